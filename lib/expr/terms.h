/* terms.h - the size of the terms that a formula adds up. */
#ifndef DAL_EXPR_TERMS_H
#define DAL_EXPR_TERMS_H

#include "expr/graph.h"

/* Some formulas, to be evaluated together with the sizes of their terms; constant. */
typedef struct dal__terms dal__terms;

/* Copies what formula[count] need of a graph; NULL: out of memory. [alloc] */
dal__terms *dal__terms_create(dal__graph *graph, const dal__node *formula, int count);
void dal__terms_free(dal__terms *terms);
/* Lets scales count what is constant along a run, too: a difference of parameters may be 0. */
void dal__terms_count_fixed(dal__terms *terms);

/* Doubles of memory that an evaluation takes. */
size_t dal__terms_memory(const dal__terms *terms);
/* The scale of each formula, out[count], for the values of all symbols: see terms.c. */
void dal__terms_scales(const dal__terms *terms, const double *symbol, double *memory, double *out);

#endif
