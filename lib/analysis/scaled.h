/* scaled.h - states in the units of a scaled system, and in the units of the user. */
#ifndef DAL_SCALED_H
#define DAL_SCALED_H

#include "dalembert_analysis.h"

/* (q, v, g), [n + n + multipliers], in units of the system's own. */
void dal__scaled_from_user(const dal_scaled *scaled, const double *state, double *out);
/* The same in the units of the user. */
void dal__scaled_to_user(const dal_scaled *scaled, const double *state, double *out);

#endif
