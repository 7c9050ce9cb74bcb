/* test_accuracy_options.c - the options that comparison runs differ by: sums, and how accurately
 * equations are solved. */
#include "fixtures.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <math.h>

static const char free_motion[] = "coordinates: [x]\nlagrangian: x'^2/2\nstart: {x': 0.1}\n";
static const char oscillator[] =
    "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x: 1, x': 0.5}\n";

/* x + h v again and again: plain sums are a loop's, and compensated ones lose nothing. */
static void test_sums(void)
{
    enum { STEPS = 100000 };
    const double h = 0.01, v = 0.1;
    dal_run_spec spec =
        fixture_spec(fixture_system(free_motion), "symplectic-euler-10", DAL_PHYSICAL, h);
    dal_run *exact = fixture_run(&spec);
    spec.options.sums = DAL_SUMS_PLAIN;
    dal_run *plain = fixture_run(&spec);
    double x = 0.0;
    for (int i = 0; i < STEPS; i++) x += h * v;
    CU_ASSERT_EQUAL(dal_run_advance(exact, STEPS, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(plain, STEPS, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_state(plain)[0], x);
    /* Right to all digits of x and of what x has no room for, which comes after x and x': the
     * product h v is high + rest, STEPS times that is right + lost. */
    size_t count;
    const double *carried = dal_run_save(exact, &count);
    const double high = h * v, rest = fma(h, v, -high);
    const double right = STEPS * high, lost = fma(STEPS, high, -right) + STEPS * rest;
    CU_ASSERT_FATAL(count >= 4);
    CU_ASSERT(fabs(rest) > 1e-20);
    CU_ASSERT(fabs((carried[0] - right) + (carried[2] - lost)) <= 1e-28 * STEPS);
    CU_ASSERT(fabs(x - right) > 1e-13 * right);
    dal_run_free(exact);
    dal_run_free(plain);
}

/* 0.1 = 4/5 2^-3: its products with numbers of 53 digits have one of five remainders, shifted by a
 * little that varies slowly, so that their roundings would go to one side.  As they are kept, D of
 * methods that keep it makes a walk of less than an ulp of h in each step: 1.4e-17 sqrt(4e5). */
static void test_one_side(void)
{
    static const char *const names[] = {"implicit-midpoint", "gauss4",         "gauss8",
                                        "lobatto4",          "stormer-verlet", "mclachlan4"};
    const long long steps = long_run(400000), stretch = steps / 100;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const dal_run_spec spec =
            fixture_spec(fixture_system("contact-oscillator"), names[i], DAL_PHYSICAL, 0.1);
        dal_run *run = fixture_run(&spec);
        double found[16], max = 0.0;
        for (int k = 0; k < 100; k++) {
            CU_ASSERT_EQUAL(dal_run_advance(run, stretch, NULL), DAL_STATUS_OK);
            dal_run_observe(run, found);
            max = fmax(max, fabs(found[0]));
        }
        CU_ASSERT(max < 4.0 * 1.4e-17 * sqrt(400000.0));
        dal_run_free(run);
    }
}

/* The midpoint rule's fixed point contracts by (h/2)^2 = 1/16 on an oscillator.  The state's size
 * is |v| + |x|/h = 2.5 and the unknown's 0.5: the first change below the tolerance leaves
 * between a 272th and a 17th of it. */
static void test_looser(void)
{
    static const double tolerance[] = {1e-3, 1e-5, 1e-7, 1e-9};
    dal_run_spec spec =
        fixture_spec(fixture_system(oscillator), "implicit-midpoint", DAL_PHYSICAL, 0.5);
    spec.options.solver = DAL_FIXED_POINT;
    dal_run *solved = fixture_stepped(&spec, 1);
    long long evaluations = 0;
    for (size_t i = 0; i < sizeof tolerance / sizeof *tolerance; i++) {
        spec.options.solver_tolerance = tolerance[i];
        dal_run *loose = fixture_stepped(&spec, 1);
        const double left = fabs(dal_run_state(loose)[1] - dal_run_state(solved)[1]);
        CU_ASSERT(left > 2.5 / 272 * tolerance[i]);
        CU_ASSERT(left < 3.0 / 17 * tolerance[i]);
        CU_ASSERT(dal_run_evaluations(loose) > evaluations);
        evaluations = dal_run_evaluations(loose);
        dal_run_free(loose);
    }
    CU_ASSERT(dal_run_evaluations(solved) > evaluations);
    dal_run_free(solved);
}

/* A sweep of the midpoint rule is one evaluation, and one more changes no more than roundings. */
static void test_tighter(void)
{
    dal_run_spec spec =
        fixture_spec(fixture_system(oscillator), "implicit-midpoint", DAL_PHYSICAL, 0.5);
    spec.options.solver = DAL_FIXED_POINT;
    dal_run *solved = fixture_stepped(&spec, 1);
    spec.options.extra_iterations = 3;
    dal_run *more = fixture_stepped(&spec, 1);
    CU_ASSERT_EQUAL(dal_run_evaluations(more), dal_run_evaluations(solved) + 3);
    for (int i = 0; i < 2; i++)
        CU_ASSERT(fabs(dal_run_state(more)[i] - dal_run_state(solved)[i]) < 1e-15);
    /* Early stopping and then sweeps again: each contracts by 1/16. */
    spec.options.solver_tolerance = 1e-4;
    dal_run *again = fixture_stepped(&spec, 1);
    spec.options.extra_iterations = 0;
    dal_run *loose = fixture_stepped(&spec, 1);
    const double before = dal_run_state(loose)[1] - dal_run_state(solved)[1];
    const double after = dal_run_state(again)[1] - dal_run_state(solved)[1];
    CU_ASSERT(fabs(fabs(after / before) * 16 * 16 * 16 - 1) < 1e-3);
    dal_run_free(solved);
    dal_run_free(more);
    dal_run_free(again);
    dal_run_free(loose);
}

/* Every lane has the bits of a run of its own. */
static void test_lanes(void)
{
    dal_run_spec spec = fixture_spec(fixture_system(oscillator), "gauss6", DAL_LIFTED, 0.4);
    spec.options.solver_tolerance = 1e-6;
    spec.options.extra_iterations = 1;
    spec.options.sums = DAL_SUMS_PLAIN;
    fixture_lanes(spec, 5, 50, "x", 0.0, 1.2);
}

static void test_refused(void)
{
    dal_run_spec spec =
        fixture_spec(fixture_system(oscillator), "implicit-midpoint", DAL_PHYSICAL, 0.5);
    spec.options.solver_tolerance = -1e-3;
    fixture_refused(&spec, DAL_STATUS_ARGUMENT,
                    "option solver-tolerance: -0.001 is not from 0 to 1");
    spec.options.solver_tolerance = NAN;
    fixture_refused(&spec, DAL_STATUS_ARGUMENT, "option solver-tolerance: nan");
    spec.options.solver_tolerance = 0.0;
    spec.options.sums = 2;
    fixture_refused(&spec, DAL_STATUS_ARGUMENT, "option sums: 2 is not from 0 to 1");
}

void suite_accuracy_options(void)
{
    CU_pSuite suite = CU_add_suite("options of accuracy", NULL, NULL);
    CU_add_test(suite, "plain and compensated sums", test_sums);
    CU_add_test(suite, "products with the step", test_one_side);
    CU_add_test(suite, "a looser solver", test_looser);
    CU_add_test(suite, "a solver that goes on", test_tighter);
    CU_add_test(suite, "lanes have the bits of runs", test_lanes);
    CU_add_test(suite, "what is refused", test_refused);
}
