/* num.h - the number an integrator computes with: one double, or several lanes of doubles.
 *
 * A source written over num is compiled once for each variant, a number DAL_LANES of lanes and an
 * instruction set; every operation acts lane by lane and is IEEE double in each, so a lane has the
 * bits of a single run.  Comparisons give a dal_mask (all bits set or none, per lane) that
 * dal_select consumes; nothing branches on the value of one lane.  num and double mix freely in
 * + - * / : a double has the same value in every lane.  With DAL_NUM_QUAD a num is one lane of quad
 * precision (quad.h). */
#ifndef DAL_KERNEL_NUM_H
#define DAL_KERNEL_NUM_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#ifdef DAL_NUM_QUAD
#include "quad.h"
#endif

/* A generated file (DAL_SPECIALISED) has the parts that it needs, and no others: the NAMEs of
 * DAL_WITH(NAME) are listed in lib/codegen/generate.c. */
#ifndef DAL_SPECIALISED
#ifndef DAL_LANES
#define DAL_LANES 1
#endif
#define DAL_SCALAR (DAL_LANES == 1)
#ifdef DAL_MINIMAL
#define DAL__LACKS_GAUGE_GRADIENT  1
#define DAL__LACKS_RANK_BY_FACTORS 1
#define DAL_WITH(name)             !DAL__LACKS_##name
#else
#define DAL_WITH(name) 1
#endif
#define DAL_HAS_GROUPS 0           /* of lanes, stepped as one larger system */
#define DAL_HAS_TIMES  !DAL_SCALAR /* lanes with times of their own */
#if defined DAL_NUM_QUAD || defined DAL_MINIMAL
#define DAL_PACKS 0
#else
#define DAL_PACKS DAL_SCALAR
#endif
#endif

/* The name of a function that exists once per variant: DAL_WIDE(f) is f_x1, f_x8, f_x8_AVX512, ...
 */
#ifdef DAL_SPECIALISED
#if DAL_WITH(SOLVE)
#define DAL_WIDE(name) name##_once
#endif
#else
#define DAL__PASTE(a, b)  a##b
#define DAL__PASTE2(a, b) DAL__PASTE(a, b)
#ifdef DAL_VARIANT_NAME
#define DAL_WIDE(name) DAL__PASTE2(name##_, DAL_VARIANT_NAME)
#else
#define DAL_WIDE(name) DAL__PASTE2(name##_x, DAL_LANES)
#endif
#endif

#define DAL_UNUSED            __attribute__((unused))
#define DAL_RARELY(condition) __builtin_expect(!!(condition), 0)

/* A generated file defines DAL_SPECIALISED: there all sizes are constants and a whole step becomes
 * one function, its loops over components unrolled where DAL_UNROLL says so.  The head of the file
 * has DAL_INLINE, by the compiler.  Functions that are passed an iteration map are inlined early,
 * since the map itself can be inlined only where its call names it. */
#ifdef DAL_SPECIALISED
#define DAL_COLD     static DAL_UNUSED __attribute__((noinline, cold))
#define DAL_NOINLINE static DAL_UNUSED __attribute__((noinline))
#if DAL_WITH(SOLVE)
#define DAL_INLINE_EARLY static inline DAL_UNUSED __attribute__((always_inline))
#define DAL_SHARED       DAL_INLINE
#define DAL_SHARED_EARLY DAL_INLINE_EARLY
#endif
#else
#define DAL_UNROLL
#ifndef DAL_MINIMAL
#define DAL_INLINE   static inline DAL_UNUSED
#define DAL_NOINLINE static DAL_UNUSED __attribute__((noinline))
#else
/* In a small library all of the kernel is shared, see DAL_SHARED: what a source does not inline is
 * in lib/run/kernel_wide.c, once. */
#ifdef DAL_LINKS
#define DAL_INLINE __attribute__((visibility("hidden")))
#else
#define DAL_INLINE inline
#endif
#define DAL_NOINLINE DAL_INLINE
#endif
#define DAL_INLINE_EARLY DAL_INLINE
#define DAL_COLD         DAL_INLINE
/* Large functions that several integrators share are compiled once per variant in the library, by
 * lib/run/kernel_wide.c (DAL_LINKS); its other sources (DAL_LINKED) see their declarations.  In all
 * other files they are a part of the file like the rest of the kernel. */
