/* npy.c - arrays of named doubles in a file of numpy.
 *
 *     "\x93NUMPY" 1 0, the length of the text as 16 bits, or 2 0 and 32 bits where that is too few
 *     {'descr': [('t', '<f8'), ("x'", '<f8')], 'fortran_order': False,       , blanks
 *     'shape': (3,), }                                                       , blanks, end of line
 *     3 rows of two little-endian doubles
 *
 * as numpy.lib.format has it.  The last line of the header is 64 bytes long and begins at a
 * multiple of 64, so that the number of rows is replaced by one write within one sector and is the
 * old one or the new one at any moment.  Rows behind that number are not read. */
#include "npy.h"
#include "endian.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { PREFIX_1 = 10, PREFIX_2 = 12, MAX_LENGTH_1 = 65535 };

static const char magic[] = "\x93NUMPY";
enum { MAGIC = sizeof magic - 1 };

/* ---- writing ------------------------------------------------------------------------------- */

void npy_make_header(npy_header *header, char *const *names, int columns)
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
    const size_t size = (prefix + length + 2 * NPY_LINE - 1) / NPY_LINE * NPY_LINE;
    *header = (npy_header){cli_malloc(size), size};
    memset(header->text, ' ', size);
    memcpy(header->text, magic, MAGIC);
    header->text[MAGIC] = prefix == PREFIX_1 ? 1 : 2;
    header->text[MAGIC + 1] = 0;
    for (size_t i = MAGIC + 2; i < prefix; i++)
        header->text[i] = (char)((size - prefix) >> 8 * (i - MAGIC - 2) & 0xff);
    memcpy(header->text + prefix, text, length);
    npy_set_rows(header, 0);
    free(text);
}

void npy_set_rows(npy_header *header, long long rows)
{
    char *line = header->text + header->length - NPY_LINE;
    const int n = snprintf(line, NPY_LINE, "'shape': (%lld,), }", rows);
    memset(line + n, ' ', (size_t)(NPY_LINE - n));
    line[NPY_LINE - 1] = '\n';
}

void npy_encode(unsigned char *bytes, const double *values, int count)
{
    for (int i = 0; i < count; i++) {
        const double x = isnan(values[i]) ? (double)NAN : values[i] + 0.0;
        uint64_t bits;
        memcpy(&bits, &x, sizeof bits);
        write_le64(bytes + WORD * i, bits);
    }
}

/* ---- reading ------------------------------------------------------------------------------- */

void npy_decode(const unsigned char *bytes, double *values, int count)
{
    for (int i = 0; i < count; i++) {
        const uint64_t bits = read_le64(bytes + WORD * i);
        memcpy(&values[i], &bits, sizeof bits);
    }
}

/* The text of the header, allocated, and where it ends; NULL unless the file is long enough for
 * it. */
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

/* Parses ('NAME', '<f8') at *at, moves *at behind it and ends the name with a NUL. */
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

/* The names are moved to the beginning of the text, for names[0] to own it. */
static int parse_header(npy_columns *c, char *text)
{
    static const char begin[] = "{'descr': [", end[] = "], 'fortran_order': False,";
    size_t max = 1;
    if (strncmp(text, begin, sizeof begin - 1) != 0) return 0;
    for (const char *p = text; *p; p++) max += *p == '(';
    c->names = cli_calloc(max, sizeof *c->names);
    char *at = text + sizeof begin - 1, *to = text;
    while (*at != ']') {
        char *name = parse_name(&at);
        if (!name) return 0;
        c->names[c->columns++] = memmove(to, name, strlen(name) + 1);
        to += strlen(to) + 1;
        if (*at == ',') at++;
    }
    if (!c->columns || strncmp(at, end, sizeof end - 1) != 0) return 0;
    at = strstr(at, "'shape': (");
    return at && sscanf(at, "'shape': (%lld,)", &c->rows) == 1 && c->rows >= 0;
}

int npy_read_header(npy_columns *columns, FILE *file, const char *path)
{
    struct stat status;
    *columns = (npy_columns){0};
    if (fstat(fileno(file), &status) != 0) return cli_io("read", path);
    const size_t size = (size_t)status.st_size;
    char *text = read_header_text(file, size, &columns->offset);
    if (ferror(file)) {
        free(text);
        return cli_io("read", path);
    }
    if (!text || !parse_header(columns, text)) {
        if (columns->columns == 0) free(text);
        npy_free_columns(columns);
        return cli_fail(CLI_USAGE, "'%s' is no .npy file of named doubles", path);
    }
    if ((size - columns->offset) / WORD / (size_t)columns->columns >= (size_t)columns->rows)
        return CLI_DONE;
    npy_free_columns(columns);
    return cli_fail(CLI_IO, "'%s' has fewer rows than its header states", path);
}

void npy_free_columns(npy_columns *columns)
{
    if (columns->columns) free(columns->names[0]);
    free(columns->names);
    *columns = (npy_columns){0};
}
