/* fields.h - fields of vectors on q, on (t, q), or on states, and their brackets. */
#ifndef DAL_GEOMETRY_FIELDS_H
#define DAL_GEOMETRY_FIELDS_H

#include "model/model.h"

enum { DAL__GENERIC_POINTS = 3 };
/* Components of fields below this are rounding; every X_i has a component 1 in the units given. */
#define DAL__FIELD_ROUNDING 1e-9

/* The span of fields, with its ranks at generic points. */
typedef struct dal__fields {
    dal_model *model;
    int row, rows;      /* the first of D that restrict it, and how many */
    int dim, fixed;     /* coordinates: of q, or of t and q; fixed: 1 where the first one is t;
                           with a drift of q and v, or of t, q and v */
    int full;           /* the largest rank that there can be */
    const int *symbol;  /* [dim] of them */
    const double *unit; /* [dim] of them */
    int *pivot;         /* [2*dim] with a drift: fields that are independent at the first point, and
                           their components that are 1; else NULL */
    dal__node *field;   /* [(DAL__GENERIC_POINTS*dim + 2)*dim] the fields so far, [dim] each */
    double *weight;     /* [DAL__GENERIC_POINTS*dim + 2] by which they are multiplied */
    int fields, first;  /* how many; how many of them are X_i, or the drift and N_k */
    double *point;      /* [DAL__GENERIC_POINTS*symbols] */
    int points;
    double *basis; /* [DAL__GENERIC_POINTS*dim*dim] orthonormal, of the fields at each point */
    int rank[DAL__GENERIC_POINTS];
    double work;
} dal__fields;

/* Allocates for as many fields on up to dim coordinates as points can need; and value[symbols].
 * Errors: DAL_STATUS_MEMORY, DAL_STATUS_NAME, DAL_STATUS_NOT_FINITE (parameters). */
dal_status dal__fields_allocate(dal__fields *d, size_t dim, const dal_setting *parameters,
                                int parameter_count, double **value, dal_error *error);
/* Moves count numbers of a point irregularly about where they are, by the try-th of many ways. */
void dal__displace_point(double *x, int from, int count, const double *unit, int way);
/* Adds the field after the others where it is independent of them at a point; x[dim] is scratch. */
void dal__fields_add(dal__fields *d, double weight, double *x);
/* The largest of its ranks. */
int dal__fields_rank(const dal__fields *d);
/* Adds the brackets of the X_i with the fields from begin on; false: formulas have become too
 * large. */
bool dal__fields_bracket(dal__fields *d, int begin, double *x);

#endif
