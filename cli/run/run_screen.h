/* run_screen.h - the result of a run on a terminal. */
#ifndef DAL_CLI_RUN_SCREEN_H
#define DAL_CLI_RUN_SCREEN_H

#include "recorder.h"
#include "ui/screen.h"

#include <stdio.h>

/* Prints what was run, the state at the end, a line for each quantity, and what to try next.
 * output: where the rows are; NULL: nowhere. */
void run_screen_print(FILE *to, const run_recorder *recorder, const char *output,
                      screen_format format);

#endif
