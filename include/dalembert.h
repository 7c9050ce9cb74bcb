/* dalembert.h - geometric integrators for nonholonomic mechanics.  This header is the manual.
 *
 * What moves is a system, how it moves is an integrator; a run joins the two over one block of
 * memory; a batch is the same run several lanes wide; measures look at what comes out.
 *
 *     d/dt L_v - L_q = Q + A^T h,   D(q,v,t) = 0,   A = dD/dv            (Lagrange-d'Alembert)
 *     H = pi.pi/(2e) + pi.F(q,v,t) + p.v + mu_e pi_e                     (canonical lift, 4n+2)
 *
 * A. A. Deriglazov, arXiv:2510.24492; equation numbers (nhK) in this project are that paper's.
 *
 * Conventions.  Every function that can fail returns a dal_status and, where it takes a dal_error,
 * fills it (it may be NULL).  A NULL pointer where an object, a text, numbers or a place for a
 * result is required, a NULL name in a dal_setting and a negative count are errors: DAL_ARGUMENT.
 * A function without a status then returns 0, NaN or NULL, writes NaN to its result, or does
 * nothing.  *_free(NULL) does nothing.  What may be NULL besides is said at its place.  [alloc]
 * marks what allocates; create/free own memory, init borrows it.  Nothing here prints, reads the
 * environment, installs signals or keeps global state; two objects may be used from two threads.
 * Quantities are in the user's own units throughout. */
#ifndef DALEMBERT_H
#define DALEMBERT_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The version as numbers, and as the text "0.3.0". */
#define DAL_VERSION_MAJOR 0
#define DAL_VERSION_MINOR 3
#define DAL_VERSION_PATCH 0
#define DAL_VERSION       DAL__VERSION(DAL_VERSION_MAJOR, DAL_VERSION_MINOR, DAL_VERSION_PATCH)

#define DAL__VERSION(major, minor, patch)      DAL__VERSION_TEXT(major, minor, patch)
#define DAL__VERSION_TEXT(major, minor, patch) #major "." #minor "." #patch

/* ---- statuses ------------------------------------------------------------------------------ */

#define DAL_STATUS_LIST(STATUS)                                                                    \
    STATUS(OK, "done")                                                                             \
    STATUS(MEMORY, "out of memory")                                                                \
    STATUS(ARGUMENT, "argument out of range")                                                      \
    STATUS(SYNTAX, "syntax error")                                                                 \
    STATUS(NAME, "unknown name")                                                                   \
    STATUS(MODEL, "the model cannot be used")                                                      \
    STATUS(TOO_LARGE, "too large")                                                                 \
    STATUS(INCONSISTENT, "the start violates a constraint")                                        \
    STATUS(RANK, "the constraints are rank-deficient at the start")                                \
    STATUS(UNSUPPORTED, "the integrator needs what the system lacks")                              \
    STATUS(SINGULAR, "a constraint became singular")                                               \
    STATUS(SINGULAR_MASS, "the mass matrix became singular")                                       \
    STATUS(NOT_FINITE, "a value is not finite")                                                    \
    STATUS(NOT_CONVERGED, "the implicit equations did not converge")                               \
    STATUS(GAUGE, "the gauge variable e reached zero")                                             \
    STATUS(IO, "input or output failed")                                                           \
    STATUS(INTERRUPTED, "interrupted")

typedef enum dal_status {
#define CODE(code, text) DAL_##code,
    DAL_STATUS_LIST(CODE)
#undef CODE
        DAL_STATUS_COUNT
} dal_status;

const char *dal_status_name(dal_status status); /* "DAL_SINGULAR" */
const char *dal_status_text(dal_status status); /* "a constraint became singular" */

enum { DAL_MESSAGE_SIZE = 320 };

/* The caller's own record of a failure.  line and column count from 1; 0: no place in a text. */
typedef struct dal_error {
    dal_status status;
    int line, column;
    char message[DAL_MESSAGE_SIZE]; /* names the object and the value; no newline */
} dal_error;

