/* trend_series.c - the blocks of a series, its tones, its bins and their cosine coefficients.
 *
 * Tones are found in the means x_i of the N full blocks, less a polynomial of degree 5, as the
 * maximum of |sum x_i e^(-2 pi i f/N)|, and then fitted together with that polynomial by Gauss and
 * Newton's method,
 *
 *     x_i = sum_k c_k p_k(i) + sum_l a_l cos(w_l i) + b_l sin(w_l i)
 *           + d_l i (b_l cos(w_l i) - a_l sin(w_l i)),     w_l <- w_l + d_l.
 *
 * A tone is taken when it lowers N/2 log of the sum of squares by tone_worth. */
#include "statistics/trend_series.h"
#include "core/pi.h"
#include "core/vectors.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum {
    POLYNOMIALS = 6,
    GRID = 2, /* frequencies to a period */
    COLUMNS = POLYNOMIALS + 3 * DAL__TONES,
    NEWTON_STEPS = 4
};

static const double slowest_tone = 3.0;
static const double tone_worth = 12.0;
static const double steady_range = 0.05; /* deviation of the ranges of blocks, of their mean */
/* A tone of nearly a whole number of periods a block leaves a slow wave in the means.  It is noise
 * to all else, of this size beside half the range of a block. */
static const double steady_alias = 1e-2, alias = 3e-3;
static const double tone_error =
    5e-4; /* of half the range: what a tone that was taken out leaves */

/* What remains of a difference of squares counts when it is this many roundings. */
static const double cancelled = 16.0;

typedef dal__trend_series series;

/* ---- reading ---- */

/* A value in units, however large. */
static double in_units(const dal_statistics *x, double unit, double value)
{
    return (value * x->factor - x->first * x->factor) / unit;
}

static void measure_ranges(series *s)
{
    double square = 0.0;
    for (int i = 0; i < s->count; i++) {
        const double range = s->max[i] - s->min[i];
        const double rise = i > 0 ? fabs(s->mean[i] - s->mean[i - 1]) : 0.0;
        s->block_range += range / s->count;
        s->swing += i > 0 ? fmax(range - rise, 0.0) / (s->count - 1) : 0.0;
        square += range * range / s->count;
    }
    const double variance = square - s->block_range * s->block_range;
    s->is_steady = variance < steady_range * steady_range * square;
}

/* Less than the root mean square of a block by what the line to its neighbours rises in it: exact
 * for a line of n values, which rises by r, rms^2 = r^2 (1 - 1/n^2)/12. */
static void measure_own(const dal_statistics *x, series *s)
{
    const double n = (double)s->length, share = (1.0 - 1.0 / (n * n)) / 12.0;
    double square = 0.0;
    for (int i = 0; i < s->count; i++) {
        const int left = i > 0 ? i - 1 : i, right = i + 1 < s->count ? i + 1 : i;
        const double r = (s->mean[right] - s->mean[left]) / (right - left);
        const double rms = x->block[i].rms / s->unit, slope = rms > 0.0 ? r / rms : 0.0;
        const double rest = 1.0 - share * slope * slope; /* of rms^2, which may be too small */
        s->own[i] = rest > cancelled * DBL_EPSILON ? rms * sqrt(rest) : 0.0;
        square += s->own[i] * s->own[i] / s->count;
    }
    s->within = sqrt(square);
}

bool dal__trend_read(const dal_statistics *x, series *s)
{
    *s = (series){.count = (int)x->blocks, .length = x->length};
    double deviation = 0.0, largest = 0.0;
    for (int i = 0; i < s->count; i++) {
        const double low = x->block[i].min, high = x->block[i].max;
        deviation = fmax(deviation, fmax(in_units(x, 1.0, high), -in_units(x, 1.0, low)));
        largest = fmax(largest, fmax(fabs(low), fabs(high)));
    }
    if (!(deviation > 0.0) || s->count < DAL__BINS) return false;
    const double unit = s->unit = exp2(fmin(ceil(log2(deviation)), 1023.0));
    for (int i = 0; i < s->count; i++) {
        s->mean[i] = x->block[i].x / unit;
        s->min[i] = in_units(x, unit, x->block[i].min);
        s->max[i] = in_units(x, unit, x->block[i].max);
        s->low = fmin(s->low, s->min[i]);
        s->high = fmax(s->high, s->max[i]);
    }
    measure_ranges(s);
    measure_own(x, s);
    s->rounding = 0.3 * DBL_EPSILON * (largest * x->factor / unit) / sqrt((double)x->length);
    return true;
}

