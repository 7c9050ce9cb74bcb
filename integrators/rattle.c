/* rattle.c - RATTLE for g = 0 and D = 0, with one multiplier of D for both halves of a step.
 *
 *     v^ = v0 + h/2 W^-1 (f0 + G0^T lambda + A0^T eta),   q1 = q0 + h v^,   g(q1, t1) = 0
 *     v1 = v^ + h/2 W^-1 (f1 + G1^T mu + A1^T eta),   D(q1, v1, t1) = 0,   G1 v1 + g_t(q1, t1) = 0
 *
 * with G = g_q, A = D_v of the other constraints, and f the forces without reactions, at (q0, v0)
 * and at (q1, v1); W is constant.  There are as many unknowns as equations, and no multiplier is
 * carried to the next step.  Exchanging 0 and 1, lambda and mu, and the sign of h gives the same
 * equations: symmetric, of order 2.  Preserves every g and D.  Without A this is RATTLE (Andersen,
 * J. Comput. Phys. 52 (1983) 24), symplectic on g = 0; with lambda_1 in place of eta at the end it
 * is gni.c.
 *
 * The increments v^ - v0 and v1 - v0 are iterated.  The new ones have the forces and reactions at
 * the last points, and a change of the multipliers by which g, D and G v + g_t vanish to first
 * order with G, A at the end: where all D are
 *
 *     W y = G^T x_G + A^T x_A,   (G, A) y = -2/h D,        W z = G^T e,   G z = -2/h^2 g + D_G/h,
 *
 * eta changes by x_A/2, lambda by x_G/2 + e, and mu by x_G/2 - e.  It contracts like h. */
#include <dalembert_kernel.h>

typedef struct rattle_step {
    num *q1, *v1;        /* [n] the end */
    num *pull;           /* [n] W^-1 times forces and reactions */
    num *first, *second; /* [m + 1] (eta, lambda) and (eta, mu) of a lane's last iteration, 1 */
    num *g;              /* [m + 1] what is left of g, at the places of lambda */
    num *in, *out;       /* of DAL_EVAL_ENFORCEMENT */
    num *place;          /* of DAL_EVAL_POSITION */
} rattle_step;

DAL_INLINE void place_end(const dal_step *s, const rattle_step *k, const num *w)
{
    const int n = DAL_N(s);
    DAL_EACH(i, n) k->q1[i] = dal_moved_q(s, i, s->h * dal_moved_v(s, i, w[i]));
    DAL_EACH(i, n) k->v1[i] = dal_moved_v(s, i, w[n + i]);
}

#if DAL_WITH(HOLONOMIC)
/* z and e, with the D of the end in k->in. */
DAL_INLINE void enforce_position(dal_step *s, const rattle_step *k)
{
    const int n = DAL_N(s), m = DAL_M(s), first = m - DAL_HOLONOMIC(s);
    const double scale = -2.0 / (s->h * s->h), half = -0.5;
    num *const g = k->g + first;
    const num *D = k->in + n + first;
    dal_eval(s, DAL_EVAL_HOLONOMIC, s->t + s->h, k->q1, k->v1, NULL, g);
    DAL_EACH(j, DAL_HOLONOMIC(s)) g[j] = scale * g[j] + half * D[j];
    dal_eval(s, DAL_EVAL_POSITION, s->t + s->h, k->q1, k->v1, k->g, k->place);
}

DAL_INLINE void change_reactions(dal_step *s, const rattle_step *k, dal_equation *eq)
{
    num *const image = eq->block[0].image;
    const int n = DAL_N(s), first = DAL_M(s) - DAL_HOLONOMIC(s);
    const num *z = k->place, *e = k->place + n;
    DAL_EACH(i, n) image[i] += 0.5 * s->h * z[i];
    DAL_EACH(j, DAL_HOLONOMIC(s)) {
        num *const lambda = k->first + first + j, *const mu = k->second + first + j;
        *lambda = DAL_IF_ACTIVE(eq->active, *lambda + e[j], *lambda);
        *mu = DAL_IF_ACTIVE(eq->active, *mu - e[j], *mu);
    }
}
#endif

DAL_INLINE void rattle_map(dal_step *s, dal_equation *eq)
{
    const rattle_step *k = (const rattle_step *)eq->context;
    const int n = DAL_N(s), m = DAL_M(s);
    const double h = s->h, end = s->t + h;
    const num *y = k->out, *x = k->out + n;
    num *const image = eq->block[0].image;
    place_end(s, k, eq->block[0].u);
    s->evaluations += 2;
    dal_eval(s, DAL_EVAL_REACTION, s->t, s->y, s->y + n, k->first, k->pull);
    DAL_EACH(i, n) image[i] = 0.5 * h * k->pull[i];
    dal_eval(s, DAL_EVAL_REACTION, end, k->q1, k->v1, k->second, k->pull);
    DAL_EACH(i, n) image[n + i] = image[i] + 0.5 * h * k->pull[i];
    if (m == 0) return;
    place_end(s, k, image);
    dal_constraint_value(s, end, k->q1, k->v1, k->in + n);
    DAL_EACH(a, m) k->in[n + a] *= -2.0 / h;
    dal_eval_enforcement(s, end, k->q1, k->v1, k->in, k->out);
#if DAL_WITH(HOLONOMIC)
    if (DAL_HOLONOMIC(s) > 0) {
        enforce_position(s, k);
        change_reactions(s, k, eq);
    }
#endif
    DAL_EACH(i, n) image[i] += 0.25 * h * y[i];
    DAL_EACH(i, n) image[n + i] += 0.5 * h * y[i];
    DAL_EACH(a, m) {
        k->first[a] = DAL_IF_ACTIVE(eq->active, k->first[a] + 0.5 * x[a], k->first[a]);
        k->second[a] = DAL_IF_ACTIVE(eq->active, k->second[a] + 0.5 * x[a], k->second[a]);
    }
}

