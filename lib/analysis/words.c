/* words.c - how the shares of a drift were found, in words. */
#include "analysis/error_shares.h"
#include "analysis/measure.h"
#include <math.h>
#include <stdio.h>

typedef struct sheet {
    const dal_error_budget *e;
    const dal_shares *a;
    char *text;
    size_t size;
} sheet;

/* How many times as large the drift of a twin of the whole run is. */
static double times(const sheet *s, dal_comparison_run comparison)
{
    const dal_trend *all = &s->a->whole, *other = &s->a->comparison[comparison];
    return s->a->whole_by_rate ? fabs(other->rate / all->rate) : other->deviation / all->deviation;
}

static const char *what(const sheet *s) { return s->a->by_rate ? "the rate" : "the deviation"; }

static void describe_order(const sheet *s, const char *before)
{
    const char *of = s->e->quad_steps > 0  ? what(s)
                     : s->a->whole_by_rate ? "the rate"
                                           : "the deviation";
    if (isnan(s->a->order))
        snprintf(s->text, s->size, "%s %s", before,
                 s->a->vanishes_in_quad ? "nothing of it is left"
                                        : "nothing of it is left when the step is halved");
    else
        snprintf(s->text, s->size, "%s %s falls by %.3g = 2^%.2f when the step is halved", before,
                 of, exp2(s->a->order), s->a->order);
}

static void describe_truncation(const sheet *s)
{
    if (s->e->quad_steps == 0)
        describe_order(s, isnan(s->a->share[DAL_SOURCE_TRUNCATION])
                              ? "without quad precision halving alone does not tell:"
                              : "by halving alone:");
    else if (s->a->is_motion)
        describe_order(s, "the motion itself changes it:");
    else if (s->a->share[DAL_SOURCE_COEFFICIENTS] != 0.0)
        snprintf(s->text, s->size, "what quad precision leaves does not fall by 2^%d",
                 dal_method_order(&s->e->spec.method));
    else
        describe_order(s, "in quad precision");
}

static void describe_coefficients(const sheet *s)
{
    if (s->e->quad_steps == 0)
        snprintf(s->text, s->size, "without quad precision they cannot be told from truncation");
    else if (s->a->share[DAL_SOURCE_COEFFICIENTS] == 0.0)
        snprintf(s->text, s->size, "what quad precision leaves is truncation, or nothing");
    else
        snprintf(s->text, s->size,
                 "what quad precision leaves falls by %.3g = 2^%.2f when the step is halved, not "
                 "by 2^%d: coefficients are doubles",
                 exp2(s->a->order), s->a->order, dal_method_order(&s->e->spec.method));
}

static void describe_solver(const sheet *s)
{
    if (s->e->ran[DAL_COMPARISON_TIGHTER] == 0)
        snprintf(s->text, s->size, "%s", s->e->reason[DAL_COMPARISON_TIGHTER]);
    else if (s->e->quad_steps == 0)
        snprintf(s->text, s->size, "solved further the drift is %.3g times this",
                 times(s, DAL_COMPARISON_TIGHTER));
    else if (s->a->solver_is_significant)
        snprintf(
            s->text, s->size,
            "that much goes when the equations are solved to rounding and iterated twice more");
    else
        snprintf(s->text, s->size, "two more iterations change no more than roundings do");
}

static void describe_rounding(const sheet *s)
{
    const char *sums = s->e->spec.options.sums == DAL_SUMS_PLAIN ? "compensated" : "plain";
    if (s->e->quad_steps == 0)
        snprintf(s->text, s->size, "no quad precision: %s", s->e->reason[DAL_COMPARISON_QUAD]);
    else if (!s->e->ran[DAL_COMPARISON_SUMS])
        snprintf(s->text, s->size, "that much goes in quad precision");
    else
        snprintf(s->text, s->size,
                 "that much goes in quad precision; with %s sums the drift is %.3g times this",
                 sums, times(s, DAL_COMPARISON_SUMS));
}

static void describe_projection(const sheet *s)
{
    if (!s->e->ran[DAL_COMPARISON_PROJECTION])
        snprintf(s->text, s->size, "%s", s->e->reason[DAL_COMPARISON_PROJECTION]);
    else
        snprintf(s->text, s->size, "%s the drift is %.3g times this",
                 s->e->has_projection ? "without projection" : "with +project",
                 times(s, DAL_COMPARISON_PROJECTION));
}

char *dal_error_budget_describe(const dal_error_budget *e, int observable, dal_error_source source,
                                char *buffer, size_t size)
{
    static void (*const describe[])(const sheet *) = {describe_truncation, describe_coefficients,
                                                      describe_solver, describe_rounding,
                                                      describe_projection};
    if (!e || !buffer || observable < 0 || observable >= e->observables) return NULL;
    const sheet s = {e, &e->shares[observable], buffer, size};
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
