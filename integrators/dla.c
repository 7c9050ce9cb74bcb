/* dla.c - discrete Lagrange-d'Alembert equations of the midpoint rule.
 *
 *     D1 Ld(q_k,q_k+1) + D2 Ld(q_k-1,q_k) + h A(q_k)^T lambda_k = 0,
 *     D((q_k + q_k+1)/2, (q_k+1 - q_k)/h, t + h/2) = 0,
 *     Ld(q0,q1) = h L((q0 + q1)/2, (q1 - q0)/h, t + h/2)
 *
 * J. Cortes, S. Martinez, Nonlinearity 14 (2001) 1365, here as a map of (q, v) on D = 0.  The
 * impulse lambda_k at a node is divided between the step that ends there, whose part brings v to
 * D = 0, and the one that begins:
 *
 *     vb = v0 + h/2 a(qb, vb) + h/2 B(q0, v0) mu,   qb = q0 + h/2 vb,   D(qb, vb, t + h/2) = 0
 *     v1 = vb + h/2 a(qb, vb) + h/2 B(q1, v1) nu,   q1 = q0 + h vb,     D(q1, v1, t1) = 0
 *
 * so that the q satisfy the two-step equations (D linear, W constant; else this is the same
 * with the midpoint rule for v' = a, and for B at the node's velocity).  Order 2, symmetric, keeps
 * every D, and D at the midpoints. */
#include <dalembert_kernel.h>

typedef struct midpoint {
    dal_elimination elimination; /* first */
    num *qb, *vb;                /* [n] */
    num *blocks;                 /* at (qb, vb); then at the end; of few constraints */
    num *none;                   /* [m + 1] multipliers 0, and 1: of a alone */
} midpoint;

/* free = h/2 a(qb, vb) for the increment w of v; of few constraints with the blocks there. */
DAL_INLINE void find_force(dal_step *s, const midpoint *k, const num *w)
{
    const double half = 0.5 * s->h, t = s->t + half;
    num *const force = k->elimination.free;
    DAL_EACH(i, DAL_N(s)) k->vb[i] = dal_moved_v(s, i, w[i]);
    DAL_EACH(i, DAL_N(s)) k->qb[i] = dal_moved_q(s, i, half * k->vb[i]);
    if (DAL_MANY_CONSTRAINTS(s)) {
        s->evaluations++;
        dal_eval(s, DAL_EVAL_REACTION, t, k->qb, k->vb, k->none, force);
        DAL_EACH(i, DAL_N(s)) force[i] *= dal_num(half);
        return;
    }
    dal_eval_blocks(s, t, k->qb, k->vb, k->blocks);
    DAL_EACH(i, DAL_N(s)) force[i] = half * k->blocks[dal_blocks_a(s) + i];
}

/* w = vb - v0; the directions do not change, and their A is taken of the beginning, too. */
DAL_INLINE void map_midpoint(dal_step *s, dal_equation *eq)
{
    midpoint *k = (midpoint *)eq->context;
    const double half = 0.5 * s->h;
    find_force(s, k, eq->block[0].u);
    if (DAL_MANY_CONSTRAINTS(s)) {
        dal_constraint_value(s, s->t + half, k->qb, k->vb, k->elimination.in + DAL_N(s));
        dal_eliminate_by_factors(s, eq, half, s->t, s->y, s->y + DAL_N(s));
        return;
    }
    dal_eliminate_multipliers(s, eq, k->blocks);
}

/* w = v1 - v0; free does not change. */
DAL_INLINE void map_end(dal_step *s, dal_equation *eq)
{
    midpoint *k = (midpoint *)eq->context;
    const double end = s->t + s->h;
    DAL_EACH(i, DAL_N(s)) k->vb[i] = dal_moved_v(s, i, eq->block[0].u[i]);
    if (!DAL_MANY_CONSTRAINTS(s)) dal_eval_blocks(s, end, k->qb, k->vb, k->blocks);
    dal_eliminate_at(s, eq, 0.5 * s->h, end, k->qb, k->vb, k->blocks);
}

