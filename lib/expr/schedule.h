/* schedule.h - from nodes to the instructions of a program, for lib/expr alone. */
#ifndef DAL_EXPR_SCHEDULE_H
#define DAL_EXPR_SCHEDULE_H

#include "core/error.h"
#include "expr/graph.h"
#include "expr/tape.h"

/* Arrays are indexed by node, [last_node + 1]. */
typedef struct dal__schedule {
    const dal__graph *graph;
    dal__node last_node;
    bool *constant;     /* depends on parameters alone */
    uint8_t *reached;   /* needed by any program; then, by the present one */
    uint32_t *place;    /* in work; DAL__NOWHERE while a temporary is not alive */
    dal__node *last;    /* the node whose instruction reads this one last */
    uint32_t *free;     /* places of temporaries to be used again, as a stack */
    size_t frees, used; /* temporaries: on that stack, and taken in all */
} dal__schedule;

#define DAL__NOWHERE UINT32_MAX

/* Starts from the outputs of all programs of tapes.  To be freed also when it failed. [alloc] */
dal_status dal__schedule_create(dal__schedule *schedule, const dal__tapes *tapes);
void dal__schedule_free(dal__schedule *schedule);
/* The program of what is constant along a run, whose places are set. [alloc] */
dal_status dal__schedule_hoisted(dal__schedule *schedule, dal__tapes *tapes);
/* Schedules one program: temporaries occupy places until their last use; the workspace grows to
 * hold them. [alloc] */
dal_status dal__schedule_tape(dal__schedule *schedule, dal__tapes *tapes, dal__tape *tape);

#endif
