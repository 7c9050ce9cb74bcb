/* simplify.c - operations on nodes: constants are folded, sums, products and quotients brought into
 * the canonical form of graph.h.
 *
 *     (c x)(d y) = (c d)(x y)      (x/w)/y = x/(w y)      x/(y/w) = (x w)/y
 *     c x +- d x = (c +- d) x      c x +- c y = c (x +- y)      x/w +- y/w = (x +- y)/w
 *     f sin(u)^2 + f cos(u)^2 = f                               c, d fixed
 *
 * A fixed product c d is a number of hoisted nodes, so it costs nothing along a run.  A new term is
 * compared with the last two of the sum it is added to, so adding costs a bounded time.
 *
 * A function of a number becomes its value, with the bits a tape would give, unless that is not
 * finite: then the node stays, and its evaluation gives the infinity or NaN. */
#include "expr/simplify.h"
#include "expr/operations.h"
#include "expr/table.h"
#include <math.h>

/* Rules may call each other this deep; below, a node is made as it is.  Integer powers up to
 * MAX_FOLDS are products; products of more factors than MAX_FACTORS are not searched for squares of
 * sines. */
enum { MAX_DEPTH = 8, MAX_FOLDS = 64, MAX_FACTORS = 12 };

typedef struct term {
    dal__node coefficient, rest;
    bool negative;
} term;

static dal__op op_of(const dal__graph *graph, dal__node node)
{
    return (dal__op)graph->node[node].op;
}

static dal__node one(dal__graph *graph) { return dal__number(graph, 1.0); }
static bool is_one(const dal__graph *graph, dal__node n) { return dal__is_number(graph, n, 1.0); }

/* The node of an ADD or MUL with ordered operands. */
static dal__node commute(dal__graph *graph, dal__op op, dal__node a, dal__node b)
{
    bool a_first = op_of(graph, a) == DAL__NUMBER || (op_of(graph, b) != DAL__NUMBER && a <= b);
    return a_first ? dal__intern(graph, op, a, b) : dal__intern(graph, op, b, a);
}

/* ---- terms ---- */

/* Takes the sign off a fixed node. */
static dal__node magnitude(dal__graph *graph, dal__node c, bool *negative)
{
    dal__record r = graph->node[c];
    if (r.op == DAL__NEG) return *negative = !*negative, r.a;
    if (r.op == DAL__NUMBER && r.value < 0.0) {
        *negative = !*negative;
        return dal__number(graph, -r.value);
    }
    return c;
}

/* A node as +-c*r with c >= 0 where c is a number, and back. */
static term split(dal__graph *graph, dal__node node)
{
    term t = {.negative = false};
    node = magnitude(graph, node, &t.negative);
    dal__record r = graph->node[node];
    if (r.fixed) {
        t.coefficient = node;
        t.rest = one(graph);
    } else if (r.op == DAL__MUL && graph->node[r.a].fixed) {
        t.coefficient = magnitude(graph, r.a, &t.negative);
        t.rest = r.b;
    } else if (r.op == DAL__MUL && graph->node[r.b].fixed) {
        t.coefficient = magnitude(graph, r.b, &t.negative);
        t.rest = r.a;
    } else {
        t.coefficient = one(graph);
        t.rest = node;
    }
    return t;
}

static dal__node negate(dal__graph *graph, dal__node node)
{
    dal__record r = graph->node[node];
    if (r.op == DAL__NUMBER) return dal__number(graph, -r.value);
    if (r.op == DAL__SUB) return dal__intern(graph, DAL__SUB, r.b, r.a);
    return dal__intern(graph, DAL__NEG, node, 0);
}

static dal__node attach(dal__graph *graph, term t)
{
    if (!t.coefficient || !t.rest) return 0;
    if (is_one(graph, t.coefficient)) return t.negative ? negate(graph, t.rest) : t.rest;
    dal__node c = t.negative ? negate(graph, t.coefficient) : t.coefficient;
    return is_one(graph, t.rest) ? c : commute(graph, DAL__MUL, c, t.rest);
}

