/* orbit.h - the exact motion from the start of a run, at any time within its steps. */
#ifndef DAL_ORBIT_H
#define DAL_ORBIT_H

#include "dalembert_predict.h"

/* The exact motion on D = 0, (q, v), at times that ascend. */
typedef struct dal__orbit dal__orbit;

/* Makes the exact motion from the state of a run of spec; from a motion that others read, too, or
 * NULL. [alloc]  Errors: as of runs. */
dal_status dal__orbit_create(dal__orbit **orbit, const dal_run_spec *spec, const dal_run *run,
                             dal_exact_motion *motion, dal_error *error);
/* Frees it; NULL is allowed. */
void dal__orbit_free(dal__orbit *orbit);
/* Whether it is by Taylor series, in steps of its own. */
bool dal__orbit_has_series(const dal__orbit *orbit);
/* Gives (q, v) at the time of step k + fraction, 0 <= fraction <= 1, in out[2n]; k must not
 * descend, the fraction may within a step, and is 0 at first.  Errors: as of a step. */
dal_status dal__orbit_state(dal__orbit *orbit, long long k, double fraction, double *out,
                            dal_error *error);

#endif
