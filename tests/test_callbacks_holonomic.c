/* test_callbacks_holonomic.c - callbacks of holonomic constraints that fail: whichever call does,
 * the run is not made, with the status of the callback and a message, or the step fails and leaves
 * the run as it was. */
#include "failing.h"
#include "fixtures.h"
#include "holonomic.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX_CALLS = 2000 };

/* The state after a step whose call number `failing` fails; true: it makes fewer calls. */
static bool survives(const dal_run_spec *spec, long failing, const double *expected)
{
    dal_run *run = NULL;
    dal_error error = {0};
    failing_begin(failing, failing);
    if (dal_run_create(&run, spec, &error) != DAL_STATUS_OK) {
        CU_ASSERT_EQUAL(error.status, DAL_STATUS_IO);
        CU_ASSERT(failing_calls() >= failing && error.message[0] != '\0');
        CU_ASSERT_PTR_NULL(run);
        return false;
    }
    const long made = failing_calls();
    const int dimension = dal_run_dimension(run);
    const size_t bytes = (size_t)dimension * sizeof(double);
    double before[32];
    CU_ASSERT_FATAL(dimension <= 32);
    memcpy(before, dal_run_state(run), bytes);
    const dal_status status = dal_run_step(run, &error);
    const bool is_reached = failing_calls() >= failing;
    const bool is_failed = (status == DAL_STATUS_IO || status == DAL_STATUS_NOT_FINITE ||
                            status == DAL_STATUS_NOT_CONVERGED || status == DAL_STATUS_SINGULAR) &&
                           error.status == status && error.message[0] != '\0';
    CU_ASSERT(is_reached && made < failing ? is_failed : status == DAL_STATUS_OK);
    const double *const state = status == DAL_STATUS_OK ? expected : before;
    CU_ASSERT_EQUAL(memcmp(dal_run_state(run), state, bytes), 0);
    CU_ASSERT_EQUAL(dal_run_time(run), status == DAL_STATUS_OK ? spec->options.step : 0.0);
    dal_run_free(run);
    return !is_reached;
}

static void each_call_fails(const char *text, const char *method)
{
    const dal_run_spec plain = fixture_spec(fixture_system(text), method, DAL_PHYSICAL, 0.1);
    static const char *const names[] = {
        "holonomic", "position", "constraint", "enforcement", "reaction", "constraint_value", NULL};
    const dal_system copy = failing_system(plain.system, names);
    dal_run_spec spec = plain;
    double expected[32];
    dal_run *run = fixture_stepped(&plain, 1);
    memcpy(expected, dal_run_state(run), (size_t)dal_run_dimension(run) * sizeof *expected);
    dal_run_free(run);
    spec.system = &copy;
    int failing = 1, stride = 1;
    for (; failing < MAX_CALLS && !survives(&spec, failing, expected); failing += stride)
        if (failing > 40) stride = case_stride(7);
    CU_ASSERT(failing > 4 && failing < MAX_CALLS);
}

static void test_methods(void)
{
    static const char *const methods[] = {"rattle",        "gauss-spark2",
                                          "gauss-spark4",  "gauss4+project",
                                          "rk4+project",   "gauss4+symmetric-project",
                                          "rattle+suzuki4"};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        each_call_fails(skate, methods[i]);
        each_call_fails(steady, methods[i]);
    }
}

void suite_callbacks_holonomic(void)
{
    CU_pSuite suite = CU_add_suite("callbacks of holonomic constraints that fail", NULL, NULL);
    CU_add_test(suite, "steps", test_methods);
}
