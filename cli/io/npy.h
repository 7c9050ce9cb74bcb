/* npy.h - arrays of named doubles in a file of numpy: see npy.c. */
#ifndef DAL_CLI_NPY_H
#define DAL_CLI_NPY_H

#include <stdint.h>
#include <stdio.h>

enum { NPY_LINE = 64 };

/* The beginning of such a file. */
typedef struct npy_header {
    char *text;    /* [length], allocated; its last NPY_LINE bytes have the number of rows */
    size_t length; /* where the rows begin */
} npy_header;

/* Makes the header of a file without rows; free its text. */
void npy_make_header(npy_header *header, char *const *names, int columns);
/* Writes the number of rows into it. */
void npy_set_rows(npy_header *header, long long rows);

/* The names are pieces of one text, which names[0] owns. */
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

/* Numbers as they are in such a file, eight bytes each, and back.  Zero has no sign there and not a
 * number one form, so that equal runs give equal files. */
void npy_encode(unsigned char *bytes, const double *values, int count);
void npy_decode(const unsigned char *bytes, double *values, int count);

#endif
