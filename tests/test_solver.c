/* test_solver.c - the solver auto: which of its two methods it takes, and that the choice is a part
 * of the persistent state. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <string.h>

enum { STEPS = 200 };

static const dal_setting friction = {"k", 30.0};

static dal_run_spec with_friction(const char *method, double step)
{
    dal_run_spec spec =
        fixture_spec(fixture_system("chaplygin-sleigh-friction"), method, DAL_PHYSICAL, step);
    spec.parameters = &friction;
    spec.parameter_count = 1;
    return spec;
}

/* Evaluations of a step with a solver. */
static double evaluations(dal_run_spec spec, dal_solver solver)
{
    spec.options.solver = solver;
    dal_run *run = fixture_stepped(&spec, STEPS);
    const double count = (double)dal_run_evaluations(run) / STEPS;
    dal_run_free(run);
    return count;
}

/* Friction that a fixed point contracts by 0.6: a sixth of the iterations for a 3 by 3 matrix. */
static void test_takes_newton(void)
{
    const dal_run_spec spec = with_friction("implicit-midpoint", 0.04);
    const double fixed = evaluations(spec, DAL_FIXED_POINT), newton = evaluations(spec, DAL_NEWTON);
    CU_ASSERT(newton < 0.5 * fixed);
    CU_ASSERT(evaluations(spec, DAL_SOLVER_AUTO) < 1.3 * newton);
}

/* Newton's method saves a tenth of the iterations, for four 7 by 7 matrices a step. */
static void test_keeps_fixed_point(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system("chaotic-oscillators"), "gauss8", DAL_PHYSICAL, 0.5);
    const double fixed = evaluations(spec, DAL_FIXED_POINT), newton = evaluations(spec, DAL_NEWTON);
    CU_ASSERT(newton < 0.9 * fixed);
    CU_ASSERT(evaluations(spec, DAL_SOLVER_AUTO) > 0.98 * fixed);
}

/* Nothing is tried where the fixed point takes a few iterations. */
static void test_bits_of_fixed_point(void)
{
    dal_run_spec spec =
        fixture_spec(fixture_system("chaplygin-sleigh"), "gauss6", DAL_LIFTED, 0.02);
    dal_run *one = fixture_stepped(&spec, STEPS);
    spec.options.solver = DAL_FIXED_POINT;
    dal_run *other = fixture_stepped(&spec, STEPS);
    const size_t bytes = (size_t)dal_run_dimension(one) * sizeof(double);
    CU_ASSERT_EQUAL(memcmp(dal_run_state(one), dal_run_state(other), bytes), 0);
    dal_run_free(one);
    dal_run_free(other);
}

/* v' = -k v along the blade's normal, 15 times faster than the step: v decays. */
static void test_stiff(void)
{
    static const char *const methods[] = {"implicit-midpoint", "gauss4", "gauss8", "gauss12"};
    for (int i = 0; i < 4; i++) {
        const dal_run_spec spec = with_friction(methods[i], 0.5);
        dal_run *run = fixture_stepped(&spec, STEPS);
        CU_ASSERT_EQUAL(dal_run_steps(run), STEPS);
        dal_run_free(run);
    }
}

/* Lanes that take Newton's method at different times, or never. */
static void test_lanes(void)
{
    enum { LANES = 8 };
    const dal_run_spec spec = with_friction("gauss4", 0.05);
    dal_setting k[LANES];
    dal_batch *batch = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, LANES, LANES, NULL), DAL_STATUS_OK);
    for (int i = 0; i < LANES; i++) {
        k[i] = (dal_setting){"k", 0.5 + 6.0 * i};
        CU_ASSERT_EQUAL(dal_batch_start(batch, i, &k[i], 1, NULL, 0, NULL), DAL_STATUS_OK);
    }
    CU_ASSERT_EQUAL(dal_batch_advance(batch, STEPS), DAL_STATUS_OK);
    for (int i = 0; i < LANES; i++) {
        double lane[16];
        dal_run_spec one = spec;
        one.parameters = &k[i];
        dal_run *run = fixture_stepped(&one, STEPS);
        dal_batch_state(batch, i, lane);
        CU_ASSERT_EQUAL(memcmp(lane, dal_run_state(run), 6 * sizeof *lane), 0);
        dal_run_free(run);
    }
    dal_batch_free(batch);
}

/* Interrupted at any step, the run continues to the same bits: the choice is saved. */
static void test_saved(void)
{
    const dal_run_spec spec = with_friction("implicit-midpoint", 0.02);
    dal_run *whole = fixture_stepped(&spec, 2 * STEPS), *first = fixture_run(&spec);
    for (int i = 0; i < 30; i++) {
        size_t count;
        const double *expected = dal_run_save(whole, &count);
        CU_ASSERT_EQUAL(dal_run_advance(first, 1, NULL), DAL_STATUS_OK);
        const double *saved = dal_run_save(first, &count);
        dal_run *second = fixture_run(&spec);
        CU_ASSERT_EQUAL(dal_run_restore(second, saved, count, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_advance(second, 2 * STEPS - 1 - i, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(memcmp(dal_run_save(second, &count), expected, count * sizeof *saved), 0);
        dal_run_free(second);
    }
    dal_run_free(first);
    dal_run_free(whole);
}

void suite_solver(void)
{
    CU_pSuite suite = CU_add_suite("solver", NULL, NULL);
    CU_add_test(suite, "Newton's method where it costs less", test_takes_newton);
    CU_add_test(suite, "The fixed point where it costs less", test_keeps_fixed_point);
    CU_add_test(suite, "Few iterations: the bits of the fixed point", test_bits_of_fixed_point);
    CU_add_test(suite, "Steps longer than the motion is stiff", test_stiff);
    CU_add_test(suite, "Lanes choose by themselves", test_lanes);
    CU_add_test(suite, "The choice is saved", test_saved);
}
