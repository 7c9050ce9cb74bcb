/* series.h - synthetic series of known kinds, for the tests of trends. */
#ifndef SERIES_H
#define SERIES_H

#include <dalembert.h>
#include <dalembert_analysis.h>
#include <stdint.h>

enum { SERIES_CAPACITY = 200001 };

typedef struct series {
    uint64_t random; /* state of the generator */
    int count;       /* values, at s = k/(count - 1), k = 0 .. count - 1 */
    double *x;
    double drift;    /* of the straight line in it, over the whole series; 0 for noise */
    double exponent; /* of its power law; NaN for others */
    double from, to; /* the bounds of the parameter that the kind draws */
} series;

typedef void series_generator(series *s);

/* SplitMix64; uniform on low..high; uniform in the logarithm; a sum of four uniform numbers, of
 * mean 0 and variance 1. */
uint64_t series_next(uint64_t *random);
double series_between(uint64_t *random, double low, double high);
double series_log_between(uint64_t *random, double low, double high);
double series_normal(uint64_t *random);

/* Numbers drawn for a series: a sign; uniform; uniform in the logarithm; the parameter of the kind.
 * The place s of value k. */
double series_sign(series *s);
double series_uniform(series *s, double a, double b);
double series_log_uniform(series *s, double a, double b);
double series_parameter(series *s);
double series_place(const series *s, int k);

/* Adds white noise of deviation size; noise with memory m T and deviation size; a walk with steps
 * of deviation size; a line; a tone; one to three tones of at least `periods` periods, the largest
 * of amplitude size. */
void series_add_white(series *s, double size);
void series_add_memory(series *s, double memory, double size);
void series_add_walk(series *s, double size);
void series_add_line(series *s, double drift);
void series_add_tone(series *s, double size, double periods, double phase);
void series_add_tones(series *s, double size, double periods);
/* The deviation of the values so far. */
double series_deviation(const series *s);

/* Which trends a kind accepts. */
enum {
    ACCEPT_NONE = 1,
    ACCEPT_SETTLES = 2,
    ACCEPT_WALK = 4,
    ACCEPT_LINEAR = 8,
    ACCEPT_POWER = 16,
    ACCEPT_EXPONENTIAL = 32,
    ACCEPT_GROWING = 64,
    ACCEPT_LOGARITHM = 128,  /* a power law below 0.2 */
    DECIDES = 256,           /* at most 8 % undecided */
    WALKS = 512,             /* a random walk in at least 30 % */
    COVERS = 1024,           /* the interval of the rate holds drift in at least 93 % */
    ROUNDINGS = 2048,        /* of rounding size beside 1, and not to be scaled */
    TRUNCATION = 4096,       /* larger than roundings beside 1, and not to be scaled */
    ACCEPT_UNDECIDED = 8192, /* nothing can be said: undecided is right */
    HARD = 16384             /* exempt from the goal of sure errors */
};

typedef struct series_kind {
    const char *name;
    series_generator *generate;
    double from, to;          /* of its parameter */
    int min_count, max_count; /* values */
    int accepts;
    int noises; /* bit i: under white noise of deviation series_noise[i]; 0: as drawn */
} series_kind;

enum { SERIES_NOISES = 3 };
extern const double series_noise[SERIES_NOISES];

extern const series_kind series_kinds[], shape_kinds[];
extern const int series_kind_count, shape_kind_count;

/* Draws series number `number` of a kind into x[SERIES_CAPACITY]. */
void series_draw(const series_kind *kind, uint64_t number, double *x, series *s);
/* The same with `count` values, under noise of deviation `noise`. */
void series_draw_values(const series_kind *kind, uint64_t number, int count, double noise,
                        double *x, series *s);

#endif
