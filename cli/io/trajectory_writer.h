/* trajectory_writer.h - a table of doubles on its way to a file: CSV with 17 digits, or .npy. */
#ifndef DAL_CLI_TRAJECTORY_WRITER_H
#define DAL_CLI_TRAJECTORY_WRITER_H

#include "npy.h"

#include <stdint.h>
#include <stdio.h>

/* A check sum of rows in their order: see trajectory_writer.c. */
enum { ROW_SUM_LANES = 4 };
typedef struct row_sum {
    uint64_t lane[ROW_SUM_LANES];
} row_sum;

typedef struct trajectory_writer {
    const char *path; /* the caller's */
    int columns, failed;
    FILE *file; /* of CSV; NULL for .npy, of which the rest is */
    int descriptor;
    npy_header header;
    unsigned char *buffer;       /* [capacity * columns] numbers */
    long long capacity, pending; /* rows in it */
    long long rows;              /* in the file; -1: it is only looked at so far */
    row_sum sum;                 /* of those */
} trajectory_writer;

/* Makes the file, "-" being stdout, and writes the names of the columns; a path ending in .npy
 * holds a structured array of them.  All functions return CLI_DONE or print and return CLI_IO. */
int writer_create(trajectory_writer *writer, const char *path, char *const *names, int columns);
/* Takes over the descriptor of a .npy file that may hold rows already, or nothing. */
void writer_attach(trajectory_writer *writer, const char *path, int descriptor, char *const *names,
                   int columns);
/* Whether such a file holds these columns and begins with so many rows of that sum: CLI_USAGE and
 * a message when not. */
int writer_verify(const trajectory_writer *writer, long long rows, const row_sum *sum);
/* Goes on behind the first rows of it, of that sum; the rest is cut off. */
int writer_continue(trajectory_writer *writer, long long rows, const row_sum *sum);
int writer_append(trajectory_writer *writer, const double *values);
/* Writes all rows so far and then their number; with sync the rows are on the disk before. */
int writer_sync(trajectory_writer *writer, int sync);
/* The file tells of all rows that are in it whole, also after a failure. */
int writer_close(trajectory_writer *writer);

#endif
