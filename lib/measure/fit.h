/* fit.h - explanations of a series of block means: trends, tones and walks; internal to verdicts.
 *
 * Times run from 0 to 1 over the series; values are in units of w, the range of x nearby. */
#ifndef DAL_FIT_H
#define DAL_FIT_H

#include "dalembert.h"

typedef struct dal__series {
    int n;
    double t[DAL_BLOCKS];
    double x[DAL_BLOCKS]; /* in units of w */
    double w[DAL_BLOCKS];
    double logs; /* sum log w */
} dal__series;

/* The series of n blocks, at least DAL__FEWEST; no w is less than least_range. */
enum { DAL__FEWEST = 8 };
dal__series dal__series_of(const dal_mean *block, int n, double least_range);

/* The trends: name, how worth is found, form, range of its parameter, points of a grid over it (0:
 * there is none), how many numbers it costs. */
#define DAL__TREND_LIST(X)                                                                         \
    X(NONE, gain, constant, 0.0, 0.0, 0, 0)                                                        \
    X(LINE, gain, line, 0.0, 0.0, 0, 1)                                                            \
    X(BENT, gain, bent, -5.0, 5.0, 10, 2)       /* t + b t^2; 2^parameter is the final slope */    \
    X(POWER, gain, power, -2.0, 6.0, 24, 2)     /* t^parameter */                                  \
    X(GROWTH, gain, growth, 1.5, 6.0, 9, 2)     /* exp(2^parameter t) */                           \
    X(DECAY, gain, decay, 1.5, 8.0, 13, 2)      /* exp(-2^parameter t) */                          \
    X(SLOW, tone_gain, cosine, 0.2, 2.5, 23, 3) /* parameter periods */

typedef enum dal__trend {
#define X(name, worth, form, low, high, points, numbers) DAL__TREND_##name,
    DAL__TREND_LIST(X)
#undef X
        DAL__TRENDS
} dal__trend;

/* An explanation: its criterion (see verdict.c), the parameter of the trend, and the root mean
 * square of what the trend explains, in units of w. */
typedef struct dal__explanation {
    double criterion, parameter, size;
} dal__explanation;

/* A constant, a trend and up to three tones, under noise. */
dal__explanation dal__fit_trend(const dal__series *series, dal__trend trend);
/* A random walk with or without drift, under noise; size is the deviation of one step of the walk,
 * from block to block, in units of x. */
dal__explanation dal__fit_walk(const dal__series *series, int drifts);

/* The criterion of verdict.c for a sum of squares in units of w. */
double dal__criterion(const dal__series *series, double squares, int numbers);

#endif