/* Steps to the midpoint; leaves vb, and v0 moved by all but the last impulse in `free`. */
DAL_INLINE dal_status step_to_midpoint(dal_step *s, midpoint *k)
{
    const int n = DAL_N(s), m = DAL_M(s);
    DAL_BLOCK(s, block, DAL_N(s), DAL_MAY_NEWTON(s));
    const double half = 0.5 * s->h;
    dal_equation eq = dal_velocity_equation(s, block, k);
    if (!DAL_MANY_CONSTRAINTS(s)) {
        dal_eval_blocks(s, s->t, s->y, s->y + n, k->blocks);
        DAL_EACH(i, n * m) k->elimination.directions[i] = half * k->blocks[dal_blocks_B(s) + i];
    }
    if (dal_failed(dal_enforce(s, &eq, map_midpoint))) return DAL_STATUS_NOT_CONVERGED;
    find_force(s, k, eq.block[0].u);
    DAL_EACH(i, n) k->elimination.free[i] += eq.block[0].u[i];
    return DAL_STATUS_OK;
}

DAL_INLINE dal_status step(dal_step *s)
{
    const int n = DAL_N(s);
    DAL_VECTOR(s, qb, DAL_N(s));
    DAL_VECTOR(s, vb, DAL_N(s));
    DAL_VECTOR(s, blocks, DAL_OF_FEW(s, DAL_BLOCKS_SIZE(s)));
    DAL_VECTOR(s, none, DAL_M(s) + 1);
    DAL_VECTOR(s, d, DAL_DIM(s));
    DAL_BLOCK(s, block, DAL_N(s), 0);
    DAL_ELIMINATION(s, elimination, 0.5 * s->h, 1.0);
    midpoint k = {elimination, qb, vb, blocks, none};
    DAL_EACH(i, DAL_M(s)) none[i] = dal_num(0.0);
    none[DAL_M(s)] = dal_num(1.0);
    elimination.in[n + DAL_M(s)] = dal_num(0.0); /* no forces with the impulses */
    if (dal_failed(step_to_midpoint(s, &k))) return DAL_STATUS_NOT_CONVERGED;
    dal_equation eq = dal_velocity_equation(s, block, &k);
    DAL_EACH(i, n) d[i] = s->h * vb[i];
    DAL_EACH(i, n) qb[i] = dal_moved_q(s, i, d[i]);
    DAL_EACH(i, n) eq.block[0].u[i] = elimination.free[i];
    if (dal_failed(dal_solve(s, &eq, map_end, NULL))) return DAL_STATUS_NOT_CONVERGED;
    DAL_EACH(i, n) d[n + i] = eq.block[0].u[i];
    return dal_update(s, s->h, d);
}

#define ABOUT_DLA                                                                                  \
    "The discrete Lagrange-d'Alembert equations of the midpoint rule (Cortes, Martinez 2001),\n"   \
    "$$D_1 L_d(q_k, q_{k+1}) + D_2 L_d(q_{k-1}, q_k) + h\\,A(q_k)^T \\lambda_k = 0, \\qquad "      \
    "D\\left(\\tfrac{q_k + q_{k+1}}{2},\\, \\tfrac{q_{k+1} - q_k}{h}\\right) = 0,$$\n"             \
    "with $L_d(q_0, q_1) = h\\,L\\left(\\tfrac{q_0 + q_1}{2}, \\tfrac{q_1 - q_0}{h}\\right)$, "    \
    "here as a map of $(q, v)$ on $D = 0$: the impulse at a node is divided between the two "      \
    "steps that meet there. The order is 2; it is symmetric and preserves every $D$, at the "      \
    "ends of steps and at their midpoints."

DAL_INTEGRATOR(dla, step, .name = "dla", .summary = "discrete Lagrange-d'Alembert, midpoint",
               .reference = "Cortes, Martinez 2001", .documentation = ABOUT_DLA, .order = 2,
               .stages = 1,
               .properties = DAL_SYMMETRIC | DAL_PRESERVES_D | DAL_PRESERVES_D_MIDPOINT,
               .needs = DAL_NEEDS_FIELD | DAL_NEEDS_BLOCKS,
               .kernel = DAL_KERNEL_ENFORCE | DAL_KERNEL_ENFORCEMENT | DAL_KERNEL_REACTION);
