/* trend.c - the trend of a quantity over a long time, and the size of its deviation.
 *
 * The evidence of shapes and noises (trend_evidence.c) is a posterior of what they mean; tones are
 * removed when each is worth 15 nats.  The meaning of the largest weight is the trend where
 * that weight is large enough and the other numbers agree with it; else the trend is undecided:
 *
 *     none           0 lies in the interval of the rate, and the largest drift that noise without
 *                    a trend admits is small beside the spread of x; the amplitude does not double
 *     settles        the change is large beside the spread; else it is none
 *     random walk    a memory of T/9 explains it less well, and 0 lies well inside the interval
 *     linear         0 lies outside it
 *     power law      the exponent is known to 0.11, and is not 1
 *     growing        the amplitude grows (see there), and no drift is certain beside it
 *
 *     dal_statistics
 *       -> dal__trend_series   means of blocks in units of the range; tones are removed
 *       -> dal__bins           means of equal bins, their cosine coefficients
 *       -> dal__evidence       how well each shape and each noise explains them
 *       -> dal__interval       the rate, from the same evidence
 *       -> dal_trend           the decision
 *
 * Noise is known to be white where differences of the means of neighbouring blocks are as small as
 * white noise of the spread within the blocks makes them. */
#include "analysis/statistics.h"
#include "analysis/trend_evidence.h"
#include "core/words.h"
#include <float.h>
#include <math.h>

enum { MIN_VALUES = 48, MIN_LENGTH = 8 };

static const double tone_price = 0.8 * 15.0; /* nats */
static const double interval_level = 0.966;  /* covers 95 %: trend_evidence.c */
static const double white_odds = 20.0, white_low = 0.55, white_high = 1.7;
static const double memory_ratio = 3.0; /* of differences: more, and there is memory */

/* The smallest sufficient posteriors. */
static const double enough = 0.75, enough_for_none = 0.65, enough_for_walk = 0.58;
/* Of a walk over noise with memory T/9, in nats: only the slowest waves distinguish them. */
static const double walk_evidence = 1.8;
static const double certain_line = 0.9, certain_walk = 0.9;
/* Drifts that count as none, in units of the spread: beside white noise and tones, beside noise
 * with memory, and beside any noise. */
static const double small_drift = 0.3, small_beside_memory = 1.0, tiny_drift = 0.17;
static const double settled_change = 0.3; /* of the spread */
static const double well_inside = 0.9;    /* the middle of an interval, in half widths */
static const double power_error = 0.11, power_span = 0.2;
static const double not_sure = 0.9; /* the confidence where weights do not give one */

/* ---- the growth of an amplitude ---- */

/* a_i is the range of x over five blocks about block i; z = log a.  The amplitude grows when z
 * rises by more than 1 and
 *
 *     z = c + p log s    or    z = c + k s,     s = t/T,
 *
 * leaves residues whose root mean square is a small part of that rise.  Noise may cover the
 * beginning: if the whole does not fit, the part well above the beginning is tried.  Beats of two
 * tones rise by as much, but in other shapes.  Values to one side whose z rises in this way by many
 * e-folds explode: an exponential over more e-folds than the shapes of trend_tables.h have, or a
 * modulated one, is found in z alone. */
/* What the amplitude of an oscillation does: LARGER by a factor of 2 and more, in no known way.
 * EXPLODES: no oscillation, but values to one side that grow by equal factors in equal times. */
typedef enum growth { STEADY, LARGER, EXPLODES, GROWS, GROWS_FAST } growth;

enum { NEAR = 2, MIN_POINTS = 10 };

static const double doubled = 0.7, grown = 1.0; /* rises of z */
static const double misfit = 0.035;             /* of the rise */
static const double clear_of_noise = 1.5;       /* rise of z above the beginning */

static const double exploded = 8.0;   /* rise of z */
static const double one_sided = 0.05; /* the nearer end over the farther one */

typedef struct curve {
    int count;
    double s[DAL_STATISTICS_BLOCKS], log_s[DAL_STATISTICS_BLOCKS], z[DAL_STATISTICS_BLOCKS];
} curve;

static bool read_curve(const dal__trend_series *x, curve *c)
{
    c->count = 0;
    for (int i = NEAR; i < x->count - NEAR; i++) {
        double low = INFINITY, high = -INFINITY;
        for (int k = i - NEAR; k <= i + NEAR; k++) {
            low = fmin(low, x->min[k]);
            high = fmax(high, x->max[k]);
        }
        if (!(high > low)) return false;
        c->s[c->count] = (i + 0.5) / x->count;
        c->log_s[c->count] = log(c->s[c->count]);
        c->z[c->count++] = log(high - low);
    }
    return true;
}

