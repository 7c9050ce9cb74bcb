/* test_event_branches.c - events where F jumps or has a kink: times from closed forms, with every
 * method; what follows them. */
#include "fixtures.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX = 16 };
static const double accuracy = 1e-12;

/* F is constant between its jumps, so that methods of order 2 make no error but at jumps. */
typedef struct motion {
    const char *text;
    int first_order; /* how many events methods of order 1 have exactly, too */
    int count;
    double time[MAX]; /* [count] of the events */
    dal_status status;
} motion;

typedef struct record {
    int count;
    double time[MAX];
} record;

static dal_status note(void *user, dal_run *run, const dal_occurrence *event)
{
    record *r = user;
    (void)run;
    if (r->count < MAX) r->time[r->count] = event->t;
    r->count++;
    return DAL_STATUS_OK;
}

/* The events of a run; false: the method cannot act on the system. */
static bool find_events(const dal_run_spec *spec, double T, dal_status expected, record *r)
{
    dal_run *run;
    *r = (record){0};
    const dal_status made = dal_run_create(&run, spec, NULL);
    if (made == DAL_STATUS_UNSUPPORTED) return false;
    CU_ASSERT_EQUAL_FATAL(made, DAL_STATUS_OK);
    CU_ASSERT_EQUAL(fixture_events(run, T, note, r, NULL), expected);
    dal_run_free(run);
    return true;
}

static void compare(const motion *m, const record *r, int exact, double direction)
{
    CU_ASSERT_EQUAL(r->count, m->count);
    for (int k = 0; k < exact && k < r->count; k++)
        CU_ASSERT_DOUBLE_EQUAL(direction * r->time[k], m->time[k], accuracy);
}

/* How a method is run: with steps that divide no time, under a tolerance, on the lifted space. */
static const struct {
    double step, tolerance;
    dal_space space;
} ways[] = {{0.007, 0.0, DAL_PHYSICAL},
            {0.01, 0.0, DAL_LIFTED},
            {0.3, 0.0, DAL_PHYSICAL},
            {0.7, 1e-10, DAL_PHYSICAL}};
enum { WAYS = 4 };

/* One method, in the ways from the first on; returns its runs. */
static int check_method(const motion *m, const dal_method *method, int first, int count,
                        double direction)
{
    const int exact = dal_method_order(method) > 1 ? m->count : m->first_order;
    int runs = 0;
    for (int i = first; i < count; i += case_stride(WAYS)) {
        dal_run_spec spec =
            fixture_spec(fixture_system(m->text), "rk4", ways[i].space, direction * ways[i].step);
        spec.method = *method;
        spec.options.tolerance = ways[i].tolerance;
        record r;
        if (!find_events(&spec, 3.0 * direction, m->status, &r)) continue;
        if (exact > 0) compare(m, &r, exact, direction);
        runs++;
    }
    return runs;
}

/* Every method, in a quick run each in one way, and every modifier on one of order 2. */
static int check_methods(const motion *m, double direction)
{
    const dal_integrator *inside = NULL;
    int runs = 0;
    for (int i = 0; dal_integrator_at(i); i++) {
        const dal_integrator *k = dal_integrator_at(i);
        if (strcmp(k->name, "stormer-verlet") == 0) inside = k;
        if (!(k->properties & DAL_MODIFIER))
            runs += check_method(m, &(dal_method){{k}}, i % case_stride(WAYS), WAYS, direction);
        else
            runs += check_method(m, &(dal_method){{inside, k}}, 0, 1, direction);
    }
    return runs;
}

/* ---- where F jumps ---- */

/* A block slides, v = v_0 - mu g t, and stops; backwards in time with the force turned round. */
#define BLOCK(sign, event)                                                                         \
    "coordinates: [x]\nparameters: {m: 1.5, mu: 0.3, g: 9.81}\nlagrangian: m/2*x'^2\n"             \
    "forces: {x: " sign "mu*m*g*sign(x')}\nstart: {x': 2.2}\nevents: [{when: x'" event "}]\n"

