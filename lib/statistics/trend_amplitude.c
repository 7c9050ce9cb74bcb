/* trend_amplitude.c - whether the amplitude of a series grows.
 *
 * In block i the mean square of the oscillation is
 *
 *     v_i = own_i^2 + mean square of the means i-2 .. i+2 about their line,
 *
 * and z = log(v)/2 its logarithmic amplitude.  The cosine coefficients Z_j of z in bins are
 * compared with the shapes F of trend_tables.h, which have no free size,
 *
 *     E(F, noise) = exp(-1/2 sum log v_j) S^(-nu/2),    S = sum (Z_j - F_j)^2/v_j + floor,
 *
 * to the power 0.6, since windows overlap.  The probability of growth is the share of the growing
 * ones in these, beats, steps and saturations of the amplitude, and a constant amplitude.  An
 * amplitude ~ t and a beat seen from its node for less than half its period differ by sin(x)/x:
 * below that the priors of the tables decide. */
#include "statistics/trend_amplitude.h"
#include <math.h>
#include <string.h>

enum {
    NEAR = 2,
    EIGHTH = DAL__BINS / 8,
    LATE = 24, /* the first of five bins before the last three */
    LATE_BINS = 5
};

static const double temper = 0.6;
static const double floor_of_z = 0.025;
static const double steady_weight = 0.62;
/* A rise that counts, of z; what it is limited to where there is less. */
static const double min_rise = 0.04, without_rise = 0.5;
/* A jump of the last two bins above all others is no steady amplitude. */
static const double min_jump = 0.05, with_jump = 0.4;

/* Exponentials over more e-folds than the shapes have: z is a line to this fraction of its rise,
 * and growth has this probability. */
static const double many_folds = 8.0, line_misfit = 0.035, by_line = 0.89;

/* The root mean square of the means about block i from their line, however small. */
static double residue_of_means(const dal__trend_series *s, int i)
{
    const int from = i < NEAR ? 0 : i + NEAR >= s->count ? s->count - 1 - 2 * NEAR : i - NEAR;
    const double *const x = s->mean + from;
    double mean = 0.0, slope = 0.0, square = 0.0, unit = 0.0;
    for (int k = 0; k <= 2 * NEAR; k++) {
        mean += x[k] / (2 * NEAR + 1);
        slope += (k - NEAR) * x[k] / 10.0;
        unit = fmax(unit, fabs(x[k]));
    }
    for (int k = 0; k <= 2 * NEAR && unit > 0.0; k++) {
        const double r = (x[k] - mean - slope * (k - NEAR)) / unit;
        square += r * r;
    }
    return unit * sqrt(square / (2 * NEAR - 1));
}

/* z in bins; false where nothing oscillates. */
static bool fill_logarithms(const dal__trend_series *s, double *z /* [DAL__BINS] */)
{
    double logarithm[DAL_STATISTICS_BLOCKS];
    for (int i = 0; i < s->count; i++) {
        const double v = hypot(s->own[i], residue_of_means(s, i));
        if (!(v > 0.0)) return false;
        logarithm[i] = log(v);
    }
    dal__trend_fill_bins(logarithm, s->count, z);
    return true;
}

static double mean_of(const double *z, int from, int count)
{
    double sum = 0.0;
    for (int m = from; m < from + count; m++) sum += z[m] / count;
    return sum;
}

/* Of the first ones. */
static double deviation_of(const double *z, int count)
{
    const double mean = mean_of(z, 0, count);
    double square = 0.0;
    for (int m = 0; m < count; m++) square += (z[m] - mean) * (z[m] - mean);
    return sqrt(square / (count - 1));
}

/* sum_j y_j F_j of all shapes. */
static void correlate(const double *y, double *restrict sum)
{
    memset(sum, 0, DAL__AMPLITUDES * sizeof *sum);
    for (int j = 0; j + 2 <= DAL__WAVES; j += 2) {
        const double y0 = y[j], y1 = y[j + 1];
        const double *restrict const a = dal__amplitude_wave[j], *restrict const b =
                                                                     dal__amplitude_wave[j + 1];
        for (int i = 0; i < DAL__AMPLITUDES; i++) sum[i] = sum[i] + y0 * a[i] + y1 * b[i];
    }
    const double last = DAL__WAVES % 2 ? y[DAL__WAVES - 1] : 0.0;
    for (int i = 0; i < DAL__AMPLITUDES; i++)
        sum[i] += last * dal__amplitude_wave[DAL__WAVES - 1][i];
}

