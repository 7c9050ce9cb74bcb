/* svd.h - singular values and right singular vectors of a dense matrix. */
#ifndef DAL_CORE_SVD_H
#define DAL_CORE_SVD_H

#include <stdbool.h>

/* Finds A = U S V^T of a[columns*rows], one column after the other, rows >= columns: the singular
 * values value[columns], decreasing, and the right singular vectors, vector[columns*columns], one
 * after the other.  a is destroyed.  Householder's QR, then one-sided Jacobi rotations (Hestenes
 * 1958, DOI 10.1137/0106005), which find small singular values and their vectors to the accuracy of
 * a.  false: out of memory. [alloc] */
bool dal__singular_values(int rows, int columns, double *a, double *value, double *vector);

#endif
