/* test_parameters.c - components of the state by name; parameters changed between steps: what a
 * change begins again, what it may not be, what a checkpoint has of it. */
#include "compiler.h"
#include "dalembert_codegen.h"
#include "fixtures.h"
#include "run/run.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- names ---- */

static void each_name(dal_run *run)
{
    char name[64];
    int i = 0;
    for (; dal_run_component_name(run, i, name, sizeof name); i++)
        CU_ASSERT_EQUAL(dal_run_component_index(run, name), i);
    CU_ASSERT_EQUAL(i, dal_run_dimension(run));
    CU_ASSERT_EQUAL(dal_run_component_index(run, "y"), -1);
    CU_ASSERT_EQUAL(dal_run_component_index(run, ""), -1);
    dal_run_free(run);
}

static void test_names(void)
{
    const dal_system *sleigh = fixture_system("chaplygin-sleigh");
    const dal_system *vakonomic = fixture_system("chaplygin-sleigh-vakonomic");
    dal_run_spec spec = fixture_spec(sleigh, "rk4", DAL_LIFTED, 0.1);
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_component_index(run, "y2'"), 4);
    CU_ASSERT_EQUAL(dal_run_component_index(run, "e"), 6);
    CU_ASSERT_EQUAL(dal_run_component_index(run, "p_y1"), 7);
    CU_ASSERT_EQUAL(dal_run_component_index(run, "pi_phi"), 12);
    CU_ASSERT_EQUAL(dal_run_component_index(run, "pi_e"), 13);
    each_name(run);
    spec = fixture_spec(sleigh, "rk4", DAL_PHYSICAL, 0.1);
    run = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_component_index(run, "p_y1"), -1);
    each_name(run);
    spec = fixture_spec(vakonomic, "rk4", DAL_PHYSICAL, 0.1);
    run = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_component_index(run, "g1"), 2 * vakonomic->n);
    each_name(run);
}

/* ---- what a change begins again ---- */

/* x'' = -k x with k = 4, and from t = 1 on k = 9: in closed form. */
static const char spring[] = "coordinates: [x]\nparameters: {m: 1, k: 4}\n"
                             "lagrangian: m*x'^2/2 - k/2*x^2\nstart: {x: 1}\n"
                             "exact: {x: cos(sqrt(k/m)*t)}\n";

static dal_run *spring_run(const char *method, dal_precision precision)
{
    dal_run_spec spec = fixture_spec(fixture_system(spring), method, DAL_PHYSICAL, 0.01);
    spec.options.precision = precision;
    return fixture_run(&spec);
}

