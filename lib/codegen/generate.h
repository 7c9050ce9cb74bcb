/* generate.h - one C file from the spec of a run.
 *
 * A generated file is the kernel and the integrator as they stand in the library, compiled with
 * constant dimensions (DAL_SPECIALISED), with the programs of the system as straight-line code. */
#ifndef DAL_GENERATE_H
#define DAL_GENERATE_H

#include "codegen/generation.h"

/* Decides what lines #if of the sources depend on; adds the parts of the kernel that the system
 * needs. */
void dal__decide_conditions(dal__generation *g);
/* Checks the spec, and sets layout, programs, sources and prefix. */
dal_status dal__generation_check(dal__generation *g, const char *prefix, dal_error *error);
dal_status dal__generation_finish(dal__generation *g, char **text, dal_error *error);
/* The pragmas that keep a compiler exact; kernel, system, method and steps. */
void dal__write_compiler(dal__generation *g);
/* The one rule for loops over components: unrolled, or vectors. */
void dal__write_unrolling(dal__generation *g);
void dal__write_steps(dal__generation *g);

#endif
