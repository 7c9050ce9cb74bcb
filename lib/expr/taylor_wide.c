/* taylor_wide.c - the recurrences of Taylor coefficients, over num.
 *
 * u_k is coefficient k of u; sums run over j.  With (a b)_k = sum a_j b_(k-j) and, from
 * u' = g a',   [a, g]_k = (1/k) sum_(j=1..k) j a_j g_(k-j):
 *
 *     u = a b            u_k = (a b)_k
 *     u = a/b            u_k = (a_k - sum_(j>=1) b_j u_(k-j)) / b_0
 *     u = sqrt a         u_k = (a_k - sum_(0<j<k) u_j u_(k-j)) / 2 u_0
 *     u = a^r            u_k = (r [a, u]_k - (1/k) sum_(0<j<k) j u_j a_(k-j)) / a_0
 *     u = exp a          u_k = [a, u]_k
 *     u = sin, w = cos   u_k = [a, w]_k,  w_k = -[a, u]_k             (sinh, cosh without the sign)
 *                        of a coordinate: k u_k = (a' w)_(k-1),  k w_k = -(a' u)_(k-1)
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
 * the same in all orders: they multiply by its reciprocal, and by 1/k. */
#include "expr/arithmetic.h"
#include "expr/taylor.h"
#include "expr/traversal.h"
#include "kernel/series.h"

/* An order that is computed. */
typedef struct expansion {
    const dal__taylor *taylor;
    const num *work;
    num *memory;
    int k, stride;
    num inverse; /* 1/k */
} expansion;

static inline num *series(const expansion *x, uint32_t slot)
{
    return x->memory + (size_t)slot * (size_t)x->stride;
}

/* Coefficient j of an operand. */
static inline num coefficient(const expansion *x, uint32_t a, int j)
{
    if (!(a & DAL__TAYLOR_CONSTANT)) return series(x, a)[j];
    return j == 0 ? x->work[a & ~DAL__TAYLOR_CONSTANT] : dal_num(0.0);
}

/* Inner sum j of an operation. */
static num inner(const expansion *x, const dal__taylor_operation *i, int j)
{
    const dal__taylor_sum *sum = &x->taylor->sum[i->sum[j]];
    return sum->a == sum->b ? dal_sum_squares(series(x, sum->a), x->k)
                            : dal_sum_products(series(x, sum->a), series(x, sum->b), x->k);
}

/* (a b)_k of any operands, by inner sum j. */
static num product(const expansion *x, const dal__taylor_operation *i, int j, uint32_t a,
                   uint32_t b)
{
    const num a_k = coefficient(x, a, x->k), b_0 = coefficient(x, b, 0);
    if (b & DAL__TAYLOR_CONSTANT) return a_k * b_0;
    if (a == b) return dal_fma(b_0 + b_0, a_k, inner(x, i, j));
    const num a_0 = coefficient(x, a, 0), b_k = coefficient(x, b, x->k);
    if (a & DAL__TAYLOR_CONSTANT) return a_0 * b_k;
    return dal_fma(b_k, a_0, dal_fma(a_k, b_0, inner(x, i, j)));
}

/* [a, g]_k of any operands. */
static num integral(const expansion *x, const dal__taylor_operation *i, int j, uint32_t a,
                    uint32_t g)
{
    const num a_k = coefficient(x, a, x->k), g_0 = coefficient(x, g, 0);
    if (a & DAL__TAYLOR_CONSTANT) return dal_num(0.0);
    if (g & DAL__TAYLOR_CONSTANT) return a_k * g_0;
    return x->inverse * dal_fma((double)x->k * a_k, g_0, inner(x, i, j));
}

/* ---- order 0 ---- */

/* The result of an operation, as a tape has it. */
static num value(const expansion *x, const dal__taylor_operation *i)
{
    const num a = coefficient(x, i->a, 0), b = coefficient(x, i->b, 0), c = coefficient(x, i->c, 0);
    (void)b, (void)c;
    switch (i->op) {
#define CASE(code, expression)                                                                     \
    case DAL__##code:                                                                              \
        return expression;
        DAL__OPERATION_LIST(CASE)
#undef CASE
    case DAL__POW_MOVING:
        return dal_pow(a, b);
    default:
        return dal_num(NAN);
    }
}

