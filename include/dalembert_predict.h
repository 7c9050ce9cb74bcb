/* dalembert_predict.h - the drift of D, E and invariants, predicted before a run.
 *
 * The conventions of dalembert.h hold here. */
#ifndef DALEMBERT_PREDICT_H
#define DALEMBERT_PREDICT_H

#include "dalembert_run.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Let x(t) be the exact motion on D = 0, x_k = x(kh) and S_h the step of a method.  Single steps
 * begun on the exact motion change D and an invariant I by
 *
 *     d_k = D(S_h(x_k)),   c_k = I(S_h(x_k)) - I(x_k),
 *
 * and a run, to first order in what it leaves of D = 0, by sums of these:
 *
 *     D_(k+1) = D_k + d_k,   I_(k+1) = I_k + c_k + D_k . (integral of lambda over the step),
 *
 * with dI/dt = lambda.D + O(D^2) along F off D = 0.  All powers of h below 2p come at once, at the
 * step of the run; what is left out is of second order in the defect. */

/* Where a predicted curve ends, and why: END(code, word, text). */
#define DAL_PREDICTION_END_LIST(END)                                                               \
    END(TIME, "time", "the end of the run")                                                        \
    END(DEFECT, "defect", "there D may have moved the motion too far from D = 0")                  \
    END(FAILED, "failed", "there a step or the exact motion fails")                                \
    END(INTERRUPTED, "interrupted", "interrupted")
/* Why a predicted curve ends. */
typedef enum dal_prediction_end {
#define CODE(code, word, text) DAL_PREDICTION_##code,
    DAL_PREDICTION_END_LIST(CODE)
#undef CODE
} dal_prediction_end;
/* The word of an end, "defect"; "?" of a number that is none. */
const char *dal_prediction_end_name(dal_prediction_end end);
/* Its text, "the end of the run"; "?" likewise. */
const char *dal_prediction_end_text(dal_prediction_end end);

/* The exact motion from a start, which predictions by several methods and steps share. */
typedef struct dal_exact_motion dal_exact_motion;

/* How a drift is predicted: dal_predict_settings_default has the values. */
typedef struct dal_predict_settings {
    long long pieces;     /* pieces of that length of the exact motion, one after the other, for the
                         random walk of chaotic motion; 500 say its s^2 to 10 %.  0: none */
    long long rows;       /* of the curve, beside the start, at equal distances; 200 */
    long long quad_steps; /* where rounding hides what steps change, all are in quad precision if
                             there are no more than these, 200000; each takes tens of times as
                             long.  0: none */
    dal_exact_motion *motion; /* from the same start; NULL: one that the prediction makes */
} dal_predict_settings;
/* The default settings. */
dal_predict_settings dal_predict_settings_default(void);

/* The predicted behaviour of one observable.  Changes are differences to the start.  NaN: not
 * known; all of an observable that the exact motion does not conserve. */
typedef struct dal_predicted {
    char name[64];       /* "D1", "E", or of the invariant */
    bool is_conserved;   /* by the exact motion from this start */
    bool is_zero;        /* the mean rate is 0 by reversibility: the method preserves a reversal
                               that maps the exact motion to itself, and the observable, too; and
                               the motion goes on and comes back */
    double change;       /* at the end of the curve */
    double max_change;   /* max |change| up to there */
    double rate, margin; /* the mean rate per unit of t, and half its interval */
    double walk;         /* s^2 of the random walk: its variance per unit of t */
    double walk_margin;  /* half the interval of s^2 of 68 %: s^2 sqrt(5/pieces), or more where
                            the pieces are short */
    double rounding;     /* what rounding of one step may do in double precision */
} dal_predicted;

/* A prediction.  Over pieces rates and walks are of all of them, the curve is of the first. */
typedef struct dal_prediction {
    double from, to;           /* of the curve that was to be predicted */
    double step, unit_of_time; /* h, and tau of the motion near the start */
    double end;                /* t where the curve ends */
    double in_phase; /* t from which a run is so far from the exact motion that what oscillates is
                        at another place of its oscillation, by about 1 % of its size; rates and
                        sizes are not meant.  NaN: not before the end, or steps are in quad
                        precision */
    dal_prediction_end reason;      /* and why */
    char message[DAL_MESSAGE_SIZE]; /* of a step that failed; else "" */
    bool leaves_D;                  /* whether steps leave D = 0, above rounding */
    bool is_quad;                   /* steps are in quad precision, since rounding limits doubles */
    bool has_series;                /* the exact motion is by taylor, else by dop853 */
    long long steps;                /* single steps that were taken */
    long long pieces;               /* that were completed; 0: none were to be */
    int observables;                /* D1..Dm, E where there is one, invariants */
    dal_predicted *predicted;       /* [observables] */
    long long rows;                 /* of the curve, with the start */
    double *t;                      /* [rows] */
    double *change;                 /* [rows*observables] */
} dal_prediction;

/* A callback of dal_predict_create; it may be NULL. */
typedef struct dal_predict_observer {
    void *user; /* the first argument of the callback */
    /* Called now and then with the share of the work that is done, 0..1; any status but
     * DAL_STATUS_OK ends the curve there. */
    dal_status (*step)(void *user, double done);
} dal_predict_observer;

/* Makes the exact motion from the start of a run of spec, for dal_predict_settings.motion.  It is
 * extended when a prediction needs more of it, and keeps polynomials for as many bytes (0: 256 MB);
 * after these each prediction has its own.  Where F has no Taylor series each has its own from its
 * start.  Of the step of spec the sign alone is used, and of its method nothing; the system must
 * outlive the motion. [alloc]
 * Errors: errors of the start; DAL_STATUS_UNSUPPORTED, p or pi are not 0. */
dal_status dal_exact_motion_create(dal_exact_motion **motion, const dal_run_spec *spec,
                                   size_t bytes, dal_error *error);
/* Extends it for predictions to the time T.  These do not change it any more, and several threads
 * may read it; otherwise it is for one prediction at a time.  Where the motion fails before T
 * predictions say so.  Errors: DAL_STATUS_ARGUMENT (T), DAL_STATUS_INTERRUPTED by the observer. */
dal_status dal_exact_motion_extend(dal_exact_motion *motion, double T,
                                   const dal_predict_observer *observer, dal_error *error);
/* Frees it; NULL is allowed. */
void dal_exact_motion_free(dal_exact_motion *motion);

/* Predicts the drift of a run of spec to the time T: a whole number of steps.  settings and
 * observer may be NULL.  A method that leaves D = 0 is followed while C (h/tau)^p t/tau, about the
 * relative error of the prediction, is small (docs/predict.md says where C is from).  [alloc]
 * Errors: errors of the start; DAL_STATUS_ARGUMENT (T, settings, the
 * start of the motion); DAL_STATUS_UNSUPPORTED, and the
 * message says the reason: a tolerance, multipliers or accelerations that pass from step to step,
 * p or pi that are not 0, events, vakonomic motion, holonomic constraints, no callback `constraint`
 * for a method that leaves D = 0, quad precision, motion on an attractor. */
dal_status dal_predict_create(dal_prediction **prediction, const dal_run_spec *spec, double T,
                              const dal_predict_settings *settings,
                              const dal_predict_observer *observer, dal_error *error);
/* Frees it; NULL is allowed. */
void dal_prediction_free(dal_prediction *prediction);

#ifdef __cplusplus
}
#endif
#endif
