/* test_batch.c - batches: lane by lane the bits of a single run, in every variant this machine can
 * run, whatever the neighbours do. */
#include "allocation.h"
#include "fixtures.h"
#include "quick.h"
#include "run/batch.h"
#include "run/engine.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* FEW takes a block of 8 lanes and one that is not full. */
enum { FEW = 11, MAX_DIMENSION = 32 };

/* Steps of half a run. */
static long long half(void) { return long_run(20) + 1; }

static const struct {
    int width;
    dal__instructions set;
    dal__variant variant;
} variants[] = {
#define X(name, variant, lanes, set) {lanes, DAL__##set, name##_##variant},
    X(DAL__VARIANT, x1, 1, BASE) DAL__VARIANT_LIST(X, DAL__VARIANT)
#undef X
};

/* Lane i has its own parameter and start. */
static dal_setting lane_parameter(int i) { return (dal_setting){"a", 0.3 + 0.003 * i}; }
static dal_setting lane_start(int i) { return (dal_setting){"u", 0.2 - 0.004 * i}; }

static void single_end(dal_run_spec spec, int lane, double *state)
{
    const dal_setting parameter = lane_parameter(lane), start = lane_start(lane);
    spec.parameters = &parameter;
    spec.start = &start;
    spec.parameter_count = spec.start_count = 1;
    dal_run *run = fixture_stepped(&spec, 2 * half());
    CU_ASSERT_FATAL(dal_run_dimension(run) <= MAX_DIMENSION);
    memcpy(state, dal_run_state(run), (size_t)dal_run_dimension(run) * sizeof *state);
    dal_run_free(run);
}

/* Runs a batch to its end and compares; takes it over. */
static void check_batch(dal_batch *batch, int dimension, double (*single)[MAX_DIMENSION])
{
    for (int i = 0; i < dal_batch_count(batch); i++) {
        const dal_setting parameter = lane_parameter(i), start = lane_start(i);
        CU_ASSERT_EQUAL(dal_batch_start(batch, i, &parameter, 1, &start, 1, NULL), DAL_STATUS_OK);
    }
    CU_ASSERT_EQUAL(dal_batch_advance(batch, half()), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_batch_advance(batch, half()), DAL_STATUS_OK);
    int wrong = 0;
    double states[(FEW + 1) * MAX_DIMENSION];
    const size_t size = (size_t)dimension * sizeof *states, end = (size_t)(FEW * dimension);
    states[end] = 1.5; /* is not written */
    dal_batch_states(batch, states);
    CU_ASSERT_EQUAL(states[end], 1.5);
    for (int i = 0; i < dal_batch_count(batch); i++) {
        double lane[MAX_DIMENSION];
        dal_batch_state(batch, i, lane);
        wrong += memcmp(single[i], lane, size) != 0;
        wrong += memcmp(single[i], states + i * dimension, size) != 0;
        wrong += dal_batch_status(batch, i, NULL) != DAL_STATUS_OK;
    }
    CU_ASSERT_EQUAL(wrong, 0);
    dal_batch_free(batch);
}

static void check_variants(const dal_run_spec *spec, int dimension, double (*single)[MAX_DIMENSION])
{
    for (int v = 0; v < DAL__VARIANTS; v++) {
        dal_batch *batch = NULL;
        const bool can = dal__machine_has(variants[v].set);
        const dal_status status =
            dal__batch_of_variant(&batch, spec, FEW, 0, variants[v].variant, NULL);
        CU_ASSERT_EQUAL(status, can ? DAL_STATUS_OK : DAL_STATUS_UNSUPPORTED);
        if (batch) check_batch(batch, dimension, single);
    }
}

