/* elimination.h - linear systems of nodes. */
#ifndef DAL_MODEL_ELIMINATION_H
#define DAL_MODEL_ELIMINATION_H

#include "expr/graph.h"

/* A linear system of nodes, matrix x = rhs.  Rows and columns from border on belong to
 * constraints (from 1), those before to the mass matrix. */
typedef struct dal__linear {
    int n, columns, border;
    dal__node *matrix; /* [n*n], destroyed */
    dal__node *rhs;    /* [n*columns], destroyed */
    dal__node *x;      /* [n*columns], the solution */
    int singular;      /* on DAL_SINGULAR: the row without a pivot */
    bool positive;     /* the matrix, being symmetric, is positive definite at the default start */
} dal__linear;

/* Solves by elimination and appends the pivots to the equations.
 * Errors: DAL_MEMORY, DAL_SINGULAR, DAL_TOO_LARGE (more than 256 unknowns, too many of
 * them coupled). */
dal_status dal__linear_solve(dal_model *model, dal__linear *linear);

#endif
