/* report_run.h - the page of a run. */
#ifndef DAL_CLI_REPORT_RUN_H
#define DAL_CLI_REPORT_RUN_H

#include "report_page.h"

/* Returns CLI_DONE or prints and returns an exit status. */
int report_run(report *r);

#endif
