/* vectors.c - memory, differences of order 8 and small least squares for the measures. */
#include "analysis/measure.h"
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* An increment is good where orders 8 and 6 agree to the first of these or to the roundings of the
 * values; two are, where both agree to the second, the error of order 8 then being near 2e-9, and
 * with each other: what oscillates fast may look smooth once. */
static const double close_agreement = 1e-10, agreement = 1e-7, rounding = 2e-14;
/* No power of it is near 1/2: what is periodic does not look smooth twice. */
static const double shortening = 0.37;
enum { ATTEMPTS = 24 };

double *dal__numbers(size_t rows, size_t columns)
{
    if (rows == 0 || columns == 0) rows = columns = 1;
    return rows > SIZE_MAX / columns ? NULL : calloc(rows * columns, sizeof(double));
}

double dal__increment(double rate) { return DAL__INCREMENT * fmax(1.0, fabs(rate)); }

double dal__greatest(const double *x, size_t count)
{
    double max = 0.0;
    for (size_t i = 0; i < count; i++)
        if (!(fabs(x[i]) <= max)) max = isnan(x[i]) ? INFINITY : fabs(x[i]);
    return max;
}

double dal__distance(const double *a, const double *b, size_t count)
{
    double max = 0.0;
    for (size_t i = 0; i < count; i++) {
        double d = fabs(a[i] - b[i]) / fmax(1.0, fabs(a[i]));
        if (!(d <= max)) max = isnan(d) ? INFINITY : d;
    }
    return max;
}

/* ---- differences ---- */

static const double order_8[4] = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
static const double order_6[4] = {3.0 / 4.0, -3.0 / 20.0, 1.0 / 60.0, 0.0};

/* The derivative by the increment d into out; by how much those of order 8 and of order 6 differ,
 * relative to max(1, |derivative|), and how much of that the roundings of the values may be. */
static dal_status difference(dal__curve *curve, void *user, double d, int count, double *scratch,
                             double *out, double *gap, double *noise)
{
    double *lower = scratch + count, size = 0.0;
    for (int i = 0; i < count; i++) out[i] = lower[i] = 0.0;
    for (int k = 4; k >= 1; k--) {
        for (int side = -1; side <= 1; side += 2) {
            DAL_TRY(curve(user, side * k * d, scratch));
            const double weight = side * order_8[k - 1] / d, less = side * order_6[k - 1] / d;
            for (int i = 0; i < count; i++) out[i] += weight * scratch[i];
            for (int i = 0; i < count; i++) lower[i] += less * scratch[i];
            size = fmax(size, dal__greatest(scratch, (size_t)count));
        }
    }
    *gap = dal__distance(out, lower, (size_t)count);
    *noise = isfinite(size) ? rounding * size / d : 0.0;
    return DAL_OK;
}

dal_status dal__differentiate(dal__curve *curve, void *user, double d, int count, double *scratch,
                              double *out)
{
    double *best = scratch + 2 * count, min = INFINITY, gap, noise;
    dal_status failure = DAL_OK;
    bool good = false;
    for (int i = 0; i < count; i++) best[i] = NAN;
    for (int k = 0; k < ATTEMPTS && !good; k++, d *= shortening) {
        const dal_status status = difference(curve, user, d, count, scratch, out, &gap, &noise);
        if (status != DAL_OK && failure == DAL_OK) failure = status;
        if (status != DAL_OK) continue;
        good = gap <= fmax(close_agreement, noise) ||
               fmax(fmax(gap, min), dal__distance(best, out, (size_t)count)) <= agreement;
        if (!(gap < min)) continue;
        min = gap;
        memcpy(best, out, (size_t)count * sizeof(double));
    }
    memcpy(out, best, (size_t)count * sizeof(double));
    return isinf(min) ? failure : DAL_OK;
}

double dal__uniform(dal__random *random)
{
    random->state = random->state * 6364136223846793005u + 1442695040888963407u;
    return (double)(random->state >> 11) * 0x1p-52 - 1.0;
}

/* ---- orthonormal rows ---- */

double dal__straighten(double *rows, int j, int width)
{
    double *x = rows + (size_t)j * (size_t)width;
    for (int k = 0; k < j; k++) {
        const double *before = rows + (size_t)k * (size_t)width;
        double part = 0.0;
        for (int i = 0; i < width; i++) part += before[i] * x[i];
        for (int i = 0; i < width; i++) x[i] -= part * before[i];
    }
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

static double column_dot(const matrix *m, int i, const double *x, int step)
{
    double sum = 0.0;
    for (int k = 0; k < m->rows; k++) sum += m->a[k * m->columns + i] * x[k * step];
    return sum;
}

static void swap(double *a, double *b)
{
    double c = *a;
    *a = *b;
    *b = c;
}

static void exchange(matrix *m, int i, int j)
{
    for (int k = 0; k < m->rows; k++) swap(&m->a[k * m->columns + i], &m->a[k * m->columns + j]);
    for (int k = 0; k < i; k++) swap(&m->r[k * m->columns + i], &m->r[k * m->columns + j]);
    swap(&m->place[i], &m->place[j]);
}

static double longest(matrix *m, int from, int *where)
{
    *where = from;
    for (int i = from; i < m->columns; i++) {
        m->norm[i] = sqrt(column_dot(m, i, m->a + i, m->columns));
        if (m->norm[i] > m->norm[*where]) *where = i;
    }
    return m->norm[*where];
}

/* Column i becomes a unit vector, the later ones lose their part along it. */
static void orthogonalise(matrix *m, int i, double norm)
{
    m->r[i * m->columns + i] = norm;
    for (int k = 0; k < m->rows; k++) m->a[k * m->columns + i] /= norm;
    for (int j = i + 1; j < m->columns; j++) {
        double part = column_dot(m, i, m->a + j, m->columns);
        m->r[i * m->columns + j] = part;
        for (int k = 0; k < m->rows; k++)
            m->a[k * m->columns + j] -= part * m->a[k * m->columns + i];
    }
}

static void solve(matrix *m, int rank, double *right, double *x)
{
    for (int i = 0; i < m->columns; i++) m->norm[i] = x[i] = 0.0;
    for (int i = 0; i < rank; i++) {
        m->norm[i] = column_dot(m, i, right, 1);
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
    int rank = 0, where;
    for (int i = 0; i < columns; i++) m.place[i] = i;
    for (; rank < columns; rank++) {
        norm = longest(&m, rank, &where);
        if (rank == 0) largest = norm;
        if (!(norm > tolerance * largest) || norm < DBL_MIN) break;
        exchange(&m, rank, where);
        orthogonalise(&m, rank, norm);
    }
    if (pivot != NULL) *pivot = rank == columns && columns > 0 ? norm / largest : 0.0;
    if (right != NULL) solve(&m, rank, right, x);
    return rank;
}
