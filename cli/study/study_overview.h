/* study_overview.h - the results of a study on a terminal. */
#ifndef DAL_CLI_STUDY_OVERVIEW_H
#define DAL_CLI_STUDY_OVERVIEW_H

#include "study_plan.h"

#include <stdio.h>

/* Prints at most 23 lines, one more being for the place of the page: D and E under representative
 * integrators, which integrators keep them, and what to try next.  tables is the file with all
 * tables; NULL: there is none yet.  Returns CLI_DONE, or prints and returns CLI_IO. */
int study_print_overview(FILE *to, const study_plan *plan, const char *tables,
                         screen_format format);

#endif
