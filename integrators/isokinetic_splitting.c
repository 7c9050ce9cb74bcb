/* isokinetic_splitting.c - exact pieces of a motion of constant kinetic energy.
 *
 *     qh = q0 + h/2 v0,    v0 -> v1 with the force f(qh, t + h/2) frozen,    q1 = qh + h/2 v1
 *
 * With D = k (v.Wv/2 - K) the second piece is exact.  With a = W^-1 f, alpha = f.v/2K, b = f.a/2K,
 * x = sqrt(b) h/2 and g(x) = sinh(x)/x,
 *
 *     v1 = (v0 + s a)/(1 + r)
 *     s = h (alpha h/2 g(x)^2 + g(2x)),   r = alpha h g(2x) + 2 x^2 g(x)^2
 *
 * D. Minary, G. Martyna, M. Tuckerman, J. Chem. Phys. 118 (2003) 2510; Tuckerman, Statistical
 * Mechanics (2010), 4.12.  For an indefinite W sinh becomes sin where b < 0.  All comes
 * from A = k W v: 2K = v.A/k, f.v = a.A(v)/k, f.a = a.A(a)/k.  Order 2, symmetric, explicit, keeps
 * D. */
#include <dalembert_kernel.h>

typedef struct growth {
    num g, g2; /* g(x), g(2x) */
} growth;

/* Below this |x| the series of g to x^2 is exact to rounding: what is left out is x^4/120. */
#define SHORT (DAL_ULP_RATIO < 1.0 ? 1e-8 : 1e-4)

/* For xx = x^2. */
DAL_INLINE growth grow(num xx)
{
    const num x = dal_sqrt(dal_abs(xx)), far = dal_max(x, dal_num(SHORT));
    const dal_mask turns = dal_less(xx, dal_num(0.0)), is_short = dal_less(x, dal_num(SHORT));
    const num g = dal_select(turns, dal_sin(far), dal_sinh(far)) / far;
    const num cosine = dal_select(turns, dal_cos(x), dal_cosh(x));
    growth out;
    out.g = dal_select(is_short, 1.0 + xx / 6.0, g);
    out.g2 = out.g * cosine;
    return out;
}

/* dv = v1 - v0 of the second piece, at q. */
DAL_INLINE void turn(dal_step *s, const num *q, num *dv)
{
    const int n = DAL_N(s), at_A = dal_blocks_A(s);
    const double h = s->h, t = s->t + 0.5 * h;
    const num *v = s->y + n;
    DAL_VECTOR(s, blocks, DAL_BLOCKS_SIZE(s));
    DAL_VECTOR(s, along, DAL_CONSTRAINT_SIZE(s));
    dal_eval_blocks(s, t, q, v, blocks);
    const num *a = blocks + dal_blocks_a(s), *A = blocks + at_A;
    dal_constraint(s, t, q, a, along);
    const num twice = dal_scalar_product(v, A, n), alpha = dal_scalar_product(a, A, n) / twice;
    const num xx = 0.25 * (h * h) * (dal_scalar_product(a, along + at_A, n) / twice);
    const growth k = grow(xx);
    const num push = h * (0.5 * h * alpha * (k.g * k.g) + k.g2);
    const num stretch = h * alpha * k.g2 + 2.0 * xx * (k.g * k.g);
    DAL_EACH(i, n) dv[i] = (push * a[i] - stretch * v[i]) / (1.0 + stretch);
}

DAL_INLINE dal_status step(dal_step *s)
{
    const int n = DAL_N(s);
    const double h = s->h;
    DAL_VECTOR(s, q, DAL_N(s));
    DAL_VECTOR(s, d, DAL_DIM(s));
    DAL_EACH(i, n) q[i] = dal_moved_q(s, i, 0.5 * h * s->y[n + i]);
    turn(s, q, d + n);
    DAL_EACH(i, n) d[i] = 0.5 * h * (s->y[n + i] + dal_moved_v(s, i, d[n + i]));
    return dal_update(s, h, d);
}

#define ABOUT_ISOKINETIC_SPLITTING                                                                 \
    "Exact pieces of a motion whose kinetic energy is constant, $D = k\\,(v \\cdot W v/2 - K)$:"   \
    " half a drift, a turn of $v$ under the frozen force $f(q_h)$, half a drift. With $a = "       \
    "W^{-1} f$, $\\alpha = f \\cdot v/2K$ and $b = f \\cdot a/2K$ the turn is\n"                   \
    "$$v_1 = \\frac{v_0 + s\\,a}{1 + r}, \\qquad s = h\\left(\\tfrac{\\alpha h}{2}\\,g(x)^2 + "    \
    "g(2x)\\right), \\qquad r = \\alpha h\\,g(2x) + 2 x^2 g(x)^2, \\qquad x = "                    \
    "\\tfrac{h}{2}\\sqrt{b}, \\quad g(x) = \\frac{\\sinh x}{x}$$\n"                                \
    "(Minary, Martyna, Tuckerman 2003). The order is 2; the method is explicit and symmetric "     \
    "and preserves this $D$. It is refused for any other constraint."

DAL_INTEGRATOR(isokinetic_splitting, step, .name = "isokinetic-splitting",
               .summary = "exact turns and drifts at constant kinetic energy",
               .reference = "Minary, Martyna, Tuckerman 2003",
               .documentation = ABOUT_ISOKINETIC_SPLITTING, .order = 2, .stages = 1,
               .properties = DAL_SYMMETRIC | DAL_PRESERVES_D | DAL_EXPLICIT,
               .needs = DAL_NEEDS_FIELD | DAL_NEEDS_BLOCKS | DAL_NEEDS_ISOKINETIC,
               .kernel = DAL_KERNEL_FUNCTIONS | DAL_KERNEL_BLOCKS | DAL_KERNEL_CONSTRAINT);
