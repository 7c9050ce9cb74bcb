/* predict_steps.h - single steps of a method on the exact motion. */
#ifndef DAL_PREDICT_STEPS_H
#define DAL_PREDICT_STEPS_H

#include "dynamics/prediction.h"

/* Takes all single steps and adds them up, as far as the curve goes.  Errors: of the first
 * block. */
dal_status dal__predict_steps(dal__prediction_work *work);

#endif
