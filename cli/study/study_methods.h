/* study_methods.h - the integrators of a case. */
#ifndef DAL_CLI_STUDY_METHODS_H
#define DAL_CLI_STUDY_METHODS_H

#include "study_data.h"

/* Reads a list of names into item->methods, each method once.  Returns CLI_DONE, or prints and
 * returns CLI_USAGE. */
int study_read_methods(study_case *item, const document *doc, yaml_node_t *node);
/* Adds +project to the methods that holonomic constraints drift with, and takes each once. */
void study_complete_methods(study_case *item);
/* Whether a name is the name of a method, or is so with the +project that the case adds. */
bool study_completes_to(const study_case *item, const char *name, const dal_method *method);
/* Whether some case runs a method of this name; where none but the method with +project is run, it
 * takes the place of the one given. */
bool study_find_method(const study_plan *plan, const char *name, dal_method *method);
/* Notes the systems whose holonomic constraints some methods are taken with +project for. */
void study_say_projected(const study_plan *plan);

#endif
