/* formula.h - formulas over the parameters a, b and the symbols x, y, z, x', y', z', for tests. */
#ifndef FORMULA_H
#define FORMULA_H

#include "expr/derivative.h"
#include "expr/operations.h"
#include "expr/parser.h"
#include "expr/simplify.h"
#include "expr/tape.h"
#include "expr/traversal.h"
#include <string.h>

enum { PARAMETERS = 2, INPUTS = 6, SYMBOLS = PARAMETERS + INPUTS };
enum { A, B, X, Y, Z, XP, YP, ZP };

/* Finds the symbols; user: the graph. */
dal__node formula_resolve(void *user, const char *name, size_t length, bool prime,
                          dal_error *error);
/* The same, where x[1] is x. */
dal__node formula_resolve_index(void *user, const char *name, size_t length, bool prime,
                                dal_error *error);
dal__graph *formula_graph(void); /* with its two parameters */
dal_status formula_parse(dal__graph *graph, const char *text, dal__node *node, dal_error *error);
/* A formula that must be right: its node, or a failed assertion and 0. */
dal__node formula_node(dal__graph *graph, const char *text);

/* A block of numbers for tapes, aligned to eight lanes; to be freed. */
double *formula_work(size_t doubles);

#endif