/* The second series of a recurrence. */
static num companion(uint32_t op, num a, num b, num u)
{
    switch (op) {
    case DAL__SIN:
        return dal_cos(a);
    case DAL__COS:
        return dal_sin(a);
    case DAL__SINH:
        return dal_cosh(a);
    case DAL__COSH:
        return dal_sinh(a);
    case DAL__ASIN:
    case DAL__ACOS:
        return dal_sqrt((1.0 - a) * (1.0 + a));
    case DAL__ASINH:
        return dal_sqrt(dal_fma(a, a, dal_num(1.0)));
    case DAL__ATAN:
        return dal_fma(a, a, dal_num(1.0));
    case DAL__ATAN2:
        return dal_fma(a, a, b * b);
    default: /* of tan and tanh */
        return u * u;
    }
}

/* What the recurrence divides by. */
static num divisor(const expansion *x, const dal__taylor_operation *i)
{
    switch (i->op) {
    case DAL__DIV:
        return coefficient(x, i->b, 0);
    case DAL__SQRT:
    case DAL__HYPOT:
        return 2.0 * coefficient(x, i->d, 0);
    case DAL__POW:
    case DAL__LOG:
        return coefficient(x, i->a, 0);
    default:
        return coefficient(x, i->e, 0);
    }
}

static void begin(const expansion *x, const dal__taylor_operation *i)
{
    const num a = coefficient(x, i->a, 0);
    if (i->op == DAL__SINCOS) {
        dal_sincos(a, series(x, i->d), series(x, i->e));
        return;
    }
    const num u = i->op == DAL__SLOPE ? dal_num(0.0) : value(x, i);
    *series(x, i->d) = u;
    if (i->e != i->d) *series(x, i->e) = companion(i->op, a, coefficient(x, i->b, 0), u);
    if (i->reciprocal != i->d) *series(x, i->reciprocal) = 1.0 / divisor(x, i);
}

/* ---- order k ---- */

/* Sine and cosine; the second changes sign where it is not hyperbolic. */
static void rotate(const expansion *x, const dal__taylor_operation *i, uint32_t sine,
                   uint32_t cosine, double sign)
{
    const int of_sine = sine == i->d ? 0 : 1, k = x->k;
    num u, w;
    if (i->turns) {
        u = x->inverse * coefficient(x, i->b, k - 1);
        w = x->inverse * coefficient(x, i->c, k - 1);
    } else {
        u = integral(x, i, 1 - of_sine, i->a, cosine);
        w = integral(x, i, of_sine, i->a, sine);
    }
    series(x, cosine)[k] = sign * w;
    series(x, sine)[k] = u;
}

/* Coefficient k of u where u' w = g', whose inner sum is the first. */
static num quotient(const expansion *x, const dal__taylor_operation *i, num g)
{
    return (g - x->inverse * inner(x, i, 0)) * *series(x, i->reciprocal);
}

/* Results with a second series. */
static void next_pair(const expansion *x, const dal__taylor_operation *i)
{
    const int k = x->k;
    const num a = coefficient(x, i->a, k);
    num *const u = series(x, i->d) + k, *const w = series(x, i->e) + k;
    switch (i->op) {
    case DAL__SIN:
    case DAL__SINCOS:
        rotate(x, i, i->d, i->e, -1.0);
        return;
    case DAL__COS:
        rotate(x, i, i->e, i->d, -1.0);
        return;
    case DAL__SINH:
        rotate(x, i, i->d, i->e, 1.0);
        return;
    case DAL__COSH:
        rotate(x, i, i->e, i->d, 1.0);
        return;
    case DAL__TAN:
        *u = a + integral(x, i, 0, i->a, i->e);
        *w = product(x, i, 1, i->d, i->d);
        return;
    case DAL__TANH:
        *u = a - integral(x, i, 0, i->a, i->e);
        *w = product(x, i, 1, i->d, i->d);
        return;
    case DAL__ATAN2:
        *u = quotient(x, i, integral(x, i, 3, i->a, i->b) - integral(x, i, 4, i->b, i->a));
        *w = product(x, i, 1, i->a, i->a) + product(x, i, 2, i->b, i->b);
        return;
    case DAL__ATAN:
        *u = quotient(x, i, a);
        *w = product(x, i, 1, i->a, i->a);
        return;
    default: /* asin, acos, asinh */
        *u = quotient(x, i, i->op == DAL__ACOS ? -a : a);
        *w = integral(x, i, 1, i->d, i->a);
        if (i->op == DAL__ASIN) *w = -*w;
    }
}

