/* properties.h - what the formulas say about constraints and motion. */
#ifndef DAL_MODEL_PROPERTIES_H
#define DAL_MODEL_PROPERTIES_H

#include "dalembert_model.h"

/* Sets the properties of the equations. */
void dal__properties(dal_model *model);
/* Collects the guards of the constraints and of the mass matrix.  Errors: DAL_STATUS_TOO_LARGE
 * (too many). */
dal_status dal__guards(dal_model *model);

#endif
