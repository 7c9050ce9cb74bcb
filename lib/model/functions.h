/* functions.h - the functions that a model defines, by formulas or by tables. */
#ifndef DAL_MODEL_FUNCTIONS_H
#define DAL_MODEL_FUNCTIONS_H

#include "expr/graph.h"
#include "model/model.h"

enum { DAL__MAX_ARGUMENTS = 16 };

/* A function: its body is a node over symbols of its own, which a call replaces. */
typedef struct dal__function {
    const char *name;
    int arity;
    const char *argument[DAL__MAX_ARGUMENTS]; /* [arity] names */
    int symbol[DAL__MAX_ARGUMENTS];           /* [arity] of the arguments */
    dal__node body;
    int table; /* of the model, from 1; 0: it has a body */
} dal__function;

/* Reads the name of an entry, "V(r)" or "f(x, y)".  Errors: DAL_STATUS_NAME, DAL_STATUS_TOO_LARGE,
 * DAL_STATUS_MEMORY. */
dal_status dal__read_signature(dal_model *model, const dal__entry *entry, dal__function *function,
                               dal_error *error);
/* The value of a function at arguments, [arity]. */
dal__node dal__call_function(dal__graph *graph, const dal__function *function,
                             const dal__node *argument);
/* Adds a copy of an entry of tables, with its points.  Errors: as of dal_model_add_table. */
dal_status dal__model_insert_table(dal_model *model, dal__entry entry, const dal_table *table,
                                   dal_error *error);

#endif
