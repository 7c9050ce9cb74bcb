/* root.h - roots of a function of one variable. */
#ifndef DAL_CORE_ROOT_H
#define DAL_CORE_ROOT_H

#include "dalembert_status.h"

/* A function and its value at s. */
typedef dal_status dal__function(void *user, double s, double *value);
typedef struct dal__value_at {
    double s, f;
} dal__value_at;

/* A root to the resolution of s, or where the value is 0; and the place on its other side: where
 * the function jumps, neither value is small. */
typedef struct dal__root {
    dal__value_at best, other;
} dal__root;

/* Finds the root between a and b, at which the values have different signs.  Errors: as for the
 * function. */
dal_status dal__find_root(dal__function *function, void *user, dal__value_at a, dal__value_at b,
                          dal__root *root);

#endif
