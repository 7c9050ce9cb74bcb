/* explain.h - the error sources of the drift of a run. */
#ifndef DAL_CLI_EXPLAIN_H
#define DAL_CLI_EXPLAIN_H

#include "run/native.h"
#include "run/simulation.h"
#include "ui/screen.h"

enum { EXPLAIN_MAX_STEPS = 2000000000 };

/* The options of a run that it does not take: comparison runs differ in precision themselves. */
#define EXPLAIN_WITHOUT (REQUEST_ROW_OPTIONS | REQUEST_OPTION(steps) | REQUEST_OPTION(precision))

typedef struct explain_settings {
    run_simulation simulation;
    long long quad_steps;
    const char *output; /* of CSV; NULL: sentences to stdout */
    native_mode native;
    bool details; /* prints the runs that were compared, too */
    bool json;    /* to stdout, instead of sentences */
    screen_format format;
    struct dal_prediction *predicted; /* found by explain_run; NULL: it cannot be */
} explain_settings;

/* Returns CLI_DONE or prints and returns an exit status. */
int explain_run(explain_settings *settings);

#endif
