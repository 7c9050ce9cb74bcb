/* algebra.h - vectors and small dense matrices over num, row-major. */
#ifndef DAL_KERNEL_ALGEBRA_H
#define DAL_KERNEL_ALGEBRA_H

#include "num.h"

/* In a generated file a function that is not inlined, so that its callers stay small.  It is
 * compiled for speed, also where they are compiled for size. */
#ifdef DAL_SPECIALISED
#define DAL_SEPARATE static DAL_UNUSED __attribute__((noinline, hot))
#else
#define DAL_SEPARATE DAL_INLINE
#endif

/* a.b */
DAL_INLINE num dal_scalar_product(const num *a, const num *b, int count)
{
    num sum = dal_num(0.0);
    DAL_EACH(i, count) sum += a[i] * b[i];
    return sum;
}

/* y[rows] = M x, M[rows*columns] */
DAL_INLINE void dal_multiply(const num *m, int rows, int columns, const num *x, num *y)
{
    DAL_EACH(i, rows) {
        num sum = dal_num(0.0);
        DAL_EACH(j, columns) sum = dal_fma(m[i * columns + j], x[j], sum);
        y[i] = sum;
    }
}

/* From this size on zeros are skipped, which most entries of large systems are: the sums keep their
 * bits. */
enum { DAL__SPARSE = 16 };

/* Whether x is 0 in all lanes. */
DAL_INLINE bool dal__is_zero(num x) { return !dal_any(~dal_equal(x, dal_num(0.0))); }

/* Numbers of G. */
#define DAL_SQUARE_M(s) (DAL_M(s) * DAL_M(s))

/* g[m*m] = A B, the matrix G of m constraints: A[m*n], B[n*m]. */
DAL_INLINE void dal_gram(const num *a, const num *b, int m, int n, num *DAL_RESTRICT g)
{
    DAL_EACH(i, m * m) g[i] = dal_num(0.0);
    DAL_EACH(i, m) {
        DAL_EACH(j, n) {
            const num x = a[i * n + j];
            if (n >= DAL__SPARSE && dal__is_zero(x)) continue;
            DAL_EACH(k, m) g[i * m + k] = dal_fma(x, b[j * m + k], g[i * m + k]);
        }
    }
}

/* Whether in all lanes a pivot is not 0, and count numbers from it on are finite. */
DAL_INLINE bool dal__divides(const num *pivot, int count)
{
    const dal_mask good = dal_less(dal_num(0.0), dal_abs(*pivot));
    return !dal_any(~(good & dal_equal(dal_nonfinite(pivot, count), dal_num(0.0))));
}

/* Eliminates column k below the diagonal, without pivoting, and returns g_kk: the ratio of the
 * leading minors k + 1 and k. */
DAL_INLINE num dal_eliminate(num *g, int m, int k)
{
    const bool sparse = m >= DAL__SPARSE && dal__divides(g + k * m + k, m - k);
    for (int i = k + 1; i < m; i++) {
        if (sparse && dal__is_zero(g[i * m + k])) continue;
        const num factor = g[i * m + k] / g[k * m + k];
        for (int j = k; j < m; j++) g[i * m + j] -= factor * g[k * m + j];
    }
    return g[k * m + k];
}

/* Exchanges rows a and b of m where mask is set. */
DAL_INLINE void dal__swap_rows(num *m, int columns, int a, int b, dal_mask mask)
{
    for (int j = 0; j < columns; j++) {
        const num x = m[a * columns + j], y = m[b * columns + j];
        m[a * columns + j] = dal_select(mask, y, x);
        m[b * columns + j] = dal_select(mask, x, y);
    }
}

/* Brings the largest entry of column k at or below the diagonal to the diagonal, in each lane; and
 * the rows of other[n*columns] with it. */
DAL_INLINE void dal__pivot(num *m, num *other, int n, int columns, int k)
{
    for (int i = k + 1; i < n; i++) {
        const dal_mask larger = dal_less(dal_abs(m[k * n + k]), dal_abs(m[i * n + k]));
        if (!dal_any(larger)) continue;
        dal__swap_rows(m, n, k, i, larger);
        dal__swap_rows(other, columns, k, i, larger);
    }
}

/* row i -= factor * row k */
DAL_INLINE void dal__subtract_row(num *m, int n, int i, int k, num factor)
{
    for (int j = 0; j < n; j++) m[i * n + j] -= factor * m[k * n + j];
}

/* Divides row i of a matrix by unit[i], a power of two; the units[period] repeat; NULL: 1. */
DAL_INLINE void dal__scale_rows(num *m, int rows, int columns, const double *unit, int period)
{
    for (int i = 0; unit && i < rows; i++)
        for (int j = 0; j < columns; j++) m[i * columns + j] *= 1.0 / unit[i % period];
}

/* inverse[n*n] of m[n*n], which is destroyed: Gauss-Jordan with partial pivoting in each lane.
 * Rows are compared in units[period] that repeat, powers of two; NULL: all are the same.
 * A singular matrix leaves infinities or NaN.  The callers iterate a residual to stagnation, so
 * the inverse affects the rate of convergence, not the result. */
DAL_SEPARATE void dal_invert_in_units(num *m, num *inverse, int n, const double *unit, int period)
{
    for (int i = 0; i < n * n; i++) inverse[i] = dal_num(i % (n + 1) == 0);
    dal__scale_rows(m, n, n, unit, period);
    dal__scale_rows(inverse, n, n, unit, period);
    for (int k = 0; k < n; k++) {
        dal__pivot(m, inverse, n, n, k);
        const num scale = 1.0 / m[k * n + k];
        for (int j = 0; j < n; j++) {
            m[k * n + j] *= scale;
            inverse[k * n + j] *= scale;
        }
        for (int i = 0; i < n; i++) {
            if (i == k) continue;
            const num factor = m[i * n + k];
            dal__subtract_row(m, n, i, k, factor);
            dal__subtract_row(inverse, n, i, k, factor);
        }
    }
}

/* The same where the rows have one unit. */
DAL_INLINE void dal_invert(num *m, num *inverse, int n)
{
    dal_invert_in_units(m, inverse, n, NULL, 1);
}

/* x <- m^-1 x for a vector x[n] by elimination with the same pivots; m is destroyed.  Rows with
 * 0 below the pivot are left alone, as most have where constraints couple a few neighbours. */
DAL_SEPARATE void dal_eliminate_in_units(num *m, num *x, int n, const double *unit, int period)
{
    dal__scale_rows(m, n, n, unit, period);
    dal__scale_rows(x, n, 1, unit, period);
    for (int k = 0; k < n; k++) {
        dal__pivot(m, x, n, 1, k);
        for (int i = k + 1; i < n; i++) {
            if (dal__is_zero(m[i * n + k])) continue;
            const num factor = m[i * n + k] / m[k * n + k];
            for (int j = k + 1; j < n; j++)
                m[i * n + j] = dal_fma(-factor, m[k * n + j], m[i * n + j]);
            x[i] = dal_fma(-factor, x[k], x[i]);
        }
    }
    for (int k = n; k-- > 0;) {
        for (int j = k + 1; j < n; j++) x[k] = dal_fma(-m[k * n + j], x[j], x[k]);
        x[k] /= m[k * n + k];
    }
}

#endif
