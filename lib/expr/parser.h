/* parser.h - formulas to nodes. */
#ifndef DAL_EXPR_PARSER_H
#define DAL_EXPR_PARSER_H

#include "expr/graph.h"

/* Turns a name (or name' when prime) into a node; on 0 it has filled *error with the status and
 * message, the parser adds the place. */
typedef dal__node dal__resolve(void *user, const char *name, size_t length, bool prime,
                               dal_error *error);

/* What the names in a formula mean.  function: the name of function number i of the user, from 0,
 * and how many arguments it takes, NULL past the last; call: its value, 0 as in resolve.  Both are
 * NULL where there are none. */
typedef struct dal__names {
    dal__resolve *resolve;
    const char *(*function)(void *user, int i, int *arity);
    dal__node (*call)(void *user, int i, const dal__node *argument, dal_error *error);
    void *user;
    bool has_second_derivatives; /* x'' is resolved as x' with a prime */
} dal__names;

/* Parses one formula.  error->line and column are relative to text, from 1.  Errors:
 * DAL_STATUS_SYNTAX, DAL_STATUS_NAME (also what resolve returns), DAL_STATUS_TOO_LARGE,
 * DAL_STATUS_MEMORY. */
dal_status dal__parse(dal__graph *graph, const char *text, size_t length, const dal__names *names,
                      dal__node *node, dal_error *error);

#endif
