/* collocation.h - one step of an implicit Runge-Kutta method (a, b, c) with s stages.
 *
 * The unknowns are the stage derivatives K_i of w = (v, g) and L_i of pi; the others follow:
 *
 *     V_i  = w + h sum a_ij K_j             Q_i = q + h sum a_ij V_j
 *     Pi_i = pi + h sum a_ij L_j            P_i = p - h sum a_ij F_q^T Pi |_j
 *     E_i  = e + h sum a_ij mu_j            t_i = t + c_i h
 *     K_i  = F(Q_i, V_i, t_i) + Pi_i/E_i    L_i = -P_i - F_v^T Pi |_i
 *
 * where an effort K replaces pi/e by K pi/e and adds the derivatives of pi.K pi/(2e) to the other
 * two, to which a mu_e(q, v, e, t) adds its own (gauge.h); y1 = y + h sum b_i (derivative)_i.  A
 * partitioned method has other coefficients for w, p and pi_e than for q, e and pi, which are each
 * the partner of the other: symplectic where b_i p_ij + b_j a_ji = b_i b_j.  For long runs (Hairer,
 * McLachlan, Razakarivony, BIT 48 (2008) 231): each coefficient is head + tail, the head a multiple
 * of 1/1024, summed apart; stages start from y + r; the iteration runs to stagnation; the step ends
 * with the stage values of the last derivatives.
 *
 * The predictor extrapolates (E) the polynomial through the derivatives K of the last step and
 * corrects it by its earlier errors e_k = K_k - E K_(k-1):
 *
 *     guess_(k+1) = E K_k + e_k + D e_k + D^2 e_k + D^3 e_k,      D x_k = x_k - x_(k-1),
 *
 * where each term gains an order in h.  In a first step, and where the iteration from the predictor
 * fails (as for large h), the guess is the field at the present state. */
#ifndef DAL_KERNEL_COLLOCATION_H
#define DAL_KERNEL_COLLOCATION_H

#include "gauge.h"
#include "solve.h"
#include "tableau.h"

enum { DAL__DIFFERENCES = 4 }; /* of the predictor's errors, stored beside the derivatives */

/* One step of size s->h from the present state and time; leaves the time advanced. */
#define dal_collocation DAL_WIDE(dal_collocation)
DAL_SHARED dal_status dal_collocation(dal_step *s, const dal_tableau *method);

#ifndef DAL_LINKED
typedef struct dal_stages {
    const dal_tableau *method;
    double h;
    num *v, *q, *pi; /* [s*nw], [s*n], [s*n] */
    num *f, *force;  /* [s*stride]; [s*n] F_q^T Pi, and with an effort [s*n] K Pi */
    num *w;          /* [s] 1/E_i */
    num *mu;         /* [s] */
    int stride;      /* of f */
#if DAL_WITH(GAUGE_GRADIENT)
    dal_gauge gauge;   /* of the present iterate; in it mu of its own */
    num *rate;         /* [s] of pi_e, of a lane's own last iteration as mu and force */
    dal_mask unsolved; /* lanes in which mu was not solved there */
#endif
} dal_stages;

/* The eigensystem that splits Newton's matrix, NULL: it stays whole, as with a single stage. */
DAL_INLINE const dal_eigensystem *dal__eigensystem_of(const dal_tableau *method)
{
    return DAL_STAGES(method) > 1 ? method->eigensystem : NULL;
}

/* sum b x for count components. */
DAL_INLINE void dal__end(const dal_stages *k, const num *x, int stride, int count, num *out)
{
    dal__weighted_all(k->method->b, k->method->b_tail, DAL_STAGES(k->method), x, stride, count,
                      out);
}

/* Which coefficients give stage values: the method's, or its partner's. */
typedef enum dal__coefficients { DAL__OF_METHOD, DAL__OF_PARTNER } dal__coefficients;

