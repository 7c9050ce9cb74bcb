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
    dal_elimination elimination; /* first; free: kick = h/2 (a0 + B0 lambda0) */
    num *q1, *v1;                /* [n] */
    num *pull, *lambda;          /* [n] a1 + B1 lambda1, [m] lambda1: of a lane's last iteration */
} rattle;

/* With W y = b + B^T l, A y = 2/h (A (w - kick) - D) at (q1, v0 + w),
 *
 *     image = kick + h/2 y,   lambda1 = l
 *
 * fulfils the equation of v1, and D to first order. */
DAL_INLINE void rattle_map(dal_step *s, dal_equation *eq)
{
    rattle *r = (rattle *)eq->context;
    const int n = DAL_N(s), m = DAL_M(s);
    const num *w = eq->block[0].u, *y = r->elimination.out, *l = y + n;
    DAL_EACH(i, n) r->v1[i] = dal_moved_v(s, i, w[i]);
    dal_constraint_value(s, s->t + s->h, r->q1, r->v1, r->elimination.in + n);
    dal_eliminate_by_factors(s, eq, 0.5 * s->h, s->t + s->h, r->q1, r->v1);
    DAL_EACH(i, n) r->pull[i] = DAL_IF_ACTIVE(eq->active, y[i], r->pull[i]);
    DAL_EACH(i, m) r->lambda[i] = DAL_IF_ACTIVE(eq->active, l[i], r->lambda[i]);
}

/* Lanes whose last step ended at this state, so that what it ended with is known. */
DAL_INLINE dal_mask rattle_known(const dal_step *s)
{
    const int n = DAL_N(s), count = dal_positional(s) ? n : 2 * n;
    const num *last = s->acceleration + 1 + n;
    dal_mask known = dal_less(dal_num(0.5), *s->acceleration);
    DAL_EACH(i, count) known &= dal_equal(last[i], s->y[i]);
    return known;
}

/* The first half of the step; without multipliers a0 + B0 lambda0 is F. */
DAL_INLINE void rattle_begin(dal_step *s, num *kick)
{
    const int n = DAL_N(s), m = DAL_M(s);
    const num half = dal_num(0.5 * s->h);
    const dal_mask known = rattle_known(s);
    DAL_EACH(i, n) kick[i] = half * s->acceleration[1 + i];
    if (!DAL_RARELY(dal_any(~known))) return;
    DAL_VECTOR(s, pull, DAL_N(s));
    dal_force(s, s->t, s->y, s->y + n, pull);
    DAL_EACH(i, n) kick[i] = dal_select(known, kick[i], half * pull[i]);
    const dal_mask has_multiplier = dal_known_multipliers(s) & ~known;
    if (!dal_any(has_multiplier)) return;
    DAL_VECTOR(s, lambda, DAL_M(s) + 1);
    DAL_EACH(i, m) lambda[i] = s->multiplier[i];
    lambda[m] = dal_num(1.0);
    dal_eval(s, DAL_EVAL_REACTION, s->t, s->y, s->y + n, lambda, pull);
    DAL_EACH(i, n) kick[i] = dal_select(has_multiplier, half * pull[i], kick[i]);
}

/* What the next step begins with; after an event and at a change of branches it is forgotten, as
 * all state of the method (lib/run/events.c). */
DAL_INLINE void rattle_end(dal_step *s, const rattle *r)
{
    const int n = DAL_N(s);
    const dal_mask alive = s->alive;
    num *const pull = s->acceleration + 1, *const last = pull + n;
    dal_save_multipliers(s, r->lambda);
    *s->acceleration = dal_select(alive, dal_num(1.0), *s->acceleration);
    DAL_EACH(i, n) pull[i] = dal_select(alive, r->pull[i], pull[i]);
    DAL_EACH(i, 2 * n) last[i] = dal_select(alive, s->y[i], last[i]);
}

DAL_INLINE dal_status step(dal_step *s)
{
    static const double one = 1.0, a2 = 0.0;
    const int n = DAL_N(s);
    const double h = s->h;
    DAL_VECTOR(s, kick, DAL_N(s));
    DAL_VECTOR(s, q1, DAL_N(s));
    DAL_VECTOR(s, v1, DAL_N(s));
    DAL_VECTOR(s, in, DAL_N(s) + DAL_M(s) + 1);
    DAL_VECTOR(s, out, DAL_N(s) + DAL_M(s));
    DAL_VECTOR(s, pull, DAL_N(s));
    DAL_VECTOR(s, lambda, DAL_M(s));
    DAL_VECTOR(s, d, DAL_DIM(s));
    DAL_BLOCK(s, block, DAL_N(s), DAL_MAY_NEWTON(s));
    rattle r = {
        {{1, 0.5 * h, &one, &a2, 0, NULL}, kick, in, out, NULL, NULL}, q1, v1, pull, lambda};
    dal_equation eq = dal_velocity_equation(s, block, &r);
    in[n + DAL_M(s)] = dal_num(1.0);
    rattle_begin(s, kick);
    DAL_EACH(i, n) pull[i] = dal_num(0.0);
    DAL_EACH(i, DAL_M(s)) lambda[i] = dal_num(0.0);
    DAL_EACH(i, n) d[i] = h * dal_moved_v(s, i, kick[i]);
    DAL_EACH(i, n) q1[i] = dal_moved_q(s, i, d[i]);
    if (dal_failed(dal_positional(s) ? dal_enforce_once(s, &eq, rattle_map)
                                     : dal_enforce(s, &eq, rattle_map)))
        return DAL_STATUS_NOT_CONVERGED;
    DAL_EACH(i, n) d[n + i] = eq.block[0].u[i];
    const dal_status status = dal_update(s, h, d);
    rattle_end(s, &r);
    return status;
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
               .properties = DAL_SYMMETRIC | DAL_PRESERVES_D | DAL_PERSISTENT_MULTIPLIER |
                             DAL_PERSISTENT_ACCELERATION,
               .needs = DAL_NEEDS_FIELD | DAL_NEEDS_BLOCKS,
               .kernel = DAL_KERNEL_ENFORCE | DAL_KERNEL_ENFORCEMENT | DAL_KERNEL_REACTION);
