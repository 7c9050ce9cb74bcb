/* vectors.h - memory, norms, orthonormal rows, least squares and random numbers. */
#ifndef DAL_VECTORS_H
#define DAL_VECTORS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* rows*columns zeroed doubles, or NULL (also when the product overflows); freed with free. */
double *dal__numbers(size_t rows, size_t columns);

/* a.b in four partial sums: one order of summation, with vector registers or without. */
static inline double dal__dot_product(int n, const double *a, const double *b)
{
    double sum[4] = {0};
    int i = 0;
    for (; i + 4 <= n; i += 4)
        for (int k = 0; k < 4; k++) sum[k] += a[i + k] * b[i + k];
    for (; i < n; i++) sum[0] += a[i] * b[i];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

static inline void dal__swap(int n, double *a, double *b)
{
    for (int i = 0; i < n; i++) {
        const double x = a[i];
        a[i] = b[i];
        b[i] = x;
    }
}

double dal__max_abs(const double *x, size_t count); /* max |x|; infinite if one is NaN */
int dal__find_max_abs(const double *x, int count);  /* where that is, the first of NaNs */
/* max_i |a_i - b_i| / max(unit_i, |a_i|), units NULL: 1; infinite if one is NaN. */
double dal__distance(const double *a, const double *b, const double *unit, size_t count);

/* Whether an iteration for numbers of this size has converged, by its last change and the one
 * before: it is within rounding, or within 64 times that and no longer falls. */
bool dal__is_converged(double change, double before, double size);
/* The sizes d_i = |m_ii| of Jacobi's scaling of a symmetric matrix m[n*n], size[n].  A row with 0
 * on the diagonal has the least one with which m_ij^2 <= d_i d_j; where no other row has a size,
 * ab/c with entries a, b, c of three rows in pairs, or 1. */
void dal__jacobi_sizes(int n, const double *m, double *size);
/* G = A B [m*m] for A[m*n], B[n*m] = W^-1 A^T. */
void dal__gram_matrix(int n, int m, const double *A, const double *B, double *G);
/* Units of the velocities that m constraints move, unit[n], powers of 2 that change with the units
 * of the velocities: max_a |B_ia|/sqrt(G_aa) = max_a sqrt(W^-1_ii) |cos(e_i, A_a)| for A[m*n],
 * B[n*m] = W^-1 A^T and the diagonal of G = A B, relative to the first; 0 where none does. */
void dal__velocity_units(int n, int m, const double *A, const double *B, double *unit);
/* max |v_i|/unit_i over those that are not 0. */
double dal__max_in_units(int n, const double *v, const double *unit);

/* x loses its component along the unit vector. */
void dal__remove_component(double *x, const double *unit, int count);
/* Row j of rows[.. * width] loses its components along the orthonormal rows before it and becomes a
 * unit vector; its length before that. */
double dal__orthonormalise_row(double *rows, int j, int width);

/* Modified Gram-Schmidt with column pivoting on a[rows*columns] (destroyed).  Columns shorter
 * than tolerance times the longest count as dependent; the rank is returned, and in *pivot (when
 * not NULL) the shortest over the longest of all pivots, 0 when rank < columns.
 * When right is not NULL it loses its component in the span (the rest is the least residue), and
 * x[columns] is the solution of a x = right with the dependent columns' x at 0. */
int dal__least_squares(int rows, int columns, double *a, double *right, double *x, double tolerance,
                       double *pivot, double *work /* [columns*(columns+2)] */);

/* The power of two at or below |x|; 0 where x is 0 or not finite. */
double dal__power_of_two(double x);

/* The k-th of a sequence that fills [0, 1) evenly, without a pattern: multiples of the golden ratio
 * modulo 1. */
double dal__golden_fraction(int k);

/* A small deterministic generator, uniform on [-1, 1). */
typedef struct dal__random {
    uint64_t state;
} dal__random;
double dal__uniform(dal__random *random);

/* Whether a symmetric matrix, a[n*n], is positive definite: each pivot exceeds tolerance times the
 * entry it came from.  w is scratch, [n*n]. */
bool dal__is_positive_definite(int n, const double *a, double tolerance, double *w);

#endif
