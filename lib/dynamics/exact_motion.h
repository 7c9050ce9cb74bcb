/* exact_motion.h - the exact motion by polynomials, for predictions that share it. */
#ifndef DAL_EXACT_MOTION_H
#define DAL_EXACT_MOTION_H

#include "dalembert_predict.h"

/* A run of spec on the physical space, where (q, v) have the bits of the run of spec, at its start,
 * and the spec *own of that.  *on_D: p and pi are 0. [alloc]  Errors: as of runs. */
dal_status dal__create_physical(const dal_run_spec *spec, dal_run_spec *own, dal_run **run,
                                bool *on_D, dal_error *error);
/* Makes the exact motion from the state of a run of spec on the physical space; it has no
 * polynomials where F has no Taylor series.  limit: how many numbers it keeps; 0: what is before
 * the time it is read at is dropped. [alloc]  Errors: as of runs. */
dal_status dal__exact_motion_of_run(dal_exact_motion **motion, const dal_run_spec *spec,
                                    const dal_run *run, size_t limit, dal_error *error);
/* Another one, which keeps nothing, from the end of this one on. [alloc]  Errors: as of runs. */
dal_status dal__exact_motion_continue(const dal_exact_motion *from, dal_exact_motion **motion,
                                      dal_error *error);
/* Whether it has polynomials. */
bool dal__exact_motion_has_series(const dal_exact_motion *motion);
/* Whether it begins where a run does, with its parameters, in the direction of its steps. */
bool dal__exact_motion_begins(const dal_exact_motion *motion, const dal_run *run);
/* Extends it to a time since the start, without sign, unless it keeps no more before that; what is
 * before `from` may be dropped.  Where it is that far already, it is not changed.
 * Errors: as of a step. */
dal_status dal__exact_motion_reach(dal_exact_motion *motion, double from, double time,
                                   dal_error *error);
/* Whether it keeps no more, and so ends before such a time. */
bool dal__exact_motion_ends_before(const dal_exact_motion *motion, double time);
/* (q, v) at a time that it has reached, out[2n]. */
void dal__exact_motion_state(const dal_exact_motion *motion, double time, double *out);

#endif
