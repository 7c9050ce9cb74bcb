/* lyapunov.h - Lyapunov exponents of a motion, or the rate of the volume of the phase space. */
#ifndef DAL_CLI_LYAPUNOV_H
#define DAL_CLI_LYAPUNOV_H

#include "ui/options.h"

#include <stdbool.h>

/* The commands lyapunov and, with is_volume, volume: reads the arguments, prints the means, writes
 * a table of the means so far and a figure.  Returns CLI_DONE or prints and returns an exit
 * status. */
int lyapunov_command(const cli_command *command, bool is_volume, int argc, char **argv);

#endif
