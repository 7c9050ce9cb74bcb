/* test_crossing.c - zeros along a run: sections and events find the same ones, all of them. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX = 64 };

static const double pi = 3.14159265358979323846;

typedef struct record {
    int count;
    double t[MAX];
    long long unresolved, touches;
    double first;
} record;

static dal_status note_crossing(void *user, dal_run *run, const dal_crossing *crossing)
{
    record *r = user;
    (void)run;
    CU_ASSERT_FATAL(r->count < MAX);
    r->t[r->count++] = crossing->t;
    return DAL_STATUS_OK;
}

static dal_status note_event(void *user, dal_run *run, const dal_occurrence *event)
{
    record *r = user;
    (void)run;
    CU_ASSERT_FATAL(r->count < MAX);
    r->t[r->count++] = event->t;
    return DAL_STATUS_OK;
}

typedef struct motion {
    const char *method;
    double step, T, tolerance;
} motion;

static dal_run *run_of(const char *text, const motion *m)
{
    dal_run_spec spec = fixture_spec(fixture_system(text), m->method, DAL_PHYSICAL, m->step);
    spec.options.tolerance = m->tolerance;
    return fixture_run(&spec);
}

/* The zeros of g(x), x = t, that a section finds. */
static record section_of(const char *g, const motion *m)
{
    char text[256];
    record r = {0};
    dal_crossings found;
    snprintf(text, sizeof text,
             "coordinates: [x]\nlagrangian: x'^2/2\nstart: {x': 1}\ninvariants: {g: \"%s\"}\n", g);
    dal_run *run = run_of(text, m);
    const dal_poincare section = {.callback = dal_run_system(run)->invariant_values,
                                  .count = 1,
                                  .user = &r,
                                  .cross = note_crossing};
    CU_ASSERT_EQUAL(dal_run_crossings(run, m->T, &section, &found, NULL), DAL_STATUS_OK);
    r.unresolved = found.unresolved;
    r.first = found.first_unresolved;
    r.touches = found.touches;
    CU_ASSERT_EQUAL(found.up + found.down, r.count);
    dal_run_free(run);
    return r;
}

/* Those that an event finds. */
static record events_of(const char *g, const motion *m)
{
    char text[256];
    record r = {0};
    snprintf(text, sizeof text,
             "coordinates: [x]\nlagrangian: x'^2/2\nstart: {x': 1}\nevents: [{when: \"%s\"}]\n", g);
    dal_run *run = run_of(text, m);
    CU_ASSERT_EQUAL(fixture_events(run, m->T, note_event, &r, NULL), DAL_STATUS_OK);
    r.unresolved = dal_run_unresolved(run, &r.first);
    dal_run_free(run);
    return r;
}

static void compare(const char *g, const record *r, const double *t, int count, double sign)
{
    CU_ASSERT_EQUAL(r->count, count);
    if (r->count != count) printf("\n  %s: %d zeros, not %d\n", g, r->count, count);
    for (int k = 0; k < count && r->count == count; k++)
        CU_ASSERT_DOUBLE_EQUAL(r->t[k], sign * t[k], 1e-13);
    CU_ASSERT(r->unresolved == 0 && isnan(r->first));
}

/* A section and an event find the zeros t[count] of g, an event also zeros of g(-x), backwards. */
static void find(const char *g, const char *reflected, const double *t, int count, const motion *m)
{
    const motion back = {m->method, -m->step, -m->T, m->tolerance};
    record r = section_of(g, m);
    compare(g, &r, t, count, 1.0);
    r = events_of(g, m);
    compare(g, &r, t, count, 1.0);
    r = events_of(reflected, &back);
    compare(reflected, &r, t, count, -1.0);
}

/* cos 7x has its zeros at (k + 1/2) pi/7: two, or none, or one, in a step of 0.7. */
static void test_oscillation(void)
{
    static const motion motions[] = {{"rk4", 0.7, 6.3, 0.0},
                                     {"gauss4", 2.1, 6.3, 0.0},
                                     {"dop853", 6.3, 6.3, 1e-12},
                                     {"taylor", 6.3, 6.3, 1e-12}};
    double t[14];
    for (int k = 0; k < 14; k++) t[k] = (k + 0.5) * pi / 7.0;
    for (size_t i = 0; i < sizeof motions / sizeof *motions; i++)
        find("cos(7*x)", "cos(7*x)", t, 14, &motions[i]);
}

