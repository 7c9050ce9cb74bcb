/* dalembert_evaluator.h - a system at a point, in units of its own, and checks of it.
 *
 * The conventions of dalembert.h hold here.  Derivatives are compared with
 * central differences of order 8, whose noise is near 1e-12. */
#ifndef DALEMBERT_EVALUATOR_H
#define DALEMBERT_EVALUATOR_H

#include "dalembert_model.h"
#include "dalembert_run.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A system with parameter values and the memory to evaluate it, for one thread. */
typedef struct dal_evaluator dal_evaluator;

/* Makes an evaluator with parameters[parameter_count]; the others have the system's values.  The
 * system must outlive it. [alloc]  Errors: DAL_STATUS_NAME with the nearest name,
 * DAL_STATUS_NOT_FINITE, errors of prepare. */
dal_status dal_evaluator_create(dal_evaluator **evaluator, const dal_system *system,
                                const dal_setting *parameters, int parameter_count,
                                dal_error *error);
/* Frees an evaluator. */
void dal_evaluator_free(dal_evaluator *evaluator);
/* The system that is evaluated. */
const dal_system *dal_evaluator_system(const dal_evaluator *evaluator);
/* Calls a callback of the system at t, q[n], v[n + multipliers]; pi[n] is read by adjoint and
 * effort alone and may else be NULL.  Errors: DAL_STATUS_UNSUPPORTED (callback is NULL), errors of
 * the callback. */
dal_status dal_evaluator_call(dal_evaluator *evaluator, dal_callback *callback, double t,
                              const double *q, const double *v, const double *pi, double *out);
/* The scales of D, E, the invariants and g at a point, out[m + 1 + invariants + holonomic], see
 * dal_scale_callback; their absolute values where the system has no scales. */
dal_status dal_evaluator_scales(dal_evaluator *evaluator, double t, const double *q,
                                const double *v, double *out);
/* The start: out[2n + multipliers + 1] = q, v, g, e, with x, x', g1 and e replaced by
 * start[start_count], and then the velocities that it solves by those from D = 0 at t = 0.  It need
 * not satisfy the other constraints.  Errors: DAL_STATUS_NAME, errors of the system; where
 * velocities are solved DAL_STATUS_RANK, DAL_STATUS_INCONSISTENT. */
dal_status dal_evaluator_start(dal_evaluator *evaluator, const dal_setting *start, int start_count,
                               double *out, dal_error *error);
/* The same of a start at the time t. */
dal_status dal_evaluator_start_at(dal_evaluator *evaluator, double t, const dal_setting *start,
                                  int start_count, double *out, dal_error *error);

/* A system in units of its own: lengths, a time and units of energy, constraints and invariants, in
 * which the numbers of its motion near the start are about 1.  All are powers of two, so that no
 * digit changes, and change with the units of the user as the quantities do.  Checks compare
 * numbers with 1: of the scaled system they find the same in all units. */
typedef struct dal_scaled dal_scaled;
/* Finds the units of spec->system by its motion from spec->start at start_time; a step, where one
 * is given, says the time where the motion does not.  The system must outlive it. [alloc]  Errors:
 * errors of the parameters and of the start; DAL_STATUS_MEMORY. */
dal_status dal_scaled_create(dal_scaled **scaled, const dal_run_spec *spec, dal_error *error);
/* The same of the system of a run, with its parameters, by the motion from its present
 * state. [alloc]  Errors: DAL_STATUS_MEMORY. */
dal_status dal_scaled_create_at(dal_scaled **scaled, const dal_run *run, dal_error *error);
/* Frees it and its system. */
void dal_scaled_free(dal_scaled *scaled);
/* The system in those units, with one lane, without series, quad precision and events. */
const dal_system *dal_scaled_system(const dal_scaled *scaled);
/* The units of time, of the coordinates, and of velocities and multipliers,
 * [1 + n + n + multipliers]. */
const double *dal_scaled_units(const dal_scaled *scaled);

/* ---- checks of a system ---- */

/* d/dt of the count values of a callback along the motion, that is the derivative along
 * (v, F, dg/dt, 1): out[count].  For D it must vanish on every level of D. [alloc]
 * Errors: DAL_STATUS_UNSUPPORTED, DAL_STATUS_NOT_FINITE, DAL_STATUS_MEMORY. */
dal_status dal_evaluator_measure_rate(dal_evaluator *evaluator, dal_callback *callback, int count,
                                      const dal_point *at, double *out);

/* Derivatives that callbacks return against differences of values: the maximum of
 * |returned - difference| / max(1, |returned|); NaN where there is nothing to compare. */
