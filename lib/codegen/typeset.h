/* typeset.h - nodes of a graph as formulas in LaTeX, or as in a system file. */
#ifndef DAL_CODEGEN_TYPESET_H
#define DAL_CODEGEN_TYPESET_H

#include "core/buffer.h"
#include "expr/graph.h"
#include <stdbool.h>

/* Appends the name of a symbol, or of a table. */
typedef void dal__symbol_writer(const void *user, int symbol, dal__buffer *text);
/* Appends the name of a node that has one; returns whether it has. */
typedef bool dal__node_namer(const void *user, dal__node node, dal__buffer *text);
typedef struct dal__typeset_options {
    dal__symbol_writer *symbol, *table;
    dal__node_namer *name; /* NULL: no node */
    const void *user;
    const char *letter;   /* of what gets a name: letter_k */
    size_t shared_length; /* that is what occurs several times and is longer */
    /* What was typeset of the graph before, whose names keep their meaning; NULL: nothing. */
    const struct dal__typesetter *before;
    bool is_plain; /* in the language of formulas of a system file instead of LaTeX */
} dal__typeset_options;

typedef struct dal__typesetter dal__typesetter;

/* Typesets these nodes, of which some may be 0. [alloc]  Errors: DAL_STATUS_MEMORY;
 * DAL_STATUS_TOO_LARGE, a formula is longer than a megabyte. */
dal_status dal__typesetter_create(dal__typesetter **typesetter, dal__graph *graph,
                                  const dal__node *nodes, int count,
                                  const dal__typeset_options *options);
void dal__typesetter_free(dal__typesetter *typesetter);
/* One of those nodes as a formula. */
const char *dal__typeset(const dal__typesetter *typesetter, dal__node node);
/* What its name i means, from 0, and the name, of those that it adds; NULL past the last. */
const char *dal__typeset_shared(const dal__typesetter *typesetter, int i, const char **name);
/* A name as letters with a subscript: theta1 as \theta_{1}, x_ball as x_{ball}; accent, as \dot, is
 * put on the letters; NULL: none. */
void dal__typeset_name(const char *name, const char *accent, dal__buffer *text);

/* The code point of a Greek letter that is named in full; 0: it is none. */
int dal__greek_letter(const char *name, size_t length);

#endif
