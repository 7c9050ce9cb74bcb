/* dalembert_causes.h - the error budget of a run: how much of a drift is truncation, rounding of
 * coefficients, the solver, rounding, projection; a part of dalembert.h, never included by itself.
 *
 * A run is compared with runs that differ from it in one thing each.  Quad precision leaves nothing
 * of the rounding of doubles, and further iterations leave nothing of the solver's error, so that
 * over the first steps, for which both are affordable,
 *
 *     x(run) = x(quad, solved further)                     truncation, or coefficients
 *            + x(solved further) - x(quad, solved further) rounding
 *            + x(run) - x(solved further)                  solver
 *
 * at every moment, and so for the rates of lines of least squares: these shares add up to 1.
 * Coefficients of a method stay doubles in quad precision; their part does not fall with the step
 * as truncation does.  The effect of projection is that of leaving it out, or of adding it; it is
 * no part of the sum. */
#ifndef DALEMBERT_CAUSES_H
#define DALEMBERT_CAUSES_H

/* code, word, text.  Runs in quad precision cover the first quad_steps steps, the others all. */
#define DAL_COMPARISON_LIST(RUN)                                                                   \
    RUN(HALVED, "half-step", "half the step")                                                      \
    RUN(LOOSER, "looser", "equations solved less far")                                             \
    RUN(TIGHTER, "tighter", "equations solved further, by two iterations")                         \
    RUN(SUMS, "sums", "plain sums, or compensated ones")                                           \
    RUN(PROJECTION, "projection", "with +project, or without")                                     \
    RUN(QUAD, "quad", "quad precision, solved further")                                            \
    RUN(QUAD_HALVED, "quad-half-step", "quad precision, solved further, half the step")

typedef enum dal_comparison_run {
#define RUN_CODE(code, word, text) DAL_COMPARISON_##code,
    DAL_COMPARISON_LIST(RUN_CODE)
#undef RUN_CODE
        DAL_COMPARISONS
} dal_comparison_run;

/* code, word */
#define DAL_ERROR_SOURCE_LIST(SOURCE)                                                              \
    SOURCE(TRUNCATION, "truncation")                                                               \
    SOURCE(COEFFICIENTS, "coefficients")                                                           \
    SOURCE(SOLVER, "solver")                                                                       \
    SOURCE(ROUNDING, "rounding")                                                                   \
    SOURCE(PROJECTION, "projection")

typedef enum dal_error_source {
#define SOURCE_CODE(code, word) DAL_SOURCE_##code,
    DAL_ERROR_SOURCE_LIST(SOURCE_CODE)
#undef SOURCE_CODE
        DAL_ERROR_SOURCES
} dal_error_source;

const char *dal_comparison_name(dal_comparison_run comparison); /* "half-step" */
const char *dal_comparison_text(dal_comparison_run comparison); /* "half the step" */
const char *dal_error_source_name(dal_error_source source);

/* The behaviour of one observable, and the shares of its drift.  "Beginning": the first
 * quad_steps steps of the run. */
typedef struct dal_shares {
    char name[64];
    dal_trend whole;                       /* along the whole run */
    dal_trend beginning;                   /* of the run, along the beginning */
    dal_trend comparison[DAL_COMPARISONS]; /* of those that ran */
    dal_trend rounding, solver;            /* the differences above, along the beginning */
    dal_trend solver_and_rounding;         /* their sum */
    int by_rate;       /* whether the beginning is measured by rates, where the run clearly drifts,
                          or else by max deviations */
    int whole_by_rate; /* the same for the whole run */
    int vanishes_in_quad;      /* quad precision leaves nothing of the drift */
    int is_motion;             /* what it leaves does not fall with the step: the motion itself */
    int solver_is_significant; /* whether the solver's part stands out from rounding */
    double order; /* log2 of what halving the step divides the drift by: in quad precision, or
                     without it along the whole run; NaN: nothing to divide */
    /* share: of the drift; that of PROJECTION goes without it, or with it; NaN: not known.
     * margin: half the 95 % interval of a share of rates; NaN: none. */
    double share[DAL_ERROR_SOURCES], margin[DAL_ERROR_SOURCES];
} dal_shares;

typedef struct dal_error_budget {
    dal_run_spec spec;
    long long steps, quad_steps; /* of the run; of those also in quad precision, 0: none */
    int has_projection;          /* the method projects: DAL_COMPARISON_PROJECTION does not */
    int ran[DAL_COMPARISONS];    /* whether each ran to its end, and if not, the reason */
    char reason[DAL_COMPARISONS][DAL_MESSAGE_SIZE];
    int observables;
    dal_shares *shares; /* [observables] */
} dal_error_budget;

/* Any member may be NULL.  step is called now and then with the share of the work that is done; any
 * status but DAL_OK ends it.  begin is called with every new run in doubles, and may replace its
 * steps by compiled code. */
typedef struct dal_error_budget_observer {
    void *user;
    dal_status (*step)(void *user, double done);
    void (*begin)(void *user, dal_run *run, long long steps);
} dal_error_budget_observer;

/* Runs a spec for so many steps, and the runs it is compared with, and finds the shares of every
 * observable's drift.  observer may be NULL.  A comparison that is not possible is left out with a
 * reason.  [alloc]  Errors: those of the run itself, DAL_ARGUMENT, DAL_MEMORY. */
dal_status dal_error_budget_create(const dal_run_spec *spec, long long steps, long long quad_steps,
                                   const dal_error_budget_observer *observer,
                                   dal_error_budget **budget, dal_error *error);
void dal_error_budget_free(dal_error_budget *budget);

/* Describes in words how a share was found; returns buffer, NULL where there is no such observable.
 */
char *dal_error_budget_describe(const dal_error_budget *budget, int observable,
                                dal_error_source source, char *buffer, size_t size);

#endif
