/* report_matrix.h - the tables on the page of a study. */
#ifndef DAL_CLI_REPORT_MATRIX_H
#define DAL_CLI_REPORT_MATRIX_H

#include "report_cells.h"

/* A table for each quantity that has one. */
void report_matrices(const study_page *s);
/* Predicted sizes beside measured ones, where the study predicts: a figure and a table.  Returns
 * CLI_DONE, or prints and returns an exit status. */
int report_predicted(const study_page *s);

#endif
