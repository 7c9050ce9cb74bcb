/* trajectory_reader.h - the rows in the directory of a run, read one by one. */
#ifndef DAL_CLI_TRAJECTORY_READER_H
#define DAL_CLI_TRAJECTORY_READER_H

#include "npy.h"

#include <stdio.h>

typedef struct trajectory_reader {
    int columns;
    char **name;     /* [columns] t, the state, the observables */
    long long count; /* all rows */
    double *row;     /* [columns] the present row */
    char *path;
    FILE *file;
    npy_columns npy;
    unsigned char *bytes; /* [8 columns] */
    long long next;       /* number of the next row */
} trajectory_reader;

/* Opens DIR/trajectory.npy.  Returns CLI_DONE, or prints and returns an exit status and leaves
 * nothing open. */
int reader_open(trajectory_reader *reader, const char *directory);
/* Returns 1 with the next row in row, 0 after the last row, -1 after a failure and its message. */
int reader_next(trajectory_reader *reader);
/* Makes row k, from 0, the next one.  Returns as reader_open. */
int reader_seek(trajectory_reader *reader, long long k);
void reader_close(trajectory_reader *reader);

#endif
