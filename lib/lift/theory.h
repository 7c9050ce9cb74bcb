/* theory.h - what Dirac's procedure begins with: variables, a Hamiltonian, primary constraints. */
#ifndef DAL_LIFT_THEORY_H
#define DAL_LIFT_THEORY_H

#include "core/pool.h"
#include "dalembert_dirac.h"
#include "model/model.h"

enum { DAL__GENERATOR_ORDERS = 4 /* of alpha, alpha', .. in a gauge generator */ };

/* H_0 and the primary constraints of a singular Lagrangian, on 2*pairs variables (X, P) with
 * {X_i, P_i} = 1, as nodes.  Symbols below parameters are parameters. */
typedef struct dal__theory {
    dal__graph *graph;
    int parameters, symbols;
    int pairs;
    int *variable;      /* [2*pairs] symbols of X, then of P */
    int t, alpha, mu;   /* symbols: time; alpha and its derivatives; multipliers of the primaries */
    int observables;    /* the first of X whose Dirac brackets are of interest */
    dal__node H, shown; /* without its multipliers; and as it is written, with F_x */
    int primaries;
    dal__node *primary;         /* [primaries] */
    double *centre, *reach;     /* [symbols] values of parameters; about where points are drawn */
    const char **text, **latex; /* [symbols] names */
    const char *const *table;   /* names of tables */
} dal__theory;

/* The theory of the first-order action of a model whose system is made: of (nh11) with the effort
 * of the model, or of vakonomic motion.  Parameters and start as of spec, for the points. [alloc]
 * Errors: errors of the start; DAL_STATUS_UNSUPPORTED (vakonomic motion with forces). */
dal_status dal__theory_create(dal__theory *theory, dal_model *model, const dal_run_spec *spec,
                              dal__pool *pool, dal_error *error);
/* Memory for the symbols and variables of a theory whose counts are set; pool->out_of_memory, and
 * the status of the graph, are for dal__dirac_run. */
void dal__theory_allocate(dal__theory *theory, dal__pool *pool);

/* Whether memory ran out or the graph is full: what is made from then on is of no use. */
static inline bool dal__theory_is_lost(const dal__theory *theory, const dal__pool *pool)
{
    return pool->out_of_memory || theory->graph->status != DAL_STATUS_OK;
}

/* Nodes that a pool owns, each the number 0; NULL: out of memory. */
static inline dal__node *dal__pool_nodes(dal__pool *pool, dal__graph *graph, size_t count)
{
    dal__node *list = dal__pool_allocate(pool, count + 1, sizeof *list);
    const dal__node zero = dal__number(graph, 0.0);
    for (size_t i = 0; list && i < count; i++) list[i] = zero;
    return list;
}

#endif
