/* predict_sums.h - what the steps of a run change, added up. */
#ifndef DAL_PREDICT_SUMS_H
#define DAL_PREDICT_SUMS_H

#include "dynamics/prediction.h"

/* Adds up what step i of a block, number k of all, changes along the run.  Errors: as of
 * dal__local_pull. */
dal_status dal__predict_add_step(dal__prediction_work *work, long long k, int i);
/* Appends the present sums to the curve. */
void dal__predict_add_row(dal__prediction_work *work, double t);

#endif
