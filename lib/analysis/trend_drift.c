/* trend_drift.c - the rate of a series, and what lies about its line.
 *
 * Under each noise (trend_evidence.c) the drift b of a straight line has Student's distribution
 * about its estimate; the interval is that of their mixture, each with the weight of its noise:
 *
 *     F(b) = sum_k w_k T_nu((b - b_k)/d_k),     T_nu(t) = Phi(t (1 - 1/4 nu)/sqrt(1 + t^2/2 nu))
 *
 * (Abramowitz, Stegun 26.7.8).  Random walks weigh more there than elsewhere: taking a walk for
 * noise with memory makes the interval far too short, and the reverse costs little.
 *
 * A series of few values has the slope of least squares through its blocks.  Were those
 * independent, its variance would be sigma^2/S_tt; with the correlation rho of neighbours it is
 * larger by (1 + rho)/(1 - rho), and N blocks are worth as many fewer (Priestley, Spectral Analysis
 * and Time Series, 5.3.2).  The interval is Student's for that many. */
#include "analysis/trend.h"
#include <math.h>

enum { HALVINGS = 60 };

static const double negligible = 1e-5; /* weight of a noise, beside the heaviest */

/* ---- the mixture ---- */

typedef struct mixture {
    int count;
    double freedom, sum;
    double at[DAL__SHAPE_NOISES], deviation[DAL__SHAPE_NOISES], weight[DAL__SHAPE_NOISES];
} mixture;

static mixture mixture_of(const dal__evidence *e, bool no_trend)
{
    mixture m = {.freedom = e->freedom - 1.0};
    double heaviest = 0.0;
    for (int k = 0; k < DAL__SHAPE_NOISES; k++) heaviest = fmax(heaviest, e->drift_weight[k]);
    for (int pass = no_trend ? 0 : 1; pass < 2 && m.count == 0; pass++)
        for (int k = 0; k < DAL__SHAPE_NOISES; k++) {
            if (pass == 0 && dal__noise_list[k].meaning != DAL__MEANS_NONE) continue;
            if (!(e->drift_weight[k] > negligible * heaviest) && pass == 1) continue;
            m.at[m.count] = e->drift[k];
            m.deviation[m.count] = fmax(e->drift_deviation[k], 1e-300);
            m.weight[m.count++] = e->drift_weight[k];
            m.sum += e->drift_weight[k];
        }
    return m;
}

static double student_probability(double t, double freedom)
{
    const double z = t * (1.0 - 0.25 / freedom) / sqrt(1.0 + 0.5 * t * t / freedom);
    return 0.5 * erfc(-0.7071067811865476 * z);
}

static double probability(const mixture *m, double b)
{
    double sum = 0.0;
    for (int k = 0; k < m->count; k++)
        sum += m->weight[k] * student_probability((b - m->at[k]) / m->deviation[k], m->freedom);
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
    const double width = 1e-4 * (b - a);
    double fa = -p, fb = 1.0 - p;
    for (int i = 0; i < HALVINGS && fa != fb; i++) {
        const double c = i % 3 == 2 ? 0.5 * (a + b) : b - fb * (b - a) / (fb - fa);
        const double fc = probability(m, c) - p;
        if (fabs(fc) < 1e-3 * fmin(p, 1.0 - p)) return c;
        if (fc < 0.0) {
            a = c, fa = fc, fb *= 0.5;
        } else {
            b = c, fb = fc, fa *= 0.5;
        }
        if (b - a < 1e-3 * width) break;
    }
    return 0.5 * (a + b);
}

dal__interval dal__trend_drift(const dal__evidence *e, double level, bool no_trend)
{
    const mixture m = mixture_of(e, no_trend);
    double middle = 0.0;
    for (int k = 0; k < m.count; k++) middle += m.weight[k] / m.sum * m.at[k];
    const double low = quantile(&m, 0.5 * (1.0 - level)), high = quantile(&m, 0.5 * (1.0 + level));
    return (dal__interval){fmin(low, middle), middle, fmax(high, middle)};
}

/* ---- few values ---- */

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
static double uncertainty(const line *l, const dal_statistics_block *block, int n)
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
    return dal__student(n / inflation - 2.0) * sqrt(square / (n - 2) / l->tt * inflation);
}

void dal__trend_line(const dal_statistics *s, dal_trend *trend)
{
    dal_statistics_block block[DAL_STATISTICS_BLOCKS];
    const int n = dal__statistics_blocks(s, block);
    const line l = fit_line(block, n);
    const double margin = uncertainty(&l, block, n);
    trend->rate = l.slope;
    trend->rate_low = l.slope - margin;
    trend->rate_high = l.slope + margin;
}

/* ---- amplitude ---- */

/* What the line itself rises within a block does not count. */
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