/* The root mean square of the residues of z about a rising line through (u, z). */
static double residue(const double *u, const double *z, int n)
{
    double mu = 0.0, mz = 0.0, uu = 0.0, uz = 0.0, zz = 0.0;
    for (int i = 0; i < n; i++) {
        mu += u[i] / n;
        mz += z[i] / n;
    }
    for (int i = 0; i < n; i++) {
        uu += (u[i] - mu) * (u[i] - mu);
        uz += (u[i] - mu) * (z[i] - mz);
        zz += (z[i] - mz) * (z[i] - mz);
    }
    return uz > 0.0 ? sqrt(fmax(zz - uz * uz / uu, 0.0) / n) : INFINITY;
}

/* From point `from` on. */
static growth growth_from(const curve *c, int from)
{
    const int n = c->count - from;
    if (n < MIN_POINTS) return LARGER;
    const double rise = c->z[c->count - 1] - c->z[from];
    const double by_power = residue(c->log_s + from, c->z + from, n);
    const double by_rate = residue(c->s + from, c->z + from, n);
    if (rise < grown || fmin(by_power, by_rate) > misfit * rise) return LARGER;
    return by_rate < by_power ? GROWS_FAST : GROWS;
}

static growth growth_of(const dal__trend_series *x)
{
    curve c;
    double rise = 0.0;
    if (!read_curve(x, &c)) return STEADY;
    const int eighth = x->count / 8;
    for (int i = 0; i < eighth; i++) rise += (c.z[c.count - 1 - i] - c.z[i]) / eighth;
    if (rise < doubled) return STEADY;
    if (rise < grown) return LARGER;
    const growth whole = growth_from(&c, 0);
    const double below = -x->low, above = x->high;
    const bool is_one_sided = fmin(below, above) < one_sided * fmax(below, above);
    if (whole == GROWS_FAST && rise > exploded && is_one_sided) return EXPLODES;
    int from = 0;
    while (from < c.count && c.z[from] < c.z[0] + clear_of_noise) from++;
    return whole != LARGER ? whole : growth_from(&c, from);
}

/* ---- the description of a series ---- */

/* Everything that the decision depends on. */
typedef struct description {
    dal__trend_series series; /* with its tones */
    dal__bins bins;
    dal__evidence evidence;
    dal__interval drift; /* over the whole series */
    growth growth;
    double spread;      /* of x: deviation within and between bins */
    double small_drift; /* that counts as none */
    double wandering;   /* max distance of a mean of bins from the mean of all, with tones */
} description;

/* The deviation within blocks of n values from their mean range: for n normal numbers it grows like
 * sqrt(2 log n); for an oscillation, the same in all blocks, it is 2 sqrt(2) deviations. */
static double within_blocks(const dal__trend_series *s)
{
    const double normal = 0.1 + 1.6 * sqrt(2.0 * log((double)s->length)), wave = 2.0 * sqrt(2.0);
    return s->block_range / (s->is_steady ? wave : fmax(wave, normal));
}

/* The mean square of differences of neighbouring means, in units of that of white noise. */
static double difference_ratio(const dal__trend_series *s)
{
    const double within = within_blocks(s);
    double square = 0.0;
    for (int i = 1; i < s->count; i++) {
        const double d = s->mean[i] - s->mean[i - 1];
        square += d * d;
    }
    return square / (2.0 * (s->count - 1)) * (double)s->length / (within * within);
}

/* Weighs the series as it is, and without tones where it has some. */
static void describe(description *p)
{
    const double ratio = difference_ratio(&p->series);
    const bool long_enough = p->series.length >= MIN_LENGTH;
    const double odds = long_enough && ratio > white_low && ratio < white_high ? white_odds : 1.0;
    dal__trend_series bare = p->series;
    dal__bins bins;
    dal__evidence evidence;
    dal__trend_bin(&p->series, &p->bins);
    const double within = within_blocks(&p->series);
    double mean = 0.0, square = 0.0;
    for (int m = 0; m < DAL__BINS; m++) mean += p->bins.mean[m] / DAL__BINS;
    for (int m = 0; m < DAL__BINS; m++) {
        const double d = p->bins.mean[m] - mean;
        square += d * d / DAL__BINS;
        p->wandering = fmax(p->wandering, fabs(d));
    }
    p->spread = sqrt(within * within + square);
    dal__trend_weigh(&p->bins, odds, &p->evidence);
    p->growth = growth_of(&p->series);
    p->small_drift = ratio > memory_ratio ? small_beside_memory : small_drift;
    dal__trend_remove_tones(&bare);
    if (bare.tones > 0) {
        dal__trend_bin(&bare, &bins);
        dal__trend_weigh(&bins, odds, &evidence);
        if (evidence.log_total - tone_price * bare.tones > p->evidence.log_total) {
            p->bins = bins;
            p->evidence = evidence;
            p->small_drift = small_drift;
        }
    }
    p->drift = dal__trend_drift(&p->evidence, interval_level, false);
}

/* ---- powers ---- */

