/* trajectory.c - rows of doubles as CSV or .npy, and back.
 *
 * A .npy file, as numpy.lib.format has it:
 *
 *     "\x93NUMPY" 1 0, the length of the text as 16 bits, or 2 0 and 32 bits where that is too few
 *     {'descr': [('t', '<f8'), ("x'", '<f8')], 'fortran_order': False,       , blanks
 *     'shape': (3,), }                                                       , blanks, end of line
 *     3 rows of two little-endian doubles
 *
 * The last line of the header is 64 bytes long and begins at a multiple of 64, so that the number
 * of rows is replaced by one write within one sector and is the old or the new one at any moment.
 * Rows are collected and written many at a time, and the header gets their number afterwards: the
 * file can be read whatever ends the process.  Rows after that number are not read.
 *
 * The sum of rows takes word number i, 64 bits, into lane i mod 4,
 *
 *     s <- (rotate(s, 23) xor word) K,
 *
 * with K odd, so that a change of any one word changes it; the four lanes are independent. */
#include "trajectory.h"
#include "csv_cells.h"
#include "endian.h"
#include "file.h"
#include "file_output.h"
#include "text.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BUFFER_BYTES = 1 << 20, NPY_LINE = 64, PREFIX_1 = 10, PREFIX_2 = 12, MAX_LENGTH_1 = 65535 };

static const char magic[] = "\x93NUMPY";
enum { MAGIC = sizeof magic - 1 };

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

/* Adds count words, after the words before. */
static void add_words(row_sum *sum, long long before, const unsigned char *bytes, long long count)
{
    long long i = 0;
    for (; i < count && (before + i) % ROW_SUM_LANES; i++)
        add_word(sum, before + i, bytes + i * WORD);
    const long long rounds = (count - i) / ROW_SUM_LANES;
    add_rounds(sum, bytes + i * WORD, rounds);
    for (i += rounds * ROW_SUM_LANES; i < count; i++) add_word(sum, before + i, bytes + i * WORD);
}

/* ---- the header of .npy -------------------------------------------------------------------- */

/* Writes the last line. */
static void set_shape(char *line, const char *shape)
{
    const int n = snprintf(line, NPY_LINE, "'shape': %s, }", shape);
    memset(line + n, ' ', (size_t)(NPY_LINE - n));
    line[NPY_LINE - 1] = '\n';
}

static void set_rows(trajectory_writer *writer, long long rows)
{
    char shape[32];
    snprintf(shape, sizeof shape, "(%lld,)", rows);
    set_shape(writer->header + writer->header_length - NPY_LINE, shape);
}

char *npy_make_header(char *const *names, int columns, const char *shape, size_t *size)
{
    char *text;
    size_t length, prefix = PREFIX_1;
    FILE *out = cli_memstream_open(&text, &length);
    fputs("{'descr': [", out);
    for (int i = 0; i < columns; i++) {
        const char quote = strchr(names[i], '\'') ? '"' : '\'';
        fprintf(out, "%s(%c%s%c, '<f8')", i ? ", " : "", quote, names[i], quote);
    }
    fputs("], 'fortran_order': False,", out);
    cli_memstream_close(out);
    if ((prefix + length + 2 * NPY_LINE - 1) / NPY_LINE * NPY_LINE - prefix > MAX_LENGTH_1)
        prefix = PREFIX_2;
    *size = (prefix + length + 2 * NPY_LINE - 1) / NPY_LINE * NPY_LINE;
    char *header = cli_malloc(*size);
    memset(header, ' ', *size);
    memcpy(header, magic, MAGIC);
    header[MAGIC] = prefix == PREFIX_1 ? 1 : 2;
    header[MAGIC + 1] = 0;
    for (size_t i = MAGIC + 2; i < prefix; i++)
        header[i] = (char)((*size - prefix) >> 8 * (i - MAGIC - 2) & 0xff);
    memcpy(header + prefix, text, length);
    set_shape(header + *size - NPY_LINE, shape);
    free(text);
    return header;
}

static void make_header(trajectory_writer *writer, char *const *names)
{
    writer->header = npy_make_header(names, writer->columns, "(0,)", &writer->header_length);
}

/* Reads the text of the header, allocated, and where the rows begin; NULL unless the file is long
 * enough for it. */
static char *read_header_text(FILE *file, size_t size, size_t *offset)
{
    unsigned char prefix[PREFIX_2];
    size_t length = 0;
    if (fread(prefix, 1, PREFIX_1, file) != PREFIX_1 || memcmp(prefix, magic, MAGIC) != 0)
        return NULL;
    *offset = prefix[MAGIC] == 1 ? PREFIX_1 : PREFIX_2;
    if (fread(prefix + PREFIX_1, 1, *offset - PREFIX_1, file) != *offset - PREFIX_1) return NULL;
    for (size_t i = *offset; i > MAGIC + 2; i--) length = length << 8 | prefix[i - 1];
    if (length > size - *offset) return NULL;
    char *text = cli_malloc(length + 1);
    text[fread(text, 1, length, file)] = '\0';
    *offset += length;
    return text;
}

