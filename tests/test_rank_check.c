/* test_rank_check.c - steps whose pivots are compared first fail where those fail that are checked
 * every time; the same system without pivots is the independent method. */
#include "compiler.h"
#include "fixtures.h"
#include "folder.h"
#include "quick.h"

#include <CUnit/Basic.h>
#include <dalembert_codegen.h>
#include <stdio.h>
#include <string.h>

/* A snakeboard whose axles turn across it; rows of A that become parallel at z = pi/4;
 * bodies on a cone of velocities that come to rest, one of them beside another. */
static const char *const texts[] = {
    "coordinates: [x, y, th, psi, phi]\n"
    "lagrangian: 0.6*(x'^2 + y'^2) + 0.4*th'^2 + 0.3*th'*psi' + 0.15*psi'^2 + 0.1*phi'^2\n"
    "constraints:\n"
    "  - -sin(th + phi)*x' + cos(th + phi)*y' + 0.8*cos(phi)*th'\n"
    "  - -sin(th - phi)*x' + cos(th - phi)*y' - 0.8*cos(phi)*th'\n"
    "start: {phi: 0.5, x': 0.8, th': tan(0.5), psi': 0.9, phi': 0.5}\n",
    "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n"
    "constraints: [x' + y', cos(z)*x' + sin(z)*y']\nstart: {z: 0.2, z': 0.7}\n",
    "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - 9.81*z\n"
    "constraints: [(x'^2 + y'^2 - z'^2)/2]\nstart: {x': 1, z': 1}\n",
    "coordinates: [x, y, z, u, w]\n"
    "lagrangian: (x'^2 + y'^2 + z'^2 + u'^2 + w'^2 + x'*u')/2 - 9.81*z - 3*w - u^2\n"
    "constraints: [(x'^2 + y'^2 - z'^2)/2, (u'^2 - w'^2)/2]\n"
    "start: {x': 1, z': 1, u': 2, w': 2}\n",
};
enum { TEXTS = sizeof texts / sizeof *texts };

static const char *const methods[] = {"symplectic-euler-00",
                                      "rk4",
                                      "implicit-midpoint",
                                      "gauss4",
                                      "stormer-verlet",
                                      "gauss6",
                                      "lobatto4",
                                      "bm6",
                                      "rk4+project",
                                      "dop853",
                                      "gni",
                                      "stormer-verlet+suzuki4"};
enum { METHODS = sizeof methods / sizeof *methods, STEPS = 400 };
static const double sizes[] = {0.003, 0.01, 0.043, 0.11, 0.2};
enum { SIZES = sizeof sizes / sizeof *sizes };

/* Steps that a run makes before it fails. */
static long long advance(const dal_run_spec *spec, dal_error *error)
{
    dal_run *run = NULL;
    *error = (dal_error){0};
    if (dal_run_create(&run, spec, error) != DAL_STATUS_OK) return -1;
    dal_run_advance(run, STEPS, error);
    const long long steps = dal_run_steps(run);
    dal_run_free(run);
    return steps;
}

/* Whether both end alike; counts the runs that met a singularity. */
static void compare(const dal_system *system, const char *name, double h, dal_space space,
                    int *singular)
{
    dal_system always = *system;
    dal_error error, expected;
    dal_run_spec spec = {.system = system, .options = dal_options_default()};
    if (dal_method_parse(&spec.method, name, NULL) != DAL_STATUS_OK ||
        !fixture_accepts(&spec.method, system, space))
        return;
    spec.options.step = h;
    spec.options.space = space;
    const long long steps = advance(&spec, &error);
    always.pivots = 0;
    spec.system = &always;
    CU_ASSERT(steps == advance(&spec, &expected));
    CU_ASSERT(error.status == expected.status);
    CU_ASSERT_STRING_EQUAL(error.message, expected.message);
    *singular += expected.status == DAL_STATUS_SINGULAR;
}

/* With one in stride of the methods. */
static int compare_all(const dal_system *system, int stride, int first_size)
{
    int singular = 0;
    CU_ASSERT_FATAL(system != NULL);
    for (int i = 0; i < METHODS; i += stride)
        for (int j = first_size; j < SIZES; j++) {
            compare(system, methods[i], sizes[j], DAL_PHYSICAL, &singular);
            if (i < 4) compare(system, methods[i], sizes[j], DAL_LIFTED, &singular);
        }
    return singular;
}

