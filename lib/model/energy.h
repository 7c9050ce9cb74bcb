/* energy.h - whether the energy is conserved, and its normal. */
#ifndef DAL_MODEL_ENERGY_H
#define DAL_MODEL_ENERGY_H

#include "dalembert_model.h"

/* Adds what is known of E to the properties. */
void dal__energy_properties(dal_model *model);
/* After the properties: the normal of a conserved energy, and F continued off D = 0. */
void dal__conserved_energy(dal_model *model);

#endif