static void same_bits(const dal_run_spec *spec, int dimension)
{
    static const int widths[] = {0, 1, 4, 8};
    static double single[FEW][MAX_DIMENSION];
    for (int i = 0; i < FEW; i++) single_end(*spec, i, single[i]);
    check_variants(spec, dimension, single);
    for (int w = 0; w < 4; w += case_stride(3)) {
        dal_batch *batch = NULL;
        CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, spec, FEW, widths[w], NULL), DAL_STATUS_OK);
        check_batch(batch, dimension, single);
    }
}

static void test_same_bits(void)
{
    const dal_system *system = fixture_system(fixture_full);
    for (int i = 0; dal_integrator_at(i); i++) {
        const int kinds = dal_integrator_at(i)->properties & DAL_MODIFIER ? 2 : 4;
        for (int kind = i % case_stride(kinds); kind < kinds; kind += case_stride(kinds)) {
            char name[80];
            fixture_method(i, name, 64);
            if (kind & 2) strcat(name, "+project");
            const dal_space space = kind & 1 ? DAL_PHYSICAL : DAL_LIFTED;
            const dal_run_spec spec = fixture_spec(system, name, space, 0.02);
            if (!fixture_accepts(&spec.method, system, space)) continue;
            same_bits(&spec, space == DAL_LIFTED ? 4 * system->n + 2 : 2 * system->n);
        }
    }
}

/* Some lanes need Newton, some do not; the others must not notice. */
static void test_mixed_stiffness(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system("chaplygin-sleigh-friction"), "gauss6", DAL_LIFTED, 0.02);
    dal_batch *batch = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, 8, 8, NULL), DAL_STATUS_OK);
    dal_setting k[8];
    for (int i = 0; i < 8; i++) {
        k[i] = (dal_setting){"k", i % 2 ? 10.0 + i : 3000.0 * i + 10.0};
        CU_ASSERT_EQUAL(dal_batch_start(batch, i, &k[i], 1, NULL, 0, NULL), DAL_STATUS_OK);
    }
    CU_ASSERT_EQUAL(dal_batch_advance(batch, 50), DAL_STATUS_OK);
    for (int i = 0; i < 8; i++) {
        double lane[64];
        dal_run_spec one = spec;
        one.parameters = &k[i];
        one.parameter_count = 1;
        dal_run *run = fixture_stepped(&one, 50);
        dal_batch_state(batch, i, lane);
        CU_ASSERT_EQUAL(memcmp(lane, dal_run_state(run), 14 * sizeof *lane), 0);
        dal_run_free(run);
    }
    dal_batch_free(batch);
}

/* A lane that fails stops, says why, keeps its last state; the others go on, under x'' = t. */
static void check_failing_lane(const dal_run_spec *spec, int count, int width, int bad)
{
    const dal_setting fast = {"s", 100.0}, none = {"s", 0.0};
    dal_batch *batch = NULL;
    dal_error error = {0};
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, spec, count, width, NULL), DAL_STATUS_OK);
    for (int i = 0; i < count; i++)
        CU_ASSERT_EQUAL(dal_batch_start(batch, i, i == bad ? &fast : &none, 1, NULL, 0, NULL),
                        DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_batch_advance(batch, 100), DAL_STATUS_OK);
    for (int i = 0; i < count; i++) {
        double state[2];
        dal_batch_state(batch, i, state);
        CU_ASSERT_EQUAL(dal_batch_status(batch, i, &error),
                        i == bad ? DAL_STATUS_NOT_FINITE : DAL_STATUS_OK);
        if (i != bad) CU_ASSERT_DOUBLE_EQUAL(state[0], 1.0 + 1.0 / 6.0, 1e-14);
        if (i != bad) CU_ASSERT_DOUBLE_EQUAL(dal_batch_time(batch, i), 1.0, 1e-15);
        if (i == bad) CU_ASSERT(state[0] > 0.0 && dal_batch_time(batch, i) < 0.5);
        if (i == bad) CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "not finite"));
    }
    dal_batch_free(batch);
}

