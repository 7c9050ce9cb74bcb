/* words.c - how the shares of a drift were found, in words. */
#include "analysis/causes.h"
#include "analysis/measure.h"
#include <math.h>
#include <stdio.h>

typedef struct sheet {
    const dal_explanation *e;
    const dal_attribution *a;
    char *text;
    size_t size;
} sheet;

/* How many times as large the drift of a twin of the whole run is. */
static double times(const sheet *s, dal_twin twin)
{
    const dal_trend *all = &s->a->all, *other = &s->a->twin[twin];
    return s->a->all_by_rate ? fabs(other->rate / all->rate) : other->deviation / all->deviation;
}

static const char *what(const sheet *s) { return s->a->by_rate ? "the rate" : "the deviation"; }

static void say_order(const sheet *s, const char *before)
{
    const char *of = s->e->early > 0 ? what(s) : s->a->all_by_rate ? "the rate" : "the deviation";
    if (isnan(s->a->order))
        snprintf(s->text, s->size, "%s %s", before,
                 s->a->is_nothing ? "nothing of it is left"
                                  : "nothing of it is left when the step is halved");
    else
        snprintf(s->text, s->size, "%s %s falls by %.3g = 2^%.2f when the step is halved", before,
                 of, exp2(s->a->order), s->a->order);
}

static void say_truncation(const sheet *s)
{
    if (s->e->early == 0)
        say_order(s, isnan(s->a->share[DAL_CAUSE_TRUNCATION])
                         ? "without long numbers halving alone does not tell:"
                         : "by halving alone:");
    else if (s->a->is_motion)
        say_order(s, "the motion itself changes it:");
    else if (s->a->share[DAL_CAUSE_COEFFICIENTS] != 0.0)
        snprintf(s->text, s->size, "what long numbers leave does not fall by 2^%d",
                 dal_method_order(&s->e->spec.method));
    else
        say_order(s, "in long numbers");
}

static void say_coefficients(const sheet *s)
{
    if (s->e->early == 0)
        snprintf(s->text, s->size, "without long numbers they cannot be told from truncation");
    else if (s->a->share[DAL_CAUSE_COEFFICIENTS] == 0.0)
        snprintf(s->text, s->size, "what long numbers leave is truncation, or nothing");
    else
        snprintf(s->text, s->size,
                 "what long numbers leave falls by %.3g = 2^%.2f when the step is halved, not by "
                 "2^%d: coefficients are doubles",
                 exp2(s->a->order), s->a->order, dal_method_order(&s->e->spec.method));
}

static void say_solver(const sheet *s)
{
    if (s->e->ran[DAL_TWIN_TIGHTER] == 0)
        snprintf(s->text, s->size, "%s", s->e->why[DAL_TWIN_TIGHTER]);
    else if (s->e->early == 0)
        snprintf(s->text, s->size, "solved further the drift is %.3g times this",
                 times(s, DAL_TWIN_TIGHTER));
    else if (s->a->solver_tells)
        snprintf(s->text, s->size,
                 "that much goes when the equations are solved to rounding "
                 "and two sweeps on");
    else
        snprintf(s->text, s->size, "two sweeps more change no more than roundings do");
}

static void say_rounding(const sheet *s)
{
    const char *sums = s->e->spec.options.sums == DAL_SUMS_PLAIN ? "compensated" : "plain";
    if (s->e->early == 0)
        snprintf(s->text, s->size, "no long numbers: %s", s->e->why[DAL_TWIN_LONG]);
    else if (!s->e->ran[DAL_TWIN_SUMS])
        snprintf(s->text, s->size, "that much goes in long numbers");
    else
        snprintf(s->text, s->size,
                 "that much goes in long numbers; with %s sums the drift is %.3g times this", sums,
                 times(s, DAL_TWIN_SUMS));
}

static void say_projection(const sheet *s)
{
    if (!s->e->ran[DAL_TWIN_PROJECTION])
        snprintf(s->text, s->size, "%s", s->e->why[DAL_TWIN_PROJECTION]);
    else
        snprintf(s->text, s->size, "%s the drift is %.3g times this",
                 s->e->projects ? "without projection" : "with +project",
                 times(s, DAL_TWIN_PROJECTION));
}

char *dal_cause_words(const dal_explanation *e, int observable, dal_cause cause, char *buffer,
                      size_t size)
{
    static void (*const say[])(const sheet *) = {say_truncation, say_coefficients, say_solver,
                                                 say_rounding, say_projection};
    if (!e || !buffer || observable < 0 || observable >= e->observables) return NULL;
    const sheet s = {e, &e->of[observable], buffer, size};
    if (size > 0) buffer[0] = '\0';
    if (!isfinite(s.a->all.deviation))
        snprintf(buffer, size, "it is not finite");
    else if (!(s.a->all.deviation > 0.0))
        snprintf(buffer, size, "it never changes");
    else if (e->early > 0 && !(s.a->early.deviation > 0.0) && cause != DAL_CAUSE_PROJECTION)
        snprintf(buffer, size, "it does not change in the first %lld steps", e->early);
    else if ((unsigned)cause < DAL_CAUSES)
        say[cause](&s);
    return buffer;
}
