/* surface.h - the surface of Dirac's constraints: formulas restricted to it, points of it. */
#ifndef DAL_LIFT_SURFACE_H
#define DAL_LIFT_SURFACE_H

#include "core/vectors.h"
#include "lift/theory.h"

enum { DAL__SURFACE_POINTS = 4 };

/* How points of a surface are found. */
typedef enum dal__surface_state {
    DAL__SURFACE_REGULAR,
    DAL__SURFACE_IRREGULAR, /* a gradient vanishes wherever its constraint does */
    DAL__SURFACE_EMPTY      /* no points are found */
} dal__surface_state;

/* Constraints that are linear in a variable with the coefficient 1 or -1 give that variable by the
 * others; the rest is solved at points. */
typedef struct dal__surface {
    const dal__theory *theory;
    dal__pool *pool;
    int solved;            /* variables that are given, */
    int *symbol;           /* [solved] these, */
    dal__node *by;         /* [solved] and what they are */
    int implicit;          /* other constraints, */
    dal__node *constraint; /* [implicit] these */
    double *raw, *point;   /* [DAL__SURFACE_POINTS*symbols] drawn, and moved to the surface */
    dal__random random;
    dal__surface_state state;
} dal__surface;

/* Begins a surface without constraints.  Where memory runs out, here and below, the pool says so;
 * no status does. */
void dal__surface_begin(dal__surface *surface, const dal__theory *theory, dal__pool *pool);
/* Adds a constraint, a restricted node that is not 0 on the surface, and finds points again. */
void dal__surface_add(dal__surface *surface, dal__node constraint);
/* Replaces nodes by what they are on the surface. */
void dal__surface_restrict(const dal__surface *surface, size_t count, dal__node *nodes);
/* Evaluates restricted nodes at the points, out[DAL__SURFACE_POINTS*count]: false, and
 * NaN, where they cannot be, since the graph is full or memory ran out. */
bool dal__surface_values(const dal__surface *surface, int count, const dal__node *nodes,
                         double *out);
/* The least |value| of a node at the points, which are stride numbers apart; 0 where one is not
 * finite. */
double dal__least_size(const double *value, size_t stride);
/* Restricts nodes, and replaces those that vanish at the points, relative to the terms they add up
 * off the surface, by the number 0.  Errors: DAL_STATUS_NOT_FINITE. */
dal_status dal__surface_clean(const dal__surface *surface, int count, dal__node *nodes);

#endif