static void test_failing_lane(void)
{
    const char *text = "coordinates: [x]\nparameters: {s: 1}\nlagrangian: x'^2/2\n"
                       "forces: {x: t - s*sqrt(x)}\nstart: {x: 1}\n";
    const dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.01);
    check_failing_lane(&spec, 6, 4, 0);
    check_failing_lane(&spec, 6, 4, 2);
    check_failing_lane(&spec, 6, 1, 5);
    check_failing_lane(&spec, 13, 8, 8);
    check_failing_lane(&spec, 13, 8, 12);
}

/* A field that fails in the lane with start x = 2 while broken, and is sound again later. */
static bool broken;
static dal_status breaks(const dal_system *system, const dal_point *at, double *out)
{
    (void)system;
    out[0] = broken && at->q[0] == 2.0 ? NAN : 0.0;
    return DAL_STATUS_OK;
}

/* A lane that has failed is never stepped again, though it could be. */
static void test_failed_lane_stays(void)
{
    const dal_system system = {.name = "breaks", .n = 1, .call.field = breaks};
    const dal_run_spec spec = fixture_spec(&system, "rk4", DAL_PHYSICAL, 0.25);
    const dal_setting start = {"q1", 2.0};
    dal_batch *batch = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, 3, 0, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_batch_start(batch, 1, NULL, 0, &start, 1, NULL), DAL_STATUS_OK);
    broken = true;
    CU_ASSERT_EQUAL(dal_batch_advance(batch, 4), DAL_STATUS_OK);
    broken = false;
    CU_ASSERT_EQUAL(dal_batch_advance(batch, 4), DAL_STATUS_OK);
    for (int i = 0; i < 3; i++) {
        CU_ASSERT_EQUAL(dal_batch_status(batch, i, NULL),
                        i == 1 ? DAL_STATUS_NOT_FINITE : DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_batch_time(batch, i), i == 1 ? 0.0 : 2.0);
    }
    dal_batch_free(batch);
    /* With no lane left the status is a lane's. */
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, 1, 0, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_batch_start(batch, 0, NULL, 0, &start, 1, NULL), DAL_STATUS_OK);
    broken = true;
    CU_ASSERT_EQUAL(dal_batch_advance(batch, 4), DAL_STATUS_NOT_FINITE);
    broken = false;
    CU_ASSERT_EQUAL(dal_batch_advance(batch, 4), DAL_STATUS_NOT_FINITE);
    CU_ASSERT_EQUAL(dal_batch_time(batch, 0), 0.0);
    dal_batch_free(batch);
}

/* The rank is checked lane by lane: of many bodies that slide down along x, one was thrown upwards
 * along y and comes to rest at t = 2/9.81, where its constraint is singular (see test_run.c). */
static void test_singular_lane(void)
{
    const char *text = "coordinates: [x, y, z]\n"
                       "lagrangian: (x'^2 + y'^2 + z'^2)/2 - 9.81*z\n"
                       "constraints: [(x'^2 + y'^2 - z'^2)/2]\n"
                       "start: {x': 1, z': -1}\n";
    const dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.013);
    const dal_setting upwards[] = {{"x'", 0.0}, {"y'", 1.0}, {"z'", 1.0}};
    static const int widths[] = {1, 4, 8};
    for (int w = 0; w < 3; w++) {
        dal_batch *batch = NULL;
        CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, 64, widths[w], NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_batch_start(batch, 37, NULL, 0, upwards, 3, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_batch_advance(batch, 40), DAL_STATUS_OK);
        for (int i = 0; i < 64; i++)
            CU_ASSERT_EQUAL(dal_batch_status(batch, i, NULL),
                            i == 37 ? DAL_STATUS_SINGULAR : DAL_STATUS_OK);
        CU_ASSERT_DOUBLE_EQUAL(dal_batch_time(batch, 37), 2.0 / 9.81, 2 * 0.013);
        dal_batch_free(batch);
    }
}

