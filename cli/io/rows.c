/* rows.c - the rows of a run that lives in a directory, read one by one. */
#include "rows.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int failed(const cli_rows *r)
{
    cli_io("read", r->path);
    return -1;
}

/* ---- .npy ---------------------------------------------------------------------------------- */

static int open_npy(cli_rows *r)
{
    int status = npy_read(&r->npy, r->file, r->path);
    if (status != CLI_DONE) return status;
    r->columns = r->npy.columns;
    r->name = r->npy.names;
    r->count = r->npy.rows;
    r->begin = (long long)r->npy.offset;
    r->bytes = cli_calloc((size_t)r->columns, sizeof(double));
    return CLI_DONE;
}

static int next_npy(cli_rows *r)
{
    const size_t length = (size_t)r->columns * sizeof(double);
    if (fread(r->bytes, 1, length, r->file) != length) {
        if (!ferror(r->file)) cli_fail(CLI_IO, "'%s': shorter than it tells", r->path);
        return ferror(r->file) ? failed(r) : -1;
    }
    npy_get(r->bytes, r->row, r->columns);
    return 1;
}

/* ---- CSV ----------------------------------------------------------------------------------- */

/* Names have no commas in them. */
static int open_csv(cli_rows *r)
{
    const ssize_t length = cli_getline(&r->line, &r->room, r->file);
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
    return rows_seek(r, 0);
}

static int next_csv(cli_rows *r)
{
    if (cli_getline(&r->line, &r->room, r->file) < 0) return failed(r);
    char *at = r->line;
    for (int i = 0; i < r->columns; i++) {
        r->row[i] = strtod(at, &at);
        if (*at == ',') at++;
    }
    return 1;
}

/* ---- either -------------------------------------------------------------------------------- */

static int open_file(cli_rows *r, const char *directory)
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

int rows_open(cli_rows *rows, const char *directory)
{
    *rows = (cli_rows){0};
    int status = open_file(rows, directory);
    if (status == CLI_DONE)
        status = cli_ends_in(rows->path, ".npy") ? open_npy(rows) : open_csv(rows);
    if (status == CLI_DONE)
        rows->row = cli_calloc((size_t)rows->columns, sizeof *rows->row);
    else
        rows_close(rows);
    return status;
}

int rows_next(cli_rows *rows)
{
    if (rows->next >= rows->count) return 0;
    rows->next++;
    return rows->bytes ? next_npy(rows) : next_csv(rows);
}

int rows_seek(cli_rows *rows, long long k)
{
    const long long bytes = rows->bytes ? k * rows->columns * (long long)sizeof(double) : 0;
    if (fseeko(rows->file, (off_t)(rows->begin + bytes), SEEK_SET) != 0)
        return cli_io("read", rows->path);
    for (long long i = 0; i < k && !rows->bytes; i++)
        if (cli_getline(&rows->line, &rows->room, rows->file) < 0)
            return cli_io("read", rows->path);
    rows->next = k;
    return CLI_DONE;
}

void rows_close(cli_rows *rows)
{
    if (rows->file) fclose(rows->file);
    if (rows->npy.columns == 0 && rows->name) free(rows->name[0]);
    if (rows->npy.columns == 0) free(rows->name);
    npy_forget(&rows->npy);
    free(rows->row);
    free(rows->bytes);
    free(rows->line);
    free(rows->path);
    *rows = (cli_rows){0};
}
