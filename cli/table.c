/* table.c - tables of doubles as CSV or .npy.
 *
 * The .npy header (numpy.lib.format, version 1.0) is padded to 128 bytes, so that the number of
 * rows can be written over when a run ends early. */
#include "table.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { NPY_HEADER = 128 };

static int broken(cli_table *table)
{
    table->broken = 1;
    return cli_io("write", table->path);
}

static int put_csv_header(cli_table *table, char *const *names)
{
    for (int i = 0; i < table->columns; i++) {
        if (i) fputc(',', table->file);
        cli_put_text(table->file, names[i]);
    }
    fputc('\n', table->file);
    return ferror(table->file) ? broken(table) : CLI_DONE;
}

static int put_npy_header(cli_table *table, long long rows)
{
    char header[NPY_HEADER + 1] = "\x93NUMPY\x01";
    header[8] = (char)(NPY_HEADER - 10);
    int n = 10 + snprintf(header + 10, NPY_HEADER - 10,
                          "{'descr': '<f8', 'fortran_order': False, 'shape': (%lld, %d), }", rows,
                          table->columns);
    memset(header + n, ' ', (size_t)(NPY_HEADER - n));
    header[NPY_HEADER - 1] = '\n';
    table->announced = rows;
    if (fwrite(header, 1, NPY_HEADER, table->file) != NPY_HEADER) return broken(table);
    return CLI_DONE;
}

static int put_column_file(const cli_table *table, char *const *names)
{
    static const char ending[] = ".columns.txt";
    size_t n = strlen(table->path);
    char *path = malloc(n + sizeof ending);
    if (!path) return cli_fail(CLI_IO, "out of memory");
    memcpy(path, table->path, n);
    memcpy(path + n, ending, sizeof ending);
    FILE *file = fopen(path, "w");
    int status = file ? CLI_DONE : cli_io("write", path);
    for (int i = 0; file && i < table->columns; i++) fprintf(file, "%s\n", names[i]);
    if (file) status = cli_close(file, path);
    free(path);
    return status;
}

int table_create(cli_table *table, const char *path, char *const *names, int columns,
                 long long rows)
{
    int standard = strcmp(path, "-") == 0;
    *table = (cli_table){.path = standard ? "standard output" : path,
                         .npy = cli_ends_in(path, ".npy"),
                         .columns = columns};
    table->file = standard ? stdout : fopen(path, "wb");
    if (!table->file) return cli_io("write", path);
    if (!table->npy) return put_csv_header(table, names);
    int status = put_npy_header(table, rows);
    return status == CLI_DONE ? put_column_file(table, names) : status;
}

static int cut(cli_table *table, long long offset)
{
    struct stat status;
    if (fstat(fileno(table->file), &status) != 0) return broken(table);
    if (status.st_size < (off_t)offset) {
        table->broken = 1;
        return cli_fail(CLI_USAGE, "'%s': shorter than the %lld bytes its checkpoint tells of",
                        table->path, offset);
    }
    if (ftruncate(fileno(table->file), (off_t)offset) != 0) return broken(table);
    return fseeko(table->file, (off_t)offset, SEEK_SET) == 0 ? CLI_DONE : broken(table);
}

int table_continue(cli_table *table, const char *path, int descriptor, char *const *names,
                   int columns, long long rows, long long offset)
{
    *table = (cli_table){.path = path, .columns = columns, .rows = rows};
    table->file = fdopen(descriptor, "r+b");
    if (!table->file) {
        close(descriptor);
        return cli_io("write", path);
    }
    int status = cut(table, offset);
    return status == CLI_DONE && offset == 0 ? put_csv_header(table, names) : status;
}

static void put_little_endian(FILE *out, double x)
{
    uint64_t bits;
    unsigned char bytes[8];
    memcpy(&bits, &x, sizeof bits);
    for (int i = 0; i < 8; i++) bytes[i] = (unsigned char)(bits >> 8 * i);
    fwrite(bytes, 1, sizeof bytes, out);
}

int table_row(cli_table *table, const double *values)
{
    for (int i = 0; i < table->columns; i++) {
        if (table->npy) {
            put_little_endian(table->file, values[i] == 0.0 ? 0.0 : values[i]);
        } else {
            if (i) fputc(',', table->file);
            cli_put(table->file, values[i]);
        }
    }
    if (!table->npy) fputc('\n', table->file);
    if (ferror(table->file)) return broken(table);
    table->rows++;
    return CLI_DONE;
}

int table_settle(cli_table *table, long long *offset)
{
    if (fflush(table->file) != 0 || fsync(fileno(table->file)) != 0) return broken(table);
    *offset = (long long)ftello(table->file);
    return *offset < 0 ? broken(table) : CLI_DONE;
}

int table_close(cli_table *table)
{
    FILE *file = table->file;
    if (!file) return CLI_DONE;
    /* Each of these that fails sets broken. */
    if (table->npy && !table->broken && table->rows != table->announced) {
        if (fseeko(file, 0, SEEK_SET) == 0)
            put_npy_header(table, table->rows);
        else
            broken(table);
    }
    table->file = NULL;
    if (!table->broken) return cli_close(file, table->path);
    /* The failure has been told already; closing would tell it again. */
    if (file != stdout) fclose(file);
    return CLI_IO;
}
