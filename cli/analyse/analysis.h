/* analysis.h - what the commands share that look at a motion as a whole: order, section, lyapunov,
 * volume. */
#ifndef DAL_CLI_ANALYSIS_H
#define DAL_CLI_ANALYSIS_H

#include "io/table.h"
#include "run/job.h"

/* A command: options of its own, and those of a run that it has a use for. */
typedef struct analysis_command {
    const cli_option *own;
    int own_count;
    const int *without; /* options of a run, JOB_x, it does not take, beside those of rows */
    int without_count;
    const char *notes;
    /* Takes option k of its own. */
    int (*take)(void *user, int k, const char *value);
    void (*set_defaults)(cli_option *options); /* of a job where they differ; NULL: nowhere */
} analysis_command;

/* Reads all arguments.  Returns CLI_GO_ON, or the exit status: a message or help was printed. */
int analysis_read(int argc, char **argv, const analysis_command *command, cli_job *job, void *user);

/* Where an output goes: a directory with NAME.csv in it, or a file. */
typedef struct analysis_place {
    const char *directory; /* NULL: a file, or stdout */
    char *table;           /* the path of the table */
} analysis_place;

/* Makes the directory.  Returns CLI_DONE or prints and returns an exit status; free the table. */
int analysis_open(analysis_place *place, const char *output, const char *name);

#endif
