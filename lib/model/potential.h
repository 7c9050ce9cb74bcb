/* potential.h - the potential, for discrete gradients. */
#ifndef DAL_MODEL_POTENTIAL_H
#define DAL_MODEL_POTENTIAL_H

#include "dalembert_model.h"

/* What a discrete gradient needs of the potential, where W is constant. */
void dal__potential(dal_model *model);

#endif
