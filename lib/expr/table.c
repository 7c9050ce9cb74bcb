/* table.c - from points to a piecewise polynomial.
 *
 * Between the points x_i, with h_i = x_{i+1} - x_i and D_i = (y_{i+1} - y_i)/h_i,
 *
 *     linear:  f = y_i + D_i d,   d = x - x_i
 *     cubic:   f = y_i + (D_i - h_i (2 M_i + M_{i+1})/6) d + M_i/2 d^2
 *                  + (M_{i+1} - M_i)/(6 h_i) d^3,
 *
 *     h_{i-1} M_{i-1} + 2 (h_{i-1} + h_i) M_i + h_i M_{i+1} = 6 (D_i - D_{i-1}),
 *
 * the natural spline, M = f'' = 0 at both ends, or the one without knots at x_1 and at the last but
 * one point, where f''' is continuous.  The system for M is diagonally dominant, so that
 * elimination needs no pivots.  C. de Boor, A Practical Guide to Splines, 1978, chapter IV. */
#include "expr/table.h"
#include "kernel/elementary.h"
#include <float.h>
#include <math.h>

enum { LIMITS = 2, PIECE = 5 /* origin, c[4] */ };
/* Clocks and their sums may pass the last point by their rounding. */
#define ROUNDING (64 * DBL_EPSILON)

size_t dal__table_size(int knots) { return LIMITS + (size_t)knots + PIECE * ((size_t)knots + 1); }

static double slope(const dal_table *t, int i)
{
    return (t->value[i + 1] - t->value[i]) / (t->at[i + 1] - t->at[i]);
}

/* Stores M_i in c[2] of the piece after point i; c[3] holds the eliminated diagonal meanwhile.
 * Without knots beside the ends M_0 = M_1 + h_0 (M_1 - M_2)/h_1 is eliminated from the first
 * equation, and M at the other end from the last one. */
static void solve_spline(const dal_table *t, double *piece)
{
    const int last = t->points - 1;
    const bool extends = t->interpolation == DAL_NOT_A_KNOT && last > 2;
    double upper = 0.0, first_upper = 0.0; /* of the equation before, and of the first one */
    piece[3] = piece[last * PIECE + 3] = 0.0;
    for (int i = 1; i < last; i++) {
        double *p = piece + i * PIECE, *before = p - PIECE;
        const double h = t->at[i] - t->at[i - 1], next = t->at[i + 1] - t->at[i];
        const double lower = extends && i == last - 1 ? h - next * next / h : h;
        const double factor = i > 1 ? lower / before[4] : 0.0;
        double diagonal = 2.0 * (h + next);
        if (extends && i == 1) diagonal += h + h * h / next;
        if (extends && i == last - 1) diagonal += next + next * next / h;
        p[4] = diagonal - factor * upper;
        p[3] = 6.0 * (slope(t, i) - slope(t, i - 1)) - factor * before[3];
        upper = extends && i == 1 ? next - h * h / next : next;
        if (i == 1) first_upper = upper;
    }
    for (int i = last - 1; i > 0; i--) {
        double *p = piece + i * PIECE;
        const double next = i == 1 ? first_upper : t->at[i + 1] - t->at[i];
        p[3] = (p[3] - next * p[PIECE + 3]) / p[4];
    }
    for (int end = 0; extends && end < 2; end++) {
        const int away = end ? -1 : 1, i = end ? last : 0, next = i + away;
        const double M = piece[next * PIECE + 3], further = piece[(next + away) * PIECE + 3];
        const double ratio = (t->at[i] - t->at[next]) / (t->at[next] - t->at[next + away]);
        piece[i * PIECE + 3] = M + ratio * (M - further);
    }
    if (t->interpolation == DAL_NOT_A_KNOT && last == 2) /* the parabola */
        piece[3] = piece[PIECE + 3] = piece[2 * PIECE + 3] =
            2.0 * (slope(t, 1) - slope(t, 0)) / (t->at[2] - t->at[0]);
}

/* A line through an end. */
static void fill_end(const dal_table *t, int i, double slope_there, double *p)
{
    const double c[PIECE] = {t->at[i], t->value[i],
                             t->extend == DAL_EXTEND_CONSTANT ? 0.0 : slope_there};
    for (int k = 0; k < PIECE; k++) p[k] = c[k];
}

void dal__table_fill(const dal_table *t, double *data)
{
    const int knots = t->points, last = knots - 1;
    double *knot = data + LIMITS, *first = knot + knots, *piece = first + PIECE;
    const double slack = ROUNDING * fmax(fabs(t->at[0]), fabs(t->at[last]));
    const bool bounded = t->extend == DAL_EXTEND_NONE;
    data[0] = bounded ? t->at[0] - slack : -DBL_MAX;
    data[1] = bounded ? t->at[last] + slack : DBL_MAX;
    for (int i = 0; i < knots; i++) {
        knot[i] = t->at[i];
        for (int k = 0; k < PIECE; k++) piece[i * PIECE + k] = 0.0;
    }
    if (t->interpolation != DAL_LINEAR) solve_spline(t, piece);
    for (int i = 0; i < last; i++) {
        double *c = piece + i * PIECE + 1;
        const double h = t->at[i + 1] - t->at[i], M = c[2], next = c[PIECE + 2];
        c[-1] = t->at[i];
        c[0] = t->value[i];
        c[1] = slope(t, i) - h * (2.0 * M + next) / 6.0;
        c[2] = 0.5 * M;
        c[3] = (next - M) / (6.0 * h);
    }
    const double *p = piece + (last - 1) * PIECE, h = t->at[last] - t->at[last - 1];
    fill_end(t, 0, piece[2], first);
    fill_end(t, last, p[2] + h * (2.0 * p[3] + 3.0 * h * p[4]), piece + last * PIECE);
}

bool dal__table_is_finite(const dal_table *t, const double *data)
{
    const int knots = t->points;
    const double *piece = data + LIMITS + knots;
    for (int i = 0; i <= knots; i++, piece += PIECE) {
        const double h = i > 0 && i < knots ? t->at[i] - t->at[i - 1] : 0.0, *c = piece + 1;
        const double third = 6.0 * fabs(c[3]), second = 2.0 * fabs(c[2]) + h * third;
        const double first = fabs(c[1]) + h * second;
        if (!isfinite(fabs(c[0]) + h * first) || !isfinite(first) || !isfinite(second + third))
            return false;
    }
    return true;
}

const double *dal__table_piece(const dal__tape_table *table, int k)
{
    return table->data + LIMITS + table->knots + PIECE * k;
}

double dal__table_value(const dal__tape_table *tables, int symbol, double x)
{
    const dal__tape_table *table = &tables[symbol / DAL__TABLE_ORDERS];
    return dal_piecewise(x, table->data, table->knots, symbol % DAL__TABLE_ORDERS);
}
