/* eigensystem.h - Newton's matrix of a Runge-Kutta method, by the eigenvectors of its coefficients.
 *
 *     A = (a_ij) = sum_e lambda_e w_e l_e^T,     l_e^T w_e = 1
 *
 * The matrix of the stage equations, 1 - z A x F_v - z^2 A^2 x F_q of stages*width rows, acts on
 * w_e x y as w_e x N_e y, N_e = 1 - (z lambda_e) F_v - (z lambda_e)^2 F_q of width rows, so that
 *
 *     M^-1 d = sum_e w_e x N_e^-1 (l_e^T d)
 *
 * where of two conjugate e one is taken and the real part doubled; N_e is real where lambda_e is
 * (Butcher, BIT 16 (1976) 237; Hairer, Wanner, Solving Ordinary Differential Equations II, IV.8).
 * With the Gauss methods, which are symmetric and symplectic, l_e = b_i (w_e)_(s+1-i). */
#ifndef DAL_KERNEL_EIGENSYSTEM_H
#define DAL_KERNEL_EIGENSYSTEM_H

#include "algebra.h"

/* The eigenvalues of A, (s + 1)/2 without the conjugates, a real one last. */
typedef struct dal_eigensystem {
    const double *value;      /* [pairs*2] real and imaginary parts */
    const double *vector;     /* [pairs*2*s] the same of w_e, so that l_e^T w_e = 1 */
    const double *b, *b_tail; /* [s] of the method */
} dal_eigensystem;

/* Numbers of an augmented complex matrix [N | 1], n rows: real parts of a row, then imaginary. */
DAL_INLINE int dal_augmented_size(int n) { return 4 * n * n; }

/* row i -= (its entry in column k) row k, from column k on; n columns */
DAL_INLINE void dal__subtract_complex(num *m, int n, int i, int k)
{
    const num *re = m + 2 * k * n, *im = re + n;
    num *DAL_RESTRICT x = m + 2 * i * n, *DAL_RESTRICT y = x + n;
    const num a = x[k], b = y[k];
    for (int j = k; j < n; j++) {
        x[j] = dal_fma(b, im[j], dal_fma(-a, re[j], x[j]));
        y[j] = dal_fma(-b, re[j], dal_fma(-a, im[j], y[j]));
    }
}

/* row k /= its entry in column k */
DAL_INLINE void dal__divide_complex(num *m, int n, int k)
{
    num *x = m + 2 * k * n, *y = x + n;
    const num scale = 1.0 / dal_fma(x[k], x[k], y[k] * y[k]), a = scale * x[k], b = scale * y[k];
    for (int j = k; j < n; j++) {
        const num re = x[j];
        x[j] = dal_fma(b, y[j], a * re);
        y[j] = dal_fma(a, y[j], -(b * re));
    }
}

/* As dal__pivot does for real rows; an entry is as large as the sum |re| + |im|. */
DAL_INLINE void dal__pivot_complex(num *m, int rows, int k)
{
    const int n = 2 * rows;
    for (int i = k + 1; i < rows; i++) {
        const num *top = m + 2 * k * n + k, *other = m + 2 * i * n + k;
        const dal_mask larger =
            dal_less(dal_abs(top[0]) + dal_abs(top[n]), dal_abs(other[0]) + dal_abs(other[n]));
        if (dal_any(larger)) dal__swap_rows(m, 2 * n, k, i, larger);
    }
}

/* N^-1, [2*n*n] real and imaginary parts, from [N | 1], which is destroyed: Gauss-Jordan with
 * partial pivoting in each lane; see dal_invert. */
DAL_SEPARATE void dal_invert_complex(num *m, num *inverse, int rows)
{
    const int n = 2 * rows;
    for (int k = 0; k < rows; k++) {
        dal__pivot_complex(m, rows, k);
        dal__divide_complex(m, n, k);
        for (int i = 0; i < rows; i++)
            if (i != k) dal__subtract_complex(m, n, i, k);
    }
    for (int i = 0; i < rows; i++) {
        for (int j = 0; j < rows; j++) {
            inverse[i * rows + j] = m[2 * i * n + rows + j];
            inverse[(rows + i) * rows + j] = m[(2 * i + 1) * n + rows + j];
        }
    }
}

/* out_r = sum_i m[r*row + i*column] x_i for each of `stages` vectors of `width` numbers, every
 * step'th number of out. */
DAL_INLINE void dal__combine_stages(int stages, int width, const double *m, int row, int column,
                                    const num *x, num *DAL_RESTRICT out, int step)
{
    for (int r = 0; r < stages; r++) {
        for (int c = 0; c < width; c++) {
            num sum = m[r * row] * x[c];
            DAL_EACH(i, stages - 1)
                sum = dal_fma(dal_num(m[r * row + (i + 1) * column]), x[(i + 1) * width + c], sum);
            out[(r * width + c) * step] = sum;
        }
    }
}

/* y = 2 N^-1 t, the imaginary parts with the other sign; [2*n] real and imaginary parts. */
DAL_INLINE void dal__multiply_complex(const num *inverse, int n, const num *t, num *DAL_RESTRICT y)
{
    for (int i = 0; i < n; i++) {
        const num *x = inverse + i * n, *z = x + n * n;
        num re = dal_num(0.0), im = dal_num(0.0);
        DAL_EACH(k, n) {
            re = dal_fma(-z[k], t[n + k], dal_fma(x[k], t[k], re));
            im = dal_fma(z[k], t[k], dal_fma(x[k], t[n + k], im));
        }
        y[i] = 2.0 * re;
        y[n + i] = -2.0 * im;
    }
}

/* d <- M^-1 d, every step'th number of d; inverse: inverses of N_e, one after the other,
 * [2*width*width] each, a real one [width*width].  scratch: [3*stages*width]. */
DAL_SEPARATE void dal_apply_eigensystem(const dal_eigensystem *e, int stages, int width,
                                        const num *inverse, num *d, int step, num *scratch)
{
    const int last = stages - 1, size = stages * width;
    num *const x = scratch, *const t = x + size, *const y = t + size;
    for (int i = 0; i < stages; i++)
        for (int c = 0; c < width; c++)
            x[i * width + c] = (e->b[i] + e->b_tail[i]) * d[(i * width + c) * step];
    dal__combine_stages(stages, width, e->vector + last, stages, -1, x, t, 1);
    for (int k = 0; k < last; k += 2)
        dal__multiply_complex(inverse + k * width * width, width, t + k * width, y + k * width);
    if (last % 2 == 0)
        dal_multiply(inverse + last * width * width, width, width, t + last * width,
                     y + last * width);
    dal__combine_stages(stages, width, e->vector, 1, stages, y, d, step);
}

#endif
