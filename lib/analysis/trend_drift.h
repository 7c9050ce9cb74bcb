/* trend_drift.h - the drift of a series over its whole length, from the evidence of its noises. */
#ifndef DAL_TREND_DRIFT_H
#define DAL_TREND_DRIFT_H

#include "analysis/trend_evidence.h"

typedef struct dal__interval {
    double low, middle, high;
} dal__interval;

/* The drift over the whole series; between the quantiles (1 -+ level)/2, under all noises or under
 * those alone that say there is no trend. */
dal__interval dal__trend_drift(const dal__evidence *evidence, double level, bool no_trend);

#endif
