/* npy.h - arrays of named doubles in a file of numpy: see npy.c. */
#ifndef DAL_CLI_NPY_H
#define DAL_CLI_NPY_H

#include <stdint.h>
#include <stdio.h>

enum { NPY_LINE = 64 };

/* What such a file begins with. */
typedef struct npy_header {
    char *text;    /* [length], allocated; its last NPY_LINE bytes alone tell of the rows */
    size_t length; /* where the rows begin */
} npy_header;

/* Returns CLI_DONE or prints and returns CLI_IO. */
void npy_make_header(npy_header *header, char *const *names, int columns);
/* Puts a number of rows into it. */
void npy_set_rows(npy_header *header, long long rows);

/* The names are pieces of one text, names[0], and to be freed with it: npy_free_columns. */
typedef struct npy_columns {
    char **names;
    int columns;
    long long rows;
    size_t offset; /* where the rows begin */
} npy_columns;

/* Reads what npy_make_header and npy_set_rows wrote.  Returns CLI_DONE or prints and returns
 * CLI_USAGE or CLI_IO. */
int npy_read_header(npy_columns *columns, FILE *file, const char *path);
void npy_free_columns(npy_columns *columns);

/* Numbers as they stand in such a file, eight bytes each, and back.  Zero has no sign there and
 * what is not a number one form, for equal runs to give equal files. */
void npy_encode(unsigned char *bytes, const double *values, int count);
void npy_decode(const unsigned char *bytes, double *values, int count);

#endif
