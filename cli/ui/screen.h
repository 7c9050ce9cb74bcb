/* screen.h - what a person reads on a terminal: at most 24 lines of at most 80 columns.
 *
 * Pipes and files get data; a terminal gets a screen, which states the result first.  A screen is
 * made in memory and printed as a whole.  What does not fit is counted, with the option that prints
 * it.  Colours are for terminals only, and never say what no word or mark says. */
#ifndef DAL_CLI_SCREEN_H
#define DAL_CLI_SCREEN_H

#include "screen_data.h"

/* Whether a person reads standard output: it is a terminal. */
bool screen_has_reader(void);
/* From now on nobody does: mpirun gives each process a terminal, wherever its own output goes. */
void screen_ignore_terminal(void);
/* The terminal for a summary: standard output, or else standard error; NULL: neither is one. */
FILE *screen_terminal(void);
/* Whether a terminal gets colours (https://no-color.org). */
bool screen_is_in_colour(FILE *to);

/* The row of --details in a table of options. */
#define SCREEN_DETAILS_OPTION(settings)                                                            \
    {                                                                                              \
        "details", NULL, NULL, "prints on a terminal what a pipe gets",                            \
            CLI_FLAG(settings, details)                                                            \
    }

/* Returns CLI_DONE, or prints that a format excludes an option that is given ("--json"), and
 * returns CLI_USAGE. */
int screen_check_format(screen_format format, const char *option, bool is_given);
/* Whether results are printed as a screen, or its table, where no option chooses another form. */
bool screen_is_wanted(screen_format format, bool has_other_form);

/* The row of --format in a table of options. */
#define SCREEN_FORMAT_OPTION(settings)                                                             \
    {                                                                                              \
        "format", "text|latex|markdown|csv", "text",                                               \
            "prints the table of the screen, whole, for a document", CLI_WORD(settings, format)    \
    }

/* Begins a screen; screen_close prints it and ends it.  more is the option that prints what does
 * not fit; NULL: the screen may have any number of lines.  Returns CLI_DONE, or prints and returns
 * CLI_IO. */
void screen_open(screen *s, FILE *to, screen_format format);
int screen_close(screen *s, const char *more);
/* How many rows of a table are shown: this many on a terminal, else all. */
int screen_limit(const screen *s, int rows);

/* Adds a paragraph, whose second and later lines begin in column hanging. */
void screen_say(screen *s, int hanging, const char *format, ...) CLI_PRINTF(3, 4);
/* Adds a command after a head, on lines of its own where it is long, with backslashes. */
void screen_say_command(screen *s, const char *head, const char *command);
/* Adds items side by side on at most that number of lines, and counts the others. */
void screen_say_items(screen *s, const char *const *items, int count, int lines, const char *more);
/* The lines so far. */
int screen_count_lines(screen *s);
/* Adds an empty line. */
void screen_skip(screen *s);

/* Names between commas, as many as fit into columns, then "... and 12 more"; allocated. */
char *screen_list_names(const char *const *names, int count, int columns);

/* Adds a cell to a table. */
void screen_add_cell(screen_table *t, screen_colour colour, const char *format, ...)
    CLI_PRINTF(3, 4);
/* Adds a table to a screen.  align has a letter for each column, the last one for all others: l, r,
 * and w for a last column whose text is wrapped.  Columns that do not fit are left out: returns how
 * many. */
int screen_add_table(screen *s, const screen_table *t, const char *align, int indent);
void screen_free_table(screen_table *t);

/* A number with some significant digits, without zeros in its exponent: 5.2e-8, 12.3, 20000.
 * Returns text. */
const char *screen_number(char text[SCREEN_NUMBER], double x, int digits);
/* A count with commas between thousands: 20,000.  Returns text. */
const char *screen_count(char text[SCREEN_NUMBER], long long count);
/* A time with its unit: "0.02 s", "3.1 min".  Returns text. */
const char *screen_seconds(char text[SCREEN_NUMBER], double seconds);
/* The colour of a size that is no rounding. */
screen_colour screen_colour_of(double size);

#endif