dal__node dal__node_neg(dal__graph *graph, dal__node a)
{
    if (!a) return 0;
    term t = split(graph, a);
    t.negative = !t.negative;
    return attach(graph, t);
}

/* ---- products ---- */

/* A fixed node as number times rest. */
static double take_number(dal__graph *graph, dal__node *c)
{
    dal__record r = graph->node[*c];
    if (r.op == DAL__NUMBER) return *c = one(graph), r.value;
    if (r.op != DAL__MUL || op_of(graph, r.a) != DAL__NUMBER) return 1.0;
    *c = r.b;
    return graph->node[r.a].value;
}

/* The factors of a product in ascending order; 0 when they are more than MAX_FACTORS. */
static int factors(const dal__graph *graph, dal__node node, dal__node *out)
{
    dal__node open[MAX_FACTORS] = {node};
    int opened = 1, count = 0;
    while (opened > 0) {
        dal__record r = graph->node[open[--opened]];
        dal__node f = open[opened];
        if (r.op == DAL__MUL) {
            if (opened + 2 > MAX_FACTORS) return 0;
            open[opened++] = r.a;
            open[opened++] = r.b;
            continue;
        }
        if (count == MAX_FACTORS) return 0;
        int i = count++;
        for (; i > 0 && out[i - 1] > f; i--) out[i] = out[i - 1];
        out[i] = f;
    }
    return count;
}

/* The product of two fixed nodes without numeric factors: their factors in ascending order, so that
 * equal products are one node. */
static dal__node fixed_product(dal__graph *graph, dal__node c, dal__node d)
{
    dal__node x[MAX_FACTORS], y[MAX_FACTORS];
    if (is_one(graph, c) || is_one(graph, d)) return is_one(graph, c) ? d : c;
    const int nx = factors(graph, c, x), ny = factors(graph, d, y);
    if (nx == 0 || ny == 0) return commute(graph, DAL__MUL, c, d);
    dal__node product = 0;
    for (int i = 0, j = 0; i < nx || j < ny;) {
        const dal__node next = j == ny || (i < nx && x[i] <= y[j]) ? x[i++] : y[j++];
        product = product ? dal__intern(graph, DAL__MUL, next, product) : next;
    }
    return product;
}

/* The product of two fixed nodes without signs; 0 where a numeric factor would over- or underflow.
 */
static dal__node coefficients(dal__graph *graph, dal__node c, dal__node d)
{
    if (is_one(graph, c)) return d;
    if (is_one(graph, d)) return c;
    dal__record r = graph->node[c], s = graph->node[d];
    if (r.op == DAL__DIV && r.b == d) return r.a;
    if (s.op == DAL__DIV && s.b == c) return s.a;
    double value = take_number(graph, &c) * take_number(graph, &d);
    if (!isnormal(value)) return 0;
    dal__node number = dal__number(graph, value), rest = fixed_product(graph, c, d);
    if (is_one(graph, number)) return rest;
    return is_one(graph, rest) ? number : dal__intern(graph, DAL__MUL, number, rest);
}

dal__node dal__node_mul(dal__graph *graph, dal__node a, dal__node b)
{
    if (!a || !b) return 0;
    if (dal__node_is_zero(graph, a)) return a;
    if (dal__node_is_zero(graph, b)) return b;
    if (a == b && op_of(graph, a) == DAL__SQRT) return graph->node[a].a;
    term x = split(graph, a), y = split(graph, b);
    if (graph->status) return 0;
    x.negative = x.negative != y.negative;
    x.coefficient = coefficients(graph, x.coefficient, y.coefficient);
    if (!x.coefficient) return commute(graph, DAL__MUL, a, b);
    if (is_one(graph, x.rest))
        x.rest = y.rest;
    else if (!is_one(graph, y.rest))
        x.rest = commute(graph, DAL__MUL, x.rest, y.rest);
    return attach(graph, x);
}

/* ---- quotients ---- */

