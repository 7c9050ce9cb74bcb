/* test_bad_arguments.c - calls with bad arguments: what the structs of the caller may hold that no
 * model would put there.  Each returns a status. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

static dal_status unprepared(const dal_system *system, const dal_point *at, double *out)
{
    (void)system;
    (void)at;
    (void)out;
    return DAL_STATUS_NOT_FINITE;
}

/* A struct filled by hand may say anything. */
static void test_systems(void)
{
    dal_system system = (dal_system){.name = "hand", .n = 1, .call.field = fixture_oscillate};
    dal_run_spec spec = fixture_spec(&system, "rk4", DAL_PHYSICAL, 0.1);
    system.workspace = SIZE_MAX;
    fixture_refused(&spec, DAL_STATUS_TOO_LARGE, "workspace");
    CU_ASSERT_EQUAL(dal_run_size(&spec), 0);
    system.workspace = 1;
    system.parameters = 1000;
    fixture_refused(&spec, DAL_STATUS_ARGUMENT, "1000 parameters in a workspace of 1");
    system.workspace = 0;
    const dal_setting given = {"k", 1.0};
    spec.parameters = &given;
    spec.parameter_count = 1;
    fixture_refused(&spec, DAL_STATUS_NAME, "unknown parameter 'k'"); /* no parameter has a name */
    spec.parameter_count = 0;
    system.prepare = unprepared;
    fixture_refused(&spec, DAL_STATUS_NOT_FINITE, "hand cannot be prepared");
}

static void test_starts(void)
{
    const dal_setting massless = {"m", 0.0}, tiny = {"e", 1e-320}; /* 1/e overflows */
    dal_run_spec spec = fixture_spec(fixture_system("chaplygin-sleigh"), "rk4", DAL_LIFTED, 0.1);
    spec.parameters = &massless;
    spec.parameter_count = 1;
    fixture_refused(&spec, DAL_STATUS_SINGULAR_MASS, "mass matrix is singular at the start");
    spec.parameter_count = 0;
    spec.start = &tiny;
    spec.start_count = 1;
    fixture_refused(&spec, DAL_STATUS_GAUGE, "e must not vanish");
}

static void test_options(void)
{
    const dal_system system = {.name = "hand", .n = 1, .call.field = fixture_oscillate};
    dal_run_spec spec = fixture_spec(&system, "rk4", (dal_space)7, 0.1);
    fixture_refused(&spec, DAL_STATUS_ARGUMENT, "option space: 7 is not from 0 to 1");
    spec = fixture_spec(&system, "rk4", DAL_PHYSICAL, 0.1);
    spec.options.solver = (dal_solver)3;
    fixture_refused(&spec, DAL_STATUS_ARGUMENT, "option solver: 3 is not from 0 to 2");
}

/* A double has 53 binary digits, and sums 12 more that count; a quad number has 113. */
static void test_tolerances(void)
{
    dal_run_spec spec = fixture_spec(fixture_system("vertical-disk"), "dop853", DAL_PHYSICAL, 0.1);
    for (int quad = 0; quad < 2; quad++) {
        spec.options.precision = quad ? DAL_QUAD : DAL_DOUBLE;
        const double min = ldexp(1.0, quad ? -112 - 12 : -52 - 12);
        CU_ASSERT_EQUAL(dal_min_tolerance(&spec.options), min);
        spec.options.tolerance = min;
        dal_run_free(fixture_run(&spec));
        spec.options.tolerance = 0.999 * min;
        fixture_refused(&spec, DAL_STATUS_ARGUMENT, "option tolerance: ");
    }
    CU_ASSERT(isnan(dal_min_tolerance(NULL)));
}

static void test_no_text(void)
{
    dal_model *model;
    dal_error error;
    CU_ASSERT_EQUAL(dal_model_read(&model, "none", NULL, 0, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_STRING_EQUAL(error.message, "there is no text to read");
    CU_ASSERT_PTR_NULL(model);
}

/* A name of 100 letters serves everywhere; a longer one is refused where it is given. */
static void test_long_names(void)
{
    char name[102], formula[128];
    for (int length = 100; length <= 101; length++) {
        dal_model *model = dal_model_create("long");
        const dal_system *system;
        dal_run *run;
        dal_error error;
        memset(name, 'q', sizeof name);
        name[length] = '\0';
        const dal_status status =
            dal_model_add(model, DAL_SECTION_COORDINATES, NULL, name, 1, 15, &error);
        if (length > 100) {
            CU_ASSERT_EQUAL(status, DAL_STATUS_TOO_LARGE);
            CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "more than 100 characters"));
        } else {
            snprintf(formula, sizeof formula, "%s'^2/2", name);
            CU_ASSERT_EQUAL(status, DAL_STATUS_OK);
            dal_model_add(model, DAL_SECTION_LAGRANGIAN, NULL, formula, 0, 0, NULL);
            CU_ASSERT_EQUAL_FATAL(dal_model_system(model, &system, &error), DAL_STATUS_OK);
            dal_run_spec spec = fixture_spec(system, "rk4", DAL_LIFTED, 0.1);
            snprintf(formula, sizeof formula, "pi_%s", name);
            const dal_setting start = {formula, 1.0};
            spec.start = &start;
            spec.start_count = 1;
            CU_ASSERT_EQUAL_FATAL(dal_run_create(&run, &spec, &error), DAL_STATUS_OK);
            CU_ASSERT_EQUAL(dal_run_state(run)[4], 1.0); /* q, v, e, p, pi */
            dal_run_free(run);
        }
        dal_model_free(model);
    }
}

