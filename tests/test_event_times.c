/* test_event_times.c - events at one time, of velocities, of reactions; the steps after them. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX = 16, NUMBERS = 8 };

typedef struct record {
    int count, event[MAX];
    double t[MAX], after[MAX][NUMBERS];
} record;

static dal_status note(void *user, dal_run *run, const dal_occurrence *event)
{
    record *r = user;
    const size_t bytes = (size_t)dal_run_dimension(run) * sizeof(double);
    CU_ASSERT_FATAL(bytes <= NUMBERS * sizeof(double) && r->count < MAX);
    r->event[r->count] = event->event;
    r->t[r->count] = event->t;
    memcpy(r->after[r->count++], dal_run_state(run), bytes);
    return DAL_STATUS_OK;
}

static record events_of(const char *text, const char *method, double step, double T)
{
    record r = {0};
    const dal_run_spec spec = fixture_spec(fixture_system(text), method, DAL_PHYSICAL, step);
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_EQUAL(fixture_events(run, T, note, &r, NULL), DAL_STATUS_OK);
    dal_run_free(run);
    return r;
}

/* ---- at one time ---- */

/* x = t.  Two events less than its rounding apart are one point of time, and act in the order of
 * the file, whichever is first by a rounding: 2 y + 1.  Those further apart act in order of time:
 * 2 (y + 1). */
#define TWO(first, second)                                                                         \
    "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\nstart: {y: 1, x': 1}\n"                     \
    "events: [{when: x - " first ", set: {y: 2*y}}, {when: x - " second ", set: {y: y + 1}}]\n"

