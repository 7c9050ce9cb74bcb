/* json.h - the JSON that the program writes, and reads of its own files.
 *
 * Texts are UTF-8.  Control characters, marks of line ends and of byte order are written as \uXXXX,
 * a byte that belongs to no character as \uFFFD.  Numbers are numbers, with 17 digits where they
 * were computed; one that is not finite is null. */
#ifndef DAL_CLI_JSON_H
#define DAL_CLI_JSON_H

#include "document.h"

#include <stdio.h>

/* ---- writing ------------------------------------------------------------------------------- */

void json_text(FILE *out, const char *text);
void json_number(FILE *out, double x);
/* "NAME": VALUE behind what goes before, as an indentation or a comma. */
void json_text_member(FILE *out, const char *before, const char *name, const char *text);
void json_number_member(FILE *out, const char *before, const char *name, double x);
/* The same of a number that was given as a text: digit for digit where JSON writes it so. */
void json_given_member(FILE *out, const char *before, const char *name, const char *number);

/* ---- reading ------------------------------------------------------------------------------- */

/* Parses one object, with libyaml: all that is written above is YAML too.  Returns CLI_DONE, or
 * prints and returns CLI_USAGE or CLI_IO; the document is to be deleted either way. */
int json_parse(document *doc, const char *place, const char *bytes, size_t length);
/* What stands for a value in the bytes that were parsed, allocated. */
char *json_source(const char *bytes, const yaml_node_t *value);
/* A text of the object in a file, allocated; NULL where the file or the text is not there, after a
 * message where the file cannot be read. */
char *json_file_text(const char *path, const char *name);

#endif
