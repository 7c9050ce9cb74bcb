/* symplectic_euler.h - symplectic Euler in partitioned form, for every polarisation.
 *
 * For each canonical pair (X, P) the Hamiltonian is evaluated at (X0, P1) where the polarisation is
 * 0 and at (X1, P0) where it is 1:  X1 = X0 + h dH/dP,  P1 = P0 - h dH/dX.  With (s_q, s_v), and
 * the pair (e, pi_e) and the time going with q, a star marking the chosen argument,
 *
 *     q1 = q + h v*                     v1 = v + h (F(q*, v*, t*) + pi* / e*)
 *     p1 = p - h F_q^T pi*              pi1 = pi - h (p* + F_v^T pi*)
 *     e1 = e + h mu_e(t*)               pi_e1 = pi_e + h |pi*|^2 / (2 e*^2)
 *
 *     s_v = 0: v* = v known, pi* = pi1 solves
 *              u = pi - h (p* + F_v^T u),            p* = p - [s_q=0] h F_q^T u
 *     s_v = 1: pi* = pi known, v* = v1 solves
 *              u = v + h (F(q*, u, t*) + pi / e*),   q* = q + [s_q=1] h u
 *
 * With an effort K(q*, v*, t*) the term pi*.K pi* of H replaces |pi*|^2, with its derivatives; with
 * mu_e(q*, v*, e*, t*) the equation of e1, or of pi_e1, is implicit as well (gauge.h).
 *
 * Symplectic for every choice, as sum dX1 dP1 - dX dP = h d(dH) = 0; order 1.  The adjoint of
 * (s_q, s_v) is (1-s_q, 1-s_v).  The physical space has the first line only, and v
 * means (v, g) there.
 *
 * Where F depends on q and t alone, F_v = 0 and (1,0) and (0,1) are explicit, with one evaluation
 * each; (1,0) and then (0,1) have q*, pi*, e* and t* in common, and evaluate F once. */
#ifndef DAL_KERNEL_SYMPLECTIC_EULER_H
#define DAL_KERNEL_SYMPLECTIC_EULER_H

#include "gauge.h"
#include "solve.h"

/* The choice (s_q, s_v) of partitioned symplectic Euler. */
typedef struct dal_polarisation {
    int q, v; /* 0 or 1 each */
} dal_polarisation;
DAL_INLINE dal_polarisation DAL_POLARISATION(int q, int v)
{
    const dal_polarisation at = {q, v};
    return at;
}

#define dal_symplectic_euler DAL_WIDE(dal_symplectic_euler)
DAL_SHARED dal_status dal_symplectic_euler(dal_step *s, dal_polarisation at, double h);
#define dal_symplectic_euler_pair DAL_WIDE(dal_symplectic_euler_pair)
DAL_SHARED dal_status dal_symplectic_euler_pair(dal_step *s, double h, double adjoint_h);

#ifndef DAL_LINKED
/* The starred arguments of one step. */
typedef struct dal_euler {
    dal_polarisation at;
    double h, t;
    num *q, *v, *p, *pi; /* [n], [nw], [n], [n] */
    num *f;              /* the field or adjoint of the last evaluation, with the part of mu_e */
    num w;               /* 1/e* */
    num mu, rate;        /* of e, and where mu_e is not of t alone, of pi_e */
    num *gradient;       /* [2n+1] of mu_e there */
} dal_euler;

#if DAL_WITH(GAUGE_GRADIENT)
/* (e, pi_e) as the one stage of a method, for the present q* and v*. */
DAL_INLINE dal_gauge dal__euler_gauge(dal_euler *k)
{
    static const double zero = 0.0, one = 1.0;
    static const dal_tableau old_e = {1, &zero, &one, NULL, &zero, NULL, NULL, &one, NULL, NULL};
    static const dal_tableau new_e = {1, &one, &one, NULL, &one, NULL, NULL, &zero, NULL, NULL};
    const dal_gauge gauge = {
        k->at.q ? &new_e : &old_e, k->h, k->q, k->v, &k->mu, &k->w, &k->rate, k->gradient};
    return gauge;
}
/* e*; returns the lanes in which it is not solved. */
DAL_INLINE dal_mask dal__euler_e(dal_step *s, dal_euler *k)
{
    const dal_gauge gauge = dal__euler_gauge(k);
    return dal_gauge_solve(s, &gauge, s->alive);
}
/* The rate of pi_e, and its part in the last adjoint. */
DAL_INLINE void dal__euler_pi_e(dal_step *s, dal_euler *k)
{
    const dal_gauge gauge = dal__euler_gauge(k);
    dal_gauge_rates(s, &gauge, k->pi, k->f, 0);
}
#endif

