/* expand.h - entries that stand for many: sizes, indices, ranges. */
#ifndef DAL_MODEL_EXPAND_H
#define DAL_MODEL_EXPAND_H

#include "model/model.h"

/* Evaluates the sizes, and makes of every given entry with an index or a range the entries that it
 * means:
 *
 *     x[1..N]                          x1, x2, ...
 *     x[i] with "for i = 1..N: ..."    an entry for each i, i being known in its formula
 *     x[N]                             one name
 *     an event with for: i = 1..N      an event for each i, i being known in its formulas
 *
 * Errors: DAL_STATUS_SYNTAX and DAL_STATUS_NAME with place, DAL_STATUS_MODEL, DAL_STATUS_TOO_LARGE,
 * DAL_STATUS_MEMORY. */
dal_status dal__expand(dal_model *model, dal_error *error);

#endif
