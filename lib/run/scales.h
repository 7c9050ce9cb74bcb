/* scales.h - the sizes of the terms that observables are made of. */
#ifndef DAL_SCALES_H
#define DAL_SCALES_H

#include "run/run.h"

/* Doubles that a run needs for its scales. */
size_t dal__scale_numbers(const dal__layout *layout);
/* The scales at observation i of those that are stored, in memory of the run; NULL, and *status
 * says why, where a callback failed. */
const double *dal__scales_observed(dal_run *run, int i, dal_status *status);
/* Whether the scales are due at observation number `observations`, from 1. */
bool dal__scales_due(long long observations);

#endif
