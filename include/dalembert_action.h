/* dalembert_action.h - the actions of the theory on a curve given by rows, and discrete actions.
 *
 * A part of dalembert_analysis.h; the conventions of dalembert.h hold here. */
#ifndef DALEMBERT_ACTION_H
#define DALEMBERT_ACTION_H

#include "dalembert_evaluator.h"
#include "dalembert_run.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A curve by rows at times that ascend.  Functions between the rows are cubic splines without knots
 * at the second and the last but one row (DAL_NOT_A_KNOT). */
typedef struct dal_curve {
    int rows;                          /* at least DAL_CURVE_ROWS */
    const double *t;                   /* [rows] */
    const double *q;                   /* [rows*n] */
    const double *v, *lambda, *p, *pi; /* [rows*n] each; NULL: q', 0, 0, 0 */
    const double *e, *pi_e;            /* [rows] each; NULL: 1, 0 */
} dal_curve;
enum { DAL_CURVE_ROWS = 7 };

/* The actions: ACTION(code, label, text). */
#define DAL_ACTION_LIST(ACTION)                                                                    \
    ACTION(EQUATIONS, "nh8", "int e/2 sum (S^i)^2 dt")                                             \
    ACTION(SECOND_ORDER, "nh10", "int e/2 |q'' - F|^2 dt")                                         \
    ACTION(FIRST_ORDER, "nh11", "int e/2 |v' - F|^2 + lambda.(q' - v) dt")                         \
    ACTION(HAMILTONIAN, "nh23", "int p.q' + pi.v' + pi_e e' - H dt")
typedef enum dal_action_form {
#define CODE(code, label, text) DAL_ACTION_##code,
    DAL_ACTION_LIST(CODE)
#undef CODE
        DAL_ACTIONS
} dal_action_form;

/* A value and an estimate of its error: how far it is from the value with every second row. */
typedef struct dal_action {
    double value; /* of the action */
    double error; /* |value - value with every second row| */
} dal_action;

/* An action of a curve, by Gauss quadrature with four nodes between two rows; S(q, q', q'', t) of
 * the section equations in DAL_ACTION_EQUATIONS, F(q, q', t) in DAL_ACTION_SECOND_ORDER, F(q, v, t)
 * in the others, H with the effort of the system.  The value
 * converges with the rows: where the curve is a motion the first one vanishes like h^4, elsewhere
 * its error is of the order h^2. [alloc]  Errors: DAL_STATUS_ARGUMENT (too few rows, times that do
 * not ascend, numbers that are not finite), DAL_STATUS_UNSUPPORTED (vakonomic motion, no
 * equations),
 * DAL_STATUS_NOT_FINITE with the time, errors of the callbacks. */
dal_status dal_evaluator_integrate_action(dal_evaluator *evaluator, const dal_curve *curve,
                                          dal_action_form form, dal_action *action,
                                          dal_error *error);
/* The largest |D_a(q, q', t)| at the rows of a curve, q' being the derivative of the spline; 0
 * without constraints. [alloc]  Errors: as above. */
dal_status dal_evaluator_measure_curve(dal_evaluator *evaluator, const dal_curve *curve,
                                       double *max_constraint, dal_error *error);

/* The step of a run whose rows a curve may be: the distance of its times, equal within 1e-9 of it;
 * 0 where they have different distances, or there are less than two. */
double dal_curve_step(const dal_curve *curve);

/* What the discrete action of a method is at rows that are its steps. */
typedef struct dal_discrete_action {
    double value;       /* of the steps from the rows; NaN where e is not constant */
    double defect;      /* the largest distance of a row from the step before it, divided by h */
    bool is_stationary; /* every row is the step before it, up to rounding */
} dal_discrete_action;
/* Whether the discrete action of a symplectic method is stationary at a curve with fixed ends,
 * whose rows have the distance h = spec->options.step: where h is small that is so if and only if
 * each row is the step from the row before it.  The discrete action is
 *     S_d = sum_k h sum_i b_i (P_ki.X'_ki - H(X_ki, P_ki)),  X = (q, v, e),  P = (p, pi, pi_e)
 * with the weights b of the method at its stages, which where e is constant is the change of
 * e pi_e.  Marsden and West, Acta Numerica 10 (2001) 357, 2.6. [alloc]  Errors:
 * DAL_STATUS_ARGUMENT (rows at other distances, and as above), DAL_STATUS_UNSUPPORTED (a method
 * that is not symplectic, or has no lift), as for dal_run_create and dal_run_step. */
dal_status dal_check_discrete_action(const dal_run_spec *spec, const dal_curve *curve,
                                     dal_discrete_action *action, dal_error *error);

#ifdef __cplusplus
}
#endif
#endif
