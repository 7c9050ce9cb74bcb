/* verdict.c - what a quantity does in the long run, from the means of its blocks.
 *
 * The means x_i at t_i, i = 1..N, are explained in several ways:
 *
 *     x = trend(t) + tones(t) + w noise    trend: c, c + a t, c + a (t + b t^2), c + a t^p,
 *                                          c + a exp(+-k t), c + one slow oscillation
 *     x = a t + walk + w noise             a random walk, with and without drift
 *
 * with up to three tones of 2.5 periods or more, and noise in units of w_i, the range of x near
 * t_i, so that noise that grows with x is no surprise.  Each explanation is weighed by Schwarz's
 * criterion (1978, DOI 10.1214/aos/1176344136)
 *
 *     B = N log(sum r^2 / N) + 2 sum log w + k c,      weight exp(-B/2),
 *
 * k counting its numbers, each at the price c = log N + 4: a trend that is none then passes once
 * in some 300 times and not once in twenty.  The verdict is the heaviest; its confidence is the
 * weight of its best explanation among the best of all verdicts.  A trend of some hundred roundings
 * is none to speak of.  A quantity that stays about one
 * value may still swing ever wider: the range within a block decides that. */
#include "measure/fit.h"
#include "measure/statistics.h"
#include <float.h>
#include <math.h>

enum { LEAST_VALUES = 48 };

/* code, its size and its trend */
#define VERDICT_LIST(VERDICT)                                                                      \
    VERDICT(EXACT, EXACT, NONE)                                                                    \
    VERDICT(ROUNDING, ROUNDING, NONE)                                                              \
    VERDICT(BOUNDED, LARGER, NONE)                                                                 \
    VERDICT(LINEAR, LARGER, LINEAR)                                                                \
    VERDICT(POWER, LARGER, POWER)                                                                  \
    VERDICT(EXPONENTIAL, LARGER, EXPONENTIAL)                                                      \
    VERDICT(ABORTED, LARGER, ABORTED)                                                              \
    VERDICT(UNDECIDED, LARGER, UNDECIDED)

typedef enum verdict {
#define VERDICT_CODE(code, size, trend) VERDICT_##code,
    VERDICT_LIST(VERDICT_CODE)
#undef VERDICT_CODE
        VERDICT_COUNT
} verdict;

/* Roundings at which a change of any shape, and one without a trend, is put down to rounding; and
 * the largest step of a walk that is. */
static const double few_roundings = 512 * DBL_EPSILON, many_roundings = 4096 * DBL_EPSILON;
static const double walk_roundings = 512 * DBL_EPSILON;
static const double least_power = 0.1;   /* a power of t below does not grow */
static const double power_margin = 0.15; /* a power of t so near to 1 is a line, slightly bent */
static const double quiet = 1e-6;        /* of the deviation: no range nearby counts for less */
static const double small = 0.05;        /* a slow oscillation in units of the range nearby */
static const double small_walk = 0.5;    /* a walk's whole way, likewise */
static const double least_growth = 1.0;  /* of the logarithm of a range that is said to grow */
static const double rough_growth = 0.02; /* most mean square about that growth, in its units */

/* ---- oscillations that grow ---- */

/* The residue's mean square after a line through y(a), and its slope. */
static double line_residue(const double *a, const double *y, int n, double *slope)
{
    double ma = 0.0, my = 0.0, aa = 0.0, ay = 0.0, yy = 0.0;
    for (int i = 0; i < n; i++) {
        ma += a[i] / n;
        my += y[i] / n;
    }
    for (int i = 0; i < n; i++) {
        aa += (a[i] - ma) * (a[i] - ma);
        ay += (a[i] - ma) * (y[i] - my);
        yy += (y[i] - my) * (y[i] - my);
    }
    *slope = ay / aa;
    return (yy - *slope * ay) / n;
}

static verdict power_of(double p)
{
    return fabs(p - 1.0) <= power_margin ? VERDICT_LINEAR : VERDICT_POWER;
}

/* Of an oscillation about one value: whether the range within a block grows, and how.  A range that
 * grows is that of the block's end. */
static verdict growth_of_range(const dal_mean *block, int n)
{
    double logs[DAL_BLOCKS], t[DAL_BLOCKS], log_t[DAL_BLOCKS], slope, rate;
    for (int i = 0; i < n; i++) {
        if (!(block[i].most > block[i].least)) return VERDICT_BOUNDED;
        logs[i] = log(block[i].most - block[i].least);
        t[i] = (i + 1.0) / n;
        log_t[i] = log(t[i]);
    }
    const double by_power = line_residue(log_t, logs, n, &slope);
    const double by_rate = line_residue(t, logs, n, &rate);
    if (rate < least_growth || fmin(by_power, by_rate) > rough_growth * rate * rate)
        return VERDICT_BOUNDED;
    return by_rate < by_power ? VERDICT_EXPONENTIAL : power_of(slope);
}

/* ---- what an explanation means ---- */

/* The least criterion by verdict. */
typedef struct ballot {
    double least[VERDICT_COUNT];
} ballot;

static void vote(ballot *b, verdict v, double value) { b->least[v] = fmin(b->least[v], value); }