static void test_block(void)
{
    const double stop = 2.2 / (0.3 * 9.81);
    const motion forwards = {
        BLOCK("-", ", direction: down, stop: true"), 1, 1, {stop}, DAL_STATUS_STOPPED};
    const motion backwards = {
        BLOCK("", ", direction: down, stop: true"), 1, 1, {stop}, DAL_STATUS_STOPPED};
    CU_ASSERT(check_methods(&forwards, 1.0) > 80 / case_stride(WAYS));
    CU_ASSERT(check_methods(&backwards, -1.0) > 80 / case_stride(WAYS));
}

/* Thrown upwards, with dry friction: the deceleration a + b becomes a - b at the top, and the
 * motion goes on from there. */
static void test_turning(void)
{
    const double a = 9.81, b = 2.5, v = 2.2, top = v * v / (2.0 * (a + b));
    const motion m = {"coordinates: [x]\nparameters: {a: 9.81, b: 2.5}\n"
                      "lagrangian: x'^2/2 - a*x\nforces: {x: -b*sign(x')}\nstart: {x': 2.2}\n"
                      "events: [{when: x'}, {when: x, direction: down, stop: true}]\n",
                      1,
                      2,
                      {v / (a + b), v / (a + b) + sqrt(2.0 * top / (a - b))},
                      DAL_STATUS_STOPPED};
    CU_ASSERT(check_methods(&m, 1.0) > 80 / case_stride(WAYS));
}

/* A force -1/2 - 3 floor(x), floor having its argument at 1: from below, at the top, from above. */
static void test_floor(void)
{
    const double up = (2.0 - sqrt(3.1)) / 0.5, v = 2.0 - 0.5 * up, to_top = v / 3.5;
    const motion m = {"coordinates: [x]\nlagrangian: x'^2/2\nforces: {x: -0.5 - 3*floor(x)}\n"
                      "start: {x: 0.1, x': 2}\n"
                      "events: [{when: x - 1, direction: up}, {when: x', direction: down},"
                      "{when: x - 1, direction: down, stop: true}]\n",
                      0,
                      3,
                      {up, up + to_top, up + 2.0 * to_top},
                      DAL_STATUS_STOPPED};
    CU_ASSERT(check_methods(&m, 1.0) > 80 / case_stride(WAYS));
}

/* Comparisons of both orders: v = 2 - t/2, then 1 - 4 (t - 2). */
static void test_comparison(void)
{
    const motion m = {"coordinates: [x]\nlagrangian: x'^2/2\n"
                      "forces: {x: \"if(x' < 1, -2, -0.5) - if(1 < x', 0, 2)\"}\n"
                      "start: {x: 0.1, x': 2}\n"
                      "events: [{when: x' - 1}, {when: x', direction: down, stop: true}]\n",
                      2,
                      2,
                      {2.0, 2.25},
                      DAL_STATUS_STOPPED};
    CU_ASSERT(check_methods(&m, 1.0) > 80 / case_stride(WAYS));
}

/* A wall where F jumps, which is -g above it and g below: from a start at rest. */
static void test_wall(void)
{
    motion m = {"coordinates: [x]\nparameters: {g: 9.81}\nlagrangian: x'^2/2\n"
                "forces: {x: -g*sign(x)}\nstart: {x: 1}\n"
                "events: [{when: x, direction: down, restitution: 0.9},"
                "{when: x - 0.1, direction: up}]\n",
                0,
                0,
                {0},
                DAL_STATUS_OK};
    const double g = 9.81;
    double v = sqrt(2.0 * g), t = v / g;
    while (t < 3.0 && m.count + 2 <= MAX) {
        m.time[m.count++] = t;
        v *= 0.9;
        const double up = t + (v - sqrt(v * v - 0.2 * g)) / g;
        if (up < 3.0) m.time[m.count++] = up;
        t += 2.0 * v / g;
    }
    dal_method method;
    static const char *const names[] = {
        "rk4",    "gauss8", "dop853", "stormer-verlet", "gni", "stormer-verlet+yoshida4",
        "spark4", "dla"};
    for (int i = 0; i < 8; i++) {
        CU_ASSERT_EQUAL(dal_method_parse(&method, names[i], NULL), DAL_STATUS_OK);
        CU_ASSERT(check_method(&m, &method, 0, WAYS, 1.0) >= 2 / case_stride(2));
    }
}

