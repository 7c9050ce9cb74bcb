/* guards.h - expressions that must keep their signs along a run. */
#ifndef DAL_MODEL_GUARDS_H
#define DAL_MODEL_GUARDS_H

#include "dalembert.h"

/* Collects the guards of the constraints and of the mass matrix.  Errors: DAL_MEMORY,
 * DAL_TOO_LARGE. */
dal_status dal__guards(dal_model *model);

#endif
