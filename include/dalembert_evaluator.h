/* dalembert_evaluator.h - a system at a point, and in units of its own.
 *
 * The conventions are those of dalembert.h, which it includes. */
#ifndef DALEMBERT_EVALUATOR_H
#define DALEMBERT_EVALUATOR_H

#include "dalembert.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A system with parameter values and the memory to evaluate it, for one thread. */
typedef struct dal_evaluator dal_evaluator;

/* Makes an evaluator with parameters[parameter_count]; the others have the system's values.  The
 * system must outlive it. [alloc]  Errors: DAL_NAME with the nearest name, DAL_NOT_FINITE, those of
 * prepare. */
dal_status dal_evaluator_create(dal_evaluator **evaluator, const dal_system *system,
                                const dal_setting *parameters, int parameter_count,
                                dal_error *error);
/* Frees an evaluator. */
void dal_evaluator_free(dal_evaluator *evaluator);
/* The system that is evaluated. */
const dal_system *dal_evaluator_system(const dal_evaluator *evaluator);
/* Calls a callback of the system at t, q[n], v[n + multipliers]; pi[n] is read by the adjoint alone
 * and may else be NULL.  Errors: DAL_UNSUPPORTED (callback is NULL), those of the callback. */
dal_status dal_evaluator_call(dal_evaluator *evaluator, dal_callback *callback, double t,
                              const double *q, const double *v, const double *pi, double *out);
/* The scales of D, E and the invariants at a point, out[m + 1 + invariants], see
 * dal_scale_callback; their absolute values where the system has no scales. */
dal_status dal_evaluator_scales(dal_evaluator *evaluator, double t, const double *q,
                                const double *v, double *out);
/* The start: out[2n + multipliers + 1] = q, v, g, e, with x, x', g1 and e replaced by
 * start[start_count], and then the velocities that it solves by those from D = 0 at t = 0.  It need
 * not satisfy the other constraints.  Errors: DAL_NAME, those of the system; of velocities that are
 * solved DAL_RANK, DAL_INCONSISTENT. */
dal_status dal_evaluator_start(dal_evaluator *evaluator, const dal_setting *start, int start_count,
                               double *out, dal_error *error);
/* The same of a start at the time t. */
dal_status dal_evaluator_start_at(dal_evaluator *evaluator, double t, const dal_setting *start,
                                  int start_count, double *out, dal_error *error);

/* A system in units of its own: lengths, a time and units of energy, constraints and invariants, in
 * which the numbers of its motion near the start are about 1.  All are powers of two, so that no
 * digit changes, and change with the units of the user as the quantities do.  The functions of
 * dalembert_analysis.h compare numbers with 1: of the scaled system they find the same in all
 * units. */
typedef struct dal_scaled dal_scaled;
/* Finds the units of spec->system by its motion from spec->start at start_time; a step, where one
 * is given, says the time where the motion does not.  The system must outlive it. [alloc]  Errors:
 * those of the parameters and of the start; DAL_MEMORY. */
dal_status dal_scaled_create(dal_scaled **scaled, const dal_run_spec *spec, dal_error *error);
/* Frees it and its system. */
void dal_scaled_free(dal_scaled *scaled);
/* The system in those units, with one lane, without series, quad precision and events. */
const dal_system *dal_scaled_system(const dal_scaled *scaled);
/* The units of time and of the coordinates, [1 + n]; those of velocities are their quotients. */
const double *dal_scaled_units(const dal_scaled *scaled);

#ifdef __cplusplus
}
#endif
#endif
