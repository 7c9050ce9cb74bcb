/* run.h - what `dalembert run` and `dalembert resume` share. */
#ifndef DAL_CLI_RUN_H
#define DAL_CLI_RUN_H

#include "native.h"
#include "recorder.h"
#include "request.h"
#include "run_directory.h"
#include "ui/cli.h"

/* The options of a run that do not concern the trajectory; they come behind those of the request.
 * name, value, default, help */
#define RUN_OPTION_LIST(X)                                                                         \
    X(output, "FILE|DIR|-", "-", "write there: .csv, .npy, a directory, or stdout")                \
    X(checkpoint, "SECONDS", "5", "a directory can be resumed from at most so long ago")           \
    X(summary, NULL, NULL, "print the summary though stderr is no terminal")                       \
    X(progress, "auto|json|off", "auto", "a line on a terminal, lines of JSON on stderr, or none") \
    X(native, "auto|on|off", "auto", "compile the steps, which changes no bit: when it pays")      \
    X(force, NULL, NULL, "write over what the directory holds of another run")

enum {
    RUN_FIRST = REQUEST_OPTIONS - 1,
#define X(name, value, initial, help) RUN_##name,
    RUN_OPTION_LIST(X)
#undef X
        RUN_OPTIONS,
    RUN_OWN = RUN_OPTIONS - REQUEST_OPTIONS
};

extern const cli_option run_options[RUN_OWN];

/* What concerns the output alone. */
typedef struct run_settings {
    const char *output;
    double interval;
    int summary, force;
    native_mode native;
    cli_progress_kind progress;
} run_settings;

/* What holds when nothing is said. */
run_settings run_settings_default(void);
/* Takes one of these options, or the value of --checkpoint.  Returns CLI_DONE or prints and returns
 * an exit status. */
int run_parse_setting(run_settings *settings, int option, const char *text);
int run_parse_interval(const char *text, double *interval);
/* The integration itself, the request being made and the directory, if there is one, described. */
int run_integrate(const run_request *request, run_directory *dir, const run_settings *settings);

#endif
