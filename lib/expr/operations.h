/* operations.h - the operations that a formula calls by name. */
#ifndef DAL_EXPR_OPERATIONS_H
#define DAL_EXPR_OPERATIONS_H

#include "expr/graph.h"

/* The operation of a name, or 0; its name, or NULL, and how many operands it takes. */
dal__op dal__function_named(const char *name, size_t length);
const char *dal__function_name(dal__op op, int *arity);

/* Whether something else may have the name of a function, too, and then hides it. */
bool dal__is_young(dal__op function);
/* Whether a name belongs to a function, and nothing else may have it; and whether another thing of
 * this name hides a function. */
bool dal__is_function(const char *name, size_t length);
bool dal__hides_function(const char *name);

#endif
