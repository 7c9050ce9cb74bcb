/* tape.h - the programs of one system, over one block of numbers:
 *
 *     work = [ parameters | numbers | hoisted | inputs | held | temporaries ]
 *
 * Symbols 0..parameters-1 are parameters, the next inputs symbols are inputs.  Nodes that depend on
 * parameters alone are hoisted: computed by dal__tapes_prepare_x1, not by each run of a program.
 * An instruction is an operation, where it writes and where it reads, as places in work; beside the
 * operations of the graph there are a few that do two of them at once (operations.h).  A program's
 * arithmetic for a node is the same in every program and at every width: same bits.
 *
 * Nodes that switch from one formula to another may be held: some programs have a second list of
 * instructions, in which a switching node decides at a point that was given instead of at its own
 * argument, while the rest is as it was, so that both lists have the same bits where they decide
 * alike.  The second list is executed while the first of the numbers `held`, is_held, is not 0:
 *
 *     held = [ is_held | p, sign p, -sign p, p < 0, p > 0 of each point p ] */
#ifndef DAL_EXPR_TAPE_H
#define DAL_EXPR_TAPE_H

#include "core/machine.h"
#include "expr/graph.h"

typedef struct dal__instruction {
    uint32_t op, d, a, b, c; /* b of a TABLE: its symbol */
} dal__instruction;

/* One program. */
typedef struct dal__tape {
    dal__node *output; /* [outputs] */
    uint32_t *place;   /* [outputs] where they are when it has run */
    int outputs;
    dal__instruction *code; /* [length] */
    dal__instruction *held; /* [length] the same with the switching nodes held; NULL: none */
    int length;
    bool may_hold; /* whether it is to have `held` */
} dal__tape;

/* The point of a node that switches: its number from 1, negative where the node has minus the
 * argument of the point; 0: the node does not switch. */
typedef int dal__held_point;
enum { DAL__HELD_NUMBERS = 5 /* of a point */ };

typedef struct dal__tapes {
    const dal__graph *graph;
    const struct dal__tape_table *tables; /* [table_count] the graph's */
    int table_count;
    int parameters, inputs;
    int points;                   /* at which nodes may be held */
    const dal__held_point *point; /* [graph->count + 1] while the tapes are finished */
    dal__tape *tape;              /* [count] */
    int count, capacity;
    dal__tape hoisted; /* computes what is constant along a run */
    double *number;    /* [numbers] */
    int numbers;
    size_t first_input, held, temporaries, workspace; /* places; workspace: the size of work */
} dal__tapes;

/* A set without programs, of a graph that must outlive dal__tapes_finish; NULL: out of memory.
 * [alloc] */
dal__tapes *dal__tapes_create(const dal__graph *graph, int parameters, int inputs);
/* Frees a set and its programs; NULL is allowed. */
void dal__tapes_free(dal__tapes *tapes);
/* Adds a program with these outputs and returns its number, from 0 (-1: out of memory). */
int dal__tapes_add(dal__tapes *tapes, const dal__node *outputs, int count);
/* Completes the set; afterwards it is constant and needs the graph no more.  Errors:
 * DAL_STATUS_MEMORY, DAL_STATUS_TOO_LARGE, DAL_STATUS_ARGUMENT (an output is no node, or has a
 * symbol that is neither). */
dal_status dal__tapes_finish(dal__tapes *tapes);

/* Lets program number i have held nodes. */
void dal__tapes_let_hold(dal__tapes *tapes, int i);

/* Arithmetic operations of a program; an elementary function counts as several. */
int dal__tape_operations(const dal__tape *tape);

/* After the parameters in work have been set: one lane (a batch copies the result to all), and one
 * of quad precision. */
void dal__tapes_prepare_x1(const dal__tapes *tapes, double *work);
void dal__tapes_prepare_x1_QUAD(const dal__tapes *tapes, double *work);
/* Holds nodes at points from the next program on; NULL: no longer, as after preparing. */
void dal__tapes_hold_x1(const dal__tapes *tapes, const double *point, double *work);
void dal__tapes_hold_x1_QUAD(const dal__tapes *tapes, const double *point, double *work);
/* Runs a program on the inputs in work; reads count of its outputs from number `first` on, where it
 * was the last program that ran; both, with all outputs.  work and out are interleaved by lanes and
 * aligned to them. */
#define DAL__TAPE_EXECUTE(name, variant, lanes, set)                                               \
    void name##_##variant(const dal__tapes *tapes, int program, double *work);
#define DAL__TAPE_READ(name, variant, lanes, set)                                                  \
    void name##_##variant(const dal__tapes *tapes, int program, int first, int count,              \
                          const double *work, double *out);
#define DAL__TAPE_RUN(name, variant, lanes, set)                                                   \
    void name##_##variant(const dal__tapes *tapes, int program, double *work, double *out);
DAL__TAPE_EXECUTE(dal__tape_execute, x1, 1, BASE)
DAL__VARIANT_LIST(DAL__TAPE_EXECUTE, dal__tape_execute)
DAL__TAPE_READ(dal__tape_read, x1, 1, BASE)
DAL__VARIANT_LIST(DAL__TAPE_READ, dal__tape_read)
DAL__TAPE_RUN(dal__tape_run, x1, 1, BASE)
DAL__VARIANT_LIST(DAL__TAPE_RUN, dal__tape_run)

#endif
