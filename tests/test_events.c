/* test_events.c - events of runs against closed forms, and what they must not change. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <dalembert_codegen.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A ball above a floor at y = r. */
#define BALL(event)                                                                                \
    "coordinates: [y]\nparameters: {g: 9.81, c: 0.8, r: 0.1}\nlagrangian: y'^2/2 - g*y\n"          \
    "start: {y: 1.1}\nevents: [{when: y - r, direction: down, " event "}]\n"
/* x = cos t. */
#define OSCILLATOR(events)                                                                         \
    "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x: 1}\nevents: [" events "]\n"

enum { MAX = 64, NUMBERS = 32 };

typedef struct record {
    int count, event[MAX], direction[MAX];
    long long number[MAX];
    double t[MAX], before[MAX][NUMBERS], after[MAX][NUMBERS];
} record;

static dal_status note(void *user, dal_run *run, const dal_occurrence *event)
{
    record *r = user;
    const size_t bytes = (size_t)dal_run_dimension(run) * sizeof(double);
    CU_ASSERT_FATAL(bytes <= NUMBERS * sizeof(double));
    if (r->count == MAX) return DAL_STATUS_OK;
    CU_ASSERT_EQUAL(event->t, dal_run_time(run));
    CU_ASSERT_EQUAL(event->number, dal_run_event_count(run, event->event));
    r->event[r->count] = event->event;
    r->direction[r->count] = event->direction;
    r->number[r->count] = event->number;
    r->t[r->count] = event->t;
    memcpy(r->before[r->count], event->before, bytes);
    memcpy(r->after[r->count++], dal_run_state(run), bytes);
    return DAL_STATUS_OK;
}

static dal_run *run_of(const char *text, const char *method, dal_space space, double step)
{
    const dal_run_spec spec = fixture_spec(fixture_system(text), method, space, step);
    return fixture_run(&spec);
}

/* The events of a run to T. */
static record events_of(const char *text, const char *method, dal_space space, double step,
                        double T, dal_status expected, dal_error *error)
{
    record r = {0};
    dal_error own = {0};
    dal_run *run = run_of(text, method, space, step);
    const dal_status status = fixture_events(run, T, note, &r, error ? error : &own);
    if (status != expected) printf("\n  %s\n", error ? error->message : own.message);
    CU_ASSERT_EQUAL(status, expected);
    dal_run_free(run);
    return r;
}

/* ---- closed forms ---- */

/* t_1 = sqrt(2 H/g), t_(k+1) = t_k + 2 c^k v/g, the speed after bounce k being c^k v. */
static void test_ball(void)
{
    static const char *const methods[] = {"rk4", "gauss4", "stormer-verlet", "discrete-gradient"};
    const double g = 9.81, c = 0.8, first = sqrt(2.0 / g), v = g * first;
    static const char *const texts[] = {BALL("set: {y': -c*y'}"), BALL("restitution: c")};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++)
        for (int k = 0; k < 4; k++) {
            const dal_space space = k % 2 && i < 3 ? DAL_LIFTED : DAL_PHYSICAL;
            const record r =
                events_of(texts[k / 2], methods[i], space, 0.01, 3.0, DAL_STATUS_OK, NULL);
            CU_ASSERT_EQUAL_FATAL(r.count, 6);
            double t = first, speed = v;
            for (int b = 0; b < r.count; b++) {
                CU_ASSERT_DOUBLE_EQUAL(r.t[b], t, 1e-12);
                CU_ASSERT_DOUBLE_EQUAL(r.before[b][0], 0.1, 1e-14);
                CU_ASSERT_DOUBLE_EQUAL(r.before[b][1], -speed, 1e-12);
                speed *= c;
                CU_ASSERT_DOUBLE_EQUAL(r.after[b][1], speed, 1e-12);
                CU_ASSERT(r.number[b] == b + 1 && r.direction[b] == -1 && r.event[b] == 0);
                t += 2.0 * speed / g;
            }
        }
}

