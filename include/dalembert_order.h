/* dalembert_order.h - order and structure of a method.
 *
 * The conventions of dalembert.h hold here.  Derivatives are compared with central differences of
 * order 8, whose noise is near 1e-12.
 *
 * Symplecticity on the lifted space says nothing about D or the energy of the motion itself: on
 * p = pi = 0 every one-step method whose step on (q,v) is locally invertible, explicit Euler
 * included, is the restriction of a symplectic map. */
#ifndef DALEMBERT_ORDER_H
#define DALEMBERT_ORDER_H

#include "dalembert_evaluator.h"
#include "dalembert_statistics.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- order and structure of a method ------------------------------------------------------- */

enum { DAL_ORDER_LEVELS = 8 /* max step sizes of dal_order */ };

/* Whether an order is found, or why not: OUTCOME(code, word). */
#define DAL_ORDER_OUTCOME_LIST(OUTCOME)                                                            \
    OUTCOME(FOUND, "found")                                                                        \
    OUTCOME(COARSE, "coarse")     /* steps too large: slopes differ, or half the solution */       \
    OUTCOME(ROUNDING, "rounding") /* fewer than three errors above rounding or the reference */    \
    OUTCOME(FEW, "few")           /* fewer than three step sizes */
/* Whether an order was found, and why not. */
typedef enum dal_order_outcome {
#define ORDER_OUTCOME_CODE(code, word) DAL_ORDER_##code,
    DAL_ORDER_OUTCOME_LIST(ORDER_OUTCOME_CODE)
#undef ORDER_OUTCOME_CODE
} dal_order_outcome;

/* Errors at time T for decreasing steps (step, step/2, step/4, ... in dal_order_measure), their
 * cost, and the slopes between them. */
typedef struct dal_order {
    int levels;                              /* step sizes, at most DAL_ORDER_LEVELS */
    double step[DAL_ORDER_LEVELS];           /* step sizes, decreasing */
    double error[DAL_ORDER_LEVELS];          /* of (q, v, g) at T: the largest part of a component,
                                                or of its unit (dal_scaled) where that is larger */
    long long evaluations[DAL_ORDER_LEVELS]; /* of the field */
    double slope[DAL_ORDER_LEVELS]; /* slope[i] between levels i-1 and i; slope[0] is NaN */
    double order;                   /* NaN: none can be stated */
    dal_order_outcome outcome;      /* why it is stated, or not */
} dal_order;

/* Computes slope and order from levels, step and error.  The order is the second slope of the last
 * three errors that are above rounding (2e-13, and ten times noise, the error of the reference) and
 * below half the solution, if the two slopes agree so well that the next term of the error changes
 * it by at most 0.1.  Otherwise it is NaN: the steps are not in the asymptotic range, or fewer than
 * three errors are the method's own. */
void dal_order_slopes(dal_order *order, double noise);

/* The number of steps between two times: n with |n step - (to - from)| <= 1e-9 |to|, 1 <= n < 2^53;
 * 0 where there is none. */
long long dal_whole_steps(double from, double to, double step);

/* Measures the order with 2 to DAL_ORDER_LEVELS step sizes: the state at T, a whole number of the
 * steps, against reference[dimension], or, when that is NULL, against gauss12 (or
 * *reference_method) with half the smallest step.  The observer, which may be NULL, has its poll
 * called every few hundred steps of a run. [alloc]  Errors: as for the runs,
 * DAL_STATUS_ARGUMENT. */
dal_status dal_order_measure(dal_order *order, const dal_run_spec *spec, double T, int levels,
                             const dal_method *reference_method, const double *reference,
                             const dal_observer *observer, dal_error *error);

/* The maximum entry of |J^T Omega J - Omega|, J the derivative of one step from the run's start (or
 * from state[4n+2] at time t) by differences; pairs (q,p), (v,pi), (e,pi_e), in the units of the
 * system for q and v, and their reciprocals for the momenta.  Lifted space only:
 * DAL_STATUS_UNSUPPORTED; e must be finite.  increment, to begin with, relative to max(unit, h |v|)
 * of a coordinate and max(unit, |x|) of all else; 0: 2e-3. [alloc]  Errors: as for a step. */
dal_status dal_check_symplecticity(const dal_run_spec *spec, double t, const double *state,
                                   double increment, double *defect, dal_error *error);

/* rho step rho step = id: the maximum difference from the identity, relative to max(unit, |x|),
 * over one step from the start (or from state at time t).  rho reverses time, t -> -t, with
 *     (q, v) -> (q, -v),      (q, v, e, p, pi, pi_e) -> (q, -v, e, -p, pi, -pi_e),
 * the antisymplectic lift that leaves H = pi.pi/(2e) + pi.F + p.v alone when mu_e is odd in t and
 * F(q,-v,-t) = F(q,v,t); vakonomic g goes to -g where D is odd in v.  [alloc]
 * Errors: as for a step. */
dal_status dal_check_reversibility(const dal_run_spec *spec, double t, const double *state,
                                   double *defect, dal_error *error);

/* p.dq + pi.dv along steps of spec->method with 1/e = 0: (q,p,v,pi) from a lifted run with the
 * start of spec (its p_x, pi_x name the covector), (dq,dv) from the tangent system of the same
 * model (dal_model_tangent) in the physical space, beginning with direction[2n].  Constant for
 * symplectic methods.  The statistics cover every step. [alloc]  Errors: as for the runs. */
dal_status dal_adjoint_pairing(const dal_run_spec *spec, const dal_system *tangent,
                               const double *direction, long long steps, dal_statistics *statistics,
                               dal_error *error);

#ifdef __cplusplus
}
#endif
#endif
