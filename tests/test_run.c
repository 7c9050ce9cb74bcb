/* test_run.c - runs: creation and its errors, steps as transactions, failures and their causes,
 * samples. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- a system by hand: x'' = -x, and x'' = -x that fails now and then ---- */

/* data: an int that counts down to a failure. */
static dal_status fail_sometimes(const dal_system *system, const dal_point *at, double *out)
{
    int *left = system->data;
    if (--*left == 0) return DAL_STATUS_NOT_FINITE;
    return fixture_oscillate(system, at, out);
}

static dal_status unit_start(const dal_system *system, const dal_point *at, double *out)
{
    (void)system;
    (void)at;
    out[0] = 1.0;
    return DAL_STATUS_OK;
}

static dal_system hand_made(dal_callback *field, void *data)
{
    return (dal_system){
        .name = "hand", .n = 1, .call.field = field, .start = unit_start, .data = data};
}

static void test_by_hand(void)
{
    const dal_system system = hand_made(fixture_oscillate, NULL);
    dal_run_spec spec = fixture_spec(&system, "gauss8", DAL_PHYSICAL, 0.1);
    dal_run *run = fixture_stepped(&spec, 100);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[0], cos(10.0), 1e-13);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[1], -sin(10.0), 1e-13);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_time(run), 10.0, 0.0);
    CU_ASSERT_EQUAL(dal_run_steps(run), 100);
    char name[16];
    CU_ASSERT_STRING_EQUAL(dal_run_component_name(run, 1, name, sizeof name), "q1'");
    CU_ASSERT_PTR_NULL(dal_run_component_name(run, 2, name, sizeof name));
    dal_run_free(run);
}

/* ---- creation refuses what cannot work ---- */

static void test_refusals(void)
{
    const dal_system *system = fixture_system("chaplygin-sleigh");
    const double steps[] = {0.0, -INFINITY, NAN, INFINITY};
    for (int i = 0; i < 4; i++) {
        const dal_run_spec spec = fixture_spec(system, "rk4", DAL_LIFTED, steps[i]);
        fixture_refused(&spec, DAL_STATUS_ARGUMENT, "step");
    }
    const dal_system bare = hand_made(fixture_oscillate, NULL);
    dal_run_spec spec = fixture_spec(&bare, "rk4", DAL_LIFTED, 0.1);
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, "rk4 cannot act on hand");
    spec = fixture_spec(&bare, "implicit-midpoint", DAL_PHYSICAL, 0.1);
    spec.options.solver = DAL_NEWTON;
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, "jacobian");
    const dal_system empty = {.name = "empty", .n = 0, .call.field = fixture_oscillate};
    spec = fixture_spec(&empty, "rk4", DAL_PHYSICAL, 0.1);
    fixture_refused(&spec, DAL_STATUS_ARGUMENT, "n is 0");
    spec = fixture_spec(system, "rk4", DAL_PHYSICAL, 0.1);
    spec.method.layer[0] = NULL;
    fixture_refused(&spec, DAL_STATUS_ARGUMENT, "integrator");
    /* Layers after a gap would not act. */
    CU_ASSERT_EQUAL(dal_method_parse(&spec.method, "rk4+project", NULL), DAL_STATUS_OK);
    spec.method.layer[3] = spec.method.layer[1];
    fixture_refused(&spec, DAL_STATUS_ARGUMENT,
                    "layer 3 of the method is missing: layer 4 is 'project'");
    spec.method.layer[0] = NULL;
    fixture_refused(&spec, DAL_STATUS_ARGUMENT,
                    "layer 1 of the method is missing: layer 2 is 'project'");
}

