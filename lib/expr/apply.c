/* apply.c - operations by code: functions, powers, and the folding of constants.
 *
 * A function of a number becomes its value, with the bits a tape would give, unless that is not
 * finite: then the node stays, and whoever evaluates it sees the infinity or NaN. */
#include "expr/graph.h"
#include <math.h>

/* Integer powers up to this are products. */
enum { MOST_FOLDS = 64 };

/* f(-x) = parity f(x); 0: neither. */
static const signed char parity[DAL__OP_COUNT] = {
    [DAL__SIN] = -1,   [DAL__COS] = 1,   [DAL__TAN] = -1,  [DAL__ASIN] = -1,
    [DAL__ATAN] = -1,  [DAL__SINH] = -1, [DAL__COSH] = 1,  [DAL__TANH] = -1,
    [DAL__ASINH] = -1, [DAL__ABS] = 1,   [DAL__SIGN] = -1,
};

/* Takes the sign off an argument, where x - y has one when y is the older node. */
static dal__node unsigned_argument(dal__graph *graph, dal__node a, bool *negative)
{
    dal__record r = graph->node[a];
    if (r.op == DAL__SUB && r.b < r.a) {
        *negative = true;
        return dal__intern(graph, DAL__SUB, r.b, r.a);
    }
    dal__term t = dal__split(graph, a);
    *negative = t.negative;
    t.negative = false;
    return *negative ? dal__attach(graph, t) : a;
}

static dal__node function(dal__graph *graph, dal__op op, dal__node a)
{
    bool negative = false;
    if (parity[op]) a = unsigned_argument(graph, a, &negative);
    negative = negative && parity[op] < 0;
    dal__record r = graph->node[a];
    if (op == DAL__ABS && r.op == DAL__ABS) return a;
    double value = r.op == DAL__NUMBER ? dal__operate(op, r.value, 0.0, 0.0) : INFINITY;
    dal__node node = isfinite(value) ? dal__number(graph, value) : dal__intern(graph, op, a, 0);
    return negative ? dal__neg(graph, node) : node;
}

/* x^n by squaring. */
static dal__node integer_power(dal__graph *graph, dal__node x, int n)
{
    dal__node result = dal__number(graph, 1.0);
    for (int rest = n < 0 ? -n : n; rest > 0; rest /= 2) {
        if (rest % 2) result = dal__mul(graph, result, x);
        if (rest > 1) x = dal__mul(graph, x, x);
    }
    return n < 0 ? dal__div(graph, dal__number(graph, 1.0), result) : result;
}

static dal__node power(dal__graph *graph, dal__node a, dal__node b)
{
    dal__record r = graph->node[a], s = graph->node[b];
    if (s.op != DAL__NUMBER) {
        return dal__is_number(graph, a, 1.0) ? a : dal__intern(graph, DAL__POW, a, b);
    }
    double value = r.op == DAL__NUMBER ? dal__operate(DAL__POW, r.value, s.value, 0.0) : INFINITY;
    if (isfinite(value)) return dal__number(graph, value);
    if (fabs(s.value) <= MOST_FOLDS && s.value == floor(s.value)) {
        return integer_power(graph, a, (int)s.value);
    }
    if (s.value == 0.5) return function(graph, DAL__SQRT, a);
    if (s.value == -0.5) {
        return dal__div(graph, dal__number(graph, 1.0), function(graph, DAL__SQRT, a));
    }
    return dal__intern(graph, DAL__POW, a, b);
}

static dal__node arc_tangent(dal__graph *graph, dal__node a, dal__node b)
{
    dal__record r = graph->node[a], s = graph->node[b];
    if (r.op == DAL__NUMBER && s.op == DAL__NUMBER) {
        return dal__number(graph, dal__operate(DAL__ATAN2, r.value, s.value, 0.0));
    }
    return dal__intern(graph, DAL__ATAN2, a, b);
}

dal__node dal__apply(dal__graph *graph, dal__op op, dal__node a, dal__node b)
{
    if (!a) return 0;
    switch (op) {
    case DAL__ADD:
        return dal__add(graph, a, b);
    case DAL__SUB:
        return dal__sub(graph, a, b);
    case DAL__MUL:
        return dal__mul(graph, a, b);
    case DAL__DIV:
        return dal__div(graph, a, b);
    case DAL__NEG:
        return dal__neg(graph, a);
    case DAL__POW:
        return b ? power(graph, a, b) : 0;
    case DAL__ATAN2:
        return b ? arc_tangent(graph, a, b) : 0;
    default:
        return function(graph, op, a);
    }
}
