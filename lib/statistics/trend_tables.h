/* trend_tables.h - the shapes and the noises that trends are made of, as tables.
 *
 * A series is cut into BINS equal bins; y_m is the mean over bin m and
 *
 *     Y_j = sum_m y_m sqrt(2/BINS) cos(pi j (m + 1/2)/BINS),    j = 1 .. WAVES,
 *
 * its cosine coefficients without the constant's.  For white noise, autoregressive noise and
 * a random walk these are nearly uncorrelated (Mueller, Watson 2008, DOI 10.1111/j.1468-0262.2008
 * .00821.x; 2018, DOI 10.3982/ECTA15047), so that a noise is a list of variances.  The tables are
 * made by tools/trend-tables.c when the library is built. */
#ifndef DAL_TREND_TABLES_H
#define DAL_TREND_TABLES_H

enum {
    DAL__BINS = 32,
    DAL__WAVES = DAL__BINS - 1,
    DAL__POWER_SHAPES = 30,               /* the first: s^p by ascending p */
    DAL__LINEAR_SHAPE = 8,                /* among them, p = 1 */
    DAL__SLOW_WAVES = 11,                 /* oscillations of 0.25 .. 2.75 periods */
    DAL__PLAIN_SHAPES = 220,              /* of one column */
    DAL__SHAPES = DAL__PLAIN_SHAPES + 24, /* columns; cosine and sine of each slow wave last */
    DAL__NOISES = 24,
    DAL__SHAPE_NOISES = 12,     /* the first of them, under which shapes are tried */
    DAL__FIRST_LONG_MEMORY = 6, /* T/9 */
    DAL__LAST_LONG_MEMORY = 7,
    DAL__FIRST_WALK = 8,
    DAL__LAST_WALK = 11,
    DAL__TAUS = 8,
    DAL__PAIRS = DAL__TAUS * (DAL__TAUS - 1) / 2 + 11 + DAL__TAUS, /* of shapes together */
    DAL__GROWING_POWERS = 5 * 24 + 72,
    DAL__GROWING_AMPLITUDES = DAL__GROWING_POWERS + 12 * 24, /* the first: powers, exponentials */
    DAL__AMPLITUDES = DAL__GROWING_AMPLITUDES + 90 + 216 + 9 * 24 + 60
};

/* What a shape or a noise says about the trend. */
typedef enum dal__meaning {
    DAL__MEANS_NONE,
    DAL__MEANS_SETTLES,
    DAL__MEANS_WALK,
    DAL__MEANS_LINEAR,
    DAL__MEANS_POWER,
    DAL__MEANS_EXPONENTIAL,
    DAL__MEANS_OTHER, /* a change of no known shape */
    DAL__MEANINGS
} dal__meaning;

typedef struct dal__shape {
    dal__meaning meaning;
    double weight;    /* prior */
    double parameter; /* exponent of a power, rate of an exponential, time or centre of a change */
    double width;     /* of a step; 0 for others */
} dal__shape;

typedef struct dal__noise {
    dal__meaning meaning;         /* of this noise alone */
    double weight;                /* prior, of the noise alone */
    double shape_weight;          /* prior, where a shape lies in it */
    double rate_weight;           /* prior, for the interval of the rate */
    double log_determinant;       /* sum of the logarithms of the variances */
    double precision_sum;         /* sum of precision */
    double precision[DAL__WAVES]; /* 1/variance of each coefficient, in units of white noise */
} dal__noise;

/* Two shapes of the list that are tried together. */
typedef struct dal__pair {
    int first, second;
    dal__meaning meaning;
    double weight; /* prior */
} dal__pair;

extern const double dal__cosine[DAL__WAVES][DAL__BINS];
extern const dal__shape dal__shape_list[DAL__SHAPES];
extern const dal__noise dal__noise_list[DAL__NOISES];
/* Coefficients of the shapes; sum of precision * coefficient^2; for slow wave i, sum of precision *
 * cosine * sine. */
extern const double dal__shape_wave[DAL__WAVES][DAL__SHAPES];
extern const double dal__shape_square[DAL__SHAPE_NOISES][DAL__SHAPES];
extern const double dal__slow_product[DAL__SHAPE_NOISES][DAL__SLOW_WAVES];
extern const dal__pair dal__pair_list[DAL__PAIRS];
/* The sum of precision * coefficient * coefficient of the two. */
extern const double dal__pair_product[DAL__SHAPE_NOISES][DAL__PAIRS];
/* Shapes of the logarithm of an amplitude, which have no free size: priors, coefficients, and the
 * sum of precision * coefficient^2. */
extern const double dal__amplitude_weight[DAL__AMPLITUDES];
extern const double dal__amplitude_wave[DAL__WAVES][DAL__AMPLITUDES];
extern const double dal__amplitude_square[DAL__SHAPE_NOISES][DAL__AMPLITUDES];

#endif
