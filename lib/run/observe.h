/* observe.h - a run within its next step. */
#ifndef DAL_RUN_OBSERVE_H
#define DAL_RUN_OBSERVE_H

#include "run/run.h"

/* Advances a run by a part of a step of size h, calls an observer and goes back; the same as
 * dal_run_intermediate does. */
dal_status dal__observe_part(dal_run *run, double h, double part,
                             dal_status (*observe)(void *user, dal_run *run), void *user,
                             dal_error *error);

#endif