/* Stage values base + (r + h sum a x) for count components; out must not overlap x. */
DAL_INLINE void dal__stage_value(const dal_step *s, const dal_stages *k, dal__coefficients of,
                                 int i, int first, int count, const num *x, int stride,
                                 num *DAL_RESTRICT out)
{
    const dal_tableau *m = k->method;
    const int stages = DAL_STAGES(m);
    const double *a = (of == DAL__OF_PARTNER ? m->partner : m->a) + i * stages;
    const double *tail = dal__tail(of == DAL__OF_PARTNER ? m->partner_tail : m->a_tail, i * stages);
    const num *y = s->y + first, *r = s->r + first, h = dal_num(k->h);
    DAL__BY_STAGES(stages,
                   DAL_EACH(c, count) out[c] =
                       y[c] + dal_fma(h, dal__weighted(a, tail, STAGES, x + c, stride), r[c]));
}
DAL_INLINE void dal__stage_values(const dal_step *s, const dal_stages *k, dal__coefficients of,
                                  int first, int count, const num *x, int stride, num *out)
{
    DAL_EACH(i, DAL_STAGES(k->method))
        dal__stage_value(s, k, of, i, first, count, x, stride, out + i * count);
}

/* The derivatives of pi: L_i = -(p + r - h sum a F_q^T Pi) - F_v^T Pi. */
DAL_INLINE void dal__momentum_derivatives(dal_step *s, const dal_stages *k, num *image)
{
    const int n = DAL_N(s), stages = DAL_STAGES(k->method);
    const num *p = s->y + dal_at_p(s), *r = s->r + dal_at_p(s);
    DAL_EACH(i, stages) {
        num *DAL_RESTRICT derivative = image + i * n;
        const num *Fv = k->f + i * k->stride + 2 * n;
        dal__weighted_all(k->method->partner + i * stages,
                          dal__tail(k->method->partner_tail, i * stages), stages, k->f + n,
                          k->stride, n, derivative);
        DAL_EACH(j, n)
            derivative[j] = -(p[j] + dal_fma(dal_num(-k->h), derivative[j], r[j])) - Fv[j];
    }
}

/* Saves F_q^T Pi and K Pi of the stages for the end of the step, from a lane's own last iteration.
 */
DAL_INLINE void dal__save_forces(const dal_step *s, const dal_stages *k, dal_mask active)
{
    (void)active; /* one lane is always active here */
    const int n = DAL_N(s), stages = DAL_STAGES(k->method);
    DAL_EACH(i, stages)
        DAL_EACH(j, n)
            k->force[i * n + j] =
                DAL_IF_ACTIVE(active, k->f[i * k->stride + n + j], k->force[i * n + j]);
    num *const K_pi = k->force + stages * n;
    DAL_EACH(i, DAL_EFFORT(s) * stages)
        DAL_EACH(j, n)
            K_pi[i * n + j] =
                DAL_IF_ACTIVE(active, k->f[i * k->stride + 3 * n + j], K_pi[i * n + j]);
}

/* Evaluates the system at every stage; on the physical space F is the image of K. */
DAL_INLINE void dal__eval_stages(dal_step *s, const dal_stages *k, num *image)
{
    DAL_EACH(i, DAL_STAGES(k->method)) {
        const double t = s->t + k->method->c[i] * k->h;
        const num *q = k->q + i * DAL_N(s), *v = k->v + i * DAL_NW(s);
        if (DAL_LIFTED(s))
            dal_adjoint(s, t, q, v, k->pi + i * DAL_N(s), k->w[i], k->f + i * k->stride);
        if (!DAL_LIFTED(s)) dal_force(s, t, q, v, image + i * DAL_NW(s));
    }
}

#if DAL_WITH(GAUGE_GRADIENT)
/* Adds the part of mu_e to the adjoint of the stages, and saves what the end of the step needs. */
DAL_INLINE void dal__add_gauge_stages(dal_step *s, dal_stages *k, dal_mask active)
{
    (void)active; /* one lane is always active here */
    dal_gauge_rates(s, &k->gauge, k->pi, k->f, k->stride);
    DAL_EACH(i, DAL_STAGES(k->method)) {
        k->mu[i] = DAL_IF_ACTIVE(active, k->gauge.mu[i], k->mu[i]);
        k->rate[i] = DAL_IF_ACTIVE(active, k->gauge.rate[i], k->rate[i]);
    }
}
#endif