/* The name among count nearest to name by edits (Damerau-Levenshtein), for "did you mean"; NULL
 * when none is within a third of the length of name (at least two edits) and has a letter in
 * common with it.  Names may hold NULLs. */
const char *dal_nearest(const char *name, const char *const *names, int count);

/* Reads a decimal number - sign, digits, one point, exponent, and nothing else - the same under
 * every locale, correctly rounded.  Errors: DAL_SYNTAX, DAL_TOO_LARGE (overflow). */
dal_status dal_parse_number(const char *text, size_t length, double *value);

/* ---- systems ------------------------------------------------------------------------------- */

typedef struct dal_system dal_system;

/* Where a system is evaluated.  work holds the parameter values first, [system->parameters]; the
 * rest of its system->workspace doubles are the system's own (filled by prepare) and scratch.
 * Functions that evaluate a system by themselves read t, q and v alone. */
typedef struct dal_point {
    double t;
    const double *q;  /* [n] coordinates */
    const double *v;  /* [n] velocities, then [multipliers] vakonomic multipliers g */
    const double *pi; /* [n] momenta of the velocities; adjoint only */
    double *work;     /* [workspace] */
} dal_point;

/* Every callback is a pure function of *at (work beyond the parameters is scratch).  In the wide
 * sets each array is interleaved, x[component*lanes + lane], aligned to its lanes; t is common.
 * A callback that fails returns a status, or leaves NaN in the lanes concerned. */
typedef dal_status dal_callback(const dal_system *system, const dal_point *at, double *out);

/* nw = n + multipliers below.  Matrices are row-major.  Only field is needed; each comment states
 * what a NULL excludes. */
typedef struct dal_callbacks {
    dal_callback *field;      /* out[nw]: F, then dg/dt */
    dal_callback *adjoint;    /* out[3n]: F, F_q^T pi, F_v^T pi          (NULL: no lifted space) */
    dal_callback *jacobian;   /* out[nw*n + nw*nw]: F_q, F_(v,g)         (NULL: no Newton) */
    dal_callback *constraint; /* out[m + m*n + n*m]: D, A, W^-1 A^T      (NULL: no +project) */
    dal_callback
        *energy_normal;      /* out[1 + 3n]: E, E_q, E_v, W^-1 E_q  (NULL: no +project-energy) */
    dal_callback *gauge;     /* out[1]: mu_e(t)                         (NULL: mu_e = 0) */
    dal_callback *guards;    /* out[guards]: must keep their signs along a run: denominators and
                                the like of the constraints             (NULL: none) */
    dal_callback *blocks;    /* out[m + m*n + n*m + n + m]: D, A, R, a, c of F = a + R h: R is
                                W^-1 B^T, B = A by Chetaev's rule, a = W^-1 b, c = D_q v + D_t
                                                        (NULL: no methods that enforce D) */
    dal_callback *potential; /* out[3n]: of L = v.Wv/2 + g.v - U, W constant, for each coordinate
                                U, U_q.v and v.Wv of those it is coupled with by U and W: 0 for
                                the first two where that U is quadratic
                                                         (NULL: no discrete-gradient) */
} dal_callbacks;

