/* test_json.c - the JSON of the program, read back by jansson and by the program itself. */
#include "io/json.h"
#include "ui/clock.h"

#include <CUnit/CUnit.h>
#include <fcntl.h>
#include <jansson.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- helpers ---- */

static uint64_t state;

static uint64_t draw(void)
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return state;
}

/* {"key": TEXT}, written by the program; allocated. */
static char *written(const char *text, size_t *length)
{
    char *bytes = NULL;
    FILE *out = open_memstream(&bytes, length);
    json_writer w = {.out = out};
    json_open(&w, NULL, JSON_ON_ONE_LINE);
    json_put_text(&w, "key", text);
    json_close(&w);
    fputc('\n', out);
    fclose(out);
    return bytes;
}

/* What jansson and the program read of it; allocated. */
static char *read_by_jansson(const char *bytes, size_t length)
{
    json_error_t error;
    json_t *root = json_loadb(bytes, length, 0, &error);
    const char *value = json_string_value(json_object_get(root, "key"));
    char *copy = value ? strdup(value) : NULL;
    json_decref(root);
    return copy;
}

static char *read_by_program(const char *bytes, size_t length)
{
    document doc = {0};
    char *copy = NULL;
    if (json_parse(&doc, "test", bytes, length) == CLI_DONE) {
        const yaml_node_t *root = yaml_document_get_root_node(&doc.yaml);
        const yaml_node_t *node = document_value(&doc, root, "key");
        copy = node ? strdup((const char *)node->data.scalar.value) : NULL;
    }
    yaml_document_delete(&doc.yaml);
    return copy;
}

static int is_read_as(const char *text, const char *expected)
{
    size_t length;
    char *bytes = written(text, &length);
    char *one = read_by_jansson(bytes, length), *other = read_by_program(bytes, length);
    const int same = one && other && strcmp(one, expected) == 0 && strcmp(other, expected) == 0;
    free(bytes);
    free(one);
    free(other);
    return same;
}

/* UTF-8 of a code (RFC 3629), with a NUL. */
static char *encode(char *to, unsigned long code)
{
    if (code < 0x80) {
        *to++ = (char)code;
    } else if (code < 0x800) {
        *to++ = (char)(0xc0 | code >> 6);
        *to++ = (char)(0x80 | (code & 0x3f));
    } else if (code < 0x10000) {
        *to++ = (char)(0xe0 | code >> 12);
        *to++ = (char)(0x80 | (code >> 6 & 0x3f));
        *to++ = (char)(0x80 | (code & 0x3f));
    } else {
        *to++ = (char)(0xf0 | code >> 18);
        *to++ = (char)(0x80 | (code >> 12 & 0x3f));
        *to++ = (char)(0x80 | (code >> 6 & 0x3f));
        *to++ = (char)(0x80 | (code & 0x3f));
    }
    *to = '\0';
    return to;
}

/* Messages of the program, which these tests provoke, are not shown. */
static int hide_messages(void)
{
    const int kept = dup(STDERR_FILENO), nothing = open("/dev/null", O_WRONLY);
    dup2(nothing, STDERR_FILENO);
    close(nothing);
    return kept;
}

static void show_messages(int kept)
{
    dup2(kept, STDERR_FILENO);
    close(kept);
}

/* ---- texts ---- */

static void test_every_character(void)
{
    enum { CHUNK = 500 };
    char text[4 * CHUNK + 8];
    for (unsigned long code = 1; code < 0x110000;) {
        char *to = text;
        const unsigned long first = code;
        for (int i = 0; i < CHUNK && code < 0x110000; i++, code++)
            if (code < 0xd800 || code > 0xdfff) to = encode(to, code);
        *to = '\0';
        if (is_read_as(text, text)) continue;
        printf("U+%04lx or one of those after it\n", first);
        CU_FAIL("a character is not read back");
        return;
    }
}

