/* taylor.h - the Taylor polynomial of the motion at the present state.
 *
 *     x(t + tau s) = x_0 + x_1 s + .. + x_p s^p,     x_(k+1) = tau f_k/(k+1)
 *
 * with f_k coefficient k of the field along the motion, from x_0 .. x_k: dal_step.series has the
 * recurrences of F, the canonical variables follow here.  The unit of time tau, a power of two,
 * changes no digit; without it x_p would leave the range of numbers where the motion is slow or
 * fast.  With w = 1/e, as series:
 *
 *     q' = v   v' = F + pi w   e' = mu_e   p' = -F_q^T pi   pi' = -p - F_v^T pi
 *     pi_e' = (pi pi)(w w)/2,   w_k = -w_0 sum_(j=1..k) e_j w_(k-j)
 *
 * or with K pi w for pi w and the like, where there is an effort K; the momenta less pi_e times the
 * derivatives of mu_e, where it is not of t alone.
 *
 * Order for a tolerance: the error of a step of size h is about (h/R)^p where R is the radius of
 * convergence, the work about p^2 for a length h; it is least for h = R/e^2 and
 * p = 1 - log(tolerance)/2 (Jorba and Zou 2005).  The work is measured to be nearer to p than to
 * p^2, and some of it is the cost of a step of any order, which favours FURTHER orders: three,
 * since the series of lanes leave the fastest cache with more. */
#ifndef DAL_KERNEL_TAYLOR_H
#define DAL_KERNEL_TAYLOR_H

#include "series.h"
#include "step.h"

#ifndef DAL_SPECIALISED
enum { DAL__TAYLOR_FURTHER = 3, DAL__TAYLOR_MAX_ORDER = 40, DAL__TAYLOR_FIXED_ORDER = 10 };

/* The order for a tolerance; for 0, the order of steps of a fixed size. */
DAL_INLINE int dal_taylor_order(double tolerance)
{
    if (tolerance == 0.0) return DAL__TAYLOR_FIXED_ORDER;
    const double order = ceil(1.0 - 0.5 * log(tolerance)) + DAL__TAYLOR_FURTHER;
    return order < DAL__TAYLOR_MAX_ORDER ? (int)order : DAL__TAYLOR_MAX_ORDER;
}

#endif

/* What an expansion needs besides x. */
typedef struct dal_expansion {
    num *memory;          /* [DAL_SERIES][order + 1] series of the system */
    num *w, *ww, *square; /* [order + 1] coefficients of w = 1/e, w^2 and pi.K pi */
    num *effort;          /* [3n][order + 1] of K pi, (pi.K pi)_q/2, (pi.K pi)_v/2 */
    num *gradient;        /* [2n + 1][order + 1] of the derivatives of mu_e by q, v, e */
} dal_expansion;

/* Declares an expansion `name` in the scratch of a step. */
#define DAL_EXPANSION(s, name)                                                                     \
    DAL_VECTOR(s, memory, DAL_SERIES(s) * (DAL_TAYLOR_ORDER(s) + 1));                              \
    DAL_VECTOR(s, gauge, 3 * (DAL_TAYLOR_ORDER(s) + 1));                                           \
    DAL_VECTOR(s, effort, 3 * DAL_EFFORT(s) * DAL_N(s) * (DAL_TAYLOR_ORDER(s) + 1));               \
    DAL_VECTOR(s, gradient, DAL_GAUGE(s) * (2 * DAL_N(s) + 1) * (DAL_TAYLOR_ORDER(s) + 1));        \
    const dal_expansion name = {                                                                   \
        memory, gauge,   gauge + DAL_TAYLOR_ORDER(s) + 1, gauge + 2 * (DAL_TAYLOR_ORDER(s) + 1),   \
        effort, gradient}

#if DAL_WITH(LIFT)
/* sum a_j b_(k-j) over j = first..k; coefficients of a, of b, are `a_stride`, `b_stride` apart. */
DAL_INLINE num dal__convolve(const num *a, int a_stride, const num *b, int b_stride, int first,
                             int k)
{
    num sum = dal_num(0.0);
    for (int j = first; j <= k; j++) sum = dal_fma(a[j * a_stride], b[(k - j) * b_stride], sum);
    return sum;
}

