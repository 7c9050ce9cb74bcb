/* units.h - values and sizes of the symbols of a model, for points at which formulas are
 * compared. */
#ifndef DAL_MODEL_UNITS_H
#define DAL_MODEL_UNITS_H

#include "model/model.h"

/* The units of t, q, v and g, unit[symbols], about the default start; of all other symbols 1. */
void dal__model_units(dal_model *model, double *unit);

/* The values of all symbols at the default start, value[symbols], with the parameters.  Errors:
 * DAL_STATUS_MEMORY, DAL_STATUS_NAME, DAL_STATUS_NOT_FINITE. */
dal_status dal__start_values(dal_model *model, const dal_setting *parameters, int parameter_count,
                             double **value, dal_error *error);
/* The given units[1 + n] of t and q, or where there are none units of 1; NULL: out of memory. */
const double *dal__complete_units(dal_model *model, const double *units);

/* Finds units[n + nw + m + 1] of dal_system for a system of the model, which has its programs. */
void dal__system_units(dal_model *model, const dal_system *system, double *units);

#endif
