/* trajectory_writer.c - rows of doubles as CSV or .npy.
 *
 * A .npy file grows: rows are collected and written many at a time, and the header gets their
 * number afterwards, so that the file can be read whatever ends the process.
 *
 * The sum of rows takes word number i, 64 bits, into lane i mod 4,
 *
 *     s <- (rotate(s, 23) xor word) K,
 *
 * with K odd, so that a change of any one word changes it; the four lanes are independent. */
#include "trajectory_writer.h"
#include "endian.h"
#include "output.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BUFFER_BYTES = 1 << 20 };

static int failed(trajectory_writer *writer)
{
    writer->failed = 1;
    return cli_io("write", writer->path);
}

/* ---- the sum ------------------------------------------------------------------------------- */

static uint64_t mix(uint64_t sum, uint64_t word)
{
    return ((sum << 23 | sum >> 41) ^ word) * UINT64_C(0x9e3779b97f4a7c15);
}

static void add_word(row_sum *sum, long long i, const unsigned char *bytes)
{
    uint64_t *lane = &sum->lane[(uint64_t)i % ROW_SUM_LANES];
    *lane = mix(*lane, read_le64(bytes));
}

/* Words of all lanes, round by round. */
static void add_rounds(row_sum *sum, const unsigned char *bytes, long long rounds)
{
    uint64_t s0 = sum->lane[0], s1 = sum->lane[1], s2 = sum->lane[2], s3 = sum->lane[3];
    for (; rounds > 0; rounds--, bytes += ROW_SUM_LANES * WORD) {
        s0 = mix(s0, read_le64(bytes));
        s1 = mix(s1, read_le64(bytes + WORD));
        s2 = mix(s2, read_le64(bytes + 2 * WORD));
        s3 = mix(s3, read_le64(bytes + 3 * WORD));
    }
    *sum = (row_sum){{s0, s1, s2, s3}};
}

/* Adds count words, behind those before. */
static void add_words(row_sum *sum, long long before, const unsigned char *bytes, long long count)
{
    long long i = 0;
    for (; i < count && (before + i) % ROW_SUM_LANES; i++)
        add_word(sum, before + i, bytes + i * WORD);
    const long long rounds = (count - i) / ROW_SUM_LANES;
    add_rounds(sum, bytes + i * WORD, rounds);
    for (i += rounds * ROW_SUM_LANES; i < count; i++) add_word(sum, before + i, bytes + i * WORD);
}

/* ---- .npy ---------------------------------------------------------------------------------- */

static size_t row_bytes(const trajectory_writer *writer) { return (size_t)writer->columns * WORD; }

