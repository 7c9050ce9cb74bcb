/* mclachlan_perlmutter.c - nonholonomic leapfrog with the constraint at the end of the step.
 *
 *     qh = q0 + h/2 v0
 *     v1 - v0 = h/2 (a(qh,v0) + a(qh,v1)) + h/2 (B(qh,v0) + B(qh,v1)) lambda
 *     q1 = qh + h/2 v1,   D(q1, v1, t1) = 0            a and B at t + h/2, solved to rounding
 *
 * R. McLachlan, M. Perlmutter, J. Nonlinear Sci. 16 (2006) 283, eq. 4.18, for linear D, where B
 * depends on q alone; the mean of B allows nonlinear D and preserves the symmetry.  Order 2,
 * symmetric, preserves every D.  With a mass matrix, a = W^-1 b and B = W^-1 A^T.  Where forces
 * depend on q alone and D is linear only the m multipliers are solved for, one evaluation a step of
 * few constraints; of many each iteration has one. */
#include <dalembert_kernel.h>

typedef struct leap {
    dal_elimination elimination; /* first */
    num *qh, *q1, *v1;           /* [n] */
    num *before, *after;         /* blocks at (qh, v0), (qh, v1), of few constraints */
    num *constraint;             /* D, A at (q1, v1), likewise */
    num *lambda;                 /* [m + 1] of a lane's last iteration, and 1 */
} leap;

DAL_INLINE void set_mean_directions(const dal_step *s, const leap *k)
{
    const int n = DAL_N(s), m = DAL_M(s), a = dal_blocks_a(s), B = dal_blocks_B(s);
    const num *after = dal_positional(s) ? k->before : k->after;
    const double half = 0.5 * s->h;
    DAL_EACH(i, n) k->elimination.free[i] = half * (k->before[a + i] + after[a + i]);
    DAL_EACH(i, n * m) k->elimination.directions[i] = half * (k->before[B + i] + after[B + i]);
}

/* The half at v0, h/2 (a + B lambda), with lambda of the last iteration, 0 in the first. */
DAL_INLINE void find_first_half(dal_step *s, const dal_equation *eq, const leap *k)
{
    const int n = DAL_N(s), m = DAL_M(s);
    const dal_mask begins = dal_equal(eq->block[0].progress->now, dal_num(INFINITY));
    num *const lambda = k->lambda, *const free = k->elimination.free;
    DAL_EACH(i, m)
        lambda[i] =
            DAL_IF_ACTIVE(eq->active, dal_select(begins, dal_num(0.0), lambda[i]), lambda[i]);
    s->evaluations++;
    dal_eval(s, DAL_EVAL_REACTION, s->t + 0.5 * s->h, k->qh, s->y + n, lambda, free);
    DAL_EACH(i, n) free[i] *= dal_num(0.5 * s->h);
}

/* The half at v1 solves, with multipliers l of its own, for D; the next lambda is their mean, so
 * that both halves have the same in the end.  A is of qh in place of q1, which differs like h. */
DAL_INLINE void leap_by_factors(dal_step *s, dal_equation *eq, const leap *k)
{
    const int n = DAL_N(s);
    const bool is_same = dal_positional(s);
    const double h = s->h;
    const num *l = k->elimination.out + n;
    if (!is_same) find_first_half(s, eq, k);
    dal_constraint_value(s, s->t + h, k->q1, k->v1, k->elimination.in + n);
    dal_eliminate_by_factors(s, eq, is_same ? h : 0.5 * h, s->t + 0.5 * h, k->qh, k->v1);
    DAL_EACH(i, DAL_M(s))
        k->lambda[i] = DAL_IF_ACTIVE(eq->active, 0.5 * (k->lambda[i] + l[i]), k->lambda[i]);
}

DAL_INLINE void leap_map(dal_step *s, dal_equation *eq)
{
    leap *k = (leap *)eq->context;
    const int n = DAL_N(s);
    const double h = s->h;
    DAL_EACH(i, n) k->v1[i] = dal_moved_v(s, i, eq->block[0].u[i]);
    DAL_EACH(i, n) k->q1[i] = dal_moved_q(s, i, 0.5 * h * (s->y[n + i] + k->v1[i]));
    if (DAL_MANY_CONSTRAINTS(s)) {
        leap_by_factors(s, eq, k);
        return;
    }
    if (!dal_positional(s)) {
        dal_eval_blocks(s, s->t + 0.5 * h, k->qh, k->v1, k->after);
        set_mean_directions(s, k);
    }
    dal_constraint(s, s->t + h, k->q1, k->v1, k->constraint);
    dal_eliminate_multipliers(s, eq, k->constraint);
}