static void test_simultaneous(void)
{
    static const struct {
        const char *text;
        int first;
        double y;
    } cases[] = {{TWO("0.3", "0.3"), 0, 3.0},
                 {TWO("0.30000000000000021", "0.3"), 0, 3.0},
                 {TWO("0.3", "0.30000000000000021"), 0, 3.0},
                 {TWO("0.3000000000001", "0.3"), 1, 4.0},
                 {TWO("0.3", "0.3000000000001"), 0, 3.0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const record r = events_of(cases[i].text, "rk4", 0.25, 1.0);
        CU_ASSERT_EQUAL_FATAL(r.count, 2);
        CU_ASSERT_EQUAL(r.event[0], cases[i].first);
        CU_ASSERT_EQUAL(r.after[1][1], cases[i].y);
        CU_ASSERT_EQUAL(r.t[0] == r.t[1], i < 3);
        CU_ASSERT_DOUBLE_EQUAL(r.t[1] - r.t[0], i < 3 ? 0.0 : 1e-13, 1e-15);
    }
}

/* At t = 1e9 a point of time is 1e-7 long. */
static void test_simultaneous_late(void)
{
    static const struct {
        const char *text;
        int first;
        double y;
    } cases[] = {{TWO("0.30000001", "0.3"), 0, 3.0}, {TWO("0.30001", "0.3"), 1, 4.0}};
    for (int i = 0; i < 2; i++) {
        record r = {0};
        dal_run_spec spec = fixture_spec(fixture_system(cases[i].text), "rk4", DAL_PHYSICAL, 0.25);
        spec.start_time = 1e9;
        dal_run *run = fixture_run(&spec);
        CU_ASSERT_EQUAL(fixture_events(run, 1e9 + 1.0, note, &r, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL_FATAL(r.count, 2);
        CU_ASSERT_EQUAL(r.event[0], cases[i].first);
        CU_ASSERT_EQUAL(r.after[1][1], cases[i].y);
        dal_run_free(run);
    }
}

/* Many in one step: between two walls at a distance of 0.6 at 0.3 + 0.6 k, whatever the step; one
 * at the start is at once, and ends a run before its first step. */
static void test_within_a_step(void)
{
    const char *walls = "coordinates: [x]\nlagrangian: x'^2/2\nstart: {x': 1}\n"
                        "events: [{when: x - 0.3, direction: up, restitution: 1},"
                        "{when: x + 0.3, direction: down, restitution: 1}]\n";
    static const char *const methods[] = {"rk4", "gauss4", "dop853", "stormer-verlet"};
    for (int i = 0; i < 4; i++) {
        const record r = events_of(walls, methods[i], 5.0, 9.0);
        CU_ASSERT_EQUAL_FATAL(r.count, 15);
        for (int k = 0; k < r.count; k++) {
            CU_ASSERT_EQUAL(r.event[k], k % 2);
            CU_ASSERT_DOUBLE_EQUAL(r.t[k], 0.3 + 0.6 * k, 1e-13);
            CU_ASSERT_DOUBLE_EQUAL(r.after[k][1], k % 2 ? 1.0 : -1.0, 1e-13);
        }
    }
    record r = {0};
    dal_run_spec spec =
        fixture_spec(fixture_system("coordinates: [x]\nlagrangian: x'^2/2\nstart: {x': 1}\n"
                                    "events: [{when: x, direction: up, stop: true}]\n"),
                     "rk4", DAL_LIFTED, 0.5);
    spec.start_time = -7.0;
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_EQUAL(fixture_events(run, 1.0, note, &r, NULL), DAL_STATUS_STOPPED);
    CU_ASSERT(r.count == 1 && r.t[0] == -7.0 && dal_run_steps(run) == 0);
    dal_run_free(run);
}

/* Under a tolerance, many in one step: x = sin t against a wall at 1/2, which it leaves and meets
 * again after 4 pi/3; and passing through 0.8, from below at asin 0.8 + 2 pi k. */
static void test_within_substeps(void)
{
    static const char *const methods[] = {"dop853", "taylor"};
    static const char *const actions[] = {"when: x - 0.5, restitution: 1",
                                          "when: x - 0.8, direction: up"};
    const double pi = acos(-1.0), first[] = {pi / 6.0, asin(0.8)}, then[] = {4.0 / 3.0, 2.0};
    for (int i = 0; i < 4; i++) {
        char text[256];
        snprintf(text, sizeof text,
                 "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x': 1}\nevents: [{%s}]\n",
                 actions[i / 2]);
        dal_run_spec spec = fixture_spec(fixture_system(text), methods[i % 2], DAL_PHYSICAL, 50.0);
        spec.options.tolerance = 1e-14;
        dal_run *run = fixture_run(&spec);
        record r = {0};
        CU_ASSERT_EQUAL(fixture_events(run, 50.0, note, &r, NULL), DAL_STATUS_OK);
        dal_run_free(run);
        CU_ASSERT_EQUAL_FATAL(r.count, i < 2 ? 12 : 8);
        for (int k = 0; k < r.count; k++)
            CU_ASSERT_DOUBLE_EQUAL(r.t[k], first[i / 2] + then[i / 2] * pi * k, 1e-11);
    }
}

/* An impact where D is not linear: the speed stays 1, its part across the wall becomes -c times
 * what it was, and the part along it keeps its sign. */
static void test_nonlinear(void)
{
    for (int i = 0; i < 3; i++) {
        char text[512];
        const double c = 0.5 * i;
        snprintf(text, sizeof text,
                 "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                 "constraints: [x'^2 + y'^2 - 1]\nstart: {x': 0.8, y': 0.6}\n"
                 "events: [{when: 1 - x, direction: down, restitution: %g}]\n",
                 c);
        const record r = events_of(text, "gauss8+project", 0.3, 3.0);
        CU_ASSERT_EQUAL_FATAL(r.count, 1);
        CU_ASSERT_DOUBLE_EQUAL(r.t[0], 1.25, 1e-13);
        CU_ASSERT_DOUBLE_EQUAL(r.after[0][2], -0.8 * c, 1e-13);
        CU_ASSERT_DOUBLE_EQUAL(r.after[0][3], sqrt(1.0 - 0.64 * c * c), 1e-13);
    }
}

/* ---- events of velocities ---- */

/* x = cos t: x' + a is 0 at asin a and at pi - asin a, both within a step, which only d(when)/dt,
 * an acceleration, shows; and where x' is 0 at the start, an event of one direction is at once or
 * half a period later. */
static void test_velocity(void)
{
    const double pi = acos(-1.0), first = asin(0.999);
    record r = events_of("coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x: 1}\n"
                         "events: [{when: x' + 0.999}]\n",
                         "gauss12", 0.15, 3.0);
    CU_ASSERT_EQUAL_FATAL(r.count, 2);
    CU_ASSERT_DOUBLE_EQUAL(r.t[0], first, 1e-11);
    CU_ASSERT_DOUBLE_EQUAL(r.t[1], pi - first, 1e-11);
    r = events_of("coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x: 1}\n"
                  "events: [{when: x', direction: up}, {when: x', direction: down}]\n",
                  "gauss12", 0.15, 7.0);
    CU_ASSERT_EQUAL_FATAL(r.count, 3);
    CU_ASSERT(r.event[0] == 1 && r.event[1] == 0 && r.event[2] == 1);
    for (int k = 0; k < 3; k++) CU_ASSERT_DOUBLE_EQUAL(r.t[k], k * pi, 1e-12);
}

/* ---- events of reactions ---- */

/* A blade with the speed u whose turning rate grows, w = a t, is held by the force u a t across it,
 * R = u w (-sin s, cos s), and slips where that is more than its grip: at t = grip/(u a).  set has
 * the reaction of that moment. */
static void test_grip(void)
{
    const char *text = "coordinates: [x, y, s, k]\nparameters: {u: 0.8, a: 0.5, grip: 0.7}\n"
                       "lagrangian: (x'^2 + y'^2 + s'^2 + k'^2)/2 + a*s\n"
                       "constraints: [x'*sin(s) - y'*cos(s)]\nstart: {x': u}\n"
                       "events: [{when: 'hypot(R_x, R_y) - grip', direction: up,"
                       " set: {k: R_y + 10*R_s}}, {when: abs(h1) - grip, stop: true}]\n";
    static const char *const methods[] = {"gauss12", "dop853", "gauss8+project"};
    for (size_t i = 0; i < 3; i++) {
        record r = {0};
        const double t = 0.7 / (0.8 * 0.5);
        const dal_run_spec spec =
            fixture_spec(fixture_system(text), methods[i], DAL_PHYSICAL, 0.02);
        dal_run *run = fixture_run(&spec);
        CU_ASSERT_EQUAL(fixture_events(run, 5.0, note, &r, NULL), DAL_STATUS_STOPPED);
        CU_ASSERT_EQUAL_FATAL(r.count, 2);
        CU_ASSERT_EQUAL(r.event[1], 1);
        for (int k = 0; k < 2; k++) {
            CU_ASSERT_DOUBLE_EQUAL(r.t[k], t, 1e-12);
            CU_ASSERT_DOUBLE_EQUAL(r.after[k][2], 0.25 * t * t, 1e-12);
            CU_ASSERT_DOUBLE_EQUAL(r.after[k][3], 0.7 * cos(0.25 * t * t), 1e-12);
        }
        dal_run_free(run);
    }
}

/* A body slides from the top of a ball with the speed w: R_r = g cos s - s'^2 is 0 where
 * cos s = (2 g + w^2)/(3 g), the radius being 1; there it leaves the ball. */
static void test_contact(void)
{
    const double g = 9.81, w = 0.6, cosine = (2.0 * g + w * w) / (3.0 * g);
    const record r = events_of("coordinates: [r, s]\nparameters: {g: 9.81, w: 0.6}\n"
                               "lagrangian: (r'^2 + r^2*s'^2)/2 - g*r*cos(s)\n"
                               "constraints: [r']\nstart: {r: 1, s': w}\n"
                               "events: [{when: R_r, direction: down}]\n",
                               "gauss12", 0.02, 0.9);
    CU_ASSERT_EQUAL_FATAL(r.count, 1);
    CU_ASSERT_DOUBLE_EQUAL(r.after[0][1], acos(cosine), 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(r.after[0][3], sqrt(g * cosine), 1e-12);
}

/* ---- events with an index ---- */

/* x_i = i t is turned at i t = 1/2, by -1/i, and x2, x3 are set where x1 is: at t = 1/2. */
static void test_index(void)
{
    const record r = events_of(
        "sizes: {N: 3}\ncoordinates: ['x[1..N]']\nlagrangian: sum(i, 1, N, x[i]'^2)/2\n"
        "start: {\"x[i]'\": {for: i = 1..N, is: i}}\n"
        "events:\n  - {when: x1 - 0.4}\n"
        "  - {for: i = 1..N, when: 'x[i] - 1/2', direction: up, set: {\"x[i]'\": \"-x[i]'/i\"}}\n"
        "  - {when: x1 - 0.5, set: {\"x[j]\": {for: j = 2..N, is: 10*j}, \"x[N-1]'\": 7, x1': "
        "0}}\n",
        "rk4", 0.03, 1.0);
    static const int event[] = {3, 2, 0, 1, 4};
    static const double t[] = {0.5 / 3, 0.25, 0.4, 0.5, 0.5}, turned[] = {-1.0, -1.0, -1.0};
    CU_ASSERT_EQUAL_FATAL(r.count, 5);
    for (int k = 0; k < 5; k++) {
        CU_ASSERT_EQUAL(r.event[k], event[k]);
        CU_ASSERT_DOUBLE_EQUAL(r.t[k], t[k], 1e-14);
    }
    for (int i = 0; i < 3; i++) CU_ASSERT_DOUBLE_EQUAL(r.after[3][3 + i], turned[i], 1e-14);
    const double end[] = {0.5, 20.0, 30.0, 0.0, 7.0, -1.0};
    for (int i = 0; i < 6; i++) CU_ASSERT_DOUBLE_EQUAL(r.after[4][i], end[i], 1e-14);
    CU_ASSERT_STRING_EQUAL(fixture_system("sizes: {N: 2}\ncoordinates: ['x[1..N]']\n"
                                          "lagrangian: x1'^2 + x2'^2\n"
                                          "events: [{for: i = 1..N, when: 'x[i] - i'}]\n")
                               ->event[1]
                               .name,
                           "event 2 (x[i] - i, i = 2)");
}

/* A parameter that moves the floor above the ball is no impact; one that moves it elsewhere counts
 * from then on, also right after an impact. */
static void test_parameter(void)
{
    const char *text = "coordinates: [y]\nparameters: {r: 0.1}\nlagrangian: y'^2/2 - 9.81*y\n"
                       "start: {y: 1}\n"
                       "events: [{when: y - r, direction: down, restitution: 0.9}]\n";
    record r = {0};
    const dal_run_spec spec = fixture_spec(fixture_system(text), "gauss4", DAL_PHYSICAL, 0.01);
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_advance(run, 10, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_set_parameter(run, "r", 1.5, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(fixture_events(run, 0.2, note, &r, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(r.count, 0);
    CU_ASSERT_EQUAL(dal_run_set_parameter(run, "r", 0.3, NULL), DAL_STATUS_OK);
    while (r.count == 0)
        CU_ASSERT_EQUAL_FATAL(fixture_events(run, 0.5, note, &r, NULL), DAL_STATUS_OK);
    const double t = sqrt(1.4 / 9.81), v = 0.9 * 9.81 * t;
    CU_ASSERT_DOUBLE_EQUAL(r.t[0], t, 1e-12);
    dal_run_free(run);

    r = (record){0};
    run = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_set_parameter(run, "r", 0.3, NULL), DAL_STATUS_OK);
    while (dal_run_event_count(run, 0) == 0)
        CU_ASSERT_EQUAL_FATAL(dal_run_step(run, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_set_parameter(run, "r", 0.3, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(fixture_events(run, 1.2, note, &r, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(r.count, 1);
    CU_ASSERT_DOUBLE_EQUAL(r.t[0], t + 2.0 * v / 9.81, 1e-12);
    dal_run_free(run);
}

/* ---- the step after an event ---- */

/* A robot that hits a wall: the multiplier of its wheels jumps.  What follows is the motion of a
 * run that starts at the event. */
static void test_restart(void)
{
    static const char *const methods[] = {"gni", "lobatto-nonholonomic4", "gauss8", "dop853"};
    const char *text = "coordinates: [x, y, s]\n"
                       "lagrangian: (x'^2 + y'^2)/2 + 0.2*s'^2\n"
                       "constraints: [x'*sin(s) - y'*cos(s)]\n"
                       "start: {s: 0.4, x': cos(0.4), y': sin(0.4), s': 0.3}\n"
                       "events: [{when: 1 - x - 0.3*cos(s), direction: down, restitution: 1}]\n";
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        dal_run_spec spec = fixture_spec(fixture_system(text), methods[i], DAL_PHYSICAL, 0.05);
        dal_run *run = fixture_run(&spec), *other;
        while (dal_run_event_count(run, 0) == 0)
            CU_ASSERT_EQUAL_FATAL(dal_run_step(run, NULL), DAL_STATUS_OK);
        spec.start_time = dal_run_time(run);
        other = fixture_run(&spec);
        CU_ASSERT_EQUAL(dal_run_set_state(other, dal_run_time(run), dal_run_state(run), NULL),
                        DAL_STATUS_OK);
        for (int k = 0; k < 3; k++) {
            CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
            CU_ASSERT_EQUAL(dal_run_step(other, NULL), DAL_STATUS_OK);
            for (int c = 0; c < dal_run_dimension(run); c++)
                CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[c], dal_run_state(other)[c], 1e-14);
        }
        dal_run_free(run);
        dal_run_free(other);
    }
}

#define CORNER(slope)                                                                              \
    "coordinates: [x, y]\nparameters: {k: " slope "}\nlagrangian: (x'^2 + y'^2)/2\n"               \
    "start: {x: 1, y: k/2, x': -1, y': -k/2}\n"                                                    \
    "events:\n  - {when: y, direction: down, restitution: 1}\n"                                    \
    "  - {when: k*x - y, direction: down, restitution: 1}\n"

/* A point in the corner of two walls at an angle a is turned by 2a in each round of impacts, and
 * leaves after pi/2a of them: too many for one time where a = 0.01. */
static void test_corner(void)
{
    static const struct {
        const char *text;
        dal_status status;
    } cases[] = {{CORNER("0.5"), DAL_STATUS_OK}, {CORNER("0.01"), DAL_STATUS_EVENT}};
    for (int k = 0; k < 2; k++) {
        const dal_run_spec spec =
            fixture_spec(fixture_system(cases[k].text), "rk4", DAL_PHYSICAL, 0.0625);
        dal_error error = {0};
        dal_run *run = fixture_run(&spec);
        const dal_status status = fixture_events(run, 1.5, NULL, NULL, &error);
        CU_ASSERT_EQUAL(status, cases[k].status);
        if (status == DAL_STATUS_EVENT)
            CU_ASSERT_PTR_NOT_NULL(strstr(error.message, " happens infinitely often"));
        CU_ASSERT_EQUAL(dal_run_time(run) > 1.0, status == DAL_STATUS_OK);
        const double *v = dal_run_state(run) + 2;
        CU_ASSERT_DOUBLE_EQUAL(hypot(v[0], v[1]), hypot(1.0, cases[k].status ? 0.005 : 0.25),
                               1e-12);
        dal_run_free(run);
    }
}

/* ---- where they stop a run ---- */

typedef struct stop_rows {
    int count;
    bool refuses; /* the row where the run has stopped */
} stop_rows;

static dal_status count_row(void *user, dal_run *run, long long row, double t)
{
    stop_rows *r = user;
    (void)row, (void)t;
    r->count++;
    return r->refuses && dal_run_stopped(run) ? DAL_STATUS_IO : DAL_STATUS_OK;
}

static dal_status ignore_values(void *user, dal_run *run, int count, const double *t,
                                const double *values, size_t stride)
{
    (void)user, (void)run, (void)count, (void)t, (void)values, (void)stride;
    return DAL_STATUS_OK;
}

/* An event that stops within rounding of the last row stops there, and no row is after it; what the
 * observer refuses of that row ends the sampling with its status. */
static void test_stops(void)
{
    static const char text[] = "coordinates: [x]\nlagrangian: x'^2/2\nstart: {x': 1}\n"
                               "events: [{when: x - 1 + 1e-12, stop: true}]\n";
    const dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.125);
    for (int k = 0; k < 4; k++) {
        const bool refuses = k % 2;
        stop_rows r = {.refuses = refuses};
        const dal_observer observer = {.user = &r,
                                       .sample = count_row,
                                       .values = k / 2 ? ignore_values : NULL,
                                       .every = k / 2};
        dal_error error;
        dal_run *run = fixture_run(&spec);
        CU_ASSERT_EQUAL(dal_run_sample(run, 1.0, 1, 0, &observer, &error),
                        refuses ? DAL_STATUS_IO : DAL_STATUS_STOPPED);
        CU_ASSERT_EQUAL(error.status, refuses ? DAL_STATUS_IO : DAL_STATUS_STOPPED);
        CU_ASSERT_EQUAL(dal_run_sample(run, 1.0, 1, 1, &observer, &error), DAL_STATUS_STOPPED);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.message, " stopped the run at t = 0.99999999999"));
        CU_ASSERT_EQUAL(r.count, 2);
        dal_run_free(run);
    }
}

void suite_event_times(void)
{
    CU_pSuite suite = CU_add_suite("event times", NULL, NULL);
    CU_add_test(suite, "at one time", test_simultaneous);
    CU_add_test(suite, "at one time, late", test_simultaneous_late);
    CU_add_test(suite, "within a step", test_within_a_step);
    CU_add_test(suite, "within a step of many substeps", test_within_substeps);
    CU_add_test(suite, "with a nonlinear constraint", test_nonlinear);
    CU_add_test(suite, "of velocities", test_velocity);
    CU_add_test(suite, "where a blade slips", test_grip);
    CU_add_test(suite, "where a contact ends", test_contact);
    CU_add_test(suite, "with an index", test_index);
    CU_add_test(suite, "after a change of a parameter", test_parameter);
    CU_add_test(suite, "the step after an event", test_restart);
    CU_add_test(suite, "in a corner", test_corner);
    CU_add_test(suite, "stopped at a row", test_stops);
}
