/* dirac.h - Dirac's algebra with constraints of any choice. */
#ifndef DAL_DIRAC_H
#define DAL_DIRAC_H

#include "dalembert_order.h"

/* Dirac's algebra with any 4n+1 functions phi(user, z, a) on 6n+2 as constraints, the first 2n+1
 * the primary ones; user is the dal__dirac_space.  dal_evaluator_check_dirac takes the theory's
 * functions, and a test takes a wrong one. */
typedef struct dal__dirac_space {
    dal_evaluator *evaluator;
    int n;
    double t;
    double (*phi)(void *user, const double *z, int a);
    int a;         /* the constraint to be differentiated */
    double *field; /* [3n] F, or K pi and its derivatives */
} dal__dirac_space;
double dal__dirac_constraint(void *user, const double *z, int a);
dal_status dal__dirac_algebra(dal_evaluator *evaluator, const dal_point *at, double e,
                              double (*phi)(void *user, const double *z, int a), dal_dirac *out);

#endif
