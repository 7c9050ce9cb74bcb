/* vakonomic.c - L and the momenta of vakonomic motion.
 *
 * The extremals of S = int L dt with D = 0 and q given at the ends are the motions of (q, v, g)
 * (model/derive.c) from a start with D = 0.  Where a coordinate is free at an end, its momentum
 *
 *     p = L_v - g.A
 *
 * is 0 there.  S is found by Gauss's formula with 5 nodes in each step, of order 10. */
#include "steer/vakonomic.h"
#include "core/error.h"
#include "model/model.h"
#include <stdlib.h>
#include <string.h>

enum { NODES = 5 };
/* Roots of the Legendre polynomial of degree 5, and their weights (Abramowitz and Stegun 25.4). */
static const double root[NODES] = {-0.90617984593866399280, -0.53846931010568309104, 0.0,
                                   0.53846931010568309104, 0.90617984593866399280};
static const double weight[NODES] = {0.23692688505618908751, 0.47862867049936646804, 128.0 / 225.0,
                                     0.47862867049936646804, 0.23692688505618908751};

dal_status dal__vakonomic_open(dal__problem *p)
{
    dal__equations *e = &p->model->equations;
    const int n = p->n, m = p->multipliers, count = p->unknowns;
    if (m == 0) return DAL_STATUS_OK;
    p->momentum = calloc((size_t)n * (size_t)(count + 1), sizeof *p->momentum);
    if (!p->momentum) return DAL_STATUS_MEMORY;
    memcpy(p->momentum, e->momentum, (size_t)n * sizeof *p->momentum);
    for (int i = 0; i < n; i++) {
        int *row = p->momentum + n + i * count;
        dal__gradient(e->graph, e->momentum[i], e->symbol + e->q, n, row);
        dal__gradient(e->graph, e->momentum[i], e->symbol + e->v, n, row + n);
        dal__gradient(e->graph, e->momentum[i], e->symbol + e->g, m, row + 2 * n);
    }
    return dal__check_size(e->graph->status, p->error);
}

void dal__vakonomic_close(dal__problem *p) { free(p->momentum); }

/* Values of nodes of t, q, v, g. */
static dal_status evaluate_at(dal__problem *p, const int *node, int count, double t,
                              const double *z, double *out)
{
    memcpy(p->value + p->model->equations.g, z + 2 * p->n, (size_t)p->multipliers * sizeof *z);
    return dal__problem_evaluate(p, node, count, t, z, out);
}

dal_status dal__vakonomic_momenta(dal__problem *p, double t, const double *z, double *out)
{
    DAL_TRY(evaluate_at(p, p->momentum, p->n, t, z, out));
    for (int i = 0; i < p->n; i++) out[i] *= p->unit[i];
    return DAL_STATUS_OK;
}

dal_status dal__vakonomic_gradients(dal__problem *p, double t, const double *z, double *out)
{
    const int d = p->unknowns;
    DAL_TRY(evaluate_at(p, p->momentum + p->n, p->n * d, t, z, out));
    for (int i = 0; i < p->n * d; i++) out[i] *= p->unit[i / d] * p->unit[i % d];
    return DAL_STATUS_OK;
}

/* L at a state within a step. */
typedef struct sample {
    dal__problem *problem;
    double L;
} sample;

static dal_status read_lagrangian(void *user, dal_run *run)
{
    sample *s = user;
    const int node = s->problem->model->equations.lagrangian;
    return evaluate_at(s->problem, &node, 1, dal_run_time(run), dal_run_state(run), &s->L);
}

dal_status dal__vakonomic_add_action(dal__problem *p, double *sum)
{
    sample s = {.problem = p};
    for (int k = 0; k < NODES; k++) {
        DAL_TRY(dal_run_intermediate(p->run, p->h * (1.0 + root[k]) / 2.0, read_lagrangian, &s,
                                     p->error));
        *sum += p->h / 2.0 * weight[k] * s.L;
    }
    return DAL_STATUS_OK;
}
