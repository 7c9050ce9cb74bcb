/* formula.h - formulas: text to a hash-consed expression graph, exact derivatives, and tapes.
 *
 *     text --parse--> graph --derivative, gradient--> graph --tapes--> numbers
 *
 * A graph only grows; a node is an index, its operands have smaller indices, so every pass over a
 * graph is a loop and never a recursion.  Equal expressions are one node.  Constants are folded and
 * sums, products and quotients brought into one form as for real numbers (product.c, sum.c): on the
 * domain of a formula that changes no value but by rounding; 0*x and x/x lose their own gaps.
 * When memory is out or the graph grows past its limit, the graph remembers it: nodes made from
 * then on are 0, every function accepts node 0, and dal__graph_status tells. */
#ifndef DAL_FORMULA_H
#define DAL_FORMULA_H

#include "core/machine.h"
#include "dalembert.h"
#include <stdbool.h>
#include <stdint.h>

typedef struct dal__graph dal__graph;
typedef int32_t dal__node; /* 0: no node */

/* Operations: code, arity, name in a formula (NULL: not callable by name). */
#define DAL__OP_LIST(X)                                                                            \
    X(NUMBER, 0, NULL)                                                                             \
    X(SYMBOL, 0, NULL)                                                                             \
    X(ADD, 2, NULL)                                                                                \
    X(SUB, 2, NULL)                                                                                \
    X(MUL, 2, NULL)                                                                                \
    X(DIV, 2, NULL)                                                                                \
    X(NEG, 1, NULL)                                                                                \
    X(POW, 2, NULL) /* real exponent */                                                            \
    X(SQRT, 1, "sqrt")                                                                             \
    X(EXP, 1, "exp")                                                                               \
    X(LOG, 1, "log")                                                                               \
    X(SIN, 1, "sin")                                                                               \
    X(COS, 1, "cos")                                                                               \
    X(TAN, 1, "tan")                                                                               \
    X(ASIN, 1, "asin")                                                                             \
    X(ACOS, 1, "acos")                                                                             \
    X(ATAN, 1, "atan")                                                                             \
    X(ATAN2, 2, "atan2")                                                                           \
    X(SINH, 1, "sinh")                                                                             \
    X(COSH, 1, "cosh")                                                                             \
    X(TANH, 1, "tanh")                                                                             \
    X(ASINH, 1, "asinh")                                                                           \
    X(ABS, 1, "abs")                                                                               \
    X(SIGN, 1, NULL) /* derivative of abs */

typedef enum dal__op {
#define X(code, arity, name) DAL__##code,
    DAL__OP_LIST(X)
#undef X
        DAL__OP_COUNT
} dal__op;

dal__graph *dal__graph_create(void); /* NULL: out of memory */
void dal__graph_free(dal__graph *graph);
dal_status dal__graph_status(const dal__graph *graph); /* DAL_OK, DAL_MEMORY or DAL_TOO_LARGE */
int dal__graph_count(const dal__graph *graph);

/* Symbols below parameters are constant along a run: what is made of them and of numbers alone is
 * collected into coefficients, and dividing by it becomes multiplying by a reciprocal.  To be
 * called before the first symbol is made; without it no symbol is a parameter. */
void dal__graph_parameters(dal__graph *graph, int parameters);

dal__node dal__number(dal__graph *graph, double value);
dal__node dal__symbol(dal__graph *graph, int symbol); /* symbol >= 0, numbered by the caller */
dal__node dal__apply(dal__graph *graph, dal__op op, dal__node a, dal__node b); /* b: 0 if unary */
dal__node dal__add(dal__graph *graph, dal__node a, dal__node b);
dal__node dal__sub(dal__graph *graph, dal__node a, dal__node b);
dal__node dal__mul(dal__graph *graph, dal__node a, dal__node b);
dal__node dal__div(dal__graph *graph, dal__node a, dal__node b);
dal__node dal__neg(dal__graph *graph, dal__node a);

/* Looking at a node. */
typedef struct dal__view {
    dal__op op;
    dal__node a, b;
    double value; /* NUMBER */
    int symbol;   /* SYMBOL */
} dal__view;
dal__view dal__look(const dal__graph *graph, dal__node node);
bool dal__is_number(const dal__graph *graph, dal__node node, double value);
/* Whether node depends on a symbol with first <= symbol < end; true when memory is out, which the
 * graph remembers. */
