/* study_cell.h - one cell of a study: a run and its results. */
#ifndef DAL_CLI_STUDY_CELL_H
#define DAL_CLI_STUDY_CELL_H

#include "run/work.h"
#include "study_data.h"

#include <stdbool.h>
#include <stdint.h>

/* Runs a cell in its directory, resumes it there, or reads its results when it is finished.  How
 * the run ended is in the cell; its state stays STUDY_WAITING when it was stopped.  Returns
 * CLI_DONE; CLI_SIGNAL when it was stopped; or prints and returns an exit status.  Different cells
 * may be run by different threads. */
int study_cell_run(const study_plan *plan, study_cell *cell, const work_stop *stop);
/* A hash of the name of a cell, its request and its system, whose hash is given. */
uint64_t study_cell_key(const study_cell *cell, uint64_t system);
/* Whether the run of a cell can be made: a refused one has none. */
bool study_cell_is_runnable(study_cell *cell);

#endif
