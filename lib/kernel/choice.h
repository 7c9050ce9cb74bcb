/* choice.h - the solver "auto": fixed point or Newton's method, whichever costs less.
 *
 * Costs are counted in operations, F and its derivatives at the cost that the system states, and
 * in the iterations that each lane needed; no clock is read.  In units of an iteration of the fixed
 * point, k of which solve an equation, Newton's method costs
 *
 *     matrix + iteration * k',      matrix: the inverse;   iteration >= 1: with the product by it
 *
 * Each lane begins with the fixed point.  Where that needs more iterations than Newton's method
 * with three would cost, or where Newton's method is in use, the other method is tried after
 * DAL__MIN_INTERVAL equations and used from then on if it costs less; else it is tried again after
 * twice as many, at most DAL__MAX_INTERVAL.  A fixed point that hardly contracts, or that takes
 * more iterations than it may, is given up for Newton's method at once.
 *
 * The decision is kept in the persistent state: uses_newton, and choice, of each lane:
 *
 *     last        iterations of the last equation that counted
 *     remaining   equations until the next trial
 *     interval    equations from one trial to the next; 0: none is planned */
#ifndef DAL_KERNEL_CHOICE_H
#define DAL_KERNEL_CHOICE_H

#include "eigensystem.h"
#include "step.h"

/* Equations from one trial of the other method to the next. */
enum { DAL__MIN_INTERVAL = 8, DAL__MAX_INTERVAL = 512 };
/* The time of an operation of Newton's method, the fixed point's being 1.  It is longer in
 * compiled steps than in interpreted ones; both must choose alike, and take the mean. */
#define DAL__NEWTON_WEIGHT 1.4
/* Iterations of Newton's method, at best and as expected, where it has not been tried; the fixed
 * point may cost PATIENCE times as much before it is given up. */
#define DAL__NEWTON_MIN           3.0
#define DAL__NEWTON_EXPECTED      6.0
#define DAL__FIXED_POINT_PATIENCE 4.0

/* Of an equation, in iterations of the fixed point. */
typedef struct dal_newton_cost {
    double matrix, iteration;
} dal_newton_cost;

/* The cost for stages of `width` unknowns each; split: the eigensystem by which the matrix is
 * inverted, NULL: whole.  The terms are counts of multiplications, except terms of lower order,
 * which represent the rest and were fitted to timings.  Both spaces are charged for (q, v), so that
 * a motion has the same bits there. */
DAL_INLINE dal_newton_cost dal_cost_of_newton(const dal_step *s, int stages, int width,
                                              const dal_eigensystem *split)
{
    const double w = width, size = (double)stages * w, pairs = 0.5 * (stages + 1);
    const double map = stages * (DAL_FIELD_OPERATIONS(s) + (4.0 * stages + 8.0) * w);
    const double matrix = DAL_JACOBIAN_OPERATIONS(s) + 32.0 * w;
    const double inverse = split ? pairs * (w + 8.0) * w * w : (2.0 * size + 4.0) * size * size;
    const double product = split ? 2.5 * pairs * (stages + w) * w : size * size;
    const dal_newton_cost cost = {DAL__NEWTON_WEIGHT * (matrix + inverse) / map,
                                  DAL__NEWTON_WEIGHT * (1.0 + product / map)};
    return cost;
}

/* Lanes of group j in which Newton's method is in use. */
DAL_INLINE dal_mask dal__newton_in_use(const dal_step *s, int j)
{
    return dal_less(dal_num(0.5), s->uses_newton[j]);
}

/* Lanes of group j in which the method not in use is tried. */
DAL_INLINE dal_mask dal__trial_is_due(const dal_step *s, int j)
{
    const num *remaining = s->choice + DAL_STEP_GROUPS, *interval = remaining + DAL_STEP_GROUPS;
    return dal_less(dal_num(0.5), interval[j]) & dal_less(remaining[j], dal_num(0.5));
}

/* The iterations that the fixed point may take; in the lanes `newton`, where Newton's method is in
 * use, only as many as cost no more than that. */
DAL_INLINE num dal__fixed_point_limit(const dal_step *s, const dal_newton_cost *cost, int j,
                                      dal_mask newton)
{
    const double expected = cost->matrix + cost->iteration * DAL__NEWTON_EXPECTED;
    const num present = cost->matrix + cost->iteration * s->choice[j];
    return dal_select(newton, present, dal_num(DAL__FIXED_POINT_PATIENCE * expected));
}

/* Lanes whose equations count until a trial: Newton's method is in use, or could cost less than the
 * iterations taken. */
DAL_INLINE dal_mask dal__counts_until_trial(const dal_step *s, const dal_newton_cost *cost, int j,
                                            num taken)
{
    return dal__newton_in_use(s, j) |
           dal_less(dal_num(cost->matrix + cost->iteration * DAL__NEWTON_MIN), taken);
}

/* Chooses in the solved lanes of group j, `by_newton` some of them, what the next equation is
 * solved by; taken: the iterations. */
DAL_INLINE void dal__choose_solver(dal_step *s, const dal_newton_cost *cost, int j, dal_mask solved,
                                   dal_mask by_newton, num taken)
{
    num *const last = s->choice + j, *const remaining = last + DAL_STEP_GROUPS,
               *const interval = remaining + DAL_STEP_GROUPS;
    const dal_mask newton = dal__newton_in_use(s, j);
    const dal_mask due = dal__trial_is_due(s, j), other = by_newton ^ newton;
    const num before = dal_select(newton, cost->matrix + cost->iteration * *last, *last);
    const num now = dal_select(by_newton, cost->matrix + cost->iteration * taken, taken);
    const dal_mask given_up = other & ~due;
    const dal_mask better = other & due & dal_less(now, before);
    const dal_mask later = solved & (given_up | (due & ~better));
    const dal_mask counts = solved & ~due & ~other & dal__counts_until_trial(s, cost, j, taken);
    const dal_mask begins = (solved & better) | (counts & dal_less(*interval, dal_num(0.5)));
    const dal_mask changes = solved & (given_up | better);
    *interval = dal_select(
        later,
        dal_max(dal_min(2.0 * *interval, dal_num(DAL__MAX_INTERVAL)), dal_num(DAL__MIN_INTERVAL)),
        *interval);
    *interval = dal_select(begins, dal_num(DAL__MIN_INTERVAL), *interval);
    *remaining = dal_select(counts, dal_max(*remaining - 1.0, dal_num(0.0)), *remaining);
    *remaining = dal_select(later | begins, *interval, *remaining);
    *last = dal_select(changes | counts, taken, *last);
    s->uses_newton[j] = dal_select(changes, 1.0 - s->uses_newton[j], s->uses_newton[j]);
}

#endif
