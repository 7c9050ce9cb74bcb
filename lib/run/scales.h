/* scales.h - the sizes of the terms that observables are made of. */
#ifndef DAL_SCALES_H
#define DAL_SCALES_H

#include "run/run.h"

/* Doubles that a run needs for its scales. */
size_t dal__scale_numbers(const dal__layout *layout);
/* The scales at observation i of those that are stored, in memory of the run; NULL, and *status
 * says why, where a callback failed. */
const double *dal__scales_observed(dal_run *run, int i, dal_status *status);
/* The number of the observation at which scales are due next, after this many. */
long long dal__scales_due(long long observations);
/* The scales of the constraints at the present state, [m] in memory of the run, where the system
 * has scales; NULL: it has none, or they have no values. */
const double *dal__constraint_scales(dal_run *run);

#endif
