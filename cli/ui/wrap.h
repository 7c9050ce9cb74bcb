/* wrap.h - texts as lines of at most 80 columns. */
#ifndef DAL_CLI_WRAP_H
#define DAL_CLI_WRAP_H

#include <stdio.h>

/* Prints a text from the present column on; further lines begin at hanging. */
void cli_wrap(FILE *out, const char *text, int column, int hanging);
/* Prints paragraphs and items.  Prose is filled again.  A line that begins with spaces is an item,
 * "  NAME   what it is"; its further lines begin below what it is, as do lines that already stand
 * there. */
void cli_wrap_notes(FILE *out, const char *notes);

#endif
