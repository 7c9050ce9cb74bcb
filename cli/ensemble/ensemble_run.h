/* ensemble_run.h - the members of an ensemble, run. */
#ifndef DAL_CLI_ENSEMBLE_RUN_H
#define DAL_CLI_ENSEMBLE_RUN_H

#include "ensemble_directory.h"
#include "run/work.h"

typedef struct ensemble_run_options {
    int threads;
    double interval; /* seconds between checkpoints */
    native_mode native;
    progress_mode progress;
    work_runner *runner;
    int processes; /* that share the members */
} ensemble_run_options;

/* Runs the members of the shard that is attached.  Returns CLI_DONE, CLI_SIGNAL after an
 * interruption, or the exit status of a failure, after a message. */
int ensemble_run(ensemble *e, ensemble_directory *dir, const ensemble_run_options *options);
/* Finishes the ensemble after a run with this status, when the members of all shards are done; else
 * says what remains.  Returns CLI_FAILED where every member failed, or the exit status. */
int ensemble_end(const ensemble *e, ensemble_directory *dir, int status, int threads);
/* Continues what was begun in a directory. */
int ensemble_resume(const char *path, const ensemble_run_options *options);

#endif