DAL_INLINE void dal__collocation_map(dal_step *s, dal_equation *eq)
{
    dal_stages *k = (dal_stages *)eq->context;
    const int n = DAL_N(s), nw = DAL_NW(s);
    num *const image = eq->block[0].image;
    dal__stage_values(s, k, DAL__OF_PARTNER, n, nw, eq->block[0].u, nw, k->v);
    dal__stage_values(s, k, DAL__OF_METHOD, 0, n, k->v, nw, k->q);
    if (DAL_LIFTED(s))
        dal__stage_values(s, k, DAL__OF_METHOD, dal_at_pi(s), n, eq->block[1].u, n, k->pi);
#if DAL_WITH(GAUGE_GRADIENT)
    if (DAL_GAUGE(s))
        k->unsolved = dal_gauge_solve(s, &k->gauge, eq->active) | (k->unsolved & ~eq->active);
#endif
    dal__eval_stages(s, k, image);
    if (!DAL_LIFTED(s)) return;
#if DAL_WITH(GAUGE_GRADIENT)
    if (DAL_GAUGE(s)) dal__add_gauge_stages(s, k, eq->active);
#endif
    dal__save_forces(s, k, DAL_LANES_AT(eq->active, 0));
    DAL_EACH(i, DAL_STAGES(k->method))
        DAL_EACH(j, n)
            image[i * n + j] = dal_fma(dal_push(s, k->f + i * k->stride, k->pi + i * n)[j], k->w[i],
                                       k->f[i * k->stride + j]);
    dal__momentum_derivatives(s, k, eq->block[1].image);
}

/* The point where Newton's matrix is evaluated: about the middle of the step, by the acceleration
 * at the end of the last one (0 before a first step).  The predictor can be far off there. */
DAL_INLINE void dal__guess_middle(const dal_step *s, const dal_stages *k, num *q, num *v)
{
    const int n = DAL_N(s), nw = DAL_NW(s);
    const num half = dal_num(DAL_STAGE_DERIVATIVES(s) ? 0.5 * k->h : 0.0), quarter = 0.5 * half;
    const num *K = s->derivatives + (DAL_STAGES(k->method) - 1) * nw;
    DAL_EACH(i, n) q[i] = dal_fma(half, dal_fma(quarter, K[i], s->y[n + i]), s->y[i]);
    DAL_EACH(i, nw) v[i] = dal_fma(half, K[i], s->y[n + i]);
}

DAL_INLINE void dal__collocation_matrix(dal_step *s, dal_equation *eq)
{
    enum { MAX = DAL_MAX_STAGES * DAL_MAX_STAGES };
    const dal_stages *k = (const dal_stages *)eq->context;
    const dal_tableau *method = k->method;
    const int stages = DAL_STAGES(method);
    double a[MAX], b[MAX], ab[MAX], ba[MAX];
    DAL_VECTOR(s, q, DAL_N(s));
    DAL_VECTOR(s, v, DAL_NW(s));
    DAL_VECTOR(s, jacobian, DAL_PER_GROUP(DAL_NW(s) * (DAL_N(s) + DAL_NW(s))));
    DAL_VECTOR(
        s, m, DAL_PER_GROUP(DAL_STAGES(k->method) * DAL_NW(s) * DAL_STAGES(k->method) * DAL_NW(s)));
    const dal_eigensystem *eigensystem = dal__eigensystem_of(method);
    if (!eigensystem) {
        dal__rounded(stages * stages, method->a, method->a_tail, a);
        dal__rounded(stages * stages, method->partner, method->partner_tail, b);
        dal__product(stages, a, b, ab);
        dal__product(stages, b, a, ba);
    }
    const dal_stage_matrix x = {stages, k->h, b, ab, false, eigensystem};
    const dal_stage_matrix p = {stages, -k->h, a, ba, true, eigensystem};
    dal__guess_middle(s, k, q, v);
    DAL_EACH_GROUP(j) {
        dal_jacobian(s, j, s->t + 0.5 * k->h, q, v, jacobian);
        dal_stage_inverse(s, &x, jacobian, m, &eq->block[0], j);
        if (DAL_LIFTED(s)) dal_stage_inverse(s, &p, jacobian, m, &eq->block[1], j);
    }
}

