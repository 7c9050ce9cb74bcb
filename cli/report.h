/* report.h - figures and a page from the files of a study or of a run.
 *
 *     DIR/report/index.html   the page
 *     DIR/report/NAME.gp      a gnuplot script, to be changed and run again by hand
 *     DIR/report/NAME.svg     what it draws (or .png) */
#ifndef DAL_CLI_REPORT_H
#define DAL_CLI_REPORT_H

#include "cli.h"
#include "gnuplot.h"

typedef struct report {
    const char *directory; /* that of the study or run */
    char *place;           /* DIR/report */
    const char *format;    /* "svg" or "png" */
    FILE *page;
    char *page_path;
    int broken; /* there is no gnuplot, so that no other figure need be tried */
} report;

/* Each returns CLI_DONE or prints and returns an exit status. */
int report_study(report *r);
int report_run(report *r);

/* Begins DIR/report/NAME.gp with the terminal and the output NAME.svg; report_draw closes the
 * script, runs gnuplot on it and puts the figure on the page. */
FILE *report_script(report *r, const char *name, int width, int height, char **path);
int report_draw(report *r, FILE *script, char *path, const char *name, const char *caption);

/* Text in which &, < and > are taken care of. */
void report_text(FILE *page, const char *text);

/* A CSV file in memory: cell(row, column), row 0 being the heads. */
typedef struct report_csv {
    char *text, **cell;
    int rows, columns;
} report_csv;
int report_csv_read(report_csv *csv, const char *path);
/* The same of an allocated text, which it takes over; NULL when a message was given. */
int report_csv_take(report_csv *csv, char *text, const char *path);
void report_csv_free(report_csv *csv);
/* The text of row and head; "" when there is no such column or the row is short. */
const char *report_csv_get(const report_csv *csv, int row, const char *head);

/* ---- the cells of a study ---- */

enum { REPORT_WORDS = 512 };

/* Distinct texts in the order of their first coming. */
typedef struct report_words {
    const char *word[REPORT_WORDS];
    int count;
} report_words;
int report_word_at(const report_words *words, const char *text); /* -1: not there */
void report_add_word(report_words *words, const char *text);

typedef struct report_cells {
    report_csv csv;
    report_words labels, methods;
    report_words plain; /* the methods that have no modifiers: each has a colour of its own */
} report_cells;
const char *report_get(const report_cells *cells, int row, const char *head);
int report_is(const report_cells *cells, int row, const char *head, const char *text);

/* The figure number (from 1) of a label, at one step, with up to four panels: D and E on
 * p = pi = 0, H off it, and the error against the work. */
int report_figure(report *r, const report_cells *cells, const char *label, const char *step,
                  int number);

#endif