/* Compiled steps have as many lanes as the widest engine that few lanes fill. */
static void test_native_lanes(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system("knife-edge"), "rk4", DAL_PHYSICAL, 0.1);
    static const int counts[] = {1, 2, 4, 5, 8, 100};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        dal_batch *batch = NULL;
        CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, counts[i], 0, NULL), DAL_STATUS_OK);
        const dal__layout *k = dal__batch_layout(batch);
        const int four = dal__engine_best(k, 4) ? 4 : 1, eight = dal__engine_best(k, 8) ? 8 : four;
        const int few = counts[i] > 1 ? four : 1;
        CU_ASSERT_EQUAL(dal__batch_native_lanes(batch), counts[i] > 4 ? eight : few);
        dal_batch_free(batch);
    }
}

static void test_arguments(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system("chaplygin-sleigh"), "rk4", DAL_LIFTED, 0.1);
    dal_batch *batch = NULL;
    dal_error error;
    CU_ASSERT_EQUAL(dal_batch_create(&batch, &spec, 0, 0, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_batch_create(&batch, &spec, 3, 5, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, 3, 0, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_batch_count(batch), 3);
    CU_ASSERT_EQUAL(dal_batch_start(batch, 3, NULL, 0, NULL, 0, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_batch_status(batch, -1, &error), DAL_STATUS_ARGUMENT);
    const dal_setting bad = {"y2'", 1.0};
    CU_ASSERT_EQUAL(dal_batch_start(batch, 1, NULL, 0, &bad, 1, &error), DAL_STATUS_INCONSISTENT);
    dal_batch_free(batch);
}

/* ---- lanes that need different numbers of sweeps ---- */

/* A falling disk, its momenta different in every lane. */
static const char disk[] =
    "coordinates: [X, Y, th, ph, ps]\n"
    "let: {wn: ps' + ph'*cos(th)}\n"
    "lagrangian: 0.65*(X'^2 + Y'^2 + (0.7*cos(th)*th')^2) + 0.1*(th'^2 + ph'^2*sin(th)^2) + "
    "0.185*wn^2 - 1.9*sin(th)\n"
    "constraints:\n"
    "  - X' - 0.7*(th'*sin(th)*sin(ph) - wn*cos(ph))\n"
    "  - Y' - 0.7*(-th'*sin(th)*cos(ph) - wn*sin(ph))\n"
    "start:\n"
    "  {th: 1.3, ph: 0.4, th': 0.3, ph': 0.5, ps': 1.7,\n"
    "   X': 0.7*(0.3*sin(1.3)*sin(0.4) - (1.7 + 0.5*cos(1.3))*cos(0.4)),\n"
    "   Y': 0.7*(-0.3*sin(1.3)*cos(0.4) - (1.7 + 0.5*cos(1.3))*sin(0.4))}\n";

enum { UNEVEN = 64 };

/* Sets lane i's start; how many settings. */
static int uneven_start(int i, dal_setting *start)
{
    start[0] = (dal_setting){"p_X", i % 3 ? 0.1 * sin(i) : 0.0};
    start[1] = (dal_setting){"pi_ps", i % 3 ? 0.1 * cos(i) : 0.0};
    start[2] = (dal_setting){"e", 1.0 + 0.1 * (i % 11)};
    return 3;
}

static bool same_as_single(dal_run_spec spec, const dal_batch *batch, int lane)
{
    dal_setting start[3];
    double state[64];
    spec.start_count = uneven_start(lane, start);
    spec.start = start;
    dal_run *run = fixture_run(&spec);
    const dal_status status = dal_run_advance(run, 60, NULL);
    dal_batch_state(batch, lane, state);
    const size_t bytes = (size_t)dal_run_dimension(run) * sizeof *state;
    const bool same = status == dal_batch_status(batch, lane, NULL) &&
                      memcmp(state, dal_run_state(run), bytes) == 0;
    dal_run_free(run);
    return same;
}

/* What a lane keeps of its last sweep for the end of the step, or for Newton, must not change while
 * its neighbours go on. */
static void uneven_sweeps(const dal_system *system, const char *method)
{
    const dal_run_spec spec = fixture_spec(system, method, DAL_LIFTED, 0.02);
    dal_batch *batch = NULL;
    int differ = 0;
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, UNEVEN, 8, NULL), DAL_STATUS_OK);
    for (int lane = 0; lane < UNEVEN; lane++) {
        dal_setting start[3];
        const int count = uneven_start(lane, start);
        CU_ASSERT_EQUAL(dal_batch_start(batch, lane, NULL, 0, start, count, NULL), DAL_STATUS_OK);
    }
    CU_ASSERT_EQUAL(dal_batch_advance(batch, 60), DAL_STATUS_OK);
    for (int lane = 0; lane < UNEVEN; lane++) differ += !same_as_single(spec, batch, lane);
    if (differ) printf("\n  %s: %d lanes differ\n", method, differ);
    CU_ASSERT_EQUAL(differ, 0);
    const dal_setting e = {"e", 2.0};
    CU_ASSERT_EQUAL(dal_batch_start(batch, 0, NULL, 0, &e, 1, NULL), DAL_STATUS_ARGUMENT);
    dal_batch_free(batch);
}