#if defined DAL_LINKED || defined DAL_LINKS
#define DAL_SHARED __attribute__((visibility("hidden")))
#else
#define DAL_SHARED DAL_INLINE
#endif
#define DAL_SHARED_EARLY DAL_SHARED
#endif

/* A loop over i from 0 to count - 1. */
#define DAL_EACH(i, count) DAL_UNROLL for (int i = 0; i < (count); i++)

#if DAL_SCALAR

#ifdef DAL_NUM_QUAD
typedef dal_quad num;
#define DAL_ULP_RATIO DAL_QUAD_ULP_RATIO /* unit in the last place, in units of a double's */
#else
/* A number, or one for each lane, with + - * / and unary minus. */
typedef double num;
#define DAL_ULP_RATIO 1.0
#endif
typedef double dal_stored;
/* A time or the size of a step: a double, or one for each lane. */
typedef double dal_times;
/* A choice of lanes, with & | ~. */
typedef int64_t dal_mask;

/* A double in all lanes; all lanes; a where m is set, else b; whether m is set in any lane. */
DAL_INLINE num dal_num(double x) { return x; }
DAL_INLINE dal_mask dal_all(void) { return -1; }
DAL_INLINE num dal_select(dal_mask m, num a, num b) { return m ? a : b; }
DAL_INLINE bool dal_any(dal_mask m) { return m != 0; }
DAL_INLINE double dal_lane(num x, int lane) { return (void)lane, x; }
DAL_INLINE num dal_with_lane(num x, int lane, double value) { return (void)lane, (void)x, value; }
DAL_INLINE dal_mask dal_lane_mask(int lane) { return (void)lane, -1; }
DAL_INLINE bool dal_mask_lane(dal_mask m, int lane) { return (void)lane, m != 0; }
#define DAL__COMPARE(a, op, b) (-(int64_t)((a)op(b)))

#else

#define DAL_ULP_RATIO 1.0
typedef double num __attribute__((vector_size(8 * DAL_LANES), may_alias));
typedef int64_t dal_mask __attribute__((vector_size(8 * DAL_LANES), may_alias));
/* A num in memory of doubles that need not be aligned to its lanes. */
typedef double dal_stored __attribute__((vector_size(8 * DAL_LANES), may_alias, aligned(8)));
typedef num dal_times;

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
#if defined __AVX512F__ && DAL_LANES == 8
DAL_INLINE bool dal_any(dal_mask m)
{
    typedef long long bits __attribute__((vector_size(64)));
    const bits none = {0};
    return __builtin_ia32_cmpq512_mask((bits)m, none, 4, (unsigned char)-1) != 0; /* 4: differs */
}
#elif defined __AVX__ && DAL_LANES == 4
DAL_INLINE bool dal_any(dal_mask m) { return __builtin_ia32_movmskpd256((num)m) != 0; }
#else
DAL_INLINE bool dal_any(dal_mask m)
{
    int64_t any = 0;
    for (int lane = 0; lane < DAL_LANES; lane++) any |= m[lane];
    return any != 0;
}
#endif
DAL_INLINE double dal_lane(num x, int lane) { return x[lane]; }
DAL_INLINE num dal_with_lane(num x, int lane, double value) { return x[lane] = value, x; }
DAL_INLINE dal_mask dal_lane_mask(int lane)
{
    dal_mask m = {0};
    m[lane] = -1;
    return m;
}
DAL_INLINE bool dal_mask_lane(dal_mask m, int lane) { return m[lane] != 0; }
#define DAL__COMPARE(a, op, b) ((dal_mask)((a)op(b)))

#endif

/* In each lane: comparisons, the larger and the smaller number. */
DAL_INLINE dal_mask dal_less(num a, num b) { return DAL__COMPARE(a, <, b); }
DAL_INLINE dal_mask dal_less_equal(num a, num b) { return DAL__COMPARE(a, <=, b); }
DAL_INLINE dal_mask dal_equal(num a, num b) { return DAL__COMPARE(a, ==, b); }
#if DAL_SCALAR
DAL_INLINE num dal_max(num a, num b) { return a < b ? b : a; }
DAL_INLINE num dal_min(num a, num b) { return b < a ? b : a; }
#elif defined __AVX512F__ && DAL_LANES == 8 &&                                                     \
    !defined __clang__ /* which finds the instruction itself */
