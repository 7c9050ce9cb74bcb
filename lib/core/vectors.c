/* vectors.c - memory, norms, orthonormal rows, least squares and random numbers. */
#include "core/vectors.h"
#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

double *dal__numbers(size_t rows, size_t columns)
{
    if (rows == 0 || columns == 0) rows = columns = 1;
    return rows > SIZE_MAX / columns ? NULL : calloc(rows * columns, sizeof(double));
}

double dal__max_abs(const double *x, size_t count)
{
    double max = 0.0;
    for (size_t i = 0; i < count; i++)
        if (!(fabs(x[i]) <= max)) max = isnan(x[i]) ? INFINITY : fabs(x[i]);
    return max;
}

int dal__find_max_abs(const double *x, int count)
{
    int max = 0;
    for (int i = 1; i < count && !isnan(x[max]); i++)
        if (!(fabs(x[i]) <= fabs(x[max]))) max = i;
    return max;
}

double dal__distance(const double *a, const double *b, const double *unit, size_t count)
{
    double max = 0.0;
    for (size_t i = 0; i < count; i++) {
        const double d = fabs(a[i] - b[i]) / fmax(unit ? unit[i] : 1.0, fabs(a[i]));
        if (!(d <= max)) max = isnan(d) ? INFINITY : d;
    }
    return max;
}

bool dal__is_converged(double change, double before, double size)
{
    const double resolution = DBL_EPSILON * size;
    return change <= resolution || (change >= before && change <= 64.0 * resolution);
}

void dal__jacobi_sizes(int n, const double *m, double *size)
{
    int unknown = 0;
    for (int i = 0; i < n; i++) {
        size[i] = isfinite(m[i * n + i]) ? fabs(m[i * n + i]) : 0.0;
        unknown += size[i] == 0.0;
    }
    while (unknown > 0) {
        int found = 0, first = -1;
        double max = 0.0;
        for (int i = 0; i < n; i++, max = 0.0) {
            if (size[i] > 0.0) continue;
            if (first < 0) first = i;
            for (int j = 0; j < n; j++) {
                const double x = fmax(fabs(m[i * n + j]), fabs(m[j * n + i])),
                             d = x * (x / size[j]);
                max = isfinite(d) ? fmax(max, d) : max;
            }
            size[i] = max;
            found += max > 0.0;
        }
        if (found == 0) {
            const double *row = m + first * n;
            for (int e = 0; e < n * n; e++) {
                const double d = fabs(row[e / n] * (row[e % n] / m[e]));
                max = isfinite(d) ? fmax(max, d) : max;
            }
            size[first] = max > 0.0 ? max : 1.0;
            found = 1;
        }
        unknown -= found;
    }
}

void dal__gram_matrix(int n, int m, const double *A, const double *B, double *G)
{
    for (int a = 0; a < m; a++)
        for (int b = 0; b < m; b++) {
            double sum = 0.0;
            for (int i = 0; i < n; i++) sum += A[a * n + i] * B[i * m + b];
            G[a * m + b] = sum;
        }
}

void dal__velocity_units(int n, int m, const double *A, const double *B, double *unit)
{
    const int unknown = INT_MAX;
    int first = unknown;
    for (int i = 0; i < n; i++) unit[i] = 0.0;
    for (int a = 0; a < m; a++) {
        double G = 0.0;
        for (int i = 0; i < n; i++) G += A[a * n + i] * B[i * m + a];
        for (int i = 0; i < n && G != 0.0 && isfinite(G); i++)
            unit[i] = fmax(unit[i], fabs(B[i * m + a] / G) * fabs(B[i * m + a]));
    }
    for (int i = 0; i < n; i++) {
        if (!isfinite(unit[i])) unit[i] = 0.0;
        if (unit[i] == 0.0) continue;
        int exponent;
        frexp(unit[i], &exponent);
        if (first == unknown) first = exponent;
        unit[i] = ldexp(1.0, (exponent - first - ((exponent - first) & 1)) / 2);
    }
}

double dal__max_in_units(int n, const double *v, const double *unit)
{
    double max = 0.0;
    for (int i = 0; i < n; i++)
        if (unit[i] > 0.0) max = fmax(max, fabs(v[i]) / unit[i]);
    return max;
}

double dal__power_of_two(double x)
{
    int exponent;
    frexp(x, &exponent);
    return x != 0.0 && isfinite(x) ? ldexp(0.5, exponent) : 0.0;
}

double dal__golden_fraction(int k)
{
    const double golden = 0.6180339887498949;
    return fmod(k * golden, 1.0);
}

double dal__uniform(dal__random *random)
{
    random->state = random->state * 6364136223846793005u + 1442695040888963407u;
    return (double)(random->state >> 11) * 0x1p-52 - 1.0;
}

/* ---- orthonormal rows ---- */

