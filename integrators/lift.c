/* lift.c - the modifier NAME+lift: the exact cotangent lift of an explicit Runge-Kutta step.
 *
 *     x1 = Phi(x),   P1 = DPhi(x)^-T P                 x = (q, v), P = (p, pi), Phi = step of NAME
 *
 * is symplectic for every Phi with invertible DPhi, and on P = 0 has the bits of NAME.  The columns
 * of DPhi come from Phi itself: a Runge-Kutta step of  x' = f, dx' = Df dx  is (Phi, DPhi dx)
 * exactly.  Where mu_e is not of t alone, x is (q, v, e) and P (p, pi, pi_e).  With columns
 * c_j = DPhi u_j - u_j of the unit vectors,
 *
 *     (1 + C)^T d = -C^T P,   P1 = P + d
 *
 * The rest of H, pi.K pi/(2e), is a flow v' = K pi/e, p' = -(pi.K pi)_q/(2e),
 * pi_e' = pi.K pi/(2e^2) where K does not depend on v, half before and half after (Strang 1968).
 * Sanz-Serna, SIAM Rev. 58 (2016) 3, has the principle.  Order: as of NAME on p = pi = 0 and where
 * 1/e = 0, else 2.  Costs 2n steps of NAME with F_q, F_v. */
#include <dalembert_kernel.h>

/* The flow of pi.K pi/(2e) over a time h; where pi = 0, q, v have the bits of NAME. */
DAL_INLINE void drift(dal_step *s, double h)
{
    const int n = DAL_N(s);
    const num *pi = s->y + dal_at_pi(s), *K_pi = pi, w = 1.0 / s->y[dal_at_e(s)];
    DAL_VECTOR(s, d, DAL_N(s));
    DAL_VECTOR(s, effort, 3 * DAL_EFFORT(s) * DAL_N(s));
#if DAL_WITH(EFFORT)
    if (DAL_EFFORT(s)) {
        dal_eval(s, DAL_EVAL_EFFORT, s->t, s->y, s->y + n, pi, effort);
        K_pi = effort;
    }
#endif
    num rate = h * dal_gauge_rate(pi, K_pi, n, w);
    DAL_EACH(i, n) d[i] = h * (K_pi[i] * w);
    const dal_mask alive = s->alive;
    s->alive &= ~dal_equal(rate, dal_num(0.0));
    dal_add(s, n, n, d);
    DAL_EACH(i, DAL_EFFORT(s) * n) d[i] = -h * (effort[n + i] * w);
    dal_add(s, dal_at_p(s), DAL_EFFORT(s) * n, d);
    dal_add(s, dal_at_pi_e(s), 1, &rate);
    s->alive = alive;
}

/* Puts numbers into the state, in the lanes alive. */
DAL_INLINE void put(dal_step *s, int first, int count, const num *y, const num *r)
{
    DAL_EACH(i, count) {
        s->y[first + i] = dal_select(s->alive, y[i], s->y[first + i]);
        s->r[first + i] = dal_select(s->alive, r[i], s->r[first + i]);
    }
}

/* Numbers of x: with a mu_e(q, v, e, t) there is a column of e, too, and a row. */
#define SIZE(s) (2 * DAL_N(s) + DAL_GAUGE(s))

/* column = DPhi u - u, u the unit vector number j; unit and zero are scratch, [SIZE]. */
DAL_INLINE dal_status differentiate(dal_step *s, int j, num *unit, num *zero, num *column)
{
    const int p = dal_at_p(s), size = SIZE(s);
    for (int i = 0; i < size; i++) unit[i] = dal_num(i == j);
    for (int i = 0; i < size; i++) zero[i] = dal_num(0.0);
    put(s, p, size, unit, zero);
    dal_begin_tangent(s);
    const dal_status status = dal_inner(s, s->h);
    dal_end_tangent(s);
    for (int i = 0; i < size; i++) column[i] = (s->y[p + i] - unit[i]) + s->r[p + i];
    return status;
}

/* d = -(1 + C)^-T C^T P; the columns are the rows of C^T and become the columns of (1 + C)^T. */
DAL_INLINE void pull(dal_step *s, num *columns, const num *momenta, num *d)
{
    const int size = SIZE(s);
    DAL_VECTOR(s, inverse, SIZE(s) * SIZE(s));
    DAL_VECTOR(s, image, SIZE(s));
    dal_multiply(columns, size, size, momenta, image);
    for (int i = 0; i < size; i++) columns[i * size + i] += 1.0;
    dal_invert(columns, inverse, size);
    dal_multiply(inverse, size, size, image, d);
    for (int i = 0; i < size; i++) d[i] = -d[i];
}

/* (x, e, P) -> (Phi(x), e1, DPhi^-T P) */
DAL_INLINE dal_status flow(dal_step *s)
{
    const int p = dal_at_p(s), size = SIZE(s);
    const double t = s->t;
    DAL_VECTOR(s, y, DAL_DIM(s));
    DAL_VECTOR(s, r, DAL_DIM(s));
    DAL_VECTOR(s, columns, SIZE(s) * SIZE(s));
    DAL_VECTOR(s, unit, SIZE(s));
    DAL_VECTOR(s, d, SIZE(s));
    for (int i = 0; i < p + size; i++) y[i] = s->y[i];
    for (int i = 0; i < p + size; i++) r[i] = s->r[i];
    for (int j = 0; j < size; j++) {
        put(s, 0, p, y, r);
        s->t = t;
        const dal_status status = differentiate(s, j, unit, d, columns + j * size);
        if (dal_failed(status)) return status;
    }
    pull(s, columns, y + p, d);
    put(s, p, size, y + p, r + p);
    dal_add(s, p, size, d);
    return DAL_STATUS_OK;
}

DAL_INLINE dal_status step(dal_step *s)
{
    if (!DAL_LIFTED(s)) return dal_inner(s, s->h);
    drift(s, 0.5 * s->h);
    const dal_status status = flow(s);
    if (dal_failed(status)) return status;
    drift(s, 0.5 * s->h);
    return DAL_STATUS_OK;
}

#define ABOUT_LIFT                                                                                 \
    "The cotangent lift of an explicit Runge-Kutta step $\\Phi$, with $x = (q, v)$ and $P = (p,"   \
    " \\pi)$:\n"                                                                                   \
    "$$x_1 = \\Phi(x_0), \\qquad P_1 = D\\Phi(x_0)^{-T} P_0.$$\n"                                  \
    "It is symplectic for every $\\Phi$ whose derivative has an inverse (Sanz-Serna 2016), and "   \
    "has the bits of $\\Phi$ where $P = 0$: that is why symplecticity on the lift says nothing "   \
    "about the motion. The lift has the order of $\\Phi$ on $p = \\pi = 0$, and order 2 "          \
    "elsewhere unless $1/e = 0$."

DAL_INTEGRATOR(
    lift, step, .name = "lift",
    .summary = "cotangent lift of an explicit Runge-Kutta method; order 2 off p = pi = 0",
    .reference = "Sanz-Serna 2016", .documentation = ABOUT_LIFT, .stages = 4,
    .properties = DAL_MODIFIER | DAL_SYMPLECTIC,
    .needs = DAL_NEEDS_RUNGE_KUTTA | DAL_NEEDS_JACOBIAN,
    .kernel = DAL_KERNEL_ALGEBRA | DAL_KERNEL_TANGENT, .inherits = DAL_EXPLICIT);
