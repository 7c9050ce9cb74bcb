/* model.h - a model: its entries, its equations, its systems.
 *
 * Entries (texts with places) are parsed by formulas.c, derived from by derive.c,
 * properties.c and energy.c, compiled by programs.c and made a dal_system by system.c.
 * All memory of a model is in one list and is freed with it. */
#ifndef DAL_MODEL_MODEL_H
#define DAL_MODEL_MODEL_H

#include "core/error.h"
#include "core/pool.h"
#include "expr/table.h"
#include "model/equations.h"
#include "model/program_list.h"

enum {
    DAL__MAX_ENTRIES = 4096,     /* of a model, all sections together, as they are given */
    DAL__MAX_COORDINATES = 1024, /* W alone has the square of them */
    DAL__MAX_EVENTS = 256,
    DAL__MAX_BYTES = 1 << 22, /* of a system file with its tables */
    DAL__MAX_POINTS = 100000, /* of a table */
    DAL__MAX_LETTERS = 100    /* of a name; pi_NAME fits into every buffer of 128 */
};

/* How the entries of a section stand in a file; in mappings each has a name and a text. */
typedef enum dal__form {
    DAL__FORM_SCALAR,
    DAL__FORM_LIST,
    DAL__FORM_MAPPING,
    DAL__FORM_MAPPINGS
} dal__form;

typedef struct dal__model_section {
    dal__form form;
    const char *label; /* how a message calls a formula of it; NULL: its texts are no formulas */
} dal__model_section;
extern const dal__model_section dal__sections[DAL_SECTION_COUNT];
const char *dal__section_name(dal_section section);

/* One text of a model, and where it and its name stood. */
typedef struct dal__entry {
    dal_section section;
    const char *name; /* NULL in lists and scalars */
    const char *text;
    int line, column, name_line, name_column;
    int item;          /* in a list of mappings: which, from 1; otherwise 0 */
    bool observed;     /* an invariant by dal_model_observe */
    bool apart;        /* of "for i = 1..N: formula": the place is the formula's */
    const char *index; /* a name that is the number at in the formula; NULL: none */
    int at;
} dal__entry;
#define DAL__AT_NAME(entry) (entry)->name_line, (entry)->name_column
#define DAL__AT_TEXT(entry) (entry)->line, (entry)->column

/* What the entries of a list or mapping within a section are called: what an event sets, "set.x'",
 * and what a start solves, "solve.x'".  The name after that, "x'"; NULL: the entry is no such. */
extern const char dal__set_prefix[], dal__solve_prefix[];
const char *dal__set_name(const dal__entry *entry);
const char *dal__solved_name(const dal__entry *entry);

/* A warning and its place. */
typedef struct dal__warning {
    const char *text;
    int line, column;
    struct dal__warning *next;
} dal__warning;

/* A tangent system: of the model, or by a parameter. */
typedef struct dal__tangent_system {
    dal__programs programs;
    dal_system system;
    bool made;
} dal__tangent_system;

struct dal_model {
    char *name;
    dal__pool memory;   /* all of it */
    bool out_of_memory; /* an allocation failed */
    dal__entry *given;  /* [given_count] */
    int given_count, given_capacity;
    dal__entry *expanded; /* [expanded_count]: those with indices and ranges written out */
    int expanded_count, expanded_capacity;
    const dal__entry *entries; /* [count]: one of the two */
    int count;
    dal__tape_table *table; /* [tables], in the order of their entries */
    int tables, table_capacity;
    dal_effort effort;    /* chosen by dal_model_set_effort */
    bool has_other_gauge; /* chosen by dal_model_set_gauge */
    dal_mechanics mechanics;
    bool has_other_mechanics; /* chosen, and not its own */
    const char *source;       /* [source_length] the text of a file; NULL: none */
    size_t source_length;
    dal__warning *warning; /* of the last attempt to make the system */
    dal__equations equations;
    bool made;
    dal__programs programs, extended_programs;
    dal__tangent_system **tangent;      /* [1 + parameters] those that were made; or NULL */
    dal__terms *terms, *reaction_terms; /* of D, E, invariants; of h, R; NULL: not made */
    double *units;                      /* of the system, see dal_system */
    dal_system system, extended;
};

/* count*size bytes of zeros that are freed with the model; NULL, and out_of_memory is set, when
 * there are none.  The second allocates nodes, each the initial one. */
void *dal__model_allocate(dal_model *model, size_t count, size_t size);
dal__node *dal__model_nodes(dal_model *model, int count, dal__node initial);
char *dal__model_print(dal_model *model, const char *format, ...) DAL__PRINTF(2, 3);
char *dal__model_copy(dal_model *model, const char *text, size_t length); /* with a NUL after it */
/* Frees the entries, all that was allocated, and the model. */
void dal__model_discard(dal_model *model);
/* Adds a warning at the name of an entry; text lives as long as the model. */
void dal__model_warn(dal_model *model, const dal__entry *entry, const char *text);
/* The error DAL_STATUS_MEMORY or DAL_STATUS_TOO_LARGE of a graph. */
dal_status dal__size_error(dal_status status, dal_error *error);
/* The same unless status is DAL_STATUS_OK. */
dal_status dal__check_size(dal_status status, dal_error *error);
/* What a function returns to a user: that memory of the model ran out, or that its graph is full,
 * wins over what later steps made of the missing nodes.  Functions between leave both to it: they
 * return early, and no status of their own. */
dal_status dal__model_conclude(const dal_model *model, dal_status status, dal_error *error);
/* The error that an entry is given twice. */
dal_status dal__duplicate(const dal__entry *entry, dal_error *error);
/* Adds a copy of the entry. */
dal_status dal__model_insert(dal_model *model, dal__entry entry, dal_error *error);
/* Entry number i of a section, or NULL past the last; and how many there are. */
const dal__entry *dal__model_entry(const dal_model *model, dal_section section, int i);
/* The entry of row a of D, from 0: of constraints, then of holonomic. */
const dal__entry *dal__constraint_entry(const dal_model *model, int a);
int dal__model_count(const dal_model *model, dal_section section);

#endif