static void test_settings(void)
{
    dal_run_spec spec = fixture_spec(fixture_system("chaplygin-sleigh"), "rk4", DAL_LIFTED, 0.1);
    dal_setting bad = {"omeg", 1.0};
    spec.parameters = &bad;
    spec.parameter_count = 1;
    fixture_refused(&spec, DAL_STATUS_NAME, "'omega'");
    spec.parameter_count = 0;
    spec.start = &bad;
    spec.start_count = 1;
    bad = (dal_setting){"pi_ph", 1.0};
    fixture_refused(&spec, DAL_STATUS_NAME, "'pi_phi'");
    bad = (dal_setting){"y2'", 0.1};
    fixture_refused(&spec, DAL_STATUS_INCONSISTENT, "constraint 1");
    bad = (dal_setting){"e", 0.0};
    fixture_refused(&spec, DAL_STATUS_GAUGE, "e = 0");
    bad = (dal_setting){"phi", NAN};
    fixture_refused(&spec, DAL_STATUS_ARGUMENT, "phi");
    spec.options.space = DAL_PHYSICAL;
    bad = (dal_setting){"p_phi", 1.0};
    fixture_refused(&spec, DAL_STATUS_NAME, "p_phi");
    /* Start formulas follow the parameters: y1' = v0. */
    const dal_setting speed = {"v0", 2.5};
    spec.start_count = 0;
    spec.parameters = &speed;
    spec.parameter_count = 1;
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_state(run)[3], 2.5);
    dal_run_free(run);
}

static dal_status stand_still(const dal_system *system, const dal_point *at, double *out)
{
    (void)system;
    (void)at;
    out[0] = out[1] = 0.0;
    return DAL_STATUS_OK;
}

/* D = (x' + y', 2 x' + 2 y'), unit masses. */
static dal_status twice(const dal_system *system, const dal_point *at, double *out)
{
    static const double a[] = {1, 1, 2, 2}, b[] = {1, 2, 1, 2};
    (void)system;
    out[0] = at->v[0] + at->v[1];
    out[1] = 2.0 * out[0];
    memcpy(out + 2, a, sizeof a);
    memcpy(out + 6, b, sizeof b);
    return DAL_STATUS_OK;
}

static void test_rank(void)
{
    /* By hand, as a model already refuses such formulas. */
    const dal_system system = {.name = "twice",
                               .n = 2,
                               .m = 2,
                               .call = {.field = stand_still, .constraint = twice},
                               .constraints = stand_still};
    const dal_run_spec spec = fixture_spec(&system, "rk4", DAL_PHYSICAL, 0.1);
    fixture_refused(&spec, DAL_STATUS_RANK, "constraint 2");
}

/* ---- a step succeeds or leaves the run bitwise unchanged ---- */

static void test_transaction(void)
{
    static const char *const methods[] = {"rk4", "gauss6", "stormer-verlet", "rk4+project"};
    for (int k = 0; k < 4; k++) {
        int countdown = 1 << 20;
        const dal_system system = hand_made(fail_sometimes, &countdown);
        const dal_run_spec spec = fixture_spec(&system, methods[k], DAL_PHYSICAL, 0.1);
        dal_run *run = fixture_run(&spec);
        size_t count;
        const double *memory = dal_run_save(run, &count);
        double *copy = malloc(count * sizeof *copy);
        for (int step = 0; step < 50; step++) {
            memcpy(copy, memory, count * sizeof *copy);
            countdown = 1 + step % 9; /* fails at the first, second, ... evaluation */
            const int expected = countdown;
            const dal_status status = dal_run_step(run, NULL);
            if (status == DAL_STATUS_OK) continue;
            CU_ASSERT(countdown < expected);
            CU_ASSERT_EQUAL(memcmp(copy, memory, count * sizeof *copy), 0);
            countdown = 1 << 20;
            CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
        }
        /* The failures left no trace. */
        countdown = 1 << 20;
        dal_run *other = fixture_stepped(&spec, dal_run_steps(run));
        CU_ASSERT_EQUAL(memcmp(dal_run_state(run), dal_run_state(other), 2 * sizeof(double)), 0);
        free(copy);
        dal_run_free(run);
        dal_run_free(other);
    }
}

