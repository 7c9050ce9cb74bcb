/* heun.c - Heun's method.
 *
 *     k1 = f(t, y),   k2 = f(t + h, y + h k1),   y1 = y + h/2 (k1 + k2)
 *
 * Order 2, explicit, two evaluations; preserves D with constant coefficients, no other. */
#include <dalembert_kernel.h>

DAL_INLINE dal_status step(dal_step *s)
{
    const num whole = dal_num(s->h);
    DAL_VECTOR(s, k1, DAL_DIM(s));
    DAL_VECTOR(s, k2, DAL_DIM(s));
    DAL_VECTOR(s, y, DAL_DIM(s));
    dal_field(s, s->t, s->y, k1);
    DAL_EACH(i, DAL_DIM(s)) y[i] = dal_fma(whole, k1[i], s->y[i]);
    dal_field(s, s->t + s->h, y, k2);
    DAL_EACH(i, DAL_DIM(s)) k1[i] += k2[i];
    return dal_update_multiple(s, s->h, 0.5 * s->h, k1);
}

DAL_INTEGRATOR(heun, step, .name = "heun", .summary = "Heun's method", .reference = "Heun 1900",
               .order = 2, .stages = 2, .properties = DAL_EXPLICIT | DAL_COMPONENTWISE,
               .needs = DAL_NEEDS_FIELD);
