/* dalembert_system.h - statuses, systems, their pictures, and models: systems from formulas.
 *
 * A part of dalembert.h, which includes it and has the conventions. */
#ifndef DALEMBERT_SYSTEM_H
#define DALEMBERT_SYSTEM_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- statuses ------------------------------------------------------------------------------ */

/* All statuses: STATUS(code, text). */
#define DAL_STATUS_LIST(STATUS)                                                                    \
    STATUS(OK, "done")                                                                             \
    STATUS(MEMORY, "out of memory")                                                                \
    STATUS(ARGUMENT, "argument out of range")                                                      \
    STATUS(SYNTAX, "syntax error")                                                                 \
    STATUS(NAME, "unknown name")                                                                   \
    STATUS(MODEL, "the model cannot be used")                                                      \
    STATUS(TOO_LARGE, "too large")                                                                 \
    STATUS(INCONSISTENT, "a constraint is violated")                                               \
    STATUS(RANK, "the constraints are rank-deficient")                                             \
    STATUS(UNSUPPORTED, "the integrator needs what the system lacks")                              \
    STATUS(SINGULAR, "a constraint became singular")                                               \
    STATUS(SINGULAR_MASS, "the mass matrix became singular")                                       \
    STATUS(NOT_FINITE, "a value is not finite")                                                    \
    STATUS(NOT_CONVERGED, "the implicit equations did not converge")                               \
    STATUS(GAUGE, "the gauge variable e reached zero")                                             \
    STATUS(IO, "input or output failed")                                                           \
    STATUS(INTERRUPTED, "interrupted")                                                             \
    STATUS(EVENT, "an event cannot be passed")                                                     \
    STATUS(STOPPED, "stopped by an event")

/* The result of a function: DAL_STATUS_OK, which is 0, or the kind of failure. */
typedef enum dal_status {
#define CODE(code, text) DAL_STATUS_##code,
    DAL_STATUS_LIST(CODE)
#undef CODE
        DAL_STATUS_COUNT
} dal_status;

/* The name of a status in tables and in Python, "DAL_SINGULAR" of DAL_STATUS_SINGULAR; "DAL_?" for
 * other numbers. */
const char *dal_status_name(dal_status status);
/* The text of a status, "a constraint became singular". */
const char *dal_status_text(dal_status status);

enum { DAL_MESSAGE_SIZE = 320 /* bytes of a message, with its NUL */ };
/* The caller's own record of a failure. */
typedef struct dal_error {
    dal_status status;              /* what the function returned */
    int line, column;               /* place in the text that was read, from 1; 0: none */
    char message[DAL_MESSAGE_SIZE]; /* names the object and the value; no newline */
} dal_error;

/* ---- systems ------------------------------------------------------------------------------- */

typedef struct dal_system dal_system;

/* Where a system is evaluated.  work begins with the parameter values, [system->parameters]; the
 * rest of its system->workspace doubles are the system's own (filled by prepare) and scratch.
 * Functions with a memory of their own, as a dal_evaluator has, read t, q and v alone. */
typedef struct dal_point {
    double t;            /* time */
    const double *q;     /* [n] coordinates */
    const double *v;     /* [n] velocities, then [multipliers] vakonomic multipliers g */
    const double *pi;    /* [n] momenta of the velocities, of adjoint; of projection, velocities */
    double *work;        /* [workspace] */
    const double *times; /* [lanes] the times in a wide set, where they differ; else NULL */
} dal_point;

/* A formula of a system: a pure function of *at (work beyond the parameters is scratch) that writes
 * out; the member that points to it says what.  In the wide sets each array is interleaved,
 * x[component*lanes + lane], and aligned to its lanes; t is common unless there are times.  A
 * callback that fails returns a status, or leaves NaN in the lanes that failed. */
typedef dal_status dal_callback(const dal_system *system, const dal_point *at, double *out);

/* The scale of each of some formulas f at a point: the largest |df/dx x| over its variables x and
 * the terms that it is made of, |f| among them.  eps times it is what one rounding can do; it
 * changes with the units as f does, and is 0 only where every term is.  memory[scale_memory]
 * belongs to the caller. */
typedef dal_status dal_scale_callback(const dal_system *system, const dal_point *at, double *memory,
                                      double *out);

