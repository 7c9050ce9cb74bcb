/* generate.h - one C file from the spec of a run.
 *
 * A generated file is the kernel and the integrator as they are in the library, compiled with
 * constant dimensions (DAL_SPECIALISED), with the programs of the system as straight-line code. */
#ifndef DAL_GENERATE_H
#define DAL_GENERATE_H

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

/* A whole file; or, for lib/jit, the steps of some lanes, the steps of one lane with a trace of
 * its states, or the observables of many states. */
typedef enum dal__product { DAL__FILE, DAL__LANES, DAL__TRACE, DAL__OBSERVE } dal__product;

/* A name that lines #if of a source are decided by, see parts.h. */
typedef struct dal__condition {
    const char *name;
    bool value;
} dal__condition;
enum { DAL__MAX_CONDITIONS = 32 };

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
    dal__product product;
    char prefix[DAL__PREFIX_SIZE];
    dal__condition condition[DAL__MAX_CONDITIONS];
    int conditions;
    dal__buffer text;
} dal__generation;

/* Decides what lines #if of the sources depend on; adds the parts of the kernel that the system
 * needs. */
void dal__decide_conditions(dal__generation *g);
/* Whether evaluations have a time for each lane. */
bool dal__has_times(const dal__generation *g);
bool dal__uses_newton(const dal__generation *g);
bool dal__follows_tangents(const dal__generation *g);
/* Whether the kernel, or the method, evaluates a callback. */
bool dal__evaluates(const dal__generation *g, dal__program_code code);
/* Whether a program goes into the file. */
bool dal__wants(const dal__generation *g, dal__program_code code);

/* Checks the spec, and sets layout, programs, sources and prefix. */
dal_status dal__generation_check(dal__generation *g, const char *prefix, dal_error *error);
dal_status dal__generation_finish(dal__generation *g, char **text, dal_error *error);
/* The pragmas that keep a compiler exact; kernel, system, method and steps. */
void dal__write_compiler(dal__generation *g);
/* The one rule for loops over components: unrolled, or vectors. */
void dal__write_unrolling(dal__generation *g);
void dal__write_steps(dal__generation *g);

#endif
