/* screen_format.h - the tables of a screen as LaTeX, Markdown and CSV. */
#ifndef DAL_CLI_SCREEN_FORMAT_H
#define DAL_CLI_SCREEN_FORMAT_H

#include "screen_data.h"

/* Writes a sentence, or nothing, to a screen whose format is not text. */
void screen_format_sentence(screen *s, const char *text);
/* Writes a table, align as of screen_add_table. */
void screen_format_table(screen *s, const screen_table *t, const char *align);

#endif
