/* test_statistics.c - what is kept of a quantity along a run, against closed forms. */
#include "measure/statistics.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

enum { VALUES = 1024 }; /* fills blocks to the last: 32 of 32 */

typedef double signal(double t);

static dal_statistics statistics_of(signal *x, double T, int values)
{
    dal_statistics s;
    dal_statistics_start(&s, 1);
    for (int k = 0; k < values; k++) {
        const double t = T * k / (values - 1), value = x(t);
        dal_statistics_add(&s, 1, t, &value);
    }
    return s;
}

static dal_trend finding_of(signal *x, double T)
{
    const dal_statistics s = statistics_of(x, T, VALUES);
    dal_trend f;
    dal_statistics_classify(&s, 1.0, 0, &f);
    return f;
}

static double line(double t) { return 3.0 - 2.0 * t; }
static double high_line(double t) { return 1e9 + 1e-3 * t; }
static double one_wave(double t) { return sin(0.2 * acos(-1.0) * t); }
static double leaning_wave(double t) { return cos(2.0 * acos(-1.0) * 10.0 * t) + 2.0 * t; }
static double square_root(double t) { return sqrt(t); }
static double cube(double t) { return 5.0 + t * t * t; }

static void test_line(void)
{
    const dal_statistics s = statistics_of(line, 10.0, VALUES);
    CU_ASSERT_EQUAL(s.count, VALUES);
    CU_ASSERT_EQUAL(s.blocks, 32);
    CU_ASSERT_EQUAL(s.length, 32);
    const dal_trend f = finding_of(line, 10.0);
    CU_ASSERT_EQUAL(f.first, 3.0);
    CU_ASSERT_DOUBLE_EQUAL(f.last, -17.0, 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(f.max_abs, 17.0, 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(f.deviation, 20.0, 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(f.rate, -2.0, 1e-13);
    CU_ASSERT(f.rate_low <= -2.0 + 1e-13 && f.rate_high >= -2.0 - 1e-13);
    CU_ASSERT_DOUBLE_EQUAL(f.rate_high - f.rate_low, 0.0, 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(f.exponent, 1.0, 0.01);
}

/* Plain normal equations would lose all digits of this slope: 1e18 against 1e-3. */
static void test_slope_beside_a_large_value(void)
{
    CU_ASSERT_DOUBLE_EQUAL(finding_of(high_line, 10.0).rate, 1e-3, 1e-8);
}

/* Of sin(2 pi t/T) the slope is int (t - T/2) sin / int (t - T/2)^2 = -(T^2/2 pi) / (T^3/12). */
static void test_slope_of_a_wave(void)
{
    CU_ASSERT_DOUBLE_EQUAL(finding_of(one_wave, 10.0).rate, -12.0 / (2.0 * acos(-1.0) * 10.0),
                           1e-3);
}

static void test_amplitude(void)
{
    const dal_trend f = finding_of(leaning_wave, 10.0);
    CU_ASSERT_DOUBLE_EQUAL(f.amplitude, 1.0, 0.02);
    CU_ASSERT_DOUBLE_EQUAL(f.rate, 2.0, 0.01);
}

/* The first block ends with value 31 of 1023 and not with t = T/32: 3 log(32/31) in log 32. */
static void test_exponents(void)
{
    CU_ASSERT_DOUBLE_EQUAL(finding_of(square_root, 10.0).exponent, 0.5, 0.01);
    CU_ASSERT_DOUBLE_EQUAL(finding_of(cube, 10.0).exponent, 3.0, 0.03);
    CU_ASSERT_DOUBLE_EQUAL(finding_of(cube, 10.0).deviation, 1000.0, 1e-9);
}

/* Extremes count wherever they fall: in the first value, in a full block, in the open one. */
static void test_extremes(void)
{
    for (int place = 0; place < 200; place++) {
        dal_statistics s;
        dal_statistics_start(&s, 1);
        for (int k = 0; k < 200; k++) {
            const double x = k == place ? -7.0 : 1.0;
            dal_statistics_add(&s, 1, k, &x);
        }
        CU_ASSERT_EQUAL(dal_statistics_max_abs(&s), 7.0);
        CU_ASSERT_EQUAL(dal_statistics_deviation(&s), 8.0);
    }
}

/* The memory stays what it is, the blocks between half and all, each of the same length, and
 * together they hold the mean of all they saw. */
static void test_blocks_double(void)
{
    dal_statistics s;
    dal_statistics_start(&s, 1);
    for (long long k = 0; k < 100000; k++) {
        const double x = (double)k;
        dal_statistics_add(&s, 1, 0.5 * (double)k, &x);
        CU_ASSERT_FATAL(s.blocks * s.length + s.open_count == k + 1);
        CU_ASSERT_FATAL(s.length == 1 || s.blocks >= DAL_BLOCKS / 2);
    }
    for (long long i = 0; i < s.blocks; i++) {
        const double first = (double)(i * s.length),
                     middle = first + 0.5 * ((double)s.length - 1.0);
        CU_ASSERT_EQUAL(s.block[i].x, middle);
        CU_ASSERT_EQUAL(s.block[i].t, 0.5 * middle);
        CU_ASSERT_EQUAL(s.block[i].least, first);
        CU_ASSERT_EQUAL(s.block[i].most, first + (double)s.length - 1.0);
    }
}

/* ---- many at a time ---- */

/* SplitMix64 (Steele, Lea, Flood 2014, DOI 10.1145/2660193.2660195), uniform on [-1, 1). */
static double chance(uint64_t *state)
{
    uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return (double)((z ^ z >> 31) >> 11) * 0x1p-52 - 1.0;
}

enum { QUANTITIES = 3, LOOKS = 5000, STRIDE = LOOKS + 3 };

/* Noise beside a value, a line, and noise in which now and then a value is none. */
static void fill_looks(double *t, double *x)
{
    uint64_t state = 7;
    for (int k = 0; k < LOOKS; k++) {
        t[k] = 0.01 * k;
        x[k] = 1e3 + chance(&state);
        x[STRIDE + k] = 3.0 * t[k];
        x[2 * STRIDE + k] = chance(&state);
        if (k % 371 == 200) x[2 * STRIDE + k] = k % 2 ? NAN : INFINITY;
    }
}

/* In portions of any size: the same bits as one by one. */
static void test_many(void)
{
    static double t[LOOKS], x[QUANTITIES * STRIDE];
    static const int most[] = {1, 5, 8, 64, 300, LOOKS};
    dal_statistics one[QUANTITIES], many[QUANTITIES];
    fill_looks(t, x);
    dal_statistics_start(one, QUANTITIES);
    for (int k = 0; k < LOOKS; k++) {
        const double values[] = {x[k], x[STRIDE + k], x[2 * STRIDE + k]};
        dal_statistics_add(one, QUANTITIES, t[k], values);
    }
    CU_ASSERT(one[2].lost && one[2].count < LOOKS && one[1].count == LOOKS);
    for (size_t i = 0; i < sizeof most / sizeof most[0]; i++) {
        uint64_t state = i;
        dal_statistics_start(many, QUANTITIES);
        for (int k = 0, portion; k < LOOKS; k += portion) {
            portion = (int)(most[i] * 0.5 * (1.0 + fabs(chance(&state)))) + 1;
            portion = portion < LOOKS - k ? portion : LOOKS - k;
            dal_statistics_add_many(many, QUANTITIES, portion, t + k, x + k, STRIDE);
        }
        CU_ASSERT(memcmp(one, many, sizeof one) == 0);
    }
}

/* Packs of every variant: the parts of the sum, and a tally left alone by what is not finite. */
static void test_packs(void)
{
    typedef bool tally_packs(dal__tally *, double, int, const double *);
    static const struct {
        dal__instructions set;
        tally_packs *add;
    } variants[] = {{DAL__BASE, dal__tally_packs_x1},
#define X(name, variant, lanes, set, group) {DAL__##set, name##_##variant},
                    DAL__VARIANT_LIST(X, dal__tally_packs)
#undef X
    };
    double x[3 * DAL_PARTS];
    for (int k = 0; k < 3 * DAL_PARTS; k++) x[k] = k * k;
    for (size_t i = 0; i < sizeof variants / sizeof variants[0]; i++) {
        if (!dal__machine_has(variants[i].set)) continue;
        double sum[DAL_PARTS] = {1.0}, sum_before[DAL_PARTS];
        dal__tally tally = {sum, 5.0, 5.0};
        CU_ASSERT(variants[i].add(&tally, 2.0, 3, x));
        CU_ASSERT(tally.least == 0.0 && tally.most == 529.0);
        for (int k = 0; k < DAL_PARTS; k++) /* k^2 + (k + 8)^2 + (k + 16)^2 - 3 * 2 */
            CU_ASSERT_EQUAL(sum[k], 3 * k * k + 48 * k + 320 - 6 + (k == 0));
        const dal__tally before = tally;
        memcpy(sum_before, sum, sizeof sum);
        x[11] = i % 2 ? NAN : -INFINITY;
        CU_ASSERT(!variants[i].add(&tally, 2.0, 3, x));
        CU_ASSERT(memcmp(&tally, &before, sizeof tally) == 0);
        CU_ASSERT(memcmp(sum, sum_before, sizeof sum) == 0);
        x[11] = 121.0;
    }
}

/* ---- the interval of the rate ---- */

/* Out of 1000 series of noise with a memory of 1/(1 - memory) values about a line of slope 1. */
static int intervals_that_hold(double memory)
{
    int hold = 0;
    uint64_t state = 11;
    for (int i = 0; i < 1000; i++) {
        dal_statistics s;
        dal_trend f;
        double noise = 0.0;
        dal_statistics_start(&s, 1);
        for (int k = 0; k < 2000; k++) {
            noise = memory * noise + chance(&state);
            const double x = 0.001 * k + noise;
            dal_statistics_add(&s, 1, 0.001 * k, &x);
        }
        dal_statistics_classify(&s, 1e9, 0, &f); /* roundings are not the question here */
        hold += f.rate_low <= 1.0 && f.rate_high >= 1.0;
    }
    return hold;
}

/* 950 are promised; the deviation of such a count is 7. */
static void test_intervals(void)
{
    CU_ASSERT_DOUBLE_EQUAL(intervals_that_hold(0.0), 950, 25);
    CU_ASSERT_DOUBLE_EQUAL(intervals_that_hold(0.9), 950, 25);
    CU_ASSERT(intervals_that_hold(0.99) >= 900);
}

/* ---- nothing and nonsense ---- */

static dal_trend_class trend_of(const dal_statistics *s)
{
    dal_trend f;
    dal_statistics_classify(s, 1.0, 0, &f);
    CU_ASSERT(f.confidence > 0.0 && f.confidence <= 1.0);
    return f.trend;
}

static void test_nothing_and_nonsense(void)
{
    dal_statistics s[2];
    dal_trend f;
    dal_statistics_start(s, 2);
    CU_ASSERT_EQUAL(trend_of(&s[0]), DAL_TREND_ABORTED);
    const double rows[][2] = {{1.0, 1.0}, {2.0, INFINITY}, {3.0, 1.0}};
    for (int k = 0; k < 3; k++) dal_statistics_add(s, 2, 0.5 * k, rows[k]);
    CU_ASSERT_EQUAL(dal_statistics_max_abs(&s[0]), 3.0);
    dal_statistics_classify(&s[0], 1.0, 0, &f);
    CU_ASSERT_DOUBLE_EQUAL(f.rate, 2.0, 1e-14);
    CU_ASSERT_EQUAL(f.trend, DAL_TREND_UNDECIDED);
    /* What is not finite is counted nowhere but in the maxima. */
    CU_ASSERT(isinf(dal_statistics_max_abs(&s[1])) && isinf(dal_statistics_deviation(&s[1])));
    CU_ASSERT_EQUAL(s[1].count, 2);
    CU_ASSERT_EQUAL(trend_of(&s[1]), DAL_TREND_ABORTED);
    dal_statistics_classify(&s[0], 1.0, 1, &f);
    CU_ASSERT_EQUAL(f.trend, DAL_TREND_ABORTED);
}

void suite_statistics(void)
{
    CU_pSuite suite = CU_add_suite("statistics of a quantity", NULL, NULL);
    CU_add_test(suite, "a line", test_line);
    CU_add_test(suite, "a slope beside a large value", test_slope_beside_a_large_value);
    CU_add_test(suite, "the slope of a wave", test_slope_of_a_wave);
    CU_add_test(suite, "amplitude", test_amplitude);
    CU_add_test(suite, "exponents", test_exponents);
    CU_add_test(suite, "extremes", test_extremes);
    CU_add_test(suite, "blocks double", test_blocks_double);
    CU_add_test(suite, "many at a time", test_many);
    CU_add_test(suite, "packs", test_packs);
    CU_add_test(suite, "intervals of the rate", test_intervals);
    CU_add_test(suite, "no values, values that are not finite", test_nothing_and_nonsense);
}