/* Backwards in time a ball bounces at -t_1, -t_2, ..; down and up are meant along the run. */
static void test_backwards(void)
{
    const double g = 9.81, c = 0.8, first = sqrt(2.0 / g);
    const record r =
        events_of(BALL("restitution: c"), "gauss4", DAL_LIFTED, -0.01, -1.5, DAL_STATUS_OK, NULL);
    CU_ASSERT_EQUAL_FATAL(r.count, 2);
    CU_ASSERT_DOUBLE_EQUAL(r.t[0], -first, 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(r.t[1], -first * (1.0 + 2.0 * c), 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(r.after[0][1], -c * g * first, 1e-12);
    CU_ASSERT_EQUAL(r.direction[0], -1);
}

/* On a plane of slope a the distance from it is a ball's height under g cos a, and the place along
 * it has the acceleration g sin a. */
static void test_tilted(void)
{
    const char *text = "coordinates: [x, y]\nparameters: {g: 9.81, c: 0.7, a: 0.3, H: 0.5}\n"
                       "lagrangian: (x'^2 + y'^2)/2 - g*y\n"
                       "start: {x: -H*sin(a), y: H*cos(a)}\n"
                       "events: [{when: x*sin(a) + y*cos(a), direction: down, restitution: c}]\n";
    text = "coordinates: [x, y]\nparameters: {g: 9.81, c: 0.7, a: 0.3, H: 0.5}\n"
           "lagrangian: (x'^2 + y'^2)/2 - g*y\n"
           "start: {x: H*sin(a), y: H*cos(a)}\n"
           "events: [{when: x*sin(a) + y*cos(a), direction: down, restitution: c}]\n";
    const double g = 9.81, c = 0.7, a = 0.3, H = 0.5;
    const record r = events_of(text, "gauss4", DAL_PHYSICAL, 0.02, 1.5, DAL_STATUS_OK, NULL);
    double t = sqrt(2.0 * H / (g * cos(a))), speed = g * cos(a) * t;
    CU_ASSERT_FATAL(r.count >= 4);
    for (int b = 0; b < r.count; b++) {
        const double *z = r.after[b], along = 0.5 * g * sin(a) * t * t;
        CU_ASSERT_DOUBLE_EQUAL(r.t[b], t, 1e-12);
        CU_ASSERT_DOUBLE_EQUAL(z[0] * cos(a) - z[1] * sin(a), along, 1e-12);
        CU_ASSERT_DOUBLE_EQUAL(z[2] * cos(a) - z[3] * sin(a), g * sin(a) * t, 1e-12);
        speed *= c;
        CU_ASSERT_DOUBLE_EQUAL(z[2] * sin(a) + z[3] * cos(a), speed, 1e-12);
        t += 2.0 * speed / (g * cos(a));
    }
}

/* int 1/sqrt(1 - k^2 sin^2 u) du by Gauss' rule of 5 points on panels. */
static double elliptic(double k, double from, double to)
{
    static const double x[] = {0.0, 0.53846931010568309104, 0.90617984593866399280};
    static const double w[] = {0.56888888888888888889, 0.47862867049936646804,
                               0.23692688505618908751};
    enum { PANELS = 400 };
    const double half = 0.5 * (to - from) / PANELS;
    double sum = 0.0;
    for (int i = 0; i < PANELS; i++)
        for (int j = -2; j <= 2; j++) {
            const double u = from + half * (2 * i + 1 + (j < 0 ? -x[-j] : x[j]));
            sum += half * w[abs(j)] / sqrt(1.0 - k * k * sin(u) * sin(u));
        }
    return sum;
}

/* From rest at -A a pendulum is at B at t = F(phi) - F(-pi/2), sin(B/2) = k sin(phi), k = sin(A/2);
 * a stop there with c = 1 makes it periodic with twice that time. */
static void test_pendulum(void)
{
    const char *text = "coordinates: [q]\nparameters: {A: 1.2, B: 0.5}\n"
                       "lagrangian: q'^2/2 + cos(q)\nstart: {q: -A}\n"
                       "events: [{when: q - B, direction: up, restitution: 1}]\n";
    const double k = sin(0.6), phi = asin(sin(0.25) / k), half_pi = acos(0.0);
    const double half = elliptic(k, -half_pi, phi);
    const record r = events_of(text, "gauss12", DAL_LIFTED, 0.05, 20.0, DAL_STATUS_OK, NULL);
    CU_ASSERT_EQUAL_FATAL(r.count, (int)((20.0 / half + 1.0) / 2.0));
    for (int b = 0; b < r.count; b++) {
        CU_ASSERT_DOUBLE_EQUAL(r.t[b], (2 * b + 1) * half, 1e-12);
        CU_ASSERT_DOUBLE_EQUAL(r.after[b][1], -sqrt(2.0 * (cos(0.5) - cos(1.2))), 1e-12);
    }
}

/* Friction m u g stops a block after v/(u g), on the way v^2/(2 u g). */
static void test_block(void)
{
    const char *text = "coordinates: [x]\nparameters: {u: 0.3, g: 9.81, v: 2}\n"
                       "accelerations: {x: -u*g}\nstart: {x': v}\n"
                       "events: [{when: x', direction: down, stop: true}]\n";
    dal_error error = {0};
    const record r = events_of(text, "rk4", DAL_PHYSICAL, 0.01, 5.0, DAL_STATUS_STOPPED, &error);
    CU_ASSERT_EQUAL_FATAL(r.count, 1);
    CU_ASSERT_DOUBLE_EQUAL(r.t[0], 2.0 / (0.3 * 9.81), 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(r.after[0][0], 2.0 / (0.3 * 9.81), 1e-12);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "event 1 (x') stopped the run at t = 0.679"));
}

/* ---- impacts with constraints ---- */

#define ROBOT(event)                                                                               \
    "coordinates: [x, y, s]\nparameters: {c: 1, u: 1, w: 0.3, a: 0.3}\n"                           \
    "lagrangian: (x'^2 + y'^2)/2 + 0.2*s'^2\nconstraints: [x'*sin(s) - y'*cos(s)]\n"               \
    "start: {s: 0.4, x': u*cos(0.4), y': u*sin(0.4), s': w}\n"                                     \
    "events: [{when: 1 - x - a*cos(s), direction: down, " event "}]\n"

/* D = 0 after the impact, the rate of `when` has turned, and W (v+ - v-) is a combination of the
 * two normals: it does no work along the direction that both leave free. */
static void test_impact(void)
{
    const record r =
        events_of(ROBOT("restitution: c"), "gauss8", DAL_PHYSICAL, 0.02, 5.0, DAL_STATUS_OK, NULL);
    CU_ASSERT_FATAL(r.count >= 2);
    for (int k = 0; k < r.count; k++) {
        const double *z = r.after[k], *v = z + 3, *u = r.before[k] + 3, s = z[2];
        const double f[] = {-1.0, 0.0, 0.3 * sin(s)}, A[] = {sin(s), -cos(s), 0.0};
        const double d[] = {f[1] * A[2] - f[2] * A[1], f[2] * A[0] - f[0] * A[2],
                            f[0] * A[1] - f[1] * A[0]};
        const double W[] = {1.0, 1.0, 0.4};
        double after = 0.0, before = 0.0, D = 0.0, work = 0.0, energy = 0.0;
        for (int i = 0; i < 3; i++) {
            after += f[i] * v[i];
            before += f[i] * u[i];
            D += A[i] * v[i];
            work += d[i] * W[i] * (v[i] - u[i]);
            energy += 0.5 * W[i] * (v[i] * v[i] - u[i] * u[i]);
        }
        CU_ASSERT_DOUBLE_EQUAL(after, -before, 1e-14);
        CU_ASSERT_DOUBLE_EQUAL(D, 0.0, 1e-15);
        CU_ASSERT_DOUBLE_EQUAL(work, 0.0, 1e-14);
        CU_ASSERT_DOUBLE_EQUAL(energy, 0.0, 1e-10); /* D of gauss8 before the impact */
    }
}

/* What is set is moved to D = 0 in the mass metric: v = u - W^-1 A^T (A u)/(A W^-1 A^T). */
static void test_projection(void)
{
    const record r = events_of(ROBOT("set: {x': -x' - 1, s': 0.7}"), "gauss8", DAL_LIFTED, 0.02,
                               1.0, DAL_STATUS_OK, NULL);
    CU_ASSERT_EQUAL_FATAL(r.count, 1);
    const double *u = r.before[0] + 3, *v = r.after[0] + 3, s = r.after[0][2];
    const double away = -u[0] - 1.0, off = away * sin(s) - u[1] * cos(s);
    CU_ASSERT_DOUBLE_EQUAL(v[0], away - off * sin(s), 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(v[1], u[1] + off * cos(s), 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(v[2], 0.7, 1e-15);
}

/* x is held where a wall arrives; there are no velocities where x is set to 3. */
static void test_unprojectable(void)
{
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\nconstraints: [x']\n"
         "events: [{when: 1 - t - x, restitution: 1}]\n",
         "event 1 (1 - t - x) at t = 1 changes no velocity that the constraints leave free"},
        {"coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
         "constraints: [x'^2 + y'^2 + x - 2]\nstart: {x': 1, y': 1}\n"
         "events: [{when: y - 0.5, set: {x: 3}}]\n",
         "near the velocities of event 1 (y - 0.5) at t = 0.53589838"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        dal_error error = {0};
        events_of(cases[k].text, "rk4", DAL_PHYSICAL, 0.1, 2.0, DAL_STATUS_EVENT, &error);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.message, cases[k].message));
        if (!strstr(error.message, cases[k].message)) printf("\n  %s\n", error.message);
    }
}

/* A wall that moves with the speed u: in its frame the ball is turned, v+ = 2 u - v-. */
static void test_moving_wall(void)
{
    const char *text = "coordinates: [x]\nparameters: {u: -0.5}\nlagrangian: x'^2/2\n"
                       "start: {x': 1}\n"
                       "events: [{when: 3 + u*t - x, direction: down, restitution: 1}]\n";
    const record r = events_of(text, "rk4", DAL_PHYSICAL, 0.07, 4.0, DAL_STATUS_OK, NULL);
    CU_ASSERT_EQUAL_FATAL(r.count, 1);
    CU_ASSERT_DOUBLE_EQUAL(r.t[0], 2.0, 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(r.after[0][1], -2.0, 1e-14);
}

/* ---- which events happen ---- */

/* cos t = 0 at pi/2 + k pi, downwards first; a set that changes no more than a mode. */
static void test_directions(void)
{
    const double pi = acos(-1.0);
    const char *text =
        OSCILLATOR("{when: x}, {when: x, direction: up}, {when: x, direction: down}");
    const record r = events_of(text, "gauss12", DAL_LIFTED, 0.1, 20.0, DAL_STATUS_OK, NULL);
    CU_ASSERT_EQUAL_FATAL(r.count, 12);
    for (int k = 0; k < 6; k++) {
        const double t = (k + 0.5) * pi;
        CU_ASSERT_DOUBLE_EQUAL(r.t[2 * k], t, 1e-12);
        CU_ASSERT_EQUAL(r.t[2 * k + 1], r.t[2 * k]);
        CU_ASSERT_EQUAL(r.event[2 * k], 0);
        CU_ASSERT_EQUAL(r.event[2 * k + 1], k % 2 ? 1 : 2);
        CU_ASSERT(r.direction[2 * k] == (k % 2 ? 1 : -1));
    }
}

/* Two roots within one step, cos t = 0.999 about t = 2 pi, and no more than a touch of 1. */
static void test_pair(void)
{
    const double pi = acos(-1.0), near = acos(0.999);
    const char *both = OSCILLATOR("{when: x - 0.999}"),
               *up = OSCILLATOR("{when: x - 0.999, direction: up}");
    const char *down = OSCILLATOR("{when: x - 0.999, direction: down}"),
               *touch = OSCILLATOR("{when: x - 1}");
    record r = events_of(both, "gauss12", DAL_PHYSICAL, 0.15, 7.0, DAL_STATUS_OK, NULL);
    CU_ASSERT_EQUAL_FATAL(r.count, 3);
    CU_ASSERT_DOUBLE_EQUAL(r.t[0], near, 1e-11);
    CU_ASSERT_DOUBLE_EQUAL(r.t[1], 2.0 * pi - near, 1e-11);
    CU_ASSERT_DOUBLE_EQUAL(r.t[2], 2.0 * pi + near, 1e-11);
    r = events_of(up, "gauss12", DAL_PHYSICAL, 0.15, 7.0, DAL_STATUS_OK, NULL);
    CU_ASSERT(r.count == 1 && fabs(r.t[0] - 2.0 * pi + near) < 1e-11);
    r = events_of(down, "gauss12", DAL_PHYSICAL, 0.15, 7.0, DAL_STATUS_OK, NULL);
    CU_ASSERT(r.count == 2 && fabs(r.t[1] - 2.0 * pi - near) < 1e-11);
    r = events_of(touch, "gauss12", DAL_PHYSICAL, 0.15, 7.0, DAL_STATUS_OK, NULL);
    CU_ASSERT_EQUAL(r.count, 0);
}

/* At one time in the order of the file, each on what the one before has left; in a corner of two
 * walls each turns its velocity. */
static void test_order_in_the_file(void)
{
    const char *set = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                      "start: {x': 1, y': 1}\nevents: [{when: y - 0.3, set: {x: 2*x}},"
                      "{when: 0.3 - x, direction: both, set: {y: y + x}}]\n";
    record r = events_of(set, "rk4", DAL_PHYSICAL, 0.25, 1.0, DAL_STATUS_OK, NULL);
    CU_ASSERT_EQUAL_FATAL(r.count, 2);
    CU_ASSERT(r.event[0] == 0 && r.event[1] == 1 && r.t[0] == r.t[1]);
    CU_ASSERT_DOUBLE_EQUAL(r.after[1][0], 0.6, 1e-15);
    CU_ASSERT_DOUBLE_EQUAL(r.after[1][1], 0.9, 1e-15);
    /* The same where nobody listens: from (0.6, 0.9) at t = 0.3 with velocity (1, 1). */
    dal_run *run = run_of(set, "rk4", DAL_PHYSICAL, 0.25);
    CU_ASSERT_EQUAL(fixture_events(run, 1.0, NULL, NULL, NULL), DAL_STATUS_OK);
    CU_ASSERT(dal_run_event_count(run, 0) == 1 && dal_run_event_count(run, 1) == 1);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[0], 0.3 + dal_run_time(run), 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[1], 0.6 + dal_run_time(run), 1e-14);
    dal_run_free(run);
    const char *corner = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                         "start: {x': 1, y': 1}\n"
                         "events: [{when: 0.3 - x, direction: down, restitution: 1},"
                         "{when: 0.3 - y, direction: down, restitution: 0.5}]\n";
    r = events_of(corner, "gauss4", DAL_LIFTED, 0.25, 1.0, DAL_STATUS_OK, NULL);
    CU_ASSERT_EQUAL_FATAL(r.count, 2);
    CU_ASSERT_DOUBLE_EQUAL(r.after[1][2], -1.0, 1e-15);
    CU_ASSERT_DOUBLE_EQUAL(r.after[1][3], -0.5, 1e-15);
}

/* A step that fails beyond the wall, where sqrt(y) has no value. */
static void test_wall_before_a_pole(void)
{
    const char *text = "coordinates: [y]\naccelerations: {y: 1e-9*sqrt(y)}\n"
                       "start: {y: 1, y': -3}\n"
                       "events: [{when: y - 0.05, direction: down, restitution: 1}]\n";
    record r = events_of(text, "rk4", DAL_PHYSICAL, 0.2, 0.6, DAL_STATUS_OK, NULL);
    CU_ASSERT_EQUAL_FATAL(r.count, 1);
    CU_ASSERT_DOUBLE_EQUAL(r.t[0], 0.95 / 3.0, 1e-8);
    CU_ASSERT_DOUBLE_EQUAL(r.after[0][1], 3.0, 1e-8);
    /* The formula of the event has no value there; the message of the longer step is not left. */
    dal_error error = {0};
    r = events_of("coordinates: [x]\nlagrangian: x'^2/2\nstart: {x': 1}\n"
                  "events: [{when: sqrt(0.53 - x) - 0.1, set: {x': -1}}]\n",
                  "rk4", DAL_PHYSICAL, 0.2, 0.8, DAL_STATUS_OK, &error);
    CU_ASSERT_EQUAL_FATAL(r.count, 1);
    CU_ASSERT_DOUBLE_EQUAL(r.t[0], 0.52, 1e-14);
    CU_ASSERT_STRING_EQUAL(error.message, "");
}

/* ---- what cannot be passed ---- */

/* Bounces of a ball accumulate at t_1 (1 + c)/(1 - c). */
static void test_endless(void)
{
    dal_error error = {0};
    record *r = calloc(1, sizeof *r);
    *r = events_of(BALL("restitution: 0.5"), "gauss4", DAL_PHYSICAL, 0.01, 3.0, DAL_STATUS_EVENT,
                   &error);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "event 1 (y - r) happens infinitely often"));
    CU_ASSERT_FATAL(r->count > 10);
    CU_ASSERT_DOUBLE_EQUAL(r->t[r->count - 1], 3.0 * sqrt(2.0 / 9.81), 1e-7);
    *r = events_of(BALL("restitution: 0"), "gauss4", DAL_PHYSICAL, 0.01, 3.0, DAL_STATUS_EVENT,
                   &error);
    CU_ASSERT_EQUAL(r->count, 1);
    /* Two events that set each other off at one time. */
    events_of("coordinates: [x]\nlagrangian: x'^2/2\nstart: {x: 0.5, x': 1}\n"
              "events: [{when: x - 1, set: {x: 0, x': -1}}, {when: x, set: {x: 1, x': 1}}]\n",
              "rk4", DAL_PHYSICAL, 0.01, 3.0, DAL_STATUS_EVENT, &error);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "at t = 0.5"));
    /* What a set passes over is no crossing. */
    *r = events_of("coordinates: [x]\nlagrangian: x'^2/2\nstart: {x: 0.5, x': 1}\n"
                   "events: [{when: x - 1, set: {x: 3}}, {when: x - 2, set: {x: 0}}]\n",
                   "rk4", DAL_PHYSICAL, 0.01, 3.0, DAL_STATUS_OK, NULL);
    CU_ASSERT_EQUAL(r->count, 1);
    free(r);
}

