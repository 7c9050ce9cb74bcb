/* report_rows.h - columns of a run as curves over t, however many rows there are. */
#ifndef DAL_CLI_REPORT_ROWS_H
#define DAL_CLI_REPORT_ROWS_H

#include "report_plot.h"
#include "run/checkpoint.h"

#include <stdbool.h>

enum { ROW_BINS = 256 };

/* Rows one after the other, and where in them the value is least and greatest. */
typedef struct row_bin {
    long long rows;
    double begin, low[2], high[2]; /* t of the first row; (t, x) */
} row_bin;

/* A column: bins of equally many rows, each but the last. */
typedef struct row_series {
    row_bin bin[ROW_BINS];
    int bins;
    long long rows_of_bin, rows;
    double end;        /* t of the last row */
    long long turns;   /* how often the value begins to fall or to rise */
    double last, rise; /* the last value, and the last change that is not 0 */
} row_series;

/* Adds a row; what is not finite is left out. */
void row_series_add(row_series *s, double t, double x);
/* Draws it on a plot over t: as a line through rows that are dense enough, or as dots; and as a
 * band from the least to the greatest value where turns are too many to be seen. */
void row_series_draw(const row_series *s, const report_plot *plot, plot_curve *curve,
                     bool is_sparse);

/* Whether rows are too few to show how often it turns. */
bool row_series_is_aliased(const row_series *s);

/* What the checkpoint of a run has of all its steps: statistics of the observables, and of a run
 * with many more steps than rows the ranges of the coordinates and the last steps. */
typedef struct row_steps {
    dal_statistics *statistics; /* [observables]; NULL: there are none */
    step_record record;         /* allocated where there is one */
} row_steps;

/* Returns CLI_DONE, or prints and returns an exit status; free it in any case. */
int row_steps_read(row_steps *steps, const run_directory *dir, int coordinates, int observables);
void row_steps_free(row_steps *steps);
/* Draw a coordinate, or an observable less a number, as the band from the least to the greatest
 * value of all steps in pieces of the time; false: there is none, or the rows are no fewer. */
bool row_steps_draw_coordinate(const row_steps *steps, int coordinate, const report_plot *plot,
                               plot_curve *curve);
bool row_steps_draw_observable(const row_steps *steps, int observable, double less, long long rows,
                               const report_plot *plot, plot_curve *curve);
/* Draws max |x - first| of all steps so far over the time since the first; returns it at the end.
 * curve: or NULL. */
double row_steps_draw_drift(const row_steps *steps, int observable, const report_plot *plot,
                            plot_curve *curve);
/* Draws a column of the last steps, less a number. */
void row_steps_draw_last(const row_steps *steps, int column, double less, const report_plot *plot,
                         plot_curve *curve);

/* How far a coordinate moves from row to row, and how far it has travelled by its velocity. */
typedef struct row_distance {
    bool has_row;
    double t, q, v; /* of the last row */
    double moved, travelled, max_abs;
} row_distance;

void row_distance_add(row_distance *d, double t, double q, double v);
/* Whether a line from row to row is not what happens between them. */
bool row_distance_is_sparse(const row_distance *d);

#endif
