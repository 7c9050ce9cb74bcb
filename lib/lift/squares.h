/* squares.h - sums of squares. */
#ifndef DAL_LIFT_SQUARES_H
#define DAL_LIFT_SQUARES_H

#include "lift/surface.h"

/* The s_i of f = sum_i c_i s_i^2, whose c_i have one sign at the points: squared[*count], of at
 * most 2*pairs; *count is 0 where f has another form. */
void dal__squared_functions(const dal__surface *surface, dal__node f, dal__node *squared,
                            int *count);

#endif
