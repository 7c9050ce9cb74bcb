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

DAL_INTEGRATOR(implicit_midpoint, step, .name = "implicit-midpoint",
               .summary = "implicit midpoint rule",
               .reference = "Hairer, Lubich, Wanner 2006, II.1", .order = 2, .stages = 1,
               .properties = DAL_SYMMETRIC | DAL_SYMPLECTIC | DAL_PRESERVES_QUADRATIC |
                             DAL_EXTRAPOLATES_STAGES,
               .needs = DAL_NEEDS_FIELD, .kernel = DAL_KERNEL_COLLOCATION);
