/* dalembert_causes.h - what a drift comes from: truncation, coefficients, solver, rounding,
 * projection; a part of dalembert.h, never included by itself.
 *
 * A run is compared with twins that differ from it in one thing each.  In long numbers (the option
 * precision) nothing is left of the rounding of doubles, and with further sweeps nothing of what
 * the solver left, so that over the first steps, which both can afford,
 *
 *     x(run) = x(long, solved further)                     truncation, or coefficients
 *            + x(solved further) - x(long, solved further) rounding
 *            + x(run) - x(solved further)                  solver
 *
 * at every moment, and so for the rates of lines of least squares: these shares add up to 1.
 * Coefficients of a method, as doubles, stay what they are in long numbers; their part does not
 * fall with the step as truncation does.  What projection does is seen by a twin without it, or
 * with it, and stands beside the others. */
#ifndef DALEMBERT_CAUSES_H
#define DALEMBERT_CAUSES_H

/* code, word, what it is.  All of the run's steps but for those in long numbers. */
#define DAL_TWIN_LIST(X)                                                                           \
    X(HALVED, "half-step", "half the step")                                                        \
    X(LOOSER, "looser", "equations solved less far")                                               \
    X(TIGHTER, "tighter", "equations solved further, by two sweeps")                               \
    X(SUMS, "sums", "plain sums, or compensated ones")                                             \
    X(PROJECTION, "projection", "with +project, or without")                                       \
    X(LONG, "long", "long numbers, solved further")                                                \
    X(LONG_HALVED, "long-half-step", "long numbers, solved further, half the step")

typedef enum dal_twin {
#define X(code, word, text) DAL_TWIN_##code,
    DAL_TWIN_LIST(X)
#undef X
        DAL_TWINS
} dal_twin;

/* code, word */
#define DAL_CAUSE_LIST(X)                                                                          \
    X(TRUNCATION, "truncation")                                                                    \
    X(COEFFICIENTS, "coefficients")                                                                \
    X(SOLVER, "solver")                                                                            \
    X(ROUNDING, "rounding")                                                                        \
    X(PROJECTION, "projection")

typedef enum dal_cause {
#define X(code, word) DAL_CAUSE_##code,
    DAL_CAUSE_LIST(X)
#undef X
        DAL_CAUSES
} dal_cause;

const char *dal_twin_name(dal_twin twin); /* "half-step" */
const char *dal_twin_text(dal_twin twin); /* "half the step" */
const char *dal_cause_name(dal_cause cause);

/* What one observable does, and why. */
typedef struct dal_attribution {
    char name[64];
    dal_trend all;             /* along the whole run */
    dal_trend early;           /* along those steps of it that long numbers were spent on */
    dal_trend twin[DAL_TWINS]; /* where twins ran */
    dal_trend rounding;        /* early: solved further, less the same in long numbers */
    dal_trend solver;          /* early: the run, less solved further */
    dal_trend both;            /* early: the run, less long numbers solved further */
    int by_rate;      /* what is compared early: rates (where the run clearly drifts), else greatest
                         deviations */
    int all_by_rate;  /* the same for the whole run */
    int is_nothing;   /* of what it does early long numbers leave nothing */
    int is_motion;    /* what they leave does not fall with the step: the motion itself */
    int solver_tells; /* whether the solver's part stands out from roundings */
    double order;     /* log2 of what halving the step divides the drift by: in long numbers, or
                         without them along the whole run; NaN: nothing to divide */
    double share[DAL_CAUSES]; /* of the drift; of PROJECTION: what goes without it, or with it; NaN:
                                 cannot be told */
    double margin[DAL_CAUSES]; /* half the 95 % interval of a share of rates; NaN: none */
} dal_attribution;

typedef struct dal_explanation {
    dal_run_spec spec;
    long long steps, early; /* of the run; of those also in long numbers, 0: none */
    int projects;           /* the method has a projection: its twin has none */
    int ran[DAL_TWINS];     /* whether each twin ran to its end, and if not, why */
    char why[DAL_TWINS][DAL_MESSAGE_SIZE];
    int observables;
    dal_attribution *of; /* [observables] */
} dal_explanation;

/* Looks on, and may help: any may be NULL.  step is called now and then with the share of the work
 * that is done; any status but DAL_OK ends it.  begin is called with every new run in doubles, and
 * may make it faster. */
typedef struct dal_explain_observer {
    void *user;
    dal_status (*step)(void *user, double done);
    void (*begin)(void *user, dal_run *run, long long steps);
} dal_explain_observer;

/* Runs a spec for so many steps, its twins beside it, the first early steps in long numbers too,
 * and finds what every observable's drift comes from.  observer may be NULL.  A twin that cannot be
 * had is left out; its reason is kept.  [alloc]  Errors: those of the run itself, DAL_ARGUMENT,
 * DAL_MEMORY. */
dal_status dal_explain(const dal_run_spec *spec, long long steps, long long early,
                       const dal_explain_observer *observer, dal_explanation **explanation,
                       dal_error *error);
void dal_explanation_free(dal_explanation *explanation);

/* How a share was found, in words; returns buffer, NULL where there is no such observable. */
char *dal_cause_words(const dal_explanation *explanation, int observable, dal_cause cause,
                      char *buffer, size_t size);

#endif
