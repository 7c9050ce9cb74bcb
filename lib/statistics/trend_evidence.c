/* trend_evidence.c - how well each shape and each noise explains the means of bins.
 *
 * The cosine coefficients Y_j (trend_tables.h) of
 *
 *     y = c + b shape + noise,     p(c) flat, p(sigma) ~ 1/sigma, variances sigma^2 v_j,
 *
 * give, with S = sum Y_j^2/v_j + floor, xx = sum X_j^2/v_j, b = (sum X_j Y_j/v_j)/xx, nu
 * coefficients, and b from a Cauchy distribution of the width a of half the range of the values,
 *
 *     E(noise)         = exp(-1/2 sum log v_j) S^(-nu/2)
 *     E(shape, noise)  = E(noise) q^(-nu/2) sqrt(2/pi) d/(a + d) / (1 + (b/(a + d))^2),
 *     q = 1 - b^2 xx/S,   d^2 = q S/((nu - 1) xx).
 *
 * (Kass, Raftery 1995, DOI 10.1080/01621459.1995.10476572.)  All are raised to the power 0.8,
 * which pays for noise that is not Gaussian and for shapes off the grid (a generalised posterior:
 * Bissiri, Holmes, Walker 2016, DOI 10.1111/rssb.12158).  The floor admits that no shape is
 * exact. */
#include "statistics/trend_evidence.h"
#include <math.h>
#include <string.h>

static const double temper = 0.8;
/* How much likelier a line is for its own interval, which a walk would make too wide. */
static const double line_odds = 3.0;
static const double shape_error = 1e-3; /* of the range: how far a shape of the grid may miss */
/* Deviations of a shape under a walk: less is the walk's own, more is a shape. */
static const double hidden = 1.2, clear = 2.0;

/* x^n for small n. */
static double power_of(double x, int n)
{
    double y = 1.0;
    for (; n > 0; n >>= 1, x *= x)
        if (n & 1) y *= x;
    return y;
}

/* S^(-nu/2) tempered, as a whole power. */
static int tempered_power(const dal__bins *b) { return (int)(0.5 * temper * b->freedom + 0.5); }

typedef struct noise_state {
    double square, floor; /* S with and without what noise explains; floor of the shapes */
    double log_evidence;
    double weight; /* tempered, relative to the best */
} noise_state;

static void weigh_noises(const dal__bins *b, double white_odds, noise_state *s, double *best)
{
    const double error = fmax(fmax(shape_error * b->range, b->error), b->rounding);
    *best = -INFINITY;
    for (int k = 0; k < DAL__NOISES; k++) {
        const dal__noise *const n = &dal__noise_list[k];
        double sum = 0.0;
        for (int j = 0; j < DAL__WAVES; j++) sum += n->precision[j] * b->wave[j] * b->wave[j];
        s[k].floor = error * error * n->precision_sum * b->freedom / DAL__WAVES;
        s[k].square = sum + s[k].floor;
        s[k].log_evidence = -0.5 * n->log_determinant - 0.5 * b->freedom * log(s[k].square);
        if (k == 0) s[k].log_evidence += log(white_odds);
        *best = fmax(*best, s[k].log_evidence);
    }
    for (int k = 0; k < DAL__NOISES; k++) s[k].weight = exp(temper * (s[k].log_evidence - *best));
}

/* sum_j X_j Y_j/v_j of all shapes. */
static void correlate(const dal__bins *b, const dal__noise *n, double *restrict sum)
{
    enum { TOGETHER = 4 }; /* waves: a sum is loaded and stored once for them */
    double y[DAL__WAVES];
    for (int j = 0; j < DAL__WAVES; j++) y[j] = n->precision[j] * b->wave[j];
    memset(sum, 0, DAL__SHAPES * sizeof *sum);
    int j = 0;
    for (; j + TOGETHER <= DAL__WAVES; j += TOGETHER) {
        const double(*restrict const x)[DAL__SHAPES] = &dal__shape_wave[j];
        const double y0 = y[j], y1 = y[j + 1], y2 = y[j + 2], y3 = y[j + 3];
        for (int i = 0; i < DAL__SHAPES; i++)
            sum[i] = sum[i] + y0 * x[0][i] + y1 * x[1][i] + y2 * x[2][i] + y3 * x[3][i];
    }
    for (; j < DAL__WAVES; j++)
        for (int i = 0; i < DAL__SHAPES; i++) sum[i] += y[j] * dal__shape_wave[j][i];
}

