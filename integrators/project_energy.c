/* project_energy.c - the modifier NAME+project-energy: back to D = 0, to the energy E0 of the start
 * and to p = pi = pi_e = 0 after every step.
 *
 *     (q, v, t1) = step of NAME
 *     q1 = q - h^2 k N,   v1 = v - k v - B c,     D(q1, v1, t1) = 0,   E(q1, v1) = E0
 *     B = W^-1 A^T,  N = W^-1 E_q,  at (q, v, t1);       v is W^-1 E_v
 *
 * along the directions of E and D in the metric of the masses, with h as the unit of time between q
 * and v: with v alone E could not be mended where the motion turns round.  Newton's method to
 * stagnation, without what D does with q, which is of order h^2.  An iteration is
 *
 *     v <- v + x - k (v0 - w),   q <- q - h^2 k N0,    W x = A^T l, A x = -D at (q, v),
 *     k = (E - E0 + E_v.x)/(E_v.(v0 - w) + h^2 E_q.N0)
 *
 * where A w = A v0, W w = A^T l, so that v0 - w keeps D; w and the denominator are frozen at
 * (q0, v0), what the step of NAME left.
 *
 * Hairer, Lubich, Wanner, Geometric Numerical Integration (2006), IV.4.  Keeps the order, every D,
 * and E where it is a constant of the motion; loses symmetry, and, as in project.c,
 * symplecticity on the lift. */
#include <dalembert_kernel.h>

typedef struct level {
    num *q0, *v0; /* [n] what the step left */
    num *q, *v;   /* [n] */
    num *energy;  /* [1 + 3n] E, E_q, E_v, N */
    num *along;   /* [n] of v: v0 - w */
    num *normal;  /* [n] of q/h: h N0 */
    num *x;       /* [n] */
    num *rate;    /* [1] what k is divided by */
} level;

DAL_INLINE void level_map(dal_step *s, dal_equation *eq)
{
    level *k = (level *)eq->context;
    const int n = DAL_N(s);
    const num *u = eq->block[0].u;
    num *const image = eq->block[0].image;
    DAL_EACH(i, n) k->v[i] = k->v0[i] + u[i];
    DAL_EACH(i, n) k->q[i] = k->q0[i] + s->h * u[n + i];
    dal_eval(s, DAL_EVAL_ENERGY_NORMAL, s->t, k->q, k->v, NULL, k->energy);
    if (DAL_M(s) > 0) dal_eval(s, DAL_EVAL_CORRECTION, s->t, k->q, k->v, NULL, k->x);
    const num excess = k->energy[0] - s->level[0] + dal_scalar_product(k->energy + 1 + n, k->x, n);
    const num share = excess / *k->rate;
    DAL_EACH(i, n) image[i] = u[i] + (k->x[i] - share * k->along[i]);
    DAL_EACH(i, n) image[n + i] = u[n + i] - share * k->normal[i];
}

/* v0 - w. */
DAL_INLINE void find_direction(dal_step *s, level *k)
{
    const int n = DAL_N(s), m = DAL_M(s);
    DAL_EACH(i, n) k->along[i] = k->v0[i];
    if (m == 0) return;
    DAL__MARK(s);
    DAL_VECTOR(s, in, DAL_N(s) + DAL_M(s) + 1);
    DAL_VECTOR(s, out, DAL_N(s) + DAL_M(s));
    DAL_EACH(i, n) in[i] = k->v0[i];
    DAL_EACH(a, m + 1) in[n + a] = dal_num(0.0);
    dal_eval(s, DAL_EVAL_ENFORCEMENT, s->t, k->q0, k->v0, in, out);
    DAL_EACH(i, n) k->along[i] -= out[i];
    DAL__RELEASE(s);
}

/* The size of v, and of q/h, against which rounding in them and in E is small. */
DAL_INLINE num level_scale(const dal_step *s, const level *k, num whole)
{
    const num weight = dal_abs(s->level[0] / whole);
    return dal_velocity_scale(s, s->h, 0) +
           weight * (dal_speed_norm(s, k->v0) + dal_speed_norm(s, k->normal));
}

DAL_INLINE void freeze_directions(dal_step *s, level *k, dal_equation *eq)
{
    const int n = DAL_N(s);
    const num *Eq = k->energy + 1, *Ev = Eq + n, *N = Ev + n;
    DAL_EACH(i, n) {
        k->q0[i] = s->y[i];
        k->v0[i] = s->y[n + i];
        k->x[i] = eq->block[0].u[i] = eq->block[0].u[n + i] = dal_num(0.0);
    }
    dal_eval(s, DAL_EVAL_ENERGY_NORMAL, s->t, k->q0, k->v0, NULL, k->energy);
    find_direction(s, k);
    DAL_EACH(i, n) k->normal[i] = s->h * N[i];
    const num of_q = s->h * dal_scalar_product(Eq, k->normal, n);
    *k->rate = dal_scalar_product(Ev, k->along, n) + of_q;
    eq->block[0].progress->scale = level_scale(s, k, dal_scalar_product(Ev, k->v0, n) + of_q);
}

