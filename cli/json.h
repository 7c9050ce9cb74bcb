/* json.h - pieces of JSON, all of them ASCII. */
#ifndef DAL_CLI_JSON_H
#define DAL_CLI_JSON_H

#include "cli.h"

/* A text in its quotes.  Bytes beyond ASCII are written as if each were a letter of Latin-1. */
void json_text(FILE *out, const char *text);
/* A number with 17 digits, or null for what JSON has none for. */
void json_number(FILE *out, double x);
/* "NAME": "TEXT" and "NAME": NUMBER behind what goes before, as an indentation or a comma. */
void json_text_member(FILE *out, const char *before, const char *name, const char *text);
void json_number_member(FILE *out, const char *before, const char *name, double x);

#endif
