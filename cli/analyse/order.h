/* order.h - the error of many methods against step, or tolerance, and against work. */
#ifndef DAL_CLI_ORDER_H
#define DAL_CLI_ORDER_H

#include "run/request.h"

#include <stdbool.h>

/* The options of a run that it does not take. */
#define ORDER_WITHOUT (REQUEST_ROW_OPTIONS | REQUEST_OPTION(steps) | REQUEST_OPTION(integrator))

typedef struct order_settings {
    run_request request;
    const char *integrators, *steps; /* lists between commas; steps NULL: step and level_count */
    const char *tolerances;          /* a list; NULL: none, else the step stays the same */
    const char *output;
    long long level_count, threads;
    bool json;       /* to stdout, instead of a table */
    bool force;      /* into any directory */
    bool is_written; /* set when output has the table */
} order_settings;

/* Prints a table or JSON, writes CSV.  Returns CLI_DONE or prints and returns an exit
 * status. */
int order_measure(order_settings *settings);

#endif
