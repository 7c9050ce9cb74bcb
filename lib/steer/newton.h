/* newton.h - Newton's method on multiple shooting. */
#ifndef DAL_STEER_NEWTON_H
#define DAL_STEER_NEWTON_H

#include "steer/border.h"

/* What the last iteration was like. */
typedef struct dal__newton_result {
    double residual; /* the largest jump, or distance from the ends, relative */
    double condition;
} dal__newton_result;

/* Moves the points of s until the pieces are one motion between the ends: damped by the natural
 * monotonicity test (Deuflhard 2004, Newton Methods for Nonlinear Problems, ch. 3).  [alloc]
 * Errors: DAL_STATUS_NOT_CONVERGED, what the observer returns, DAL_STATUS_MEMORY; the points are
 * then the last ones. */
dal_status dal__newton(dal__shooting *s, dal__newton_result *result);
/* The residual of the points as they are.  Errors: likewise. */
dal_status dal__newton_measure(dal__shooting *s, dal__newton_result *result);

#endif