/* The callbacks of a step: code, member, what each reads of its point, the numbers of its output,
 * with nw = n + multipliers, and what they are.  All but field may be NULL, which excludes what is
 * in parentheses.  guards keep their signs; blocks is of F = a + R h, B = A by Chetaev's rule;
 * potential is of L = v.Wv/2 + g.v - U, W constant, for each coordinate those that U and W couple
 * it with, and the first two are 0 where that U is quadratic.
 * With DAL_MASS_ON_KERNEL W need not have an inverse: W^-1 A^T and R are the X with A X = 1 and
 * W X = A^T Z for some Z, W^-1 b is the a with A a = 0 and W a = b + A^T z for some z, and so with
 * W^-1 E_q. */
/* clang-format off */
#define DAL_CALLBACK_LIST(CALLBACK) \
    CALLBACK(FIELD, field, tqv, nw) /* F, then dg/dt */ \
    CALLBACK(ADJOINT, adjoint, tqvpi, 3 * n) /* F, F_q^T pi, F_v^T pi (lifted space) */ \
    CALLBACK(JACOBIAN, jacobian, tqv, nw * (n + nw)) /* F_q, F_(v,g) (Newton) */ \
    CALLBACK(CONSTRAINT, constraint, tqv, m + 2 * m * n) /* D, A, W^-1 A^T (+project) */ \
    CALLBACK(ENERGY_NORMAL, energy_normal, tqv, 1 + 3 * n) /* E, E_q, E_v, W^-1 E_q */ \
    CALLBACK(GAUGE, gauge, t, 1) /* mu_e(t); NULL: 0 */ \
    CALLBACK(GUARDS, guards, tqv, guards) /* denominators; NULL: none */ \
    CALLBACK(BLOCKS, blocks, tqv, 2 * (m + m * n) + n) /* D, A, R = W^-1 B^T, a = W^-1 b, */ \
        /* c = D_q v + D_t (methods that enforce D) */ \
    CALLBACK(POTENTIAL, potential, tqv, 3 * n) /* U, U_q.v, v.Wv (discrete-gradient) */
/* clang-format on */
typedef struct dal_callbacks {
#define MEMBER(code, member, ...) dal_callback *member;
    DAL_CALLBACK_LIST(MEMBER)
#undef MEMBER
} dal_callbacks;

/* Taylor coefficients of F along a motion, for integrators with DAL_NEEDS_SERIES; made by a model.
 * From coefficient k of
 *     in[1 + 2n + multipliers]       t, q, v, g; on the lifted space then pi[n]
 * and the lower ones in memory[size[lifted]*stride], k < stride, follows coefficient k of
 *     out[n + multipliers]           F, dg/dt
 *     out[3n + 1]                    F, F_q^T pi, F_v^T pi, mu_e, on the lifted space
 * All arrays are interleaved by lanes as for a callback; work is as in dal_point. */
typedef dal_status dal_series_callback(const dal_system *system, int lifted, int k, int stride,
                                       const double *in, double *work, double *memory, double *out);
/* Those callbacks of a system. */
typedef struct dal_series {
    const char *refused;        /* what in F has no Taylor series, "abs"; NULL: nothing */
    size_t size[2];             /* series in memory, on the physical and on the lifted space */
    dal_series_callback *call;  /* one lane */
    dal_series_callback *wide4; /* of 4 lanes; may be NULL */
    dal_series_callback *wide8; /* of 8 lanes; may be NULL */
} dal_series;

/* What is known of the constraints and of the energy; set by a model, or by hand. */
enum {
    DAL_D_LINEAR = 1 << 0,       /* every D linear or affine in v */
    DAL_D_CONSTANT = 1 << 1,     /* every D linear in (q,v) with constant coefficients */
    DAL_D_BILINEAR = 1 << 2,     /* every D bilinear: c.v + q^T B v + d.q */
    DAL_D_QUADRATIC = 1 << 3,    /* every D a polynomial of degree <= 2 in (q,v) */
    DAL_D_RANK_CHECKED = 1 << 4, /* det A W^-1 A^T can vanish along a run: it is checked in steps */
    DAL_E_EXACT = 1 << 5,        /* dE/dt = 0 for every level of D */
    DAL_E_ON_D = 1 << 6,         /* dE/dt = 0 on D = 0 only */
    DAL_AUTONOMOUS = 1 << 7,     /* F does not depend on t */
    DAL_MASS_CONSTANT = 1 << 8,  /* W depends on parameters alone */
    DAL_VAKONOMIC = 1 << 9,      /* vakonomic equations, with multipliers g */
    DAL_SERVO = 1 << 10,         /* reactions along directions B of their own, not along A^T */
    DAL_BLOCKS_POSITIONAL = 1 << 11, /* every D linear, W^-1 b and A without v */
    DAL_D_ISOKINETIC = 1 << 12,      /* one D = k (v.Wv/2 - K), W constant, W^-1 b without v */
    DAL_WIDE_TIMES = 1 << 13,        /* the wide sets read dal_point.times, or no time at all */
    DAL_MASS_ON_KERNEL = 1 << 14,    /* W need be regular on ker A only, see dal_callbacks */
    DAL_F_POSITIONAL = 1 << 15       /* F depends on neither v nor g */
};

