/* vakonomic.h - L and the momenta of vakonomic motion, whose ends are in q alone. */
#ifndef DAL_STEER_VAKONOMIC_H
#define DAL_STEER_VAKONOMIC_H

#include "steer/problem.h"

/* Makes the nodes; nothing for other motion.  [alloc]  Errors: DAL_STATUS_MEMORY. */
dal_status dal__vakonomic_open(dal__problem *p);
void dal__vakonomic_close(dal__problem *p);
/* Momenta L_v - g.A at a point by units of q: out[n].  Errors: DAL_STATUS_MEMORY. */
dal_status dal__vakonomic_momenta(dal__problem *p, double t, const double *z, double *out);
/* Their derivatives by q, v, g in units: out[n*unknowns].  Errors: DAL_STATUS_MEMORY. */
dal_status dal__vakonomic_gradients(dal__problem *p, double t, const double *z, double *out);
/* Adds int L dt along the next step of p->run.  Errors: of a step. */
dal_status dal__vakonomic_add_action(dal__problem *p, double *sum);

#endif