static void test_uneven_sweeps(void)
{
    static const char *const methods[] = {"gauss4",           "gauss6",
                                          "gauss12",          "gauss4+project",
                                          "stormer-verlet",   "symplectic-euler-11",
                                          "implicit-midpoint"};
    for (int i = 0; i < 7; i += case_stride(3)) uneven_sweeps(fixture_system(disk), methods[i]);
}

/* A batch that was cleared steps the lanes that are started again as a new one does, those that had
 * failed among them, and leaves the others alone. */
static void test_cleared(void)
{
    const dal_system system = {.name = "breaks", .n = 1, .call.field = breaks};
    const dal_run_spec spec = fixture_spec(&system, "rk4", DAL_PHYSICAL, 0.25);
    const dal_setting bad = {"q1", 2.0}, again[] = {{"q1", 5.0}, {"q1'", 1.0}};
    dal_batch *batch = NULL;
    double state[2];
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, 11, 0, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_batch_start(batch, 1, NULL, 0, &bad, 1, NULL), DAL_STATUS_OK);
    broken = true;
    CU_ASSERT_EQUAL(dal_batch_advance(batch, 4), DAL_STATUS_OK);
    broken = false;
    CU_ASSERT_EQUAL(dal_batch_start(batch, 0, NULL, 0, NULL, 0, NULL), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_batch_clear(batch), DAL_STATUS_OK);
    for (int i = 0; i < 9; i++)
        CU_ASSERT_EQUAL(dal_batch_start(batch, i, NULL, 0, again, 2, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_batch_advance(batch, 8), DAL_STATUS_OK);
    for (int i = 0; i < 11; i++) {
        dal_batch_state(batch, i, state);
        CU_ASSERT_EQUAL(dal_batch_status(batch, i, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_batch_time(batch, i), i < 9 ? 2.0 : 1.0);
        CU_ASSERT_EQUAL(state[0], i < 9 ? 7.0 : 0.0);
    }
    dal_batch_free(batch);
}

/* x'' = cos t - x, 4 and 8 lanes of which read one time. */
static dal_status driven(const dal_system *system, const dal_point *at, double *out)
{
    (void)system;
    out[0] = cos(at->t) - at->q[0];
    return DAL_STATUS_OK;
}

/* Lanes with times and states of their own take the steps of single runs, to the bit, whether F
 * depends on t or not; a lane that had failed is stepped again. */
static void test_own_times(void)
{
    const dal_system by_hand = {.name = "driven", .n = 1, .call.field = driven};
    const dal_system *const systems[] = {
        &by_hand, fixture_system("coordinates: [q1]\nlagrangian: (q1'^2 - q1^2)/2 + q1*cos(t)\n"),
        fixture_system("coordinates: [q1]\nlagrangian: q1'^2/2 + cos(q1)\n")};
    for (int k = 0; k < 3; k++) {
        const dal_run_spec spec = fixture_spec(systems[k], "rk4", DAL_PHYSICAL, 0.25);
        dal_run *run = fixture_run(&spec);
        dal_batch *batch = NULL;
        double state[2];
        CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, 11, 0, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_batch_clear(batch), DAL_STATUS_OK);
        for (int i = 0; i < 11; i++) {
            const double from[2] = {0.1 * i, 1.0 - 0.3 * i};
            CU_ASSERT_EQUAL(dal_batch_set_state(batch, i, 0.7 * i, from, NULL), DAL_STATUS_OK);
        }
        CU_ASSERT_EQUAL(dal_batch_advance(batch, 3), DAL_STATUS_OK);
        for (int i = 0; i < 11; i++) {
            const double from[2] = {0.1 * i, 1.0 - 0.3 * i};
            CU_ASSERT_EQUAL(dal_run_set_state(run, 0.7 * i, from, NULL), DAL_STATUS_OK);
            CU_ASSERT_EQUAL(dal_run_advance(run, 3, NULL), DAL_STATUS_OK);
            dal_batch_state(batch, i, state);
            CU_ASSERT_EQUAL(dal_batch_time(batch, i), dal_run_time(run));
            CU_ASSERT_EQUAL(memcmp(state, dal_run_state(run), sizeof state), 0);
        }
        const double bad[2] = {NAN, 0.0};
        CU_ASSERT_EQUAL(dal_batch_set_state(batch, 0, 0.0, bad, NULL), DAL_STATUS_NOT_FINITE);
        CU_ASSERT_EQUAL(dal_batch_set_state(batch, 0, NAN, state, NULL), DAL_STATUS_NOT_FINITE);
        CU_ASSERT_EQUAL(dal_batch_set_state(batch, 11, 0.0, state, NULL), DAL_STATUS_ARGUMENT);
        CU_ASSERT_EQUAL(dal_batch_set_state(batch, -1, 0.0, state, NULL), DAL_STATUS_ARGUMENT);
        dal_batch_free(batch);
        dal_run_free(run);
    }
}

