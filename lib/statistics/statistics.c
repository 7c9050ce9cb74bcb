/* statistics.c - a quantity x(t) followed at every step in constant memory.
 *
 * The series is cut into blocks of equal length, of which mean, root mean square about it, min and
 * max are kept.  When all DAL_STATISTICS_BLOCKS are full, neighbours are merged and the length
 * doubles, so that between one half and all of them are in use after any number of values: the
 * method of batch means (Flyvbjerg, Petersen 1989, DOI 10.1063/1.457480; Law, Kelton, Simulation
 * Modeling and Analysis, 9.5).
 *
 * The roughness of the series distinguishes a sum of roundings from a smooth change.  If its steps
 * are independent, E (x_(k+l) - x_k)^2 = l sigma^2: the sum of squared steps n sigma^2 sums
 * (x_(k+1) - x_k)^2, or, at a fraction of the cost, 4/8 times the sum of (x_(k+8) - x_k)^2 over one
 * k in four.  A smooth series has steps in one direction and a sum that is smaller by n. */
#include "statistics/statistics.h"
#include <math.h>
#include <string.h>

void dal_statistics_start(dal_statistics *s, int count)
{
    for (int i = 0; s && i < count; i++) s[i] = (dal_statistics){.length = 1, .factor = 1.0};
}

/* rms^2 = (rms_a^2 + rms_b^2)/2 + ((x_a - x_b)/2)^2, in units of the largest. */
static double joint_rms(const dal_statistics_block *a, const dal_statistics_block *b)
{
    const double half = fabs(0.5 * a->x - 0.5 * b->x), unit = fmax(half, fmax(a->rms, b->rms));
    if (!(unit > 0.0)) return 0.0;
    const double x = a->rms / unit, y = b->rms / unit, z = half / unit;
    return unit * sqrt(0.5 * (x * x + y * y) + z * z);
}

/* Joins neighbours: half as many blocks, twice as long. */
static void halve(dal_statistics *s)
{
    for (int i = 0; i < DAL_STATISTICS_BLOCKS / 2; i++) {
        const dal_statistics_block *a = &s->block[2 * i], *b = a + 1;
        s->block[i] = (dal_statistics_block){.t = 0.5 * (a->t + b->t),
                                             .x = 0.5 * (a->x + b->x),
                                             .rms = joint_rms(a, b),
                                             .min = b->min < a->min ? b->min : a->min,
                                             .max = b->max > a->max ? b->max : a->max};
    }
    s->blocks = DAL_STATISTICS_BLOCKS / 2;
    s->length *= 2;
}

static double sum_of(const double *a /* [DAL_PARTIAL_SUMS] */)
{
    return ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
}

/* ---- units ---- */

/* For numbers near the largest double: their sums and differences stay finite. */
static const double small_factor = 0x1p-200;

/* Differences are counted in units of max |x| of all full blocks. */
static void raise_rough_unit(dal_statistics *s)
{
    const double max = fmax(fabs(s->min), fabs(s->max));
    if (max <= s->rough_unit) return;
    /* The smallest power of two above it whose inverse is a number. */
    int exponent;
    frexp(max, &exponent);
    const double unit = ldexp(1.0, exponent < -1000 ? -1000 : exponent > 1000 ? 1000 : exponent);
    const double ratio = (s->rough_unit > 0.0 ? s->rough_unit : 1.0) / unit;
    s->rough_steps = s->rough_steps * ratio * ratio;
    for (int i = 0; i < DAL_PARTIAL_SUMS; i++) s->rough[i] = s->rough[i] * ratio * ratio;
    s->rough_unit = unit;
}

static double per_rough_unit(const dal_statistics *s)
{
    return s->rough_unit > 0.0 ? 1.0 / s->rough_unit : 1.0;
}

/* ---- one value ---- */

/* Of the open block: rms^2/unit^2 = <((x - from)/unit)^2> - <(x - from)/unit>^2. */
static double open_rms(const dal_statistics *s, double mean)
{
    const double unit = s->rough_unit > 0.0 ? s->rough_unit : 1.0;
    const double from = s->open_from * s->factor - s->first * s->factor;
    const double d = (mean - from) / unit / s->factor;
    const double square = sum_of(s->open_square) / (double)s->length - d * d;
    return square > 0.0 ? s->factor * unit * sqrt(square) : 0.0;
}

