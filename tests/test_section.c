/* test_section.c - intermediate steps, and the crossings of a Poincare section. */
#include "allocation.h"
#include "analysis/differences.h"
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* x = cos t, with sections g of its own. */
#define OSCILLATOR(g)                                                                              \
    "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x: 1}\ninvariants: {g: " g "}\n"

enum { MAX = 64 };

typedef struct record {
    int count;
    double t[MAX], g[MAX];
    int direction[MAX];
    long long number[MAX];
    int polls, stop_after;
} record;

static dal_status note(void *user, dal_run *run, const dal_crossing *crossing)
{
    record *r = user;
    double seen[MAX];
    CU_ASSERT_FATAL(r->count < MAX);
    CU_ASSERT_EQUAL(dal_run_time(run), crossing->t);
    CU_ASSERT_EQUAL(dal_run_observe(run, seen), DAL_STATUS_OK);
    const dal_system *s = dal_run_system(run);
    const int lifted = dal_run_dimension(run) > 2 * s->n + s->multipliers;
    r->g[r->count] = seen[s->m + (s->energy != NULL) + (lifted ? 4 : 0)];
    r->t[r->count] = crossing->t;
    r->direction[r->count] = crossing->direction;
    r->number[r->count++] = crossing->number;
    return r->count == r->stop_after ? DAL_STATUS_INTERRUPTED : DAL_STATUS_OK;
}

static dal_status poll(void *user, dal_run *run)
{
    (void)run;
    ((record *)user)->polls++;
    return DAL_STATUS_OK;
}

/* The crossings of invariant 1 by a run. */
static dal_status cross(dal_run *run, double T, int direction, record *r, dal_crossings *found,
                        dal_error *error)
{
    const dal_system *s = dal_run_system(run);
    const dal_poincare section = {.callback = s->invariant_values,
                                  .count = s->invariants,
                                  .direction = direction,
                                  .user = r,
                                  .cross = note,
                                  .poll = poll};
    return dal_run_crossings(run, T, &section, found, error);
}

/* The same of a fixture from its start. */
static record crossings_of(const char *text, const char *method, double step, double T,
                           int direction, dal_crossings *found)
{
    const dal_run_spec spec = fixture_spec(fixture_system(text), method, DAL_PHYSICAL, step);
    dal_run *run = fixture_run(&spec);
    dal_error error = {0};
    record r = {0};
    const dal_status status = cross(run, T, direction, &r, found, &error);
    if (status != DAL_STATUS_OK) printf("\n  %s\n", error.message);
    CU_ASSERT_EQUAL(status, DAL_STATUS_OK);
    dal_run_free(run);
    return r;
}

/* ---- an intermediate step ---- */

static dal_status copy_x(void *user, dal_run *run)
{
    double *out = user;
    out[0] = dal_run_time(run);
    out[1] = dal_run_state(run)[0];
    return out[1] < 0.0 ? DAL_STATUS_INTERRUPTED : DAL_STATUS_OK;
}

