/* error_shares.c - the shares of a drift, from the trends of a run and of its comparisons.
 *
 * A drift is measured by its rate where the line of least squares rises by at least half of the max
 * deviation and its interval excludes 0; rates of parts add up to that of the sum.  Otherwise it is
 * measured by the max deviation, and shares need not add up. */
#include "analysis/error_shares.h"
#include "core/words.h"
#include <float.h>
#include <math.h>
#include <stdio.h>

/* The solver's part must exceed what rounding does by this, or be a rate this far from zero. */
static const double significant = 4.0, clear = 2.0;
/* Parts of a drift: below the first a source is none; below the second the rest is rounding in quad
 * precision. */
static const double small = 0.1, nothing = 1e-12;
/* The effect of coefficients in each step, in roundings of the scale, at most. */
static const double coefficient_roundings = 16.0;
static const double half_an_order = 0.5;
/* A change of an observable is the motion's if the exact motion has at least this part of it. */
static const double part_of_motion = 0.5;

const char *dal_error_source_name(dal_error_source source)
{
    DAL__RETURN_WORD(DAL_ERROR_SOURCE_LIST, DAL__SECOND, source, "?");
}

static double half_width(const dal_trend *f) { return 0.5 * (f->rate_high - f->rate_low); }

static int drifts(const dal_trend *f, double time)
{
    return fabs(f->rate) > half_width(f) && fabs(f->rate) * time >= 0.5 * f->deviation;
}

static double size_of(const dal_trend *f, int by_rate)
{
    return by_rate ? fabs(f->rate) : f->deviation;
}

/* log2 of the ratio of a drift to that with half the step; NaN where one is 0. */
static double order_of(const dal_trend *whole, const dal_trend *halved, int by_rate)
{
    const double a = size_of(whole, by_rate), b = size_of(halved, by_rate);
    return a > 0.0 && b > 0.0 ? log2(a / b) : NAN;
}

static void set_share(dal_shares *a, dal_error_source source, const dal_trend *part)
{
    const double whole = size_of(&a->beginning, a->by_rate);
    a->share[source] = a->by_rate ? part->rate / a->beginning.rate : part->deviation / whole;
    a->margin[source] = a->by_rate ? half_width(part) / whole : NAN;
}

/* Whether what quad precision leaves comes from coefficients: it is small, and does not fall with
 * the step as the order of the method says. */
static int is_of_coefficients(const dal_error_budget *e, const dal_shares *a)
{
    const double max =
        coefficient_roundings * DBL_EPSILON * a->beginning.scale * (double)e->quad_steps;
    const int order = dal_method_order(&e->spec.method);
    return a->comparison[DAL_COMPARISON_QUAD].deviation <= max && !isnan(a->order) &&
           a->order < order - half_an_order;
}

/* What quad precision leaves is truncation, an error of coefficients, or the motion itself, which
 * does not fall with the step at all.  Where it leaves next to nothing, rounding errors have grown
 * with the motion: those of the exact motion in doubles do, too. */
static void weigh_quad(const dal_error_budget *e, dal_shares *a)
{
    const dal_trend *quad = &a->comparison[DAL_COMPARISON_QUAD];
    const double whole = size_of(&a->beginning, a->by_rate);
    a->vanishes_in_quad = size_of(quad, a->by_rate) <= nothing * whole ||
                          quad->deviation <= 2.0 * DBL_EPSILON * a->beginning.max_abs;
    if (!a->vanishes_in_quad)
        a->order = order_of(quad, &a->comparison[DAL_COMPARISON_QUAD_HALVED], a->by_rate);
    const int coefficients = is_of_coefficients(e, a);
    if (!e->ran[DAL_COMPARISON_EXACT])
        a->is_motion = !coefficients && a->order < half_an_order;
    else if (size_of(quad, a->by_rate) < small * whole)
        a->is_motion = 0;
    set_share(a, coefficients ? DAL_SOURCE_COEFFICIENTS : DAL_SOURCE_TRUNCATION, quad);
    a->share[coefficients ? DAL_SOURCE_TRUNCATION : DAL_SOURCE_COEFFICIENTS] = 0.0;
    if (a->is_motion) a->share[DAL_SOURCE_TRUNCATION] = a->margin[DAL_SOURCE_TRUNCATION] = NAN;
}

/* Quad precision separates truncation and coefficients from rounding, more iterations the solver.
 */