/* 1/c of a fixed c without sign, or 0 for a number that has no exact one. */
static dal__node reciprocal(dal__graph *graph, dal__node c)
{
    dal__record r = graph->node[c];
    if (is_one(graph, c)) return c;
    if (r.op == DAL__NUMBER) {
        int exponent;
        bool exact = frexp(r.value, &exponent) == 0.5 && isnormal(1.0 / r.value);
        return exact ? dal__number(graph, 1.0 / r.value) : 0;
    }
    if (r.op == DAL__DIV && is_one(graph, r.a)) return r.b;
    if (r.op == DAL__DIV) return dal__intern(graph, DAL__DIV, r.b, r.a);
    return dal__intern(graph, DAL__DIV, one(graph), c);
}

/* c/d of fixed nodes without signs. */
static dal__node ratio(dal__graph *graph, dal__node c, dal__node d)
{
    if (c == d) return one(graph);
    if (is_one(graph, d)) return c;
    dal__record r = graph->node[c], s = graph->node[d];
    if (r.op == DAL__NUMBER && s.op == DAL__NUMBER && isfinite(r.value / s.value))
        return dal__number(graph, r.value / s.value);
    dal__node inverse = s.op == DAL__DIV || s.op == DAL__NUMBER ? reciprocal(graph, d) : 0;
    dal__node product = inverse ? coefficients(graph, c, inverse) : 0;
    return product ? product : dal__intern(graph, DAL__DIV, c, d);
}

/* u/w with w not fixed and u, w without coefficients of their own. */
static dal__node fraction(dal__graph *graph, dal__node u, dal__node w)
{
    dal__record p = graph->node[u], q = graph->node[w];
    if ((p.op != DAL__DIV && q.op != DAL__DIV) || graph->depth >= MAX_DEPTH)
        return dal__intern(graph, DAL__DIV, u, w);
    graph->depth++;
    dal__node node = p.op == DAL__DIV ? dal__node_div(graph, p.a, dal__node_mul(graph, p.b, w))
                                      : dal__node_div(graph, dal__node_mul(graph, u, q.b), q.a);
    graph->depth--;
    return node;
}

/* x/c with c fixed. */
static dal__node divide_fixed(dal__graph *graph, term x, dal__node c)
{
    dal__node inverse = reciprocal(graph, c);
    dal__node coefficient = inverse ? coefficients(graph, x.coefficient, inverse) : 0;
    if (coefficient)
        x.coefficient = coefficient;
    else if (op_of(graph, x.coefficient) == DAL__NUMBER)
        x.rest = dal__intern(graph, DAL__DIV, x.rest, c);
    else
        x.coefficient = ratio(graph, x.coefficient, c);
    return attach(graph, x);
}

dal__node dal__node_div(dal__graph *graph, dal__node a, dal__node b)
{
    if (!a || !b) return 0;
    if (dal__node_is_zero(graph, b)) return dal__intern(graph, DAL__DIV, a, b);
    if (dal__node_is_zero(graph, a)) return a;
    term x = split(graph, a), y = split(graph, b);
    if (graph->status) return 0;
    x.negative = x.negative != y.negative;
    if (x.rest == y.rest) {
        x.rest = one(graph);
        x.coefficient = ratio(graph, x.coefficient, y.coefficient);
        return attach(graph, x);
    }
    if (is_one(graph, y.rest)) return divide_fixed(graph, x, y.coefficient);
    dal__node inverse = reciprocal(graph, y.coefficient);
    dal__node coefficient = inverse ? coefficients(graph, x.coefficient, inverse) : 0;
    if (coefficient) {
        x.coefficient = coefficient;
        y.coefficient = one(graph);
    }
    y.negative = false;
    dal__node below = attach(graph, y);
    if (is_one(graph, x.rest)) {
        x.rest = dal__intern(graph, DAL__DIV, x.coefficient, below);
        x.coefficient = one(graph);
    } else {
        dal__node quotient = fraction(graph, x.rest, below);
        x.rest = one(graph);
        return dal__node_mul(graph, attach(graph, x), quotient);
    }
    return attach(graph, x);
}

static dal__node signed_sum(dal__graph *graph, term x, term y);

/* ---- sums: f sin(u)^2 + f cos(u)^2 ---- */

typedef struct comparison {
    dal__node common[MAX_FACTORS], left[MAX_FACTORS], right[MAX_FACTORS];
    int commons, lefts, rights;
} comparison;

