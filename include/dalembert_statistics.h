/* dalembert_statistics.h - statistics of a quantity along a run: sizes and trends.
 *
 * The conventions of dalembert.h hold here. */
#ifndef DALEMBERT_STATISTICS_H
#define DALEMBERT_STATISTICS_H

#include "dalembert_run.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- statistics of a quantity along a run -------------------------------------------------- */

enum { DAL_STATISTICS_BLOCKS = 64 /* max blocks of values */ };
enum { DAL_PARTIAL_SUMS = 8 /* sums that a block is added up in */ };

/* The version of dal_statistics: it changes whenever the members or their meaning do, and is saved
 * with them in files.  Each member has 64 bits and none is a pointer. */
enum { DAL_STATISTICS_LAYOUT = 4 };

/* A block of successive values of x. */
typedef struct dal_statistics_block {
    double t;        /* the middle of its times */
    double x;        /* the mean */
    double rms;      /* the root mean square of x less the mean */
    double min, max; /* the extreme values */
} dal_statistics_block;

/* The statistics of one quantity x over any number of values, in constant memory.  They are plain
 * numbers and may be copied and saved.  block[] holds the means of length values each. */
typedef struct dal_statistics {
    long long count;      /* finite values so far */
    long long length;     /* values in a block; doubles when all blocks are full */
    long long blocks;     /* full blocks */
    long long open_count; /* values in the open block */
    long long lost;       /* 1 after a value that was not finite */
    double first, last;   /* x at the first and at the last value */
    double min, max;      /* of all full blocks */
    double from, to;      /* t at the first and at the last value */
    /* Of the open block: t at its first value, min, max, and the partial sums of x - first: value
     * k of the block belongs to sum k modulo DAL_PARTIAL_SUMS. */
    double open_t, open_min, open_max, open_sum[DAL_PARTIAL_SUMS];
    double open_from, open_square[DAL_PARTIAL_SUMS]; /* its first x; ((x - it)/rough_unit)^2 */
    /* Sums and means are of factor * (x - first): 1, or less after a value near the largest
     * double. */
    double factor;
    double scale; /* the largest by dal_statistics_add_scales; 0: none */
    /* Sums of squared differences, in units of rough_unit, a power of two (0: all values were 0):
     * rough_steps of successive values while blocks are short; then rough[] of values
     * DAL_PARTIAL_SUMS apart, one pair in four, by partial sum; held[] is the first of a pair. */
    double rough_unit, rough_steps, rough[DAL_PARTIAL_SUMS], held[DAL_PARTIAL_SUMS];
    /* x: factor * (mean - first), rms: times factor; min and max are of x itself. */
    dal_statistics_block block[DAL_STATISTICS_BLOCKS];
} dal_statistics;

/* Begins the statistics of count quantities, statistics[count], which belong to the caller. */
void dal_statistics_start(dal_statistics *statistics, int count);
/* Adds one value of each quantity, values[count], at time t, which increases in nearly equal steps.
 * A value that is not finite is left out and sets lost. */
void dal_statistics_add(dal_statistics *statistics, int count, double t, const double *values);
/* Adds the values of each quantity at t[samples]; the value of quantity i at t[k] is
 * values[i * stride + k].  The result has the bits of adding them one by one; it is many times
 * faster. */
void dal_statistics_add_many(dal_statistics *statistics, int count, int samples, const double *t,
                             const double *values, size_t stride);

/* Adds the scales of the quantities where they have just been observed, scales[count]: the largest
 * so far is the scale of dal_run_classify.  An observer's scales are such. */
void dal_statistics_add_scales(dal_statistics *statistics, int count, const double *scales);

/* max |x|; infinite when a value was lost. */
double dal_statistics_max_abs(const dal_statistics *statistics);
/* max |x - first|; infinite when a value was lost. */
double dal_statistics_deviation(const dal_statistics *statistics);

/* A mean and its 95 % confidence interval, from the means of blocks and the correlation of
 * neighbours (Flyvbjerg, Petersen 1989, DOI 10.1063/1.457480).  The interval covers
 * variation from block to block; it covers neither a slow approach to a limit nor the error of the
 * method. */
typedef struct dal_average {
    double mean;      /* the mean */
    double low, high; /* ends of the interval */
} dal_average;

/* The mean of x; NaN without values; an infinite interval with fewer than 3 blocks. */
void dal_statistics_mean(const dal_statistics *statistics, dal_average *average);

/* How the slope of x varies: the largest less the smallest of the rates of least squares of the
 * four quarters of the values; NaN with fewer than 16 blocks.  A line that bends on as it does here
 * may have, in a run k times as long, a rate within k - 1 such ranges of its own: of 280 rates of
 * shipped systems 93 % did for k = 50.  It is no confidence interval. */
double dal_statistics_rate_range(const dal_statistics *statistics);

/* Sizes: SIZE(code, word). */
#define DAL_SIZE_LIST(SIZE)                                                                        \
    SIZE(EXACT, "exact")       /* the quantity never changed */                                    \
    SIZE(ROUNDING, "rounding") /* no more than the roundings of that many steps cause */           \
    SIZE(LARGER, "larger")     /* more */

