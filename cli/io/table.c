/* table.c - tables of doubles as CSV or .npy.
 *
 * A .npy file grows: rows are gathered and written many at a time, and only then the header tells
 * of them, so that whatever kills the process leaves a file that can be read.
 *
 * The sum of rows takes word number i, 64 bits, into lane i mod 4,
 *
 *     s <- (rotate(s, 23) xor word) K,
 *
 * with K odd, so that any one word that changes changes it, and four words are under way at once.
 */
#include "table.h"
#include "word.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BUFFER_BYTES = 1 << 20 };

static int broken(cli_table *table)
{
    table->broken = 1;
    return cli_io("write", table->path);
}

/* ---- the sum ------------------------------------------------------------------------------- */

static uint64_t mix(uint64_t sum, uint64_t word)
{
    return ((sum << 23 | sum >> 41) ^ word) * UINT64_C(0x9e3779b97f4a7c15);
}

static void add_word(table_sum *sum, long long place, const unsigned char *bytes)
{
    uint64_t *lane = &sum->lane[(uint64_t)place % TABLE_LANES];
    *lane = mix(*lane, word_get(bytes));
}

/* Words of all lanes, round by round. */
static void add_rounds(table_sum *sum, const unsigned char *bytes, long long rounds)
{
    uint64_t s0 = sum->lane[0], s1 = sum->lane[1], s2 = sum->lane[2], s3 = sum->lane[3];
    for (; rounds > 0; rounds--, bytes += TABLE_LANES * WORD) {
        s0 = mix(s0, word_get(bytes));
        s1 = mix(s1, word_get(bytes + WORD));
        s2 = mix(s2, word_get(bytes + 2 * WORD));
        s3 = mix(s3, word_get(bytes + 3 * WORD));
    }
    *sum = (table_sum){{s0, s1, s2, s3}};
}

/* Adds count words, behind those before. */
static void add_words(table_sum *sum, long long before, const unsigned char *bytes, long long count)
{
    long long i = 0;
    for (; i < count && (before + i) % TABLE_LANES; i++)
        add_word(sum, before + i, bytes + i * WORD);
    const long long rounds = (count - i) / TABLE_LANES;
    add_rounds(sum, bytes + i * WORD, rounds);
    for (i += rounds * TABLE_LANES; i < count; i++) add_word(sum, before + i, bytes + i * WORD);
}

/* ---- .npy ---------------------------------------------------------------------------------- */

static size_t row_bytes(const cli_table *table) { return (size_t)table->columns * WORD; }

static off_t place_of(const cli_table *table, long long row)
{
    return (off_t)(table->header.length + (size_t)row * row_bytes(table));
}

/* Writes at a place; *written bytes are surely there afterwards. */
static int write_at(int descriptor, const void *bytes, size_t length, off_t place, size_t *written)
{
    for (*written = 0; *written < length;) {
        const ssize_t n = pwrite(descriptor, (const char *)bytes + *written, length - *written,
                                 place + (off_t)*written);
        if (n < 0 && errno != EINTR) return 0;
        if (n > 0) *written += (size_t)n;
    }
    return 1;
}

/* The last line of the header, which alone changes. */
static int announce(cli_table *table)
{
    const size_t place = table->header.length - NPY_LINE;
    size_t written;
    npy_announce(&table->header, table->rows);
    return write_at(table->descriptor, table->header.text + place, NPY_LINE, (off_t)place,
                    &written);
}

/* Writes the rows that wait.  Of a write that fails the whole rows count. */
static int flush(cli_table *table)
{
    size_t written;
    const int done =
        write_at(table->descriptor, table->buffer, (size_t)table->waiting * row_bytes(table),
                 place_of(table, table->rows), &written);
    const int reason = errno;
    const long long whole = (long long)(written / row_bytes(table));
    add_words(&table->sum, table->rows * table->columns, table->buffer, whole * table->columns);
    table->rows += whole;
    table->waiting = 0;
    if (done) return CLI_DONE;
    announce(table);
    errno = reason;
    return broken(table);
}

static int begin_anew(cli_table *table)
{
    size_t written;
    table->rows = 0;
    table->sum = (table_sum){{0}};
    npy_announce(&table->header, 0);
    if (ftruncate(table->descriptor, 0) == 0 &&
        write_at(table->descriptor, table->header.text, table->header.length, 0, &written))
        return CLI_DONE;
    return broken(table);
}

static void make_buffer(cli_table *table, char *const *names)
{
    const size_t rows = BUFFER_BYTES / row_bytes(table);
    table->room = rows ? (long long)rows : 1;
    table->buffer = cli_malloc((size_t)table->room * row_bytes(table));
    npy_describe(&table->header, names, table->columns);
}

void table_adopt(cli_table *table, const char *path, int descriptor, char *const *names,
                 int columns)
{
    *table = (cli_table){.path = path, .columns = columns, .descriptor = descriptor, .rows = -1};
    make_buffer(table, names);
}