/* ---- tones ---- */

typedef struct tone_fit {
    int n, tones;
    double angle[DAL__TONES], a[DAL__TONES], b[DAL__TONES];
    double column[COLUMNS][DAL_STATISTICS_BLOCKS]; /* the first are orthonormal polynomials */
    double residue[DAL_STATISTICS_BLOCKS], square;
} tone_fit;

/* Orthonormal polynomials on the blocks, by x p_k = p_(k+1) + c_k p_(k-1). */
static void fill_polynomials(tone_fit *f)
{
    const int n = f->n;
    for (int k = 0; k < POLYNOMIALS; k++) {
        double *const p = f->column[k], *const before = f->column[k ? k - 1 : 0];
        for (int i = 0; i < n; i++) p[i] = k ? (2.0 * i + 1.0 - n) / n * before[i] : 1.0;
        for (int l = k - 2; l >= 0; l -= 2) {
            const double component = dal__dot_product(n, p, f->column[l]);
            for (int i = 0; i < n; i++) p[i] -= component * f->column[l][i];
        }
        const double size = 1.0 / sqrt(dal__dot_product(n, p, p));
        for (int i = 0; i < n; i++) p[i] *= size;
    }
}

/* cos and sin of angle * i. */
static void fill_tone(int n, double angle, double *c, double *s)
{
    const double a = cos(angle), b = sin(angle);
    double x = 1.0, y = 0.0;
    for (int i = 0; i < n; i++) {
        c[i] = x;
        s[i] = y;
        const double next = a * x - b * y;
        y = b * x + a * y;
        x = next;
    }
}

/* The angle of the largest Fourier coefficient of the residue, by Goertzel's recurrence, four
 * frequencies at a time. */
static double loudest(const tone_fit *f)
{
    double best = -1.0, place = 0.0;
    for (double v = slowest_tone; v < 0.5 * f->n; v += 4.0 / GRID) {
        double c[4], a[4] = {0}, b[4] = {0};
        for (int k = 0; k < 4; k++) c[k] = 2.0 * cos(2.0 * DAL__PI * (v + (double)k / GRID) / f->n);
        for (int i = 0; i < f->n; i++)
            for (int k = 0; k < 4; k++) {
                const double next = f->residue[i] + c[k] * a[k] - b[k];
                b[k] = a[k];
                a[k] = next;
            }
        for (int k = 0; k < 4; k++) {
            const double w = v + (double)k / GRID;
            const double square = a[k] * a[k] + b[k] * b[k] - c[k] * a[k] * b[k];
            if (square > best && w < 0.5 * f->n) {
                best = square;
                place = w;
            }
        }
    }
    return 2.0 * DAL__PI * place / f->n;
}

/* Least squares by the normal equations: columns of length near one. */
static void solve(double m[COLUMNS][COLUMNS], double *x, int n)
{
    for (int i = 0; i < n; i++) {
        const double whole = m[i][i];
        for (int k = 0; k < i; k++) m[i][i] -= m[i][k] * m[i][k];
        if (!(m[i][i] > 1e-12 * whole) || !(whole > 0.0)) {
            for (int k = i; k < n; k++) m[k][i] = 0.0; /* nothing new: its size is 0 */
            m[i][i] = INFINITY;
            continue;
        }
        m[i][i] = sqrt(m[i][i]);
        for (int k = i + 1; k < n; k++) {
            for (int l = 0; l < i; l++) m[k][i] -= m[k][l] * m[i][l];
            m[k][i] /= m[i][i];
        }
    }
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < i; k++) x[i] -= m[i][k] * x[k];
        x[i] /= m[i][i];
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++) x[i] -= m[k][i] * x[k];
        x[i] = m[i][i] < INFINITY ? x[i] / m[i][i] : 0.0;
    }
}