/* The adjoint at the starred arguments, with the part of mu_e. */
DAL_INLINE void dal__euler_adjoint(dal_step *s, dal_euler *k)
{
    dal_adjoint(s, k->t, k->q, k->v, k->pi, k->w, k->f);
#if DAL_WITH(GAUGE_GRADIENT)
    if (DAL_GAUGE(s)) dal__euler_pi_e(s, k);
#endif
}

/* Whether F, and K, depend on q and t alone. */
DAL_INLINE bool dal__force_is_positional(const dal_step *s)
{
    return (DAL_PROPERTIES(s) & DAL_F_POSITIONAL) != 0;
}

/* q* for the velocity v*. */
DAL_INLINE void dal__euler_q(dal_step *s, dal_euler *k)
{
    DAL_EACH(i, DAL_N(s))
        k->q[i] = dal_choose(k->at.q, s->y[i] + dal_fma(dal_num(k->h), k->v[i], s->r[i]), s->y[i]);
}

/* F + pi* w, from the last field. */
DAL_INLINE num dal__euler_rate_v(const dal_step *s, const dal_euler *k, int i)
{
    return DAL_LIFTED(s) ? dal_fma(dal_push(s, k->f, k->pi)[i], k->w, k->f[i]) : k->f[i];
}

/* v1 for that rate, to the bits of the update. */
DAL_INLINE num dal__euler_v1(const dal_step *s, const dal_euler *k, int i, num rate)
{
    const int v = DAL_N(s) + i;
    return s->y[v] + dal_fma(dal_num(k->h), rate, s->r[v]);
}

/* s_v = 1: u = v1. */
DAL_INLINE void dal__euler_map_v(dal_step *s, dal_equation *eq)
{
    dal_euler *k = (dal_euler *)eq->context;
    DAL_EACH(i, DAL_NW(s))
        k->v[i] = DAL_IF_ACTIVE(DAL_LANES_AT(eq->active, 0), eq->block[0].u[i], k->v[i]);
    dal__euler_q(s, k);
#if DAL_WITH(GAUGE_GRADIENT)
    if (DAL_GAUGE(s) && k->at.q) dal__euler_e(s, k);
#endif
    if (DAL_EFFORT(s))
        dal_adjoint(s, k->t, k->q, k->v, k->pi, k->w, k->f);
    else
        dal_force(s, k->t, k->q, k->v, k->f);
    DAL_EACH(i, DAL_NW(s))
        eq->block[0].image[i] = dal__euler_v1(s, k, i, dal__euler_rate_v(s, k, i));
}

/* p* for the momentum pi*, from the last adjoint. */
DAL_INLINE void dal__euler_p(dal_step *s, dal_euler *k)
{
    const int n = DAL_N(s), p = dal_at_p(s);
    DAL_EACH(i, n)
        k->p[i] = dal_choose(k->at.q, s->y[p + i],
                             s->y[p + i] + dal_fma(dal_num(-k->h), k->f[n + i], s->r[p + i]));
}

/* s_v = 0: u = pi1. */
DAL_INLINE void dal__euler_map_pi(dal_step *s, dal_equation *eq)
{
    dal_euler *k = (dal_euler *)eq->context;
    const int n = DAL_N(s), pi = dal_at_pi(s);
    DAL_EACH(i, n) k->pi[i] = eq->block[0].u[i];
    dal__euler_adjoint(s, k);
    dal__euler_p(s, k);
    DAL_EACH(i, n)
        eq->block[0].image[i] =
            s->y[pi + i] + dal_fma(dal_num(-k->h), k->p[i] + k->f[2 * n + i], s->r[pi + i]);
}

/* 1 - h F_v - [s_q=1] h^2 F_q, or 1 + h F_v^T - [s_q=0] h^2 F_q^T. */
DAL_INLINE void dal__euler_matrix(dal_step *s, dal_equation *eq)
{
    static const double one = 1.0, zero = 0.0;
    const dal_euler *k = (const dal_euler *)eq->context;
    DAL_VECTOR(s, jacobian, DAL_NW(s) * (DAL_N(s) + DAL_NW(s)));
    DAL_VECTOR(s, m, DAL_NW(s) * DAL_NW(s));
    dal_jacobian(s, 0, k->t, k->q, k->v, jacobian);
    const bool q_moves = k->at.v == k->at.q;
    const dal_stage_matrix matrix = {
        1, k->at.v ? k->h : -k->h, &one, q_moves ? &one : &zero, !k->at.v, NULL};
    dal_stage_inverse(s, &matrix, jacobian, m, &eq->block[0], 0);
}

