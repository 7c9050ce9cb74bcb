/* npy_table.c - rows of doubles in a .npy file that are written and read at any place. */
#include "npy_table.h"
#include "endian.h"
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

/* Writes or reads all bytes; false after an error, or at the end of the file. */
typedef enum transfer_way { READ, WRITE } transfer_way;

static bool transfer(int descriptor, unsigned char *bytes, size_t length, off_t at,
                     transfer_way way)
{
    while (length) {
        const ssize_t n = way == WRITE ? pwrite(descriptor, bytes, length, at)
                                       : pread(descriptor, bytes, length, at);
        if (n < 0 && errno == EINTR) continue;
        if (n == 0) errno = EIO;
        if (n <= 0) return false;
        bytes += n;
        length -= (size_t)n;
        at += n;
    }
    return true;
}

/* A new file gets its header and its length, an old one must have them. */
static int prepare(const npy_table *table, char *header, off_t length, bool is_new)
{
    struct stat info;
    unsigned char *found = cli_malloc(table->header);
    int status = CLI_DONE;
    if (is_new) {
        if (ftruncate(table->descriptor, 0) != 0 || ftruncate(table->descriptor, length) != 0 ||
            !transfer(table->descriptor, (unsigned char *)header, table->header, 0, WRITE))
            status = cli_io("write", table->path);
    } else if (fstat(table->descriptor, &info) != 0 || info.st_size != length ||
               !transfer(table->descriptor, found, table->header, 0, READ) ||
               memcmp(found, header, table->header) != 0) {
        status = cli_fail(CLI_USAGE, "'%s' is not the file that was begun", table->path);
    }
    free(found);
    return status;
}

int npy_table_open(npy_table *table, char *path, char *const *names, int columns, long long blocks,
                   long long rows, bool is_new)
{
    char shape[64];
    if (blocks > 0)
        snprintf(shape, sizeof shape, "(%lld, %lld)", blocks, rows);
    else
        snprintf(shape, sizeof shape, "(%lld,)", rows);
    *table = (npy_table){.path = path, .columns = columns};
    table->descriptor = open(path, O_RDWR | (is_new ? O_CREAT : 0), 0666);
    if (table->descriptor < 0 && !is_new && errno == ENOENT)
        return cli_fail(CLI_USAGE, "'%s' is missing: the ensemble cannot be continued", path);
    if (table->descriptor < 0) return cli_io("write", path);
    char *header = npy_make_header(names, columns, shape, &table->header);
    const double bytes = (double)(blocks > 0 ? blocks : 1) * (double)rows * columns * WORD;
    int status = CLI_DONE;
    if (bytes > 0x1p62)
        status = cli_fail(CLI_USAGE, "'%s' would have %g bytes", path, bytes);
    else
        status = prepare(table, header, (off_t)table->header + (off_t)bytes, is_new);
    free(header);
    return status;
}

static int transfer_rows(const npy_table *table, long long first, long long count, double *values,
                         transfer_way way)
{
    unsigned char bytes[BLOCK * WORD];
    off_t at = (off_t)table->header + (off_t)first * table->columns * WORD;
    for (long long left = count * table->columns; left > 0;) {
        const size_t n = left < BLOCK ? (size_t)left : BLOCK;
        for (size_t i = 0; way == WRITE && i < n; i++) write_le_double(bytes + i * WORD, values[i]);
        if (!transfer(table->descriptor, bytes, n * WORD, at, way))
            return cli_io(way == WRITE ? "write" : "read", table->path);
        for (size_t i = 0; way == READ && i < n; i++) values[i] = read_le_double(bytes + i * WORD);
        values += n;
        left -= (long long)n;
        at += (off_t)(n * WORD);
    }
    return CLI_DONE;
}

int npy_table_write(const npy_table *table, long long first, long long count, const double *values)
{
    return transfer_rows(table, first, count, (double *)values, WRITE);
}

int npy_table_read(const npy_table *table, long long first, long long count, double *values)
{
    return transfer_rows(table, first, count, values, READ);
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