/* Pairs in a step with a kink, a cusp or a jump between them, or that are jumps. */
static void test_kinks_and_jumps(void)
{
    static const motion m = {"rk4", 0.7, 2.1, 0.0};
    static const struct {
        const char *g, *reflected;
        double t[2];
    } cases[] = {
        {"abs(x - 1) - 0.01", "abs(x + 1) - 0.01", {0.99, 1.01}},
        {"0.01 - abs(x - 1)", "0.01 - abs(x + 1)", {0.99, 1.01}},
        {"max(x - 1, 3*(1 - x)) - 0.03", "max(-x - 1, 3*(1 + x)) - 0.03", {0.99, 1.03}},
        {"sqrt(abs(x - 1)) - 0.1", "sqrt(abs(x + 1)) - 0.1", {0.99, 1.01}},
        {"if(x < 1, x + 0.1, x - 1.3)", "if(-x < 1, 0.1 - x, -x - 1.3)", {1.0, 1.3}},
        {"if(x < 1, 0.9 - x, 2 - x/2)", "if(-x < 1, 0.9 + x, 2 + x/2)", {0.9, 1.0}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        find(cases[i].g, cases[i].reflected, cases[i].t, 2, &m);
}

/* A zero of even order is none, and neither is a kink that touches 0 or stays above it. */
static void test_touches(void)
{
    static const motion m = {"rk4", 0.7, 2.1, 0.0};
    find("(x - 1)^2", "(x + 1)^2", NULL, 0, &m);
    find("abs(x - 1)", "abs(x + 1)", NULL, 0, &m);
    find("abs(x - 1) + 1e-9", "abs(x + 1) + 1e-9", NULL, 0, &m);
    find("1e-9 + (x - 1)^2", "1e-9 + (x + 1)^2", NULL, 0, &m);
    CU_ASSERT_EQUAL(section_of("(x - 1)^2", &m).touches, 1);
    CU_ASSERT_EQUAL(section_of("abs(x - 1)", &m).touches, 1);
    CU_ASSERT_EQUAL(section_of("abs(x - 1) + 1e-9", &m).touches, 0);
}

/* x = 1 + (t - 1)^2 - d^2, which rk4 follows exactly: a touch where d = 0, else two zeros. */
static void test_near_touch(void)
{
    static const motion m = {"rk4", 0.7, 2.1, 0.0};
    const double t[] = {0.9999, 1.0001};
    find("(x - 1)^2 - 1e-8", "(x + 1)^2 - 1e-8", t, 2, &m);
}

/* cos 1e5 x has more zeros than 1024 intervals of a step show: each step says so. */
static void test_unresolved(void)
{
    static const motion m = {"rk4", 0.7, 2.1, 0.0};
    char text[256];
    dal_crossings found;
    double first;
    snprintf(text, sizeof text,
             "coordinates: [x]\nlagrangian: x'^2/2\nstart: {x': 1}\n"
             "invariants: {g: cos(1e5*x)}\nevents: [{when: cos(1e5*x)}]\n");
    dal_run *run = run_of(text, &m);
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
    CU_ASSERT(dal_run_unresolved(run, &first) >= 1 && first == 0.0);
    dal_run_free(run);
    *strstr(text, "events") = '\0';
    run = run_of(text, &m);
    const dal_poincare section = {.callback = dal_run_system(run)->invariant_values, .count = 1};
    CU_ASSERT_EQUAL(dal_run_crossings(run, m.T, &section, &found, NULL), DAL_STATUS_OK);
    CU_ASSERT(found.unresolved == 3 && found.first_unresolved == 0.0);
    dal_run_free(run);
}

/* ---- a step that was searched ---- */

static long long evaluations;

static dal_status count_values(const dal_system *system, const dal_point *at, double *out)
{
    evaluations++;
    out[0] = at->q[0] - 0.5;
    (void)system;
    return DAL_STATUS_OK;
}

static dal_status ignore_row(void *user, dal_run *run, long long row, double t)
{
    (void)user;
    (void)run;
    (void)row;
    (void)t;
    return DAL_STATUS_OK;
}

/* x = t: rows between two steps do not search a step again, and change no bit of the run. */
static void test_rows_between_steps(void)
{
    const dal_observer observer = {.sample = ignore_row};
    dal_system system = *fixture_system("coordinates: [x]\nlagrangian: x'^2/2\nstart: {x': 1}\n"
                                        "events: [{when: x - 0.5}]\n");
    dal_run_spec spec = fixture_spec(&system, "rk4", DAL_PHYSICAL, 0.125);
    long long counted[2];
    double end[2][2];
    system.event_values = count_values;
    for (int i = 0; i < 2; i++) {
        dal_run *run = fixture_run(&spec);
        evaluations = 0;
        CU_ASSERT_EQUAL(dal_run_sample(run, 2.0, i ? 48 : 1, 0, &observer, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_event_count(run, 0), 1);
        memcpy(end[i], dal_run_state(run), sizeof end[i]);
        counted[i] = evaluations;
        dal_run_free(run);
    }
    CU_ASSERT_EQUAL(counted[0], counted[1]);
    CU_ASSERT_EQUAL(memcmp(end[0], end[1], sizeof end[0]), 0);
}

/* What was found holds for the step from where it was: not after a restore, nor with another
 * parameter. */
static void test_changed_between(void)
{
    const dal_observer observer = {.sample = ignore_row};
    const dal_run_spec spec =
        fixture_spec(fixture_system("coordinates: [x]\nparameters: {a: 0.6}\nlagrangian: x'^2/2\n"
                                    "start: {x': 1}\nevents: [{when: x - a, stop: true}]\n"),
                     "rk4", DAL_PHYSICAL, 0.5);
    double saved[64];
    size_t count;
    dal_run *run = fixture_run(&spec);
    const double *numbers = dal_run_save(run, &count);
    CU_ASSERT_FATAL(count <= 64);
    memcpy(saved, numbers, count * sizeof *saved);
    CU_ASSERT_EQUAL(dal_run_sample(run, 0.55, 1, 0, &observer, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_time(run), 0.5);
    CU_ASSERT_EQUAL(dal_run_set_parameter(run, "a", 0.75, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_STOPPED);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_time(run), 0.75, 1e-15);
    CU_ASSERT_EQUAL(dal_run_restore(run, saved, count, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(fixture_events(run, 2.0, NULL, NULL, NULL), DAL_STATUS_STOPPED);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_time(run), 0.6, 1e-15);
    dal_run_free(run);
}

void suite_crossing(void)
{
    CU_pSuite suite = CU_add_suite("zeros along a run", NULL, NULL);
    CU_add_test(suite, "several in a step", test_oscillation);
    CU_add_test(suite, "pairs about kinks and jumps", test_kinks_and_jumps);
    CU_add_test(suite, "touches", test_touches);
    CU_add_test(suite, "a close pair", test_near_touch);
    CU_add_test(suite, "more than the intervals show", test_unresolved);
    CU_add_test(suite, "rows between steps", test_rows_between_steps);
    CU_add_test(suite, "changes between steps", test_changed_between);
}