static void compare(comparison *c, const dal__node *x, int nx, const dal__node *y, int ny)
{
    int i = 0, j = 0;
    while (i < nx || j < ny)
        if (i < nx && j < ny && x[i] == y[j])
            c->common[c->commons++] = x[i++], j++;
        else if (j == ny || (i < nx && x[i] < y[j]))
            c->left[c->lefts++] = x[i++];
        else
            c->right[c->rights++] = y[j++];
}

/* The common factor f of f sin(u)^2 and f cos(u)^2, or 0. */
static dal__node pythagoras(dal__graph *graph, dal__node x, dal__node y)
{
    dal__node fx[MAX_FACTORS], fy[MAX_FACTORS];
    if (graph->node[x].op != DAL__MUL || graph->node[y].op != DAL__MUL) return 0;
    int nx = factors(graph, x, fx), ny = factors(graph, y, fy);
    if (nx == 0 || nx != ny) return 0;
    comparison c = {.commons = 0};
    compare(&c, fx, nx, fy, ny);
    if (c.lefts != 2 || c.left[0] != c.left[1] || c.right[0] != c.right[1]) return 0;
    dal__record s = graph->node[c.left[0]], t = graph->node[c.right[0]];
    bool squares = (s.op == DAL__SIN && t.op == DAL__COS) || (s.op == DAL__COS && t.op == DAL__SIN);
    if (!squares || s.a != t.a) return 0;
    dal__node f = one(graph);
    for (int i = 0; i < c.commons; i++) f = dal__node_mul(graph, f, c.common[i]);
    return f;
}

/* ---- two terms into one ---- */

/* +-a +-b of two fixed magnitudes, where the sum is exact or they are the same; else 0. */
static dal__node fixed_sum(dal__graph *graph, term x, term y)
{
    dal__record r = graph->node[x.coefficient], s = graph->node[y.coefficient];
    if (x.coefficient == y.coefficient) {
        if (x.negative != y.negative) return dal__number(graph, 0.0);
        x.coefficient = dal__node_mul(graph, dal__number(graph, 2.0), x.coefficient);
        return attach(graph, x);
    }
    if (r.op != DAL__NUMBER || s.op != DAL__NUMBER) return 0;
    double a = x.negative ? -r.value : r.value, b = y.negative ? -s.value : s.value;
    double sum = a + b;
    bool exact = isfinite(sum) && sum - a == b && sum - b == a;
    return exact ? dal__number(graph, sum) : 0;
}

static dal__node common_denominator(dal__graph *graph, term x, term y)
{
    dal__record r = graph->node[x.rest], s = graph->node[y.rest];
    if (r.op != DAL__DIV || s.op != DAL__DIV || r.b != s.b) return 0;
    dal__node c[2] = {dal__node_mul(graph, x.coefficient, r.a),
                      dal__node_mul(graph, y.coefficient, s.a)};
    term u = split(graph, c[0]), w = split(graph, c[1]);
    u.negative = u.negative != x.negative;
    w.negative = w.negative != y.negative;
    return dal__node_div(graph, signed_sum(graph, u, w), r.b);
}

/* x + y as one term, or 0 when they do not combine. */
static dal__node combine(dal__graph *graph, term x, term y)
{
    bool x_fixed = is_one(graph, x.rest), y_fixed = is_one(graph, y.rest);
    if (x_fixed && y_fixed) return fixed_sum(graph, x, y);
    if (x_fixed || y_fixed) return 0;
    term c = {x.coefficient, one(graph), x.negative}, d = c;
    d.coefficient = y.coefficient, d.negative = y.negative;
    if (x.rest == y.rest) return dal__node_mul(graph, signed_sum(graph, c, d), x.rest);
    if (x.coefficient == y.coefficient && !is_one(graph, x.coefficient)) {
        x.coefficient = y.coefficient = one(graph);
        return dal__node_mul(graph, c.coefficient, signed_sum(graph, x, y));
    }
    dal__node f = 0;
    if (x.coefficient == y.coefficient && x.negative == y.negative)
        f = pythagoras(graph, x.rest, y.rest);
    if (f) return x.negative ? dal__node_neg(graph, f) : f;
    return common_denominator(graph, x, y);
}

