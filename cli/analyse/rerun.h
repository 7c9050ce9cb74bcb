/* rerun.h - the request of a run's directory, for a command that runs it again. */
#ifndef DAL_CLI_RERUN_H
#define DAL_CLI_RERUN_H

#include "run/simulation.h"

/* simulation_options for a command whose SYSTEM may be the directory of a run: that gives the
 * system and the options that were not given, except without, and a line says which.  A command
 * without --steps, or with another step, gets the end of the run as --time. */
cli_option_set rerun_options(run_simulation *simulation, const cli_option *options,
                             uint64_t without);

#endif
