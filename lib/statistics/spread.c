/* spread.c - statistics of the members of an ensemble: moments, quantiles, covariance.
 *
 * The mean of a first sum is corrected by the mean of the differences from it, so that its error is
 * a few roundings whatever the count (Neely 1966, DOI 10.1145/365719.365958). */
#include "dalembert_batch.h"
#include "dalembert_program.h"
#include <math.h>
#include <stdbool.h>

void dal_spread_measure(dal_spread *spread, const double *values, long long count)
{
    if (!spread) return;
    *spread = (dal_spread){0, NAN, NAN, NAN, NAN};
    if (!values || count < 1) return;
    double sum = 0.0, differences = 0.0, squares = 0.0;
    double min = values[0], max = values[0];
    for (long long i = 0; i < count; i++) {
        sum += values[i];
        min = values[i] < min ? values[i] : min;
        max = values[i] > max ? values[i] : max;
    }
    const double first_mean = sum / (double)count;
    for (long long i = 0; i < count; i++) differences += values[i] - first_mean;
    const double mean = first_mean + differences / (double)count;
    for (long long i = 0; i < count; i++) squares += (values[i] - mean) * (values[i] - mean);
    *spread =
        (dal_spread){count, mean, count > 1 ? sqrt(squares / (double)(count - 1)) : NAN, min, max};
}

/* Reorders values[first..last] so that number k is where sorting would put it, smaller ones before
 * and larger ones after it (Hoare 1961, algorithm 65, DOI 10.1145/366622.366647). */
static void select_value(double *values, long long first, long long last, long long k)
{
    while (first < last) {
        const double pivot = values[k];
        long long i = first, j = last;
        while (i <= j) {
            while (values[i] < pivot) i++;
            while (values[j] > pivot) j--;
            if (i > j) break;
            const double other = values[i];
            values[i++] = values[j];
            values[j--] = other;
        }
        if (j < k) first = i;
        if (k < i) last = j;
    }
}

void dal_measure_quantiles(double *values, long long count, const double *p, int quantiles,
                           double *quantile)
{
    for (int i = 0; p && quantile && i < quantiles; i++) {
        quantile[i] = NAN;
        if (!values || count < 1 || !(p[i] >= 0.0 && p[i] <= 1.0)) continue;
        const double place = p[i] * (double)(count - 1);
        const long long low = (long long)place, high = low + 1 < count ? low + 1 : low;
        select_value(values, 0, count - 1, low);
        select_value(values, low, count - 1, high);
        const double fraction = place - (double)low;
        quantile[i] = values[low] + fraction * (values[high] - values[low]);
    }
}

long long dal__add_products(int columns, const double *mean, const double *rows, long long count,
                            double *sums)
{
    long long added = 0;
    if (!mean || !rows || !sums) return 0;
    for (const double *x = rows; count > 0; count--, x += columns) {
        bool is_finite = true;
        for (int i = 0; i < columns; i++) is_finite &= isfinite(x[i]) != 0;
        if (!is_finite) continue;
        for (int i = 0; i < columns; i++)
            for (int j = 0; j < columns; j++)
                sums[i * columns + j] += (x[i] - mean[i]) * (x[j] - mean[j]);
        added++;
    }
    return added;
}
