/* dalembert_sensitivity.h - derivatives of a run by its start and its parameters.
 *
 * The conventions of dalembert.h hold here. */
#ifndef DALEMBERT_SENSITIVITY_H
#define DALEMBERT_SENSITIVITY_H

#include "dalembert_model.h"
#include "dalembert_run.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Columns S_k = d state/d x_k along a run, where x_k is a parameter or a component of the start.
 * With z' = step(z, x) they are moved by the exact derivative of the numerical step,
 *
 *     S_k' = step_z S_k + step_x_k,
 *
 * by the method itself on the tangent systems of the model (dal_model_tangent_by), not by the
 * derivative of the motion: they are what differences of runs converge to, to rounding and to the
 * error of an implicit method's solver.  A component of the start is varied by itself, so that a
 * column may lead off D = 0; a parameter is varied with all components of the start that the run
 * does not set and that the system makes from it. */
typedef struct dal_sensitivity dal_sensitivity;

/* Makes count columns by names[count], parameters or "x", "x'", "p_x", "pi_x", at the start of a
 * run of spec, whose system is the model's.  [alloc]  Errors: as for a run and for
 * dal_model_tangent_by; DAL_STATUS_ARGUMENT (count, a system of another model);
 * DAL_STATUS_UNSUPPORTED, and the message says the reason: a method whose step has no exact tangent
 * here (it enforces D or E, uses more of the system than F, or passes multipliers or accelerations
 * from step to step), a tolerance, extend-energy, events, a projection to holonomic constraints, a
 * start that is solved or made consistent, mu_e that is not of t alone off p = pi = 0, and e, by
 * which there is no derivative. */
dal_status dal_sensitivity_create(dal_sensitivity **sensitivity, dal_model *model,
                                  const dal_run_spec *spec, const char *const *names, int count,
                                  dal_error *error);
/* Frees the columns. */
void dal_sensitivity_free(dal_sensitivity *sensitivity);

/* Advances the columns to time t, which is not before the time of the last call by more than a
 * step: by whole steps of the run, and by a shorter one that leaves them where they were, as
 * dal_run_intermediate.  Errors: as for a step; DAL_STATUS_ARGUMENT (t). */
dal_status dal_sensitivity_advance(dal_sensitivity *sensitivity, double t, dal_error *error);

/* The number of columns. */
int dal_sensitivity_count(const dal_sensitivity *sensitivity);
/* Numbers in a column, the dimension of the run. */
int dal_sensitivity_dimension(const dal_sensitivity *sensitivity);
/* Whether momenta have derivatives: false where p = pi = 0 all along, and their derivatives are
 * 0. */
bool dal_sensitivity_is_lifted(const dal_sensitivity *sensitivity);
/* Column k, from 0, at the time of the last call: the derivatives [dimension] of the components of
 * dal_run_state; NULL past the last. */
const double *dal_sensitivity_column(const dal_sensitivity *sensitivity, int k);

/* All that passes from one step to the next, *count doubles: a checkpoint. */
const double *dal_sensitivity_save(dal_sensitivity *sensitivity, size_t *count);
/* Restores a copy, saved[count], into columns of the same spec and names, which then continue with
 * the same bits.  Errors: as for dal_run_restore; DAL_STATUS_ARGUMENT (a wrong count). */
dal_status dal_sensitivity_restore(dal_sensitivity *sensitivity, const double *saved, size_t count,
                                   dal_error *error);

#ifdef __cplusplus
}
#endif
#endif
