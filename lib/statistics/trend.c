/* trend.c - the trend of a quantity over a long time, and the size of its deviation.
 *
 * The evidence of shapes and noises (trend_evidence.c) is a posterior of what they mean; tones are
 * removed when each is worth 15 nats.  The meaning of the largest weight is the trend where
 * that weight is large enough and the other numbers agree with it; else the trend is undecided:
 *
 *     none           0 lies in the interval of the rate, and the largest drift that noise without
 *                    a trend admits is below the spread of x: surely where it is small beside it;
 *                    the amplitude does not grow
 *     settles        the change is large beside the spread (else it is none), and what follows it
 *                    is a level (trend_change.c): a line there beside the change is linear, and
 *                    anything else undecided
 *     random walk    a memory of T/9 explains it less well, and 0 lies well inside the interval
 *     linear         0 lies outside it, and the line does not bend
 *     power law      the exponent is known to 0.11, and is not 1
 *     exponential    surely where it rises before the last tenth
 *     growing        the amplitude grows (trend_amplitude.c), and no drift is certain beside it
 *
 * A trend that is likely, but that another one resembles, has a confidence below 0.9.
 *
 *     dal_statistics
 *       -> dal__trend_series   means of blocks in units of the range; tones are removed
 *       -> dal__bins           means of equal bins, their cosine coefficients
 *       -> dal__evidence       how well each shape and each noise explains them
 *       -> dal__interval       the rate, from the same evidence
 *       -> dal_trend           the decision
 *
 * Noise is known to be white where differences of the means of neighbouring blocks are as small as
 * white noise of the deviation within the blocks makes them; for the interval of a rate the slowest
 * waves must be as small, too. */
#include "core/words.h"
#include "statistics/statistics.h"
#include "statistics/trend_amplitude.h"
#include "statistics/trend_change.h"
#include <float.h>
#include <math.h>

enum { MIN_VALUES = 48, MIN_LENGTH = 8, LONG_BLOCKS = 32 };

static const double tone_price = 0.8 * 15.0; /* nats */
static const double interval_level = 0.966;  /* covers 95 %: trend_evidence.c */
static const double white_odds = 20.0, white_low = 0.55, white_high = 1.6;
/* Of white noise in the rate, where its slowest waves are white, too; with short blocks. */
static const double white_rate = 60.0, few_white_rate = 7.5, white_slow = 1.9, whitish_slow = 2.6;
static const double memory_ratio = 3.0; /* of differences: more, and there is memory */

/* The smallest sufficient posteriors. */
static const double enough = 0.75, enough_for_none = 0.65, enough_beside_memory = 0.55,
                    enough_for_walk = 0.58;
/* Of a walk over noise with memory T/9, in nats: only the slowest waves distinguish them. */
static const double walk_evidence = 1.8;
static const double certain_line = 0.5, certain_walk = 0.9;
/* Drifts that count as none, in units of the spread: surely, and at most; beside white noise and
 * tones, beside noise with memory, and beside any noise. */
static const double small_drift = 0.15, large_drift = 0.75;
static const double small_beside_memory = 1.0, large_beside_memory = 2.5, tiny_drift = 0.17;
static const double settled_change = 0.3; /* of the spread */
static const double well_inside = 0.9;    /* the middle of an interval, in half widths */
static const double power_error = 0.11, power_span = 0.2;
/* Of the slope of the second half: the largest half width of its interval beside sure growth. */
static const double clear_growth = 0.4;
static const double not_sure = 0.89; /* the greatest confidence of what is likely, never sure */
static const double steady = 0.3;    /* the probability of growth of what does not grow */
/* A bend of a line, in its margins and in rates. */
static const double clear_bend = 1.2, small_bend = 0.15, large_bend = 0.4;
static const double exploded = 8.0;   /* rise of the logarithm of an amplitude */
static const double one_sided = 0.05; /* the nearer end over the farther one */

/* ---- the description of a series ---- */

/* Everything that the decision depends on. */
typedef struct description {
    dal__trend_series series; /* with its tones */
    dal__bins bins;
    dal__evidence evidence;
    dal__interval drift; /* over the whole series */
    dal__amplitude_growth growth;
    double spread;    /* of x: deviation within and between bins */
    bool has_memory;  /* differences show it */
    double wandering; /* max distance of a mean of bins from the mean of all, with tones */
} description;

/* The mean square of differences of neighbouring means about their mean, over its value for white
 * noise with the deviation within blocks. */