void dal__remove_component(double *x, const double *unit, int count)
{
    double component = 0.0;
    for (int i = 0; i < count; i++) component += unit[i] * x[i];
    for (int i = 0; i < count; i++) x[i] -= component * unit[i];
}

double dal__orthonormalise_row(double *rows, int j, int width)
{
    double *x = rows + (size_t)j * (size_t)width;
    for (int k = 0; k < j; k++) dal__remove_component(x, rows + (size_t)k * (size_t)width, width);
    double square = 0.0;
    for (int i = 0; i < width; i++) square += x[i] * x[i];
    const double length = sqrt(square);
    for (int i = 0; i < width; i++) x[i] /= length;
    return length;
}

/* ---- least squares ---- */

typedef struct matrix {
    int rows, columns;
    double *a;     /* row-major; columns become orthonormal */
    double *r;     /* [columns*columns] upper triangle */
    double *place; /* [columns] where a pivoted column came from, kept as doubles */
    double *norm;  /* [columns] */
} matrix;

/* Moves the longest column from i on to place i; its length. */
static double pivot_column(matrix *m, int i)
{
    int longest = i;
    for (int j = i; j < m->columns; j++) m->norm[j] = 0.0;
    for (int k = 0; k < m->rows; k++) {
        const double *const row = m->a + k * m->columns;
        for (int j = i; j < m->columns; j++) m->norm[j] += row[j] * row[j];
    }
    for (int j = i; j < m->columns; j++) {
        m->norm[j] = sqrt(m->norm[j]);
        if (m->norm[j] > m->norm[longest]) longest = j;
    }
    for (int k = 0; k < m->rows; k++)
        dal__swap(1, &m->a[k * m->columns + i], &m->a[k * m->columns + longest]);
    for (int k = 0; k < i; k++)
        dal__swap(1, &m->r[k * m->columns + i], &m->r[k * m->columns + longest]);
    dal__swap(1, &m->place[i], &m->place[longest]);
    return m->norm[longest];
}

/* Column i becomes a unit vector, the later ones lose their component along it: row by row, as the
 * matrix lies in memory. */
static void orthogonalise(matrix *m, int i, double norm)
{
    double *const component = m->r + i * m->columns;
    component[i] = norm;
    for (int j = i + 1; j < m->columns; j++) component[j] = 0.0;
    for (int k = 0; k < m->rows; k++) {
        double *const row = m->a + k * m->columns;
        row[i] /= norm;
        for (int j = i + 1; j < m->columns; j++) component[j] += row[i] * row[j];
    }
    for (int k = 0; k < m->rows; k++) {
        double *const row = m->a + k * m->columns;
        for (int j = i + 1; j < m->columns; j++) row[j] -= component[j] * row[i];
    }
}

static void solve(matrix *m, int rank, double *right, double *x)
{
    for (int i = 0; i < m->columns; i++) m->norm[i] = x[i] = 0.0;
    for (int i = 0; i < rank; i++) {
        for (int k = 0; k < m->rows; k++) m->norm[i] += m->a[k * m->columns + i] * right[k];
        for (int k = 0; k < m->rows; k++) right[k] -= m->norm[i] * m->a[k * m->columns + i];
    }
    for (int i = rank - 1; i >= 0; i--) {
        for (int j = i + 1; j < rank; j++) m->norm[i] -= m->r[i * m->columns + j] * m->norm[j];
        m->norm[i] /= m->r[i * m->columns + i];
    }
    for (int i = 0; i < rank; i++) x[(int)m->place[i]] = m->norm[i];
}

int dal__least_squares(int rows, int columns, double *a, double *right, double *x, double tolerance,
                       double *pivot, double *work)
{
    size_t square = (size_t)columns * (size_t)columns;
    matrix m = {rows, columns, a, work, work + square, work + square + columns};
    double largest = 0.0, norm = 0.0;
    int rank = 0;
    for (int i = 0; i < columns; i++) m.place[i] = i;
    for (; rank < columns; rank++) {
        norm = pivot_column(&m, rank);
        if (rank == 0) largest = norm;
        if (!(norm > tolerance * largest) || norm < DBL_MIN) break;
        orthogonalise(&m, rank, norm);
    }
    if (pivot != NULL) *pivot = rank == columns && columns > 0 ? norm / largest : 0.0;
    if (right != NULL) solve(&m, rank, right, x);
    return rank;
}

bool dal__is_positive_definite(int n, const double *a, double tolerance, double *w)
{
    memcpy(w, a, (size_t)n * (size_t)n * sizeof *w);
    for (int k = 0; k < n; k++) {
        if (!(w[k * n + k] > tolerance * a[k * n + k])) return false;
        for (int i = k + 1; i < n; i++) {
            const double factor = w[i * n + k] / w[k * n + k];
            for (int j = k; j < n && factor != 0.0; j++) w[i * n + j] -= factor * w[k * n + j];
        }
    }
    return true;
}