static verdict meaning(dal__trend trend, const dal__explanation *e)
{
    switch (trend) {
    case DAL__TREND_LINE:
        return VERDICT_LINEAR;
    case DAL__TREND_BENT:
        return fabs(e->parameter) <= 1.0 ? VERDICT_LINEAR : VERDICT_POWER;
    case DAL__TREND_POWER:
        return e->parameter < least_power ? VERDICT_BOUNDED : power_of(e->parameter);
    case DAL__TREND_GROWTH:
        return VERDICT_EXPONENTIAL;
    case DAL__TREND_SLOW:
        return e->size > small ? VERDICT_UNDECIDED : VERDICT_BOUNDED;
    default:
        return VERDICT_BOUNDED;
    }
}

/* A walk that all its time takes no further than an oscillation about it is none to speak of; one
 * of steps larger than rounding is a power of t. */
static verdict meaning_of_walk(const dal__explanation *walk, const dal__series *s, long long length,
                               double scale)
{
    const double nearby = exp(s->logs / s->n);
    if (walk->size * sqrt(s->n) < small_walk * nearby) return VERDICT_BOUNDED;
    return walk->size / sqrt((double)length) <= walk_roundings * scale ? VERDICT_ROUNDING
                                                                       : VERDICT_POWER;
}

static void vote_all(ballot *b, const dal__series *s, long long length, double scale)
{
    const double nearby = exp(s->logs / s->n);
    for (dal__trend i = 0; i < DAL__TRENDS; i++) {
        const dal__explanation e = dal__fit_trend(s, i);
        const int is_small = e.size * nearby <= few_roundings * scale;
        vote(b, is_small ? VERDICT_BOUNDED : meaning(i, &e), e.criterion);
    }
    const dal__explanation plain = dal__fit_walk(s, 0), drifting = dal__fit_walk(s, 1);
    vote(b, meaning_of_walk(&plain, s, length, scale), plain.criterion);
    vote(b, VERDICT_LINEAR, drifting.criterion);
}

/* ---- the verdict ---- */

static verdict count_votes(const ballot *b, double *confidence)
{
    int first = 0;
    double sum = 0.0;
    for (int i = 1; i < VERDICT_COUNT; i++)
        if (b->least[i] < b->least[first]) first = i;
    for (int i = 0; i < VERDICT_COUNT; i++) sum += exp(0.5 * (b->least[first] - b->least[i]));
    *confidence = 1.0 / sum;
    return (verdict)first;
}

static verdict weigh(const dal_statistics *x, const dal_mean *block, int n, double scale,
                     dal_trend *trend)
{
    const double least_range = fmax(quiet * trend->deviation, 8.0 * DBL_EPSILON * trend->max_abs);
    const dal__series s = dal__series_of(block, n, least_range);
    ballot b;
    for (int i = 0; i < VERDICT_COUNT; i++) b.least[i] = INFINITY;
    vote_all(&b, &s, x->length, scale);
    verdict v = count_votes(&b, &trend->confidence);
    if (v == VERDICT_BOUNDED) v = growth_of_range(block, n);
    if (v == VERDICT_BOUNDED && trend->deviation <= many_roundings * scale) v = VERDICT_ROUNDING;
    return v;
}

/* What can be said without the blocks; -1 when nothing. */
static int at_once(const dal_statistics *x, double scale, int aborted, const dal_trend *trend)
{
    if (aborted || x->lost || x->count == 0) return VERDICT_ABORTED;
    if (x->count > 1 && trend->deviation == 0.0) return VERDICT_EXACT;
    if (x->count > 1 && trend->deviation <= few_roundings * scale) return VERDICT_ROUNDING;
    return x->count < LEAST_VALUES ? VERDICT_UNDECIDED : -1;
}

void dal__classify(const dal_statistics *x, double scale, int aborted, dal_trend *trend)
{
    static const dal_size_class sizes[] = {
#define VERDICT_SIZE(code, size, trend) DAL_SIZE_##size,
        VERDICT_LIST(VERDICT_SIZE)
#undef VERDICT_SIZE
    };
    static const dal_trend_class trends[] = {
#define VERDICT_TREND(code, size, trend) DAL_TREND_##trend,
        VERDICT_LIST(VERDICT_TREND)
#undef VERDICT_TREND
    };
    dal_mean block[DAL_BLOCKS];
    const int n = dal__blocks(x, block), known = at_once(x, scale, aborted, trend);
    trend->confidence = 1.0;
    const verdict v = known >= 0 ? (verdict)known : weigh(x, block, n, scale, trend);
    trend->size = sizes[v];
    trend->trend = trends[v];
    if (trend->trend == DAL_TREND_UNDECIDED || trend->trend == DAL_TREND_ABORTED)
        trend->exponent = NAN;
}

const char *dal_size_text(dal_size_class size)
{
    static const char *const text[] = {
#define SIZE_WORD(code, word) word,
        DAL_SIZE_LIST(SIZE_WORD)
#undef SIZE_WORD
    };
    return (unsigned)size < DAL_SIZE_COUNT ? text[size] : "?";
}

const char *dal_trend_text(dal_trend_class trend)
{
    static const char *const text[] = {
#define TREND_WORD(code, word) word,
        DAL_TREND_LIST(TREND_WORD)
#undef TREND_WORD
    };
    return (unsigned)trend < DAL_TREND_COUNT ? text[trend] : "?";
}