/* ---- events -------------------------------------------------------------------------------- */

/* What an event does; without any of these it is counted and reported only. */
enum {
    DAL_EVENT_SETS = 1 << 0,   /* sets q and v; v is then moved to D = 0 */
    DAL_EVENT_TURNS = 1 << 1,  /* sets a velocity: d(when)/dt must lead back to the allowed side */
    DAL_EVENT_IMPACT = 1 << 2, /* restitution */
    DAL_EVENT_STOPS = 1 << 3   /* ends the run */
};
/* An event happens where its formula `when` passes through 0 along a run. */
typedef struct dal_event {
    const char *name; /* "event 1 (y - r)", for messages */
    int direction;    /* 1: when increases along the run, -1: decreases, 0: both */
    unsigned actions; /* DAL_EVENT_SETS | ... */
} dal_event;

/* The branches of F where sign, abs, min, max, floor, a comparison or a table switches from one
 * formula to another as an argument s passes certain values.  A run with events repeats a step in
 * which s may do so with the branches held as at its begin, so that F is smooth in it, and an event
 * there is found as exactly as anywhere else; see docs/events.md.  Made by a model.  A system
 * written in C has none: its events have, where F jumps, the error of a step across the jump. */
typedef struct dal_branches {
    int count;            /* how many there are */
    dal_callback *values; /* out[2*count]: s of each, then the size of which eps is its rounding */
    dal_callback *rates;  /* out[count]: ds/dt along the motion */
    /* The values, infinite ones among them, between which branch k of s = point stays. */
    void (*bounds)(const dal_system *system, int k, double point, double *lower, double *upper);
    /* Until the next call the callbacks of a step, the rates of events and these two decide as for
     * s = point[count]; NULL: as s is.  work: as in the points where they are evaluated. */
    void (*hold)(const dal_system *system, const double *point, double *work);
} dal_branches;

/* A velocity that a start solves from D = 0, and where a file names it, for messages. */
typedef struct dal_solved {
    int velocity;     /* its number, from 0 */
    int line, column; /* from 1, or 0 */
} dal_solved;

/* A second-order system with constraints, as a plain struct: filled by a model or by hand with
 * designated initialisers; what is not named may stay zero. */
