/* error_words.c - the shares of a drift in words: how each was found, and in a sentence. */
#include "analysis/error_shares.h"
#include <math.h>
#include <stdio.h>

typedef struct description {
    const dal_error_budget *e;
    const dal_shares *a;
    char *text;
    size_t size;
} description;

static bool is_described(const dal_error_budget *e, int observable, char *buffer, size_t size)
{
    if (!e || !buffer || observable < 0 || observable >= e->observables) return false;
    if (size > 0) buffer[0] = '\0';
    return true;
}

/* ---- how a share was found ---- */

/* The drift of a comparison over the drift of the run. */
static double drift_ratio(const description *s, dal_comparison_run comparison)
{
    const dal_trend *all = &s->a->whole, *other = &s->a->comparison[comparison];
    return s->a->whole_by_rate ? fabs(other->rate / all->rate) : other->deviation / all->deviation;
}

/* The same of the error, where the motion changes the quantity. */
static double projection_ratio(const description *s)
{
    const double share = s->a->share[DAL_SOURCE_PROJECTION];
    return !s->a->is_conserved && share > 0.0 ? 1.0 - share
                                              : drift_ratio(s, DAL_COMPARISON_PROJECTION);
}

static void describe_order(const description *s, const char *before)
{
    const bool by_rate = s->e->quad_steps > 0 ? s->a->by_rate : s->a->whole_by_rate;
    if (s->e->quad_steps == 0 && !s->e->ran[DAL_COMPARISON_HALVED])
        snprintf(s->text, s->size, "neither quad precision nor a run with half the step: %s",
                 s->e->reason[DAL_COMPARISON_HALVED]);
    else if (isnan(s->a->order))
        snprintf(s->text, s->size, "%s %s", before,
                 s->a->vanishes_in_quad ? "nothing of it remains"
                                        : "nothing of it remains when the step is halved");
    else
        snprintf(s->text, s->size, "%s %s %s by %.3g = 2^%.2f when the step is halved", before,
                 by_rate ? "the rate" : "the deviation", s->a->order < 0.0 ? "grows" : "falls",
                 exp2(fabs(s->a->order)), fabs(s->a->order));
}

static void describe_motion(const description *s)
{
    const dal_error_budget *e = s->e;
    if (e->ran[DAL_COMPARISON_EXACT] && s->a->is_conserved)
        snprintf(s->text, s->size, "along the exact motion it does not change");
    else if (s->a->is_conserved)
        snprintf(s->text, s->size, "the motion conserves it");
    else if (!e->ran[DAL_COMPARISON_EXACT] && s->a->is_motion)
        snprintf(s->text, s->size,
                 "what quad precision leaves does not fall when the step is halved");
    else if (!e->ran[DAL_COMPARISON_EXACT])
        snprintf(s->text, s->size, "no exact motion: %s", e->reason[DAL_COMPARISON_EXACT]);
    else if (s->a->share[DAL_SOURCE_MOTION] == 0.0)
        snprintf(s->text, s->size, "quad precision leaves next to nothing: rounding errors grow");
    else
        snprintf(s->text, s->size, "along the exact motion the drift is %.3g times this",
                 drift_ratio(s, DAL_COMPARISON_EXACT));
}

static void describe_truncation(const description *s)
{
    const bool moves = s->e->ran[DAL_COMPARISON_EXACT] && s->a->share[DAL_SOURCE_MOTION] > 0.0;
    if (s->a->share[DAL_SOURCE_COEFFICIENTS] > 0.0 || s->a->share[DAL_SOURCE_BRANCHES] > 0.0)
        snprintf(s->text, s->size, "what %s does not fall by 2^%d when the step is halved",
                 s->e->quad_steps > 0 ? "quad precision leaves" : "there is",
                 dal_method_order(&s->e->spec.method));
    else if (s->e->quad_steps == 0)
        describe_order(s, isnan(s->a->share[DAL_SOURCE_TRUNCATION])
                              ? "halving alone, without quad precision, is not conclusive:"
                              : "by halving alone:");
    else
        describe_order(s,
                       moves ? "in quad precision, less the exact motion," : "in quad precision");
}

static void describe_branches(const description *s)
{
    char words[128];
    description inner = *s;
    if (!dal__has_branches(s->e->spec.system)) {
        snprintf(s->text, s->size, "the equations have no branches");
    } else if (!(s->a->share[DAL_SOURCE_BRANCHES] > 0.0)) {
        snprintf(s->text, s->size, "truncation falls as in smooth equations");
    } else {
        inner.text = words, inner.size = sizeof words;
        describe_order(&inner, s->e->quad_steps > 0 ? "in quad precision" : "");
        snprintf(s->text, s->size, "the equations contain %s: %s, not by 2^%d",
                 s->e->spec.system->series->refused, words, dal_method_order(&s->e->spec.method));
    }
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
    if (!s->e->ran[DAL_COMPARISON_TIGHTER])
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
        snprintf(s->text, s->size, "%s the %s is %.3g times this",
                 s->e->has_projection ? "without projection" : "with +project",
                 s->a->is_conserved ? "drift" : "error", projection_ratio(s));
}

