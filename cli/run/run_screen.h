/* run_screen.h - the result of a run on a terminal. */
#ifndef DAL_CLI_RUN_SCREEN_H
#define DAL_CLI_RUN_SCREEN_H

#include "recorder.h"
#include "ui/screen.h"

#include <stdio.h>

/* The quantities of a run, and how much of them is shown. */
typedef struct run_quantities {
    const dal_trend *trend;
    const char *const *names;
    int count;
    int max_rows, columns; /* of a table, and of the names in it */
} run_quantities;

/* Adds to a table of three columns the names, the word and the text of each verdict, quantities
 * alike in one row, what is exact in the end.  Returns the first quantity that moves; -1: none;
 * *left_out: how many rows more there are. */
int run_add_verdicts(screen_table *table, const run_quantities *quantities, int *left_out);

/* Prints what was run, the state at the end, a line for each quantity, and what to try next.
 * output: where the rows are; NULL: nowhere.  Returns an exit status. */
int run_screen_print(FILE *to, const run_recorder *recorder, const char *output,
                     screen_format format);

#endif
