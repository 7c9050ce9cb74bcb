/* mechanics.h - the inside of a model: its entries, its equations as graph nodes, its programs.
 *
 * The way of a model: entries (texts with places) -> formulas.c -> equations.c, properties.c ->
 * system.c.  All memory of a model hangs in one list and goes with it. */
#ifndef DAL_MECHANICS_H
#define DAL_MECHANICS_H

#include "core/error.h"
#include "expr/derivative.h"
#include "expr/parser.h"
#include "expr/simplify.h"
#include "expr/tape.h"
#include "expr/traversal.h"

enum {
    DAL__MOST_ENTRIES = 4096,    /* of a model, all sections together */
    DAL__MOST_COORDINATES = 256, /* W alone has the square of them */
    DAL__MOST_BYTES = 1 << 22,   /* of a system file */
    DAL__MOST_LETTERS = 100      /* of a name; pi_NAME has room in every buffer of 128 */
};

/* How the entries of a section stand in a file. */
typedef enum dal__form { DAL__SCALAR, DAL__LIST, DAL__MAPPING, DAL__MAPPINGS } dal__form;
dal__form dal__section_shape(dal_section section);
/* Whether each entry has a name and a text. */
bool dal__section_named(dal_section section);
const char *dal__section_name(dal_section section);

/* One text of a model, and where it and its name stood. */
typedef struct dal__entry {
    dal_section section;
    const char *name; /* NULL in lists and scalars */
    const char *text;
    int line, column, name_line, name_column;
    int item; /* in a list of mappings: which, from 1; otherwise 0 */
} dal__entry;

/* A pivot of the elimination.  It must not be small against what it was subtracted from. */
typedef struct dal__pivot {
    dal__node pivot, size;
    int constraint; /* whose, from 1; 0: of the mass matrix */
    bool watched;   /* in every program; the others only in the diagnosis */
} dal__pivot;

/* The equations of one model.  Every array lies in the model's memory; a missing node is 0 only in
 * exact (no solution given), otherwise the number 0. */
typedef struct dal__equations {
    dal__graph *graph;
    int parameters, n, m, multipliers, invariants, lets, guards, pivots;
    bool vakonomic, accelerations, servo, pictured;
    unsigned properties;
    /* First symbols of the inputs.  Twice the room for q, v and pi: the tangent system has 2n. */
    int t, q, v, pi, g, symbols;
    /* Formulas as given. */
    dal__node *let; /* [lets] */
    dal__node lagrangian;
    dal__node *force;      /* [n]: Q, or the accelerations */
    dal__node *constraint; /* [m]: D */
    dal__node *start;      /* [2n + multipliers + 1] */
    dal__node *invariant;  /* [invariants] */
    dal__node *exact;      /* [2n] or all 0 */
    dal__node mu;          /* mu_e, or 0 */
    dal__node *picture;    /* [DAL_PICTURE_COUNT], or NULL */
    dal_body body;
    /* Derived. */
    dal__node *W;         /* [n*n] */
    dal__node *b;         /* [n] */
    dal__node *momentum;  /* [n]: L_v */
    dal__node *A;         /* [m*n] */
    dal__node *B;         /* [m*n]: directions of the reactions; A itself by Chetaev's rule */
    dal__node *c;         /* [m] */
    dal__node *U;         /* [n*m]: W^-1 A^T, or 0s */
    dal__node *R;         /* [n*m]: W^-1 B^T; U itself by Chetaev's rule */
    dal__node *h;         /* [m]: multipliers of the constraints, not of vakonomic motion */
    dal__node *a;         /* [n]: W^-1 b, or 0s */
    dal__node *F;         /* [n + multipliers] */
    dal__node energy;     /* or 0 */
    dal__node *normal;    /* [1 + 3n]: E, E_q, E_v, W^-1 E_q; or NULL */
    dal__node *potential; /* [3n], see potential.c; or NULL */
    dal__node *extended;  /* [n]: F continued off D = 0 with E exact; or NULL */
    dal__node *guard;     /* [guards] */
    int mass_guard;       /* which of them is det W, from 1; 0: none */
    dal__pivot *pivot;    /* [pivots], room for 2 (n + m) */
    double *value;        /* [symbols]: default parameters, default start */
    int *symbol;          /* [symbols]: 0, 1, 2, ...; symbol + q are the symbols of q */
    dal__node *flow;      /* [1 + n]: d/dt of (t, q), that is 1 and v */
    /* Names. */
    const char **parameter, **coordinate, **let_name, **invariant_name, **guard_name, **tag;
    int tags;
} dal__equations;

