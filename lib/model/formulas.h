/* formulas.h - from the texts of a model to nodes. */
#ifndef DAL_MODEL_FORMULAS_H
#define DAL_MODEL_FORMULAS_H

#include "model/model.h"

/* Parses all entries into nodes and evaluates the default parameters and start.  Errors:
 * DAL_SYNTAX, DAL_NAME, DAL_MODEL, DAL_RANK (more constraints than coordinates), DAL_MEMORY,
 * DAL_TOO_LARGE. */
dal_status dal__parse_model(dal_model *model, dal_error *error);
/* How messages call the formula of an entry: "force on x", "constraint 2". */
void dal__entry_title(const dal_model *model, const dal__entry *entry, char *title, size_t size);

#endif
