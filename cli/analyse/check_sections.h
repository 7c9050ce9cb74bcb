/* check_sections.h - the sections of the report of `dalembert check`. */
#ifndef DAL_CLI_CHECK_SECTIONS_H
#define DAL_CLI_CHECK_SECTIONS_H

#include "check.h"

/* Each prints items, or none where it does not apply to the system. */
void check_start(check *c);
void check_constraints(check *c);
void check_energy(check *c);
void check_reversal(check *c);
void check_derivatives(check *c);
void check_exact(check *c);
void check_algebra(check *c);
void check_action(check *c);

#endif