/* The programs of a system.  Of each: the name and what of the inputs it reads. */
enum { DAL__T = 1, DAL__QV = 2, DAL__PI = 4 };
#define DAL__WIDE_LIST(X)                                                                          \
    X(FIELD, field, DAL__T | DAL__QV)                                                              \
    X(ADJOINT, adjoint, DAL__T | DAL__QV | DAL__PI)                                                \
    X(JACOBIAN, jacobian, DAL__T | DAL__QV)                                                        \
    X(CONSTRAINT, constraint, DAL__T | DAL__QV)                                                    \
    X(ENERGY_NORMAL, energy_normal, DAL__T | DAL__QV)                                              \
    X(GAUGE, gauge, DAL__T)                                                                        \
    X(GUARDS, guards, DAL__T | DAL__QV)                                                            \
    X(PARTS, parts, DAL__T | DAL__QV)                                                              \
    X(POTENTIAL, potential, DAL__T | DAL__QV)
#define DAL__SINGLE_LIST(X)                                                                        \
    X(START, start, 0)                                                                             \
    X(CONSTRAINTS, constraints, DAL__T | DAL__QV)                                                  \
    X(ENERGY, energy, DAL__T | DAL__QV)                                                            \
    X(INVARIANTS, invariant_values, DAL__T | DAL__QV)                                              \
    X(PICTURE, picture, DAL__T | DAL__QV)                                                          \
    X(EXACT, exact, DAL__T)

typedef enum dal__program_code {
#define X(code, name, reads) DAL__PROGRAM_##code,
    DAL__WIDE_LIST(X) DAL__SINGLE_LIST(X)
#undef X
        DAL__PROGRAM_DIAGNOSE,
    DAL__PROGRAM_COUNT
} dal__program_code;

typedef struct dal__program {
    bool present;
    int tape;    /* number in the tapes */
    int outputs; /* for the caller */
    int watched; /* pivots, each with its size, that follow the outputs */
} dal__program;

/* Evaluates a program on what it reads of *at. */
typedef dal_status dal__run_program(const dal_system *system, const dal_at *at, double *out,
                                    dal__program_code code, unsigned reads);

/* What a dal_system of a model holds as its data. */
typedef struct dal__programs {
    dal__tapes *tapes;
    const dal__equations *equations;
    int n, multipliers; /* of this system: 2n, 0 for the tangent one */
    int t, q, v, pi, g; /* places of the inputs in work */
    size_t scratch;     /* place in work for outputs and watched pivots together */
    dal__program program[DAL__PROGRAM_COUNT];
    dal_callbacks wide1, wide4, wide8, wide64;
    dal__run_program *run; /* a program of one lane */
} dal__programs;

/* A system again, its numbers being long. */
typedef struct dal__in_long {
    dal__programs programs; /* the same; not their owner */
    dal_system system;
} dal__in_long;

/* A pivot must exceed this fraction of what it was subtracted from: some hundred times the rounding
 * of the subtraction, so that three digits of it are true. */
#define DAL__PIVOT_LEAST 1e-13

struct dal_model {
    char *name;
    struct dal__block *blocks; /* all memory */
    bool starved;              /* an allocation failed */
    dal__entry *entries;
    int count, capacity;
    dal__equations equations;
    bool made, tangent_made;
    dal__programs programs, tangent_programs, extended_programs;
    dal_system system, tangent, extended;
};

/* ---- model.c ---- */

/* count*size bytes of zeros that go with the model; NULL (and starved) when memory is out. */
void *dal__model_take(dal_model *model, size_t count, size_t size);
char *dal__model_print(dal_model *model, const char *format, ...) DAL__PRINTF(2, 3);
dal_status dal__starved(dal_error *error);
/* The message for DAL_MEMORY or DAL_TOO_LARGE. */
dal_status dal__exhausted(dal_status status, dal_error *error);
/* Adds a copy of the entry. */
dal_status dal__model_insert(dal_model *model, dal__entry entry, dal_error *error);
/* Entry number i of a section, or NULL past the last; and how many there are. */
const dal__entry *dal__model_entry(const dal_model *model, dal_section section, int i);
int dal__model_count(const dal_model *model, dal_section section);
/* Whether the first length characters of text are a name: a letter, then letters, digits, _. */
bool dal__is_name(const char *text, size_t length);

/* ---- names.c ---- */

/* Collects the names of all sections into the equations and refuses clashes. */
dal_status dal__names(dal_model *model, dal_error *error);
/* The index of name in names, or -1. */
int dal__index_of(const char *name, size_t length, const char *const *names, int count);