static void close_block(dal_statistics *s, double t)
{
    const double mean = sum_of(s->open_sum) / (double)s->length;
    s->block[s->blocks++] = (dal_statistics_block){.t = 0.5 * (s->open_t + t),
                                                   .x = mean,
                                                   .rms = open_rms(s, mean),
                                                   .min = s->open_min,
                                                   .max = s->open_max};
    s->min = s->open_min < s->min ? s->open_min : s->min;
    s->max = s->open_max > s->max ? s->open_max : s->max;
    s->open_count = 0;
    raise_rough_unit(s);
    if (s->blocks == DAL_STATISTICS_BLOCKS) halve(s);
}

static void open_block(dal_statistics *s, double t, double x)
{
    if (s->count == 0) {
        s->first = s->min = s->max = x;
        s->from = t;
    }
    s->open_t = t;
    s->open_min = s->open_max = x;
    s->open_from = x;
    memset(s->open_sum, 0, sizeof s->open_sum);
    memset(s->open_square, 0, sizeof s->open_square);
}

/* Counts values up to x at t. */
static void move_on(dal_statistics *s, int values, double t, double x)
{
    s->last = x;
    s->to = t;
    s->count += values;
    s->open_count += values;
    if (s->open_count == s->length) close_block(s, t);
}

static double square_of(const dal_statistics *s, double x, double from)
{
    const double unit = per_rough_unit(s);
    const double d = s->factor < 1.0 ? x * unit - from * unit : (x - from) * unit;
    return d * d < DAL__ROUGH_LIMIT ? d * d : DAL__ROUGH_LIMIT;
}

/* Blocks too short for a cycle: the first thousand values. */
static bool is_short(const dal_statistics *s) { return s->length < DAL__CYCLE * DAL_PARTIAL_SUMS; }

static void add_roughness(dal_statistics *s, double x)
{
    const int number = (int)(s->open_count % DAL_PARTIAL_SUMS);
    const int phase = (int)(s->open_count / DAL_PARTIAL_SUMS % DAL__CYCLE);
    if (is_short(s))
        s->rough_steps += s->count > 0 ? square_of(s, x, s->last) : 0.0;
    else if (phase == 0)
        s->held[number] = x;
    else if (phase == 1)
        s->rough[number] += square_of(s, x, s->held[number]);
}

static void add_one(dal_statistics *s, double t, double x)
{
    if (!(fabs(x) < INFINITY)) {
        s->lost = 1;
        return;
    }
    if (fabs(x) > DAL__PLAIN_LIMIT && s->factor == 1.0) {
        s->factor = small_factor;
        for (int i = 0; i < DAL_PARTIAL_SUMS; i++) s->open_sum[i] *= small_factor;
        for (int i = 0; i < DAL_STATISTICS_BLOCKS; i++) {
            s->block[i].x *= small_factor;
            s->block[i].rms *= small_factor;
        }
    }
    if (s->open_count == 0) open_block(s, t, x);
    add_roughness(s, x);
    const int number = (int)(s->open_count % DAL_PARTIAL_SUMS);
    s->open_sum[number] += x * s->factor - s->first * s->factor;
    s->open_square[number] += square_of(s, x, s->open_from);
    s->open_min = x < s->open_min ? x : s->open_min;
    s->open_max = x > s->open_max ? x : s->open_max;
    move_on(s, 1, t, x);
}

void dal_statistics_add(dal_statistics *s, int count, double t, const double *values)
{
    for (int i = 0; s && values && i < count; i++) add_one(&s[i], t, values[i]);
}

void dal_statistics_add_scales(dal_statistics *s, int count, const double *scales)
{
    for (int i = 0; s && scales && i < count; i++)
        if (!(scales[i] <= s[i].scale)) s[i].scale = isnan(scales[i]) ? INFINITY : scales[i];
}

/* ---- many values ---- */

typedef bool tally_packs(dal__tally *tally, double first, int phase, int packs,
                         const double *values);