/* ---- runs that cannot do what is requested ---- */

static double time_of_row(void *user, long long row) { return ((const double *)user)[row]; }

static dal_status count_row(void *user, dal_run *run, long long row, double t)
{
    (void)user, (void)run, (void)row;
    CU_ASSERT(isfinite(t));
    return DAL_STATUS_OK;
}

/* Nothing is done where the rows or counts of an observer cannot be. */
static void test_observers(void)
{
    static double times[][3] = {{0.1, NAN, 0.3},
                                {0.2, 0.1, 0.3},
                                {0.1, INFINITY, 0.3},
                                {0.1, 0.35, 0.3}, /* after the last */
                                {NAN, 0.1, 0.3}};
    static double repeated[] = {0.1, 0.1, 0.3};
    const dal_run_spec spec =
        fixture_spec(fixture_system("vertical-disk"), "rk4", DAL_PHYSICAL, 0.1);
    dal_run *run = fixture_run(&spec);
    for (size_t i = 0; i < sizeof times / sizeof *times; i++) {
        dal_error error = {0};
        const dal_observer rows = {.user = times[i], .row_time = time_of_row, .sample = count_row};
        CU_ASSERT_EQUAL(dal_run_sample(run, 0.3, 2, 0, &rows, &error), DAL_STATUS_ARGUMENT);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "is at t = "));
    }
    const dal_observer counts[] = {{.every = -1}, {.every = INT64_MAX}, {.polling = -2}};
    for (int i = 0; i < 3; i++)
        CU_ASSERT_EQUAL(dal_run_sample(run, 0.3, 2, 0, &counts[i], NULL), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_run_steps(run), 0);
    const dal_observer good = {.user = repeated, .row_time = time_of_row, .sample = count_row};
    CU_ASSERT_EQUAL(dal_run_sample(run, 0.3, 2, 0, &good, NULL), DAL_STATUS_OK);
    dal_run_free(run);
}

static dal_status interrupts(const dal_system *system, const dal_point *at, double *out)
{
    (void)system;
    out[0] = -at->q[0];
    return at->t > 0.5 ? DAL_STATUS_INTERRUPTED : DAL_STATUS_OK;
}

static void test_run_arguments(void)
{
    const dal_system system = {.name = "hand", .n = 1, .call.field = interrupts};
    const dal_run_spec spec = fixture_spec(&system, "rk4", DAL_PHYSICAL, 0.1);
    dal_error error = {0};
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_advance(run, -5, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_run_sample(run, 0.3, 3, 0, NULL, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_steps(run), 3);
    CU_ASSERT_EQUAL(dal_run_sample(run, 0.5, 5, -1, NULL, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_run_sample(run, 0.5, 5, 6, NULL, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_run_sample(run, 0.5, 5, 0, NULL, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "row 0 lies before"));
    /* What the system says comes back. */
    CU_ASSERT_EQUAL(dal_run_advance(run, 10, &error), DAL_STATUS_INTERRUPTED);
    /* The clock of five steps is 0.5, the second stage of the sixth 0.05 later. */
    CU_ASSERT_STRING_EQUAL(error.message,
                           "the system failed at t = 0.55000000000000004: interrupted");
    CU_ASSERT(error.line == 0 && error.column == 0);
    CU_ASSERT_EQUAL(dal_run_steps(run), 5);
    dal_run_free(run);
}

/* A name is cut between its parts where the next one does not fit with its NUL. */
static void test_names_of_methods(void)
{
    dal_method method;
    char name[32];
    CU_ASSERT_EQUAL(dal_method_parse(&method, "rk4+project+project-energy", NULL), DAL_STATUS_OK);
    for (size_t size = 0; size <= sizeof name; size++) {
        memset(name, '?', sizeof name);
        CU_ASSERT_PTR_EQUAL(dal_method_name(&method, name, size), name);
        static const char *const cut[] = {
            "", "rk4", "rk4+", "rk4+project", "rk4+project+", "rk4+project+project-energy"};
        int longest = 0;
        for (int i = 0; i < 6; i++)
            if (strlen(cut[i]) < size) longest = i;
        if (size > 0) CU_ASSERT_STRING_EQUAL(name, cut[longest]);
        for (size_t i = size; i < sizeof name; i++) CU_ASSERT_EQUAL(name[i], '?');
    }
}

void suite_bad_arguments(void)
{
    CU_pSuite suite = CU_add_suite("bad arguments", NULL, NULL);
    CU_add_test(suite, "systems by hand with bad members", test_systems);
    CU_add_test(suite, "starts where something is infinite", test_starts);
    CU_add_test(suite, "options that no text gives", test_options);
    CU_add_test(suite, "tolerances", test_tolerances);
    CU_add_test(suite, "observers", test_observers);
    CU_add_test(suite, "a text that is none", test_no_text);
    CU_add_test(suite, "long names", test_long_names);
    CU_add_test(suite, "arguments of runs", test_run_arguments);
    CU_add_test(suite, "names of methods in little room", test_names_of_methods);
}
