/* implicit_midpoint.c - the implicit midpoint rule.
 *
 *     y1 = y + h f(t + h/2, (y + y1)/2)           (solved to rounding)
 *
 * The Gauss method with one stage; Hairer, Lubich, Wanner, Geometric Numerical Integration (2006),
 * II.1.  Order 2, symmetric, symplectic on the lift; preserves D quadratic in (q,v). */
#include <dalembert_kernel.h>

static const double half[] = {0.5}, one[] = {1.0};

static const dal_tableau tableau = {1, half, one, NULL, half, NULL, one, half, NULL, NULL};

DAL_INLINE dal_status step(dal_step *s) { return dal_collocation(s, &tableau); }

#define ABOUT_IMPLICIT_MIDPOINT                                                                    \
    "The Gauss method with one stage,\n"                                                           \
    "$$y_1 = y_0 + h\\,f\\left(t + \\tfrac{h}{2},\\; \\tfrac{1}{2}(y_0 + y_1)\\right),$$\n"        \
    "solved to rounding (Hairer, Lubich, Wanner 2006, II.1). The order is 2; the method is "       \
    "symmetric, symplectic on the lift, and preserves every $D$ that is quadratic in $(q, v)$. "   \
    "The energy is not preserved, not even a quadratic one, because the stage has $D \\ne 0$."

DAL_INTEGRATOR(implicit_midpoint, step, .name = "implicit-midpoint",
               .summary = "implicit midpoint rule",
               .reference = "Hairer, Lubich, Wanner 2006, II.1",
               .documentation = ABOUT_IMPLICIT_MIDPOINT, .order = 2, .stages = 1,
               .properties = DAL_SYMMETRIC | DAL_SYMPLECTIC | DAL_PRESERVES_QUADRATIC |
                             DAL_EXTRAPOLATES_STAGES,
               .needs = DAL_NEEDS_FIELD, .kernel = DAL_KERNEL_COLLOCATION);
