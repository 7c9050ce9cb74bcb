/* taylor_wide.c - runs a series program, over num. */
#include "expr/arithmetic.h"
#include "expr/operations.h"
#include "expr/taylor.h"
#include "kernel/series.h"

/* An order that is computed. */
typedef struct expansion {
    const dal__taylor *taylor;
    const num *work;
    num *memory;
    int k, stride;
    num inverse, unit_inverse; /* 1/k, tau/k */
} expansion;

static inline num *series(const expansion *x, uint32_t slot)
{
    return x->memory + (size_t)slot * (size_t)x->stride;
}

/* Coefficient j of an operand. */
static inline num coefficient(const expansion *x, uint32_t a, int j)
{
    if (!dal__is_constant(a)) return series(x, a)[j];
    return j == 0 ? x->work[a & ~DAL__TAYLOR_CONSTANT] : dal_num(0.0);
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
    case DAL__SLOPE:
        return dal_num(0.0);
    default:
        return dal_num(NAN);
    }
}

/* The second series of a recurrence, and the reciprocal of what it divides by. */
static void begin(const expansion *x, const dal__taylor_operation *i)
{
    const num a_0 = coefficient(x, i->a, 0), b_0 = coefficient(x, i->b, 0), u_0 = *series(x, i->u);
    const num c_0 = coefficient(x, i->c, 0);
    num *const w = series(x, i->w), *const reciprocal = series(x, i->reciprocal);
    (void)b_0, (void)c_0;
    switch (i->recurrence) {
#define PLAIN(code, sums, u_k)
#define QUOTIENT(code, sums, divisor, u_k)                                                         \
    case DAL__##code:                                                                              \
        *reciprocal = 1.0 / divisor;                                                               \
        break;
#define PAIR(code, sums, second, u_k, w_k)                                                         \
    case DAL__##code:                                                                              \
        *w = second;                                                                               \
        break;
#define PAIR_QUOTIENT(code, sums, second, u_k, w_k)                                                \
    case DAL__##code:                                                                              \
        *w = second;                                                                               \
        *reciprocal = 1.0 / *w;                                                                    \
        break;
        DAL__RECURRENCE_LIST(PLAIN, QUOTIENT, PAIR, PAIR_QUOTIENT)
#undef PLAIN
#undef QUOTIENT
#undef PAIR
#undef PAIR_QUOTIENT
    }
}

static void compute_first(const expansion *x, const dal__taylor_operation *i)
{
    if (i->op == DAL__SINCOS) {
        dal_sincos(coefficient(x, i->a, 0), series(x, i->u), series(x, i->w));
        return;
    }
    *series(x, i->u) = value(x, i);
    begin(x, i);
}

/* ---- order k ---- */

static num inner_sum(const expansion *x, uint32_t number)
{
    const dal__taylor_sum *sum = &x->taylor->sum[number];
    return sum->a == sum->b ? dal_sum_squares(series(x, sum->a), x->k)
                            : dal_sum_products(series(x, sum->a), series(x, sum->b), x->k);
}

static num convolve(const expansion *x, dal__convolution form, uint32_t first, uint32_t second,
                    uint32_t number)
{
    const num a = coefficient(x, first, x->k), b = coefficient(x, second, x->k);
    const num a_0 = coefficient(x, first, 0), b_0 = coefficient(x, second, 0);
    const num inverse = x->inverse;
    const int k = x->k;
    switch (form) {
#define SUM inner_sum(x, number)
#define FORM(name, expression)                                                                     \
    case DAL__##name:                                                                              \
        return expression;
        DAL__CONVOLUTION_LIST(FORM)
#undef FORM
#undef SUM
    }
    return dal_num(NAN);
}

#define INNER(j)          inner_sum(x, i->sum[j])
#define PRODUCT(p, q, j)  convolve(x, dal__product_form(i->p, i->q), i->p, i->q, i->sum[j])
#define INTEGRAL(p, q, j) convolve(x, dal__integral_form(i->p, i->q), i->p, i->q, i->sum[j])

/* What the formulas of recurrences name; each uses a few. */
#define COEFFICIENTS                                                                               \
    const num a = coefficient(x, i->a, k), b = coefficient(x, i->b, k);                            \
    const num c = coefficient(x, i->c, k), a_0 = coefficient(x, i->a, 0);                          \
    const num b_0 = coefficient(x, i->b, 0), u_0 = *series(x, i->u);                               \
    const num c_0 = coefficient(x, i->c, 0);                                                       \
    const num b_before = coefficient(x, i->b, k - 1), c_before = coefficient(x, i->c, k - 1);      \
    const num reciprocal = *series(x, i->reciprocal), inverse = x->inverse;                        \
    const num unit_inverse = x->unit_inverse;                                                      \
    (void)a, (void)b, (void)c, (void)a_0, (void)b_0, (void)c_0, (void)u_0, (void)b_before;         \
    (void)c_before, (void)reciprocal, (void)inverse, (void)unit_inverse

static void compute_next(const expansion *x, const dal__taylor_operation *i)
{
    const int k = x->k;
    switch (i->recurrence) {
#define PLAIN(code, sums, u_k)                                                                     \
    case DAL__##code: {                                                                            \
        COEFFICIENTS;                                                                              \
        series(x, i->u)[k] = u_k;                                                                  \
    } break;
#define QUOTIENT(code, sums, divisor, u_k) PLAIN(code, sums, u_k)
#define PAIR(code, sums, second, u_k, w_k)                                                         \
    case DAL__##code: {                                                                            \
        COEFFICIENTS;                                                                              \
        series(x, i->u)[k] = u_k;                                                                  \
        series(x, i->w)[k] = w_k;                                                                  \
    } break;
        DAL__RECURRENCE_LIST(PLAIN, QUOTIENT, PAIR, PAIR)
#undef PLAIN
#undef QUOTIENT
#undef PAIR
    default: /* refused */
        series(x, i->u)[k] = dal_num(NAN);
    }
}

void DAL_WIDE(dal__taylor_run)(const dal__taylor *taylor, double unit, int k, int stride,
                               const double *in, const double *work, double *memory)
{
    const num inverse = dal_inverse(k + (k == 0)); /* order 0 does not use it */
    const expansion x = {taylor, (const num *)work, (num *)memory, k,
                         stride, inverse,           unit * inverse};
    for (int i = 0; i < taylor->inputs; i++) series(&x, (uint32_t)i)[k] = ((const num *)in)[i];
    for (int n = 0; n < taylor->length; n++) {
        const dal__taylor_operation *i = &taylor->code[n];
        if (k == 0)
            compute_first(&x, i);
        else if (!i->once)
            compute_next(&x, i);
    }
}

void DAL_WIDE(dal__taylor_read)(const dal__taylor *taylor, int first, int count, int k, int stride,
                                const double *work, const double *memory, double *out)
{
    const expansion x = {.taylor = taylor,
                         .work = (const num *)work,
                         .memory = (num *)memory,
                         .k = k,
                         .stride = stride};
    for (int i = 0; i < count; i++) ((num *)out)[i] = coefficient(&x, taylor->output[first + i], k);
}
