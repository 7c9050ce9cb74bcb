/* check_dirac.h - what Dirac's procedure finds for the lift of a system. */
#ifndef DAL_CLI_CHECK_DIRAC_H
#define DAL_CLI_CHECK_DIRAC_H

#include "check_items.h"

/* Adds the items of the procedure. */
void check_dirac(check *c);

#endif
