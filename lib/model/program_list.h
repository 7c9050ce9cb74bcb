/* program_list.h - which programs a system has, and what holds them. */
#ifndef DAL_MODEL_PROGRAM_LIST_H
#define DAL_MODEL_PROGRAM_LIST_H

#include "expr/taylor.h"
#include "expr/terms.h"
#include "model/equations.h"

/* The programs of a system besides its callbacks (DAL_CALLBACK_LIST): code, name, and the
 * inputs that it reads. */
enum {
    DAL__READS_none,
    DAL__READS_t,
    DAL__READS_tqv,
    DAL__READS_tqvpi,
    DAL__READS_tqve,    /* instead of pi e */
    DAL__READS_tqv_l,   /* instead of pi l[m] and beta */
    DAL__READS_tqv_pi_c /* pi[n], c[m] and beta */
};
/* Numbers read from pi on. */
static inline int dal__momenta_read(int reads, int n, int m)
{
    return reads == DAL__READS_tqv_pi_c ? n + m + 1
           : reads == DAL__READS_tqv_l  ? m + 1
           : reads == DAL__READS_tqvpi  ? n
                                        : 0;
}
#define DAL__SINGLE_LIST(PROGRAM)                                                                  \
    PROGRAM(START, start, t)                                                                       \
    PROGRAM(CONSTRAINTS, constraints, tqv)                                                         \
    PROGRAM(ENERGY, energy, tqv)                                                                   \
    PROGRAM(INVARIANTS, invariant_values, tqv)                                                     \
    PROGRAM(REACTIONS, reactions, tqv)                                                             \
    PROGRAM(PROJECTION, projection, tqvpi)                                                         \
    PROGRAM(EQUATIONS, equation_values, tqvpi)                                                     \
    PROGRAM(EXACT, exact, t)                                                                       \
    PROGRAM(EVENT_VALUES, event_values, tqv)                                                       \
    PROGRAM(EVENT_RATES, event_rates, tqv)                                                         \
    PROGRAM(EVENT_STATES, event_states, tqv)                                                       \
    PROGRAM(EVENT_NORMALS, event_normals, tqv)

typedef enum dal__program_code {
#define CODE(code, ...) DAL__PROGRAM_##code,
    DAL_CALLBACK_LIST(CODE) DAL__SINGLE_LIST(CODE)
#undef CODE
        DAL__PROGRAM_PICTURE,
    DAL__PROGRAM_BRANCH_VALUES,
    DAL__PROGRAM_BRANCH_RATES,
    DAL__PROGRAM_DIAGNOSE,
    DAL__PROGRAM_COUNT
} dal__program_code;

typedef struct dal__program {
    bool present;
    int tape;           /* number in the tapes */
    int outputs;        /* for the caller */
    int checked;        /* pivots, each with its size, that follow the outputs */
    int saved;          /* pivots for the rank check, after these */
    bool is_by_columns; /* R = W^-1 B^T [n*m] is no output: it is inserted after D and A, column by
                           column from DAL__PROGRAM_REACTION, in CONSTRAINT and BLOCKS */
} dal__program;

/* A branch: the argument of nodes that switch, and the table at whose points they do, or one of
 * these. */
enum { DAL__BRANCH_AT_ZERO = -1, DAL__BRANCH_AT_INTEGERS = -2 };
typedef struct dal__switch_point {
    dal__node argument;
    int table;
} dal__switch_point;

/* Evaluates a program on what it reads of *at. */
typedef dal_status dal__run_program(const dal_system *system, const dal_point *at, double *out,
                                    dal__program_code code, int reads);

/* What a dal_system of a model holds as its data. */
typedef struct dal__programs {
    dal__tapes *tapes;
    const dal__equations *equations;
    int n, multipliers;    /* of this system: 2n, 0 for the tangent one */
    int t, q, v, pi, g, e; /* places of the inputs in work */
    size_t scratch;        /* place in work for pivots, and for the diagnosis */
    size_t saved_pivots;   /* place in work for the pivots of the rank check */
    size_t column;         /* place in work for a column of R, where a program is by columns */
    int pivots;            /* how many these are */
    dal__program program[DAL__PROGRAM_COUNT];
    dal_callbacks wide1, wide4, wide8;
    dal__taylor *taylor[2]; /* F in t, q, v, g; and the lift, in pi too; NULL: not made */
    dal_series series;
    const dal__terms *terms;          /* of D, E, invariants; the model's, as the next */
    const dal__terms *reaction_terms; /* of h, R; NULL: not made */
    int lookups, *lookup;             /* [lookups] the tables that are read in the diagnosis */
    dal_picture picture;
    dal__switch_point *branch; /* [branches.count] those that may be held; the model's */
    dal_branches branches;
    dal__run_program *run; /* a program of one lane */
} dal__programs;

/* A system again, its numbers being long. */
typedef struct dal__quad_system {
    dal__programs programs; /* the same; not their owner */
    dal_system system;
} dal__quad_system;

/* A pivot must exceed this fraction of what it was subtracted from: some hundred times the rounding
 * of the subtraction, so that three digits of it are true. */
#define DAL__PIVOT_LEAST 1e-13

#endif
