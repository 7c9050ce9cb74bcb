/* local_change.h - what single steps of a method change, each begun on the exact motion. */
#ifndef DAL_LOCAL_CHANGE_H
#define DAL_LOCAL_CHANGE_H

#include "dalembert_batch.h"
#include "dalembert_evaluator.h"
#include "dalembert_run.h"

enum { DAL__LOCAL_STEPS = 64 /* that are taken together */ };

/* D1..Dm, E where there is one, and invariants: of a system, and how steps change them. */
typedef struct dal__local {
    const dal_system *system;
    dal_evaluator *evaluator;
    dal_scaled *scaled;
    const double *unit; /* [1 + 2n] of t, q and v */
    dal_batch *batch;   /* NULL: steps are in quad precision */
    dal_run *quad;
    double step;
    bool enforces_D; /* a step ends on D = 0 wherever it begins; its d is D there */
    bool has_energy;
    int n, m, invariants, count;
    double *values, *scales; /* scratch; as of dal_evaluator_scales */
    double *ends;            /* [STEPS*2n] where the last steps in double precision ended */
} dal__local;

/* Makes it for a run of spec on the physical space, in a precision. [alloc]  Errors: as of batches
 * and runs. */
dal_status dal__local_create(dal__local *local, const dal_run_spec *spec, const dal_run *run,
                             dal_precision precision, dal_error *error);
/* Frees what it holds. */
void dal__local_free(dal__local *local);
/* The observables at (q, v), out[count]. */
dal_status dal__local_observe(dal__local *local, double t, const double *x, double *out);
/* Their scales there, out[count]: eps times these is a rounding. */
dal_status dal__local_scales(dal__local *local, double t, const double *x, double *out);
/* What single steps change, from states x[steps*2n] at t[steps]: change[steps*count], steps at most
 * DAL__LOCAL_STEPS.  *made of them, from the first on, have not failed. */
dal_status dal__local_steps(dal__local *local, int steps, const double *t, const double *x,
                            double *change, int *made, dal_error *error);
/* lambda.D at (q, v) for each observable, out[count], 0 for D: the rate at which it changes where D
 * is D[m], to first order.  The system has the callback `constraint`. */
dal_status dal__local_pull(dal__local *local, double t, const double *x, const double *D,
                           double *out);
/* div F = trace F_v at (q, v), by differences; NaN where a callback fails. */
double dal__local_divergence(dal__local *local, double t, const double *x);

#endif
