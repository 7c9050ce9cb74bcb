/* steer_data.h - what is searched between two states, and what came out. */
#ifndef DAL_CLI_STEER_DATA_H
#define DAL_CLI_STEER_DATA_H

#include "dalembert_steer.h"
#include "run/simulation.h"
#include "ui/screen.h"

/* The options of a run that it does not take: the state is the lift's, in double precision. */
#define STEER_WITHOUT                                                                              \
    ((REQUEST_ROW_OPTIONS & ~REQUEST_OPTION(samples)) | REQUEST_OPTION(space) |                    \
     REQUEST_OPTION(tolerance) | REQUEST_OPTION(precision))

typedef struct steer_settings {
    run_simulation simulation;
    request_settings target;
    const char *free_starts; /* names between commas; NULL: none */
    const char *output;      /* a directory, or NULL */
    bool rest, aim, json, force;
    long long starts, seed, iterations;
    screen_format format;
} steer_settings;

/* What came out; borrowed. */
typedef struct steer_results {
    const steer_settings *set;
    const dal_steering *steering;
    int status; /* of the search */
} steer_results;

#endif