static void test_outward(void)
{
    dal_error error = {0};
    const record r = events_of(BALL("set: {y': y'/2}"), "rk4", DAL_PHYSICAL, 0.01, 3.0,
                               DAL_STATUS_EVENT, &error);
    CU_ASSERT_EQUAL(r.count, 1);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "event 1 (y - r) at t = 0.4515"));
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "still lead out"));
    /* One at rest upon a wall. */
    const char *rest = "coordinates: [y]\nlagrangian: y'^2/2 - y\n"
                       "events: [{when: y, direction: down, restitution: 0.5}]\n";
    events_of(rest, "rk4", DAL_PHYSICAL, 0.01, 3.0, DAL_STATUS_EVENT, &error);
    CU_ASSERT_PTR_NOT_NULL(
        strstr(error.message, "event 1 (y) happens infinitely often from t = 0"));
    /* A set that gives no velocity is no wall, and neither is one of both directions. */
    CU_ASSERT(
        events_of(BALL("set: {y: y}"), "rk4", DAL_PHYSICAL, 0.01, 3.0, DAL_STATUS_OK, NULL).count ==
        1);
    events_of(BALL("restitution: y - 1"), "rk4", DAL_PHYSICAL, 0.01, 3.0, DAL_STATUS_EVENT, &error);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "has the restitution -0.9"));
}

