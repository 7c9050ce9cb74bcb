/* dirac.h - Dirac's procedure for any theory. */
#ifndef DAL_LIFT_DIRAC_H
#define DAL_LIFT_DIRAC_H

#include "lift/theory.h"

/* Dirac's procedure for a theory, of which parts and memory are the pool's.  *dirac is freed with
 * dal_dirac_free, and owns the pool's memory from then on. [alloc]  Errors: as of
 * dal__surface_clean. */
dal_status dal__dirac_run(dal_dirac **dirac, const dal__theory *theory, dal__pool *pool);

#endif
