/* check_methods.h - which integrators `run` accepts for a system, and what they preserve of it. */
#ifndef DAL_CLI_CHECK_METHODS_H
#define DAL_CLI_CHECK_METHODS_H

#include "check_items.h"

/* Adds the item of the integrators that have one of these properties and that `run` accepts; with
 * constant coefficients D is preserved by all of them. */
void check_preserving(check *c, bool is_constant, unsigned properties);
/* Adds the items of all integrators: accepted, refused and why, and what they preserve. */
void check_methods(check *c);

#endif
