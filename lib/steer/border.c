/* border.c - the equations of the ends of a motion.
 *
 *     x_i = given,   or   momentum_i = 0 where x_i is free
 *
 * at both ends.  An integral I(q, v) of the lift that momenta do not move, d(q,v)(T)/d(p,pi)(0) N_0
 * = 0 and N_T^T d(q,v)(T)/d(p,pi)(0) = 0 for its gradients N at the ends, makes these equations
 * dependent where both ends give its value: a slack s takes up what they may contradict each
 * other,
 *
 *     x(T) + N_T s = target,   N_0^T (p, pi)(0) = 0
 *
 * and is 0 where the target lies on I = const.  With aim, of (q, v) alone, and of vakonomic motion,
 * of (q, v, g), D(0) = 0 is added. */
#include "steer/border.h"
#include "core/error.h"
#include "core/svd.h"
#include "core/vectors.h"
#include "steer/vakonomic.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Gradients of the integrals at both ends: D is constant, g - (t - from) D is. */
static dal_status find_gradients(dal__border *b, const double *first, const double *last)
{
    dal__problem *p = b->problem;
    const int width = 2 * p->n, count = p->constraints + p->holonomic;
    double *end = b->gradient + count * width;
    DAL_TRY(dal__problem_gradients(p, p->from, first, b->gradient));
    DAL_TRY(dal__problem_gradients(p, p->T, last, end));
    for (int a = 0; a < p->holonomic; a++)
        for (int i = 0; i < width; i++)
            end[(p->constraints + a) * width + i] -=
                (p->T - p->from) * end[(p->constraints - p->holonomic + a) * width + i];
    return DAL_STATUS_OK;
}

/* Orthonormal rows x, out[..*columns], with a x = 0 for a[rows*columns]; how many, -1: out of
 * memory. */
static int find_null_rows(int rows, int columns, const double *a, double *out)
{
    const double tolerance = 1e-9;
    const int height = rows > columns ? rows : columns;
    double *by_columns = dal__numbers((size_t)columns, (size_t)height);
    double *value = dal__numbers(1, (size_t)columns);
    double *vector = dal__numbers((size_t)columns, (size_t)columns);
    int count = -1;
    for (int i = 0; by_columns && i < rows * columns; i++)
        by_columns[i % columns * height + i / columns] = a[i];
    if (by_columns && value && vector &&
        dal__singular_values(height, columns, by_columns, value, vector)) {
        count = 0;
        for (int k = 0; k < columns; k++) {
            if (value[k] > tolerance * value[0] && value[k] > 0.0) continue;
            memcpy(out + columns * count++, vector + columns * k, (size_t)columns * sizeof *out);
        }
    }
    free(by_columns);
    free(value);
    free(vector);
    return count;
}

/* Rows of gradients by components that are free at an end, rows[..*integrals]. */
static int gather_free(const dal__border *b, int end, double *rows)
{
    const dal__problem *p = b->problem;
    int count = 0;
    for (int i = 0; i < 2 * p->n; i++) {
        if (!p->is_free[end][i]) continue;
        for (int a = 0; a < p->integrals; a++)
            rows[count * p->integrals + a] = b->gradient[(end * p->integrals + a) * 2 * p->n + i];
        count++;
    }
    return count;
}

/* Combinations of integrals that both ends give, and that no end gives. */
static dal_status find_combinations(dal__border *b)
{
    const dal__problem *p = b->problem;
    const int count = p->integrals;
    if (count == 0) return DAL_STATUS_OK;
    const size_t size = (size_t)count;
    double *rows = dal__numbers(4 * (size_t)p->n + 2 * size, size);
    double *given = dal__numbers(2 * size, size);
    bool good = rows && given;
    if (good) {
        const int first = gather_free(b, 0, rows);
        const int last = gather_free(b, 1, rows + first * count);
        b->twice = find_null_rows(first + last, count, rows, b->combination);
        const int at_first = find_null_rows(first, count, rows, given);
        const int at_last = find_null_rows(last, count, rows + first * count,
                                           given + (at_first > 0 ? at_first : 0) * count);
        good = b->twice >= 0 && at_first >= 0 && at_last >= 0;
        if (good)
            b->never =
                find_null_rows(at_first + at_last, count, given, b->combination + b->twice * count);
        good = good && b->never >= 0;
    }
    free(rows);
    free(given);
    return good ? DAL_STATUS_OK : DAL_STATUS_MEMORY;
}

