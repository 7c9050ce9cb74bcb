/* symmetric_project.c - the modifier NAME+symmetric-project: g = 0 and D = 0 by a reaction before
 * and after every step, for a symmetric method.
 *
 *     v^ = v0 + B0 mu,   (q1, v~) = step of NAME from (q0, v^),   v1 = v~ + B1 mu
 *     D(q1, v1, t1) = 0;      B = W^-1 A^T,  B0 at (q0, v0, t0),  B1 at (q1, v1, t1)
 *
 * solved by Newton's method, to stagnation.  With W x = A^T l and D + A (v~ + x - v1) = 0 at the
 * last (q1, v1) the next v1 is v~ + x, and the next mu is (mu + l)/2, by the derivative 2 A B of D.
 * Where there are holonomic constraints g(q, t) = 0, and their B^ among the columns of B,
 *
 *     q^ = q0 + h B^0 nu,   q1 = q~ + h B^1 nu,   g(q1, t1) = 0
 *
 * with B1 at (q1, v1, t1), and v^ = v0 + B0 mu from (q^, v^) as above; nu with the frozen
 * derivative 2 h G B^.
 * E. Hairer, BIT 40 (2000) 726, here in the metric of the masses, for v alone without g.  Keeps
 * symmetry, order, every g and every D; p = pi = pi_e = 0, and symplecticity on the lift is lost
 * (project.c). */
#include <dalembert_kernel.h>

typedef struct reflection {
    double t0;
    num *y0, *r0, *method_state0; /* all of the run where the step began */
    num *mu;                      /* [m + 1] of a lane's last iteration, and 0 */
    num *in, *out;                /* of DAL_EVAL_ENFORCEMENT */
    num *nu;                      /* [m + 1] 0, and [holonomic] before the last 0: likewise */
    num *q1, *g;                  /* [n] of the last iteration, [m + 1] 0, and g there likewise */
    num *place;                   /* of DAL_EVAL_POSITION */
    dal_mask failed;              /* lanes that NAME could not step */
    dal_status status;
} reflection;

/* The step of NAME from (q0 + h push^, v0 + push), in the active lanes; push^ after push. */
DAL_INLINE void step_inside(dal_step *s, reflection *k, const num *push, dal_mask active)
{
    const dal_mask alive = s->alive;
    const dal_mask unconverged = s->unconverged;
    DAL_EACH(i, DAL_DIM(s)) s->y[i] = dal_select(active, k->y0[i], s->y[i]);
    DAL_EACH(i, DAL_DIM(s)) s->r[i] = dal_select(active, k->r0[i], s->r[i]);
    dal_restore_method_state(s, active, k->method_state0);
    s->t = k->t0;
    s->alive = active;
    if (DAL_HOLONOMIC(s) > 0) dal_add_multiple(s, 0, DAL_N(s), s->h, push + DAL_N(s));
    dal_add(s, DAL_N(s), DAL_N(s), push);
    const dal_status status = dal_inner(s, s->h);
    if (status != DAL_STATUS_OK && status != DAL_STATUS_NOT_CONVERGED) k->status = status;
    k->failed = active & ~s->alive;
    s->t = k->t0 + s->h;
    s->alive = alive;
    s->unconverged = unconverged;
}

#if DAL_WITH(HOLONOMIC)
/* Moves q by h B^1 nu, and gives the images of B^0 nu and of the change of q over h; the next nu by
 * the derivative 2 h G B^ of g at the start. */
DAL_INLINE void reflect_position(dal_step *s, reflection *k, dal_equation *eq)
{
    const int n = DAL_N(s), holonomic = DAL_HOLONOMIC(s), first = DAL_M(s) - holonomic;
    num *const push = eq->block[0].image + n, *const nu = k->nu + first;
    const num *v1 = eq->block[1].u, *l = k->place + n;
    DAL_EACH(i, n) k->q1[i] = k->y0[i] + s->h * v1[n + i];
    dal_eval(s, DAL_EVAL_REACTION, s->t, k->q1, v1, k->nu, k->place);
    dal_add_multiple(s, 0, n, s->h, k->place);
    dal_eval(s, DAL_EVAL_HOLONOMIC, s->t, s->y, v1, NULL, k->g + first);
    dal_eval(s, DAL_EVAL_POSITION, k->t0, k->y0, k->y0 + n, k->g, k->place);
    DAL_EACH(j, holonomic) nu[j] = DAL_IF_ACTIVE(eq->active, nu[j] - l[j] / (2.0 * s->h), nu[j]);
    dal_eval(s, DAL_EVAL_REACTION, k->t0, k->y0, k->y0 + n, k->nu, push);
    DAL_EACH(i, n) push[i] = dal_select(k->failed, dal_num(NAN), push[i]);
    DAL_EACH(i, n) eq->block[1].image[n + i] = (s->y[i] - k->y0[i]) / s->h;
}
#endif

