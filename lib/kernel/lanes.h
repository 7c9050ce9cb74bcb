/* lanes.h - the lanes of a step, and vectors with components of all of them.
 *
 * A num holds as many lanes as a register.  The lanes of a step are one num, except where a
 * generated file steps DAL_STEP_GROUPS groups of them as one larger system (DAL_HAS_GROUPS):
 * component i of group j is then number i*DAL_STEP_GROUPS + j of a vector.  What each lane has of
 * its own, a choice of lanes or a norm, is an array over the groups. */
#ifndef DAL_KERNEL_LANES_H
#define DAL_KERNEL_LANES_H

#include "num.h"

#ifndef DAL_SPECIALISED
enum { DAL_STEP_GROUPS = 1 };
#endif

/* A loop over the groups j; a variable of each of them; how many of count numbers one has. */
#define DAL_EACH_GROUP(j)    DAL_EACH(j, DAL_STEP_GROUPS)
#define DAL_OF_GROUPS(name)  name[DAL_STEP_GROUPS]
#define DAL_PER_GROUP(count) ((count) / DAL_STEP_GROUPS)

/* A choice of lanes, and its part for a number of a vector, or for a group. */
#if DAL_HAS_GROUPS
typedef struct dal_lane_set {
    dal_mask group[DAL_STEP_GROUPS]; /* the lanes chosen in each */
} dal_lane_set;
#define DAL_LANES_AT(lanes, i) (lanes).group[(i) % DAL_STEP_GROUPS]
#else
typedef dal_mask dal_lane_set;
#define DAL_LANES_AT(lanes, i) (lanes)
#endif

#if DAL_WITH(SOLVE)
/* The lanes of both choices, of one of them, of the first alone; whether there are any. */
DAL_INLINE dal_lane_set dal_lanes_and(dal_lane_set a, dal_lane_set b)
{
    DAL_EACH_GROUP(j) DAL_LANES_AT(a, j) &= DAL_LANES_AT(b, j);
    return a;
}
DAL_INLINE dal_lane_set dal_lanes_or(dal_lane_set a, dal_lane_set b)
{
    DAL_EACH_GROUP(j) DAL_LANES_AT(a, j) |= DAL_LANES_AT(b, j);
    return a;
}
DAL_INLINE dal_lane_set dal_lanes_without(dal_lane_set a, dal_lane_set b)
{
    DAL_EACH_GROUP(j) DAL_LANES_AT(a, j) &= ~DAL_LANES_AT(b, j);
    return a;
}
DAL_INLINE bool dal_any_lanes(dal_lane_set lanes)
{
    dal_mask some = DAL_LANES_AT(lanes, 0);
    DAL_EACH(j, DAL_STEP_GROUPS - 1) some |= DAL_LANES_AT(lanes, j + 1);
    return dal_any(some);
}

/* to = from in these lanes, for count numbers. */
DAL_INLINE void dal_copy_lanes(dal_lane_set lanes, num *to, const num *from, int count)
{
    DAL_EACH(i, count) to[i] = dal_select(DAL_LANES_AT(lanes, i), from[i], to[i]);
}

/* The max norm over group j, in units[width] that repeat; NULL: 1. */
DAL_INLINE num dal_group_norm(const num *x, int count, const double *unit, int width, int j)
{
    if (DAL_STEP_GROUPS == 1 && !unit) return dal_max_norm(x, count);
    const int all = DAL_PER_GROUP(count), period = unit ? width : all;
    num norm = dal_num(0.0);
    for (int first = 0; first < all; first += period)
        DAL_EACH(i, period)
            norm =
                dal_max(norm, dal_abs(dal_in_units(x[(first + i) * DAL_STEP_GROUPS + j], unit, i)));
    return norm;
}

/* x = matrix x in group j, with rows numbers; scratch[rows]. */
DAL_INLINE void dal_group_multiply(const num *matrix, int rows, num *x, int j, num *scratch)
{
    x += j;
    for (int i = 0; i < rows; i++) {
        num sum = dal_num(0.0);
        for (int k = 0; k < rows; k++)
            sum = dal_fma(matrix[i * rows + k], x[k * DAL_STEP_GROUPS], sum);
        scratch[i] = sum;
    }
    for (int i = 0; i < rows; i++) x[i * DAL_STEP_GROUPS] = scratch[i];
}

/* u += d in these lanes; adds |d| to the norms and NaN to nonfinite where d is not finite. */
DAL_INLINE void dal_add_increment(dal_lane_set lanes, num *u, const num *increment, int count,
                                  num *norm, num *nonfinite)
{
    DAL_EACH(i, count) {
        const int j = i % DAL_STEP_GROUPS;
        const num d = increment[i];
        norm[j] = dal_max(norm[j], dal_abs(d));
        nonfinite[j] += d - d;
        u[i] = dal_select(DAL_LANES_AT(lanes, j), u[i] + d, u[i]);
    }
}
#endif

#endif
