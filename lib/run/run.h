/* run.h - the inside of a dal_run.
 *
 * One block of memory:
 *
 *     dal_run | shadow, point, event_scratch, scales, observations | engine | quad engine */
#ifndef DAL_RUN_H
#define DAL_RUN_H

#include "run/quad.h"

/* Compiled functions, see lib/jit/native.c; an object has one of them.  persistent, work and states
 * are as everywhere; lanes is a mask. */
typedef struct dal__native_code {
    /* Takes up to count steps until a lane fails; returns the number of steps tried. */
    long long (*steps)(double *persistent, const double *work, double h, long long count,
                       unsigned lanes, unsigned *failed, int *reason);
    /* The same for one lane.  Component i of the state after step k goes to states[i*stride + k],
     * the time after the last component.  states may be NULL. */
    long long (*traced)(double *persistent, const double *work, double h, long long count,
                        unsigned *failed, int *reason, double *states, long long stride);
    /* The observables of such states: observable i of state k goes to values[i*stride + k]. */
    void (*observables)(const double *states, long long stride, long long count, const double *work,
                        double *values);
    void *handle;
    void (*release)(void *handle);
} dal__native_code;

/* Up to capacity successive observations: observable i of observation k is values[i*capacity +
 * k]. */
typedef struct dal__observations {
    int capacity;
    double *states; /* [dim*capacity], evaluated together; NULL: each is evaluated at once */
    double *times;  /* [capacity], after states */
    double *values; /* [observables*capacity] */
    dal__native_code code;
} dal__observations;

struct dal_run {
    dal__layout layout;
    const dal__engine_kind *kind; /* of one lane */
    void *engine;
    double *persistent; /* [layout.persistent] of the engine; in quad precision: rounded */
    double *storage;    /* [stored] persistent and, after it, parameters; or the same of quad */
    size_t stored;
    dal__quad_run quad;
    double *work;          /* [layout.workspace] parameters, and numbers of the system */
    double *shadow;        /* [stored] the state before an intermediate step */
    double *scratch;       /* of the engine, for outputs of callbacks */
    double *matrices;      /* of all constraints: scratch, or see dal__reserve_matrices */
    double *point;         /* [n + nw] where a step failed; D and g before a change of parameters */
    double *event_scratch; /* see event_search.c */
    double *scales;        /* see scales.c */
    bool has_search;       /* event_scratch holds a search, see event_search.c */
    bool is_held;          /* the branches of the system are held */
    bool exact;            /* the exact solution agrees with the start */
    void *owned;           /* memory to free, or NULL */
    dal__native_code native;
    dal__observations observations;
};

/* Constant without quad precision, so that no call of run/quad.h remains. */
#define DAL__IS_QUAD(run) (DAL__HAS_QUAD && (run)->quad.engine)

/* Holds the branches of the system at points [branches->count], see dal_branches; NULL: no
 * longer. */
void dal__run_hold(dal_run *run, const double *point);
/* Takes count steps of size h, until one fails; does not explain a failure. */
dal_status dal__step_run(dal_run *run, double h, long long count);
/* Advances an interpreted run by `size` within its step h, see dal__engine.step_intermediate. */
dal_status dal__step_intermediate(dal_run *run, double h, double size);

enum { DAL__NAME_SIZE = 128 /* bytes of the name of a state component */ };

/* Completes work from the parameters. */
dal_status dal__run_prepare(dal_run *run);
/* Takes state and parameters from a copy of the storage; parameters that are others are prepared.
 * Errors: as for prepare. */
dal_status dal__run_load(dal_run *run, const double *saved);
/* Saves state and parameters in the shadow, and restores them. */
void dal__run_back_up(dal_run *run);
void dal__run_revert(dal_run *run);

static inline void dal__compiled_free(dal__native_code *native)
{
    if (native->release) native->release(native->handle);
}

/* The present point. */
static inline dal_point dal__here(const dal_run *run)
{
    const dal__layout *k = &run->layout;
    return (dal_point){run->persistent[dal__at(k, DAL__TIME)],
                       run->persistent,
                       run->persistent + k->n,
                       NULL,
                       run->work,
                       NULL};
}

#endif
