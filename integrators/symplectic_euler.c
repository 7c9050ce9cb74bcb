/* symplectic_euler.c - symplectic Euler in every polarisation (s_q, s_v) of the pairs (q,p),
 * (v,pi).
 *
 *     (0,0)  q1 = q + h v    v1 = v + h F(q, v)      explicit Euler on p = pi = 0
 *     (1,0)  q1 = q + h v    v1 = v + h F(q1, v)     explicit on p = pi = 0
 *     (0,1)  v1 = v + h F(q, v1)    q1 = q + h v1    v1 solved to rounding
 *     (1,1)  v1 = v + h F(q1, v1)   q1 = q + h v1    implicit Euler on p = pi = 0
 *
 * with the momenta as in dal_symplectic_euler.  Hairer, Lubich, Wanner, Geometric Numerical
 * Integration (2006), VI.3.  Order 1, symplectic on the lift whatever the polarisation; (1,0) and
 * (0,1) preserve D bilinear in (q,v). */
#include <dalembert_kernel.h>

static DAL_UNUSED const char reference[] = "Hairer, Lubich, Wanner 2006, VI.3";

DAL_INLINE dal_status step_00(dal_step *s)
{
    return dal_symplectic_euler(s, DAL_POLARISATION(0, 0), s->h);
}

#define ABOUT_SYMPLECTIC_EULER                                                                     \
    "One explicit or implicit Euler step for each member of the pairs $(q, p)$ and $(v, \\pi)$;"   \
    " two digits say whether $F$ is evaluated at the new $q$ and at the new $v$. For 10 these "    \
    "are\n"                                                                                        \
    "$$q_1 = q_0 + h\\,v_0, \\qquad v_1 = v_0 + h\\,F(q_1, v_0),$$\n"                              \
    "for 01 the same with the old $q$ and the new $v$ in $F$, and $q_1 = q_0 + h\\,v_1$. 00 is "   \
    "the explicit and 11 the implicit Euler method on $(q, v)$. All have order 1 and are "         \
    "symplectic on the lift (Hairer, Lubich, Wanner 2006, VI.3), which implies nothing about "     \
    "$D$ or $E$. 10 and 01 preserve $D$ that is bilinear in $(q, v)$; 00 and 11 preserve no "      \
    "more than linear $D$ with constant coefficients."

DAL_INTEGRATOR(symplectic_euler_00, step_00, .name = "symplectic-euler-00",
               .summary = "symplectic Euler; explicit Euler on (q,v)", .reference = reference,
               .documentation = ABOUT_SYMPLECTIC_EULER, .order = 1, .stages = 1,
               .properties = DAL_SYMPLECTIC | DAL_EXPLICIT | DAL_COMPONENTWISE,
               .needs = DAL_NEEDS_FIELD, .kernel = DAL_KERNEL_EULER);

DAL_INLINE dal_status step_10(dal_step *s)
{
    return dal_symplectic_euler(s, DAL_POLARISATION(1, 0), s->h);
}

DAL_INTEGRATOR(symplectic_euler_10, step_10, .name = "symplectic-euler-10",
               .alias = "symplectic-euler", .summary = "symplectic Euler, new q and old v",
               .reference = reference, .documentation = ABOUT_SYMPLECTIC_EULER, .order = 1,
               .stages = 1,
               .properties = DAL_SYMPLECTIC | DAL_PRESERVES_BILINEAR | DAL_EXPLICIT |
                             DAL_COMPONENTWISE,
               .needs = DAL_NEEDS_FIELD, .kernel = DAL_KERNEL_EULER);

DAL_INLINE dal_status step_01(dal_step *s)
{
    return dal_symplectic_euler(s, DAL_POLARISATION(0, 1), s->h);
}

DAL_INTEGRATOR(symplectic_euler_01, step_01, .name = "symplectic-euler-01",
               .summary = "symplectic Euler, old q and new v", .reference = reference,
               .documentation = ABOUT_SYMPLECTIC_EULER, .order = 1, .stages = 1,
               .properties = DAL_SYMPLECTIC | DAL_PRESERVES_BILINEAR, .needs = DAL_NEEDS_FIELD,
               .kernel = DAL_KERNEL_EULER);

DAL_INLINE dal_status step_11(dal_step *s)
{
    return dal_symplectic_euler(s, DAL_POLARISATION(1, 1), s->h);
}

DAL_INTEGRATOR(symplectic_euler_11, step_11, .name = "symplectic-euler-11",
               .summary = "symplectic Euler; implicit Euler on (q,v)", .reference = reference,
               .documentation = ABOUT_SYMPLECTIC_EULER, .order = 1, .stages = 1,
               .properties = DAL_SYMPLECTIC, .needs = DAL_NEEDS_FIELD, .kernel = DAL_KERNEL_EULER);