/* a b + c, a b - c or c - a b. */
static num fused(const expansion *x, const dal__taylor_operation *i)
{
    const num ab = product(x, i, 0, i->a, i->b), c = coefficient(x, i->c, x->k);
    if (i->op == DAL__SUB_MUL) return c - ab;
    return i->op == DAL__MUL_ADD ? ab + c : ab - c;
}

/* a^r, with inner sums of j a_j u_(k-j) and of j u_j a_(k-j). */
static num power(const expansion *x, const dal__taylor_operation *i, num a_k)
{
    const num r = coefficient(x, i->b, 0), u_0 = coefficient(x, i->d, 0);
    const num own = dal_fma((double)x->k * a_k, u_0, inner(x, i, 0));
    return (r * own - inner(x, i, 1)) * x->inverse * *series(x, i->reciprocal);
}

static num next_coefficient(const expansion *x, const dal__taylor_operation *i)
{
    const num a = coefficient(x, i->a, x->k), b = coefficient(x, i->b, x->k);
    const num reciprocal = *series(x, i->reciprocal);
    switch (i->op) {
    case DAL__ADD:
        return a + b;
    case DAL__SUB:
        return a - b;
    case DAL__NEG:
        return -a;
    case DAL__SLOPE:
        return (double)x->k * a;
    case DAL__MUL:
        return product(x, i, 0, i->a, i->b);
    case DAL__MUL_ADD:
    case DAL__MUL_SUB:
    case DAL__SUB_MUL:
        return fused(x, i);
    case DAL__DIV:
        if (i->b & DAL__TAYLOR_CONSTANT) return a * reciprocal;
        return (a - dal_fma(b, coefficient(x, i->d, 0), inner(x, i, 0))) * reciprocal;
    case DAL__SQRT:
        return (a - inner(x, i, 0)) * reciprocal;
    case DAL__HYPOT:
        return (product(x, i, 1, i->a, i->a) + product(x, i, 2, i->b, i->b) - inner(x, i, 0)) *
               reciprocal;
    case DAL__EXP:
        return integral(x, i, 0, i->a, i->d);
    case DAL__POW_MOVING:
        return integral(x, i, 0, i->c, i->d);
    case DAL__POW:
        return power(x, i, a);
    case DAL__LOG:
        if (i->a & DAL__TAYLOR_CONSTANT) return dal_num(0.0);
        return quotient(x, i, a);
    case DAL__IF: /* whose condition is constant */
        return dal_if(coefficient(x, i->a, 0), b, coefficient(x, i->c, x->k));
    default: /* refused */
        return dal_num(NAN);
    }
}

void DAL_WIDE(dal__taylor_run)(const dal__taylor *taylor, int k, int stride, const double *in,
                               const double *work, double *memory)
{
    const num inverse = dal_inverse(k + (k == 0)); /* order 0 does not use it */
    const expansion x = {taylor, (const num *)work, (num *)memory, k, stride, inverse};
    for (int i = 0; i < taylor->inputs; i++) series(&x, (uint32_t)i)[k] = ((const num *)in)[i];
    for (int n = 0; n < taylor->length; n++) {
        const dal__taylor_operation *i = &taylor->code[n];
        if (k == 0)
            begin(&x, i);
        else if (i->once)
            continue;
        else if (i->e != i->d)
            next_pair(&x, i);
        else
            series(&x, i->d)[k] = next_coefficient(&x, i);
    }
}

void DAL_WIDE(dal__taylor_read)(const dal__taylor *taylor, int first, int count, int k, int stride,
                                const double *work, const double *memory, double *out)
{
    const expansion x = {taylor, (const num *)work, (num *)memory, k, stride, dal_num(0.0)};
    for (int i = 0; i < count; i++) ((num *)out)[i] = coefficient(&x, taylor->output[first + i], k);
}
