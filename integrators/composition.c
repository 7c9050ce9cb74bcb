/* composition.c - the modifiers NAME+yoshida4, +suzuki4, ...: symmetric compositions.
 *
 *     Psi_h = Phi_(c_1 h) o Phi_(c_2 h) o ... o Phi_(c_2 h) o Phi_(c_1 h),     sum c_i = 1
 *
 * of a symmetric method Phi of order 2; the c_i annihilate its error terms up to the order in the
 * name.  Symmetric; symplectic where Phi is, and preserves the D that Phi preserves.  Each has c_i
 * < 0 (Sheng 1989; Suzuki, J. Math. Phys. 32 (1991) 400): steps backwards, which grow under strong
 * friction.
 *
 *     yoshida4    c_1 = 1/(2 - 2^(1/3)), 3 steps        Yoshida, Phys. Lett. A 150 (1990) 262
 *     suzuki4     c_1 = c_2 = 1/(4 - 4^(1/3)), 5 steps  Suzuki, Phys. Lett. A 146 (1990) 319
 *     yoshida6    solution A, 7 steps                   Yoshida 1990
 *     kahan-li6   9 steps                               Kahan, Li, Math. Comp. 66 (1997) 1089
 *     suzuki8     15 steps            Suzuki, Umeno, Springer Proc. Phys. 76 (1993) 74; McLachlan,
 *                                     SIAM J. Sci. Comput. 16 (1995) 151
 *     kahan-li8   17 steps                              Kahan, Li 1997
 *     sofroniou10 35 steps            Sofroniou, Spaletta, Optim. Methods Softw. 20 (2005) 597
 *
 * Digits as in Hairer, Lubich, Wanner, Geometric Numerical Integration (2006), V.3.2. */
#include <dalembert_kernel.h>

/* clang-format off */
static const double c_yoshida4[] = {1.35120719195965763404768781};
static const double c_suzuki4[] = {0.41449077179437573714235406, 0.41449077179437573714235406};
static const double c_yoshida6[] = {0.78451361047755726381949763, 0.23557321335935813368479318,
    -1.17767998417887100694641568};
static const double c_kahan_li6[] = {0.39216144400731413927925056, 0.33259913678935943859974864,
    -0.70624617255763935980996482, 0.08221359629355080023149045};
static const double c_suzuki8[] = {0.74167036435061295344822780, -0.40910082580003159399730010,
    0.19075471029623837995387626, -0.57386247111608226665638773, 0.29906418130365592384446354,
    0.33462491824529818378495798, 0.31529309239676659663205666};
static const double c_kahan_li8[] = {0.13020248308889008087881763, 0.56116298177510838456196441,
    -0.38947496264484728640807860, 0.15884190655515560089621075, -0.39590389413323757733623154,
    0.18453964097831570709183254, 0.25837438768632204729397911, 0.29501172360931029887096624};
static const double c_sofroniou10[] = {0.07879572252168641926390768, 0.31309610341510852776481247,
    0.02791838323507806610952027, -0.22959284159390709415121340, 0.13096206107716486317465686,
    -0.26973340565451071434460973, 0.07497334315589143566613711, 0.11199342399981020488957508,
    0.36613344954622675119314812, -0.39910563013603589787862981, 0.10308739852747107731580277,
    0.41143087395589023782070412, -0.00486636058313526176219566, -0.39203335370863990644808194,
    0.05194250296244964703718290, 0.05066509075992449633587434, 0.04967437063972987905456880};
/* clang-format on */

DAL_INLINE dal_status compose(dal_step *s, int substeps, const double *c)
{
    const dal_composition k = {substeps, c};
    const double end = s->t + s->h;
    double size[DAL_MAX_SUBSTEPS];
    dal_substeps(&k, s->h, size);
    for (int i = 0; i < substeps; i++) {
        const dal_status status = dal_inner(s, size[i]);
        if (dal_failed(status)) return status;
    }
    s->t = end;
    return DAL_STATUS_OK;
}

#define ABOUT_COMPOSITION                                                                          \
    "Symmetric compositions of a symmetric method $\\Phi_h$ of order 2,\n"                         \
    "$$\\Psi_h = \\Phi_{c_1 h} \\circ \\Phi_{c_2 h} \\circ \\cdots \\circ \\Phi_{c_2 h} \\circ "   \
    "\\Phi_{c_1 h}, \\qquad \\sum c_i = 1,$$\n"                                                    \
    "where the $c_i$ annihilate the terms of the error up to the order in the name; with three "   \
    "substeps $c_1 = 1/(2 - 2^{1/3})$ gives order 4 (Yoshida 1990; Suzuki 1990; Suzuki, Umeno "    \
    "1993; McLachlan 1995; Kahan, Li 1997; Sofroniou, Spaletta 2005). What $\\Phi_h$ preserves "   \
    "is preserved: symmetry, symplecticity"                                                        \
    " on the lift, its $D$ and its energy. Each has negative $c_i$: strong friction grows in "     \
    "these substeps."

/* Defines a modifier of substeps_ substeps. */
#define COMPOSITION(identifier, substeps_, order_, name_, reference_)                              \
    DAL_INLINE dal_status step_##identifier(dal_step *s)                                           \
    {                                                                                              \
        return compose(s, substeps_, c_##identifier);                                              \
    }                                                                                              \
    DAL_INTEGRATOR(identifier, step_##identifier, .name = name_,                                   \
                   .summary = "composition of " #substeps_ " steps of a symmetric method",         \
                   .reference = reference_, .documentation = ABOUT_COMPOSITION, .order = order_,   \
                   .properties = DAL_MODIFIER, .needs = DAL_NEEDS_SYMMETRIC | DAL_NEEDS_ORDER_2,   \
                   .kernel = DAL_KERNEL_COMPOSITION,                                               \
                   .inherits = DAL_SYMMETRIC | DAL_SYMPLECTIC | DAL_PRESERVES_BILINEAR |           \
                               DAL_PRESERVES_QUADRATIC | DAL_PRESERVES_D | DAL_EXPLICIT |          \
                               DAL_PRESERVES_ENERGY | DAL_PRESERVES_HOLONOMIC)

COMPOSITION(yoshida4, 3, 4, "yoshida4", "Yoshida 1990");
COMPOSITION(suzuki4, 5, 4, "suzuki4", "Suzuki 1990");
COMPOSITION(yoshida6, 7, 6, "yoshida6", "Yoshida 1990, solution A");
COMPOSITION(kahan_li6, 9, 6, "kahan-li6", "Kahan, Li 1997");
COMPOSITION(suzuki8, 15, 8, "suzuki8", "Suzuki, Umeno 1993; McLachlan 1995");
COMPOSITION(kahan_li8, 17, 8, "kahan-li8", "Kahan, Li 1997");
COMPOSITION(sofroniou10, 35, 10, "sofroniou10", "Sofroniou, Spaletta 2005");
