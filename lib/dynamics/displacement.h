/* displacement.h - how far the steps of a run lead away from the exact motion. */
#ifndef DAL_DISPLACEMENT_H
#define DAL_DISPLACEMENT_H

#include "dynamics/local_change.h"

/* The displacement of a run from the exact motion, to first order. */
typedef struct dal__displacement dal__displacement;

/* Makes one for the steps of local; tau is the unit of time. [alloc]  Errors: DAL_STATUS_MEMORY. */
dal_status dal__displacement_create(dal__displacement **made, dal__local *local, double tau,
                                    dal_error *error);
/* Frees it; NULL is allowed. */
void dal__displacement_free(dal__displacement *displacement);
/* Adds step number k, from 0, which begins on the exact motion at x[2n] and ends at end[2n]. Gives
 * the largest displacement so far, in units, of the components for which counts[2n] is true; NaN
 * where F has no value. */
double dal__displacement_add(dal__displacement *displacement, long long k, double t,
                             const double *x, const double *end, const bool *counts);

#endif
