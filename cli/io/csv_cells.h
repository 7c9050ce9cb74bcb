/* csv_cells.h - the numbers and texts that are written into CSV files. */
#ifndef DAL_CLI_CSV_CELLS_H
#define DAL_CLI_CSV_CELLS_H

#include <stdio.h>

/* Writes x with 17 digits, as a double reads it back; minus zero as 0. */
void csv_put(FILE *out, double x);
/* The same, and nothing where x is NaN: a cell of a CSV file is empty where there is no value. */
void csv_put_known(FILE *out, double x);
/* Writes a cell of a CSV file; one with a comma or a quote in it is quoted, as RFC 4180 has it.
 * Control characters become blanks, so that a row is a line. */
void csv_put_text(FILE *out, const char *text);
/* Writes cells, each after a comma; those that are not a number stay empty. */
void csv_put_cells(FILE *out, const double *numbers, int count);

#endif
