/* trend_amplitude.h - whether the amplitude of a series grows. */
#ifndef DAL_TREND_AMPLITUDE_H
#define DAL_TREND_AMPLITUDE_H

#include "statistics/trend_series.h"

typedef struct dal__amplitude_growth {
    double probability; /* that the amplitude grows, by a power of t or exponentially */
    double exponential; /* of this, the share of exponentials */
    double rise;        /* of the logarithm of the amplitude, from the first to the last eighth */
} dal__amplitude_growth;

/* Of a series with its tones. */
dal__amplitude_growth dal__trend_growth(const dal__trend_series *series);

#endif
