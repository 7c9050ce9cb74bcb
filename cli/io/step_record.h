/* step_record.h - what is kept of the observed steps of a run, however many there are: the range
 * of each coordinate in up to RECORD_BLOCKS blocks of equally many steps, and the last steps.
 *
 * All of it is one array of numbers, which a checkpoint saves:
 *
 *     number    steps | steps of a block | blocks | the last steps
 *     block     [coordinates] lowest | [coordinates] highest | t of its first step
 *     steps     [columns][RECORD_STEPS] t, state, observables; step k is at k mod RECORD_STEPS */
#ifndef DAL_CLI_STEP_RECORD_H
#define DAL_CLI_STEP_RECORD_H

#include <stdbool.h>
#include <stddef.h>

enum { RECORD_BLOCKS = 128, RECORD_STEPS = 512 };

typedef struct step_record {
    int coordinates; /* the first columns after t */
    int state;       /* columns after t that are the state; */
    int observables; /* and those after them */
    size_t count;    /* numbers of the array, */
    double *number;  /* [count]; NULL: nothing is kept */
} step_record;

/* A block of steps. */
typedef struct step_block {
    double from;              /* t of its first step */
    const double *low, *high; /* [coordinates]; an infinite range: no value was finite */
} step_block;

/* The record of a run, which keeps nothing until it is allocated; free it.  All below need one that
 * is, except record_add, which adds nothing then. */
step_record record_of(int coordinates, int state, int observables);
void record_allocate(step_record *record);
void record_free(step_record *record);
/* Adds steps: component i of the state at t[k] is states[i * state_stride + k], observable i
 * values[i * stride + k]. */
typedef struct record_steps {
    int count;
    const double *t, *states, *values;
    size_t state_stride, stride;
} record_steps;
void record_add(step_record *record, const record_steps *steps);

/* Whether the array may be a record: its counts agree. */
bool record_is_sound(const step_record *record);
long long record_steps_added(const step_record *record);
int record_blocks(const step_record *record);
step_block record_block(const step_record *record, int block);
/* How many last steps there are; a column of number k of them, from 0. */
int record_last_steps(const step_record *record);
double record_value(const step_record *record, int column, int k);

#endif