/* pi1 for p* = p and F_v = 0. */
DAL_INLINE void dal__euler_explicit_pi(dal_step *s, dal_euler *k)
{
    const int n = DAL_N(s), pi = dal_at_pi(s);
    DAL_EACH(i, n) k->p[i] = s->y[dal_at_p(s) + i];
#if DAL_WITH(GAUGE_GRADIENT)
    DAL_EACH(i, DAL_GAUGE(s) * DAL_ADJOINT_SIZE(s)) k->f[i] = dal_num(0.0);
    if (DAL_GAUGE(s)) dal__euler_pi_e(s, k);
    DAL_EACH(i, DAL_GAUGE(s) * n) k->p[i] += k->f[2 * n + i];
#endif
    DAL_EACH(i, n) k->pi[i] = s->y[pi + i] + dal_fma(dal_num(-k->h), k->p[i], s->r[pi + i]);
}

/* Solves for v1 (s_v = 1) or pi1 (s_v = 0). */
DAL_INLINE dal_status dal__euler_solve(dal_step *s, dal_euler *k)
{
    const int n = DAL_N(s), nw = DAL_NW(s), pi = dal_at_pi(s);
    DAL_BLOCK(s, block, DAL_NW(s), DAL_MAY_NEWTON(s));
    DAL_EQUATION(s, eq, 1, k, block);
    eq.cost = dal_cost_of_newton(s, 1, DAL_NW(s), NULL);
    if (k->at.v) {
        dal_set_speeds(s, &eq.block[0], nw);
        eq.block[0].progress->scale = dal_velocity_scale(s, k->h, 0);
        DAL_EACH(i, nw) eq.block[0].u[i] = s->y[n + i];
        if (dal_failed(dal_solve(s, &eq, dal__euler_map_v, dal__euler_matrix)))
            return DAL_STATUS_NOT_CONVERGED;
        DAL_EACH(i, nw) k->v[i] = eq.block[0].u[i];
    } else {
        eq.follows = true; /* there is no such equation on the physical space */
        eq.block[0].size = n;
        eq.block[0].progress->scale = dal_momentum_scale(s, k->h, 0);
        DAL_EACH(i, n) eq.block[0].u[i] = s->y[pi + i];
        if (dal_failed(dal_solve(s, &eq, dal__euler_map_pi, dal__euler_matrix)))
            return DAL_STATUS_NOT_CONVERGED;
        DAL_EACH(i, n) k->pi[i] = eq.block[0].u[i];
    }
    return DAL_STATUS_OK;
}

/* The rates d of the momenta. */
DAL_INLINE void dal__euler_momenta(dal_step *s, const dal_euler *k, num *d)
{
    const int n = DAL_N(s);
    DAL_EACH(i, n) {
        d[dal_at_p(s) + i] = -k->f[n + i];
        d[dal_at_pi(s) + i] = -(k->p[i] + k->f[2 * n + i]);
    }
    d[dal_at_e(s)] = k->mu;
    d[dal_at_pi_e(s)] =
        DAL_GAUGE(s) ? k->rate : dal_gauge_rate(k->pi, dal_push(s, k->f, k->pi), n, k->w);
}

#if DAL_WITH(GAUGE_GRADIENT)
/* e*, the rates of e and pi_e and their part in the adjoint at v*, which is v[n]; lanes in which
 * e* is not solved have failed. */
DAL_INLINE void dal__euler_end_gauge(dal_step *s, dal_euler *k, const num *v)
{
    DAL_EACH(i, DAL_N(s)) k->v[i] = v[i];
    const dal_mask unsolved = dal__euler_e(s, k);
    s->unconverged |= unsolved;
    s->alive &= ~unsolved;
    dal__euler_pi_e(s, k);
}
#endif

/* Whether a field at the starred arguments is there already. */
typedef enum dal__euler_field { DAL__FIELD_UNKNOWN, DAL__FIELD_KNOWN } dal__euler_field;

/* The field f at the starred arguments, unless it is known, and the rates of all components. */
DAL_INLINE void dal__euler_rates(dal_step *s, dal_euler *k, num *f, dal__euler_field field, num *d)
{
    const int n = DAL_N(s);
    const bool known = field == DAL__FIELD_KNOWN;
    if (DAL_LIFTED(s) && !known) dal_adjoint(s, k->t, k->q, k->v, k->pi, k->w, f);
    if (!DAL_LIFTED(s) && !known) dal_force(s, k->t, k->q, k->v, f);
    DAL_EACH(i, DAL_GAUGE(s) * DAL_ADJOINT_SIZE(s)) k->f[i] = f[i];
    DAL_EACH(i, DAL_NW(s)) d[n + i] = dal__euler_rate_v(s, k, i);
    DAL_EACH(i, n) d[i] = k->at.v ? dal__euler_v1(s, k, i, d[n + i]) : k->v[i];
#if DAL_WITH(GAUGE_GRADIENT)
    if (DAL_GAUGE(s)) dal__euler_end_gauge(s, k, d);
#endif
    if (DAL_LIFTED(s)) dal__euler_p(s, k);
    if (DAL_LIFTED(s)) dal__euler_momenta(s, k, d);
}

