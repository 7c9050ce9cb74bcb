/* trend_evidence.h - how well each shape and each noise explains the means of bins. */
#ifndef DAL_TREND_EVIDENCE_H
#define DAL_TREND_EVIDENCE_H

#include "statistics/trend_series.h"

typedef struct dal__evidence {
    double log_total;
    double meaning[DAL__MEANINGS];        /* posterior, adding up to 1 */
    double shape[DAL__SHAPES];            /* posterior */
    double pair[DAL__PAIRS];              /* posterior of two shapes */
    double power_rest[DAL__POWER_SHAPES]; /* S of the powers under white noise */
    /* The straight line under each noise: drift over the whole series, its deviation, weight. */
    double drift[DAL__SHAPE_NOISES], drift_deviation[DAL__SHAPE_NOISES];
    double drift_weight[DAL__SHAPE_NOISES];
    int freedom;
    double walk_over_memory; /* log of the evidence of walks over noise with memory T/9 */
} dal__evidence;

/* How many times likelier than usual the noise is white: for the trend, for the rate of a line. */
typedef struct dal__white_odds {
    double trend, rate;
} dal__white_odds;

void dal__trend_weigh(const dal__bins *bins, dal__white_odds odds, dal__evidence *evidence);

typedef struct dal__interval {
    double low, middle, high;
} dal__interval;

typedef enum dal__noises { DAL__NOISES_WITHOUT_TREND, DAL__ALL_NOISES } dal__noises;

/* The drift over the whole series, between the quantiles (1 -+ level)/2, under these noises. */
dal__interval dal__trend_drift(const dal__evidence *evidence, double level, dal__noises noises);

#endif
