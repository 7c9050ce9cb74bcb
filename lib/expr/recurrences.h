/* recurrences.h - the recurrences of Taylor coefficients.
 *
 * u_k is coefficient k of u, in t/tau; sums run over j.  With (a b)_k = sum a_j b_(k-j) and, from
 * u' = g a',   [a, g]_k = (1/k) sum_(j=1..k) j a_j g_(k-j):
 *
 *     u = a b            u_k = (a b)_k
 *     u = a/b            u_k = (a_k - sum_(j>=1) b_j u_(k-j)) / b_0
 *     u = sqrt a         u_k = (a_k - sum_(0<j<k) u_j u_(k-j)) / 2 u_0
 *     u = a^r            u_k = (r [a, u]_k - (1/k) sum_(0<j<k) j u_j a_(k-j)) / a_0
 *     u = exp a          u_k = [a, u]_k
 *     u = sin, w = cos   u_k = [a, w]_k,  w_k = -[a, u]_k             (sinh, cosh without the sign)
 *                        of a coordinate: k u_k = tau (a' w)_(k-1),  k w_k = -tau (a' u)_(k-1)
 *     u = tan, w = u^2   u_k = a_k + [a, w]_k,  w_k = (u u)_k         (tanh: a_k - [a, w]_k)
 *     u' w = g a'        u_k = ([a, g]_k - (1/k) sum_(0<j<k) j u_j w_(k-j)) / w_0:
 *         log a          g = 1, w = a
 *         asin a         g = 1,  w = sqrt(1 - a^2),  w' = -a u'
 *         acos a         g = -1, w = sqrt(1 - a^2),  w' = a u'
 *         asinh a        g = 1,  w = sqrt(1 + a^2),  w' = a u'
 *         atan a         g = 1,  w = 1 + a^2
 *         atan2(a, b)    u' w = b a' - a b',  w = a^2 + b^2
 *     u = hypot(a, b)    u_k = ((a a)_k + (b b)_k - sum_(0<j<k) u_j u_(k-j)) / 2 u_0
 *
 * Terms with coefficient k, or 0, are added to the inner sums last.  What recurrences divide by is
 * the same in all orders: they multiply by its reciprocal, and by 1/k.
 *
 * The one list of these: taylor.c makes programs by it, taylor_wide.c computes what it says, over
 * num, and taylor_emit.c writes the same as C.  A row has the pairs of series whose inner sums the
 * recurrence needs, w_0, what it divides by, u_k and w_k, as far as there are any; a quotient with
 * a second series divides by w_0.  In the formulas
 *
 *     a, b, c, u, w       coefficient k of the operands, of the result and of the second series
 *     a_0, .., w_0        coefficient 0
 *     b_before, c_before  coefficient k - 1
 *     inverse             1/k
 *     unit_inverse        tau/k
 *     reciprocal          of what is divided by
 *     INNER(j)            inner sum j
 *     PRODUCT(a, b, j)    (a b)_k, by inner sum j
 *     INTEGRAL(a, g, j)   [a, g]_k, by inner sum j
 */
#ifndef DAL_EXPR_RECURRENCES_H
#define DAL_EXPR_RECURRENCES_H

#include "expr/operations.h"

/* An operand is a slot, or with this bit the place in work of what is constant along a run. */
#define DAL__TAYLOR_CONSTANT (UINT32_C(1) << 31)

/* Recurrences that are not each of an operation of tapes. */
enum {
    DAL__SLOPE = DAL__SUB_MUL + 1, /* coefficients j a_j */
    DAL__POW_MOVING,               /* a power whose exponent moves: a^b = exp(c), c = b log a */
    DAL__LOG_CONSTANT,             /* of what is constant along a run */
    DAL__DIV_CONSTANT,             /* by what is */
    DAL__OVER_ROOT_CUBED,          /* a constant over b = c sqrt c */
    DAL__SIN_TURN,                 /* sine of a coordinate a, whose cosine times a' is b, and */
    DAL__COS_TURN,                 /* sine times a' is c; so the next two */
    DAL__SINCOS_TURN,
    DAL__RECURRENCES
};

enum { DAL__TAYLOR_SUMS = 5 };

