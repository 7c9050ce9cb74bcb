/* test_callbacks_events.c - callbacks of events that fail, and callbacks of the motion between
 * events (trial.h). */
#include "fixtures.h"
#include "trial.h"
#include <CUnit/CUnit.h>
#include <math.h>

static dal_status keep_event(void *user, dal_run *run, const dal_occurrence *event)
{
    trial_add(user, &event->t, 1);
    trial_add_run(user, run);
    return DAL_STATUS_OK;
}
static dal_status pass_events(trial *t)
{
    dal_run *run = NULL;
    dal_status status = dal_run_create(&run, &t->spec, &t->error);
    if (status == DAL_STATUS_OK)
        status = fixture_events(run, 30.0 * t->spec.options.step, keep_event, t, &t->error);
    const long long unresolved = run ? dal_run_unresolved(run, NULL) : 0;
    trial_add_number(t, (double)unresolved);
    if (status == DAL_STATUS_OK) trial_add_run(t, run);
    dal_run_free(run);
    return status;
}

static dal_status keep_row(void *user, dal_run *run, long long row, double t)
{
    (void)row;
    trial_add_number(user, t);
    trial_add_run(user, run);
    return DAL_STATUS_OK;
}

/* Rows within a step that cannot be searched, one of them beyond an event. */
static dal_status sample_past_events(trial *t)
{
    dal_run *run = NULL;
    dal_status status = dal_run_create(&run, &t->spec, &t->error);
    const dal_observer observer = {.user = t, .sample = keep_row};
    if (status == DAL_STATUS_OK) status = dal_run_sample(run, 0.4, 20, 1, &observer, &t->error);
    dal_run_free(run);
    return status;
}

/* Without rows, between which an event may be. */
static dal_status advance_past_events(trial *t)
{
    dal_run *run = NULL;
    dal_status status = dal_run_create(&run, &t->spec, &t->error);
    if (status == DAL_STATUS_OK) status = dal_run_advance(run, 8, &t->error);
    if (status == DAL_STATUS_OK) trial_add_run(t, run);
    const long long count = run ? dal_run_event_count(run, 0) : 0;
    trial_add_number(t, (double)count);
    for (int i = 0; run && i < dal_run_observables(run); i++)
        trial_add_number(t, dal_run_event_jump(run, i));
    dal_run_free(run);
    return status;
}

/* ---- the suite ---- */

static const char ball[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - y\n"
                           "start: {y: 1}\n"
                           "events:\n  - {when: y, direction: down, restitution: 0.5}\n"
                           "  - {when: y - 0.2, direction: up, set: {x: x + 1}}\n";
/* The force on x jumps at x = 0, and the one on y has a corner at x = 0.5. */
static const char jump[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                           "forces: {x: -sign(x), y: abs(x - 0.5)}\n"
                           "start: {x: 1}\nevents: [{when: x}, {when: x - 0.5}]\n";

/* The event does not happen: its rate is too large for one; F jumps; it turns
 * before 0. */
#define PASSING(when)                                                                              \
    "coordinates: [x]\nlagrangian: x'^2/2\nstart: {x': 1}\nevents: [{when: \"" when "\"}]\n"
static const char *const passing[] = {PASSING("cos(300*x) + 2"),
                                      PASSING("if(x < 0.33, x + 5, x + 9)"),
                                      PASSING("(x - 0.45)^2 + 0.001")};
/* Both zeros of the event are in one step: where it turns, and where it has just acted. */
static const char turning[] = PASSING("(x - 0.45)^2 - 0.0004");
static const char low[] = "coordinates: [x]\nlagrangian: x'^2/2 - x\nstart: {x: 0.001}\n"
                          "events: [{when: x, direction: down, restitution: 1}]\n";

static const char drop[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - y\n"
                           "start: {y: 0.05}\n"
                           "events:\n  - {when: y, direction: down, restitution: 0.5}\n"
                           "  - {when: y - 0.01, direction: up, set: {x: x + 1}}\n";

static void test_searches(void)
{
    static const char *const names[][2] = {
        {"event_values"}, {"event_rates"}, {"event_normals"}, {"energy"}, {"event_states"}};
    for (size_t i = 0; i < sizeof passing / sizeof *passing; i++)
        for (int k = 0; k < 3; k++)
            trial_each_call_of(names[k], passing[i], "rk4", TRIAL_FAILS, advance_past_events);
    for (int k = 0; k < 5; k++) {
        trial_each_call_of(names[k], drop, "rk4", 1e-13, advance_past_events);
        if (k < 3) trial_each_call_of(names[k], drop, "rk4", 1e-13, sample_past_events);
        if (k == 4) continue;
        trial_each_call_of(names[k], turning, "rk4", 1e-13, advance_past_events);
        trial_each_call_of(names[k], low, "rk4", 1e-13, advance_past_events);
    }
}

static void test_events(void)
{
    trial_each_call(ball, "rk4", DAL_PHYSICAL, 1e-13, pass_events);
    trial_each_call(jump, "rk4", DAL_PHYSICAL, INFINITY, pass_events);
}

static void test_memory(void) { trial_each_allocation(ball, "rk4", DAL_PHYSICAL, pass_events); }

void suite_callbacks_events(void)
{
    CU_pSuite suite = CU_add_suite("callbacks of events that fail", NULL, NULL);
    CU_add_test(suite, "events", test_events);
    CU_add_test(suite, "searches", test_searches);
    CU_add_test(suite, "out of memory", test_memory);
}
