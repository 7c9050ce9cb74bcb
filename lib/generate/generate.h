/* generate.h - the making of one C file from a run's spec; internal to lib/generate.
 *
 * A generated file is the kernel and the integrator as they stand in the library, compiled with
 * constant dimensions (DAL_SPECIALISED), around the system's programs as straight-line code. */
#ifndef DAL_GENERATE_H
#define DAL_GENERATE_H

#include "mechanics/mechanics.h"
#include "run/engine.h"
#include "text.h"

/* The sources that travel inside the library, made by the Makefile; the last name is NULL. */
typedef struct dal__source {
    const char *name; /* "rk4.c" */
    const char *text; /* without its #include lines */
} dal__source;
extern const dal__source dal__sources[];

enum { DAL__PREFIX_SIZE = 64 };

typedef struct dal__generation {
    const dal_run_spec *spec;
    dal_run *run; /* at its start; knows names and observables */
    dal__shape shape;
    const dal__programs *programs;
    const dal__source *source[DAL_CHAIN]; /* of each link */
    dal__input_name *input;               /* what the programs call their inputs */
    int lanes;
    bool native; /* steps alone */
    char prefix[DAL__PREFIX_SIZE];
    dal__text text;
} dal__generation;

/* Adds a text in which the word PREFIX becomes the prefix. */
void dal__put_template(dal__generation *g, const char *text);
/* The text of a source by its name; "" when there is none. */
const char *dal__source_text(const char *name);
/* Whether the text of the method uses a word. */
bool dal__method_uses(const dal__generation *g, const char *word);
bool dal__uses_newton(const dal__generation *g);
bool dal__follows_tangents(const dal__generation *g);
/* Whether a program goes into the file. */
bool dal__wants(const dal__generation *g, dal__program_code code);

/* The steps alone, for native mode: the function DAL__NATIVE_PREFIX_lanes.  Takes nothing from the
 * parameters and the start of the spec. [alloc] */
#define DAL__NATIVE_PREFIX "dal_native"
dal_status dal__generate_native(const dal_run_spec *spec, int lanes, char **text, dal_error *error);

/* ---- prefix.c ---- */

/* A prefix of the caller's, or (NULL) SYSTEM_METHOD.  Errors: DAL_ARGUMENT. */
dal_status dal__choose_prefix(dal__generation *g, const char *prefix, dal_error *error);

/* ---- constants.c ---- */
void dal__put_constants(dal__generation *g);

/* ---- interface.c: what a caller sees ---- */
void dal__put_interface(dal__generation *g);
void dal__put_names(dal__generation *g);

/* ---- answers.c: the system ---- */
void dal__put_answers(dal__generation *g);
void dal__put_start(dal__generation *g);
void dal__put_observe(dal__generation *g);

#endif
