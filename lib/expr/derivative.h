/* derivative.h - exact derivatives of a graph, as further nodes of it. */
#ifndef DAL_EXPR_DERIVATIVE_H
#define DAL_EXPR_DERIVATIVE_H

#include "expr/graph.h"

/* The derivatives of f by each symbol (reverse mode, one sweep), out[count]; and along a direction:
 * sum_i df/dsymbol_i * seed_i (forward mode). */
void dal__gradient(dal__graph *graph, dal__node f, const int *symbols, int count, dal__node *out);
dal__node dal__tangent(dal__graph *graph, dal__node f, const int *symbols, int count,
                       const dal__node *seeds);

#endif
