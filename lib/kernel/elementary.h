/* elementary.h - elementary functions over num, lane by lane.
 *
 * sin and cos are our own, so that a lane of a batch has the bits of a single run:
 *
 *     n = nearest integer to x 2/pi,   r - tail = x - n pi/2,   |r| <= pi/4,
 *     sin r = r - r^3 S(r^2),          cos r = 1 - r^2/2 + r^4 C(r^2),
 *
 * and n mod 4 selects +-sin or +-cos.  Error below 0.85 ulp for |x| <= 1e7; beyond,
 * and for what is not finite, the lane concerned is libm's.
 *
 * Reduction (Cody and Waite 1980, chapter 8) with fused products: pi/2 = P1 + P2 + P3, each the
 * double nearest to what remains, up to 2^-161.  For |x| <= 1e7, n < 2^23:  a = x - n P1 is exact,
 * a multiple of 2^-53 below 1.  n P2 = b + rest exactly, |b| < 2^-30, so that a is a multiple of
 * the last place of b and r = a - b with its rounding error (a - r) - b is exact too (Dekker 1971).
 * No double up to 1e7 but 0 comes nearer to a multiple of pi/2 than 2^-61 (the nearest is at
 * 29 pi/2).
 *
 * Coefficients: S and C are the polynomials of degree 5 that interpolate (1 - sin x / x)/x^2 and
 * (cos x - 1 + x^2/2)/x^4, in exact rationals from their Taylor series, at the six largest zeros
 * of the Chebyshev polynomial T7 (T8), placed on z = x^2 so that its smallest (second smallest)
 * zero is z = 0 and its interval ends at (pi/4)^2: x^2 S and x^4 C then err almost evenly, by
 * 9.5e-18 and 8.2e-19 with coefficients rounded to double.
 *
 * The rarer functions call libm in each lane.  Quad precision takes the C library's. */
#ifndef DAL_KERNEL_ELEMENTARY_H
#define DAL_KERNEL_ELEMENTARY_H

#include "num.h"

#if DAL_WITH(SINCOS)
#ifndef DAL_NUM_QUAD

#if DAL_SCALAR
typedef uint64_t dal__unsigned;
DAL_INLINE dal_mask dal__bits(num x)
{
    dal_mask bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}
DAL_INLINE num dal__from_bits(dal_mask bits)
{
    num x;
    memcpy(&x, &bits, sizeof x);
    return x;
}
#else
typedef uint64_t dal__unsigned __attribute__((vector_size(8 * DAL_LANES), may_alias));
DAL_INLINE dal_mask dal__bits(num x) { return (dal_mask)x; }
DAL_INLINE num dal__from_bits(dal_mask bits) { return (num)bits; }
#endif

/* x in the lanes where bit 1 of quadrant is clear, -x where it is set. */
DAL_INLINE num dal__flip(num x, dal_mask quadrant)
{
    return dal__from_bits(dal__bits(x) ^ ((dal_mask)((dal__unsigned)quadrant << 62) & INT64_MIN));
}

/* An angle brought to [-pi/4, pi/4]: r - tail, and the quadrant in the last two bits. */
typedef struct dal__angle {
    num r, tail;
    dal_mask quadrant;
} dal__angle;

DAL_INLINE dal__angle dal__reduce(num x)
{
    const num two_over_pi = dal_num(0x1.45f306dc9c883p-1);
    const num P1 = dal_num(0x1.921fb54442d18p+0), P2 = dal_num(0x1.1a62633145c07p-54);
    const num P3 = dal_num(-0x1.f1976b7ed8fbcp-110);
    const num shift = dal_num(0x1.8p52); /* puts the units of n into the last bits of shifted */
    num shifted = dal_fma(x, two_over_pi, shift), n = shifted - shift;
    num a = dal_fma(n, -P1, x), b = n * P2, rest = dal_fma(n, P2, -b);
    num r = a - b;
    num tail = dal_fma(n, P3, rest - ((a - r) - b));
    const dal__angle angle = {r, tail, dal__bits(shifted)};
    return angle;
}

/* c0 + c1 z + ... + c5 z^5, zz = z^2, the products side by side. */
DAL_INLINE num dal__quintic(const double *c, num z, num zz)
{
    num low = dal_fma(z, dal_num(c[1]), dal_num(c[0]));
    num middle = dal_fma(z, dal_num(c[3]), dal_num(c[2]));
    num high = dal_fma(z, dal_num(c[5]), dal_num(c[4]));
    return dal_fma(zz, dal_fma(zz, high, middle), low);
}

