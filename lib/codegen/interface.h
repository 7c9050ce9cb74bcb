/* interface.h - what the caller of a generated file sees. */
#ifndef DAL_CODEGEN_INTERFACE_H
#define DAL_CODEGEN_INTERFACE_H

#include "codegen/generation.h"

/* Sets the prefix: the caller's, or (NULL) SYSTEM_METHOD.  Errors: DAL_STATUS_ARGUMENT. */
dal_status dal__choose_prefix(dal__generation *g, const char *prefix, dal_error *error);
/* The first comment and the declarations; names and defaults at the end. */
void dal__write_interface(dal__generation *g);
void dal__write_names(dal__generation *g);

#endif
