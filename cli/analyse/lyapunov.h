/* lyapunov.h - Lyapunov exponents of a motion, or the rate of the volume of the phase space. */
#ifndef DAL_CLI_LYAPUNOV_H
#define DAL_CLI_LYAPUNOV_H

#include "ui/options.h"

/* Makes the page of a directory after a command that ended with this exit status; returns one. */
typedef int lyapunov_page(const char *directory, int status);

/* The commands lyapunov and volume: read the arguments, print the means, write a table of the means
 * so far and its page.  Return CLI_DONE or print and return an exit status. */
int lyapunov_measure(const cli_command *command, int argc, char **argv, lyapunov_page *page);
int lyapunov_measure_volume(const cli_command *command, int argc, char **argv, lyapunov_page *page);

#endif