bool dal__depends(dal__graph *graph, dal__node node, int first, int end);

/* Exact derivatives: of f by each symbol (reverse mode, one sweep), out[count]; and along a
 * direction: sum_i df/dsymbol_i * seed_i (forward mode). */
void dal__gradient(dal__graph *graph, dal__node f, const int *symbols, int count, dal__node *out);
dal__node dal__tangent(dal__graph *graph, dal__node f, const int *symbols, int count,
                       const dal__node *seeds);
/* f with each symbols[i] replaced by the node by[i]. */
dal__node dal__substitute(dal__graph *graph, dal__node f, const int *symbols, int count,
                          const dal__node *by);
/* The value of a node; values[symbol].  A slow way for single questions (pivots, starts); NaN when
 * memory is out, which the graph remembers. [alloc] */
double dal__evaluate(dal__graph *graph, dal__node node, const double *values);

/* ---- parser ---- */

/* Turns a name (or name' when prime) into a node; on 0 it has filled *error with the status and
 * message, the parser adds the place. */
typedef dal__node dal__resolve(void *user, const char *name, size_t length, bool prime,
                               dal_error *error);

/* Parses one formula.  error->line and column are relative to text, from 1.  Errors: DAL_SYNTAX,
 * DAL_NAME (also what resolve says), DAL_TOO_LARGE, DAL_MEMORY. */
dal_status dal__parse(dal__graph *graph, const char *text, size_t length, dal__resolve *resolve,
                      void *user, dal__node *node, dal_error *error);

/* Whether a name is that of a function, so that nothing else may carry it. */
bool dal__is_function(const char *name, size_t length);

/* ---- tapes ---- */

/* All programs of one system over one block of numbers:
 *     work = [ parameters | hoisted and constants | inputs | temporaries ]
 * Symbols 0..parameters-1 are parameters, the next inputs symbols are inputs.  Nodes that depend on
 * parameters alone are hoisted: computed by dal__tapes_prepare_x1, not by each run of a program.
 * A program's arithmetic for a node is the same in every program and at every width: same bits. */
typedef struct dal__tapes dal__tapes;

dal__tapes *dal__tapes_create(const dal__graph *graph, int parameters, int inputs);
void dal__tapes_free(dal__tapes *tapes);
/* Adds a program with these outputs and returns its number, from 0 (-1: out of memory). */
int dal__tapes_add(dal__tapes *tapes, const dal__node *outputs, int count);
/* Completes the set; afterwards it is constant and needs the graph no more.  Errors: DAL_MEMORY,
 * DAL_TOO_LARGE, DAL_ARGUMENT (an output is no node, or has a symbol that is neither). */
dal_status dal__tapes_finish(dal__tapes *tapes);
size_t dal__tapes_workspace(const dal__tapes *tapes);        /* numbers in work */
int dal__tapes_inputs(const dal__tapes *tapes);              /* where the inputs begin in work */
int dal__tapes_length(const dal__tapes *tapes, int program); /* instructions, for reports */
/* After the parameters in work have been set: one lane (a batch spreads the result), and one of
 * long numbers. */
void dal__tapes_prepare_x1(const dal__tapes *tapes, double *work);
void dal__tapes_prepare_x1_LONGER(const dal__tapes *tapes, double *work);
/* Runs a program on the inputs in work and writes its outputs; work and out are interleaved by
 * lanes and aligned to them. */
#define DAL__TAPE_RUN(name, variant, lanes, set, group)                                            \
    void name##_##variant(const dal__tapes *tapes, int program, double *work, double *out);
DAL__TAPE_RUN(dal__tape_run, x1, 1, BASE, x1)
DAL__VARIANT_LIST(DAL__TAPE_RUN, dal__tape_run)

/* Writes a program as C statements over num that set out[0], out[1], ...: its instructions one by
 * one, so that it computes the same bits.  Input number i is called input[i].text; parameters and
 * what was hoisted are DAL_WORK(place), with their places in work.  The second writes what
 * dal__tapes_prepare_x1 computes. */
typedef struct dal__input_name {
    char text[16];
} dal__input_name;
struct dal__text;
void dal__tape_write(const dal__tapes *tapes, int program, const dal__input_name *input,
                     struct dal__text *text);
void dal__tapes_write_hoisted(const dal__tapes *tapes, struct dal__text *text);

#endif
