/* test_ensemble.c - ensembles: draws against their distributions, members against single runs, the
 * transport of a covariance against its closed form, and statistics against brute force. */
#include "dalembert_program.h"
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { DRAWS = 100000, SEED = 20 };
static const double sigmas = 5.0; /* deviations of an estimate that pass */

static dal_variation parsed(const char *text)
{
    dal_variation v;
    CU_ASSERT_EQUAL(dal_variation_parse(&v, text, NULL), DAL_STATUS_OK);
    return v;
}

/* ---- draws ---- */

/* SplitMix64 as its authors print it: a generator with a state. */
static uint64_t next(uint64_t *state)
{
    uint64_t z = (*state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/* The published sequence of seed 1234567 checks that generator; FNV-1a of "a" is published, too. */
static void test_generator(void)
{
    uint64_t state = 1234567;
    CU_ASSERT_EQUAL(next(&state), 6457827717110365317u);
    CU_ASSERT_EQUAL(next(&state), 3203168211198807973u);
    state = 0xaf63dc4c8601ec8cu + (uint64_t)6 * 0x9e3779b97f4a7c15u;
    uint64_t key = next(&state); /* of seed 7: one more increment */
    CU_ASSERT_EQUAL(dal__random_key("a", 7), key);
    const dal_variation v = parsed("a=uniform(0,1)");
    for (int member = 0; member < 5; member++) {
        const double u = ((double)(next(&key) >> 11) + 0.5) / 9007199254740992.0;
        next(&key);
        CU_ASSERT_EQUAL(dal_variation_draw(&v, 7, (unsigned long long)member), u);
    }
}

/* Moments of count draws within some deviations of the distribution's: mean, variance, and
 * the fourth central moment, which the error of the variance follows from; and a probability. */
static void check_moments(const char *text, double mean, double variance, double fourth,
                          double below, double probability)
{
    const dal_variation v = parsed(text);
    double sum = 0.0, squares = 0.0;
    int count = 0;
    for (int i = 0; i < DRAWS; i++) {
        const double x = dal_variation_draw(&v, SEED, (unsigned long long)i);
        sum += x - mean;
        squares += (x - mean) * (x - mean);
        count += x < below;
    }
    const double n = DRAWS;
    CU_ASSERT_DOUBLE_EQUAL(sum / n, 0.0, sigmas * sqrt(variance / n));
    CU_ASSERT_DOUBLE_EQUAL(squares / n, variance,
                           sigmas * sqrt((fourth - variance * variance) / n));
    CU_ASSERT_DOUBLE_EQUAL(count / n, probability,
                           sigmas * sqrt(probability * (1.0 - probability) / n));
}

static void test_moments(void)
{
    check_moments("k = uniform(1, 2)", 1.5, 1.0 / 12.0, 1.0 / 80.0, 1.3, 0.3);
    check_moments("x'=normal(0.5,2)", 0.5, 4.0, 48.0, -1.5, 0.5 * erfc(sqrt(0.5)));
    check_moments("x=normal(0,1)", 0.0, 1.0, 3.0, -3.0, 0.5 * erfc(3.0 * sqrt(0.5)));
    /* exp of normal(m, s): moments exp(k m + k^2 s^2/2). */
    const double m = -0.2, s = 0.3, a = exp(m + s * s / 2), w = exp(s * s);
    check_moments("m=lognormal(-0.2,0.3)", a, a * a * (w - 1),
                  a * a * a * a * (w - 1) * (w - 1) *
                      (w * w * w * w + 2 * w * w * w + 3 * w * w - 3),
                  exp(m), 0.5);
}

static double correlation(const dal_variation *a, unsigned long long seed, const dal_variation *b,
                          unsigned long long other, int shift)
{
    double sum = 0.0;
    for (int i = 0; i < DRAWS; i++)
        sum += dal_variation_draw(a, seed, (unsigned long long)i) *
               dal_variation_draw(b, other, (unsigned long long)(i + shift));
    return sum / DRAWS;
}

/* Names, seeds and neighbours are independent: correlations of normal(0, 1) are below 5/sqrt(N). */
static void test_independence(void)
{
    const dal_variation x = parsed("x=normal(0,1)"), y = parsed("y=normal(0,1)");
    const double bound = sigmas / sqrt((double)DRAWS);
    CU_ASSERT_DOUBLE_EQUAL(correlation(&x, SEED, &y, SEED, 0), 0.0, bound);
    CU_ASSERT_DOUBLE_EQUAL(correlation(&x, SEED, &x, SEED + 1, 0), 0.0, bound);
    CU_ASSERT_DOUBLE_EQUAL(correlation(&x, SEED, &x, SEED, 1), 0.0, bound);
    CU_ASSERT_DOUBLE_EQUAL(correlation(&x, SEED, &x, SEED, 0), 1.0, sigmas * sqrt(2.0 / DRAWS));
}

/* ---- members ---- */

static dal_ensemble *make(const dal_run_spec *spec, const dal_variation *v, int count, int lanes)
{
    dal_ensemble *made = NULL;
    dal_error error = {0};
    CU_ASSERT_EQUAL_FATAL(dal_ensemble_create(&made, spec, v, count, SEED, lanes, &error),
                          DAL_STATUS_OK);
    return made;
}

/* A member has the bits of a run whose settings are the sums, in whatever chunk and lane it is. */
static void test_members(void)
{
    enum { COUNT = 13, DIMENSION = 6 };
    const dal_setting set = {"k", 0.5}, start = {"x", 0.25};
    dal_run_spec spec =
        fixture_spec(fixture_system("coordinates: [x, y, z]\nparameters: {k: 1}\n"
                                    "lagrangian: (x'^2 + y'^2 + z'^2)/2 - k*(x^2 + y^2)/2\n"
                                    "constraints: [z' - y*x']\nstart: {x': k, y: 0.1}\n"),
                     "gauss4", DAL_PHYSICAL, 0.02);
    spec.parameters = &set;
    spec.start = &start;
    spec.parameter_count = spec.start_count = 1;
    spec.options.consistent = 1;
    const dal_variation v[] = {parsed("x'=normal(0,0.1)"), parsed("k=uniform(1,2)"),
                               parsed("x=uniform(-1,1)")};
    double whole[COUNT][DIMENSION], piece[COUNT][DIMENSION], draws[COUNT][3];
    dal_ensemble *a = make(&spec, v, 3, COUNT), *b = make(&spec, v, 3, 5);
    CU_ASSERT_EQUAL(dal_ensemble_start(a, 0, COUNT), DAL_STATUS_OK);
    dal_batch_advance(dal_ensemble_batch(a), 60);
    dal_ensemble_states(a, whole[0]);
    dal_ensemble_draws(a, draws[0]);
    for (int first = 10; first >= 0; first -= 5) {
        const int count = first == 10 ? 3 : 5;
        CU_ASSERT_EQUAL(dal_ensemble_start(b, (unsigned long long)first, count), DAL_STATUS_OK);
        dal_batch_advance(dal_ensemble_batch(b), 20);
        dal_batch_advance(dal_ensemble_batch(b), 40);
        dal_ensemble_states(b, piece[first]);
    }
    CU_ASSERT_EQUAL(memcmp(whole, piece, sizeof whole), 0);
    for (int i = 0; i < COUNT; i++) {
        for (int k = 0; k < 3; k++)
            CU_ASSERT_EQUAL(draws[i][k], dal_variation_draw(&v[k], SEED, (unsigned long long)i));
        /* The start x' = k follows the member's own k. */
        const double k = 0.5 + draws[i][1];
        const dal_setting parameter = {"k", k};
        const dal_setting from[] = {{"x", 0.25 + draws[i][2]}, {"x'", k + draws[i][0]}};
        dal_run_spec single = spec;
        single.parameters = &parameter;
        single.start = from;
        single.start_count = 2;
        dal_run *run = fixture_stepped(&single, 60);
        CU_ASSERT_EQUAL(memcmp(dal_run_state(run), whole[i], sizeof whole[i]), 0);
        dal_run_free(run);
    }
    dal_ensemble_free(a);
    dal_ensemble_free(b);
}

/* x'' = -x turns (x, x'): the covariance of a sample becomes R S R^T, and its mean R m. */
static void test_covariance(void)
{
    enum { COUNT = 500 };
    const dal_run_spec spec = fixture_spec(
        fixture_system("coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x: 1}\n"), "gauss8",
        DAL_PHYSICAL, 0.05);
    const dal_variation v[] = {parsed("x=normal(0,0.3)"), parsed("x'=uniform(-0.2,0.1)")};
    dal_ensemble *e = make(&spec, v, 2, COUNT);
    double states[2 * COUNT], before[4] = {0}, after[4] = {0}, mean[2][2] = {{0}};
    for (int time = 0; time < 2; time++) {
        if (time == 0) CU_ASSERT_EQUAL(dal_ensemble_start(e, 0, COUNT), DAL_STATUS_OK);
        if (time == 1) dal_batch_advance(dal_ensemble_batch(e), 46); /* t = 2.3 */
        dal_ensemble_states(e, states);
        for (int i = 0; i < 2 * COUNT; i++) mean[time][i % 2] += states[i] / COUNT;
        CU_ASSERT_EQUAL(dal__add_products(2, mean[time], states, COUNT, time ? after : before),
                        COUNT);
    }
    const double c = cos(2.3), s = sin(2.3), R[4] = {c, s, -s, c};
    for (int i = 0; i < 2; i++) {
        const double turned = R[2 * i] * mean[0][0] + R[2 * i + 1] * mean[0][1];
        CU_ASSERT_DOUBLE_EQUAL(mean[1][i], turned, 1e-9);
        for (int j = 0; j < 2; j++) {
            double sum = 0.0;
            for (int k = 0; k < 4; k++) sum += R[2 * i + k / 2] * before[k] * R[2 * j + k % 2];
            CU_ASSERT_DOUBLE_EQUAL(after[2 * i + j] / COUNT, sum / COUNT, 1e-9);
        }
    }
    dal_ensemble_free(e);
}

/* Members without a start, or that fail on the way, are NaN and have their reason. */
static void test_failures(void)
{
    enum { COUNT = 40 };
    dal_run_spec spec =
        fixture_spec(fixture_system("coordinates: [x]\nparameters: {s: 1}\nlagrangian: x'^2/2\n"
                                    "forces: {x: -s*sqrt(x)}\nstart: {x: 1}\n"),
                     "rk4", DAL_PHYSICAL, 0.01);
    const dal_variation fast = parsed("s=uniform(-1,99)");
    dal_ensemble *e = make(&spec, &fast, 1, COUNT);
    double states[2 * COUNT], draws[COUNT];
    CU_ASSERT_EQUAL(dal_ensemble_start(e, 0, COUNT), DAL_STATUS_OK);
    dal_batch_advance(dal_ensemble_batch(e), 100);
    dal_ensemble_states(e, states);
    dal_ensemble_draws(e, draws);
    int failed = 0;
    /* x(1) > 0 where s <= 2: the force is at most s. */
    for (int i = 0; i < COUNT; i++) {
        const bool is_lost = isnan(states[2 * i]) && isnan(states[2 * i + 1]);
        const dal_status status = dal_batch_status(dal_ensemble_batch(e), i, NULL);
        CU_ASSERT_EQUAL(status, is_lost ? DAL_STATUS_NOT_FINITE : DAL_STATUS_OK);
        CU_ASSERT(1.0 + draws[i] > 2.0 || !is_lost);
        failed += is_lost;
    }
    CU_ASSERT(failed > COUNT / 2 && failed < COUNT);
    dal_ensemble_free(e);
    spec = fixture_spec(fixture_system("chaplygin-sleigh"), "rk4", DAL_PHYSICAL, 0.01);
    const dal_variation across = parsed("y2'=uniform(0.5,1)");
    e = make(&spec, &across, 1, 3);
    CU_ASSERT_EQUAL(dal_ensemble_start(e, 0, 3), DAL_STATUS_OK);
    for (int i = 0; i < 3; i++)
        CU_ASSERT_EQUAL(dal_batch_status(dal_ensemble_batch(e), i, NULL), DAL_STATUS_INCONSISTENT);
    CU_ASSERT_EQUAL(dal_ensemble_start(e, 0, 4), DAL_STATUS_ARGUMENT);
    dal_ensemble_free(e);
}

/* ---- errors ---- */

static void check_refused(const char *text, dal_status status, const char *fragment)
{
    dal_variation v;
    dal_error error = {0};
    CU_ASSERT_EQUAL(dal_variation_parse(&v, text, &error), status);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, fragment));
}