static int other_columns(const cli_table *table)
{
    const size_t length = table->header.length - NPY_LINE;
    char *text = cli_malloc(length);
    const int other = pread(table->descriptor, text, length, 0) != (ssize_t)length ||
                      memcmp(text, table->header.text, length) != 0;
    free(text);
    return other;
}

/* Reads the first rows, bufferful by bufferful, and gives their sum. */
static int sum_rows(const cli_table *table, long long rows, table_sum *sum)
{
    *sum = (table_sum){{0}};
    for (long long row = 0; row < rows; row += table->room) {
        const long long count = rows - row < table->room ? rows - row : table->room;
        const size_t length = (size_t)count * row_bytes(table);
        const ssize_t n = pread(table->descriptor, table->buffer, length, place_of(table, row));
        if (n < 0) return cli_io("read", table->path);
        if ((size_t)n < length)
            return cli_fail(CLI_USAGE, "'%s': shorter than the %lld rows its checkpoint tells of",
                            table->path, rows);
        add_words(sum, row * table->columns, table->buffer, count * table->columns);
    }
    return CLI_DONE;
}

int table_holds(const cli_table *table, long long rows, const table_sum *sum)
{
    table_sum found;
    if (rows == 0) return CLI_DONE;
    if (other_columns(table))
        return cli_fail(CLI_USAGE, "'%s': its columns are not those of the run", table->path);
    const int status = sum_rows(table, rows, &found);
    if (status != CLI_DONE || memcmp(&found, sum, sizeof found) == 0) return status;
    return cli_fail(CLI_USAGE, "'%s': its first %lld rows were changed since the checkpoint",
                    table->path, rows);
}

int table_go_on(cli_table *table, long long rows, const table_sum *sum)
{
    if (rows == 0) return begin_anew(table);
    table->rows = rows;
    table->sum = *sum;
    if (ftruncate(table->descriptor, place_of(table, rows)) != 0 || !announce(table))
        return broken(table);
    return CLI_DONE;
}

static int create_npy(cli_table *table, const char *path, char *const *names, int columns)
{
    const int descriptor = open(path, O_RDWR | O_CREAT | O_TRUNC, 0666);
    if (descriptor < 0) return cli_io("write", path);
    table_adopt(table, path, descriptor, names, columns);
    return begin_anew(table);
}

static int put_row(cli_table *table, const double *values)
{
    unsigned char *place = table->buffer + (size_t)table->waiting * row_bytes(table);
    npy_put(place, values, table->columns);
    return ++table->waiting < table->room ? CLI_DONE : flush(table);
}

static int settle_npy(cli_table *table, int settle)
{
    if (flush(table) != CLI_DONE) return CLI_IO;
    if ((settle && fsync(table->descriptor) != 0) || !announce(table)) return broken(table);
    return CLI_DONE;
}

static int close_npy(cli_table *table)
{
    const int begun = table->rows >= 0 && !table->broken;
    if (begun && flush(table) == CLI_DONE && !announce(table)) broken(table);
    if (close(table->descriptor) != 0 && !table->broken) broken(table);
    free(table->header.text);
    free(table->buffer);
    table->buffer = NULL;
    return table->broken ? CLI_IO : CLI_DONE;
}

/* ---- CSV ----------------------------------------------------------------------------------- */

static int create_csv(cli_table *table, const char *path, char *const *names)
{
    const int standard = strcmp(path, "-") == 0;
    table->path = standard ? "standard output" : path;
    table->file = standard ? stdout : fopen(path, "wb");
    if (!table->file) return cli_io("write", path);
    for (int i = 0; i < table->columns; i++) {
        if (i) fputc(',', table->file);
        cli_put_text(table->file, names[i]);
    }
    fputc('\n', table->file);
    return ferror(table->file) ? broken(table) : CLI_DONE;
}

static int put_line(cli_table *table, const double *values)
{
    for (int i = 0; i < table->columns; i++) {
        if (i) fputc(',', table->file);
        cli_put(table->file, values[i]);
    }
    fputc('\n', table->file);
    if (ferror(table->file)) return broken(table);
    table->rows++;
    return CLI_DONE;
}

static int close_csv(cli_table *table)
{
    FILE *file = table->file;
    table->file = NULL;
    if (!table->broken) return cli_close(file, table->path);
    /* The failure has been told already; closing would tell it again. */
    if (file != stdout) fclose(file);
    return CLI_IO;
}

/* ---- either -------------------------------------------------------------------------------- */

int table_create(cli_table *table, const char *path, char *const *names, int columns)
{
    *table = (cli_table){.columns = columns};
    return cli_ends_in(path, ".npy") ? create_npy(table, path, names, columns)
                                     : create_csv(table, path, names);
}

int table_row(cli_table *table, const double *values)
{
    return table->file ? put_line(table, values) : put_row(table, values);
}

int table_settle(cli_table *table, int settle)
{
    if (!table->file) return settle_npy(table, settle);
    return fflush(table->file) == 0 ? CLI_DONE : broken(table);
}

int table_close(cli_table *table)
{
    if (table->file) return close_csv(table);
    return table->buffer ? close_npy(table) : CLI_DONE;
}
