/* elimination.h - linear systems of nodes. */
#ifndef DAL_MODEL_ELIMINATION_H
#define DAL_MODEL_ELIMINATION_H

#include "dalembert_model.h"
#include "model/equations.h"

/* A matrix of nodes and, after dal__factor, its triangular factors.  All lies in the model's
 * memory. */
typedef struct dal__factors {
    int n;
    dal__node *matrix;     /* [n*n]; factored in place */
    const int *constraint; /* [n]: whose row and column it is, from 1; 0: of the mass matrix */
    int saddle;            /* rows from here on border a positive definite matrix; 0: none do */
    int singular;          /* on DAL_STATUS_SINGULAR: the row without a pivot */
    bool positive;         /* the matrix, being symmetric, is positive definite at the start */
    dal__node *given;      /* [n*n] the matrix as it was */
    int *row, *column;     /* [n] of the pivots, in their order */
    int *first, *other;    /* the entries left and right of each pivot, see list_entries */
} dal__factors;

/* Sets up to be factored a matrix of n rows that belong to the mass matrix (NULL) or to these
 * constraints; its nodes are 0. */
void dal__factors_allocate(dal_model *model, dal__factors *factors, int n, const int *constraints);
/* Factors the matrix.  Errors: DAL_STATUS_SINGULAR, DAL_STATUS_TOO_LARGE (too many unknowns are
 * coupled, directly or by the elimination). */
dal_status dal__factor(dal_model *model, dal__factors *factors);
/* Appends the pivots to the equations' own; divides: a set of DAL__DIVIDES_... */
void dal__record_pivots(dal__equations *equations, const dal__factors *factors, unsigned divides);
/* The pivots [n]; their product is the determinant, except for its sign. */
void dal__list_pivots(const dal__factors *factors, dal__node *pivot);
/* How sums are written: as they arise, or in few operations (collect.h). */
typedef enum dal__sum_form { DAL__SUMS_UNCHANGED, DAL__SUMS_COLLECTED } dal__sum_form;
/* Solves for right-hand sides [columns*n], one after the other, into x[columns*n]. */
void dal__factors_solve(dal_model *model, const dal__factors *factors, dal__sum_form sums,
                        int columns, const dal__node *rhs, dal__node *x);

#endif
