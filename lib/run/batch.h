/* batch.h - batches of one chosen variant, for tests; internal to lib/run. */
#ifndef DAL_BATCH_H
#define DAL_BATCH_H

#include "run/run.h"

/* As dal_batch_create, all blocks of this variant (DAL__VARIANTS: chosen as there).
 * Errors: also DAL_UNSUPPORTED, when machine, system or integrator lack the variant. */
dal_status dal__batch_create(dal_batch **batch, const dal_run_spec *spec, int count, int width,
                             dal__variant only, dal_error *error);

#endif
