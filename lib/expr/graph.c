/* graph.c - nodes and their hashing. */
#include "expr/graph.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_BITS = 8, MAX_NODES = 4000000 };

dal__graph *dal__graph_create(int parameters)
{
    dal__graph *graph = calloc(1, sizeof *graph);
    if (!graph) return NULL;
    graph->limit = MAX_NODES;
    graph->parameters = parameters;
    graph->table_bits = FIRST_BITS;
    graph->capacity = 1 << (FIRST_BITS - 1);
    graph->node = calloc((size_t)graph->capacity, sizeof *graph->node);
    graph->table = calloc((size_t)1 << FIRST_BITS, sizeof *graph->table);
    if (!graph->node || !graph->table) return dal__graph_free(graph), NULL;
    graph->node[0] = (dal__record){.op = DAL__NUMBER, .value = NAN, .fixed = true};
    return graph;
}

void dal__graph_free(dal__graph *graph)
{
    if (!graph) return;
    free(graph->node);
    free(graph->table);
    free(graph);
}

static uint64_t mix(uint64_t h, uint64_t word)
{
    h = (h ^ word) * UINT64_C(0x9e3779b97f4a7c15);
    return h ^ (h >> 29);
}

/* The place in the table that holds r, or the free one where it belongs. */
static dal__node *place(const dal__graph *graph, const dal__record *r)
{
    const size_t mask = ((size_t)1 << graph->table_bits) - 1;
    uint64_t bits, h = r->op;
    memcpy(&bits, &r->value, sizeof bits);
    h = mix(h, bits);
    h = mix(h, (uint64_t)(uint32_t)r->a << 32 | (uint32_t)r->b);
    h = mix(h, (uint64_t)(uint32_t)r->c << 32 | (uint32_t)r->symbol);
    for (size_t i = (size_t)(h >> (64 - graph->table_bits));; i = (i + 1) & mask) {
        const dal__record *s = &graph->node[graph->table[i]];
        const bool equal = r->op == s->op && r->a == s->a && r->b == s->b && r->c == s->c &&
                           r->symbol == s->symbol &&
                           memcmp(&r->value, &s->value, sizeof r->value) == 0;
        if (!graph->table[i] || equal) return &graph->table[i];
    }
}

/* Doubles the table and the nodes, which fill at most half of it. */
static bool grow(dal__graph *graph)
{
    size_t capacity = 2 * (size_t)graph->capacity;
    dal__record *node = realloc(graph->node, capacity * sizeof *node);
    if (!node) return false;
    graph->node = node;
    dal__node *table = calloc(2 * capacity, sizeof *table);
    if (!table) return false;
    free(graph->table);
    graph->table = table;
    graph->capacity = (int)capacity;
    graph->table_bits++;
    for (int i = 1; i <= graph->count; i++) *place(graph, &graph->node[i]) = i;
    return true;
}

static dal__node fail(dal__graph *graph, dal_status status)
{
    graph->status = status;
    return 0;
}

static dal__node keep(dal__graph *graph, dal__record r)
{
    if (graph->status) return 0;
    dal__node *at = place(graph, &r);
    if (*at) return *at;
    if (graph->count >= graph->limit) return fail(graph, DAL_STATUS_TOO_LARGE);
    if (graph->count + 1 == graph->capacity) {
        if (!grow(graph)) return fail(graph, DAL_STATUS_MEMORY);
        at = place(graph, &r);
    }
    graph->node[++graph->count] = r;
    return *at = graph->count;
}

dal__node dal__number(dal__graph *graph, double value)
{
    /* Adding 0 makes -0 the same node as 0. */
    return keep(graph, (dal__record){.op = DAL__NUMBER, .value = value + 0.0, .fixed = true});
}

dal__node dal__symbol(dal__graph *graph, int symbol)
{
    return keep(
        graph,
        (dal__record){.op = DAL__SYMBOL, .symbol = symbol, .fixed = symbol < graph->parameters});
}

dal__node dal__intern(dal__graph *graph, dal__op op, dal__node a, dal__node b)
{
    const dal__record *node = graph->node;
    bool fixed = node[a].fixed && (!b || node[b].fixed);
    return keep(graph, (dal__record){.op = (uint8_t)op, .a = a, .b = b, .fixed = fixed});
}

dal__node dal__intern_if(dal__graph *graph, dal__node a, dal__node b, dal__node c)
{
    const dal__record *node = graph->node;
    bool fixed = node[a].fixed && node[b].fixed && node[c].fixed;
    return keep(graph, (dal__record){.op = DAL__IF, .a = a, .b = b, .c = c, .fixed = fixed});
}

dal__node dal__intern_table(dal__graph *graph, int symbol, dal__node a)
{
    const bool fixed = graph->node[a].fixed;
    return keep(graph, (dal__record){.op = DAL__TABLE, .a = a, .symbol = symbol, .fixed = fixed});
}

dal__node dal__find(const dal__graph *graph, dal__op op, dal__node a, dal__node b)
{
    return *place(graph, &(dal__record){.op = (uint8_t)op, .a = a, .b = b});
}

dal__node dal__find_symbol(const dal__graph *graph, int symbol)
{
    bool fixed = symbol < graph->parameters;
    return *place(graph, &(dal__record){.op = DAL__SYMBOL, .symbol = symbol, .fixed = fixed});
}

void *dal__per_node(dal__graph *graph, dal__node node, size_t size)
{
    void *zeros = calloc((size_t)node + 1, size);
    if (!zeros && graph->status == DAL_STATUS_OK) graph->status = DAL_STATUS_MEMORY;
    return zeros;
}

dal__record dal__inspect(const dal__graph *graph, dal__node node) { return graph->node[node]; }

bool dal__is_number(const dal__graph *graph, dal__node node, double value)
{
    return graph->node[node].op == DAL__NUMBER && graph->node[node].value == value;
}

bool dal__node_is_zero(const dal__graph *graph, dal__node node)
{
    return dal__is_number(graph, node, 0.0);
}
