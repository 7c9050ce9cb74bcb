/* observables.h - the observables that are not formulas of the system, for runs in double and in
 * quad precision and for generated files. */
#ifndef DAL_KERNEL_OBSERVABLES_H
#define DAL_KERNEL_OBSERVABLES_H

#include "num.h"

#if DAL_WITH(LIFT)
/* H = pi.K pi/(2e) + pi.F + p.v + mu_e pi_e and the max norms of p, pi, pi_e, out[4], of the state
 * y[4n + 2], where f[n] is F, K_pi[n] is K pi and mu is mu_e. */
DAL_INLINE void dal_lift_observables(const num *y, int n, const num *f, const num *K_pi, num mu,
                                     num *out)
{
    const num *v = y + n, *p = y + 2 * n + 1, *pi = y + 3 * n + 1;
    num sum = dal_num(0.0);
    DAL_EACH(i, n) sum += pi[i] * K_pi[i] * (0.5 / y[2 * n]) + pi[i] * f[i] + p[i] * v[i];
    out[0] = sum + mu * y[4 * n + 1];
    out[1] = out[2] = dal_num(0.0);
    DAL_EACH(i, n) {
        out[1] = dal_max(out[1], dal_abs(p[i]));
        out[2] = dal_max(out[2], dal_abs(pi[i]));
    }
    out[3] = dal_abs(y[4 * n + 1]);
}
#endif

#if DAL_WITH(REACTIONS)
/* out[m + n]: h and R = B^T h, from h[m] and, after it, B[m*n]. */
DAL_INLINE void dal_reaction_observables(const num *h, int m, int n, num *out)
{
    const num *B = h + m;
    DAL_EACH(a, m) out[a] = h[a];
    DAL_EACH(i, n) {
        num sum = dal_num(0.0);
        DAL_EACH(a, m) sum += B[a * n + i] * h[a];
        out[m + i] = sum;
    }
}
#endif

#if DAL_WITH(EXACT)
/* max |a_i - b_i|; NaN where one of them is. */
DAL_INLINE num dal_max_distance(const num *a, const num *b, int count)
{
    num max = dal_num(0.0), nan = dal_num(0.0);
    DAL_EACH(i, count) {
        const num distance = dal_abs(a[i] - b[i]);
        max = dal_max(max, distance);
        nan = dal_select(dal_equal(distance, distance), nan, distance);
    }
    return dal_select(dal_equal(nan, nan), max, nan);
}
#endif

#endif
