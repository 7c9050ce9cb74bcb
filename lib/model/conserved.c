/* conserved.c - what a conserved energy gives beside its value.
 *
 * The normal of E = const, for projections: E_q, E_v and W^-1 E_q.  (W^-1 E_v is v.)
 *
 * Where E is conserved on D = 0 alone, dE/dt = v.Q - L_t + h.(B v) vanishes there and nowhere else.
 * The motion can be continued off D = 0 in another way, so that E is a true integral and D remains
 * one:
 *
 *     F~ = F + alpha (v - W^-1 A^T beta),   (A W^-1 A^T) beta = A v
 *     alpha = -(dE/dt) / (v.W v - (A v).beta)
 *
 * The divisor is the square of that part of v that D leaves free, so F~ = F on D = 0. */
#include "model/mechanics.h"

/* Added to the denominator, which vanishes at rest, where alpha is to be 0: far below v.W v of any
 * motion, and its square is still a number. */
#define REST 1e-150

static dal__node *take(dal_model *model, int count)
{
    return dal__model_take(model, (size_t)count, sizeof(dal__node));
}

static dal_status find_normal(dal_model *model)
{
    dal__equations *e = &model->equations;
    const int n = e->n;
    dal__node *normal = take(model, 1 + 3 * n);
    if (!normal) return DAL_MEMORY;
    normal[0] = e->energy;
    dal__gradient(e->graph, e->energy, e->symbol + e->q, n, normal + 1);
    dal__gradient(e->graph, e->energy, e->symbol + e->v, n, normal + 1 + n);
    e->normal = normal;
    return dal__solve_again(model, n, e->W, normal + 1, normal + 1 + 2 * n);
}

static dal__node by_time(const dal__equations *e, dal__node f)
{
    dal__node out;
    dal__gradient(e->graph, f, e->symbol + e->t, 1, &out);
    return out;
}

/* A v and beta. */
static dal_status find_beta(dal_model *model, dal__node *along, dal__node *beta)
{
    const dal__equations *e = &model->equations;
    const int n = e->n, m = e->m;
    dal__node *G = take(model, m * m);
    if (!G) return DAL_MEMORY;
    for (int a = 0; a < m; a++) {
        along[a] = dal__dot(e->graph, n, e->A + a * n, e->flow + 1);
        for (int b = a; b < m; b++) {
            dal__node sum = dal__number(e->graph, 0.0);
            for (int i = 0; i < n; i++)
                sum = dal__add(e->graph, sum, dal__mul(e->graph, e->A[a * n + i], e->U[i * m + b]));
            G[a * m + b] = G[b * m + a] = sum;
        }
    }
    return dal__solve_again(model, m, G, along, beta);
}

/* dE/dt along F. */
static dal__node power(const dal__equations *e)
{
    const dal__node *v = e->flow + 1;
    dal__node sum =
        dal__sub(e->graph, dal__dot(e->graph, e->n, v, e->force), by_time(e, e->lagrangian));
    for (int a = 0; a < e->m; a++) {
        dal__node along = dal__dot(e->graph, e->n, e->B + a * e->n, v);
        sum = dal__add(e->graph, sum, dal__mul(e->graph, e->h[a], along));
    }
    return sum;
}

static dal_status extend(dal_model *model)
{
    dal__equations *e = &model->equations;
    dal__graph *graph = e->graph;
    const int n = e->n, m = e->m;
    dal__node *along = take(model, m), *beta = take(model, m), *extended = take(model, n);
    if (model->starved) return DAL_MEMORY;
    dal_status status = find_beta(model, along, beta);
    if (status != DAL_OK) return status == DAL_SINGULAR ? DAL_OK : status; /* B is not A */
    const dal__node *v = e->flow + 1;
    dal__node whole = dal__dot(graph, n, v, e->normal + 1 + n);
    dal__node free = dal__sub(graph, whole, dal__dot(graph, m, along, beta));
    dal__node divisor = dal__add(graph, free, dal__number(graph, REST));
    dal__node alpha = dal__neg(graph, dal__div(graph, power(e), divisor));
    for (int i = 0; i < n; i++) {
        dal__node along_free = dal__sub(graph, v[i], dal__dot(graph, m, e->U + i * m, beta));
        extended[i] = dal__add(graph, e->F[i], dal__mul(graph, alpha, along_free));
    }
    e->extended = extended;
    return graph->status;
}

dal_status dal__conserved(dal_model *model)
{
    dal__equations *e = &model->equations;
    e->normal = e->extended = NULL;
    if (!(e->properties & (DAL_E_EXACT | DAL_E_WEAK)) || e->vakonomic) return DAL_OK;
    DAL_TRY(find_normal(model));
    return e->properties & DAL_E_WEAK ? extend(model) : DAL_OK;
}
