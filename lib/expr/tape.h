/* tape.h - the inside of tapes, for lib/expr alone.
 *
 *     work = [ parameters | numbers | hoisted | inputs | temporaries ]
 *
 * An instruction is an operation, where it writes and where it reads, as places in work.  Beside
 * the operations of the graph a tape has a few that do two of them at once (graph.h). */
#ifndef DAL_FORMULA_TAPE_H
#define DAL_FORMULA_TAPE_H

#include "expr/formula.h"

typedef struct dal__instruction {
    uint32_t op, d, a, b, c;
} dal__instruction;

/* One program. */
typedef struct dal__tape {
    dal__node *output; /* [outputs] */
    uint32_t *place;   /* [outputs] where they are when it has run */
    int outputs;
    dal__instruction *code; /* [length] */
    int length;
} dal__tape;

struct dal__tapes {
    const dal__graph *graph;
    int parameters, inputs;
    dal__tape *tape; /* [count] */
    int count, capacity;
    dal__tape hoisted; /* computes what is constant along a run */
    double *number;    /* [numbers] */
    int numbers;
    size_t first_input, temporaries, workspace; /* places */
};

#endif
