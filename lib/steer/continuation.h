/* continuation.h - from a motion to another target, by moving its end. */
#ifndef DAL_STEER_CONTINUATION_H
#define DAL_STEER_CONTINUATION_H

#include "steer/newton.h"

/* Finds a motion to the target in s from a motion to another one.  [alloc]  Errors:
 * DAL_STATUS_NOT_CONVERGED, what the observer returns, DAL_STATUS_MEMORY; the points are then of
 * the last motion. */
dal_status dal__continuation_solve(dal__shooting *s, dal__newton_result *result);

#endif
