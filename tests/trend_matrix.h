/* trend_matrix.h - how often trends are right, wrong and sure of what is wrong. */
#ifndef TREND_MATRIX_H
#define TREND_MATRIX_H

#include "series.h"

/* Whether a kind accepts the trend of a series that it drew: undecided always counts; of a line
 * also none, unless it is sure, with the drift that it admits. */
int series_accepts(const series_kind *kind, const series *s, const dal_trend *f);

/* Whether the numbers of a trend agree with each other. */
int trend_is_consistent(const dal_trend *f);

/* Of the series of one kind, with one number of values and one noise. */
typedef struct trend_cell {
    int count, right, wrong, sure, outside; /* settles or none beside an interval without 0 */
    int covered, said[DAL_TREND_COUNT];
    double width;   /* of the intervals, in widths of least squares, in the mean */
    double seconds; /* of classifications */
} trend_cell;

/* Adds series 0 .. series - 1; x, t[SERIES_CAPACITY], of equal steps. */
void trend_cell_fill(trend_cell *cell, const series_kind *kind, int series, int count, double noise,
                     double *x, const double *t);

/* Prints the matrix of all kinds whose names contain a text, by several processes:
 * `suite --trends [SERIES [KIND]]`. */
int trend_matrix_print(int argc, char **argv);

#endif
