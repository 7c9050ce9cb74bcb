/* parts.h - which parts of the kernel a generated file has, and their text.
 *
 * A file has the parts that its integrators declare (DAL_KERNEL_*), and what these use, each as the
 * preprocessor leaves it. */
#ifndef DAL_CODEGEN_PARTS_H
#define DAL_CODEGEN_PARTS_H

#include "codegen/generation.h"

/* The parts that all layers of the method declare, with those that they use. */
unsigned dal__kernel_of(const dal_method *method);
/* Adds the parts that the given ones use. */
unsigned dal__kernel_closure(unsigned parts);
/* The file of an integrator of the library and its identifier there; false: it is another's. */
bool dal__find_source(const dal_integrator *integrator, const char **identifier, const char **text);

/* Writes a source of the library, preprocessed, by its name. */
void dal__write_source(dal__generation *g, const char *name);
/* Writes the parts of the kernel. */
void dal__write_kernel(dal__generation *g);

#endif
