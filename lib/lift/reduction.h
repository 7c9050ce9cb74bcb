/* reduction.h - linear equations on the surface of Dirac's constraints, with nodes as entries. */
#ifndef DAL_LIFT_REDUCTION_H
#define DAL_LIFT_REDUCTION_H

#include "lift/surface.h"

/* Rows of equations sum_j entry[row][j] x_j + entry[row][columns + k] = 0, k a right side. */
typedef struct dal__reduction {
    int rows, columns, width; /* width: columns and right sides */
    dal__node *entry;         /* [rows*width] */
    int *pivot;               /* [rows] the unknown that a row gives; -1: none */
    int *row;                 /* [columns] the row that gives an unknown; -1: it is free */
} dal__reduction;

/* Memory for equations, each entry 0. */
void dal__reduction_begin(dal__reduction *r, const dal__surface *surface, int rows, int columns,
                          int rights);
/* Brings the equations to reduced echelon form, row by row: the unknown of each pivot is in no
 * other row.  A row without a pivot has 0s, and right sides that must vanish.  Errors: as of
 * dal__surface_clean. */
dal_status dal__reduction_solve(dal__reduction *r, const dal__surface *surface);
/* An unknown as the equations give it, right side k, free unknowns being these nodes. */
dal__node dal__reduction_value(const dal__reduction *r, dal__graph *graph, int unknown, int k,
                               const dal__node *free_unknown);

#endif
