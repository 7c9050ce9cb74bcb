/* statistics.h - what the statistics of a quantity and their verdict share. */
#ifndef DAL_STATISTICS_INTERNAL_H
#define DAL_STATISTICS_INTERNAL_H

#include "dalembert.h"

/* The full blocks, counted from first and from the first time; how many there are. */
int dal__blocks(const dal_statistics *statistics, dal_mean *block /* [DAL_BLOCKS] */);

/* Fills in verdict and confidence. */
void dal__classify(const dal_statistics *statistics, double scale, int aborted,
                   dal_finding *finding);

#endif
