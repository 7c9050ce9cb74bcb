/* simulation.h - the system, the run and the rows of a request. */
#ifndef DAL_CLI_SIMULATION_H
#define DAL_CLI_SIMULATION_H

#include "request.h"

/* Of an empty request; release it with simulation_free. */
run_simulation simulation_default(void);
void simulation_free(run_simulation *simulation);
/* The options of its request as a set for a command, which may change their defaults and help in
 * options, and does not take some.  A command that has read its arguments has loaded the system. */
cli_option_set simulation_options(run_simulation *simulation, const cli_option *options,
                                  uint64_t without);

/* The system, parameters and start of a simulation whose system is loaded, without a
 * method. */
dal_run_spec simulation_spec(const run_simulation *simulation);

/* All below return CLI_DONE, or print and return an exit status. */

/* Chooses the space and makes the spec of the run; where the system is not loaded yet, loads it and
 * adds the modifier that holonomic constraints need. */
int simulation_make_spec(run_simulation *simulation, dal_run_spec *spec);
/* After the last option: checks that none is missing, chooses a step that need not be given, and
 * makes the spec; and the run as well. */
int simulation_complete(run_simulation *simulation, dal_run_spec *spec);
int simulation_create(run_simulation *simulation);

#endif