/* Adds the part of pi.K pi/(2e); effort: coefficient k of the callback's outputs. */
DAL_INLINE void dal__effort_series(const dal_step *s, int k, const num *x, const num *effort,
                                   const dal_expansion *g, num *dx)
{
    const int n = DAL_N(s), dim = DAL_DIM(s), order = DAL_TAYLOR_ORDER(s);
    const num *pi = x + dal_at_pi(s);
    DAL_EACH(i, 3 * n) g->effort[i * (order + 1) + k] = effort[i];
    DAL_EACH(i, n) {
        const num *push = g->effort + i * (order + 1), *by_q = push + n * (order + 1);
        const num *by_v = by_q + n * (order + 1);
        g->square[k] += dal__convolve(pi + i, dim, push, 1, 0, k);
        dx[n + i] += dal__convolve(push, 1, g->w, 1, 0, k);
        dx[dal_at_p(s) + i] -= dal__convolve(by_q, 1, g->w, 1, 0, k);
        dx[dal_at_pi(s) + i] -= dal__convolve(by_v, 1, g->w, 1, 0, k);
    }
}

#if DAL_WITH(GAUGE_GRADIENT)
/* Adds the part of mu_e; gradient: coefficient k of its derivatives. */
DAL_INLINE void dal__gauge_series(const dal_step *s, int k, const num *x, const num *gradient,
                                  const dal_expansion *g, num *dx)
{
    const int order = DAL_TAYLOR_ORDER(s);
    DAL_EACH(i, 2 * DAL_N(s) + 1) {
        num *const series = g->gradient + i * (order + 1);
        series[k] = gradient[i];
        dx[dal_at_p(s) + i] -= dal__convolve(x + dal_at_pi_e(s), DAL_DIM(s), series, 1, 0, k);
    }
}
#endif

/* Coefficient k of the canonical variables' field, from x_0 .. x_k; f holds the one of F,
 * F_q^T pi, F_v^T pi, mu_e, of the derivatives of mu_e, and of the callback effort. */
DAL_INLINE void dal__lifted_series(const dal_step *s, int k, const num *x, const num *f,
                                   const dal_expansion *g, num *dx)
{
    const int n = DAL_N(s), dim = DAL_DIM(s), p = dal_at_p(s);
    const num *e = x + dal_at_e(s), *pi = x + dal_at_pi(s);
    g->w[k] = k == 0 ? 1.0 / e[0] : -g->w[0] * dal__convolve(e, dim, g->w, 1, 1, k);
    g->ww[k] = dal__convolve(g->w, 1, g->w, 1, 0, k);
    g->square[k] = dal_num(0.0);
    DAL_EACH(i, n) {
        if (DAL_EFFORT(s)) {
            dx[n + i] = f[i];
        } else {
            g->square[k] += dal__convolve(pi + i, dim, pi + i, dim, 0, k);
            dx[n + i] = f[i] + dal__convolve(pi + i, dim, g->w, 1, 0, k);
        }
        dx[p + i] = -f[n + i];
        dx[dal_at_pi(s) + i] = -x[k * dim + p + i] - f[2 * n + i];
    }
    const num *gradient = f + 3 * n + 1, *effort = gradient + DAL_GAUGE(s) * (2 * n + 1);
    if (DAL_EFFORT(s)) dal__effort_series(s, k, x, effort, g, dx);
    dx[dal_at_e(s)] = f[3 * n];
    dx[dal_at_pi_e(s)] = 0.5 * dal__convolve(g->square, 1, g->ww, 1, 0, k);
#if DAL_WITH(GAUGE_GRADIENT)
    if (DAL_GAUGE(s)) dal__gauge_series(s, k, x, gradient, g, dx);
#endif
}
#endif

/* Below this tolerance the rounding of 1/k counts: it is the same in all steps, and moved the
 * amplitude of an oscillator by 1e-16 in each step of 2.  The rest of 1/k is added then. */
#ifdef DAL_NUM_QUAD
#define DAL__IS_FINE_SERIES(s) 0
#elif DAL_WITH(CONTROL)
#define DAL__FINE_SERIES       1e-14
#define DAL__IS_FINE_SERIES(s) (DAL_CONTROLLED(s) && DAL_TOLERANCE(s) < DAL__FINE_SERIES)
#else
#define DAL__IS_FINE_SERIES(s) 0
#endif

/* tau/k, and what its rounding took from it. */
typedef struct dal__reciprocal {
    num rounded, rest;
} dal__reciprocal;

DAL_INLINE dal__reciprocal dal__reciprocal_of(const dal_step *s, int k)
{
    const double unit = DAL_UNIT_OF_TIME(s);
    dal__reciprocal inverse = {unit * dal_inverse(k), dal_num(0.0)};
    if (DAL__IS_FINE_SERIES(s)) inverse.rest = dal_num(unit * __builtin_fma(-1.0 / k, k, 1.0) / k);
    return inverse;
}

