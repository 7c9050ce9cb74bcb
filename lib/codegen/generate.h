/* generate.h - one C file from the spec of a run.
 *
 * A generated file is the kernel and the integrator as they stand in the library, compiled with
 * constant dimensions (DAL_SPECIALISED), with the programs of the system as straight-line code. */
#ifndef DAL_GENERATE_H
#define DAL_GENERATE_H

#include "core/buffer.h"
#include "expr/emit.h"
#include "model/programs.h"
#include "run/engine.h"

/* The sources embedded in the library by the Makefile; the last name is NULL. */
typedef struct dal__source {
    const char *name; /* "rk4.c" */
    const char *text; /* without its #include lines */
} dal__source;
extern const dal__source dal__sources[];

enum { DAL__PREFIX_SIZE = 64 };

/* A whole file; or, for lib/jit, the steps of some lanes, those of one lane with a trace of its
 * states, or the observables of many states. */
typedef enum dal__product { DAL__FILE, DAL__LANES, DAL__TRACE, DAL__OBSERVE } dal__product;

typedef struct dal__generation {
    const dal_run_spec *spec;
    const dal_run *run; /* for names and observables */
    dal__layout layout;
    const dal__programs *programs;
    const dal__source *source[DAL_LAYERS]; /* of each layer */
    dal__input_name *input;                /* names of the inputs in the programs */
    int lanes;
    dal__product product;
    char prefix[DAL__PREFIX_SIZE];
    dal__buffer text;
} dal__generation;

/* Writes a text, with the prefix for the word PREFIX. */
void dal__write_template(dal__generation *g, const char *text);
/* The text of a source by its name; "" when there is none. */
const char *dal__source_text(const char *name);
/* Whether the text of the method uses a word. */
bool dal__method_uses(const dal__generation *g, const char *word);
bool dal__uses_newton(const dal__generation *g);
bool dal__follows_tangents(const dal__generation *g);
/* Whether a program goes into the file. */
bool dal__wants(const dal__generation *g, dal__program_code code);

/* Checks the spec, and sets layout, programs, sources and prefix. */
dal_status dal__generation_check(dal__generation *g, const char *prefix, dal_error *error);
dal_status dal__generation_finish(dal__generation *g, char **text, dal_error *error);
/* The pragmas that keep a compiler exact; kernel, system, method and steps. */
void dal__write_compiler(dal__generation *g);
void dal__write_steps(dal__generation *g);

#endif
