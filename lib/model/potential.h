/* potential.h - the potential, for discrete gradients. */
#ifndef DAL_MODEL_POTENTIAL_H
#define DAL_MODEL_POTENTIAL_H

#include "dalembert.h"

/* Derives what a discrete gradient needs, where W is constant.  Errors: DAL_MEMORY,
 * DAL_TOO_LARGE. */
dal_status dal__potential(dal_model *model);

#endif
