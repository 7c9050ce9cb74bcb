/* ranks.c - ranks at points: whether the equations of motion have one solution, and the growth
 * vector of the velocities that constraints allow.
 *
 *     W v' - A^T h = b,   A v' = -c
 *
 * have one solution where A has rank m and W is regular on ker A, that is Z W Z^T of rank n - m for
 * rows Z that span ker A.  Entries are compared in the given units.
 *
 * D = A(q) v allows the fields X_1, .., X_(n-m) that span ker A.  With the bracket of fields
 *
 *     [X, Y]_j = sum_i X_i dY_j/dq_i - Y_i dX_j/dq_i
 *     V_1 = span X_i,    V_(k+1) = V_k + span [X_i, V_k]
 *
 * the ranks of V_1, V_2, .. at generic points are the growth vector.  Where V_2 = V_1 the
 * constraints are integrable (Frobenius), where a rank is n every q can be reached (Chow).
 * D = A v + a and D of t are the same on (t, q), with the column a.  Brackets are exact, as
 * formulas; ranks are numerical, at points about the start.
 *
 * R. Montgomery, A Tour of Subriemannian Geometries, AMS 2002, ch. 2. */
#include "model/ranks.h"
#include "core/settings.h"
#include "core/vectors.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "model/motion.h"
#include <math.h>
#include <string.h>

/* ---- at a point ---- */

/* value[symbols] of the default start, with the parameters. */
static dal_status copy_values(dal_model *model, const dal_setting *parameters, int parameter_count,
                              double **value, dal_error *error)
{
    const dal__equations *e = &model->equations;
    *value = dal__model_allocate(model, (size_t)e->symbols, sizeof **value);
    if (!*value) return dal__memory_error(error);
    memcpy(*value, e->value, (size_t)e->symbols * sizeof **value);
    return dal__set_parameters(&model->system, parameters, parameter_count, DAL_STATUS_NOT_FINITE,
                               *value, error);
}

/* The units, or units of 1 for t and q where there are none; NULL: out of memory. */
static const double *complete_units(dal_model *model, const double *units)
{
    const size_t count = 1 + (size_t)model->equations.n;
    double *ones = units ? NULL : dal__model_allocate(model, count, sizeof *ones);
    for (size_t i = 0; ones && i < count; i++) ones[i] = 1.0;
    return units ? units : ones;
}

/* ---- of A, and of W on ker A ---- */

/* Pivots below this fraction of the largest leave F less than six digits. */
static const double rank_tolerance = 1e-10;

/* The matrices at a point, in the units. */
typedef struct matrices {
    int n, m;
    double *A, *W;  /* [m*n], [n*n] */
    double *basis;  /* [n*n] orthonormal rows: of A, then of ker A */
    double *matrix; /* [n*n] whose rank is taken */
    double *work;   /* [n*(n+2)] */
} matrices;

static int rank_of(const matrices *k, int rows, int columns, double *pivot)
{
    return dal__least_squares(rows, columns, k->matrix, NULL, NULL, rank_tolerance, pivot, k->work);
}

/* Continues m orthonormal rows by n - m of them, each from the unit vector with the largest part
 * orthogonal to those before. */
static void complete_basis(const matrices *k)
{
    const int n = k->n;
    for (int row = k->m; row < n; row++) {
        double best = -1.0;
        int axis = 0;
        for (int i = 0; i < n; i++) {
            double rest = 1.0;
            for (int j = 0; j < row; j++) rest -= k->basis[j * n + i] * k->basis[j * n + i];
            if (rest > best) best = rest, axis = i;
        }
        memset(k->basis + row * n, 0, (size_t)n * sizeof *k->basis);
        k->basis[row * n + axis] = 1.0;
        dal__orthonormalise_row(k->basis, row, n);
        dal__orthonormalise_row(k->basis, row, n); /* against rounding */
    }
}

/* The rank of Z W Z^T, each row relative to the root of what its diagonal entry is a sum of: what
 * rounding leaves of W counts as 0. */
static int rank_on_kernel(const matrices *k, double *pivot)
{
    const int n = k->n, size = n - k->m;
    const double *Z = k->basis + k->m * n;
    double *root = k->work;
    for (int a = 0; a < size; a++)
        for (int b = 0; b < size; b++) {
            double sum = 0.0, terms = 0.0;
            for (int i = 0; i < n * n; i++) {
                const double term = Z[a * n + i / n] * k->W[i] * Z[b * n + i % n];
                sum += term;
                terms += fabs(term);
            }
            k->matrix[a * size + b] = sum;
            if (a == b) root[a] = sqrt(terms);
        }
    for (int i = 0; i < size * size; i++) {
        const double scale = root[i / size] * root[i % size];
        if (scale > 0.0) k->matrix[i] /= scale;
    }
    *pivot = 0.0;
    if (dal__max_abs(k->matrix, (size_t)(size * size)) < rank_tolerance) return 0;
    return rank_of(k, size, size, pivot);
}

