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
 * where A vb = k D = 0 for D homogeneous of degree k in v: an E that the motion conserves is then
 * preserved to rounding.  For any other D it errs by O(h^2), even where the motion conserves it.
 * O. Verdier's odelab has it for linear D.  Coordinates that neither U nor W couple have
 * a kappa of their own, so that energies of blocks that D does not couple are kept one by one; it
 * is 0 where U is quadratic.  Order 2, symmetric; preserves the energy, and D at the midpoints: at
 * the nodes D errs by O(h^2), bounded. */
#include <dalembert_kernel.h>

/* Where v.Wv is below this fraction of U, kappa d is omitted: it is of third order in v and changes
 * the energy by less than rounding, while the rounding of U would be divided by v. */
#define STILL 0x1p-30

typedef struct gradient {
    dal_elimination elimination; /* first */
    num *q, *vb;                 /* [n] */
    num *blocks;                 /* at (qb, vb), of few constraints */
    num *U0, *mid, *end;         /* [3n] U, U_q.v, v.Wv at q0, qb, q1, with vb */
} gradient;

/* h^2 kappa for coordinate i. */
DAL_INLINE num gradient_factor(const dal_step *s, const gradient *k, int i)
{
    const int n = DAL_N(s);
    const num U0 = k->U0[i], U1 = k->end[i], square = k->mid[2 * n + i];
    const num excess = (U1 - U0) - s->h * k->mid[n + i];
    const dal_mask moves = dal_less(STILL * (dal_abs(U0) + dal_abs(U1)), dal_abs(square));
    return dal_select(moves, excess / square, dal_num(0.0));
}

/* The equation of vb, and D at (qb, vb), where k->q is qb. */
DAL_INLINE void enforce_at_middle(dal_step *s, dal_equation *eq, gradient *k)
{
    const int n = DAL_N(s), m = DAL_M(s);
    const double half = 0.5 * s->h, t = s->t + half;
    num *const free = k->elimination.free;
    if (DAL_MANY_CONSTRAINTS(s)) { /* the factors of F add h/2 a by themselves */
        k->elimination.in[n + m] = dal_num(1.0);
        DAL_EACH(i, n) free[i] = -(0.5 * gradient_factor(s, k, i) * k->vb[i]);
    } else {
        dal_eval_blocks(s, t, k->q, k->vb, k->blocks);
        const num *a = k->blocks + dal_blocks_a(s);
        DAL_EACH(i, n) free[i] = half * a[i] - 0.5 * gradient_factor(s, k, i) * k->vb[i];
    }
    dal_eliminate_at(s, eq, half, t, k->q, k->vb, k->blocks);
}

/* w = vb - v0 */
DAL_INLINE void gradient_map(dal_step *s, dal_equation *eq)
{
    gradient *k = (gradient *)eq->context;
    const int n = DAL_N(s);
    const double half = 0.5 * s->h, t = s->t + half;
    DAL_EACH(i, n) k->vb[i] = dal_moved_v(s, i, eq->block[0].u[i]);
    DAL_EACH(i, n) k->q[i] = dal_moved_q(s, i, s->h * k->vb[i]);
    dal_eval(s, DAL_EVAL_POTENTIAL, t, k->q, k->vb, NULL, k->end);
    DAL_EACH(i, n) k->q[i] = dal_moved_q(s, i, half * k->vb[i]);
    dal_eval(s, DAL_EVAL_POTENTIAL, t, k->q, k->vb, NULL, k->mid);
    enforce_at_middle(s, eq, k);
}

DAL_INLINE dal_status step(dal_step *s)
{
    const int n = DAL_N(s);
    DAL_VECTOR(s, q, DAL_N(s));
    DAL_VECTOR(s, vb, DAL_N(s));
    DAL_VECTOR(s, blocks, DAL_OF_FEW(s, DAL_BLOCKS_SIZE(s)));
    DAL_VECTOR(s, U0, 3 * DAL_N(s));
    DAL_VECTOR(s, mid, 3 * DAL_N(s));
    DAL_VECTOR(s, end, 3 * DAL_N(s));
    DAL_VECTOR(s, d, DAL_DIM(s));
    DAL_BLOCK(s, block, DAL_N(s), DAL_MAY_NEWTON(s));
    DAL_ELIMINATION(s, elimination, 0.5 * s->h, 1.0);
    gradient k = {elimination, q, vb, blocks, U0, mid, end};
    dal_equation eq = dal_velocity_equation(s, block, &k);
    dal_eval(s, DAL_EVAL_POTENTIAL, s->t + 0.5 * s->h, s->y, s->y + n, NULL, U0);
    if (dal_failed(dal_enforce(s, &eq, gradient_map))) return DAL_STATUS_NOT_CONVERGED;
    DAL_EACH(i, n) d[i] = s->h * dal_moved_v(s, i, eq.block[0].u[i]);
    DAL_EACH(i, n) d[n + i] = 2.0 * eq.block[0].u[i];
    return dal_update(s, s->h, d);
}

#define ABOUT_DISCRETE_GRADIENT                                                                    \
    "The midpoint rule in which a discrete gradient of the potential replaces its derivative "     \
    "(Gonzalez 1996), in the metric of the masses:\n"                                              \
    "$$v_1 - v_0 = h\\,a(\\bar q, \\bar v) - h\\,\\kappa\\,d + h\\,B\\,\\lambda, \\qquad d = "     \
    "q_1 - q_0 = h\\,\\bar v, \\qquad \\kappa = \\frac{U(q_1) - U(q_0) - U_q(\\bar q)\\cdot "      \
    "d}{d \\cdot W d}.$$\n"                                                                        \
    "It needs $L = \\tfrac{1}{2}\\,v \\cdot W v + g(q) \\cdot v - U(q)$ with constant $W$. The "   \
    "energy is preserved to rounding where $D$ is homogeneous in $v$ and the motion conserves "    \
    "it. $D$ vanishes at the midpoints; at the ends of steps it errs by $O(h^2)$, bounded. The "   \
    "order is 2; the method is symmetric."

DAL_INTEGRATOR(discrete_gradient, step, .name = "discrete-gradient",
               .summary = "midpoint with a discrete gradient of U", .reference = "Gonzalez 1996",
               .documentation = ABOUT_DISCRETE_GRADIENT, .order = 2, .stages = 1,
               .properties = DAL_SYMMETRIC | DAL_PRESERVES_ENERGY | DAL_PRESERVES_D_MIDPOINT,
               .needs = DAL_NEEDS_FIELD | DAL_NEEDS_BLOCKS | DAL_NEEDS_POTENTIAL,
               .kernel = DAL_KERNEL_ENFORCE | DAL_KERNEL_ENFORCEMENT | DAL_KERNEL_POTENTIAL);
