/* dalembert_dynamics.h - Lyapunov exponents, phase volume and Poincare sections.
 *
 * The conventions of dalembert.h hold here. */
#ifndef DALEMBERT_DYNAMICS_H
#define DALEMBERT_DYNAMICS_H

#include "dalembert_statistics.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Lyapunov exponents and phase volume --------------------------------------------------- */

/* A run on (q, v, g) with tangent vectors.  J, the derivative of each of its steps, moves them, and
 * Gram-Schmidt makes them orthonormal again in the units of dal_scaled (Benettin, Galgani,
 * Giorgilli, Strelcyn 1980, DOI 10.1007/BF02128236).
 *     J V = V' R,    exponent i = mean of log(R_ii)/h,    mean of log|det J|/h = their sum
 * The mean divergence of the motion, the mean trace of F_(v,g), is their sum, too.  Over a long
 * time it holds for every density of the phase space, and on D = 0, provided that the logarithms of
 * the density and of |grad D| grow slower than t: they contribute total derivatives only. */
typedef struct dal_lyapunov dal_lyapunov;

/* Makes count tangent vectors; 0: one for each direction of the step map, that is 2n + multipliers,
 * less m where the method enforces D = 0, less one for each holonomic constraint and for E where
 * it enforces these.  tangent is
 * dal_model_tangent of the same model, or NULL.  With it and a Runge-Kutta method, partitioned
 * symplectic Euler, or a composition, J is the derivative of the formulas of the step, to rounding
 * and to the error of its solver; otherwise it is found by differences of the step, of order 8,
 * with increments that do not depend on how far the coordinates have travelled.  The space of the
 * spec is ignored. [alloc]  Errors: as for a run; DAL_STATUS_ARGUMENT (count);
 * DAL_STATUS_UNSUPPORTED: the step is no smooth map of (q, v, g) alone: it has a multiplier as
 * persistent state, or a tolerance. */
dal_status dal_lyapunov_create(dal_lyapunov **lyapunov, const dal_run_spec *spec,
                               const dal_system *tangent, int count, dal_error *error);
/* The same on the lift (q, v, p, pi) at constant e, 4n vectors, for methods with an exact J, which
 * needs the tangent.  The lift is Hamiltonian: the divergence is 0, and exponents are in pairs,
 * lambda and -lambda; on p = pi = 0 they are the exponents of (q, v) and their negatives.  The unit
 * of p_i q_i and of pi_i v_i is e u^2/tau of the largest velocity u. [alloc]  Errors: also
 * DAL_STATUS_UNSUPPORTED: no exact J; the gauge's mu_e is not of t alone. */
dal_status dal_lyapunov_create_lifted(dal_lyapunov **lyapunov, const dal_run_spec *spec,
                                      const dal_system *tangent, int count, dal_error *error);
/* Frees the vectors and their run. */
void dal_lyapunov_free(dal_lyapunov *lyapunov);
/* Takes steps of the run and its vectors; the run has the bits of dal_run_advance.  Errors: as
 * for a step; DAL_STATUS_SINGULAR when J takes a vector to 0. */
dal_status dal_lyapunov_advance(dal_lyapunov *lyapunov, long long steps, dal_error *error);
/* Begins all means at the present time, after a transient; the vectors stay. */
void dal_lyapunov_discard_transient(dal_lyapunov *lyapunov);

/* The sum of all exponents against the divergence.  For the flow, over any time,
 *     sum = mean divergence + surface,    surface = (1/T) [log |grad D|] between both ends
 * where the method enforces D = 0 (and E: |grad| is then the volume spanned by the gradients with
 * respect to (q, v, g)), else surface = 0: an enforced direction has no exponent, where the flow
 * has an exponent 0. */
