/* reference.h - the exact motion of a run, to rounding. */
#ifndef DAL_REFERENCE_H
#define DAL_REFERENCE_H

#include "dalembert_evaluator.h"

/* The exact motion from the start of a run, beside that run. */
typedef struct dal__reference dal__reference;

/* Makes a run of dop853 on (q, v, g) in the units of scaled, from the state of a run of spec and by
 * steps of its size; state, [its dimension], is the start in these units. [alloc]  Errors: as of
 * runs. */
dal_status dal__create_reference_run(dal_run **reference, const dal_scaled *scaled,
                                     const dal_run_spec *spec, const dal_run *run, double *state,
                                     dal_error *error);
/* Makes the motion of a spec, at its start. [alloc]  Errors: as of runs; DAL_STATUS_UNSUPPORTED: p
 * and pi are not 0, so that they move (q, v), too. */
dal_status dal__reference_create(dal__reference **reference, const dal_run_spec *spec,
                                 dal_error *error);
/* Frees it; NULL is allowed. */
void dal__reference_free(dal__reference *reference);
/* Goes on by steps of the spec.  Errors: as of a step. */
dal_status dal__reference_advance(dal__reference *reference, long long steps, dal_error *error);
/* Its substeps so far. */
long long dal__reference_steps(const dal__reference *reference);
/* A run of the spec that is at the present state of the exact motion, for its observables. */
dal_run *dal__reference_run(dal__reference *reference);

/* Whether p and pi of a run are 0, so that (q, v) is the motion; without them it is. */
bool dal__is_on_motion(const dal_run *run);
/* The method of a name that the library has. */
dal_method dal__library_method(const char *name);

#endif