/* Guesses the field at the present state for every stage, in the given lanes. */
DAL_INLINE void dal__guess_block(dal_block *b, int width, const num *derivative, dal_lane_set lanes)
{
    DAL_EACH(i, DAL_SIZE(b))
        b->u[i] = dal_select(DAL_LANES_AT(lanes, i), derivative[i % width], b->u[i]);
}
DAL_INLINE void dal__guess_from_field(dal_step *s, dal_equation *eq, dal_lane_set lanes)
{
    DAL_VECTOR(s, dy, DAL_DIM(s));
    dal_field(s, s->t, s->y, dy);
    dal__guess_block(&eq->block[0], DAL_NW(s), dy + DAL_N(s), lanes);
    if (DAL_LIFTED(s)) dal__guess_block(&eq->block[1], DAL_N(s), dy + dal_at_pi(s), lanes);
}

/* u += factor x */
DAL_INLINE void dal__accumulate(num *DAL_RESTRICT u, double factor, const num *x, int count)
{
    DAL_EACH(i, count) u[i] = dal_fma(dal_num(factor), x[i], u[i]);
}

/* Distance between the stored derivatives, predictor errors and their differences. */
DAL_INLINE int dal__stride(const dal_step *s, int stages)
{
    return stages * (DAL_NW(s) + DAL_N(s));
}

/* The predictor: the polynomial of the last step and its earlier errors. */
DAL_INLINE void dal__extrapolate(const dal_tableau *m, dal_block *b, int width, const num *last,
                                 int stride)
{
    const int stages = DAL_STAGES(m);
    DAL_EACH(i, DAL_SIZE(b)) b->u[i] = dal_num(0.0);
    DAL_EACH(i, stages)
        DAL_EACH(j, stages)
            dal__accumulate(b->u + i * width, m->extrapolation[i * stages + j], last + j * width,
                            width);
    DAL_EACH(d, DAL__DIFFERENCES)
        DAL_EACH(i, DAL_SIZE(b)) b->u[i] += last[(d + 1) * stride + i];
}

/* Saves the predictor errors and their differences where the predictor was accepted, else 0.  They
 * replace the first guess, which is no longer needed. */
DAL_INLINE void dal__save_predictor_errors(dal_block *b, dal_lane_set lanes, dal_lane_set accepted,
                                           num *DAL_RESTRICT last, int stride)
{
    num *const error = b->start;
    DAL_EACH(i, DAL_SIZE(b)) error[i] = b->u[i] - error[i];
    DAL_EACH(d, DAL__DIFFERENCES)
        DAL_EACH(i, DAL_SIZE(b)) error[i] += last[(d + 1) * stride + i];
    DAL_EACH(d, DAL__DIFFERENCES)
        DAL_EACH(i, DAL_SIZE(b)) {
            num *const kept = last + (d + 1) * stride + i, before = *kept;
            *kept =
                dal_select(DAL_LANES_AT(lanes, i),
                           dal_select(DAL_LANES_AT(accepted, i), error[i], dal_num(0.0)), before);
            error[i] -= before;
        }
}

/* Solves the stages in the lanes tried, which are then those solved, and alive. */
DAL_COLD dal_status dal__try_guess(dal_step *s, dal_equation *eq, dal_lane_set *tried)
{
    dal_status status = DAL_STATUS_OK;
    s->unconverged = dal_lanes_without(s->unconverged, *tried);
    s->alive = *tried;
    if (dal_any_lanes(*tried))
        status = dal_solve(s, eq, dal__collocation_map, dal__collocation_matrix);
    *tried = s->alive;
    return status;
}

DAL_INLINE num *dal__momentum_derivatives_kept(dal_step *s, const dal_stages *k)
{
    return s->derivatives + DAL_STAGES(k->method) * DAL_NW(s);
}

DAL_INLINE void dal__predict(dal_step *s, const dal_stages *k, dal_equation *eq)
{
    const int stride = dal__stride(s, DAL_STAGES(k->method));
    dal__extrapolate(k->method, &eq->block[0], DAL_NW(s), s->derivatives, stride);
    if (DAL_LIFTED(s))
        dal__extrapolate(k->method, &eq->block[1], DAL_N(s), dal__momentum_derivatives_kept(s, k),
                         stride);
}
DAL_INLINE void dal__record_predictor_errors(dal_step *s, const dal_stages *k, dal_equation *eq,
                                             dal_lane_set lanes, dal_lane_set accepted)
{
    const int stride = dal__stride(s, DAL_STAGES(k->method));
    dal__save_predictor_errors(&eq->block[0], lanes, accepted, s->derivatives, stride);
    if (DAL_LIFTED(s))
        dal__save_predictor_errors(&eq->block[1], lanes, accepted,
                                   dal__momentum_derivatives_kept(s, k), stride);
}

