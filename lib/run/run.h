/* run.h - the inside of a dal_run; internal to lib/run. */
#ifndef DAL_RUN_H
#define DAL_RUN_H

#include "run/engine.h"

/* Compiled steps, see lib/generate/native.c: up to count steps of the lanes in a mask, until one of
 * them fails; the number of steps tried.  NULL: the engine steps. */
typedef struct dal__native {
    long long (*steps)(double *carried, const double *work, double h, long long count,
                       unsigned lanes, unsigned *failed, int *why);
    void *handle;
    void (*release)(void *handle);
} dal__native;

struct dal_run {
    dal__shape shape;
    const dal__engine_kind *kind; /* of one lane */
    void *engine;
    double *carried; /* [shape.carried] the engine's own */
    double *work;    /* [shape.workspace] parameters, and the system's */
    double *shadow;  /* [shape.carried] state of the trajectory during a side step */
    double *answer;  /* scratch for what the system says */
    double *point;   /* [n + nw] where a step went wrong */
    bool exact;      /* the exact solution belongs to this start */
    void *owned;     /* memory to free, or NULL */
    dal__native native;
};

static inline void dal__native_free(dal__native *native)
{
    if (native->release) native->release(native->handle);
}

/* Names of state components, by place; NULL past the end. */
char *dal__state_name(const dal_system *system, bool lifted, int i, char *buffer, size_t size);

/* Sets parameters and the start at t = 0 and checks them; the run is then at its first step. */
dal_status dal__run_start(dal_run *run, const dal_setting *parameters, int parameter_count,
                          const dal_setting *start, int start_count, dal_error *error);

/* Finds out why a step of size h failed with status, and says it. */
dal_status dal__explain(dal_run *run, double h, dal_status status, dal_error *error);

/* count steps of size h, until one fails, with no explanation of a failure. */
dal_status dal__run_steps(dal_run *run, double h, long long count);

static inline dal_at dal__here(const dal_run *run)
{
    const dal__shape *k = &run->shape;
    return (dal_at){run->carried[dal__at(k, DAL__TIME)], run->carried, run->carried + k->n, NULL,
                    run->work};
}

#endif