/* What is known of the constraints and of the energy; set by a model, or by hand. */
enum {
    DAL_D_LINEAR = 1 << 0,       /* every D linear or affine in v */
    DAL_D_CONSTANT = 1 << 1,     /* every D linear in (q,v) with constant coefficients */
    DAL_D_BILINEAR = 1 << 2,     /* every D bilinear: c.v + q^T B v + d.q */
    DAL_D_QUADRATIC = 1 << 3,    /* every D a polynomial of degree <= 2 in (q,v) */
    DAL_D_RANK_CHECKED = 1 << 4, /* G can vanish along a run: compare the normals A step by step */
    DAL_E_EXACT = 1 << 5,        /* dE/dt = 0 for every level of D */
    DAL_E_ON_D = 1 << 6,         /* dE/dt = 0 on D = 0 only */
    DAL_AUTONOMOUS = 1 << 7,     /* F does not depend on t */
    DAL_MASS_CONSTANT = 1 << 8,  /* W depends on parameters alone */
    DAL_VAKONOMIC = 1 << 9,
    DAL_SERVO = 1 << 10,             /* reactions along directions B of their own, not along A^T */
    DAL_BLOCKS_POSITIONAL = 1 << 11, /* every D linear, W^-1 b and A without v */
    DAL_D_ISOKINETIC = 1 << 12       /* one D = k (v.Wv/2 - K), W constant, W^-1 b without v */
};

/* A second-order system with constraints, as a plain struct: filled by a model or by hand with
 * designated initialisers; what is not named may stay zero. */
struct dal_system {
    const char *name;
    const char *title, *reference;
    int n;           /* coordinates, >= 1 */
    int m;           /* constraints */
    int multipliers; /* first-order variables beside v (vakonomic g); 0 or m */
    int parameters, invariants, guards, tags;
    unsigned properties;
    const char *const *coordinate;      /* [n] names; NULL: q1, q2, ... */
    const char *const *parameter;       /* [parameters] names */
    const double *value;                /* [parameters] default values */
    const char *const *invariant;       /* [invariants] names */
    const char *const *guard;           /* [guards] "constraint 1: y1'" for messages */
    int mass_guard;                     /* which guard, from 1, is det W; 0: none */
    const char *const *tag;             /* [tags] */
    size_t workspace;                   /* doubles in dal_point.work; 0 means parameters */
    dal_callbacks call;                 /* one lane */
    const dal_callbacks *wide4, *wide8; /* 4 or 8 lanes interleaved; NULL: fewer at once */
    dal_callback *prepare; /* completes work after a change of parameters; out unused */
    dal_callback *start;   /* out[2n + multipliers + 1]: q, v, g, e at t = 0; NULL: 0 and e = 1 */
    dal_callback *constraints;      /* out[m]: D alone; NULL: D is not observed */
    dal_callback *energy;           /* out[1]: E = L_v.v - L; NULL: unknown */
    dal_callback *invariant_values; /* out[invariants] */
    dal_callback *exact;    /* out[2n]: q, v of the exact solution at at->t; NULL: unknown */
    dal_callback *diagnose; /* out[1]: why field is not finite here: returns DAL_SINGULAR with the
                               number of the constraint (from 1), DAL_SINGULAR_MASS, or DAL_OK */
    const dal_system *extended; /* the same with F continued off D = 0 so that E is exact, for the
                                   option extend-energy; NULL: there is none */
    const dal_system *quad;     /* the same with work in quad precision, for the option precision;
                                   NULL: none */
    const struct dal_picture *picture; /* how it is drawn; NULL: not at all */
    void *data;                        /* the owner's */
};

/* ---- pictures ------------------------------------------------------------------------------ */

/* The numbers of a picture, 0 where not given.  x, y: the place; angle: the heading, from x to y;
 * steer: the turn of the front axle of a board, whose other one turns against it, or of the arm of
 * a racer; width: of a disk, breadth over length as seen.  Then the words for a body. */
#define DAL_PICTURE_LIST(NUMBER)                                                                   \
    NUMBER(X, "x")                                                                                 \
    NUMBER(Y, "y") NUMBER(ANGLE, "angle") NUMBER(STEER, "steer") NUMBER(WIDTH, "width")
#define DAL_BODY_LIST(BODY)                                                                        \
    BODY(POINT, "point")                                                                           \
    BODY(SLEIGH, "sleigh")                                                                         \
    BODY(BLADE, "blade")                                                                           \
    BODY(DISK, "disk")                                                                             \
    BODY(BALL, "ball") BODY(ROBOT, "robot") BODY(BOARD, "board") BODY(RACER, "racer")