/* Lanes alive that have a predictor for steps of this size. */
DAL_INLINE dal_lane_set dal__predicted_lanes(const dal_step *s, const dal_stages *k)
{
    dal_lane_set lanes = s->alive;
    DAL_EACH_GROUP(j) DAL_LANES_AT(lanes, j) &= dal_equal(s->derivatives_h[j], dal_num(k->h));
    return lanes;
}

/* Solves from the predictor, where there is one; returns the lanes solved. */
DAL_INLINE dal_lane_set dal__solve_from_predictor(dal_step *s, const dal_stages *k,
                                                  dal_equation *eq)
{
    const dal_lane_set lanes = s->alive;
    dal_lane_set accepted = dal__predicted_lanes(s, k);
    dal__predict(s, k, eq);
    dal__save_guess(eq); /* the predictor errors need it even where nothing is tried */
    dal__try_guess(s, eq, &accepted);
    dal__record_predictor_errors(s, k, eq, lanes, accepted);
    return accepted;
}

/* Solves the stages; where the predictor fails, from the field at the present state. */
DAL_INLINE dal_status dal__solve_stages(dal_step *s, const dal_stages *k, dal_equation *eq)
{
    dal_status status = DAL_STATUS_OK;
    const dal_lane_set lanes = s->alive;
    const dal_lane_set accepted = DAL_STAGE_DERIVATIVES(s) ? dal__solve_from_predictor(s, k, eq)
                                                           : dal_lanes_without(lanes, lanes);
    dal_lane_set rest = dal_lanes_without(lanes, accepted);
    if (dal_any_lanes(rest)) {
        dal__guess_from_field(s, eq, rest);
        status = dal__try_guess(s, eq, &rest);
    }
    s->alive = dal_lanes_or(accepted, rest);
    return dal_any_lanes(s->alive) ? DAL_STATUS_OK : status;
}

/* Chooses the solver of the next step where the number of iterations matters for that. */
DAL_INLINE void dal__choose_after_fixed_point(dal_step *s, const dal_equation *eq)
{
    DAL_EACH_GROUP(j) {
        const dal_mask counts = dal__counts_until_trial(s, &eq->cost, j, eq->taken[j]);
        const dal_mask alive = DAL_LANES_AT(s->alive, j);
        if (DAL_RARELY(dal_any(alive & counts)))
            dal__choose_solver(s, &eq->cost, j, alive, ~dal_all(), eq->taken[j]);
    }
}

/* The same where the fixed point from the predictor suffices in all lanes; else
 * DAL_STATUS_NOT_CONVERGED, and nothing has changed. */
DAL_INLINE dal_status dal__solve_predicted(dal_step *s, const dal_stages *k, dal_equation *eq)
{
    if (!DAL_STAGE_DERIVATIVES(s) || (DAL_MAY_NEWTON(s) && DAL_SOLVER(s) == DAL_NEWTON))
        return DAL_STATUS_NOT_CONVERGED;
    dal_lane_set solved = dal__predicted_lanes(s, k);
    if (DAL_MAY_NEWTON(s))
        DAL_EACH_GROUP(j) {
            DAL_LANES_AT(solved, j) &= ~(dal__newton_in_use(s, j) | dal__trial_is_due(s, j));
            eq->limit[j] = dal__fixed_point_limit(s, &eq->cost, j, ~dal_all());
        }
    if (DAL_RARELY(dal_any_lanes(dal_lanes_without(s->alive, solved))))
        return DAL_STATUS_NOT_CONVERGED;
    dal__predict(s, k, eq);
    dal__save_guess(eq);
    dal__iterate(s, eq, dal__collocation_map,
                 DAL_MAY_NEWTON(s) ? DAL__TRY_FIXED_POINT : DAL__ITERATE_FIXED_POINT, &solved);
    if (DAL_RARELY(dal_any_lanes(dal_lanes_without(s->alive, solved))))
        return DAL_STATUS_NOT_CONVERGED;
    if (DAL_MAY_NEWTON(s)) dal__choose_after_fixed_point(s, eq);
    dal__record_predictor_errors(s, k, eq, solved, solved);
    return DAL_STATUS_OK;
}

