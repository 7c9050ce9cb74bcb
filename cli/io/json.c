/* json.c - the JSON that the program writes, and reads of its own files. */
#include "json.h"
#include "dalembert.h"
#include "output.h"
#include "ui/memory.h"
#include "ui/message.h"

#include "file.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- writing ------------------------------------------------------------------------------- */

/* Well-formed UTF-8 beyond ASCII (The Unicode Standard, table 3-7): the first byte, the second, and
 * bytes 80..BF up to the length. */
static const struct {
    unsigned char first, last, low, high, length;
} forms[] = {{0xc2, 0xdf, 0x80, 0xbf, 2}, {0xe0, 0xe0, 0xa0, 0xbf, 3}, {0xe1, 0xec, 0x80, 0xbf, 3},
             {0xed, 0xed, 0x80, 0x9f, 3}, {0xee, 0xef, 0x80, 0xbf, 3}, {0xf0, 0xf0, 0x90, 0xbf, 4},
             {0xf1, 0xf3, 0x80, 0xbf, 4}, {0xf4, 0xf4, 0x80, 0x8f, 4}};

enum { FORMS = sizeof forms / sizeof forms[0] };

static bool is_continuation(unsigned char c) { return (c & 0xc0) == 0x80; }

/* The bytes of the character that begins here; 0: none does. */
static int length_of(const unsigned char *s)
{
    if (s[0] < 0x80) return 1;
    for (int i = 0; i < FORMS; i++) {
        if (s[0] < forms[i].first || s[0] > forms[i].last) continue;
        if (s[1] < forms[i].low || s[1] > forms[i].high) return 0;
        for (int k = 2; k < forms[i].length; k++)
            if (!is_continuation(s[k])) return 0;
        return forms[i].length;
    }
    return 0;
}

/* The code of a character of at most three bytes, as \uXXXX has it. */
static unsigned code_of(const unsigned char *s, int length)
{
    if (length == 1) return s[0];
    if (length == 2) return (s[0] & 0x1fu) << 6 | (s[1] & 0x3fu);
    return (s[0] & 0x0fu) << 12 | (s[1] & 0x3fu) << 6 | (s[2] & 0x3fu);
}

/* Controls, line ends (U+2028, U+2029), the mark of byte order and what is no character. */
static bool is_escaped(unsigned code)
{
    return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x2028 || code == 0x2029 ||
           code == 0xfeff || code >= 0xfffe;
}

void json_text(FILE *out, const char *text)
{
    fputc('"', out);
    for (const unsigned char *s = (const unsigned char *)text; *s;) {
        const int length = length_of(s);
        if (length == 0)
            fputs("\\ufffd", out);
        else if (*s == '"' || *s == '\\')
            fprintf(out, "\\%c", *s);
        else if (length < 4 && is_escaped(code_of(s, length)))
            fprintf(out, "\\u%04x", code_of(s, length));
        else
            fwrite(s, 1, (size_t)length, out);
        s += length ? length : 1;
    }
    fputc('"', out);
}

void json_number(FILE *out, double x)
{
    if (isfinite(x))
        cli_put(out, x);
    else
        fputs("null", out);
}

static void put_name(FILE *out, const char *before, const char *name)
{
    fputs(before, out);
    json_text(out, name);
    fputs(": ", out);
}

void json_text_member(FILE *out, const char *before, const char *name, const char *text)
{
    put_name(out, before, name);
    json_text(out, text);
}

void json_number_member(FILE *out, const char *before, const char *name, double x)
{
    put_name(out, before, name);
    json_number(out, x);
}

/* RFC 8259: -? (0 | [1-9][0-9]*) (. [0-9]+)? ([eE] [+-]? [0-9]+)? */
static bool is_number(const char *text)
{
    static const char digits[] = "0123456789";
    const char *s = text + (*text == '-');
    size_t n = strspn(s, digits);
    if (n == 0 || (n > 1 && *s == '0')) return 0;
    s += n;
    if (*s == '.') {
        n = strspn(++s, digits);
        if (n == 0) return 0;
        s += n;
    }
    if (*s == 'e' || *s == 'E') {
        s++;
        s += *s == '+' || *s == '-';
        n = strspn(s, digits);
        if (n == 0) return 0;
        s += n;
    }
    return *s == '\0';
}

void json_given_member(FILE *out, const char *before, const char *name, const char *number)
{
    double x = NAN;
    put_name(out, before, name);
    if (is_number(number))
        fputs(number, out);
    else if (dal_parse_number(number, strlen(number), &x) == DAL_OK)
        json_number(out, x);
    else
        json_text(out, number);
}

/* ---- reading ------------------------------------------------------------------------------- */

int json_parse(document *doc, const char *place, const char *bytes, size_t length)
{
    const int status = document_parse(doc, place, bytes, length);
    if (status != CLI_DONE) return status;
    const yaml_node_t *root = yaml_document_get_root_node(&doc->yaml);
    if (root->type == YAML_MAPPING_NODE) return CLI_DONE;
    return document_fail(doc, root, "an object is wanted");
}

/* The marks of libyaml count characters. */
static size_t byte_of(const char *bytes, size_t character)
{
    size_t i = 0;
    for (; bytes[i]; i++) {
        if (is_continuation((unsigned char)bytes[i])) continue;
        if (character-- == 0) break;
    }
    return i;
}

char *json_source(const char *bytes, const yaml_node_t *value)
{
    const size_t begin = byte_of(bytes, value->start_mark.index);
    return cli_strndup(bytes + begin, byte_of(bytes, value->end_mark.index) - begin);
}

static char *find_text(const char *path, const char *bytes, size_t length, const char *name)
{
    document doc = {0};
    char *copy = NULL;
    if (json_parse(&doc, path, bytes, length) == CLI_DONE) {
        const yaml_node_t *root = yaml_document_get_root_node(&doc.yaml);
        const yaml_node_t *node = document_value(&doc, root, name);
        const char *value = node ? document_scalar(&doc, node, name) : NULL;
        if (value) copy = cli_strdup(value);
    }
    yaml_document_delete(&doc.yaml);
    return copy;
}

char *json_file_text(const char *path, const char *name)
{
    size_t length;
    if (access(path, F_OK) != 0) return NULL;
    char *bytes = file_read(path, &length);
    char *text = bytes ? find_text(path, bytes, length, name) : NULL;
    free(bytes);
    return text;
}