enum {
#define CODE(code, name) DAL_PICTURE_##code,
    DAL_PICTURE_LIST(CODE) DAL_PICTURE_COUNT
#undef CODE
};
typedef enum dal_body {
#define CODE(code, name) DAL_BODY_##code,
    DAL_BODY_LIST(CODE) DAL_BODY_COUNT
#undef CODE
} dal_body;

/* How a system is drawn in the plane, of no consequence for its motion. */
typedef struct dal_picture {
    dal_callback *evaluate; /* out[DAL_PICTURE_COUNT] */
    dal_body body;
} dal_picture;

/* ---- integrators and methods --------------------------------------------------------------- */

/* Declared properties of an integrator; the conformance suite verifies them. */
enum {
    DAL_SYMMETRIC = 1 << 0,
    DAL_SYMPLECTIC = 1 << 1,             /* on the lifted space; says nothing about D or E */
    DAL_PRESERVES_BILINEAR = 1 << 2,     /* D bilinear in (q,v) */
    DAL_PRESERVES_QUADRATIC = 1 << 3,    /* D quadratic in (q,v) */
    DAL_PRESERVES_D = 1 << 4,            /* every D */
    DAL_EXPLICIT = 1 << 5,               /* on the physical space */
    DAL_MODIFIER = 1 << 6,               /* acts on another integrator: NAME+this */
    DAL_COMPONENTWISE = 1 << 7,          /* on (q,v) only adds multiples of v and F */
    DAL_PRESERVES_D_MIDPOINT = 1 << 8,   /* D((q0 + q1)/2, (q1 - q0)/h, t + h/2) = 0 in each step */
    DAL_PRESERVES_ENERGY = 1 << 9,       /* E, where the motion conserves it */
    DAL_PERSISTENT_MULTIPLIER = 1 << 10, /* a map of (q, v, multipliers of the last step), symmetric
                                            and reversible in them */
    DAL_ADAPTIVE = 1 << 11,              /* divides a step h where the option tolerance is not 0 */
    DAL_EXTRAPOLATES_STAGES = 1 << 12    /* from one step to the first guess of the next */
};

/* What an integrator needs of the system or, a modifier, of the method inside. */
enum {
    DAL_NEEDS_FIELD = 1 << 0,
    DAL_NEEDS_CONSTRAINT = 1 << 1,
    DAL_NEEDS_SYMMETRIC = 1 << 2,  /* a symmetric method */
    DAL_NEEDS_ORDER_2 = 1 << 3,    /* a method of order 2 */
    DAL_NEEDS_BLOCKS = 1 << 4,     /* D, A, R, a, c; acts on p = pi = 0 only */
    DAL_NEEDS_POTENTIAL = 1 << 5,  /* U, and a constant W */
    DAL_NEEDS_ISOKINETIC = 1 << 6, /* DAL_D_ISOKINETIC */
    DAL_NEEDS_ENERGY = 1 << 7,     /* an energy that is conserved, and its gradient */
    DAL_NEEDS_JACOBIAN = 1 << 8,   /* F_q and F_v, on the lifted space */
    DAL_NEEDS_RUNGE_KUTTA = 1 << 9 /* an explicit method that calls dal_field alone */
};

struct dal_step; /* dalembert_kernel.h */
typedef dal_status dal_step_function(struct dal_step *step);

/* A constant descriptor; its file in integrators/ holds the mathematics. */
typedef struct dal_integrator {
    const char *name, *alias; /* alias: another name, or NULL */
    const char *summary, *reference;
    int order;  /* 0 for a modifier: that of the inner method */
    int stages; /* solved together or stored at once; determines scratch and, with
                   DAL_EXTRAPOLATES_STAGES, persistent state */
    unsigned properties, needs;
    unsigned inherits; /* a modifier: properties of the method inside that it preserves */
    dal_step_function *step;
} dal_integrator;