static void test_singularities(void)
{
    for (int i = 0; i < TEXTS; i++) {
        const dal_system *system = fixture_system(texts[i]);
        CU_ASSERT(system->pivots > 0);
        CU_ASSERT(compare_all(system, 1, 0) > 20);
    }
}

static void test_builtins(void)
{
    int checked = 0;
    for (int i = 0; dal_builtin_name(i); i += case_stride(2)) {
        const dal_system *system = fixture_system(dal_builtin_name(i));
        if (!(system->properties & DAL_D_RANK_CHECKED)) continue;
        compare_all(system, case_stride(5), 3);
        checked++;
    }
    CU_ASSERT(checked > 5);
}

/* ---- when the check is made ---- */

/* In the first, x' and y' have constant coefficients each in one constraint alone, so that the rank
 * of A is 2 everywhere, and W is positive definite: A W^-1 A^T is regular.  Each other lacks one of
 * these: x' has a coefficient that vanishes, y' is in both constraints, W is indefinite, and
 * vakonomic motion has other equations. */
static void test_regular(void)
{
    static const struct {
        const char *lagrangian, *first, *rest;
        bool is_checked;
    } list[] = {
        {"(x'^2 + y'^2 + z'^2 + u'^2)/2", "2*x' - cos(z)*u'", "", false},
        {"(x'^2 + y'^2 + z'^2 + u'^2)/2", "cos(x)*x' - cos(z)*u'", "", true},
        {"(x'^2 + y'^2 + z'^2 + u'^2)/2", "2*x' + cos(z)*y' - u'", "", true},
        {"(x'^2 - y'^2 + z'^2 + u'^2)/2", "2*x' - cos(z)*u'", "", true},
        {"(x'^2 + y'^2 + z'^2 + u'^2)/2", "2*x' - cos(z)*u'", "mechanics: vakonomic\n", true},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        char text[256];
        snprintf(text, sizeof text,
                 "coordinates: [x, y, z, u]\nlagrangian: %s\n"
                 "constraints: [\"%s\", \"y' - sin(z)*u'\"]\n%s",
                 list[i].lagrangian, list[i].first, list[i].rest);
        const dal_system *system = fixture_system(text);
        CU_ASSERT_FATAL(system != NULL);
        CU_ASSERT(!(system->properties & DAL_D_RANK_CHECKED) == !list[i].is_checked);
    }
}

static dal_callback *constraint;
static int evaluations;

static dal_status count(const dal_system *system, const dal_point *at, double *out)
{
    evaluations++;
    return constraint(system, at, out);
}

/* Evaluations of the constraint since the last time. */
static int evaluated(dal_run *run, long long steps)
{
    CU_ASSERT(dal_run_advance(run, steps, NULL) == DAL_STATUS_OK);
    const int counted = evaluations;
    evaluations = 0;
    return counted;
}

/* Both ends of the first two steps are evaluated, and of no other: the pivots are a part of the
 * persistent state.  Without pivots it is every step. */
static void test_spared(void)
{
    dal_system counting = *fixture_system("roller-racer");
    dal_run_spec spec = fixture_spec(&counting, "rk4", DAL_PHYSICAL, 0.001);
    constraint = counting.call.constraint;
    counting.call.constraint = count;
    CU_ASSERT(counting.pivots > 0);
    dal_run *run = fixture_run(&spec), *resumed = fixture_run(&spec);
    evaluations = 0;
    CU_ASSERT(evaluated(run, 1000) == 4);
    size_t numbers;
    const double *saved = dal_run_save(run, &numbers);
    CU_ASSERT(dal_run_restore(resumed, saved, numbers, NULL) == DAL_STATUS_OK);
    CU_ASSERT(evaluated(resumed, 1000) == 0);
    CU_ASSERT(dal_run_set_state(resumed, 0.0, dal_run_state(run), NULL) == DAL_STATUS_OK);
    CU_ASSERT(evaluated(resumed, 1000) == 4);
    dal_run_free(resumed);
    dal_run_free(run);
    counting.pivots = 0;
    run = fixture_run(&spec);
    evaluations = 0;
    CU_ASSERT(evaluated(run, 1000) == 2000);
    dal_run_free(run);
}

/* ---- lanes and compiled steps ---- */

