/* leaf.c - targets off the leaf of the start.
 *
 * Where the velocities that D allows span, with all brackets, r of the dimensions of q, or of
 * (t, q), locally dimension - r independent functions I of q and t are constant on every motion
 * with D = 0 (Frobenius): among them g of holonomic constraints.  Those that are sums of products
 * of a low degree are found by invariants/invariants.c.  A target whose I is not the start's cannot
 * be reached. */
#include "steer/leaf.h"
#include "core/error.h"
#include "core/vectors.h"
#include "dalembert_invariants.h"
#include "expr/traversal.h"
#include "invariants/atoms.h"
#include "model/model.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_DEGREE = 4 };

/* Compares an invariant at both ends, unless it depends on a coordinate that is free there, by how
 * much the components change it. */
static dal_status compare_ends(dal__problem *p, const dal_invariant *invariant)
{
    const double rounding = 1e-10; /* as of targets off D = 0 */
    const int n = p->n;
    dal__equations *e = &p->model->equations;
    dal__node node;
    double value[2], size = 0.0;
    DAL_TRY(dal__search_parse(p->model, invariant->formula, 1, &node, p->error));
    for (int i = 0; i < n; i++)
        if ((p->is_free[0][i] || p->is_free[1][i]) &&
            dal__depends(e->graph, node, e->q + i, e->q + i + 1))
            return DAL_STATUS_OK;
    int *gradient = calloc((size_t)n, sizeof *gradient);
    double *rate = dal__numbers(1, (size_t)n);
    dal_status status = gradient && rate ? DAL_STATUS_OK : DAL_STATUS_MEMORY;
    if (status == DAL_STATUS_OK) dal__gradient(e->graph, node, e->symbol + e->q, n, gradient);
    for (int end = 0; end < 2 && status == DAL_STATUS_OK; end++) {
        const double t = end ? p->T : p->from, *x = end ? p->target : p->start;
        status = dal__problem_evaluate(p, &node, 1, t, x, &value[end]);
        if (status == DAL_STATUS_OK) status = dal__problem_evaluate(p, gradient, n, t, x, rate);
        for (int i = 0; i < n; i++) size += fabs(rate[i]) * (p->unit[i] + fabs(x[i]));
    }
    free(gradient);
    free(rate);
    if (status != DAL_STATUS_OK || !(fabs(value[1] - value[0]) > rounding * size)) return status;
    return dal__fail(p->error, DAL_STATUS_INCONSISTENT,
                     "the target is on another leaf of D = 0: every motion keeps %.80s, which is "
                     "%.6g at the start and %.6g at the target",
                     invariant->formula, value[0], value[1]);
}

dal_status dal__leaf_check(dal__problem *p, const dal_steering *steering)
{
    const dal_growth *g = &steering->growth;
    const bool keeps_D = p->integrals > 0 || !p->is_lifted;
    const int functions = steering->has_growth ? g->dimension - g->rank[g->levels - 1] : 0;
    dal_status status = DAL_STATUS_OK;
    bool is_complete = functions <= p->holonomic;
    if (!keeps_D) return DAL_STATUS_OK;
    for (int degree = 1; degree <= MAX_DEGREE && !is_complete && status == DAL_STATUS_OK;
         degree++) {
        const dal_invariants_settings set = {.degree = degree, .of_coordinates = true};
        dal_run_spec spec = p->spec;
        dal_invariants *found = NULL;
        status = dal_find_invariants(&found, p->model, &spec, &set, NULL);
        if (status != DAL_STATUS_OK) /* it is not known */
            return status == DAL_STATUS_MEMORY ? status : DAL_STATUS_OK;
        for (int i = 0; i < found->count && status == DAL_STATUS_OK; i++)
            status = compare_ends(p, &found->invariant[i]);
        is_complete = found->independent >= functions;
        dal_invariants_free(found);
    }
    p->knows_leaf = is_complete && p->system->effort != DAL_EFFORT_CONTROLS;
    return status;
}