DAL_INLINE dal_status to_level(dal_step *s)
{
    DAL_VECTOR(s, q0, DAL_N(s));
    DAL_VECTOR(s, v0, DAL_N(s));
    DAL_VECTOR(s, q, DAL_N(s));
    DAL_VECTOR(s, v, DAL_N(s));
    DAL_VECTOR(s, energy, 1 + 3 * DAL_N(s));
    DAL_VECTOR(s, along, DAL_N(s));
    DAL_VECTOR(s, normal, DAL_N(s));
    DAL_VECTOR(s, x, DAL_N(s));
    DAL_VECTOR(s, rate, 1);
    DAL_BLOCK(s, change, 2 * DAL_N(s), 0); /* of v and of q/h */
    level k = {q0, v0, q, v, energy, along, normal, x, rate};
    DAL_EQUATION(s, eq, 1, &k, change);
    dal_set_speeds(s, &eq.block[0], DAL_N(s));
    freeze_directions(s, &k, &eq);
    if (dal_failed(dal_solve(s, &eq, level_map, NULL))) return DAL_STATUS_NOT_CONVERGED;
    DAL_EACH(i, DAL_N(s)) q[i] = s->h * eq.block[0].u[DAL_N(s) + i];
    dal_add(s, 0, DAL_N(s), q);
    dal_add(s, DAL_N(s), DAL_N(s), eq.block[0].u);
    return DAL_STATUS_OK;
}

/* level: E0 and, once it is known, 1. */
DAL_INLINE void note_energy(dal_step *s)
{
    const dal_mask fresh = s->alive & dal_less(s->level[1], dal_num(0.5));
    DAL_VECTOR(s, energy, 1 + 3 * DAL_N(s));
    if (!dal_any(fresh)) return;
    dal_eval(s, DAL_EVAL_ENERGY_NORMAL, s->t, s->y, s->y + DAL_N(s), NULL, energy);
    s->level[0] = dal_select(fresh, energy[0], s->level[0]);
    s->level[1] = dal_select(fresh, dal_num(1.0), s->level[1]);
}

DAL_INLINE dal_status step(dal_step *s)
{
    note_energy(s);
    const dal_status status = dal_inner(s, s->h);
    if (dal_failed(status)) return status;
    if (dal_failed(to_level(s))) return DAL_STATUS_NOT_CONVERGED;
    dal_clear_momenta(s);
    return DAL_STATUS_OK;
}

#define ABOUT_PROJECT_ENERGY                                                                       \
    "After each step back to $D = 0$ and to the energy of the start, along the directions of "     \
    "both in the metric of the masses:\n"                                                          \
    "$$q_1 = q - h^2 k\\,W^{-1} E_q, \\qquad v_1 = v - k\\,v - W^{-1} A^T c, \\qquad D(q_1, "      \
    "v_1) = 0, \\quad E(q_1, v_1) = E_0$$\n"                                                       \
    "(Hairer, Lubich, Wanner 2006, IV.4). The order stays what it was; every $D$ is preserved, "   \
    "and $E$ where the motion conserves it. Symmetry and symplecticity on the lift are lost. A "   \
    "right $E$ says nothing about the error of the motion."

DAL_INTEGRATOR(project_energy, step, .name = "project-energy",
               .summary = "after each step back to D = 0, E = E(0), p = pi = pi_e = 0",
               .reference = "Hairer, Lubich, Wanner 2006, IV.4",
               .documentation = ABOUT_PROJECT_ENERGY, .stages = 1,
               .properties = DAL_MODIFIER | DAL_PRESERVES_D | DAL_PRESERVES_ENERGY,
               .needs = DAL_NEEDS_CONSTRAINT | DAL_NEEDS_ENERGY,
               .kernel = DAL_KERNEL_SOLVE | DAL_KERNEL_CORRECTION | DAL_KERNEL_ENFORCEMENT |
                         DAL_KERNEL_ENERGY_NORMAL,
               .inherits = DAL_PRESERVES_BILINEAR | DAL_PRESERVES_QUADRATIC | DAL_EXPLICIT |
                           DAL_ADAPTIVE);
