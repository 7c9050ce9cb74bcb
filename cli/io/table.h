/* table.h - a table of doubles on its way to a file: CSV with 17 digits, or .npy. */
#ifndef DAL_CLI_TABLE_H
#define DAL_CLI_TABLE_H

#include "npy.h"
#include "ui/cli.h"

#include <stdint.h>

/* A check sum of rows in their order: see table.c. */
enum { TABLE_LANES = 4 };
typedef struct table_sum {
    uint64_t lane[TABLE_LANES];
} table_sum;

typedef struct cli_table {
    const char *path; /* the caller's */
    int columns, broken;
    FILE *file; /* of CSV; NULL for .npy, of which the rest is */
    int descriptor;
    npy_header header;
    unsigned char *buffer;   /* [room * columns] numbers */
    long long room, waiting; /* rows in it */
    long long rows;          /* in the file; -1: it is only looked at so far */
    table_sum sum;           /* of those */
} cli_table;

/* Makes the file, "-" being stdout, and writes the names of the columns; a path ending in .npy
 * holds a structured array of them.  All functions return CLI_DONE or print and return CLI_IO. */
int table_create(cli_table *table, const char *path, char *const *names, int columns);
/* Takes over the descriptor of a .npy file that may hold rows already, or nothing. */
void table_adopt(cli_table *table, const char *path, int descriptor, char *const *names,
                 int columns);
/* Whether such a file holds these columns and begins with so many rows of that sum: CLI_USAGE and
 * a message when not. */
int table_holds(const cli_table *table, long long rows, const table_sum *sum);
/* Goes on behind the first rows of it, of that sum; the rest is cut off. */
int table_go_on(cli_table *table, long long rows, const table_sum *sum);
int table_row(cli_table *table, const double *values);
/* Writes all rows so far and then their number; with settle the rows are on the disk before. */
int table_settle(cli_table *table, int settle);
/* The file tells of all rows that are in it whole, also after a failure. */
int table_close(cli_table *table);

#endif