enum { DAL_LAYERS = 4 };

/* An integrator, then the modifiers around it, innermost first; unused layers are NULL.
 * An integrator outside the library is used by its address: {{&my_integrator}}. */
typedef struct dal_method {
    const dal_integrator *layer[DAL_LAYERS];
} dal_method;

/* Integrator or modifier number i of the library, NULL past the last. */
const dal_integrator *dal_integrator_at(int i);

/* "rk4", "gauss8+project".  Errors: DAL_NAME with the nearest name. */
dal_status dal_method_parse(dal_method *method, const char *name, dal_error *error);
/* Writes the full name, at most size bytes with its NUL; returns buffer. */
char *dal_method_name(const dal_method *method, char *buffer, size_t size);
int dal_method_order(const dal_method *method);
unsigned dal_method_properties(const dal_method *method); /* of all its layers together */
unsigned dal_method_needs(const dal_method *method);      /* of any of its layers */

/* ---- models: systems from formulas --------------------------------------------------------- */

typedef struct dal_model dal_model;

/* The sections of a system file; lists and single values have no names. */
#define DAL_SECTION_LIST(SECTION)                                                                  \
    SECTION(TITLE, "title")                                                                        \
    SECTION(REFERENCE, "reference")                                                                \
    SECTION(COORDINATES, "coordinates")     /* text: a name */                                     \
    SECTION(PARAMETERS, "parameters")       /* name, text: a number */                             \
    SECTION(LET, "let")                     /* name, formula */                                    \
    SECTION(LAGRANGIAN, "lagrangian")       /* formula */                                          \
    SECTION(ACCELERATIONS, "accelerations") /* coordinate, formula; instead of a Lagrangian */     \
    SECTION(FORCES, "forces")               /* coordinate, formula */                              \
    SECTION(CONSTRAINTS, "constraints")     /* formula */                                          \
    SECTION(REACTIONS, "reactions")   /* constraint.coordinate, as 2.x: formula; see below */      \
    SECTION(MECHANICS, "mechanics")   /* lagrange-d'alembert (default) or vakonomic */             \
    SECTION(GAUGE, "gauge")           /* e or mu_e, formula in t and parameters */                 \
    SECTION(START, "start")           /* name, formula in parameters */                            \
    SECTION(INVARIANTS, "invariants") /* name, formula */                                          \
    SECTION(EXACT, "exact")           /* coordinate, formula in t and parameters */                \
    SECTION(TAGS, "tags")             /* a word */                                                 \
    SECTION(PICTURE, "picture")       /* x, y, angle, ..: formula; body: a word */

typedef enum dal_section {
#define CODE(code, text) DAL_SECTION_##code,
    DAL_SECTION_LIST(CODE)
#undef CODE
        DAL_SECTION_COUNT
} dal_section;

/* Without reactions Chetaev's rule gives them: constraint a pushes along dD_a/dv.  With them it
 * pushes along B_a(q,v,t), as an actuator does that enforces a servo constraint:
 *     W dv/dt = b + B^T h,   (A W^-1 B^T) h = -(c + A W^-1 b)
 * In a file reactions is a list parallel to constraints; its item a maps coordinates to the
 * components of B_a, those not named being 0:    reactions: [{x: 1, theta: -l*cos(theta)}]
 * picture has x and y at least:    picture: {x: y1, y: y2, angle: phi, body: sleigh} */

/* An empty model, or NULL when memory is out; without a name (NULL) it is called "". [alloc] */
dal_model *dal_model_create(const char *name);
void dal_model_free(dal_model *model);

/* Adds one entry; texts are copied and parsed by dal_model_system, so the order of calls is free.
 * line and column (from 1, or 0) say where the text stood, for messages. [alloc]
 * Errors: DAL_NAME, DAL_SYNTAX, DAL_MODEL (duplicate), DAL_MEMORY. */
