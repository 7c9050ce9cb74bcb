/* test_checkpoints.c - the state that a run saves and restores, and memory of the caller. */
#include "fixtures.h"
#include "quick.h"
#include "run/events.h"
#include "run/run.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void test_checkpoint(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system(fixture_full), "gauss8", DAL_LIFTED, 0.02);
    dal_run *whole = fixture_run(&spec), *first = fixture_run(&spec), *second = fixture_run(&spec);
    size_t count;
    CU_ASSERT_EQUAL(dal_run_advance(whole, 80, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(first, 37, NULL), DAL_STATUS_OK);
    const double *memory = dal_run_save(first, &count);
    CU_ASSERT_EQUAL(dal_run_restore(second, memory, count, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(second, 43, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(
        memcmp(dal_run_save(whole, &count), dal_run_save(second, &count), count * sizeof(double)),
        0);
    CU_ASSERT_EQUAL(dal_run_restore(second, memory, count - 1, NULL), DAL_STATUS_ARGUMENT);
    dal_run_free(whole);
    dal_run_free(first);
    dal_run_free(second);
}

static void test_own_memory(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system("vertical-disk"), "gauss4+project", DAL_LIFTED, 0.1);
    const size_t bytes = dal_run_size(&spec);
    CU_ASSERT_FATAL(bytes > 0);
    char *memory = malloc(bytes + 7);
    dal_run *run = NULL, *other = fixture_run(&spec);
    dal_error error;
    CU_ASSERT_EQUAL(dal_run_init(&run, memory + 7, bytes - 1, &spec, &error), DAL_STATUS_MEMORY);
    CU_ASSERT_EQUAL_FATAL(dal_run_init(&run, memory + 7, bytes, &spec, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(run, 20, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(other, 20, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(memcmp(dal_run_state(run), dal_run_state(other),
                           sizeof(double) * (size_t)dal_run_dimension(run)),
                    0);
    dal_run_free(run); /* frees nothing */
    dal_run_free(other);
    free(memory);
}

/* ---- numbers that no run has ---- */

/* A ball above a floor; a clock that stops the run. */
static const char ball[] = "coordinates: [y]\nparameters: {g: 9.81, c: 0.8}\n"
                           "lagrangian: y'^2/2 - g*y\nstart: {y: 1}\nevents:\n"
                           "  - {when: y, direction: down, restitution: c}\n"
                           "  - {when: t - 9, stop: true}\n";

static dal_run_spec spec_of(const char *system, const char *method, dal_space space,
                            double tolerance)
{
    dal_run_spec spec = fixture_spec(fixture_system(system), method, space, 0.05);
    spec.options.tolerance = tolerance;
    return spec;
}

/* A run of ball after its first impact, at t = 0.45. */
static dal_run *bounced(dal_space space)
{
    const dal_run_spec spec = spec_of(ball, "gauss4", space, 0.0);
    return fixture_stepped(&spec, 11);
}

static double *saved_copy(const dal_run *run, size_t *count)
{
    const double *saved = dal_run_save(run, count);
    double *copy = malloc(*count * sizeof *copy);
    CU_ASSERT_PTR_NOT_NULL_FATAL(copy);
    return memcpy(copy, saved, *count * sizeof *copy);
}

/* Numbers of a checkpoint, from the first after y and r, or from the first that events have. */
typedef struct impossible {
    bool is_of_events;
    size_t at;
    double x;
    const char *name;
} impossible;

/* The persistent state of the ball in the physical space: y, y', r[2], the clock, the state of the
 * method; of its events: side[2], count[2], stopped, stalled, jump[1]. */
static void test_impossible(void)
{
    static const impossible list[] = {
        {false, 2, 1.5, "number of steps"},
        {false, 2, -1.0, "number of steps"},
        {false, 2, 0x1p60, "number of steps"},
        {false, 3, -8.0, "number of evaluations"},
        {false, 4, 2.0, "uses_newton"},
        {false, 6, 0.5, "has_multiplier"},
        {false, 7, -0.1, "size of a substep"},
        {true, 0, 3.0, "side of an event"},
        {true, 1, 0.5, "side of an event"},
        {true, 2, 0.5, "times that an event happened"},
        {true, 3, -1.0, "times that an event happened"},
        {true, 3, 1e300, "times that an event happened"},
        {true, 4, 1.0, "stopped the run"}, /* it stops no run */
        {true, 4, 2.0, "stopped the run"}, /* it has not happened */
        {true, 4, 3.0, "stopped the run"}, /* there is none */
        {true, 4, -1.0, "stopped the run"},
        {true, 4, 1e18, "stopped the run"},
        {true, 5, 1e9, "events at one time"},
        {true, 5, -1.0, "events at one time"},
    };
    dal_run *run = bounced(DAL_PHYSICAL);
    const dal__layout *k = &run->layout;
    size_t count;
    double *good = saved_copy(run, &count), *bad = saved_copy(run, &count);
    CU_ASSERT_EQUAL(dal_run_event_count(run, 0), 1);
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        dal_error error = {0};
        const size_t first = list[i].is_of_events ? dal__at_events(k) : dal__at(k, DAL__TIME);
        memcpy(bad, good, count * sizeof *bad);
        bad[first + list[i].at] = list[i].x;
        CU_ASSERT_EQUAL(dal_run_restore(run, bad, count, &error), DAL_STATUS_ARGUMENT);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.message, list[i].name));
        CU_ASSERT_EQUAL(memcmp(dal_run_save(run, &count), good, count * sizeof *good), 0);
    }
    dal_run_free(run);
    free(good);
    free(bad);
}

static void refuse(dal_run *run, size_t at, double x, const char *name)
{
    size_t count;
    dal_error error = {0};
    double *bad = saved_copy(run, &count);
    bad[at] = x;
    CU_ASSERT_EQUAL(dal_run_restore(run, bad, count, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, name));
    free(bad);
}

/* A number of a run that is neither 0 nor 1, at a place after the clock. */
static void refuse_half(dal_run *run, size_t place, const char *name)
{
    refuse(run, dal__at(&run->layout, DAL__TIME) + DAL__CLOCK_SIZE + place, 0.5, name);
}

/* What few methods and systems have: accelerations, and pivots that are compared. */
static void test_impossible_flags(void)
{
    const dal_run_spec gni = spec_of("chaplygin-sleigh", "gni", DAL_PHYSICAL, 0.0),
                       full = spec_of(fixture_full, "gauss4", DAL_PHYSICAL, 0.0);
    dal_run *run = fixture_stepped(&gni, 2);
    const dal__layout *k = &run->layout;
    const size_t multipliers = 3 + (size_t)DAL__COUNT_MULTIPLIER(k);
    CU_ASSERT(k->acceleration > 0);
    refuse_half(run, multipliers, "whether an acceleration is known");
    refuse_half(run, multipliers + (size_t)k->acceleration + 2, "whether that is known");
    dal_run_free(run);
    run = fixture_stepped(&full, 2);
    k = &run->layout;
    CU_ASSERT(k->pivots > 0);
    refuse_half(run, 6 + (size_t)DAL__COUNT_MULTIPLIER(k) + (size_t)k->acceleration,
                "whether pivots are unsteady");
    CU_ASSERT(DAL__COUNT_THREE(k) > 0);
    for (size_t i = 1; i <= (size_t)DAL__COUNT_THREE(k); i++)
        refuse(run, dal__at_changed(k) - i, -1.0, "a count of the choice of a solver");
    refuse(run, dal__at_changed(k), 0.5, "whether a parameter was changed");
    dal_run_free(run);
}

/* A run that an event has stopped is one that there may be. */
static void test_stopped(void)
{
    const dal_run_spec spec = spec_of(ball, "rk4", DAL_PHYSICAL, 0.0);
    dal_run *run = fixture_run(&spec), *other = fixture_run(&spec);
    size_t count;
    CU_ASSERT_EQUAL(dal_run_set_parameter(run, "c", 1.0, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(run, 1000, NULL), DAL_STATUS_STOPPED);
    const double *saved = dal_run_save(run, &count);
    CU_ASSERT_EQUAL(dal_run_restore(other, saved, count, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_stopped(other), 2);
    CU_ASSERT_EQUAL(dal_run_event_count(other, 1), 1);
    dal_run_free(run);
    dal_run_free(other);
}

/* Only what events change has a jump, and only after one. */
static void test_impossible_jumps(void)
{
    dal_run *run = bounced(DAL_LIFTED);
    size_t count;
    double *bad = saved_copy(run, &count);
    const size_t jumps = dal__at_events(&run->layout) + 6;
    dal_error error = {0};
    CU_ASSERT(bad[jumps] < 0.0); /* of E */
    bad[jumps] = 0.25;
    CU_ASSERT_EQUAL(dal_run_restore(run, bad, count, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_event_jump(run, 0), 0.25);
    bad[jumps + 1] = 0.25; /* of H */
    CU_ASSERT_EQUAL(dal_run_restore(run, bad, count, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "jump of an observable"));
    bad[jumps + 1] = 0.0;
    bad[jumps - 4] = 0.0; /* no event has happened */
    CU_ASSERT_EQUAL(dal_run_restore(run, bad, count, NULL), DAL_STATUS_ARGUMENT);
    bad[jumps] = 0.0;
    CU_ASSERT_EQUAL(dal_run_restore(run, bad, count, NULL), DAL_STATUS_OK);
    dal_run_free(run);
    free(bad);
}

/* A run takes what it can from a changed checkpoint, whatever its steps then return; one that it
 * refuses leaves it as it was. */
static void restore_changed(dal_run *run, const double *bad, const double *good, size_t count)
{
    dal_error error = {0};
    const dal_status status = dal_run_restore(run, bad, count, &error);
    if (status != DAL_STATUS_OK) {
        CU_ASSERT(error.message[0] != '\0');
        CU_ASSERT_EQUAL(memcmp(dal_run_save(run, &count), good, count * sizeof *good), 0);
        return;
    }
    for (int i = 0; i < 2; i++) dal_run_step(run, NULL);
    CU_ASSERT(dal_run_steps(run) >= 0 && dal_run_evaluations(run) >= 0);
    CU_ASSERT(dal_run_stopped(run) >= 0 && dal_run_stopped(run) <= 2);
    CU_ASSERT(dal_run_event_count(run, 0) >= -1 && dal_run_event_jump(run, -1) == 0.0);
    CU_ASSERT_EQUAL(dal_run_restore(run, good, count, NULL), DAL_STATUS_OK);
}

/* Every word of a checkpoint takes values that doubles may have, and every byte is changed; in a
 * quick run each in a third of the ways. */
static void change_everything(const dal_run_spec *spec, long long steps)
{
    static const double values[] = {NAN, INFINITY, -1.0,   0.0,     0.5,    1.0,      2.0,
                                    3.0, 1e18,     0x1p54, -1e-300, 1e-300, -1.7e308, 1.7e308};
    enum { VALUES = sizeof values / sizeof *values };
    dal_run *run = fixture_stepped(spec, steps);
    size_t count;
    double *good = saved_copy(run, &count), *bad = saved_copy(run, &count);
    for (size_t i = 0; i < count; i++) {
        for (int k = (int)i % case_stride(3); k < VALUES; k += case_stride(3)) {
            bad[i] = values[k];
            restore_changed(run, bad, good, count);
        }
        for (size_t byte = 0; byte < sizeof *bad; byte++)
            for (int k = (int)byte % case_stride(3); k < 3; k += case_stride(3)) {
                memcpy(bad, good, count * sizeof *bad);
                ((unsigned char *)(bad + i))[byte] ^= (unsigned char[]){0xff, 0x80, 0x01}[k];
                restore_changed(run, bad, good, count);
            }
        bad[i] = good[i];
    }
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
    dal_run *other = fixture_stepped(spec, steps + 1);
    CU_ASSERT_EQUAL(
        memcmp(dal_run_save(run, &count), dal_run_save(other, &count), count * sizeof *good), 0);
    dal_run_free(run);
    dal_run_free(other);
    free(good);
    free(bad);
}

static void test_changed(void)
{
    dal_run_spec specs[] = {
        spec_of(ball, "gauss4", DAL_LIFTED, 0.0),
        spec_of(ball, "dop853", DAL_PHYSICAL, 1e-9),
        spec_of("chaplygin-sleigh", "gauss6+project", DAL_LIFTED, 0.0),
        spec_of("vertical-disk", "rk4+project-energy", DAL_PHYSICAL, 0.0),
        spec_of("chaplygin-sleigh", "taylor", DAL_PHYSICAL, 1e-12),
        spec_of(ball, "gauss4", DAL_PHYSICAL, 0.0),
    };
    enum { COUNT = sizeof specs / sizeof *specs };
    specs[COUNT - 1].options.precision = DAL_QUAD;
    for (int i = 0; i < COUNT; i++) change_everything(&specs[i], 11);
}

void suite_checkpoints(void)
{
    CU_pSuite suite = CU_add_suite("checkpoints", NULL, NULL);
    CU_add_test(suite, "checkpoint", test_checkpoint);
    CU_add_test(suite, "the caller's memory", test_own_memory);
    CU_add_test(suite, "impossible numbers", test_impossible);
    CU_add_test(suite, "impossible flags", test_impossible_flags);
    CU_add_test(suite, "impossible jumps", test_impossible_jumps);
    CU_add_test(suite, "a run that was stopped", test_stopped);
    CU_add_test(suite, "every number and byte changed", test_changed);
}
