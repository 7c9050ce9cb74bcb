/* earlier_statistics.c - the statistics of quantities as earlier versions saved them.
 *
 * Layout 3 has no root mean squares of blocks.  The range of n normal values is near
 * 0.1 + 1.6 sqrt(2 log n) deviations, the range of an oscillation 2 sqrt(2), of two values 2: from
 * the greatest of these that applies, the deviation of a block is estimated.  Blocks that follow
 * are measured, so that the share of the estimates falls as the run goes on.  Nor has it scales:
 * theirs was max(1, max |x|). */
#include "earlier_statistics.h"

#include <math.h>
#include <string.h>

typedef struct statistics_3 {
    int64_t count, length, blocks, open_count, lost;
    double first, last, min, max, from, to;
    double open_t, open_min, open_max, open_sum[DAL_PARTIAL_SUMS];
    double factor;
    double rough_unit, rough_steps, rough[DAL_PARTIAL_SUMS], held[DAL_PARTIAL_SUMS];
    struct {
        double t, x, min, max;
    } block[DAL_STATISTICS_BLOCKS];
} statistics_3;

_Static_assert(sizeof(statistics_3) == STATISTICS_WORDS_3 * sizeof(uint64_t), "layout 3");

/* Of n values with this range. */
static double estimated_deviation(double range, double n)
{
    if (n < 3.0) return 0.5 * range;
    return range / fmax(2.0 * sqrt(2.0), 0.1 + 1.6 * sqrt(2.0 * log(n)));
}

/* The partial sums of squares of the open block, as if all its values were one deviation from the
 * mean. */
static void estimate_open_block(dal_statistics *s)
{
    double sum = 0.0;
    for (int i = 0; i < DAL_PARTIAL_SUMS; i++) sum += s->open_sum[i];
    const double n = (double)s->open_count, unit = s->rough_unit > 0.0 ? s->rough_unit : 1.0;
    s->open_from = s->first + sum / s->factor / n;
    const double deviation = estimated_deviation(s->open_max - s->open_min, n) / unit;
    for (int i = 0; i < DAL_PARTIAL_SUMS; i++)
        s->open_square[i] = n / DAL_PARTIAL_SUMS * deviation * deviation;
}

void statistics_from_layout_3(dal_statistics *s, const uint64_t *words)
{
    statistics_3 a;
    memcpy(&a, words, sizeof a);
    *s = (dal_statistics){.count = a.count,
                          .length = a.length,
                          .blocks = a.blocks,
                          .open_count = a.open_count,
                          .lost = a.lost,
                          .first = a.first,
                          .last = a.last,
                          .min = a.min,
                          .max = a.max,
                          .from = a.from,
                          .to = a.to,
                          .open_t = a.open_t,
                          .open_min = a.open_min,
                          .open_max = a.open_max,
                          .factor = a.factor,
                          .rough_unit = a.rough_unit,
                          .rough_steps = a.rough_steps};
    memcpy(s->open_sum, a.open_sum, sizeof s->open_sum);
    memcpy(s->rough, a.rough, sizeof s->rough);
    memcpy(s->held, a.held, sizeof s->held);
    for (int i = 0; i < DAL_STATISTICS_BLOCKS; i++) {
        const double range = a.block[i].max * a.factor - a.block[i].min * a.factor;
        s->block[i] = (dal_statistics_block){.t = a.block[i].t,
                                             .x = a.block[i].x,
                                             .rms = estimated_deviation(range, (double)a.length),
                                             .min = a.block[i].min,
                                             .max = a.block[i].max};
    }
    if (a.open_count > 0) estimate_open_block(s);
    s->scale = fmax(1.0, dal_statistics_max_abs(s));
}
