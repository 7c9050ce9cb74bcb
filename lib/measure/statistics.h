/* statistics.h - what the statistics of a quantity and their verdict share. */
#ifndef DAL_STATISTICS_INTERNAL_H
#define DAL_STATISTICS_INTERNAL_H

#include "dalembert.h"
#include "machine.h"

/* Of the open block: the parts of the sum of x - first, and the range of x. */
typedef struct dal__tally {
    double *sum /* [DAL_PARTS] */, least, most;
} dal__tally;

/* Adds packs of DAL_PARTS values each, the first of them at part 0; once per variant.  False, and
 * the tally as it was, when a value or a sum is not finite. */
#define DAL__TALLY(name, variant, lanes, set, group)                                               \
    bool name##_##variant(dal__tally *tally, double first, int packs, const double *values);
DAL__TALLY(dal__tally_packs, x1, 1, BASE, x1)
DAL__VARIANT_LIST(DAL__TALLY, dal__tally_packs)

/* The full blocks, counted from first and from the first time; how many there are. */
int dal__blocks(const dal_statistics *statistics, dal_mean *block /* [DAL_BLOCKS] */);

/* The 97.5 % quantile of Student's distribution; and by how much n residues of correlated blocks,
 * with the sums of their squares and of the products of neighbours, are worth fewer than n. */
double dal__student(double freedom);
double dal__inflation(double square, double product, int n);

/* The sum of x - first in the open block. */
double dal__open_sum(const dal_statistics *statistics);

/* Fills in size, trend and confidence. */
void dal__classify(const dal_statistics *statistics, double scale, int aborted, dal_trend *trend);

#endif
