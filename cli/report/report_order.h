/* report_order.h - the page of the results of `dalembert order`. */
#ifndef DAL_CLI_REPORT_ORDER_H
#define DAL_CLI_REPORT_ORDER_H

#include "report_page.h"

/* Returns CLI_DONE or prints and returns an exit status. */
int report_order(report *r);

#endif