/* A motion does not count beyond the branch that was held: F is 0 up to x = 1 at t = 1, then -2, so
 * that x is 1.2 at t = 1.276, and not at 1.2. */
static void test_beyond(void)
{
    const dal_run_spec spec = fixture_spec(
        fixture_system(
            "coordinates: [x]\nlagrangian: x'^2/2\nstart: {x': 1}\n"
            "forces: {x: \"if(x < 1, 0, -2)\"}\nevents: [{when: x - 1.2, stop: true}]\n"),
        "rk4", DAL_PHYSICAL, 0.9);
    record r;
    CU_ASSERT(find_events(&spec, 3.0, DAL_STATUS_STOPPED, &r));
    CU_ASSERT_EQUAL(r.count, 1);
    CU_ASSERT(r.time[0] > 1.21);
}

/* ---- where F has a kink ---- */

/* x'' = 1 up to t = 1, then 2 - t up to t = 3/2, then 1/2: a table, min and max, abs. */
static void test_kink(void)
{
    static const char *const forces[] = {"f(t)", "max(min(1, 2 - t), 1/2)",
                                         "0.75 + (abs(t - 1.5) - abs(t - 1))/2"};
    const double later = 0.5 + 1.0 * 0.5 + 0.5 * 0.25 - 0.125 / 6.0;
    /* The last has stages before the begin and after the end of a step. */
    static const char *const names[] = {"rk4", "gauss4", "stormer-verlet+yoshida4"};
    for (int i = 0; i < 9; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 "coordinates: [x]\n"
                 "tables: {f: {file: f.csv, at: t, value: f, extend: constant}}\n"
                 "files: {f.csv: \"t,f\\n0,1\\n1,1\\n1.5,0.5\\n9,0.5\"}\n"
                 "lagrangian: x'^2/2\nforces: {x: \"%s\"}\n"
                 "events: [{when: x - 0.5, direction: up}, {when: t - 1.5, stop: true}]\n",
                 forces[i / 3]);
        dal_run_spec spec = fixture_spec(fixture_system(text), names[i % 3], DAL_PHYSICAL, 0.3);
        record r;
        CU_ASSERT(find_events(&spec, 3.0, DAL_STATUS_STOPPED, &r));
        CU_ASSERT_EQUAL_FATAL(r.count, 2);
        CU_ASSERT_DOUBLE_EQUAL(r.time[0], 1.0, accuracy);
        CU_ASSERT_DOUBLE_EQUAL(r.time[1], 1.5, accuracy);
        dal_run *run = fixture_run(&spec);
        CU_ASSERT_EQUAL(fixture_events(run, 3.0, NULL, NULL, NULL), DAL_STATUS_STOPPED);
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[0], later, accuracy);
        dal_run_free(run);
    }
}

/* A table 1 up to x = 1 and 2 x - 1 beyond it: at x = 1.5 it is 2, and 1 with its first piece. */
static void test_piece(void)
{
    const dal_system *system =
        fixture_system("coordinates: [x]\ntables: {f: {file: f.csv, at: x, value: f}}\n"
                       "files: {f.csv: \"x,f\\n0,1\\n1,1\\n2,3\"}\n"
                       "lagrangian: x'^2/2\nforces: {x: f(x)}\nevents: [{when: x - 1}]\n");
    const dal_branches *b = system->branches;
    CU_ASSERT_FATAL(b && b->count == 1);
    double *work = calloc(system->workspace + 1, sizeof *work);
    const double q = 1.5, v = 0.0, first = 0.5;
    double F, lower, upper;
    const dal_point at = {.q = &q, .v = &v, .work = work};
    CU_ASSERT_EQUAL(system->prepare(system, &at, NULL), DAL_STATUS_OK);
    for (int is_held = 0; is_held < 2; is_held++) {
        b->hold(system, is_held ? &first : NULL, work);
        CU_ASSERT_EQUAL(system->call.field(system, &at, &F), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(F, is_held ? 1.0 : 2.0);
    }
    b->bounds(system, 0, q, &lower, &upper);
    CU_ASSERT(lower == 1.0 && upper == 2.0);
    free(work);
}

/* ---- rest ---- */

/* A run ends at an event from which both sides lead back to it. */
static void expect_leads_back(const char *system, const char *method, double step, record *r,
                              const char *event)
{
    dal_error error = {0};
    const dal_run_spec spec = fixture_spec(fixture_system(system), method, DAL_PHYSICAL, step);
    dal_run *run = fixture_run(&spec);
    *r = (record){0};
    CU_ASSERT_EQUAL(fixture_events(run, 30.0, note, r, &error), DAL_STATUS_EVENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, event));
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "F leads back"));
    dal_run_free(run);
}

