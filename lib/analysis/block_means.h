/* block_means.h - lines through the means of blocks, where there are too few for evidence. */
#ifndef DAL_BLOCK_MEANS_H
#define DAL_BLOCK_MEANS_H

#include "dalembert_analysis.h"

/* The 97.5 % quantile of Student's distribution. */
double dal__student(double freedom);
/* How many times fewer independent values n residues are worth, given the sum of their squares and
 * that of the products of neighbours. */
double dal__inflation(double square, double product, int n);

/* The rate of least squares and its interval. */
void dal__trend_line(const dal_statistics *statistics, dal_trend *trend);
/* Half the range of x about a line of this rate, less what the line itself rises in a block. */
double dal__trend_amplitude(const dal_statistics *statistics, double rate);

#endif
