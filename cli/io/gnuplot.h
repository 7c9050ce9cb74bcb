/* gnuplot.h - figures: a script that is kept, and what gnuplot draws by it. */
#ifndef DAL_CLI_GNUPLOT_H
#define DAL_CLI_GNUPLOT_H

#include <stdbool.h>
#include <stdio.h>

/* Begins DIR/NAME.gp with the terminal, the output NAME.FORMAT (svg or png) and the common style;
 * free *path, the script's.  An old picture is removed.  No text of a file is a part of NAME.
 * NULL after a message. */
FILE *gnuplot_open(const char *directory, const char *name, const char *format, int width,
                   int height, char **path);
/* Closes the script and runs gnuplot on it in DIR, which must draw its picture; an SVG figure has
 * no background and is readable in light and dark.  Returns CLI_DONE, or prints and returns an exit
 * status; *missing, unless NULL, is whether there is no gnuplot. */
int gnuplot_draw(const char *directory, FILE *script, const char *path, bool *missing);
/* Whether there is a gnuplot to run. */
bool gnuplot_is_there(void);
/* Any text as a string of gnuplot, in quotes, blanks for its control characters; the same as
 * a setting: set WHAT 'TEXT'. */
void gnuplot_quote(FILE *script, const char *text);
void gnuplot_set(FILE *script, const char *what, const char *text);
/* The colours of the curves, one after the other; and as "lc rgb C dt D" for more curves than
 * colours, which dashes distinguish. */
enum { GNUPLOT_COLOURS = 8 };
const char *gnuplot_colour(int i);
void gnuplot_style(FILE *script, int i);

#endif
