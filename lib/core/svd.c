/* svd.c - singular values and right singular vectors of a dense matrix.
 *
 *     A = Q R,    R V = U S:   rotations of two columns of R at a time make them orthogonal,
 *
 *     tan 2t = 2 r_i.r_j / (|r_j|^2 - |r_i|^2)
 *
 * Golub, Van Loan, Matrix Computations, 4th edition, 5.2 and 8.6. */
#include "core/svd.h"
#include "core/vectors.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static double length_of(int count, const double *x) { return sqrt(dal__dot_product(count, x, x)); }

/* Householder's reflections make a upper triangular. */
static void triangularise(int rows, int columns, double *a)
{
    for (int k = 0; k < columns; k++) {
        double *const x = a + (size_t)k * (size_t)rows + k;
        const int count = rows - k;
        const double length = length_of(count, x), end = x[0] > 0.0 ? -length : length;
        if (!(length > 0.0)) continue;
        x[0] -= end;
        const double square = dal__dot_product(count, x, x);
        for (int j = k + 1; j < columns; j++) {
            double *const y = a + (size_t)j * (size_t)rows + k;
            const double factor = 2.0 * dal__dot_product(count, x, y) / square;
            for (int i = 0; i < count; i++) y[i] -= factor * x[i];
        }
        x[0] = end;
        for (int i = 1; i < count; i++) x[i] = 0.0;
    }
}

static void rotate(int count, double c, double s, double *x, double *y)
{
    for (int i = 0; i < count; i++) {
        const double a = x[i], b = y[i];
        x[i] = c * a - s * b;
        y[i] = s * a + c * b;
    }
}

/* Makes columns x, y of R orthogonal, u, v being the same columns of V; whether they were not. */
static bool make_orthogonal(int count, double *x, double *y, double *u, double *v, double least)
{
    const double a = dal__dot_product(count, x, x), b = dal__dot_product(count, y, y);
    const double product = dal__dot_product(count, x, y);
    if (fmax(a, b) <= least * least) return false;
    if (fabs(product) <= 4.0 * DBL_EPSILON * sqrt(a) * sqrt(b)) return false;
    const double zeta = (b - a) / (2.0 * product);
    const double t = copysign(1.0, zeta) / (fabs(zeta) + hypot(1.0, zeta));
    const double c = 1.0 / hypot(1.0, t);
    rotate(count, c, c * t, x, y);
    rotate(count, c, c * t, u, v);
    return true;
}

bool dal__singular_values(int rows, int columns, double *a, double *value, double *vector)
{
    enum { MAX_SWEEPS = 40 };
    const size_t n = (size_t)columns;
    double *r = dal__numbers(n, n), largest = 0.0;
    bool rotated = true;
    if (!r) return false;
    triangularise(rows, columns, a);
    for (size_t j = 0; j < n; j++) {
        memcpy(r + j * n, a + j * (size_t)rows, n * sizeof *r);
        for (size_t i = 0; i < n; i++) vector[j * n + i] = i == j;
        largest = fmax(largest, length_of(columns, r + j * n));
    }
    const double least = DBL_EPSILON * largest; /* columns below this are roundings */
    for (int sweep = 0; sweep < MAX_SWEEPS && rotated; sweep++) {
        rotated = false;
        for (size_t i = 0; i < n; i++)
            for (size_t j = i + 1; j < n; j++)
                rotated |= make_orthogonal(columns, r + i * n, r + j * n, vector + i * n,
                                           vector + j * n, least);
    }
    for (size_t j = 0; j < n; j++) value[j] = length_of(columns, r + j * n);
    for (size_t i = 0; i < n; i++) {
        size_t max = i;
        for (size_t j = i + 1; j < n; j++)
            if (value[j] > value[max]) max = j;
        rotate(1, max == i, max != i, value + max, value + i);
        rotate(columns, max == i, max != i, vector + max * n, vector + i * n);
        value[max] = fabs(value[max]);
    }
    free(r);
    return true;
}
