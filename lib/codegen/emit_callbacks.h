/* emit_callbacks.h - the programs of a system as C: dal_eval, the start, the observables. */
#ifndef DAL_EMIT_CALLBACKS_H
#define DAL_EMIT_CALLBACKS_H

#include "codegen/generation.h"

void dal__emit_callbacks(dal__generation *g);
void dal__write_start(dal__generation *g);
void dal__write_observe(dal__generation *g);

#endif