/* Parses ('NAME', '<f8') at *at, moves *at past it and ends the name with a NUL. */
static char *parse_name(char **at)
{
    static const char type[] = ", '<f8')";
    char *open = strchr(*at, '(');
    char *name = open && (open[1] == '\'' || open[1] == '"') ? open + 2 : NULL;
    char *end = name ? strchr(name, open[1]) : NULL;
    if (!end || strncmp(end + 1, type, sizeof type - 1) != 0) return NULL;
    *end = '\0';
    *at = end + sizeof type;
    return name;
}

/* The names are moved to the beginning of the text, for name[0] to own it. */
static bool parse_header(trajectory_reader *r, char *text)
{
    static const char begin[] = "{'descr': [", end[] = "], 'fortran_order': False,";
    size_t max = 1;
    if (strncmp(text, begin, sizeof begin - 1) != 0) return false;
    for (const char *p = text; *p; p++) max += *p == '(';
    r->name = cli_calloc(max, sizeof *r->name);
    char *at = text + sizeof begin - 1, *to = text;
    while (*at != ']') {
        char *name = parse_name(&at);
        if (!name) return false;
        r->name[r->columns++] = memmove(to, name, strlen(name) + 1);
        to += strlen(to) + 1;
        if (*at == ',') at++;
    }
    if (!r->columns || strncmp(at, end, sizeof end - 1) != 0) return false;
    at = strstr(at, "'shape': (");
    return at && sscanf(at, "'shape': (%lld,)", &r->count) == 1 && r->count >= 0;
}

static int read_header(trajectory_reader *r)
{
    struct stat status;
    if (fstat(fileno(r->file), &status) != 0) return cli_io("read", r->path);
    const size_t size = (size_t)status.st_size;
    char *text = read_header_text(r->file, size, &r->offset);
    const bool is_header = text && parse_header(r, text);
    if (r->columns == 0) free(text);
    if (ferror(r->file)) return cli_io("read", r->path);
    if (!is_header) return cli_fail(CLI_USAGE, "'%s' is no .npy file of named doubles", r->path);
    for (int i = 0; i < r->columns; i++) {
        const long control = text_find_control(r->name[i], "");
        if (control >= 0)
            return cli_fail(CLI_USAGE,
                            "'%s': the name of column %d has the control character U+%04lX",
                            r->path, i + 1, (unsigned long)control);
    }
    if ((size - r->offset) / WORD / (size_t)r->columns >= (size_t)r->count) return CLI_DONE;
    return cli_fail(CLI_IO, "'%s' has fewer rows than its header states", r->path);
}

static int failed(trajectory_writer *writer)
{
    writer->failed = true;
    return cli_io("write", writer->path);
}

/* ---- writing .npy -------------------------------------------------------------------------- */

static size_t row_bytes(const trajectory_writer *writer) { return (size_t)writer->columns * WORD; }

static off_t place_of(const trajectory_writer *writer, long long row)
{
    return (off_t)(writer->header_length + (size_t)row * row_bytes(writer));
}

/* Writes the number of rows into the last line of the header, which alone changes. */
static bool write_rows_number(trajectory_writer *writer)
{
    const size_t place = writer->header_length - NPY_LINE;
    set_rows(writer, writer->rows);
    return file_transfer(writer->descriptor, writer->header + place, NPY_LINE, (off_t)place,
                         FILE_WRITE) == NPY_LINE;
}

/* Writes the pending rows.  Of a write that fails the whole rows count. */
static int flush(trajectory_writer *writer)
{
    const size_t length = (size_t)writer->pending * row_bytes(writer);
    const size_t written = file_transfer(writer->descriptor, writer->buffer, length,
                                         place_of(writer, writer->rows), FILE_WRITE);
    const int reason = errno;
    const long long whole = (long long)(written / row_bytes(writer));
    add_words(&writer->sum, writer->rows * writer->columns, writer->buffer,
              whole * writer->columns);
    writer->rows += whole;
    writer->pending = 0;
    if (written == length) return CLI_DONE;
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
    make_header(writer, names);
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
    const size_t length = writer->header_length - NPY_LINE;
    char *text = cli_malloc(length);
    const bool is_same = pread(writer->descriptor, text, length, 0) == (ssize_t)length &&
                         memcmp(text, writer->header, length) == 0;
    free(text);
    if (!is_same) return cli_fail(CLI_USAGE, "'%s': its columns are not the run's", writer->path);
    const int status = sum_rows(writer, rows, &found);
    if (status != CLI_DONE || memcmp(&found, sum, sizeof found) == 0) return status;
    return cli_fail(CLI_USAGE, "'%s': its first %lld rows were changed since the checkpoint",
                    writer->path, rows);
}

