/* ensemble_statistics.h - what an ensemble's directory gets when all members are done.
 *
 *     DIR/statistics.csv   for each time and component of the state: count, mean, deviation, min,
 *                          quantiles, max
 *     DIR/covariance.csv   for each time a matrix, one line for each component
 *     DIR/failures.csv     the members that failed: t that was reached, the reason, what was drawn,
 *                          the message
 *     DIR/histograms.csv   how many members lie in each of equal intervals from min to max
 *     DIR/cloud.csv        the states of the first members
 *
 * All are made of final.npy, rows.npy and members.npy, in the order of members, so that they depend
 * neither on threads nor on shards nor on interruptions. */
#ifndef DAL_CLI_ENSEMBLE_STATISTICS_H
#define DAL_CLI_ENSEMBLE_STATISTICS_H

#include "ensemble_directory.h"

/* Writes all of it, prints a table of the last time, and marks the ensemble as done.  Returns
 * CLI_DONE, CLI_FAILED where no member remains at the end, or prints and returns an exit status. */
int ensemble_finish(const ensemble *e, const ensemble_directory *dir, int threads);

#endif