dal_status dal_model_add(dal_model *model, dal_section section, const char *name, const char *text,
                         int line, int column, dal_error *error);

/* Reads a system file (YAML). [alloc]  The first takes the text itself, the second a path, the
 * third the name of a system that is embedded in the library ("chaplygin-sleigh").  The name of a
 * text may be NULL. */
dal_status dal_model_read(dal_model **model, const char *name, const char *text, size_t length,
                          dal_error *error);
dal_status dal_model_read_file(dal_model **model, const char *path, dal_error *error);
dal_status dal_model_builtin(dal_model **model, const char *name, dal_error *error);

/* Name of built-in system number i, NULL past the last; and its YAML text. */
const char *dal_builtin_name(int i);
const char *dal_builtin_text(const char *name);

/* The system of a complete model, owned by the model, made at the first call. [alloc]
 * Errors: every fault of the formulas, with place; DAL_MODEL; DAL_TOO_LARGE. */
dal_status dal_model_system(dal_model *model, const dal_system **system, dal_error *error);

/* The tangent system, 2n coordinates (q, delta q): F and F_q dq + F_v dv, without constraints.
 * A Runge-Kutta or polarised method applied to it is its exact tangent map. [alloc] */
dal_status dal_model_tangent(dal_model *model, const dal_system **system, dal_error *error);

/* ---- options ------------------------------------------------------------------------------- */

typedef enum dal_space { DAL_LIFTED, DAL_PHYSICAL } dal_space;
typedef enum dal_solver { DAL_SOLVER_AUTO, DAL_FIXED_POINT, DAL_NEWTON } dal_solver;
typedef enum dal_precision { DAL_DOUBLE, DAL_QUAD } dal_precision;
typedef enum dal_sums { DAL_SUMS_COMPENSATED, DAL_SUMS_PLAIN } dal_sums;

/* One of several words, by its number. */
typedef int dal_choice;

/* type, name, its word outside C, default (of a choice the first word), min, max, value (the words
 * of a choice, or the name of the number in texts), help */
#define DAL_OPTION_LIST(OPTION)                                                                    \
    OPTION(double, step, "step", 0.01, 0.0, 1e300, "H", "step size h in units of t")               \
    OPTION(dal_choice, space, "space", DAL_LIFTED, 0, 1, "lifted|physical",                        \
           "4n+2 canonical variables, or (q,v); vakonomic systems have (q,v) alone")               \
    OPTION(dal_choice, solver, "solver", DAL_SOLVER_AUTO, 0, 2, "auto|fixed-point|newton",         \
           "for implicit equations; solves to rounding level without solver-tolerance")            \
    OPTION(int, iterations, "iterations", 100, 1, 100000, "N",                                     \
           "maximum number of iterations of an implicit equation")                                 \
    OPTION(dal_choice, extend_energy, "extend-energy", 0, 0, 1, "off|on",                          \
           "continue F off D = 0 so that E is conserved there too")                                \
    OPTION(double, tolerance, "tolerance", 0, 0.0, 1.0, "TOLERANCE",                               \
           "estimated error, absolute and relative, of the substeps of dop853; 0: no substeps")    \
    OPTION(double, solver_tolerance, "solver-tolerance", 0, 0.0, 1.0, "CHANGE",                    \
           "relative change at which an implicit equation counts as solved; 0: rounding level")    \
    OPTION(int, extra_iterations, "extra-iterations", 0, 0, 1000, "N",                             \
           "iterations after an implicit equation is solved")                                      \
    OPTION(dal_choice, sums, "sums", DAL_SUMS_COMPENSATED, 0, 1, "compensated|plain",              \
           "how steps are added to the state")                                                     \
    OPTION(                                                                                        \
        dal_choice, precision, "precision", DAL_DOUBLE, 0, 1, "double|quad",                       \
        "arithmetic of the run; quad has 113 binary digits and takes some hundred times longer")

