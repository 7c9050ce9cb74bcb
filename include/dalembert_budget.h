/* dalembert_budget.h - error budgets: how much each source of error does.
 *
 * The conventions of dalembert.h hold here. */
#ifndef DALEMBERT_BUDGET_H
#define DALEMBERT_BUDGET_H

#include "dalembert_statistics.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- error budgets ------------------------------------------------------------------------- */

/* How much of a drift is truncation, rounding of coefficients, the solver, rounding, projection.
 *
 * A run is compared with runs that differ from it in one thing each.  Quad precision leaves nothing
 * of the rounding of doubles, and further iterations leave nothing of the solver's error, so that
 * over the first steps, for which both are affordable,
 *
 *     x(run) = x(quad, solved further)                     truncation, or coefficients
 *            + x(solved further) - x(quad, solved further) rounding
 *            + x(run) - x(solved further)                  solver
 *
 * at every moment, and so for the rates of lines of least squares.  Coefficients of a method stay
 * doubles in quad precision; their part does not fall with the step as truncation does.  Nor does
 * truncation in steps across branches (if, abs, min, ...), a source of its own.  The effect of
 * projection is the effect of leaving it out, or of adding it; it is no part of the sum.
 *
 * A change along the exact motion is no error.  What is known to be conserved from this start has
 * none: D; E by an identity; H, |p|, |pi| and |pi_e| on p = pi = 0; invariants whose rate vanishes
 * at points about the start.  Of all else the exact motion, found by dop853 with a tolerance of
 * 1e-16 in units of the system's own, says how it changes,
 *
 *     x(quad, solved further) = x(exact motion) + error,
 *
 * and motion and error are sources beside each other; a change within roundings is none.  Without
 * that motion, what quad precision leaves counts as motion if it does not fall with the step.
 * Under a tolerance, half the step is the tolerance divided by 2^p, p being the order of the
 * method.
 *
 * A share is the size of a part, the absolute value of its rate or its max deviation, over the sum
 * of the sizes of all: between 0 and 1, and 1 in all. */

/* Comparison runs: RUN(code, word, text).  Those in quad precision cover the first quad_steps
 * steps, the others all. */
#define DAL_COMPARISON_LIST(RUN)                                                                   \
    RUN(HALVED, "half-step", "half the step")                                                      \
    RUN(LOOSER, "looser", "equations solved less far")                                             \
    RUN(TIGHTER, "tighter", "equations solved further, by two iterations")                         \
    RUN(SUMS, "sums", "plain sums, or compensated ones")                                           \
    RUN(PROJECTION, "projection", "with +project, or without")                                     \
    RUN(EXACT, "exact-motion", "the exact motion, by dop853")                                      \
    RUN(QUAD, "quad", "quad precision, solved further")                                            \
    RUN(QUAD_HALVED, "quad-half-step", "quad precision, solved further, half the step")

/* The runs that a run is compared with. */
typedef enum dal_comparison_run {
#define RUN_CODE(code, word, text) DAL_COMPARISON_##code,
    DAL_COMPARISON_LIST(RUN_CODE)
#undef RUN_CODE
        DAL_COMPARISONS
} dal_comparison_run;

/* Error sources: SOURCE(code, word). */
#define DAL_ERROR_SOURCE_LIST(SOURCE)                                                              \
    SOURCE(MOTION, "motion")         /* the exact motion changes it */                             \
    SOURCE(TRUNCATION, "truncation") /* of smooth equations: falls as the order says */            \
    SOURCE(BRANCHES, "branches")     /* truncation in steps across branches */                     \
    SOURCE(COEFFICIENTS, "coefficients")                                                           \
    SOURCE(SOLVER, "solver")                                                                       \
    SOURCE(ROUNDING, "rounding")                                                                   \
    SOURCE(PROJECTION, "projection")

/* The sources of a drift. */
typedef enum dal_error_source {
#define SOURCE_CODE(code, word) DAL_SOURCE_##code,
    DAL_ERROR_SOURCE_LIST(SOURCE_CODE)
#undef SOURCE_CODE
        DAL_ERROR_SOURCES
} dal_error_source;