static void test_errors(void)
{
    check_refused("", DAL_STATUS_SYNTAX, "is not NAME=DISTRIBUTION(A,B)");
    check_refused("x=normal(0,1", DAL_STATUS_SYNTAX, "is not NAME=DISTRIBUTION(A,B)");
    check_refused("x=normal(0)", DAL_STATUS_SYNTAX, "is not NAME=DISTRIBUTION(A,B)");
    check_refused("x=normal(0,1)2", DAL_STATUS_SYNTAX, "is not NAME=DISTRIBUTION(A,B)");
    check_refused("=normal(0,1)", DAL_STATUS_SYNTAX, "does not begin with a name");
    check_refused("x=norml(0,1)", DAL_STATUS_NAME, "'norml', not one of uniform normal lognormal");
    check_refused("x=normal(p,1)", DAL_STATUS_SYNTAX, "'p' is not a number");
    check_refused("x=normal(0,q)", DAL_STATUS_SYNTAX, "'q' is not a number");
    check_refused("x=normal(0,-1)", DAL_STATUS_ARGUMENT,
                  "x: the standard deviation -1 is negative");
    check_refused("x=uniform(2,1)", DAL_STATUS_ARGUMENT, "x: uniform needs LOW < HIGH");
    check_refused("x=uniform(1,1)", DAL_STATUS_ARGUMENT, "x: uniform needs LOW < HIGH");
    const dal_run_spec spec =
        fixture_spec(fixture_system("chaplygin-sleigh"), "rk4", DAL_PHYSICAL, 0.01);
    const dal_variation unknown = parsed("y1''=normal(0,1)");
    const dal_variation twice[] = {parsed("y1=normal(0,1)"), parsed("y1=uniform(0,1)")};
    dal_ensemble *e;
    dal_error error = {0};
    CU_ASSERT_EQUAL(dal_ensemble_create(&e, &spec, &unknown, 1, 0, 8, &error), DAL_STATUS_NAME);
    CU_ASSERT_PTR_NULL(e);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "unknown start value or parameter 'y1'''"));
    CU_ASSERT_EQUAL(dal_ensemble_create(&e, &spec, twice, 2, 0, 8, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "y1 is varied twice"));
    CU_ASSERT_EQUAL(dal_ensemble_create(&e, &spec, twice, 1, 0, 0, &error), DAL_STATUS_ARGUMENT);
    /* What a caller wrote and nothing has parsed. */
    const dal_variation wrong[] = {{"y1", DAL_NORMAL, 0.0, -1.0},
                                   {"y1", DAL_UNIFORM, 2.0, 1.0},
                                   {"y1", DAL_NORMAL, NAN, 1.0},
                                   {"y1", DAL_UNIFORM, 0.0, INFINITY}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        CU_ASSERT_EQUAL(dal_ensemble_create(&e, &spec, &wrong[i], 1, 0, 8, &error),
                        DAL_STATUS_ARGUMENT);
}