/* Saves the derivatives for the next predictor. */
DAL_INLINE void dal__save_unknowns(const dal_step *s, const dal_block *b, num *DAL_RESTRICT last)
{
    dal_copy_lanes(s->alive, last, b->u, DAL_SIZE(b));
}
DAL_INLINE void dal__save_derivatives(dal_step *s, const dal_stages *k, const dal_equation *eq)
{
    if (!DAL_STAGE_DERIVATIVES(s)) return;
    dal__save_unknowns(s, &eq->block[0], s->derivatives);
    if (DAL_LIFTED(s)) dal__save_unknowns(s, &eq->block[1], dal__momentum_derivatives_kept(s, k));
    DAL_EACH_GROUP(j)
        s->derivatives_h[j] =
            dal_select(DAL_LANES_AT(s->alive, j), dal_num(k->h), s->derivatives_h[j]);
}

/* Stage values of the gauge variable, where it is a function of time alone. */
DAL_INLINE void dal__gauge_stages(dal_step *s, dal_stages *k)
{
    if (DAL_GAUGE(s)) return;
    const dal_tableau *m = k->method;
    DAL_EACH(i, DAL_STAGES(m)) k->mu[i] = dal_mu_e(s, s->t + m->c[i] * k->h);
    const int stages = DAL_STAGES(m);
    DAL_EACH(i, stages) {
        const double *a = m->a + i * stages, *tail = dal__tail(m->a_tail, i * stages);
        const num moved = k->h * dal__weighted(a, tail, stages, k->mu, 1);
        k->w[i] = 1.0 / (s->y[dal_at_e(s)] + moved);
    }
}

/* (y1 - y)/h of the momenta. */
DAL_INLINE void dal__collocation_momenta(dal_step *s, const dal_stages *k, const dal_equation *eq,
                                         num *d)
{
    const int n = DAL_N(s);
    DAL_VECTOR(s, rate, DAL_STAGES(k->method));
    const num *K_pi = DAL_EFFORT(s) ? k->force + DAL_STAGES(k->method) * n : k->pi;
    DAL_EACH(i, DAL_STAGES(k->method))
        rate[i] = dal_gauge_rate(k->pi + i * n, K_pi + i * n, n, k->w[i]);
#if DAL_WITH(GAUGE_GRADIENT)
    DAL_EACH(i, DAL_GAUGE(s) * DAL_STAGES(k->method)) rate[i] = k->rate[i];
#endif
    num *const p = d + dal_at_p(s);
    dal__end(k, k->force, n, n, p);
    DAL_EACH(j, n) p[j] = -p[j];
    dal__end(k, eq->block[1].u, n, n, d + dal_at_pi(s));
    dal__end(k, k->mu, 1, 1, d + dal_at_e(s));
    dal__end(k, rate, 1, 1, d + dal_at_pi_e(s));
}

/* (y1 - y)/h from the solved stages, and the end of the step. */
DAL_INLINE dal_status dal__collocation_end(dal_step *s, const dal_stages *k, const dal_equation *eq)
{
    const int n = DAL_N(s), nw = DAL_NW(s);
    DAL_VECTOR(s, d, DAL_DIM(s));
    dal__stage_values(s, k, DAL__OF_PARTNER, n, nw, eq->block[0].u, nw, k->v);
    if (DAL_LIFTED(s))
        dal__stage_values(s, k, DAL__OF_METHOD, dal_at_pi(s), n, eq->block[1].u, n, k->pi);
    dal__end(k, k->v, nw, n, d);
    dal__end(k, eq->block[0].u, nw, nw, d + n);
    if (DAL_LIFTED(s)) dal__collocation_momenta(s, k, eq, d);
    return dal_update_multiple(s, k->h, k->h, d);
}

/* Solves the stages from the predictor alone, or from any guess. */
typedef enum dal__guess { DAL__FROM_PREDICTOR, DAL__FROM_ANY_GUESS } dal__guess;