/* Evaluates A, with rows of a largest entry of 1, and W. */
static bool fill_matrices(const matrices *k, const dal__equations *e, const double *value,
                          const double *units)
{
    const int n = k->n;
    for (int i = 0; i < k->m * n; i++)
        k->A[i] = dal__evaluate(e->graph, e->A[i], value) * units[1 + i % n];
    for (int a = 0; a < k->m; a++) {
        const double size = dal__max_abs(k->A + a * n, (size_t)n);
        for (int i = 0; i < n && size > 0.0; i++) k->A[a * n + i] /= size;
    }
    for (int i = 0; i < n * n; i++)
        k->W[i] = dal__evaluate(e->graph, e->W[i], value) * units[1 + i / n] * units[1 + i % n];
    return isfinite(dal__max_abs(k->A, (size_t)(k->m * n))) &&
           isfinite(dal__max_abs(k->W, (size_t)(n * n)));
}

/* False: out of memory. */
static bool allocate_matrices(dal_model *model, matrices *k)
{
    const size_t n = (size_t)model->equations.n, m = (size_t)model->equations.m;
    *k = (matrices){.n = model->equations.n,
                    .m = model->equations.m,
                    .A = dal__model_allocate(model, m * n + 1, sizeof(double)),
                    .W = dal__model_allocate(model, n * n, sizeof(double)),
                    .basis = dal__model_allocate(model, n * n, sizeof(double)),
                    .matrix = dal__model_allocate(model, n * n, sizeof(double)),
                    .work = dal__model_allocate(model, n * (n + 2), sizeof(double))};
    return !model->out_of_memory;
}

/* The rank of A and, where it is m, of W on ker A. */
static void find_ranks(const matrices *k, dal_ranks *out)
{
    const int n = k->n, m = k->m;
    for (int a = 0; a < m; a++)
        for (int i = 0; i < n; i++) k->matrix[i * m + a] = k->A[a * n + i];
    out->constraints = m > 0 ? rank_of(k, n, m, &out->constraints_pivot) : 0;
    if (out->constraints < m) return;
    memcpy(k->basis, k->A, (size_t)(m * n) * sizeof *k->basis);
    for (int a = 0; a < m; a++) dal__orthonormalise_row(k->basis, a, n);
    complete_basis(k);
    out->mass = n > m ? rank_on_kernel(k, &out->mass_pivot) : 0;
}

dal_status dal_model_ranks(dal_model *model, const dal_setting *parameters, int parameter_count,
                           const dal_point *at, const double *units, dal_ranks *out,
                           dal_error *error)
{
    DAL_REQUIRE(model, error);
    DAL_REQUIRE(out, error);
    DAL_REQUIRE(at && at->q && at->v, error);
    DAL_REQUIRE(model->made, error);
    DAL_TRY(dal__check_settings(parameters, parameter_count, "parameters", error));
    const dal__equations *e = &model->equations;
    const size_t n = (size_t)e->n;
    double *value;
    matrices k;
    *out = (dal_ranks){.mass = -1};
    if (e->vakonomic || e->servo)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "the motion does not follow Chetaev's rule");
    DAL_TRY(copy_values(model, parameters, parameter_count, &value, error));
    units = complete_units(model, units);
    if (!allocate_matrices(model, &k)) return dal__memory_error(error);
    value[e->t] = at->t;
    memcpy(value + e->q, at->q, n * sizeof *value);
    memcpy(value + e->v, at->v, n * sizeof *value);
    const bool is_finite = fill_matrices(&k, e, value, units);
    if (e->graph->status == DAL_STATUS_MEMORY) return dal__memory_error(error);
    if (!is_finite)
        return dal__fail(error, DAL_STATUS_NOT_FINITE, "A or W is not finite at t = %.17g", at->t);
    find_ranks(&k, out);
    return DAL_STATUS_OK;
}

/* ---- distributions ---- */

enum { MAX_NODES = 400000 };
/* Nodes passed over by derivatives: the brackets of a large system are not all followed. */
#define MAX_WORK 4e9

dal_status dal__fields_allocate(dal__fields *d, size_t dim, const dal_setting *parameters,
                                int parameter_count, double **value, dal_error *error)
{
    dal_model *const model = d->model;
    const dal__equations *e = &model->equations;
    const size_t symbols = (size_t)e->symbols;
    d->field = dal__model_nodes(model, (int)((DAL__GENERIC_POINTS * dim + 2) * dim), 0);
    d->weight = dal__model_allocate(model, DAL__GENERIC_POINTS * dim + 2, sizeof *d->weight);
    d->basis = dal__model_allocate(model, DAL__GENERIC_POINTS * dim * dim, sizeof *d->basis);
    d->point = dal__model_allocate(model, DAL__GENERIC_POINTS * symbols, sizeof *d->point);
    if (model->out_of_memory) return dal__memory_error(error);
    return copy_values(model, parameters, parameter_count, value, error);
}

void dal__displace_point(double *x, int from, int count, const double *unit, int way)
{
    for (int i = 0; i < count; i++)
        x[from + i] += unit[i] * (dal__golden_fraction(way + from + i + 1) - 0.5);
}

/* ---- fields at the points ---- */

