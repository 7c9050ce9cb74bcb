/* block_means.c - the mean of a quantity and its interval, from the means of N blocks.
 *
 * The variance of the mean of independent blocks is sigma^2 / N; the correlation of neighbours
 * inflates it as it does that of a rate (statistics.c). */
#include "analysis/statistics.h"
#include <math.h>

/* Half the width of the interval about the mean of the blocks. */
static double uncertainty(const dal_statistics_block *block, int n)
{
    double mean = 0.0, square = 0.0, product = 0.0, before = 0.0;
    if (n < 3) return INFINITY;
    for (int i = 0; i < n; i++) mean += block[i].x / n;
    for (int i = 0; i < n; i++) {
        const double r = block[i].x - mean;
        square += r * r;
        product += r * before;
        before = r;
    }
    if (!(square > 0.0)) return 0.0;
    const double inflation = dal__inflation(square, product, n);
    return dal__student(n / inflation - 1.0) * sqrt(square / (n - 1.0) / n * inflation);
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
    const double margin = uncertainty(block, n);
    *average = (dal_average){mean, mean - margin, mean + margin};
}
