/* held.h - the branches of F, which a step of a run with events may hold. */
#ifndef DAL_MODEL_HELD_H
#define DAL_MODEL_HELD_H

#include "model/programs.h"

/* What decides the branch of a node: a of abs(a), sign(a), floor(a) and a table, a - b of a < b,
 * a <= b, min(a, b) and max(a, b); 0 where the node does not switch along a run. [alloc] */
dal__node dal__switch_argument(dal__graph *graph, dal__node node);

/* Adds the programs of the branches of F, and lets the programs of a step hold them; after all
 * other nodes are made.  Nothing without branches. */
void dal__programs_add_branches(dal_model *model, dal__programs *programs);

#endif