/* What a formula may contain. */
enum { DAL__MAY_T = 1, DAL__MAY_STATE = 2, DAL__MAY_MULTIPLIERS = 4 };
typedef struct dal__scope {
    const dal_model *model;
    unsigned may;
    int parameters, lets; /* those already known */
} dal__scope;
dal__node dal__resolve_name(void *scope, const char *name, size_t length, bool prime,
                            dal_error *error);

/* ---- reactions.c ---- */

/* Whether there are reactions of their own, and then one for each constraint. */
dal_status dal__reactions(dal_model *model, dal_error *error);

/* ---- picture.c ---- */

/* Parses the picture, if there is one. */
dal_status dal__picture(dal_model *model, dal_error *error);

/* ---- formulas.c ---- */

/* Parses the text of an entry; the message of an error gets the entry's name and place. */
dal_status dal__formula(dal_model *model, const dal__entry *entry, dal__scope scope,
                        dal__node *node, dal_error *error);

/* Parses all entries into nodes and evaluates the default parameters and start. */
dal_status dal__formulas(dal_model *model, dal_error *error);

/* ---- linear.c ---- */

/* A linear system of nodes, matrix x = rhs.  Rows and columns from border on belong to
 * constraints (from 1), those before to the mass matrix. */
typedef struct dal__linear {
    int n, columns, border;
    dal__node *matrix; /* [n*n], destroyed */
    dal__node *rhs;    /* [n*columns], destroyed */
    dal__node *x;      /* [n*columns], the solution */
    int singular;      /* on DAL_SINGULAR: the row without a pivot */
} dal__linear;

/* Solves by elimination and appends the pivots to the equations.
 * Errors: DAL_MEMORY, DAL_SINGULAR. */
dal_status dal__linear_solve(dal_model *model, dal__linear *linear);

/* ---- equations.c ---- */

dal_status dal__equations_derive(dal_model *model, dal_error *error);
/* matrix x = rhs for one right-hand side; appends no pivots, for a matrix solved before. */
dal_status dal__solve_again(dal_model *model, int n, const dal__node *matrix, const dal__node *rhs,
                            dal__node *x);
/* sum_i a[i] b[i] of count nodes. */
dal__node dal__dot(dal__graph *graph, int count, const dal__node *a, const dal__node *b);
/* d/dt along v without accelerations: f_q v + f_t. */
dal__node dal__along(const dal__equations *e, dal__node f);

/* ---- properties.c, energy.c, guards.c, conserved.c ---- */

dal_status dal__properties(dal_model *model);
/* Adds what is known of E to the properties. */
dal_status dal__energy_properties(dal_model *model);
dal_status dal__guards(dal_model *model);
/* After the properties: what a conserved energy gives beside its value. */
dal_status dal__conserved(dal_model *model);

/* ---- potential.c ---- */

dal_status dal__potential(dal_model *model);

/* ---- programs.c ---- */

/* Begins the programs of a system whose coordinates and velocities have n symbols each. */
dal_status dal__programs_begin(const dal__equations *e, dal__programs *programs, int n,
                               int multipliers);
/* Adds a program: count outputs, followed by the watched pivots. */
dal_status dal__programs_add(dal_model *model, dal__programs *programs, dal__program_code code,
                             const dal__node *outputs, int count);
/* Adds field, adjoint and jacobian of dx/dt = F: nw nodes, the first n of them accelerations. */
dal_status dal__programs_add_motion(dal_model *model, dal__programs *programs, const dal__node *F);
/* The programs of a model's system; NULL for another. */
const dal__programs *dal__programs_of(const dal_system *system);
/* Finishes the tapes and points the system to its callbacks, and to itself in long numbers. */
dal_status dal__programs_finish(dal_model *model, dal__programs *programs, dal_system *system);

/* ---- callbacks_wide.c, callbacks.c ---- */

/* Sets *call to the callbacks of a variant; what runs its programs. */
#define DAL__CALLBACKS(name, variant, lanes, set, group)                                           \
    dal__run_program *name##_##variant(const dal__programs *programs, dal_callbacks *call);
DAL__CALLBACKS(dal__callbacks, x1, 1, BASE, x1)
DAL__VARIANT_LIST(DAL__CALLBACKS, dal__callbacks)
void dal__callbacks_single(const dal__programs *programs, dal_system *system);

/* ---- builtin.c ---- */

/* The texts of systems/, made by the Makefile; the last name is NULL. */
typedef struct dal__builtin {
    const char *name, *text;
} dal__builtin;
extern const dal__builtin dal__builtins[];

#endif
