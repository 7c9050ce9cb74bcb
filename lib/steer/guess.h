/* guess.h - from a first guess to a motion. */
#ifndef DAL_STEER_GUESS_H
#define DAL_STEER_GUESS_H

#include "steer/newton.h"

enum { DAL__STEER_PIECES = 24 /* of a motion, at most */ };

/* From the guess p->guess to a motion in s, by a coarse grid where there are enough steps.  Errors:
 * DAL_STATUS_NOT_CONVERGED, what the observer returns, DAL_STATUS_MEMORY, errors of a step; the
 * points are then the last ones. */
dal_status dal__guess_solve(dal__shooting *s, dal__newton_result *result);

#endif
