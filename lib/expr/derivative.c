/* derivative.c - exact derivatives of a graph, as further nodes of it.
 *
 *     reverse:  fbar = 1,  abar += ybar dy/da  for every y(a, ...), from f down to the symbols
 *     forward:  ydot = sum dy/da adot,         from the symbols up to f
 *
 * Both sweeps visit only what lies between the symbols and f. */
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include <stdlib.h>

static dal__node number(dal__graph *graph, double value) { return dal__number(graph, value); }

static dal__node square(dal__graph *graph, dal__node x) { return dal__node_mul(graph, x, x); }

/* sqrt(c + sign x^2) */
static dal__node root(dal__graph *graph, double c, double sign, dal__node x)
{
    dal__node x2 = dal__node_mul(graph, number(graph, sign), square(graph, x));
    return dal__apply(graph, DAL__SQRT, dal__node_add(graph, number(graph, c), x2), 0);
}

/* k f'(a) of y = f(a), for the functions of one argument. */
static dal__node by_argument(dal__graph *g, dal__op op, dal__node y, dal__node a, dal__node k)
{
    dal__node one = number(g, 1.0);
    switch (op) {
    case DAL__NEG:
        return dal__node_neg(g, k);
    case DAL__SQRT:
        return dal__node_div(g, k, dal__node_mul(g, number(g, 2.0), y));
    case DAL__EXP:
        return dal__node_mul(g, k, y);
    case DAL__LOG:
        return dal__node_div(g, k, a);
    case DAL__SIN:
        return dal__node_mul(g, k, dal__apply(g, DAL__COS, a, 0));
    case DAL__COS:
        return dal__node_neg(g, dal__node_mul(g, k, dal__apply(g, DAL__SIN, a, 0)));
    case DAL__TAN:
        return dal__node_mul(g, k, dal__node_add(g, one, square(g, y)));
    case DAL__ASIN:
        return dal__node_div(g, k, root(g, 1.0, -1.0, a));
    case DAL__ACOS:
        return dal__node_neg(g, dal__node_div(g, k, root(g, 1.0, -1.0, a)));
    case DAL__ATAN:
        return dal__node_div(g, k, dal__node_add(g, one, square(g, a)));
    case DAL__SINH:
        return dal__node_mul(g, k, dal__apply(g, DAL__COSH, a, 0));
    case DAL__COSH:
        return dal__node_mul(g, k, dal__apply(g, DAL__SINH, a, 0));
    case DAL__TANH:
        return dal__node_mul(g, k, dal__node_sub(g, one, square(g, y)));
    case DAL__ASINH:
        return dal__node_div(g, k, root(g, 1.0, 1.0, a));
    case DAL__ABS:
        return dal__node_mul(g, k, dal__apply(g, DAL__SIGN, a, 0));
    default:
        return number(g, 0.0); /* SIGN is piecewise constant */
    }
}

/* k dy/da of y = a op b. */
static dal__node by_first(dal__graph *g, dal__op op, dal__node a, dal__node b, dal__node k)
{
    switch (op) {
    case DAL__MUL:
        return dal__node_mul(g, k, b);
    case DAL__DIV:
        return dal__node_div(g, k, b);
    case DAL__POW: {
        dal__node less = dal__apply(g, DAL__POW, a, dal__node_sub(g, b, number(g, 1.0)));
        return dal__node_mul(g, k, dal__node_mul(g, b, less));
    }
    case DAL__ATAN2:
        return dal__node_div(g, dal__node_mul(g, k, b),
                             dal__node_add(g, square(g, a), square(g, b)));
    default:
        return k; /* ADD, SUB */
    }
}

/* k dy/db of y = a op b. */
static dal__node by_second(dal__graph *g, dal__op op, dal__node y, dal__node a, dal__node b,
                           dal__node k)
{
    switch (op) {
    case DAL__SUB:
        return dal__node_neg(g, k);
    case DAL__MUL:
        return dal__node_mul(g, k, a);
    case DAL__DIV:
        return dal__node_neg(g, dal__node_div(g, dal__node_mul(g, k, y), b));
    case DAL__POW:
        return dal__node_mul(g, k, dal__node_mul(g, y, dal__apply(g, DAL__LOG, a, 0)));
    case DAL__ATAN2:
        return dal__node_neg(g, dal__node_div(g, dal__node_mul(g, k, a),
                                              dal__node_add(g, square(g, a), square(g, b))));
    default:
        return k; /* ADD */
    }
}