/* ---- failures name their cause ---- */

static void fails(const char *name, const char *method, double h, long long steps,
                  const dal_setting *start, int start_count, dal_status status,
                  const char *fragment)
{
    dal_error error = {0};
    dal_run_spec spec = fixture_spec(fixture_system(name), method, DAL_LIFTED, h);
    spec.start = start;
    spec.start_count = start_count;
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_advance(run, steps, &error), status);
    if (!strstr(error.message, fragment)) printf("\n  %s: '%s'\n", method, error.message);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, fragment));
    for (int i = 0; i < dal_run_dimension(run); i++) CU_ASSERT(isfinite(dal_run_state(run)[i]));
    dal_run_free(run);
}

static void test_failures(void)
{
    static const char *const methods[] = {"rk4", "gauss4", "stormer-verlet+project"};
    for (int i = 0; i < 3; i++)
        fails("chaplygin-sleigh-nonlinear", methods[i], 0.01, 400, NULL, 0, DAL_STATUS_SINGULAR,
              "constraint 1");
    const char *gauge = "coordinates: [x]\nlagrangian: x'^2/2\ngauge: {e: 1, mu_e: -1}\n";
    fails(gauge, "rk4", 0.3, 10, NULL, 0, DAL_STATUS_GAUGE, "e reached zero");
    fails(gauge, "implicit-midpoint", 0.25, 10, NULL, 0, DAL_STATUS_GAUGE, "e reached zero");
    /* K = (v + h K/2)^2 + 1 has no real root from h = 1 on. */
    const char *rootless = "coordinates: [x]\nlagrangian: x'^2/2\nforces: {x: x'^2 + 1}\n";
    fails(rootless, "implicit-midpoint", 50.0, 10, NULL, 0, DAL_STATUS_NOT_CONVERGED,
          "did not converge");
    /* Before it e = 1 - t has reached 0, where nothing is defined either. */
    const char *rootless_gauge = "coordinates: [x]\nlagrangian: x'^2/2\nforces: {x: x'^2 + 1}\n"
                                 "gauge: {e: 1, mu_e: -1}\n";
    fails(rootless_gauge, "implicit-midpoint", 50.0, 10, NULL, 0, DAL_STATUS_GAUGE,
          "e reached zero");
    fails(rootless, "gauss6", 50.0, 10, NULL, 0, DAL_STATUS_NOT_CONVERGED, "did not converge");
    fails(rootless, "symplectic-euler-11", 50.0, 10, NULL, 0, DAL_STATUS_NOT_CONVERGED,
          "did not converge");
    const char *pole =
        "coordinates: [x]\nlagrangian: x'^2/2\nforces: {x: -sqrt(x)}\nstart: {x: 1}\n";
    fails(pole, "rk4", 0.1, 100, NULL, 0, DAL_STATUS_NOT_FINITE, "not finite");
}

/* A body under D = (x'^2 + y'^2 - z'^2)/2 thrown upwards comes to rest, where G = 0. */
static void test_rest_is_singular(void)
{
    const char *text = "coordinates: [x, y, z]\n"
                       "lagrangian: (x'^2 + y'^2 + z'^2)/2 - 9.81*z\n"
                       "constraints: [(x'^2 + y'^2 - z'^2)/2]\n"
                       "start: {x': 1, z': 1}\n";
    static const char *const methods[] = {"rk4", "gauss8", "gauss12+project"};
    static const double steps[] = {0.001, 0.013, 0.1};
    for (int i = 0; i < 9; i++)
        fails(text, methods[i / 3], steps[i % 3], 1000, NULL, 0, DAL_STATUS_SINGULAR,
              "constraint 1");
    const dal_setting falling = {"z'", -1.0};
    dal_run_spec spec = fixture_spec(fixture_system(text), "gauss8", DAL_LIFTED, 0.013);
    spec.start = &falling;
    spec.start_count = 1;
    dal_run *run = fixture_stepped(&spec, 100);
    dal_run_free(run);
}

