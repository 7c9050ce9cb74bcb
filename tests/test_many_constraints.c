/* test_many_constraints.c - the rank check of many constraints, by the factors of F: copies of
 * systems that reach a singular place at a known time, of which one or two do. */
#include "allocation.h"
#include "compiler.h"
#include "fixtures.h"
#include "run/layout.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { MANY = 16, EACH = 5, MAX_SETTINGS = MANY * EACH };
static const double STEP = 0.013;

/* Copies of one system, and the ones of the bits `singular` with another start. */
typedef struct copies {
    int count;
    unsigned singular;
    double time; /* when these become singular */
    const char *reason;
    const dal_system *system;
    dal_setting start[MAX_SETTINGS];
    char name[MAX_SETTINGS][8];
    int settings;
} copies;

static void set(copies *c, const char *variable, int i, const char *prime, double value)
{
    char *name = c->name[c->settings];
    snprintf(name, sizeof c->name[0], "%s%d%s", variable, i, prime);
    c->start[c->settings++] = (dal_setting){name, value};
}

/* Bodies under (x'^2 + y'^2 - z'^2)/2 = 0.  Those thrown upwards along y lose the speed 1 at half
 * of g = 9.81 and come to rest, where the gradient of their constraint vanishes and turns. */
static void throw_bodies(copies *c, int count, unsigned singular)
{
    char text[512];
    snprintf(text, sizeof text,
             "coordinates: ['x[0..%d]', 'y[0..%d]', 'z[0..%d]']\n"
             "lagrangian: sum(i, 0, %d, (x[i]'^2 + y[i]'^2 + z[i]'^2)/2 - 9.81*z[i])\n"
             "constraints: [{for: i = 0..%d, is: \"(x[i]'^2 + y[i]'^2 - z[i]'^2)/2\"}]\n",
             count - 1, count - 1, count - 1, count - 1, count - 1);
    *c = (copies){.count = count, .singular = singular, .time = 2.0 / 9.81, .reason = "its normal"};
    c->system = fixture_system(text);
    for (int i = 0; i < count; i++) {
        const bool up = singular >> i & 1u;
        set(c, "x", i, "'", up ? 0.0 : 1.0);
        set(c, "y", i, "'", up ? 1.0 : 0.0);
        set(c, "z", i, "'", up ? 1.0 : -1.0);
    }
}

/* Snakeboards, of two constraints each, which depend on each other where phi = pi/2.  phi' is
 * constant; the others turn their axles the other way. */
static void turn_boards(copies *c, int count, unsigned singular)
{
    char text[1024];
    const int last = count - 1;
    snprintf(text, sizeof text,
             "coordinates: ['x[0..%d]', 'y[0..%d]', 'a[0..%d]', 'b[0..%d]', 'c[0..%d]']\n"
             "lagrangian: sum(i, 0, %d, 0.6*(x[i]'^2 + y[i]'^2) + 0.4*a[i]'^2 + 0.3*a[i]'*b[i]' + "
             "0.15*b[i]'^2 + 0.1*c[i]'^2)\n"
             "constraints:\n"
             "  - {for: i = 0..%d, is: \"-sin(a[i] + c[i])*x[i]' + cos(a[i] + c[i])*y[i]' + "
             "0.8*cos(c[i])*a[i]'\"}\n"
             "  - {for: i = 0..%d, is: \"-sin(a[i] - c[i])*x[i]' + cos(a[i] - c[i])*y[i]' - "
             "0.8*cos(c[i])*a[i]'\"}\n",
             last, last, last, last, last, last, last, last);
    *c = (copies){.count = count, .singular = singular, .time = 2.0 * (acos(0.0) - 0.5)};
    c->reason = "its normal";
    c->system = fixture_system(text);
    for (int i = 0; i < count; i++) {
        set(c, "c", i, "", 0.5);
        set(c, "x", i, "'", 0.8);
        set(c, "a", i, "'", tan(0.5));
        set(c, "b", i, "'", 0.9);
        set(c, "c", i, "'", singular >> i & 1u ? 0.5 : -0.1);
    }
}

static int first_singular(const copies *c)
{
    for (int i = 0; i < c->count; i++)
        if (c->singular >> i & 1u) return i + 1;
    return 0;
}

static dal_run_spec spec_of(const copies *c, const char *method)
{
    dal_run_spec spec = fixture_spec(c->system, method, DAL_PHYSICAL, STEP);
    spec.start = c->start;
    spec.start_count = c->settings;
    return spec;
}

/* A run steps up to the time of the singular copies, and names the first of their constraints; one
 * without them does not fail. */
static void check_run(const copies *c, const char *method, bool is_native)
{
    const dal_run_spec spec = spec_of(c, method);
    const int steps = (int)(1.5 * c->time / STEP);
    dal_run *run = fixture_run(&spec);
    dal_error error = {0};
    char name[32];
    if (is_native) CU_ASSERT_EQUAL(dal_run_native(run, &compiler_options, &error), DAL_STATUS_OK);
    const dal_status status = dal_run_advance(run, steps, &error);
    CU_ASSERT_EQUAL(status, c->singular ? DAL_STATUS_SINGULAR : DAL_STATUS_OK);
    if (c->singular) {
        snprintf(name, sizeof name, "constraint %d becomes", first_singular(c));
        CU_ASSERT_DOUBLE_EQUAL(dal_run_time(run), c->time, 2.0 * STEP);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.message, name));
        CU_ASSERT_PTR_NOT_NULL(strstr(error.message, c->reason));
    }
    dal_run_free(run);
}

