/* statistics.h - what the statistics of a quantity share with those who read them. */
#ifndef DAL_STATISTICS_INTERNAL_H
#define DAL_STATISTICS_INTERNAL_H

#include "core/machine.h"
#include "dalembert_statistics.h"

enum { DAL__CYCLE = 4 }; /* packs: in each, one difference of packs is squared */

/* Of the open block: the partial sums of x - first, the range of x, the partial sums of the squares
 * of (x - held) times per_unit, the pack that is held: the first of a cycle; and the partial sums
 * of the squares of (x - from) times per_unit. */
typedef struct dal__tally {
    double *sum /* [DAL_PARTIAL_SUMS] */, min, max;
    double *rough, *held /* [DAL_PARTIAL_SUMS] */, per_unit;
    double *square /* [DAL_PARTIAL_SUMS] */, from;
} dal__tally;

/* A difference beyond this many units counts as this many, so that no square overflows. */
#define DAL__ROUGH_LIMIT 0x1p900
/* Values beyond this one are summed with a factor below 1. */
#define DAL__PLAIN_LIMIT 0x1p900

/* The full blocks, counted from first and from the first time; how many there are. */
int dal__statistics_blocks(const dal_statistics *statistics,
                           dal_statistics_block *block /* [DAL_STATISTICS_BLOCKS] */);

/* The deviation of the values if their steps were independent: sqrt(sum of squared steps), times
 * factor. */
double dal__roughness(const dal_statistics *statistics);

/* The 97.5 % quantile of Student's distribution. */
double dal__student(double freedom);
/* How many times fewer independent values n residues are worth, given the sums of their squares and
 * of the products of neighbours. */
double dal__inflation(double square, double product, int n);

/* The rate of least squares and its interval. */
void dal__trend_line(const dal_statistics *statistics, dal_trend *trend);
/* Half the range of x about a line of this rate, less what the line itself rises in a block. */
double dal__trend_amplitude(const dal_statistics *statistics, double rate);

/* Adds packs of DAL_PARTIAL_SUMS values each, the first value to sum 0 and the first pack at place
 * `phase` of its cycle; once per variant.  False, and the tally as it was, when a value is not
 * finite or beyond DAL__PLAIN_LIMIT. */
#define DAL__TALLY(name, variant, lanes, set)                                                      \
    bool name##_##variant(dal__tally *tally, double first, int phase, int packs,                   \
                          const double *values);
DAL__TALLY(dal__tally_packs, x1, 1, BASE)
DAL__VARIANT_LIST(DAL__TALLY, dal__tally_packs)

#endif
