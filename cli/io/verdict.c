/* verdict.c - size and trend of a quantity in words, for a screen. */
#include "verdict.h"

#include <math.h>
#include <stdio.h>

static void describe_trend(const dal_trend *t, char *text, size_t size)
{
    char rate[SCREEN_NUMBER], moved[SCREEN_NUMBER];
    screen_number(moved, t->deviation, 2);
    switch (t->trend) {
    case DAL_TREND_NONE:
        snprintf(text, size, "stays about one value, within %s", moved);
        break;
    case DAL_TREND_SETTLES:
        snprintf(text, size, "changes once, by %s, and then stays", moved);
        break;
    case DAL_TREND_RANDOM_WALK:
        snprintf(text, size, "grows like the square root of t, %s so far", moved);
        break;
    case DAL_TREND_LINEAR:
        snprintf(text, size, "grows like t: %s per unit of time, %s so far",
                 screen_number(rate, fabs(t->rate), 2), moved);
        break;
    case DAL_TREND_POWER:
        snprintf(text, size, "grows like t^%.2g, %s so far", t->exponent, moved);
        break;
    case DAL_TREND_EXPONENTIAL:
        snprintf(text, size, "grows exponentially, %s so far", moved);
        break;
    case DAL_TREND_GROWING:
        snprintf(text, size, "oscillates, and its amplitude grows, %s so far", moved);
        break;
    case DAL_TREND_ABORTED:
        snprintf(text, size, "the run ended early, or a value was not finite");
        break;
    default:
        snprintf(text, size, "too short to say, %s so far", moved);
    }
}

verdict verdict_of(const dal_trend *t)
{
    verdict v = {.colour = SCREEN_ROUNDING};
    char moved[SCREEN_NUMBER];
    if (t->conservation != DAL_CONSERVED) {
        v.word = "not stated";
        v.colour = SCREEN_FAINT;
        snprintf(v.text, sizeof v.text, "%s; moved by %s", dal_conservation_text(t->conservation),
                 screen_number(moved, t->deviation, 2));
    } else if (t->size != DAL_SIZE_LARGER && t->trend != DAL_TREND_ABORTED) {
        v.word = dal_size_text(t->size);
        if (t->size == DAL_SIZE_EXACT || t->trend == DAL_TREND_NONE ||
            t->trend == DAL_TREND_UNDECIDED)
            return v;
        describe_trend(t, v.text, sizeof v.text);
    } else {
        v.word = dal_trend_text(t->trend);
        v.colour = t->trend == DAL_TREND_ABORTED ? SCREEN_LARGE : screen_colour_of(t->deviation);
        describe_trend(t, v.text, sizeof v.text);
    }
    return v;
}
