/* gnuplot.h - figures for papers: a script with its data, and what gnuplot draws by it. */
#ifndef DAL_CLI_GNUPLOT_H
#define DAL_CLI_GNUPLOT_H

#include <stdbool.h>
#include <stdio.h>

typedef enum gnuplot_format { GNUPLOT_SVG, GNUPLOT_PDF } gnuplot_format;

typedef struct gnuplot {
    FILE *script;
    char *path; /* of the script */
    gnuplot_format format;
} gnuplot;

/* The width of a column of a paper, 3.4 inches, in units of 1/96 inch. */
enum { GNUPLOT_WIDTH = 326 };

/* Begins DIR/NAME.gp with the terminal and the common style.  It draws NAME.svg, or NAME.pdf with
 * NAME.tex, which \input puts into a paper and whose labels TeX sets.  Pictures of an earlier
 * script are removed.  No text of a file is a part of NAME.  Returns CLI_DONE, or prints and
 * returns an exit status. */
int gnuplot_open(gnuplot *g, const char *directory, const char *name, gnuplot_format format,
                 int height);
/* Closes the script, and runs gnuplot on it in DIR, which must draw its picture.  Return CLI_DONE,
 * or print and return an exit status. */
int gnuplot_close(gnuplot *g);
int gnuplot_draw(gnuplot *g, const char *directory);
/* Any text as a string of gnuplot, in quotes, blanks for its control characters, and as words and
 * symbols of TeX where TeX sets it; the same as a setting: set WHAT 'TEXT'. */
void gnuplot_quote(const gnuplot *g, const char *text);
void gnuplot_set(const gnuplot *g, const char *what, const char *text);
/* The colours of the curves, one after the other; and as "lc rgb C dt D" for more curves than
 * colours, which dashes distinguish. */
enum { GNUPLOT_COLOURS = 8 };
const char *gnuplot_colour(int i);
void gnuplot_style(FILE *script, int i);

#endif
