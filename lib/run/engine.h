/* engine.h - one step of one or several lanes as a transaction; internal to lib/run.
 *
 *     carried:  y[dim] | r[dim] | time, its rounding error, steps, evaluations, stiff, slopes_h |
 *               slopes[stages*(nw + n)]
 *
 * All that survives a step is the array `carried`; all else is scratch.  The engine exists once per
 * width (engine_wide.c); arrays are interleaved by lanes. */
#ifndef DAL_ENGINE_H
#define DAL_ENGINE_H

#include "dalembert.h"
#include "error.h"
#include <stdbool.h>

/* What a run is, apart from its values. */
typedef struct dal__shape {
    const dal_system *system;
    dal_method method;
    dal_options options;
    int n, nw, m, dim, lifted, depth, stages, slopes;
    size_t workspace, carried, scratch; /* numbers */
} dal__shape;

/* Places behind y and r in the carried array. */
enum {
    DAL__TIME,
    DAL__TIME_ERROR,
    DAL__STEPS,
    DAL__EVALUATIONS,
    DAL__STIFF,
    DAL__SLOPES_H,
    DAL__SLOPES
};
static inline size_t dal__at(const dal__shape *shape, int place)
{
    return 2 * (size_t)shape->dim + (size_t)place;
}

/* Why a step of one lane failed, found by stepping it again with eyes open (one lane only). */
typedef struct dal__cause {
    bool not_finite;       /* an answer of the system was not finite */
    dal_status status;     /* what the system said */
    double t;              /* where */
    double *q, *v;         /* [n], [nw] */
    int guard, constraint; /* which guard or normal turned, from 1; 0: none */
} dal__cause;

/* Measures a spec; errors as dal_run_init. */
dal_status dal__shape_init(dal__shape *shape, const dal_run_spec *spec, dal_error *error);

/* The descriptor of a built-in integrator compiled at a width, NULL: there is none. */
const dal_integrator *dal__integrator_wide(const dal_integrator *integrator, int width);

#define DAL__ENGINE(w)                                                                             \
    size_t dal__engine_bytes_x##w(const dal__shape *shape);                                        \
    void *dal__engine_place_x##w(const dal__shape *shape, void *memory, double **carried,          \
                                 double **work);                                                   \
    unsigned dal__engine_step_x##w(void *engine, double h, unsigned lanes, dal_status *why);       \
    dal_status dal__engine_ask_x##w(void *engine, int question, double t, const double *state,     \
                                    double *out);                                                  \
    void dal__engine_trace_x##w(void *engine, dal__cause *cause);

/* For each width:
 * bytes   memory an engine needs, to be aligned to 64 bytes;
 * place   makes one; *carried and *work receive its interleaved arrays (zeroed);
 * step    advances the lanes of a bit mask by h; returns the mask of those that failed, which are
 *         as they were, with why[lane] set;
 * ask     evaluates the field etc. (dal_question) at a state (adjoint: with its own pi);
 * trace   from now on records causes of failure (NULL: stops). */
DAL__ENGINE(1)
DAL__ENGINE(4)
DAL__ENGINE(8)

#endif