/* For the best instructions of the machine: all variants give the same. */
static tally_packs *best_tally(void)
{
    tally_packs *best = dal__tally_packs_x1;
#define X(name, variant, lanes, set)                                                               \
    if (dal__machine_has(DAL__##set)) best = name##_##variant;
    DAL__VARIANT_LIST(X, dal__tally_packs)
#undef X
    return best;
}

/* Whole packs at the end of what the open block has, as many as it still takes. */
static int packs_ahead(const dal_statistics *s, int values)
{
    if (s->open_count % DAL_PARTIAL_SUMS != 0 || is_short(s) || s->factor < 1.0) return 0;
    const long long rest = s->length - s->open_count;
    return (int)(rest < values ? rest : values) / DAL_PARTIAL_SUMS;
}

static bool add_packs(dal_statistics *s, tally_packs *add, int packs, const double *t,
                      const double *x)
{
    const int values = packs * DAL_PARTIAL_SUMS;
    if (!(fabs(x[0]) <= DAL__PLAIN_LIMIT)) return false;
    if (s->open_count == 0) open_block(s, t[0], x[0]);
    dal__tally tally = {s->open_sum, s->open_min,       s->open_max,    s->rough,
                        s->held,     per_rough_unit(s), s->open_square, s->open_from};
    const int phase = (int)(s->open_count / DAL_PARTIAL_SUMS % DAL__CYCLE);
    if (!add(&tally, s->first, phase, packs, x)) return false;
    s->open_min = tally.min;
    s->open_max = tally.max;
    move_on(s, values, t[values - 1], x[values - 1]);
    return true;
}

static void add_series(dal_statistics *s, tally_packs *add, int values, const double *t,
                       const double *x)
{
    for (int k = 0; k < values;) {
        const int packs = packs_ahead(s, values - k);
        if (packs > 0 && add_packs(s, add, packs, t + k, x + k)) {
            k += packs * DAL_PARTIAL_SUMS;
            continue;
        }
        const int end = packs > 0 ? k + DAL_PARTIAL_SUMS : k + 1;
        for (; k < end; k++) add_one(s, t[k], x[k]);
    }
}

void dal_statistics_add_many(dal_statistics *s, int count, int samples, const double *t,
                             const double *values, size_t stride)
{
    tally_packs *const add = best_tally();
    if (!s || !t || !values) return;
    for (int i = 0; i < count; i++) add_series(&s[i], add, samples, t, values + (size_t)i * stride);
}

/* ---- extremes ---- */

static double min(const dal_statistics *s)
{
    return s->open_count ? fmin(s->min, s->open_min) : s->min;
}

static double max(const dal_statistics *s)
{
    return s->open_count ? fmax(s->max, s->open_max) : s->max;
}

double dal_statistics_max_abs(const dal_statistics *s)
{
    if (!s) return NAN;
    return s->lost ? INFINITY : fmax(fabs(min(s)), fabs(max(s)));
}

double dal_statistics_deviation(const dal_statistics *s)
{
    if (!s) return NAN;
    return s->lost ? INFINITY : fmax(max(s) - s->first, s->first - min(s));
}

/* ---- blocks ---- */

int dal__statistics_blocks(const dal_statistics *s, dal_statistics_block *block)
{
    const int n = (int)s->blocks;
    memcpy(block, s->block, (size_t)n * sizeof *block);
    for (int i = 0; i < n; i++) {
        block[i].t = fabs(block[i].t - s->from); /* a run may go backwards in t */
        block[i].x /= s->factor;
        block[i].rms /= s->factor;
        block[i].min -= s->first;
        block[i].max -= s->first;
    }
    return n;
}

double dal__roughness(const dal_statistics *s)
{
    double sum = 0.0;
    for (int i = 0; i < DAL_PARTIAL_SUMS; i++) sum += s->rough[i];
    const double unit = s->rough_unit > 0.0 ? s->rough_unit : 1.0;
    return s->factor * unit * sqrt(s->rough_steps + sum * DAL__CYCLE / DAL_PARTIAL_SUMS);
}

/* ---- means and lines ---- */

/* Both are made from the means of N blocks.  Were those independent, the variance of the mean would
 * be sigma^2/N, of the slope sigma^2/S_tt; with the correlation rho of neighbours it is
 * larger by (1 + rho)/(1 - rho), and N blocks are worth as many fewer (Priestley, Spectral Analysis
 * and Time Series, 5.3.2).  The intervals are Student's for that many. */
typedef struct line {
    double t, x, slope; /* through the means (t, x) */
    double tt;          /* sum of squares of t about its mean */
} line;

static line fit_line(const dal_statistics_block *block, int n)
{
    line l = {0};
    double tx = 0.0;
    for (int i = 0; i < n; i++) {
        l.t += block[i].t / n;
        l.x += block[i].x / n;
    }
    for (int i = 0; i < n; i++) {
        const double t = block[i].t - l.t;
        l.tt += t * t;
        tx += t * (block[i].x - l.x);
    }
    l.slope = l.tt > 0.0 ? tx / l.tt : 0.0;
    return l;
}

/* The 97.5 % quantile of Student's distribution, expanded about the quantile of the normal one
 * (Fisher, Cornish 1960, DOI 10.1080/00401706.1960.10489895): better than 1 % from 3 degrees on. */
double dal__student(double freedom)
{
    static const double c[] = {1.959964, 2.372212, 2.822501, 2.555850};
    const double f = 1.0 / fmax(freedom, 1.0);
    return c[0] + f * (c[1] + f * (c[2] + f * c[3]));
}

double dal__inflation(double square, double product, int n)
{
    /* Residues are correlated by -2/n even where the values are not. */
    const double rho = fmin(fmax(product / square + 2.0 / n, 0.0), 1.0 - 1.0 / n);
    return (1.0 + rho) / (1.0 - rho);
}

/* Half the width of the interval of a line with 1 parameter (a mean) or 2; its variance is the
 * variance of the residues over the sum of squares (N for a mean). */
static double half_width(const line *l, const dal_statistics_block *block, int n, int parameters,
                         double squares)
{
    double square = 0.0, product = 0.0, before = 0.0;
    if (n < 3) return INFINITY;
    for (int i = 0; i < n; i++) {
        const double r = block[i].x - l->x - l->slope * (block[i].t - l->t);
        square += r * r;
        product += r * before;
        before = r;
    }
    if (!(square > 0.0)) return 0.0;
    const double inflation = dal__inflation(square, product, n);
    return dal__student(n / inflation - parameters) *
           sqrt(square / (n - parameters) / squares * inflation);
}

void dal_statistics_mean(const dal_statistics *s, dal_average *average)
{
    dal_statistics_block block[DAL_STATISTICS_BLOCKS];
    if (!average) return;
    if (!s) {
        *average = (dal_average){NAN, NAN, NAN};
        return;
    }
    const int n = dal__statistics_blocks(s, block);
    double sum = s->open_count > 0 ? sum_of(s->open_sum) / s->factor : 0.0;
    for (int i = 0; i < n; i++) sum += block[i].x * (double)s->length;
    const double mean = s->lost || s->count == 0 ? NAN : s->first + sum / (double)s->count;
    line level = fit_line(block, n);
    level.slope = 0.0;
    const double margin = half_width(&level, block, n, 1, n);
    *average = (dal_average){mean, mean - margin, mean + margin};
}

void dal__trend_line(const dal_statistics *s, dal_trend *trend)
{
    dal_statistics_block block[DAL_STATISTICS_BLOCKS];
    const int n = dal__statistics_blocks(s, block);
    const line l = fit_line(block, n);
    const double margin = half_width(&l, block, n, 2, l.tt);
    trend->rate = l.slope;
    trend->rate_low = l.slope - margin;
    trend->rate_high = l.slope + margin;
}

double dal__trend_amplitude(const dal_statistics *s, double rate)
{
    dal_statistics_block block[DAL_STATISTICS_BLOCKS];
    const int n = dal__statistics_blocks(s, block);
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < n; i++) {
        low = fmin(low, block[i].min - rate * block[i].t);
        high = fmax(high, block[i].max - rate * block[i].t);
    }
    const double within = n > 0 && block[0].min < block[0].max ? 1.0 : 0.0;
    const double rise = n > 1 ? within * fabs(rate) * (block[1].t - block[0].t) : 0.0;
    return n > 0 ? fmax(0.5 * (high - low - rise), 0.0) : 0.0;
}

double dal_statistics_rate_range(const dal_statistics *s)
{
    enum { QUARTERS = 4, MIN_BLOCKS = 16 };
    dal_statistics_block block[DAL_STATISTICS_BLOCKS];
    double low = INFINITY, high = -INFINITY;
    const int n = s && !s->lost ? dal__statistics_blocks(s, block) : 0;
    if (n < MIN_BLOCKS) return NAN;
    for (int k = 0; k < QUARTERS; k++) {
        const int from = k * n / QUARTERS, to = (k + 1) * n / QUARTERS;
        const double slope = fit_line(block + from, to - from).slope;
        low = fmin(low, slope);
        high = fmax(high, slope);
    }
    return high - low;
}