/* clang-format off */
#define DAL__RECURRENCE_LIST(PLAIN, QUOTIENT, PAIR, PAIR_QUOTIENT)                                 \
    PLAIN(ADD, NO_SUMS, a + b)                                                                     \
    PLAIN(SUB, NO_SUMS, a - b)                                                                     \
    PLAIN(NEG, NO_SUMS, -a)                                                                        \
    PLAIN(SLOPE, NO_SUMS, (double)k * a)                                                           \
    PLAIN(MUL, SUMS({A, B}), PRODUCT(a, b, 0))                                                     \
    PLAIN(MUL_ADD, SUMS({A, B}), PRODUCT(a, b, 0) + c)                                             \
    PLAIN(MUL_SUB, SUMS({A, B}), PRODUCT(a, b, 0) - c)                                             \
    PLAIN(SUB_MUL, SUMS({A, B}), c - PRODUCT(a, b, 0))                                             \
    PLAIN(IF, NO_SUMS, dal_if(a_0, b, c)) /* whose condition is constant */                        \
    PLAIN(EXP, SUMS({SLOPE_A, U}), INTEGRAL(a, u, 0))                                              \
    PLAIN(POW_MOVING, SUMS({SLOPE_C, U}), INTEGRAL(c, u, 0))                                       \
    PLAIN(LOG_CONSTANT, NO_SUMS, dal_num(0.0))                                                     \
    QUOTIENT(LOG, SUMS({SLOPE_U, A}), a_0, (a - inverse * INNER(0)) * reciprocal)                  \
    QUOTIENT(DIV_CONSTANT, NO_SUMS, b_0, a * reciprocal)                                           \
    QUOTIENT(DIV, SUMS({B, U}), b_0, (a - dal_fma(b, u_0, INNER(0))) * reciprocal)                 \
    QUOTIENT(OVER_ROOT_CUBED, SUMS({SLOPE_C, U}, {SLOPE_U, C}), c_0,                               \
             (-1.5 * dal_fma((double)k * c, u_0, INNER(0)) - INNER(1)) * inverse * reciprocal)     \
    QUOTIENT(SQRT, SUMS({U, U}), (2.0 * u_0), (a - INNER(0)) * reciprocal)                         \
    QUOTIENT(HYPOT, SUMS({U, U}, {A, A}, {B, B}), (2.0 * u_0),                                     \
             (PRODUCT(a, a, 1) + PRODUCT(b, b, 2) - INNER(0)) * reciprocal)                        \
    QUOTIENT(POW, SUMS({SLOPE_A, U}, {SLOPE_U, A}), a_0,                                           \
             (b_0 * dal_fma((double)k * a, u_0, INNER(0)) - INNER(1)) * inverse * reciprocal)      \
    PAIR(SIN, SUMS({SLOPE_A, U}, {SLOPE_A, W}), dal_cos(a_0),                                      \
         INTEGRAL(a, w, 1), -1.0 * INTEGRAL(a, u, 0))                                              \
    PAIR(SINCOS, SUMS({SLOPE_A, U}, {SLOPE_A, W}), dal_cos(a_0),                                   \
         INTEGRAL(a, w, 1), -1.0 * INTEGRAL(a, u, 0))                                              \
    PAIR(COS, SUMS({SLOPE_A, U}, {SLOPE_A, W}), dal_sin(a_0),                                      \
         -1.0 * INTEGRAL(a, w, 1), INTEGRAL(a, u, 0))                                              \
    PAIR(SIN_TURN, NO_SUMS, dal_cos(a_0), unit_inverse * b_before,                                 \
         -1.0 * (unit_inverse * c_before))                                                         \
    PAIR(SINCOS_TURN, NO_SUMS, dal_cos(a_0), unit_inverse * b_before,                              \
         -1.0 * (unit_inverse * c_before))                                                         \
    PAIR(COS_TURN, NO_SUMS, dal_sin(a_0), -1.0 * (unit_inverse * c_before),                        \
         unit_inverse * b_before)                                                                  \
    PAIR(SINH, SUMS({SLOPE_A, U}, {SLOPE_A, W}), dal_cosh(a_0),                                    \
         INTEGRAL(a, w, 1), INTEGRAL(a, u, 0))                                                     \
    PAIR(COSH, SUMS({SLOPE_A, U}, {SLOPE_A, W}), dal_sinh(a_0),                                    \
         INTEGRAL(a, w, 1), INTEGRAL(a, u, 0))                                                     \
    PAIR(TAN, SUMS({SLOPE_A, W}, {U, U}), u_0 * u_0,                                               \
         a + INTEGRAL(a, w, 0), PRODUCT(u, u, 1))                                                  \
    PAIR(TANH, SUMS({SLOPE_A, W}, {U, U}), u_0 * u_0,                                              \
         a - INTEGRAL(a, w, 0), PRODUCT(u, u, 1))                                                  \
    PAIR_QUOTIENT(ASIN, SUMS({SLOPE_U, W}, {SLOPE_U, A}), dal_sqrt((1.0 - a_0) * (1.0 + a_0)),     \
                  (a - inverse * INNER(0)) * reciprocal, -INTEGRAL(u, a, 1))                       \
    PAIR_QUOTIENT(ACOS, SUMS({SLOPE_U, W}, {SLOPE_U, A}), dal_sqrt((1.0 - a_0) * (1.0 + a_0)),     \
                  (-a - inverse * INNER(0)) * reciprocal, INTEGRAL(u, a, 1))                       \
    PAIR_QUOTIENT(ASINH, SUMS({SLOPE_U, W}, {SLOPE_U, A}),                                         \
                  dal_sqrt(dal_fma(a_0, a_0, dal_num(1.0))),                                       \
                  (a - inverse * INNER(0)) * reciprocal, INTEGRAL(u, a, 1))                        \
    PAIR_QUOTIENT(ATAN, SUMS({SLOPE_U, W}, {A, A}), dal_fma(a_0, a_0, dal_num(1.0)),               \
                  (a - inverse * INNER(0)) * reciprocal, PRODUCT(a, a, 1))                         \
    PAIR_QUOTIENT(ATAN2, SUMS({SLOPE_U, W}, {A, A}, {B, B}, {SLOPE_A, B}, {SLOPE_B, A}),           \
                  dal_fma(a_0, a_0, b_0 * b_0),                                                    \
                  (INTEGRAL(a, b, 3) - INTEGRAL(b, a, 4) - inverse * INNER(0)) * reciprocal,       \
                  PRODUCT(a, a, 1) + PRODUCT(b, b, 2))

