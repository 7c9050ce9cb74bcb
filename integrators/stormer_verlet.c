/* stormer_verlet.c - generalised Stormer-Verlet, polarisation (1,0).
 *
 *     qh = q + h/2 v,   vh = v + h/2 F(qh, v)
 *     v1 = vh + h/2 F(qh, v1)                     (solved to rounding)
 *     q1 = qh + h/2 v1
 *
 * The composition of symplectic Euler (1,0) with its adjoint; Hairer, Lubich, Wanner,
 * Geometric Numerical Integration (2006), VI.3.  Order 2, symmetric, symplectic on the lift;
 * preserves D bilinear in (q,v).  Where F depends on q and t alone it is the leapfrog, with one
 * evaluation a step. */
#include <dalembert_kernel.h>

DAL_INLINE dal_status step(dal_step *s)
{
    const double half = 0.5 * s->h;
    return dal_symplectic_euler_pair(s, half, half);
}

#define ABOUT_STORMER_VERLET                                                                       \
    "Half a step of symplectic Euler and half a step of its adjoint:\n"                            \
    "$$q_h = q_0 + \\tfrac{h}{2}\\,v_0, \\qquad v_1 = v_0 + \\tfrac{h}{2}\\left(F(q_h, v_0) + "    \
    "F(q_h, v_1)\\right), \\qquad q_1 = q_h + \\tfrac{h}{2}\\,v_1.$$\n"                            \
    "The order is 2; the method is symmetric and symplectic on the lift, and preserves $D$ that"   \
    " is bilinear in $(q, v)$ (Hairer, Lubich, Wanner 2006, VI.3). Where $F$ depends on $v$ the"   \
    " new velocity is solved for, to rounding. Where it does not, this is the leapfrog method "    \
    "with one evaluation of $F$ a step."

DAL_INTEGRATOR(stormer_verlet, step, .name = "stormer-verlet",
               .summary = "generalised Stormer-Verlet",
               .reference = "Hairer, Lubich, Wanner 2006, VI.3",
               .documentation = ABOUT_STORMER_VERLET, .order = 2, .stages = 1,
               .properties = DAL_SYMMETRIC | DAL_SYMPLECTIC | DAL_PRESERVES_BILINEAR,
               .needs = DAL_NEEDS_FIELD, .kernel = DAL_KERNEL_EULER);
