/* quad.h - a run in quad precision, behind a run in double. */
#ifndef DAL_RUN_QUAD_H
#define DAL_RUN_QUAD_H

#include "run/run.h"

/* Whether a run can be in quad precision.  Errors: DAL_UNSUPPORTED. */
dal_status dal__quad_check(const dal__layout *layout, dal_error *error);

/* Bytes for its engine, aligned to 64; doubles per number. */
size_t dal__quad_bytes(const dal__layout *layout);
size_t dal__quad_width(void);
void dal__quad_place(dal_run *run, char *memory);
/* Copies number i of the persistent state from the run in double. */
void dal__quad_set(dal_run *run, size_t i);
/* Copies persistent state and parameters from the run in double, those before number `first`
 * excepted (push), or to it, rounded (pull). */
void dal__quad_push(dal_run *run, size_t first);
void dal__quad_pull(dal_run *run);
/* Completes work from the parameters. */
dal_status dal__quad_prepare(dal_run *run);
void dal__quad_hold(dal_run *run, const double *point);
dal_status dal__quad_step(dal_run *run, double h);
dal_status dal__quad_step_part(dal_run *run, double h, double part);
/* As dal_run_observe. */
dal_status dal__quad_observe(dal_run *run, double *out);
/* Number i of stored quad numbers, rounded. */
double dal__quad_rounded(const double *stored, size_t i);

#endif