/* Where the event does not stop the run, the block stays at rest.  Where F leads back to v = 0 from
 * both sides and is not 0 there, the run ends: turning points of a spring at |x| = 1.05 - 0.2 k. */
static void test_rest(void)
{
    static const char *const names[] = {"rk4", "gauss8", "stormer-verlet", "gni"};
    const double pi = acos(-1.0);
    for (int i = 0; i < 8; i += case_stride(3)) {
        const char *text = i < 4 ? BLOCK("-", "") : BLOCK("-", ", direction: down");
        const dal_run_spec spec =
            fixture_spec(fixture_system(text), names[i % 4], DAL_PHYSICAL, 0.01);
        dal_run *run = fixture_run(&spec);
        CU_ASSERT_EQUAL(fixture_events(run, 3.0, NULL, NULL, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_event_count(run, 0), 1);
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[0], 2.2 * 2.2 / (2.0 * 0.3 * 9.81), accuracy);
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[1], 0.0, 1e-16);
        CU_ASSERT_EQUAL(dal_run_unresolved(run, NULL), 0);
        dal_run_free(run);
    }
    record r;
    expect_leads_back("coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\n"
                      "forces: {x: -0.1*sign(x')}\nstart: {x: 1.05}\nevents: [{when: x'}]\n",
                      "gauss12", 0.1, &r, "event 1 (x') at t = 15.70796326794");
    CU_ASSERT_EQUAL(r.count, 5);
    for (int k = 0; k < r.count; k++) CU_ASSERT_DOUBLE_EQUAL(r.time[k], pi * (k + 1), 1e-11);
}

/* Where the argument is 1 and not 0: v = 3/2 - t/4, and both sides lead back to v = 1. */
static void test_rest_beside_zero(void)
{
    record r;
    expect_leads_back("coordinates: [x]\nlagrangian: x'^2/2\nforces: {x: 0.25 - 0.5*floor(x')}\n"
                      "start: {x': 1.5}\nevents: [{when: x' - 1}]\n",
                      "gauss4", 0.15, &r, "event 1 (x' - 1) at t = 2:");
}

/* ---- along a run ---- */

static const char up_and_down[] =
    "coordinates: [x]\nlagrangian: x'^2/2 - 5*x\nforces: {x: -2*sign(x')}\nstart: {x': 3}\n"
    "events: [{when: x'}, {when: x + 1, direction: down, restitution: 0.9}]\n";

/* x(t) = 3 t - 7 t^2/2 up to t = 3/7, then 9/14 - 3 (t - 3/7)^2/2. */
static dal_status check_row(void *user, dal_run *run, long long row, double t)
{
    const double past = t - 3.0 / 7.0;
    const double x = past < 0.0 ? 3.0 * t - 3.5 * t * t : 9.0 / 14.0 - 1.5 * past * past;
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[0], x, accuracy);
    *(long long *)user = row;
    return DAL_STATUS_OK;
}

/* Rows between the steps follow the motion too, and change nothing. */
static void test_rows(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system(up_and_down), "gauss4", DAL_PHYSICAL, 0.3);
    long long last = -1;
    const dal_observer observer = {.user = &last, .sample = check_row};
    dal_run *run = fixture_run(&spec), *other = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_sample(run, 1.2, 97, 0, &observer, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(last, 97);
    CU_ASSERT_EQUAL(dal_run_sample(other, 1.2, 1, 0, NULL, NULL), DAL_STATUS_OK);
    size_t count;
    const double *saved = dal_run_save(run, &count);
    CU_ASSERT_EQUAL(memcmp(saved, dal_run_save(other, &count), count * sizeof *saved), 0);
    dal_run_free(run);
    dal_run_free(other);
}

