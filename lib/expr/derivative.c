/* derivative.c - exact derivatives of a graph, as further nodes of it.
 *
 *     reverse:  fbar = 1,  abar += ybar dy/da  for every y(a, ...), from f down to the symbols
 *     forward:  ydot = sum dy/da adot,         from the symbols up to f
 *
 * Both sweeps visit only what lies between the symbols and f.
 *
 * Of if, min and max the derivative is the taken operand's, and what the others give may be
 * no number: 0 times an adjoint would not be 0.  So the reverse sweep stops at such a branch y, and
 * goes down from each of its operands in a sweep of its own:
 *
 *     y = if(a, b, c):   dy/dx = if(a, db/dx, dc/dx),   df/dx += ybar dy/dx
 */
#include "expr/derivative.h"
#include "expr/partials.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include <stdlib.h>

/* ---- the derivatives of one operation ---- */

#define SUM(x, y)        dal__node_add(g, x, y)
#define DIFFERENCE(x, y) dal__node_sub(g, x, y)
#define PRODUCT(x, y)    dal__node_mul(g, x, y)
#define RATIO(x, y)      dal__node_div(g, x, y)
#define MINUS(x)         dal__node_neg(g, x)
#define SQUARE(x)        dal__node_mul(g, x, x)
#define NUMBER(x)        dal__number(g, x)
#define POWER(x, y)      dal__apply(g, DAL__POW, x, y)
#define DIRECTION(x, r)  direction(g, x, r)
#define ROOT(c, sign, x) root(g, c, sign, x)
#define TABLE_SLOPE(x)   dal__node_table(g, g->node[y].symbol + 1, x)
#define OF(function, x)  dal__apply(g, DAL__##function, x, 0)

/* sqrt(c + sign x^2) */
static dal__node root(dal__graph *g, double c, double sign, dal__node x)
{
    dal__node x2 = PRODUCT(dal__number(g, sign), SQUARE(x));
    return OF(SQRT, SUM(dal__number(g, c), x2));
}

/* x/r, or 0 where r is 0. */
static dal__node direction(dal__graph *g, dal__node x, dal__node r)
{
    dal__node zero = dal__number(g, 0.0);
    return dal__node_if(g, dal__apply(g, DAL__EQUAL, r, zero), zero, RATIO(x, r));
}

/* k times the derivative of node y by its operand (0 the first, 1 the second). */
static dal__node partial(dal__graph *g, dal__node y, int operand, dal__node k)
{
    const dal__node a = g->node[y].a, b = g->node[y].b;
    switch ((dal__op)g->node[y].op) {
#define OF_BOTH(code, first, second)                                                               \
    case DAL__##code:                                                                              \
        return operand == 0 ? first : second;
#define OF_ONE(code, derivative)                                                                   \
    case DAL__##code:                                                                              \
        return derivative;
        DAL__PARTIAL_LIST(OF_BOTH, OF_ONE)
#undef OF_BOTH
#undef OF_ONE
    default:
        return dal__number(g, 0.0);
    }
}

/* ---- branches ---- */

static bool is_branch(const dal__record *r)
{
    return r->op == DAL__IF || r->op == DAL__MIN || r->op == DAL__MAX;
}

/* if(condition, x, y) as the derivative of a branch whose operands have the derivatives b, and c
 * for the third; the node 0 is a derivative that is 0. */
static dal__node branch_derivative(dal__graph *g, dal__node y, const dal__node derivative[3])
{
    const dal__record r = g->node[y];
    dal__node d[3];
    for (int k = 0; k < 3; k++) d[k] = derivative[k] ? derivative[k] : dal__number(g, 0.0);
    if (r.op == DAL__IF) return dal__node_if(g, r.a, d[1], d[2]);
    dal__node second =
        r.op == DAL__MIN ? dal__apply(g, DAL__LESS, r.b, r.a) : dal__apply(g, DAL__LESS, r.a, r.b);
    return dal__node_if(g, second, d[1], d[0]);
}

/* ---- all of a graph ---- */

/* The symbols are most often in a row. */
static int position(const int *symbols, int count, int symbol)
{
    int k = count ? symbol - symbols[0] : 0;
    if (k >= 0 && k < count && symbols[k] == symbol) return k;
    k = 0;
    while (k < count && symbols[k] != symbol) k++;
    return k;
}

/* Whether a node has no derivative but 0. */
static bool is_step(const dal__record *r)
{
    return r->op == DAL__FLOOR || r->op == DAL__LESS || r->op == DAL__LESS_EQUAL ||
           r->op == DAL__EQUAL;
}

/* Marks the nodes between f and the symbols, as dal__reach does. [alloc] */
static uint8_t *between(dal__graph *graph, dal__node f, const int *symbols, int count)
{
    uint8_t *mark = dal__reach(graph, f);
    if (!mark) return NULL;
    for (dal__node i = dal__first_marked(mark, 1, f); i > 0;
         i = dal__first_marked(mark, i + 1, f)) {
        const dal__record *r = &graph->node[i];
        const bool condition = r->op == DAL__IF;
        mark[i] = r->op == DAL__SYMBOL ? position(symbols, count, r->symbol) < count
                  : is_step(r)         ? 0
                                       : (mark[r->a] && !condition) || mark[r->b] || mark[r->c];
    }
    return mark;
}

