/* row_times.h - when the rows of a run are taken. */
#ifndef DAL_CLI_ROW_TIMES_H
#define DAL_CLI_ROW_TIMES_H

#include "request_data.h"
#include "ui/options.h"

/* Times that are not equally distant are kept in memory. */
enum { ROW_TIMES_MAX = 100000000, STEP_ERROR_SIZE = 128 };

/* T0 + N h, the numbers being decimals: 0.3 for 3 steps of 0.1. */
double step_end(double from, double step, long long steps);
/* The time of a row of a simulation that is filled. */
double row_times_get(const run_simulation *simulation, long long row);

/* All below, except step_error, return CLI_DONE, or print and return CLI_USAGE or CLI_IO. */

/* Why the time between two cannot be divided into such steps: there is none in it, or more than a
 * double counts; NULL where it can. */
const char *step_error(double step, double from, double end, char text[STEP_ERROR_SIZE]);
/* Checks --step of a request by it. */
int row_times_check_step(const run_request *request, double from, double end);
/* Parses the value of --times, a list or a file with one, for a request. */
int row_times_parse(void *request, const cli_option *option, const char *given);
/* Fills the end and the rows of a simulation whose request has all its options, and checks the
 * step. */
int row_times_fill(run_simulation *simulation);

#endif
