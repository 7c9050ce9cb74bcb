/* gni.c - the geometric nonholonomic integrator in RATTLE form.
 *
 *     vh = v0 + h/2 (a(q0,v0) + B(q0,v0) lambda0),   q1 = q0 + h vh
 *     v1 = vh + h/2 (a(q1,v1) + B(q1,v1) lambda1),   D(q1, v1, t1) = 0
 *
 * lambda1 is the lambda0 of the next step; the first is the continuous motion's.  S. Ferraro,
 * D. Iglesias, D. Martin de Diego, Nonlinearity 21 (2008) 1911, and, in this form, Ferraro,
 * Iglesias, Martin de Diego, Discrete Contin. Dyn. Syst. Suppl. (2009) 220.  vh -> vh of the next
 * step is a reflection in D = 0: without forces, and with constant W, its kinetic energy is kept.
 * Order 2, symmetric in (q, v, lambda), preserves every D; explicit where forces depend on q alone
 * and D is linear.  An error of lambda changes its sign from step to step and grows where the
 * motion contracts: on the straight motion of chaplygin-sleigh-offset the energy is lost. */
#include <dalembert_kernel.h>

typedef struct rattle {
    dal_elimination elimination; /* first */
    num *kick;                   /* [n] h/2 (a0 + B0 lambda0) */
    num *q1, *v1;                /* [n] */
    num *after;                  /* blocks at (q1, v1) */
} rattle;

DAL_INLINE void rattle_map(dal_step *s, dal_equation *eq)
{
    rattle *k = (rattle *)eq->context;
    const int n = DAL_N(s), m = DAL_M(s);
    const double half = 0.5 * s->h;
    DAL_EACH(i, n) k->v1[i] = dal_moved_v(s, i, eq->block[0].u[i]);
    dal_eval_blocks(s, s->t + s->h, k->q1, k->v1, k->after);
    DAL_EACH(i, n) k->elimination.free[i] = k->kick[i] + half * k->after[dal_blocks_a(s) + i];
    DAL_EACH(i, n * m) k->elimination.directions[i] = half * k->after[dal_blocks_B(s) + i];
    dal_eliminate_multipliers(s, eq, k->after);
}

/* The first half of the step. */
DAL_INLINE void rattle_begin(dal_step *s, num *kick)
{
    const int n = DAL_N(s), m = DAL_M(s);
    DAL_VECTOR(s, before, DAL_BLOCKS_SIZE(s));
    DAL_VECTOR(s, lambda, DAL_M(s));
    DAL_VECTOR(s, pull, DAL_N(s));
    dal_eval_blocks(s, s->t, s->y, s->y + n, before);
    dal_restore_multipliers(s, before, lambda);
    dal_multiply(before + dal_blocks_B(s), n, m, lambda, pull);
    DAL_EACH(i, n) kick[i] = 0.5 * s->h * (before[dal_blocks_a(s) + i] + pull[i]);
}

DAL_INLINE dal_status step(dal_step *s)
{
    const int n = DAL_N(s);
    const double h = s->h;
    DAL_VECTOR(s, kick, DAL_N(s));
    DAL_VECTOR(s, q1, DAL_N(s));
    DAL_VECTOR(s, v1, DAL_N(s));
    DAL_VECTOR(s, after, DAL_BLOCKS_SIZE(s));
    DAL_VECTOR(s, d, DAL_DIM(s));
    DAL_BLOCK(s, block, DAL_N(s), DAL_MAY_NEWTON(s));
    DAL_ELIMINATION(s, elimination, 0.5 * s->h, 0.0);
    rattle k = {elimination, kick, q1, v1, after};
    dal_equation eq = dal_velocity_equation(s, block, &k);
    rattle_begin(s, kick);
    DAL_EACH(i, n) d[i] = h * dal_moved_v(s, i, kick[i]);
    DAL_EACH(i, n) q1[i] = dal_moved_q(s, i, d[i]);
    if (dal_failed(dal_positional(s) ? dal_enforce_once(s, &eq, rattle_map)
                                     : dal_enforce(s, &eq, rattle_map)))
        return DAL_STATUS_NOT_CONVERGED;
    DAL_EACH(i, n) d[n + i] = eq.block[0].u[i];
    dal_save_multipliers(s, k.elimination.mu);
    return dal_update(s, h, d);
}

#define ABOUT_GNI                                                                                  \
    "RATTLE with the constraint on velocities:\n"                                                  \
    "$$v_h = v_0 + \\tfrac{h}{2}\\left(a(q_0, v_0) + B(q_0, v_0)\\,\\lambda_0\\right), \\quad "    \
    "q_1 = q_0 + h\\,v_h, \\quad v_1 = v_h + \\tfrac{h}{2}\\left(a(q_1, v_1) + B(q_1, "            \
    "v_1)\\,\\lambda_1\\right), \\quad D(q_1, v_1) = 0,$$\n"                                       \
    "where $\\lambda_1$ is the $\\lambda_0$ of the next step (Ferraro, Iglesias, Martin de "       \
    "Diego 2008 and 2009). The order is 2; it is symmetric in $(q, v, \\lambda)$ and preserves "   \
    "every $D$. Without forces, and with constant $W$, the kinetic energy of $v_h$ is "            \
    "preserved. An error of the multipliers changes its sign from step to step, and grows where"   \
    " the motion contracts."

DAL_INTEGRATOR(gni, step, .name = "gni", .alias = "nonholonomic-rattle",
               .summary = "RATTLE with D on the velocities",
               .reference = "Ferraro, Iglesias, Martin de Diego 2008", .documentation = ABOUT_GNI,
               .order = 2, .stages = 1,
               .properties = DAL_SYMMETRIC | DAL_PRESERVES_D | DAL_PERSISTENT_MULTIPLIER,
               .needs = DAL_NEEDS_FIELD | DAL_NEEDS_BLOCKS, .kernel = DAL_KERNEL_ENFORCE);