const char *dal_comparison_name(dal_comparison_run comparison); /* the word, "half-step" */
const char *dal_comparison_text(dal_comparison_run comparison); /* the text, "half the step" */
const char *dal_error_source_name(dal_error_source source);     /* the word, "truncation" */

/* The behaviour of one observable, and the shares of its drift.  "Beginning": the first
 * quad_steps steps of the run. */
typedef struct dal_shares {
    char name[64];                         /* of the observable */
    dal_trend whole;                       /* along the whole run */
    dal_trend beginning;                   /* of the run, along the beginning */
    dal_trend comparison[DAL_COMPARISONS]; /* of those that ran */
    dal_trend rounding, solver;            /* the differences above, along the beginning */
    dal_trend solver_and_rounding;         /* their sum */
    dal_trend motion;                      /* of the exact motion, along the beginning */
    dal_trend error, error_halved;         /* in quad precision less the exact motion, or less the
                                              start where that conserves it; with half the step */
    bool by_rate;       /* whether the beginning is measured by rates, where the run clearly drifts,
                          or else by max deviations */
    bool whole_by_rate; /* the same for the whole run */
    bool vanishes_in_quad;      /* quad precision leaves nothing of the drift */
    bool is_conserved;          /* the exact motion from this start conserves it */
    bool is_motion;             /* the exact motion makes at least half of the change */
    bool solver_is_significant; /* whether the solver's part is well above rounding */
    double order; /* log2 of what halving the step divides the error by: in quad precision, or
                     without it along the whole run; NaN: nothing to divide */
    /* share: of the change, 0..1; the share of PROJECTION vanishes without it, or with it; NaN: not
     * known.  margin: half the 95 % interval of a share of rates; NaN: none. */
    double share[DAL_ERROR_SOURCES], margin[DAL_ERROR_SOURCES];
} dal_shares;

/* A run, the runs it was compared with, and the shares of every observable's drift. */
typedef struct dal_error_budget {
    dal_run_spec spec;         /* of the run */
    long long steps;           /* of the run */
    long long quad_steps;      /* of those also in quad precision; 0: none */
    long long exact_steps;     /* substeps of the exact motion, all along */
    bool has_projection;       /* the method projects: DAL_COMPARISON_PROJECTION does not */
    bool ran[DAL_COMPARISONS]; /* whether each ran to its end */
    char reason[DAL_COMPARISONS][DAL_MESSAGE_SIZE]; /* and if not, the reason */
    int observables;                                /* of the run */
    dal_shares *shares;                             /* [observables] */
} dal_error_budget;

/* Callbacks of dal_error_budget_create; any may be NULL. */
typedef struct dal_error_budget_observer {
    void *user; /* the first argument of every callback */
    /* Called now and then with the share of the work that is done, 0..1; any status but
     * DAL_STATUS_OK ends it. */
    dal_status (*step)(void *user, double done);
    /* Called with every new run in doubles; may replace its steps by compiled code.  The last such
     * run exists whenever step is called. */
    void (*begin)(void *user, dal_run *run, long long steps);
} dal_error_budget_observer;

/* Runs a spec for a number of steps, and the runs it is compared with, and finds the shares of
 * every observable's drift.  observer may be NULL.  A comparison that is not possible is left out,
 * with a reason.  [alloc]  Errors: as for the run itself, DAL_STATUS_ARGUMENT. */
dal_status dal_error_budget_create(dal_error_budget **budget, const dal_run_spec *spec,
                                   long long steps, long long quad_steps,
                                   const dal_error_budget_observer *observer, dal_error *error);
/* Frees a budget. */
void dal_error_budget_free(dal_error_budget *budget);

/* Says in a sentence what an observable does and by which sources, "drifts by truncation (100 %):
 * halve the step and it falls by 16", in buffer[size]; returns buffer, NULL where there is no such
 * observable. */
char *dal_error_budget_summarise(const dal_error_budget *budget, int observable, char *buffer,
                                 size_t size);
/* Describes in words how a share was found, in buffer[size]; returns buffer, NULL where there is no
 * such observable. */
char *dal_error_budget_describe(const dal_error_budget *budget, int observable,
                                dal_error_source source, char *buffer, size_t size);

#ifdef __cplusplus
}
#endif
#endif
