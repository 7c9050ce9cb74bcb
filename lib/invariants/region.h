/* region.h - about the start of a motion, in its own units. */
#ifndef DAL_INVARIANTS_REGION_H
#define DAL_INVARIANTS_REGION_H

#include "dalembert_evaluator.h"
#include "model/equations.h"

/* The start of spec, whose system has the equations e, as values of all symbols, centre[symbols],
 * parameters included; and distance units of the motion there, reach[symbols].  [alloc]  Errors:
 * errors of the parameters and of the start. */
dal_status dal__region_find(const dal__equations *e, const dal_run_spec *spec, double distance,
                            double *centre, double *reach, dal_error *error);

#endif
