/* symbols.h - the names of a model, and what they mean in a formula. */
#ifndef DAL_MODEL_SYMBOLS_H
#define DAL_MODEL_SYMBOLS_H

#include "expr/graph.h"

/* Collects the names of all sections into the equations and refuses clashes. */
dal_status dal__collect_names(dal_model *model, dal_error *error);
/* The index of name in names, or -1. */
int dal__index_of(const char *name, size_t length, const char *const *names, int count);

/* What a formula may contain; MULTIPLIERS: of vakonomic motion. */
enum { DAL__MAY_T = 1, DAL__MAY_STATE = 2, DAL__MAY_MULTIPLIERS = 4, DAL__MAY_REACTIONS = 8 };
typedef struct dal__scope {
    const dal_model *model;
    unsigned may;
    const dal__node *given;          /* [2n] q, v of a start, 0: not given yet; NULL: no start */
    int parameters, lets, functions; /* those already known */
    const char *index;               /* a name that is the number at; NULL: none */
    int at;
    const struct dal__function *inside; /* whose body the formula is; NULL: none */
} dal__scope;
/* The functions that a scope knows, as the parser wants them. */
const char *dal__scope_function(void *scope, int i, int *arity);
dal__node dal__scope_call(void *scope, int i, const dal__node *argument, dal_error *error);
dal__node dal__resolve_name(void *scope, const char *name, size_t length, bool prime,
                            dal_error *error);

#endif
