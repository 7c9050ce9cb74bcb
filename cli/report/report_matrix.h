/* report_matrix.h - the tables of sizes and trends on the page of a study. */
#ifndef DAL_CLI_REPORT_MATRIX_H
#define DAL_CLI_REPORT_MATRIX_H

#include "report_cells.h"

/* A table for each quantity that has one. */
void report_matrices(const study_page *s);

#endif