static void share_beginning(const dal_error_budget *e, dal_shares *a)
{
    a->by_rate = drifts(&a->beginning, (double)e->quad_steps * e->spec.options.step);
    if (!(size_of(&a->beginning, a->by_rate) > 0.0)) return;
    weigh_quad(e, a);
    const int moves = a->by_rate && fabs(a->solver.rate) > clear * half_width(&a->solver);
    a->solver_is_significant = a->solver.deviation > significant * a->rounding.deviation || moves;
    set_share(a, DAL_SOURCE_ROUNDING,
              a->solver_is_significant ? &a->rounding : &a->solver_and_rounding);
    if (a->solver_is_significant)
        set_share(a, DAL_SOURCE_SOLVER, &a->solver);
    else if (!e->ran[DAL_COMPARISON_TIGHTER] ||
             a->solver.deviation < small * a->beginning.deviation)
        a->share[DAL_SOURCE_SOLVER] = 0.0;
}

/* Without quad precision: halving the step divides truncation T by 2^p and leaves the rest. */
static void share_by_halving(const dal_error_budget *e, dal_shares *a)
{
    const double whole = size_of(&a->whole, a->whole_by_rate);
    if (!e->ran[DAL_COMPARISON_HALVED] || !(whole > 0.0)) return;
    const dal_trend *half = &a->comparison[DAL_COMPARISON_HALVED];
    a->order = order_of(&a->whole, half, a->whole_by_rate);
    const double divisor = exp2(dal_method_order(&e->spec.method));
    if (!a->is_motion && fabs(a->order - dal_method_order(&e->spec.method)) < half_an_order)
        a->share[DAL_SOURCE_TRUNCATION] =
            (whole - size_of(half, a->whole_by_rate)) / whole * divisor / (divisor - 1.0);
}

void dal__find_shares(const dal_error_budget *e, dal_shares *a)
{
    for (int k = 0; k < DAL_ERROR_SOURCES; k++) a->share[k] = a->margin[k] = NAN;
    a->order = NAN;
    if (!isfinite(a->whole.deviation)) return;
    a->whole_by_rate = drifts(&a->whole, (double)e->steps * e->spec.options.step);
    /* What rounding alone may change along the exact motion. */
    const dal_trend *exact = &a->comparison[DAL_COMPARISON_EXACT];
    const double roundings = coefficient_roundings * DBL_EPSILON * exact->scale * (double)e->steps;
    a->is_motion =
        e->ran[DAL_COMPARISON_EXACT] && exact->deviation > roundings &&
        size_of(exact, a->whole_by_rate) > part_of_motion * size_of(&a->whole, a->whole_by_rate);
    if (e->quad_steps > 0)
        share_beginning(e, a);
    else
        share_by_halving(e, a);
    const double whole = size_of(&a->whole, a->whole_by_rate);
    if (!e->ran[DAL_COMPARISON_PROJECTION] || !(whole > 0.0)) return;
    const double other = size_of(&a->comparison[DAL_COMPARISON_PROJECTION], a->whole_by_rate);
    a->share[DAL_SOURCE_PROJECTION] = fmax(1.0 - other / whole, 0.0);
}

/* ---- in words ---- */

typedef struct description {
    const dal_error_budget *e;
    const dal_shares *a;
    char *text;
    size_t size;
} description;

/* The drift of a comparison over that of the run. */
static double drift_ratio(const description *s, dal_comparison_run comparison)
{
    const dal_trend *all = &s->a->whole, *other = &s->a->comparison[comparison];
    return s->a->whole_by_rate ? fabs(other->rate / all->rate) : other->deviation / all->deviation;
}

static void describe_order(const description *s, const char *before)
{
    const int by_rate = s->e->quad_steps > 0 ? s->a->by_rate : s->a->whole_by_rate;
    if (s->e->quad_steps == 0 && !s->e->ran[DAL_COMPARISON_HALVED])
        snprintf(s->text, s->size, "neither quad precision nor a run with half the step: %s",
                 s->e->reason[DAL_COMPARISON_HALVED]);
    else if (isnan(s->a->order))
        snprintf(s->text, s->size, "%s %s", before,
                 s->a->vanishes_in_quad ? "nothing of it is left"
                                        : "nothing of it is left when the step is halved");
    else
        snprintf(s->text, s->size, "%s %s %s by %.3g = 2^%.2f when the step is halved", before,
                 by_rate ? "the rate" : "the deviation", s->a->order < 0.0 ? "grows" : "falls",
                 exp2(fabs(s->a->order)), fabs(s->a->order));
}

