/* engine.h - one step of one or several lanes as a transaction; internal to lib/run.
 *
 * All that survives a step is the array `persistent` (kernel/persistent.h).  The engine exists once
 * per variant (engine_wide.c); arrays are interleaved by lanes. */
#ifndef DAL_ENGINE_H
#define DAL_ENGINE_H

#include "core/arguments.h"
#include "core/machine.h"
#include "dalembert.h"
#include "kernel/persistent.h"
#include <stdbool.h>
#include <stdint.h>

/* What a run is, apart from its values. */
typedef struct dal__layout {
    const dal_system *system;
    dal_method method;
    dal_options options;
    int n, nw, m, dim, lifted, depth, stages, derivatives, multiplier;
    size_t workspace, persistent, scratch; /* numbers */
} dal__layout;

/* Numbers of what a method remembers, for DAL__METHOD_STATE_LIST. */
#define DAL__COUNT_ONE(layout)         1
#define DAL__COUNT_TWO(layout)         2
#define DAL__COUNT_DERIVATIVES(layout) ((layout)->derivatives)
#define DAL__COUNT_MULTIPLIER(layout)  ((layout)->multiplier)

/* Where something of the clock, or the memory, is in the persistent array. */
static inline size_t dal__at(const dal__layout *layout, int place)
{
    return 2 * (size_t)layout->dim + (size_t)place;
}

/* Why a step of one lane failed, found by stepping it again with eyes open (one lane only). */
typedef struct dal__failure {
    bool not_finite;       /* an answer of the system was not finite */
    dal_status status;     /* what the system said */
    double t;              /* where */
    double *q, *v;         /* [n], [nw] */
    double reached;        /* time at which the substeps ended */
    double substep;        /* the one planned then, 0: too small to be told from none */
    int guard, constraint; /* which guard or normal turned, from 1; 0: none */
} dal__failure;

/* Measures a spec; errors as dal_run_init. */
dal_status dal__layout_init(dal__layout *layout, const dal_run_spec *spec, dal_error *error);

/* Whether a run can be in quad precision (quad.c).  Errors: DAL_UNSUPPORTED. */
dal_status dal__quad_check(const dal__layout *layout, dal_error *error);

/* Numbers in the answer to a dal_callback_code. */
int dal__eval_size(const dal__layout *layout, int code);

/* The variants by number. */
typedef enum dal__variant {
    DAL__VARIANT_x1,
#define X(name, variant, lanes, set) name##_##variant,
    DAL__VARIANT_LIST(X, DAL__VARIANT)
#undef X
        DAL__VARIANTS
} dal__variant;

/* The descriptor of a built-in integrator for a variant; NULL: there is none. */
const dal_integrator *dal__integrator_wide(const dal_integrator *integrator, dal__variant variant);

/* A set of lanes: bit i is lane i. */
typedef uint64_t dal__lanes;

#define DAL__ENGINE(name, variant, lanes, set)                                                     \
    size_t name##_bytes_##variant(const dal__layout *layout);                                      \
    void *name##_place_##variant(const dal__layout *layout, void *memory, double **persistent,     \
                                 double **work);                                                   \
    dal__lanes name##_step_##variant(void *engine, double h, dal__lanes alive, dal_status *why);   \
    dal_status name##_eval_##variant(void *engine, int code, double t, const double *state,        \
                                     double *out);                                                 \
    void name##_trace_##variant(void *engine, dal__failure *failure);

/* For each variant:
 * bytes   memory an engine needs, to be aligned to 64 bytes and to 8 bytes a lane;
 * place   makes one; *persistent and *work receive its interleaved arrays (zeroed);
 * step    advances the lanes alive by h; returns those that failed, which are as they were, with
 *         why[lane] set;
 * ask     evaluates the field etc. (dal_callback_code) at a state (adjoint: with its own pi);
 * trace   from now on records causes of failure (NULL: stops). */
DAL__ENGINE(dal__engine, x1, 1, BASE)
DAL__VARIANT_LIST(DAL__ENGINE, dal__engine)

/* The same by number. */
typedef struct dal__engine_kind {
    int width;
    dal__instructions set;
    size_t (*bytes)(const dal__layout *layout);
    void *(*place)(const dal__layout *layout, void *memory, double **persistent, double **work);
    dal__lanes (*step)(void *engine, double h, dal__lanes alive, dal_status *why);
    dal_status (*eval)(void *engine, int code, double t, const double *state, double *out);
    void (*trace)(void *engine, dal__failure *failure);
} dal__engine_kind;
extern const dal__engine_kind dal__engine_kinds[DAL__VARIANTS];

/* Whether machine, system and integrators have the variant; the best there is of a width, or NULL
 * (of width 1 there is always one). */
bool dal__engine_can(const dal__layout *layout, dal__variant variant);
const dal__engine_kind *dal__engine_best(const dal__layout *layout, int width);

#endif
