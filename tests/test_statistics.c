/* test_statistics.c - what is kept of a quantity along a run, against closed forms. */
#include "quick.h"
#include "statistics/statistics.h"
#include <CUnit/CUnit.h>
#include <float.h>
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

static dal_trend trend_of_signal(signal *x, double T)
{
    const dal_statistics s = statistics_of(x, T, VALUES);
    dal_trend f;
    dal_statistics_classify(&s, 1.0, DAL_STATUS_OK, &f);
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
    const dal_trend f = trend_of_signal(line, 10.0);
    CU_ASSERT_EQUAL(f.first, 3.0);
    CU_ASSERT_DOUBLE_EQUAL(f.last, -17.0, 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(f.max_abs, 17.0, 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(f.deviation, 20.0, 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(f.rate, -2.0, 1e-13);
    CU_ASSERT(f.rate_low <= -2.0 + 1e-13 && f.rate_high >= -2.0 - 1e-13);
    CU_ASSERT_DOUBLE_EQUAL(f.rate_high - f.rate_low, 0.0, 1e-12);
    CU_ASSERT_EQUAL(f.exponent, 1.0);
}

/* Plain normal equations would lose all digits of this slope: 1e18 against 1e-3. */
static void test_slope_beside_a_large_value(void)
{
    CU_ASSERT_DOUBLE_EQUAL(trend_of_signal(high_line, 10.0).rate, 1e-3, 1e-8);
}

/* One period in all the time may be a drift or none: the interval holds 0. */
static void test_slope_of_a_wave(void)
{
    const dal_trend f = trend_of_signal(one_wave, 10.0);
    CU_ASSERT(f.rate_low < 0.0 && f.rate_high > 0.0);
    CU_ASSERT_EQUAL(f.max_drift, 10.0 * fmax(-f.rate_low, f.rate_high));
}

static void test_amplitude(void)
{
    const dal_trend f = trend_of_signal(leaning_wave, 10.0);
    CU_ASSERT_DOUBLE_EQUAL(f.amplitude, 1.0, 0.02);
    CU_ASSERT_DOUBLE_EQUAL(f.rate, 2.0, 0.01);
}

static void test_exponents(void)
{
    CU_ASSERT_DOUBLE_EQUAL(trend_of_signal(square_root, 10.0).exponent, 0.5, 0.01);
    CU_ASSERT_DOUBLE_EQUAL(trend_of_signal(cube, 10.0).exponent, 3.0, 0.03);
    CU_ASSERT_DOUBLE_EQUAL(trend_of_signal(cube, 10.0).deviation, 1000.0, 1e-9);
}

/* Extremes count wherever they fall: in the first value, in a full block, in the open one, where
 * the last three of 203 are. */
static void test_extremes(void)
{
    for (int place = 0; place < 203; place++)
        for (int sign = -1; sign <= 1; sign += 2) {
            dal_statistics s;
            dal_statistics_start(&s, 1);
            for (int k = 0; k < 203; k++) {
                const double x = sign * (k == place ? 7.0 : -1.0);
                dal_statistics_add(&s, 1, k, &x);
            }
            CU_ASSERT(s.open_count == 3);
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
        CU_ASSERT_FATAL(s.length == 1 || s.blocks >= DAL_STATISTICS_BLOCKS / 2);
    }
    for (long long i = 0; i < s.blocks; i++) {
        const double first = (double)(i * s.length),
                     middle = first + 0.5 * ((double)s.length - 1.0);
        CU_ASSERT_EQUAL(s.block[i].x, middle);
        CU_ASSERT_EQUAL(s.block[i].t, 0.5 * middle);
        CU_ASSERT_EQUAL(s.block[i].min, first);
        CU_ASSERT_EQUAL(s.block[i].max, first + (double)s.length - 1.0);
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

enum { QUANTITIES = 3, SAMPLES = 5000, STRIDE = SAMPLES + 3 };

/* Noise beside a value, a line, and noise in which now and then a value is none. */
static void fill_samples(double *t, double *x)
{
    uint64_t state = 7;
    for (int k = 0; k < SAMPLES; k++) {
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
    static double t[SAMPLES], x[QUANTITIES * STRIDE];
    static const int portions[] = {1, 5, 8, 64, 300, SAMPLES};
    dal_statistics one[QUANTITIES], many[QUANTITIES];
    fill_samples(t, x);
    dal_statistics_start(one, QUANTITIES);
    for (int k = 0; k < SAMPLES; k++) {
        const double values[] = {x[k], x[STRIDE + k], x[2 * STRIDE + k]};
        dal_statistics_add(one, QUANTITIES, t[k], values);
    }
    CU_ASSERT(one[2].lost && one[2].count < SAMPLES && one[1].count == SAMPLES);
    for (size_t i = 0; i < sizeof portions / sizeof portions[0]; i++) {
        uint64_t state = i;
        dal_statistics_start(many, QUANTITIES);
        for (int k = 0, portion; k < SAMPLES; k += portion) {
            portion = (int)(portions[i] * 0.5 * (1.0 + fabs(chance(&state)))) + 1;
            portion = portion < SAMPLES - k ? portion : SAMPLES - k;
            dal_statistics_add_many(many, QUANTITIES, portion, t + k, x + k, STRIDE);
        }
        CU_ASSERT(memcmp(one, many, sizeof one) == 0);
    }
}

/* Packs of every variant: the parts of the sum, the squares of x_(k+8) - x_k in the first two packs
 * of a cycle, and a tally left alone by what is not finite. */
static void test_packs(void)
{
    typedef bool tally_packs(dal__tally *, double, int, int, const double *);
    static const struct {
        dal__instructions set;
        tally_packs *add;
    } variants[] = {{DAL__BASE, dal__tally_packs_x1},
#define X(name, variant, lanes, set) {DAL__##set, name##_##variant},
                    DAL__VARIANT_LIST(X, dal__tally_packs)
#undef X
    };
    double x[7 * DAL_PARTIAL_SUMS];
    for (int k = 0; k < 7 * DAL_PARTIAL_SUMS; k++) x[k] = k * k;
    for (size_t i = 0; i < sizeof variants / sizeof variants[0]; i++) {
        if (!dal__machine_has(variants[i].set)) continue;
        double sum[DAL_PARTIAL_SUMS] = {1.0}, rough[DAL_PARTIAL_SUMS] = {0},
               held[DAL_PARTIAL_SUMS] = {0}, square[DAL_PARTIAL_SUMS] = {0};
        double before[4][DAL_PARTIAL_SUMS];
        dal__tally tally = {sum, 5.0, 5.0, rough, held, 0.5, square, 3.0};
        CU_ASSERT(variants[i].add(&tally, 2.0, 3, 3, x));
        CU_ASSERT(tally.min == 0.0 && tally.max == 529.0);
        for (int k = 0; k < DAL_PARTIAL_SUMS; k++) {
            /* k^2 + (k + 8)^2 + (k + 16)^2 - 3 * 2; ((k + 16)^2 - (k + 8)^2)^2/4 */
            CU_ASSERT_EQUAL(sum[k], 3 * k * k + 48 * k + 320 - 6 + (k == 0));
            CU_ASSERT_EQUAL(rough[k], (8 * k + 96) * (8 * k + 96));
            CU_ASSERT_EQUAL(held[k], (k + 8) * (k + 8));
            double expected = 0.0; /* of integers and quarters: exact */
            for (int j = k; j < 3 * DAL_PARTIAL_SUMS; j += DAL_PARTIAL_SUMS)
                expected += 0.25 * (j * j - 3.0) * (j * j - 3.0);
            CU_ASSERT_EQUAL(square[k], expected);
        }
        const dal__tally tally_before = tally;
        memcpy(before[0], sum, sizeof sum);
        memcpy(before[1], rough, sizeof rough);
        memcpy(before[2], held, sizeof held);
        memcpy(before[3], square, sizeof square);
        static const double bad[] = {NAN, -INFINITY, 1e300, -1e300};
        x[11] = bad[i % 4];
        CU_ASSERT(!variants[i].add(&tally, 2.0, 2, 7, x));
        CU_ASSERT(memcmp(&tally, &tally_before, sizeof tally) == 0);
        CU_ASSERT(memcmp(sum, before[0], sizeof sum) == 0);
        CU_ASSERT(memcmp(rough, before[1], sizeof rough) == 0);
        CU_ASSERT(memcmp(held, before[2], sizeof held) == 0);
        CU_ASSERT(memcmp(square, before[3], sizeof square) == 0);
        x[11] = 121.0;
    }
}

/* ---- root mean squares ---- */

static double wavy(int k) { return 3.0 + sin(0.7 * k) + (k == 500 ? 40.0 : 0.0); }
static double straight(int k) { return 2.0 - 0.25 * k; }
static double enormous(int k) { return 0x1p1000 * (1.0 + 0.5 * sin(0.7 * k)); }

/* The root mean square of values from .. from + n - 1 about their mean. */
static double root_mean_square(double (*x)(int), int from, int n)
{
    double mean = 0.0, square = 0.0;
    for (int k = from; k < from + n; k++) mean += x(k) / n;
    for (int k = from; k < from + n; k++) {
        const double d = (x(k) - mean) * 0x1p-500;
        square += d * d / n;
    }
    return 0x1p500 * sqrt(square);
}

static void check_root_mean_squares(double (*of)(int), int count)
{
    dal_statistics s;
    dal_statistics_start(&s, 1);
    for (int k = 0; k < count; k++) {
        const double x = of(k);
        dal_statistics_add(&s, 1, k, &x);
    }
    /* A sum of terms of the size of x^2, of which the root is taken. */
    const double error = 16.0 * DBL_EPSILON * fmax(fabs(s.min), fabs(s.max));
    const int n = (int)s.length;
    for (int b = 0; b < s.blocks; b++) {
        const double rms = root_mean_square(of, b * n, n);
        CU_ASSERT_DOUBLE_EQUAL(s.block[b].rms / s.factor, rms, error);
        if (of == straight) CU_ASSERT_DOUBLE_EQUAL(rms, 0.25 * sqrt((n * n - 1.0) / 12.0), error);
    }
}

/* Of each block as by its definition, however often blocks were merged. */
static void test_root_mean_squares(void)
{
    static double (*const signals[])(int) = {wavy, straight, enormous};
    static const int counts[] = {40, 500, 3000, 20000};
    for (size_t i = 0; i < sizeof signals / sizeof signals[0]; i++)
        for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++)
            check_root_mean_squares(signals[i], counts[c]);
}

/* ---- roughness ---- */

/* Of a random walk of n steps it is sqrt(n) sigma, of a line of n steps, sampled 8 apart, sqrt(8/n)
 * of its rise: whatever was merged. */
static void test_roughness(void)
{
    static const int counts[] = {500, 1000, 3000, 100000};
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        uint64_t state = 3;
        dal_statistics walk, line;
        double level = 0.0;
        dal_statistics_start(&walk, 1);
        dal_statistics_start(&line, 1);
        for (int k = 0; k <= counts[i]; k++) {
            const double rise = 1e-200 * k;
            dal_statistics_add(&walk, 1, k, &level);
            dal_statistics_add(&line, 1, k, &rise);
            level += 1e200 * chance(&state); /* of variance 1/3 */
        }
        const double n = counts[i], of_walk = dal__roughness(&walk),
                     of_line = dal__roughness(&line);
        CU_ASSERT_DOUBLE_EQUAL(of_walk / (1e200 * sqrt(n / 3.0)), 1.0, 4.0 / sqrt(n));
        CU_ASSERT(of_line < 1.01e-200 * sqrt(8.0 * n) && of_line > 0.99e-200 * sqrt(n));
    }
}

/* ---- numbers near the largest ---- */

/* Sums of numbers beyond 2^900 are kept with a factor: the means are theirs all the same. */
static void test_large_numbers(void)
{
    dal_statistics s;
    dal_statistics_block block[DAL_STATISTICS_BLOCKS];
    dal_statistics_start(&s, 1);
    for (int k = 0; k < 4096; k++) {
        const double x = k < 1000 ? 1.0 : k % 2 ? 1e308 : -1e308;
        dal_statistics_add(&s, 1, k, &x);
    }
    CU_ASSERT_EQUAL(dal__statistics_blocks(&s, block), 32);
    CU_ASSERT(s.factor < 1.0);
    CU_ASSERT_EQUAL(block[0].x, 0.0);
    CU_ASSERT(fabs(block[31].x) < 1e292);
    CU_ASSERT(block[31].min == -1e308 - 1.0 && block[31].max == 1e308 - 1.0);
    CU_ASSERT_EQUAL(dal_statistics_max_abs(&s), 1e308);
}

/* ---- the interval of the rate ---- */

enum { NOISY_VALUES = 2000 };
static int intervals(void) { return 1000 / case_stride(5); }

typedef struct cover {
    int hold, narrow; /* intervals that hold the slope; that are narrower than some width */
} cover;

/* Of 1000 series, 200 in a quick run, of noise with a memory of 1/(1 - memory) values about a line
 * of slope 1. */
static cover cover_of(double memory, double half_width)
{
    cover c = {0};
    uint64_t state = 11;
    for (int i = 0; i < intervals(); i++) {
        dal_statistics s;
        dal_trend f;
        double noise = 0.0;
        dal_statistics_start(&s, 1);
        for (int k = 0; k < NOISY_VALUES; k++) {
            noise = memory * noise + chance(&state);
            const double x = 0.001 * k + noise;
            dal_statistics_add(&s, 1, 0.001 * k, &x);
        }
        dal_statistics_classify(&s, 1e9, DAL_STATUS_OK, &f); /* roundings do not matter here */
        c.hold += f.rate_low <= 1.0 && f.rate_high >= 1.0;
        c.narrow += f.rate_high - f.rate_low < 2.0 * half_width;
    }
    return c;
}

/* 93 % are promised to hold it.  The slope of least squares of n white values of variance 1/3 over
 * a time T has a deviation sqrt(4/n)/T; with memory, 1/(1 - memory) times as much.  Half of the
 * intervals, which allow for memory and walks, are no wider than six times those that know the
 * noise; none is much narrower. */
static void test_intervals(void)
{
    const double white = 1.96 * sqrt(4.0 / NOISY_VALUES) / (0.001 * NOISY_VALUES);
    const cover none = cover_of(0.0, 6.0 * white), some = cover_of(0.9, 60.0 * white);
    const int promised = intervals() / 100 * 93;
    CU_ASSERT(none.hold >= promised && none.narrow >= intervals() / 2);
    CU_ASSERT(some.hold >= promised && some.narrow >= intervals() / 2);
    CU_ASSERT(cover_of(0.99, 1.0).hold >= promised);
    CU_ASSERT(cover_of(0.0, 0.8 * white).narrow < intervals() / 20);
}

/* Tables: the 97.5 % quantile of Student's distribution. */
static void test_student(void)
{
    static const struct {
        double freedom, quantile;
    } cases[] = {{3, 3.182446}, {5, 2.570582}, {10, 2.228139}, {30, 2.042272}, {1e9, 1.959964}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        CU_ASSERT_DOUBLE_EQUAL(dal__student(cases[i].freedom), cases[i].quantile,
                               0.01 * cases[i].quantile);
    /* No neighbour leans on another: n are worth n.  With a correlation of 1/3, half of them. */
    CU_ASSERT_DOUBLE_EQUAL(dal__inflation(8.0, -4.0, 8), 1.0, 1e-15);
    CU_ASSERT_DOUBLE_EQUAL(dal__inflation(12.0, 1.0, 8), 2.0, 1e-15);
}

/* Seven values 1, -1, 1, .. about the line of slope 0: S_tt = 28, the squares of the residues are
 * 7 - 1/7, five degrees of freedom. */
static void test_few_values(void)
{
    dal_statistics s;
    dal_trend f;
    dal_statistics_start(&s, 1);
    for (int k = 0; k < 7; k++) {
        const double x = k % 2 ? -1.0 : 1.0;
        dal_statistics_add(&s, 1, k, &x);
    }
    dal_statistics_classify(&s, 1.0, DAL_STATUS_OK, &f);
    CU_ASSERT_DOUBLE_EQUAL(f.rate, 0.0, 1e-15);
    const double margin = 2.570582 * sqrt(48.0 / 7.0 / 5.0 / 28.0);
    CU_ASSERT_DOUBLE_EQUAL(f.rate_high, margin, 0.01 * margin);
    CU_ASSERT_EQUAL(f.trend, DAL_TREND_UNDECIDED);
}

/* ---- nothing and nonsense ---- */

static dal_trend_class trend_of(const dal_statistics *s)
{
    dal_trend f;
    dal_statistics_classify(s, 1.0, DAL_STATUS_OK, &f);
    CU_ASSERT(f.trend < DAL_TREND_UNDECIDED ? f.confidence > 0.0 && f.confidence <= 1.0
                                            : isnan(f.confidence));
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
    dal_statistics_classify(&s[0], 1.0, DAL_STATUS_OK, &f);
    CU_ASSERT_DOUBLE_EQUAL(f.rate, 2.0, 1e-14);
    CU_ASSERT_EQUAL(f.trend, DAL_TREND_UNDECIDED);
    /* What is not finite is counted nowhere but in the maxima. */
    CU_ASSERT(isinf(dal_statistics_max_abs(&s[1])) && isinf(dal_statistics_deviation(&s[1])));
    CU_ASSERT_EQUAL(s[1].count, 2);
    CU_ASSERT_EQUAL(trend_of(&s[1]), DAL_TREND_ABORTED);
    dal_statistics_classify(&s[0], 1.0, DAL_STATUS_STOPPED, &f);
    CU_ASSERT_EQUAL(f.trend, DAL_TREND_UNDECIDED);
    dal_statistics_classify(&s[0], 1.0, DAL_STATUS_SINGULAR, &f);
    CU_ASSERT_EQUAL(f.trend, DAL_TREND_ABORTED);
}

static double parabola(double t) { return 5.0 - t + 0.25 * t * t; }

/* The line of least squares of a parabola has its slope in the middle: of 32 blocks, the middles
 * of the first and the last quarter are 24 blocks apart. */
static void test_rates_of_quarters(void)
{
    const double block = 8.0 * 32.0 / (VALUES - 1);
    dal_statistics s = statistics_of(parabola, 8.0, VALUES);
    CU_ASSERT_DOUBLE_EQUAL(dal_statistics_rate_range(&s), 0.5 * 24.0 * block, 1e-12);
    s = statistics_of(line, 8.0, VALUES);
    CU_ASSERT_DOUBLE_EQUAL(dal_statistics_rate_range(&s), 0.0, 1e-12);
    s = statistics_of(line, 8.0, 15);
    CU_ASSERT(isnan(dal_statistics_rate_range(&s)));
    s = statistics_of(line, 8.0, 16);
    CU_ASSERT_DOUBLE_EQUAL(dal_statistics_rate_range(&s), 0.0, 1e-12);
    dal_statistics_add(&s, 1, 9.0, &(double){NAN});
    CU_ASSERT(isnan(dal_statistics_rate_range(&s)));
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
    CU_add_test(suite, "root mean squares", test_root_mean_squares);
    CU_add_test(suite, "roughness", test_roughness);
    CU_add_test(suite, "numbers near the largest", test_large_numbers);
    CU_add_test(suite, "intervals of the rate", test_intervals);
    CU_add_test(suite, "rates of quarters", test_rates_of_quarters);
    CU_add_test(suite, "Student's quantiles", test_student);
    CU_add_test(suite, "few values", test_few_values);
    CU_add_test(suite, "no values, values that are not finite", test_nothing_and_nonsense);
}
