/* symmetric_project.c - the modifier NAME+symmetric-project: g = 0 and D = 0 by a reaction before
 * and after every step, for a symmetric method.
 *
 *     v^ = v0 + B0 mu,   (q1, v~) = step of NAME from (q0, v^),   v1 = v~ + B1 mu
 *     D(q1, v1, t1) = 0;      B = W^-1 A^T,  B0 at (q0, v0, t0),  B1 at (q1, v1, t1)
 *
 * solved for mu and v1 by Newton's method with the frozen derivative 2 A B, to stagnation.  Where
 * there are holonomic constraints g(q, t) = 0, and their B^ among the columns of B,
 *
 *     q^ = q0 + h B^0 nu,   q1 = q~ + h B^1 nu,   g(q1, t1) = 0
 *
 * with B1 at (q1, v1, t1), and v^ = v0 + B0 mu from (q^, v^) as above.
 * E. Hairer, BIT 40 (2000) 726, here in the metric of the masses, for v alone without g.  Keeps
 * symmetry, order, every g and every D; p = pi = pi_e = 0, and symplecticity on the lift is lost
 * (project.c). */
#include <dalembert_kernel.h>

typedef struct reflection {
    double t0;
    num *y0, *r0, *method_state0; /* all of the run where the step began */
    num *B0;                      /* [n*m] */
    num *inverse;                 /* [m*m] of 2 A0 B0 */
    num *inverse_g;               /* [holonomic^2] of 2 h G0 B^0 */
    num *q1;                      /* [n], and g [holonomic]: of the last iteration */
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

/* q += h B^ nu, with the last columns of B */
DAL_INLINE void push_position(dal_step *s, const reflection *k, const num *B, const num *nu)
{
    const int n = DAL_N(s), m = DAL_M(s), holonomic = DAL_HOLONOMIC(s), first = m - holonomic;
    if (holonomic == 0) return;
    DAL_EACH(i, n) k->push[i] = dal_num(0.0);
    DAL_EACH(i, n)
        DAL_EACH(j, holonomic) k->push[i] = dal_fma(B[i * m + first + j], nu[j], k->push[i]);
    dal_add_multiple(s, 0, n, s->h, k->push);
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
    push_position(s, k, k->B0, mu + DAL_M(s));
    push_velocity(s, k, k->B0, mu);
    const dal_status status = dal_inner(s, s->h);
    if (status != DAL_STATUS_OK && status != DAL_STATUS_NOT_CONVERGED) k->status = status;
    k->failed = active & ~s->alive;
    s->t = k->t0 + s->h;
    s->alive = alive;
    s->unconverged = unconverged;
}

#if DAL_WITH(HOLONOMIC)
/* The images of nu and of the change of q over h. */
DAL_INLINE void reflect_position(dal_step *s, const reflection *k, dal_equation *eq)
{
    const int n = DAL_N(s), m = DAL_M(s), holonomic = DAL_HOLONOMIC(s);
    num *const g = k->q1 + n, *const image = eq->block[0].image + m;
    const num *nu = eq->block[0].u + m;
    dal_eval(s, DAL_EVAL_HOLONOMIC, s->t, s->y, s->y + n, NULL, g);
    dal_multiply(k->inverse_g, holonomic, holonomic, g, image);
    DAL_EACH(j, holonomic) image[j] = dal_select(k->failed, dal_num(NAN), nu[j] - image[j]);
    DAL_EACH(i, n) eq->block[1].image[n + i] = (s->y[i] - k->y0[i]) / s->h;
}

/* The inverse of 2 h G B^ at the start, from A B = g. */
DAL_INLINE void invert_positions(dal_step *s, const reflection *k, const num *g)
{
    const int m = DAL_M(s), holonomic = DAL_HOLONOMIC(s), first = m - holonomic;
    DAL_VECTOR(s, own, DAL_HOLONOMIC(s) * DAL_HOLONOMIC(s));
    DAL_EACH(i, holonomic)
        DAL_EACH(j, holonomic) own[i * holonomic + j] = 2.0 * s->h * g[(first + i) * m + first + j];
    dal_invert(own, k->inverse_g, holonomic);
}
#endif

DAL_INLINE void reflection_map(dal_step *s, dal_equation *eq)
{
    reflection *k = (reflection *)eq->context;
    const int n = DAL_N(s), m = DAL_M(s);
    const num *mu = eq->block[0].u, *v1 = eq->block[1].u, *v = s->y + n, *q1 = s->y;
    const dal_mask alive = s->alive;
    step_inside(s, k, mu, eq->active);
    s->alive = eq->active;
    if (DAL_HOLONOMIC(s) > 0) {
        DAL_EACH(i, n) k->q1[i] = k->y0[i] + s->h * v1[n + i];
        q1 = k->q1;
    }
    dal_eval(s, DAL_EVAL_CONSTRAINT, s->t, q1, v1, NULL, k->out);
    push_position(s, k, k->out + m + m * n, mu + m);
    push_velocity(s, k, k->out + m + m * n, mu);
#if DAL_WITH(HOLONOMIC)
    if (DAL_HOLONOMIC(s) > 0) reflect_position(s, k, eq);
#endif
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
#if DAL_WITH(HOLONOMIC)
    if (DAL_HOLONOMIC(s) > 0) invert_positions(s, k, g);
#endif
    DAL_EACH(i, m * m) g[i] = 2.0 * g[i];
    dal_invert_in_units(g, k->inverse, m, DAL_LEVELS(s), m);
    num norm = dal_num(0.0);
    DAL_EACH(i, n) norm = dal_max(norm, dal_in_units(dal_max_norm(B + i * m, m), DAL_SPEEDS(s), i));
    dal_set_speeds(s, &eq->block[1], n);
    eq->block[1].progress->scale = dal_velocity_scale(s, s->h, 0);
    eq->block[0].progress->scale = eq->block[1].progress->scale / norm;
    DAL_EACH(a, eq->block[0].size) eq->block[0].u[a] = dal_num(0.0);
    DAL_EACH(i, eq->block[1].size) eq->block[1].u[i] = s->y[n + i % n];
}

DAL_INLINE dal_status reflect(dal_step *s)
{
    DAL_VECTOR(s, y0, DAL_DIM(s));
    DAL_VECTOR(s, r0, DAL_DIM(s));
    DAL_VECTOR(s, method_state0, DAL_METHOD_STATE(s));
    DAL_VECTOR(s, B0, DAL_N(s) * DAL_M(s));
    DAL_VECTOR(s, inverse, DAL_M(s) * DAL_M(s));
    DAL_VECTOR(s, out, DAL_M(s) + 2 * DAL_M(s) * DAL_N(s));
    DAL_VECTOR(s, inverse_g, DAL_HOLONOMIC(s) * DAL_HOLONOMIC(s));
    DAL_VECTOR(s, q1, DAL_N(s) + DAL_HOLONOMIC(s));
    DAL_VECTOR(s, push, DAL_N(s));
    DAL_VECTOR(s, shift, DAL_M(s));
    DAL_BLOCK(s, mu, DAL_M(s) + DAL_HOLONOMIC(s), 0);
    DAL_BLOCK(s, v1, DAL_HOLONOMIC(s) > 0 ? 2 * DAL_N(s) : DAL_N(s), 0);
    reflection k = {s->t, y0,  r0,   method_state0, B0,         inverse,      inverse_g,
                    q1,   out, push, shift,         ~dal_all(), DAL_STATUS_OK};
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
    .kernel = DAL_KERNEL_SOLVE | DAL_KERNEL_CONSTRAINT | DAL_KERNEL_METHOD_STATE,
    .inherits = DAL_PRESERVES_BILINEAR | DAL_PRESERVES_QUADRATIC);