/* ---- statistics ---- */

static int compare_numbers(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Against the definition, on sorted copies: with and without equal values, of all small counts. */
static void test_quantiles(void)
{
    enum { MAX = 60 };
    static const double p[] = {0.5, 0.0, 0.05, 1.0, 0.25, 0.975, 0.75};
    const dal_variation v = parsed("x=normal(0,3)");
    for (int count = 1; count <= MAX; count++) {
        double values[MAX], sorted[MAX], quantile[7], mean = 0.0, squares = 0.0;
        for (int i = 0; i < count; i++) {
            values[i] = dal_variation_draw(&v, (unsigned)count, (unsigned)i);
            if (count % 3 == 0) values[i] = floor(values[i]);
            mean += values[i] / count;
        }
        for (int i = 0; i < count; i++) squares += pow(values[i] - mean, 2);
        memcpy(sorted, values, sizeof values);
        qsort(sorted, (size_t)count, sizeof *sorted, compare_numbers);
        dal_spread spread;
        dal_spread_measure(&spread, values, count);
        CU_ASSERT_EQUAL(spread.count, count);
        CU_ASSERT_EQUAL(spread.min, sorted[0]);
        CU_ASSERT_EQUAL(spread.max, sorted[count - 1]);
        CU_ASSERT_DOUBLE_EQUAL(spread.mean, mean, 1e-13);
        const double deviation = sqrt(squares / (count - 1));
        CU_ASSERT(count > 1 ? fabs(spread.deviation - deviation) < 1e-13 : isnan(spread.deviation));
        dal_measure_quantiles(values, count, p, 7, quantile);
        for (int i = 0; i < 7; i++) {
            const double place = p[i] * (count - 1);
            const int low = (int)floor(place), high = low + 1 < count ? low + 1 : low;
            CU_ASSERT_EQUAL(quantile[i],
                            sorted[low] + (place - low) * (sorted[high] - sorted[low]));
        }
    }
}

/* A mean of values that nearly cancel keeps its digits. */
static void test_spread(void)
{
    double values[1000];
    dal_spread spread;
    for (int i = 0; i < 1000; i++) values[i] = 1e8 + (i % 2 ? 1.0 : -1.0);
    dal_spread_measure(&spread, values, 1000);
    CU_ASSERT_DOUBLE_EQUAL(spread.mean, 1e8, 1e-8);
    CU_ASSERT_DOUBLE_EQUAL(spread.deviation, sqrt(1000.0 / 999.0), 1e-12);
    /* The sum is beyond 2^53 and rounds each summand to a multiple of 8 or 16; the mean is right to
     * its own last place, 2^-6. */
    for (int i = 0; i < 999; i++) values[i] = 1e14 + 5.0 * (i % 3 == 0);
    dal_spread_measure(&spread, values, 999);
    CU_ASSERT_DOUBLE_EQUAL(spread.mean - 1e14, 5.0 / 3.0, 0x1p-5);
}

void suite_ensemble(void)
{
    CU_pSuite suite = CU_add_suite("ensembles", NULL, NULL);
    CU_add_test(suite, "the generator against published numbers", test_generator);
    CU_add_test(suite, "moments of the distributions", test_moments);
    CU_add_test(suite, "names, seeds and members are independent", test_independence);
    CU_add_test(suite, "members have the bits of single runs", test_members);
    CU_add_test(suite, "the covariance of an oscillator", test_covariance);
    CU_add_test(suite, "members that fail", test_failures);
    CU_add_test(suite, "errors", test_errors);
    CU_add_test(suite, "quantiles by sorting", test_quantiles);
    CU_add_test(suite, "the mean of large values", test_spread);
}
