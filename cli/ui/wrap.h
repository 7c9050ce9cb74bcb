/* wrap.h - texts as lines of at most 80 columns. */
#ifndef DAL_CLI_WRAP_H
#define DAL_CLI_WRAP_H

#include <stdbool.h>
#include <stdio.h>

/* The columns that a text of UTF-8 takes: its characters, not its bytes. */
int cli_columns(const char *text);
/* The bytes of its first characters, as many as fit in some columns. */
int cli_fit(const char *text, int columns);

/* Prints a text from the present column on; further lines begin at hanging. */
void cli_wrap(FILE *out, const char *text, int column, int hanging);
/* The same with lines of WIDTH columns. */
void cli_wrap_to(FILE *out, const char *text, int column, int hanging, int width);
/* Notes are paragraphs and items.  A line that begins with spaces is an item, "  NAME   what it
 * is", to which lines belong that begin below what it is. */
typedef struct cli_paragraph {
    const char *begin, *text, *end; /* text: after the name */
    const char *name;               /* of an item */
    int name_length;                /* 0: it has none */
    int hanging;                    /* where further lines begin */
    bool is_item;
} cli_paragraph;
/* Finds the end of the first paragraph; returns where the next one begins. */
const char *cli_next_paragraph(const char *notes, cli_paragraph *p);
/* Prints notes, each paragraph filled again. */
void cli_wrap_notes(FILE *out, const char *notes);

#endif
