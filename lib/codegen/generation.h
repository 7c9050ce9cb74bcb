/* generation.h - a file that is being generated, and what it needs. */
#ifndef DAL_GENERATION_H
#define DAL_GENERATION_H

#include "core/buffer.h"
#include "expr/emit.h"
#include "kernel/parts.h"
#include "model/programs.h"
#include "run/engine.h"

/* The sources embedded in the library by the Makefile; the last name is NULL. */
typedef struct dal__source {
    const char *name; /* "rk4.c" */
    const char *text; /* without its #include lines */
} dal__source;
extern const dal__source dal__sources[];

enum { DAL__PREFIX_SIZE = 64 };

/* A whole file; or, for lib/jit, the steps of some lanes, the steps of one lane with a trace of its
 * states, or the observables of many states. */
typedef enum dal__product {
    DAL__PRODUCT_FILE,
    DAL__PRODUCT_LANES,
    DAL__PRODUCT_TRACE,
    DAL__PRODUCT_OBSERVE
} dal__product;

/* A name that lines #if of a source are decided by, see preprocessor.c. */
typedef struct dal__condition {
    const char *name;
    bool value;
} dal__condition;
enum { DAL__MAX_CONDITIONS = 48 };

typedef struct dal__generation {
    const dal_run_spec *spec;
    const dal_run *run; /* for names and observables */
    dal__layout layout;
    const dal__programs *programs;
    unsigned kernel;                    /* DAL_KERNEL_*: the parts of the method */
    const char *identifier[DAL_LAYERS]; /* of each layer */
    const char *source[DAL_LAYERS];     /* its text */
    dal__input_name *input;             /* names of the inputs in the programs */
    int lanes;
    bool with_field; /* functions of a point */
    dal__product product;
    char prefix[DAL__PREFIX_SIZE];
    dal__condition condition[DAL__MAX_CONDITIONS];
    int conditions;
    dal__buffer text;
} dal__generation;

/* Whether steps are divided into substeps. */
bool dal__is_controlled(const dal__generation *g);
/* Whether lanes, and evaluations, have times of their own. */
bool dal__has_times(const dal__generation *g);
bool dal__uses_newton(const dal__generation *g);
/* Whether a modifier moves tangent vectors stored in the momenta. */
bool dal__follows_tangents(const dal__generation *g);
/* Whether the kernel, or the method, evaluates a callback, be it present or not. */
bool dal__evaluates(const dal__generation *g, dal__program_code code);
/* Whether a program goes into the file. */
bool dal__wants(const dal__generation *g, dal__program_code code);
/* Whether a program that it gets is by columns (program_list.h). */
bool dal__inserts_columns(const dal__generation *g);
/* Whether the file has the function of a point that evaluates a program. */
bool dal__has_function(const dal__generation *g, dal__program_code code);
/* Whether a generated function may return a status. */
bool dal__is_status_of_step(dal_status status);
/* Whether the file has the code of the canonical variables, of which some methods have calls on any
 * space. */
bool dal__has_lift(const dal__generation *g);
/* Whether steps enforce holonomic constraints. */
bool dal__has_holonomic(const dal__generation *g);

#endif
