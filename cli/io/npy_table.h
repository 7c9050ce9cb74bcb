/* npy_table.h - rows of doubles in a .npy file that are written and read at any place.
 *
 * The file is a structured array of a known number of rows, in one dimension or two; what was not
 * written is 0. */
#ifndef DAL_CLI_NPY_TABLE_H
#define DAL_CLI_NPY_TABLE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct npy_table {
    char *path;
    int descriptor, columns;
    size_t header; /* bytes before the rows */
} npy_table;

/* Whether a file must be there, or is made. */
typedef enum npy_state { NPY_EXISTING, NPY_NEW } npy_state;

/* All return CLI_DONE, or print and return CLI_IO, or CLI_USAGE where a file that must be there is
 * missing or another one. */

/* Opens a file of blocks of rows, shape (rows,) or (blocks, rows); a new one is made and has its
 * whole length.  Takes over path. */
int npy_table_open(npy_table *table, char *path, char *const *names, int columns, long long blocks,
                   long long rows, npy_state state);
/* Rows first, .., first + count - 1, counted through all blocks. */
int npy_table_write(const npy_table *table, long long first, long long count, const double *values);
int npy_table_read(const npy_table *table, long long first, long long count, double *values);
/* Waits until all that was written is on the disk. */
int npy_table_sync(const npy_table *table);
void npy_table_close(npy_table *table);

#endif
