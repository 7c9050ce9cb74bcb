/* reduction.c - linear equations on the surface of Dirac's constraints, with nodes as entries.
 *
 * Gauss-Jordan elimination: an entry that vanishes on the surface is 0, a pivot is a number where
 * the row has one, otherwise the entry whose least size at the points is largest. */
#include "lift/reduction.h"
#include "core/error.h"
#include "expr/simplify.h"

void dal__reduction_begin(dal__reduction *r, const dal__surface *s, int rows, int columns,
                          int rights)
{
    *r = (dal__reduction){.rows = rows, .columns = columns, .width = columns + rights};
    r->entry = dal__pool_nodes(s->pool, s->theory->graph, (size_t)rows * (size_t)r->width);
    r->pivot = dal__pool_allocate(s->pool, (size_t)rows + 1, sizeof *r->pivot);
    r->row = dal__pool_allocate(s->pool, (size_t)columns + 1, sizeof *r->row);
    if (s->pool->out_of_memory) return;
    for (int a = 0; a < rows; a++) r->pivot[a] = -1;
    for (int j = 0; j < columns; j++) r->row[j] = -1;
}

/* Row a loses unknown j by row b. */
static dal_status eliminate(const dal__reduction *r, const dal__surface *s, int a, int b, int j)
{
    dal__graph *graph = s->theory->graph;
    dal__node *to = r->entry + (size_t)a * (size_t)r->width;
    const dal__node *by = r->entry + (size_t)b * (size_t)r->width;
    if (dal__node_is_zero(graph, to[j])) return DAL_STATUS_OK;
    const dal__node factor = dal__node_div(graph, to[j], by[j]);
    for (int i = 0; i < r->width; i++)
        if (!dal__node_is_zero(graph, by[i]))
            to[i] = dal__node_sub(graph, to[i], dal__node_mul(graph, factor, by[i]));
    to[j] = dal__number(graph, 0.0);
    return dal__surface_clean(s, r->width, to);
}

dal_status dal__reduction_solve(dal__reduction *r, const dal__surface *s)
{
    const dal__graph *graph = s->theory->graph;
    const size_t columns = (size_t)r->columns;
    double *value = dal__pool_allocate(s->pool, DAL__SURFACE_POINTS * columns + 1, sizeof *value);
    if (s->pool->out_of_memory) return DAL_STATUS_OK;
    DAL_TRY(dal__surface_clean(s, r->rows * r->width, r->entry));
    for (int a = 0; a < r->rows; a++) {
        const dal__node *entry = r->entry + (size_t)a * (size_t)r->width;
        int pivot = -1, candidates = 0;
        for (int j = 0; j < r->columns; j++)
            if (r->row[j] >= 0) DAL_TRY(eliminate(r, s, a, r->row[j], j));
        for (int j = 0; j < r->columns; j++) {
            if (dal__node_is_zero(graph, entry[j])) continue;
            candidates++;
            if (pivot < 0 || dal__inspect(graph, entry[j]).op == DAL__NUMBER) pivot = j;
        }
        if (pivot < 0) continue;
        double best = 0.0;
        const bool is_open = candidates > 1 && dal__inspect(graph, entry[pivot]).op != DAL__NUMBER;
        if (is_open) dal__surface_values(s, r->columns, entry, value);
        for (size_t j = 0; is_open && j < columns; j++) {
            const double least = dal__least_size(value + j, columns);
            if (least > best) best = least, pivot = (int)j;
        }
        for (int b = 0; b < a; b++) DAL_TRY(eliminate(r, s, b, a, pivot));
        r->pivot[a] = pivot;
        r->row[pivot] = a;
    }
    return DAL_STATUS_OK;
}

dal__node dal__reduction_value(const dal__reduction *r, dal__graph *graph, int unknown, int k,
                               const dal__node *free_unknown)
{
    if (r->row[unknown] < 0) return free_unknown[unknown];
    const dal__node *entry = r->entry + (size_t)r->row[unknown] * (size_t)r->width;
    dal__node sum = entry[r->columns + k];
    for (int j = 0; j < r->columns; j++)
        if (r->row[j] < 0 && !dal__node_is_zero(graph, entry[j]))
            sum = dal__node_add(graph, sum, dal__node_mul(graph, entry[j], free_unknown[j]));
    return dal__node_neg(graph, dal__node_div(graph, sum, entry[unknown]));
}
