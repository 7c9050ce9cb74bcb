/* dalembert_order.h - order and structure of a method, the action and Dirac's procedure.
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

/* ---- the action ---------------------------------------------------------------------------- */

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

/* A function on a phase space of 2N numbers z = (X, P). */
typedef double dal_observable_function(void *user, const double *z);

/* gradient[count] of f at z by differences with increments of 2e-3, or less where f changes faster.
 * z is changed meanwhile and restored. */
void dal_measure_gradient(dal_observable_function *f, void *user, int count, double *z,
                          double *gradient);
/* {f,g} = sum f_X g_P - f_P g_X from two gradients [2*pairs]. */
double dal_poisson(const double *f, const double *g, int pairs);

/* ---- Dirac's procedure --------------------------------------------------------------------- */

/* A formula with the names of the system, in the language of system files and in LaTeX. */
typedef struct dal_formula {
    const char *text;  /* as in a system file */
    const char *latex; /* for display mathematics */
} dal_formula;

/* What the conservation of a constraint requires: OUTCOME(code, word). */
#define DAL_DIRAC_OUTCOME_LIST(OUTCOME)                                                            \
    OUTCOME(HOLDS, "holds")             /* nothing */                                              \
    OUTCOME(FIXES, "fixes")             /* a multiplier */                                         \
    OUTCOME(ADDS, "adds")               /* a further constraint */                                 \
    OUTCOME(IRREGULAR, "irregular")     /* constraints whose squares add up to the condition */    \
    OUTCOME(CONTRADICTS, "contradicts") /* what holds nowhere: there is no motion */               \
    OUTCOME(STOPS, "stops")             /* an irregular one of another form, or without a point */
/* What the conservation of a constraint requires. */
typedef enum dal_dirac_outcome {
#define DIRAC_OUTCOME_CODE(code, word) DAL_DIRAC_##code,
    DAL_DIRAC_OUTCOME_LIST(DIRAC_OUTCOME_CODE)
#undef DIRAC_OUTCOME_CODE
        DAL_DIRAC_OUTCOME_COUNT
} dal_dirac_outcome;
/* The word of an outcome; "?" of a number that is none. */
const char *dal_dirac_outcome_name(dal_dirac_outcome outcome);

/* A constraint phi = 0. */
typedef struct dal_dirac_constraint {
    dal_formula phi;  /* its left side */
    int stage;        /* that found it; 0: primary */
    int source;       /* the constraint whose conservation requires it; -1: primary */
    bool first_class; /* else it is one of the second-class ones that Dirac brackets are made of */
    dal_formula form; /* phi, where first class less what has brackets with the second class */
} dal_dirac_constraint;

/* The conservation of one constraint, in one stage. */
typedef struct dal_dirac_step {
    int stage;                 /* from 1 */
    int constraint;            /* that must be conserved, from 0 */
    dal_dirac_outcome outcome; /* what that requires */
    dal_formula condition;     /* 0 where the constraint is conserved; the value of a multiplier */
    int multiplier;            /* fixed; -1: none */
    int first, count;          /* of the constraints that it adds */
} dal_dirac_step;

/* The multiplier of a primary constraint. */
typedef struct dal_dirac_multiplier {
    dal_formula name;  /* as in the formulas */
    dal_formula value; /* of one that is not free, on the surface */
    bool is_free;      /* whether nothing fixes it */
} dal_dirac_multiplier;

/* A Dirac bracket {left, right} that is not 0, on the surface. */
typedef struct dal_dirac_bracket {
    dal_formula left;  /* a coordinate or velocity */
    dal_formula right; /* a coordinate, velocity or momentum */
    dal_formula value; /* of the bracket */
} dal_dirac_bracket;

/* The gauge transformation of a free multiplier: {z, generator} is the change of z.  A multiplier
 * has none here where the series of its primary constraint does not end by itself. */
typedef struct dal_dirac_generator {
    int multiplier;            /* from 0 */
    int derivatives;           /* the highest of alpha(t) in it */
    dal_formula generator;     /* with alpha, alpha' and so on */
    int changes;               /* variables that it changes */
    dal_formula *changed;      /* [changes] these variables */
    dal_formula *change;       /* [changes] by what, on the surface */
    dal_formula of_multiplier; /* the change of the multiplier */
} dal_dirac_generator;

/* Dirac's procedure from beginning to end.  The phase space has 2*pairs dimensions:
 *
 *     lifted      X = (q, v, lambda, e), P = (p, pi, pi_lambda, pi_e), from (nh11),
 *                 H_0 = pi.K pi/(2e) + pi.F + lambda.v
 *     vakonomic   X = (q, v, lambda, g), P = (p, pi, pi_lambda, pi_g), from
 *                 L_1 = L(q,v,t) - g.D(q,v,t) + lambda.(q' - v),   H_0 = lambda.v - L + g.D
 *
 * The momenta whose velocities do not occur in L_1 are the primary constraints phi_b, and
 * H = H_0 + sum_b mu_b phi_b.  Stage by stage every constraint must be conserved on the surface of
 * those found so far,
 *
 *     {phi_a, H_0} + d phi_a/dt + sum_b mu_b {phi_a, phi_b} = 0,
 *
 * which is reduced by elimination: rows with a pivot fix multipliers, the others are conditions.
 * Brackets are expressions with exact derivatives; points about the start decide what vanishes on
 * the surface.  A condition sum_i c_i s_i^2, or a semidefinite quadratic form in momenta, has no
 * gradient where it is 0: it is replaced by the s_i, or by the kernel of the form (nh15). */
typedef struct dal_dirac {
    int pairs;               /* half of the dimension of the phase space */
    int primaries;           /* primary constraints, and multipliers */
    int stages;              /* until nothing is added */
    int constraints;         /* all; a complete chain of the lift has 4n + 1 for a regular K */
    int second_class;        /* rank of their brackets; 2n for the lift */
    int first_class;         /* the rest */
    int free_multipliers;    /* 1 for the lift: mu_e, the gauge */
    int dimension;           /* of the surface less the gauge directions: 2n; -1: not known */
    bool is_complete;        /* else the last step contradicts or stops, and there is no more */
    dal_formula hamiltonian; /* H_0 */
    dal_formula on_surface;  /* H on the surface */
    dal_dirac_constraint *constraint; /* [constraints] */
    int steps;                        /* conservations */
    dal_dirac_step *step;             /* [steps] */
    dal_dirac_multiplier *multiplier; /* [primaries] */
    int brackets;                     /* listed */
    int generators;                   /* listed */
    dal_dirac_bracket *bracket;       /* [brackets] of (q, v) with (q, v, p, pi) */
    dal_dirac_generator *generator;   /* [generators] */
} dal_dirac;

/* Carries out Dirac's procedure for a model whose system is the one of spec, with its effort; the
 * parameters and the start of spec say where points are.  [alloc]  Errors: errors of the start;
 * DAL_STATUS_UNSUPPORTED (vakonomic motion with forces), DAL_STATUS_TOO_LARGE,
 * DAL_STATUS_NOT_FINITE. */
dal_status dal_dirac_create(dal_dirac **dirac, dal_model *model, const dal_run_spec *spec,
                            dal_error *error);
/* Frees it; NULL is allowed. */
void dal_dirac_free(dal_dirac *dirac);

#ifdef __cplusplus
}
#endif
#endif