/* ---- runs ---- */

typedef struct rows {
    int count;
    double values[MAX][3];
} rows;

static dal_status add_row(void *user, dal_run *run, long long row, double t)
{
    rows *r = user;
    (void)row;
    CU_ASSERT_FATAL(r->count < MAX);
    r->values[r->count][0] = t;
    memcpy(&r->values[r->count++][1], dal_run_state(run), 2 * sizeof(double));
    return DAL_STATUS_OK;
}

/* The height of the ball at t. */
static double height(double t)
{
    const double g = 9.81, c = 0.8;
    double begin = -sqrt(2.0 / g), speed = g * -begin, end = -begin;
    while (end < t) {
        speed *= c;
        begin = end;
        end += 2.0 * speed / g;
    }
    return 0.1 + speed * (t - begin) - 0.5 * g * (t - begin) * (t - begin);
}

/* Rows and interruptions do not change the motion; the last row of a stopped run is the event. */
static void test_rows(void)
{
    const dal_observer observer = {.user = &(rows){0}, .sample = add_row};
    const char *text = BALL("restitution: c");
    rows *r = observer.user, few;
    dal_run *run = run_of(text, "gauss6", DAL_LIFTED, 0.1),
            *other = run_of(text, "gauss6", DAL_LIFTED, 0.1);
    CU_ASSERT_EQUAL(dal_run_sample(run, 3.0, 5, 0, &observer, NULL), DAL_STATUS_OK);
    few = *r;
    *r = (rows){0};
    CU_ASSERT_EQUAL(dal_run_sample(other, 3.0, 50, 0, &observer, NULL), DAL_STATUS_OK);
    for (int k = 0; k <= 50; k++)
        CU_ASSERT_DOUBLE_EQUAL(r->values[k][1], height(r->values[k][0]), 1e-12);
    for (int k = 0; k <= 5; k++)
        CU_ASSERT_EQUAL(memcmp(few.values[k], r->values[10 * k], sizeof few.values[k]), 0);
    size_t count;
    const double *saved = dal_run_save(run, &count);
    CU_ASSERT_EQUAL(memcmp(saved, dal_run_save(other, &count), count * sizeof *saved), 0);
    dal_run_free(run);
    dal_run_free(other);

    *r = (rows){0};
    run = run_of(BALL("stop: true"), "gauss6", DAL_LIFTED, 0.1);
    CU_ASSERT_EQUAL(dal_run_sample(run, 3.0, 30, 0, &observer, NULL), DAL_STATUS_STOPPED);
    CU_ASSERT_EQUAL(r->count, 6);
    CU_ASSERT_DOUBLE_EQUAL(r->values[5][0], sqrt(2.0 / 9.81), 1e-12);
    CU_ASSERT_EQUAL(dal_run_stopped(run), 1);
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_STOPPED);
    CU_ASSERT_EQUAL(r->count, 6);
    dal_run_free(run);
}

