/* native_text.h - the files that are compiled for runs and batches. */
#ifndef DAL_NATIVE_TEXT_H
#define DAL_NATIVE_TEXT_H

#include "codegen/generate.h"

#define DAL__NATIVE_PREFIX "dal_native"
/* The steps alone, DAL__LANES or DAL__TRACE: the function PREFIX_lanes or _traced.
 * Takes nothing from the parameters and the start of the spec. [alloc] */
dal_status dal__generate_native(const dal_run_spec *spec, dal__product product, int lanes,
                                char **text, dal_error *error);
/* The observables of a run of this layout, wherever it stands: the function
 * PREFIX_observables. [alloc] */
dal_status dal__generate_observables(const dal__layout *layout, const dal_run *run, char **text,
                                     dal_error *error);

#endif
