/* check.h - examines a system before a run. */
#ifndef DAL_CLI_CHECK_H
#define DAL_CLI_CHECK_H

#include "run/simulation.h"

#include <stdbool.h>

typedef struct check_settings {
    run_simulation simulation;
    bool json, details, latex, mathml;
} check_settings;

/* Prints the report, as text or as JSON, or the equations as LaTeX or MathML.  Returns CLI_DONE,
 * CLI_CHECK where an item failed or was not measured, or prints and returns an exit status. */
int check_system(check_settings *settings);

#endif