static void test_out_of_memory(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system(disk), "gauss4", DAL_PHYSICAL, 0.1);
    allocation_trial trial = {0};
    while (allocation_next(&trial)) {
        dal_batch *batch = NULL;
        dal_error error = {0};
        allocation_start(&trial);
        const dal_status status = dal_batch_create(&batch, &spec, 5, 0, &error);
        CU_ASSERT_EQUAL(batch == NULL, allocation_end(&trial, status));
        CU_ASSERT(error.status == status && error.line == 0 && error.column == 0);
        dal_batch_free(batch);
    }
    CU_ASSERT(trial.failures >= 4);
}

void suite_batch(void)
{
    CU_pSuite suite = CU_add_suite("batch", NULL, NULL);
    CU_add_test(suite, "the bits of single runs in every variant", test_same_bits);
    CU_add_test(suite, "stiff and easy lanes side by side", test_mixed_stiffness);
    CU_add_test(suite, "a failing lane", test_failing_lane);
    CU_add_test(suite, "a failed lane stays where it is", test_failed_lane_stays);
    CU_add_test(suite, "a lane whose constraint turns singular", test_singular_lane);
    CU_add_test(suite, "arguments", test_arguments);
    CU_add_test(suite, "lanes of compiled steps", test_native_lanes);
    CU_add_test(suite, "lanes started again", test_cleared);
    CU_add_test(suite, "lanes with times of their own", test_own_times);
    CU_add_test(suite, "out of memory", test_out_of_memory);
    CU_add_test(suite, "lanes that need different numbers of sweeps", test_uneven_sweeps);
}