/* tau x/k */
DAL_INLINE num dal__divide(const dal_step *s, num x, const dal__reciprocal *k)
{
    (void)s;
    if (DAL__IS_FINE_SERIES(s)) return dal_fma(x, k->rounded, x * k->rest);
    return k->rounded * x;
}

/* Coefficient k + 1 of the motion from those before, x[(order + 1)*dim], coefficient k from number
 * k*dim on, and coefficient k of t. */
DAL_INLINE void dal__expand_order(dal_step *s, num t, int k, num *x, const dal_expansion *e)
{
    const int n = DAL_N(s), nw = DAL_NW(s), dim = DAL_DIM(s);
    const dal__reciprocal inverse = dal__reciprocal_of(s, k + 1);
    const num *now = x + k * dim;
    num *next = x + (k + 1) * dim;
    DAL__MARK(s);
    DAL_VECTOR(s, in, 1 + 2 * DAL_N(s) + DAL_NW(s) + DAL_GAUGE(s));
    DAL_VECTOR(s, f, 3 * (1 + DAL_EFFORT(s)) * DAL_N(s) + 1 + DAL_GAUGE(s) * (2 * DAL_N(s) + 1));
    in[0] = t;
    DAL_EACH(i, n + nw) in[1 + i] = now[i];
    if (DAL_LIFTED(s))
        DAL_EACH(i, n) in[1 + n + nw + i] = now[dal_at_pi(s) + i];
    if (DAL_GAUGE(s)) in[1 + 3 * n] = now[dal_at_e(s)];
    dal_eval_series(s, k, DAL_TAYLOR_ORDER(s) + 1, in, e->memory, f);
    DAL_EACH(i, n) next[i] = dal__divide(s, now[n + i], &inverse);
    if (!DAL_LIFTED(s))
        DAL_EACH(i, nw) next[n + i] = dal__divide(s, f[i], &inverse);
#if DAL_WITH(LIFT)
    if (DAL_LIFTED(s)) {
        dal__lifted_series(s, k, x, f, e, next);
        DAL_EACH(i, dim - n) next[n + i] = dal__divide(s, next[n + i], &inverse);
    }
#endif
    DAL__RELEASE(s);
}

/* Coefficient 1 of the motion from x, its state at t. */
DAL_INLINE void dal_expand_first(dal_step *s, dal_times t, num *x, const dal_expansion *e)
{
    s->evaluations++;
    dal__expand_order(s, t, 0, x, e);
}

/* Coefficients 2 .. order.  The body of a compiled step is too large for compilers to do well with
 * the body of this loop in it, too; nothing but x and the series is written here. */
DAL_NOINLINE void dal__expand_orders(dal_step *s, num *DAL_RESTRICT x, const dal_expansion *e)
{
    for (int k = 1; k < DAL_TAYLOR_ORDER(s); k++)
        dal__expand_order(s, dal_num(k == 1 ? DAL_UNIT_OF_TIME(s) : 0.0), k, x, e);
}

/* The same, after dal_expand_first. */
DAL_INLINE void dal_expand_rest(dal_step *s, num *x, const dal_expansion *e)
{
    s->evaluations += DAL_TAYLOR_ORDER(s) - 1;
    dal__expand_orders(s, x, e);
}

/* By Horner's rule, with s = h/tau: rate = sum_(k=1..order) x_k s^(k-1)/tau, the mean rate of
 * change over h, and the derivative by s at its end, sum k x_k s^(k-1).  x, rate[dim] and
 * derivative[dim] must have DAL__PACK more numbers, since whole registers are read and written. */
DAL_INLINE void dal_evaluate_polynomial(const dal_step *s, dal_times h, const num *x,
                                        num *DAL_RESTRICT rate, num *DAL_RESTRICT derivative)
{
    const int dim = DAL_DIM(s);
    const double per_unit = 1.0 / DAL_UNIT_OF_TIME(s);
    const dal__terms zero = {0}, size = per_unit * (num)h - zero;
    for (int i = 0; i < dim; i += DAL__TERMS) {
        dal__terms sum = zero, slope = zero;
        for (int k = DAL_TAYLOR_ORDER(s); k > 0; k--) {
            slope = DAL__FUSE_TERMS(size, slope, sum);
            sum = DAL__FUSE_TERMS(size, sum, *(const dal__terms *)(x + k * dim + i));
        }
        *(dal__terms *)(rate + i) = per_unit * sum;
        *(dal__terms *)(derivative + i) = DAL__FUSE_TERMS(size, slope, sum);
    }
}

#endif
