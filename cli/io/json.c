/* json.c - the JSON that the program writes, and reads of its own files. */
#include "json.h"
#include "dalembert.h"
#include "dalembert_program.h"
#include "ui/memory.h"
#include "ui/message.h"

#include "file.h"
#include "text.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* ---- writing ------------------------------------------------------------------------------- */

/* Controls, line ends (U+2028, U+2029), the mark of byte order and what is no character. */
static bool is_escaped(long code)
{
    return text_is_control(code) || code == 0x2028 || code == 0x2029 || code == 0xfeff ||
           code == 0xfffe || code == 0xffff;
}

static void put_text(const json_writer *w, const char *text)
{
    FILE *out = w->out;
    long code;
    if (!text) {
        fputs("null", out);
        return;
    }
    fputc('"', out);
    while (*text) {
        const int length = text_read_character(text, &code);
        if (length == 0)
            fputs("\\ufffd", out);
        else if (code == '"' || code == '\\')
            fprintf(out, "\\%c", *text);
        else if (is_escaped(code) || (code == '<' && w->is_in_page))
            fprintf(out, "\\u%04lx", (unsigned long)code);
        else
            fwrite(text, 1, (size_t)length, out);
        text += length ? length : 1;
    }
    fputc('"', out);
}

/* What goes between two members, and before the first and after the last on lines of their own. */
static void put_gap(const json_writer *w, int depth)
{
    if (w->depth <= w->lines)
        fprintf(w->out, "\n%*s", w->is_in_page ? 0 : 2 * depth, "");
    else if (!w->is_empty && depth == w->depth && !w->is_in_page)
        fputc(' ', w->out);
}

static bool is_list(const json_writer *w) { return w->lists >> w->depth & 1u; }

FILE *json_put_name(json_writer *w, const char *name)
{
    if (!name && !is_list(w)) return w->out;
    if (!w->is_empty) fputc(',', w->out);
    put_gap(w, w->depth);
    if (name) {
        put_text(w, name);
        fputs(w->is_in_page ? ":" : ": ", w->out);
    }
    w->is_empty = false;
    return w->out;
}

static void open_level(json_writer *w, const char *name, json_layout layout, char bracket)
{
    fputc(bracket, json_put_name(w, name));
    w->depth++;
    w->lists = (w->lists & ~(1u << w->depth)) | (unsigned)(bracket == '[') << w->depth;
    if (layout == JSON_LINES) w->lines = w->depth;
    w->is_empty = true;
}

void json_open(json_writer *w, const char *name, json_layout layout)
{
    open_level(w, name, layout, '{');
}

void json_open_list(json_writer *w, const char *name, json_layout layout)
{
    open_level(w, name, layout, '[');
}

void json_close(json_writer *w)
{
    const char end = is_list(w) ? ']' : '}';
    if (!w->is_empty) put_gap(w, w->depth - 1);
    if (w->lines == w->depth) w->lines--;
    w->lists &= ~(1u << w->depth);
    w->depth--;
    w->is_empty = false;
    fputc(end, w->out);
}

void json_put_text(json_writer *w, const char *name, const char *text)
{
    json_put_name(w, name);
    put_text(w, text);
}

void json_put_bool(json_writer *w, const char *name, bool flag)
{
    fputs(flag ? "true" : "false", json_put_name(w, name));
}

/* Zero has no sign.  All doubles keep 15 digits, except the ones so small that they have fewer. */
const char *json_format_number(char text[JSON_NUMBER], double x)
{
    double read = NAN;
    strcpy(text, "null");
    for (int digits = fabs(x) < DBL_MIN ? 1 : DBL_DIG; isfinite(x) && read != x; digits++) {
        const int length = snprintf(text, JSON_NUMBER, "%.*g", digits, x + 0.0);
        dal__parse_number(text, (size_t)length, &read);
    }
    return text;
}

void json_put_number(json_writer *w, const char *name, double x)
{
    char text[JSON_NUMBER];
    fputs(json_format_number(text, x), json_put_name(w, name));
}

void json_put_rounded(json_writer *w, const char *name, double x)
{
    FILE *out = json_put_name(w, name);
    if (isfinite(x))
        fprintf(out, "%.9g", x);
    else
        fputs("null", out);
}

void json_put_numbers(json_writer *w, const char *name, const double *x, long long count)
{
    json_open_list(w, name, JSON_ON_ONE_LINE);
    for (long long i = 0; i < count; i++) json_put_number(w, NULL, x[i]);
    json_close(w);
}

void json_put_integer(json_writer *w, const char *name, long long x)
{
    fprintf(json_put_name(w, name), "%lld", x);
}

void json_put_source(json_writer *w, const char *name, const char *source)
{
    fputs(source, json_put_name(w, name));
}

/* RFC 8259: -? (0 | [1-9][0-9]*) (. [0-9]+)? ([eE] [+-]? [0-9]+)?  The length of the number that
 * begins here; 0: none does. */