/* Lanes that fail in steps of their own, with each method the same as runs. */
static void test_lanes(void)
{
    enum { COUNT = 16 };
    for (int i = 0; i < METHODS; i++) {
        dal_run_spec spec = fixture_spec(fixture_system(texts[1]), methods[i], DAL_PHYSICAL, 0.043);
        dal_batch *batch = NULL;
        CU_ASSERT_FATAL(dal_batch_create(&batch, &spec, COUNT, 0, NULL) == DAL_STATUS_OK);
        for (int lane = 0; lane < COUNT; lane++) {
            const dal_setting start = {"z", 0.2 + 0.03 * lane};
            CU_ASSERT(dal_batch_start(batch, lane, NULL, 0, &start, 1, NULL) == DAL_STATUS_OK);
        }
        dal_batch_advance(batch, STEPS);
        for (int lane = 0; lane < COUNT; lane++) {
            const dal_setting start = {"z", 0.2 + 0.03 * lane};
            dal_error error;
            spec.start = &start;
            spec.start_count = 1;
            const long long steps = advance(&spec, &error);
            CU_ASSERT(dal_batch_status(batch, lane, NULL) == error.status);
            CU_ASSERT_DOUBLE_EQUAL(dal_batch_time(batch, lane), 0.043 * (double)steps, 1e-9);
        }
        dal_batch_free(batch);
    }
}

static void test_compiled(void)
{
    for (int i = 0; i < 2 && compiler_there(); i++) {
        const dal_run_spec spec =
            fixture_spec(fixture_system(texts[i]), i ? "gauss4" : "rk4", DAL_PHYSICAL, 0.043);
        dal_error error, expected;
        const long long steps = advance(&spec, &expected);
        dal_run *run = fixture_run(&spec);
        CU_ASSERT(dal_run_native(run, &(dal_native_options){.cache = "cache"}, NULL) ==
                  DAL_STATUS_OK);
        CU_ASSERT(dal_run_advance(run, STEPS, &error) == DAL_STATUS_SINGULAR);
        CU_ASSERT(dal_run_steps(run) == steps);
        CU_ASSERT_STRING_EQUAL(error.message, expected.message);
        dal_run_free(run);
    }
    folder_remove("cache");
}

/* ---- a constraint that turns ---- */

static const dal_system *turning;
static long calls, failing; /* of D; the call that fails, from 1; 0: none */

static dal_status failing_constraint(const dal_system *system, const dal_point *at, double *out)
{
    (void)system;
    return ++calls == failing ? DAL_STATUS_IO : turning->call.constraint(turning, at, out);
}

static dal_status turn(const dal_run_spec *spec, dal_error *error)
{
    calls = 0;
    dal_run *run = fixture_run(spec);
    const dal_status status = dal_run_step(run, error);
    dal_run_free(run);
    return status;
}

/* The velocity of a particle of constant kinetic energy turns in a long step; G = |v|^2 is 1.  That
 * G keeps its size is seen at the ends of 64 intervals of the step, one value less shows it too. */
static void test_turn(void)
{
    enum { INTERVALS = 64 };
    turning = fixture_system("isokinetic");
    dal_system system = *turning;
    system.call.constraint = failing_constraint;
    system.wide4 = system.wide8 = NULL;
    system.extended = system.quad = NULL;
    const dal_run_spec spec = fixture_spec(&system, "rk4", DAL_PHYSICAL, 5.0);
    dal_error error;
    failing = 0;
    CU_ASSERT_EQUAL(turn(&spec, &error), DAL_STATUS_NOT_CONVERGED);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "turns by more than a right angle"));
    const long total = calls;
    for (failing = total - INTERVALS + 2; failing <= total; failing++) {
        CU_ASSERT_EQUAL(turn(&spec, &error), DAL_STATUS_NOT_CONVERGED);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "turns by more than a right angle"));
    }
    failing = 0;
}

void suite_rank_check(void)
{
    CU_pSuite suite = CU_add_suite("rank check", NULL, NULL);
    CU_add_test(suite, "singularities are found in the same steps", test_singularities);
    CU_add_test(suite, "systems of the library", test_builtins);
    CU_add_test(suite, "not made where the rank cannot fall", test_regular);
    CU_add_test(suite, "made where pivots change", test_spared);
    CU_add_test(suite, "lanes", test_lanes);
    CU_add_test(suite, "compiled steps", test_compiled);
    CU_add_test(suite, "a constraint that turns", test_turn);
}