static double difference_ratio(const dal__trend_series *s)
{
    const double mean = (s->mean[s->count - 1] - s->mean[0]) / (s->count - 1);
    double square = 0.0;
    for (int i = 1; i < s->count; i++) {
        const double d = s->mean[i] - s->mean[i - 1] - mean;
        square += d * d;
    }
    return square / (2.0 * (s->count - 1)) * (double)s->length / (s->within * s->within);
}

/* The mean square of the slowest waves less a line, in units of white noise. */
static double slow_ratio(const dal__trend_series *s, const dal__bins *b)
{
    enum { SLOW = 8 };
    double xx = 0.0, xy = 0.0, square = 0.0;
    for (int j = 0; j < DAL__WAVES; j++) {
        const double x = dal__shape_wave[j][DAL__LINEAR_SHAPE];
        xx += x * x;
        xy += x * b->wave[j];
    }
    for (int j = 0; j < SLOW; j++) {
        const double r = b->wave[j] - xy / xx * dal__shape_wave[j][DAL__LINEAR_SHAPE];
        square += r * r / SLOW;
    }
    return square / (s->within * s->within) * (double)s->length * s->count / DAL__BINS;
}

static dal__white_odds odds_of(const description *p, double ratio)
{
    dal__white_odds odds = {1.0, 1.0};
    if (p->series.length < MIN_LENGTH || ratio < white_low || ratio > white_high) return odds;
    odds.trend = white_odds;
    const double slow = slow_ratio(&p->series, &p->bins);
    if (slow < white_slow)
        odds.rate = p->series.length < LONG_BLOCKS ? few_white_rate : white_rate;
    else if (slow < whitish_slow)
        odds.rate = few_white_rate;
    return odds;
}

static void measure_spread(description *p)
{
    const double within = p->series.within;
    double mean = 0.0, square = 0.0;
    for (int m = 0; m < DAL__BINS; m++) mean += p->bins.mean[m] / DAL__BINS;
    for (int m = 0; m < DAL__BINS; m++) {
        const double d = p->bins.mean[m] - mean;
        square += d * d / DAL__BINS;
        p->wandering = fmax(p->wandering, fabs(d));
    }
    p->spread = sqrt(within * within + square);
}

/* Weighs the series as it is, and without tones where it has some. */
static void describe(description *p)
{
    const double ratio = difference_ratio(&p->series);
    dal__trend_series bare = p->series;
    dal__bins bins;
    dal__evidence evidence;
    dal__trend_bin(&p->series, &p->bins);
    measure_spread(p);
    const dal__white_odds odds = odds_of(p, ratio);
    if (odds.rate > 1.0) p->bins.error = 0.0; /* white noise has no waves to leave */
    dal__trend_weigh(&p->bins, odds, &p->evidence);
    p->growth = dal__trend_growth(&p->series);
    p->has_memory = ratio > memory_ratio;
    dal__trend_remove_tones(&bare);
    if (bare.tones > 0) {
        dal__trend_bin(&bare, &bins);
        dal__trend_weigh(&bins, odds, &evidence);
        if (evidence.log_total - tone_price * bare.tones > p->evidence.log_total) {
            p->bins = bins;
            p->evidence = evidence;
            p->has_memory = false;
        }
    }
    p->drift = dal__trend_drift(&p->evidence, interval_level, DAL__ALL_NOISES);
}

/* ---- powers ---- */

/* The power of least S, between powers of the grid by a parabola in log p. */
static double best_power(const dal__evidence *e)
{
    int i = 0;
    for (int k = 1; k < DAL__POWER_SHAPES; k++)
        if (e->power_rest[k] < e->power_rest[i]) i = k;
    if (i == 0) return dal__shape_list[i].parameter;
    if (i == DAL__POWER_SHAPES - 1) return NAN; /* it may be any greater one */
    const double a = log(dal__shape_list[i - 1].parameter), b = log(dal__shape_list[i].parameter);
    const double c = log(dal__shape_list[i + 1].parameter), *const s = e->power_rest + i;
    const double left = (s[0] - s[-1]) / (b - a), right = (s[1] - s[0]) / (c - b);
    return exp(0.5 * (a + b) - 0.5 * left * (c - a) / (right - left));
}

