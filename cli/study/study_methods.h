/* study_methods.h - the integrators of a case. */
#ifndef DAL_CLI_STUDY_METHODS_H
#define DAL_CLI_STUDY_METHODS_H

#include "study_data.h"

bool study_has_method(const study_case *item, const dal_method *method);
/* Reads a list of names into item->methods, each method once.  Returns CLI_DONE, or prints and
 * returns CLI_USAGE. */
int study_read_methods(study_case *item, const document *doc, yaml_node_t *node);

#endif