/* What the prior of a shape's size costs. */
static double occam(double size, double deviation, double width)
{
    const double w = width + deviation, ratio = size / w;
    return 0.7978845608028654 * deviation / (w * (1.0 + ratio * ratio));
}

/* The cost of a line: as likely small, beside oscillations, as all there is. */
static double line_price(const dal__bins *b, double size, double deviation)
{
    return 0.5 * occam(size, deviation, 0.3 * b->half_range) +
           0.5 * occam(size, deviation, 2.0 * b->half_range);
}

static void add_weight(dal__evidence *e, dal__meaning meaning, int shape, double weight)
{
    e->meaning[meaning] += weight;
    e->shape[shape] += weight;
}

/* The straight line, for its interval: its shape is exact. */
static void weigh_line(const dal__bins *b, int k, const noise_state *s, double xy, dal__evidence *e)
{
    const dal__noise *const n = &dal__noise_list[k];
    const double xx = dal__shape_square[k][DAL__LINEAR_SHAPE], size = xy / xx;
    const double end_to_end = DAL__BINS / (DAL__BINS - 1.0); /* a shape is 1 from bin to bin */
    const double rest = s->square - size * xy, error = fmax(b->rounding, b->error);
    /* sum (Y_j - size X_j)^2/v_j: a difference of sums would lose it among roundings. */
    double residue = 0.0;
    for (int j = 0; j < DAL__WAVES; j++) {
        const double r = b->wave[j] - size * dal__shape_wave[j][DAL__LINEAR_SHAPE];
        residue += n->precision[j] * r * r;
    }
    const double own = residue + error * error * n->precision_sum;
    const double price = line_price(b, size, sqrt(rest / (b->freedom - 1.0) / xx));
    e->drift[k] = end_to_end * size;
    e->drift_deviation[k] = end_to_end * sqrt(own / (b->freedom - 1.0) / xx);
    e->drift_weight[k] = n->rate_weight * s->weight *
                         (1.0 + line_odds * price * power_of(s->square / rest, tempered_power(b)));
}

/* A shape within the deviation of a random walk is none; one slightly above it is undecided. */
static dal__meaning meaning_under_walk(const dal__shape *shape, double deviations)
{
    if (deviations >= clear) return shape->meaning;
    return deviations < hidden ? DAL__MEANS_WALK : DAL__MEANS_OTHER;
}

/* Shapes of one column, step by step for all of them: a processor divides several at a time. */
static void weigh_plain_shapes(const dal__bins *b, int k, const noise_state *s, const double *xy,
                               dal__evidence *e)
{
    enum { SHAPES = DAL__PLAIN_SHAPES };
    const double *const xx = dal__shape_square[k];
    const double outer = s->weight * dal__noise_list[k].shape_weight;
    const double per_freedom = 1.0 / (b->freedom - 1.0), square = s->square, width = b->half_range;
    double size[SHAPES], rest[SHAPES], deviation[SHAPES], price[SHAPES], base[SHAPES],
        power[SHAPES];
    for (int i = 0; i < SHAPES; i++) {
        size[i] = xy[i] / xx[i];
        rest[i] = square - size[i] * xy[i];
        deviation[i] = sqrt(rest[i] * per_freedom / xx[i]);
        price[i] = occam(size[i], deviation[i], width);
        base[i] = square / rest[i];
        power[i] = 1.0;
    }
    price[DAL__LINEAR_SHAPE] = line_price(b, size[DAL__LINEAR_SHAPE], deviation[DAL__LINEAR_SHAPE]);
    for (int n = tempered_power(b); n > 0; n >>= 1) {
        if (n & 1)
            for (int i = 0; i < SHAPES; i++) power[i] *= base[i];
        for (int i = 0; i < SHAPES; i++) base[i] *= base[i];
    }
    for (int i = 0; k == 0 && i < DAL__POWER_SHAPES; i++) e->power_rest[i] = rest[i];
    const bool is_walk = dal__noise_list[k].meaning == DAL__MEANS_WALK;
    for (int i = 0; i < SHAPES; i++) {
        const dal__shape *const shape = &dal__shape_list[i];
        const dal__meaning meaning =
            is_walk ? meaning_under_walk(shape, fabs(size[i]) / deviation[i]) : shape->meaning;
        add_weight(e, meaning, i, outer * shape->weight * price[i] * power[i]);
    }
}

