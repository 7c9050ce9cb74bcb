/* run.h - the integration of one run, as `dalembert run` and `dalembert resume` do it. */
#ifndef DAL_CLI_RUN_H
#define DAL_CLI_RUN_H

#include "native.h"
#include "recorder.h"
#include "request_data.h"
#include "run_directory.h"
#include "ui/options.h"
#include "ui/screen.h"

/* The options of a run that do not concern the trajectory. */
#define RUN_OPTION_LIST(OPTION)                                                                    \
    OPTION(output)                                                                                 \
    OPTION(events)                                                                                 \
    OPTION(checkpoint)                                                                             \
    OPTION(summary) OPTION(details) OPTION(format) OPTION(progress) OPTION(native) OPTION(force)

enum {
#define NUMBER(name) RUN_##name,
    RUN_OPTION_LIST(NUMBER)
#undef NUMBER
        RUN_OPTIONS
};

typedef struct run_settings {
    const char *output, *events; /* events: a file, or NULL */
    double interval;             /* between checkpoints, in seconds */
    bool summary, details, force;
    bool has_no_screen;   /* a terminal gets what the command prints of the run by itself */
    screen_format format; /* of the summary, on standard output; text: on a terminal */
    native_mode native;
    progress_mode progress;
    const char *text[RUN_OPTIONS]; /* as given; NULL: not given */
} run_settings;

/* As a set for a command, which does not take some: a set of RUN_OPTION(name). */
#define RUN_OPTION(name) (UINT64_C(1) << RUN_##name)
cli_option_set run_option_set(run_settings *settings, uint64_t without);
/* Integrates a run, in its directory unless dir is NULL; returns the exit status. */
int run_integrate(const run_simulation *simulation, run_directory *dir,
                  const run_settings *settings);
/* Whether nothing is in a directory that a new run would overwrite, or that is not of a run.
 * Returns CLI_DONE, or prints and returns CLI_USAGE. */
int run_check_directory(const char *path);
/* Integrates a new run in the directory settings->output; returns the exit status. */
int run_in_directory(const run_simulation *simulation, const run_settings *settings);

#endif
