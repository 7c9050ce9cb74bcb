/* block_means.c - the mean and the line of least squares of a quantity, with intervals.
 *
 * Both are made from the means of N blocks.  Were those independent, the variance of the mean would
 * be sigma^2/N and that of the slope sigma^2/S_tt; with the correlation rho of neighbours it is
 * larger by (1 + rho)/(1 - rho), and N blocks are worth as many fewer (Priestley, Spectral Analysis
 * and Time Series, 5.3.2).  The intervals are Student's for that many. */
#include "analysis/block_means.h"
#include "analysis/statistics.h"
#include <math.h>

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
    /* Residues are correlated by -2/n even where the values are not. */
    const double rho = fmin(fmax(product / square + 2.0 / n, 0.0), 1.0 - 1.0 / n);
    return (1.0 + rho) / (1.0 - rho);
}

/* Half the width of the interval of a line with 1 parameter (a mean) or 2; its variance is that of
 * the residues over the sum of squares (N for a mean). */
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
    double sum = s->open_count > 0 ? dal__open_sum(s) : 0.0;
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
