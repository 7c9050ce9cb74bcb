/* error_shares.c - the shares of a drift, from the trends of a run and of its comparisons.
 *
 *     x(run) = motion + truncation, in smooth steps or across branches, or coefficients
 *            + rounding + solver
 *
 * A drift is measured by its rate where the line of least squares rises by at least half of the max
 * deviation and its interval excludes 0; rates of parts add up to the sum's rate.  Otherwise it is
 * measured by the max deviation.  The share of a part is its size over the sum of the sizes. */
#include "analysis/error_shares.h"
#include "core/words.h"
#include <float.h>
#include <math.h>
#include <stdbool.h>

/* The solver's part must exceed what rounding does by this, or be a rate this far from zero. */
static const double significant = 4.0, clear = 2.0;
/* Parts of a drift: below the first a source is none; below the second the rest is rounding in quad
 * precision. */
static const double small = 0.1, nothing = 1e-12;
/* Roundings of the scale in each step: what coefficients do, and the errors of the exact motion, at
 * most. */
static const double roundings_per_step = 16.0;
static const double half_an_order = 0.5;

const char *dal_error_source_name(dal_error_source source)
{
    DAL__RETURN_WORD(DAL_ERROR_SOURCE_LIST, DAL__SECOND, source, "?");
}

bool dal__has_branches(const dal_system *system)
{
    return system->series && system->series->refused;
}

static double half_width(const dal_trend *f) { return 0.5 * (f->rate_high - f->rate_low); }

static bool drifts(const dal_trend *f, double time)
{
    return fabs(f->rate) > half_width(f) && fabs(f->rate) * time >= 0.5 * f->deviation;
}

static double size_of(const dal_trend *f, bool by_rate)
{
    return by_rate ? fabs(f->rate) : f->deviation;
}

/* log2 of the ratio of an error to that with half the step; NaN where one is 0. */
static double order_of(double whole, double halved)
{
    return whole > 0.0 && halved > 0.0 ? log2(whole / halved) : NAN;
}

/* The order of a drift that falls as the method says: at least the stated one. */
static bool falls_as_stated(const dal_error_budget *e, double order)
{
    return order >= dal_method_order(&e->spec.method) - half_an_order;
}

/* ---- the motion ---- */

/* The errors of the exact motion, at most. */
static double error_of_reference(const dal_error_budget *e, double scale)
{
    const long long steps = e->steps > e->exact_steps ? e->steps : e->exact_steps;
    return roundings_per_step * DBL_EPSILON * scale * (double)steps;
}

/* Whether the exact motion changes a quantity.  Where quad precision leaves next to nothing,
 * rounding errors have grown with the motion, as they do for the exact motion in doubles, too. */
static bool has_motion(const dal_error_budget *e, dal_shares *a)
{
    const dal_trend *exact = &a->comparison[DAL_COMPARISON_EXACT];
    if (a->is_conserved || !e->ran[DAL_COMPARISON_EXACT]) return false;
    a->is_conserved = exact->deviation <= error_of_reference(e, exact->scale);
    return !a->is_conserved &&
           (e->quad_steps == 0 || size_of(&a->comparison[DAL_COMPARISON_QUAD], a->by_rate) >=
                                      small * size_of(&a->beginning, a->by_rate));
}

/* ---- with quad precision ---- */

static void set_share(dal_shares *a, dal_error_source source, const dal_trend *change)
{
    a->share[source] = size_of(change, a->by_rate);
    a->margin[source] = a->by_rate ? half_width(change) : NAN;
}

/* Sizes become shares of their sum. */
static void divide_by_sum(dal_shares *a)
{
    double sum = 0.0;
    for (int k = 0; k < DAL_ERROR_SOURCES; k++)
        if (!isnan(a->share[k])) sum += a->share[k];
    for (int k = 0; k < DAL_ERROR_SOURCES && sum > 0.0; k++) {
        a->share[k] /= sum;
        a->margin[k] /= sum;
    }
}

/* The source of what quad precision leaves beside the motion.  Coefficients leave little of the
 * scale, and it does not fall with the step as the order of the method says; nor does what steps
 * across branches leave, which need not be little. */
static dal_error_source source_in_quad(const dal_error_budget *e, const dal_shares *a)
{
    if (isnan(a->order) || falls_as_stated(e, a->order)) return DAL_SOURCE_TRUNCATION;
    if (a->error.deviation <=
        roundings_per_step * DBL_EPSILON * a->beginning.scale * (double)e->quad_steps)
        return DAL_SOURCE_COEFFICIENTS;
    return dal__has_branches(e->spec.system) ? DAL_SOURCE_BRANCHES : DAL_SOURCE_TRUNCATION;
}

