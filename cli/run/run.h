/* run.h - the integration of one run, as `dalembert run` and `dalembert resume` do it. */
#ifndef DAL_CLI_RUN_H
#define DAL_CLI_RUN_H

#include "native.h"
#include "recorder.h"
#include "request.h"
#include "run_directory.h"

/* The options of a run that do not concern the trajectory; they come behind those of the request.
 * name, value, default, help */
#define RUN_OPTION_LIST(OPTION)                                                                    \
    OPTION(output, "FILE|DIR|-", "-", "write there: .csv, .npy, a directory, or stdout")           \
    OPTION(checkpoint, "SECONDS", "5", "seconds between checkpoints of a directory")               \
    OPTION(summary, NULL, NULL, "print the summary though stderr is no terminal")                  \
    OPTION(progress, "auto|json|off", "auto",                                                      \
           "a line on a terminal, lines of JSON on stderr, or none")                               \
    OPTION(native, "auto|on|off", "auto", "compile the steps, which changes no bit: when it pays") \
    OPTION(force, NULL, NULL, "write over the run that the directory holds")

enum {
    RUN_FIRST = REQUEST_OPTIONS - 1,
#define RUN_OPTION(name, value, initial, help) RUN_##name,
    RUN_OPTION_LIST(RUN_OPTION)
#undef RUN_OPTION
        RUN_OPTIONS,
    RUN_OWN = RUN_OPTIONS - REQUEST_OPTIONS
};

extern const cli_option run_options[RUN_OWN];

/* Where and how the results of a run are written. */
typedef struct run_settings {
    const char *output;
    double interval; /* seconds between checkpoints */
    int summary, force;
    native_mode native;
    progress_mode progress;
} run_settings;

run_settings run_settings_default(void);
/* Parse one of these options, or the value of --checkpoint.  Return CLI_DONE, or print and return
 * CLI_USAGE. */
int run_parse_setting(run_settings *settings, int option, const char *text);
int run_parse_interval(const char *text, double *interval);
/* Integrates the run of a request, in its directory unless dir is NULL; returns the exit status. */
int run_integrate(const run_request *request, run_directory *dir, const run_settings *settings);

#endif
