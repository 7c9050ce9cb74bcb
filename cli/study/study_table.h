/* study_table.h - the results of a study, in tables for readers and as CSV. */
#ifndef DAL_CLI_STUDY_TABLE_H
#define DAL_CLI_STUDY_TABLE_H

#include "study_data.h"

#include <stdio.h>

/* The tables of one case, and the note under all of them. */
void study_print_case(FILE *out, const study_plan *plan, const study_case *item);
void study_print_note(FILE *out, const study_plan *plan);

/* Writes the results of all cells that have some into a directory:
 *     cells.csv        a row per cell
 *     quantities.csv   a row per cell and observable
 *     series/LABEL.csv the tracks of the cells of a case, window by window
 * Returns CLI_DONE or prints and returns CLI_IO. */
int study_write_csv(const study_plan *plan, const char *directory);

#endif
