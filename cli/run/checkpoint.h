/* checkpoint.h - the state of a run in a file. */
#ifndef DAL_CLI_CHECKPOINT_H
#define DAL_CLI_CHECKPOINT_H

#include "dalembert_statistics.h"
#include "run_directory.h"

#include <stdbool.h>

/* Both return CLI_DONE, or print and return CLI_USAGE or CLI_IO. */

/* Writes the checkpoint of a run whose observables have statistics[count]. */
int checkpoint_save(const run_directory *dir, const run_position *position, const dal_run *run,
                    const dal_statistics *statistics, int count);
/* Reads it into run and statistics; where it is damaged, or the rows are not those it was written
 * with, reads the checkpoint before it.  Without either *position is the start. */
int checkpoint_load(const run_directory *dir, const trajectory_writer *writer,
                    run_position *position, dal_run *run, dal_statistics *statistics, int count);
/* Reads the statistics of a run alone; *found is false, which is no error, where there is no
 * checkpoint of this version that has count of them. */
int checkpoint_read_statistics(const run_directory *dir, dal_statistics *statistics, int count,
                               bool *found);

#endif
