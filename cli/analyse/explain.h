/* explain.h - the error sources of the drift of a run. */
#ifndef DAL_CLI_EXPLAIN_H
#define DAL_CLI_EXPLAIN_H

#include "run/native.h"
#include "run/request.h"

enum { EXPLAIN_MAX_STEPS = 2000000000 };

typedef struct explain_settings {
    run_request request;
    long long quad_steps;
    const char *output; /* of CSV; NULL: sentences to stdout */
    native_mode native;
} explain_settings;

/* Returns CLI_DONE or prints and returns an exit status. */
int explain_run(explain_settings *settings);

#endif