/* Two shapes beside each other; where one column does it, they do not count. */
static const double clear_deviations = 3.0, min_ratio = 0.06;

static void weigh_pair(const dal__bins *b, int k, const noise_state *s, const double *xy, int pair,
                       dal__evidence *e)
{
    const dal__pair *const p = &dal__pair_list[pair];
    const int i = p->first, l = p->second;
    const double xx = dal__shape_square[k][i], yy = dal__shape_square[k][l];
    const double cross = dal__pair_product[k][pair], det = xx * yy - cross * cross;
    const double c = (yy * xy[i] - cross * xy[l]) / det, d = (xx * xy[l] - cross * xy[i]) / det;
    const double rest = fmax(s->square - c * xy[i] - d * xy[l], s->floor);
    const double variance = rest / (b->freedom - 2.0);
    const double of_c = sqrt(variance * yy / det), of_d = sqrt(variance * xx / det);
    if (fabs(c) < clear_deviations * of_c || fabs(d) < clear_deviations * of_d ||
        fmin(fabs(c), fabs(d)) < min_ratio * fmax(fabs(c), fabs(d)))
        return;
    const double price =
        occam(c, of_c, b->half_range) * occam(d, sqrt(variance / yy), b->half_range);
    const double weight = s->weight * dal__noise_list[k].shape_weight * p->weight * price *
                          power_of(s->square / rest, tempered_power(b));
    e->meaning[p->meaning] += weight;
    e->pair[pair] += weight;
}

static void weigh_shapes(const dal__bins *b, int k, const noise_state *s, dal__evidence *e)
{
    const dal__noise *const n = &dal__noise_list[k];
    const double *const xx = dal__shape_square[k];
    const int power = tempered_power(b);
    const double outer = s->weight * n->shape_weight;
    double xy[DAL__SHAPES];
    correlate(b, n, xy);
    weigh_plain_shapes(b, k, s, xy, e);
    for (int w = 0; w < DAL__SLOW_WAVES; w++) {
        const int i = DAL__PLAIN_SHAPES + 2 * w;
        const double cross = dal__slow_product[k][w], det = xx[i] * xx[i + 1] - cross * cross;
        const double c = (xx[i + 1] * xy[i] - cross * xy[i + 1]) / det;
        const double d = (xx[i] * xy[i + 1] - cross * xy[i]) / det;
        const double rest = fmax(s->square - c * xy[i] - d * xy[i + 1], s->floor);
        const double deviation = sqrt(rest / (b->freedom - 2.0) / sqrt(det));
        const double size = sqrt(c * c + d * d),
                     price = occam(0.5 * size, deviation, b->half_range);
        add_weight(e, dal__shape_list[i].meaning, i,
                   outer * 2.0 * dal__shape_list[i].weight * price * price *
                       power_of(s->square / rest, power));
    }
    for (int i = 0; i < DAL__PAIRS; i++) weigh_pair(b, k, s, xy, i, e);
    weigh_line(b, k, s, xy[DAL__LINEAR_SHAPE], e);
}

/* log(sum weight * E) of the noises alone that a test of their own compares: walks, or a long
 * memory. */
static double log_evidence_of(const noise_state *s, int first, int last, double best)
{
    double sum = 0.0, weights = 0.0;
    for (int k = first; k <= last; k++) {
        sum += dal__noise_list[k].weight * exp(s[k].log_evidence - best);
        weights += dal__noise_list[k].weight;
    }
    return log(sum / weights);
}

void dal__trend_weigh(const dal__bins *b, dal__white_odds odds, dal__evidence *e)
{
    noise_state s[DAL__NOISES];
    double best, sum = 0.0;
    memset(e, 0, sizeof *e);
    e->freedom = b->freedom;
    weigh_noises(b, odds.trend, s, &best);
    e->walk_over_memory = log_evidence_of(s, DAL__FIRST_WALK, DAL__LAST_WALK, best) -
                          log_evidence_of(s, DAL__FIRST_LONG_MEMORY, DAL__LAST_LONG_MEMORY, best);
    for (int k = 0; k < DAL__NOISES; k++)
        e->meaning[dal__noise_list[k].meaning] += dal__noise_list[k].weight * s[k].weight;
    for (int k = 0; k < DAL__SHAPE_NOISES; k++) weigh_shapes(b, k, &s[k], e);
    for (int i = 0; i < DAL__MEANINGS; i++) sum += e->meaning[i];
    for (int i = 0; i < DAL__MEANINGS; i++) e->meaning[i] /= sum;
    for (int i = 0; i < DAL__SHAPES; i++) e->shape[i] /= sum;
    for (int i = 0; i < DAL__PAIRS; i++) e->pair[i] /= sum;
    e->drift_weight[0] *= odds.rate;
    e->log_total = log(sum) + temper * best;
}

