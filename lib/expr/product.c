/* product.c - products and quotients in canonical form (graph.h).
 *
 *     (c x)(d y) = (c d)(x y)      (x/w)/y = x/(w y)      x/(y/w) = (x w)/y      c, d fixed
 *
 * A fixed product c d is a number of hoisted nodes, so it costs nothing along a run. */
#include "expr/graph.h"
#include <math.h>

static dal__op op_of(const dal__graph *graph, dal__node node)
{
    return (dal__op)graph->node[node].op;
}

static dal__node one(dal__graph *graph) { return dal__number(graph, 1.0); }
static bool is_one(const dal__graph *graph, dal__node n) { return dal__is_number(graph, n, 1.0); }
static bool is_zero(const dal__graph *graph, dal__node n) { return dal__is_number(graph, n, 0.0); }

dal__node dal__commute(dal__graph *graph, dal__op op, dal__node a, dal__node b)
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

dal__term dal__split(dal__graph *graph, dal__node node)
{
    dal__term t = {.negative = false};
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

dal__node dal__attach(dal__graph *graph, dal__term t)
{
    if (!t.coefficient || !t.rest) return 0;
    if (is_one(graph, t.coefficient)) return t.negative ? negate(graph, t.rest) : t.rest;
    dal__node c = t.negative ? negate(graph, t.coefficient) : t.coefficient;
    return is_one(graph, t.rest) ? c : dal__commute(graph, DAL__MUL, c, t.rest);
}

dal__node dal__neg(dal__graph *graph, dal__node a)
{
    if (!a) return 0;
    dal__term t = dal__split(graph, a);
    t.negative = !t.negative;
    return dal__attach(graph, t);
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
    dal__node number = dal__number(graph, value);
    dal__node rest = is_one(graph, c)   ? d
                     : is_one(graph, d) ? c
                                        : dal__commute(graph, DAL__MUL, c, d);
    if (is_one(graph, number)) return rest;
    return is_one(graph, rest) ? number : dal__intern(graph, DAL__MUL, number, rest);
}

dal__node dal__mul(dal__graph *graph, dal__node a, dal__node b)
{
    if (!a || !b) return 0;
    if (is_zero(graph, a) || is_zero(graph, b)) return dal__number(graph, 0.0);
    if (a == b && op_of(graph, a) == DAL__SQRT) return graph->node[a].a;
    dal__term x = dal__split(graph, a), y = dal__split(graph, b);
    if (graph->status) return 0;
    x.negative = x.negative != y.negative;
    x.coefficient = coefficients(graph, x.coefficient, y.coefficient);
    if (!x.coefficient) return dal__commute(graph, DAL__MUL, a, b);
    if (is_one(graph, x.rest)) {
        x.rest = y.rest;
    } else if (!is_one(graph, y.rest)) {
        x.rest = dal__commute(graph, DAL__MUL, x.rest, y.rest);
    }
    return dal__attach(graph, x);
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
    if (r.op == DAL__NUMBER && s.op == DAL__NUMBER && isfinite(r.value / s.value)) {
        return dal__number(graph, r.value / s.value);
    }
    if (s.op == DAL__DIV) {
        dal__node product = coefficients(graph, c, reciprocal(graph, d));
        if (product) return product;
    }
    return dal__intern(graph, DAL__DIV, c, d);
}

/* u/w with w not fixed and u, w without coefficients of their own. */
static dal__node fraction(dal__graph *graph, dal__node u, dal__node w)
{
    dal__record p = graph->node[u], q = graph->node[w];
    if (q.op == DAL__DIV && p.op != DAL__DIV && graph->depth < DAL__DEEPEST) {
        graph->depth++;
        dal__node node = dal__div(graph, dal__mul(graph, u, q.b), q.a);
        graph->depth--;
        return node;
    }
    if (p.op == DAL__DIV && graph->depth < DAL__DEEPEST) {
        graph->depth++;
        dal__node node = dal__div(graph, p.a, dal__mul(graph, p.b, w));
        graph->depth--;
        return node;
    }
    return dal__intern(graph, DAL__DIV, u, w);
}

/* x/c with c fixed. */
static dal__node divide_fixed(dal__graph *graph, dal__term x, dal__node c)
{
    dal__node inverse = reciprocal(graph, c);
    dal__node coefficient = inverse ? coefficients(graph, x.coefficient, inverse) : 0;
    if (coefficient) {
        x.coefficient = coefficient;
    } else if (op_of(graph, x.coefficient) == DAL__NUMBER) {
        x.rest = dal__intern(graph, DAL__DIV, x.rest, c);
    } else {
        x.coefficient = ratio(graph, x.coefficient, c);
    }
    return dal__attach(graph, x);
}

dal__node dal__div(dal__graph *graph, dal__node a, dal__node b)
{
    if (!a || !b) return 0;
    if (is_zero(graph, b)) return dal__intern(graph, DAL__DIV, a, b);
    if (is_zero(graph, a)) return a;
    dal__term x = dal__split(graph, a), y = dal__split(graph, b);
    if (graph->status) return 0;
    x.negative = x.negative != y.negative;
    if (x.rest == y.rest) {
        x.rest = one(graph);
        x.coefficient = ratio(graph, x.coefficient, y.coefficient);
        return dal__attach(graph, x);
    }
    if (is_one(graph, y.rest)) return divide_fixed(graph, x, y.coefficient);
    dal__node inverse = reciprocal(graph, y.coefficient);
    dal__node coefficient = inverse ? coefficients(graph, x.coefficient, inverse) : 0;
    if (coefficient) {
        x.coefficient = coefficient;
        y.coefficient = one(graph);
    }
    y.negative = false;
    dal__node below = dal__attach(graph, y);
    if (is_one(graph, x.rest)) {
        x.rest = dal__intern(graph, DAL__DIV, x.coefficient, below);
        x.coefficient = one(graph);
    } else {
        dal__node quotient = fraction(graph, x.rest, below);
        x.rest = one(graph);
        return dal__mul(graph, dal__attach(graph, x), quotient);
    }
    return dal__attach(graph, x);
}
