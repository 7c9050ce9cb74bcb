/* atoms.h - the factors from which invariants are made, and their products. */
#ifndef DAL_INVARIANTS_ATOMS_H
#define DAL_INVARIANTS_ATOMS_H

#include "invariants/search.h"

/* Adds the atoms that the equations of motion contain, and the further ones of the settings.
 * Memory is the model's.  Errors: as of dal_find_invariants. */
dal_status dal__search_atoms(dal__search *search, const dal_invariants_settings *settings,
                             dal_error *error);
/* Removes the atoms that depend on one of the symbols from first to end - 1. */
void dal__search_remove(dal__search *search, int first, int end);
/* Makes their products.  Errors: DAL_STATUS_TOO_LARGE, DAL_STATUS_MEMORY. */
dal_status dal__search_products(dal__search *search, dal_error *error);
/* df/dt along the motion; f is a node of the model. */
dal__node dal__search_rate(const dal__equations *e, dal__node f);
/* The divergence tr F_v. */
dal__node dal__search_divergence(const dal__equations *e);
/* Parses a formula of a user, or of the search; number: of the formula, for an error. */
dal_status dal__search_parse(dal_model *model, const char *text, int number, dal__node *node,
                             dal_error *error);

#endif
