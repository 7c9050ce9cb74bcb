/* sum.c - sums and differences in canonical form (graph.h).
 *
 *     c x +- d x = (c +- d) x      c x +- c y = c (x +- y)      x/w +- y/w = (x +- y)/w
 *     f sin(u)^2 + f cos(u)^2 = f                               c, d fixed
 *
 * A new term is held against the last two of the sum it joins, so adding costs a bounded time. */
#include "expr/graph.h"
#include <math.h>

enum { MOST_FACTORS = 12 };

static dal__node one(dal__graph *graph) { return dal__number(graph, 1.0); }
static bool is_one(const dal__graph *graph, dal__node n) { return dal__is_number(graph, n, 1.0); }

static dal__node signed_sum(dal__graph *graph, dal__term x, dal__term y);

/* ---- f sin(u)^2 + f cos(u)^2 ---- */

/* The factors of a product in ascending order; 0 when they are more than MOST_FACTORS. */
static int factors(const dal__graph *graph, dal__node node, dal__node *out)
{
    dal__node open[MOST_FACTORS] = {node};
    int opened = 1, count = 0;
    while (opened > 0) {
        dal__record r = graph->node[open[--opened]];
        dal__node f = open[opened];
        if (r.op == DAL__MUL) {
            if (opened + 2 > MOST_FACTORS) return 0;
            open[opened++] = r.a;
            open[opened++] = r.b;
            continue;
        }
        if (count == MOST_FACTORS) return 0;
        int i = count++;
        for (; i > 0 && out[i - 1] > f; i--) out[i] = out[i - 1];
        out[i] = f;
    }
    return count;
}

typedef struct comparison {
    dal__node common[MOST_FACTORS], left[MOST_FACTORS], right[MOST_FACTORS];
    int commons, lefts, rights;
} comparison;

static void compare(comparison *c, const dal__node *x, int nx, const dal__node *y, int ny)
{
    int i = 0, j = 0;
    while (i < nx || j < ny) {
        if (i < nx && j < ny && x[i] == y[j]) {
            c->common[c->commons++] = x[i++], j++;
        } else if (j == ny || (i < nx && x[i] < y[j])) {
            c->left[c->lefts++] = x[i++];
        } else {
            c->right[c->rights++] = y[j++];
        }
    }
}

/* The common factor f of f sin(u)^2 and f cos(u)^2, or 0. */
static dal__node pythagoras(dal__graph *graph, dal__node x, dal__node y)
{
    dal__node fx[MOST_FACTORS], fy[MOST_FACTORS];
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
    for (int i = 0; i < c.commons; i++) f = dal__mul(graph, f, c.common[i]);
    return f;
}

/* ---- two terms into one ---- */

/* +-a +-b of two fixed magnitudes, where the sum is exact or they are the same; else 0. */
static dal__node fixed_sum(dal__graph *graph, dal__term x, dal__term y)
{
    dal__record r = graph->node[x.coefficient], s = graph->node[y.coefficient];
    if (x.coefficient == y.coefficient) {
        if (x.negative != y.negative) return dal__number(graph, 0.0);
        x.coefficient = dal__mul(graph, dal__number(graph, 2.0), x.coefficient);
        return dal__attach(graph, x);
    }
    if (r.op != DAL__NUMBER || s.op != DAL__NUMBER) return 0;
    double a = x.negative ? -r.value : r.value, b = y.negative ? -s.value : s.value;
    double sum = a + b;
    bool exact = isfinite(sum) && sum - a == b && sum - b == a;
    return exact ? dal__number(graph, sum) : 0;
}

static dal__node common_denominator(dal__graph *graph, dal__term x, dal__term y)
{
    dal__record r = graph->node[x.rest], s = graph->node[y.rest];
    if (r.op != DAL__DIV || s.op != DAL__DIV || r.b != s.b) return 0;
    dal__node c[2] = {dal__mul(graph, x.coefficient, r.a), dal__mul(graph, y.coefficient, s.a)};
    dal__term u = dal__split(graph, c[0]), w = dal__split(graph, c[1]);
    u.negative = u.negative != x.negative;
    w.negative = w.negative != y.negative;
    return dal__div(graph, signed_sum(graph, u, w), r.b);
}

