/* test_verdict.c - verdicts on 1000 synthetic series of each kind, with the matrix of what was said
 * of what, and on series with one peculiarity each. */
#include "quick.h"
#include <CUnit/CUnit.h>
#include <dalembert.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>

enum { SERIES = 1000, LEAST_RIGHT = 95 /* of 100 */ };

/* ---- chance ---- */

/* SplitMix64 (Steele, Lea, Flood 2014, DOI 10.1145/2660193.2660195). */
static uint64_t next(uint64_t *state)
{
    uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return z ^ z >> 31;
}

static double between(uint64_t *state, double low, double high)
{
    return low + (high - low) * (double)(next(state) >> 11) * 0x1p-53;
}

/* Log-uniform. */
static double about(uint64_t *state, double low, double high)
{
    return exp(between(state, log(low), log(high)));
}

/* The sum of four uniform numbers, of variance 1: near enough to normal, and quick. */
static double normal(uint64_t *state)
{
    const uint64_t bits = next(state);
    const double sum = (double)(bits & 0xffff) + (double)(bits >> 16 & 0xffff) +
                       (double)(bits >> 32 & 0xffff) + (double)(bits >> 48);
    return (sum * 0x1p-16 - 2.0) * 1.7320508075688772;
}

/* ---- the kinds ---- */

typedef struct series {
    uint64_t chance;
    int length;
    double size, offset; /* of the whole; what it is added to */
    double noise;        /* relative to size */
    double tone[3], frequency[3], phase[3];
    double trend, power, rate, level, memory, red;
} series;

/* One to three tones of 3 to length/4 periods, of which the greatest has size 1. */
static double tones(const series *s, double t)
{
    double sum = 0.0;
    for (int i = 0; i < 3; i++)
        if (s->tone[i] > 0.0) sum += s->tone[i] * cos(s->frequency[i] * t + s->phase[i]);
    return sum;
}

static double exact(series *s, double t) { return (void)t, s->offset; }
static double white(series *s, double t) { return (void)t, normal(&s->chance); }

/* Noise that remembers some dozen steps. */
static double red(series *s, double t)
{
    (void)t;
    s->red = s->memory * s->red + normal(&s->chance);
    return s->red;
}

static double oscillation(series *s, double t)
{
    return tones(s, t) + s->noise * normal(&s->chance);
}

static double walk(series *s, double t)
{
    (void)t;
    s->level += 0x1p-53 * normal(&s->chance);
    return s->level;
}

static double line(series *s, double t) { return t + s->noise * normal(&s->chance); }
static double slow_trend(series *s, double t) { return s->trend * t + oscillation(s, t); }
static double bow(series *s, double t) { return pow(t, s->power) + s->noise * normal(&s->chance); }

static double explosion(series *s, double t)
{
    return exp(s->rate * t) * (1.0 + s->noise * normal(&s->chance));
}

static double relaxation(series *s, double t)
{
    return exp(-2.0 * s->rate * t) + s->noise * normal(&s->chance);
}

/* The tones are many to a block; slower ones that grow are not told from others. */
static double resonance(series *s, double t)
{
    return t * t * cos((0.3 + s->memory) * s->length * t + s->phase[0]);
}

static double diffusion(series *s, double t) { return 1e3 * walk(s, t) / 0x1p-53; }

typedef double value(series *s, double t);

#define KIND_LIST(X)                                                                               \
    X(exact, EXACT, NONE)                                                                          \
    X(white, LARGER, NONE)                                                                         \
    X(red, LARGER, NONE)                                                                           \
    X(oscillation, LARGER, NONE)                                                                   \
    X(walk, ROUNDING, NONE)                                                                        \
    X(line, LARGER, LINEAR)                                                                        \
    X(slow_trend, LARGER, LINEAR)                                                                  \
    X(bow, LARGER, POWER)                                                                          \
    X(explosion, LARGER, EXPONENTIAL)                                                              \
    X(relaxation, LARGER, NONE)                                                                    \
    X(resonance, LARGER, POWER)                                                                    \
    X(diffusion, LARGER, POWER)

static const struct {
    const char *name;
    value *of;
    dal_size_class size;
    dal_trend_class trend;
} kinds[] = {
#define X(name, size, trend) {#name, name, DAL_SIZE_##size, DAL_TREND_##trend},
    KIND_LIST(X)
#undef X
};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

static series make_series(uint64_t seed)
{
    series s = {.chance = seed};
    uint64_t *c = &s.chance;
    next(c);
    s.length = (int)about(c, 600.0, 6000.0);
    s.size = about(c, 1e-6, 1e3);
    s.offset = between(c, -1.0, 1.0) * s.size;
    s.noise = about(c, 1e-4, 0.3);
    s.trend = (next(c) & 1 ? 1.0 : -1.0) * about(c, 0.3, 3.0);
    s.power = next(c) & 1 ? between(c, 1.4, 4.0) : between(c, 0.3, 0.6);
    s.rate = between(c, 5.0, 30.0);
    s.memory = between(c, 0.5, 0.95);
    const int count = 1 + (int)(next(c) % 3);
    for (int i = 0; i < count; i++) {
        s.tone[i] = i == 0 ? 1.0 : between(c, 0.1, 1.0);
        s.frequency[i] = 6.283185307179586 * about(c, 3.0, 0.25 * s.length);
        s.phase[i] = between(c, 0.0, 6.283185307179586);
    }
    return s;
}

