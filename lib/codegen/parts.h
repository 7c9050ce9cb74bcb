/* parts.h - which parts of the kernel a generated file has, and their text.
 *
 * A file has the parts that its integrators declare (DAL_KERNEL_*), and what these use.  Inside a
 * part, lines #if and #ifdef with names that are known here are decided here, so that what is not
 * needed does not reach the file; the compiler decides all others. */
#ifndef DAL_CODEGEN_PARTS_H
#define DAL_CODEGEN_PARTS_H

#include "codegen/generation.h"

/* The parts that all layers of the method declare, with those that they use. */
unsigned dal__kernel_of(const dal_method *method);
/* Adds the parts that the given ones use. */
unsigned dal__kernel_closure(unsigned parts);
/* The file of an integrator of the library and its identifier there; false: it is another's. */
bool dal__find_source(const dal_integrator *integrator, const char **identifier, const char **text);

/* Writes a source of the library by its name; the word PREFIX becomes the prefix of the file. */
void dal__write_source(dal__generation *g, const char *name);
/* The same for a text. */
void dal__write_selected(dal__generation *g, const char *text);
/* Writes a text, with the prefix for the word PREFIX, as it is. */
void dal__write_template(dal__generation *g, const char *text);
/* Writes an item of a list after the others, on a line of its own where theirs is full. */
void dal__write_item(dal__generation *g, const char *item);
/* Writes the parts of the kernel. */
void dal__write_kernel(dal__generation *g);

#endif
