/* taylor.c - the Taylor-series method, of any order up to 40.
 *
 *     y1 = y + h (x_1 + h (x_2 + .. + h x_p)),     x_k = (d/dt)^k y / k!
 *
 * Jorba, Zou, Experimental Mathematics 14 (2005) 99.  The coefficients come from recurrences over
 * the formulas of the model (lib/expr/recurrences.h), exact except rounding.  Of order 10 with
 * steps of a fixed size, explicit; preserves D with constant coefficients, no other.
 *
 * With a tolerance each substep has the order for it (lib/kernel/taylor.h) and the size at which
 * its last coefficients leave the polynomial with that error, relative to max(1, |x|):
 *
 *     h = tau tolerance^(1/p) min (max(1, |x|)/|x_m|)^(1/m),   m = p-3 .. p,
 *
 * in the units of x and t that the system has, x_m in t/tau: four of them, since odd or even
 * motions lack every other one, and some motions more.  Last coefficients may vanish all the same,
 * as they do for x'' = t^50 at t = 0; so the polynomial must satisfy the equations at the end of
 * the substep, else h is halved. */
#include <dalembert_kernel.h>

#if DAL_WITH(CONTROL)
enum { ESTIMATES = 4 };

/* The defect |f(y1) - x'(h)| h of a polynomial with an error of the tolerance is some p times that;
 * rounding alone leaves some units in the last place, more where F cancels. */
#define DEFECT_OF_TOLERANCE 1e3
#define DEFECT_OF_ROUNDING  (2e-12 * DAL_ULP_RATIO)

/* The bits of |x| as an integer, which are ordered as the numbers are; NaN comes last. */
DAL_INLINE dal_mask bits_of(num x)
{
    const dal_times size = (dal_times)x;
    dal_mask bits;
    memcpy(&bits, &size, sizeof bits);
    return bits & INT64_MAX;
}

DAL_INLINE dal_mask larger(dal_mask a, dal_mask b)
{
    const dal_mask less = DAL__COMPARE(a, <, b);
    return (a & ~less) | (b & less);
}

