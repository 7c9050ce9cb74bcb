/* study_csv.h - the results of a study as CSV. */
#ifndef DAL_CLI_STUDY_CSV_H
#define DAL_CLI_STUDY_CSV_H

#include "study_plan.h"

/* Writes the results of all cells that have some into a directory:
 *     cells.csv        a row per cell
 *     quantities.csv   a row per cell and observable
 *     series/LABEL.csv the tracks of the cells of a case, window by window
 * Returns CLI_DONE or prints and returns CLI_IO. */
int study_write_csv(const study_plan *plan, const char *directory);

#endif
