/* summary.h - size and trend of each observable over a run. */
#ifndef DAL_CLI_SUMMARY_H
#define DAL_CLI_SUMMARY_H

#include "recorder.h"

#include <stdio.h>

void summary_print(FILE *out, const run_simulation *simulation, const run_results *results);
/* For each line the rates that it may have in a longer run, if it bends on as it does in this. */
void summary_print_details(FILE *out, const run_results *results);

#endif
