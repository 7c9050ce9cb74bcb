/* predict_rates.c - mean rates and random walks of predicted changes.
 *
 * Mean rates are weighted with a bump function, exp(-1/(s (1 - s))), s = t/T: of quasi-periodic
 * motion they converge faster than any power of 1/T (Das, Saiki, Sander, Yorke 2017, DOI
 * 10.1088/1361-6544/aa84c2).  Their interval is the larger difference to the means over either
 * half, and what rounding may do.  A bump hardly sees the ends, where motion may begin or end
 * otherwise than it goes on: what is left of the sums at either end, beyond where it is in between,
 * belongs to the interval, too.
 *
 * Of chaotic motion the sums S over M pieces have E[S]/T, the drift, and var S = s^2 T + b with a
 * bounded b: s^2 = 2 (V - W)/T with V = var S(T), and W = var S(T/2) of both halves of all pieces.
 * The sums are Gaussian.  S(T) has the covariance V/2 with each half, and the halves C = V/2 - W
 * with each other, so that the error of s^2 is 2/T sqrt((V^2 + W^2 + C^2)/M): sqrt(5/M) of it where
 * b is small, and more where pieces are not long beside b/s^2. */
#include "dynamics/predict_rates.h"
#include <math.h>

enum { MIN_BINS = 4 };
/* Volumes that shrink by exp(-contraction) approach an attractor. */
static const double contraction = 2.0;
/* Motion that is as much farther away in its second half may not come back, and motion that ends
 * does not. */
static const double escape = 1.25;

typedef dal__prediction_work work;

/* The mean of the increments of an observable over bins from .. to - 1, weighted by a bump. */
static double weighted_mean(const work *w, int observable, long long from, long long to)
{
    double sum = 0.0, weights = 0.0;
    for (long long b = from; b < to; b++) {
        const double s = ((double)(b - from) + 0.5) / (double)(to - from);
        const double weight = exp(-1.0 / (s * (1.0 - s)));
        sum += weight * w->bins[(size_t)b * (size_t)w->count + (size_t)observable];
        weights += weight;
    }
    return sum / (weights * (double)w->steps_of_bin);
}

/* How far x is outside of low .. high, with a margin of that length at either side. */
static double outside(double x, double low, double high)
{
    return fmax(fmax(low - x, x - high) - (high - low), 0.0);
}

/* The sum of the increments less `mean` a step is 0 at the start.  How much more of it there is at
 * either end than in the middle half, in which it goes to and fro. */
static double excess_at_ends(const work *w, int observable, long long bins, double mean)
{
    double rest = 0.0, low = INFINITY, high = -INFINITY;
    for (long long b = 0; b < bins; b++) {
        if (b >= bins / 4 && b <= bins - bins / 4) {
            low = fmin(low, rest);
            high = fmax(high, rest);
        }
        rest += w->bins[(size_t)b * (size_t)w->count + (size_t)observable] -
                mean * (double)w->steps_of_bin;
    }
    return fmax(outside(0.0, low, high), outside(rest, low, high));
}

/* Rates of the moments over pieces, or else of the curve. */
static void find_rate(const work *w, int observable, dal_predicted *p)
{
    const dal_prediction *of = w->of;
    const long long made = of->steps / w->steps_of_bin;
    const long long bins = made < w->bin_count ? made : w->bin_count;
    const double M = (double)of->pieces, T = (double)w->steps * of->step, h = of->step;
    const double *S = w->moments + 3 * observable;
    p->rate = p->margin = p->walk = p->walk_margin = NAN;
    if (of->pieces > 1) {
        const double whole = fmax(S[1] - S[0] * S[0] / M, 0.0) / (M - 1.0);
        const double half = fmax(S[2] - 0.5 * S[0] * S[0] / M, 0.0) / (2.0 * M - 1.0);
        const double between = 0.5 * whole - half;
        p->rate = S[0] / (M * T);
        p->margin = 2.0 * sqrt(whole / M) / fabs(T);
        p->walk = 2.0 * (whole - half) / fabs(T);
        p->walk_margin =
            2.0 * sqrt((whole * whole + half * half + between * between) / M) / fabs(T);
    } else if (bins >= MIN_BINS) {
        const double first = weighted_mean(w, observable, 0, bins / 2) / h;
        const double second = weighted_mean(w, observable, bins / 2, bins) / h;
        const double steps = (double)bins * (double)w->steps_of_bin;
        const double noise = of->is_quad ? 0.0 : p->rounding / (sqrt(steps) * fabs(h));
        const double mean = weighted_mean(w, observable, 0, bins);
        p->rate = mean / h;
        p->margin = fmax(fabs(first - p->rate), fabs(second - p->rate)) + noise +
                    excess_at_ends(w, observable, bins, mean) / (steps * fabs(h));
    }
}

dal_status dal__predict_results(work *w)
{
    /* Phase volume that shrinks steadily, in the mean over both halves and beyond the chance of its
     * samples: what a step changes is forgotten there, and sums do not forget. */
    double sum[2] = {0.0, 0.0}, squares = 0.0;
    const int half = w->divergences / 2;
    for (int i = 0; i < 2 * half; i++) {
        sum[i >= half] += w->divergence[i] / half;
        squares += w->divergence[i] * w->divergence[i] / (2.0 * half);
    }
    const double T = fabs(w->of->end - w->of->from), mean = 0.5 * (sum[0] + sum[1]);
    const double chance = 4.0 * sqrt(fmax(squares - mean * mean, 0.0) / fmax(half, 1.0));
    const bool steady = half > 2 && fmax(sum[0], sum[1]) < 0.25 * mean - chance;
    if (steady && mean * T < -contraction)
        return dal__predict_refuse(
            w, "the motion approaches an attractor, on which it forgets changes");
    const bool is_whole = w->of->steps == w->steps * (w->pieces > 0 ? w->pieces : 1);
    const bool returns = is_whole && w->reach[1] <= escape * w->reach[0];
    w->of->rows = w->row;
    w->of->observables = w->count;
    for (int j = 0; j < w->count; j++) {
        dal_predicted *p = &w->of->predicted[j];
        dal_run_observable_name(w->run, j, p->name, sizeof p->name);
        p->is_conserved = w->conserved[j];
        p->is_zero = p->is_conserved && w->even[j] && !w->of->leaves_D && returns;
        find_rate(w, j, p);
        if (p->is_conserved) continue;
        p->change = p->max_change = p->rate = p->margin = p->walk = p->walk_margin = NAN;
        for (long long r = 0; r < w->row; r++)
            w->of->change[(size_t)r * (size_t)w->count + (size_t)j] = NAN;
    }
    return DAL_STATUS_OK;
}