static void test_known_bytes(void)
{
    size_t length;
    char *bytes = written("Gr\xc3\xb6\xc3\x9f"
                          "e \xf0\x9d\x84\x9e \"\\/\t\x7f\xe2\x80\xa8\xef\xbb\xbf",
                          &length);
    CU_ASSERT_STRING_EQUAL(bytes, "{\"key\": \"Gr\xc3\xb6\xc3\x9f"
                                  "e \xf0\x9d\x84\x9e \\\"\\\\/\\u0009\\u007f\\u2028\\ufeff\"}\n");
    free(bytes);
}

/* Each byte that belongs to no character is U+FFFD: Latin-1, overlong forms, surrogates, characters
 * cut off, codes beyond U+10FFFF, bytes that never occur. */
static void test_not_utf8(void)
{
#define GAP "\xef\xbf\xbd"
    CU_ASSERT(is_read_as("caf\xe9", "caf" GAP));
    CU_ASSERT(is_read_as("\xe9t\xe9", GAP "t" GAP));
    CU_ASSERT(is_read_as("\xc0\x80 \xc1\xbf", GAP GAP " " GAP GAP));
    CU_ASSERT(is_read_as("\xe0\x9f\xbf|\xf0\x8f\xbf\xbf", GAP GAP GAP "|" GAP GAP GAP GAP));
    CU_ASSERT(is_read_as("\xed\xa0\x80x\xed\xbf\xbf", GAP GAP GAP "x" GAP GAP GAP));
    CU_ASSERT(is_read_as("\xf4\x90\x80\x80\xf5\xff\xfe", GAP GAP GAP GAP GAP GAP GAP));
    CU_ASSERT(is_read_as("\xf0\x9d\x84", GAP GAP GAP));
    CU_ASSERT(is_read_as("\xe2\x82"
                         "a\xc3",
                         GAP GAP "a" GAP));
    CU_ASSERT(is_read_as("\x80\xc3\xa9\xbf", GAP "\xc3\xa9" GAP));
#undef GAP
    state = 1;
    for (int i = 0; i < 20000; i++) {
        char text[24], *one, *other;
        size_t length;
        for (int k = 0; k < 23; k++) text[k] = (char)(draw() >> 20 | 1);
        text[23] = '\0';
        char *bytes = written(text, &length);
        one = read_by_jansson(bytes, length);
        other = read_by_program(bytes, length);
        CU_ASSERT_FATAL(one && other && strcmp(one, other) == 0);
        free(bytes);
        free(one);
        free(other);
    }
}

/* ---- numbers ---- */

/* The value of {"x": NUMBER}; NULL of jansson's is no number. */
static json_t *number_of(void (*put)(json_writer *writer, const void *number), const void *number)
{
    char *bytes = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&bytes, &length);
    json_writer w = {.out = out};
    json_open(&w, NULL, JSON_LINES);
    put(&w, number);
    json_close(&w);
    fclose(out);
    json_t *root = json_loadb(bytes, length, JSON_REJECT_DUPLICATES, NULL);
    json_t *value = json_incref(json_object_get(root, "x"));
    json_decref(root);
    free(bytes);
    return value;
}

static void put_double(json_writer *writer, const void *x)
{
    json_put_number(writer, "x", *(const double *)x);
}

static const char *format_number(double x)
{
    static char text[64];
    json_writer w = {.out = fmemopen(text, sizeof text, "w"), .depth = 1, .lists = 2u};
    w.is_empty = true;
    json_put_number(&w, NULL, x);
    fclose(w.out);
    return text;
}

static void put_given(json_writer *writer, const void *text) { json_put_given(writer, "x", text); }

