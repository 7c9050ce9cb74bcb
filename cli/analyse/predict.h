/* predict.h - the drift of D, E and invariants by several methods, predicted before a run. */
#ifndef DAL_CLI_PREDICT_H
#define DAL_CLI_PREDICT_H

#include "run/simulation.h"
#include "ui/screen.h"

/* The options of a run that it does not take. */
#define PREDICT_WITHOUT                                                                            \
    ((REQUEST_ROW_OPTIONS & ~REQUEST_OPTION(observe)) | REQUEST_OPTION(steps) |                    \
     REQUEST_OPTION(space) | REQUEST_OPTION(effort) | REQUEST_OPTION(gauge))

typedef struct predict_settings {
    run_simulation simulation;       /* whose options it has lists of, */
    const char *integrators, *steps; /* as they were given; NULL: there is one */
    long long pieces, samples, quad_steps;
    const char *output;
    bool json, details;
    screen_format format;
} predict_settings;

/* Prints a screen or JSON, writes CSV.  Returns CLI_DONE or prints and returns an exit status. */
int predict_run(predict_settings *settings);

#endif