static size_t number_length(const char *text)
{
    static const char digits[] = "0123456789";
    const char *s = text + (*text == '-');
    size_t n = *s == '0' ? 1 : strspn(s, digits);
    if (n == 0) return 0;
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
    return (size_t)(s - text);
}

void json_put_given(json_writer *w, const char *name, const char *number)
{
    double x = NAN;
    const size_t length = number_length(number);
    if (length > 0 && !number[length])
        json_put_source(w, name, number);
    else if (dal__parse_number(number, strlen(number), &x) == DAL_STATUS_OK)
        json_put_number(w, name, x);
    else
        json_put_text(w, name, number);
}

json_writer json_begin_results_in(FILE *out, const char *command)
{
    json_writer w = {.out = out};
    char *schema = cli_format("dalembert/%s/1", command);
    json_open(&w, NULL, JSON_LINES);
    json_put_text(&w, "schema", schema);
    json_put_text(&w, "dalembert", DAL_VERSION);
    free(schema);
    return w;
}

json_writer json_begin_results(const char *command)
{
    return json_begin_results_in(stdout, command);
}

void json_end_results(json_writer *w)
{
    json_close(w);
    fputc('\n', w->out);
}

/* ---- reading ------------------------------------------------------------------------------- */

typedef struct json_reader {
    document *doc;
    const char *text, *at;
    size_t line;            /* of what is at `at`, from 0 */
    const char *line_start; /* of that line */
    int depth;
} json_reader;

static yaml_mark_t mark(const json_reader *r)
{
    return (yaml_mark_t){(size_t)(r->at - r->text), r->line, (size_t)(r->at - r->line_start)};
}

/* Returns 0, which is no node. */
static int fail(const json_reader *r, const char *reason)
{
    const yaml_node_t here = {.start_mark = mark(r)};
    document_fail(r->doc, &here, "%s", reason);
    return 0;
}

static int added(int node)
{
    if (!node) cli_out_of_memory();
    return node;
}

static void skip_space(json_reader *r)
{
    for (; *r->at && strchr(" \t\r\n", *r->at); r->at++)
        if (*r->at == '\n') {
            r->line++;
            r->line_start = r->at + 1;
        }
}

/* The code of a \uXXXX that begins here, or -1. */
static long parse_escape(const char *s)
{
    unsigned code;
    if (s[0] != '\\' || s[1] != 'u' || strspn(s + 2, "0123456789abcdefABCDEF") < 4) return -1;
    return sscanf(s + 2, "%4x", &code) == 1 ? (long)code : -1;
}

/* Reads an escape; half of a surrogate pair is no character. */
static long read_escape(json_reader *r)
{
    static const char short_form[] = "\"\\/bfnrt", meaning[] = "\"\\/\b\f\n\r\t";
    const char *found = r->at[1] ? strchr(short_form, r->at[1]) : NULL;
    const long code = found ? meaning[found - short_form] : parse_escape(r->at);
    if (code < 0) return code;
    r->at += found ? 2 : 6;
    if (code < 0xd800 || code > 0xdfff) return code;
    const long low = parse_escape(r->at);
    if (code > 0xdbff || low < 0xdc00 || low > 0xdfff) return 0xfffd;
    r->at += 6;
    return 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
}

static char *put_code(char *to, long code)
{
    static const unsigned char lead[] = {0, 0, 0xc0, 0xe0, 0xf0};
    const int length = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    for (int i = length - 1; i > 0; i--, code >>= 6) to[i] = (char)(0x80 | (code & 0x3f));
    to[0] = (char)(lead[length] | code);
    return to + length;
}

/* A text in quotes; what is read is never longer than what is there. */
static int parse_text(json_reader *r)
{
    const char *end = ++r->at;
    while (*end && *end != '"') end += *end == '\\' && end[1] ? 2 : 1;
    char *text = cli_malloc((size_t)(end - r->at)), *to = text;
    long code = 0;
    while (code >= 0 && *r->at != '"') {
        const int length = text_read_character(r->at, &code);
        if (code == '\\')
            code = read_escape(r);
        else if (length == 0 || code < 0x20)
            code = -1;
        else
            r->at += length;
        if (code >= 0) to = put_code(to, code);
    }
    const int node =
        code < 0
            ? fail(r, "no JSON: the text does not go on so")
            : added(yaml_document_add_scalar(&r->doc->yaml, NULL, (yaml_char_t *)text,
                                             (int)(to - text), YAML_DOUBLE_QUOTED_SCALAR_STYLE));
    free(text);
    r->at += node != 0;
    return node;
}

/* A number, true, false or null. */
static int parse_word(json_reader *r)
{
    static const char *const words[] = {"true", "false", "null"};
    size_t length = number_length(r->at);
    for (int i = 0; i < 3; i++)
        if (strncmp(r->at, words[i], strlen(words[i])) == 0) length = strlen(words[i]);
    if (length == 0) return fail(r, "no JSON: a value is expected");
    r->at += length;
    return added(yaml_document_add_scalar(&r->doc->yaml, NULL, (const yaml_char_t *)r->at - length,
                                          (int)length, YAML_PLAIN_SCALAR_STYLE));
}

static int parse_value(json_reader *r);

