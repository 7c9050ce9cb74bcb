/* gauge.h - multipliers and gauge generators. */
#ifndef DAL_LIFT_GAUGE_H
#define DAL_LIFT_GAUGE_H

#include "lift/classes.h"

/* Finds multipliers, generators and H on the surface.  Errors: as of dal__surface_clean. */
dal_status dal__gauge_find(dal__classes *classes, dal__chain *chain);

#endif
