/* preprocessor.h - sources of the library as text in a generated file. */
#ifndef DAL_CODEGEN_PREPROCESSOR_H
#define DAL_CODEGEN_PREPROCESSOR_H

#include "codegen/generation.h"

/* Writes a text as preprocessor.c says. */
void dal__preprocess(dal__generation *g, const char *text);
/* Writes a text, with the prefix for the word PREFIX, as it is. */
void dal__write_template(dal__generation *g, const char *text);
/* Writes an item of a list after the others, on a line of its own where theirs is full. */
void dal__write_item(dal__generation *g, const char *item);

#endif
