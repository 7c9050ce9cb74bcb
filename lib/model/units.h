/* units.h - the sizes of the symbols of a model, for points at which formulas are compared. */
#ifndef DAL_MODEL_UNITS_H
#define DAL_MODEL_UNITS_H

#include "model/model.h"

/* The units of t, q, v and g, unit[symbols], about the default start; of all other symbols 1.
 * Errors: DAL_STATUS_MEMORY. */
dal_status dal__model_units(dal_model *model, double *unit);

/* Finds units[n + nw + m + 1] of dal_system for a system of the model, which has its programs.
 * Errors: DAL_STATUS_MEMORY. */
dal_status dal__system_units(dal_model *model, const dal_system *system, double *units);

#endif
