/* statistics.c - a quantity x(t) followed at every step in constant memory.
 *
 * The series is cut into blocks of equal length, of which mean, least and most are kept.  When all
 * DAL_BLOCKS are full, neighbours are joined and the length doubles, so that between one half and
 * all of them are in use after any number of values: the method of batch means (Flyvbjerg,
 * Petersen 1989, DOI 10.1063/1.457480; Law, Kelton, Simulation Modeling and Analysis, 9.5).
 *
 * The rate is the slope of least squares through the means of the blocks.  Were those independent,
 * its variance would be sigma^2 / S_tt; with the correlation rho of neighbours it is larger by
 * (1 + rho)/(1 - rho), and N blocks are worth as many fewer (Priestley, Spectral Analysis and Time
 * Series, 5.3.2).  The interval is Student's for that many. */
#include "measure/statistics.h"
#include <math.h>
#include <string.h>

void dal_statistics_start(dal_statistics *s, int count)
{
    for (int i = 0; i < count; i++) s[i] = (dal_statistics){.length = 1};
}

/* Joins neighbours: half as many blocks, twice as long. */
static void halve(dal_statistics *s)
{
    for (int i = 0; i < DAL_BLOCKS / 2; i++) {
        const dal_mean *a = &s->block[2 * i], *b = a + 1;
        s->block[i] = (dal_mean){0.5 * (a->t + b->t), 0.5 * (a->x + b->x), fmin(a->least, b->least),
                                 fmax(a->most, b->most)};
    }
    s->blocks = DAL_BLOCKS / 2;
    s->length *= 2;
}

double dal__open_sum(const dal_statistics *s)
{
    const double *a = s->open_sum;
    return ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
}

static void close_block(dal_statistics *s, double t)
{
    s->block[s->blocks++] = (dal_mean){0.5 * (s->open_t + t), dal__open_sum(s) / (double)s->length,
                                       s->open_least, s->open_most};
    s->least = fmin(s->least, s->open_least);
    s->most = fmax(s->most, s->open_most);
    s->open_count = 0;
    if (s->blocks == DAL_BLOCKS) halve(s);
}

