/* two_point.c - solves linear boundary value problems in pieces.
 *
 * Let the rows so far be G w_0 + E w_k = s.  With the rows of the next piece
 *
 *     ( G   E      0 ) ( w_0, w_k, w_(k+1) )     ( s   )
 *     ( 0  -Phi_k  1 )                        =  ( r_k )
 *
 * Gauss's elimination of w_k with exchanges between all 2d rows leaves d rows that give w_k by w_0
 * and w_(k+1), and d rows that are the next G and E. */
#include "steer/two_point.h"
#include "core/svd.h"
#include "core/vectors.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static int columns_of(const dal__two_point *b) { return 2 * b->d + b->extra; }

/* svd.h wants as many rows as columns. */
static int padded_rows(const dal__two_point *b)
{
    const int rows = b->d + b->rows, columns = columns_of(b);
    return rows > columns ? rows : columns;
}

bool dal__two_point_open(dal__two_point *b, int d, int pieces, int extra, int rows)
{
    *b = (dal__two_point){.d = d, .pieces = pieces, .extra = extra, .rows = rows};
    const size_t size = (size_t)d, count = (size_t)pieces, columns = (size_t)columns_of(b);
    b->border = dal__numbers((size_t)rows, columns);
    b->right = dal__numbers(1, (size_t)rows);
    b->panel = dal__numbers(count, 2 * size * size);
    b->upper = dal__numbers(count, 2 * size * size);
    b->pivot = calloc(count * size, sizeof *b->pivot);
    b->last = dal__numbers(size, 2 * size);
    b->matrix = dal__numbers(2 * (size_t)padded_rows(b), columns);
    b->value = dal__numbers(1, columns);
    b->vector = dal__numbers(columns, columns);
    b->scratch = dal__numbers(count + 8 * size + 8, 2 * size + columns + (size_t)rows);
    return b->border && b->right && b->panel && b->upper && b->pivot && b->last && b->matrix &&
           b->value && b->vector && b->scratch;
}

void dal__two_point_close(dal__two_point *b)
{
    free(b->border);
    free(b->right);
    free(b->panel);
    free(b->upper);
    free(b->pivot);
    free(b->last);
    free(b->matrix);
    free(b->value);
    free(b->vector);
    free(b->scratch);
}

/* panel[2d*d] of w_k is factored, and the columns of w_0 and w_(k+1), other[2d*2d], with it. */
static void factor_panel(int d, double *panel, double *other, int *pivot)
{
    for (int j = 0; j < d; j++) {
        int max = j;
        for (int i = j + 1; i < 2 * d; i++)
            if (fabs(panel[i * d + j]) > fabs(panel[max * d + j])) max = i;
        pivot[j] = max;
        if (max != j) {
            dal__swap(d, panel + j * d, panel + max * d);
            dal__swap(2 * d, other + j * 2 * d, other + max * 2 * d);
        }
        const double inverse = panel[j * d + j] != 0.0 ? 1.0 / panel[j * d + j] : 0.0;
        for (int i = j + 1; i < 2 * d; i++) {
            const double factor = panel[i * d + j] *= inverse;
            if (factor == 0.0) continue;
            for (int k = j + 1; k < d; k++) panel[i * d + k] -= factor * panel[j * d + k];
            for (int k = 0; k < 2 * d; k++) other[i * 2 * d + k] -= factor * other[j * 2 * d + k];
        }
    }
}

static void eliminate_pieces(dal__two_point *b, const double *phi)
{
    const int d = b->d;
    double *other = b->scratch;
    const size_t square = (size_t)(d * d);
    for (int i = 0; i < d; i++)
        for (int j = 0; j < d; j++) {
            b->last[i * 2 * d + j] = -phi[i * d + j];
            b->last[i * 2 * d + d + j] = i == j;
        }
    for (int k = 1; k < b->pieces; k++) {
        double *panel = b->panel + 2 * square * (size_t)k;
        double *upper = b->upper + 2 * square * (size_t)k;
        memset(other, 0, 4 * square * sizeof *other);
        for (int i = 0; i < d; i++)
            for (int j = 0; j < d; j++) {
                panel[i * d + j] = b->last[i * 2 * d + d + j];
                panel[(d + i) * d + j] = -phi[(size_t)k * square + (size_t)(i * d + j)];
                other[i * 2 * d + j] = b->last[i * 2 * d + j];
                other[(d + i) * 2 * d + d + j] = i == j;
            }
        factor_panel(d, panel, other, b->pivot + k * d);
        memcpy(upper, other, 2 * square * sizeof *other);
        memcpy(b->last, other + 2 * square, 2 * square * sizeof *other);
    }
}

