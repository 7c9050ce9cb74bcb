/* controlled.c - in how many directions controls move motions.
 *
 * Controls u in dv/dt = F + N u move (q, v) at a given time in as many directions as
 *
 *     V_1 = span (0, N_k),    V_(k+1) = V_k + span [(v, F), V_k] + span [V_1, V_k]
 *
 * has in the end, the smallest distribution that holds them and is closed under brackets with the
 * drift (v, F) too (strong accessibility); of t and (q, v) with the drift (1, v, F).  D is an
 * integral of all of them: ranks are taken on D = 0.
 *
 * H. J. Sussmann and V. Jurdjevic, J. Differential Equations 12 (1972) 95,
 * doi:10.1016/0022-0396(72)90007-1. */
#include "steer/controlled.h"
#include "core/settings.h"
#include "core/vectors.h"
#include "expr/derivative.h"
#include "expr/traversal.h"
#include "geometry/fields.h"
#include "model/motion.h"
#include <math.h>
#include <string.h>

/* The drift, which is no part of the distribution, multiplied by a time; and columns (0, N_k). */
static void make_controls(dal__fields *d, double time, double *x)
{
    const dal__equations *e = &d->model->equations;
    const int n = e->n, at_v = d->fixed + n;
    dal__node *field = d->field;
    if (d->fixed) field[0] = dal__number(e->graph, 1.0);
    for (int i = 0; i < n; i++) {
        field[d->fixed + i] = dal__symbol(e->graph, e->v + i);
        field[at_v + i] = e->F[i];
    }
    d->weight[0] = time;
    d->fields = 1;
    for (int k = 0; k < e->controls; k++) {
        double size = 0.0;
        field = d->field + d->fields * d->dim;
        for (int j = 0; j < at_v; j++) field[j] = dal__number(e->graph, 0.0);
        dal__gradient(e->graph, e->control_cost[k], e->symbol + e->pi, n, field + at_v);
        for (int i = at_v; i < d->dim; i++)
            size = fmax(size, fabs(dal__evaluate(e->graph, field[i], d->point)) / d->unit[i]);
        dal__fields_add(d, size > 0.0 ? 1.0 / size : 1.0, x);
    }
    d->first = d->fields;
}

/* Irregular points about the start, value[symbols], with velocities moved to D = 0, at which F is
 * finite. */
static dal_status make_states(dal__fields *d, const double *value, const double *units)
{
    enum { CORRECTIONS = 20 };
    const dal__equations *e = &d->model->equations;
    const int n = e->n;
    dal__node *change = dal__model_nodes(d->model, n, 0);
    if (e->m > 0) DAL_TRY(dal__motion_correct(d->model, change));
    if (d->model->out_of_memory) return DAL_STATUS_MEMORY;
    for (int try = 0; try < 8 * DAL__GENERIC_POINTS && d->points < DAL__GENERIC_POINTS; try++) {
        double *x = d->point + d->points * e->symbols, sum = 0.0;
        memcpy(x, value, (size_t)e->symbols * sizeof *x);
        dal__displace_point(x, e->t, 1 + n, units, try * e->symbols);
        dal__displace_point(x, e->v, n, units + 1 + n, try * e->symbols);
        for (int k = 0; k < CORRECTIONS && e->m > 0; k++) {
            for (int i = 0; i < n; i++) x[e->pi + i] = dal__evaluate(e->graph, change[i], x);
            for (int i = 0; i < n; i++) x[e->v + i] += x[e->pi + i];
        }
        for (int i = 0; i < n; i++) sum += dal__evaluate(e->graph, e->F[i], x);
        d->points += isfinite(sum);
    }
    return d->points > 0 ? e->graph->status : DAL_STATUS_NOT_FINITE;
}

dal_status dal__controlled_rank(dal_model *model, const dal_setting *parameters,
                                int parameter_count, const double *units, int *rank,
                                dal_error *error)
{
    const dal__equations *e = &model->equations;
    const int n = e->n;
    const size_t dim = 1 + 2 * (size_t)n;
    dal__fields d = {.model = model, .pivot = dal__model_allocate(model, 2 * dim, sizeof(int))};
    double *value, *x = dal__model_allocate(model, dim, sizeof *x);
    int *symbol = dal__model_allocate(model, dim, sizeof *symbol);
    *rank = -1;
    if (model->out_of_memory) return dal__memory_error(error);
    DAL_TRY(dal__fields_allocate(&d, dim, parameters, parameter_count, &value, error));
    for (int i = 0; i <= n; i++) symbol[i] = e->t + i;
    for (int i = 0; i < n; i++) {
        symbol[1 + n + i] = e->v + i;
        d.fixed |= dal__depends(e->graph, e->F[i], e->t, e->t + 1);
    }
    for (int k = 0; k < e->controls; k++)
        d.fixed |= dal__depends(e->graph, e->control_cost[k], e->t, e->t + 1);
    d.symbol = symbol + !d.fixed;
    d.unit = units + !d.fixed;
    d.dim = 2 * n + d.fixed;
    d.full = 2 * n - e->m - e->holonomic;
    dal_status status = make_states(&d, value, units);
    if (status == DAL_STATUS_OK) make_controls(&d, units[0], x);
    bool is_closed = status == DAL_STATUS_OK;
    for (int begin = 0, last = -1;
         is_closed && dal__fields_rank(&d) > last && dal__fields_rank(&d) < d.full;) {
        const int end = d.fields;
        last = dal__fields_rank(&d);
        is_closed = dal__fields_bracket(&d, begin, x);
        begin = end;
    }
    if (is_closed) *rank = dal__fields_rank(&d);
    if (status == DAL_STATUS_OK) status = e->graph->status;
    return status == DAL_STATUS_MEMORY ? dal__memory_error(error) : status;
}
