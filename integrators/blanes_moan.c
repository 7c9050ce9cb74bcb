/* blanes_moan.c - compositions of symplectic Euler with its adjoint.
 *
 *     Psi_h = Phi*_(c_1 h) o Phi_(c_2 h) o ... o Phi*_(c_2 h) o Phi_(c_1 h),     sum c_i = 1
 *
 * the same sizes both ways, Phi = symplectic Euler (1,0), new q and old v, Phi* = (0,1).
 * Compositions of both reach an order with fewer and smaller steps than compositions of a symmetric
 * method.
 *
 *     bm4         12 steps, from the splitting S_6 of order 4       Blanes, Moan, J. Comput. Appl.
 *     bm6         20 steps, from the splitting S_10 of order 6      Math. 142 (2002) 313
 *     mclachlan4  10 steps: c_1, c_2, ... = a_5, a_1, a_4, a_2, a_3 with s = sqrt(19) and a_i =
 *                 (146 + 5s)/540, (-2 + 10s)/135, 1/5, (-23 - 20s)/270, (14 - s)/108
 *                                                 McLachlan, SIAM J. Sci. Comput. 16 (1995) 151
 *
 * A splitting a_1, b_1, a_2, ... of two flows is c_1 = a_1, c_2 = b_1 - c_1, c_3 = a_2 - c_2, ....
 * Symmetric, symplectic on the lift; preserve D bilinear in (q,v).  Where F depends on q, t alone
 * two substeps have one evaluation of it. */
#include <dalembert_kernel.h>

/* clang-format off */
static const double c_bm4[] = {0.0792036964311957, 0.1303114101821663, 0.2228614958676077,
    -0.3667132690474257, 0.3246481886897062};
static const double c_bm6[] = {0.0502627644003922, 0.0985536835006498, 0.3149606169276942,
    -0.4473464826954782, 0.4924263724898759, -0.4251187677976909, 0.2370639139781219,
    0.1956024886000531, 0.3463581898507269};
static const double c_mclachlan4[] = {0.0892694542264752448866946, 0.3107305457735247551133054,
    -0.4080665884104202631286653, 0.3080665884104202631286653};
/* clang-format on */

DAL_INLINE dal_status alternate(dal_step *s, int substeps, const double *c)
{
    const dal_composition k = {substeps, c};
    const double end = s->t + s->h;
    double size[DAL_MAX_SUBSTEPS];
    dal_substeps(&k, s->h, size);
    for (int i = 0; i < substeps; i += 2)
        if (dal_failed(dal_symplectic_euler_pair(s, size[i], size[i + 1])))
            return DAL_STATUS_NOT_CONVERGED;
    s->t = end;
    return DAL_STATUS_OK;
}

#define ABOUT_BLANES_MOAN                                                                          \
    "Compositions of symplectic Euler $\\Phi_h$ with its adjoint $\\Phi^*_h$,\n"                   \
    "$$\\Psi_h = \\Phi^*_{c_1 h} \\circ \\Phi_{c_2 h} \\circ \\cdots \\circ \\Phi^*_{c_2 h} "      \
    "\\circ \\Phi_{c_1 h}, \\qquad \\sum c_i = 1,$$\n"                                             \
    "with the same coefficients both ways. They reach order 4 or 6 with smaller error constants"   \
    " than compositions of Stormer-Verlet (McLachlan 1995; Blanes, Moan 2002). The methods are "   \
    "symmetric and symplectic on the lift, and preserve $D$ that is bilinear in $(q, v)$, since"   \
    " each part does. Some $c_i$ are negative: strong friction grows in these substeps."

/* Defines a method of substeps_ substeps. */
#define ALTERNATING(identifier, substeps_, order_, name_, reference_)                              \
    DAL_INLINE dal_status step_##identifier(dal_step *s)                                           \
    {                                                                                              \
        return alternate(s, substeps_, c_##identifier);                                            \
    }                                                                                              \
    DAL_INTEGRATOR(identifier, step_##identifier, .name = name_,                                   \
                   .summary = "composition of " #substeps_ " symplectic Euler steps",              \
                   .reference = reference_, .documentation = ABOUT_BLANES_MOAN, .order = order_,   \
                   .stages = 1,                                                                    \
                   .properties = DAL_SYMMETRIC | DAL_SYMPLECTIC | DAL_PRESERVES_BILINEAR,          \
                   .needs = DAL_NEEDS_FIELD, .kernel = DAL_KERNEL_EULER | DAL_KERNEL_COMPOSITION)

ALTERNATING(mclachlan4, 10, 4, "mclachlan4", "McLachlan 1995");
ALTERNATING(bm4, 12, 4, "bm4", "Blanes, Moan 2002");
ALTERNATING(bm6, 20, 6, "bm6", "Blanes, Moan 2002");