DAL_INLINE dal_status dal__collocate(dal_step *s, const dal_tableau *method, dal__guess guess)
{
    DAL_VECTOR(s, v, DAL_STAGES(method) * DAL_NW(s));
    DAL_VECTOR(s, q, DAL_STAGES(method) * DAL_N(s));
    DAL_VECTOR(s, pi, DAL_STAGES(method) * DAL_N(s));
    DAL_VECTOR(s, f, DAL_STAGES(method) * ((2 + DAL_EFFORT(s)) * DAL_N(s) + DAL_NW(s)));
    DAL_VECTOR(s, force, DAL_STAGES(method) * (1 + DAL_EFFORT(s)) * DAL_N(s));
    DAL_VECTOR(s, w, DAL_STAGES(method));
    DAL_VECTOR(s, mu, DAL_STAGES(method));
#if DAL_WITH(GAUGE_GRADIENT)
    DAL_VECTOR(s, of_gauge, DAL_GAUGE(s) * DAL_STAGES(method) * (2 * DAL_N(s) + 4));
#endif
    DAL_BLOCK(s, derivatives, DAL_STAGES(method) * DAL_NW(s), DAL_MAY_NEWTON(s));
    DAL_BLOCK(s, momenta, DAL_LIFTED(s) * DAL_STAGES(method) * DAL_N(s), DAL_MAY_NEWTON(s));
    dal_stages k = {
        method,
        s->h,
        v,
        q,
        pi,
        f,
        force,
        w,
        mu,
        DAL_LIFTED(s) ? DAL_ADJOINT_SIZE(s) : DAL_NW(s),
#if DAL_WITH(GAUGE_GRADIENT)
        {method, s->h, q, v, of_gauge, w, of_gauge + DAL_STAGES(method),
         of_gauge + 3 * DAL_STAGES(method)},
        of_gauge + 2 * DAL_STAGES(method),
        dal_all() & 0
#endif
    };
    DAL_EQUATION(s, eq, 1 + DAL_LIFTED(s), &k, derivatives, momenta);
    eq.cost = dal_cost_of_newton(s, DAL_STAGES(method), DAL_PER_GROUP(DAL_NW(s)),
                                 dal__eigensystem_of(method));
    eq.block[0].weight = eq.block[1].weight = fabs(s->h);
    dal_set_speeds(s, &eq.block[0], DAL_NW(s));
    DAL_EACH_GROUP(j) eq.block[0].progress[j].scale = dal_velocity_scale(s, s->h, j);
    if (DAL_LIFTED(s)) {
        dal__gauge_stages(s, &k);
        DAL_EACH(i, DAL_STAGES(method) * (1 + DAL_EFFORT(s)) * DAL_N(s)) force[i] = dal_num(0.0);
#if DAL_WITH(GAUGE_GRADIENT)
        DAL_EACH(i, DAL_GAUGE(s) * DAL_STAGES(method)) k.mu[i] = k.rate[i] = dal_num(0.0);
#endif
        eq.block[1].progress->scale = dal_momentum_scale(s, s->h, 0);
    }
    if (dal_failed(guess == DAL__FROM_PREDICTOR ? dal__solve_predicted(s, &k, &eq)
                                                : dal__solve_stages(s, &k, &eq)))
        return DAL_STATUS_NOT_CONVERGED;
#if DAL_WITH(GAUGE_GRADIENT)
    if (DAL_GAUGE(s)) {
        s->unconverged |= s->alive & k.unsolved;
        s->alive &= ~k.unsolved;
    }
#endif
    dal__save_derivatives(s, &k, &eq);
    return dal__collocation_end(s, &k, &eq);
}

#ifdef DAL_SPECIALISED
/* The rare case is a function of its own, so that the usual one fits into registers. */
DAL_COLD dal_status dal__collocate_again(dal_step *s, const dal_tableau *method)
{
    return dal__collocate(s, method, DAL__FROM_ANY_GUESS);
}

DAL_SHARED dal_status dal_collocation(dal_step *s, const dal_tableau *method)
{
    const long long evaluations = s->evaluations;
    if (dal__collocate(s, method, DAL__FROM_PREDICTOR) == DAL_STATUS_OK) return DAL_STATUS_OK;
    s->evaluations = evaluations;
    dal_step again = *s;
    const dal_status status = dal__collocate_again(&again, method);
    *s = again;
    return status;
}
#else
DAL_SHARED dal_status dal_collocation(dal_step *s, const dal_tableau *method)
{
    return dal__collocate(s, method, DAL__FROM_ANY_GUESS);
}
#endif
#endif

#endif
