/* generate.h - the making of one C file from a run's spec; internal to lib/codegen.
 *
 * A generated file is the kernel and the integrator as they stand in the library, compiled with
 * constant dimensions (DAL_SPECIALISED), around the system's programs as straight-line code. */
#ifndef DAL_GENERATE_H
#define DAL_GENERATE_H

#include "core/buffer.h"
#include "expr/emit.h"
#include "model/programs.h"
#include "run/engine.h"

/* The sources that travel inside the library, made by the Makefile; the last name is NULL. */
typedef struct dal__source {
    const char *name; /* "rk4.c" */
    const char *text; /* without its #include lines */
} dal__source;
extern const dal__source dal__sources[];

enum { DAL__PREFIX_SIZE = 64 };

/* What is made: a whole file; for native mode, the steps of some lanes, those of one lane which may
 * leave a trace of its states, and the observables of many states. */
typedef enum dal__product { DAL__FILE, DAL__LANES, DAL__TRACE, DAL__OBSERVE } dal__product;

typedef struct dal__generation {
    const dal_run_spec *spec;
    const dal_run *run; /* knows names and observables */
    dal__layout layout;
    const dal__programs *programs;
    const dal__source *source[DAL_LAYERS]; /* of each link */
    dal__input_name *input;                /* what the programs call their inputs */
    int lanes;
    dal__product product;
    char prefix[DAL__PREFIX_SIZE];
    dal__buffer text;
} dal__generation;

/* Adds a text in which the word PREFIX becomes the prefix. */
void dal__write_template(dal__generation *g, const char *text);
/* The text of a source by its name; "" when there is none. */
const char *dal__source_text(const char *name);
/* Whether the text of the method uses a word. */
bool dal__method_uses(const dal__generation *g, const char *word);
bool dal__uses_newton(const dal__generation *g);
bool dal__follows_tangents(const dal__generation *g);
/* Whether a program goes into the file. */
bool dal__wants(const dal__generation *g, dal__program_code code);

/* Sees whether it can be made, and sets layout, programs, sources and prefix. */
dal_status dal__generation_check(dal__generation *g, const char *prefix, dal_error *error);
dal_status dal__generation_finish(dal__generation *g, char **text, dal_error *error);
/* What keeps a compiler exact; kernel, system, method and steps. */
void dal__write_compiler(dal__generation *g);
void dal__write_steps(dal__generation *g);

#endif
