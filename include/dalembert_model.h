/* dalembert_model.h - models: systems from formulas; a part of dalembert.h, never included by
 * itself. */
#ifndef DALEMBERT_MODEL_H
#define DALEMBERT_MODEL_H

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

#endif
