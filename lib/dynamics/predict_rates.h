/* predict_rates.h - mean rates and random walks of predicted changes. */
#ifndef DAL_PREDICT_RATES_H
#define DAL_PREDICT_RATES_H

#include "dynamics/prediction.h"

/* Finds rates and walks.  Errors: DAL_STATUS_UNSUPPORTED, the motion is on an attractor. */
dal_status dal__predict_results(dal__prediction_work *work);

#endif
