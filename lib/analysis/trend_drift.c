/* trend_drift.c - the drift of a series, as an interval.
 *
 * Under each noise (trend_evidence.c) the drift b of a straight line has Student's distribution
 * about its estimate; the interval is that of their mixture, each with the weight of its noise:
 *
 *     F(b) = sum_k w_k T_nu((b - b_k)/d_k),     T_nu(t) = Phi(t (1 - 1/4 nu)/sqrt(1 + t^2/2 nu))
 *
 * (Abramowitz, Stegun 26.7.8).  Random walks weigh more there than elsewhere: taking a walk for
 * noise with memory makes the interval far too short, and the reverse costs little. */
#include "analysis/trend_drift.h"
#include <math.h>

enum { HALVINGS = 60 };

static const double negligible = 1e-5; /* weight of a noise, beside the largest */

typedef struct mixture {
    int count;
    double freedom, sum;
    double at[DAL__SHAPE_NOISES], deviation[DAL__SHAPE_NOISES], weight[DAL__SHAPE_NOISES];
} mixture;

static mixture mixture_of(const dal__evidence *e, bool no_trend)
{
    mixture m = {.freedom = e->freedom - 1.0};
    double largest = 0.0;
    for (int k = 0; k < DAL__SHAPE_NOISES; k++) largest = fmax(largest, e->drift_weight[k]);
    for (int pass = no_trend ? 0 : 1; pass < 2 && m.count == 0; pass++)
        for (int k = 0; k < DAL__SHAPE_NOISES; k++) {
            if (pass == 0 && dal__noise_list[k].meaning != DAL__MEANS_NONE) continue;
            if (!(e->drift_weight[k] > negligible * largest) && pass == 1) continue;
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
