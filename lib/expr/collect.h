/* collect.h - sums of products, written with few operations. */
#ifndef DAL_EXPR_COLLECT_H
#define DAL_EXPR_COLLECT_H

#include "expr/graph.h"

/* A node of the same value: expanded into a sum of products, simplified by
 * f sin(u)^2 + f cos(u)^2 = f and f - f = 0, and written with common factors outside.  The node
 * itself where that needs as many operations, or the sum has too many terms. */
dal__node dal__collect(dal__graph *graph, dal__node node);

/* How many operations it takes to compute these nodes, once what is constant along a run is
 * known; a division or root counts 4, another function 15.  INT_MAX: out of memory. */
int dal__cost(dal__graph *graph, const dal__node *nodes, int count);

#endif
