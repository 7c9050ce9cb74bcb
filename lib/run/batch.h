/* batch.h - batches for compiled code and ensembles, and batches of one variant for tests. */
#ifndef DAL_BATCH_H
#define DAL_BATCH_H

#include "dalembert_batch.h"
#include "run/run.h"

/* As dal_batch_create, all blocks of this variant (DAL__VARIANTS: chosen as there).
 * Errors: also DAL_STATUS_UNSUPPORTED, when machine, system or integrator lack the variant. */
dal_status dal__batch_of_variant(dal_batch **batch, const dal_run_spec *spec, int count, int width,
                                 dal__variant only, dal_error *error);

/* As dal_batch_start, for a lane whose start is the settings' with numbers added to it,
 * [dimension] or NULL; and what its status is where it has no start. */
dal_status dal__batch_start_varied(dal_batch *batch, int lane, const dal_setting *parameters,
                                   int parameter_count, const dal_setting *start, int start_count,
                                   const double *added, dal_error *error);
void dal__batch_refuse(dal_batch *batch, int lane, const dal_error *reason);

/* The run that makes the starts. */
const dal_run *dal__batch_scalar(const dal_batch *batch);

/* The layout of the batch; how many of its lanes compiled code should step together. */
const dal__layout *dal__batch_layout(const dal_batch *batch);
int dal__batch_native_lanes(const dal_batch *batch);

/* Steps that number of lanes together by compiled code from now on.  The batch then owns the code
 * where that has a release.  Errors: DAL_STATUS_MEMORY; the batch is unchanged. */
dal_status dal__batch_install(dal_batch *batch, int lanes, const dal__native_code *native,
                              dal_error *error);

#endif
