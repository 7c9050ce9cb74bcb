/* batch.h - the inside of batches for native mode, and batches of one chosen variant for tests. */
#ifndef DAL_BATCH_H
#define DAL_BATCH_H

#include "run/run.h"

/* As dal_batch_create, all blocks of this variant (DAL__VARIANTS: chosen as there).
 * Errors: also DAL_UNSUPPORTED, when machine, system or integrator lack the variant. */
dal_status dal__batch_create(dal_batch **batch, const dal_run_spec *spec, int count, int width,
                             dal__variant only, dal_error *error);

/* What the batch is, and how many of its lanes are best stepped together by compiled code. */
const dal__layout *dal__batch_layout(const dal_batch *batch);
int dal__batch_native_lanes(const dal_batch *batch);

/* From now on lanes of the batch are stepped together by compiled code, which then is the batch's.
 * Errors: DAL_MEMORY; the batch is as before, and the code the caller's. */
dal_status dal__batch_install(dal_batch *batch, int lanes, const dal__native *native,
                              dal_error *error);

#endif