/* ---- sums ---- */

/* x + y without simplification. */
static dal__node join(dal__graph *graph, term x, term y)
{
    bool negative = x.negative && y.negative;
    term u = x, w = y, s = {one(graph), 0, negative};
    u.negative = w.negative = false;
    dal__node a = attach(graph, u), b = attach(graph, w);
    if (x.negative == y.negative) {
        s.rest = commute(graph, DAL__ADD, a, b);
    } else {
        s.rest =
            x.negative ? dal__intern(graph, DAL__SUB, b, a) : dal__intern(graph, DAL__SUB, a, b);
    }
    return attach(graph, s);
}

/* Where x is a sum and y combines with one of its two terms: the sum of the rest and that. */
static dal__node absorb(dal__graph *graph, term x, term y)
{
    dal__record r = graph->node[x.rest];
    if ((r.op != DAL__ADD && r.op != DAL__SUB) || !is_one(graph, x.coefficient)) return 0;
    term p = split(graph, r.a), q = split(graph, r.b);
    p.negative = p.negative != x.negative;
    q.negative = q.negative != (x.negative != (r.op == DAL__SUB));
    dal__node merged = combine(graph, q, y);
    if (merged) return signed_sum(graph, p, split(graph, merged));
    merged = combine(graph, p, y);
    return merged ? signed_sum(graph, q, split(graph, merged)) : 0;
}

static dal__node signed_sum(dal__graph *graph, term x, term y)
{
    if (graph->status) return 0;
    if (dal__node_is_zero(graph, x.coefficient)) return attach(graph, y);
    if (dal__node_is_zero(graph, y.coefficient)) return attach(graph, x);
    if (graph->depth >= MAX_DEPTH) return join(graph, x, y);
    graph->depth++;
    dal__node sum = combine(graph, x, y);
    if (!sum) sum = absorb(graph, x, y);
    if (!sum) sum = absorb(graph, y, x);
    graph->depth--;
    return sum ? sum : join(graph, x, y);
}

/* a + sign b */
static dal__node add(dal__graph *graph, dal__node a, int sign, dal__node b)
{
    if (!a || !b) return 0;
    dal__record r = graph->node[a], s = graph->node[b];
    if (r.op == DAL__NUMBER && s.op == DAL__NUMBER) {
        double sum = r.value + sign * s.value;
        if (isfinite(sum)) return dal__number(graph, sum);
    }
    term x = split(graph, a), y = split(graph, b);
    y.negative = y.negative != (sign < 0);
    return signed_sum(graph, x, y);
}

dal__node dal__node_add(dal__graph *graph, dal__node a, dal__node b)
{
    return add(graph, a, +1, b);
}
dal__node dal__node_sub(dal__graph *graph, dal__node a, dal__node b)
{
    return add(graph, a, -1, b);
}

/* ---- functions and powers ---- */

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
    term t = split(graph, a);
    *negative = t.negative;
    t.negative = false;
    return *negative ? attach(graph, t) : a;
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
    return negative ? dal__node_neg(graph, node) : node;
}

/* x^n by squaring. */
static dal__node integer_power(dal__graph *graph, dal__node x, int n)
{
    dal__node result = dal__number(graph, 1.0);
    for (int rest = n < 0 ? -n : n; rest > 0; rest /= 2) {
        if (rest % 2) result = dal__node_mul(graph, result, x);
        if (rest > 1) x = dal__node_mul(graph, x, x);
    }
    return n < 0 ? dal__node_div(graph, dal__number(graph, 1.0), result) : result;
}