struct dal_system {
    const char *name;              /* for messages and files; may be NULL, as the next two */
    const char *title, *reference; /* a line for people; where the system is from */
    int n;                         /* coordinates, >= 1 */
    int m;                         /* constraints */
    int multipliers;               /* first-order variables beside v (vakonomic g); 0 or m */
    int parameters, invariants, guards, tags, tables; /* how many there are */
    int observed; /* of the invariants, the last: formulas that dal_model_observe has added */
    unsigned properties;           /* DAL_D_LINEAR | ...: what is known of D and E */
    const char *const *coordinate; /* [n] names; NULL: q1, q2, ... */
    const char *const *parameter;  /* [parameters] names */
    const double *value;           /* [parameters] default values */
    const char *const *invariant;  /* [invariants] names */
    const char *const *guard;      /* [guards] "constraint 1: y1'" for messages */
    int mass_guard;                /* which guard, from 1, is det W; 0: none */
    const char *const *tag;        /* [tags] words that classify the system */
    const char *const *table;      /* [tables] names, for messages */
    size_t workspace;              /* doubles in dal_point.work; 0 means parameters */
    int pivots; /* numbers that field and adjoint leave at the end of work: pivots of the equations
                   they solve; the rank check is spared where these are steady; 0: none */
    dal_callbacks call;                 /* one lane */
    const dal_callbacks *wide4, *wide8; /* of 4 and of 8 lanes, interleaved; may be NULL */
    dal_callback *prepare; /* completes work after a change of parameters; out unused */
    dal_callback *start;   /* out[2n + multipliers + 1]: q, v, g, e at the start; NULL: 0, e = 1 */
    int solved_velocities; /* how many a start solves from D = 0, the other velocities being
                                kept; `start` has first guesses.  Needs call.constraint */
    const dal_solved *solved;  /* [solved_velocities] */
    dal_callback *constraints; /* out[m]: D alone; NULL: D is not observed */
    dal_callback
        *energy; /* out[1]: E = L_v.v - L, of L - g.D where multipliers are g; NULL: unknown */
    dal_callback *invariant_values; /* out[invariants]; NULL: no invariants */
    dal_callback *reactions;        /* out[m + m*n]: h, B of the force B^T h in F; NULL: unknown */
    dal_scale_callback *scales;     /* out[m + 1 + invariants]: of D, E and the invariants; NULL:
                                   estimated, see dal_run_scales */
    dal_scale_callback *reaction_scales; /* out[m + n]: of h and R = B^T h; NULL: likewise */
    size_t scale_memory;                 /* doubles that these two need */
    const double *units; /* [n + nw + m + 1] how large each q, v, g, D and E is, powers of two: a
                            tolerance is relative to |x| plus the unit of q and v, equations are
                            solved and pivots chosen in units of v, D and E; NULL: all are 1 */
    dal_callback *projection;   /* out[m + 2*m*n]: D, A, W(q,u)^-1 A^T, u being at->pi; NULL: W does
                                 not depend on v, call.constraint gives the same */
    dal_callback *exact;        /* out[2n]: q, v of the exact solution at at->t; NULL: unknown */
    int events;                 /* how many there are, in the order in which they act */
    const dal_event *event;     /* [events] */
    dal_callback *event_values; /* out[events]: when; this and the next three need events */
    dal_callback *event_rates;  /* out[events]: d(when)/dt along the motion */
    dal_callback *event_states; /* out[2n*events]: q, v as each sets them; NULL: none does */
    dal_callback *event_normals; /* out[(1 + 2n)*events]: restitution, when_q, W^-1 when_q */
    dal_callback
        *diagnose; /* out[1]: why field is not finite here: returns DAL_STATUS_SINGULAR with the
                               number of the constraint (from 1), DAL_STATUS_SINGULAR_MASS,
                               DAL_STATUS_NOT_FINITE with the one of a table read outside its
                               points, or DAL_STATUS_OK */
    const dal_system *extended;   /* F continued off D = 0 so that E is exact, for extend-energy */
    const dal_system *quad;       /* work in quad precision, for precision; these two may be NULL */
    const dal_series *series;     /* Taylor coefficients of F; NULL: none */
    const dal_branches *branches; /* of F where there are events; NULL: none, or not known */
    const struct dal_picture *picture;         /* how it is drawn; NULL: not at all */
    void *data;                                /* of the owner, for callbacks */
    int field_operations, jacobian_operations; /* arithmetic operations of these callbacks, which
                                                  the solver auto weighs; 0: unknown */
};

/* ---- models: systems from formulas --------------------------------------------------------- */

/* A system as formulas, from a file or added one by one. */
typedef struct dal_model dal_model;
/* The sections of a system file, SECTION(code, name).  A comment says what the names and texts of
 * dal_model_add are; lists and single values have no names. */
#define DAL_SECTION_LIST(SECTION)                                                                  \
    SECTION(TITLE, "title")                                                                        \
    SECTION(REFERENCE, "reference")                                                                \
    SECTION(COORDINATES, "coordinates")     /* text: a name */                                     \
    SECTION(SIZES, "sizes")                 /* name, text: a whole number */                       \
    SECTION(PARAMETERS, "parameters")       /* name, text: a number */                             \
    SECTION(FILES, "files")                 /* name of a file, its text; see tables */             \
    SECTION(TABLES, "tables")               /* by dal_model_add_table */                           \
    SECTION(FUNCTIONS, "functions")         /* name with arguments, as V(r); formula */            \
    SECTION(LET, "let")                     /* name, formula */                                    \
    SECTION(LAGRANGIAN, "lagrangian")       /* formula */                                          \
    SECTION(ACCELERATIONS, "accelerations") /* coordinate, formula; instead of a Lagrangian */     \
    SECTION(FORCES, "forces")               /* coordinate, formula */                              \
    SECTION(CONSTRAINTS, "constraints")     /* formula */                                          \
    SECTION(REACTIONS, "reactions")   /* constraint.coordinate, as 2.x: formula; see below */      \
    SECTION(MECHANICS, "mechanics")   /* lagrange-d'alembert (default) or vakonomic */             \
    SECTION(GAUGE, "gauge")           /* e or mu_e, formula in t and parameters */                 \
    SECTION(START, "start")           /* name, formula; solve.x' and any text: x' from D = 0 */    \
    SECTION(INVARIANTS, "invariants") /* name, formula */                                          \
    SECTION(EVENTS, "events")         /* event.key, as 1.when, 1.set.x': formula or word */        \
    SECTION(EXACT, "exact")           /* coordinate, formula in t and parameters */                \
    SECTION(TAGS, "tags")             /* a word */                                                 \
    SECTION(PICTURE, "picture")       /* x, y, angle, ..: formula; body: a word */                 \
    SECTION(DEFAULTS, "defaults")     /* integrator: a method; step, time: a number */

