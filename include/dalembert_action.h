/* dalembert_action.h - the actions of the theory on a curve given by rows, and discrete actions;
 * Poisson brackets of functions.
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

/* ---- on rows at equal distances ------------------------------------------------------------- */

/* S = int e/2 |q'' - F(q,q',t)|^2 dt (nh10) with constant e on the curve q[count*n] given at t0,
 * t0 + h, ...: derivatives by differences of order 8, so the four points at either end serve for
 * differences only; count >= 10. [alloc]  0 on solutions up to discretisation and rounding (about
 * (2e-15/h^2)^2 and h^16), positive off them. */
dal_status dal_evaluator_measure_action(dal_evaluator *evaluator, double t0, double h,
                                        long long count, const double *q, double e, double *action);

/* How far the discrete first-order action (nh23) is from stationary on a path.
 *     S = sum_k P_k.(X_(k+1) - X_k) - h H((X_k + X_(k+1))/2, P_k)
 * with X_k [2n+1] = q, v, e at the count >= 3 nodes, P_k [2n+1] = p, pi, pi_e the mean over each of
 * the count-1 intervals, states[count*(4n+2)] the rows of a lifted run.  The maximum of |dS/dX_k|
 * over inner nodes and |dS/dP_k|, divided by h: zero to rounding for implicit-midpoint, of the
 * order of the error for others. [alloc]  Errors: DAL_STATUS_ARGUMENT, errors of the callbacks. */
dal_status dal_evaluator_check_stationarity(dal_evaluator *evaluator, double t0, double h,
                                            long long count, const double *states, double *defect);

/* ---- brackets ------------------------------------------------------------------------------- */

/* A function on a phase space of 2N numbers z = (X, P). */
typedef double dal_observable_function(void *user, const double *z);

/* gradient[count] of f at z by differences with increments of 2e-3, or less where f changes faster.
 * z is changed meanwhile and restored. */
void dal_measure_gradient(dal_observable_function *f, void *user, int count, double *z,
                          double *gradient);
/* {f,g} = sum f_X g_P - f_P g_X from two gradients [2*pairs]. */
double dal_poisson(const double *f, const double *g, int pairs);

#ifdef __cplusplus
}
#endif
#endif
