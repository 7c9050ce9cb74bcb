/* potential.h - the potential, for discrete gradients. */
#ifndef DAL_MODEL_POTENTIAL_H
#define DAL_MODEL_POTENTIAL_H

#include "dalembert_model.h"

/* What a discrete gradient needs of the potential, where W is constant.  Errors: DAL_STATUS_MEMORY,
 * DAL_STATUS_TOO_LARGE. */
dal_status dal__potential(dal_model *model);

#endif
