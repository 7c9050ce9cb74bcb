/* num.h - the number an integrator computes with: one double, or several lanes of doubles.
 *
 * A source written over num is compiled once for each DAL_LANES in {1, 4, 8}; every operation acts
 * lane by lane and is IEEE double in each, so a lane has the bits of a single run.  Comparisons
 * give a dal_mask (all bits set or none, per lane) that dal_select consumes; nothing branches on
 * the value of one lane.  num and double mix freely in + - * / : a double is every lane's value. */
#ifndef DAL_KERNEL_NUM_H
#define DAL_KERNEL_NUM_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#ifndef DAL_LANES
#define DAL_LANES 1
#endif

#define DAL__PASTE(a, b)  a##b
#define DAL__PASTE2(a, b) DAL__PASTE(a, b)
/* The name of a function that exists once per width: DAL_WIDE(f) is f_x1, f_x4 or f_x8. */
#define DAL_WIDE(name) DAL__PASTE2(name##_x, DAL_LANES)

#define DAL_UNUSED __attribute__((unused))

/* A generated file defines DAL_SPECIALISED: there all sizes are constants and a whole step becomes
 * one function, its loops over components unrolled where DAL_UNROLL says so. */
#ifdef DAL_SPECIALISED
#define DAL_INLINE static inline DAL_UNUSED __attribute__((always_inline))
#define DAL_COLD   static DAL_UNUSED __attribute__((noinline, cold))
#else
#define DAL_UNROLL
#define DAL_INLINE static inline DAL_UNUSED
#define DAL_COLD   static inline DAL_UNUSED
#endif

/* for i = 0 .. count - 1 */
#define DAL_EACH(i, count) DAL_UNROLL for (int i = 0; i < (count); i++)

#if DAL_LANES == 1

typedef double num;
typedef int64_t dal_mask;

DAL_INLINE num dal_num(double x) { return x; }
DAL_INLINE dal_mask dal_all(void) { return -1; }
DAL_INLINE num dal_select(dal_mask m, num a, num b) { return m ? a : b; }
DAL_INLINE int dal_any(dal_mask m) { return m != 0; }
DAL_INLINE double dal_lane(num x, int lane) { return (void)lane, x; }
DAL_INLINE num dal_with_lane(num x, int lane, double value) { return (void)lane, (void)x, value; }
DAL_INLINE dal_mask dal_lane_mask(int lane) { return (void)lane, -1; }
DAL_INLINE int dal_mask_lane(dal_mask m, int lane) { return (void)lane, m != 0; }
#define DAL__COMPARE(a, op, b) (-(int64_t)((a)op(b)))

#else

typedef double num __attribute__((vector_size(8 * DAL_LANES), may_alias));
typedef int64_t dal_mask __attribute__((vector_size(8 * DAL_LANES), may_alias));

DAL_INLINE num dal_num(double x)
{
    const num zero = {0};
    return x - zero;
}
DAL_INLINE dal_mask dal_all(void)
{
    const dal_mask none = {0};
    return ~none;
}
DAL_INLINE num dal_select(dal_mask m, num a, num b)
{
    return (num)(((dal_mask)a & m) | ((dal_mask)b & ~m));
}
DAL_INLINE int dal_any(dal_mask m)
{
    int64_t any = 0;
    for (int lane = 0; lane < DAL_LANES; lane++) any |= m[lane];
    return any != 0;
}
DAL_INLINE double dal_lane(num x, int lane) { return x[lane]; }
DAL_INLINE num dal_with_lane(num x, int lane, double value) { return x[lane] = value, x; }
DAL_INLINE dal_mask dal_lane_mask(int lane)
{
    dal_mask m = {0};
    m[lane] = -1;
    return m;
}
DAL_INLINE int dal_mask_lane(dal_mask m, int lane) { return m[lane] != 0; }
#define DAL__COMPARE(a, op, b) ((dal_mask)((a)op(b)))

#endif

DAL_INLINE dal_mask dal_less(num a, num b) { return DAL__COMPARE(a, <, b); }
DAL_INLINE dal_mask dal_less_equal(num a, num b) { return DAL__COMPARE(a, <=, b); }
DAL_INLINE dal_mask dal_equal(num a, num b) { return DAL__COMPARE(a, ==, b); }
DAL_INLINE num dal_max(num a, num b) { return dal_select(dal_less(a, b), b, a); }
DAL_INLINE num dal_min(num a, num b) { return dal_select(dal_less(b, a), b, a); }
/* a or b in every lane alike. */
DAL_INLINE num dal_choose(int condition, num a, num b) { return condition ? a : b; }
/* Lanes where x is neither infinite nor NaN. */
DAL_INLINE dal_mask dal_finite(num x) { return dal_equal(x - x, dal_num(0.0)); }

#if DAL_LANES == 1
DAL_INLINE num dal_abs(num x) { return fabs(x); }
DAL_INLINE num dal_sqrt(num x) { return sqrt(x); }
#else
DAL_INLINE num dal_abs(num x) { return (num)((dal_mask)x & INT64_MAX); }
DAL_INLINE num dal_sqrt(num x)
{
    num r;
    for (int lane = 0; lane < DAL_LANES; lane++) r[lane] = sqrt(x[lane]);
    return r;
}
#endif

#endif
