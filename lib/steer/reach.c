/* reach.c - ranks of what momenta move, and conjugate times.
 *
 * J(t) = d(q, v)(t)/d(p, pi)(0) along an extremal from a given start.  With the gradients N of the
 * integrals that momenta do not move, J N(0) = 0 and N(t)^T J = 0; conjugate times, from which on
 * the extremal is no minimum, are where
 *
 *     ( J        N(t) )
 *     ( N(0)^T   0    )
 *
 * is singular for t > 0: there its determinant changes its sign, unless the kernel has an even
 * dimension. */
#include "steer/reach.h"
#include "core/error.h"
#include "core/svd.h"
#include "core/vectors.h"
#include "steer/controlled.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double reach_tolerance = 1e-9;

dal_status dal__reach_find(dal__problem *p, dal_steering *out)
{
    const dal_system *system = p->system;
    const int n = p->n, parameters = p->spec.parameter_count;
    dal_error error = {.status = DAL_STATUS_OK};
    out->allowed = p->is_lifted && p->integrals == 0 ? 2 * n : -1;
    double *unit = dal__numbers(1, 1 + 2 * (size_t)n);
    if (!unit) return DAL_STATUS_MEMORY;
    unit[0] = fabs(p->T - p->from);
    memcpy(unit + 1, p->unit, 2 * (size_t)n * sizeof *unit);
    dal_status status = system->m == 0 ? DAL_STATUS_UNSUPPORTED
                                       : dal_model_growth(p->model, p->spec.parameters, parameters,
                                                          unit, &out->growth, &error);
    out->has_growth = status == DAL_STATUS_OK && out->growth.is_complete;
    if (out->has_growth && system->effort == DAL_EFFORT_CONSTRAINT && p->is_lifted) {
        const int last = out->growth.rank[out->growth.levels - 1];
        const int r = last - (out->growth.dimension - n);
        out->allowed = r + n - system->m;
    }
    if (status != DAL_STATUS_MEMORY && system->effort == DAL_EFFORT_CONTROLS && p->is_lifted)
        status = dal__controlled_rank(p->model, p->spec.parameters, parameters, unit, &out->allowed,
                                      &error);
    free(unit);
    return status == DAL_STATUS_MEMORY ? status : DAL_STATUS_OK;
}

/* The sign of the determinant of a[n*n], which is destroyed; 0: it is singular to rounding. */
static int sign_of_determinant(int n, double *a)
{
    const double least = 1e-13;
    double max = 0.0, min = INFINITY;
    int sign = 1;
    for (int j = 0; j < n; j++) {
        int row = j;
        for (int i = j + 1; i < n; i++)
            if (fabs(a[i * n + j]) > fabs(a[row * n + j])) row = i;
        if (row != j) dal__swap(n, a + j * n, a + row * n);
        const double pivot = a[j * n + j];
        sign *= (row != j ? -1 : 1) * (pivot < 0.0 ? -1 : 1);
        max = fmax(max, fabs(pivot));
        min = fmin(min, fabs(pivot));
        for (int i = j + 1; i < n && pivot != 0.0; i++) {
            const double factor = a[i * n + j] / pivot;
            for (int l = j; l < n; l++) a[i * n + l] -= factor * a[j * n + l];
        }
    }
    return min > least * max ? sign : 0;
}

/* Independent gradients of the integrals, orthonormal rows, out[..*2n]; how many. */
static int find_independent(const dal__problem *p, double *out)
{
    const int w = 2 * p->n;
    int count = 0;
    for (int a = 0; a < p->integrals; a++) {
        memmove(out + count * w, out + a * w, (size_t)w * sizeof *out);
        const double size = dal__max_abs(out + count * w, (size_t)w);
        if (size > 0.0 && dal__orthonormalise_row(out, count, w) > reach_tolerance * size) count++;
    }
    return count;
}

dal_status dal__reach_measure(const dal__shooting *s, dal_extremal *out)
{
    dal__problem *p = s->problem;
    const int w = 2 * p->n, d = p->unknowns;
    bool has_free = false;
    out->rank = out->conjugate_times = -1;
    out->first_conjugate = NAN;
    if (!p->is_lifted) return DAL_STATUS_OK;
    const size_t square = (size_t)(w * w);
    double *memory = dal__numbers(20, square + (size_t)w);
    if (!memory) return DAL_STATUS_MEMORY;
    double *full = memory, *scratch = full + 2 * square, *first = scratch + 4 * square;
    double *normals = first + square, *matrix = normals + square;
    for (int i = 0; i < w; i++) {
        full[(w + i) * w + i] = 1.0;
        has_free = has_free || p->is_free[0][i] || p->is_free[1][i];
    }
    if (!has_free) out->conjugate_times = 0;
    dal_status status = dal__problem_gradients(p, p->from, s->point, first);
    const int count = find_independent(p, first), size = w + count;
    for (int k = 0, last = 0; k < s->pieces; k++) {
        const double *phi = s->derivative + (size_t)k * (size_t)(d * d);
        memset(scratch, 0, (size_t)(d * w) * sizeof *scratch);
        for (int i = 0; i < d * d; i++)
            for (int j = 0; j < w; j++) scratch[i / d * w + j] += phi[i] * full[i % d * w + j];
        memcpy(full, scratch, (size_t)(d * w) * sizeof *full);
        if (has_free || status != DAL_STATUS_OK) continue;
        status = dal__problem_gradients(p, dal__shooting_time(s, k + 1),
                                        s->point + (k + 1) * p->dimension, normals);
        memset(matrix, 0, (size_t)(size * size) * sizeof *matrix);
        if (find_independent(p, normals) != count) continue;
        for (int i = 0; i < w; i++) {
            memcpy(matrix + i * size, full + i * w, (size_t)w * sizeof *matrix);
            for (int a = 0; a < count; a++) {
                matrix[i * size + w + a] = normals[a * w + i];
                matrix[(w + a) * size + i] = first[a * w + i];
            }
        }
        const int sign = sign_of_determinant(size, matrix);
        if (sign * last < 0 && out->conjugate_times++ == 0)
            out->first_conjugate = dal__shooting_time(s, k + 1);
        if (sign != 0) last = sign;
    }
    memset(scratch, 0, square * sizeof *scratch);
    for (int i = 0; i < w * w; i++) scratch[i % w * w + i / w] = full[i];
    if (!dal__singular_values(w, w, scratch, matrix, matrix + w)) status = DAL_STATUS_MEMORY;
    for (out->rank = 0; out->rank < w; out->rank++)
        if (!(matrix[out->rank] > reach_tolerance * matrix[0])) break;
    free(memory);
    return status;
}
