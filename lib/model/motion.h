/* motion.h - accelerations and multipliers of the Lagrange-d'Alembert equations, as nodes. */
#ifndef DAL_MODEL_MOTION_H
#define DAL_MODEL_MOTION_H

#include "model/elimination.h"
#include "model/equations.h"

/* Derives U, R, a, h and F from W, b, A, B and c.  Errors: DAL_STATUS_RANK,
 * DAL_STATUS_SINGULAR_MASS, DAL_STATUS_TOO_LARGE. */
dal_status dal__motion_derive(dal_model *model, dal_error *error);

/* The first part of it: mass, the factors of W, a = W^-1 b, and U = W^-1 A^T, R = W^-1 B^T, which
 * remain 0s where they have many more entries than A and W does not depend on v.  Errors:
 * as of dal__factor. */
dal_status dal__solve_mass(dal_model *model);
/* After dal__motion_derive: W^-1 force [n]; where W is restricted to ker A, the x of ker A with
 * W x - A^T h = force for some h. */
void dal__solve_force(dal_model *model, const dal__node *force, dal__node *x);
/* W(q,u)^-1 A^T [n*m], u being the symbols of pi. */
void dal__solve_mass_at_pi(dal_model *model, dal__node *U);

/* matrix x = rhs for one right-hand side, without a record of the pivots.  Errors: those above. */
dal_status dal__solve_vector(dal_model *model, int n, const dal__node *matrix, const dal__node *rhs,
                             dal__node *x);

/* Whether the two below apply: to what dal__motion_derive has derived by Chetaev's rule. */
bool dal__motion_is_symmetric(const dal__equations *e);
/* F_q [n*n] and F_v [n*n], row by row.  False where they are full and large, since constraints or
 * masses couple many coordinates. */
bool dal__motion_jacobian(dal_model *model, dal__node *by_q, dal__node *by_v);
/* F_q^T pi [n] and F_v^T pi [n]. */
void dal__motion_adjoint(dal_model *model, dal__node *by_q, dal__node *by_v);

/* K pi, (pi.K pi)_q/2 and (pi.K pi)_v/2 [3n] of an effort, which is not the mass's where
 * W may be singular. */
void dal__motion_effort(dal_model *model, dal_effort effort, dal__node *out);

/* x [n] with W x = A^T l for some l and A x = -D: what brings v to D = 0 to first order.  Errors:
 * as of dal__factor. */
dal_status dal__motion_correct(dal_model *model, dal__node *x);

/* y [n], l [m] of DAL_EVAL_ENFORCEMENT, where W y = beta b + B^T l and A y = A pi + c; the symbols
 * from e->pi on are pi [n], c [m] and beta.  Errors: as of dal__factor (vakonomic motion
 * alone). */
dal_status dal__motion_enforce(dal_model *model, dal__node *out);
/* y [n] of DAL_EVAL_REACTION, where W y = beta b + B^T l; the symbols from e->pi on are l [m] and
 * beta. */
void dal__motion_react(dal_model *model, dal__node *y);

/* y [n], l [holonomic] of DAL_EVAL_POSITION, where W y = G^T l and G y = c with the rows G = g_q of
 * A alone; the last of the symbols l of DAL_EVAL_REACTION are c.  Errors: as of
 * dal__factor. */
dal_status dal__motion_place(dal_model *model, dal__node *out);

/* The error of a mass matrix, or of constraints, without a pivot in this row (from 0). */
dal_status dal__singular_mass(const dal_model *model, int row, dal_error *error);
dal_status dal__dependent_constraints(dal_model *model, int row, dal_error *error);

#endif
