/* tableau.h - the coefficients of an implicit Runge-Kutta method, and sums weighted by them.
 *
 * Each coefficient is head + tail, the head a multiple of 1/1024, so that products with heads err
 * little and the coefficients' own rounding does not drive a long run one way (Hairer, McLachlan,
 * Razakarivony, BIT 48 (2008) 231). */
#ifndef DAL_KERNEL_TABLEAU_H
#define DAL_KERNEL_TABLEAU_H

#include "eigensystem.h"

#if DAL_WITH(TABLEAU)
/* The coefficients of a method with s stages; tails may be NULL. */
typedef struct dal_tableau {
    int stages;                           /* s */
    const double *c;                      /* [s] */
    const double *b, *b_tail;             /* [s] multiples of 1/1024, and the rest */
    const double *a, *a_tail;             /* [s*s] */
    const double *extrapolation;          /* [s*s] Lagrange basis l_j(1 + c_i) on the nodes */
    const double *partner, *partner_tail; /* [s*s] of w and p, where a belongs to q, e and pi */
    const dal_eigensystem *eigensystem;   /* of a = partner; NULL: none */
} dal_tableau;

DAL_INLINE const double *dal__tail(const double *tail, int first)
{
    return tail ? tail + first : tail;
}

/* sum_j weight_j x[j*stride], heads and tails (NULL: all 0) summed apart. */
DAL_INLINE num dal__weighted(const double *head, const double *tail, int stages, const num *x,
                             int stride)
{
    num large = head[0] * x[0];
    DAL_EACH(i, stages - 1) large = dal_fma(dal_num(head[i + 1]), x[(i + 1) * stride], large);
    if (!tail) return large;
    num small = tail[0] * x[0];
    DAL_EACH(i, stages - 1) small = dal_fma(dal_num(tail[i + 1]), x[(i + 1) * stride], small);
    return large + small;
}

/* The statement with a constant STAGES where there are few: the sum over the stages then unrolls,
 * and the loop over components uses vector registers. */
#define DAL__BY_STAGES(stages, statement)                                                          \
    switch (stages) {                                                                              \
    case 1: {                                                                                      \
        enum { STAGES = 1 };                                                                       \
        statement;                                                                                 \
    } break;                                                                                       \
    case 2: {                                                                                      \
        enum { STAGES = 2 };                                                                       \
        statement;                                                                                 \
    } break;                                                                                       \
    case 3: {                                                                                      \
        enum { STAGES = 3 };                                                                       \
        statement;                                                                                 \
    } break;                                                                                       \
    default: {                                                                                     \
        const int STAGES = (stages);                                                               \
        statement;                                                                                 \
    }                                                                                              \
    }

/* out = sum_j weight_j x_j for count components side by side; out must not overlap x. */
DAL_INLINE void dal__weighted_all(const double *head, const double *tail, int stages, const num *x,
                                  int stride, int count, num *DAL_RESTRICT out)
{
    DAL__BY_STAGES(stages,
                   DAL_EACH(c, count) out[c] = dal__weighted(head, tail, STAGES, x + c, stride));
}

/* Coefficients rounded to one double each, for Newton's matrix. */
DAL_INLINE void dal__rounded(int count, const double *head, const double *tail, double *a)
{
    for (int i = 0; i < count; i++) a[i] = head[i] + (tail ? tail[i] : 0.0);
}
#endif
#endif
