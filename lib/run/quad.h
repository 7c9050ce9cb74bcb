/* quad.h - the engine of a run in quad precision, after the one of a run in double. */
#ifndef DAL_RUN_QUAD_H
#define DAL_RUN_QUAD_H

#include "run/engine.h"

/* The engine; its arrays hold quad numbers. */
typedef struct dal__quad_run {
    dal__layout layout; /* of the system in quad precision */
    void *engine;       /* NULL: the run is in double */
    double *persistent; /* [layout.persistent] */
    double *work;       /* [layout.workspace] */
} dal__quad_run;

/* Bytes for the engine, aligned to 64, of a run with a layout; doubles per number. */
size_t dal__quad_bytes(const dal__layout *layout);
size_t dal__quad_width(void);
void dal__quad_place(dal__quad_run *run, const dal__layout *layout, char *memory);
/* Copies number i of the persistent state of the run in double. */
void dal__quad_set(const dal__quad_run *run, const double *persistent, size_t i);
/* Copies persistent state and parameters of the run in double, those before number `first`
 * excepted (push), or to it, rounded (pull). */
void dal__quad_push(const dal__quad_run *run, const double *persistent, size_t first);
void dal__quad_pull(const dal__quad_run *run, double *persistent);
/* Completes work from the parameters, at the time t of the run in double. */
dal_status dal__quad_prepare(const dal__quad_run *run, double t);
void dal__quad_hold(const dal__quad_run *run, const double *point);
dal_status dal__quad_step(const dal__quad_run *run, double h);
dal_status dal__quad_step_intermediate(const dal__quad_run *run, double h, double size);
/* As dal_run_observe; exact_known as in dal__observable_count. */
dal_status dal__quad_observe(const dal__quad_run *run, bool exact_known, double *out);
/* Takes a step of size h and finds what it changes of D, E where there is one, and the invariants,
 * out[their number], rounded at the end alone; memory holds 2 quad numbers for each. */
dal_status dal__quad_change(const dal__quad_run *run, double h, double *memory, double *out);
/* Number i of stored quad numbers, rounded. */
double dal__quad_rounded(const double *stored, size_t i);

#endif
