/* derivatives.h - the derivatives of a callback by all of its arguments. */
#ifndef DAL_DERIVATIVES_H
#define DAL_DERIVATIVES_H

#include "dalembert_evaluator.h"

/* The derivatives by (q, v, g), differences[rows * (n + nw)], of the first rows values of a
 * callback at a point. [alloc] */
dal_status dal__gradients(dal_evaluator *evaluator, dal_callback *callback, int rows,
                          const dal_point *at, double *differences);

#endif
