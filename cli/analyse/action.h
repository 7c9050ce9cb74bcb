/* action.h - the actions of the theory on a curve in a file. */
#ifndef DAL_CLI_ACTION_H
#define DAL_CLI_ACTION_H

#include "run/simulation.h"

#include <stdbool.h>

/* The options of a run that the command takes. */
#define ACTION_OPTIONS                                                                             \
    (REQUEST_OPTION(set) | REQUEST_OPTION(mechanics) | REQUEST_OPTION(effort) |                    \
     REQUEST_OPTION(gauge) | REQUEST_OPTION(system))

typedef struct action_settings {
    run_simulation simulation;
    const char *curve;   /* path of a CSV file */
    const char *methods; /* names with commas between them, of discrete actions */
    double perturb;      /* the size of a bump on every coordinate; 0: none */
    bool json, details;
} action_settings;

/* Evaluates the actions and prints them, as text or JSON.  Returns CLI_DONE, or prints and returns
 * an exit status. */
int action_evaluate(action_settings *settings);

#endif
