/* lyapunov_results.h - Lyapunov exponents, or the rate of the volume, in words and as JSON. */
#ifndef DAL_CLI_LYAPUNOV_RESULTS_H
#define DAL_CLI_LYAPUNOV_RESULTS_H

#include "dalembert_dynamics.h"
#include "run/simulation.h"
#include "ui/screen.h"

/* The options of a run that the commands do not take. */
#define LYAPUNOV_WITHOUT (REQUEST_ROW_OPTIONS | REQUEST_OPTION(steps))

typedef struct lyapunov_results {
    bool is_volume;
    const run_simulation *simulation;
    const dal_lyapunov *spectrum;
    double transient, begin; /* begin: t at the beginning of the means */
    int status;              /* of the run */
    /* The sum of the exponents against the divergence; the reason is "" where they are compared. */
    dal_balance balance;
    const char *reason;
} lyapunov_results;

/* All of them, as text or as JSON, to standard output. */
void lyapunov_print(const lyapunov_results *r);
void lyapunov_put(const lyapunov_results *r);
/* Prints the result and the largest exponents on a terminal.  Returns CLI_DONE, or prints and
 * returns CLI_IO. */
int lyapunov_print_screen(const lyapunov_results *r, screen_format format);

#endif