/* One step of Gauss and Newton; leaves the residue of the columns it solved for. */
static void newton_step(tone_fit *f, const double *x)
{
    const int n = f->n, columns = POLYNOMIALS + 3 * f->tones;
    double m[COLUMNS][COLUMNS], c[COLUMNS];
    for (int l = 0; l < f->tones; l++) {
        double *const co = f->column[POLYNOMIALS + 3 * l], *const si = co + DAL_STATISTICS_BLOCKS,
                      *const turn = si + DAL_STATISTICS_BLOCKS;
        const double size = 1.0 / n;
        fill_tone(n, f->angle[l], co, si);
        for (int i = 0; i < n; i++)
            turn[i] = size * (i - 0.5 * n) * (f->b[l] * co[i] - f->a[l] * si[i]);
    }
    for (int i = 0; i < columns; i++) {
        c[i] = dal__dot_product(n, f->column[i], x);
        for (int k = i < POLYNOMIALS ? i : 0; k <= i; k++)
            m[i][k] = i < POLYNOMIALS ? 1.0 : dal__dot_product(n, f->column[i], f->column[k]);
        if (i < POLYNOMIALS)
            for (int k = 0; k < i; k++) m[i][k] = 0.0;
    }
    solve(m, c, columns);
    memcpy(f->residue, x, (size_t)n * sizeof *x);
    for (int i = 0; i < columns; i++)
        for (int k = 0; k < n; k++) f->residue[k] -= c[i] * f->column[i][k];
    f->square = dal__dot_product(n, f->residue, f->residue);
    for (int l = 0; l < f->tones; l++) {
        const double *const tone = c + POLYNOMIALS + 3 * l;
        const double limit = 0.5 * 2.0 * DAL__PI / n; /* half a period at a time */
        /* The phase turns about the middle. */
        const double d = fmin(fmax(tone[2] / n, -limit), limit), middle = 0.5 * n * d;
        const double a = tone[0], b = tone[1];
        f->a[l] = a * cos(middle) - b * sin(middle);
        f->b[l] = a * sin(middle) + b * cos(middle);
        f->angle[l] += d;
    }
}

/* Adds one tone; false when it is not worth it. */
static bool add_tone(tone_fit *f, const double *x)
{
    const tone_fit before = *f;
    const double square = f->square;
    f->angle[f->tones] = loudest(f);
    f->a[f->tones] = f->b[f->tones] = 0.0;
    f->tones++;
    for (int i = 0; i < NEWTON_STEPS; i++) newton_step(f, x);
    const double min = 1e-8 * dal__dot_product(f->n, x, x);
    if (0.5 * f->n * log((square + min) / (f->square + min)) >= tone_worth) return true;
    *f = before;
    return false;
}

void dal__trend_remove_tones(series *s)
{
    tone_fit f = {.n = s->count};
    fill_polynomials(&f);
    newton_step(&f, s->mean);
    while (f.tones < DAL__TONES && add_tone(&f, s->mean)) continue;
    for (int l = 0; l < f.tones; l++) {
        double c[DAL_STATISTICS_BLOCKS], d[DAL_STATISTICS_BLOCKS];
        fill_tone(f.n, f.angle[l], c, d);
        for (int i = 0; i < f.n; i++) s->mean[i] -= f.a[l] * c[i] + f.b[l] * d[i];
    }
    if (f.tones > 0) s->tones = f.tones;
}

/* ---- bins ---- */

/* Blocks are not constant inside: where one overlaps a bin, the integral is taken of the line that
 * has the mean of the block and the slope between its neighbours. */
void dal__trend_fill_bins(const double *block, int count, double *bin)
{
    const double width = (double)count / DAL__BINS;
    double whole = 0.0, before = 0.0; /* integrals up to block i and up to the last bin */
    for (int m = 0, i = 0; m < DAL__BINS; m++) {
        const double to = (m + 1) * width;
        while (i + 1 <= to) whole += block[i++];
        double now = whole;
        if (i < count) {
            const int left = i > 0 ? i - 1 : i, right = i + 1 < count ? i + 1 : i;
            const double slope = (block[right] - block[left]) / (right - left), u = to - i;
            now += u * block[i] + 0.5 * slope * u * (u - 1.0);
        }
        bin[m] = (now - before) / width;
        before = now;
    }
}

void dal__trend_bin(const series *s, dal__bins *b)
{
    double low = INFINITY, high = -INFINITY;
    dal__trend_fill_bins(s->mean, s->count, b->mean);
    for (int m = 0; m < DAL__BINS; m++) {
        low = fmin(low, b->mean[m]);
        high = fmax(high, b->mean[m]);
    }
    for (int j = 0; j < DAL__WAVES; j++)
        b->wave[j] = dal__dot_product(DAL__BINS, dal__cosine[j], b->mean);
    b->range = high - low;
    b->half_range = 0.5 * (s->high - s->low);
    b->rounding = s->rounding;
    b->error = fmax((s->is_steady ? steady_alias : alias) * 0.5 * s->swing,
                    s->tones ? tone_error * b->half_range : 0.0);
    b->freedom = DAL__WAVES - 2 * s->tones;
}