/* sin(r - tail), r^2 = z.  The correction of r is +0 where r is -0, which thus keeps its sign. */
DAL_INLINE num dal__sin_kernel(num r, num tail, num z, num zz)
{
    static const double S[] = {0x1.5555555555549p-3,  -0x1.111111110f823p-7,
                               0x1.a01a019c063e9p-13, -0x1.71de356d7f5c2p-19,
                               0x1.ae5e5df644004p-26, -0x1.5d9088d79b4d8p-33};
    num moved = tail * dal_fma(z, dal_num(-0.5), dal_num(1.0));
    return r - dal_fma(r * z, dal__quintic(S, z, zz), moved);
}

/* cos(r - tail), r^2 = z; what 1 - z/2 loses to rounding is put back. */
DAL_INLINE num dal__cos_kernel(num r, num tail, num z, num zz)
{
    static const double C[] = {0x1.555555555554ep-5,  -0x1.6c16c16c15552p-10,
                               0x1.a01a019d06981p-16, -0x1.27e4f84120a12p-22,
                               0x1.1eea0e0eaff16p-29, -0x1.8fbed74f17e31p-37};
    num w = dal_fma(z, dal_num(-0.5), dal_num(1.0));
    num lost = dal_fma(z, dal_num(-0.5), 1.0 - w);
    return w + dal_fma(zz, dal__quintic(C, z, zz), dal_fma(r, tail, lost));
}

/* near, but libm's sin x, or cos x, in the lanes beyond. */
typedef enum dal__circular { DAL__SINE, DAL__COSINE } dal__circular;
DAL_COLD num dal__beyond(dal__circular f, num x, dal_mask beyond, num near)
{
    for (int lane = 0; lane < DAL_LANES; lane++) {
        const double angle = dal_lane(x, lane), value = f == DAL__SINE ? sin(angle) : cos(angle);
        if (dal_mask_lane(beyond, lane)) near = dal_with_lane(near, lane, value);
    }
    return near;
}

DAL_INLINE void dal_sincos(num x, num *s, num *c)
{
    dal__angle angle = dal__reduce(x);
    num z = angle.r * angle.r, zz = z * z;
    num sine = dal__sin_kernel(angle.r, angle.tail, z, zz);
    num cosine = dal__cos_kernel(angle.r, angle.tail, z, zz);
    dal_mask odd = -(angle.quadrant & 1);
    *s = dal__flip(dal_select(odd, cosine, sine), angle.quadrant);
    *c = dal__flip(dal_select(odd, sine, cosine), angle.quadrant + 1);
    dal_mask beyond = ~dal_less_equal(dal_abs(x), dal_num(1e7));
    if (dal_any(beyond)) {
        *s = dal__beyond(DAL__SINE, x, beyond, *s);
        *c = dal__beyond(DAL__COSINE, x, beyond, *c);
    }
}

#else

DAL_INLINE void dal_sincos(num x, num *s, num *c)
{
    *s = DAL_QUAD_FUNCTION(sin)(x);
    *c = DAL_QUAD_FUNCTION(cos)(x);
}

#endif
#endif

#if DAL_WITH(SIN)
/* sin x, wrong by less than one unit in the last place. */
DAL_INLINE num dal_sin(num x)
{
    num s, c;
    dal_sincos(x, &s, &c);
    return s;
}

/* cos x, likewise. */
DAL_INLINE num dal_cos(num x)
{
    num s, c;
    dal_sincos(x, &s, &c);
    return c;
}
#endif

#if DAL_WITH(BRANCHES)
/* -1, 0 or 1; zeros and NaN stay what they are. */
DAL_INLINE num dal_sign(num x)
{
    num zero = dal_num(0.0);
    num negative = dal_select(dal_less(x, zero), dal_num(-1.0), x);
    return dal_select(dal_less(zero, x), dal_num(1.0), negative);
}

/* 1 where m is set, else 0; a where the condition is not 0, else b. */
DAL_INLINE num dal_truth(dal_mask m) { return dal_select(m, dal_num(1.0), dal_num(0.0)); }
DAL_INLINE num dal_if(num condition, num a, num b)
{
    return dal_select(dal_equal(condition, dal_num(0.0)), b, a);
}

/* The smaller and the larger number, the first of equal ones; NaN where one of them is. */
DAL_INLINE num dal_minimum(num a, num b) { return dal_select(dal_equal(b, b), dal_min(a, b), b); }
DAL_INLINE num dal_maximum(num a, num b) { return dal_select(dal_equal(b, b), dal_max(a, b), b); }

/* sqrt(a^2 + b^2), where the squares may over- or underflow. */
DAL_INLINE num dal_hypot(num a, num b)
{
    const num larger = dal_maximum(dal_abs(a), dal_abs(b)), one = dal_num(1.0);
    const num ratio = dal_min(dal_abs(a), dal_abs(b)) / larger;
    const num length = larger * dal_sqrt(dal_fma(ratio, ratio, one));
    return dal_select(dal_equal(larger, dal_num(0.0)), larger, length);
}