/* A section of a system file.  Reactions are along B_a = dD_a/dv (Chetaev's rule), unless the file
 * gives B_a(q,v,t), as for an actuator that enforces a servo constraint:
 *     W dv/dt = b + B^T h,   (A W^-1 B^T) h = -(c + A W^-1 b)
 * A component of B_a that is not named is 0. */
typedef enum dal_section {
#define CODE(code, text) DAL_SECTION_##code,
    DAL_SECTION_LIST(CODE)
#undef CODE
        DAL_SECTION_COUNT
} dal_section;

/* Makes an empty model; NULL when out of memory.  A NULL name is "". [alloc] */
dal_model *dal_model_create(const char *name);
/* Frees a model and its systems. */
void dal_model_free(dal_model *model);
/* Adds an entry to a section, in any order.  Its text is copied, and parsed by dal_model_system;
 * line and column (from 1 or 0) are its place. [alloc]  Errors: DAL_STATUS_NAME, DAL_STATUS_SYNTAX,
 * DAL_STATUS_MODEL. */
dal_status dal_model_add(dal_model *model, dal_section section, const char *name, const char *text,
                         int line, int column, dal_error *error);
/* Adds a formula that runs observe, after all other entries: it may contain what an invariant may,
 * is the last of the system's invariants, has its own text as name and need not be conserved.  No
 * other equation changes.  [alloc]  Errors: DAL_STATUS_NAME (a name alone, which as a formula is
 * written (x)), DAL_STATUS_SYNTAX (no text, line breaks, quotes, blanks at an end),
 * DAL_STATUS_TOO_LARGE (more than 100 characters), DAL_STATUS_MODEL (given twice). */
dal_status dal_model_observe(dal_model *model, const char *formula, int line, int column,
                             dal_error *error);
/* Between two points a table is a straight line, or the natural cubic spline: smooth up to its
 * second derivative, which is 0 at both ends. */
typedef enum dal_interpolation { DAL_LINEAR, DAL_CUBIC } dal_interpolation;
/* Outside its points a table is no number, the value at the end, or the line that continues it. */
typedef enum dal_extend { DAL_EXTEND_NONE, DAL_EXTEND_CONSTANT, DAL_EXTEND_LINEAR } dal_extend;
/* A function of one argument, given by points. */
typedef struct dal_table {
    const double *at, *value;        /* [points]; at ascends */
    int points;                      /* >= 2 */
    dal_interpolation interpolation; /* between the points */
    dal_extend extend;               /* outside of them */
} dal_table;
/* Adds a table, whose points are copied; formulas call it by its name, as torque(t). [alloc]
 * Errors: DAL_STATUS_NAME, DAL_STATUS_MODEL (points that do not ascend or are not finite),
 * DAL_STATUS_TOO_LARGE (more than 100,000 points). */
dal_status dal_model_add_table(dal_model *model, const char *name, const dal_table *table, int line,
                               int column, dal_error *error);
/* Text number i of a section, from 0, and where not NULL its name and place; NULL past the last. */
const char *dal_model_text(const dal_model *model, dal_section section, int i, const char **name,
                           int *line, int *column);
/* Warning number i about a model that has its system, and where not NULL its place; NULL: none. */
const char *dal_model_warning(const dal_model *model, int i, int *line, int *column);
/* Makes *model from the YAML text of a system file, text[length].  name is for messages and may be
 * NULL.  Files of its tables are in the text, under "files". [alloc]  Errors: DAL_STATUS_SYNTAX,
 * DAL_STATUS_NAME and DAL_STATUS_MODEL, with place. */