/* x + y as one term, or 0 when they do not combine. */
static dal__node combine(dal__graph *graph, dal__term x, dal__term y)
{
    bool x_fixed = is_one(graph, x.rest), y_fixed = is_one(graph, y.rest);
    if (x_fixed && y_fixed) return fixed_sum(graph, x, y);
    if (x_fixed || y_fixed) return 0;
    dal__term c = {x.coefficient, one(graph), x.negative}, d = c;
    d.coefficient = y.coefficient, d.negative = y.negative;
    if (x.rest == y.rest) return dal__mul(graph, signed_sum(graph, c, d), x.rest);
    if (x.coefficient == y.coefficient && !is_one(graph, x.coefficient)) {
        x.coefficient = y.coefficient = one(graph);
        return dal__mul(graph, c.coefficient, signed_sum(graph, x, y));
    }
    dal__node f = 0;
    if (x.coefficient == y.coefficient && x.negative == y.negative) {
        f = pythagoras(graph, x.rest, y.rest);
    }
    if (f) return x.negative ? dal__neg(graph, f) : f;
    return common_denominator(graph, x, y);
}

/* ---- sums ---- */

/* x + y as it is. */
static dal__node join(dal__graph *graph, dal__term x, dal__term y)
{
    bool negative = x.negative && y.negative;
    dal__term u = x, w = y, s = {one(graph), 0, negative};
    u.negative = w.negative = false;
    dal__node a = dal__attach(graph, u), b = dal__attach(graph, w);
    if (x.negative == y.negative) {
        s.rest = dal__commute(graph, DAL__ADD, a, b);
    } else {
        s.rest =
            x.negative ? dal__intern(graph, DAL__SUB, b, a) : dal__intern(graph, DAL__SUB, a, b);
    }
    return dal__attach(graph, s);
}

/* Where x is a sum and y combines with one of its two parts: the sum of the rest and that. */
static dal__node absorb(dal__graph *graph, dal__term x, dal__term y)
{
    dal__record r = graph->node[x.rest];
    if ((r.op != DAL__ADD && r.op != DAL__SUB) || !is_one(graph, x.coefficient)) return 0;
    dal__term p = dal__split(graph, r.a), q = dal__split(graph, r.b);
    p.negative = p.negative != x.negative;
    q.negative = q.negative != (x.negative != (r.op == DAL__SUB));
    dal__node merged = combine(graph, q, y);
    if (merged) return signed_sum(graph, p, dal__split(graph, merged));
    merged = combine(graph, p, y);
    return merged ? signed_sum(graph, q, dal__split(graph, merged)) : 0;
}

static bool is_zero(const dal__graph *graph, dal__term x)
{
    return dal__is_number(graph, x.coefficient, 0.0);
}

static dal__node signed_sum(dal__graph *graph, dal__term x, dal__term y)
{
    if (graph->status) return 0;
    if (is_zero(graph, x)) return dal__attach(graph, y);
    if (is_zero(graph, y)) return dal__attach(graph, x);
    if (graph->depth >= DAL__DEEPEST) return join(graph, x, y);
    graph->depth++;
    dal__node sum = combine(graph, x, y);
    if (!sum) sum = absorb(graph, x, y);
    if (!sum) sum = absorb(graph, y, x);
    graph->depth--;
    return sum ? sum : join(graph, x, y);
}

static dal__node add(dal__graph *graph, dal__node a, dal__node b, bool minus)
{
    if (!a || !b) return 0;
    dal__record r = graph->node[a], s = graph->node[b];
    if (r.op == DAL__NUMBER && s.op == DAL__NUMBER) {
        double sum = minus ? r.value - s.value : r.value + s.value;
        if (isfinite(sum)) return dal__number(graph, sum);
    }
    dal__term x = dal__split(graph, a), y = dal__split(graph, b);
    y.negative = y.negative != minus;
    return signed_sum(graph, x, y);
}

dal__node dal__add(dal__graph *graph, dal__node a, dal__node b) { return add(graph, a, b, false); }
dal__node dal__sub(dal__graph *graph, dal__node a, dal__node b) { return add(graph, a, b, true); }
