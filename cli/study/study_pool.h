/* study_pool.h - the cells of a study on several threads. */
#ifndef DAL_CLI_STUDY_POOL_H
#define DAL_CLI_STUDY_POOL_H

#include "study_plan.h"

/* The numbers of the cells by falling cost, so that none is left for the end; allocated. */
int *study_sort_cells(const study_plan *plan);
/* Runs all cells that are not of another shard.  Returns CLI_DONE, CLI_SIGNAL when it was
 * interrupted, or the exit status of the first failure of the program's own, after a message. */
int study_pool_run(study_plan *plan, int threads);

#endif