typedef struct dal_options {
#define OPTION(type, name, word, initial, min, max, value, help) type name;
    DAL_OPTION_LIST(OPTION)
#undef OPTION
} dal_options;

dal_options dal_options_default(void);
/* Sets one option from text.  Errors: DAL_NAME (nearest name), DAL_ARGUMENT, DAL_SYNTAX. */
dal_status dal_options_set(dal_options *options, const char *name, const char *text,
                           dal_error *error);

/* ---- runs ---------------------------------------------------------------------------------- */

typedef struct dal_run dal_run;

typedef struct dal_setting {
    const char *name;
    double value;
} dal_setting;

/* What a run is made from.  parameters: by name.  start: x, x', e, p_x, pi_x, pi_e, g1, ...; the
 * system gives what is not named.  e = INFINITY gives 1/e = 0, the adjoint system. */
typedef struct dal_run_spec {
    const dal_system *system;
    dal_method method;
    dal_options options;
    const dal_setting *parameters, *start;
    int parameter_count, start_count;
} dal_run_spec;

/* Bytes that a run needs; 0 when the spec is not usable. */
size_t dal_run_size(const dal_run_spec *spec);
/* Places a run in the caller's memory (any alignment, dal_run_size bytes); nothing to free.
 * The system and the descriptors must outlive it.  Errors: DAL_ARGUMENT, DAL_NAME (nearest name),
 * DAL_UNSUPPORTED, DAL_INCONSISTENT (|D| beyond 1e-10 relative), DAL_RANK, DAL_SINGULAR_MASS,
 * DAL_GAUGE, DAL_NOT_FINITE, DAL_MEMORY (too few bytes). */
dal_status dal_run_init(dal_run **run, void *memory, size_t bytes, const dal_run_spec *spec,
                        dal_error *error);
/* The same in memory of its own. [alloc] */
dal_status dal_run_create(dal_run **run, const dal_run_spec *spec, dal_error *error);
void dal_run_free(dal_run *run);

/* One step, or count steps.  A step succeeds or leaves the run unchanged to the bit.  Errors:
 * DAL_SINGULAR, DAL_SINGULAR_MASS, DAL_NOT_FINITE, DAL_NOT_CONVERGED, DAL_GAUGE; the error names
 * the constraint and the time. */
dal_status dal_run_step(dal_run *run, dal_error *error);
dal_status dal_run_advance(dal_run *run, long long count, dal_error *error);

const dal_system *dal_run_system(const dal_run *run);
double dal_run_time(const dal_run *run);
double dal_run_step_size(const dal_run *run);      /* h */
long long dal_run_steps(const dal_run *run);       /* since t = 0, those before a restore too */
long long dal_run_evaluations(const dal_run *run); /* of the field, or of the lifted field */
int dal_run_dimension(const dal_run *run);         /* 4n+2 lifted; 2n + multipliers physical */
/* [dimension] q, v, e, p, pi, pi_e (lifted) or q, v, g (physical); valid until the run is freed. */
const double *dal_run_state(const dal_run *run);
const double *dal_run_parameters(const dal_run *run); /* [parameters] values in force */
/* Replaces time and state, which need only be finite; clears all other persistent state. */
dal_status dal_run_set_state(dal_run *run, double t, const double *state, dal_error *error);
/* Name of state component i: x, x', e, p_x, pi_x, pi_e, g1; returns buffer, NULL past the end. */
char *dal_run_name(const dal_run *run, int i, char *buffer, size_t size);

/* The persistent state of a run, *count doubles, valid until the run is freed: all that passes from
 * one step to the next.  A copy is a checkpoint.  restore puts it into a run of the same spec,
 * which then continues with the same bits.  Errors: DAL_ARGUMENT (wrong count), DAL_NOT_FINITE. */