DAL_INLINE num dal_max(num a, num b)
{
    return __builtin_ia32_maxpd512_mask(b, a, a, (unsigned char)-1, 4);
}
DAL_INLINE num dal_min(num a, num b)
{
    return __builtin_ia32_minpd512_mask(b, a, a, (unsigned char)-1, 4);
}
#else
DAL_INLINE num dal_max(num a, num b) { return dal_select(dal_less(a, b), b, a); }
DAL_INLINE num dal_min(num a, num b) { return dal_select(dal_less(b, a), b, a); }
#endif
/* a or b, the same in every lane. */
DAL_INLINE num dal_choose(bool condition, num a, num b) { return condition ? a : b; }
/* Lanes where x is neither infinite nor NaN. */
DAL_INLINE dal_mask dal_finite(num x) { return dal_equal(x - x, dal_num(0.0)); }

/* |x|; the square root; a b + c, rounded once.  Where the processor has no instruction for that the
 * C library computes it: the same bits, slowly. */
#ifdef DAL_NUM_QUAD
DAL_INLINE num dal_abs(num x) { return DAL_QUAD_FUNCTION(fabs)(x); }
DAL_INLINE num dal_sqrt(num x) { return DAL_QUAD_FUNCTION(sqrt)(x); }
DAL_INLINE num dal_fma(num a, num b, num c) { return a * b + c; } /* its rounding does not matter */
#elif DAL_SCALAR
DAL_INLINE num dal_abs(num x) { return fabs(x); }
DAL_INLINE num dal_sqrt(num x) { return sqrt(x); }
DAL_INLINE num dal_fma(num a, num b, num c) { return __builtin_fma(a, b, c); }
#else
/* Compilers do not reliably turn a loop over the lanes into one instruction, so it is named where
 * it exists, for as many lanes as a register holds. */
#if defined __AVX512F__ && DAL_LANES >= 8
#define DAL__REGISTER      8
#define DAL__FUSE(a, b, c) __builtin_ia32_vfmaddpd512_mask(a, b, c, (unsigned char)-1, 4)
#elif defined __FMA__ && DAL_LANES >= 4
#define DAL__REGISTER      4
#define DAL__FUSE(a, b, c) __builtin_ia32_vfmaddpd256(a, b, c)
#elif defined __FMA__
#define DAL__REGISTER      2
#define DAL__FUSE(a, b, c) __builtin_ia32_vfmaddpd(a, b, c)
#endif

#ifdef DAL__FUSE
typedef double dal__register __attribute__((vector_size(8 * DAL__REGISTER)));

DAL_INLINE num dal_fma(num a, num b, num c)
{
    union {
        num all;
        dal__register piece[DAL_LANES / DAL__REGISTER];
    } x = {a}, y = {b}, z = {c};
    for (int i = 0; i < DAL_LANES / DAL__REGISTER; i++)
        x.piece[i] = DAL__FUSE(x.piece[i], y.piece[i], z.piece[i]);
    return x.all;
}
#else
DAL_INLINE num dal_fma(num a, num b, num c)
{
    num r = a;
    for (int lane = 0; lane < DAL_LANES; lane++) r[lane] = __builtin_fma(a[lane], b[lane], c[lane]);
    return r;
}
#endif
DAL_INLINE num dal_abs(num x) { return (num)((dal_mask)x & INT64_MAX); }
DAL_INLINE num dal_sqrt(num x)
{
    num r;
    for (int lane = 0; lane < DAL_LANES; lane++) r[lane] = sqrt(x[lane]);
    return r;
}
#endif

#define DAL_RESTRICT __restrict

/* Reductions over many numbers use packs, which a compiler must not form by itself.  For the
 * maximum and for finiteness the order does not matter.  Sums use packs from DAL__MIN_PACKED
 * numbers on, in one order for all builds.  Functions over packs that return a number say how many
 * numbers they have processed. */
enum { DAL__PACK = 8, DAL__MIN_PACKED = 16 };
#if DAL_PACKS
typedef double dal__pack __attribute__((vector_size(64), aligned(8), may_alias));
typedef int64_t dal__pack_mask __attribute__((vector_size(64)));