/* The number with these bits. */
DAL_INLINE dal_times of_bits(dal_mask bits)
{
    dal_times x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* log2 of the number with these bits, 1 + f times a power of 2, within 0.01. */
DAL_INLINE dal_times logarithm(dal_mask bits)
{
    const int64_t one = (int64_t)1023 << 52, fraction = ((int64_t)1 << 52) - 1;
    const dal_times f = of_bits((bits & fraction) | one) - 1.0;
    const dal_times shifted = of_bits((bits >> 52) | (int64_t)0x433 << 52);
    return shifted - (0x1p52 + 1023.0) + f * (1.344 - 0.344 * f);
}

/* 2^x, to 1 part in 1000, for |x| < 1000: the integer next to x becomes an exponent. */
DAL_INLINE dal_times power_of_2(dal_times x)
{
    const dal_times shifted = x + (0x1.8p52 + 1023.0), f = x - (shifted - (0x1.8p52 + 1023.0));
    dal_mask exponent;
    memcpy(&exponent, &shifted, sizeof exponent);
    return of_bits((exponent & 0x7ff) << 52) * (1.0 + f * (0.6931 + f * (0.2402 + f * 0.0555)));
}

/* The units of components from first on; p and pi have none. */
DAL_INLINE const double *units_from(const dal_step *s, int first)
{
    return first == 0 ? DAL_UNITS(s) : NULL;
}

/* Bits of max |x_i|/unit_i over count components; NULL: 1. */
DAL_INLINE dal_mask max_bits(const num *x, const double *unit, int count)
{
    dal_mask bits = dal_all() & 0;
    DAL_EACH(i, count) bits = larger(bits, bits_of(dal_in_units(x[i], unit, i)));
    return bits;
}

/* h/(tau tolerance^(1/p)) for count components from first on, 0 where a coefficient is not
 * finite. */
DAL_INLINE num radius(const dal_step *s, const num *x, int first, int count)
{
    const double *units = units_from(s, first);
    const int order = DAL_TAYLOR_ORDER(s);
    const dal_mask unit = larger(bits_of(dal_num(1.0)), max_bits(x + first, units, count));
    const dal_times log_unit = logarithm(unit);
    dal_mask largest = unit;
    num log_size = dal_num(900.0); /* in the range of power_of_2 */
    for (int m = order - ESTIMATES + 1; m <= order; m++) {
        const dal_mask last = max_bits(x + m * DAL_DIM(s) + first, units, count);
        log_size = dal_min(log_size, (num)((log_unit - logarithm(last)) * (1.0 / m)));
        largest = larger(largest, last);
    }
    const dal_mask finite = DAL__COMPARE(largest, <, bits_of(dal_num(INFINITY)));
    return dal_select(finite, (num)power_of_2((dal_times)log_size), dal_num(0.0));
}

/* The size of the next substep.  The error of (q,v) and of (p,pi) is controlled, each by itself,
 * and none of e and pi_e, so that the substeps of (q,v) on the surface know neither the space nor
 * the gauge. */
DAL_INLINE num next_size(const dal_step *s, const num *x)
{
    num size = radius(s, x, 0, DAL_N(s) + DAL_NW(s));
    if (DAL_LIFTED(s)) size = dal_min(size, radius(s, x, dal_at_p(s), 2 * DAL_N(s)));
    return DAL_UNIT_OF_TIME(s) * (DAL_TOLERANCE_ROOT(s) * size);
}

/* Lanes where the defect of some components is small after a substep h tau to `end`, where the
 * derivative by t/tau is `field`, and by the polynomial `rate`. */
DAL_INLINE dal_mask satisfies(const dal_step *s, num h, const num *end, const num *field,
                              const num *rate, int first, int count)
{
    const double *units = units_from(s, first);
    num defect = dal_num(0.0), size = dal_num(1.0), nonfinite = dal_num(0.0);
    DAL_EACH(k, count) {
        const int i = first + k;
        const num of_i = dal_abs(h * (field[i] - rate[i])), moved = dal_abs(h * field[i]);
        nonfinite += of_i - of_i;
        defect = dal_max(defect, dal_in_units(of_i, units, k));
        size = dal_max(size, dal_in_units(dal_max(dal_abs(end[i]), moved), units, k));
    }
    const double allowed = DEFECT_OF_TOLERANCE * DAL_TOLERANCE(s) + DEFECT_OF_ROUNDING;
    return dal_finite(nonfinite) & dal_less_equal(defect, allowed * size);
}

/* Lanes where the polynomial satisfies the equations at its end; z[2][dim]: the state there and its
 * derivative by t/tau from the equations, derivative[dim]: the same from the polynomial. */
DAL_INLINE dal_mask is_accepted(const dal_step *s, dal_times h, const num *z, const num *derivative)
{
    const num *field = z + DAL_DIM(s), size = h / DAL_UNIT_OF_TIME(s);
    dal_mask good = satisfies(s, size, z, field, derivative, 0, DAL_N(s) + DAL_NW(s));
    if (DAL_LIFTED(s)) good &= satisfies(s, size, z, field, derivative, dal_at_p(s), 2 * DAL_N(s));
    return good;
}

#ifndef DAL_SPECIALISED
/* Stores the polynomial of a trial for dense output. */
DAL_INLINE void store_series(const dal_step *s, num h, const num *x)
{
    const int dim = DAL_DIM(s);
    const num size = h / DAL_UNIT_OF_TIME(s);
    num power = dal_num(1.0 / DAL_UNIT_OF_TIME(s));
    s->dense->terms = DAL_TAYLOR_ORDER(s);
    for (int k = 0; k < s->dense->terms; k++, power *= size)
        DAL_EACH(i, dim) s->dense->rate[k * dim + i] = power * x[(k + 1) * dim + i];
}
#endif

/* Steps by s->h in substeps; a trial that is not accepted is halved.  The coefficients of order 0
 * at the end of a trial that all lanes accept begin the next expansion: they are formed in one
 * place, so that compilers have the body for them once. */
DAL_INLINE dal_status divided(dal_step *s, num *x, num *rate, const dal_expansion *e)
{
    const int dim = DAL_DIM(s);
    const num halves = dal_num(2.0 * DAL__SAFE), keeps = dal_num(1.0);
    DAL_VECTOR(s, derivative, DAL_DIM(s) + DAL__PACK);
    DAL_VECTOR(s, z, 2 * DAL_DIM(s));
    dal_control c = dal_control_begin(s);
    bool is_trial = false; /* whether z is the end of a trial: else the state */
    dal_times rest = c.rest;
    DAL_EACH(i, dim) z[i] = s->y[i];
    for (;;) {
        const dal_times t = c.start + c.direction * (c.whole - rest);
        dal_expand_first(s, t, z, e);
        if (is_trial) {
            const dal_mask good = is_accepted(s, c.h, z, derivative);
            const int differ = dal_any(c.active & ~good);
#ifndef DAL_SPECIALISED
            if (DAL_RARELY(s->dense != NULL)) store_series(s, c.h, x);
#endif
            dal_control_end(s, &c, (dal_times)dal_select(good, keeps, halves), rate);
            if (differ && dal_any(c.active & ~c.again)) {
                DAL_EACH(i, dim) z[i] = s->y[i];
                rest = c.rest;
                is_trial = false;
                continue;
            }
        }
        if (dal_any(c.active & ~c.again)) {
            const num whole = dal_num(c.whole);
            DAL_EACH(i, dim) x[i] = s->y[i];
            DAL_EACH(i, dim) x[dim + i] = z[dim + i];
            dal_expand_rest(s, x, e);
            const num size = next_size(s, x);
            const num planned = dal_select(dal_less(size, whole), size, whole);
            c.planned = (dal_times)dal_select(c.again, c.planned, planned);
        }
        if (!dal_control_next(s, &c)) return dal_control_status(s, &c);
        rest = c.rest - c.direction * c.h;
        dal_evaluate_polynomial(s, c.h, x, rate, derivative);
        DAL_EACH(i, dim) z[i] = s->y[i] + dal_fma(c.h, rate[i], s->r[i]);
        is_trial = true;
    }
}
#endif

DAL_INLINE dal_status step(dal_step *s)
{
    const num t = dal_num(s->t), h = dal_num(s->h);
    DAL_VECTOR(s, x, (DAL_TAYLOR_ORDER(s) + 1) * DAL_DIM(s) + DAL__PACK);
    DAL_VECTOR(s, rate, 2 * (DAL_DIM(s) + DAL__PACK));
    DAL_EXPANSION(s, e);
#if DAL_WITH(CONTROL)
    if (DAL_CONTROLLED(s)) return divided(s, x, rate, &e);
#endif
    DAL_EACH(i, DAL_DIM(s)) x[i] = s->y[i];
    dal_expand_first(s, (dal_times)t, x, &e);
    dal_expand_rest(s, x, &e);
    dal_evaluate_polynomial(s, (dal_times)h, x, rate, rate + DAL_DIM(s) + DAL__PACK);
    return dal_update_multiple(s, s->h, s->h, rate);
}

#define ABOUT_TAYLOR                                                                               \
    "The Taylor polynomial of the motion, whose coefficients follow from recurrences over the "    \
    "formulas of the system, exact except rounding:\n"                                             \
    "$$y_1 = \\sum_{k=0}^{p} x_k\\,h^k, \\qquad x_k = \\frac{1}{k!}\\,\\frac{d^k "                 \
    "y}{dt^k}(t_0).$$\n"                                                                           \
    "With steps of a fixed size the order is $p = 10$; with `--tolerance` order and size of "      \
    "each substep follow from the last coefficients (Jorba, Zou 2005). No structure is "           \
    "preserved beyond linear $D$ with constant coefficients, and none is needed where the error"   \
    " of a step is below rounding."

DAL_INTEGRATOR(taylor, step, .name = "taylor", .summary = "Taylor series of the motion",
               .reference = "Jorba, Zou 2005", .documentation = ABOUT_TAYLOR,
               .order = DAL__TAYLOR_FIXED_ORDER, .stages = 2,
               .properties = DAL_EXPLICIT | DAL_ADAPTIVE,
               .needs = DAL_NEEDS_FIELD | DAL_NEEDS_SERIES,
               .kernel = DAL_KERNEL_CONTROL | DAL_KERNEL_SERIES);
