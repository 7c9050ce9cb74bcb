/* test_mean.c - means with intervals. */
#include <CUnit/CUnit.h>
#include <dalembert.h>
#include <dalembert_analysis.h>
#include <math.h>

static double noise(unsigned *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) / (1 << 24) - 0.5;
}

static void test_mean(void)
{
    dal_statistics s;
    dal_average a;
    double x = 0.1;
    dal_statistics_start(&s, 1);
    dal_statistics_mean(&s, &a);
    CU_ASSERT(isnan(a.mean));
    for (int i = 0; i < 1000; i++) dal_statistics_add(&s, 1, i, &x);
    dal_statistics_mean(&s, &a);
    CU_ASSERT_EQUAL(a.mean, 0.1);
    CU_ASSERT(a.low == 0.1 && a.high == 0.1);
    /* 1, 2, .., 1003: the open block counts too. */
    dal_statistics_start(&s, 1);
    for (int i = 1; i <= 1003; i++) dal_statistics_add(&s, 1, i, &(double){i});
    dal_statistics_mean(&s, &a);
    CU_ASSERT_DOUBLE_EQUAL(a.mean, 502.0, 1e-11);
    CU_ASSERT_DOUBLE_EQUAL(a.high - a.mean, a.mean - a.low, 1e-11);
    x = INFINITY;
    dal_statistics_add(&s, 1, 1004.0, &x);
    dal_statistics_mean(&s, &a);
    CU_ASSERT(isnan(a.mean));
}

/* x_i = r x_(i-1) + noise about 3: how often the interval holds 3. */
static int covered(double r, int trials)
{
    unsigned state = 7;
    int inside = 0;
    for (int k = 0; k < trials; k++) {
        dal_statistics s;
        dal_average a;
        double x = 0.0;
        dal_statistics_start(&s, 1);
        for (int i = -50; i < 4000; i++) {
            x = r * x + noise(&state);
            if (i >= 0) dal_statistics_add(&s, 1, i, &(double){3.0 + x});
        }
        dal_statistics_mean(&s, &a);
        inside += a.low <= 3.0 && 3.0 <= a.high;
    }
    return inside;
}

/* 95 % of 400 is 380, its deviation 4.4. */
static void test_mean_coverage(void)
{
    const int white = covered(0.0, 400), coloured = covered(0.98, 400);
    CU_ASSERT(white >= 365 && white < 400);
    CU_ASSERT(coloured >= 365 && coloured < 400);
}

void suite_mean(void)
{
    CU_pSuite suite = CU_add_suite("means", NULL, NULL);
    CU_add_test(suite, "mean", test_mean);
    CU_add_test(suite, "mean: how often the interval holds it", test_mean_coverage);
}
