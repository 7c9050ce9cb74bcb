/* text.h - characters of UTF-8, lists and their items, and what a text of a file may hold.
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
/* Appends an item to a list, after the separator unless it is the first, for which the list is
 * NULL.  Returns the longer list, allocated; the other one is freed. */
char *text_append_item(char *list, const char *separator, const char *item);
/* The end of an item of a list: its comma, unless in parentheses, or the end of the list. */
const char *text_find_comma(const char *item);
/* Whether a formula is a name alone. */
bool text_is_name(const char *formula);
/* Cuts a list at its commas into items that are not empty, in *items, allocated; how many. */
int text_split(char *list, const char ***items);

#endif
