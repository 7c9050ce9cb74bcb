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

static dal_verdict power_of(double p)
{
    return fabs(p - 1.0) <= power_margin ? DAL_VERDICT_LINEAR : DAL_VERDICT_POWER;
}

/* Of an oscillation about one value: whether the range within a block grows, and how.  A range that
 * grows is that of the block's end. */
static dal_verdict growth_of_range(const dal_mean *block, int n)
{
    double logs[DAL_BLOCKS], t[DAL_BLOCKS], log_t[DAL_BLOCKS], slope, rate;
    for (int i = 0; i < n; i++) {
        if (!(block[i].most > block[i].least)) return DAL_VERDICT_BOUNDED;
        logs[i] = log(block[i].most - block[i].least);
        t[i] = (i + 1.0) / n;
        log_t[i] = log(t[i]);
    }
    const double by_power = line_residue(log_t, logs, n, &slope);
    const double by_rate = line_residue(t, logs, n, &rate);
    if (rate < least_growth || fmin(by_power, by_rate) > rough_growth * rate * rate)
        return DAL_VERDICT_BOUNDED;
    return by_rate < by_power ? DAL_VERDICT_EXPONENTIAL : power_of(slope);
}

/* ---- what an explanation means ---- */

/* The least criterion by verdict. */
typedef struct ballot {
    double least[DAL_VERDICT_COUNT];
} ballot;

static void vote(ballot *b, dal_verdict verdict, double value)
{
    b->least[verdict] = fmin(b->least[verdict], value);
}

static dal_verdict meaning(dal__trend trend, const dal__explanation *e)
{
    switch (trend) {
    case DAL__TREND_LINE:
        return DAL_VERDICT_LINEAR;
    case DAL__TREND_BENT:
        return fabs(e->parameter) <= 1.0 ? DAL_VERDICT_LINEAR : DAL_VERDICT_POWER;
    case DAL__TREND_POWER:
        return e->parameter < least_power ? DAL_VERDICT_BOUNDED : power_of(e->parameter);
    case DAL__TREND_GROWTH:
        return DAL_VERDICT_EXPONENTIAL;
    case DAL__TREND_SLOW:
        return e->size > small ? DAL_VERDICT_UNDECIDED : DAL_VERDICT_BOUNDED;
    default:
        return DAL_VERDICT_BOUNDED;
    }
}

/* A walk that all its time takes no further than an oscillation about it is none to speak of; one
 * of steps larger than rounding is a power of t. */
static dal_verdict meaning_of_walk(const dal__explanation *walk, const dal__series *s,
                                   long long length, double scale)
{
    const double nearby = exp(s->logs / s->n);
    if (walk->size * sqrt(s->n) < small_walk * nearby) return DAL_VERDICT_BOUNDED;
    return walk->size / sqrt((double)length) <= walk_roundings * scale ? DAL_VERDICT_ROUNDING
                                                                       : DAL_VERDICT_POWER;
}

static void vote_all(ballot *b, const dal__series *s, long long length, double scale)
{
    const double nearby = exp(s->logs / s->n);
    for (dal__trend i = 0; i < DAL__TRENDS; i++) {
        const dal__explanation e = dal__fit_trend(s, i);
        const int is_small = e.size * nearby <= few_roundings * scale;
        vote(b, is_small ? DAL_VERDICT_BOUNDED : meaning(i, &e), e.criterion);
    }
    const dal__explanation plain = dal__fit_walk(s, 0), drifting = dal__fit_walk(s, 1);
    vote(b, meaning_of_walk(&plain, s, length, scale), plain.criterion);
    vote(b, DAL_VERDICT_LINEAR, drifting.criterion);
}

/* ---- the verdict ---- */

static void count_votes(const ballot *b, dal_finding *finding)
{
    int first = 0;
    double sum = 0.0;
    for (int i = 1; i < DAL_VERDICT_COUNT; i++)
        if (b->least[i] < b->least[first]) first = i;
    for (int i = 0; i < DAL_VERDICT_COUNT; i++) sum += exp(0.5 * (b->least[first] - b->least[i]));
    finding->verdict = (dal_verdict)first;
    finding->confidence = 1.0 / sum;
}

static void weigh(const dal_statistics *x, const dal_mean *block, int n, double scale,
                  dal_finding *finding)
{
    const double least_range =
        fmax(quiet * finding->deviation, 8.0 * DBL_EPSILON * finding->greatest);
    const dal__series s = dal__series_of(block, n, least_range);
    ballot b;
    for (int i = 0; i < DAL_VERDICT_COUNT; i++) b.least[i] = INFINITY;
    vote_all(&b, &s, x->length, scale);
    count_votes(&b, finding);
    if (finding->verdict == DAL_VERDICT_BOUNDED) finding->verdict = growth_of_range(block, n);
    if (finding->verdict == DAL_VERDICT_BOUNDED && finding->deviation <= many_roundings * scale)
        finding->verdict = DAL_VERDICT_ROUNDING;
}

/* What can be said without the blocks; -1 when nothing. */
static int at_once(const dal_statistics *x, double scale, int aborted, const dal_finding *finding)
{
    if (aborted || x->lost || x->count == 0) return DAL_VERDICT_ABORTED;
    if (x->count > 1 && finding->deviation == 0.0) return DAL_VERDICT_EXACT;
    if (x->count > 1 && finding->deviation <= few_roundings * scale) return DAL_VERDICT_ROUNDING;
    return x->count < LEAST_VALUES ? DAL_VERDICT_UNDECIDED : -1;
}

void dal__classify(const dal_statistics *x, double scale, int aborted, dal_finding *finding)
{
    dal_mean block[DAL_BLOCKS];
    const int n = dal__blocks(x, block), verdict = at_once(x, scale, aborted, finding);
    finding->confidence = 1.0;
    if (verdict >= 0)
        finding->verdict = (dal_verdict)verdict;
    else
        weigh(x, block, n, scale, finding);
}

const char *dal_verdict_text(dal_verdict verdict)
{
    static const char *const text[] = {
#define X(code, word) word,
        DAL_VERDICT_LIST(X)
#undef X
    };
    return (unsigned)verdict < DAL_VERDICT_COUNT ? text[verdict] : "?";
}
