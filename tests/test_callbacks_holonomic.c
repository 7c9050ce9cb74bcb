/* test_callbacks_holonomic.c - callbacks of holonomic constraints that fail: whichever call does,
 * the run is not made, with the status of the callback and a message, or the step fails and leaves
 * the run as it was. */
#include "fixtures.h"
#include "holonomic.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX_CALLS = 2000 };
#define MISLEADING 1e6 /* what a callback that fails leaves, which nothing may use */

static const dal_system *original;
static int calls, failing; /* the call that fails, from 1; 0: none */

#define CALLBACKS(CALLBACK)                                                                        \
    CALLBACK(holonomic)                                                                            \
    CALLBACK(position)                                                                             \
    CALLBACK(constraint)                                                                           \
    CALLBACK(enforcement)                                                                          \
    CALLBACK(reaction)                                                                             \
    CALLBACK(constraint_value)
#define FAIL(name)                                                                                 \
    static dal_status fail_##name(const dal_system *system, const dal_point *at, double *out)      \
    {                                                                                              \
        (void)system;                                                                              \
        if (++calls != failing) return original->call.name(original, at, out);                     \
        out[0] = MISLEADING;                                                                       \
        return DAL_STATUS_IO;                                                                      \
    }
CALLBACKS(FAIL)
#undef FAIL

static dal_system failing_system(const dal_system *system)
{
    dal_system copy = *system;
    original = system;
    copy.wide4 = copy.wide8 = NULL;
    copy.extended = copy.quad = NULL;
    copy.series = NULL;
    copy.diagnose = NULL;
#define WRAP(name)                                                                                 \
    CU_ASSERT_PTR_NOT_NULL_FATAL(system->call.name);                                               \
    copy.call.name = fail_##name;
    CALLBACKS(WRAP)
#undef WRAP
    return copy;
}

/* The state after a step whose call `failing` fails, or that makes fewer calls: then true. */
static bool survives(const dal_run_spec *spec, const double *expected)
{
    dal_run *run = NULL;
    dal_error error = {0};
    calls = 0;
    if (dal_run_create(&run, spec, &error) != DAL_STATUS_OK) {
        CU_ASSERT_EQUAL(error.status, DAL_STATUS_IO);
        CU_ASSERT(calls >= failing && error.message[0] != '\0');
        CU_ASSERT_PTR_NULL(run);
        return false;
    }
    const int made = calls, dimension = dal_run_dimension(run);
    const size_t bytes = (size_t)dimension * sizeof(double);
    double before[32];
    CU_ASSERT_FATAL(dimension <= 32);
    memcpy(before, dal_run_state(run), bytes);
    const dal_status status = dal_run_step(run, &error);
    const bool is_reached = calls >= failing;
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
    const dal_system copy = failing_system(plain.system);
    dal_run_spec spec = plain;
    double expected[32];
    failing = 0;
    dal_run *run = fixture_stepped(&plain, 1);
    memcpy(expected, dal_run_state(run), (size_t)dal_run_dimension(run) * sizeof *expected);
    dal_run_free(run);
    spec.system = &copy;
    int stride = 1;
    for (failing = 1; failing < MAX_CALLS && !survives(&spec, expected); failing += stride)
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
