/* test_drift.c - statistics of a quantity along a run, and their verdicts. */
#include <CUnit/CUnit.h>
#include <dalembert.h>
#include <math.h>
#include <string.h>

enum { ROWS = 1001 };

typedef double signal(double t);

static dal_drift drift_of(signal *x, double T)
{
    dal_drift drift;
    dal_drift_start(&drift, 1, 0.0, T);
    for (int k = 0; k < ROWS; k++) {
        const double t = T * k / (ROWS - 1), value = x(t);
        dal_drift_add(&drift, 1, t, &value);
    }
    dal_drift_finish(&drift, 1);
    return drift;
}

static double line(double t) { return 3.0 - 2.0 * t; }
static double high_line(double t) { return 1e9 + 1e-3 * t; }
static double constant(double t) { return (void)t, -7.0; }
static double noise(double t) { return 1.0 + 3e-13 * sin(1e4 * t); }
static double wave(double t) { return cos(2.0 * acos(-1.0) * t); }
static double one_wave(double t) { return sin(0.2 * acos(-1.0) * t); }
static double leaning_wave(double t) { return wave(t) + 2.0 * t; }
static double growing_wave(double t) { return t * wave(t); }
/* Jumps at once and then leans: the quarters are much alike, the line is not level. */
static double jump(double t) { return t == 0.0 ? 0.0 : 10.0 + 0.5 * t; }
static double growth(double t) { return exp(t); }
static double broken(double t) { return t < 5.0 ? t : NAN; }

static void test_line(void)
{
    const dal_drift d = drift_of(line, 10.0);
    CU_ASSERT_EQUAL(d.count, ROWS);
    CU_ASSERT_EQUAL(d.first, 3.0);
    CU_ASSERT_DOUBLE_EQUAL(d.last, -17.0, 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(d.greatest, 17.0, 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(d.deviation, 20.0, 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(d.rate, -2.0, 1e-13);
    CU_ASSERT(d.residue < 1e-6);
    for (int k = 0; k < 4; k++) CU_ASSERT_DOUBLE_EQUAL(d.quarter[k], 5.0 * (k + 1), 0.05);
}

/* The plain normal equations would lose all digits of this slope: 1e18 against 1e-3. */
static void test_slope_beside_a_large_value(void)
{
    CU_ASSERT_DOUBLE_EQUAL(drift_of(high_line, 10.0).rate, 1e-3, 1e-8);
}

/* Of sin(2 pi t/T) the slope is int (t - T/2) sin / int (t - T/2)^2 = -(T^2/2 pi) / (T^3/12). */
static void test_slope_of_a_wave(void)
{
    const double pi = acos(-1.0), T = 10.0;
    const dal_drift d = drift_of(one_wave, T);
    CU_ASSERT_DOUBLE_EQUAL(d.rate, -12.0 / (2.0 * pi * T), 1e-3);
    /* mean square 1/2, less rate^2 T^2/12 for the line */
    CU_ASSERT_DOUBLE_EQUAL(d.residue, sqrt(0.5 - 12.0 / (4.0 * pi * pi)), 1e-3);
}

static void test_verdicts(void)
{
    const struct {
        signal *x;
        double scale;
        dal_verdict verdict;
        const char *word;
    } cases[] = {
        {constant, 7.0, DAL_VERDICT_EXACT, "exact"},
        {noise, 1.0, DAL_VERDICT_ROUNDING, "rounding"},
        {noise, 1e-3, DAL_VERDICT_BOUNDED, "bounded"},
        {wave, 1.0, DAL_VERDICT_BOUNDED, "bounded"},
        {one_wave, 1.0, DAL_VERDICT_BOUNDED, "bounded"},
        {line, 1.0, DAL_VERDICT_DRIFTS, "drifts"},
        {line, 1e30, DAL_VERDICT_ROUNDING, "rounding"},
        {leaning_wave, 1.0, DAL_VERDICT_DRIFTS, "drifts"},
        {growing_wave, 1.0, DAL_VERDICT_DRIFTS, "drifts"},
        {growth, 1.0, DAL_VERDICT_DRIFTS, "drifts"},
        {jump, 1.0, DAL_VERDICT_DRIFTS, "drifts"},
        {broken, 1.0, DAL_VERDICT_LOST, "lost"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const dal_drift d = drift_of(cases[i].x, 10.0);
        const dal_verdict verdict = dal_drift_verdict(&d, cases[i].scale);
        CU_ASSERT_EQUAL(verdict, cases[i].verdict);
        CU_ASSERT_STRING_EQUAL(dal_verdict_text(verdict), cases[i].word);
    }
}

static void test_nothing_and_nonsense(void)
{
    dal_drift d[2];
    dal_drift_start(d, 2, 0.0, 1.0);
    CU_ASSERT_EQUAL(dal_drift_verdict(&d[0], 1.0), DAL_VERDICT_LOST);
    const double rows[][2] = {{1.0, 1.0}, {2.0, INFINITY}, {3.0, 1.0}};
    for (int k = 0; k < 3; k++) dal_drift_add(d, 2, 0.5 * k, rows[k]);
    dal_drift_finish(d, 2);
    CU_ASSERT_EQUAL(d[0].greatest, 3.0);
    CU_ASSERT_DOUBLE_EQUAL(d[0].rate, 2.0, 1e-14);
    /* What is not finite is counted nowhere but in the maxima. */
    CU_ASSERT(isinf(d[1].greatest) && isinf(d[1].deviation));
    CU_ASSERT_EQUAL(d[1].count, 2);
    CU_ASSERT_EQUAL(d[1].rate, 0.0);
}

void suite_drift(void)
{
    CU_pSuite suite = CU_add_suite("drift statistics", NULL, NULL);
    CU_add_test(suite, "a line", test_line);
    CU_add_test(suite, "a slope beside a large value", test_slope_beside_a_large_value);
    CU_add_test(suite, "the slope of a wave", test_slope_of_a_wave);
    CU_add_test(suite, "verdicts", test_verdicts);
    CU_add_test(suite, "no rows, values that are not finite", test_nothing_and_nonsense);
}
