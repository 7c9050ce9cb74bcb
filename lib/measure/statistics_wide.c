/* statistics_wide.c - packs of values summed and ranged, over num.
 *
 * Value k of a pack goes to part k of the sum, however many lanes a num has: the order of summation
 * is one.  Least and most do not depend on the order.  What is not finite makes a part of the sum
 * not finite, and nothing else does but an overflow, so that one look at the end is enough. */
#include "kernel/groups.h"

#include "kernel/num.h"
#include "measure/statistics.h"

enum { NUMS = DAL_PARTS / DAL_LANES }; /* to a pack */

/* The least and most of a pack's places. */
static void gather(const num *least, const num *most, dal__tally *tally)
{
    for (int i = 0; i < DAL_PARTS; i++) {
        const double low = dal_lane(least[i / DAL_LANES], i % DAL_LANES);
        const double high = dal_lane(most[i / DAL_LANES], i % DAL_LANES);
        tally->least = low < tally->least ? low : tally->least;
        tally->most = high > tally->most ? high : tally->most;
    }
}

bool DAL_WIDE(dal__tally_packs)(dal__tally *tally, double first, int packs, const double *values)
{
    const dal_stored *x = (const dal_stored *)values;
    dal_stored *part = (dal_stored *)tally->sum;
    num sum[NUMS], least[NUMS], most[NUMS], poison = dal_num(0.0);
    for (int i = 0; i < NUMS; i++) {
        sum[i] = part[i];
        least[i] = most[i] = x[i];
    }
    for (int k = 0; k < packs; k++, x += NUMS)
        for (int i = 0; i < NUMS; i++) {
            sum[i] += x[i] - first;
            least[i] = dal_min(least[i], x[i]);
            most[i] = dal_max(most[i], x[i]);
        }
    for (int i = 0; i < NUMS; i++) poison += sum[i] - sum[i];
    if (dal_any(~dal_equal(poison, dal_num(0.0)))) return false;
    for (int i = 0; i < NUMS; i++) part[i] = sum[i];
    gather(least, most, tally);
    return true;
}