/* "NAME": VALUE of an object, or a value of an array. */
static int parse_member(json_reader *r, int node, bool is_object)
{
    int key = 0;
    skip_space(r);
    if (is_object) {
        if (*r->at != '"') return fail(r, "no JSON: a name in quotes is expected");
        key = parse_value(r);
        if (!key) return 0;
        skip_space(r);
        if (*r->at != ':') return fail(r, "no JSON: a colon is expected");
        r->at++;
    }
    const int value = parse_value(r);
    if (!value) return 0;
    skip_space(r);
    return added(is_object ? yaml_document_append_mapping_pair(&r->doc->yaml, node, key, value)
                           : yaml_document_append_sequence_item(&r->doc->yaml, node, value));
}

/* An object or an array. */
static int parse_members(json_reader *r)
{
    const bool is_object = *r->at++ == '{';
    const char end = is_object ? '}' : ']';
    const int node = added(
        is_object ? yaml_document_add_mapping(&r->doc->yaml, NULL, YAML_FLOW_MAPPING_STYLE)
                  : yaml_document_add_sequence(&r->doc->yaml, NULL, YAML_FLOW_SEQUENCE_STYLE));
    if (++r->depth > DOCUMENT_DEPTH) return fail(r, "deeper than 32 levels");
    skip_space(r);
    if (*r->at != end) {
        if (!parse_member(r, node, is_object)) return 0;
        while (*r->at == ',') {
            r->at++;
            if (!parse_member(r, node, is_object)) return 0;
        }
    }
    if (*r->at != end) return fail(r, "no JSON: a comma or an end is expected");
    r->at++;
    r->depth--;
    return node;
}

static int parse_value(json_reader *r)
{
    skip_space(r);
    const yaml_mark_t start = mark(r);
    const int number = *r->at == '{' || *r->at == '[' ? parse_members(r)
                       : *r->at == '"'                ? parse_text(r)
                                                      : parse_word(r);
    yaml_node_t *node = document_node(r->doc, number);
    if (!node) return 0;
    node->start_mark = start;
    node->end_mark = mark(r);
    return number;
}

int json_parse(document *doc, const char *place, const char *bytes, size_t length)
{
    json_reader r = {.doc = doc, .text = bytes, .at = bytes, .line_start = bytes};
    doc->place = place;
    added(yaml_document_initialize(&doc->yaml, NULL, NULL, NULL, 1, 1));
    const int root = parse_value(&r);
    skip_space(&r);
    if (root && r.at != bytes + length) fail(&r, "no JSON: there is more after it");
    if (!root || r.at != bytes + length) return CLI_USAGE;
    const yaml_node_t *node = document_node(doc, root);
    if (node->type == YAML_MAPPING_NODE) return CLI_DONE;
    return document_fail(doc, node, "an object is required");
}

char *json_source(const char *bytes, const yaml_node_t *value)
{
    return cli_strndup(bytes + value->start_mark.index,
                       value->end_mark.index - value->start_mark.index);
}

int json_read(document *doc, const char *path, const char *place)
{
    size_t length;
    *doc = (document){.place = place};
    char *bytes = file_read(path, &length);
    const int status = bytes ? json_parse(doc, place, bytes, length) : CLI_IO;
    free(bytes);
    return status;
}

/* A file that may be absent, or hold no object, without a message.  The document is to be deleted
 * in any case. */
static int parse_file(document *doc, const char *path, bool *is_parsed)
{
    struct stat info;
    *is_parsed = false;
    if (stat(path, &info) != 0) return CLI_DONE;
    if (S_ISDIR(info.st_mode)) return cli_fail(CLI_USAGE, "'%s' is a directory", path);
    const int status = json_read(doc, path, NULL);
    *is_parsed = status == CLI_DONE;
    return status == CLI_IO ? CLI_IO : CLI_DONE;
}

const char *json_scalar(const document *doc, const yaml_node_t *object, const char *name)
{
    const yaml_node_t *node = document_value(doc, object, name);
    if (!node || node->type != YAML_SCALAR_NODE) return "";
    const char *text = (const char *)node->data.scalar.value;
    return strcmp(text, "null") == 0 ? "" : text;
}

const char *json_text(const document *doc, const char *name)
{
    const yaml_node_t *node = document_value(doc, document_node(doc, 1), name);
    return node ? document_scalar(doc, node, name) : NULL;
}

int json_file_text(const char *path, const char *name, char **text)
{
    document doc = {0};
    bool is_parsed;
    const int status = parse_file(&doc, path, &is_parsed);
    const char *value = is_parsed ? json_text(&doc, name) : NULL;
    *text = value ? cli_strdup(value) : NULL;
    yaml_document_delete(&doc.yaml);
    return status;
}

int json_file_find(const char *path, const char *name, bool *is_there)
{
    document doc = {0};
    const int status = parse_file(&doc, path, is_there);
    if (*is_there)
        *is_there = document_value(&doc, yaml_document_get_root_node(&doc.yaml), name) != NULL;
    yaml_document_delete(&doc.yaml);
    return status;
}