/* PRODUCT and INTEGRAL of a and b: which of them are constant along a run, or the same, decides
 * among these.  SUM is their inner sum. */
#define DAL__CONVOLUTION_LIST(FORM)                                                                \
    FORM(ZERO, dal_num(0.0))                                                                       \
    FORM(MULTIPLE_OF_A, a * b_0)                                                                   \
    FORM(MULTIPLE_OF_B, b * a_0)                                                                   \
    FORM(SQUARE, dal_fma(a_0 + a_0, a, SUM))                                                       \
    FORM(PRODUCT, dal_fma(b, a_0, dal_fma(a, b_0, SUM)))                                           \
    FORM(INTEGRAL, inverse * dal_fma((double)k * a, b_0, SUM))
/* clang-format on */

typedef enum dal__convolution {
#define FORM(name, expression) DAL__##name,
    DAL__CONVOLUTION_LIST(FORM)
#undef FORM
} dal__convolution;

static inline bool dal__is_constant(uint32_t a) { return (a & DAL__TAYLOR_CONSTANT) != 0; }

static inline dal__convolution dal__product_form(uint32_t a, uint32_t b)
{
    if (dal__is_constant(b)) return DAL__MULTIPLE_OF_A;
    if (dal__is_constant(a)) return DAL__MULTIPLE_OF_B;
    return a == b ? DAL__SQUARE : DAL__PRODUCT;
}

static inline dal__convolution dal__integral_form(uint32_t a, uint32_t b)
{
    if (dal__is_constant(a)) return DAL__ZERO;
    return dal__is_constant(b) ? DAL__MULTIPLE_OF_A : DAL__INTEGRAL;
}

#endif
