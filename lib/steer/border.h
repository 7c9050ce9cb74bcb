/* border.h - the equations of the ends of a motion, as rows of a border. */
#ifndef DAL_STEER_BORDER_H
#define DAL_STEER_BORDER_H

#include "steer/shooting.h"
#include "steer/two_point.h"

/* Of integrals I(q, v) of the lift, which momenta do not move, some are given by both ends: there
 * the end gets slacks along their gradients, and the momenta at the start are orthogonal to them.
 * Some are given by no end: they are 0 at the start, whose momenta may lie along their
 * gradients. */
typedef struct dal__border {
    dal__problem *problem;
    int twice, never;    /* how many */
    double *combination; /* [(twice + never)*integrals] orthonormal rows: of these integrals */
    double *gradient;    /* [2*integrals*2n] at the start, at the end; in units */
    double *constraint;  /* [m + holonomic] D and g at the start */
    double *momentum;    /* [n] of vakonomic motion, at an end */
} dal__border;

/* [alloc] */
dal_status dal__border_open(dal__border *border, const dal__shooting *s);
void dal__border_close(dal__border *border);
/* Rows of the border, and its extra unknowns. */
int dal__border_rows(const dal__border *border);
int dal__border_extra(const dal__border *border);
/* Sets border and right side at points[(pieces + 1)*dimension].  Errors: errors of the
 * callbacks. */
dal_status dal__border_fill(dal__border *border, const double *point, int pieces,
                            dal__two_point *out);
/* Sets the right side alone, at other points. */
dal_status dal__border_right(dal__border *border, const double *point, int pieces,
                             dal__two_point *out);
/* max |distance| of the ends from what is given, in units, with slack[extra]. */
double dal__border_distance(const dal__border *border, const double *point,
                            const dal__two_point *at, const double *slack);

#endif
