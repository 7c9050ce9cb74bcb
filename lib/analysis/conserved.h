/* conserved.h - which observables the exact motion of a run conserves. */
#ifndef DAL_CONSERVED_H
#define DAL_CONSERVED_H

#include "dalembert_run.h"

/* Finds which observables of a run of the spec the exact motion from its start is known to
 * conserve, conserved[observables]. [alloc]  Errors: DAL_STATUS_MEMORY. */
dal_status dal__find_conserved(const dal_run_spec *spec, const dal_run *run, bool *conserved,
                               dal_error *error);

#endif
