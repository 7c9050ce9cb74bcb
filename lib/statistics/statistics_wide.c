/* statistics_wide.c - partial sums and extremes of packs of values, over num.
 *
 * Value k of a pack is added to partial sum k, whatever the number of lanes: the order of summation
 * is always the same.  min and max do not depend on the order.  Only a value that is not finite
 * makes a partial sum not finite, so that one test at the end is enough.  Of each cycle of four
 * packs the first is subtracted from the second. */
#include "kernel/num.h"
#include "statistics/statistics.h"

enum { NUMS = DAL_PARTIAL_SUMS / DAL_LANES }; /* to a pack */

/* The tally of one num of the packs. */
typedef struct lane_tally {
    num sum, min, max, rough, held, square;
} lane_tally;

/* What is the same for all of them. */
typedef struct view {
    double first, per_unit, from;
    int phase, packs;
} view;

static num square_of(const view *v, num a, num from)
{
    const num d = (a - from) * v->per_unit;
    return dal_min(d * d, dal_num(DAL__ROUGH_LIMIT));
}

/* Adds one value, or a cycle of four at once: comparisons are slow, and most of the ones in a cycle
 * do not depend on each other. */
static void add_value(lane_tally *s, const view *v, int phase, num a)
{
    s->sum += a - v->first;
    s->min = dal_min(s->min, a);
    s->max = dal_max(s->max, a);
    if (phase == 0) s->held = a;
    if (phase == 1) s->rough += square_of(v, a, s->held);
    s->square += square_of(v, a, dal_num(v->from));
}

static void add_cycle(lane_tally *s, const view *v, num a, num b, num c, num d)
{
    s->sum = (((s->sum + (a - v->first)) + (b - v->first)) + (c - v->first)) + (d - v->first);
    s->min = dal_min(s->min, dal_min(dal_min(a, b), dal_min(c, d)));
    s->max = dal_max(s->max, dal_max(dal_max(a, b), dal_max(c, d)));
    s->rough += square_of(v, b, a);
    s->held = a;
    const num from = dal_num(v->from);
    s->square =
        (((s->square + square_of(v, a, from)) + square_of(v, b, from)) + square_of(v, c, from)) +
        square_of(v, d, from);
}

/* Every NUMS-th num from x on. */
static lane_tally add_packs(lane_tally s, const view *v, const dal_stored *x)
{
    int packs = v->packs, phase = v->phase;
    for (; packs > 0 && phase % DAL__CYCLE != 0; packs--, phase++, x += NUMS)
        add_value(&s, v, phase, x[0]);
    for (; packs >= DAL__CYCLE; packs -= DAL__CYCLE, x += DAL__CYCLE * NUMS)
        add_cycle(&s, v, x[0], x[NUMS], x[2 * NUMS], x[3 * NUMS]);
    for (phase = 0; packs > 0; packs--, phase++, x += NUMS) add_value(&s, v, phase, x[0]);
    return s;
}

bool DAL_WIDE(dal__tally_packs)(dal__tally *tally, double first, int phase, int packs,
                                const double *values)
{
    const dal_stored *const x = (const dal_stored *)values;
    dal_stored *const sum = (dal_stored *)tally->sum, *const rough = (dal_stored *)tally->rough,
                      *const held = (dal_stored *)tally->held,
                      *const square = (dal_stored *)tally->square;
    const view v = {first, tally->per_unit, tally->from, phase, packs};
    const num limit = dal_num(DAL__PLAIN_LIMIT);
    lane_tally s[NUMS];
    dal_mask good = dal_all();
    for (int i = 0; i < NUMS; i++) {
        s[i] = add_packs((lane_tally){sum[i], x[i], x[i], rough[i], held[i], square[i]}, &v, x + i);
        good &= dal_finite(s[i].sum) & dal_less_equal(s[i].max, limit) &
                dal_less_equal(-s[i].min, limit);
    }
    if (dal_any(~good)) return false;
    for (int i = 0; i < NUMS; i++) {
        sum[i] = s[i].sum;
        rough[i] = s[i].rough;
        held[i] = s[i].held;
        square[i] = s[i].square;
        for (int lane = 0; lane < DAL_LANES; lane++) {
            const double low = dal_lane(s[i].min, lane), high = dal_lane(s[i].max, lane);
            tally->min = low < tally->min ? low : tally->min;
            tally->max = high > tally->max ? high : tally->max;
        }
    }
    return true;
}
