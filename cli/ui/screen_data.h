/* screen_data.h - a screen while it is made, and tables of texts. */
#ifndef DAL_CLI_SCREEN_DATA_H
#define DAL_CLI_SCREEN_DATA_H

#include "message.h"

#include <stdbool.h>
#include <string.h>

enum { SCREEN_LINES = 24, SCREEN_COLUMNS = 80, SCREEN_NUMBER = 32 };

/* The palette: rounding, then larger sizes by decades; faint is what is not stated. */
typedef enum screen_colour {
    SCREEN_PLAIN,
    SCREEN_ROUNDING,
    SCREEN_SMALL,
    SCREEN_MEDIUM,
    SCREEN_LARGE,
    SCREEN_FAINT,
    SCREEN_COLOURS
} screen_colour;

/* How the tables of a screen are printed, whole: for a person, or for a document.  LaTeX has the
 * sentences as comments, Markdown as paragraphs, CSV has none. */
typedef enum screen_format { SCREEN_TEXT, SCREEN_LATEX, SCREEN_MARKDOWN, SCREEN_CSV } screen_format;

typedef struct screen {
    FILE *out; /* the text as it is made; whatever is written there is printed in the end */
    FILE *to;  /* a terminal, or any stream where it is no text */
    int width; /* columns */
    screen_format format;
    bool in_colour;
    char *text;
    size_t length;
} screen;

/* A table of texts: rows of the same number of cells, added one by one.  Begin with
 * {.columns = n}; free it. */
typedef struct screen_cell {
    char *text;
    screen_colour colour;
} screen_cell;

typedef struct screen_table {
    int columns, cells, capacity;
    int heads; /* the first rows, which are headings */
    int gap;   /* blanks between columns; 0: 2 */
    screen_cell *cell;
} screen_table;

/* The letter of a column, of a text as screen_add_table has it. */
static inline char screen_align_of(const char *align, int column)
{
    const int last = (int)strlen(align) - 1;
    return align[column < last ? column : last];
}

#endif