int writer_continue(trajectory_writer *writer, long long rows, const row_sum *sum)
{
    writer->rows = rows;
    writer->sum = *sum;
    const off_t end = rows > 0 ? place_of(writer, rows) : 0;
    set_rows(writer, rows);
    if (ftruncate(writer->descriptor, end) != 0 ||
        file_transfer(writer->descriptor, writer->header, writer->header_length, 0, FILE_WRITE) <
            writer->header_length)
        return failed(writer);
    return CLI_DONE;
}

/* ---- writing either ------------------------------------------------------------------------ */

int writer_create(trajectory_writer *writer, const char *path, char *const *names, int columns)
{
    const bool is_stdout = strcmp(path, "-") == 0;
    *writer = (trajectory_writer){.columns = columns};
    if (cli_ends_in(path, ".npy")) {
        int descriptor;
        const int status = file_open_output(path, &descriptor);
        if (status != CLI_DONE) return status;
        writer_attach(writer, path, descriptor, names, columns);
        return writer_continue(writer, 0, &(row_sum){{0}});
    }
    writer->path = is_stdout ? "standard output" : path;
    const int status = file_stream_output(path, &writer->file);
    if (status != CLI_DONE) return status;
    for (int i = 0; i < columns; i++) {
        if (i) fputc(',', writer->file);
        csv_put_text(writer->file, names[i]);
    }
    fputc('\n', writer->file);
    return ferror(writer->file) ? failed(writer) : CLI_DONE;
}

int writer_append(trajectory_writer *writer, const double *values)
{
    if (!writer->file) {
        unsigned char *place = writer->buffer + (size_t)writer->pending * row_bytes(writer);
        /* Zero has no sign in the file and not a number one form: equal runs give equal files. */
        for (int i = 0; i < writer->columns; i++)
            write_le_double(place + WORD * i, isnan(values[i]) ? (double)NAN : values[i] + 0.0);
        return ++writer->pending < writer->capacity ? CLI_DONE : flush(writer);
    }
    for (int i = 0; i < writer->columns; i++) {
        if (i) fputc(',', writer->file);
        csv_put(writer->file, values[i]);
    }
    fputc('\n', writer->file);
    if (ferror(writer->file)) return failed(writer);
    writer->rows++;
    return CLI_DONE;
}

int writer_sync(trajectory_writer *writer, file_sync sync)
{
    if (flush(writer) != CLI_DONE) return CLI_IO;
    if (sync == FILE_SYNCED && fsync(writer->descriptor) != 0) return failed(writer);
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
    const bool has_begun = writer->rows >= 0 && !writer->failed;
    if (has_begun && flush(writer) == CLI_DONE && !write_rows_number(writer)) failed(writer);
    if (close(writer->descriptor) != 0 && !writer->failed) failed(writer);
    free(writer->header);
    free(writer->buffer);
    writer->buffer = NULL;
    return writer->failed ? CLI_IO : CLI_DONE;
}

/* ---- reading ------------------------------------------------------------------------------- */

int reader_open(trajectory_reader *reader, const char *directory)
{
    static const char name[] = "trajectory.npy";
    *reader = (trajectory_reader){.path = cli_join(directory, name)};
    reader->file = fopen(reader->path, "rb");
    int status = CLI_DONE;
    if (reader->file)
        status = read_header(reader);
    else if (errno == ENOENT || errno == ENOTDIR)
        status = cli_fail(CLI_USAGE, "'%s' holds no run: there is no %s", directory, name);
    else
        status = cli_io("read", reader->path);
    if (status != CLI_DONE) {
        reader_close(reader);
        return status;
    }
    reader->bytes = cli_calloc((size_t)reader->columns, WORD);
    reader->row = cli_calloc((size_t)reader->columns, sizeof *reader->row);
    return CLI_DONE;
}

static bool read_row(trajectory_reader *reader)
{
    const size_t length = (size_t)reader->columns * WORD;
    if (fread(reader->bytes, 1, length, reader->file) != length) return false;
    for (int i = 0; i < reader->columns; i++)
        reader->row[i] = read_le_double(reader->bytes + WORD * i);
    return true;
}

int reader_next(trajectory_reader *reader)
{
    if (reader->next >= reader->count) return 0;
    reader->next++;
    errno = EIO; /* of a file that was cut since its header was read */
    if (read_row(reader)) return 1;
    cli_io("read", reader->path);
    return -1;
}

int reader_peek_last(trajectory_reader *reader)
{
    const off_t place = ftello(reader->file),
                last = (off_t)reader->offset + (off_t)(reader->count - 1) * reader->columns * WORD;
    errno = EIO; /* of a file that was cut */
    const bool is_read = place >= 0 && fseeko(reader->file, last, SEEK_SET) == 0 &&
                         read_row(reader) && fseeko(reader->file, place, SEEK_SET) == 0;
    return is_read ? CLI_DONE : cli_io("read", reader->path);
}

void reader_close(trajectory_reader *reader)
{
    if (reader->file) fclose(reader->file);
    if (reader->columns) free(reader->name[0]);
    free(reader->name);
    free(reader->row);
    free(reader->bytes);
    free(reader->path);
    *reader = (trajectory_reader){0};
}