typedef struct dal_derivatives {
    double jacobian;            /* F_q, F_(v,g) */
    double adjoint;             /* F_q^T pi, F_v^T pi, and its F against field */
    double effort;              /* (pi.K pi)_q/2, (pi.K pi)_v/2 */
    double effort_constraint;   /* A K pi against |A| |K pi|: of an effort with A K = 0 */
    double constraint_jacobian; /* A = dD/dv */
    double gram;                /* asymmetry of G = A W^-1 A^T, relative to its size */
} dal_derivatives;
/* Compares the derivatives at a point.  [alloc]  Errors: as for the callbacks,
 * DAL_STATUS_NOT_FINITE: the differences are not finite. */
dal_status dal_evaluator_check_derivatives(dal_evaluator *evaluator, const dal_point *at,
                                           dal_derivatives *out);

/* The numerical rank of G = A W^-1 A^T, and its smallest pivot relative to the largest entry of
 * G scaled to a unit diagonal (0 where G is singular). [alloc]  Errors: as for the callbacks. */
dal_status dal_evaluator_measure_rank(dal_evaluator *evaluator, const dal_point *at, int *rank,
                                      double *pivot);

/* Moves q[n] along W^-1 g_q^T until g = 0 of holonomic constraints (Newton, to stagnation), v[n]
 * being where W is taken. [alloc]  Errors: as of dal_evaluator_project_velocity. */
dal_status dal_evaluator_project_position(dal_evaluator *evaluator, double t, double *q,
                                          const double *v);

/* Moves v[n] along W^-1 A^T until D = 0 (Newton, to stagnation). [alloc]  Errors:
 * DAL_STATUS_NOT_CONVERGED, or DAL_STATUS_SINGULAR where G is singular, v being as before; errors
 * of the callbacks. */
dal_status dal_evaluator_project_velocity(dal_evaluator *evaluator, double t, const double *q,
                                          double *v);

/* The class of D as a function, by differences at points around *at: each member is a necessary
 * condition, satisfied to rounding at every point tried. */
typedef struct dal_constraint_class {
    bool linear;         /* affine in v */
    bool constant;       /* affine in (q,v) jointly */
    bool bilinear;       /* affine in v, and affine in q */
    bool quadratic;      /* of degree <= 2 in (q,v) jointly */
    int parity;          /* D(q,-v,-t) = +D: 1, -D: -1, neither: 0; of the first
                            constraint, 0 when one has none */
    bool homogeneous;    /* v.D_v = k D with one k per constraint */
    bool reversible;     /* F(q,-v,-t) = F(q,v,t) */
    double force_defect; /* max |F(q,-v,-t) - F(q,v,t)| / max(1, |F|) over these points; NaN where
                            F has no values */
} dal_constraint_class;
/* Classifies D about a point; degree[m], when not NULL, receives the k of each constraint. [alloc]
 * Errors: DAL_STATUS_UNSUPPORTED, DAL_STATUS_NOT_FINITE: D has no values about the point. */
dal_status dal_evaluator_classify_constraints(dal_evaluator *evaluator, const dal_point *at,
                                              dal_constraint_class *out, double *degree);

/* What jumps where a formula changes its branch: the derivative of F of this number along the
 * motion (0: F itself), or one of these. */
enum {
    DAL_JUMP_IMPULSE = -1, /* L, L_v or a constraint: an impulse that is not in F */
    DAL_JUMP_NONE = 4,     /* no derivative below this one */
    DAL_JUMP_UNKNOWN       /* no point was found where the branch changes */
};
/* A formula with branches, and the first of their jumps. */
typedef struct dal_branch {
    char formula[128]; /* "force on x" */
    int line, column;  /* its place */
    int jump;          /* the lowest derivative that jumps, or one of the above */
} dal_branch;
/* Finds the formulas of the motion with branches (if, abs, min, ...) of a model whose system is
 * made: how many there are, and what up to capacity of them do near the start, with the default
 * parameters.  A step across a jump of derivative k has at most order k + 1. [alloc]  Errors:
 * DAL_STATUS_ARGUMENT, DAL_STATUS_MEMORY, DAL_STATUS_TOO_LARGE. */
dal_status dal_model_branches(dal_model *model, dal_branch *branch, int capacity, int *count);

/* The branches at which F or its derivative by a velocity jumps, as far as is known near the start:
 * beyond one of them derivatives of F are not derivatives of the motion. */
typedef struct dal_jumps dal_jumps;
/* Finds the branches of a model whose system is made, and which must outlive them. [alloc]  Errors:
 * DAL_STATUS_ARGUMENT, DAL_STATUS_MEMORY, DAL_STATUS_TOO_LARGE. */
dal_status dal_jumps_create(dal_jumps **jumps, dal_model *model);
/* Frees them; NULL is allowed. */
void dal_jumps_free(dal_jumps *jumps);
/* How many there are. */
int dal_jumps_count(const dal_jumps *jumps);
/* The formula, "force on x", in which a branch is another one at the state of a run than it was at
 * the last call, valid until the next call; NULL: none. */
const char *dal_jumps_passed(dal_jumps *jumps, const dal_run *run);

#ifdef __cplusplus
}
#endif
#endif
