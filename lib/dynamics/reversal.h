/* reversal.h - reversals of a motion, and whether they map it to itself. */
#ifndef DAL_REVERSAL_H
#define DAL_REVERSAL_H

#include "dynamics/local_change.h"
#include "dynamics/orbit.h"

/* The search for a reversal that maps the exact motion to itself and that the method preserves. */
typedef struct dal__reversals dal__reversals;

/* Begins a search about x, (q, v) at t, for a method of a run of spec on the physical space; *made
 * is NULL where there is none to be found. [alloc]  Errors: errors of runs, DAL_STATUS_MEMORY. */
dal_status dal__reversals_create(dal__reversals **made, dal__local *local, const dal_run_spec *spec,
                                 double t, const double *x, dal_error *error);
/* Frees it; NULL is allowed. */
void dal__reversals_free(dal__reversals *reversals);
/* Whether F depends on q_i, and not as on an angle. */
bool dal__reversals_depend(const dal__reversals *reversals, int i);
/* Searches near step k of the exact motion, which is at x at the time t, and sets even[count] of
 * the observables whose mean rate is 0 by a reversal.  true: nothing remains to search. */
bool dal__reversals_meet(dal__reversals *reversals, dal__orbit *orbit, long long k, double t,
                         const double *x, bool *even);

#endif