/* The largest whole number that is not above x. */
#ifdef DAL_NUM_QUAD
DAL_DECLARE_QUAD(floor)
DAL_INLINE num dal_floor(num x) { return DAL_QUAD_FUNCTION(floor)(x); }
#else
DAL_INLINE num dal_floor(num x)
{
    num y = x;
    for (int lane = 0; lane < DAL_LANES; lane++)
        y = dal_with_lane(y, lane, floor(dal_lane(x, lane)));
    return y;
}
#endif
#endif

#if DAL_WITH(TABLES)
/* A derivative, of order 0 to 3, of a piecewise polynomial; NaN outside its limits:
 *
 *     f(x) = c[0] + c[1] d + c[2] d^2 + c[3] d^3,   d = x - origin
 *
 *     data:  lower limit, upper limit | knot[knots], ascending | origin, c[4] of knots + 1 pieces
 *
 * Piece k holds from knot k - 1 up to knot k, which belongs to the next one.  The piece is the one
 * that contains a point, also where x has left it. */
DAL_INLINE num dal_piece_at(num point, num x, const double *data, int knots, int order)
{
    const double *knot = data + 2;
    num d = x, c0 = x, c1 = x, c2 = x, c3 = x;
    for (int lane = 0; lane < DAL_LANES; lane++) {
        const double at = dal_lane(point, lane);
        int k = 0;
        for (int rest = knots; rest > 0;) {
            const int half = rest / 2;
            const bool right = knot[k + half] <= at;
            k += right ? half + 1 : 0;
            rest = right ? rest - half - 1 : half;
        }
        const double *piece = knot + knots + 5 * k;
        d = dal_with_lane(d, lane, at >= data[0] && at <= data[1] ? piece[0] : NAN);
        c0 = dal_with_lane(c0, lane, piece[1]);
        c1 = dal_with_lane(c1, lane, piece[2]);
        c2 = dal_with_lane(c2, lane, piece[3]);
        c3 = dal_with_lane(c3, lane, piece[4]);
    }
    d = x - d;
    switch (order) {
    case 0:
        return dal_fma(dal_fma(dal_fma(c3, d, c2), d, c1), d, c0);
    case 1:
        return dal_fma(dal_fma(dal_num(3.0) * c3, d, dal_num(2.0) * c2), d, c1);
    case 2:
        return dal_fma(dal_num(6.0) * c3, d, dal_num(2.0) * c2);
    default:
        return dal_fma(dal_num(0.0), d, dal_num(6.0) * c3);
    }
}

DAL_INLINE num dal_piecewise(num x, const double *data, int knots, int order)
{
    return dal_piece_at(x, x, data, knots, order);
}
#endif

#if DAL_WITH(LIBM)
#define DAL__LIBM_UNARY(FUNCTION)                                                                  \
    FUNCTION(tan)                                                                                  \
    FUNCTION(asin)                                                                                 \
    FUNCTION(acos)                                                                                 \
    FUNCTION(atan)                                                                                 \
    FUNCTION(sinh) FUNCTION(cosh) FUNCTION(tanh) FUNCTION(asinh) FUNCTION(exp) FUNCTION(log)
#define DAL__LIBM_BINARY(FUNCTION) FUNCTION(atan2) FUNCTION(pow)

#ifdef DAL_NUM_QUAD
#define FUNCTION(f)                                                                                \
    DAL_DECLARE_QUAD(f)                                                                            \
    DAL_INLINE num dal_##f(num x) { return DAL_QUAD_FUNCTION(f)(x); }
DAL__LIBM_UNARY(FUNCTION)
#undef FUNCTION
#define FUNCTION(f)                                                                                \
    DAL_DECLARE_QUAD2(f)                                                                           \
    DAL_INLINE num dal_##f(num a, num b) { return DAL_QUAD_FUNCTION(f)(a, b); }
DAL__LIBM_BINARY(FUNCTION)
#undef FUNCTION
#else
#define FUNCTION(f)                                                                                \
    DAL_INLINE num dal_##f(num x)                                                                  \
    {                                                                                              \
        num y = x;                                                                                 \
        for (int lane = 0; lane < DAL_LANES; lane++)                                               \
            y = dal_with_lane(y, lane, f(dal_lane(x, lane)));                                      \
        return y;                                                                                  \
    }
DAL__LIBM_UNARY(FUNCTION)
#undef FUNCTION
#define FUNCTION(f)                                                                                \
    DAL_INLINE num dal_##f(num a, num b)                                                           \
    {                                                                                              \
        num y = a;                                                                                 \
        for (int lane = 0; lane < DAL_LANES; lane++)                                               \
            y = dal_with_lane(y, lane, f(dal_lane(a, lane), dal_lane(b, lane)));                   \
        return y;                                                                                  \
    }
DAL__LIBM_BINARY(FUNCTION)
#undef FUNCTION
#endif
#endif

#endif
