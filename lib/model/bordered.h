/* bordered.h - the linear system of accelerations and multipliers, as nodes. */
#ifndef DAL_MODEL_BORDERED_H
#define DAL_MODEL_BORDERED_H

#include "model/elimination.h"

/* A way to solve it, of flags: SOLVED, with all constraints solved for a coordinate first that can
 * be; PAIRED, with constraints paired; COLLECTED, with the sums of the reduced equations in few
 * operations; FORWARD, the sums of the elimination, too; WHOLE, by the factors of the bordered
 * matrix, sparse where W^-1 is not. */
enum { DAL__SOLVED = 1, DAL__PAIRED = 2, DAL__COLLECTED = 4, DAL__FORWARD = 8, DAL__WHOLE = 16 };

/* The system of one model, solved as far as that does not depend on the right-hand side. */
typedef struct dal__bordered dal__bordered;

/* Factors the system in one way; mass: the factors of W.  singular: on DAL_STATUS_SINGULAR the
 * constraint, from 0, that depends on others, or -1.  Errors: DAL_STATUS_SINGULAR,
 * DAL_STATUS_TOO_LARGE. */
dal_status dal__bordered_factor(dal_model *model, const dal__factors *mass, unsigned way,
                                dal__bordered **bordered, int *singular);
/* Whether any constraint is solved for a coordinate first. */
bool dal__bordered_is_reduced(const dal__bordered *bordered);
/* Whether all are: their coefficients of these coordinates are a diagonal of constants, so that the
 * rank of A cannot fall. */
bool dal__bordered_keeps_rank(const dal__bordered *bordered);
/* Replaces the pivots of the equations by the pivots of W and of this system. */
void dal__bordered_record_pivots(dal__equations *equations, const dal__bordered *bordered,
                                 const dal__factors *mass);
/* W x - B^T h = top [n], A x = bottom [m]; h is NULL where it is not wanted.  Sums are
 * collected as far as its way says. */
void dal__bordered_solve(dal_model *model, dal__bordered *bordered, dal__sum_form sums,
                         const dal__node *top, const dal__node *bottom, dal__node *x, dal__node *h);

#endif
