/* saved.h - whether numbers can be those of a saved run. */
#ifndef DAL_RUN_SAVED_H
#define DAL_RUN_SAVED_H

#include "run/run.h"

/* Checks the numbers of a checkpoint of a run, memory[stored].  Errors: DAL_NOT_FINITE,
 * DAL_ARGUMENT. */
dal_status dal__check_saved(const dal_run *run, const double *memory, dal_error *error);

#endif