dal_status dal_model_read(dal_model **model, const char *name, const char *text, size_t length,
                          dal_error *error);
/* Makes *model from the file at path, which tables name their files from. [alloc]  Errors:
 * DAL_STATUS_IO, as for dal_model_read. */
dal_status dal_model_read_file(dal_model **model, const char *path, dal_error *error);
/* The YAML text that a model was read from, with the files of its tables in it, so that
 * dal_model_read makes the same model anywhere; NULL where it was not read.  *length without the
 * NUL after it. */
const char *dal_model_source(const dal_model *model, size_t *length);
/* Makes *model from a system of the library, "chaplygin-sleigh". [alloc]  Errors: DAL_STATUS_NAME
 * with the nearest name. */
dal_status dal_model_builtin(dal_model **model, const char *name, dal_error *error);
/* Name of system number i of the library, from 0; NULL past the last. */
const char *dal_builtin_name(int i);
/* The YAML text of a system of the library; NULL where there is none of this name. */
const char *dal_builtin_text(const char *name);

/* Gives the system of a complete model, made at the first call and owned by the model: the formulas
 * are parsed and F is derived, with exact derivatives. [alloc]  Errors: DAL_STATUS_SYNTAX and
 * DAL_STATUS_NAME with place, DAL_STATUS_MODEL, DAL_STATUS_TOO_LARGE. */
dal_status dal_model_system(dal_model *model, const dal_system **system, dal_error *error);
/* Gives the tangent system, owned by the model: 2n coordinates (q, dq), accelerations F and
 * F_q dq + F_v dv, no constraints.  A Runge-Kutta or partitioned method applied to it is that
 * method's exact tangent map. [alloc]  Errors: as for dal_model_system. */
dal_status dal_model_tangent(dal_model *model, const dal_system **system, dal_error *error);

/* A value for a name. */
typedef struct dal_setting {
    const char *name; /* of a parameter or of a component of the state */
    double value;     /* finite, except e = INFINITY */
} dal_setting;

enum { DAL_GROWTH_LEVELS = 64 /* max ranks of dal_growth */ };
/* The growth vector of the velocities that D = 0 allows, a distribution V_1 on the space of q:
 * rank[k] is the rank of V_(k+1) = V_k + [V_1, V_k] at generic points.  V_1 alone: D is integrable,
 * that is holonomic; a last rank below the dimension: a part of it is. */
typedef struct dal_growth {
    int dimension;               /* n; where D has terms without v, or t: n + 1, of (t, q) */
    int levels;                  /* ranks */
    bool is_complete;            /* false: further brackets are too large */
    int rank[DAL_GROWTH_LEVELS]; /* [levels] */
} dal_growth;
/* Finds the growth vector of a model whose system is made, by exact brackets at points near the
 * start, with parameters[parameter_count].  units[1 + n] of t and q, from dal_scaled_units, say how
 * far the points are and what components are compared with; NULL: 1.  [alloc]  Errors:
 * DAL_STATUS_UNSUPPORTED (no constraints, or one that is not linear in v), DAL_STATUS_NAME,
 * DAL_STATUS_SINGULAR, DAL_STATUS_NOT_FINITE, DAL_STATUS_TOO_LARGE. */
dal_status dal_model_growth(dal_model *model, const dal_setting *parameters, int parameter_count,
                            const double *units, dal_growth *out, dal_error *error);

/* Numerical ranks at a point.  The motion is determined there where constraints is m and mass is
 * n - m: W = L_vv alone may be singular. */
typedef struct dal_ranks {
    int constraints;          /* of A = D_v [m*n] */
    int mass;                 /* of W on ker A; -1 where constraints is below m */
    double constraints_pivot; /* the smallest pivot over the largest, 0 below full rank */
    double mass_pivot;        /* likewise */
} dal_ranks;
/* Finds the ranks of a model whose system is made, with parameters[parameter_count], at a point of
 * which t, q[n] and v[n] are read.  Entries are compared in units[1 + n] of t and q, as from
 * dal_scaled_units; NULL: 1.  [alloc]  Errors: DAL_STATUS_UNSUPPORTED (vakonomic motion, reactions
 * given), DAL_STATUS_NAME, DAL_STATUS_NOT_FINITE. */
dal_status dal_model_ranks(dal_model *model, const dal_setting *parameters, int parameter_count,
                           const dal_point *at, const double *units, dal_ranks *out,
                           dal_error *error);

#ifdef __cplusplus
}
#endif
#endif
