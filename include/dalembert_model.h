/* dalembert_model.h - models: systems from formulas.
 *
 * A part of dalembert.h, which has the conventions. */
#ifndef DALEMBERT_MODEL_H
#define DALEMBERT_MODEL_H

#include "dalembert_system.h"

#ifdef __cplusplus
extern "C" {
#endif

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
    SECTION(HOLONOMIC, "holonomic")         /* formula in q, t and parameters */                   \
    SECTION(REACTIONS, "reactions")   /* constraint.coordinate, as 2.x: formula; see below */      \
    SECTION(MECHANICS, "mechanics")   /* lagrange-d'alembert (default) or vakonomic */             \
    SECTION(CONTROLS, "controls")     /* column.coordinate, as 2.x: formula; of effort controls */ \
    SECTION(EQUATIONS, "equations")   /* formula in q, q' and q'', as x'': 0 on the motions */     \
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
 * A component of B_a that is not named is 0.  A holonomic constraint g(q,t) = 0 brings the row
 * D = g_q v + g_t, after the rows of the section constraints, and a reaction along g_q. */
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
/* Chooses K of the lift; DAL_EFFORT_IDENTITY where it is not called.  Errors: DAL_STATUS_ARGUMENT
 * (an unknown effort, a model that has its system).  dal_model_system then has the errors
 * DAL_STATUS_MODEL (controls, and the model has none) and DAL_STATUS_UNSUPPORTED (vakonomic motion,
 * which has no lift; mass, and W is singular). */
dal_status dal_model_set_effort(dal_model *model, dal_effort effort, dal_error *error);
/* Replaces e and mu_e of the lift, "e = 1, mu_e = 0.1*cos(t)": what is not named is 1, and 0.  On
 * p = pi = 0 no gauge changes a bit of (q, v).  Places of its formulas are line 1 and a column of
 * the text.  Call it before dal_model_observe.  [alloc]  Errors: DAL_STATUS_SYNTAX with the column,
 * DAL_STATUS_NAME (another name), DAL_STATUS_MODEL (a name given twice), DAL_STATUS_ARGUMENT (a
 * model that has its system).  dal_model_system then has the errors of its formulas, and
 * DAL_STATUS_MODEL where e is not above 0. */
dal_status dal_model_set_gauge(dal_model *model, const char *text, dal_error *error);
/* Which mechanics a model's Lagrangian and constraints are read by: MECHANICS(code, name). */
#define DAL_MECHANICS_LIST(MECHANICS)                                                              \
    MECHANICS(SYSTEM, "system")                         /* what its section mechanics names */     \
    MECHANICS(LAGRANGE_DALEMBERT, "lagrange-dalembert") /* reactions do no virtual work (nh3) */   \
    MECHANICS(VAKONOMIC, "vakonomic")                   /* extremals of int L - g.D (nh6) */
/* The number of a mechanics. */
typedef enum dal_mechanics {
#define CODE(code, name) DAL_MECHANICS_##code,
    DAL_MECHANICS_LIST(CODE)
#undef CODE
        DAL_MECHANICS_COUNT
} dal_mechanics;
/* Chooses the mechanics; DAL_MECHANICS_SYSTEM where it is not called.  Where it is another one than
 * the model's own, the system has no exact solution, its invariants are observed alone, and the
 * start has no multipliers g if it is DAL_MECHANICS_LAGRANGE_DALEMBERT.  Errors:
 * DAL_STATUS_ARGUMENT (an unknown mechanics, a model that has its system).  dal_model_system then
 * has the errors of a model with this mechanics: DAL_STATUS_MODEL (vakonomic, with accelerations,
 * reactions or impacts) and DAL_STATUS_NAME (formulas of g in Lagrange-d'Alembert mechanics). */
dal_status dal_model_set_mechanics(dal_model *model, dal_mechanics mechanics, dal_error *error);
/* Between two points a table is a straight line, the natural cubic spline: smooth up to its second
 * derivative, which is 0 at both ends; or the cubic spline without knots at the second and the last
 * but one point: through points of a cubic it is that cubic, and its second derivative has the same
 * order of error at the ends as elsewhere. */
typedef enum dal_interpolation { DAL_LINEAR, DAL_CUBIC, DAL_NOT_A_KNOT } dal_interpolation;
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
 * method's exact tangent map.
 *
 * Its lifted space is the tangent of the lifted space: the momenta of (q, dq) are (dp, p) and
 * (dpi, pi), pi_e is dpi_e, and with K = [[0, K], [K, dK]] as its effort, dK = K_q dq + K_v dv,
 *     H = dp.v + p.dv + dpi.F + pi.(F_q dq + F_v dv) + (2 dpi.K pi + pi.dK pi)/(2e)
 * is the derivative of H of the system along (dq, dv, dp, dpi), with de = 0.  Vakonomic motion has
 * no lift; its tangent system has the 2m multipliers (g, dg). [alloc]  Errors: as for
 * dal_model_system. */
dal_status dal_model_tangent(dal_model *model, const dal_system **system, dal_error *error);
/* The same with the derivatives by a parameter added, F_q dq + F_v dv + F_k, and to dK likewise; it
 * starts from the derivative of the start of the system.  Steps of a Runge-Kutta or partitioned
 * method then move (dq, dv) as the derivative of the steps of a run by that parameter. [alloc]
 * Errors: also DAL_STATUS_NAME; DAL_STATUS_UNSUPPORTED: the gauge depends on the parameter, or the
 * start is solved. */
dal_status dal_model_tangent_by(dal_model *model, const char *parameter, const dal_system **system,
                                dal_error *error);

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
/* The same of one constraint by itself, from 0: with one rank it is integrable, a multiple of the
 * derivative of some g(q,t).  Errors: likewise; DAL_STATUS_ARGUMENT. */
dal_status dal_model_growth_of(dal_model *model, int constraint, const dal_setting *parameters,
                               int parameter_count, const double *units, dal_growth *out,
                               dal_error *error);

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
