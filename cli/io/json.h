/* json.h - the JSON that the program writes, and reads of its own files.
 *
 * Texts are UTF-8.  Control characters, marks of line ends and of byte order are written as \uXXXX,
 * a byte that belongs to no character as \uFFFD.  Numbers are numbers, in the shortest form that
 * reads back exactly; one that is not finite is null. */
#ifndef DAL_CLI_JSON_H
#define DAL_CLI_JSON_H

#include "document.h"

#include <stdbool.h>
#include <stdio.h>

/* ---- writing ------------------------------------------------------------------------------- */

/* Writes objects and lists within each other, with their commas and line ends; begin with
 * {.out = file}. */
typedef struct json_writer {
    FILE *out;
    int depth;       /* of the present object or list; */
    int lines;       /* down to this one each member has a line of its own */
    unsigned lists;  /* bit d: the one of depth d is a list */
    bool is_empty;   /* the present one */
    bool is_in_page; /* in an element of HTML: < is escaped, and no space goes between members */
} json_writer;

typedef enum json_layout { JSON_ON_ONE_LINE, JSON_LINES } json_layout;

/* Begins an object or a list, of lines only within such; name is NULL for the outermost, and below
 * for all that is in a list.  Ends it. */
void json_open(json_writer *writer, const char *name, json_layout layout);
void json_open_list(json_writer *writer, const char *name, json_layout layout);
void json_close(json_writer *writer);
/* Members of the present object or list. */
void json_put_text(json_writer *writer, const char *name, const char *text); /* NULL: null */
void json_put_bool(json_writer *writer, const char *name, bool flag);
/* The fewest digits, 15 or more, that are read back as x; "null" where it is not finite. */
enum { JSON_NUMBER = 32 };
const char *json_format_number(char text[JSON_NUMBER], double x);
void json_put_number(json_writer *writer, const char *name, double x);
void json_put_integer(json_writer *writer, const char *name, long long x);
void json_put_numbers(json_writer *writer, const char *name, const double *x, long long count);
/* A number of nine digits, where more would only make a page longer. */
void json_put_rounded(json_writer *writer, const char *name, double x);
/* A number that was given as a text: digit for digit where JSON writes it so. */
void json_put_given(json_writer *writer, const char *name, const char *number);
/* A value that is JSON already. */
void json_put_source(json_writer *writer, const char *name, const char *source);
/* The same, written by the caller. */
FILE *json_put_name(json_writer *writer, const char *name);

/* Begins and ends what a command prints with --json: an object with its schema, such as
 * dalembert/order/1, and the version of the program. */
#define JSON_OPTION(settings)                                                                      \
    {                                                                                              \
        "json", NULL, NULL, "prints the results as JSON", CLI_FLAG(settings, json)                 \
    }
json_writer json_begin_results(const char *command);
/* The same in another file. */
json_writer json_begin_results_in(FILE *out, const char *command);
void json_end_results(json_writer *writer);

/* ---- reading ------------------------------------------------------------------------------- */

/* Parses one object (RFC 8259), length bytes and a NUL, at most DOCUMENT_DEPTH levels deep, to the
 * nodes of a YAML document: texts are quoted scalars; numbers, true, false and null plain ones.
 * Half of a surrogate pair is U+FFFD.  Returns CLI_DONE, or prints, unless place is NULL, and
 * returns CLI_USAGE; the document is to be deleted either way. */
int json_parse(document *doc, const char *place, const char *bytes, size_t length);
/* The same of a file; CLI_IO where it cannot be read. */
int json_read(document *doc, const char *path, const char *place);
/* A scalar of an object as it is written, a text without its quotes; "" where there is none, or
 * null. */
const char *json_scalar(const document *doc, const yaml_node_t *object, const char *name);
/* The text of a value in the bytes that were parsed, allocated. */
char *json_source(const char *bytes, const yaml_node_t *value);
/* A text of the object; NULL where it is not there, or after a message where it is no text. */
const char *json_text(const document *doc, const char *name);
/* A text of the object in a file, allocated; NULL where the file or the text is not there, or the
 * file holds no object.  A file that cannot be read is CLI_IO. */
int json_file_text(const char *path, const char *name, char **text);
/* Whether the object in a file has that member; no message where the file holds no object. */
int json_file_find(const char *path, const char *name, bool *is_there);

#endif