static void test_numbers(void)
{
    static const double special[] = {0.0, 1.0, -2.5, 5e-324, 1e300, 1.7976931348623157e308, 1e17};
    static const double none[] = {NAN, INFINITY, -INFINITY};
    double x;
    state = 7;
    for (int i = 0; i < 20000; i++) {
        const uint64_t bits = draw();
        memcpy(&x, &bits, sizeof x);
        if (i < 7) x = special[i];
        if (!isfinite(x)) continue;
        json_t *value = number_of(put_double, &x);
        CU_ASSERT_FATAL(json_is_number(value));
        CU_ASSERT(json_number_value(value) == x);
        json_decref(value);
    }
    for (int i = 0; i < 3; i++) {
        json_t *value = number_of(put_double, &none[i]);
        CU_ASSERT(json_is_null(value));
        json_decref(value);
    }
}

/* The number with one digit less is another one: the text is the shortest. */
static void test_shortest(void)
{
    static const char *const known[] = {
        "0", "0.1", "-2.5", "1e-09", "100", "5e-324", "0.30000000000000004"};
    char shorter[40];
    state = 9;
    for (int i = 0; i < 20000; i++) {
        const uint64_t bits = draw();
        double x;
        memcpy(&x, &bits, sizeof x);
        if (i % 2) x = 1e-3 * (double)(bits % 100000); /* with few digits */
        if (!isfinite(x)) continue;
        const char *text = format_number(x);
        int digits = 0;
        for (const char *c = text; *c && *c != 'e'; c++)
            digits += *c >= '0' && *c <= '9' && (digits > 0 || *c != '0');
        CU_ASSERT(strtod(text, NULL) == x);
        if (digits == 1 || !strchr(text, '.')) continue;
        snprintf(shorter, sizeof shorter, "%.*e", digits - 2, x);
        CU_ASSERT(strtod(shorter, NULL) != x);
    }
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        CU_ASSERT_STRING_EQUAL(format_number(strtod(known[i], NULL)), known[i]);
    CU_ASSERT_STRING_EQUAL(format_number(-0.0), "0");
}

/* ---- lists ---- */

static void test_lists(void)
{
    char *bytes = NULL;
    size_t length = 0;
    json_writer w = {.out = open_memstream(&bytes, &length)};
    json_open(&w, NULL, JSON_LINES);
    json_open_list(&w, "none", JSON_LINES);
    json_close(&w);
    json_open_list(&w, "some", JSON_LINES);
    json_open_list(&w, NULL, JSON_ON_ONE_LINE);
    json_put_integer(&w, NULL, 1);
    json_put_text(&w, NULL, NULL);
    json_close(&w);
    json_open(&w, NULL, JSON_ON_ONE_LINE);
    json_put_bool(&w, "yes", true);
    json_put_bool(&w, "no", false);
    json_close(&w);
    json_close(&w);
    json_close(&w);
    fclose(w.out);
    CU_ASSERT_STRING_EQUAL(bytes, "{\n  \"none\": [],\n  \"some\": [\n    [1, null],\n"
                                  "    {\"yes\": true, \"no\": false}\n  ]\n}");
    json_t *root = json_loadb(bytes, length, JSON_REJECT_DUPLICATES, NULL);
    CU_ASSERT(json_array_size(json_object_get(root, "some")) == 2);
    json_decref(root);
    free(bytes);
}

/* What JSON has no such form for is the same number in another. */
static void test_given_numbers(void)
{
    static const struct {
        const char *text;
        double value;
    } given[] = {{"0.1", 0.1},   {"1e4", 1e4},   {"-1.5E-3", -1.5e-3}, {"12", 12},
                 {".5", 0.5},    {"+3", 3},      {"007", 7},           {"2.", 2},
                 {"1e+06", 1e6}, {"-.25", -0.25}};
    for (size_t i = 0; i < sizeof given / sizeof given[0]; i++) {
        json_t *value = number_of(put_given, given[i].text);
        CU_ASSERT_FATAL(json_is_number(value));
        CU_ASSERT(json_number_value(value) == given[i].value);
        json_decref(value);
    }
    char *bytes = NULL;
    size_t length = 0;
    json_writer w = {.out = open_memstream(&bytes, &length)};
    json_open(&w, NULL, JSON_ON_ONE_LINE);
    json_put_given(&w, "step", "0.10");
    json_close(&w);
    fclose(w.out);
    CU_ASSERT_STRING_EQUAL(bytes, "{\"step\": 0.10}");
    free(bytes);
}