DAL_INLINE dal_status step(dal_step *s)
{
    const int n = DAL_N(s);
    const double h = s->h;
    DAL_VECTOR(s, qh, DAL_N(s));
    DAL_VECTOR(s, q1, DAL_N(s));
    DAL_VECTOR(s, v1, DAL_N(s));
    DAL_VECTOR(s, before, DAL_OF_FEW(s, DAL_BLOCKS_SIZE(s)));
    DAL_VECTOR(s, after, DAL_OF_FEW(s, DAL_BLOCKS_SIZE(s)));
    DAL_VECTOR(s, constraint, DAL_OF_FEW(s, DAL_CONSTRAINT_SIZE(s)));
    DAL_VECTOR(s, lambda, DAL_M(s) + 1);
    DAL_VECTOR(s, d, DAL_DIM(s));
    DAL_BLOCK(s, block, DAL_N(s), DAL_MAY_NEWTON(s));
    DAL_ELIMINATION(s, elimination, 0.5 * s->h, 0.0);
    leap k = {elimination, qh, q1, v1, before, after, constraint, lambda};
    dal_equation eq = dal_velocity_equation(s, block, &k);
    DAL_EACH(i, n) qh[i] = dal_moved_q(s, i, 0.5 * h * s->y[n + i]);
    if (DAL_MANY_CONSTRAINTS(s)) {
        DAL_EACH(i, n) elimination.free[i] = dal_num(0.0);
        DAL_EACH(i, DAL_M(s)) lambda[i] = dal_num(0.0);
        lambda[DAL_M(s)] = elimination.in[n + DAL_M(s)] = dal_num(1.0);
    } else {
        dal_eval_blocks(s, s->t + 0.5 * h, qh, s->y + n, before);
        if (dal_positional(s)) set_mean_directions(s, &k);
    }
    if (dal_failed(DAL_M(s) == 0 && dal_positional(s) ? dal_enforce_once(s, &eq, leap_map)
                                                      : dal_enforce(s, &eq, leap_map)))
        return DAL_STATUS_NOT_CONVERGED;
    DAL_EACH(i, n) d[n + i] = eq.block[0].u[i];
    DAL_EACH(i, n) d[i] = 0.5 * h * (s->y[n + i] + dal_moved_v(s, i, d[n + i]));
    return dal_update(s, h, d);
}

#define ABOUT_MCLACHLAN_PERLMUTTER                                                                 \
    "A leapfrog step whose multipliers make $D = 0$ at the end of the step:\n"                     \
    "$$q_h = q_0 + \\tfrac{h}{2}\\,v_0, \\qquad v_1 - v_0 = h\\,\\bar a(q_h) + h\\,\\bar "         \
    "B(q_h)\\,\\lambda, \\qquad q_1 = q_h + \\tfrac{h}{2}\\,v_1, \\qquad D(q_1, v_1) = 0.$$\n"     \
    "Bars are means over $v_0$ and $v_1$, $a = W^{-1} b$ and $B = W^{-1} A^T$. McLachlan and "     \
    "Perlmutter (2006, eq. 4.18) have it for linear $D$; the mean of $B$ extends it to every "     \
    "$D$. The order is 2, the method is symmetric and keeps no multipliers from step to step. "    \
    "The energy is not preserved; for many reversible systems its error is bounded."

DAL_INTEGRATOR(mclachlan_perlmutter, step, .name = "mclachlan-perlmutter",
               .summary = "leapfrog with D at its end", .reference = "McLachlan, Perlmutter 2006",
               .documentation = ABOUT_MCLACHLAN_PERLMUTTER, .order = 2, .stages = 1,
               .properties = DAL_SYMMETRIC | DAL_PRESERVES_D,
               .needs = DAL_NEEDS_FIELD | DAL_NEEDS_BLOCKS,
               .kernel = DAL_KERNEL_ENFORCE | DAL_KERNEL_CONSTRAINT | DAL_KERNEL_ENFORCEMENT |
                         DAL_KERNEL_REACTION);
