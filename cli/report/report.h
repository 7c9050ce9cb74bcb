/* report.h - a page and figures from the files of a study, of a run, or of `dalembert order`.
 *
 *     DIR/report/index.html   the page, which needs no other file
 *     DIR/report/NAME.gp      a gnuplot script with its data, to be changed and run again by hand
 *     DIR/report/NAME.svg     what it draws (or .png) */
#ifndef DAL_CLI_REPORT_H
#define DAL_CLI_REPORT_H

#include "ui/cli.h"

typedef struct report {
    const char *directory; /* that of the study or run */
    char *place;           /* DIR/report */
    const char *format;    /* "svg" or "png" */
    FILE *page;
    char *page_path;
    int missing; /* there is no gnuplot: scripts are written, figures are not */
    int figures; /* on the page so far */
} report;

/* Each returns CLI_DONE or prints and returns an exit status. */
int report_study(report *r);
int report_run(report *r);
int report_order(report *r);

/* ---- the page: report_page.c ---- */

extern const char report_style[]; /* report.css, embedded when the program is built */

int report_open(report *r);
int report_close(report *r);
/* Ends the head and begins the body with the title as its heading. */
void report_title(report *r, const char *title);
/* Text in which &, <, > and quotes are taken care of. */
void report_text(FILE *page, const char *text);
void report_element(FILE *page, const char *element, const char *text);
/* A cell of a table with a number; "–" for NAN. */
void report_number(FILE *page, const char *format, double x);
void report_paragraph(FILE *page, const char *text);
/* A cell of a table for a size and a trend, in words and in colour, and a number beneath them.
 * Without both it holds the number alone. */
void report_trend(FILE *page, const char *size, const char *trend, const char *number);
/* A file of the directory, word for word, as something to unfold; nothing where there is none. */
void report_file(report *r, const char *name, const char *summary);
/* The figure DIR/report/NAME.svg, inside the page; alt says in words what it shows. */
int report_embed(report *r, const char *name, const char *alt, const char *caption);

/* ---- plots: report_plot.c ---- */

enum { PLOT_CURVES = 12, PLOT_TITLE = 96, PLOT_NAME = 192 };

typedef struct plot_curve {
    char title[PLOT_TITLE]; /* "" keeps it out of the key */
    int ink, dots;          /* black instead of a colour; points without lines */
    int values;             /* points so far, those left out included, */
    double max_abs;         /* and max |y| of them; NaN once y was none */
    double (*at)[2];
    int count, room;
} plot_curve;

/* A figure of curves over common axes. */
typedef struct report_plot {
    char name[PLOT_NAME], title[PLOT_NAME], xlabel[PLOT_TITLE], ylabel[PLOT_TITLE];
    const char *caption;
    const char *nothing;            /* what the page says instead when all values are 0, or NULL */
    int log_x, log_y, marks, alike; /* marks: points, too; alike: one scale on both axes */
    plot_curve curve[PLOT_CURVES + 2];
    int count;
} report_plot;

/* Begins the next curve; points go to the last one.  What is not finite, or has no logarithm where
 * one is needed, is left out. */
plot_curve *report_curve(report_plot *plot, const char *title);
void report_point(report_plot *plot, double x, double y);
/* Lifts the pen. */
void report_lift(report_plot *plot);
/* Draws it on the page and frees the points.  Without values it puts nothing there. */
int report_draw(report *r, report_plot *plot);
/* The caption of envelopes. */
extern const char report_envelope[];
/* log y over log x between the last point and the one at a tenth of its x: the slope of an
 * envelope; NAN where there is none. */
double report_slope(const plot_curve *curve);

/* The path of the run in a directory, with its body, where the system has a picture; the caption
 * goes on with a sentence about the body. */
int report_path(report *r, const char *run, const char *name, const char *caption);

/* ---- CSV files in memory: report_csv.c ---- */

/* cell(row, column), row 0 being the heads. */
typedef struct report_csv {
    char *text, **cell;
    int rows, columns;
} report_csv;
int report_csv_read(report_csv *csv, const char *path);
void report_csv_free(report_csv *csv);
/* The text of row and head; "" when there is no such column or the row is short.  And its number,
 * NAN for no text. */
const char *report_csv_get(const report_csv *csv, int row, const char *head);
double report_csv_number(const report_csv *csv, int row, const char *head);

/* ---- the cells of a study: report_study.c ---- */

enum { REPORT_WORDS = 512 };

/* Distinct texts in the order of their first coming. */
typedef struct report_words {
    const char *word[REPORT_WORDS];
    int count;
} report_words;
void report_add_word(report_words *words, const char *text);

typedef struct report_cells {
    report_csv csv;
    report_words labels, methods;
} report_cells;
const char *report_get(const report_cells *cells, int row, const char *head);
int report_is(const report_cells *cells, int row, const char *head, const char *text);
/* The row of a cell started like this, or else like that; -1: none has numbers. */
int report_find(const report_cells *cells, const char *label, const char *method, const char *step,
                const char *start, const char *other);

/* The figures of a label: report_figure.c. */
int report_figures(report *r, const report_cells *cells, const char *label);

#endif