/* ---- the drift, as an interval ---- */

/* Under each noise the drift b of a straight line has Student's distribution about its estimate;
 * the interval belongs to their mixture, each with the weight of its noise:
 *
 *     F(b) = sum_k w_k T_nu((b - b_k)/d_k),     T_nu(t) = Phi(t (1 - 1/4 nu)/sqrt(1 + t^2/2 nu))
 *
 * (Abramowitz, Stegun 26.7.8).  Random walks weigh more there than elsewhere: taking a walk for
 * noise with memory makes the interval far too short, and the reverse costs little. */
enum { HALVINGS = 60 };

static const double negligible = 1e-5; /* weight of a noise, beside the largest */

typedef struct mixture {
    int count;
    double freedom, sum;
    double at[DAL__SHAPE_NOISES], deviation[DAL__SHAPE_NOISES], weight[DAL__SHAPE_NOISES];
} mixture;

static mixture mixture_of(const dal__evidence *e, dal__noises noises)
{
    mixture m = {.freedom = e->freedom - 1.0};
    double largest = 0.0;
    for (int k = 0; k < DAL__SHAPE_NOISES; k++) largest = fmax(largest, e->drift_weight[k]);
    for (int pass = noises; pass < 2 && m.count == 0; pass++)
        for (int k = 0; k < DAL__SHAPE_NOISES; k++) {
            if (pass == DAL__NOISES_WITHOUT_TREND && dal__noise_list[k].meaning != DAL__MEANS_NONE)
                continue;
            if (!(e->drift_weight[k] > negligible * largest) && pass == DAL__ALL_NOISES) continue;
            m.at[m.count] = e->drift[k];
            m.deviation[m.count] = fmax(e->drift_deviation[k], 1e-300);
            m.weight[m.count++] = e->drift_weight[k];
            m.sum += e->drift_weight[k];
        }
    return m;
}

static double probability(const mixture *m, double b)
{
    const double nu = m->freedom;
    double sum = 0.0;
    for (int k = 0; k < m->count; k++) {
        const double t = (b - m->at[k]) / m->deviation[k];
        const double z = t * (1.0 - 0.25 / nu) / sqrt(1.0 + 0.5 * t * t / nu);
        sum += m->weight[k] * (0.5 * erfc(-0.7071067811865476 * z));
    }
    return sum / m->sum;
}

/* Where the probability is p: by false position, halving the weight of an end that stays (the
 * Illinois method: Dowell, Jarratt 1971, DOI 10.1007/BF01934364). */
static double quantile(const mixture *m, double p)
{
    double a = INFINITY, b = -INFINITY;
    for (int k = 0; k < m->count; k++) {
        a = fmin(a, m->at[k] - 12.0 * m->deviation[k]);
        b = fmax(b, m->at[k] + 12.0 * m->deviation[k]);
    }
    const double width = 1e-4 * (b - a), near = 1e-3 * fmin(p, 1.0 - p);
    double fa = -p, fb = 1.0 - p;
    for (int i = 0; i < HALVINGS && fa != fb; i++) {
        const double c = i % 3 == 2 ? 0.5 * (a + b) : b - fb * (b - a) / (fb - fa);
        const double fc = probability(m, c) - p;
        if (fabs(fc) < near) return c;
        if (fc < 0.0) {
            a = c, fa = fc, fb *= 0.5;
        } else {
            b = c, fb = fc, fa *= 0.5;
        }
        if (b - a < 1e-3 * width) break;
    }
    return 0.5 * (a + b);
}

dal__interval dal__trend_drift(const dal__evidence *e, double level, dal__noises noises)
{
    const mixture m = mixture_of(e, noises);
    double middle = 0.0;
    for (int k = 0; k < m.count; k++) middle += m.weight[k] / m.sum * m.at[k];
    const double low = quantile(&m, 0.5 * (1.0 - level)), high = quantile(&m, 0.5 * (1.0 + level));
    return (dal__interval){fmin(low, middle), middle, fmax(high, middle)};
}