/* Adjoints of the symbols and branches that f reaches without passing a branch. */
static void reverse(dal__graph *graph, dal__node f, const uint8_t *active, dal__node *adjoint)
{
    adjoint[f] = dal__number(graph, 1.0);
    for (dal__node i = dal__last_marked(active, f); i > 0; i = dal__last_marked(active, i - 1)) {
        if (!adjoint[i] || graph->node[i].op == DAL__SYMBOL) continue;
        if (is_branch(&graph->node[i])) continue;
        dal__node operand[2] = {graph->node[i].a, graph->node[i].b};
        for (int k = 0; k < 2; k++) {
            dal__node x = operand[k];
            if (!active[x]) continue;
            dal__node term = partial(graph, i, k, adjoint[i]);
            adjoint[x] = adjoint[x] ? dal__node_add(graph, adjoint[x], term) : term;
        }
    }
}

/* What one gradient needs: the branches between f and the symbols, and their gradients. */
typedef struct sweep {
    const int *symbols;
    int count, branches;
    const uint8_t *active;
    dal__node *branch;   /* [branches], ascending */
    dal__node *gradient; /* [branches*count]; 0 where it is 0 */
} sweep;

/* The gradient of f, at[count], from the adjoints of symbols and of branches below it. */
static void gradient_of(dal__graph *graph, const sweep *s, dal__node f, dal__node *at)
{
    dal__node *adjoint = dal__per_node(graph, f, sizeof *adjoint);
    if (adjoint) reverse(graph, f, s->active, adjoint);
    for (int k = 0; k < s->count; k++) {
        dal__node x = dal__find_symbol(graph, s->symbols[k]);
        at[k] = adjoint && x && x <= f ? adjoint[x] : 0;
    }
    for (int i = 0; adjoint && i < s->branches && s->branch[i] <= f; i++) {
        const dal__node weight = adjoint[s->branch[i]], *by = s->gradient + i * s->count;
        for (int k = 0; weight && k < s->count; k++) {
            if (!by[k]) continue;
            dal__node term = dal__node_mul(graph, weight, by[k]);
            at[k] = at[k] ? dal__node_add(graph, at[k], term) : term;
        }
    }
    free(adjoint);
}

/* The gradients of all branches, those below a branch first; scratch[3*count]. */
static void differentiate_branches(dal__graph *graph, sweep *s, dal__node f, dal__node *scratch)
{
    const int count = s->count;
    for (dal__node i = 1; i <= f; i++) {
        const dal__record r = graph->node[i];
        const dal__node operand[3] = {r.op == DAL__IF ? 0 : r.a, r.b, r.c};
        if (!s->active[i] || !is_branch(&r)) continue;
        for (int k = 0; k < 3 * count; k++) scratch[k] = 0;
        for (int k = 0; k < 3; k++)
            if (s->active[operand[k]]) gradient_of(graph, s, operand[k], scratch + k * count);
        dal__node *out = s->gradient + s->branches * count;
        for (int k = 0; k < count; k++) {
            const dal__node d[3] = {scratch[k], scratch[count + k], scratch[2 * count + k]};
            out[k] = d[0] || d[1] || d[2] ? branch_derivative(graph, i, d) : 0;
        }
        s->branch[s->branches++] = i;
    }
}

void dal__gradient(dal__graph *graph, dal__node f, const int *symbols, int count, dal__node *out)
{
    uint8_t *active = between(graph, f, symbols, count);
    sweep s = {.symbols = symbols, .count = count, .active = active};
    dal__node branches = 0, *memory = NULL;
    for (dal__node i = active ? dal__first_marked(active, 1, f) : 0; i > 0;
         i = dal__first_marked(active, i + 1, f))
        branches += is_branch(&graph->node[i]);
    const size_t width = 1 + (size_t)count, numbers = (size_t)branches * width + 3 * width;
    if (branches) memory = calloc(numbers, sizeof *memory);
    if (branches && !memory) graph->status = DAL_STATUS_MEMORY;
    if (memory) {
        s.branch = memory;
        s.gradient = memory + branches;
        differentiate_branches(graph, &s, f, memory + (size_t)branches * width);
    }
    for (int k = 0; k < count; k++) out[k] = 0;
    if (active && graph->status == DAL_STATUS_OK) gradient_of(graph, &s, f, out);
    const dal__node zero = dal__number(graph, 0.0);
    for (int k = 0; k < count; k++)
        if (!out[k]) out[k] = zero;
    free(active);
    free(memory);
}

static dal__node forward(dal__graph *graph, dal__node i, const uint8_t *active,
                         const dal__node *tangent)
{
    const dal__record r = graph->node[i];
    const dal__node along[3] = {tangent[r.a], tangent[r.b], tangent[r.c]};
    if (is_branch(&r)) return branch_derivative(graph, i, along);
    dal__node operand[2] = {r.a, r.b}, sum = dal__number(graph, 0.0);
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
    dal__node *tangent = dal__per_node(graph, f, sizeof *tangent), result = dal__number(graph, 0.0);
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