/* A run saved at any step continues with the same bits. */
static void test_resume(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system(up_and_down), "gauss6", DAL_LIFTED, 0.07);
    dal_run *run = fixture_run(&spec), *other = fixture_run(&spec);
    size_t count;
    for (int k = 0; k < 60; k++) {
        const double *saved = dal_run_save(run, &count);
        CU_ASSERT_EQUAL(dal_run_restore(other, saved, count, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_step(other, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(memcmp(saved, dal_run_save(other, &count), count * sizeof *saved), 0);
    }
    CU_ASSERT(dal_run_event_count(run, 0) > 2 && dal_run_event_count(run, 1) > 1);
    dal_run_free(run);
    dal_run_free(other);
}

/* Steps in which nothing changes have the bits of the system without events. */
static void test_bits(void)
{
    static const char *const names[] = {"rk4", "gauss8", "stormer-verlet", "gni", "dla"};
    const char *const text = "coordinates: [x]\nparameters: {m: 1.5, mu: 0.3, g: 9.81}\n"
                             "lagrangian: m/2*x'^2\nforces: {x: -mu*m*g*sign(x')}\n"
                             "start: {x': 2.2}\n";
    for (int i = 0; i < 5; i++) {
        const dal_run_spec plain =
            fixture_spec(fixture_system(text), names[i], DAL_PHYSICAL, 0.007);
        const dal_run_spec spec =
            fixture_spec(fixture_system(BLOCK("-", "")), names[i], DAL_PHYSICAL, 0.007);
        dal_run *run = fixture_run(&plain), *other = fixture_run(&spec);
        CU_ASSERT_PTR_NULL(plain.system->branches);
        CU_ASSERT_PTR_NOT_NULL(spec.system->branches);
        CU_ASSERT_EQUAL(dal_run_advance(run, 106, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_advance(other, 106, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(memcmp(dal_run_state(run), dal_run_state(other), 2 * sizeof(double)), 0);
        dal_run_free(run);
        dal_run_free(other);
    }
}

/* In quad precision the block stops where it stops, to the rounding of what is shown. */
static void test_quad(void)
{
    dal_run_spec spec =
        fixture_spec(fixture_system(BLOCK("-", ", stop: true")), "rk4", DAL_PHYSICAL, 0.01);
    spec.options.precision = DAL_QUAD;
    dal_run *run;
    const dal_status made = dal_run_create(&run, &spec, NULL);
    if (made == DAL_STATUS_UNSUPPORTED) return; /* no type of 113 bits */
    CU_ASSERT_EQUAL_FATAL(made, DAL_STATUS_OK);
    CU_ASSERT_EQUAL(fixture_events(run, 3.0, NULL, NULL, NULL), DAL_STATUS_STOPPED);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_time(run), 2.2 / (0.3 * 9.81), 1e-15);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[1], 0.0, 1e-15);
    dal_run_free(run);
}

void suite_event_branches(void)
{
    CU_pSuite suite = CU_add_suite("event_branches", NULL, NULL);
    CU_add_test(suite, "a sliding block", test_block);
    CU_add_test(suite, "a turning point", test_turning);
    CU_add_test(suite, "floor", test_floor);
    CU_add_test(suite, "comparisons", test_comparison);
    CU_add_test(suite, "a wall", test_wall);
    CU_add_test(suite, "beyond a branch", test_beyond);
    CU_add_test(suite, "kinks", test_kink);
    CU_add_test(suite, "a piece of a table", test_piece);
    CU_add_test(suite, "rest", test_rest);
    CU_add_test(suite, "rest where the argument is not 0", test_rest_beside_zero);
    CU_add_test(suite, "rows", test_rows);
    CU_add_test(suite, "resumed", test_resume);
    CU_add_test(suite, "bits", test_bits);
    CU_add_test(suite, "quad precision", test_quad);
}
