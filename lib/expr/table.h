/* table.h - functions of one argument given by points. */
#ifndef DAL_EXPR_TABLE_H
#define DAL_EXPR_TABLE_H

#include "dalembert_model.h"
#include <stdbool.h>
#include <stddef.h>

enum { DAL__TABLE_ORDERS = 5 /* a cubic, its three derivatives, and 0 */ };

/* A piecewise polynomial, with the data of dal_piecewise (kernel/elementary.h). */
typedef struct dal__tape_table {
    int knots;
    int degree;
    const double *data; /* [dal__table_size(knots)] */
} dal__tape_table;

/* How many numbers the data of some points are; fills them in.  at[] ascends; the arguments of
 * dal_table otherwise. */
size_t dal__table_size(int knots);
void dal__table_fill(const dal_table *table, double *data);
/* Whether the numbers that were filled in, and the values between the points, are finite: points
 * may be too large, or too close. */
bool dal__table_is_finite(const dal_table *table, const double *data);
/* Piece number k, from 0 before the first point to the number of points after the last one: its
 * origin and its coefficients c[4]. */
const double *dal__table_piece(const dal__tape_table *table, int k);
/* The value or a derivative at x, by the symbol of its node, with the bits of a tape; NaN outside
 * the range. */
double dal__table_value(const dal__tape_table *tables, int symbol, double x);

#endif