/* Adds what of x[dim] is orthogonal to the basis at a point; false: nothing is. */
static bool extend_basis(dal__fields *d, int point, double *x)
{
    double *basis = d->basis + (size_t)(point * d->dim) * (size_t)d->dim;
    double size = 1.0, rest = 0.0;
    if (d->rank[point] == d->dim) return false;
    for (int j = 0; j < d->dim; j++) size = fmax(size, fabs(x[j]));
    for (int k = 0; k < 2 * d->rank[point]; k++) /* twice, against rounding */
        dal__remove_component(x, basis + k % d->rank[point] * d->dim, d->dim);
    for (int j = 0; j < d->dim; j++) rest += x[j] * x[j];
    rest = sqrt(rest);
    if (!(rest > DAL__FIELD_ROUNDING * size) || isinf(rest)) return false;
    for (int j = 0; j < d->dim; j++) basis[d->rank[point] * d->dim + j] = x[j] / rest;
    d->rank[point]++;
    return true;
}

/* With a drift the fields become unit vectors in the components of their pivots at the first point:
 * the new one loses its parts along those before, and is divided by its largest component. */
static void eliminate_field(dal__fields *d)
{
    dal__graph *graph = d->model->equations.graph;
    dal__node *field = d->field + d->fields * d->dim;
    const int last = d->rank[0] - 1;
    double max = -1.0;
    int best = 0;
    for (int k = 0; k < last; k++) {
        const dal__node *other = d->field + d->pivot[2 * k] * d->dim;
        const dal__node part = field[d->pivot[2 * k + 1]];
        for (int j = 0; j < d->dim; j++)
            field[j] = dal__node_sub(graph, field[j], dal__node_mul(graph, part, other[j]));
    }
    for (int j = 0; j < d->dim; j++) {
        const double size = fabs(dal__evaluate(graph, field[j], d->point)) / d->unit[j];
        if (size > max) max = size, best = j;
    }
    for (int j = 0; j < d->dim; j++)
        if (j != best) field[j] = dal__node_div(graph, field[j], field[best]);
    field[best] = dal__number(graph, 1.0);
    d->pivot[2 * last] = d->fields;
    d->pivot[2 * last + 1] = best;
    d->weight[d->fields] = d->unit[best];
}

void dal__fields_add(dal__fields *d, double weight, double *x)
{
    dal__graph *graph = d->model->equations.graph;
    const dal__node *field = d->field + d->fields * d->dim;
    const int rank = d->rank[0];
    bool is_new = false, is_zero = true;
    for (int j = 0; j < d->dim; j++) is_zero &= dal__node_is_zero(graph, field[j]);
    for (int k = 0; k < d->points && !is_zero; k++) {
        const double *at = d->point + k * d->model->equations.symbols;
        for (int j = 0; j < d->dim; j++)
            x[j] = dal__node_is_zero(graph, field[j])
                       ? 0.0
                       : dal__evaluate(graph, field[j], at) * weight / d->unit[j];
        is_new |= extend_basis(d, k, x);
    }
    d->weight[d->fields] = weight;
    if (d->pivot && d->rank[0] > rank) eliminate_field(d);
    d->fields += is_new;
}

int dal__fields_rank(const dal__fields *d)
{
    int max = 0;
    for (int k = 0; k < d->points; k++)
        if (d->rank[k] > max) max = d->rank[k];
    return max;
}

/* ---- brackets ---- */

/* The derivative of f along a field. */
static dal__node along(dal__fields *d, dal__node f, const dal__node *field)
{
    dal__graph *graph = d->model->equations.graph;
    if (dal__inspect(graph, f).op == DAL__NUMBER) return dal__number(graph, 0.0);
    d->work += graph->count;
    return dal__tangent(graph, f, d->symbol, d->dim, field);
}

bool dal__fields_bracket(dal__fields *d, int begin, double *x)
{
    dal__graph *graph = d->model->equations.graph;
    const int end = d->fields;
    for (int k = begin; k < end; k++)
        for (int i = 0; i < (begin == 0 ? k : d->first); i++) {
            const dal__node *X = d->field + i * d->dim, *Y = d->field + k * d->dim;
            dal__node *out = d->field + d->fields * d->dim;
            if (dal__fields_rank(d) == d->full) return true;
            if (graph->count > MAX_NODES || d->work > MAX_WORK) return false;
            for (int j = 0; j < d->dim; j++)
                out[j] = dal__node_sub(graph, along(d, Y[j], X), along(d, X[j], Y));
            dal__fields_add(d, d->weight[i] * d->weight[k], x);
        }
    return true;
}

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
    if (d->model->out_of_memory) return DAL_STATUS_MEMORY;
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
    return e->graph->status;
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
    return e->graph->status;
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
    units = complete_units(model, units);
    if (model->out_of_memory) return dal__memory_error(error);
    DAL_TRY(dal__fields_allocate(d, dim, parameters, parameter_count, &value, error));
    dal_status status = make_matrix(d, A, value, units, error);
    if (status == DAL_STATUS_OK) status = make_fields(d, A, x);
    DAL_TRY(dal__check_size(e->graph->status, error));
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
    return dal__check_size(e->graph->status, error);
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
