/* consistent.h - velocities on D = 0 by the least change in the mass metric. */
#ifndef DAL_RUN_CONSISTENT_H
#define DAL_RUN_CONSISTENT_H

#include "run/run.h"

/* An equation normal.v = value for the velocities, beside D = 0. */
typedef struct dal__condition {
    const double *normal, *lifted; /* [n]: the normal, and W^-1 times it */
    double value;
} dal__condition;

/* Replaces the velocities u of the present state by those, v, on D(q,v,t) = 0 and, unless it is
 * NULL, the condition, for which (v - u).W (v - u) is stationary: Newton's method, of one step
 * where D is linear.  place: that state in messages.  Errors, and then v is not defined:
 * DAL_RANK, DAL_INCONSISTENT (no such v is found near u), DAL_UNSUPPORTED (W has no inverse), those
 * of the constraints. */
dal_status dal__make_consistent(dal_run *run, const dal__condition *condition, const char *place,
                                dal_error *error);

#endif
