/* statistics_wide.c - packs of values summed and ranged, over num.
 *
 * Value k of a pack goes to part k of the sum, however many lanes a num has: the order of summation
 * is one.  Least and most do not depend on the order.  What is not finite makes a part of the sum
 * not finite, and nothing else does but an overflow, so that one look at the end is enough. */
#include "kernel/groups.h"

#include "kernel/num.h"
#include "measure/statistics.h"

enum { NUMS = DAL_PARTS / DAL_LANES }; /* to a pack */

/* What one num of the packs has seen. */
typedef struct seen {
    num sum, least, most;
} seen;

/* One more value, or four: comparisons take a processor long, so that most of them do not wait for
 * each other. */
static void see(seen *s, double first, num a)
{
    s->sum += a - first;
    s->least = dal_min(s->least, a);
    s->most = dal_max(s->most, a);
}

static void see_four(seen *s, double first, num a, num b, num c, num d)
{
    s->sum = (((s->sum + (a - first)) + (b - first)) + (c - first)) + (d - first);
    s->least = dal_min(s->least, dal_min(dal_min(a, b), dal_min(c, d)));
    s->most = dal_max(s->most, dal_max(dal_max(a, b), dal_max(c, d)));
}

/* Every NUMS-th num from x on. */
static seen see_all(num sum, double first, int packs, const dal_stored *x)
{
    seen s = {sum, x[0], x[0]};
    for (; packs >= 4; packs -= 4, x += 4 * NUMS)
        see_four(&s, first, x[0], x[NUMS], x[2 * NUMS], x[3 * NUMS]);
    for (; packs > 0; packs--, x += NUMS) see(&s, first, x[0]);
    return s;
}

static void gather(const seen *s, dal__tally *tally)
{
    for (int lane = 0; lane < DAL_LANES; lane++) {
        const double low = dal_lane(s->least, lane), high = dal_lane(s->most, lane);
        tally->least = low < tally->least ? low : tally->least;
        tally->most = high > tally->most ? high : tally->most;
    }
}

bool DAL_WIDE(dal__tally_packs)(dal__tally *tally, double first, int packs, const double *values)
{
    const dal_stored *const x = (const dal_stored *)values;
    dal_stored *const part = (dal_stored *)tally->sum;
    seen s[NUMS];
    num poison = dal_num(0.0);
    for (int i = 0; i < NUMS; i++) {
        s[i] = see_all(part[i], first, packs, x + i);
        poison += s[i].sum - s[i].sum;
    }
    if (dal_any(~dal_equal(poison, dal_num(0.0)))) return false;
    for (int i = 0; i < NUMS; i++) {
        part[i] = s[i].sum;
        gather(&s[i], tally);
    }
    return true;
}
