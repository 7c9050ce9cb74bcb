/* test_direction.c - runs that begin at any time and go either way: rows, checkpoints, lanes, and
 * self-adjoint methods, which return to their start. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Bilinear D, a mass matrix that depends on q, forces that depend on t. */
static const char driven[] =
    "coordinates: [x, y, z]\n"
    "lagrangian: (x'^2 + (1 + y^2)*y'^2 + z'^2)/2 - (x^2 + y^2 + z^2 + 0.3*x^2*z^2)/2\n"
    "forces: {x: 0.2*cos(3*t), z: 0.1*sin(t)*y}\n"
    "constraints: [x' + y*z']\n"
    "start: {x: 0.8, y: 0.6, z: -0.5, x': -0.24, y': 0.7, z': 0.4}\n";

/* ---- there and back ---- */

enum { STEPS = 40 };

static const double step = 0.1, start_time = 0.7;

/* max |x - x(0)| of (q,v) after STEPS steps and as many of size -h; NaN: a step failed. */
static double distance_of(dal_run_spec spec)
{
    double begin[64], end[64], distance = 0.0;
    spec.start_time = start_time;
    dal_run *there = fixture_run(&spec);
    const int dimension = dal_run_dimension(there);
    const size_t bytes = (size_t)dimension * sizeof *begin;
    memcpy(begin, dal_run_state(there), bytes);
    const dal_status went = dal_run_advance(there, STEPS, NULL);
    memcpy(end, dal_run_state(there), bytes);
    spec.options.step = -step;
    dal_run *back = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_set_state(back, dal_run_time(there), end, NULL), DAL_STATUS_OK);
    const dal_status returned = dal_run_advance(back, STEPS, NULL);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_time(back), start_time, 1e-15);
    for (int i = 0; i < 2 * spec.system->n; i++)
        distance = fmax(distance, fabs(dal_run_state(back)[i] - begin[i]));
    dal_run_free(there);
    dal_run_free(back);
    return went == DAL_STATUS_OK && returned == DAL_STATUS_OK ? distance : NAN;
}

/* Rounding of some eighty steps, with the condition of the implicit equations. */
static const double rounding = 2e-12;

static int check_return(const dal_system *system, const char *name)
{
    dal_method method;
    CU_ASSERT_EQUAL_FATAL(dal_method_parse(&method, name, NULL), DAL_STATUS_OK);
    const unsigned properties = dal_method_properties(&method);
    const dal_run_spec spec = fixture_spec(system, name, DAL_PHYSICAL, step);
    /* The last multipliers are a part of the state of these, and not of (q,v). */
    if (properties & DAL_PERSISTENT_MULTIPLIER || !(properties & DAL_SYMMETRIC)) return 0;
    if (!fixture_accepts(&method, system, DAL_PHYSICAL) || dal_run_size(&spec) == 0) return 0;
    const double distance = distance_of(spec);
    if (!(distance <= rounding)) printf("\n  %s returns within %.2e\n", name, distance);
    CU_ASSERT(distance <= rounding);
    return 1;
}

static int check_returns(const char *text)
{
    const dal_system *system = fixture_system(text);
    int count = 0;
    char name[64];
    for (int i = 0; dal_integrator_at(i); i++) {
        const dal_integrator *inner = dal_integrator_at(i);
        if (inner->properties & DAL_MODIFIER) continue;
        count += check_return(system, inner->name);
        for (int k = 0; dal_integrator_at(k); k++) {
            const dal_integrator *outer = dal_integrator_at(k);
            if (!(outer->properties & DAL_MODIFIER)) continue;
            snprintf(name, sizeof name, "%s+%s", inner->name, outer->name);
            count += check_return(system, name);
        }
    }
    return count;
}

static void test_return(void)
{
    CU_ASSERT(check_returns(fixture_bilinear) > 20);
    CU_ASSERT(check_returns(driven) > 10);
}

