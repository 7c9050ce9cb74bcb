/* checkpoint.h - the state of a run in a file. */
#ifndef DAL_CLI_CHECKPOINT_H
#define DAL_CLI_CHECKPOINT_H

#include "dalembert_sensitivity.h"
#include "dalembert_statistics.h"
#include "io/step_record.h"
#include "run_directory.h"

#include <stdbool.h>

/* What was observed of the steps of a run. */
typedef struct observed_steps {
    dal_statistics *statistics; /* [count] of the observables */
    int count;
    step_record *record;          /* what is kept of the steps themselves, allocated or not */
    dal_sensitivity *sensitivity; /* what goes beside the run; NULL: nothing */
} observed_steps;

/* All return CLI_DONE, or print and return CLI_USAGE or CLI_IO. */

/* Writes the checkpoint of a run. */
int checkpoint_save(const run_directory *dir, const run_position *position, const dal_run *run,
                    const observed_steps *observed);
/* Reads it into run, statistics and record; where it is damaged, or the rows are not those it was
 * written with, reads the checkpoint before it.  Without either *position is the start.  A record
 * that the checkpoint does not have is freed. */
int checkpoint_load(const run_directory *dir, const trajectory_writer *writer,
                    run_position *position, dal_run *run, const observed_steps *observed);
/* Reads what was observed alone; *found is false, which is no error, where there is no checkpoint
 * of this version that has count statistics.  The record is allocated where there is one. */
int checkpoint_read_observed(const run_directory *dir, const observed_steps *observed, bool *found);

#endif
