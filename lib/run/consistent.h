/* consistent.h - coordinates on g = 0, velocities on D = 0, and the independence of the constraints
 * there. */
#ifndef DAL_RUN_CONSISTENT_H
#define DAL_RUN_CONSISTENT_H

#include "core/constraint_rows.h"
#include "run/run.h"

/* An equation normal.v = value for the velocities, beside D = 0. */
typedef struct dal__condition {
    const double *normal, *lifted; /* [n]: the normal, and W^-1 times it */
    double value;
} dal__condition;

/* A state, and its constraints linearised in the velocities, D + A (v' - v), with a condition as
 * the last row where there is one; or g + g_q (q' - q).  The numbers lie in run->matrices. */
typedef struct dal__linearised {
    dal__constraint_rows c;          /* and a row of the condition after the constraints */
    double *v;                       /* [n] velocities of the state; or q */
    const dal__condition *condition; /* or NULL */
    const char *place;               /* the state in messages: "the start" */
    double *G, *x;                   /* [rows*rows], [rows] */
    double *given;                   /* [n] */
    double *unit;                    /* [n] see dal__velocity_units */
} dal__linearised;

/* The memory of these numbers: scratch where it is large enough, or allocated until it is released,
 * which has no effect where it is not.  Errors: DAL_STATUS_MEMORY. */
#ifdef DAL_MINIMAL
#define dal__reserve_matrices(run, error) DAL_STATUS_OK
#define dal__release_matrices(run)        ((void)0)
#else
dal_status dal__reserve_matrices(dal_run *run, dal_error *error);
void dal__release_matrices(dal_run *run);
#endif

/* The present state of a run, its constraints not yet evaluated. */
dal__linearised dal__linearised_of(dal_run *run, const dal__condition *condition,
                                   const char *place);

/* The same of g(q,t) = 0. */
dal__linearised dal__linearised_coordinates(dal_run *run, const char *place);

/* Evaluates D, A and B at the state, with W at the velocities u; NULL: at its own.  Errors: as
 * of the constraints. */
dal_status dal__linearise(dal__linearised *k, const double *u, dal_error *error);

/* The error of a mass matrix that is singular at the point; DAL_STATUS_OK: it is not, or is not
 * known. */
dal_status dal__check_mass(const dal__linearised *k, dal_error *error);
/* Stores in x[rows] the sizes of the constraints, S(D_a) + sqrt(A_a W^-1 A_a^T v.W v): the terms of
 * D_a, scales[m] (NULL: not known), and what velocities of the same energy add to it at most; where
 * v.W v is not known, sum |A_ai| max |v_i|.  Of g_j: its terms; where not known, sum |g_q| max |q|.
 */
void dal__constraint_sizes(dal__linearised *k, const double *scales);

/* Whether the rows are independent: no pivot of G = A B is below 1e-12 of its diagonal entry,
 * without exchanges of rows.  Errors: DAL_STATUS_RANK, DAL_STATUS_SINGULAR_MASS. */
dal_status dal__linearised_check_rank(dal__linearised *k, dal_error *error);

/* Replaces the velocities u of the state by those, v, on D(q,v,t) = 0 and the condition for which
 * (v - u).W(q,u) (v - u) is stationary: in one step where D is linear; or the coordinates by
 * those on g = 0.  Errors, and then v is not
 * defined: DAL_STATUS_RANK, DAL_STATUS_SINGULAR_MASS, DAL_STATUS_INCONSISTENT (no such v is found
 * near u), DAL_STATUS_UNSUPPORTED (W has no inverse), as of the constraints. */
dal_status dal__make_consistent(dal__linearised *k, dal_error *error);

#endif
