/* dirac.h - Dirac's procedure for the action of a system, printed. */
#ifndef DAL_CLI_DIRAC_H
#define DAL_CLI_DIRAC_H

#include "run/simulation.h"

#include <stdbool.h>

typedef struct dirac_settings {
    run_simulation simulation;
    bool latex, json, details;
} dirac_settings;

/* Carries out the procedure and prints it stage by stage, as LaTeX or as JSON.  Returns CLI_DONE,
 * CLI_CHECK where the procedure does not end, or prints and returns an exit status. */
int dirac_analyse(const dirac_settings *settings);

#endif
