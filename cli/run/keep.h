/* keep.h - a run in a directory of its own, begun or gone on with, for commands that make many. */
#ifndef DAL_CLI_KEEP_H
#define DAL_CLI_KEEP_H

#include "dalembert.h"
#include "recorder.h"

typedef struct cli_keep {
    run_directory dir;
    run_recorder recorder;
} cli_keep;

/* Makes the directory and describes the run in it, or, where this run is there already, stands
 * where its checkpoint says.  Nothing is printed but failures of files and input; with different
 * directories it may be done in several threads.  Nothing waits for the disk until the run is
 * longer than a checkpoint's interval: what a power cut takes of a shorter one is done anew.
 * Returns CLI_DONE, CLI_USAGE (another run or another process is there, or what is there is
 * damaged) or CLI_IO; keep_close it in any case. */
int keep_open(cli_keep *keep, const run_request *request, const char *directory);
/* As recorder_run; not when it is finished. */
int keep_go(cli_keep *keep, dal_error *error);
int keep_is_finished(const cli_keep *keep);
void keep_close(cli_keep *keep);

#endif
