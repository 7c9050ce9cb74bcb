/* project.c - the modifier NAME+project: back to D = 0 and p = pi = pi_e = 0 after every step.
 *
 *     (q1, u, t1) = step of NAME
 *     v1 = u - B c,   D(q1, v1, t1) = 0,   B = W^-1 A^T,   A and W at (q1, u, t1)
 *
 * the nearest v in the metric of the masses, by Newton's method with the frozen derivative
 * G = A B, to stagnation: c <- c + G^-1 D(q1, u - B c).  Hairer, Lubich, Wanner, Geometric
 * Numerical Integration (2006), IV.4.  Keeps the order on D = 0 and every D; loses symmetry.  A
 * step that lands in D = 0 has a rank-deficient derivative on (q,v), hence no cotangent lift of
 * 4n+2 variables, and is not symplectic there; restricted to D = 0 it lifts to T*{D = 0}, of
 * dimension 2(2n - m). */
#include <dalembert_kernel.h>

typedef struct projection {
    num *u, *v;      /* [n] */
    num *out;        /* [m + m*n + n*m] D, A, B at (q1, v) */
    num *directions; /* [n*m] the frozen B */
    num *inverse;    /* [m*m] G^-1 */
    num *shift;      /* [m] */
} projection;

DAL_INLINE void eval_constraint(dal_step *s, projection *p)
{
    dal_eval(s, DAL_EVAL_CONSTRAINT, s->t, s->y, p->v, NULL, p->out);
}

/* The unknown is the change of v, whose scale is the scale of v. */
DAL_INLINE void projection_map(dal_step *s, dal_equation *eq)
{
    projection *p = (projection *)eq->context;
    const int n = DAL_N(s), m = DAL_M(s);
    DAL_EACH(i, n) p->v[i] = p->u[i] + eq->block[0].u[i];
    eval_constraint(s, p);
    dal_multiply(p->inverse, m, m, p->out, p->shift);
    dal_multiply(p->directions, n, m, p->shift, eq->block[0].image);
    DAL_EACH(i, n) eq->block[0].image[i] = eq->block[0].u[i] - eq->block[0].image[i];
}

/* B and G^-1 at (q1, u). */
DAL_INLINE void freeze_projection(dal_step *s, projection *p)
{
    const int n = DAL_N(s), m = DAL_M(s);
    DAL_VECTOR(s, g, DAL_M(s) * DAL_M(s));
    eval_constraint(s, p);
    const num *a = p->out + m, *b = p->out + m + m * n;
    DAL_EACH(i, n * m) p->directions[i] = b[i];
    dal_gram(a, b, m, n, g);
    dal_invert_in_units(g, p->inverse, m, DAL_LEVELS(s), m);
}

DAL_INLINE dal_status project_velocity(dal_step *s)
{
    const int n = DAL_N(s);
    DAL_VECTOR(s, v, DAL_N(s));
    DAL_VECTOR(s, out, DAL_M(s) + 2 * DAL_M(s) * DAL_N(s));
    DAL_VECTOR(s, directions, DAL_N(s) * DAL_M(s));
    DAL_VECTOR(s, inverse, DAL_M(s) * DAL_M(s));
    DAL_VECTOR(s, shift, DAL_M(s));
    DAL_BLOCK(s, change, DAL_N(s), 0);
    projection p = {s->y + n, v, out, directions, inverse, shift};
    DAL_EQUATION(eq, 1, &p, change);
    dal_set_speeds(s, &eq.block[0], n);
    eq.block[0].scale[0] = dal_speed_norm(s, s->y + n);
    DAL_EACH(i, n) eq.block[0].u[i] = dal_num(0.0);
    DAL_EACH(i, n) v[i] = s->y[n + i];
    freeze_projection(s, &p);
    if (dal_failed(dal_solve(s, &eq, projection_map, NULL))) return DAL_STATUS_NOT_CONVERGED;
    dal_add(s, n, n, eq.block[0].u);
    return DAL_STATUS_OK;
}

DAL_INLINE dal_status step(dal_step *s)
{
    const dal_status status = dal_inner(s, s->h);
    if (dal_failed(status)) return status;
    if (DAL_M(s) > 0 && dal_failed(project_velocity(s))) return DAL_STATUS_NOT_CONVERGED;
    dal_clear_momenta(s);
    return DAL_STATUS_OK;
}

DAL_INTEGRATOR(project, step, .name = "project",
               .summary = "after each step back to D = 0, p = pi = pi_e = 0, in the mass metric",
               .reference = "Hairer, Lubich, Wanner 2006, IV.4", .stages = 1,
               .properties = DAL_MODIFIER | DAL_PRESERVES_D, .needs = DAL_NEEDS_CONSTRAINT,
               .kernel = DAL_KERNEL_SOLVE | DAL_KERNEL_CONSTRAINT,
               .inherits = DAL_PRESERVES_BILINEAR | DAL_PRESERVES_QUADRATIC | DAL_EXPLICIT |
                           DAL_ADAPTIVE);
