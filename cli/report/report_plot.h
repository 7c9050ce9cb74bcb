/* report_plot.h - figures of curves over common axes. */
#ifndef DAL_CLI_REPORT_PLOT_H
#define DAL_CLI_REPORT_PLOT_H

#include "report_page.h"

/* PLOT_METHODS: curves with long names, for which there is room below a figure. */
enum { PLOT_CURVES = 12, PLOT_METHODS = 8, PLOT_TITLE = 96, PLOT_NOTE = 32, PLOT_NAME = 192 };

typedef struct plot_curve {
    char title[PLOT_TITLE]; /* "" keeps it out of the key */
    char note[PLOT_NOTE];   /* after the title */
    int colour;             /* its number, 0 for the first curve unless the caller changes it */
    bool is_black;
    bool has_dots;   /* points without lines */
    bool has_rings;  /* rings without lines */
    bool is_band;    /* between two values at each x */
    int values;      /* points so far, those left out included, */
    double max_abs;  /* and max |y| of them; NaN once y was none */
    double (*at)[3]; /* x, y and of a band the upper y */
    int count, capacity;
} plot_curve;

typedef struct report_plot {
    const char *name, *title, *xlabel, *ylabel, *caption; /* the caller's */
    const char *part;      /* of the run, or NULL: all; charts of one part are linked */
    const char *zero_text; /* what the page says instead when all values are 0, or NULL */
    bool log_x, log_y;
    bool has_marks;   /* at the points of the curves */
    bool is_to_scale; /* one scale on both axes */
    bool from_zero;   /* the ordinate begins at 0 */
    plot_curve curve[PLOT_CURVES + 2];
    int count;
    const double *mark; /* [marks] abscissas in their order, the caller's; vertical lines there */
    int marks;
    const char *const *row; /* [rows] names at the ordinates 1, 2, ..., from above, or none */
    int rows;
} report_plot;

/* Begins the next curve. */
plot_curve *report_curve(report_plot *plot, const char *title);
/* Adds a point.  What is not finite, or has no logarithm where one is needed, is left out. */
void report_point(const report_plot *plot, plot_curve *curve, double x, double y);
/* Adds to a band what lies between two values. */
void report_band(const report_plot *plot, plot_curve *curve, double x, double low, double high);
/* Ends a line; the next point begins another. */
void report_lift(plot_curve *curve);
/* Notes in brackets after the title of an envelope the slope of log y over log x between the last
 * point and the one at a tenth of its x, or why there is none. */
void report_title_envelope(plot_curve *curve);
extern const char report_envelope_caption[];
/* Puts it on the page and beside it, and frees the points; nothing is put there without values. */
int report_draw(report *r, report_plot *plot);

#endif
