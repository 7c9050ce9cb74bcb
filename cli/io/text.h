/* text.h - characters of UTF-8, lists between commas, and what a text of a file may hold.
 *
 * A text that another program reads, a terminal, a browser, gnuplot or a shell, has no control
 * characters: U+0000..001F and 007F..009F. */
#ifndef DAL_CLI_TEXT_H
#define DAL_CLI_TEXT_H

#include <stdbool.h>
#include <stdio.h>

/* The bytes of the character of UTF-8 that begins here, and its code; 0: none does. */
int text_read_character(const char *text, long *code);
bool text_is_control(long code);
/* The first control character of a text that is not one of those allowed; -1: it has none. */
long text_find_control(const char *text, const char *allowed);
/* Controls of texts that may have more lines than one. */
#define TEXT_LINES "\t\n\r"
/* Writes a text between quotes of this kind, those within it twice, and blanks for its control
 * characters. */
void text_write_quoted(FILE *out, char quote, const char *text);
/* Whether a text can name a file in a directory: it is not empty, does not begin with a dot, and
 * has no slash and no control characters. */
bool text_is_file_name(const char *text);
/* Cuts a list at its commas into items that are not empty, in *items, allocated; how many. */
int text_split(char *list, const char ***items);

#endif
