/* report_rows.h - columns of a run as curves over t, however many rows there are. */
#ifndef DAL_CLI_REPORT_ROWS_H
#define DAL_CLI_REPORT_ROWS_H

#include "report_plot.h"

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