/* A run saved at any step, right after an event too, continues with the same bits. */
static void test_resume(void)
{
    enum { STEPS = 120 };
    dal_run *run = run_of(BALL("restitution: c"), "gauss6", DAL_LIFTED, 0.03);
    dal_run *other = run_of(BALL("restitution: c"), "gauss6", DAL_LIFTED, 0.03);
    size_t count;
    dal_run_save(run, &count);
    for (int k = 0; k < STEPS; k++) {
        CU_ASSERT_EQUAL(dal_run_restore(other, dal_run_save(run, NULL), 0, NULL),
                        DAL_STATUS_ARGUMENT);
        const double *saved = dal_run_save(run, &count);
        CU_ASSERT_EQUAL(dal_run_restore(other, saved, count, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_step(other, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(memcmp(saved, dal_run_save(other, &count), count * sizeof *saved), 0);
    }
    CU_ASSERT(dal_run_event_count(run, 0) > 5);
    dal_run_free(run);
    dal_run_free(other);
}

/* What E loses at an impact is its jump: (1 - c^2) v^2/2. */
static void test_jump(void)
{
    dal_run *run = run_of(BALL("restitution: c"), "gauss4", DAL_PHYSICAL, 0.01);
    double E[8];
    CU_ASSERT_EQUAL(fixture_events(run, 2.0, NULL, NULL, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_event_count(run, 0), 3);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_event_jump(run, 0), (pow(0.8, 6) - 1.0) * 9.81, 1e-12);
    CU_ASSERT_EQUAL(dal_run_observe(run, E), DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(E[0] - dal_run_event_jump(run, 0), 9.81 * 1.1, 1e-12);
    CU_ASSERT_EQUAL(dal_run_event_jump(run, 1), 0.0);
    CU_ASSERT_EQUAL(dal_run_event_count(run, 1), -1);
    dal_run_free(run);
}

static void test_quad(void)
{
    dal_run_spec spec =
        fixture_spec(fixture_system(BALL("restitution: c")), "gauss4", DAL_PHYSICAL, 0.05);
    spec.options.precision = DAL_QUAD;
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_EQUAL(fixture_events(run, 1.0, NULL, NULL, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_event_count(run, 0), 1);
    const double first = sqrt(2.0 / 9.81), t = dal_run_time(run) - first;
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[0], 0.1 + 0.8 * 9.81 * first * t - 0.5 * 9.81 * t * t,
                           1e-14);
    dal_run_free(run);
}

/* ---- what is refused ---- */

static void test_refuses(void)
{
    dal_run_spec spec =
        fixture_spec(fixture_system(BALL("restitution: c")), "gauss4", DAL_LIFTED, 0.1);
    dal_error error = {0};
    const dal_setting start = {"pi_y", 1.0};
    dal_batch *batch;
    char *text;
    spec.start = &start;
    spec.start_count = 1;
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, "events act on p = pi = 0 only");
    spec.start_count = 0;
    dal_run *run = fixture_run(&spec);
    fixture_perturb(run, 1.0);
    CU_ASSERT_EQUAL(dal_run_step(run, &error), DAL_STATUS_UNSUPPORTED);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "events act on p = pi = 0 only"));
    dal_run_free(run);
    CU_ASSERT_EQUAL(dal_batch_create(&batch, &spec, 4, 0, &error), DAL_STATUS_UNSUPPORTED);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "has events: batches would pass over them"));
    CU_ASSERT_EQUAL(dal_generate(&spec, NULL, &text, &error), DAL_STATUS_UNSUPPORTED);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "has events"));
}

