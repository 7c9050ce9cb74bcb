/* symbols.h - the names of a model, what they mean in a formula, and the parsing of one formula. */
#ifndef DAL_MODEL_SYMBOLS_H
#define DAL_MODEL_SYMBOLS_H

#include "model/model.h"

/* Collects the names of all sections into the equations and refuses clashes. */
dal_status dal__collect_names(dal_model *model, dal_error *error);
/* The index of name in names, or -1. */
int dal__index_of(const char *name, size_t length, const char *const *names, int count);

/* What a formula may contain; MULTIPLIERS: of vakonomic motion. */
enum {
    DAL__MAY_T = 1,
    DAL__MAY_STATE = 2,
    DAL__MAY_MULTIPLIERS = 4,
    DAL__MAY_REACTIONS = 8,
    DAL__MAY_ACCELERATIONS = 16,
    DAL__MAY_GAUGE = 32 /* e */
};
typedef struct dal__scope {
    const dal_model *model;
    unsigned may;
    const dal__node *given;          /* [2n] q, v of a start, 0: not given yet; NULL: no start */
    int parameters, lets, functions; /* those already known */
    const char *index;               /* a name that is the number at; NULL: none */
    int at;
    const struct dal__function *inside; /* whose body the formula is; NULL: none */
} dal__scope;

/* How messages call the formula of an entry: "force on x", "constraint 2". */
void dal__entry_title(const dal_model *model, const dal__entry *entry, char *title, size_t size);

/* Parses the text of an entry; the message of an error gets the entry's name and place. */
dal_status dal__parse_entry(dal_model *model, const dal__entry *entry, dal__scope scope,
                            dal__node *node, dal_error *error);
/* The error that the value of an entry is not finite. */
dal_status dal__not_finite(const dal_model *model, const dal__entry *entry, dal_error *error);
/* All parameters and lets, and what else a formula may contain: DAL__MAY_T | ... */
dal__scope dal__scope_of(const dal__equations *e, unsigned may);
/* Finds the index of a word in a list; what: how a message calls it. */
dal_status dal__find_word(const char *word, int line, int column, const char *what,
                          const char *const *words, int count, int *i, dal_error *error);

#endif
