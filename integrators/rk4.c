/* rk4.c - the classical Runge-Kutta method.
 *
 *     k1 = f(t, y)                  k2 = f(t + h/2, y + h/2 k1)
 *     k3 = f(t + h/2, y + h/2 k2)   k4 = f(t + h, y + h k3)
 *     y1 = y + h/6 (k1 + 2 k2 + 2 k3 + k4)
 *
 * W. Kutta, Z. Math. Phys. 46 (1901) 435; Hairer, Norsett, Wanner, Solving ODEs I (1993), II.1.
 * Order 4, explicit, four evaluations; preserves D with constant coefficients, no other. */
#include <dalembert_kernel.h>

DAL_INLINE dal_status step(dal_step *s)
{
    const double t = s->t, h = s->h;
    const num half = dal_num(0.5 * h), whole = dal_num(h), two = dal_num(2.0);
    DAL_VECTOR(s, y, DAL_DIM(s));
    DAL_VECTOR(s, k, DAL_DIM(s));
    DAL_VECTOR(s, sum, DAL_DIM(s)); /* k1 + 2 k2 + 2 k3 + k4 */
    dal_field(s, t, s->y, sum);
    DAL_EACH(i, DAL_DIM(s)) y[i] = dal_fma(half, sum[i], s->y[i]);
    dal_field(s, t + 0.5 * h, y, k);
    DAL_EACH(i, DAL_DIM(s)) y[i] = dal_fma(half, k[i], s->y[i]);
    DAL_EACH(i, DAL_DIM(s)) sum[i] = dal_fma(two, k[i], sum[i]);
    dal_field(s, t + 0.5 * h, y, k);
    DAL_EACH(i, DAL_DIM(s)) y[i] = dal_fma(whole, k[i], s->y[i]);
    DAL_EACH(i, DAL_DIM(s)) sum[i] = dal_fma(two, k[i], sum[i]);
    dal_field(s, t + h, y, k);
    DAL_EACH(i, DAL_DIM(s)) sum[i] += k[i];
    return dal_update_multiple(s, h, h / 6.0, sum);
}

#define ABOUT_RK4                                                                                  \
    "The method of Kutta (1901) with four evaluations of $F$,\n"                                   \
    "$$y_1 = y_0 + \\tfrac{h}{6}\\left(k_1 + 2 k_2 + 2 k_3 + k_4\\right), \\qquad k_2 = "          \
    "f\\left(t + \\tfrac{h}{2},\\, y_0 + \\tfrac{h}{2}\\,k_1\\right), \\ldots$$\n"                 \
    "for $y = (q, v)$. The order is 4. It is neither symmetric nor symplectic and preserves "      \
    "only linear $D$ with constant coefficients; elsewhere $D$ and $E$ drift. It is here for "     \
    "comparison, and as a base of `+project`."

DAL_INTEGRATOR(rk4, step, .name = "rk4", .summary = "classical Runge-Kutta",
               .reference = "Kutta 1901", .documentation = ABOUT_RK4, .order = 4, .stages = 4,
               .properties = DAL_EXPLICIT | DAL_COMPONENTWISE, .needs = DAL_NEEDS_FIELD);
