/* scaled.h - evaluators of the system of a run. */
#ifndef DAL_ANALYSIS_SCALED_H
#define DAL_ANALYSIS_SCALED_H

#include "dalembert_analysis.h"

/* An evaluator of the system of a run, or of that system scaled, with the parameters of the run.
 * [alloc] */
dal_status dal__evaluator_of_run(dal_evaluator **evaluator, const dal_scaled *scaled,
                                 const dal_run *run, dal_error *error);

#endif
