/* simplify.h - operations on nodes, in canonical form (graph.h).
 *
 * They simplify as for real numbers: on the domain of a formula they change no value but by
 * rounding; 0*x becomes 0 and x/x becomes 1 everywhere.  If an operand is 0, no node, so is the
 * result. */
#ifndef DAL_EXPR_SIMPLIFY_H
#define DAL_EXPR_SIMPLIFY_H

#include "expr/graph.h"

dal__node dal__apply(dal__graph *graph, dal__op op, dal__node a, dal__node b); /* b: 0 if unary */
dal__node dal__node_add(dal__graph *graph, dal__node a, dal__node b);
dal__node dal__node_sub(dal__graph *graph, dal__node a, dal__node b);
dal__node dal__node_mul(dal__graph *graph, dal__node a, dal__node b);
dal__node dal__node_div(dal__graph *graph, dal__node a, dal__node b);
/* b where a is not 0, else c. */
dal__node dal__node_if(dal__graph *graph, dal__node a, dal__node b, dal__node c);
/* A derivative of a table, by the number that is its symbol. */
dal__node dal__node_table(dal__graph *graph, int symbol, dal__node a);
dal__node dal__node_neg(dal__graph *graph, dal__node a);
/* sum_i a[i] b[i] of count nodes. */
dal__node dal__dot(dal__graph *graph, int count, const dal__node *a, const dal__node *b);
/* sum + sum_i a[i*a_stride] b[i*b_stride] of count nodes: rows or columns of matrices. */
dal__node dal__add_strided_dot(dal__graph *graph, dal__node sum, int count, const dal__node *a,
                               int a_stride, const dal__node *b, int b_stride);
/* *sum += a b, which changes nothing where one of them is 0. */
void dal__add_product(dal__graph *graph, dal__node *sum, dal__node a, dal__node b);

#endif
