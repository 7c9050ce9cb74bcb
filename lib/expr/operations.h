/* operations.h - operations: their names in formulas, their values, and which are computed as
 * one. */
#ifndef DAL_EXPR_OPERATIONS_H
#define DAL_EXPR_OPERATIONS_H

#include "expr/graph.h"

/* The operation of a name, or 0; its name, or NULL, and how many operands it takes. */
dal__op dal__function_named(const char *name, size_t length);
const char *dal__function_name(dal__op op, int *arity);

/* Whether something else may have the name of a function, too, and then hides it. */
bool dal__may_be_hidden(dal__op function);
/* Whether a name belongs to a function, and nothing else may have it; and whether another thing of
 * this name hides a function. */
bool dal__is_function(const char *name, size_t length);
bool dal__hides_function(const char *name);

/* Operations that are computed as one: both functions of one argument; and a sum or difference one
 * of whose operands is a product. */
enum {
    DAL__SINCOS = DAL__OP_COUNT, /* sin a and cos a */
    DAL__MUL_ADD,                /* a*b + c, rounded once; so the next two */
    DAL__MUL_SUB,                /* a*b - c */
    DAL__SUB_MUL,                /* c - a*b */
    DAL__PIECE                   /* a table, its piece being held: see tape.h */
};

/* One operation on doubles, with the bits of a tape. */
double dal__operate(int op, double a, double b, double c);

#endif
