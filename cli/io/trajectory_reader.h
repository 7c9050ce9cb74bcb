/* trajectory_reader.h - the rows of a run that lives in a directory, read one by one. */
#ifndef DAL_CLI_TRAJECTORY_READER_H
#define DAL_CLI_TRAJECTORY_READER_H

#include "npy.h"

typedef struct trajectory_reader {
    int columns;
    char **name;     /* [columns] t, the state, the observables */
    long long count; /* all rows */
    double *row;     /* [columns] the present one */
    char *path;
    FILE *file;
    npy_columns npy;
    unsigned char *bytes; /* [8 columns]; NULL: CSV */
    char *line;           /* of CSV */
    size_t capacity;
    long long begin, next; /* where the first row begins; the next one */
} trajectory_reader;

/* Opens DIR/trajectory.npy or, as older versions made it, DIR/rows.csv.  Returns CLI_DONE or prints
 * and returns an exit status, nothing being open then. */
int reader_open(trajectory_reader *reader, const char *directory);
/* 1: the next row is in row; 0: there is no more; -1: reading failed, which was told. */
int reader_next(trajectory_reader *reader);
/* Lets reader_next give row k, from 0; CSV is read from its beginning for it.  As reader_open. */
int reader_seek(trajectory_reader *reader, long long k);
void reader_close(trajectory_reader *reader);

#endif
