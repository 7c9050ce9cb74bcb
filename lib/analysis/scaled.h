/* scaled.h - states in units of a scaled system or the user; evaluators of a run's system. */
#ifndef DAL_ANALYSIS_SCALED_H
#define DAL_ANALYSIS_SCALED_H

#include "dalembert_evaluator.h"

/* (q, v, g), [n + n + multipliers], in units of the system's own. */
void dal__scaled_from_user(const dal_scaled *scaled, const double *state, double *out);
/* The same in the units of the user. */
void dal__scaled_to_user(const dal_scaled *scaled, const double *state, double *out);

/* An evaluator of the system of a run, or of that system scaled, with the parameters of the run.
 * [alloc] */
dal_status dal__evaluator_of_run(dal_evaluator **evaluator, const dal_scaled *scaled,
                                 const dal_run *run, dal_error *error);

#endif
