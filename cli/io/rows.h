/* rows.h - the rows of a run that lives in a directory, read one by one. */
#ifndef DAL_CLI_ROWS_H
#define DAL_CLI_ROWS_H

#include "npy.h"

typedef struct cli_rows {
    int columns;
    char **name;     /* [columns] t, the state, the observables */
    long long count; /* all rows */
    double *row;     /* [columns] the present one */
    char *path;
    FILE *file;
    npy_columns npy;
    unsigned char *bytes; /* [8 columns]; NULL: CSV */
    char *line;           /* of CSV */
    size_t room;
    long long begin, next; /* where the first row begins; the next one */
} cli_rows;

/* Opens DIR/trajectory.npy or, as older versions made it, DIR/rows.csv.  Returns CLI_DONE or prints
 * and returns an exit status, nothing being open then. */
int rows_open(cli_rows *rows, const char *directory);
/* 1: the next row is in row; 0: there is no more; -1: reading failed, which was told. */
int rows_next(cli_rows *rows);
/* Lets rows_next give row k, from 0; CSV is read from its beginning for it.  As rows_open. */
int rows_seek(cli_rows *rows, long long k);
void rows_close(cli_rows *rows);

#endif