static dal_trend trend_of(value *x, uint64_t seed)
{
    series s = make_series(seed);
    dal_statistics statistics;
    dal_trend trend;
    dal_statistics_start(&statistics, 1);
    const int plain = x == exact || x == walk;
    for (int k = 0; k <= s.length; k++) {
        const double t = (double)k / s.length, own = x(&s, t);
        const double sample = plain ? own : s.offset + s.size * own;
        dal_statistics_add(&statistics, 1, 100.0 * t, &sample);
    }
    dal_statistics_classify(&statistics, 1.0, 0, &trend);
    return trend;
}

/* ---- the matrix ---- */

static void test_matrix(void)
{
    const int count = (int)long_run(SERIES);
    printf("\n%24s", "");
    for (int v = 0; v < DAL_TREND_COUNT; v++) printf(" %15s", dal_trend_text(v));
    printf("\n");
    for (int k = 0; k < KINDS; k++) {
        int said[DAL_TREND_COUNT] = {0}, right = 0;
        for (int i = 0; i < count; i++) {
            const dal_trend f = trend_of(kinds[k].of, (uint64_t)(k * SERIES + i));
            said[f.trend]++;
            right += f.trend == kinds[k].trend && f.size == kinds[k].size;
        }
        printf("%24s", kinds[k].name);
        for (int v = 0; v < DAL_TREND_COUNT; v++) printf(" %15d", said[v]);
        printf("\n");
        CU_ASSERT(right >= count * LEAST_RIGHT / 100);
    }
}

/* ---- peculiarities ---- */

typedef double signal(int k);

enum { LONG = 5000 };

static double constant(int k) { return (void)k, -7.0; }
static double few_bits(int k) { return 1.0 + 0x1p-52 * (k % 3); }
static double small_line(int k) { return 1.0 + 0x1p-52 * (k / 100); }
static double steady_drift(int k) { return 1.0 + 1e-14 * k; }
static double curved_drift(int k) { return 1.0 + 1e-3 * k + 3e-8 * k * k; }
static double half_wave(int k) { return sin(3.0 * k / LONG); }
static double one_wave(int k) { return sin(6.0 * k / LONG); }
static double four_waves(int k) { return sin(25.0 * k / LONG); }
static double spike(int k) { return k == 0 ? 1.0 : 0.0; }
static double growing(int k) { return exp(9.0 * k / LONG) * cos(2.0 * k); }
static double broken(int k) { return k < 4000 ? 1.0 : NAN; }

static dal_trend follow(signal *x, double scale, int count)
{
    dal_statistics statistics;
    dal_trend trend;
    dal_statistics_start(&statistics, 1);
    for (int k = 0; k <= count; k++) {
        const double own = x(k);
        dal_statistics_add(&statistics, 1, 0.1 * k, &own);
    }
    dal_statistics_classify(&statistics, scale, 0, &trend);
    return trend;
}

static void test_peculiarities(void)
{
    static const struct {
        signal *x;
        double scale;
        int count;
        dal_size_class size;
        dal_trend_class trend;
    } cases[] = {
        {constant, 1.0, LONG, DAL_SIZE_EXACT, DAL_TREND_NONE},
        {constant, 1.0, 1, DAL_SIZE_EXACT, DAL_TREND_NONE},
        {constant, 1.0, 0, DAL_SIZE_LARGER, DAL_TREND_UNDECIDED},
        {few_bits, 1.0, LONG, DAL_SIZE_ROUNDING, DAL_TREND_NONE},
        {few_bits, 1e-6, LONG, DAL_SIZE_LARGER, DAL_TREND_NONE},
        {small_line, 1.0, LONG, DAL_SIZE_ROUNDING, DAL_TREND_NONE},
        {steady_drift, 1.0, LONG, DAL_SIZE_LARGER, DAL_TREND_LINEAR},
        {steady_drift, 1e6, LONG, DAL_SIZE_ROUNDING, DAL_TREND_NONE},
        {steady_drift, 1.0, 30, DAL_SIZE_LARGER, DAL_TREND_UNDECIDED},
        {curved_drift, 1.0, LONG, DAL_SIZE_LARGER, DAL_TREND_LINEAR},
        {half_wave, 1.0, LONG, DAL_SIZE_LARGER, DAL_TREND_UNDECIDED},
        {one_wave, 1.0, LONG, DAL_SIZE_LARGER, DAL_TREND_UNDECIDED},
        {four_waves, 1.0, LONG, DAL_SIZE_LARGER, DAL_TREND_NONE},
        {spike, 1.0, LONG, DAL_SIZE_LARGER, DAL_TREND_NONE},
        {growing, 1.0, LONG, DAL_SIZE_LARGER, DAL_TREND_EXPONENTIAL},
        {broken, 1.0, LONG, DAL_SIZE_LARGER, DAL_TREND_ABORTED},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const dal_trend f = follow(cases[i].x, cases[i].scale, cases[i].count);
        if (f.size != cases[i].size || f.trend != cases[i].trend)
            printf("\n  case %zu: %s, %s, %g", i, dal_size_text(f.size), dal_trend_text(f.trend),
                   f.confidence);
        CU_ASSERT_EQUAL(f.size, cases[i].size);
        CU_ASSERT_EQUAL(f.trend, cases[i].trend);
        CU_ASSERT(f.confidence > 0.0 && f.confidence <= 1.0);
    }
}

void suite_verdict(void)
{
    CU_pSuite suite = CU_add_suite("verdicts", NULL, NULL);
    CU_add_test(suite, "1000 series of each kind", test_matrix);
    CU_add_test(suite, "peculiarities", test_peculiarities);
}
