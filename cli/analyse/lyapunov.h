/* lyapunov.h - Lyapunov exponents of a motion, or the rate of the volume of the phase space. */
#ifndef DAL_CLI_LYAPUNOV_H
#define DAL_CLI_LYAPUNOV_H

#include "ui/options.h"

/* The commands lyapunov and volume: read the arguments, print the means, write a table of the means
 * so far and a figure.  Return CLI_DONE or print and return an exit status. */
int lyapunov_measure(const cli_command *command, int argc, char **argv);
int lyapunov_measure_volume(const cli_command *command, int argc, char **argv);

#endif