static void test_intermediate(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system(OSCILLATOR("x")), "gauss12", DAL_LIFTED, 0.25);
    dal_run *run = fixture_run(&spec);
    double seen[2], before[256];
    size_t count;
    CU_ASSERT_EQUAL(dal_run_step_size(run), 0.25);
    CU_ASSERT_EQUAL(dal_run_advance(run, 3, NULL), DAL_STATUS_OK);
    const double *memory = dal_run_save(run, &count);
    CU_ASSERT_FATAL(count < 256);
    memcpy(before, memory, count * sizeof *memory);
    CU_ASSERT_EQUAL(dal_run_intermediate(run, 0.125, copy_x, seen, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(seen[0], 0.875);
    CU_ASSERT_DOUBLE_EQUAL(seen[1], cos(0.875), 1e-15);
    /* Backwards, and beyond the step; what look returns is returned. */
    CU_ASSERT_EQUAL(dal_run_intermediate(run, -0.5, copy_x, seen, NULL), DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(seen[1], cos(0.25), 1e-13);
    CU_ASSERT_EQUAL(dal_run_intermediate(run, 1.0, copy_x, seen, NULL), DAL_STATUS_INTERRUPTED);
    CU_ASSERT_EQUAL(dal_run_intermediate(run, NAN, copy_x, seen, NULL), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(memcmp(before, memory, count * sizeof *memory), 0);
    dal_run_free(run);
}

/* ---- crossings of a known motion ---- */

/* cos t = 0 at pi/2 + k pi, downwards first. */
static void test_times(void)
{
    dal_crossings found;
    const record r = crossings_of(OSCILLATOR("x"), "gauss12", 0.1, 20.0, 0, &found);
    CU_ASSERT_EQUAL_FATAL(r.count, 6);
    CU_ASSERT(found.down == 3 && found.up == 3 && found.touches == 0);
    for (int k = 0; k < 6; k++) {
        CU_ASSERT_DOUBLE_EQUAL(r.t[k], pi / 2.0 + k * pi, 1e-14 * (2 + k));
        CU_ASSERT_DOUBLE_EQUAL(r.g[k], 0.0, 2e-16 * 20.0);
        CU_ASSERT_EQUAL(r.direction[k], k % 2 ? 1 : -1);
        CU_ASSERT_EQUAL(r.number[k], k + 1);
    }
}

static void test_directions(void)
{
    for (int direction = -1; direction <= 1; direction += 2) {
        dal_crossings found;
        const record r = crossings_of(OSCILLATOR("x"), "gauss12", 0.1, 20.0, direction, &found);
        CU_ASSERT_EQUAL_FATAL(r.count, 3);
        CU_ASSERT(found.down == 3 && found.up == 3);
        for (int k = 0; k < 3; k++) {
            const double first = direction < 0 ? 0.5 : 1.5;
            CU_ASSERT_DOUBLE_EQUAL(r.t[k], (first + 2 * k) * pi, 1e-13);
            CU_ASSERT_EQUAL(r.direction[k], direction);
            CU_ASSERT_EQUAL(r.number[k], k + 1);
        }
    }
}

/* A section of t alone: the phase 3 t + 1 of a forcing. */
static void test_in_time(void)
{
    dal_crossings found;
    const record r = crossings_of(OSCILLATOR("sin(3*t + 1)"), "rk4", 0.05, 10.0, 1, &found);
    CU_ASSERT_EQUAL_FATAL(r.count, 4);
    for (int k = 0; k < 4; k++)
        CU_ASSERT_DOUBLE_EQUAL(r.t[k], (2.0 * pi * (k + 1) - 1.0) / 3.0, 1e-14);
}

/* Between two steps x exceeds 0.999 and falls again: crossings a = arccos 0.999 about 2 pi k. */
static void test_pairs_in_a_step(void)
{
    dal_crossings found;
    const double a = acos(0.999);
    const record r = crossings_of(OSCILLATOR("x - 0.999"), "gauss12", 0.1, 20.0, 0, &found);
    CU_ASSERT_EQUAL_FATAL(r.count, 7);
    CU_ASSERT(found.down == 4 && found.up == 3 && found.touches == 0);
    for (int k = 0; k < 7; k++)
        CU_ASSERT_DOUBLE_EQUAL(r.t[k], 2.0 * pi * ((k + 1) / 2) + (k % 2 ? -a : a), 2e-12);
}

/* Under a tolerance, crossings and pairs in one step of many substeps: x = 1/2, and x = 0.999. */
static void test_within_substeps(void)
{
    static const char *const methods[] = {"dop853", "taylor"};
    for (int i = 0; i < 4; i++) {
        const char *text = i < 2 ? OSCILLATOR("x - 0.5") : OSCILLATOR("x - 0.999");
        const double a = acos(i < 2 ? 0.5 : 0.999);
        dal_run_spec spec = fixture_spec(fixture_system(text), methods[i % 2], DAL_PHYSICAL, 20.0);
        spec.options.tolerance = 1e-14;
        dal_run *run = fixture_run(&spec);
        dal_crossings found;
        record r = {0};
        CU_ASSERT_EQUAL(cross(run, 20.0, 0, &r, &found, NULL), DAL_STATUS_OK);
        dal_run_free(run);
        CU_ASSERT_EQUAL_FATAL(r.count, 7);
        CU_ASSERT(found.down == 4 && found.up == 3 && found.touches == 0);
        for (int k = 0; k < 7; k++)
            CU_ASSERT_DOUBLE_EQUAL(r.t[k], 2.0 * pi * ((k + 1) / 2) + (k % 2 ? -a : a), 1e-11);
    }
}

/* (t - a)^2 = 0.02^2 at a - 0.02 and a + 0.02: within the first step or the last one, with |g|
 * falling towards either end of the run, alone or as the only step. */
static void test_pairs_at_the_ends(void)
{
    static const struct {
        const char *text;
        double T, first;
    } cases[] = {{OSCILLATOR("(t - 0.03)^2 - 0.0004"), 1.0, 0.01},
                 {OSCILLATOR("(t - 0.07)^2 - 0.0004"), 1.0, 0.05},
                 {OSCILLATOR("(t - 0.93)^2 - 0.0004"), 1.0, 0.91},
                 {OSCILLATOR("(t - 0.97)^2 - 0.0004"), 1.0, 0.95},
                 {OSCILLATOR("(t - 0.03)^2 - 0.0004"), 0.1, 0.01},
                 {OSCILLATOR("0.0004 - (t - 0.05)^2"), 0.1, 0.03},
                 {OSCILLATOR("(t - 0.07)^2 - 0.0004"), 0.1, 0.05},
                 {OSCILLATOR("(t - 0.07)^2 - 0.0004"), 0.2, 0.05},
                 {OSCILLATOR("(t - 0.13)^2 - 0.0004"), 0.2, 0.11}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        dal_crossings found;
        const record r = crossings_of(cases[k].text, "gauss12", 0.1, cases[k].T, 0, &found);
        CU_ASSERT_EQUAL(found.touches, 0);
        CU_ASSERT_EQUAL_FATAL(r.count, 2);
        CU_ASSERT_DOUBLE_EQUAL(r.t[0], cases[k].first, 1e-14);
        CU_ASSERT_DOUBLE_EQUAL(r.t[1], cases[k].first + 0.04, 1e-14);
        CU_ASSERT_EQUAL(r.direction[0], -r.direction[1]);
    }
}

/* A start on the surface is no crossing, but t = 0.05 in the first step is one; sqrt(t) leaves the
 * surface without a rate. */
static void test_from_the_surface(void)
{
    dal_crossings found;
    record r = crossings_of(OSCILLATOR("t*(t - 0.05)"), "gauss12", 0.1, 1.0, 0, &found);
    CU_ASSERT(r.count == 1 && found.up == 1 && found.down == 0 && found.touches == 0);
    CU_ASSERT_DOUBLE_EQUAL(r.t[0], 0.05, 1e-15);
    r = crossings_of(OSCILLATOR("t*(0.05 - t)"), "gauss12", 0.1, 0.1, 0, &found);
    CU_ASSERT(r.count == 1 && found.up == 0 && found.down == 1 && found.touches == 0);
    r = crossings_of(OSCILLATOR("sqrt(t)"), "gauss12", 0.1, 1.0, 0, &found);
    CU_ASSERT(r.count == 0 && found.touches == 0);
}

/* 1 + sqrt(t) > 0 has no rate at t = 0, the start. */
static void test_no_rate_at_an_end(void)
{
    dal_crossings found;
    const record r = crossings_of(OSCILLATOR("1 + sqrt(t)"), "gauss12", 0.1, 1.0, 0, &found);
    CU_ASSERT_EQUAL(r.count, 0);
}

/* g = +-((t - c)^2 - d^2), which rk4 follows exactly, with its minimum at c in a step of 0.25
 * beside t = 1, the step where |g| is least: after it or before it, so that both crossings c -+ d
 * lie in the step after t = 1, or in the one before. */
static void test_pairs_on_either_side(void)
{
    static const double place[] = {0.95, 0.9, 1.05, 1.1};
    for (int i = 0; i < 8; i++) {
        const double c = place[i % 4], d = 0.04, up = i < 4 ? -1.0 : 1.0;
        char text[256];
        dal_crossings found;
        snprintf(text, sizeof text,
                 "coordinates: [x]\naccelerations: {x: 2}\nstart: {x: %.17g, x': %.17g}\n"
                 "invariants: {g: %g*x}\n",
                 c * c - d * d, -2.0 * c, up);
        const record r = crossings_of(text, "rk4", 0.25, 3.0, 0, &found);
        CU_ASSERT_EQUAL_FATAL(r.count, 2);
        CU_ASSERT(found.up == 1 && found.down == 1 && found.touches == 0);
        CU_ASSERT_DOUBLE_EQUAL(r.t[0], c - d, 1e-14);
        CU_ASSERT_DOUBLE_EQUAL(r.t[1], c + d, 1e-14);
        CU_ASSERT(r.direction[0] == -up && r.direction[1] == up);
        CU_ASSERT(r.number[0] == 1 && r.number[1] == 2);
    }
}

/* x = 1 is reached but not crossed, at 2 pi k. */
static void test_touches(void)
{
    dal_crossings found;
    record r = crossings_of(OSCILLATOR("x - 1"), "gauss12", 0.1, 20.0, 0, &found);
    CU_ASSERT(r.count == 0 && found.down == 0 && found.up == 0);
    CU_ASSERT_EQUAL(found.touches, 3);
    r = crossings_of(OSCILLATOR("1 - x"), "gauss12", 0.1, 20.0, 0, &found);
    CU_ASSERT(r.count == 0 && found.touches == 3);
    /* A minimum that stays away from 0 is nothing. */
    r = crossings_of(OSCILLATOR("x - 1.001"), "gauss12", 0.1, 20.0, 0, &found);
    CU_ASSERT(r.count == 0 && found.touches == 0);
}

/* g = (t - 1.05)^2 + s, 1.1025 at the start: a minimum s of |g| below 1e-12 of that touches 0, on
 * either side of it; one farther off is nothing above 0, and a pair of crossings below. */
static void test_touches_within(void)
{
    static const struct {
        double s;
        int touches, crossings;
    } cases[] = {{0.9e-12, 1, 0}, {1.3e-12, 0, 0}, {-0.9e-12, 1, 0}, {-1.3e-12, 0, 2}};
    for (int i = 0; i < 8; i++) {
        char text[256];
        dal_crossings found;
        snprintf(text, sizeof text,
                 "coordinates: [x]\naccelerations: {x: 2}\nparameters: {s: %.17g}\n"
                 "start: {x: 1.05^2 + s, x': -2.1}\ninvariants: {g: %sx}\n",
                 cases[i % 4].s, i < 4 ? "" : "-");
        const record r = crossings_of(text, "rk4", 0.25, 2.0, 0, &found);
        CU_ASSERT_EQUAL(found.touches, cases[i % 4].touches);
        CU_ASSERT_EQUAL(r.count, cases[i % 4].crossings);
    }
}

/* T is a whole number of steps to 1e-9 of itself. */
static void test_whole_steps(void)
{
    static const double off[] = {0.9e-9, -0.9e-9, 1.1e-9, -1.1e-9};
    const dal_run_spec spec =
        fixture_spec(fixture_system(OSCILLATOR("x")), "rk4", DAL_PHYSICAL, 0.25);
    for (int i = 0; i < 4; i++) {
        dal_run *run = fixture_run(&spec);
        dal_crossings found;
        record r = {0};
        CU_ASSERT_EQUAL(cross(run, 2.0 * (1.0 + off[i]), 0, &r, &found, NULL),
                        i < 2 ? DAL_STATUS_OK : DAL_STATUS_ARGUMENT);
        CU_ASSERT_EQUAL(dal_run_steps(run), i < 2 ? 8 : 0);
        dal_run_free(run);
    }
}

/* g = 0 exactly at a step: (t - 1)^2 touches there, t - 1 crosses there, once. */
static void test_on_a_step(void)
{
    dal_crossings found;
    record r = crossings_of("coordinates: [x]\naccelerations: {x: 2}\n"
                            "start: {x: 1, x': -2}\ninvariants: {g: x}\n",
                            "rk4", 0.25, 2.0, 0, &found);
    CU_ASSERT(r.count == 0 && found.touches == 1);
    r = crossings_of("coordinates: [x]\naccelerations: {x: 0}\n"
                     "start: {x: -1, x': 1}\ninvariants: {g: x}\n",
                     "rk4", 0.25, 2.0, 0, &found);
    CU_ASSERT_EQUAL_FATAL(r.count, 1);
    CU_ASSERT(r.t[0] == 1.0 && r.direction[0] == 1 && found.touches == 0);
    /* A start on the section is no crossing. */
    r = crossings_of("coordinates: [x]\naccelerations: {x: 0}\n"
                     "start: {x': 1}\ninvariants: {g: x}\n",
                     "rk4", 0.25, 2.0, 0, &found);
    CU_ASSERT(r.count == 0 && found.up == 0);
}

/* x^2 + x'^2 = 1 up to rounding, which crosses nothing. */
static void test_of_rounding(void)
{
    dal_crossings found;
    const record r = crossings_of(OSCILLATOR("x^2 + x'^2 - 1"), "gauss12", 0.1, 20.0, 0, &found);
    CU_ASSERT(r.count == 0 && found.touches == 0 && found.unresolved == 0);
}

/* ---- every method, either space ---- */

static void cross_with(const char *model, const char *method, dal_space space)
{
    dal_run_spec spec = fixture_spec(fixture_system(model), method, space, 0.05);
    if (!fixture_accepts(&spec.method, spec.system, space)) return;
    dal_run *run = fixture_run(&spec), *plain = fixture_run(&spec);
    dal_crossings found;
    dal_error error = {0};
    record r = {0};
    size_t count;
    const dal_status status = cross(run, 9.0, 0, &r, &found, &error);
    if (status != DAL_STATUS_OK) printf("\n  %s: %s\n", method, error.message);
    CU_ASSERT_EQUAL(status, DAL_STATUS_OK);
    CU_ASSERT_EQUAL(r.count, 3);
    for (int k = 0; k < r.count; k++) {
        CU_ASSERT_DOUBLE_EQUAL(r.g[k], 0.0, 1e-15);
        CU_ASSERT_DOUBLE_EQUAL(r.t[k], (k + 1) * pi - atan(6.0 / 7.0), 0.05);
    }
    CU_ASSERT_EQUAL(dal_run_advance(plain, 180, NULL), DAL_STATUS_OK);
    const double *a = dal_run_save(run, &count), *b = dal_run_save(plain, &count);
    CU_ASSERT_EQUAL(memcmp(a, b, count * sizeof *a), 0);
    dal_run_free(run);
    dal_run_free(plain);
}

/* y = 0.6 cos t + 0.7 sin t, whatever D does to x and z.  The trajectory is the same as without
 * sections, and the crossings lie on it to rounding. */
static void test_methods(void)
{
    char name[128];
    const char *const model = "coordinates: [x, y, z]\n"
                              "lagrangian: (x'^2 + y'^2 + z'^2)/2 - (x^2 + y^2 + z^2)/2\n"
                              "constraints: [x' + y*z']\n"
                              "start: {x: 0.8, y: 0.6, z: -0.5, x': -0.24, y': 0.7, z': 0.4}\n"
                              "invariants: {g: y}\n";
    for (int i = 0; dal_integrator_at(i) != NULL; i++) {
        cross_with(model, fixture_method(i, name, sizeof name), DAL_PHYSICAL);
        cross_with(model, fixture_method(i, name, sizeof name), DAL_LIFTED);
    }
}

/* ---- what is refused, and ends ---- */

static void test_refuses(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system(OSCILLATOR("log(0.5 - t)")), "rk4", DAL_PHYSICAL, 0.1);
    dal_run *run = fixture_run(&spec);
    dal_crossings found;
    dal_error error;
    record r = {0};
    CU_ASSERT_EQUAL(cross(run, 0.95, 0, &r, &found, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT(strstr(error.message, "whole number of steps") != NULL);
    CU_ASSERT_EQUAL(cross(run, 0.0, 0, &r, &found, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(cross(run, 1.0, 0, &r, &found, &error), DAL_STATUS_NOT_FINITE);
    CU_ASSERT(strstr(error.message, "no value at t = 0.5") != NULL);
    const dal_poincare wrong = {.callback = spec.system->invariant_values, .count = 1, .index = 1};
    CU_ASSERT_EQUAL(dal_run_crossings(run, 1.0, &wrong, &found, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT(strstr(error.message, "value 2 of 1") != NULL);
    dal_run_free(run);
}

static void test_stops(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system(OSCILLATOR("x")), "rk4", DAL_PHYSICAL, 0.01);
    dal_run *run = fixture_run(&spec);
    dal_crossings found;
    record r = {.stop_after = 2};
    CU_ASSERT_EQUAL(cross(run, 40.0, 0, &r, &found, NULL), DAL_STATUS_INTERRUPTED);
    CU_ASSERT_EQUAL(r.count, 2);
    dal_run_free(run);
    run = fixture_run(&spec);
    r = (record){0};
    CU_ASSERT_EQUAL(cross(run, 40.0, 0, &r, &found, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(r.polls, 4);
    dal_run_free(run);
}

static void test_out_of_memory(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system(OSCILLATOR("x - 0.999")), "rk4", DAL_PHYSICAL, 0.1);
    allocation_trial trial = {0};
    while (allocation_next(&trial)) {
        dal_run *run = fixture_run(&spec);
        dal_crossings found;
        record r = {0};
        allocation_start(&trial);
        allocation_end(&trial, cross(run, 7.0, 0, &r, &found, NULL));
        dal_run_free(run);
    }
    CU_ASSERT(trial.failures >= 4);
}

/* The rate of a callback that fails has the status of the callback; likewise where F fails. */
static dal_status fail(const dal_system *system, const dal_point *at, double *out)
{
    (void)system, (void)at, (void)out;
    return DAL_STATUS_IO;
}

static void test_rates(void)
{
    const dal_system systems[] = {{.name = "hand", .n = 1, .call.field = fixture_oscillate},
                                  {.name = "failing", .n = 1, .call.field = fail}};
    const double q[] = {1.0}, v[] = {0.5};
    const dal_point at = {.q = q, .v = v};
    for (int i = 0; i < 3; i++) {
        dal_evaluator *evaluator = fixture_evaluator(&systems[i == 1]);
        const dal__rate of = {.evaluator = evaluator,
                              .callback = i == 0 ? fail : fixture_oscillate,
                              .count = 1,
                              .time = 1.0};
        double rate = NAN;
        CU_ASSERT_EQUAL(dal__rate_in_units(&of, &at, &rate),
                        i == 2 ? DAL_STATUS_OK : DAL_STATUS_IO);
        if (i == 2) CU_ASSERT_DOUBLE_EQUAL(rate, -0.5, 1e-9); /* of -x */
        dal_evaluator_free(evaluator);
    }
}

void suite_section(void)
{
    CU_pSuite suite = CU_add_suite("Poincare sections", NULL, NULL);
    CU_add_test(suite, "an intermediate step", test_intermediate);
    CU_add_test(suite, "times of crossings", test_times);
    CU_add_test(suite, "directions", test_directions);
    CU_add_test(suite, "a section in time", test_in_time);
    CU_add_test(suite, "pairs within a step", test_pairs_in_a_step);
    CU_add_test(suite, "within a step of many substeps", test_within_substeps);
    CU_add_test(suite, "pairs in the first and the last step", test_pairs_at_the_ends);
    CU_add_test(suite, "from the surface", test_from_the_surface);
    CU_add_test(suite, "no rate at an end", test_no_rate_at_an_end);
    CU_add_test(suite, "pairs in the step before or after", test_pairs_on_either_side);
    CU_add_test(suite, "touches", test_touches);
    CU_add_test(suite, "touches within 1e-12", test_touches_within);
    CU_add_test(suite, "whole steps", test_whole_steps);
    CU_add_test(suite, "g = 0 at a step", test_on_a_step);
    CU_add_test(suite, "of rounding alone", test_of_rounding);
    CU_add_test(suite, "every method", test_methods);
    CU_add_test(suite, "what is refused", test_refuses);
    CU_add_test(suite, "ends when interrupted", test_stops);
    CU_add_test(suite, "out of memory", test_out_of_memory);
    CU_add_test(suite, "rates of callbacks that fail", test_rates);
}
