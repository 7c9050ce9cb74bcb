/* reach.h - what can be reached, and what of it a motion reaches. */
#ifndef DAL_STEER_REACH_H
#define DAL_STEER_REACH_H

#include "steer/shooting.h"

/* Fills growth and allowed of a steering.  Errors: DAL_STATUS_MEMORY. */
dal_status dal__reach_find(dal__problem *p, dal_steering *out);
/* Fills rank and conjugate times by the derivatives of an extremal in pieces. [alloc]  Errors:
 * DAL_STATUS_MEMORY. */
dal_status dal__reach_measure(const dal__shooting *s, dal_extremal *out);

#endif