/* The exponent of a power law; NaN where it is not known well. */
static double exponent_of(const dal__evidence *e)
{
    double sum = 0.0, mean = 0.0, square = 0.0, logarithms = 0.0;
    for (int i = 0; i < DAL__PLAIN_SHAPES; i++) {
        const dal__shape *const s = &dal__shape_list[i];
        if (s->meaning != DAL__MEANS_POWER && s->meaning != DAL__MEANS_LINEAR) continue;
        sum += e->shape[i];
        mean += e->shape[i] * s->parameter;
        square += e->shape[i] * s->parameter * s->parameter;
        if (s->parameter == 0.0) logarithms += e->shape[i];
    }
    mean /= sum;
    const double error = sqrt(fmax(square / sum - mean * mean, 0.0));
    if (error > power_error) return NAN;
    if (logarithms > 0.5 * sum) return 0.0;
    const double p = best_power(e);
    return fabs(p - mean) < power_span * fmax(1.0, p) ? p : NAN;
}

/* ---- the decision ---- */

typedef struct decision {
    dal_trend_class trend;
    double confidence, exponent;
    dal_trend_class likeliest; /* where it is undecided */
    dal__interval drift;
} decision;

static bool contains_zero(const dal__interval *i) { return i->low <= 0.0 && i->high >= 0.0; }

static double max_abs(const dal__interval *i) { return fmax(fabs(i->low), fabs(i->high)); }

static bool is_steady(const description *p) { return p->growth.probability < steady; }

static decision undecided(const description *p)
{
    return (decision){DAL_TREND_UNDECIDED, NAN, NAN, DAL_TREND_UNDECIDED, p->drift};
}

static decision decided(const description *p, dal_trend_class trend, double confidence,
                        double exponent)
{
    return (decision){trend, confidence, exponent, trend, p->drift};
}

/* Where only the weight is too small. */
static decision not_enough(const description *p, dal_trend_class likeliest, double weight)
{
    decision d = undecided(p);
    if (weight >= 0.5) d.likeliest = likeliest;
    return d;
}

/* No drift that noise without a trend admits is large. */
static decision decide_none(const description *p, double weight)
{
    const dal__interval drift = dal__trend_drift(&p->evidence, 0.95, DAL__NOISES_WITHOUT_TREND);
    const double admitted = max_abs(&drift) / p->spread;
    const double small = p->has_memory ? small_beside_memory : small_drift;
    const double large = p->has_memory ? large_beside_memory : large_drift;
    const double least = p->has_memory ? enough_beside_memory : enough_for_none;
    if (!is_steady(p) || !contains_zero(&p->drift) || admitted > large) return undecided(p);
    if (weight < least) return not_enough(p, DAL_TREND_NONE, weight);
    return decided(p, DAL_TREND_NONE, admitted < small ? weight : fmin(weight, not_sure), 0.0);
}

/* Whatever the noise is, it admits next to no drift. */
static bool is_tiny(const description *p, dal__meaning likeliest, double weight)
{
    return (likeliest == DAL__MEANS_OTHER || likeliest == DAL__MEANS_NONE ||
            (likeliest == DAL__MEANS_WALK && weight < certain_walk)) &&
           is_steady(p) && contains_zero(&p->drift) && max_abs(&p->drift) < tiny_drift * p->spread;
}

/* A change, by the line after it. */
static decision decide_change(const description *p, double weight)
{
    if (weight < enough) return not_enough(p, DAL_TREND_SETTLES, weight);
    const dal__change change = dal__trend_change(&p->series, &p->bins, &p->evidence);
    decision d = undecided(p);
    if (change.result == DAL__CHANGE_TO_LEVEL)
        d = decided(p, DAL_TREND_SETTLES, change.is_sure ? weight : fmin(weight, not_sure), 0.0);
    if (change.result == DAL__CHANGE_BESIDE_LINE)
        d = decided(p, DAL_TREND_LINEAR, fmin(weight, not_sure), 1.0);
    if (change.result != DAL__CHANGE_UNCLEAR) d.drift = change.rate;
    return d;
}

/* A line, unless it bends. */
static decision decide_line(const description *p, double weight)
{
    const dal__interval bend = dal__trend_bend(&p->bins);
    const double rate = fabs(p->drift.middle), margin = bend.high - bend.middle;
    if (contains_zero(&p->drift)) return undecided(p);
    if (weight < enough) return not_enough(p, DAL_TREND_LINEAR, weight);
    if (fabs(bend.middle) > clear_bend * margin && fabs(bend.middle) > small_bend * rate)
        return undecided(p);
    const bool is_sure = max_abs(&bend) <= large_bend * rate;
    return decided(p, DAL_TREND_LINEAR, is_sure ? weight : fmin(weight, not_sure), 1.0);
}

