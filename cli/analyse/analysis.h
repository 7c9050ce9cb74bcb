/* analysis.h - what the commands share that examine a system or a motion as a whole: check, order,
 * section, lyapunov, volume, explain. */
#ifndef DAL_CLI_ANALYSIS_H
#define DAL_CLI_ANALYSIS_H

#include "run/request.h"

#include <stdbool.h>
#include <stdint.h>

/* A set of options of a run. */
#define ANALYSIS_OPTION(name) (UINT64_C(1) << REQUEST_##name)
/* The options that concern rows only. */
#define ANALYSIS_ROWS                                                                              \
    (ANALYSIS_OPTION(samples) | ANALYSIS_OPTION(sampling) | ANALYSIS_OPTION(times) |               \
     ANALYSIS_OPTION(statistics))

/* A command: its own options, and those of a run except a set of them. */
typedef struct analysis_command {
    const cli_option *own;
    int own_count;
    uint64_t without;
    const char *notes;
    int (*parse)(void *user, int option, const char *value); /* one of its own */
    void (*adapt)(cli_option *options); /* changes defaults and help of those of a run, or NULL */
} analysis_command;

/* Reads all arguments.  Returns CLI_GO_ON, or the exit status after a message or help. */
int analysis_read(int argc, char **argv, const analysis_command *command, run_request *request,
                  void *user);

/* An output: a directory with NAME.csv in it, or a file. */
typedef struct analysis_output {
    const char *directory; /* NULL: a file, or stdout */
    char *table;           /* the path of the table */
} analysis_output;

/* Makes the directory.  Returns CLI_DONE or prints and returns an exit status; free the table. */
int analysis_open(analysis_output *output, const char *path, const char *name);

/* max |a_i - b_i| / max(1, |b_i|); infinite where an entry is not a number. */
double analysis_distance(const double *a, const double *b, int count);

#endif