const double *dal_run_save(const dal_run *run, size_t *count);
dal_status dal_run_restore(dal_run *run, const double *saved, size_t count, dal_error *error);

/* Observables at the present state, in this order: D1..Dm, E (with an energy), H (lifted),
 * |p|, |pi|, |pi_e| (lifted, max norms), invariants, error (with an exact solution that agrees with
 * the start; max norm over q). */
int dal_run_observables(const dal_run *run);
char *dal_run_observable_name(const dal_run *run, int i, char *buffer, size_t size);
dal_status dal_run_observe(dal_run *run, double *out);

/* Callbacks of dal_run_sample; any may be NULL.  Any status but DAL_OK ends the run with it. */
typedef struct dal_observer {
    void *user;
    /* Called for each row. */
    dal_status (*sample)(void *user, dal_run *run, long long row, double t);
    /* Called now and then between rows. */
    dal_status (*poll)(void *user, dal_run *run);
    /* Called at the start and after every `every` steps. */
    dal_status (*step)(void *user, dal_run *run);
    /* Replaces step for long runs: receives the observables of several such steps at once.
     * Observable i at t[k], k < count, is values[i * stride + k].  The run stands at the last of
     * them, or behind it and before the next. */
    dal_status (*values)(void *user, dal_run *run, int count, const double *t, const double *values,
                         size_t stride);
    long long every; /* steps between two calls of step or values; 0: no calls */
    /* t of each row, increasing, T for the last; NULL: row*T/samples */
    double (*row_time)(void *user, long long row);
    /* Max steps and rows between two polls, rounded down to 992, 496, 248, 124, ... 1; 0: 992.
     * poll may change it where steps are slow. */
    long long polling;
} dal_observer;

/* Advances the run to time T and samples rows first_row..samples at t = row*T/samples, the last at
 * T exactly.  The trajectory consists of steps h.  An intermediate step of the same method gives a
 * row between two steps and does not change the trajectory.  After an interruption between rows
 * pass the first row not sampled.  observer may be NULL. */
dal_status dal_run_sample(dal_run *run, double T, long long samples, long long first_row,
                          const dal_observer *observer, dal_error *error);

/* Takes a step of size h from the present state, calls observe there, and restores the run to the
 * bit.  observe must not move the run.  Errors: those of a step, the run being unchanged;
 * DAL_ARGUMENT; what observe returns. */
dal_status dal_run_intermediate(dal_run *run, double h,
                                dal_status (*observe)(void *user, dal_run *run), void *user,
                                dal_error *error);

/* ---- batches ------------------------------------------------------------------------------- */

typedef struct dal_batch dal_batch;

/* count runs of one spec, stepped several lanes at a time, each with the bits of a single run.
 * width: max lanes at a time, 1, 4 or 8; 0: the fastest.  Different batches may be stepped in
 * different threads.  [alloc] */
dal_status dal_batch_create(dal_batch **batch, const dal_run_spec *spec, int count, int width,
                            dal_error *error);
void dal_batch_free(dal_batch *batch);
/* Sets parameters and start of one lane, which replace those of the spec, at t = 0.  Allowed before
 * the first step only. */
dal_status dal_batch_start(dal_batch *batch, int lane, const dal_setting *parameters,
                           int parameter_count, const dal_setting *start, int start_count,
                           dal_error *error);
/* Steps every lane that has not failed; DAL_OK while any such lane is left.  A failed lane keeps
 * its state before the failing step and does not slow down the others. */
dal_status dal_batch_advance(dal_batch *batch, long long count);
int dal_batch_count(const dal_batch *batch);
dal_status dal_batch_status(const dal_batch *batch, int lane, dal_error *error);
double dal_batch_time(const dal_batch *batch, int lane);
/* Copies the state of a lane, [dimension] doubles as dal_run_state; does nothing without the
 * lane. */
void dal_batch_state(const dal_batch *batch, int lane, double *state);

#ifdef __cplusplus
}
#endif
#endif
