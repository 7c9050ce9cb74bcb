/* trend_change.h - the line after a change, and the bend of a whole series. */
#ifndef DAL_TREND_CHANGE_H
#define DAL_TREND_CHANGE_H

#include "statistics/trend_evidence.h"

typedef enum dal__change_result {
    DAL__CHANGE_UNCLEAR,
    DAL__CHANGE_TO_LEVEL,
    DAL__CHANGE_BESIDE_LINE
} dal__change_result;

typedef struct dal__change {
    dal__change_result result;
    bool is_sure;       /* of a level: the interval admits next to no drift after the change */
    dal__interval rate; /* after the change, over the time of the whole series */
} dal__change;

/* What follows the likeliest change of a series, whose bins may be without its tones. */
dal__change dal__trend_change(const dal__trend_series *series, const dal__bins *bins,
                              const dal__evidence *evidence);

/* By how much the slope of a parabola through the bins is larger at the end than at the beginning,
 * with its 95 % interval. */
dal__interval dal__trend_bend(const dal__bins *bins);
/* The slope of the second half, over the time of the whole series, with its 95 % interval. */
dal__interval dal__trend_second_half(const dal__bins *bins);

#endif
