/* check_invariants.h - what the motion conserves that the system file does not say. */
#ifndef DAL_CLI_CHECK_INVARIANTS_H
#define DAL_CLI_CHECK_INVARIANTS_H

#include "check_items.h"

/* How items about such an invariant begin; its name follows, and its formula is the text. */
#define CHECK_PROPOSED_INVARIANT "proposed invariant "

/* Adds an item for each invariant that depends neither on E nor on an invariant of the file, with a
 * name for its `invariants:` block, and one that says how many there are. */
void check_further_invariants(check *c);

/* How items about an integrable constraint begin; its number follows. */
#define CHECK_INTEGRABLE "constraint "
/* Adds an item for each constraint of velocities that is integrable, which proposes `holonomic:`,
 * with its integral where that is found. */
void check_integrable_constraints(check *c);

#endif