typedef struct dal_balance {
    double surface;    /* [log |grad D|] between both ends, over the time, or 0 */
    double difference; /* sum - mean divergence - surface */
    double margin;     /* a bound of the errors of the method, the mean of
                          dimension r x^order / (1 - x) with x = h r and
                          r = max(|F_q|^(1/2), |F_(v,g)|), of the quadrature and of J; it has no
                          statistical part: both are means of one trajectory */
    bool holds;        /* |difference| <= margin; if not, J is wrong */
} dal_balance;

/* Compares the sum of all exponents so far with the divergence.  [alloc]  Errors:
 * DAL_STATUS_UNSUPPORTED: not all exponents, no jacobian, directions lost that neither D nor E
 * explains, a method that maps D to -D in every step, or x >= 1 in some step. */
dal_status dal_lyapunov_balance(dal_lyapunov *lyapunov, dal_balance *balance, dal_error *error);

/* The run, at its present state. */
const dal_run *dal_lyapunov_run(const dal_lyapunov *lyapunov);
/* The number of vectors, and of exponents. */
int dal_lyapunov_count(const dal_lyapunov *lyapunov);
/* Whether J is by the tangent system, not by differences. */
bool dal_lyapunov_is_exact(const dal_lyapunov *lyapunov);
/* Whether the vectors span the space, so that their sum is log|det J|/h. */
bool dal_lyapunov_is_whole(const dal_lyapunov *lyapunov);

/* The unit of time of the system, tau of dal_scaled; NaN for NULL.  Exponents of regular motion may
 * reach about log(1 + T/tau)/T after a time T. */
double dal_lyapunov_time_unit(const dal_lyapunov *lyapunov);
/* Exponent i, from 0 (NaN past the last); their order is decreasing after a transient. */
void dal_lyapunov_exponent(const dal_lyapunov *lyapunov, int i, dal_average *average);
/* The sum of the exponents. */
void dal_lyapunov_sum(const dal_lyapunov *lyapunov, dal_average *average);
/* The divergence: for each step the mean of both ends; NaN when the system has no jacobian. */
void dal_lyapunov_divergence(const dal_lyapunov *lyapunov, dal_average *average);

/* ---- Poincare sections --------------------------------------------------------------------- */

/* One crossing of g = 0. */
typedef struct dal_crossing {
    long long number; /* from 1, of those reported */
    double t;         /* its time */
    int direction;    /* 1: upwards, -1: downwards */
} dal_crossing;

/* A Poincare section, the surface g = 0.  cross and poll may be NULL and must not move the run; any
 * status but DAL_STATUS_OK ends the run with that status. */
typedef struct dal_poincare {
    dal_callback *callback; /* of the run's system; invariant_values for an invariant */
    int count;              /* its values */
    int index;              /* the index of g, from 0 */
    int direction;          /* 1: from g < 0 to g > 0, -1: the other way, 0: both */
    void *user;             /* the first argument of both callbacks */
    /* Called with the run at the crossing. */
    dal_status (*cross)(void *user, dal_run *run, const dal_crossing *crossing);
    /* Called about every 1000 steps. */
    dal_status (*poll)(void *user, dal_run *run);
} dal_poincare;

/* The numbers of crossings, reported or not. */
typedef struct dal_crossings {
    long long up, down;      /* by direction */
    long long touches;       /* minima of |g| below 1e-12 max |g| that are no crossings */
    long long unresolved;    /* steps that may hide crossings, */
    double first_unresolved; /* and the begin of the first of them; NaN: there is none */
} dal_crossings;

/* Advances the run to time T, a whole number of its steps, and reports the crossings that its steps
 * show: the state, found by dal_run_intermediate, with g = 0 to rounding; the trajectory does not
 * change.  An interval h of a step is halved, up to 10 times, where |g'| h > pi max |g| or g
 * changes by more than its rates g' at both ends explain.  A start with g = 0 is no crossing.
 * [alloc]  Errors: as for the steps and of the callback; DAL_STATUS_ARGUMENT. */
dal_status dal_run_crossings(dal_run *run, double T, const dal_poincare *section,
                             dal_crossings *found, dal_error *error);

#ifdef __cplusplus
}
#endif
#endif