static void test_motion(void)
{
    for (int precision = DAL_DOUBLE; precision <= DAL_QUAD; precision++) {
        dal_run *run = spring_run("gauss12", precision);
        CU_ASSERT_EQUAL(dal_run_advance(run, 100, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_set_parameter(run, "k", 9.0, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_parameters(run)[1], 9.0);
        CU_ASSERT_EQUAL(dal_run_advance(run, 50, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_steps(run), 150);
        const double x = cos(2.0), v = -2.0 * sin(2.0), c = cos(1.5), s = sin(1.5);
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[0], x * c + v / 3.0 * s, 1e-14);
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[1], v * c - 3.0 * x * s, 1e-13);
        dal_run_free(run);
    }
}

/* The state of the method is 0, as before a first step, and the next step needs no fewer
 * evaluations than one. */
static void test_warm_start(void)
{
    dal_run *run = spring_run("gauss6", DAL_DOUBLE);
    const dal__layout *k = &run->layout;
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
    const long long first = dal_run_evaluations(run);
    CU_ASSERT_EQUAL(dal_run_advance(run, 20, NULL), DAL_STATUS_OK);
    const long long before = dal_run_evaluations(run);
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
    const long long warm = dal_run_evaluations(run) - before;
    CU_ASSERT(warm < first);
    CU_ASSERT_EQUAL(dal_run_set_parameter(run, "k", 4.0, NULL), DAL_STATUS_OK);
    for (size_t i = dal__at(k, DAL__CLOCK_SIZE); i < dal__at_changed(k); i++)
        CU_ASSERT_EQUAL(run->persistent[i], 0.0);
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
    CU_ASSERT(dal_run_evaluations(run) - before - warm > warm);
    dal_run_free(run);
}

/* +project-energy stays on the energy that the new parameter gives the state. */
static void test_energy_level(void)
{
    dal_run *run = spring_run("rk4+project-energy", DAL_DOUBLE);
    double seen[3];
    CU_ASSERT_EQUAL(dal_run_advance(run, 100, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_set_parameter(run, "k", 9.0, NULL), DAL_STATUS_OK);
    const double *y = dal_run_state(run), level = 0.5 * y[1] * y[1] + 4.5 * y[0] * y[0];
    for (int i = 0; i < 300; i++) {
        CU_ASSERT_EQUAL_FATAL(dal_run_step(run, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_observe(run, seen), DAL_STATUS_OK);
        CU_ASSERT_DOUBLE_EQUAL(seen[0], level, 4e-15 * level);
    }
    dal_run_free(run);
}

/* ---- the observable error ---- */

typedef struct last_seen {
    double value, before;
} last_seen;

static dal_status see(void *user, dal_run *run, int count, const double *t, const double *values,
                      size_t stride)
{
    last_seen *last = user;
    (void)t;
    (void)run;
    last->value = values[stride + (size_t)count - 1];
    last->before = values[(size_t)count - 1];
    return DAL_STATUS_OK;
}

static double sampled_error(dal_run *run)
{
    last_seen last = {0.0, 0.0};
    const dal_observer observer = {.user = &last, .values = see, .every = 1};
    const double T = dal_run_time(run) + 0.1;
    CU_ASSERT_EQUAL(dal_run_sample(run, T, 1, 1, &observer, NULL), DAL_STATUS_OK);
    CU_ASSERT(isfinite(last.before));
    return last.value;
}

static void test_error(void)
{
    for (int native = 0; native <= (int)compiler_works; native++) {
        dal_run *run = spring_run("gauss8", DAL_DOUBLE);
        double seen[2];
        if (native) CU_ASSERT_EQUAL(dal_run_native(run, &compiler_options, NULL), DAL_STATUS_OK);
        if (native)
            CU_ASSERT_EQUAL(dal_run_native_observables(run, &compiler_options, NULL),
                            DAL_STATUS_OK);
        CU_ASSERT(sampled_error(run) < 1e-13);
        CU_ASSERT_EQUAL(dal_run_set_parameter(run, "k", 5.0, NULL), DAL_STATUS_OK);
        CU_ASSERT(isnan(sampled_error(run)));
        CU_ASSERT_EQUAL(dal_run_set_parameter(run, "k", 4.0, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_observe(run, seen), DAL_STATUS_OK);
        CU_ASSERT(isfinite(seen[0]) && isnan(seen[1]));
        CU_ASSERT_EQUAL(dal_run_set_state(run, 0.0, dal_run_state(run), NULL), DAL_STATUS_OK);
        CU_ASSERT(isnan(sampled_error(run)));
        dal_run_free(run);
    }
}

/* ---- checkpoints ---- */

static void same_memory(const dal_run *a, const dal_run *b)
{
    size_t m, n;
    const double *x = dal_run_save(a, &m), *y = dal_run_save(b, &n);
    CU_ASSERT_EQUAL_FATAL(m, n);
    CU_ASSERT_EQUAL(memcmp(x, y, n * sizeof *x), 0);
}

/* A copy brings its parameters, into a run of other parameters, too. */
static void test_checkpoint(void)
{
    for (int precision = DAL_DOUBLE; precision <= DAL_QUAD; precision++) {
        dal_run *run = spring_run("gauss6", precision), *other = spring_run("gauss6", precision);
        size_t count;
        double seen[2], copy[256];
        CU_ASSERT_EQUAL(dal_run_advance(run, 10, NULL), DAL_STATUS_OK);
        CU_ASSERT_FATAL(dal_run_save(run, &count) && count <= 256);
        memcpy(copy, dal_run_save(run, &count), count * sizeof *copy);
        CU_ASSERT_EQUAL(dal_run_set_parameter(run, "k", 7.0, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_advance(run, 10, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_restore(other, dal_run_save(run, &count), count, NULL),
                        DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_parameters(other)[1], 7.0);
        CU_ASSERT_EQUAL(dal_run_advance(run, 10, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_advance(other, 10, NULL), DAL_STATUS_OK);
        same_memory(run, other);
        CU_ASSERT_EQUAL(dal_run_observe(other, seen), DAL_STATUS_OK);
        CU_ASSERT(isnan(seen[1]));
        /* Back to before the change. */
        CU_ASSERT_EQUAL(dal_run_restore(run, copy, count, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_parameters(run)[1], 4.0);
        CU_ASSERT_EQUAL(dal_run_advance(run, 90, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_observe(run, seen), DAL_STATUS_OK);
        CU_ASSERT(seen[1] < 1e-12);
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[0], cos(2.0), 1e-12);
        dal_run_free(run);
        dal_run_free(other);
    }
}

static dal_status stiffen(void *user, dal_run *run)
{
    (void)user;
    return dal_run_set_parameter(run, "k", 100.0, NULL);
}

/* An intermediate step leaves nothing, not even a parameter. */
static void test_intermediate(void)
{
    dal_run *run = spring_run("gauss6", DAL_DOUBLE), *other = spring_run("gauss6", DAL_DOUBLE);
    CU_ASSERT_EQUAL(dal_run_advance(run, 10, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_intermediate(run, 0.004, stiffen, NULL, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(run, 10, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(other, 20, NULL), DAL_STATUS_OK);
    same_memory(run, other);
    dal_run_free(run);
    dal_run_free(other);
}

/* ---- what is refused leaves no trace ---- */

static const char driven[] = "coordinates: [x, y, phi]\n"
                             "parameters: {m: 1, I: 0.5, k: 2, u: 0.1}\n"
                             "lagrangian: m/2*(x'^2 + y'^2) + I/2*phi'^2 - k^2/2*x^2\n"
                             "forces: {phi: u*cos(t)/(m + sin(k))}\n"
                             "constraints: [x'*sin(phi) - y'*cos(phi)]\n"
                             "start: {x: 0.3, x': 1, phi': 0.5}\n";
static void refused(dal_run *run, const char *name, double value, dal_status status,
                    const char *fragment)
{
    double before[256];
    dal_error error = {0};
    size_t count;
    CU_ASSERT_FATAL(dal_run_save(run, &count) && count <= 256);
    memcpy(before, dal_run_save(run, &count), count * sizeof *before);
    CU_ASSERT_EQUAL(dal_run_set_parameter(run, name, value, &error), status);
    if (!strstr(error.message, fragment)) printf("\n  '%s' lacks '%s'\n", error.message, fragment);
    CU_ASSERT(error.status == status && strstr(error.message, fragment));
    CU_ASSERT_EQUAL(dal_run_set_parameter(run, name, value, NULL), status);
    CU_ASSERT_EQUAL(memcmp(before, dal_run_save(run, &count), count * sizeof *before), 0);
}

static void test_refusals(void)
{
    dal_run_spec spec = fixture_spec(fixture_system(driven), "gauss4", DAL_LIFTED, 0.02);
    for (int precision = DAL_DOUBLE; precision <= DAL_QUAD; precision++) {
        spec.options.precision = precision;
        dal_run *run = fixture_stepped(&spec, 10), *other = fixture_stepped(&spec, 10);
        refused(run, "mm", 1.0, DAL_STATUS_NAME, "did you mean 'm'?");
        refused(run, "x", 1.0, DAL_STATUS_NAME, "unknown parameter 'x'");
        refused(run, "k", NAN, DAL_STATUS_NOT_FINITE, "parameter k");
        refused(run, "k", -INFINITY, DAL_STATUS_NOT_FINITE, "-inf");
        refused(run, "m", 0.0, DAL_STATUS_SINGULAR_MASS, "parameter m = 0: the mass matrix");
        refused(run, "I", 0.0, DAL_STATUS_SINGULAR_MASS, "the present state");
        refused(run, "k", 1e200, DAL_STATUS_NOT_FINITE, "acceleration");
        CU_ASSERT_EQUAL(dal_run_advance(run, 10, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_advance(other, 10, NULL), DAL_STATUS_OK);
        same_memory(run, other);
        dal_run_free(run);
        dal_run_free(other);
    }
}

/* Constraints that a parameter makes dependent, or takes away. */
static void test_rank(void)
{
    static const char text[] = "coordinates: [x, y, z]\nparameters: {s: 2}\n"
                               "lagrangian: (x'^2 + y'^2 + z'^2)/2\n"
                               "constraints: [x' - y', x' - s*y' + (s - 1)*z]\nstart: {z': 1}\n";
    const char *one = "coordinates: [x, y]\nparameters: {s: 1}\nlagrangian: (x'^2 + y'^2)/2\n"
                      "constraints: [s*(x' - y')]\nstart: {x': 1, y': 1}\n";
    dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.1);
    dal_run *run = fixture_run(&spec);
    refused(run, "s", 1.0, DAL_STATUS_SINGULAR, "is singular at the present state");
    dal_run_free(run);
    spec = fixture_spec(fixture_system(one), "rk4", DAL_PHYSICAL, 0.1);
    run = fixture_stepped(&spec, 1);
    refused(run, "s", 0.0, DAL_STATUS_SINGULAR, "constraint 1 is singular");
    dal_run_free(run);
}

/* By hand: x'' = -x/s, which prepare refuses to divide by beyond 10. */
static dal_status divide(const dal_system *system, const dal_point *at, double *out)
{
    (void)system;
    out[0] = -at->q[0] * at->work[1];
    return DAL_STATUS_OK;
}

static dal_status invert(const dal_system *system, const dal_point *at, double *out)
{
    (void)system, (void)out;
    if (at->work[0] > 10.0) return DAL_STATUS_MODEL;
    at->work[1] = 1.0 / at->work[0];
    return DAL_STATUS_OK;
}

static void test_by_hand(void)
{
    static const char *const names[] = {"s"};
    static const double values[] = {2.0};
    const dal_system system = {.name = "hand",
                               .n = 1,
                               .parameters = 1,
                               .parameter = names,
                               .value = values,
                               .workspace = 2,
                               .prepare = invert,
                               .call.field = divide};
    const dal_setting start = {"q1", 1.0};
    dal_run_spec spec = fixture_spec(&system, "gauss6", DAL_PHYSICAL, 0.01);
    spec.start = &start;
    spec.start_count = 1;
    dal_run *run = fixture_stepped(&spec, 5), *other = fixture_stepped(&spec, 5);
    refused(run, "s", 11.0, DAL_STATUS_MODEL, "hand cannot be prepared");
    refused(run, "s", 0.0, DAL_STATUS_NOT_FINITE, "acceleration 1");
    CU_ASSERT_EQUAL(dal_run_advance(run, 5, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(other, 5, NULL), DAL_STATUS_OK);
    same_memory(run, other);
    CU_ASSERT_EQUAL(dal_run_set_parameter(run, "s", 4.0, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(run->work[1], 0.25);
    size_t count;
    double copy[256];
    CU_ASSERT_FATAL(dal_run_save(run, &count) && count <= 256);
    memcpy(copy, dal_run_save(run, &count), count * sizeof *copy);
    copy[count - 1] = 12.0;
    CU_ASSERT_EQUAL(dal_run_restore(run, copy, count, NULL), DAL_STATUS_MODEL);
    CU_ASSERT_EQUAL(run->work[0], 4.0);
    CU_ASSERT_EQUAL(run->work[1], 0.25);
    dal_run_free(run);
    dal_run_free(other);
}

/* ---- a constraint that moves ---- */

/* D = x' - k y': set, with a word about D.  rk4 then stays on the level of D, and +project returns
 * to D = 0. */
static void test_violated(void)
{
    static const char text[] = "coordinates: [x, y]\nparameters: {k: 1}\n"
                               "lagrangian: (x'^2 + y'^2)/2 - x\nconstraints: [x' - k*y']\n"
                               "start: {x': 1, y': 1}\n";
    static const char *const methods[] = {"rk4", "rk4+project"};
    for (int i = 0; i < 2; i++) {
        const dal_run_spec spec =
            fixture_spec(fixture_system(text), methods[i], DAL_PHYSICAL, 0.01);
        dal_run *run = fixture_stepped(&spec, 10);
        double seen[2];
        dal_error error = {0};
        CU_ASSERT_EQUAL(dal_run_set_parameter(run, "k", 1.0, &error), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_set_parameter(run, "k", 3.0, &error), DAL_STATUS_INCONSISTENT);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "parameter k = 3: the present state violates "
                                                     "constraint 1: D1 = -"));
        CU_ASSERT_EQUAL(dal_run_parameters(run)[0], 3.0);
        const double level = dal_run_state(run)[2] - 3.0 * dal_run_state(run)[3];
        CU_ASSERT_EQUAL(dal_run_advance(run, 10, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_observe(run, seen), DAL_STATUS_OK);
        CU_ASSERT_DOUBLE_EQUAL(seen[0], i == 0 ? level : 0.0, 1e-14);
        dal_run_free(run);
    }
}

static void set_all(dal_run *run)
{
    const dal_system *system = dal_run_system(run);
    dal_error error = {0};
    for (int i = 0; i < system->parameters; i++) {
        const double value = dal_run_parameters(run)[i];
        if (dal_run_set_parameter(run, system->parameter[i], value, &error) == DAL_STATUS_OK)
            continue;
        printf("\n  %s: %s\n", system->name, error.message);
        CU_FAIL("a parameter as it is");
    }
}

/* D drifts along a run of rk4: that is no violation by a parameter, on which D does not depend. */
static void test_drift(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system("chaplygin-sleigh"), "rk4", DAL_PHYSICAL, 0.2);
    dal_run *run = fixture_stepped(&spec, 100);
    double seen[8];
    CU_ASSERT_EQUAL(dal_run_observe(run, seen), DAL_STATUS_OK);
    CU_ASSERT(fabs(seen[0]) > 1e-7);
    CU_ASSERT_EQUAL(dal_run_set_parameter(run, "I", 2.0, NULL), DAL_STATUS_OK);
    dal_run_free(run);
}

/* Every parameter of every system can be set to what it is, wherever the run is. */
static void test_built_in(void)
{
    for (int i = 0; dal_builtin_name(i); i++) {
        const dal_system *system = fixture_system(dal_builtin_name(i));
        const dal_run_spec spec = fixture_spec(system, "gauss4+project", DAL_PHYSICAL, 0.001);
        if (!fixture_accepts(&spec.method, system, DAL_PHYSICAL)) continue;
        dal_run *run = fixture_run(&spec);
        for (int step = 0; step < 3; step++) {
            set_all(run);
            CU_ASSERT_EQUAL(dal_run_advance(run, 10, NULL), DAL_STATUS_OK);
        }
        dal_run_free(run);
    }
}

/* ---- lanes ---- */

/* What is refused in a lane leaves it; one that has failed says why. */
static void test_lanes(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system("coordinates: [x]\nparameters: {s: 1}\n"
                                                          "lagrangian: x'^2/2\n"
                                                          "forces: {x: -s*sqrt(x)}\n"
                                                          "start: {x: 1}\n"),
                                           "rk4", DAL_PHYSICAL, 0.01);
    dal_batch *batch = NULL;
    dal_run *other = fixture_run(&spec);
    dal_error error = {0};
    double state[2];
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, 5, 0, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_batch_set_parameter(batch, 5, "s", 1.0, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_batch_set_parameter(batch, 0, "t", 1.0, &error), DAL_STATUS_NAME);
    CU_ASSERT_EQUAL(dal_batch_set_parameter(batch, 0, "s", NAN, &error), DAL_STATUS_NOT_FINITE);
    CU_ASSERT_EQUAL(dal_batch_set_parameter(batch, 3, "s", 40.0, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_batch_advance(batch, 100), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(other, 100, NULL), DAL_STATUS_OK);
    for (int lane = 0; lane < 5; lane++) {
        dal_batch_state(batch, lane, state);
        CU_ASSERT_EQUAL(dal_batch_status(batch, lane, NULL),
                        lane == 3 ? DAL_STATUS_NOT_FINITE : DAL_STATUS_OK);
        CU_ASSERT_EQUAL(memcmp(state, dal_run_state(other), sizeof state) == 0, lane != 3);
    }
    CU_ASSERT_EQUAL(dal_batch_set_parameter(batch, 3, "s", 1.0, &error), DAL_STATUS_NOT_FINITE);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "t = "));
    CU_ASSERT_EQUAL(dal_batch_set_parameter(batch, 2, "s", 1.0, &error), DAL_STATUS_OK);
    dal_batch_free(batch);
    dal_run_free(other);
}

void suite_parameters(void);
void suite_parameters(void)
{
    CU_pSuite suite = CU_add_suite("parameters", compiler_set_up, compiler_tear_down);
    CU_add_test(suite, "names of the state", test_names);
    CU_add_test(suite, "the motion", test_motion);
    CU_add_test(suite, "a first step again", test_warm_start);
    CU_add_test(suite, "the energy of the present state", test_energy_level);
    CU_add_test(suite, "no exact solution any more", test_error);
    CU_add_test(suite, "checkpoints", test_checkpoint);
    CU_add_test(suite, "intermediate steps", test_intermediate);
    CU_add_test(suite, "refusals", test_refusals);
    CU_add_test(suite, "dependent constraints", test_rank);
    CU_add_test(suite, "a system by hand", test_by_hand);
    CU_add_test(suite, "a violated constraint", test_violated);
    CU_add_test(suite, "a drift of D", test_drift);
    CU_add_test(suite, "all systems", test_built_in);
    CU_add_test(suite, "lanes", test_lanes);
}
