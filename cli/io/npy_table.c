/* npy_table.c - rows of doubles in a .npy file that are written and read at any place. */
#include "npy_table.h"
#include "endian.h"
#include "file.h"
#include "trajectory.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BLOCK = 8192 /* numbers that are converted at a time */ };

/* A new file gets its header and its length, an old one must have them. */
static int prepare(const npy_table *table, char *header, off_t length, npy_state state)
{
    struct stat info;
    unsigned char *found = cli_malloc(table->header);
    int status = CLI_DONE;
    if (state == NPY_NEW) {
        if (ftruncate(table->descriptor, 0) != 0 || ftruncate(table->descriptor, length) != 0 ||
            file_transfer(table->descriptor, header, table->header, 0, FILE_WRITE) < table->header)
            status = cli_io("write", table->path);
    } else if (fstat(table->descriptor, &info) != 0 || info.st_size != length ||
               file_transfer(table->descriptor, found, table->header, 0, FILE_READ) <
                   table->header ||
               memcmp(found, header, table->header) != 0) {
        status = cli_fail(CLI_USAGE, "'%s' is not the file that was begun", table->path);
    }
    free(found);
    return status;
}

int npy_table_open(npy_table *table, char *path, char *const *names, int columns, long long blocks,
                   long long rows, npy_state state)
{
    char shape[64];
    if (blocks > 0)
        snprintf(shape, sizeof shape, "(%lld, %lld)", blocks, rows);
    else
        snprintf(shape, sizeof shape, "(%lld,)", rows);
    *table = (npy_table){.path = path, .columns = columns};
    table->descriptor = open(path, O_RDWR | (state == NPY_NEW ? O_CREAT : 0), 0666);
    if (table->descriptor < 0 && state == NPY_EXISTING && errno == ENOENT)
        return cli_fail(CLI_USAGE, "'%s' is missing: the ensemble cannot be continued", path);
    if (table->descriptor < 0) return cli_io("write", path);
    char *header = npy_make_header(names, columns, shape, &table->header);
    const double bytes = (double)(blocks > 0 ? blocks : 1) * (double)rows * columns * WORD;
    int status = CLI_DONE;
    if (bytes > 0x1p62)
        status = cli_fail(CLI_USAGE, "'%s' would have %g bytes", path, bytes);
    else
        status = prepare(table, header, (off_t)table->header + (off_t)bytes, state);
    free(header);
    return status;
}

static int transfer_rows(const npy_table *table, long long first, long long count, double *values,
                         file_way way)
{
    unsigned char bytes[BLOCK * WORD];
    off_t at = (off_t)table->header + (off_t)first * table->columns * WORD;
    for (long long rest = count * table->columns; rest > 0;) {
        const size_t n = rest < BLOCK ? (size_t)rest : BLOCK;
        for (size_t i = 0; way == FILE_WRITE && i < n; i++)
            write_le_double(bytes + i * WORD, values[i]);
        if (file_transfer(table->descriptor, bytes, n * WORD, at, way) < n * WORD)
            return cli_io(way == FILE_WRITE ? "write" : "read", table->path);
        for (size_t i = 0; way == FILE_READ && i < n; i++)
            values[i] = read_le_double(bytes + i * WORD);
        values += n;
        rest -= (long long)n;
        at += (off_t)(n * WORD);
    }
    return CLI_DONE;
}

int npy_table_write(const npy_table *table, long long first, long long count, const double *values)
{
    return transfer_rows(table, first, count, (double *)values, FILE_WRITE);
}

int npy_table_read(const npy_table *table, long long first, long long count, double *values)
{
    return transfer_rows(table, first, count, values, FILE_READ);
}

int npy_table_sync(const npy_table *table)
{
    return fdatasync(table->descriptor) == 0 ? CLI_DONE : cli_io("write", table->path);
}

void npy_table_close(npy_table *table)
{
    if (table->path && table->descriptor >= 0) close(table->descriptor);
    free(table->path);
    *table = (npy_table){.descriptor = -1};
}