dal_status dal__border_open(dal__border *b, const dal__shooting *s)
{
    dal__problem *p = s->problem;
    const size_t count = (size_t)(p->constraints + p->holonomic), width = 2 * (size_t)p->n;
    *b = (dal__border){.problem = p};
    b->gradient = dal__numbers(2 * count + 1, width);
    b->combination = dal__numbers(2 * count + 1, count);
    b->constraint = dal__numbers(1, count + 1);
    b->momentum = dal__numbers(1, width);
    if (!b->gradient || !b->combination || !b->constraint || !b->momentum) return DAL_STATUS_MEMORY;
    DAL_TRY(find_gradients(b, s->point, s->point + s->pieces * p->dimension));
    return find_combinations(b);
}

void dal__border_close(dal__border *b)
{
    free(b->gradient);
    free(b->combination);
    free(b->constraint);
    free(b->momentum);
}

int dal__border_rows(const dal__border *b)
{
    const dal__problem *p = b->problem;
    if (p->is_lifted) return 4 * p->n + b->twice + b->never;
    return 4 * p->n + p->constraints + p->holonomic;
}

int dal__border_extra(const dal__border *b) { return b->twice + b->never; }

/* Row a of the combinations of gradients at an end, out[2n]. */
static void combine(const dal__border *b, int a, int end, double *out)
{
    const dal__problem *p = b->problem;
    memset(out, 0, 2 * (size_t)p->n * sizeof *out);
    for (int k = 0; k < p->integrals; k++)
        for (int i = 0; i < 2 * p->n; i++)
            out[i] += b->combination[a * p->integrals + k] *
                      b->gradient[(end * p->integrals + k) * 2 * p->n + i];
}

/* Orthonormal rows of gradients at an end. */
static void find_normals(const dal__border *b, int first, int count, int end, double *out)
{
    const int width = 2 * b->problem->n;
    for (int a = 0; a < count; a++) {
        combine(b, first + a, end, out + a * width);
        dal__orthonormalise_row(out, a, width);
    }
}

/* Slacks, and the rows of momenta at the start. */
static void fill_integrals(const dal__border *b, double *normals, dal__two_point *out)
{
    const dal__problem *p = b->problem;
    const int n = p->n, width = 2 * n, columns = 2 * out->d + out->extra;
    double *row = out->border + 4 * n * columns;
    find_normals(b, 0, b->twice, 1, normals);
    for (int a = 0; a < b->twice; a++)
        for (int i = 0; i < width; i++)
            if (!p->is_free[1][i])
                out->border[(width + i) * columns + 2 * out->d + a] = normals[a * width + i];
    find_normals(b, 0, b->twice, 0, normals);
    for (int a = 0; a < b->twice; a++, row += columns)
        memcpy(row + width, normals + a * width, (size_t)width * sizeof *row);
    find_normals(b, b->twice, b->never, 0, normals);
    for (int a = 0; a < b->never; a++, row += columns) {
        combine(b, b->twice + a, 0, row);
        for (int i = 0; i < width; i++)
            if (p->is_free[0][i])
                out->border[i * columns + 2 * out->d + b->twice + a] = -normals[a * width + i];
    }
}

/* Rows of the momenta of vakonomic motion whose coordinates are free. */
static dal_status fill_momenta(const dal__border *b, const double *point, int pieces,
                               dal__two_point *out)
{
    dal__problem *p = b->problem;
    const int n = p->n, d = out->d, columns = 2 * d + out->extra;
    if (p->multipliers == 0) return DAL_STATUS_OK;
    double *rows = dal__numbers((size_t)n, (size_t)d);
    dal_status status = rows ? DAL_STATUS_OK : DAL_STATUS_MEMORY;
    for (int end = 0; end < 2 && status == DAL_STATUS_OK; end++) {
        status = dal__vakonomic_gradients(p, end == 0 ? p->from : p->T,
                                          point + end * pieces * p->dimension, rows);
        for (int i = 0; i < n; i++)
            if (p->is_free[end][i])
                memcpy(out->border + (end * 2 * n + i) * columns + end * d, rows + i * d,
                       (size_t)d * sizeof *rows);
    }
    free(rows);
    return status;
}