static void describe_truncation(const description *s)
{
    if (s->a->is_motion && s->e->ran[DAL_COMPARISON_EXACT])
        snprintf(s->text, s->size,
                 "the motion itself %s: along the exact motion the drift is %.3g times this",
                 s->e->quad_steps > 0 ? "changes it" : "changes it, or lets rounding errors grow",
                 drift_ratio(s, DAL_COMPARISON_EXACT));
    else if (s->e->quad_steps == 0)
        describe_order(s, isnan(s->a->share[DAL_SOURCE_TRUNCATION])
                              ? "halving alone, without quad precision, is not conclusive:"
                              : "by halving alone:");
    else if (s->a->is_motion)
        describe_order(s, "the motion itself changes it:");
    else if (s->a->share[DAL_SOURCE_COEFFICIENTS] != 0.0)
        snprintf(s->text, s->size, "what quad precision leaves does not fall by 2^%d",
                 dal_method_order(&s->e->spec.method));
    else
        describe_order(s, "in quad precision");
}

static void describe_coefficients(const description *s)
{
    if (s->e->quad_steps == 0)
        snprintf(s->text, s->size,
                 "without quad precision they cannot be distinguished from truncation");
    else if (s->a->share[DAL_SOURCE_COEFFICIENTS] == 0.0)
        snprintf(s->text, s->size, "what quad precision leaves is %s",
                 s->a->is_motion ? "the motion itself, or truncation" : "truncation, or nothing");
    else
        snprintf(s->text, s->size,
                 "what quad precision leaves falls by %.3g = 2^%.2f when the step is halved, not "
                 "by 2^%d: coefficients are doubles",
                 exp2(s->a->order), s->a->order, dal_method_order(&s->e->spec.method));
}

static void describe_solver(const description *s)
{
    if (s->e->ran[DAL_COMPARISON_TIGHTER] == 0)
        snprintf(s->text, s->size, "%s", s->e->reason[DAL_COMPARISON_TIGHTER]);
    else if (s->e->quad_steps == 0)
        snprintf(s->text, s->size, "solved further the drift is %.3g times this",
                 drift_ratio(s, DAL_COMPARISON_TIGHTER));
    else if (s->a->solver_is_significant)
        snprintf(
            s->text, s->size,
            "this part vanishes when the equations are solved to rounding and iterated twice more");
    else
        snprintf(s->text, s->size, "two more iterations change no more than roundings do");
}

static void describe_rounding(const description *s)
{
    const char *sums = s->e->spec.options.sums == DAL_SUMS_PLAIN ? "compensated" : "plain";
    if (s->e->quad_steps == 0)
        snprintf(s->text, s->size, "no quad precision: %s", s->e->reason[DAL_COMPARISON_QUAD]);
    else if (!s->e->ran[DAL_COMPARISON_SUMS])
        snprintf(s->text, s->size, "this part vanishes in quad precision");
    else
        snprintf(s->text, s->size,
                 "this part vanishes in quad precision; with %s sums the drift is %.3g times this",
                 sums, drift_ratio(s, DAL_COMPARISON_SUMS));
}

static void describe_projection(const description *s)
{
    if (!s->e->ran[DAL_COMPARISON_PROJECTION])
        snprintf(s->text, s->size, "%s", s->e->reason[DAL_COMPARISON_PROJECTION]);
    else
        snprintf(s->text, s->size, "%s the drift is %.3g times this",
                 s->e->has_projection ? "without projection" : "with +project",
                 drift_ratio(s, DAL_COMPARISON_PROJECTION));
}

char *dal_error_budget_describe(const dal_error_budget *e, int observable, dal_error_source source,
                                char *buffer, size_t size)
{
    static void (*const describe[])(const description *) = {describe_truncation,
                                                            describe_coefficients, describe_solver,
                                                            describe_rounding, describe_projection};
    if (!e || !buffer || observable < 0 || observable >= e->observables) return NULL;
    const description s = {e, &e->shares[observable], buffer, size};
    if (size > 0) buffer[0] = '\0';
    if (!isfinite(s.a->whole.deviation))
        snprintf(buffer, size, "it is not finite");
    else if (!(s.a->whole.deviation > 0.0))
        snprintf(buffer, size, "it never changes");
    else if (e->quad_steps > 0 && !(s.a->beginning.deviation > 0.0) &&
             source != DAL_SOURCE_PROJECTION)
        snprintf(buffer, size, "it does not change in the first %lld steps", e->quad_steps);
    else if ((unsigned)source < DAL_ERROR_SOURCES)
        describe[source](&s);
    return buffer;
}