char *dal_error_budget_describe(const dal_error_budget *e, int observable, dal_error_source source,
                                char *buffer, size_t size)
{
    static void (*const describe[])(const description *) = {
        describe_motion, describe_truncation, describe_branches,  describe_coefficients,
        describe_solver, describe_rounding,   describe_projection};
    if (!is_described(e, observable, buffer, size)) return NULL;
    const description s = {e, &e->shares[observable], buffer, size};
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

/* ---- a sentence ---- */

/* Sources below the first part of a change are not named, or, beside the motion, apart from it;
 * above the second there is no other one. */
static const double named = 0.01, alone = 0.95;
/* What projection removes at least of a drift that D = 0 would not have. */
static const double by_constraints = 0.5;

static const char *phrase(dal_error_source source)
{
    switch (source) {
    case DAL_SOURCE_MOTION:
        return "the motion itself";
    case DAL_SOURCE_BRANCHES:
        return "truncation at branches";
    case DAL_SOURCE_COEFFICIENTS:
        return "rounding of coefficients";
    case DAL_SOURCE_SOLVER:
        return "the solver";
    default:
        return dal_error_source_name(source);
    }
}

static void append_words(description *s, const char *format, const char *text, double number)
{
    const int length = snprintf(s->text, s->size, format, text, number);
    const size_t used = length < 0 ? 0 : (size_t)length < s->size ? (size_t)length : s->size;
    s->text += used;
    s->size -= used;
}

/* "0.4 %", "23 %", "100 %" */
static void append_percent(description *s, double share)
{
    if (share >= 0.995)
        append_words(s, "100 %%%s", "", 0.0);
    else
        append_words(s, "%s%.2g %%", "", 100.0 * share);
}

/* The largest share of a source that is named and not done; DAL_ERROR_SOURCES: none. */
static int next_source(const dal_shares *a, const bool *done)
{
    int next = DAL_ERROR_SOURCES;
    for (int k = 0; k < DAL_SOURCE_PROJECTION; k++)
        if (!done[k] && a->share[k] >= named &&
            (next == DAL_ERROR_SOURCES || a->share[k] > a->share[next]))
            next = k;
    return next;
}

/* "by truncation (80 %) and rounding (20 %)"; the largest source. */
static int list_sources(description *s)
{
    bool done[DAL_ERROR_SOURCES] = {false};
    const int first = next_source(s->a, done);
    for (int k = first, next; k < DAL_ERROR_SOURCES; k = next) {
        done[k] = true;
        next = next_source(s->a, done);
        append_words(s,
                     k == first                 ? " by %s ("
                     : next < DAL_ERROR_SOURCES ? ", %s ("
                                                : " and %s (",
                     phrase((dal_error_source)k), 0.0);
        append_percent(s, s->a->share[k]);
        append_words(s, ")%s", "", 0.0);
    }
    return first;
}

/* Which error the step reduces: truncation, with or without branches. */
static int reduced_source(const dal_shares *a)
{
    return a->share[DAL_SOURCE_BRANCHES] > 0.0 ? DAL_SOURCE_BRANCHES : DAL_SOURCE_TRUNCATION;
}

static void advise_step(description *s, const char *what)
{
    const dal_options *o = &s->e->spec.options;
    const double order = s->a->order, divisor = exp2(dal_method_order(&s->e->spec.method));
    if (o->tolerance > 0.0)
        append_words(s, ": divide the tolerance by %s%.0f", "", divisor);
    else
        append_words(s, ": halve the step%s", "", 0.0);
    if (order < 0.5)
        append_words(s, " and %s does not fall", what, 0.0);
    else
        append_words(s, " and %s falls by %.3g", what, exp2(order));
}

/* What is smaller than what is named, beside the motion. */
static void add_error_of_motion(description *s, int source)
{
    append_words(s, "; %s is ", phrase((dal_error_source)source), 0.0);
    append_percent(s, s->a->share[source]);
    advise_step(s, "it");
}

static void advise(description *s, int first)
{
    const int reduced = reduced_source(s->a);
    const double share = s->a->share[reduced];
    if (s->a->whole.conservation == DAL_OFF_SURFACE &&
        s->a->share[DAL_SOURCE_PROJECTION] > by_constraints && !s->e->has_projection)
        append_words(s, ", because D does%s", "", 0.0);
    if (first == DAL_SOURCE_SOLVER)
        append_words(s, ": solve the equations further%s", "", 0.0);
    else if (first == DAL_SOURCE_ROUNDING && s->e->spec.options.sums == DAL_SUMS_PLAIN &&
             s->e->ran[DAL_COMPARISON_SUMS])
        append_words(s, ": with compensated sums%s it is %.2g times this", "",
                     drift_ratio(s, DAL_COMPARISON_SUMS));
    else if (share > 0.0 && share < named && s->a->is_motion && !isnan(s->a->order))
        add_error_of_motion(s, reduced);
    else if (share >= named && !isnan(s->a->order))
        advise_step(s, share >= alone ? "it" : phrase((dal_error_source)reduced));
}

char *dal_error_budget_summarise(const dal_error_budget *e, int observable, char *buffer,
                                 size_t size)
{
    if (!is_described(e, observable, buffer, size)) return NULL;
    const dal_shares *a = &e->shares[observable];
    description s = {e, a, buffer, size};
    if (!isfinite(a->whole.deviation))
        append_words(&s, "is not finite%s", "", 0.0);
    else if (!(a->whole.deviation > 0.0))
        append_words(&s, "never changes%s", "", 0.0);
    else if (a->is_conserved && a->whole.size == DAL_SIZE_ROUNDING)
        append_words(&s, "stays at rounding%s", "", 0.0);
    else {
        append_words(&s, "%s",
                     a->is_motion       ? "changes"
                     : a->whole_by_rate ? "drifts"
                                        : "varies",
                     0.0);
        const int first = list_sources(&s);
        if (first < DAL_ERROR_SOURCES)
            advise(&s, first);
        else
            append_words(&s, "; these runs do not say by what%s", "", 0.0);
    }
    return buffer;
}