/* Without restitution a point goes on along the wall: what roundings leave of its velocity to the
 * wall does not lead out, whichever way the wall is turned. */
static void test_inelastic(void)
{
    enum { WALLS = 40 };
    for (int k = 1; k <= WALLS; k++) {
        char text[256];
        const double a = 0.15 * k, x = 0.3 + 0.01 * k;
        snprintf(
            text, sizeof text,
            "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
            "start: {x': %.17g, y': %.17g}\n"
            "events: [{when: 1 - x*cos(%.17g) - y*sin(%.17g), direction: down, restitution: 0}]"
            "\n",
            cos(a) - x * sin(a), sin(a) + x * cos(a), a, a);
        const record r = events_of(text, "rk4", DAL_PHYSICAL, 0.1, 3.0, DAL_STATUS_OK, NULL);
        CU_ASSERT_EQUAL_FATAL(r.count, 1);
        CU_ASSERT_DOUBLE_EQUAL(r.t[0], 1.0, 1e-12);
        CU_ASSERT_DOUBLE_EQUAL(r.after[0][2], -x * sin(a), 1e-14);
        CU_ASSERT_DOUBLE_EQUAL(r.after[0][3], x * cos(a), 1e-14);
    }
}

void suite_events(void)
{
    CU_pSuite suite = CU_add_suite("events", NULL, NULL);
    CU_add_test(suite, "a bouncing ball", test_ball);
    CU_add_test(suite, "backwards", test_backwards);
    CU_add_test(suite, "on an incline", test_tilted);
    CU_add_test(suite, "a pendulum against a stop", test_pendulum);
    CU_add_test(suite, "a sliding block", test_block);
    CU_add_test(suite, "impacts with constraints", test_impact);
    CU_add_test(suite, "what is set is moved to D = 0", test_projection);
    CU_add_test(suite, "what cannot be moved to D = 0", test_unprojectable);
    CU_add_test(suite, "a moving wall", test_moving_wall);
    CU_add_test(suite, "directions", test_directions);
    CU_add_test(suite, "pairs in a step", test_pair);
    CU_add_test(suite, "at one time", test_order_in_the_file);
    CU_add_test(suite, "a wall before a pole", test_wall_before_a_pole);
    CU_add_test(suite, "infinitely many", test_endless);
    CU_add_test(suite, "velocities that lead out", test_outward);
    CU_add_test(suite, "without restitution", test_inelastic);
    CU_add_test(suite, "rows", test_rows);
    CU_add_test(suite, "resumed", test_resume);
    CU_add_test(suite, "jumps of E", test_jump);
    CU_add_test(suite, "quad precision", test_quad);
    CU_add_test(suite, "what is refused", test_refuses);
}
