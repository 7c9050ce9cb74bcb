/* operations.c - operations: their names in formulas, and their values. */
#include "expr/operations.h"
#include "expr/arithmetic.h"
#include <math.h>
#include <string.h>

static const struct function {
    const char *name;
    int arity;
} functions[] = {
#define FUNCTION(code, arity, name) {name, arity},
    DAL__OP_LIST(FUNCTION)
#undef FUNCTION
};

dal__op dal__function_named(const char *name, size_t length)
{
    for (int op = 0; op < DAL__OP_COUNT; op++) {
        const char *known = functions[op].name;
        if (known && strlen(known) == length && memcmp(known, name, length) == 0)
            return (dal__op)op;
    }
    return (dal__op)0;
}

const char *dal__function_name(dal__op op, int *arity)
{
    *arity = functions[op].arity;
    return functions[op].name;
}

bool dal__may_be_hidden(dal__op function) { return function >= DAL__SIGN; }

bool dal__is_function(const char *name, size_t length)
{
    const dal__op function = dal__function_named(name, length);
    return function && !dal__may_be_hidden(function);
}

bool dal__hides_function(const char *name)
{
    return dal__may_be_hidden(dal__function_named(name, strlen(name))) || strcmp(name, "sum") == 0;
}

double dal__operate(int op, double a, double b, double c)
{
    switch (op) {
#define CASE(code, expression)                                                                     \
    case DAL__##code:                                                                              \
        return expression;
        DAL__OPERATION_LIST(CASE)
#undef CASE
    default:
        return NAN;
    }
}
