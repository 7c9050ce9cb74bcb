/* growth.c - the growth vector of the velocities that constraints allow.
 *
 * D = A(q) v allows the fields X_1, .., X_(n-m) that span ker A.  With the bracket of fields
 *
 *     V_1 = span X_i,    V_(k+1) = V_k + span [X_i, V_k]
 *
 * the ranks of V_1, V_2, .. at generic points are the growth vector.  Where V_2 = V_1 the
 * constraints are integrable (Frobenius), where a rank is n every q can be reached (Chow).
 * D = A v + a and D of t are the same on (t, q), with the column a.
 *
 * R. Montgomery, A Tour of Subriemannian Geometries, AMS 2002, ch. 2. */
#include "core/settings.h"
#include "core/vectors.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "geometry/fields.h"
#include "model/motion.h"
#include "model/units.h"
#include <math.h>
#include <string.h>

/* ---- the fields X_i ---- */

static dal__node times(dal__graph *graph, dal__node f, double factor)
{
    return dal__node_mul(graph, dal__number(graph, factor), f);
}

/* X_c for each column c that is no pivot: 1 there, and -A_p^-1 A_c in the pivots p.  Pivots are
 * chosen by elimination at the first point; t is none.  A_p is solved in units in which the largest
 * entry of each row is about 1, since its rows and columns have units of their own. */
static dal_status make_fields(dal__fields *d, const dal__node *A, double *x)
{
    dal__equations *e = &d->model->equations;
    const int m = d->rows, dim = d->dim;
    bool *pivot = dal__model_allocate(d->model, (size_t)dim, sizeof *pivot);
    double *per_row = dal__model_allocate(d->model, (size_t)m, sizeof *per_row);
    dal__node *matrix = dal__model_nodes(d->model, m * m, 0);
    dal__node *side = dal__model_nodes(d->model, 2 * m, 0), *solution = side + m;
    if (d->model->out_of_memory) return DAL_STATUS_OK;
    for (int i = 0; i < m * dim; i++)
        x[i] = dal__evaluate(e->graph, A[i], d->point) * d->unit[i % dim];
    for (int a = 0; a < m; a++) {
        const double size = dal__max_abs(x + a * dim, (size_t)dim); /* in the units */
        for (int j = 0; j < dim && size > 0.0; j++) x[a * dim + j] /= size;
        per_row[a] = size > 0.0 && isfinite(size) ? 1.0 / dal__power_of_two(size) : 1.0;
    }
    for (int a = 0; a < m; a++) {
        const double *row = x + a * dim;
        int best = d->fixed;
        for (int j = d->fixed; j < dim; j++)
            if (fabs(row[j]) > fabs(row[best])) best = j;
        if (!(fabs(row[best]) > DAL__FIELD_ROUNDING)) return DAL_STATUS_SINGULAR;
        pivot[best] = true;
        for (int b = a + 1; b < m; b++) {
            const double factor = x[b * dim + best] / row[best];
            for (int j = 0; j < dim; j++) x[b * dim + j] -= factor * row[j];
        }
    }
    for (int j = 0, p = 0; j < dim; j++) {
        if (!pivot[j]) continue;
        for (int a = 0; a < m; a++)
            matrix[a * m + p] = times(e->graph, A[a * dim + j], per_row[a] * d->unit[j]);
        p++;
    }
    for (int c = 0; c < dim; c++) {
        if (pivot[c]) continue;
        dal__node *field = d->field + d->fields * dim;
        for (int a = 0; a < m; a++) side[a] = times(e->graph, A[a * dim + c], -per_row[a]);
        DAL_TRY(dal__solve_vector(d->model, m, matrix, side, solution));
        for (int j = 0, p = 0; j < dim; j++)
            field[j] = pivot[j] ? times(e->graph, solution[p++], d->unit[j])
                                : dal__number(e->graph, j == c ? 1.0 : 0.0);
        dal__fields_add(d, d->unit[c], x);
    }
    d->first = d->fields;
    return DAL_STATUS_OK;
}

/* D at v = 0. */
static dal__node at_rest(const dal__equations *e, dal__node D, const dal__node *zeros)
{
    return dal__substitute(e->graph, D, e->symbol + e->v, e->n, zeros);
}

/* A[rows*dim] of a distribution, after it n zeros, the first column for t; and irregular points
 * about the start, value[symbols], at which it is finite. */
