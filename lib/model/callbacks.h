/* callbacks.h - the callbacks of a model's system. */
#ifndef DAL_MODEL_CALLBACKS_H
#define DAL_MODEL_CALLBACKS_H

#include "model/programs.h"

/* Sets the callbacks that need one lane only. */
void dal__fill_single_callbacks(dal__programs *programs, dal_system *system);

/* Sets *call to the callbacks of a variant; what runs its programs. */
#define DAL__CALLBACKS(name, variant, lanes, set)                                                  \
    dal__run_program *name##_##variant(const dal__programs *programs, dal_callbacks *call);
DAL__CALLBACKS(dal__fill_callbacks, x1, 1, BASE)
DAL__VARIANT_LIST(DAL__CALLBACKS, dal__fill_callbacks)

#endif
