/* test_start.c - the tolerances of a start: how far it may violate a constraint, how dependent two
 * constraints may be, how far from an exact solution it may begin.  Each from both sides. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <stdio.h>

/* The status of a run of a text with its start overridden. */
static dal_status status_of(const char *text, const dal_setting *start, int count)
{
    dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.1);
    dal_run *run = NULL;
    spec.start = start;
    spec.start_count = count;
    const dal_status status = dal_run_create(&run, &spec, NULL);
    dal_run_free(run);
    return status;
}

/* |D| <= 1e-10 |A|_1 |v|_max: D = s (3 x' + y') at x' = w, y' = -3 w + d. */
static dal_status inconsistent(double s, double w, double relative)
{
    char text[256];
    snprintf(text, sizeof text,
             "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\nconstraints: [%g*(3*x' + y')]\n",
             s);
    const dal_setting start[] = {{"x'", w}, {"y'", -3.0 * w + relative * 4.0 * 3.0 * w}};
    return status_of(text, start, 2);
}

static void test_consistent(void)
{
    static const double scale[] = {1.0, 1e6, 1e-6}, speed[] = {1.0, 1e5, 1e-5};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int sign = -1; sign <= 1; sign += 2) {
                CU_ASSERT_EQUAL(inconsistent(scale[i], speed[j], sign * 0.9e-10), DAL_OK);
                CU_ASSERT_EQUAL(inconsistent(scale[i], speed[j], sign * 1.1e-10), DAL_INCONSISTENT);
            }
}

/* D1 = x' - y', D2 = x' - (1 + s) y' with unit masses: the second pivot of G is s^2/2 and its
 * diagonal entry 2 + 2 s + s^2, so that the pivot is s^2/4 (1 - s ...) of it; 1e-12 at s = 2e-6. */
static dal_status rank(double s)
{
    char text[256];
    snprintf(text, sizeof text,
             "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n"
             "parameters: {s: %.17g}\nconstraints: [x' - y', x' - (1 + s)*y']\n",
             s);
    const dal_setting start = {"z'", 1.0};
    return status_of(text, &start, 1);
}

static void test_rank(void)
{
    CU_ASSERT_EQUAL(rank(2.1e-6), DAL_OK);
    CU_ASSERT_EQUAL(rank(1.9e-6), DAL_RANK);
    CU_ASSERT_EQUAL(rank(-2.1e-6), DAL_OK);
    CU_ASSERT_EQUAL(rank(-1.9e-6), DAL_RANK);
}

/* x = 2 exp(-t): the error is observed where |x - 2|, |x' + 2| <= 1e-10 (1 + 2). */
static int observables(const char *name, double off)
{
    dal_run_spec spec =
        fixture_spec(fixture_system("coordinates: [x]\naccelerations: {x: x}\n"
                                    "start: {x: 2, x': -2}\nexact: {x: 2*exp(-t)}\n"),
                     "rk4", DAL_PHYSICAL, 0.1);
    const dal_setting start = {name, (name[1] ? -2.0 : 2.0) + off};
    spec.start = &start;
    spec.start_count = 1;
    dal_run *run = fixture_run(&spec);
    const int count = dal_run_observables(run);
    dal_run_free(run);
    return count;
}

static void test_exact(void)
{
    static const char *const names[] = {"x", "x'"};
    for (int i = 0; i < 2; i++)
        for (int sign = -1; sign <= 1; sign += 2) {
            CU_ASSERT_EQUAL(observables(names[i], sign * 2.8e-10), 1);
            CU_ASSERT_EQUAL(observables(names[i], sign * 3.2e-10), 0);
        }
}

/* A start that the parameters make infinite is named, with its value. */
static void test_not_finite(void)
{
    dal_run_spec spec =
        fixture_spec(fixture_system("coordinates: [x]\nlagrangian: x'^2/2\nparameters: {k: 0}\n"
                                    "start: {x: 1e200*exp(k), x': 1}\n"),
                     "rk4", DAL_PHYSICAL, 0.1);
    const dal_setting k = {"k", 500.0};
    spec.parameters = &k;
    spec.parameter_count = 1;
    fixture_refused(&spec, DAL_NOT_FINITE, "start x is not finite: inf");
}

void suite_start(void)
{
    CU_pSuite suite = CU_add_suite("start", NULL, NULL);
    CU_add_test(suite, "constraints are violated by 1e-10 at most", test_consistent);
    CU_add_test(suite, "an infinite start", test_not_finite);
    CU_add_test(suite, "pivots are 1e-12 at least", test_rank);
    CU_add_test(suite, "an exact solution begins there within 1e-10", test_exact);
}