static dal__node power(dal__graph *graph, dal__node a, dal__node b)
{
    dal__record r = graph->node[a], s = graph->node[b];
    if (s.op != DAL__NUMBER)
        return dal__is_number(graph, a, 1.0) ? a : dal__intern(graph, DAL__POW, a, b);
    double value = r.op == DAL__NUMBER ? dal__operate(DAL__POW, r.value, s.value, 0.0) : INFINITY;
    if (isfinite(value)) return dal__number(graph, value);
    if (fabs(s.value) <= MAX_FOLDS && s.value == floor(s.value))
        return integer_power(graph, a, (int)s.value);
    if (s.value == 0.5) return function(graph, DAL__SQRT, a);
    if (s.value == -0.5)
        return dal__node_div(graph, dal__number(graph, 1.0), function(graph, DAL__SQRT, a));
    return dal__intern(graph, DAL__POW, a, b);
}

/* A function of two operands that is folded where both are numbers and the value is one. */
static dal__node function2(dal__graph *graph, dal__op op, dal__node a, dal__node b)
{
    dal__record r = graph->node[a], s = graph->node[b];
    const bool numbers = r.op == DAL__NUMBER && s.op == DAL__NUMBER;
    const double value = numbers ? dal__operate(op, r.value, s.value, 0.0) : INFINITY;
    if (isfinite(value)) return dal__number(graph, value);
    if (a == b && (op == DAL__MIN || op == DAL__MAX)) return a;
    if (a == b && (op == DAL__LESS_EQUAL || op == DAL__EQUAL)) return one(graph);
    if (a == b && op == DAL__LESS) return dal__number(graph, 0.0);
    return dal__intern(graph, op, a, b);
}

dal__node dal__node_if(dal__graph *graph, dal__node a, dal__node b, dal__node c)
{
    if (!a || !b || !c) return 0;
    if (op_of(graph, a) == DAL__NUMBER) return dal__node_is_zero(graph, a) ? c : b;
    return b == c ? b : dal__intern_if(graph, a, b, c);
}

dal__node dal__node_table(dal__graph *graph, int symbol, dal__node a)
{
    if (!a) return 0;
    const dal__tape_table *table = &graph->tables[symbol / DAL__TABLE_ORDERS];
    const dal__record r = graph->node[a];
    if (symbol % DAL__TABLE_ORDERS > table->degree) return dal__number(graph, 0.0);
    const double value =
        r.op == DAL__NUMBER ? dal__table_value(graph->tables, symbol, r.value) : NAN;
    return isfinite(value) ? dal__number(graph, value) : dal__intern_table(graph, symbol, a);
}

dal__node dal__apply(dal__graph *graph, dal__op op, dal__node a, dal__node b)
{
    if (!a) return 0;
    switch (op) {
    case DAL__ADD:
        return dal__node_add(graph, a, b);
    case DAL__SUB:
        return dal__node_sub(graph, a, b);
    case DAL__MUL:
        return dal__node_mul(graph, a, b);
    case DAL__DIV:
        return dal__node_div(graph, a, b);
    case DAL__NEG:
        return dal__node_neg(graph, a);
    case DAL__POW:
        return b ? power(graph, a, b) : 0;
    case DAL__ATAN2:
    case DAL__MIN:
    case DAL__MAX:
    case DAL__HYPOT:
    case DAL__LESS:
    case DAL__LESS_EQUAL:
    case DAL__EQUAL:
        return b ? function2(graph, op, a, b) : 0;
    default:
        return function(graph, op, a);
    }
}

dal__node dal__dot(dal__graph *graph, int count, const dal__node *a, const dal__node *b)
{
    dal__node sum = dal__number(graph, 0.0);
    for (int i = 0; i < count; i++)
        if (!dal__node_is_zero(graph, a[i]))
            sum = dal__node_add(graph, sum, dal__node_mul(graph, a[i], b[i]));
    return sum;
}

dal__node dal__add_strided_dot(dal__graph *graph, dal__node sum, int count, const dal__node *a,
                               int a_stride, const dal__node *b, int b_stride)
{
    for (int i = 0; i < count; i++)
        sum = dal__node_add(graph, sum, dal__node_mul(graph, a[i * a_stride], b[i * b_stride]));
    return sum;
}

void dal__add_product(dal__graph *graph, dal__node *sum, dal__node a, dal__node b)
{
    if (!dal__node_is_zero(graph, a) && !dal__node_is_zero(graph, b))
        *sum = dal__node_add(graph, *sum, dal__node_mul(graph, a, b));
}
