/* study_screen.h - the results of a study on one screen. */
#ifndef DAL_CLI_STUDY_SCREEN_H
#define DAL_CLI_STUDY_SCREEN_H

#include "study_data.h"

#include <stdbool.h>
#include <stdio.h>

/* At most 39 lines of 80 columns: what stays and what drifts, under representative integrators and
 * under all.  tables is the file with all tables; NULL: there is none yet. */
void study_print_screen(FILE *out, const study_plan *plan, const char *tables, bool in_colour);

#endif