/* A snakeboard whose axles turn across it, phi = pi/2, where the two constraints depend;
 * and a normal that vanishes with a factor of D.  Between steps G recovers: nothing but the turn
 * shows it.  (phi' is constant; phi = pi/2 at t = 2.14, x = 0 at t = 1.) */
static void test_leapt_over(void)
{
    const char *board = "coordinates: [x, y, th, psi, phi]\n"
                        "lagrangian: 0.6*(x'^2 + y'^2) + 0.4*th'^2 + 0.3*th'*psi' + 0.15*psi'^2"
                        " + 0.1*phi'^2\n"
                        "constraints:\n"
                        "  - -sin(th + phi)*x' + cos(th + phi)*y' + 0.8*cos(phi)*th'\n"
                        "  - -sin(th - phi)*x' + cos(th - phi)*y' - 0.8*cos(phi)*th'\n"
                        "start: {phi: 0.5, x': 0.8, th': tan(0.5), psi': 0.9, phi': 0.5}\n";
    const char *factor = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                         "constraints: [-2*(y' - 1)*sin(x)]\nstart: {x: -1, x': 1, y': 1}\n";
    static const char *const methods[] = {"rk4", "gauss4", "stormer-verlet+project"};
    static const double steps[] = {0.007, 0.013, 0.11};
    for (int i = 0; i < 9; i++) {
        fails(board, methods[i / 3], steps[i % 3], 400, NULL, 0, DAL_STATUS_SINGULAR,
              "constraint 2");
        fails(factor, methods[i / 3], steps[i % 3], 400, NULL, 0, DAL_STATUS_SINGULAR,
              "a factor goes");
    }
}

/* W = 1 - x, or W = ((1, x), (x, 1)), through zero between two steps. */
static void test_mass_is_singular(void)
{
    static const char *const methods[] = {"rk4", "gauss6", "stormer-verlet"};
    for (int i = 0; i < 3; i++) {
        fails("coordinates: [x]\nlagrangian: (1 - x)*x'^2/2 + x\nstart: {x': 1}\n", methods[i],
              0.013, 500, NULL, 0, DAL_STATUS_SINGULAR_MASS, "mass matrix");
        fails("coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + x*x'*y'\nstart: {x': 1, y': "
              "-1}\n",
              methods[i], 0.013, 500, NULL, 0, DAL_STATUS_SINGULAR_MASS, "mass matrix");
    }
}

/* ---- samples ---- */

typedef struct rows {
    long long count, stop_at;
    double t[64], x[64];
} rows;

static dal_status keep_row(void *user, dal_run *run, long long row, double t)
{
    rows *r = user;
    if (r->count == r->stop_at) return DAL_STATUS_INTERRUPTED;
    r->t[row] = t;
    r->x[row] = dal_run_state(run)[0];
    r->count++;
    return DAL_STATUS_OK;
}

static void sample(dal_run *run, double T, long long samples, long long first, rows *r)
{
    const dal_observer observer = {.user = r, .sample = keep_row};
    CU_ASSERT_EQUAL(dal_run_sample(run, T, samples, first, &observer, NULL), DAL_STATUS_OK);
}

