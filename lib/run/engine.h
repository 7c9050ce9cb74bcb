/* engine.h - one step of one or several lanes as a transaction.
 *
 * All that survives a step is the persistent state (kernel/persistent.h).  The engine exists once
 * per variant (engine_wide.c); its arrays are interleaved by lanes. */
#ifndef DAL_ENGINE_H
#define DAL_ENGINE_H

#include "run/layout.h"
#include "run/registry.h"
#include <stdint.h>

/* Why a step of one lane failed, recorded while it is repeated. */
typedef struct dal__failure {
    bool not_finite;   /* a callback returned a value that is not finite, or a status */
    dal_status status; /* that status */
    double t;          /* the point of that evaluation */
    double *q, *v;     /* [n], [nw] */
    double reached;    /* time at which the substeps ended */
    double substep;    /* size of the next one, 0: below the last place */
    int guard,
        constraint; /* the first guard or constraint that failed its check, from 1; 0: none */
} dal__failure;

/* The motion within a substep, as kernel/adaptive.h has it; from and size are of the step. */
typedef struct dal__polynomial {
    const double *y, *r; /* [dim] where the substep begins, as numbers of the engine */
    const double *rate;  /* [terms*dim] */
    int terms;
    double from, size;
} dal__polynomial;

/* A set of lanes: bit i is lane i. */
typedef uint64_t dal__lanes;

/* The next multiple of 64 bytes: a cache line, and the widest vector register. */
static inline size_t dal__align(size_t bytes) { return (bytes + 63) / 64 * 64; }

/* The functions of an engine of one variant. */
typedef struct dal__engine {
    /* Bytes of an engine, to be aligned to 64 bytes and to 8 bytes a lane. */
    size_t (*bytes)(const dal__layout *layout);
    /* Makes an engine; *persistent and, after it, *work receive its interleaved arrays (zeroed),
     * *scratch (unless NULL) what is free between steps. */
    void *(*place)(const dal__layout *layout, void *memory, double **persistent, double **work,
                   double **scratch);
    /* Advances the alive lanes by h.  Returns those that failed, which are unchanged, and sets
     * their reason[lane]. */
    dal__lanes (*step)(void *engine, double h, dal__lanes alive, dal_status *reason);
    /* Advances a single run by `size`, within its step of size h: to the state that the polynomial
     * of the substep there gives.  Without a tolerance, or where the method leaves no polynomial,
     * it is a step of that size.  NULL for several lanes. */
    dal__lanes (*step_intermediate)(void *engine, double h, double size, dal_status *reason);
    /* Gives the polynomial that step_intermediate has found last; false: there is none.  NULL for
     * several lanes. */
    bool (*polynomial)(const void *engine, dal__polynomial *out);
    /* Holds the branches of the system at points, or no longer, as dal_branches.hold.  NULL for
     * several lanes. */
    void (*hold)(void *engine, const double *point);
    /* Evaluates a callback (dal_callback_code) at a state, with its own pi. */
    dal_status (*eval)(void *engine, int code, double t, const double *state, double *out);
    /* The observables of the present state; exact_known as in dal__observable_count.  NULL for
     * several lanes. */
    dal_status (*observe)(void *engine, bool exact_known, double *out);
    /* Records failures from now on (NULL: no longer). */
    void (*trace)(void *engine, dal__failure *failure);
} dal__engine;

typedef struct dal__engine_kind {
    int width;
    dal__instructions set;
    const dal__engine *engine;
} dal__engine_kind;

#define VARIANT(name, variant, lanes, set) extern const dal__engine name##_##variant;
VARIANT(dal__engine, x1, 1, BASE)
DAL__VARIANT_LIST(VARIANT, dal__engine)
#undef VARIANT

extern const dal__engine_kind dal__engine_kinds[DAL__VARIANTS];

/* Whether machine, system and integrators have the variant. */
bool dal__engine_can(const dal__layout *layout, dal__variant variant);
/* The best engine of a width, or NULL (never for width 1). */
const dal__engine_kind *dal__engine_best(const dal__layout *layout, int width);

#endif
