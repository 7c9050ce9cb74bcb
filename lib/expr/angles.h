/* angles.h - sines and cosines of sums. */
#ifndef DAL_EXPR_ANGLES_H
#define DAL_EXPR_ANGLES_H

#include "expr/graph.h"

/* Replaces in these nodes the sines and cosines of sums by sines and cosines of the terms, where
 * all together then cost less. */
void dal__expand_angles(dal__graph *graph, dal__node *nodes, int count);

#endif
