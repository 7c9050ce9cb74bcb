/* properties.c - what the formulas say about constraints and motion, decided on the graph.  A
 * system without constraints has none of the properties of D. */
#include "model/properties.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "model/energy.h"
#include "model/model.h"

/* ---- constraints ---- */

/* The derivatives of a node by q and v, one after the other. */
static void state_gradient(const dal__equations *e, dal__node f, dal__node *out)
{
    dal__gradient(e->graph, f, e->symbol + e->q, e->n, out);
    dal__gradient(e->graph, f, e->symbol + e->v, e->n, out + e->n);
}

static bool varies(const dal__equations *e, dal__node f)
{
    return dal__depends(e->graph, f, e->parameters, e->symbols);
}

/* What the second derivatives of a constraint allow; first and second: [2n] each, scratch. */
static unsigned constraint_class(const dal__equations *e, dal__node D, dal__node *first,
                                 dal__node *second)
{
    int n = e->n;
    unsigned all = DAL_D_LINEAR | DAL_D_CONSTANT | DAL_D_BILINEAR | DAL_D_QUADRATIC;
    state_gradient(e, D, first);
    if (dal__depends(e->graph, D, e->t, e->t + 1)) all = DAL_D_LINEAR;
    for (int i = 0; i < 2 * n; i++) {
        state_gradient(e, first[i], second);
        if (varies(e, first[i])) all &= ~(unsigned)DAL_D_CONSTANT;
        for (int j = 0; j < 2 * n; j++) {
            if (dal__is_number(e->graph, second[j], 0.0)) continue;
            if (i >= n && j >= n) all &= ~(unsigned)(DAL_D_LINEAR | DAL_D_BILINEAR);
            if (i < n && j < n) all &= ~(unsigned)DAL_D_BILINEAR;
            if (varies(e, second[j])) all &= ~(unsigned)(DAL_D_BILINEAR | DAL_D_QUADRATIC);
        }
    }
    return all;
}

/* ---- what methods need that enforce D ---- */

static bool depends_on_v(const dal__equations *e, const dal__node *f, int count)
{
    for (int i = 0; i < count; i++)
        if (dal__depends(e->graph, f[i], e->v, e->v + e->n)) return true;
    return false;
}

/* A W_00 = D_00 W v, where D_00 is the first entry of D_vv and W constant: D = k (v.Wv/2 - K). */
static bool is_isokinetic(const dal__equations *e, dal__node *row)
{
    dal__graph *graph = e->graph;
    const dal__node *v = e->flow + 1;
    if (e->m != 1 || e->servo || !dal__is_number(graph, e->c[0], 0.0)) return false;
    if (dal__is_number(graph, e->W[0], 0.0)) return false;
    dal__gradient(graph, e->A[0], e->symbol + e->v, e->n, row);
    const dal__node first = row[0];
    for (int i = 0; i < e->n; i++) {
        dal__gradient(graph, e->A[i], e->symbol + e->v, e->n, row);
        for (int j = 0; j < e->n; j++) {
            dal__node expected = dal__node_mul(graph, first, e->W[i * e->n + j]);
            dal__node defect =
                dal__node_sub(graph, dal__node_mul(graph, row[j], e->W[0]), expected);
            if (!dal__is_number(graph, defect, 0.0)) return false;
        }
        dal__node rest = dal__node_sub(graph, e->A[i], dal__dot(graph, e->n, row, v));
        if (!dal__is_number(graph, rest, 0.0)) return false;
    }
    return true;
}

static unsigned parts_properties(const dal__equations *e, dal__node *row)
{
    const int n = e->n, mn = e->m * e->n;
    if (e->vakonomic || depends_on_v(e, e->a, n)) return 0;
    if (!depends_on_v(e, e->A, mn) && !depends_on_v(e, e->R, mn)) return DAL_BLOCKS_POSITIONAL;
    const bool steady = e->properties & DAL_MASS_CONSTANT;
    return steady && is_isokinetic(e, row) ? DAL_D_ISOKINETIC : 0;
}

/* ---- the whole ---- */

dal_status dal__properties(dal_model *model)
{
    dal__equations *e = &model->equations;
    dal__node *first = dal__model_nodes(model, 2 * e->n, 0);
    dal__node *second = dal__model_nodes(model, 2 * e->n, 0);
    if (model->out_of_memory) return DAL_MEMORY;
    bool autonomous = true, constant = true;
    for (int i = 0; i < e->n + e->multipliers; i++)
        autonomous = autonomous && !dal__depends(e->graph, e->F[i], e->t, e->t + 1);
    for (int i = 0; i < e->n * e->n; i++) constant = constant && !varies(e, e->W[i]);
    e->properties = e->m ? ~0u : 0;
    for (int a = 0; a < e->m; a++)
        e->properties &= constraint_class(e, e->constraint[a], first, second);
    /* The rank of A is to be checked where it can fall and no formula shows it: that of nonlinear
     * constraints, and of several that vary and may become parallel (a snakeboard with its axles
     * across). */
    if (e->m && !(e->properties & (e->m > 1 ? DAL_D_CONSTANT : DAL_D_LINEAR)))
        e->properties |= DAL_D_RANK_CHECKED;
    e->properties |= (autonomous ? DAL_AUTONOMOUS : 0u) | (constant ? DAL_MASS_CONSTANT : 0u) |
                     (e->vakonomic ? DAL_VAKONOMIC : 0u) | (e->servo ? DAL_SERVO : 0u);
    DAL_TRY(dal__energy_properties(model));
    e->properties |= parts_properties(e, first);
    return e->graph->status;
}
