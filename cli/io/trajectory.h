/* trajectory.h - rows of doubles: written as CSV with 17 digits or as .npy, read from .npy. */
#ifndef DAL_CLI_TRAJECTORY_H
#define DAL_CLI_TRAJECTORY_H

#include "file.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* A check sum of rows in their order: see trajectory.c. */
enum { ROW_SUM_LANES = 4 };
typedef struct row_sum {
    uint64_t lane[ROW_SUM_LANES];
} row_sum;

typedef struct trajectory_writer {
    const char *path; /* the caller's */
    int columns;
    bool failed;
    FILE *file; /* of CSV; NULL for .npy, of which the rest is */
    int descriptor;
    char *header; /* its last 64 bytes have the number of rows; the rows begin after it */
    size_t header_length;
    unsigned char *buffer;       /* [capacity * columns] numbers */
    long long capacity, pending; /* rows in it */
    long long rows;              /* in the file; -1: none is to be written yet */
    row_sum sum;                 /* of those */
} trajectory_writer;

/* The header of a structured array in a .npy file, allocated; shape: "(3,)", "(2, 3)". */
char *npy_make_header(char *const *names, int columns, const char *shape, size_t *size);

/* Creates the file, "-" being stdout, and writes the names of the columns; a path that ends in .npy
 * gets a structured array.  All functions return CLI_DONE, or print and return CLI_IO. */
int writer_create(trajectory_writer *writer, const char *path, char *const *names, int columns);
/* Takes over the descriptor of a .npy file that may hold rows already, or nothing. */
void writer_attach(trajectory_writer *writer, const char *path, int descriptor, char *const *names,
                   int columns);
/* Checks that such a file has these columns and begins with rows of that sum: CLI_USAGE where it
 * does not. */
int writer_verify(const trajectory_writer *writer, long long rows, const row_sum *sum);
/* Continues after the first rows, of that sum, and cuts off the rest. */
int writer_continue(trajectory_writer *writer, long long rows, const row_sum *sum);
int writer_append(trajectory_writer *writer, const double *values);
/* Writes all rows so far and then their number; with sync the rows are on the disk before. */
int writer_sync(trajectory_writer *writer, file_sync sync);
/* Closes the file; its header has the number of all whole rows, also after a failure. */
int writer_close(trajectory_writer *writer);

typedef struct trajectory_reader {
    int columns;
    char **name;     /* [columns] t, the state, the observables; pieces of one text */
    long long count; /* all rows */
    double *row;     /* [columns] the present row */
    char *path;
    FILE *file;
    size_t offset;        /* where the rows begin */
    unsigned char *bytes; /* [8 columns] */
    long long next;       /* number of the next row */
} trajectory_reader;

/* Opens DIR/trajectory.npy.  Returns CLI_DONE, or prints and returns an exit status and leaves
 * nothing open. */
int reader_open(trajectory_reader *reader, const char *directory);
/* Returns 1 with the next row in row, 0 after the last row, -1 after a failure and its message. */
int reader_next(trajectory_reader *reader);
/* The last of count > 0 rows in row, without moving to it.  Returns CLI_DONE, or prints and returns
 * an exit status. */
int reader_peek_last(trajectory_reader *reader);
void reader_close(trajectory_reader *reader);

#endif
