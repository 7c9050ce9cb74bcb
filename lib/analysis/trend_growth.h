/* trend_growth.h - whether the amplitude of an oscillation grows. */
#ifndef DAL_TREND_GROWTH_H
#define DAL_TREND_GROWTH_H

#include "analysis/trend_series.h"

/* What the amplitude of an oscillation does: LARGER by a factor of 2 and more, in no known way.
 * EXPLODES: no oscillation, but values to one side that grow by equal factors in equal times. */
typedef enum dal__growth {
    DAL__STEADY,
    DAL__LARGER,
    DAL__EXPLODES,
    DAL__GROWS,
    DAL__GROWS_FAST
} dal__growth;

dal__growth dal__trend_growth(const dal__trend_series *series);

#endif