static void open_block(dal_statistics *s, double t, double x)
{
    if (s->count == 0) {
        s->first = s->least = s->most = x;
        s->from = t;
    }
    s->open_t = t;
    s->open_least = s->open_most = x;
    memset(s->open_sum, 0, sizeof s->open_sum);
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

static void add_one(dal_statistics *s, double t, double x)
{
    if (!(fabs(x) < INFINITY)) {
        s->lost = 1;
        return;
    }
    if (s->open_count == 0) open_block(s, t, x);
    s->open_sum[s->open_count % DAL_PARTS] += x - s->first;
    s->open_least = x < s->open_least ? x : s->open_least;
    s->open_most = x > s->open_most ? x : s->open_most;
    move_on(s, 1, t, x);
}

void dal_statistics_add(dal_statistics *s, int count, double t, const double *values)
{
    for (int i = 0; s && values && i < count; i++) add_one(&s[i], t, values[i]);
}

/* ---- many values ---- */

typedef bool tally_packs(dal__tally *tally, double first, int packs, const double *values);

/* For the best instructions of the machine: all variants give the same. */
static tally_packs *best_tally(void)
{
    tally_packs *best = dal__tally_packs_x1;
#define X(name, variant, lanes, set, group)                                                        \
    if (dal__machine_has(DAL__##set)) best = name##_##variant;
    DAL__VARIANT_LIST(X, dal__tally_packs)
#undef X
    return best;
}

/* Whole packs at the end of what the open block has, as many as it still takes. */
static int packs_ahead(const dal_statistics *s, int values)
{
    if (s->open_count % DAL_PARTS != 0) return 0;
    const long long left = s->length - s->open_count;
    return (int)(left < values ? left : values) / DAL_PARTS;
}

static bool add_packs(dal_statistics *s, tally_packs *add, int packs, const double *t,
                      const double *x)
{
    const int values = packs * DAL_PARTS;
    if (!(fabs(x[0]) < INFINITY)) return false;
    if (s->open_count == 0) open_block(s, t[0], x[0]);
    dal__tally tally = {s->open_sum, s->open_least, s->open_most};
    if (!add(&tally, s->first, packs, x)) return false;
    s->open_least = tally.least;
    s->open_most = tally.most;
    move_on(s, values, t[values - 1], x[values - 1]);
    return true;
}

static void add_series(dal_statistics *s, tally_packs *add, int values, const double *t,
                       const double *x)
{
    for (int k = 0; k < values;) {
        const int packs = packs_ahead(s, values - k);
        if (packs > 0 && add_packs(s, add, packs, t + k, x + k)) {
            k += packs * DAL_PARTS;
            continue;
        }
        const int end = packs > 0 ? k + DAL_PARTS : k + 1;
        for (; k < end; k++) add_one(s, t[k], x[k]);
    }
}

void dal_statistics_add_many(dal_statistics *s, int count, int looks, const double *t,
                             const double *values, size_t stride)
{
    tally_packs *const add = best_tally();
    if (!s || !t || !values) return;
    for (int i = 0; i < count; i++) add_series(&s[i], add, looks, t, values + (size_t)i * stride);
}

/* ---- extremes ---- */

static double least(const dal_statistics *s)
{
    return s->open_count ? fmin(s->least, s->open_least) : s->least;
}

static double most(const dal_statistics *s)
{
    return s->open_count ? fmax(s->most, s->open_most) : s->most;
}

double dal_statistics_max_abs(const dal_statistics *s)
{
    if (!s) return NAN;
    return s->lost ? INFINITY : fmax(fabs(least(s)), fabs(most(s)));
}

double dal_statistics_deviation(const dal_statistics *s)
{
    if (!s) return NAN;
    return s->lost ? INFINITY : fmax(most(s) - s->first, s->first - least(s));
}

/* ---- blocks ---- */

int dal__blocks(const dal_statistics *s, dal_mean *block)
{
    const int n = (int)s->blocks;
    memcpy(block, s->block, (size_t)n * sizeof *block);
    for (int i = 0; i < n; i++) {
        block[i].t -= s->from;
        block[i].least -= s->first;
        block[i].most -= s->first;
    }
    return n;
}

/* ---- rate ---- */

typedef struct line {
    double t, x, slope; /* through the means (t, x) */
    double tt;          /* sum of squares of t about its mean */
} line;

static line fit_line(const dal_mean *block, int n)
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

static double above(const line *l, const dal_mean *b, double x)
{
    return x - l->x - l->slope * (b->t - l->t);
}

/* The 97.5 % quantile of Student's distribution, expanded about that of the normal one (Fisher,
 * Cornish 1960, DOI 10.1080/00401706.1960.10489895): better than 1 % from 3 degrees on. */
double dal__student(double freedom)
{
    static const double c[] = {1.959964, 2.372212, 2.822501, 2.555850};
    const double f = 1.0 / fmax(freedom, 1.0);
    return c[0] + f * (c[1] + f * (c[2] + f * c[3]));
}

double dal__inflation(double square, double product, int n)
{
    /* Residues lean against each other by 2/n even where the values do not. */
    const double rho = fmin(fmax(product / square + 2.0 / n, 0.0), 1.0 - 1.0 / n);
    return (1.0 + rho) / (1.0 - rho);
}

/* Half the width of the interval about the slope. */
static double uncertainty(const line *l, const dal_mean *block, int n)
{
    double square = 0.0, product = 0.0, before = 0.0;
    if (n < 3) return INFINITY;
    for (int i = 0; i < n; i++) {
        const double r = above(l, &block[i], block[i].x);
        square += r * r;
        product += r * before;
        before = r;
    }
    if (!(square > 0.0)) return 0.0;
    const double inflation = dal__inflation(square, product, n);
    return dal__student(n / inflation - 2.0) * sqrt(square / (n - 2) / l->tt * inflation);
}

/* Half the range about the line; what the line itself rises within a block does not count. */
static double amplitude(const line *l, const dal_mean *block, int n)
{
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < n; i++) {
        low = fmin(low, above(l, &block[i], block[i].least));
        high = fmax(high, above(l, &block[i], block[i].most));
    }
    const double within = n > 0 && block[0].least < block[0].most ? 1.0 : 0.0;
    const double rise = n > 1 ? within * fabs(l->slope) * (block[1].t - block[0].t) : 0.0;
    return n > 0 ? fmax(0.5 * (high - low - rise), 0.0) : 0.0;
}

/* ---- growth ---- */

/* The slope of log max |x - first| over log t, at t = T, T/2, T/4, ... as far as blocks go. */
static double exponent(const dal_mean *block, int n)
{
    double reach[DAL_BLOCKS], most = 0.0, sum[5] = {0};
    for (int i = 0; i < n; i++)
        reach[i] = most = fmax(most, fmax(fabs(block[i].least), fabs(block[i].most)));
    for (int k = n; k > 0 && reach[k - 1] > 0.0; k /= 2) {
        const double a = log(k), b = log(reach[k - 1]);
        const double terms[] = {1.0, a, b, a * a, a * b};
        for (int i = 0; i < 5; i++) sum[i] += terms[i];
    }
    const double square = sum[0] * sum[3] - sum[1] * sum[1];
    return square > 0.0 ? (sum[0] * sum[4] - sum[1] * sum[2]) / square : 0.0;
}

/* ---- the whole ---- */

void dal_statistics_classify(const dal_statistics *s, double scale, int aborted, dal_trend *trend)
{
    dal_mean block[DAL_BLOCKS];
    const int n = dal__blocks(s, block);
    const line l = fit_line(block, n);
    const double margin = uncertainty(&l, block, n);
    *trend = (dal_trend){.count = s->count,
                         .first = s->first,
                         .last = s->last,
                         .max_abs = dal_statistics_max_abs(s),
                         .deviation = dal_statistics_deviation(s),
                         .amplitude = amplitude(&l, block, n),
                         .rate = l.slope,
                         .rate_low = l.slope - margin,
                         .rate_high = l.slope + margin,
                         .max_drift = (fabs(l.slope) + margin) * (s->to - s->from),
                         .exponent = exponent(block, n)};
    dal__classify(s, scale, aborted, trend);
}
