/* traversal.h - passes over a graph: dependence, values, substitution. */
#ifndef DAL_EXPR_TRAVERSAL_H
#define DAL_EXPR_TRAVERSAL_H

#include "expr/operations.h"

/* The largest of some nodes; 0 of none. */
dal__node dal__last_of(const dal__node *nodes, int count);
/* Marks node and all nodes it depends on, [node + 1]; NULL, and the status of the graph is
 * DAL_STATUS_MEMORY, when memory is out. [alloc] */
uint8_t *dal__reach(dal__graph *graph, dal__node node);
/* The same of several nodes, up to the last of them. [alloc] */
uint8_t *dal__reach_all(dal__graph *graph, const dal__node *nodes, int count);
/* The last marked node up to i, the first from i to last; 0 where there is none.  Most nodes of a
 * large graph are not reached from one of them. */
dal__node dal__last_marked(const uint8_t *mark, dal__node i);
dal__node dal__first_marked(const uint8_t *mark, dal__node i, dal__node last);
/* Whether node depends on a symbol with first <= symbol < end; true when memory is out, as
 * above. */
bool dal__depends(dal__graph *graph, dal__node node, int first, int end);

/* Whether node reaches an operation of a set, a bit (1 << op) each, that is not fixed; true when
 * memory is out, as above. */
bool dal__reaches(dal__graph *graph, dal__node node, uint64_t operations);
/* Operations whose values jump, and those that have a kink. */
#define DAL__OP_BIT(op) (UINT64_C(1) << DAL__##op)
#define DAL__JUMPING                                                                               \
    (DAL__OP_BIT(SIGN) | DAL__OP_BIT(FLOOR) | DAL__OP_BIT(LESS) | DAL__OP_BIT(LESS_EQUAL) |        \
     DAL__OP_BIT(EQUAL) | DAL__OP_BIT(IF))
#define DAL__KINKED                                                                                \
    (DAL__OP_BIT(ABS) | DAL__OP_BIT(MIN) | DAL__OP_BIT(MAX) | DAL__OP_BIT(HYPOT) |                 \
     DAL__OP_BIT(TABLE))
#define DAL__ROUGH (DAL__JUMPING | DAL__KINKED)

/* A node as it is computed everywhere: an operation of the graph, or a fused one.  What is fused
 * depends on the node alone: in a sum that is not fixed, a product that is not; of two products the
 * one made later, so that the other is computed before it. */
typedef struct dal__lowered {
    int op;
    dal__node a, b, c; /* 0 where there is none */
} dal__lowered;
dal__lowered dal__lower(const dal__graph *graph, dal__node node);

/* The value of a node; values[symbol].  Slow, for single values (pivots, starts); NaN when memory
 * is out, as above. [alloc] */
double dal__evaluate(dal__graph *graph, dal__node node, const double *values);
/* The same of several nodes, out[count], in one sweep.  False: out of memory, as above. [alloc] */
bool dal__evaluate_all(dal__graph *graph, const dal__node *nodes, int count, const double *values,
                       double *out);

/* Node i again, with each operand x replaced by image[x]. */
dal__node dal__rebuild(dal__graph *graph, dal__node i, const dal__node *image);
/* Replaces in these nodes, or in f, each symbols[i] by the node by[i]. */
void dal__substitute_all(dal__graph *graph, int nodes, dal__node *node, const int *symbols,
                         int count, const dal__node *by);
dal__node dal__substitute(dal__graph *graph, dal__node f, const int *symbols, int count,
                          const dal__node *by);

#endif
