/* walk.c - a random walk under noise, by Kalman's filter.
 *
 *     x_i = level_i + w_i noise,   level_(i+1) = level_i + drift dt + sqrt(ratio w_i w_(i+1)) noise
 *
 * The filter predicts each x from those before; what it misses by, over its own deviation, are
 * independent numbers of one variance (Harvey, Forecasting, Structural Time Series Models and the
 * Kalman Filter, 1989, 3.4, 4.1).  The drift is fitted to the same filter's misses of t itself. */
#include "measure/fit.h"
#include <math.h>

static double dot(const double *a, const double *b, int n)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* The misses, each over its own deviation, of a level that walks by ratio w^2 a block under
 * noise of w^2: those of x and those of t. */
static double filter(const dal__series *s, double ratio, double *of_x, double *of_t)
{
    double x = s->x[0] * s->w[0], t = s->t[0], variance = s->w[0] * s->w[0], logs = 0.0;
    for (int i = 1; i < s->n; i++) {
        const double square = s->w[i] * s->w[i];
        variance += ratio * s->w[i] * s->w[i - 1];
        const double total = variance + square, share = variance / total;
        const double dx = s->x[i] * s->w[i] - x, dt = s->t[i] - t;
        of_x[i - 1] = dx / sqrt(total);
        of_t[i - 1] = dt / sqrt(total);
        x += share * dx;
        t += share * dt;
        variance *= 1.0 - share;
        logs += 0.5 * log(total);
    }
    return logs * s->n / (s->n - 1.0);
}

static dal__explanation with_ratio(const dal__series *s, double ratio, int drifts)
{
    double a[DAL_BLOCKS], b[DAL_BLOCKS];
    dal__series scaled = *s;
    const int n = s->n - 1;
    scaled.logs = filter(s, ratio, a, b);
    const double drift = drifts ? dot(a, b, n) / dot(b, b, n) : 0.0;
    for (int i = 0; i < n; i++) a[i] -= drift * b[i];
    const double variance = dot(a, a, n) / n;
    return (dal__explanation){dal__criterion(&scaled, variance * s->n, 3 + drifts), ratio,
                              sqrt(variance * ratio) * exp(s->logs / s->n)};
}

dal__explanation dal__fit_walk(const dal__series *s, int drifts)
{
    dal__explanation most = {.criterion = INFINITY};
    for (double ratio = 0.01; ratio < 200.0; ratio *= 10.0) {
        const dal__explanation w = with_ratio(s, ratio, drifts);
        if (w.criterion < most.criterion) most = w;
    }
    return most;
}
