/* discrete_gradient.c - the midpoint rule with a discrete gradient of the potential.
 *
 *     q1 - q0 = d = h vb,   vb = (v0 + v1)/2,   qb = (q0 + q1)/2
 *     v1 - v0 = h a(qb,vb) - h kappa d + h B(qb,vb) lambda,    D(qb, vb, t + h/2) = 0
 *     kappa = (U(q1) - U(q0) - U_q(qb).d) / (d.W d)
 *
 * L = v.Wv/2 + g(q).v - U(q) with constant W.  U_q + kappa W d is the discrete gradient of
 * O. Gonzalez, J. Nonlinear Sci. 6 (1996) 449, in the metric of the masses; with it
 *
 *     E1 - E0 = h vb.Q + h lambda.(A vb)
 *
 * where A vb = 0 for D linear or homogeneous in v: what E the motion keeps is kept to rounding.
 * O. Verdier's odelab has it for linear D.  Order 2, symmetric; keeps the energy, and D at the
 * midpoints: at the nodes D errs by O(h^2), bounded. */
#include <dalembert_kernel.h>

/* A mean kinetic energy below this part of U, and the correction is below the rounding of U. */
#define STILL 0x1p-52

typedef struct gradient {
    dal_reaction reaction; /* first */
    num *q, *vb;           /* [n] */
    num *parts;            /* at (qb, vb) */
    num *potential;        /* U, U_q, W vb */
    num U0;
} gradient;

/* kappa h^2; q is left at q1. */
DAL_INLINE num gradient_slope(dal_step *s, gradient *k)
{
    const int n = DAL_N(s);
    const double t = s->t + 0.5 * s->h, h = s->h;
    const num *U_q = k->potential + 1, *Wv = U_q + n;
    num power = dal_num(0.0), square = dal_num(0.0);
    dal_ask(s, DAL_ASK_POTENTIAL, t, k->q, k->vb, NULL, k->potential);
    DAL_EACH(i, n) power += U_q[i] * k->vb[i];
    DAL_EACH(i, n) square += Wv[i] * k->vb[i];
    DAL_EACH(i, n) k->q[i] = dal_moved_q(s, i, h * k->vb[i]);
    dal_ask(s, DAL_ASK_POTENTIAL, t, k->q, k->vb, NULL, k->potential);
    const num U1 = k->potential[0], size = dal_abs(U1) + dal_abs(k->U0);
    return dal_select(dal_less(STILL * size, dal_abs(square)), ((U1 - k->U0) - h * power) / square,
                      dal_num(0.0));
}

/* w = vb - v0 */
DAL_INLINE void gradient_map(dal_step *s, dal_equation *eq)
{
    gradient *k = (gradient *)eq->context;
    const int n = DAL_N(s), m = DAL_M(s);
    const double half = 0.5 * s->h;
    DAL_EACH(i, n) k->vb[i] = dal_moved_v(s, i, eq->block[0].u[i]);
    DAL_EACH(i, n) k->q[i] = dal_moved_q(s, i, half * k->vb[i]);
    dal_parts(s, s->t + half, k->q, k->vb, k->parts);
    const num kappa = gradient_slope(s, k);
    DAL_EACH(i, n) k->reaction.free[i] = half * k->parts[dal_at_a(s) + i] - 0.5 * kappa * k->vb[i];
    DAL_EACH(i, n * m) k->reaction.normals[i] = half * k->parts[dal_at_B(s) + i];
    dal_react(s, eq, k->parts);
}

DAL_INLINE dal_status step(dal_step *s)
{
    const int n = DAL_N(s);
    DAL_VECTOR(s, q, DAL_N(s));
    DAL_VECTOR(s, vb, DAL_N(s));
    DAL_VECTOR(s, parts, DAL_PARTS(s));
    DAL_VECTOR(s, potential, 1 + 2 * DAL_N(s));
    DAL_VECTOR(s, d, DAL_DIM(s));
    DAL_BLOCK(s, block, DAL_N(s), DAL_MAY_NEWTON(s));
    DAL_REACTION(s, reaction, 0.5 * s->h, 1.0);
    gradient k = {reaction, q, vb, parts, potential, dal_num(0.0)};
    dal_equation eq = dal_velocity_equation(s, block, &k);
    dal_ask(s, DAL_ASK_POTENTIAL, s->t + 0.5 * s->h, s->y, s->y + n, NULL, potential);
    k.U0 = potential[0];
    DAL_TRY(dal_impose(s, &eq, gradient_map, 0));
    DAL_EACH(i, n) d[i] = s->h * dal_moved_v(s, i, eq.block[0].u[i]);
    DAL_EACH(i, n) d[n + i] = 2.0 * eq.block[0].u[i];
    return dal_update(s, s->h, d);
}

DAL_INTEGRATOR(discrete_gradient, step, .name = "discrete-gradient",
               .summary = "midpoint with a discrete gradient of U", .reference = "Gonzalez 1996",
               .order = 2, .stages = 1,
               .claims = DAL_SYMMETRIC | DAL_KEEPS_ENERGY | DAL_KEEPS_D_MIDPOINT,
               .needs = DAL_NEEDS_FIELD | DAL_NEEDS_PARTS | DAL_NEEDS_POTENTIAL);