/* partial = max(partial, |x|) */
DAL_INLINE void dal__pack_max(dal__pack *partial, const dal__pack *x)
{
    const dal__pack_mask size = (dal__pack_mask)*x & INT64_MAX, less = *partial < (dal__pack)size;
    *partial = (dal__pack)((size & less) | ((dal__pack_mask)*partial & ~less));
}
DAL_INLINE int dal__norm_packs(const num *x, int count, num *norm)
{
    if (count < DAL__PACK) return 0; /* packs cost more than a few numbers */
    dal__pack partial[4] = {{0}};    /* four independent chains */
    int i = 0;
    for (; i + 4 * DAL__PACK <= count; i += 4 * DAL__PACK)
        for (int k = 0; k < 4; k++)
            dal__pack_max(&partial[k], (const dal__pack *)(x + i + k * DAL__PACK));
    for (; i + DAL__PACK <= count; i += DAL__PACK)
        dal__pack_max(&partial[0], (const dal__pack *)(x + i));
    for (int k = 1; k < 4; k++) dal__pack_max(&partial[0], &partial[k]);
    for (int j = 0; j < DAL__PACK; j++) *norm = dal_max(*norm, partial[0][j]);
    return i;
}
DAL_INLINE int dal__nonfinite_packs(const num *x, int count, num *nonfinite)
{
    dal__pack partial = {0};
    int i = 0;
    for (; i + DAL__PACK <= count; i += DAL__PACK)
        partial += *(const dal__pack *)(x + i) - *(const dal__pack *)(x + i);
    for (int j = 0; j < DAL__PACK; j++) *nonfinite += partial[j];
    return i;
}
/* part_j = sum of u_i^2, i = j modulo the size of a pack; count is a multiple of it. */
DAL_INLINE void dal__square_packs(const num *u, int count, num *partial)
{
    dal__pack sum = {0};
    for (int i = 0; i < count; i += DAL__PACK)
        sum += *(const dal__pack *)(u + i) * *(const dal__pack *)(u + i);
    for (int j = 0; j < DAL__PACK; j++) partial[j] = sum[j];
}
#else
#define dal__norm_packs(x, count, norm)           0
#define dal__nonfinite_packs(x, count, nonfinite) 0
#endif

#if DAL_WITH(UNITS)
/* x/unit_i; unit NULL: 1. */
DAL_INLINE num dal_in_units(num x, const double *unit, int i)
{
    if (!unit) return x;
    return x / unit[i];
}
#endif

#if DAL_WITH(SOLVE)
/* max |x_i|, of x[count] */
DAL_INLINE num dal_max_norm(const num *x, int count)
{
    num norm = dal_num(0.0);
    const int seen = dal__norm_packs(x, count, &norm);
    DAL_EACH(i, count - seen) norm = dal_max(norm, dal_abs(x[seen + i]));
    return norm;
}
#endif

/* 0, or NaN where one of the numbers is not finite. */
DAL_INLINE num dal_nonfinite(const num *x, int count)
{
    num nonfinite = dal_num(0.0);
    const int seen = dal__nonfinite_packs(x, count, &nonfinite);
    DAL_EACH(i, count - seen) nonfinite += x[seen + i] - x[seen + i];
    return nonfinite;
}

#if DAL_WITH(LIFT)
/* |u|^2 */
DAL_INLINE num dal_square(const num *u, int count)
{
    num partial[DAL__PACK], sum = dal_num(0.0);
    DAL_EACH(j, DAL__PACK) partial[j] = dal_num(0.0);
    const int seen = count < DAL__MIN_PACKED ? 0 : count / DAL__PACK * DAL__PACK;
#if DAL_PACKS
    if (seen > 0) dal__square_packs(u, seen, partial);
#else
    DAL_EACH(i, seen) partial[i % DAL__PACK] += u[i] * u[i];
#endif
    DAL_EACH(i, count - seen) sum += u[seen + i] * u[seen + i];
    if (seen == 0) return sum;
    return (((partial[0] + partial[4]) + (partial[2] + partial[6])) +
            ((partial[1] + partial[5]) + (partial[3] + partial[7]))) +
           sum;
}
#endif

#endif
