/* table.h - a table of doubles on its way to a file: CSV with 17 digits, or .npy. */
#ifndef DAL_CLI_TABLE_H
#define DAL_CLI_TABLE_H

#include "cli.h"

typedef struct cli_table {
    FILE *file;
    const char *path; /* the caller's */
    int npy, columns, broken;
    long long rows, announced; /* written; said by the header of a .npy file */
} cli_table;

/* Makes the file, "-" being stdout, and writes the names of the columns.  A path ending in .npy
 * holds float64 [rows][columns], little-endian; the names then go to PATH.columns.txt, one a line.
 * All functions return CLI_DONE or print and return CLI_IO. */
int table_create(cli_table *table, const char *path, char *const *names, int columns,
                 long long rows);
/* Goes on with a CSV file, given by its descriptor, which becomes the table's, behind its first
 * offset bytes, which hold rows rows; the rest is cut off.  With offset 0 it begins anew.
 * CLI_USAGE when the file is shorter. */
int table_continue(cli_table *table, const char *path, int descriptor, char *const *names,
                   int columns, long long rows, long long offset);
int table_row(cli_table *table, const double *values);
/* Brings all rows so far to the disk: *offset bytes. */
int table_settle(cli_table *table, long long *offset);
/* Also corrects the header of a .npy file that got fewer rows than announced. */
int table_close(cli_table *table);

#endif