/* k times the derivative of node y by its operand (0 the first, 1 the second). */
static dal__node partial(dal__graph *graph, dal__node y, int operand, dal__node k)
{
    dal__record r = graph->node[y];
    dal__op op = (dal__op)r.op;
    if (!r.b) return by_argument(graph, op, y, r.a, k);
    return operand == 0 ? by_first(graph, op, r.a, r.b, k) : by_second(graph, op, y, r.a, r.b, k);
}

static int position(const int *symbols, int count, int symbol)
{
    int k = 0;
    while (k < count && symbols[k] != symbol) k++;
    return k;
}

/* Marks the nodes between f and the symbols, as dal__reach does. [alloc] */
static uint8_t *between(dal__graph *graph, dal__node f, const int *symbols, int count)
{
    uint8_t *mark = dal__reach(graph, f);
    if (!mark) return NULL;
    for (dal__node i = 1; i <= f; i++) {
        const dal__record *r = &graph->node[i];
        if (!mark[i]) continue;
        mark[i] = r->op == DAL__SYMBOL ? position(symbols, count, r->symbol) < count
                                       : mark[r->a] || mark[r->b];
    }
    return mark;
}

static void reverse(dal__graph *graph, dal__node f, const uint8_t *active, dal__node *adjoint)
{
    adjoint[f] = number(graph, 1.0);
    for (dal__node i = f; i > 0; i--) {
        if (!active[i] || graph->node[i].op == DAL__SYMBOL) continue;
        dal__node operand[2] = {graph->node[i].a, graph->node[i].b};
        for (int k = 0; k < 2; k++) {
            dal__node x = operand[k];
            if (!active[x]) continue;
            dal__node term = partial(graph, i, k, adjoint[i]);
            adjoint[x] = adjoint[x] ? dal__node_add(graph, adjoint[x], term) : term;
        }
    }
}

void dal__gradient(dal__graph *graph, dal__node f, const int *symbols, int count, dal__node *out)
{
    uint8_t *active = between(graph, f, symbols, count);
    dal__node *adjoint = dal__per_node(graph, f, sizeof *adjoint);
    if (active && adjoint) reverse(graph, f, active, adjoint);
    for (int k = 0; k < count; k++) {
        dal__node x = dal__find_symbol(graph, symbols[k]);
        bool inside = adjoint && x && x <= f && adjoint[x];
        out[k] = inside ? adjoint[x] : number(graph, 0.0);
    }
    free(active);
    free(adjoint);
}

static dal__node forward(dal__graph *graph, dal__node i, const uint8_t *active,
                         const dal__node *tangent)
{
    dal__node operand[2] = {graph->node[i].a, graph->node[i].b}, sum = number(graph, 0.0);
    for (int k = 0; k < 2; k++) {
        dal__node x = operand[k];
        if (active[x]) sum = dal__node_add(graph, sum, partial(graph, i, k, tangent[x]));
    }
    return sum;
}

dal__node dal__tangent(dal__graph *graph, dal__node f, const int *symbols, int count,
                       const dal__node *seeds)
{
    uint8_t *active = between(graph, f, symbols, count);
    dal__node *tangent = dal__per_node(graph, f, sizeof *tangent), result = number(graph, 0.0);
    for (dal__node i = 1; active && tangent && i <= f; i++) {
        dal__record r = graph->node[i];
        if (!active[i]) continue;
        tangent[i] = r.op == DAL__SYMBOL ? seeds[position(symbols, count, r.symbol)]
                                         : forward(graph, i, active, tangent);
    }
    if (active && tangent && active[f]) result = tangent[f];
    free(active);
    free(tangent);
    return graph->status ? 0 : result;
}