dal_status dal__border_fill(dal__border *b, const double *point, int pieces, dal__two_point *out)
{
    const dal__problem *p = b->problem;
    const int width = 2 * p->n, columns = 2 * out->d + out->extra;
    DAL_TRY(find_gradients(b, point, point + pieces * p->dimension));
    memset(out->border, 0, (size_t)(out->rows * columns) * sizeof *out->border);
    DAL_TRY(fill_momenta(b, point, pieces, out));
    double *normals = dal__numbers((size_t)out->extra + 1, (size_t)width);
    if (!normals) return DAL_STATUS_MEMORY;
    for (int i = 0; i < 2 * width; i++) { /* x_i, or its momentum, at an end */
        const int end = i / width, column = end * out->d + i % width;
        if (!p->is_free[end][i % width])
            out->border[i * columns + column] = 1.0;
        else if (p->is_lifted)
            out->border[i * columns + column + width] = 1.0;
    }
    if (p->is_lifted) fill_integrals(b, normals, out);
    for (int a = 0; !p->is_lifted && a < p->constraints + p->holonomic; a++)
        memcpy(out->border + (2 * width + a) * columns, b->gradient + a * width,
               (size_t)width * sizeof *normals);
    free(normals);
    return dal__border_right(b, point, pieces, out);
}

dal_status dal__border_right(dal__border *b, const double *point, int pieces, dal__two_point *out)
{
    dal__problem *p = b->problem;
    const int width = 2 * p->n, columns = 2 * out->d + out->extra;
    for (int end = 0; end < 2; end++) {
        const double *z = point + end * pieces * p->dimension;
        const double *given = end == 0 ? p->start : p->target;
        if (p->multipliers > 0)
            DAL_TRY(dal__vakonomic_momenta(p, end == 0 ? p->from : p->T, z, b->momentum));
        for (int i = 0; i < width; i++) {
            double *right = out->right + end * width + i;
            if (!p->is_free[end][i])
                *right = (given[i] - z[i]) / p->unit[i];
            else if (p->is_lifted)
                *right = -z[width + 1 + i] / p->unit[width + i];
            else
                *right = p->multipliers > 0 && i < p->n ? -b->momentum[i] : 0.0;
        }
    }
    DAL_TRY(dal__problem_constraints(p, p->from, point, b->constraint));
    double *right = out->right + 2 * width;
    for (int a = 0; !p->is_lifted && a < p->constraints + p->holonomic; a++)
        right[a] = -b->constraint[a];
    for (int a = 0; a < b->twice; a++) { /* N_0^T (p, pi) = 0 */
        const double *row = out->border + (2 * width + a) * columns;
        right[a] = 0.0;
        for (int i = 0; i < width; i++)
            right[a] -= row[width + i] * point[width + 1 + i] / p->unit[width + i];
    }
    for (int a = b->twice; a < b->twice + b->never; a++) {
        right[a] = 0.0;
        for (int k = 0; k < p->integrals; k++)
            right[a] -= b->combination[a * p->integrals + k] * b->constraint[k];
    }
    return DAL_STATUS_OK;
}

double dal__border_distance(const dal__border *b, const double *point, const dal__two_point *at,
                            const double *slack)
{
    const dal__problem *p = b->problem;
    const int width = 2 * p->n, columns = 2 * at->d + at->extra;
    double max = 0.0;
    for (int end = 0; end < 2; end++)
        for (int i = 0; i < width; i++) {
            const double *row = at->border + (end * width + i) * columns + 2 * at->d;
            double rest = (point[end * at->pieces * p->dimension + i] -
                           (end == 0 ? p->start[i] : p->target[i])) /
                          p->unit[i];
            if (p->is_free[end][i]) continue;
            rest += dal__dot_product(at->extra, row, slack);
            max = fmax(max, fabs(rest));
        }
    return max;
}
