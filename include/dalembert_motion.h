/* dalembert_motion.h - measures of a motion as a whole: exponents, phase volume, sections; a part
 * of dalembert.h, never included by itself. */
#ifndef DALEMBERT_MOTION_H
#define DALEMBERT_MOTION_H

/* ---- means ---------------------------------------------------------------------------------- */

/* A mean and its 95 % confidence interval, from the means of blocks and the correlation of
 * neighbours.  The interval knows what varies from block to block, nothing else: neither a slow
 * approach to a limit nor the error of the method. */
typedef struct dal_average {
    double mean, low, high;
} dal_average;

/* NaN without values; an infinite interval with fewer than 3 blocks. */
void dal_statistics_mean(const dal_statistics *statistics, dal_average *average);

/* ---- Lyapunov exponents and phase volume --------------------------------------------------- */

/* A run on (q, v, g) with tangent vectors: J, the derivative of each of its steps, moves them, and
 * Gram-Schmidt makes them orthonormal again,
 *     J V = V' R,    exponent i = mean of log(R_ii)/h,    mean of log|det J|/h = their sum,
 * and the divergence of the motion, the trace of F_(v,g), is followed beside them.  Its long-time
 * mean is that of every density of the phase space, and on D = 0, where the logarithms of densities
 * and of |grad D| grow slower than t: only their total derivatives come in. */
typedef struct dal_lyapunov dal_lyapunov;

/* count vectors, 0: as many as the step map has directions, that is 2n + multipliers, less m where
 * the method forces D = 0, less one where it forces E.  tangent is dal_model_tangent of the same
 * model, or NULL.  J is exact (to rounding) with it and a Runge-Kutta, polarised or composed
 * method; else by differences of the step, of order 8, with increments that do not depend on how
 * far the coordinates have travelled.  The space of the spec is not looked at. [alloc]  Errors:
 * those of a run; DAL_ARGUMENT (count); DAL_UNSUPPORTED: the step is no smooth map of (q, v, g)
 * alone: a multiplier carried along, a tolerance. */
dal_status dal_lyapunov_create(dal_lyapunov **lyapunov, const dal_run_spec *spec,
                               const dal_system *tangent, int count, dal_error *error);
void dal_lyapunov_free(dal_lyapunov *lyapunov);
/* The same bits as dal_run_advance of a run of the spec.  Errors: those of a step; DAL_SINGULAR
 * when J takes a vector to 0. */
dal_status dal_lyapunov_advance(dal_lyapunov *lyapunov, long long steps, dal_error *error);
/* Begins all means anew, as behind a transient; the vectors stay. */
void dal_lyapunov_discard_transient(dal_lyapunov *lyapunov);

/* Whether the sum of all exponents is the divergence.  Of the flow it is so over any time:
 *     sum = mean divergence + surface,    surface = (1/T) [log |grad D|] between both ends
 * where the method forces D = 0 (E likewise, |grad| then being the volume that the gradients by (q,
 * v, g) span), else 0: a direction that is forced has no exponent, and that of the flow was a 0. */
typedef struct dal_balance {
    double surface;
    double difference; /* sum - mean divergence - surface */
    double margin;     /* what the method's error may be, the mean of dimension r x^order / (1 - x)
                          with x = h r and r = max(|F_q|^(1/2), |F_(v,g)|), and those of quadrature
                          and of J; no interval is in it: both means are of one trajectory */
    int holds;         /* |difference| <= margin; if not, J has been measured wrongly */
} dal_balance;

/* Errors: DAL_UNSUPPORTED: not all exponents, no jacobian, directions lost that neither D nor E
 * explains, a method that turns D into -D in every step, or x >= 1 in some step. [alloc] */
dal_status dal_lyapunov_balance(dal_lyapunov *lyapunov, dal_balance *balance, dal_error *error);

const dal_run *dal_lyapunov_run(const dal_lyapunov *lyapunov);
int dal_lyapunov_count(const dal_lyapunov *lyapunov);
int dal_lyapunov_is_exact(const dal_lyapunov *lyapunov); /* J by the tangent system */
/* Whether the vectors span the space, so that their sum is log|det J|/h. */
int dal_lyapunov_is_whole(const dal_lyapunov *lyapunov);

/* Exponent i, from 0 (NaN past the last); they come in falling order when the vectors have had time
 * to turn. */
void dal_lyapunov_exponent(const dal_lyapunov *lyapunov, int i, dal_average *average);
/* Of the sum of the exponents. */
void dal_lyapunov_sum(const dal_lyapunov *lyapunov, dal_average *average);
/* Of the divergence, each step's being the mean of its ends; NaN when the system has no jacobian.
 */
void dal_lyapunov_divergence(const dal_lyapunov *lyapunov, dal_average *average);

/* ---- Poincare sections --------------------------------------------------------------------- */

typedef struct dal_crossing {
    long long number; /* from 1, of those shown */
    double t;
    int direction; /* 1: upwards, -1: downwards */
} dal_crossing;

/* The crossings of g = 0, g being value number index of a callback of the run's system that leaves
 * count values (an invariant: system->invariant_values). */
typedef struct dal_poincare {
    dal_callback *callback;
    int count, index;
    int direction; /* 1: from g < 0 to g > 0, -1: the other way, 0: both */
    void *user;
    /* Called with the run at the crossing; it must not move the run.  May be NULL, as poll, which
     * is called after every 1000 steps or so.  Any status but DAL_OK ends it all with that status.
     */
    dal_status (*cross)(void *user, dal_run *run, const dal_crossing *crossing);
    dal_status (*poll)(void *user, dal_run *run);
} dal_poincare;

/* What came of it: crossings met, of either direction, and touches. */
typedef struct dal_crossings {
    long long up, down;
    long long touches; /* minima of |g| below 1e-12 of the greatest |g| met that are no crossings */
} dal_crossings;

/* Carries the run to time T, a whole number of its steps, and shows every crossing on the way.
 * Where g changes sign within a step, a step of another size of the same method from where that
 * step began meets it, its size found to rounding; so the trajectory is undisturbed.  A pair of
 * crossings within one step is found where g has an extremum between them.  A start with g = 0 is
 * no crossing. [alloc]  Errors: those of the steps and of the callback; DAL_ARGUMENT. */
dal_status dal_run_crossings(dal_run *run, double T, const dal_poincare *section,
                             dal_crossings *found, dal_error *error);

#endif