static void check_methods(const copies *c)
{
    static const char *const methods[] = {"rk4", "gauss4", "rk4+project"};
    for (int i = 0; i < 3; i++) check_run(c, methods[i], false);
}

static bool by_factors(const copies *c, double tolerance)
{
    dal_run_spec spec = spec_of(c, tolerance > 0.0 ? "dop853" : "rk4");
    dal__layout layout;
    spec.options.tolerance = tolerance;
    CU_ASSERT(dal__checks_rank(c->system));
    CU_ASSERT_EQUAL_FATAL(dal__layout_init(&layout, &spec, NULL), DAL_STATUS_OK);
    return dal__checks_rank_by_factors(&layout);
}

static void test_which(void)
{
    copies c;
    throw_bodies(&c, MANY, 0);
    CU_ASSERT(by_factors(&c, 0.0));
    CU_ASSERT(!by_factors(&c, 1e-6));
    throw_bodies(&c, MANY - 1, 0);
    CU_ASSERT(!by_factors(&c, 0.0));
    turn_boards(&c, MANY / 2, 0);
    CU_ASSERT(by_factors(&c, 0.0));
}

static void test_vanishing(void)
{
    copies c;
    throw_bodies(&c, MANY, 0);
    check_methods(&c);
    throw_bodies(&c, MANY, 1u << 7);
    check_methods(&c);
}

/* Two at once, after which det A W^-1 A^T would have its sign again. */
static void test_two(void)
{
    copies c;
    throw_bodies(&c, MANY, 1u << 3 | 1u << 9);
    check_methods(&c);
}

static void test_parallel(void)
{
    copies c;
    turn_boards(&c, MANY / 2, 0);
    check_run(&c, "rk4", false);
    turn_boards(&c, MANY / 2, 1u << 5);
    check_methods(&c);
}

/* Each lane has the check of its own. */
static void test_lanes(void)
{
    enum { LANES = 16, UPWARDS = 11 };
    static const int widths[] = {1, 4, 8};
    copies c, other;
    throw_bodies(&c, MANY, 0);
    throw_bodies(&other, MANY, 1u << 7);
    const dal_run_spec spec = spec_of(&c, "rk4");
    const int steps = (int)(1.5 * other.time / STEP);
    for (int w = 0; w < 3; w++) {
        dal_batch *batch = NULL;
        CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, LANES, widths[w], NULL),
                              DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_batch_start(batch, UPWARDS, NULL, 0, other.start, other.settings, NULL),
                        DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_batch_advance(batch, steps), DAL_STATUS_OK);
        for (int i = 0; i < LANES; i++)
            CU_ASSERT_EQUAL(dal_batch_status(batch, i, NULL),
                            i == UPWARDS ? DAL_STATUS_SINGULAR : DAL_STATUS_OK);
        CU_ASSERT_DOUBLE_EQUAL(dal_batch_time(batch, UPWARDS), other.time, 2.0 * STEP);
        dal_batch_free(batch);
    }
}

/* Compiled steps, too, of one lane and of several. */
static void test_compiled(void)
{
    copies c;
    if (!compiler_works) return;
    throw_bodies(&c, MANY, 1u << 7);
    check_run(&c, "rk4", true);
    throw_bodies(&c, MANY, 0);
    check_run(&c, "rk4", true);
}

/* Matrices of these constraints are no part of a run: they are allocated for its start and for a
 * parameter that changes. */
static void test_memory(void)
{
    static const char text[] =
        "coordinates: ['x[1..40]', 'y[1..40]']\nparameters: {k: 1}\n"
        "lagrangian: sum(i, 1, 40, x[i]'^2 + y[i]'^2)/2\n"
        "constraints: [{for: i = 1..40, is: \"y[i]' - k*sin(x[i])*x[i]'\"}]\nstart: {x1': 1}\n";
    const dal_run_spec spec =
        fixture_spec(fixture_system(text), "symplectic-euler", DAL_PHYSICAL, 0.1);
    bool failed = true;
    for (long count = 0; failed; count++) { /* each of the few, in a quick run, too */
        dal_run *run = NULL;
        allocation_fail_after(count);
        dal_status status = dal_run_create(&run, &spec, NULL);
        if (status == DAL_STATUS_OK) status = dal_run_set_parameter(run, "k", 2.0, NULL);
        failed = allocation_failed();
        allocation_fail_after(-1);
        CU_ASSERT_EQUAL(status, failed ? DAL_STATUS_MEMORY : DAL_STATUS_OK);
        dal_run_free(run);
    }
}

void suite_many_constraints(void)
{
    CU_pSuite suite = CU_add_suite("rank of many constraints", compiler_set_up, compiler_tear_down);
    CU_add_test(suite, "which systems have factors", test_which);
    CU_add_test(suite, "a gradient that vanishes", test_vanishing);
    CU_add_test(suite, "two that vanish at once", test_two);
    CU_add_test(suite, "gradients that become parallel", test_parallel);
    CU_add_test(suite, "lanes", test_lanes);
    CU_add_test(suite, "compiled steps", test_compiled);
    CU_add_test(suite, "out of memory", test_memory);
}
