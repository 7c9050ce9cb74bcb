/* project.c - the modifier NAME+project: back to g = 0, D = 0 and p = pi = pi_e = 0 after every
 * step.
 *
 *     (q1, u, t1) = step of NAME
 *     v1 = u - W^-1 A^T c,   D(q1, v1, t1) = 0
 *
 * the nearest v in the metric of the masses, by Newton's method: v <- v + x from v = u with
 *
 *     W x = A^T l,   A x = -D,        W, A and D at (q1, v, t1)
 *
 * Where D is linear in v the first x solves, except for the rounding of x; elsewhere it is of the
 * size of the last one squared, so that one at rounding level ends the iteration.
 *
 * Holonomic constraints g(q, t) = 0 come first, with q1 the nearest q in the same metric:
 *
 *     q1 = q - W^-1 G^T l,   g(q1, t1) = 0,    G = g_q and W at q:     (G W^-1 G^T) dl = g(q1, t1)
 *
 * and then v at q1, where their derivatives g_q v + g_t are rows of D.  Hairer, Lubich,
 * Wanner, Geometric Numerical Integration (2006), IV.4.  Keeps the order on D = 0 and every D;
 * loses symmetry.  A step that lands in D = 0 has a rank-deficient derivative on (q,v), hence no
 * cotangent lift of 4n+2 variables, and is not symplectic there; restricted to D = 0 it lifts to
 * T*{D = 0}, of dimension 2(2n - m). */
#include <dalembert_kernel.h>

/* Of a change of v by this share, what rounding leaves of D is far below the rounding of v. */
#define ENOUGH_IF_LINEAR 1e-4

typedef struct projection {
    const num *u; /* [n] */
    num *v;       /* [n] */
} projection;

/* The unknown is the change of v, whose scale is the scale of v. */
DAL_INLINE void projection_map(dal_step *s, dal_equation *eq)
{
    const projection *p = (const projection *)eq->context;
    const int n = DAL_N(s);
    num *const image = eq->block[0].image;
    DAL_EACH(i, n) p->v[i] = p->u[i] + eq->block[0].u[i];
    dal_eval(s, DAL_EVAL_CORRECTION, s->t, s->y, p->v, NULL, image);
    DAL_EACH(i, n) image[i] += eq->block[0].u[i];
}

DAL_INLINE dal_status project_velocity(dal_step *s)
{
    const int n = DAL_N(s);
    DAL_VECTOR(s, v, DAL_N(s));
    DAL_BLOCK(s, change, DAL_N(s), 0);
    projection p = {s->y + n, v};
    DAL_EQUATION(s, eq, 1, &p, change);
    dal_set_speeds(s, &eq.block[0], n);
    eq.block[0].progress->scale = dal_speed_norm(s, s->y + n);
    eq.block[0].enough = DAL_PROPERTIES(s) & DAL_D_LINEAR ? ENOUGH_IF_LINEAR : DAL__ROUNDING;
    DAL_EACH(i, n) eq.block[0].u[i] = dal_num(0.0);
    if (dal_failed(dal_solve(s, &eq, projection_map, NULL))) return DAL_STATUS_NOT_CONVERGED;
    dal_add(s, n, n, eq.block[0].u);
    return DAL_STATUS_OK;
}

#if DAL_WITH(HOLONOMIC)
typedef struct nearest {
    num *q, *g; /* [n], [m] the last ones */
    num *out;   /* of DAL_EVAL_POSITION */
} nearest;

/* The unknown is the change of q over h, a velocity. */
DAL_INLINE void nearest_map(dal_step *s, dal_equation *eq)
{
    const nearest *k = (const nearest *)eq->context;
    const int n = DAL_N(s), first = DAL_M(s) - DAL_HOLONOMIC(s);
    const num *u = eq->block[0].u;
    DAL_EACH(i, n) k->q[i] = s->y[i] + s->h * u[i];
    dal_eval(s, DAL_EVAL_HOLONOMIC, s->t, k->q, s->y + n, NULL, k->g + first);
    dal_eval(s, DAL_EVAL_POSITION, s->t, s->y, s->y + n, k->g, k->out);
    DAL_EACH(i, n) eq->block[0].image[i] = u[i] - k->out[i] / s->h;
}

DAL_INLINE dal_status project_position(dal_step *s)
{
    const int n = DAL_N(s);
    DAL_VECTOR(s, q, DAL_N(s));
    DAL_VECTOR(s, g, DAL_M(s) + 1);
    DAL_VECTOR(s, out, DAL_N(s) + DAL_HOLONOMIC(s));
    DAL_BLOCK(s, change, DAL_N(s), 0);
    nearest k = {q, g, out};
    DAL_EQUATION(s, eq, 1, &k, change);
    DAL_EACH(i, DAL_M(s) + 1) g[i] = dal_num(0.0);
    dal_set_speeds(s, &eq.block[0], n);
    eq.block[0].progress->scale = dal_velocity_scale(s, s->h, 0);
    DAL_EACH(i, n) eq.block[0].u[i] = dal_num(0.0);
    if (dal_failed(dal_solve(s, &eq, nearest_map, NULL))) return DAL_STATUS_NOT_CONVERGED;
    dal_add_multiple(s, 0, n, s->h, eq.block[0].u);
    return DAL_STATUS_OK;
}
#endif

DAL_INLINE dal_status step(dal_step *s)
{
    const dal_status status = dal_inner(s, s->h);
    if (dal_failed(status)) return status;
#if DAL_WITH(HOLONOMIC)
    if (DAL_HOLONOMIC(s) > 0 && dal_failed(project_position(s))) return DAL_STATUS_NOT_CONVERGED;
#endif
    if (DAL_M(s) > 0 && dal_failed(project_velocity(s))) return DAL_STATUS_NOT_CONVERGED;
    dal_clear_momenta(s);
    return DAL_STATUS_OK;
}

#define ABOUT_PROJECT                                                                              \
    "After each step back to $g = 0$ of holonomic constraints, to the nearest coordinates in the " \
    "metric of the masses, and then to $D = 0$, to the nearest velocity:\n"                        \
    "$$v_1 = u - W^{-1} A^T c, \\qquad D(q_1, v_1) = 0,$$\n"                                       \
    "where $(q_1, u)$ is the step of the method inside (Hairer, Lubich, Wanner 2006, IV.4); $p "   \
    "= \\pi = \\pi_e = 0$ as well. The order stays what it was; every $g$ and $D$ is preserved. "  \
    "Symmetry is lost, and so is symplecticity on the lift: a step that lands in $D = 0$ has a "   \
    "singular derivative on $(q, v)$."

DAL_INTEGRATOR(
    project, step, .name = "project",
    .summary = "after each step back to g = 0, D = 0, p = pi = pi_e = 0, in the mass metric",
    .reference = "Hairer, Lubich, Wanner 2006, IV.4", .documentation = ABOUT_PROJECT, .stages = 1,
    .properties = DAL_MODIFIER | DAL_PRESERVES_D | DAL_PRESERVES_HOLONOMIC,
    .needs = DAL_NEEDS_CONSTRAINT, .kernel = DAL_KERNEL_SOLVE | DAL_KERNEL_CORRECTION,
    .inherits = DAL_PRESERVES_BILINEAR | DAL_PRESERVES_QUADRATIC | DAL_EXPLICIT | DAL_ADAPTIVE);