typedef struct weights {
    double powers, exponentials, other, steady;
} weights;

/* S^(-nu/2), tempered. */
static double ninth_power(double x)
{
    const double square = x * x, fourth = square * square;
    return fourth * fourth * x;
}

static double sum_of(const double *x, int from, int to)
{
    double sum = 0.0;
    for (int i = from; i < to; i++) sum += x[i];
    return sum;
}

/* Adds what all shapes explain under one noise, in units of S^(-nu/2) for S = unit. */
static void weigh_noise(const double *wave, int k, double unit, weights *w)
{
    const dal__noise *const n = &dal__noise_list[k];
    double y[DAL__WAVES], sum[DAL__AMPLITUDES], square = 0.0;
    for (int j = 0; j < DAL__WAVES; j++) {
        y[j] = n->precision[j] * wave[j];
        square += y[j] * wave[j];
    }
    const double floor = floor_of_z * floor_of_z * n->precision_sum;
    /* Walks and long memory explain any amplitude. */
    const double share = n->meaning == DAL__MEANS_WALK    ? 0.3
                         : n->meaning == DAL__MEANS_OTHER ? 0.5
                                                          : 1.0;
    const double outer = share * n->shape_weight * exp(-0.5 * temper * n->log_determinant);
    correlate(y, sum);
    for (int i = 0; i < DAL__AMPLITUDES; i++) {
        const double rest = fmax(square - 2.0 * sum[i] + dal__amplitude_square[k][i], 0.0) + floor;
        sum[i] = dal__amplitude_weight[i] * ninth_power(unit / rest);
    }
    w->powers += outer * sum_of(sum, 0, DAL__GROWING_POWERS);
    w->exponentials += outer * sum_of(sum, DAL__GROWING_POWERS, DAL__GROWING_AMPLITUDES);
    w->other += outer * sum_of(sum, DAL__GROWING_AMPLITUDES, DAL__AMPLITUDES);
    w->steady += outer * steady_weight * ninth_power(unit / (square + floor));
}

/* The probability of growth where the end does not rise above the beginning, or all at once. */
static double limited(const double *z, double probability)
{
    const double beginning = mean_of(z, 0, 2 * EIGHTH), late = mean_of(z, LATE, LATE_BINS);
    const double noise = 2.0 * deviation_of(z, 2 * EIGHTH) / sqrt(LATE_BINS);
    const double last = mean_of(z, DAL__BINS - 2, 2), all = mean_of(z, 0, DAL__BINS - 2);
    double top = all + 4.0 * deviation_of(z, DAL__BINS - 2);
    for (int m = 0; m < DAL__BINS - 2; m++) top = fmax(top, z[m]);
    if (late - beginning < min_rise + noise) probability = fmin(probability, without_rise);
    return last > top + min_jump ? fmax(probability, with_jump) : probability;
}

dal__amplitude_growth dal__trend_growth(const dal__trend_series *s)
{
    double z[DAL__BINS], wave[DAL__WAVES], square = 0.0, xx = 0.0, xy = 0.0;
    weights w = {0};
    dal__amplitude_growth g = {0};
    if (!fill_logarithms(s, z)) return g;
    g.rise = mean_of(z, DAL__BINS - EIGHTH, EIGHTH) - mean_of(z, 0, EIGHTH);
    if (g.rise <= 0.0) return g;
    for (int j = 0; j < DAL__WAVES; j++) {
        const double x = dal__shape_wave[j][DAL__LINEAR_SHAPE];
        wave[j] = 0.0;
        for (int m = 0; m < DAL__BINS; m++) wave[j] += dal__cosine[j][m] * z[m];
        square += wave[j] * wave[j];
        xx += x * x;
        xy += x * wave[j];
    }
    const double misfit = sqrt(fmax(square - xy * xy / xx, 0.0) / DAL__BINS);
    if (g.rise > many_folds && misfit < line_misfit * g.rise) {
        g.probability = by_line;
        g.exponential = 1.0;
        return g;
    }
    const double unit = square + DAL__WAVES * floor_of_z * floor_of_z;
    for (int k = 0; k < DAL__SHAPE_NOISES; k++) weigh_noise(wave, k, unit, &w);
    const double growing = w.powers + w.exponentials;
    g.probability = limited(z, growing / (growing + w.other + w.steady));
    g.exponential = w.exponentials / growing;
    return g;
}
