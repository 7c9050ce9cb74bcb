/* prediction.h - a prediction while it is made, for the files that make it. */
#ifndef DAL_PREDICTION_H
#define DAL_PREDICTION_H

#include "dalembert_predict.h"
#include "dynamics/displacement.h"
#include "dynamics/local_change.h"
#include "dynamics/orbit.h"
#include "dynamics/reversal.h"

/* Of a step, in units of it; weights are equal. */
static const double dal__gauss_points[] = {0.21132486540518711775, 0.78867513459481288225};
enum { DAL__GAUSS_POINTS = 2, DAL__DIVERGENCES = 256 };

/* A prediction while it is made. */
typedef struct dal__prediction_work {
    dal_prediction *of;
    const dal_predict_observer *observer;
    dal_run_spec spec; /* on the physical space */
    dal_run *run;      /* of spec, at the start */
    dal__local local;
    dal__orbit *orbit;
    dal__reversals *reversals;
    dal__displacement *displacement; /* NULL: it need not be known any more */
    int n, count;
    long long whole, steps; /* of a piece; up to the end of the curve */
    long long pieces, quad_steps;
    double *t, *x, *points; /* of a block: [STEPS], [STEPS*2n], [STEPS*GAUSS*2n] of Gauss points */
    double *local_change;   /* [STEPS*count] */
    bool has_points;        /* lambda is needed */
    long long row, rows;    /* the next row of the curve; all */
    double *total, *rest;   /* [count] sums of a piece, compensated */
    double *half;           /* [count] at the middle of a piece */
    double *pull, *scale;   /* [count] */
    double *increment;      /* [count] of a step of the run */
    double *bins;           /* [count*bin_count] of increments */
    long long bin_count, steps_of_bin;
    double *moments;    /* [count*3] sums of S and S^2 over T, of S^2 over T/2 */
    double *divergence; /* [divergences] of F, at equal distances */
    int divergences;
    long long apart;     /* steps between two of them */
    double reach[2];     /* max |q_i|, |v_i| in units in either half, of what F depends on */
    bool *general;       /* [2n] which these are */
    bool *even, *hidden; /* [count] zero by reversibility; by rounding */
    bool *conserved;     /* [count] by the exact motion */
    dal_error *error;
} dal__prediction_work;

/* Fails where the method or the system cannot be predicted. */
dal_status dal__predict_check_method(const dal__prediction_work *work);
/* Fails because of the method or the motion. */
dal_status dal__predict_refuse(const dal__prediction_work *work, const char *reason);

#endif
