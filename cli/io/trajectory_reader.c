/* trajectory_reader.c - the rows of a run that lives in a directory, read one by one. */
#include "trajectory_reader.h"
#include "output.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int failed(const trajectory_reader *r)
{
    cli_io("read", r->path);
    return -1;
}

/* ---- .npy ---------------------------------------------------------------------------------- */

static int open_npy(trajectory_reader *r)
{
    int status = npy_read_header(&r->npy, r->file, r->path);
    if (status != CLI_DONE) return status;
    r->columns = r->npy.columns;
    r->name = r->npy.names;
    r->count = r->npy.rows;
    r->begin = (long long)r->npy.offset;
    r->bytes = cli_calloc((size_t)r->columns, sizeof(double));
    return CLI_DONE;
}

static int next_npy(trajectory_reader *r)
{
    const size_t length = (size_t)r->columns * sizeof(double);
    if (fread(r->bytes, 1, length, r->file) != length) {
        if (!ferror(r->file)) cli_fail(CLI_IO, "'%s': shorter than it tells", r->path);
        return ferror(r->file) ? failed(r) : -1;
    }
    npy_decode(r->bytes, r->row, r->columns);
    return 1;
}

/* ---- CSV ----------------------------------------------------------------------------------- */

/* Names have no commas in them. */
static int open_csv(trajectory_reader *r)
{
    const ssize_t length = cli_getline(&r->line, &r->capacity, r->file);
    if (length < 2) return cli_fail(CLI_USAGE, "'%s' has no rows", r->path);
    r->line[length - 1] = '\0';
    for (const char *c = r->line; *c; c++) r->columns += *c == ',';
    r->name = cli_calloc((size_t)++r->columns, sizeof *r->name);
    char *text = cli_strdup(r->line);
    for (int i = 0; i < r->columns; i++) {
        r->name[i] = text;
        text += strcspn(text, ",");
        *text++ = '\0';
    }
    r->begin = length;
    for (int c; (c = fgetc(r->file)) != EOF;) r->count += c == '\n';
    return reader_seek(r, 0);
}

static int next_csv(trajectory_reader *r)
{
    if (cli_getline(&r->line, &r->capacity, r->file) < 0) return failed(r);
    char *at = r->line;
    for (int i = 0; i < r->columns; i++) {
        r->row[i] = strtod(at, &at);
        if (*at == ',') at++;
    }
    return 1;
}

/* ---- either -------------------------------------------------------------------------------- */

static int open_file(trajectory_reader *r, const char *directory)
{
    static const char *const names[] = {"trajectory.npy", "rows.csv"};
    for (int i = 0; i < 2 && !r->file; i++) {
        free(r->path);
        r->path = cli_join(directory, names[i]);
        r->file = fopen(r->path, "rb");
        if (!r->file && errno != ENOENT && errno != ENOTDIR) return cli_io("read", r->path);
    }
    if (r->file) return CLI_DONE;
    return cli_fail(CLI_USAGE, "'%s' holds no run: there is no %s", directory, names[0]);
}

int reader_open(trajectory_reader *reader, const char *directory)
{
    *reader = (trajectory_reader){0};
    int status = open_file(reader, directory);
    if (status == CLI_DONE)
        status = cli_ends_in(reader->path, ".npy") ? open_npy(reader) : open_csv(reader);
    if (status == CLI_DONE)
        reader->row = cli_calloc((size_t)reader->columns, sizeof *reader->row);
    else
        reader_close(reader);
    return status;
}

int reader_next(trajectory_reader *reader)
{
    if (reader->next >= reader->count) return 0;
    reader->next++;
    return reader->bytes ? next_npy(reader) : next_csv(reader);
}

int reader_seek(trajectory_reader *reader, long long k)
{
    const long long bytes = reader->bytes ? k * reader->columns * (long long)sizeof(double) : 0;
    if (fseeko(reader->file, (off_t)(reader->begin + bytes), SEEK_SET) != 0)
        return cli_io("read", reader->path);
    for (long long i = 0; i < k && !reader->bytes; i++)
        if (cli_getline(&reader->line, &reader->capacity, reader->file) < 0)
            return cli_io("read", reader->path);
    reader->next = k;
    return CLI_DONE;
}

void reader_close(trajectory_reader *reader)
{
    if (reader->file) fclose(reader->file);
    if (reader->npy.columns == 0 && reader->name) free(reader->name[0]);
    if (reader->npy.columns == 0) free(reader->name);
    npy_free_columns(&reader->npy);
    free(reader->row);
    free(reader->bytes);
    free(reader->line);
    free(reader->path);
    *reader = (trajectory_reader){0};
}
