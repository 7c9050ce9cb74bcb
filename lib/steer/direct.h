/* direct.h - a first guess for Newton's method: u constant in pieces, by Gauss-Newton. */
#ifndef DAL_STEER_DIRECT_H
#define DAL_STEER_DIRECT_H

#include "steer/shooting.h"

/* Gauss-Newton iterations on a lifted motion in pieces. */
typedef struct dal__direct {
    dal__shooting *s;
    double damping; /* added to the Gramian, relative to its trace */
    double jump;    /* the largest jump, in units */
    double change;  /* of (q, v) by the last iteration, if it was whole: the largest, in units */
    bool is_stuck;  /* the last iteration found nothing better */
    double *memory;
    double *control;     /* [pieces*n*n] pi by u, in units: pi = control u, |u|^2/2 the cost */
    double *jumps;       /* [pieces*unknowns] */
    double *costate;     /* [(pieces + 1)*2n] multipliers of the jumps, in units: p, pi */
    double *change_x;    /* [(pieces + 1)*2n] */
    double *change_pi;   /* [pieces*n] */
    double *gramian;     /* [2n*2n], and scratch */
    double *point, *end; /* tried ones */
} dal__direct;

/* Begins at the points of s, of which p is set to 0.  [alloc] */
dal_status dal__direct_open(dal__direct *d, dal__shooting *s);
void dal__direct_close(dal__direct *d);
/* One iteration.  Errors: of the observer, of a step at the points as they are. */
dal_status dal__direct_iterate(dal__direct *d);
/* Copies the points, with the multipliers for momenta, to out[(pieces + 1)*dimension]. */
void dal__direct_extremal(const dal__direct *d, double *out);

#endif
