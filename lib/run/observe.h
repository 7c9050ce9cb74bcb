/* observe.h - a run within its next step. */
#ifndef DAL_RUN_OBSERVE_H
#define DAL_RUN_OBSERVE_H

#include "run/run.h"

/* Advances a run by `size` within a step h, calls an observer and goes back; the same as
 * dal_run_intermediate does. */
dal_status dal__observe_intermediate(dal_run *run, double h, double size,
                                     dal_status (*observe)(void *user, dal_run *run), void *user,
                                     dal_error *error);

#endif