static dal_status make_matrix(dal__fields *d, dal__node *A, const double *value,
                              const double *units, dal_error *error)
{
    const dal__equations *e = &d->model->equations;
    const dal__node *zeros = A + d->rows * (1 + e->n), *of_v = e->A + d->row * e->n;
    const dal__node *D = e->constraint + d->row;
    bool has_t = false;
    for (int i = 0; i < d->rows * e->n; i++) {
        if (dal__depends(e->graph, of_v[i], e->v, e->v + e->n))
            return dal__fail(error, DAL_STATUS_UNSUPPORTED, "%s is not linear in v",
                             DAL__CONSTRAINT_NAME(e, d->row + i / e->n));
        has_t |= dal__depends(e->graph, of_v[i], e->t, e->t + 1);
    }
    for (int a = 0; a < d->rows; a++)
        has_t |= !dal__node_is_zero(e->graph, at_rest(e, D[a], zeros));
    d->fixed = has_t;
    d->dim = d->full = e->n + has_t;
    d->symbol = e->symbol + (has_t ? e->t : e->q);
    d->unit = units + !has_t;
    for (int a = 0; a < d->rows; a++) {
        if (has_t) A[a * d->dim] = at_rest(e, D[a], zeros);
        memcpy(A + a * d->dim + has_t, of_v + a * e->n, (size_t)e->n * sizeof *A);
    }
    for (int try = 0; try < 8 * DAL__GENERIC_POINTS && d->points < DAL__GENERIC_POINTS; try++) {
        double *x = d->point + d->points * e->symbols, sum = 0.0;
        memcpy(x, value, (size_t)e->symbols * sizeof *x);
        dal__displace_point(x, e->t, 1 + e->n, units, try * e->symbols);
        for (int i = 0; i < d->rows * d->dim; i++) sum += dal__evaluate(e->graph, A[i], x);
        d->points += isfinite(sum);
    }
    if (d->points == 0)
        return dal__fail(error, DAL_STATUS_NOT_FINITE, "A has no finite values about the start");
    return DAL_STATUS_OK;
}

/* ---- the whole ---- */

/* Finds the ranks of the distribution of its rows. */
static dal_status find_growth(dal__fields *d, const dal_setting *parameters, int parameter_count,
                              const double *units, dal_growth *out, dal_error *error)
{
    dal_model *const model = d->model;
    const dal__equations *e = &model->equations;
    const size_t dim = 1 + (size_t)e->n, rows = (size_t)d->rows;
    dal__node *A = dal__model_nodes(model, (int)(rows * dim) + e->n, dal__number(e->graph, 0.0));
    double *value, *x = dal__model_allocate(model, rows * dim, sizeof *x);
    units = dal__complete_units(model, units);
    if (model->out_of_memory) return dal__memory_error(error);
    DAL_TRY(dal__fields_allocate(d, dim, parameters, parameter_count, &value, error));
    dal_status status = make_matrix(d, A, value, units, error);
    if (status == DAL_STATUS_OK) status = make_fields(d, A, x);
    DAL_TRY(dal__model_conclude(model, DAL_STATUS_OK, error));
    if (status == DAL_STATUS_SINGULAR)
        return dal__fail(error, status, "the constraints are dependent about the start");
    DAL_TRY(status);
    out->dimension = d->dim;
    out->rank[out->levels++] = dal__fields_rank(d);
    for (int begin = 0; out->levels < DAL_GROWTH_LEVELS && !out->is_complete;) {
        const int end = d->fields, last = out->rank[out->levels - 1];
        if (!dal__fields_bracket(d, begin, x)) break;
        begin = end;
        if (dal__fields_rank(d) > last) out->rank[out->levels++] = dal__fields_rank(d);
        out->is_complete = dal__fields_rank(d) == last || dal__fields_rank(d) == d->full;
    }
    return dal__model_conclude(model, DAL_STATUS_OK, error);
}

dal_status dal_model_growth(dal_model *model, const dal_setting *parameters, int parameter_count,
                            const double *units, dal_growth *out, dal_error *error)
{
    DAL_REQUIRE(model, error);
    DAL_REQUIRE(out, error);
    DAL_REQUIRE(model->made, error);
    DAL_TRY(dal__check_settings(parameters, parameter_count, "parameters", error));
    *out = (dal_growth){.levels = 0};
    dal__fields d = {.model = model, .rows = model->equations.m};
    if (d.rows == 0)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED, "the system has no constraints");
    return find_growth(&d, parameters, parameter_count, units, out, error);
}

dal_status dal_model_growth_of(dal_model *model, int constraint, const dal_setting *parameters,
                               int parameter_count, const double *units, dal_growth *out,
                               dal_error *error)
{
    DAL_REQUIRE(model, error);
    DAL_REQUIRE(out, error);
    DAL_REQUIRE(model->made, error);
    DAL_TRY(dal__check_settings(parameters, parameter_count, "parameters", error));
    *out = (dal_growth){.levels = 0};
    dal__fields d = {.model = model, .row = constraint, .rows = 1};
    if (constraint < 0 || constraint >= model->equations.m)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "constraint %d: the system has %d", constraint,
                         model->equations.m);
    return find_growth(&d, parameters, parameter_count, units, out, error);
}