/* mu_e and e*, as far as v* is known, and pi. */
DAL_INLINE void dal__euler_begin_lift(dal_step *s, dal_euler *k)
{
    const num e = s->y[dal_at_e(s)];
    DAL_EACH(i, DAL_N(s)) k->pi[i] = s->y[dal_at_pi(s) + i];
#if DAL_WITH(GAUGE_GRADIENT)
    if (DAL_GAUGE(s)) dal__euler_e(s, k);
#endif
    if (DAL_GAUGE(s)) return;
    k->mu = dal_mu_e(s, k->t);
    k->w = 1.0 / dal_choose(k->at.q, e + k->h * k->mu, e);
}

/* The numbers of a field or an adjoint. */
#define DAL__EULER_FIELD(s) ((2 + DAL_EFFORT(s)) * DAL_N(s) + DAL_NW(s))

/* One step of size h from the present state and time; f, DAL__EULER_FIELD numbers, is the field at
 * the starred arguments, without mu_e, where it is known, and else becomes it. */
DAL_INLINE dal_status dal__euler_step(dal_step *s, dal_polarisation at, double h, num *f,
                                      dal__euler_field field)
{
    DAL__MARK(s);
    const int n = DAL_N(s);
    const bool is_explicit = dal__force_is_positional(s) && at.q != at.v;
    DAL_VECTOR(s, q, DAL_N(s));
    DAL_VECTOR(s, v, DAL_NW(s));
    DAL_VECTOR(s, p, DAL_N(s));
    DAL_VECTOR(s, pi, DAL_N(s));
    DAL_VECTOR(s, d, DAL_DIM(s));
    DAL_VECTOR(s, gradient, DAL_GAUGE(s) * (2 * DAL_N(s) + 1));
    DAL_VECTOR(s, with_mu, DAL_GAUGE(s) * DAL__EULER_FIELD(s));
    const num zero = dal_num(0.0);
    dal_euler k = {at, h, at.q ? s->t + h : s->t, q, v, p, pi, f, zero, zero, zero, gradient};
    if (DAL_GAUGE(s)) k.f = with_mu;
    DAL_EACH(i, DAL_NW(s)) v[i] = s->y[n + i];
    dal__euler_q(s, &k);
    if (DAL_LIFTED(s)) dal__euler_begin_lift(s, &k);
    if (is_explicit && DAL_LIFTED(s) && !at.v) dal__euler_explicit_pi(s, &k);
    if (!is_explicit && (at.v || DAL_LIFTED(s)) && dal_failed(dal__euler_solve(s, &k)))
        return DAL_STATUS_NOT_CONVERGED;
    if (!is_explicit) dal__euler_q(s, &k);
    dal__euler_rates(s, &k, f, field, d);
    DAL__RELEASE(s);
    return dal_update_multiple(s, h, h, d);
}

/* One step of size h from the present state and time. */
DAL_SHARED dal_status dal_symplectic_euler(dal_step *s, dal_polarisation at, double h)
{
    DAL__MARK(s);
    DAL_VECTOR(s, f, DAL__EULER_FIELD(s));
    const dal_status status = dal__euler_step(s, at, h, f, DAL__FIELD_UNKNOWN);
    DAL__RELEASE(s);
    return status;
}

/* (1,0) of size h, then (0,1) of size adjoint_h. */
DAL_SHARED dal_status dal_symplectic_euler_pair(dal_step *s, double h, double adjoint_h)
{
    DAL__MARK(s);
    DAL_VECTOR(s, f, DAL__EULER_FIELD(s));
    if (dal_failed(dal__euler_step(s, DAL_POLARISATION(1, 0), h, f, DAL__FIELD_UNKNOWN)))
        return DAL_STATUS_NOT_CONVERGED;
    const dal__euler_field field =
        dal__force_is_positional(s) ? DAL__FIELD_KNOWN : DAL__FIELD_UNKNOWN;
    const dal_status status = dal__euler_step(s, DAL_POLARISATION(0, 1), adjoint_h, f, field);
    DAL__RELEASE(s);
    return status;
}
#endif

#endif
