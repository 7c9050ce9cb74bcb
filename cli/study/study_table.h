/* study_table.h - the tables of a study. */
#ifndef DAL_CLI_STUDY_TABLE_H
#define DAL_CLI_STUDY_TABLE_H

#include "study_plan.h"

#include <stdio.h>

/* The tables of one case, and the note under all of them. */
void study_print_case(FILE *out, const study_plan *plan, const study_case *item);
void study_print_note(FILE *out, const study_plan *plan);

#endif
