/* run.h - the inside of a dal_run; internal to lib/run. */
#ifndef DAL_RUN_H
#define DAL_RUN_H

#include "run/engine.h"

struct dal_run {
    dal__shape shape;
    void *engine;    /* width 1 */
    double *carried; /* [shape.carried] the engine's own */
    double *work;    /* [shape.workspace] parameters, and the system's */
    double *shadow;  /* [shape.carried] state of the trajectory during a side step */
    double *answer;  /* scratch for what the system says */
    double *point;   /* [n + nw] where a step went wrong */
    bool exact;      /* the exact solution belongs to this start */
    void *owned;     /* memory to free, or NULL */
};

/* Names of state components, by place; NULL past the end. */
char *dal__state_name(const dal_system *system, bool lifted, int i, char *buffer, size_t size);

/* Sets parameters and the start at t = 0 and checks them; the run is then at its first step. */
dal_status dal__run_start(dal_run *run, const dal_setting *parameters, int parameter_count,
                          const dal_setting *start, int start_count, dal_error *error);

/* Finds out why a step of size h failed with status, and says it. */
dal_status dal__explain(dal_run *run, double h, dal_status status, dal_error *error);

/* A step of size h with no explanation of a failure. */
dal_status dal__run_step(dal_run *run, double h);

static inline dal_at dal__here(const dal_run *run)
{
    const dal__shape *k = &run->shape;
    return (dal_at){run->carried[dal__at(k, DAL__TIME)], run->carried, run->carried + k->n, NULL,
                    run->work};
}

#endif
