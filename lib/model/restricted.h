/* restricted.h - the linear system of accelerations and multipliers where W alone may be singular,
 * as nodes. */
#ifndef DAL_MODEL_RESTRICTED_H
#define DAL_MODEL_RESTRICTED_H

#include "model/elimination.h"

/* The factors of one matrix W; they do not depend on the right-hand side. */
typedef struct dal__restricted {
    const dal__node *W; /* [n*n] */
    dal__node *N, *P;   /* [n*m], [n*n] */
    dal__factors S, V;
    int singular; /* on DAL_STATUS_SINGULAR: the constraint, from 0, that depends on others;
                   * -1: W is singular on ker A */
} dal__restricted;

/* Factors the system with this W [n*n], which must outlive it.  Errors: DAL_STATUS_SINGULAR,
 * DAL_STATUS_TOO_LARGE. */
dal_status dal__restricted_factor(dal_model *model, const dal__node *W, dal__restricted *r);
/* W x - A^T h = top [n], A x = bottom [m]; h is NULL where it is not wanted. */
void dal__restricted_solve(dal_model *model, const dal__restricted *r, const dal__node *top,
                           const dal__node *bottom, dal__node *x, dal__node *h);
/* The x [n*m] of top = 0 and A x = 1: they span the directions of W^-1 A^T. */
void dal__restricted_directions(dal_model *model, const dal__restricted *r, dal__node *x);
/* Replaces the pivots of the equations. */
void dal__restricted_record_pivots(dal__equations *equations, const dal__restricted *r);

/* Whether det W has both signs, or vanishes beyond a jump, at irregular points at distances of 1/16
 * to 2^60 from the default start: then W is singular between them, where the motion may well be
 * determined.  No node is made, so that F does not depend on it. */
bool dal__mass_may_turn_singular(dal_model *model);

#endif