static void weigh_quad(const dal_error_budget *e, dal_shares *a, bool moves)
{
    const double whole = size_of(&a->beginning, a->by_rate);
    const double unknown = moves ? error_of_reference(e, a->beginning.scale)
                                 : 2.0 * DBL_EPSILON * a->beginning.max_abs;
    a->vanishes_in_quad =
        size_of(&a->error, a->by_rate) <= nothing * whole || a->error.deviation <= unknown;
    if (!a->vanishes_in_quad)
        a->order = order_of(size_of(&a->error, a->by_rate), size_of(&a->error_halved, a->by_rate));
    const dal_error_source source = source_in_quad(e, a);
    /* Without an exact motion: what does not fall with the step at all. */
    const bool is_motion = !a->is_conserved && !e->ran[DAL_COMPARISON_EXACT] &&
                           source != DAL_SOURCE_COEFFICIENTS && a->order < half_an_order;
    a->share[DAL_SOURCE_MOTION] = a->share[DAL_SOURCE_TRUNCATION] = 0.0;
    a->share[DAL_SOURCE_BRANCHES] = a->share[DAL_SOURCE_COEFFICIENTS] = 0.0;
    if (moves) set_share(a, DAL_SOURCE_MOTION, &a->motion);
    set_share(a, is_motion ? DAL_SOURCE_MOTION : source, &a->error);
    if (is_motion) a->share[DAL_SOURCE_TRUNCATION] = NAN;
}

/* Quad precision separates truncation and coefficients from rounding, more iterations the solver.
 */
static void share_beginning(const dal_error_budget *e, dal_shares *a)
{
    const double time = (double)e->quad_steps * fabs(e->spec.options.step);
    a->by_rate = drifts(&a->beginning, time);
    const bool moves = has_motion(e, a);
    if (moves) {
        a->by_rate = a->by_rate && drifts(&a->error, time);
    } else {
        a->error = a->comparison[DAL_COMPARISON_QUAD];
        a->error_halved = a->comparison[DAL_COMPARISON_QUAD_HALVED];
    }
    if (!(size_of(&a->beginning, a->by_rate) > 0.0)) return;
    weigh_quad(e, a, moves);
    const bool solver_drifts = a->by_rate && fabs(a->solver.rate) > clear * half_width(&a->solver);
    a->solver_is_significant =
        a->solver.deviation > significant * a->rounding.deviation || solver_drifts;
    set_share(a, DAL_SOURCE_ROUNDING,
              a->solver_is_significant ? &a->rounding : &a->solver_and_rounding);
    if (a->solver_is_significant)
        set_share(a, DAL_SOURCE_SOLVER, &a->solver);
    else if (!e->ran[DAL_COMPARISON_TIGHTER] ||
             a->solver.deviation < small * a->beginning.deviation)
        a->share[DAL_SOURCE_SOLVER] = 0.0;
    divide_by_sum(a);
}

/* ---- without it ---- */

/* The error of the run or of a comparison along all steps: where the motion changes the quantity,
 * by rates, which may be subtracted. */
static double whole_error(const dal_shares *a, bool moves, int series, const double *rate)
{
    const dal_trend *f = series == DAL__WHOLE_RUN ? &a->whole : &a->comparison[series - 1];
    return moves ? fabs(rate[series] - rate[1 + DAL_COMPARISON_EXACT])
                 : size_of(f, a->whole_by_rate);
}

/* Halving the step divides truncation T by 2^p or more and leaves the rest. */
static void share_by_halving(const dal_error_budget *e, dal_shares *a, bool moves,
                             const double *rate)
{
    const double error = whole_error(a, moves, DAL__WHOLE_RUN, rate);
    const double motion = moves ? fabs(rate[1 + DAL_COMPARISON_EXACT]) : 0.0;
    const double sum = motion + error;
    if (!(sum > 0.0)) return;
    if (moves || a->is_conserved) a->share[DAL_SOURCE_MOTION] = motion / sum;
    if (!dal__has_branches(e->spec.system)) a->share[DAL_SOURCE_BRANCHES] = 0.0;
    if (!e->ran[DAL_COMPARISON_TIGHTER]) a->share[DAL_SOURCE_SOLVER] = 0.0;
    if (!e->ran[DAL_COMPARISON_HALVED]) return;
    const double half = whole_error(a, moves, 1 + DAL_COMPARISON_HALVED, rate);
    a->order = order_of(error, half);
    if (falls_as_stated(e, a->order)) {
        const double divisor = exp2(fmax(nearbyint(a->order), dal_method_order(&e->spec.method)));
        const double share = (error - half) / sum * divisor / (divisor - 1.0);
        a->share[DAL_SOURCE_TRUNCATION] = fmin(share, error / sum);
    } else if (a->order >= half_an_order && dal__has_branches(e->spec.system)) {
        a->share[DAL_SOURCE_BRANCHES] = error / sum;
    }
}

void dal__find_shares(const dal_error_budget *e, dal_shares *a, const double *rate)
{
    for (int k = 0; k < DAL_ERROR_SOURCES; k++) a->share[k] = a->margin[k] = NAN;
    a->order = NAN;
    if (!isfinite(a->whole.deviation)) return;
    a->whole_by_rate = drifts(&a->whole, (double)e->steps * fabs(e->spec.options.step));
    if (e->quad_steps > 0) share_beginning(e, a);
    const bool moves = has_motion(e, a);
    if (e->quad_steps == 0) share_by_halving(e, a, moves, rate);
    a->is_motion = a->share[DAL_SOURCE_MOTION] >= 0.5;
    const double whole = whole_error(a, moves, DAL__WHOLE_RUN, rate);
    if (!e->ran[DAL_COMPARISON_PROJECTION] || !(whole > 0.0)) return;
    const double other = whole_error(a, moves, 1 + DAL_COMPARISON_PROJECTION, rate);
    a->share[DAL_SOURCE_PROJECTION] = fmax(1.0 - other / whole, 0.0);
}