/* The unknowns are B0 mu and v1; of holonomic constraints also B^0 nu and (q1 - q0)/h. */
DAL_INLINE void reflection_map(dal_step *s, dal_equation *eq)
{
    reflection *k = (reflection *)eq->context;
    const int n = DAL_N(s), m = DAL_M(s);
    const num *v1 = eq->block[1].u, *v = s->y + n, *x = k->out, *l = k->out + n;
    num *const push = eq->block[0].image, *const c = k->in + n;
    const dal_mask alive = s->alive;
    step_inside(s, k, eq->block[0].u, eq->active);
    s->alive = eq->active;
#if DAL_WITH(HOLONOMIC)
    if (DAL_HOLONOMIC(s) > 0) reflect_position(s, k, eq);
#endif
    DAL_EACH(i, n) k->in[i] = v1[i] - v[i];
    dal_constraint_value(s, s->t, s->y, v1, c);
    DAL_EACH(a, m) c[a] = -c[a];
    c[m] = dal_num(0.0);
    dal_eval(s, DAL_EVAL_ENFORCEMENT, s->t, s->y, v1, k->in, k->out);
    dal_add(s, n, n, x);
    DAL_EACH(a, m) k->mu[a] = DAL_IF_ACTIVE(eq->active, 0.5 * (k->mu[a] + l[a]), k->mu[a]);
    dal_eval(s, DAL_EVAL_REACTION, k->t0, k->y0, k->y0 + n, k->mu, push);
    DAL_EACH(i, n) push[i] = dal_select(k->failed, dal_num(NAN), push[i]);
    DAL_EACH(i, n) eq->block[1].image[i] = v[i];
    s->alive = alive;
}

/* All that a step from here may change. */
DAL_INLINE void begin_reflection(dal_step *s, reflection *k, dal_equation *eq)
{
    const int n = DAL_N(s);
    DAL_EACH(i, DAL_DIM(s)) k->y0[i] = s->y[i];
    DAL_EACH(i, DAL_DIM(s)) k->r0[i] = s->r[i];
    dal_save_method_state(s, k->method_state0);
    DAL_EACH(a, DAL_M(s) + 1) k->mu[a] = k->nu[a] = k->g[a] = dal_num(0.0);
    for (int b = 0; b < 2; b++) {
        dal_set_speeds(s, &eq->block[b], n);
        eq->block[b].progress->scale = dal_velocity_scale(s, s->h, 0);
    }
    DAL_EACH(i, eq->block[0].size) eq->block[0].u[i] = dal_num(0.0);
    DAL_EACH(i, eq->block[1].size) eq->block[1].u[i] = s->y[n + i % n];
}

DAL_INLINE dal_status reflect(dal_step *s)
{
    DAL_VECTOR(s, y0, DAL_DIM(s));
    DAL_VECTOR(s, r0, DAL_DIM(s));
    DAL_VECTOR(s, method_state0, DAL_METHOD_STATE(s));
    DAL_VECTOR(s, mu, DAL_M(s) + 1);
    DAL_VECTOR(s, in, DAL_N(s) + DAL_M(s) + 1);
    DAL_VECTOR(s, out, DAL_N(s) + DAL_M(s));
    DAL_VECTOR(s, nu, DAL_M(s) + 1);
    DAL_VECTOR(s, q1, DAL_N(s));
    DAL_VECTOR(s, g, DAL_M(s) + 1);
    DAL_VECTOR(s, place, DAL_N(s) + DAL_HOLONOMIC(s));
    DAL_BLOCK(s, push, DAL_HOLONOMIC(s) > 0 ? 2 * DAL_N(s) : DAL_N(s), 0);
    DAL_BLOCK(s, v1, DAL_HOLONOMIC(s) > 0 ? 2 * DAL_N(s) : DAL_N(s), 0);
    reflection k = {s->t, y0, r0, method_state0, mu,         in,           out,
                    nu,   q1, g,  place,         ~dal_all(), DAL_STATUS_OK};
    DAL_EQUATION(s, eq, 2, &k, push, v1);
    begin_reflection(s, &k, &eq);
    const dal_status status = dal_solve(s, &eq, reflection_map, NULL);
    return k.status == DAL_STATUS_OK ? status : k.status;
}

DAL_INLINE dal_status step(dal_step *s)
{
    dal_clear_momenta(s);
    return DAL_M(s) > 0 ? reflect(s) : dal_inner(s, s->h);
}

#define ABOUT_SYMMETRIC_PROJECT                                                                    \
    "A reaction with the same multipliers before and after a step of a symmetric method "          \
    "$\\Phi_h$ (Hairer 2000), in the metric of the masses, of $v$ alone and, for holonomic "       \
    "constraints $g = 0$, of $q$ as well:\n"                                                       \
    "$$(q_1, \\tilde v) = \\Phi_h\\left(q_0,\\, v_0 + B_0\\,\\mu\\right), \\qquad v_1 = \\tilde"   \
    " v + B_1\\,\\mu, \\qquad D(q_1, v_1) = 0, \\qquad B = W^{-1} A^T.$$\n"                        \
    "The order and the symmetry of the method inside stay; every $g$ and $D$ is preserved. "       \
    "Symplecticity on the lift is lost."

DAL_INTEGRATOR(
    symmetric_project, step, .name = "symmetric-project",
    .summary = "a reaction before and after each step, so that g = D = 0; p = pi = pi_e = 0",
    .reference = "Hairer 2000", .documentation = ABOUT_SYMMETRIC_PROJECT, .stages = 1,
    .properties = DAL_MODIFIER | DAL_SYMMETRIC | DAL_PRESERVES_D | DAL_PRESERVES_HOLONOMIC,
    .needs = DAL_NEEDS_CONSTRAINT | DAL_NEEDS_SYMMETRIC,
    .kernel = DAL_KERNEL_SOLVE | DAL_KERNEL_ENFORCEMENT | DAL_KERNEL_REACTION |
              DAL_KERNEL_METHOD_STATE,
    .inherits = DAL_PRESERVES_BILINEAR | DAL_PRESERVES_QUADRATIC);
