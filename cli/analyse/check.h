/* check.h - what the parts of `dalembert check` share: the system under examination, points about
 * its start, and the lines of the report. */
#ifndef DAL_CLI_CHECK_H
#define DAL_CLI_CHECK_H

#include "run/job.h"

/* How an item of the report ends. */
#define CHECK_RESULT_LIST(X)                                                                       \
    X(OK, "ok")                                                                                    \
    X(FAIL, "FAIL")                                                                                \
    X(UNMEASURED, "not measured")                                                                  \
    X(INFO, "info")

typedef enum check_result {
#define X(code, text) CHECK_##code,
    CHECK_RESULT_LIST(X)
#undef X
} check_result;

enum { CHECK_POINTS = 8 };

typedef struct check {
    const dal_system *system;
    cli_job *job; /* with its system made: what `run` would make of the arguments */
    dal_probe *probe;
    const dal_setting *parameters;
    int parameter_count;
    double *start;                   /* [2n + multipliers + 1] q, v, g, e */
    int n, m, nw, size;              /* nw = n + multipliers, size = n + nw */
    int regular;                     /* F is finite at the start */
    dal_point origin;                /* the start, at t = 0 */
    dal_point near[CHECK_POINTS];    /* points about the start, 0 <= t < 1 */
    dal_point surface[CHECK_POINTS]; /* the same moved onto D = 0 */
    int near_count, surface_count;
    double *values; /* scratch for the values of any one callback */
    int items, failed, unmeasured;
} check;

/* The sections of the report, in its order. */
#define CHECK_SECTION_LIST(X)                                                                      \
    X(start, "start")                                                                              \
    X(constraints, "constraints")                                                                  \
    X(energy, "energy and invariants")                                                             \
    X(reversal, "reversal of the motion")                                                          \
    X(derivatives, "derivatives against differences")                                              \
    X(exact, "exact solution")                                                                     \
    X(algebra, "Dirac's algebra in 6n+2")                                                          \
    X(action, "actions")

#define X(name, title) void check_##name(check *c);
CHECK_SECTION_LIST(X)
#undef X

/* One line of the report: what is examined, the result, and what was found. */
void check_item(check *c, check_result result, const char *what, const char *format, ...)
    CLI_PRINTF(4, 5);
/* The same for a number that has been measured and must not exceed a limit. */
void check_bound(check *c, const char *what, double value, double limit);
/* The same for what could not be measured, and why: as bad as a failure. */
void check_unmeasured(check *c, const char *what, const char *format, ...) CLI_PRINTF(3, 4);
/* A line of further text under the last item. */
void check_note(const char *format, ...) CLI_PRINTF(1, 2);

/* Greatest |d/dt of a callback's values| along the motion over some points. */
typedef struct check_rate {
    double most;
    int points, measured; /* points there are, and of these those that gave a value */
    dal_status status;    /* why another gave none */
} check_rate;

/* Of value i alone unless i < 0. */
check_rate check_measure_rate(check *c, dal_callback *callback, int values, int i,
                              const dal_point *points, int count);
/* An item for it, with a bound, or for information alone. */
void check_rate_bound(check *c, const char *what, const check_rate *rate, double limit);
void check_rate_info(check *c, const char *what, const check_rate *rate);

#endif
