/* start.h - parameters and start of a run. */
#ifndef DAL_START_H
#define DAL_START_H

#include "run/run.h"

/* Lets the next step be the method's first. */
void dal__restart_method(dal_run *run);
/* Sets parameters and the start at its time, adds numbers to that, added[dim] or NULL, and checks
 * them. */
dal_status dal__run_start(dal_run *run, const dal_setting *parameters, int parameter_count,
                          const dal_setting *start, int start_count, const double *added,
                          dal_error *error);
/* dal_run_set_parameter of a run whose events do not matter; the parameter was changed where it
 * returns DAL_STATUS_OK or DAL_STATUS_INCONSISTENT. */
dal_status dal__change_parameter(dal_run *run, const char *name, double value, dal_error *error);

#endif
