/* differences.h - derivatives by central differences of order 8. */
#ifndef DAL_DIFFERENCES_H
#define DAL_DIFFERENCES_H

#include "dalembert_evaluator.h"

/* The increment to begin with, relative to the scale of a quantity: the error of order 8 at a
 * function whose nearest singularity is 0.3 away, 576 (2e-3/0.3)^8 / 0.3 = 7e-15, stays below the
 * rounding 2.2e-16/2e-3 = 1e-13.  The scale of a coordinate is 1, or the way h |v| of a step, never
 * |q|, which only says how far it has travelled; the scale of velocities, multipliers and momenta
 * is their own size. */
#define DAL__INCREMENT 2e-3

/* A curve x(s) in count numbers, and its derivative at s = 0:
 *     x' = sum_(k=1..4) c_k (x(k d) - x(-k d)) / d,   c = 4/5, -1/5, 4/105, -1/280.
 * d is shortened where order 6, from the same values, does not agree, or where the curve has no
 * value. scratch[3*count].  Errors: as for the curve, when it has no values for any d. */
typedef dal_status dal__vector_function(void *user, double s, double *out);
dal_status dal__differentiate(dal__vector_function *curve, void *user, double d, int count,
                              double *scratch, double *out);

/* The derivative of values by *x, which is varied in place. */
typedef dal_status dal__values(void *user, double *out);
dal_status dal__differentiate_by(double *x, dal__values *values, void *user, double d, int count,
                                 double *scratch, double *out);

/* One value of a callback, whose rate along the motion dal__rate_in_units finds as
 * dal_evaluator_measure_rate does, by increments of the time and to rounding of the size, not of
 * 1. */
typedef struct dal__rate {
    dal_evaluator *evaluator;
    dal_callback *callback;
    int count, index; /* of the values, of this one */
    double time;      /* a positive one, in which the motion changes */
    double size;      /* of the value along the motion so far, 0 or more */
} dal__rate;
/* [alloc]  Errors: from the callbacks, DAL_STATUS_NOT_FINITE, DAL_STATUS_MEMORY. */
dal_status dal__rate_in_units(const dal__rate *of, const dal_point *at, double *rate);

#endif
