/* run.h - the inside of a dal_run; internal to lib/run. */
#ifndef DAL_RUN_H
#define DAL_RUN_H

#include "run/engine.h"

/* Compiled code, see lib/jit/native.c; of the functions an object has one.  persistent, work and
 * states are as everywhere; lanes are a mask. */
typedef struct dal__native {
    /* Up to count steps until a lane fails; the number of steps tried. */
    long long (*steps)(double *persistent, const double *work, double h, long long count,
                       unsigned lanes, unsigned *failed, int *why);
    /* The same of one lane; number i of the state after step k goes to states[i * stride + k], the
     * time behind the last number.  states may be NULL. */
    long long (*traced)(double *persistent, const double *work, double h, long long count,
                        unsigned *failed, int *why, double *states, long long stride);
    /* The observables of such states: number i of state k at values[i * stride + k]. */
    void (*observables)(const double *states, long long stride, long long count, const double *work,
                        double *values);
    void *handle;
    void (*release)(void *handle);
} dal__native;

/* The engine of a run in quad precision, and what belongs to it; see quad.c. */
typedef struct dal__quad_run {
    dal__layout layout; /* of the system in quad precision */
    void *engine;       /* NULL: the run is in doubles */
    double *persistent; /* [layout.persistent] its own numbers, each in the place of some doubles */
    double *work;       /* [layout.workspace] likewise */
    double *scratch;    /* scratch for what the system says, likewise */
} dal__quad_run;

/* Where the observables of successive looks at a run are collected, up to room of them: observable
 * i of record k is values[i * room + k]. */
typedef struct dal__observations {
    int capacity;
    double *states; /* [dim * room], to be evaluated together; NULL: every record is at once */
    double *times;  /* [room], behind states */
    double *values; /* [observables * room] */
    dal__native code;
} dal__observations;

struct dal_run {
    dal__layout layout;
    const dal__engine_kind *kind; /* of one lane */
    void *engine;
    double *persistent; /* [layout.persistent] the engine's own; rounded in quad precision */
    double *storage; /* [stored] all that is persistent from step to step: persistent, or quad's */
    size_t stored;
    dal__quad_run quad;
    double *work;    /* [layout.workspace] parameters, and the system's */
    double *shadow;  /* [stored] state of the trajectory during a side step */
    double *scratch; /* scratch for what the system says */
    double *point;   /* [n + nw] where a step went wrong */
    bool exact;      /* the exact solution belongs to this start */
    void *owned;     /* memory to free, or NULL */
    dal__native native;
    dal__observations observations;
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
dal_status dal__failure_reason(dal_run *run, double h, dal_status status, dal_error *error);

/* Follows count steps and hands the looks over to observer->values; or the start alone. */
dal_status dal__observe_steps(dal_run *run, const dal_observer *observer, long long count,
                              dal_error *error);
dal_status dal__observe_start(dal_run *run, const dal_observer *observer, dal_error *error);

/* status, which an observer returned, and what is said of it. */
dal_status dal__stopped(const dal_run *run, dal_status status, dal_error *error);

/* count steps of size h, until one fails, with no explanation of a failure. */
dal_status dal__run_steps(dal_run *run, double h, long long count);

/* Remembers all that is persistent, and goes back to that. */
void dal__run_back_up(dal_run *run);
void dal__run_revert(dal_run *run);

/* ---- quad.c: a run in quad precision ---- */

/* Bytes for its engine, aligned to 64; doubles that one of its numbers takes. */
size_t dal__quad_bytes(const dal__layout *layout, size_t answers);
size_t dal__quad_width(void);
void dal__quad_place(dal_run *run, char *memory, size_t answers);
/* Takes over parameters, state and clock of the run in doubles; and gives it them, rounded. */
dal_status dal__quad_begin(dal_run *run);
void dal__quad_push(dal_run *run);
void dal__quad_pull(dal_run *run);
dal_status dal__quad_step(dal_run *run, double h);
/* As dal_run_observe, and the numbers of a memory of this run rounded to doubles. */
dal_status dal__quad_observe(dal_run *run, double *out);
double dal__quad_rounded(const double *memory, size_t i);

static inline dal_point dal__here(const dal_run *run)
{
    const dal__layout *k = &run->layout;
    return (dal_point){run->persistent[dal__at(k, DAL__TIME)], run->persistent,
                       run->persistent + k->n, NULL, run->work};
}

#endif