/* ---- reading ---- */

static int parse(const char *bytes, size_t length)
{
    document doc = {0};
    const int status = json_parse(&doc, "test", bytes, length);
    yaml_document_delete(&doc.yaml);
    return status;
}

/* {"a": [[...]]} with that many brackets, closed or not. */
static int parse_nested(int depth, int closed)
{
    char *bytes = malloc(2 * (size_t)depth + 16);
    size_t n = (size_t)sprintf(bytes, "{\"a\": ");
    for (int i = 0; i < depth; i++) bytes[n++] = '[';
    for (int i = 0; i < depth && closed; i++) bytes[n++] = ']';
    if (closed) bytes[n++] = '}';
    bytes[n] = '\0';
    const int status = parse(bytes, n);
    free(bytes);
    return status;
}

static void test_depth(void)
{
    static const char in_a_text[] =
        "{\"a\": \"[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[\\\"[[[[[[[[[[[\"}";
    const int kept = hide_messages();
    CU_ASSERT(parse_nested(DOCUMENT_DEPTH - 1, 1) == CLI_DONE);
    CU_ASSERT(parse_nested(DOCUMENT_DEPTH, 1) == CLI_USAGE);
    const double begun = cli_seconds();
    CU_ASSERT(parse_nested(100000, 1) == CLI_USAGE);
    CU_ASSERT(parse_nested(100000, 0) == CLI_USAGE);
    CU_ASSERT(cli_seconds() - begun < 1.0);
    CU_ASSERT(parse(in_a_text, strlen(in_a_text)) == CLI_DONE);
    CU_ASSERT(parse("[1]", 3) == CLI_USAGE);
    CU_ASSERT(parse("", 0) == CLI_USAGE);
    CU_ASSERT(parse("{\"a\": 1", 7) == CLI_USAGE);
    show_messages(kept);
}

/* The bytes of a value are the bytes in the text, whatever letters come before. */
static void test_source(void)
{
    static const char bytes[] =
        "{\"title\": \"\xc3\x84\xe2\x82\xac\xf0\x9d\x84\x9e\",\n"
        "  \"input\": {\"\xc3\xa9\": [1, 2.50]},\n  \"status\": \"done\"}\n";
    document doc = {0};
    CU_ASSERT_FATAL(json_parse(&doc, "test", bytes, strlen(bytes)) == CLI_DONE);
    const yaml_node_t *root = yaml_document_get_root_node(&doc.yaml);
    const yaml_node_t *node = document_value(&doc, root, "input");
    CU_ASSERT_FATAL(node != NULL);
    char *source = json_source(bytes, node);
    CU_ASSERT_STRING_EQUAL(source, "{\"\xc3\xa9\": [1, 2.50]}");
    CU_ASSERT(document_value(&doc, root, "done") == NULL);
    free(source);
    yaml_document_delete(&doc.yaml);
}

void suite_json(void)
{
    CU_pSuite suite = CU_add_suite("json", NULL, NULL);
    CU_add_test(suite, "every character is read back", test_every_character);
    CU_add_test(suite, "bytes", test_known_bytes);
    CU_add_test(suite, "what is not UTF-8", test_not_utf8);
    CU_add_test(suite, "numbers", test_numbers);
    CU_add_test(suite, "numbers are as short as they can be", test_shortest);
    CU_add_test(suite, "numbers as they were given", test_given_numbers);
    CU_add_test(suite, "lists", test_lists);
    CU_add_test(suite, "depth", test_depth);
    CU_add_test(suite, "the bytes of a value", test_source);
}
