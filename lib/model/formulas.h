/* formulas.h - from the texts of a model to nodes. */
#ifndef DAL_MODEL_FORMULAS_H
#define DAL_MODEL_FORMULAS_H

#include "model/model.h"

/* Parses all entries into nodes and evaluates the default parameters and start.  Errors:
 * DAL_STATUS_SYNTAX, DAL_STATUS_NAME, DAL_STATUS_MODEL, DAL_STATUS_RANK (more constraints than
 * coordinates), DAL_STATUS_MEMORY, DAL_STATUS_TOO_LARGE. */
dal_status dal__parse_model(dal_model *model, dal_error *error);
/* Parses the formulas that are observed alone, once all else has its nodes: operands are ordered by
 * the numbers of nodes, and so the bits of a trajectory stay. */
dal_status dal__parse_observed(dal_model *model, dal_error *error);
/* Parses the section equations, S(q, q', q'') with q'' in the places of pi, to out. */
dal_status dal__parse_motion_equations(dal_model *model, dal__node *out, dal_error *error);

#endif