/* A rise in the last tenth alone may be anything. */
static bool rises_before_the_end(const dal__bins *b)
{
    enum { HALF = DAL__BINS / 2, LATE = 26, COUNT = 3 };
    double mean = 0.0, square = 0.0, late = 0.0;
    for (int m = 0; m < HALF; m++) mean += b->mean[m] / HALF;
    for (int m = 0; m < HALF; m++) square += (b->mean[m] - mean) * (b->mean[m] - mean);
    for (int m = LATE; m < LATE + COUNT; m++) late += b->mean[m] / COUNT;
    return fabs(late - mean) > 3.0 * sqrt(square / (HALF - 1) / COUNT);
}

static decision decide_growth(const description *p, dal__meaning best, double weight)
{
    const double *const weights = p->evidence.meaning;
    switch (best) {
    case DAL__MEANS_POWER: {
        const double exponent = exponent_of(&p->evidence);
        if (weight < enough) return not_enough(p, DAL_TREND_POWER, weight);
        if (isnan(exponent)) return undecided(p);
        /* What hardly grows any more may also have come to a level. */
        const dal__interval late = dal__trend_second_half(&p->bins);
        const bool grows = late.high - late.middle < clear_growth * fabs(late.middle);
        return decided(p, DAL_TREND_POWER, grows ? weight : fmin(weight, not_sure), exponent);
    }
    case DAL__MEANS_EXPONENTIAL:
        if (weight < enough) return not_enough(p, DAL_TREND_EXPONENTIAL, weight);
        return decided(p, DAL_TREND_EXPONENTIAL,
                       rises_before_the_end(&p->bins) ? weight : fmin(weight, not_sure), NAN);
    default:
        return not_enough(p, DAL_TREND_UNDECIDED, weights[best]);
    }
}

/* Values to one side whose amplitude grows by many e-folds: an exponential over more of them than
 * the shapes of trend_tables.h have, or a modulated one. */
static bool explodes(const description *p)
{
    const double below = -p->series.low, above = p->series.high;
    const double half_way = fabs(p->bins.mean[DAL__BINS / 2] - p->bins.mean[0]);
    return p->growth.probability >= enough && p->growth.rise > exploded &&
           p->growth.exponential > 0.5 &&
           fmax(half_way, fmin(below, above)) < one_sided * fmax(below, above);
}

static decision decide(const description *p)
{
    const double *const weight = p->evidence.meaning;
    dal__meaning best = 0;
    for (dal__meaning i = 1; i < DAL__MEANINGS; i++)
        if (weight[i] > weight[best]) best = i;
    const double w = weight[best];
    if (best == DAL__MEANS_OTHER && explodes(p))
        return decided(p, DAL_TREND_EXPONENTIAL, not_sure, NAN);
    const bool drifts = best == DAL__MEANS_LINEAR && w > certain_line && !contains_zero(&p->drift);
    if (p->growth.probability >= enough && !drifts && p->wandering < 0.5 * p->bins.half_range)
        return decided(p, DAL_TREND_GROWING, p->growth.probability, NAN);
    if (best == DAL__MEANS_SETTLES && p->bins.range < settled_change * p->spread)
        best = DAL__MEANS_NONE;
    if (is_tiny(p, best, w))
        return decided(p, DAL_TREND_NONE, fmin(fmax(w, enough), not_sure), 0.0);
    switch (best) {
    case DAL__MEANS_NONE:
        return decide_none(p, w);
    case DAL__MEANS_SETTLES:
        return decide_change(p, w);
    case DAL__MEANS_WALK: {
        const double middle = fabs(p->drift.low + p->drift.high);
        if (p->evidence.walk_over_memory <= walk_evidence ||
            middle >= well_inside * (p->drift.high - p->drift.low))
            return undecided(p);
        return w < enough_for_walk ? not_enough(p, DAL_TREND_RANDOM_WALK, w)
                                   : decided(p, DAL_TREND_RANDOM_WALK, w, 0.5);
    }
    case DAL__MEANS_LINEAR:
        return decide_line(p, w);
    default:
        return decide_growth(p, best, w);
    }
}

/* ---- size ---- */