/* The distance that the others have: the test above can see one. */
static void test_no_return(void)
{
    static const char *const names[] = {"rk4", "gni", "lobatto-nonholonomic2"};
    const dal_system *system = fixture_system(fixture_bilinear);
    for (int i = 0; i < 3; i++) {
        const double distance = distance_of(fixture_spec(system, names[i], DAL_PHYSICAL, step));
        if (!(distance > 1e-9)) printf("\n  %s returns within %.2e\n", names[i], distance);
        CU_ASSERT(distance > 1e-9);
    }
}

/* ---- the time of the start ---- */

static const char forced[] = "coordinates: [x]\nlagrangian: x'^2/2\nforces: {x: cos(t)}\n"
                             "start: {x: 0.2, x': -0.3}\n";

/* x'' = cos t from x, x' at T0. */
static double forced_place(double from, double t)
{
    return 0.2 - (0.3 + sin(from)) * (t - from) + cos(from) - cos(t);
}

static void test_closed_form(void)
{
    static const double from[] = {0.0, 2.5, -40.0};
    for (int i = 0; i < 6; i++) {
        const double h = i % 2 ? -0.05 : 0.05;
        dal_run_spec spec = fixture_spec(fixture_system(forced), "gauss8", DAL_PHYSICAL, h);
        spec.start_time = from[i / 2];
        dal_run *run = fixture_run(&spec);
        CU_ASSERT_EQUAL(dal_run_time(run), from[i / 2]);
        CU_ASSERT_EQUAL(dal_run_advance(run, 60, NULL), DAL_STATUS_OK);
        const double t = from[i / 2] + 60 * h;
        CU_ASSERT_DOUBLE_EQUAL(dal_run_time(run), t, 1e-14);
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[0], forced_place(from[i / 2], t), 1e-12);
        dal_run_free(run);
    }
}

/* Substeps under control go backwards, too. */
static void test_control(void)
{
    dal_run_spec spec = fixture_spec(fixture_system(forced), "dop853", DAL_PHYSICAL, -2.0);
    spec.options.tolerance = 1e-12;
    spec.start_time = 2.5;
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_advance(run, 3, NULL), DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[0], forced_place(2.5, -3.5), 1e-10);
    dal_run_free(run);
}

