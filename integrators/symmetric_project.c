/* symmetric_project.c - the modifier NAME+symmetric-project: D = 0 by a reaction before and
 * after every step, for a symmetric method.
 *
 *     v^ = v0 + B0 mu,   (q1, v~) = step of NAME from (q0, v^),   v1 = v~ + B1 mu
 *     D(q1, v1, t1) = 0;      B = W^-1 A^T,  B0 at (q0, v0, t0),  B1 at (q1, v1, t1)
 *
 * solved for mu and v1 by Newton's method with the frozen derivative 2 A B, to stagnation.
 * E. Hairer, BIT 40 (2000) 726, here in the metric of the masses and for v alone.  Keeps symmetry,
 * order and every D; p = pi = pi_e = 0, and symplecticity on the lift is lost (project.c). */
#include <dalembert_kernel.h>

typedef struct reflection {
    double t0;
    num *y0, *r0, *method_state0; /* all of the run where the step began */
    num *B0;                      /* [n*m] */
    num *inverse;                 /* [m*m] of 2 A0 B0 */
    num *out;                     /* [m + m*n + n*m] D, A, B */
    num *push;                    /* [n] B mu */
    num *shift;                   /* [m] */
    dal_mask failed;              /* lanes that NAME could not step */
    dal_status status;
} reflection;

/* v += B mu */
DAL_INLINE void push_velocity(dal_step *s, const reflection *k, const num *B, const num *mu)
{
    dal_multiply(B, DAL_N(s), DAL_M(s), mu, k->push);
    dal_add(s, DAL_N(s), DAL_N(s), k->push);
}

/* The step of NAME from (q0, v0 + B0 mu), in the active lanes. */
DAL_INLINE void step_inside(dal_step *s, reflection *k, const num *mu, dal_mask active)
{
    const dal_mask alive = s->alive;
    const dal_mask unconverged = s->unconverged;
    DAL_EACH(i, DAL_DIM(s)) s->y[i] = dal_select(active, k->y0[i], s->y[i]);
    DAL_EACH(i, DAL_DIM(s)) s->r[i] = dal_select(active, k->r0[i], s->r[i]);
    dal_restore_method_state(s, active, k->method_state0);
    s->t = k->t0;
    s->alive = active;
    push_velocity(s, k, k->B0, mu);
    const dal_status status = dal_inner(s, s->h);
    if (status != DAL_STATUS_OK && status != DAL_STATUS_NOT_CONVERGED) k->status = status;
    k->failed = active & ~s->alive;
    s->t = k->t0 + s->h;
    s->alive = alive;
    s->unconverged = unconverged;
}

DAL_INLINE void reflection_map(dal_step *s, dal_equation *eq)
{
    reflection *k = (reflection *)eq->context;
    const int n = DAL_N(s), m = DAL_M(s);
    const num *mu = eq->block[0].u, *v1 = eq->block[1].u, *v = s->y + n;
    const dal_mask alive = s->alive;
    step_inside(s, k, mu, eq->active);
    s->alive = eq->active;
    dal_eval(s, DAL_EVAL_CONSTRAINT, s->t, s->y, v1, NULL, k->out);
    push_velocity(s, k, k->out + m + m * n, mu);
    dal_eval(s, DAL_EVAL_CONSTRAINT, s->t, s->y, v, NULL, k->out);
    dal_multiply(k->inverse, m, m, k->out, k->shift);
    DAL_EACH(a, m) eq->block[0].image[a] = dal_select(k->failed, dal_num(NAN), mu[a] - k->shift[a]);
    DAL_EACH(i, n) eq->block[1].image[i] = v[i];
    s->alive = alive;
}

/* All that a step from here may change, and the constraint here. */
DAL_INLINE void begin_reflection(dal_step *s, reflection *k, dal_equation *eq)
{
    const int n = DAL_N(s), m = DAL_M(s);
    const num *A = k->out + m, *B = A + m * n;
    DAL_VECTOR(s, g, DAL_M(s) * DAL_M(s));
    DAL_EACH(i, DAL_DIM(s)) k->y0[i] = s->y[i];
    DAL_EACH(i, DAL_DIM(s)) k->r0[i] = s->r[i];
    dal_save_method_state(s, k->method_state0);
    dal_eval(s, DAL_EVAL_CONSTRAINT, s->t, s->y, s->y + n, NULL, k->out);
    DAL_EACH(i, n * m) k->B0[i] = B[i];
    dal_gram(A, B, m, n, g);
    DAL_EACH(i, m * m) g[i] = 2.0 * g[i];
    dal_invert_in_units(g, k->inverse, m, DAL_LEVELS(s), m);
    num norm = dal_num(0.0);
    DAL_EACH(i, n) norm = dal_max(norm, dal_in_units(dal_max_norm(B + i * m, m), DAL_SPEEDS(s), i));
    dal_set_speeds(s, &eq->block[1], n);
    eq->block[1].progress->scale = dal_velocity_scale(s, s->h, 0);
    eq->block[0].progress->scale = eq->block[1].progress->scale / norm;
    DAL_EACH(a, m) eq->block[0].u[a] = dal_num(0.0);
    DAL_EACH(i, n) eq->block[1].u[i] = s->y[n + i];
}

DAL_INLINE dal_status reflect(dal_step *s)
{
    DAL_VECTOR(s, y0, DAL_DIM(s));
    DAL_VECTOR(s, r0, DAL_DIM(s));
    DAL_VECTOR(s, method_state0, DAL_METHOD_STATE(s));
    DAL_VECTOR(s, B0, DAL_N(s) * DAL_M(s));
    DAL_VECTOR(s, inverse, DAL_M(s) * DAL_M(s));
    DAL_VECTOR(s, out, DAL_M(s) + 2 * DAL_M(s) * DAL_N(s));
    DAL_VECTOR(s, push, DAL_N(s));
    DAL_VECTOR(s, shift, DAL_M(s));
    DAL_BLOCK(s, mu, DAL_M(s), 0);
    DAL_BLOCK(s, v1, DAL_N(s), 0);
    reflection k = {s->t, y0,   r0,    method_state0, B0,           inverse,
                    out,  push, shift, ~dal_all(),    DAL_STATUS_OK};
    DAL_EQUATION(s, eq, 2, &k, mu, v1);
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
    "$\\Phi_h$ (Hairer 2000), in the metric of the masses:\n"                                      \
    "$$(q_1, \\tilde v) = \\Phi_h\\left(q_0,\\, v_0 + B_0\\,\\mu\\right), \\qquad v_1 = \\tilde"   \
    " v + B_1\\,\\mu, \\qquad D(q_1, v_1) = 0, \\qquad B = W^{-1} A^T.$$\n"                        \
    "The order and the symmetry of the method inside stay; every $D$ is preserved. "               \
    "Symplecticity on the lift is lost."

DAL_INTEGRATOR(symmetric_project, step, .name = "symmetric-project",
               .summary = "a reaction before and after each step, so that D = 0; p = pi = pi_e = 0",
               .reference = "Hairer 2000", .documentation = ABOUT_SYMMETRIC_PROJECT, .stages = 1,
               .properties = DAL_MODIFIER | DAL_SYMMETRIC | DAL_PRESERVES_D,
               .needs = DAL_NEEDS_CONSTRAINT | DAL_NEEDS_SYMMETRIC,
               .kernel = DAL_KERNEL_SOLVE | DAL_KERNEL_CONSTRAINT | DAL_KERNEL_METHOD_STATE,
               .inherits = DAL_PRESERVES_BILINEAR | DAL_PRESERVES_QUADRATIC);
