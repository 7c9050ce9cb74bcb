/* points.h - formulas of a model at random points of D = 0. */
#ifndef DAL_INVARIANTS_POINTS_H
#define DAL_INVARIANTS_POINTS_H

#include "model/model.h"

/* Where points are drawn: of each symbol that is no parameter, the middle and how far from there;
 * [symbols] both. */
typedef struct dal__region {
    const double *centre, *reach;
} dal__region;

/* Some formulas, and the memory to evaluate them. */
typedef struct dal__points dal__points;

/* Makes points at which output[count] are evaluated; the region outlives them. [alloc]  Errors:
 * DAL_STATUS_MEMORY, DAL_STATUS_TOO_LARGE. */
dal_status dal__points_create(dal__points **points, const dal__equations *e,
                              const dal__region *region, const dal__node *output, int count);
void dal__points_free(dal__points *points);
/* Sets all parameters, and begins a sequence of points. */
void dal__points_begin(dal__points *points, const double *parameter);
/* Draws the next point of D = 0 at which every output is finite: out[count].  They are computed in
 * quad precision and rounded then, so that what cancels is near 1e-34.  Errors:
 * DAL_STATUS_NOT_FINITE where no such point is found. */
dal_status dal__points_next(dal__points *points, double *out);

#endif
