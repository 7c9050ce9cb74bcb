/* lyapunov.h - Lyapunov exponents of a motion, or the rate of the volume of the phase space. */
#ifndef DAL_CLI_LYAPUNOV_H
#define DAL_CLI_LYAPUNOV_H

#include "run/request.h"

#include <stdbool.h>

typedef struct lyapunov_settings {
    bool is_volume;
    run_request request;
    const char *output;
    double transient;
    long long rows, exponents; /* exponents: 0 for all */
} lyapunov_settings;

/* The options that both commands take. */
cli_group lyapunov_group(lyapunov_settings *settings);
/* Prints the means, writes a table of the means so far and a figure.  Returns CLI_DONE or prints
 * and returns an exit status. */
int lyapunov_measure(lyapunov_settings *settings);

#endif
