/* evaluator.h - the inside of an evaluator, for functions that evaluate a system by themselves. */
#ifndef DAL_ANALYSIS_EVALUATOR_H
#define DAL_ANALYSIS_EVALUATOR_H

#include "dalembert_evaluator.h"

/* The workspace of an evaluator, [workspace], with its parameters. */
double *dal__evaluator_work(dal_evaluator *evaluator);
/* pi.K pi of the effort; vector[3n] is scratch.  Errors: errors of the callback. */
dal_status dal__evaluator_square(dal_evaluator *evaluator, double t, const double *q,
                                 const double *v, const double *pi, double *vector, double *out);

#endif
