/* trend_series.h - the blocks of a series in units of its range, and the means of equal bins. */
#ifndef DAL_TREND_SERIES_H
#define DAL_TREND_SERIES_H

#include "dalembert_statistics.h"
#include "statistics/trend_tables.h"
#include <stdbool.h>

enum { DAL__TONES = 3 };

/* The full blocks: x = first + unit * value, unit a power of two near the max deviation. */
typedef struct dal__trend_series {
    int count;
    long long length; /* values in a block */
    double unit;      /* of factor * x */
    double low, high; /* of all values */
    double mean[DAL_STATISTICS_BLOCKS], min[DAL_STATISTICS_BLOCKS], max[DAL_STATISTICS_BLOCKS];
    double own[DAL_STATISTICS_BLOCKS]; /* the deviation within a block from its own line */
    double within;                     /* the root of its mean square */
    double block_range;                /* max - min, in the mean */
    double swing;                      /* the same, less what the trend rises within a block */
    bool is_steady;                    /* it is the same in all blocks */
    double rounding;                   /* of the mean of a block */
    int tones;                         /* taken out of mean */
} dal__trend_series;

typedef struct dal__bins {
    int freedom; /* of the coefficients: less two for each tone */
    double mean[DAL__BINS], wave[DAL__WAVES];
    double range;           /* of the means */
    double half_range;      /* of all values */
    double rounding, error; /* of the means: by roundings; by what is not in the model */
} dal__bins;

/* False where there are too few blocks, or all values are the same. */
bool dal__trend_read(const dal_statistics *statistics, dal__trend_series *series);
/* Takes up to DAL__TONES tones out of the means. */
void dal__trend_remove_tones(dal__trend_series *series);
/* The means over bins of what is given in blocks. */
void dal__trend_fill_bins(const double *block, int count, double *bin /* [DAL__BINS] */);
void dal__trend_bin(const dal__trend_series *series, dal__bins *bins);

#endif
