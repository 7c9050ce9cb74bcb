/* steer_page.h - the page of a search between two states. */
#ifndef DAL_CLI_STEER_PAGE_H
#define DAL_CLI_STEER_PAGE_H

#include "report/report_page.h"

/* Writes the page of a directory with steer.json: what was found, the inputs, and the run of the
 * cheapest motion.  Returns CLI_DONE, or prints and returns an exit status. */
int steer_write_page(report *r);

#endif
