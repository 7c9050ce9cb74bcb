/* rows.c - what it costs to write rows: by the table of the program, with its buffer, its check sum
 * and its header, and the same bytes by write(2) alone, 1 MiB at a time.
 *
 *     rows table
 *     rows write
 *
 * Both make a new file in /tmp each time, of 21 columns as the sleigh has them on the canonical
 * space.  Prints nanoseconds per row and numbers read back, since the bytes must be the same. */
#define _DEFAULT_SOURCE
#include "bench.h"
#include "io/trajectory.h"
#include "ui/message.h"
#include <fcntl.h>
#include <unistd.h>

enum { ROWS = 1 << 16, COLUMNS = 21, SOURCE = 64, CHUNK = 1 << 20, CHECKED = 64 };

static char place[] = "/tmp/dalembert-rows-XXXXXX.npy";
static char *names[COLUMNS];

static double rows[SOURCE][COLUMNS];

/* Something other than zeros in every column. */
static void fill(void)
{
    for (int k = 0; k < SOURCE; k++)
        for (int i = 0; i < COLUMNS; i++) rows[k][i] = 0.01 * k + 0.125 * i;
}

static int by_table(void *self, double *end)
{
    trajectory_writer table;
    (void)self;
    (void)end;
    int status = writer_create(&table, place, names, COLUMNS);
    for (long k = 0; k < ROWS && status == CLI_DONE; k++) {
        rows[k % SOURCE][0] = 0.01 * (double)k;
        status = writer_append(&table, rows[k % SOURCE]);
    }
    const int closed = writer_close(&table);
    return status != CLI_DONE || closed != CLI_DONE;
}

typedef struct bytes {
    char *text;
    size_t length;
} bytes;

static int by_write(void *self, double *end)
{
    const bytes *b = self;
    (void)end;
    const int file = open(place, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    size_t at = 0;
    for (ssize_t n = 0; file >= 0 && n >= 0 && at<b->length; at += n> 0 ? (size_t)n : 0)
        n = write(file, b->text + at, b->length - at < CHUNK ? b->length - at : CHUNK);
    return file < 0 || close(file) != 0 || at < b->length;
}

/* The file as it is now. */
static int read_file(bytes *b)
{
    FILE *file = fopen(place, "rb");
    const size_t capacity = (size_t)ROWS * COLUMNS * 8 + 4096;
    b->text = malloc(capacity);
    b->length = file && b->text ? fread(b->text, 1, capacity, file) : 0;
    if (file) fclose(file);
    return b->length == 0;
}

/* As bench_measure wants it: the work, then numbers from all over the file. */
typedef struct contender {
    int (*work)(void *self, double *end);
    bytes bytes;
} contender;

static int work(void *self, double *end)
{
    contender *c = self;
    const int failed = c->work(&c->bytes, end), file = open(place, O_RDONLY);
    const size_t stride = c->bytes.length / 8 / CHECKED;
    for (size_t i = 0; i < CHECKED && file >= 0; i++)
        if (pread(file, &end[i], 8, (off_t)(8 * (stride * i + stride - 1))) != 8) end[i] = NAN;
    if (file >= 0) close(file);
    return failed;
}

int main(int argc, char **argv)
{
    static char text[COLUMNS][8];
    const int table = bench_is(argc, argv, "table");
    contender c = {table ? by_table : by_write, {NULL, 0}};
    if (!table && !bench_is(argc, argv, "write")) return bench_unknown(argc, argv);
    for (int i = 0; i < COLUMNS; i++) {
        snprintf(text[i], sizeof text[i], "x%d", i);
        names[i] = text[i];
    }
    fill();
    const int file = mkstemps(place, 4);
    if (file < 0 || close(file) != 0 || by_table(NULL, NULL) || read_file(&c.bytes)) return 1;
    const int status = bench_measure(&(bench_contender){ROWS, CHECKED, work, &c});
    free(c.bytes.text);
    unlink(place);
    return status;
}
