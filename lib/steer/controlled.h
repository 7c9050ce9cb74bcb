/* controlled.h - in how many directions controls move motions. */
#ifndef DAL_STEER_CONTROLLED_H
#define DAL_STEER_CONTROLLED_H

#include "dalembert_model.h"

/* In how many directions of (q, v) controls move motions, about generic ones on D = 0 near the
 * start, see controlled.c; -1: brackets are too large.  units[1 + 2n] of t, q and v say how far the
 * points are.  The effort is controls.  Errors: DAL_STATUS_NAME, DAL_STATUS_SINGULAR,
 * DAL_STATUS_NOT_FINITE, DAL_STATUS_MEMORY, DAL_STATUS_TOO_LARGE. */
dal_status dal__controlled_rank(dal_model *model, const dal_setting *parameters,
                                int parameter_count, const double *units, int *rank,
                                dal_error *error);

#endif