static off_t place_of(const trajectory_writer *writer, long long row)
{
    return (off_t)(writer->header.length + (size_t)row * row_bytes(writer));
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

/* Writes the number of rows into the last line of the header, which alone changes. */
static int write_rows_number(trajectory_writer *writer)
{
    const size_t place = writer->header.length - NPY_LINE;
    size_t written;
    npy_set_rows(&writer->header, writer->rows);
    return write_at(writer->descriptor, writer->header.text + place, NPY_LINE, (off_t)place,
                    &written);
}

/* Writes the pending rows.  Of a write that fails the whole rows count. */
static int flush(trajectory_writer *writer)
{
    size_t written;
    const int done =
        write_at(writer->descriptor, writer->buffer, (size_t)writer->pending * row_bytes(writer),
                 place_of(writer, writer->rows), &written);
    const int reason = errno;
    const long long whole = (long long)(written / row_bytes(writer));
    add_words(&writer->sum, writer->rows * writer->columns, writer->buffer,
              whole * writer->columns);
    writer->rows += whole;
    writer->pending = 0;
    if (done) return CLI_DONE;
    write_rows_number(writer);
    errno = reason;
    return failed(writer);
}

void writer_attach(trajectory_writer *writer, const char *path, int descriptor, char *const *names,
                   int columns)
{
    *writer =
        (trajectory_writer){.path = path, .columns = columns, .descriptor = descriptor, .rows = -1};
    const size_t rows = BUFFER_BYTES / row_bytes(writer);
    writer->capacity = rows ? (long long)rows : 1;
    writer->buffer = cli_malloc((size_t)writer->capacity * row_bytes(writer));
    npy_make_header(&writer->header, names, columns);
}

/* Reads the first rows, one buffer after the other, and gives their sum. */
static int sum_rows(const trajectory_writer *writer, long long rows, row_sum *sum)
{
    *sum = (row_sum){{0}};
    for (long long row = 0; row < rows; row += writer->capacity) {
        const long long count = rows - row < writer->capacity ? rows - row : writer->capacity;
        const size_t length = (size_t)count * row_bytes(writer);
        const ssize_t n = pread(writer->descriptor, writer->buffer, length, place_of(writer, row));
        if (n < 0) return cli_io("read", writer->path);
        if ((size_t)n < length)
            return cli_fail(CLI_USAGE, "'%s' has fewer rows than the %lld of its checkpoint",
                            writer->path, rows);
        add_words(sum, row * writer->columns, writer->buffer, count * writer->columns);
    }
    return CLI_DONE;
}

int writer_verify(const trajectory_writer *writer, long long rows, const row_sum *sum)
{
    row_sum found;
    if (rows == 0) return CLI_DONE;
    const size_t length = writer->header.length - NPY_LINE;
    char *text = cli_malloc(length);
    const int same = pread(writer->descriptor, text, length, 0) == (ssize_t)length &&
                     memcmp(text, writer->header.text, length) == 0;
    free(text);
    if (!same)
        return cli_fail(CLI_USAGE, "'%s': its columns are not those of the run", writer->path);
    const int status = sum_rows(writer, rows, &found);
    if (status != CLI_DONE || memcmp(&found, sum, sizeof found) == 0) return status;
    return cli_fail(CLI_USAGE, "'%s': its first %lld rows were changed since the checkpoint",
                    writer->path, rows);
}

int writer_continue(trajectory_writer *writer, long long rows, const row_sum *sum)
{
    size_t written;
    writer->rows = rows;
    writer->sum = *sum;
    const off_t end = rows > 0 ? place_of(writer, rows) : 0;
    npy_set_rows(&writer->header, rows);
    if (ftruncate(writer->descriptor, end) != 0 ||
        !write_at(writer->descriptor, writer->header.text, writer->header.length, 0, &written))
        return failed(writer);
    return CLI_DONE;
}

/* ---- either -------------------------------------------------------------------------------- */

int writer_create(trajectory_writer *writer, const char *path, char *const *names, int columns)
{
    const int is_stdout = strcmp(path, "-") == 0;
    *writer = (trajectory_writer){.columns = columns};
    if (cli_ends_in(path, ".npy")) {
        const int descriptor = open(path, O_RDWR | O_CREAT | O_TRUNC, 0666);
        if (descriptor < 0) return cli_io("write", path);
        writer_attach(writer, path, descriptor, names, columns);
        return writer_continue(writer, 0, &(row_sum){{0}});
    }
    writer->path = is_stdout ? "standard output" : path;
    writer->file = is_stdout ? stdout : fopen(path, "wb");
    if (!writer->file) return cli_io("write", path);
    for (int i = 0; i < columns; i++) {
        if (i) fputc(',', writer->file);
        cli_put_text(writer->file, names[i]);
    }
    fputc('\n', writer->file);
    return ferror(writer->file) ? failed(writer) : CLI_DONE;
}

int writer_append(trajectory_writer *writer, const double *values)
{
    if (!writer->file) {
        unsigned char *place = writer->buffer + (size_t)writer->pending * row_bytes(writer);
        npy_encode(place, values, writer->columns);
        return ++writer->pending < writer->capacity ? CLI_DONE : flush(writer);
    }
    for (int i = 0; i < writer->columns; i++) {
        if (i) fputc(',', writer->file);
        cli_put(writer->file, values[i]);
    }
    fputc('\n', writer->file);
    if (ferror(writer->file)) return failed(writer);
    writer->rows++;
    return CLI_DONE;
}

int writer_sync(trajectory_writer *writer, int sync)
{
    if (writer->file) return fflush(writer->file) == 0 ? CLI_DONE : failed(writer);
    if (flush(writer) != CLI_DONE) return CLI_IO;
    if (sync && fsync(writer->descriptor) != 0) return failed(writer);
    return write_rows_number(writer) ? CLI_DONE : failed(writer);
}

int writer_close(trajectory_writer *writer)
{
    FILE *file = writer->file;
    writer->file = NULL;
    if (file && !writer->failed) return cli_close(file, writer->path);
    /* A failure was printed already; cli_close would print it again. */
    if (file && file != stdout) fclose(file);
    if (file) return CLI_IO;
    if (!writer->buffer) return CLI_DONE;
    const int has_begun = writer->rows >= 0 && !writer->failed;
    if (has_begun && flush(writer) == CLI_DONE && !write_rows_number(writer)) failed(writer);
    if (close(writer->descriptor) != 0 && !writer->failed) failed(writer);
    free(writer->header.text);
    free(writer->buffer);
    writer->buffer = NULL;
    return writer->failed ? CLI_IO : CLI_DONE;
}
