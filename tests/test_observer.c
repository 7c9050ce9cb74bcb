/* test_observer.c - an observer that is called every K steps, and rows at times of its own. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <math.h>

typedef struct samples {
    long long count, every;
    double last, shown[4];
} samples;

static const double times[4] = {0.0, 0.25, 7.0, 10.0};

static dal_status look(void *user, dal_run *run)
{
    samples *l = user;
    CU_ASSERT_EQUAL(dal_run_steps(run), l->count * l->every);
    l->count++;
    l->last = dal_run_time(run);
    return DAL_STATUS_OK;
}

static dal_status show(void *user, dal_run *run, long long row, double t)
{
    samples *l = user;
    CU_ASSERT_DOUBLE_EQUAL(dal_run_time(run), t, 1e-12);
    l->shown[row] = t;
    return DAL_STATUS_OK;
}

static double given(void *user, long long row)
{
    (void)user;
    return times[row];
}

/* 100 steps of 0.1; rows on, between and at the end of steps do not disturb the observer. */
static void test_calls(void)
{
    const dal_system *system = fixture_system("chaplygin-sleigh");
    const dal_run_spec spec = fixture_spec(system, "rk4", DAL_PHYSICAL, 0.1);
    for (int every = 1; every <= 7; every += 3) {
        samples l = {.every = every};
        const dal_observer observer = {
            .user = &l, .sample = show, .step = look, .every = every, .row_time = given};
        dal_run *run = fixture_run(&spec);
        CU_ASSERT_EQUAL(dal_run_sample(run, 10.0, 3, 0, &observer, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(l.count, 1 + 100 / every);
        CU_ASSERT_DOUBLE_EQUAL(l.last, 0.1 * (100 - 100 % every), 1e-12);
        for (int i = 0; i < 4; i++) CU_ASSERT_EQUAL(l.shown[i], times[i]);
        CU_ASSERT_EQUAL(dal_run_steps(run), 100);
        dal_run_free(run);
    }
}

/* ---- callbacks that refuse ---- */

typedef struct calls {
    long made, refused; /* the call that is refused, from 1; 0: none */
    long of[7];         /* of each callback */
} calls;
enum { SAMPLE, POLL, STEP, VALUES, STATES, SCALES, EVENT };

static dal_status call(void *user, int callback)
{
    calls *c = user;
    c->of[callback]++;
    return ++c->made == c->refused ? DAL_STATUS_IO : DAL_STATUS_OK;
}
static dal_status on_sample(void *user, dal_run *run, long long row, double t)
{
    (void)run, (void)row, (void)t;
    return call(user, SAMPLE);
}
static dal_status on_poll(void *user, dal_run *run)
{
    (void)run;
    return call(user, POLL);
}
static dal_status on_step(void *user, dal_run *run)
{
    (void)run;
    return call(user, STEP);
}
static dal_status on_values(void *user, dal_run *run, int count, const double *t,
                            const double *values, size_t stride)
{
    (void)run, (void)count, (void)t, (void)values, (void)stride;
    return call(user, VALUES);
}
static dal_status on_states(void *user, dal_run *run, int count, const double *t,
                            const double *states, size_t stride)
{
    (void)run, (void)count, (void)t, (void)states, (void)stride;
    return call(user, STATES);
}
static dal_status on_scales(void *user, dal_run *run, const double *scales)
{
    (void)run, (void)scales;
    return call(user, SCALES);
}
static dal_status on_event(void *user, dal_run *run, const dal_occurrence *event)
{
    (void)run, (void)event;
    return call(user, EVENT);
}

static dal_status sampled(const dal_run_spec *spec, bool by_values, long long every, calls *c,
                          dal_error *error)
{
    const dal_observer observer = {.user = c,
                                   .sample = on_sample,
                                   .poll = on_poll,
                                   .step = by_values ? NULL : on_step,
                                   .values = by_values ? on_values : NULL,
                                   .states = by_values ? on_states : NULL,
                                   .scales = by_values ? on_scales : NULL,
                                   .event = on_event,
                                   .every = every,
                                   .polling = 4};
    dal_run *run = fixture_run(spec);
    const dal_status status = dal_run_sample(run, 5.0, 7, 0, &observer, error);
    dal_run_free(run);
    return status;
}

/* Whichever call of whichever callback refuses, its status ends the sampling, and none follows. */
static void test_refusals(void)
{
    static const char *const texts[] = {"coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - y\n"
                                        "start: {y: 1}\n"
                                        "events: [{when: y, direction: down, restitution: 0.9}]\n",
                                        "chaplygin-sleigh"};
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 4; k++) {
            const bool by_values = k % 2;
            const long long every = k / 2 ? 3 : 1;
            const dal_run_spec spec =
                fixture_spec(fixture_system(texts[i]), "rk4", DAL_PHYSICAL, 0.1);
            calls all = {0};
            CU_ASSERT_EQUAL(sampled(&spec, by_values, every, &all, NULL), DAL_STATUS_OK);
            CU_ASSERT(all.of[SAMPLE] == 8 && all.of[POLL] > 0);
            if (i == 1) CU_ASSERT_EQUAL(all.of[STEP], by_values ? 0 : 1 + 50 / every);
            CU_ASSERT(!by_values == !all.of[VALUES] && !by_values == !all.of[SCALES]);
            CU_ASSERT_EQUAL(all.of[STATES], all.of[VALUES]);
            CU_ASSERT_EQUAL(all.of[EVENT] > 0, i == 0);
            for (long refused = 1; refused <= all.made; refused++) {
                calls c = {.refused = refused};
                CU_ASSERT_EQUAL(sampled(&spec, by_values, every, &c, NULL), DAL_STATUS_IO);
                CU_ASSERT_EQUAL(c.made, refused);
            }
        }
}

/* ---- names ---- */

/* Invariants of a system written in C may lack names. */
/* Steps that nobody observes fail, too. */
static void test_failure(void)
{
    const char *const text = "coordinates: [x]\naccelerations: {x: sqrt(3.05 - t)}\n";
    const dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.1);
    calls all = {0};
    CU_ASSERT_EQUAL(sampled(&spec, false, 0, &all, NULL), DAL_STATUS_NOT_FINITE);
}

static void test_names(void)
{
    static const char text[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                               "constraints: [y' - x']\ninvariants: {p: x', q: y'}\n";
    for (int k = 0; k < 2; k++) {
        dal_system system = *fixture_system(text);
        if (k == 0) system.invariant = NULL;
        const char *const names[] = {
            "D1", "E", "H", "|p|", "|pi|", "|pi_e|", k ? "p" : "invariant", k ? "q" : "invariant"};
        const dal_run_spec spec = fixture_spec(&system, "gauss4", DAL_LIFTED, 0.1);
        dal_run *run = fixture_run(&spec);
        char name[32];
        for (int i = 0; i < 8; i++)
            CU_ASSERT_STRING_EQUAL(dal_run_observable_name(run, i, name, sizeof name), names[i]);
        dal_run_free(run);
    }
}

void suite_observer(void)
{
    CU_pSuite suite = CU_add_suite("observer", NULL, NULL);
    CU_add_test(suite, "at steps, and rows at given times", test_calls);
    CU_add_test(suite, "callbacks that refuse", test_refusals);
    CU_add_test(suite, "a step that fails", test_failure);
    CU_add_test(suite, "names of observables", test_names);
}
