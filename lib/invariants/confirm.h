/* confirm.h - formulas tried as invariants: their rates, and their independence. */
#ifndef DAL_INVARIANTS_CONFIRM_H
#define DAL_INVARIANTS_CONFIRM_H

#include "invariants/search.h"

/* A formula, and what is found of it. */
typedef struct dal__candidate {
    dal__node node;
    bool holds;               /* the condition, to the digits of doubles; */
    bool exact;               /* of quad precision; */
    bool at_any_parameters;   /* with other parameters, too */
    bool has_one_sign;        /* positive, or negative, at all points */
    bool is_negative;         /* at the last of them */
    bool independent, is_new; /* as of dal_invariant */
} dal__candidate;

/* Tries formulas at points of D = 0 of their own.  [alloc]  Errors: DAL_STATUS_MEMORY,
 * DAL_STATUS_TOO_LARGE (the graph), DAL_STATUS_NOT_FINITE. */
dal_status dal__confirm(const dal__search *search, const dal__condition *condition,
                        dal__candidate *candidate, int count);
/* The constraint of velocities, from 0, of whose D the derivative of f(q,t) is a multiple, at
 * points about the start; -1: it is one of none.  [alloc]  Errors: DAL_STATUS_MEMORY,
 * DAL_STATUS_TOO_LARGE. */
dal_status dal__find_constraint(const dal__search *search, dal__node f, int *constraint);
/* Finds which of them are functionally independent on D = 0.  [alloc]  Errors: likewise. */
dal_status dal__find_independent(const dal__search *search, dal__candidate *candidate, int count);

#endif
