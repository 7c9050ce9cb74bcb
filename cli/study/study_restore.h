/* study_restore.h - the results of a study, from its tables. */
#ifndef DAL_CLI_STUDY_RESTORE_H
#define DAL_CLI_STUDY_RESTORE_H

#include "io/csv_table.h"
#include "study_data.h"

/* Gives the cells of a plan, which have no results yet, the states in cells.csv and the trends of
 * D, E and the error in quantities.csv.  Both tables have their rows in the order of the cells;
 * cells without a row stay as they are. */
void study_restore(study_plan *plan, const csv_table *cells, const csv_table *quantities);

#endif