bool dal__two_point_factor(dal__two_point *b, const double *phi, double tolerance)
{
    const int d = b->d, columns = columns_of(b), rows = padded_rows(b);
    double *copy = b->matrix + rows * columns;
    eliminate_pieces(b, phi);
    memset(b->matrix, 0, (size_t)(rows * columns) * sizeof *b->matrix);
    for (int i = 0; i < d + b->rows; i++)
        for (int j = 0; j < columns; j++) {
            if (i >= d)
                b->matrix[j * rows + i] = b->border[(i - d) * columns + j];
            else if (j < 2 * d)
                b->matrix[j * rows + i] = b->last[i * 2 * d + j];
        }
    memcpy(copy, b->matrix, (size_t)(rows * columns) * sizeof *copy);
    if (!dal__singular_values(rows, columns, copy, b->value, b->vector)) return false;
    b->rank = 0;
    while (b->rank < columns && b->value[b->rank] > tolerance * b->value[0]) b->rank++;
    b->condition = b->rank > 0 ? b->value[0] / b->value[b->rank - 1] : INFINITY;
    return true;
}

void dal__two_point_solve(dal__two_point *b, const double *r, double *w)
{
    const int d = b->d, last = b->pieces;
    const size_t bytes = (size_t)d * sizeof *w;
    double *both = b->scratch, *x = both + 2 * d + b->rows, *saved = x + columns_of(b);
    memcpy(both, r, bytes);
    for (int k = 1; k < last; k++) {
        const double *panel = b->panel + 2 * (size_t)k * (size_t)(d * d);
        memcpy(both + d, r + k * d, bytes);
        for (int j = 0; j < d; j++) dal__swap(1, both + j, both + b->pivot[k * d + j]);
        for (int j = 0; j < d; j++)
            for (int i = j + 1; i < 2 * d; i++) both[i] -= panel[i * d + j] * both[j];
        memcpy(saved + k * d, both, bytes);
        memcpy(both, both + d, bytes);
    }
    memcpy(both + d, b->right, (size_t)b->rows * sizeof *both);
    memset(x, 0, (size_t)columns_of(b) * sizeof *x);
    for (int k = 0; k < b->rank; k++) { /* the least solution of the rows of the ends */
        const double *v = b->vector + k * columns_of(b);
        double sum = 0.0;
        for (int j = 0; j < columns_of(b); j++)
            sum += v[j] * dal__dot_product(d + b->rows, b->matrix + j * padded_rows(b), both);
        sum /= b->value[k] * b->value[k];
        for (int j = 0; j < columns_of(b); j++) x[j] += sum * v[j];
    }
    memcpy(w, x, bytes);
    memcpy(w + last * d, x + d, bytes);
    memcpy(w + (last + 1) * d, x + 2 * d, (size_t)b->extra * sizeof *w);
    for (int k = last - 1; k > 0; k--) { /* w_k by w_0 and w_(k+1) */
        const double *panel = b->panel + 2 * (size_t)k * (size_t)(d * d);
        const double *upper = b->upper + 2 * (size_t)k * (size_t)(d * d);
        double *right = saved + k * d, *out = w + k * d;
        for (int i = d; i-- > 0;) {
            right[i] -= dal__dot_product(d, upper + i * 2 * d, w);
            right[i] -= dal__dot_product(d, upper + i * 2 * d + d, out + d);
            for (int j = i + 1; j < d; j++) right[i] -= panel[i * d + j] * out[j];
            out[i] = panel[i * d + i] != 0.0 ? right[i] / panel[i * d + i] : 0.0;
        }
    }
}