/* Whether a deviation is what roundings of that many steps make.
 *
 * R = max |x - first| / (eps scale), n steps.  One rounding has a deviation of 0.29 units in the
 * last place; ten to thirty of them in a step make 0.9 to 1.6 eps, and the maximum of their sum
 * passes 2.8 sqrt(n) once in a hundred: 4.5 sqrt(n).  16 sqrt(n) leaves a factor 3.5 for condition.
 * In celestial mechanics an optimal integrator follows sqrt(t), and a bias of a fraction of eps a
 * step shows as t (Brouwer 1937, DOI 10.1086/105423; Rein, Spiegel 2015, DOI
 * 10.1093/mnras/stu2164).  Hence a deviation is
 *
 *     rounding   R <= 64; or the steps are of a hundred eps at most, and the deviation about first,
 *                or about a line of at most one eps a step, is within 16 sqrt(n) and five times
 *                the roughness sqrt(sum of squared steps), which a sum of independent errors
 *                passes once in 10^6 and a smooth change at once.  Where the trend is linear, a
 *                bias, the roughness does not count: its steps are alike;
 *     larger     else, or where a value was not finite. */
static const double few_roundings = 64.0, per_root_step = 16.0, largest_step = 128.0;
static const double smoothness = 5.0; /* deviations in units of the roughness */

static dal_size_class size_of(const dal_statistics *s, double scale, const dal_trend *trend)
{
    const double eps = DBL_EPSILON * scale, steps = (double)s->count - 1.0;
    if (s->lost || !isfinite(scale)) return DAL_SIZE_LARGER;
    if (trend->deviation == 0.0) return DAL_SIZE_EXACT;
    if (trend->deviation <= few_roundings * eps) return DAL_SIZE_ROUNDING;
    const double roughness = dal__roughness(s) / s->factor;
    const double by_steps = per_root_step * eps * sqrt(steps);
    const double max = fmin(by_steps, smoothness * roughness);
    const double per_step = fabs(trend->rate) * fabs(s->to - s->from) / steps;
    const double about_line = trend->trend == DAL_TREND_LINEAR ? by_steps : max;
    const bool is_near =
        trend->deviation <= max || (trend->amplitude <= about_line && per_step <= eps);
    const bool has_small_steps = roughness <= largest_step * eps * sqrt(steps);
    return is_near && has_small_steps ? DAL_SIZE_ROUNDING : DAL_SIZE_LARGER;
}

/* ---- the whole ---- */

/* A drift over the whole series as a rate. */
static double rate_of(const description *p, const dal_statistics *s, double drift)
{
    const double between = fabs(s->block[s->blocks - 1].t - s->block[0].t);
    const double whole = between * (double)s->blocks / ((double)s->blocks - 1.0);
    return drift * p->series.unit / whole / s->factor;
}

static decision classify(const dal_statistics *s, dal_trend *trend)
{
    description p = {0};
    decision d = undecided(&p);
    if (!dal__trend_read(s, &p.series)) {
        dal__trend_line(s, trend);
        return s->count > 1 && !(trend->deviation > 0.0) ? decided(&p, DAL_TREND_NONE, 1.0, 0.0)
                                                         : d;
    }
    describe(&p);
    d = s->count < MIN_VALUES ? undecided(&p) : decide(&p);
    trend->rate = rate_of(&p, s, d.drift.middle);
    trend->rate_low = rate_of(&p, s, d.drift.low);
    trend->rate_high = rate_of(&p, s, d.drift.high);
    return d;
}

void dal_statistics_classify(const dal_statistics *s, double scale, dal_status status,
                             dal_trend *trend)
{
    if (!s || !trend) return;
    *trend = (dal_trend){.count = s->count,
                         .first = s->first,
                         .last = s->last,
                         .scale = scale,
                         .max_abs = dal_statistics_max_abs(s),
                         .deviation = dal_statistics_deviation(s)};
    decision d = classify(s, trend);
    const bool has_ended = status == DAL_STATUS_OK || status == DAL_STATUS_STOPPED;
    if (!has_ended || s->lost || s->count == 0)
        d = (decision){.trend = DAL_TREND_ABORTED,
                       .confidence = NAN,
                       .exponent = NAN,
                       .likeliest = DAL_TREND_ABORTED};
    trend->max_drift = fmax(fabs(trend->rate_low), fabs(trend->rate_high)) * fabs(s->to - s->from);
    trend->amplitude = dal__trend_amplitude(s, trend->rate);
    trend->trend = d.trend;
    trend->likeliest = d.likeliest;
    trend->confidence = d.confidence;
    trend->exponent = d.exponent;
    trend->size = size_of(s, scale, trend);
}

const char *dal_trend_text(dal_trend_class trend)
{
    DAL__RETURN_WORD(DAL_TREND_LIST, DAL__SECOND, trend, "?");
}

const char *dal_size_text(dal_size_class size)
{
    DAL__RETURN_WORD(DAL_SIZE_LIST, DAL__SECOND, size, "?");
}
