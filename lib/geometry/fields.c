/* fields.c - fields of vectors, their ranks at points, and their brackets
 *
 *     [X, Y]_j = sum_i X_i dY_j/dq_i - Y_i dX_j/dq_i.
 *
 * Brackets are exact, as formulas; ranks are numerical, at points about the start. */
#include "geometry/fields.h"
#include "core/vectors.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "model/units.h"
#include <math.h>

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
    return dal__start_values(model, parameters, parameter_count, value, error);
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
