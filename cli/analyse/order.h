/* order.h - the error of many methods against step and against work. */
#ifndef DAL_CLI_ORDER_H
#define DAL_CLI_ORDER_H

#include "run/request.h"

typedef struct order_settings {
    run_request request;
    const char *integrators, *steps; /* lists between commas; steps NULL: step and level_count */
    const char *output;
    long long level_count, threads;
} order_settings;

/* Prints a table, writes CSV and diagrams.  Returns CLI_DONE or prints and returns an exit
 * status. */
int order_measure(order_settings *settings);

#endif
