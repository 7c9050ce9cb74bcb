/* formulas.h - from the texts of a model to nodes. */
#ifndef DAL_MODEL_FORMULAS_H
#define DAL_MODEL_FORMULAS_H

#include "model/model.h"
#include "model/symbols.h"

/* Parses all entries into nodes and evaluates the default parameters and start.  Errors:
 * DAL_SYNTAX, DAL_NAME, DAL_MODEL, DAL_RANK (more constraints than coordinates), DAL_MEMORY,
 * DAL_TOO_LARGE. */
dal_status dal__parse_model(dal_model *model, dal_error *error);
/* Parses the formulas that are observed alone, once all else has its nodes: operands are ordered by
 * the numbers of nodes, and so the bits of a trajectory stay. */
dal_status dal__parse_observed(dal_model *model, dal_error *error);
/* How messages call the formula of an entry: "force on x", "constraint 2". */
void dal__entry_title(const dal_model *model, const dal__entry *entry, char *title, size_t size);

/* Parses the text of an entry; the message of an error gets the entry's name and place. */
dal_status dal__parse_entry(dal_model *model, const dal__entry *entry, dal__scope scope,
                            dal__node *node, dal_error *error);
/* The error that the value of an entry is not finite. */
dal_status dal__not_finite(const dal_model *model, const dal__entry *entry, dal_error *error);
/* All parameters and lets, and what else a formula may contain: DAL__MAY_T | ... */
dal__scope dal__scope_of(const dal__equations *e, unsigned may);
/* Finds the index of a word in a list; what: how a message calls it. */
dal_status dal__find_word(const char *word, int line, int column, const char *what,
                          const char *const *words, int count, int *i, dal_error *error);

#endif
