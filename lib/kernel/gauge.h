/* gauge.h - e and pi_e in the stages of an implicit method where mu_e is not of t alone.
 *
 *     mu_i = mu_e(Q_i, V_i, E_i, t_i)                     E_i = e + h sum a_ij mu_j
 *     R_i = Pi_i.K Pi_i/(2 E_i^2) - Y_i mu_e,e|_i         Y_i = pi_e + h sum p_ij R_j
 *
 * for given Q, V, Pi, with the coefficients p of the partner (tableau.h): (e, pi_e) is a canonical
 * pair, so a symplectic method stays symplectic.  Newton's method solves for mu, in each lane until
 * an increment is small; the equations for R are linear.  Both are solved for every iterate of the
 * stages of (q, v), whose iteration then does not depend on the gauge.  To the derivatives of H by
 * q and v mu_e pi_e adds Y times the derivatives of mu_e. */
#ifndef DAL_KERNEL_GAUGE_H
#define DAL_KERNEL_GAUGE_H

#include "algebra.h"
#include "step.h"
#include "tableau.h"

#if DAL_WITH(GAUGE_GRADIENT)
/* Newton's increments double their digits: after one of this share of e the next is rounding. */
#define DAL__GAUGE_INCREMENT (1e-10 * DAL_ULP_RATIO)
enum { DAL__GAUGE_ITERATIONS = 20 };

/* The stages of (e, pi_e), and what they depend on. */
typedef struct dal_gauge {
    const dal_tableau *method;
    double h;
    const num *q, *v; /* [s*n] Q, V */
    num *mu, *w;      /* [s] mu_i, 1/E_i */
    num *rate;        /* [s] R_i */
    num *gradient;    /* [s*(2n+1)] of mu_e by q, v, e */
} dal_gauge;

/* Numbers of the state plus h times their mean rate of stage i, a_ij or p_ij being its weights. */
DAL_INLINE num dal__gauge_stage(const dal_step *s, const dal_gauge *g, int place, const double *a,
                                const double *tail, const num *rates, int i)
{
    const int stages = DAL_STAGES(g->method);
    const num mean = dal__weighted(a + i * stages, dal__tail(tail, i * stages), stages, rates, 1);
    return s->y[place] + dal_fma(dal_num(g->h), mean, s->r[place]);
}

/* Evaluates mu_e or its derivatives at the stages; out[s*size]. */
DAL_INLINE void dal__eval_gauge(dal_step *s, const dal_gauge *g, dal_callback_code code, int size,
                                num *out)
{
    const dal_tableau *m = g->method;
    DAL_EACH(i, DAL_STAGES(m)) {
        const num e = dal__gauge_stage(s, g, dal_at_e(s), m->a, m->a_tail, g->mu, i);
        g->w[i] = 1.0 / e;
        dal_eval(s, code, s->t + m->c[i] * g->h, g->q + i * DAL_N(s), g->v + i * DAL_N(s), &e,
                 out + i * size);
    }
}

/* x <- (1 - z diag(mu_e,e) a)^-1 x, x[s]; of a the heads and tails. */
DAL_INLINE void dal__solve_rates(dal_step *s, const dal_gauge *g, const double *a,
                                 const double *tail, double z, num *x)
{
    const int stages = DAL_STAGES(g->method), size = 2 * DAL_N(s) + 1;
    DAL__MARK(s);
    DAL_VECTOR(s, m, DAL_STAGES(g->method) * DAL_STAGES(g->method));
    for (int i = 0; i < stages * stages; i++) {
        const num by_e = g->gradient[(i / stages + 1) * size - 1];
        const num weight = dal_num(a[i]) + (tail ? tail[i] : 0.0);
        m[i] = (double)(i % (stages + 1) == 0) - z * weight * by_e;
    }
    dal_eliminate_in_units(m, x, stages, NULL, 1);
    DAL__RELEASE(s);
}

#define dal_gauge_solve DAL_WIDE(dal_gauge_solve)
DAL_SHARED dal_mask dal_gauge_solve(dal_step *s, const dal_gauge *g, dal_mask lanes);
#define dal_gauge_rates DAL_WIDE(dal_gauge_rates)
DAL_SHARED void dal_gauge_rates(dal_step *s, const dal_gauge *g, const num *pi, num *f, int stride);

#ifndef DAL_LINKED
/* mu and w of the stages, in the given lanes; returns those that are not solved. */
DAL_SHARED dal_mask dal_gauge_solve(dal_step *s, const dal_gauge *g, dal_mask lanes)
{
    const dal_tableau *m = g->method;
    const int stages = DAL_STAGES(m), size = 2 * DAL_N(s) + 1;
    const num enough = DAL__GAUGE_INCREMENT * dal_abs(s->y[dal_at_e(s)]);
    DAL__MARK(s);
    DAL_VECTOR(s, x, DAL_STAGES(g->method));
    DAL_EACH(i, stages) g->mu[i] = dal_num(0.0);
    for (int k = 0; k < DAL__GAUGE_ITERATIONS && dal_any(lanes); k++) {
        dal__eval_gauge(s, g, DAL_EVAL_GAUGE_GRADIENT, size, g->gradient);
        dal__eval_gauge(s, g, DAL_EVAL_GAUGE, 1, x);
        DAL_EACH(i, stages) x[i] -= g->mu[i];
        dal__solve_rates(s, g, m->a, m->a_tail, g->h, x);
        num moved = dal_num(0.0);
        DAL_EACH(i, stages) {
            g->mu[i] = dal_select(lanes, g->mu[i] + x[i], g->mu[i]);
            moved += dal_abs(g->h * x[i]);
        }
        lanes &= ~dal_less_equal(moved, enough);
    }
    DAL_EACH(i, stages)
        g->w[i] = 1.0 / dal__gauge_stage(s, g, dal_at_e(s), m->a, m->a_tail, g->mu, i);
    DAL__RELEASE(s);
    return lanes;
}

/* R of the stages, from what dal_adjoint wrote to f, stride numbers a stage, for pi[s*n]; adds to
 * f the derivatives of mu_e pi_e by q and v. */
DAL_SHARED void dal_gauge_rates(dal_step *s, const dal_gauge *g, const num *pi, num *f, int stride)
{
    const dal_tableau *m = g->method;
    const int n = DAL_N(s), size = 2 * DAL_N(s) + 1, pi_e = dal_at_pi_e(s);
    dal__eval_gauge(s, g, DAL_EVAL_GAUGE_GRADIENT, size, g->gradient);
    DAL_EACH(i, DAL_STAGES(m)) {
        const num *K_pi = dal_push(s, f + i * stride, pi + i * n);
        const num by_e = g->gradient[(i + 1) * size - 1];
        g->rate[i] =
            dal_fma(-by_e, s->y[pi_e] + s->r[pi_e], dal_gauge_rate(pi + i * n, K_pi, n, g->w[i]));
    }
    dal__solve_rates(s, g, m->partner, m->partner_tail, -g->h, g->rate);
    DAL_EACH(i, DAL_STAGES(m)) {
        const num y = dal__gauge_stage(s, g, pi_e, m->partner, m->partner_tail, g->rate, i);
        num *const by_q = f + i * stride + n;
        DAL_EACH(j, 2 * n) by_q[j] = dal_fma(y, g->gradient[i * size + j], by_q[j]);
    }
}
#endif
#endif
#endif
