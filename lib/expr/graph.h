/* graph.h - the inside of an expression graph, for lib/expr alone.
 *
 * A node is an operation with operands of smaller index; hashing keeps equal nodes single.  Node 0
 * is no node.  A node is fixed when it depends on parameters alone, so it is constant along a run.
 *
 * Canonical form.  Every node is a term  +-c*r  whose coefficient c is fixed and whose rest r is
 * not; the sign sits at the coefficient, (-c)*r, or is a NEG where c = 1.  The numeric factor of a
 * fixed product stands first, operands of ADD and MUL are ordered by index, a quotient of quotients
 * is one quotient, and x/c is (1/c)*x wherever 1/c costs nothing in accuracy or in time. */
#ifndef DAL_FORMULA_GRAPH_H
#define DAL_FORMULA_GRAPH_H

#include "expr/formula.h"

/* Rules may call each other this deep; below, a node is made as it is. */
enum { DAL__DEEPEST = 8 };

typedef struct dal__record {
    double value; /* NUMBER */
    dal__node a, b;
    int symbol; /* SYMBOL */
    uint8_t op;
    bool fixed;
} dal__record;

struct dal__graph {
    dal__record *node; /* [capacity]; node[0] is NaN */
    dal__node *table;  /* [1 << table_bits] open addressing; 0: free */
    int count, capacity, table_bits;
    int limit; /* of count */
    int parameters;
    int depth; /* of simplifications under way */
    dal_status status;
};

typedef struct dal__term {
    dal__node coefficient, rest;
    bool negative;
} dal__term;

/* The node with exactly these parts, made where it is missing; no simplification. */
dal__node dal__intern(dal__graph *graph, dal__op op, dal__node a, dal__node b);
/* The same, or 0 where it is missing. */
dal__node dal__find(const dal__graph *graph, dal__op op, dal__node a, dal__node b);

/* The node of a symbol, or 0 where it is missing. */
dal__node dal__find_symbol(const dal__graph *graph, int symbol);

/* A node as +-c*r with c >= 0 where c is a number, and back. */
dal__term dal__split(dal__graph *graph, dal__node node);
dal__node dal__attach(dal__graph *graph, dal__term term);
/* The node of an ADD or MUL with ordered operands. */
dal__node dal__commute(dal__graph *graph, dal__op op, dal__node a, dal__node b);

/* Operations that are computed as one: both functions of one argument; and a sum or difference one
 * of whose operands is a product. */
enum {
    DAL__SINCOS = DAL__OP_COUNT, /* sin a and cos a */
    DAL__MUL_ADD,                /* a*b + c, rounded once; so the next two */
    DAL__MUL_SUB,                /* a*b - c */
    DAL__SUB_MUL                 /* c - a*b */
};

/* A node as it is computed, wherever it is: an operation of the graph, or a fused one.  What is
 * fused depends on the node alone: in a sum that is not fixed, a product that is not; of two
 * products the one made later, so that the other is there when it is needed. */
typedef struct dal__lowered {
    int op;
    dal__node a, b, c; /* 0 where there is none */
} dal__lowered;
dal__lowered dal__lower(const dal__graph *graph, dal__node node);

/* Zeros for each node up to this one, [node + 1] of size bytes; NULL when memory is out, which the
 * graph then remembers. [alloc] */
void *dal__per_node(dal__graph *graph, dal__node node, size_t size);
/* Marks node and all it is made of, [node + 1]; NULL likewise. [alloc] */
uint8_t *dal__reach(dal__graph *graph, dal__node node);
/* One operation on doubles, with the bits of a tape. */
double dal__operate(int op, double a, double b, double c);

#endif
