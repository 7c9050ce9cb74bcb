/* failure.h - the reason why a step failed. */
#ifndef DAL_FAILURE_H
#define DAL_FAILURE_H

#include "run/run.h"

/* Finds the reason why a step of size h failed with status, fills *error and returns its
 * status. */
dal_status dal__failure_reason(dal_run *run, double h, dal_status status, dal_error *error);

#endif
