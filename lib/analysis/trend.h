/* trend.h - what the parts of the classification of a series share.
 *
 *     dal_statistics
 *       -> dal__trend_series   means of blocks in units of the range; tones taken out of them
 *       -> dal__bins           means of equal bins, their cosine coefficients
 *       -> dal__evidence       how well each shape and each noise explains them
 *       -> dal__interval       the rate, from the same evidence
 *       -> dal_trend           the decision */
#ifndef DAL_TREND_INTERNAL_H
#define DAL_TREND_INTERNAL_H

#include "analysis/statistics.h"
#include "analysis/trend_tables.h"

enum { DAL__TONES = 3 };

/* The full blocks: x = first + unit * value, unit a power of two near the greatest deviation. */
typedef struct dal__trend_series {
    int count;
    long long length; /* values in a block */
    double unit;      /* of factor * x */
    double low, high; /* of all values */
    double mean[DAL_STATISTICS_BLOCKS], min[DAL_STATISTICS_BLOCKS], max[DAL_STATISTICS_BLOCKS];
    double block_range; /* max - min, in the mean */
    double swing;       /* the same, less what the trend rises within a block */
    bool is_steady;     /* it is the same in all blocks */
    double rounding;    /* of the mean of a block */
    int tones;          /* taken out of mean */
} dal__trend_series;

typedef struct dal__bins {
    int freedom; /* of the coefficients: less two for each tone */
    double mean[DAL__BINS], wave[DAL__WAVES];
    double range;           /* of the means */
    double half_range;      /* of all values */
    double rounding, error; /* of the means: by roundings; by what is not in the model */
} dal__bins;

typedef struct dal__evidence {
    double log_total;
    double meaning[DAL__MEANINGS];        /* posterior, adding up to 1 */
    double shape[DAL__SHAPES];            /* posterior */
    double power_rest[DAL__POWER_SHAPES]; /* S of the powers under white noise */
    /* The straight line under each noise: drift over the whole series, its deviation, weight. */
    double drift[DAL__SHAPE_NOISES], drift_deviation[DAL__SHAPE_NOISES];
    double drift_weight[DAL__SHAPE_NOISES];
    int freedom;
    double walk_over_memory; /* log of the evidence of walks over that of noise with memory T/9 */
} dal__evidence;

typedef struct dal__interval {
    double low, middle, high;
} dal__interval;

/* What the amplitude of an oscillation does: LARGER by a factor of 2 and more, in no known way.
 * EXPLODES: no oscillation, but values to one side that grow by equal factors in equal times. */
typedef enum dal__growth {
    DAL__STEADY,
    DAL__LARGER,
    DAL__EXPLODES,
    DAL__GROWS,
    DAL__GROWS_FAST
} dal__growth;

/* False where there are too few blocks, or all values are the same. */
bool dal__trend_read(const dal_statistics *statistics, dal__trend_series *series);
/* Takes up to DAL__TONES tones out of the means. */
void dal__trend_remove_tones(dal__trend_series *series);
void dal__trend_bin(const dal__trend_series *series, dal__bins *bins);

/* white_odds: how many times likelier than usual the noise is white. */
void dal__trend_weigh(const dal__bins *bins, double white_odds, dal__evidence *evidence);

/* The drift over the whole series; between the quantiles (1 -+ level)/2, under all noises or under
 * those alone that say there is no trend. */
dal__interval dal__trend_drift(const dal__evidence *evidence, double level, bool no_trend);

dal__growth dal__trend_growth(const dal__trend_series *series);

dal_size_class dal__trend_size(const dal_statistics *statistics, double scale,
                               const dal_trend *trend);

/* By least squares, where there are too few blocks for evidence. */
void dal__trend_line(const dal_statistics *statistics, dal_trend *trend);
/* Half the range of x about the line of trend->rate. */
double dal__trend_amplitude(const dal_statistics *statistics, double rate);

#endif
