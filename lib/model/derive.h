/* derive.h - the equations of motion of a model, from its formulas. */
#ifndef DAL_MODEL_DERIVE_H
#define DAL_MODEL_DERIVE_H

#include "model/model.h"

/* Derives everything but the given formulas.  Errors: DAL_STATUS_RANK, DAL_STATUS_SINGULAR_MASS,
 * DAL_STATUS_UNSUPPORTED, DAL_STATUS_TOO_LARGE. */
dal_status dal__equations_derive(dal_model *model, dal_error *error);
/* h [m], then R = B^T h [n]; out begins as 0s. */
void dal__list_reactions(const dal__equations *e, dal__node *out);
/* Replaces h and R = B^T h in invariants and events by their formulas, whose nodes are made where
 * they are used alone. */
void dal__insert_reactions(dal_model *model);

#endif
