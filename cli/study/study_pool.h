/* study_pool.h - the cells of a study, run. */
#ifndef DAL_CLI_STUDY_POOL_H
#define DAL_CLI_STUDY_POOL_H

#include "run/work.h"
#include "study_plan.h"

/* Runs all cells that are not of another shard.  Returns CLI_DONE, CLI_SIGNAL when it was
 * interrupted, or the exit status of the first failure of the program's own, after a message. */
int study_pool_run(study_plan *plan, work_runner *runner, int threads);

#endif
