/* graph.h - expressions as a graph of nodes.
 *
 *     text --parser--> graph --derivative--> graph --schedule--> tapes --tape, emit--> numbers, C
 *
 * A node is an operation with operands of smaller index, so every pass over a graph is a loop and
 * never a recursion; hashing keeps equal nodes single.  Node 0 is no node.  A graph only grows.  A
 * node is fixed when it depends on parameters alone, so it is constant along a run.
 *
 * Canonical form (simplify.c).  Every node is a term +-c*r whose coefficient c is fixed and whose
 * rest r is not; the sign sits at the coefficient, (-c)*r, or is a NEG where c = 1.  The numeric
 * factor of a fixed product comes first, operands of ADD and MUL are ordered by index, a quotient
 * of quotients is one quotient, and x/c is (1/c)*x wherever 1/c costs nothing in accuracy or in
 * time.
 *
 * When memory is out or the graph exceeds its limit, its status says so: nodes made from then on
 * are 0, and every function accepts node 0.  Those who make formulas for others leave it there; the
 * function that began returns it when all are made. */
#ifndef DAL_EXPR_GRAPH_H
#define DAL_EXPR_GRAPH_H

#include "dalembert_status.h"
#include <stdbool.h>
#include <stdint.h>

typedef int32_t dal__node; /* 0: no node */

/* Operations: code, arity, name in a formula (NULL: not callable by name).  A name of a system wins
 * over functions from SIGN on, which are younger than systems that may use the name. */
#define DAL__OP_LIST(OP)                                                                           \
    OP(NUMBER, 0, NULL)                                                                            \
    OP(SYMBOL, 0, NULL)                                                                            \
    OP(ADD, 2, NULL)                                                                               \
    OP(SUB, 2, NULL)                                                                               \
    OP(MUL, 2, NULL)                                                                               \
    OP(DIV, 2, NULL)                                                                               \
    OP(NEG, 1, NULL)                                                                               \
    OP(POW, 2, NULL) /* real exponent */                                                           \
    OP(SQRT, 1, "sqrt")                                                                            \
    OP(EXP, 1, "exp")                                                                              \
    OP(LOG, 1, "log")                                                                              \
    OP(SIN, 1, "sin")                                                                              \
    OP(COS, 1, "cos")                                                                              \
    OP(TAN, 1, "tan")                                                                              \
    OP(ASIN, 1, "asin")                                                                            \
    OP(ACOS, 1, "acos")                                                                            \
    OP(ATAN, 1, "atan")                                                                            \
    OP(ATAN2, 2, "atan2")                                                                          \
    OP(SINH, 1, "sinh")                                                                            \
    OP(COSH, 1, "cosh")                                                                            \
    OP(TANH, 1, "tanh")                                                                            \
    OP(ASINH, 1, "asinh")                                                                          \
    OP(ABS, 1, "abs")                                                                              \
    OP(SIGN, 1, "sign") /* derivative of abs */                                                    \
    OP(FLOOR, 1, "floor")                                                                          \
    OP(MIN, 2, "min")                                                                              \
    OP(MAX, 2, "max")                                                                              \
    OP(HYPOT, 2, "hypot")                                                                          \
    OP(LESS, 2, NULL) /* comparisons: 0 or 1 */                                                    \
    OP(LESS_EQUAL, 2, NULL)                                                                        \
    OP(EQUAL, 2, NULL)                                                                             \
    OP(IF, 3, "if")    /* b where a is not 0, else c */                                            \
    OP(TABLE, 1, NULL) /* a derivative of a table; its symbol: DAL__TABLE_ORDERS*table + order */

typedef enum dal__op {
#define CODE(code, arity, name) DAL__##code,
    DAL__OP_LIST(CODE)
#undef CODE
        DAL__OP_COUNT
} dal__op;

typedef struct dal__record {
    double value;      /* NUMBER */
    dal__node a, b, c; /* operands; 0 where there is none */
    int symbol;        /* SYMBOL, TABLE */
    uint8_t op;
    bool fixed;
} dal__record;

typedef struct dal__graph {
    dal__record *node;               /* [capacity]; node[0] is NaN */
    dal__node *table;                /* [1 << table_bits] open addressing; 0: free */
    int count, capacity, table_bits; /* count: of nodes, the last index */
    int limit;                       /* of count */
    int parameters;
    int depth;                            /* of simplifications under way */
    const struct dal__tape_table *tables; /* [table_count] of points, the caller's */
    int table_count;
    dal_status status; /* DAL_STATUS_OK, DAL_STATUS_MEMORY or DAL_STATUS_TOO_LARGE */
} dal__graph;

/* Symbols below parameters are constant along a run: nodes that depend on them alone are collected
 * into coefficients, and dividing by one becomes multiplying by a reciprocal.  NULL: out of memory.
 * [alloc] */
dal__graph *dal__graph_create(int parameters);
void dal__graph_free(dal__graph *graph);

/* The nodes of a number and of a symbol, made if missing. [alloc] */
dal__node dal__number(dal__graph *graph, double value);
dal__node dal__symbol(dal__graph *graph, int symbol); /* symbol >= 0, numbered by the caller */
/* The node with exactly this operation and operands, made if missing; no simplification. */
dal__node dal__intern(dal__graph *graph, dal__op op, dal__node a, dal__node b);
dal__node dal__intern_if(dal__graph *graph, dal__node a, dal__node b, dal__node c);
dal__node dal__intern_table(dal__graph *graph, int symbol, dal__node a);
/* The same, or 0 if missing; the node of a symbol, likewise. */
dal__node dal__find(const dal__graph *graph, dal__op op, dal__node a, dal__node b);
dal__node dal__find_symbol(const dal__graph *graph, int symbol);

/* What a node is; whether it is this number; whether it is 0. */
dal__record dal__inspect(const dal__graph *graph, dal__node node);
bool dal__is_number(const dal__graph *graph, dal__node node, double value);
bool dal__node_is_zero(const dal__graph *graph, dal__node node);

/* Zeros for each node up to this one, [node + 1] of size bytes; NULL, and the status is
 * DAL_STATUS_MEMORY, when there are none. [alloc] */
void *dal__per_node(dal__graph *graph, dal__node node, size_t size);

#endif
