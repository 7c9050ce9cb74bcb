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

/* ---- the derivatives of one operation ---- */

#define SUM(x, y)        dal__node_add(g, x, y)
#define DIFFERENCE(x, y) dal__node_sub(g, x, y)
#define PRODUCT(x, y)    dal__node_mul(g, x, y)
#define RATIO(x, y)      dal__node_div(g, x, y)
#define MINUS(x)         dal__node_neg(g, x)
#define SQUARE(x)        dal__node_mul(g, x, x)
#define OF(function, x)  dal__apply(g, DAL__##function, x, 0)

/* k dy/da and k dy/db of y = a op b; of abs it is sign, and that of sign is 0. */
#define DERIVATIVE_LIST(OF_BOTH, OF_ONE)                                                           \
    OF_BOTH(ADD, k, k)                                                                             \
    OF_BOTH(SUB, k, MINUS(k))                                                                      \
    OF_BOTH(MUL, PRODUCT(k, b), PRODUCT(k, a))                                                     \
    OF_BOTH(DIV, RATIO(k, b), MINUS(RATIO(PRODUCT(k, y), b)))                                      \
    OF_BOTH(POW, PRODUCT(k, PRODUCT(b, dal__apply(g, DAL__POW, a, DIFFERENCE(b, one)))),           \
            PRODUCT(k, PRODUCT(y, OF(LOG, a))))                                                    \
    OF_BOTH(ATAN2, RATIO(PRODUCT(k, b), SUM(SQUARE(a), SQUARE(b))),                                \
            MINUS(RATIO(PRODUCT(k, a), SUM(SQUARE(a), SQUARE(b)))))                                \
    OF_ONE(NEG, MINUS(k))                                                                          \
    OF_ONE(SQRT, RATIO(k, PRODUCT(number(g, 2.0), y)))                                             \
    OF_ONE(EXP, PRODUCT(k, y))                                                                     \
    OF_ONE(LOG, RATIO(k, a))                                                                       \
    OF_ONE(SIN, PRODUCT(k, OF(COS, a)))                                                            \
    OF_ONE(COS, MINUS(PRODUCT(k, OF(SIN, a))))                                                     \
    OF_ONE(TAN, PRODUCT(k, SUM(one, SQUARE(y))))                                                   \
    OF_ONE(ASIN, RATIO(k, root(g, 1.0, -1.0, a)))                                                  \
    OF_ONE(ACOS, MINUS(RATIO(k, root(g, 1.0, -1.0, a))))                                           \
    OF_ONE(ATAN, RATIO(k, SUM(one, SQUARE(a))))                                                    \
    OF_ONE(SINH, PRODUCT(k, OF(COSH, a)))                                                          \
    OF_ONE(COSH, PRODUCT(k, OF(SINH, a)))                                                          \
    OF_ONE(TANH, PRODUCT(k, DIFFERENCE(one, SQUARE(y))))                                           \
    OF_ONE(ASINH, RATIO(k, root(g, 1.0, 1.0, a)))                                                  \
    OF_ONE(ABS, PRODUCT(k, OF(SIGN, a)))

/* sqrt(c + sign x^2) */
static dal__node root(dal__graph *g, double c, double sign, dal__node x)
{
    dal__node x2 = PRODUCT(number(g, sign), SQUARE(x));
    return OF(SQRT, SUM(number(g, c), x2));
}

/* k times the derivative of node y by its operand (0 the first, 1 the second). */
static dal__node partial(dal__graph *g, dal__node y, int operand, dal__node k)
{
    const dal__node a = g->node[y].a, b = g->node[y].b, one = number(g, 1.0);
    switch ((dal__op)g->node[y].op) {
#define OF_BOTH(code, first, second)                                                               \
    case DAL__##code:                                                                              \
        return operand == 0 ? first : second;
#define OF_ONE(code, derivative)                                                                   \
    case DAL__##code:                                                                              \
        return derivative;
        DERIVATIVE_LIST(OF_BOTH, OF_ONE)
#undef OF_BOTH
#undef OF_ONE
    default:
        return number(g, 0.0);
    }
}

/* ---- all of a graph ---- */

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
