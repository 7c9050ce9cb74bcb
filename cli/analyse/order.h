/* order.h - the error of many methods against step, or tolerance, and against work. */
#ifndef DAL_CLI_ORDER_H
#define DAL_CLI_ORDER_H

#include "order_study.h"

/* The options of a run that it does not take. */
#define ORDER_WITHOUT (REQUEST_ROW_OPTIONS | REQUEST_OPTION(steps) | REQUEST_OPTION(integrator))

/* Prints a table or JSON, writes CSV.  Returns CLI_DONE or prints and returns an exit
 * status. */
int order_measure(order_settings *settings);

#endif