/* The power of least S, between those of the grid by a parabola in log p. */
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
} decision;

static bool has_no_drift(const description *p)
{
    return p->drift.low <= 0.0 && p->drift.high >= 0.0;
}

static double max_abs(const dal__interval *i) { return fmax(fabs(i->low), fabs(i->high)); }

static bool admits_none(const description *p)
{
    const dal__interval drift = dal__trend_drift(&p->evidence, 0.95, true);
    return p->growth == STEADY && has_no_drift(p) && max_abs(&drift) < p->small_drift * p->spread;
}

/* Whatever the noise is, it admits next to no drift. */
static bool is_tiny(const description *p, dal__meaning likeliest, double weight)
{
    return (likeliest == DAL__MEANS_OTHER || likeliest == DAL__MEANS_NONE ||
            (likeliest == DAL__MEANS_WALK && weight < certain_walk)) &&
           p->growth == STEADY && has_no_drift(p) && max_abs(&p->drift) < tiny_drift * p->spread;
}

static decision decide(const description *p)
{
    const double *const weight = p->evidence.meaning;
    const double middle = fabs(p->drift.low + p->drift.high), width = p->drift.high - p->drift.low;
    dal__meaning best = 0;
    for (dal__meaning i = 1; i < DAL__MEANINGS; i++)
        if (weight[i] > weight[best]) best = i;
    const double w = weight[best];
    const decision undecided = {DAL_TREND_UNDECIDED, w, NAN};
    if (p->growth == EXPLODES && best == DAL__MEANS_OTHER)
        return (decision){DAL_TREND_EXPONENTIAL, not_sure, NAN};
    const bool drifts = best == DAL__MEANS_LINEAR && w > certain_line && !has_no_drift(p);
    if (p->growth >= GROWS && !drifts && p->wandering < 0.5 * p->bins.half_range)
        return (decision){DAL_TREND_GROWING, not_sure, NAN};
    if (best == DAL__MEANS_SETTLES && p->bins.range < settled_change * p->spread)
        best = DAL__MEANS_NONE;
    if (is_tiny(p, best, w))
        return (decision){DAL_TREND_NONE, fmin(fmax(w, enough), not_sure), 0.0};
    switch (best) {
    case DAL__MEANS_NONE:
        return w >= enough_for_none && admits_none(p) ? (decision){DAL_TREND_NONE, w, 0.0}
                                                      : undecided;
    case DAL__MEANS_SETTLES:
        return w >= enough ? (decision){DAL_TREND_SETTLES, w, 0.0} : undecided;
    case DAL__MEANS_WALK:
        return w >= enough_for_walk && p->evidence.walk_over_memory > walk_evidence &&
                       middle < well_inside * width
                   ? (decision){DAL_TREND_RANDOM_WALK, w, 0.5}
                   : undecided;
    case DAL__MEANS_LINEAR:
        return w >= enough && !has_no_drift(p) ? (decision){DAL_TREND_LINEAR, w, 1.0} : undecided;
    case DAL__MEANS_POWER: {
        const double exponent = exponent_of(&p->evidence);
        return w >= enough && !isnan(exponent) ? (decision){DAL_TREND_POWER, w, exponent}
                                               : undecided;
    }
    case DAL__MEANS_EXPONENTIAL:
        return w >= enough ? (decision){DAL_TREND_EXPONENTIAL, w, NAN} : undecided;
    default:
        return undecided;
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
    const bool varies = trend->deviation > 0.0;
    if (!dal__trend_read(s, &p.series)) {
        dal__trend_line(s, trend);
        const bool is_constant = s->count > 1 && !varies;
        return (decision){is_constant ? DAL_TREND_NONE : DAL_TREND_UNDECIDED, 1.0,
                          is_constant ? 0.0 : NAN};
    }
    describe(&p);
    trend->rate = rate_of(&p, s, p.drift.middle);
    trend->rate_low = rate_of(&p, s, p.drift.low);
    trend->rate_high = rate_of(&p, s, p.drift.high);
    return s->count < MIN_VALUES ? (decision){DAL_TREND_UNDECIDED, 1.0, NAN} : decide(&p);
}

void dal_statistics_classify(const dal_statistics *s, double scale, int aborted, dal_trend *trend)
{
    if (!s || !trend) return;
    *trend = (dal_trend){.count = s->count,
                         .first = s->first,
                         .last = s->last,
                         .scale = scale,
                         .max_abs = dal_statistics_max_abs(s),
                         .deviation = dal_statistics_deviation(s)};
    decision d = classify(s, trend);
    if (aborted || s->lost || s->count == 0) d = (decision){DAL_TREND_ABORTED, 1.0, NAN};
    trend->max_drift = fmax(fabs(trend->rate_low), fabs(trend->rate_high)) * fabs(s->to - s->from);
    trend->amplitude = dal__trend_amplitude(s, trend->rate);
    trend->trend = d.trend;
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