/* The first guess: F for all accelerations, with its multipliers. */
DAL_INLINE void rattle_begin(dal_step *s, const rattle_step *k, dal_block *block)
{
    const int n = DAL_N(s), m = DAL_M(s);
    dal_motion_multipliers(s, k->in, k->out);
    DAL_EACH(i, m) k->first[i] = k->second[i] = k->out[n + i];
    k->first[m] = k->second[m] = dal_num(1.0);
    DAL_EACH(i, n) {
        block->u[i] = 0.5 * s->h * k->in[i];
        block->u[n + i] = s->h * k->in[i];
    }
    DAL_EACH(i, n + m + 1) k->in[i] = dal_num(0.0);
    DAL_EACH(i, m + 1) k->g[i] = dal_num(0.0);
}

DAL_INLINE dal_status step(dal_step *s)
{
    const int n = DAL_N(s);
    DAL_VECTOR(s, q1, DAL_N(s));
    DAL_VECTOR(s, v1, DAL_N(s));
    DAL_VECTOR(s, pull, DAL_N(s));
    DAL_VECTOR(s, first, DAL_M(s) + 1);
    DAL_VECTOR(s, second, DAL_M(s) + 1);
    DAL_VECTOR(s, g, DAL_M(s) + 1);
    DAL_VECTOR(s, in, DAL_N(s) + DAL_M(s) + 1);
    DAL_VECTOR(s, out, DAL_N(s) + DAL_M(s));
    DAL_VECTOR(s, place, DAL_N(s) + DAL_HOLONOMIC(s));
    DAL_VECTOR(s, d, DAL_DIM(s));
    DAL_BLOCK(s, block, 2 * DAL_N(s), 0);
    rattle_step k = {q1, v1, pull, first, second, g, in, out, place};
    DAL_EQUATION(s, eq, 1, &k, block);
    dal_set_speeds(s, &eq.block[0], n);
    eq.block[0].progress->scale = dal_velocity_scale(s, s->h, 0);
    rattle_begin(s, &k, &eq.block[0]);
    if (dal_failed(dal_solve(s, &eq, rattle_map, NULL))) return DAL_STATUS_NOT_CONVERGED;
    DAL_EACH(i, n) d[i] = s->h * dal_moved_v(s, i, eq.block[0].u[i]);
    DAL_EACH(i, n) d[n + i] = eq.block[0].u[n + i];
    return dal_update(s, s->h, d);
}

#define ABOUT_RATTLE                                                                               \
    "RATTLE (Andersen 1983) for holonomic constraints $g(q, t) = 0$ beside $D(q, v, t) = 0$, "     \
    "with the multiplier $\\eta$ of $D$ in both halves of the step:\n"                             \
    "$$\\hat v = v_0 + \\tfrac{h}{2} W^{-1}\\left(f_0 + G_0^T \\lambda + A_0^T \\eta\\right), "    \
    "\\quad q_1 = q_0 + h\\,\\hat v, \\quad v_1 = \\hat v + \\tfrac{h}{2} W^{-1}\\left(f_1 + "     \
    "G_1^T \\mu + A_1^T \\eta\\right),$$\n"                                                        \
    "$$g(q_1, t_1) = 0, \\qquad D(q_1, v_1, t_1) = 0, \\qquad G_1 v_1 + g_t(q_1, t_1) = 0, "       \
    "\\qquad G = g_q, \\quad A = D_v.$$\n"                                                         \
    "Here $f$ are the forces without reactions. The order is 2; the method is symmetric, "         \
    "preserves every $g$ and $D$ and keeps no multipliers from step to step, unlike `gni`. "       \
    "Without $D$ it is symplectic on $g = 0$. $W$ must be constant; `gauss-spark2` takes any."

DAL_INTEGRATOR(rattle, step, .name = "rattle",
               .summary = "RATTLE with one multiplier of D for both halves",
               .reference = "Andersen 1983", .documentation = ABOUT_RATTLE, .order = 2, .stages = 1,
               .properties = DAL_SYMMETRIC | DAL_PRESERVES_D | DAL_PRESERVES_HOLONOMIC,
               .needs = DAL_NEEDS_FIELD | DAL_NEEDS_BLOCKS | DAL_NEEDS_CONSTANT_MASS,
               .kernel = DAL_KERNEL_ENFORCE | DAL_KERNEL_ENFORCEMENT | DAL_KERNEL_REACTION);