/* The size of a quantity's deviation. */
typedef enum dal_size_class {
#define SIZE_CODE(code, word) DAL_SIZE_##code,
    DAL_SIZE_LIST(SIZE_CODE)
#undef SIZE_CODE
        DAL_SIZE_COUNT
} dal_size_class;

/* Trends: TREND(code, word). */
#define DAL_TREND_LIST(TREND)                                                                      \
    TREND(NONE, "none")                   /* it stays about one value */                           \
    TREND(SETTLES, "settles")             /* it changes once and then stays about one value */     \
    TREND(RANDOM_WALK, "random walk")     /* its steps are independent: it grows like sqrt(t) */   \
    TREND(LINEAR, "linear")               /* it drifts at one rate, and may oscillate */           \
    TREND(POWER, "power law")             /* it grows like another power of t */                   \
    TREND(EXPONENTIAL, "exponential")     /* it grows by equal factors in equal times */           \
    TREND(GROWING, "growing oscillation") /* about one value, with a growing amplitude */          \
    TREND(UNDECIDED, "undecided")         /* several of these, or none, explain the values */      \
    TREND(ABORTED, "aborted")             /* a value was not finite, or the run ended early */

/* The trend of a quantity over a long time. */
typedef enum dal_trend_class {
#define TREND_CODE(code, word) DAL_TREND_##code,
    DAL_TREND_LIST(TREND_CODE)
#undef TREND_CODE
        DAL_TREND_COUNT
} dal_trend_class;

/* Kinds of conservation: CONSERVATION(code, text). */
#define DAL_CONSERVATION_LIST(CONSERVATION)                                                        \
    CONSERVATION(CONSERVED, "conserved")                                                           \
    CONSERVATION(NOT_CONSERVED, "not conserved by the motion")                                     \
    CONSERVATION(OFF_SURFACE, "conserved on D = 0 only, and D is not 0")                           \
    CONSERVATION(MOVED_BY_PI, "not conserved where pi is not 0")

/* Whether the motion of a run conserves a quantity. */
typedef enum dal_conservation {
#define CONSERVATION_CODE(code, text) DAL_##code,
    DAL_CONSERVATION_LIST(CONSERVATION_CODE)
#undef CONSERVATION_CODE
} dal_conservation;

const char *dal_size_text(dal_size_class size);    /* the word, "rounding" */
const char *dal_trend_text(dal_trend_class trend); /* the word, "random walk" */
/* The text, "conserved". */
const char *dal_conservation_text(dal_conservation conservation);

/* Size and trend of a quantity x, with the numbers both are decided by. */
typedef struct dal_trend {
    long long count;           /* values */
    double first, last;        /* x at the first and at the last */
    double scale;              /* of the terms that x is made of, see dal_run_classify */
    double max_abs, deviation; /* max |x|, max |x - first| */
    double amplitude;          /* half the range of x about the fitted line */
    double rate;               /* slope of the line, per unit of time passed, |t - first t|; where x
                                   settles, after the change */
    double rate_low, rate_high; /* its 95 % interval, of this run and not of a longer one */
    double max_drift;           /* max |drift| over the whole series in this interval */
    double exponent; /* of t: 1 linear, 1/2 random walk, 0 none and settles, fitted for a power law;
                         NaN where none can be stated */
    dal_size_class size;           /* of the deviation */
    dal_trend_class trend;         /* of x */
    double confidence;             /* 0..1, of the trend; NaN where it is undecided or aborted */
    dal_trend_class likeliest;     /* where undecided: what has half of the evidence; else trend */
    dal_conservation conservation; /* unless DAL_CONSERVED, exponent, size, trend and confidence
                                      state nothing; see dal_run_classify */
} dal_trend;

/* Classifies a quantity by the evidence for each shape (Kass, Raftery 1995, DOI
 * 10.1080/01621459.1995.10476572).  scale is the size of the terms that it is made of, in its unit,
 * by which roundings are measured; where it or a value is not finite, no change is a rounding.
 * status: with which the run ended; unless it is DAL_STATUS_OK or DAL_STATUS_STOPPED the trend is
 * DAL_TREND_ABORTED.  More values may be added afterwards. */
void dal_statistics_classify(const dal_statistics *statistics, double scale, dal_status status,
                             dal_trend *trend);

/* Classifies all observables of a run: statistics[count] and trend[count] in the order of
 * dal_run_observe.  Their scales are those that dal_statistics_add_scales has added, or, where it
 * has added none, of the present state; of norms (|p|, |pi|, |pi_e|) the largest value.  E is
 * DAL_CONSERVED where the motion conserves it on every level of D, or on
 * D = 0 while max |D| is rounding-sized, and not where pi/e acts; H where F does not depend on t or
 * pi is 0; all else always is.  status: see dal_statistics_classify. */
void dal_run_classify(dal_run *run, const dal_statistics *statistics, dal_status status,
                      dal_trend *trend);

#ifdef __cplusplus
}
#endif
#endif
