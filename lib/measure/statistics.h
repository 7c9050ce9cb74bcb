/* statistics.h - what the statistics of a quantity and their verdict share. */
#ifndef DAL_STATISTICS_INTERNAL_H
#define DAL_STATISTICS_INTERNAL_H

#include "dalembert.h"

/* The full blocks, counted from first and from the first time; how many there are. */
int dal__blocks(const dal_statistics *statistics, dal_mean *block /* [DAL_BLOCKS] */);

/* The 97.5 % quantile of Student's distribution; and by how much n residues of correlated blocks,
 * with the sums of their squares and of the products of neighbours, are worth fewer than n. */
double dal__student(double freedom);
double dal__inflation(double square, double product, int n);

/* Fills in verdict and confidence. */
void dal__classify(const dal_statistics *statistics, double scale, int aborted,
                   dal_finding *finding);

#endif
