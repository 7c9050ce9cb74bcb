/* irregular.h - constraints whose gradient vanishes wherever they do. */
#ifndef DAL_LIFT_IRREGULAR_H
#define DAL_LIFT_IRREGULAR_H

#include "lift/surface.h"

/* The regular functions that vanish where f does, if f is a semidefinite quadratic form in momenta
 * or a sum of squares with coefficients of one sign: regular[*count], of at most 2*pairs; *count is
 * 0 where it is neither. */
void dal__regular_functions(const dal__surface *surface, dal__node f, dal__node *regular,
                            int *count);

#endif
