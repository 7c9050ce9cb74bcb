/* shooting.h - pieces of a motion, each from a point of its own, and their exact derivatives. */
#ifndef DAL_STEER_SHOOTING_H
#define DAL_STEER_SHOOTING_H

#include "dalembert_batch.h"
#include "steer/problem.h"

/* A motion in pieces, with points at their ends. */
typedef struct dal__shooting {
    dal__problem *problem;
    double h;
    long long steps; /* of the whole motion */
    int pieces;
    long long *first;   /* [pieces + 1] the step at which each begins */
    dal_batch *plain;   /* [pieces] lanes */
    dal_batch *tangent; /* [unknowns] lanes of the tangent system */
    double *point;      /* [(pieces + 1)*dimension] where pieces begin, and the end */
    double *end;        /* [pieces*dimension] where they end; pi_e there: what they add */
    double *derivative; /* [pieces*unknowns*unknowns] of these ends, in units; row-major */
    double *cost;       /* [pieces*unknowns] of pi_e there */
    double *scratch;
} dal__shooting;

/* Makes one of some steps between from and T, and of at most that number of pieces.  [alloc] */
dal_status dal__shooting_open(dal__shooting *s, dal__problem *p, long long steps, int pieces);
void dal__shooting_close(dal__shooting *s);
/* t of point k. */
double dal__shooting_time(const dal__shooting *s, int k);
/* Finds the ends of all pieces that begin at these points.  Errors: of a step, and what the
 * observer returned, which is called between many steps. */
dal_status dal__shooting_move(dal__shooting *s, const double *point, double *end);
/* By which unknowns ends are differentiated. */
typedef enum dal__columns { DAL__COLUMNS_OF_ALL, DAL__COLUMNS_WITHOUT_P } dal__columns;
/* Finds their derivatives at s->point.  Errors: likewise. */
dal_status dal__shooting_differentiate(dal__shooting *s, dal__columns columns);
/* Jumps in units from ends to points, out[pieces*unknowns], of which count in each are set. */
void dal__shooting_jumps(const dal__shooting *s, const double *point, const double *end, int count,
                         double *out);

#endif
