/* traversal.c - passes over a graph: dependence, values, substitution.
 *
 * Operands have smaller indices than their node, so marking runs down the indices and computing
 * runs up. */
#include "expr/traversal.h"
#include "expr/simplify.h"
#include "expr/table.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

dal__node dal__last_of(const dal__node *nodes, int count)
{
    dal__node last = 0;
    for (int k = 0; k < count; k++)
        if (nodes[k] > last) last = nodes[k];
    return last;
}

/* Whether 8 nodes from i on are all unmarked. */
static bool are_unmarked(const uint8_t *mark, dal__node i)
{
    uint64_t word;
    memcpy(&word, mark + i, sizeof word);
    return word == 0;
}

dal__node dal__last_marked(const uint8_t *mark, dal__node i)
{
    while (i > 8 && are_unmarked(mark, i - 7)) i -= 8;
    while (i > 0 && !mark[i]) i--;
    return i;
}

dal__node dal__first_marked(const uint8_t *mark, dal__node i, dal__node last)
{
    while (i + 7 <= last && are_unmarked(mark, i)) i += 8;
    while (i <= last && !mark[i]) i++;
    return i <= last ? i : 0;
}

uint8_t *dal__reach_all(dal__graph *graph, const dal__node *nodes, int count)
{
    const dal__node last = dal__last_of(nodes, count);
    uint8_t *mark = dal__per_node(graph, last, 1);
    if (!mark) return NULL;
    for (int k = 0; k < count; k++) mark[nodes[k]] = 1;
    for (dal__node i = dal__last_marked(mark, last); i > 0; i = dal__last_marked(mark, i - 1)) {
        const dal__record *r = &graph->node[i];
        mark[r->a] = mark[r->b] = mark[r->c] = 1;
    }
    mark[0] = 0;
    return mark;
}

uint8_t *dal__reach(dal__graph *graph, dal__node node) { return dal__reach_all(graph, &node, 1); }

bool dal__depends(dal__graph *graph, dal__node node, int first, int end)
{
    if (graph->node[node].fixed && first >= graph->parameters) return false;
    uint8_t *mark = dal__reach(graph, node);
    if (!mark) return true;
    bool found = false;
    for (dal__node i = node; i > 0 && !found; i = dal__last_marked(mark, i - 1)) {
        const dal__record *r = &graph->node[i];
        found = r->op == DAL__SYMBOL && r->symbol >= first && r->symbol < end;
    }
    free(mark);
    return found;
}

bool dal__reaches(dal__graph *graph, dal__node node, uint64_t operations)
{
    uint8_t *mark = dal__reach(graph, node);
    bool found = !mark;
    for (dal__node i = node; i > 0 && !found; i = dal__last_marked(mark, i - 1))
        found = !graph->node[i].fixed && operations >> graph->node[i].op & 1;
    free(mark);
    return found;
}

static bool is_product(const dal__graph *graph, dal__node node)
{
    return graph->node[node].op == DAL__MUL && !graph->node[node].fixed;
}

dal__lowered dal__lower(const dal__graph *graph, dal__node node)
{
    const dal__record *r = &graph->node[node];
    const bool sum = r->op == DAL__ADD || r->op == DAL__SUB;
    const bool first = sum && is_product(graph, r->a), second = sum && is_product(graph, r->b);
    if (r->fixed || (!first && !second)) return (dal__lowered){r->op, r->a, r->b, r->c};
    const bool later = second && (!first || r->b > r->a);
    const dal__record *product = &graph->node[later ? r->b : r->a];
    const int op = r->op == DAL__ADD ? DAL__MUL_ADD : later ? DAL__SUB_MUL : DAL__MUL_SUB;
    return (dal__lowered){op, product->a, product->b, later ? r->a : r->b};
}

bool dal__evaluate_all(dal__graph *graph, const dal__node *nodes, int count, const double *values,
                       double *out)
{
    const dal__node last = dal__last_of(nodes, count);
    uint8_t *mark = dal__reach_all(graph, nodes, count);
    double *x = dal__per_node(graph, last, sizeof *x);
    const bool in_memory = mark && x;
    for (dal__node i = in_memory ? dal__first_marked(mark, 1, last) : 0; i > 0;
         i = dal__first_marked(mark, i + 1, last)) {
        const dal__record *r = &graph->node[i];
        const dal__lowered l = dal__lower(graph, i);
        x[i] = r->op == DAL__NUMBER   ? r->value
               : r->op == DAL__SYMBOL ? values[r->symbol]
               : r->op == DAL__TABLE  ? dal__table_value(graph->tables, r->symbol, x[r->a])
                                      : dal__operate(l.op, x[l.a], x[l.b], x[l.c]);
    }
    for (int k = 0; k < count; k++) out[k] = in_memory && nodes[k] ? x[nodes[k]] : NAN;
    free(mark);
    free(x);
    return in_memory;
}

double dal__evaluate(dal__graph *graph, dal__node node, const double *values)
{
    double value;
    dal__evaluate_all(graph, &node, 1, values, &value);
    return value;
}

dal__node dal__rebuild(dal__graph *graph, dal__node i, const dal__node *image)
{
    dal__record r = graph->node[i];
    if (r.op == DAL__NUMBER || r.op == DAL__SYMBOL) return i;
    if (image[r.a] == r.a && image[r.b] == r.b && image[r.c] == r.c) return i;
    if (r.op == DAL__IF) return dal__node_if(graph, image[r.a], image[r.b], image[r.c]);
    if (r.op == DAL__TABLE) return dal__node_table(graph, r.symbol, image[r.a]);
    return dal__apply(graph, (dal__op)r.op, image[r.a], image[r.b]);
}

static dal__node replaced(dal__graph *graph, dal__node i, const dal__node *image,
                          const int *symbols, int count, const dal__node *by)
{
    const dal__record r = graph->node[i];
    for (int k = 0; r.op == DAL__SYMBOL && k < count; k++)
        if (symbols[k] == r.symbol) return by[k];
    return dal__rebuild(graph, i, image);
}

void dal__substitute_all(dal__graph *graph, int nodes, dal__node *node, const int *symbols,
                         int count, const dal__node *by)
{
    const dal__node last = dal__last_of(node, nodes);
    uint8_t *mark = dal__reach_all(graph, node, nodes);
    dal__node *image = dal__per_node(graph, last, sizeof *image);
    for (dal__node i = 1; mark && image && i <= last; i++)
        if (mark[i]) image[i] = replaced(graph, i, image, symbols, count, by);
    for (int k = 0; k < nodes; k++) node[k] = mark && image ? image[node[k]] : 0;
    free(mark);
    free(image);
}

dal__node dal__substitute(dal__graph *graph, dal__node f, const int *symbols, int count,
                          const dal__node *by)
{
    dal__substitute_all(graph, 1, &f, symbols, count, by);
    return f;
}