static void test_batch(void)
{
    dal_run_spec spec = fixture_spec(fixture_system(driven), "gauss4", DAL_LIFTED, -0.02);
    spec.start_time = 1.25;
    dal_run *run = fixture_run(&spec);
    dal_batch *batch = NULL;
    double state[64];
    CU_ASSERT_EQUAL(dal_run_advance(run, 30, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, 9, 0, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_batch_start(batch, 8, NULL, 0, NULL, 0, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_batch_time(batch, 8), 1.25);
    CU_ASSERT_EQUAL(dal_batch_advance(batch, 30), DAL_STATUS_OK);
    for (int lane = 0; lane < 9; lane++) {
        dal_batch_state(batch, lane, state);
        CU_ASSERT_EQUAL(dal_batch_time(batch, lane), dal_run_time(run));
        CU_ASSERT_EQUAL(
            memcmp(state, dal_run_state(run), (size_t)dal_run_dimension(run) * sizeof *state), 0);
    }
    dal_batch_free(batch);
    dal_run_free(run);
}

/* ---- rows ---- */

enum { ROWS = 7 };

typedef struct rows {
    double t[ROWS + 1], x[ROWS + 1];
    int count, end; /* the number of rows before the observer interrupts the run */
} rows;

static dal_status add_row(void *user, dal_run *run, long long row, double t)
{
    rows *r = user;
    r->t[row] = t;
    r->x[row] = dal_run_state(run)[0];
    CU_ASSERT_DOUBLE_EQUAL(dal_run_time(run), t, 1e-14);
    return ++r->count == r->end ? DAL_STATUS_INTERRUPTED : DAL_STATUS_OK;
}

/* Rows at equal distances between steps, and the same after an interruption and a restore. */
static void check_rows(double h, double T)
{
    size_t count;
    rows whole = {.end = -1}, half = {.end = 4};
    const dal_observer all = {.user = &whole, .sample = add_row},
                       some = {.user = &half, .sample = add_row};
    dal_run_spec spec = fixture_spec(fixture_system(forced), "gauss8", DAL_PHYSICAL, h);
    spec.start_time = 2.5;
    dal_run *run = fixture_run(&spec), *first = fixture_run(&spec), *second = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_sample(run, T, ROWS, 0, &all, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(whole.count, ROWS + 1);
    for (int i = 0; i <= ROWS; i++) {
        CU_ASSERT_DOUBLE_EQUAL(whole.t[i], 2.5 + (T - 2.5) * i / ROWS, 1e-14);
        CU_ASSERT_DOUBLE_EQUAL(whole.x[i], forced_place(2.5, whole.t[i]), 1e-12);
    }
    CU_ASSERT_EQUAL(whole.t[ROWS], T);
    CU_ASSERT_EQUAL(dal_run_sample(first, T, ROWS, 0, &some, NULL), DAL_STATUS_INTERRUPTED);
    const double *saved = dal_run_save(first, &count);
    CU_ASSERT_EQUAL(dal_run_restore(second, saved, count, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_sample(second, T, ROWS, 4, &some, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(memcmp(whole.x, half.x, sizeof whole.x), 0);
    dal_run_free(run);
    dal_run_free(first);
    dal_run_free(second);
}

static void test_rows(void)
{
    check_rows(0.03, 3.5);
    check_rows(-0.03, 1.5);
}

/* A drift at one rate is seen whichever way time goes, by its size since the start. */
static void test_trend(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        dal_statistics s;
        dal_trend trend;
        dal_statistics_start(&s, 1);
        for (int i = 0; i <= 4000; i++) {
            const double x = 1.0 + 1e-6 * i + 1e-5 * sin(i);
            dal_statistics_add(&s, 1, 5.0 + sign * 0.1 * i, &x);
        }
        dal_statistics_classify(&s, 1.0, DAL_STATUS_OK, &trend);
        CU_ASSERT_EQUAL(trend.trend, DAL_TREND_LINEAR);
        CU_ASSERT_DOUBLE_EQUAL(trend.rate, 1e-5, 1e-8);
        CU_ASSERT(trend.rate_low <= trend.rate && trend.rate <= trend.rate_high);
        CU_ASSERT(trend.max_drift > 0.0);
    }
}

/* ---- what is refused ---- */

static void refuse_end(dal_run *run, double T, const char *fragment)
{
    dal_error error = {0};
    CU_ASSERT_EQUAL(dal_run_sample(run, T, 10, 0, NULL, &error), DAL_STATUS_ARGUMENT);
    if (!strstr(error.message, fragment)) printf("\n  '%s'\n", error.message);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, fragment));
}

static void test_refused(void)
{
    dal_run_spec spec = fixture_spec(fixture_system(forced), "rk4", DAL_PHYSICAL, -0.1);
    spec.start_time = 2.0;
    dal_run *run = fixture_run(&spec);
    refuse_end(run, 3.0, "a step of -0.1 does not lead from t = 2 to 3");
    refuse_end(run, 2.0, "a step of -0.1 does not lead from t = 2 to 2");
    refuse_end(run, 1.95, "the step -0.1 is larger than the time -0.05");
    refuse_end(run, -INFINITY, "the time must be finite");
    dal_run_free(run);
    spec.start_time = NAN;
    fixture_refused(&spec, DAL_STATUS_ARGUMENT, "the time of the start must be finite");
    spec.start_time = 0.0;
    spec.options.step = 0.0;
    fixture_refused(&spec, DAL_STATUS_ARGUMENT, "the step must be finite and not 0");
}

void suite_direction(void)
{
    CU_pSuite suite = CU_add_suite("direction", NULL, NULL);
    CU_add_test(suite, "self-adjoint methods return", test_return);
    CU_add_test(suite, "others do not", test_no_return);
    CU_add_test(suite, "a start at any time", test_closed_form);
    CU_add_test(suite, "substeps backwards", test_control);
    CU_add_test(suite, "lanes", test_batch);
    CU_add_test(suite, "rows, and a checkpoint between them", test_rows);
    CU_add_test(suite, "trends", test_trend);
    CU_add_test(suite, "directions that lead nowhere", test_refused);
}