static void test_samples(void)
{
    const dal_system system = hand_made(fixture_oscillate, NULL);
    const dal_run_spec spec = fixture_spec(&system, "gauss8", DAL_PHYSICAL, 0.3);
    rows a = {.stop_at = 99}, b = {.stop_at = 99};
    dal_run *run = fixture_run(&spec), *other = fixture_run(&spec);
    sample(run, 10.0, 40, 0, &a); /* rows between steps, the last step cut short */
    CU_ASSERT_EQUAL(a.count, 41);
    CU_ASSERT_EQUAL(a.t[0], 0.0);
    CU_ASSERT_EQUAL(a.t[40], 10.0);
    for (int i = 0; i <= 40; i++) CU_ASSERT_DOUBLE_EQUAL(a.x[i], cos(a.t[i]), 1e-10);
    CU_ASSERT_EQUAL(dal_run_steps(run), 33);
    CU_ASSERT_EQUAL(dal_run_advance(other, 33, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(memcmp(dal_run_state(run), dal_run_state(other), 2 * sizeof(double)), 0);
    dal_run_free(run);
    dal_run_free(other);

    /* Stopped at a row and taken up again from there: the same rows. */
    run = fixture_run(&spec);
    b.stop_at = 17;
    const dal_observer observer = {.user = &b, .sample = keep_row};
    dal_error error;
    CU_ASSERT_EQUAL(dal_run_sample(run, 10.0, 40, 0, &observer, &error), DAL_STATUS_INTERRUPTED);
    CU_ASSERT_EQUAL(error.status, DAL_STATUS_INTERRUPTED);
    b.stop_at = 99;
    sample(run, 10.0, 40, 17, &b);
    CU_ASSERT_EQUAL(memcmp(a.x, b.x, 41 * sizeof(double)), 0);
    dal_run_free(run);

    run = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_sample(run, 0.1, 1, 0, &observer, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "larger than the time"));
    CU_ASSERT_EQUAL(dal_run_sample(run, 1e300, 1, 0, &observer, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "more than can be counted"));
    CU_ASSERT_EQUAL(dal_run_sample(run, NAN, 1, 0, &observer, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_run_sample(run, 1.0, 0, 0, &observer, &error), DAL_STATUS_ARGUMENT);
    dal_run_free(run);
}

/* ---- polls ---- */

typedef struct polled {
    dal_observer observer;
    long long before, gap; /* the step of the last poll, the most steps between two */
} polled;

/* Requests fewer polls from step 512 on. */
static dal_status note_poll(void *user, dal_run *run)
{
    polled *p = user;
    const long long step = dal_run_steps(run), gap = step - p->before;
    if (gap > p->gap) p->gap = gap;
    p->before = step;
    if (step >= 512 && p->observer.polling == 9) p->observer.polling = 100;
    return DAL_STATUS_OK;
}

/* 9 is rounded down to 7, 100 to 62; by default there are 992 steps from one to the next. */
static void test_polls(void)
{
    const dal_system system = hand_made(fixture_oscillate, NULL);
    const dal_run_spec spec = fixture_spec(&system, "rk4", DAL_PHYSICAL, 0.1);
    static const struct {
        long long polling, steps, gap;
    } cases[] = {{1, 500, 1}, {9, 500, 7}, {9, 5000, 62}, {0, 5000, 992}, {5000, 5000, 992}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        dal_run *run = fixture_run(&spec);
        polled p = {.observer = {.user = &p, .poll = note_poll, .polling = cases[i].polling}};
        const double T = 0.1 * (double)cases[i].steps;
        CU_ASSERT_EQUAL(dal_run_sample(run, T, 1, 0, &p.observer, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(p.gap, cases[i].gap);
        CU_ASSERT(cases[i].steps - p.before <= 2 * cases[i].gap);
        dal_run_free(run);
    }
}

void suite_run(void)
{
    CU_pSuite suite = CU_add_suite("run", NULL, NULL);
    CU_add_test(suite, "a system by hand", test_by_hand);
    CU_add_test(suite, "what creation refuses", test_refusals);
    CU_add_test(suite, "settings by name", test_settings);
    CU_add_test(suite, "rank-deficient constraints", test_rank);
    CU_add_test(suite, "a step is a transaction", test_transaction);
    CU_add_test(suite, "failures name their cause", test_failures);
    CU_add_test(suite, "G singular at rest", test_rest_is_singular);
    CU_add_test(suite, "G singular between steps", test_leapt_over);
    CU_add_test(suite, "W singular on the way", test_mass_is_singular);
    CU_add_test(suite, "rows", test_samples);
    CU_add_test(suite, "polls", test_polls);
}
