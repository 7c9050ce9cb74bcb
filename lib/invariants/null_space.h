/* null_space.h - the functions whose rate along the motion is 0. */
#ifndef DAL_INVARIANTS_NULL_SPACE_H
#define DAL_INVARIANTS_NULL_SPACE_H

#include "invariants/search.h"

/* Functions at points, one after the other: values and rates [functions*points]. */
typedef struct dal__samples {
    int functions, points;
    double *value, *rate;
} dal__samples;

/* Evaluates all products at points with a set of parameters.  [alloc]  Errors: DAL_STATUS_MEMORY,
 * DAL_STATUS_NOT_FINITE. */
dal_status dal__search_sample(const dal__search *search, const dal__condition *condition,
                              const double *parameter, int points, dal__samples *samples);
void dal__samples_free(dal__samples *samples);

/* The functions for which the condition holds: a basis in reduced echelon form. */
typedef struct dal__null_space {
    int functions;                     /* independent ones on D = 0 */
    int count;                         /* of the basis */
    double *coefficient;               /* [count*products] */
    double least_change, largest_zero; /* as of dal_invariants */
} dal__null_space;

/* Finds it; the samples, of more points than functions, are destroyed.  [alloc]  Errors:
 * DAL_STATUS_MEMORY. */
dal_status dal__find_null_space(const dal__samples *samples, const dal__condition *condition,
                                dal__null_space *out);
void dal__null_space_free(dal__null_space *space);

#endif
