/* test_steer_ends.c - targets that are not reached, that cannot be, and what is refused. */
#include "core/vectors.h"
#include "fixtures.h"
#include "quick.h"
#include "steer/continuation.h"
#include "steer/guess.h"
#include "steered.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <string.h>

static dal_status stop_at_third(void *user, int guess, int iteration, double residual)
{
    int *calls = user;
    CU_ASSERT(guess == 0 && iteration == *calls && residual >= 0.0);
    return (*calls)++ == 3 ? DAL_STATUS_INTERRUPTED : DAL_STATUS_OK;
}

static dal_status note_reach(void *user, const dal_steering *steering)
{
    const int *calls = user;
    CU_ASSERT_EQUAL(*calls, 0);
    CU_ASSERT_EQUAL(steering->count, 0);
    CU_ASSERT_EQUAL(steering->allowed, 5);
    return DAL_STATUS_OK;
}

/* A target that is not reached leaves the nearest motion and says so. */
static void test_unreached(void)
{
    const dal_setting target[] = {{"x", 0.0}, {"y", 1.0}, {"phi", 0.0}};
    int calls = 0;
    const dal_steer_observer observer = {&calls, note_reach, stop_at_third};
    steered s;
    steered_open(&s, steered_sleigh, DAL_EFFORT_CONSTRAINT, "gauss4", 0.04);
    s.observer = &observer;
    CU_ASSERT_EQUAL_FATAL(steered_try(&s, 2.0, target, 3), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(s.steering->count, 1);
    CU_ASSERT_EQUAL(s.steering->extremal->status, DAL_STATUS_INTERRUPTED);
    CU_ASSERT(s.steering->extremal->message[0] != '\0');
    CU_ASSERT_EQUAL(calls, 4);
    const dal_extremal *nearest = s.steering->extremal;
    const double *end = nearest->z + (s.steering->rows - 1) * s.steering->dimension;
    CU_ASSERT(nearest->residual > 1e-6 && nearest->residual < 10.0);
    CU_ASSERT(nearest->distance >= fabs(end[1] - 1.0) && nearest->distance < 10.0);
    /* y = 0 is the leaf of x dy - y dx = 0 through (1, 0): what is off it cannot be reached */
    static const char radial[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                                 "constraints: [x*y' - y*x']\nstart: {x: 1}\n";
    steered_close(&s);
    steered_open(&s, radial, DAL_EFFORT_CONSTRAINT, "gauss4", 0.05);
    s.settings.iterations = 30;
    const dal_setting side[] = {{"x", 1.0}, {"y", 0.5}};
    CU_ASSERT_EQUAL(steered_try(&s, 1.0, side, 2), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(s.steering->allowed, 2);
    CU_ASSERT_EQUAL(s.best->status, DAL_STATUS_NOT_CONVERGED);
    CU_ASSERT(strstr(s.best->message, "only 2 of 4") != NULL);
    const dal_setting along[] = {{"x", 1.5}, {"y", 0.0}};
    steered_find(&s, 1.0, along, 2);
    CU_ASSERT_DOUBLE_EQUAL(s.best->S, 6.0 * 0.25, 1e-11);
    CU_ASSERT_EQUAL(s.best->rank, 2);
    steered_close(&s);
}

/* ---- motions of many steps ---- */

/* The iteration, and how often the observer was called again in it. */
typedef struct repetition {
    int iteration, repeated;
} repetition;

static dal_status stop_between_steps(void *user, int guess, int iteration, double residual)
{
    repetition *c = user;
    CU_ASSERT(guess == 0 && residual >= 0.0);
    CU_ASSERT(c->repeated < 3); /* it has ended the search */
    c->repeated = iteration == c->iteration ? c->repeated + 1 : 0;
    c->iteration = iteration;
    return c->repeated == 3 ? DAL_STATUS_INTERRUPTED : DAL_STATUS_OK;
}

/* A motion of many steps is given up between them. */
static void test_many_steps(void)
{
    const dal_setting target[] = {{"x", 0.0}, {"y", 1.0}, {"phi", 0.0}};
    repetition c = {.iteration = -1};
    const dal_steer_observer observer = {&c, NULL, stop_between_steps};
    steered s;
    steered_open(&s, steered_sleigh, DAL_EFFORT_CONSTRAINT, "gauss4", 2.0 / 24000.0);
    s.observer = &observer;
    CU_ASSERT_EQUAL_FATAL(steered_try(&s, 2.0, target, 3), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(c.repeated, 3);
    CU_ASSERT_EQUAL(s.steering->count, 0);
    steered_close(&s);
}

/* ---- targets to which no guess leads ---- */

static dal_status note_guess(void *user, int guess, int iteration, double residual)
{
    int *last = user;
    CU_ASSERT(iteration >= 0 && !(residual < 0.0));
    CU_ASSERT(*last >= 0 || guess == -1); /* it comes last */
    *last = guess;
    return DAL_STATUS_OK;
}

/* The end of an elastic rod by its own equation phi'' = p1 sin phi - p2 cos phi, p = v - g being
 * constant, which is integrated by rk4 in small steps from the start that was found. */
static void bend_rod(const double *z, double T, double out[3])
{
    enum { STEPS = 4000 };
    const double h = T / STEPS, p1 = z[3] - z[6], p2 = z[4] - z[7];
    double y[4] = {z[0], z[1], z[2], z[5]};
    for (int k = 0; k < STEPS; k++) {
        double rate[4] = {0}, sum[4] = {0};
        for (int stage = 0; stage < 4; stage++) {
            const double part = stage == 0 ? 0.0 : stage == 3 ? h : h / 2.0;
            const double phi = y[2] + part * rate[2], turn = y[3] + part * rate[3];
            rate[0] = cos(phi);
            rate[1] = sin(phi);
            rate[2] = turn;
            rate[3] = p1 * sin(phi) - p2 * cos(phi);
            for (int i = 0; i < 4; i++) sum[i] += (stage % 3 == 0 ? h / 6.0 : h / 3.0) * rate[i];
        }
        for (int i = 0; i < 4; i++) y[i] += sum[i];
    }
    memcpy(out, y, 3 * sizeof *out);
}

/* A rod clamped at both ends, to which no line or bent line leads. */
static void test_continuation(void)
{
    static const char rod[] = "coordinates: [x, y, phi]\nlagrangian: (x'^2 + y'^2 + phi'^2)/2\n"
                              "constraints: [x' - cos(phi), y' - sin(phi)]\n"
                              "mechanics: vakonomic\nstart: {x': 1}\n";
    const dal_setting target[] = {{"x", 0.776}, {"y", -0.434}, {"phi", 1.763}};
    int last = 0;
    const dal_steer_observer observer = {&last, NULL, note_guess};
    double end[3];
    steered s;
    if (case_stride(2) > 1) return; /* as many steps as all other tests */
    steered_open(&s, rod, DAL_EFFORT_IDENTITY, "gauss8", 0.02);
    s.settings.rest = false;
    s.settings.iterations = 40;
    s.observer = &observer;
    CU_ASSERT_EQUAL_FATAL(steered_try(&s, 1.0, target, 3), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(last, -1);
    CU_ASSERT_EQUAL(s.steering->count, 1);
    CU_ASSERT_EQUAL(s.best->status, DAL_STATUS_OK);
    CU_ASSERT(s.best->residual <= s.settings.tolerance && s.best->distance < 1e-10);
    bend_rod(steered_row(&s, 0), 1.0, end);
    for (int i = 0; i < 3; i++) CU_ASSERT_DOUBLE_EQUAL(end[i], target[i].value, 1e-8);
    steered_close(&s);
}

/* A search that has begun: to the side of a sleigh, where the straight line is singular. */
typedef struct sideways {
    steered s;
    dal__problem problem;
    dal__shooting shooting;
} sideways;

static const dal_setting side_target[] = {{"x", 0.0}, {"y", 1.0}, {"phi", 0.0}};

static void open_sideways(sideways *w, const dal_steer_observer *observer)
{
    steered *s = &w->s;
    steered_open(s, steered_sleigh, DAL_EFFORT_CONSTRAINT, "gauss4", 0.08);
    s->settings.target = side_target;
    s->settings.targets = 3;
    CU_ASSERT_EQUAL_FATAL(
        dal__problem_open(&w->problem, s->model, &s->spec, 2.0, &s->settings, observer, &s->record),
        DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(
        dal__shooting_open(&w->shooting, &w->problem, w->problem.steps, DAL__STEER_PIECES),
        DAL_STATUS_OK);
}

static void close_sideways(sideways *w)
{
    dal__shooting_close(&w->shooting);
    dal__problem_close(&w->problem);
    steered_close(&w->s);
}

/* From a target near it. */
static void test_continuation_of_lift(void)
{
    dal__newton_result result;
    sideways w;
    if (case_stride(2) > 1) return;
    open_sideways(&w, NULL);
    CU_ASSERT_EQUAL(dal__continuation_solve(&w.shooting, &result), DAL_STATUS_OK);
    CU_ASSERT(result.residual <= w.s.settings.tolerance);
    for (int i = 0; i < 3; i++) CU_ASSERT_EQUAL(w.problem.target[i], side_target[i].value);
    w.s.spec.start_count = 0;
    dal_run *run = fixture_run(&w.s.spec);
    CU_ASSERT_EQUAL(dal_run_set_state(run, 0.0, w.shooting.point, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(run, 25, NULL), DAL_STATUS_OK);
    for (int i = 0; i < 3; i++) {
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[i], side_target[i].value, 1e-7);
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[3 + i], 0.0, 1e-7);
    }
    dal_run_free(run);
    close_sideways(&w);
}

/* A sleigh that stays at rest makes no jumps: what is left is the way to the target. */
static void test_distance_alone(void)
{
    dal__newton_result result;
    sideways w;
    open_sideways(&w, NULL);
    const int dimension = w.problem.dimension;
    memset(w.shooting.point, 0,
           (size_t)(w.shooting.pieces + 1) * (size_t)dimension * sizeof(double));
    for (int k = 0; k <= w.shooting.pieces; k++) w.shooting.point[k * dimension + 6] = 1.0; /* e */
    CU_ASSERT_EQUAL(dal__newton_measure(&w.shooting, &result), DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(result.residual * w.problem.unit[1], 1.0, 1e-14);
    close_sideways(&w);
}

typedef struct call_count {
    int made, last;
} call_count;

static dal_status stop_at_last(void *user, int guess, int iteration, double residual)
{
    call_count *c = user;
    (void)guess;
    (void)iteration;
    (void)residual;
    return ++c->made == c->last ? DAL_STATUS_STOPPED : DAL_STATUS_OK;
}

/* The same search, ended at that call of its observer, from 1, or not; how many there were. */
static int count_calls(int last, dal_status expected)
{
    call_count c = {.last = last};
    const dal_steer_observer observer = {&c, NULL, stop_at_last};
    dal__newton_result result;
    sideways w;
    open_sideways(&w, &observer);
    CU_ASSERT_EQUAL(dal__continuation_solve(&w.shooting, &result), expected);
    for (int i = 0; i < 3; i++) CU_ASSERT_EQUAL(w.problem.target[i], side_target[i].value);
    close_sideways(&w);
    return c.made;
}

/* Where the search is ended, be it before the last iteration, there is no motion to the target. */
static void test_stopped_continuation(void)
{
    if (case_stride(2) > 1) return;
    const int calls = count_calls(0, DAL_STATUS_OK);
    CU_ASSERT_EQUAL(count_calls(calls, DAL_STATUS_STOPPED), calls);
    CU_ASSERT_EQUAL(count_calls(1, DAL_STATUS_STOPPED), 1);
}

/* Wherever a search is ended, its observer is not called again. */
static void test_stopped_anywhere(void)
{
    const dal_setting target[] = {{"x", 0.5}, {"phi", 0.4}};
    int calls = 1;
    for (int last = 0; last <= calls; last += last > 0 ? case_stride(5) : 1) {
        call_count c = {.last = last};
        const dal_steer_observer observer = {&c, NULL, stop_at_last};
        steered s;
        steered_open(&s, steered_sleigh, DAL_EFFORT_CONSTRAINT, "gauss4", 0.1);
        s.observer = &observer;
        CU_ASSERT_EQUAL_FATAL(steered_try(&s, 2.0, target, 2), DAL_STATUS_OK);
        if (last == 0) calls = c.made;
        CU_ASSERT_EQUAL(c.made, last == 0 ? calls : last);
        steered_close(&s);
    }
    CU_ASSERT(calls > 5);
}

/* On a circle of radius 1 a turn by theta costs 6 theta^2/T^3; the angle and its rate change. */
static const char circle[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                             "holonomic: [x^2 + y^2 - 1]\nstart: {x: 1}\n";

static void test_circle(void)
{
    const double T = 1.5, theta = 1.1;
    const dal_setting target[] = {{"x", cos(theta)}, {"y", sin(theta)}};
    steered s;
    steered_open(&s, circle, DAL_EFFORT_CONSTRAINT, "gauss8", 0.015);
    s.spec.options.bare = true;
    steered_find(&s, T, target, 2);
    CU_ASSERT_DOUBLE_EQUAL(s.best->S, 6.0 * theta * theta / (T * T * T), 1e-12);
    CU_ASSERT_EQUAL(s.best->rank, 2);
    CU_ASSERT_EQUAL(s.steering->allowed, 2);
    steered_close(&s);
}

/* Two masses and a spring, of which one is pushed: by Kalman's rank all four numbers change. */
static void test_controlled(void)
{
    static const char pair[] = "coordinates: [x, y]\ncontrols: [{x: 1}]\n"
                               "lagrangian: (x'^2 + 2*y'^2 - 3*(x - y)^2)/2\n";
    const dal_setting target[] = {{"x", 0.4}, {"y", 0.3}};
    steered s;
    steered_open(&s, pair, DAL_EFFORT_CONTROLS, "gauss4", 0.1);
    steered_find(&s, 2.0, target, 2);
    CU_ASSERT_EQUAL(s.steering->allowed, 4);
    CU_ASSERT_EQUAL(s.best->rank, 4);
    steered_close(&s);
}

static void is_refused(steered *s, double T, const dal_setting *target, int targets,
                       dal_status status, const char *fragment)
{
    CU_ASSERT_EQUAL(steered_try(s, T, target, targets), status);
    CU_ASSERT_PTR_NULL(s->steering);
    if (!strstr(s->record.message, fragment)) printf("\n  %s\n", s->record.message);
    CU_ASSERT(strstr(s->record.message, fragment) != NULL);
}

static dal_status stop_at_once(void *user, int guess, int iteration, double residual)
{
    CU_ASSERT(guess == 0 && iteration == 0 && residual >= 0.0);
    ++*(int *)user;
    return DAL_STATUS_INTERRUPTED;
}

/* Whether a search for a target begins. */
static bool begins(steered *s, const dal_setting *target, int targets)
{
    int calls = 0;
    const dal_steer_observer observer = {&calls, NULL, stop_at_once};
    s->observer = &observer;
    CU_ASSERT_EQUAL_FATAL(steered_try(s, 1.0, target, targets), DAL_STATUS_OK);
    s->observer = NULL;
    return calls == 1;
}

/* What an integrable D conserves whatever the effort's inputs are: x - y, x^2 + y^2, of time
 * x - sin t, and a part of a D that is not integrable. */
static void test_leaves(void)
{
    static const char line[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                               "constraints: [x' - y']\nstart: {x: 1}\n";
    static const char cylinder[] = "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n"
                                   "constraints: [x*x' + y*y']\nstart: {x: 1}\n";
    static const char moved[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                                "constraints: [x' - cos(t)]\nstart: {x': 1}\n";
    static const char carried[] = "coordinates: [x, y, phi, z]\n"
                                  "lagrangian: (x'^2 + y'^2 + phi'^2 + z'^2)/2\n"
                                  "constraints: [x'*sin(phi) - y'*cos(phi), z' - 2*phi*phi']\n";
    dal_setting target[] = {{"x", 2.0}, {"y", 0.5}, {"phi", 0.5}, {"z", 0.3}};
    steered s;
    steered_open(&s, line, DAL_EFFORT_CONSTRAINT, "gauss4", 0.1);
    is_refused(&s, 1.0, target, 2, DAL_STATUS_INCONSISTENT,
               "every motion keeps x - y, which is 1 at the start and 1.5 at the target");
    CU_ASSERT(begins(&s, target, 1)); /* y is free */
    target[1].value = 1.0;
    CU_ASSERT(begins(&s, target, 2));
    steered_close(&s);
    steered_open(&s, line, DAL_EFFORT_MASS, "gauss4", 0.1); /* it pushes across D = 0 */
    target[1].value = 0.5;
    CU_ASSERT(begins(&s, target, 2));
    s.settings.rest = false;
    s.settings.aim = true;
    is_refused(&s, 1.0, target, 2, DAL_STATUS_INCONSISTENT, "keeps x - y");
    steered_close(&s);
    steered_open(&s, cylinder, DAL_EFFORT_CONSTRAINT, "gauss4", 0.1);
    is_refused(&s, 1.0, target, 2, DAL_STATUS_INCONSISTENT,
               "keeps x^2 + y^2, which is 1 at the start and 4.25 at the target");
    target[0].value = -0.6, target[1].value = 0.8;
    CU_ASSERT(begins(&s, target, 2));
    steered_close(&s);
    steered_open(&s, moved, DAL_EFFORT_CONSTRAINT, "gauss4", 0.1);
    s.settings.rest = false;
    is_refused(&s, 1.0, target, 1, DAL_STATUS_INCONSISTENT, "every motion keeps x - sin(t)");
    target[0].value = sin(1.0);
    CU_ASSERT(begins(&s, target, 1));
    steered_close(&s);
    steered_open(&s, carried, DAL_EFFORT_CONSTRAINT, "gauss4", 0.1);
    is_refused(&s, 1.0, target, 4, DAL_STATUS_INCONSISTENT, "z");
    target[3].value = 0.25;
    CU_ASSERT(begins(&s, target, 4));
    steered_close(&s);
}

/* Every place and heading of a sleigh is on its one leaf. */
static void test_one_leaf(void)
{
    steered s;
    dal__random random = {1};
    steered_open(&s, steered_sleigh, DAL_EFFORT_CONSTRAINT, "gauss4", 0.1);
    for (int i = 0; i < 20; i++) {
        const dal_setting target[] = {{"x", 2.0 * dal__uniform(&random)},
                                      {"y", 2.0 * dal__uniform(&random)},
                                      {"phi", 3.0 * dal__uniform(&random)}};
        CU_ASSERT(begins(&s, target, 3));
    }
    steered_close(&s);
}

static void test_refuses(void)
{
    static const char *const nowhere[] = {"z"};
    const dal_setting target[] = {{"x", 1.0}, {"y", 0.0}, {"phi", 0.0}, {"y'", 0.5}};
    const dal_setting other = {"z", 1.0}, momentum = {"p_x", 1.0}, none = {"x", NAN};
    steered s;
    steered_open(&s, steered_sleigh, DAL_EFFORT_CONSTRAINT, "gauss4", 0.1);
    is_refused(&s, 1.0, target, 4, DAL_STATUS_INCONSISTENT, "the target is off D");
    is_refused(&s, 1.03, target, 3, DAL_STATUS_ARGUMENT, "no whole number of steps");
    is_refused(&s, 0.0, target, 3, DAL_STATUS_ARGUMENT, "no whole number of steps");
    is_refused(&s, 1.0, &other, 1, DAL_STATUS_NAME, "no coordinate or velocity");
    is_refused(&s, 1.0, &momentum, 1, DAL_STATUS_NAME, "no coordinate or velocity");
    is_refused(&s, 1.0, &none, 1, DAL_STATUS_ARGUMENT, "not finite");
    s.settings.free_starts = nowhere;
    s.settings.frees = 1;
    is_refused(&s, 1.0, target, 3, DAL_STATUS_NAME, "'z' is no coordinate or velocity");
    s.settings.frees = 0;
    s.settings.rest = false;
    is_refused(&s, 1.0, NULL, 0, DAL_STATUS_ARGUMENT, "no target");
    s.settings.rest = true;
    s.spec = fixture_spec(s.spec.system, "gauss4+project", DAL_LIFTED, 0.1);
    is_refused(&s, 1.0, target, 3, DAL_STATUS_UNSUPPORTED, "; take gauss4");
    s.spec = fixture_spec(s.spec.system, "dop853", DAL_LIFTED, 0.1);
    s.spec.options.tolerance = 1e-9;
    is_refused(&s, 1.0, target, 3, DAL_STATUS_UNSUPPORTED, "; take dop853 without a tolerance");
    s.spec = fixture_spec(fixture_system("chaplygin-sleigh"), "gauss4", DAL_LIFTED, 0.1);
    is_refused(&s, 1.0, target, 3, DAL_STATUS_ARGUMENT, "not the model's");
    steered_close(&s);
    steered_open(&s, "chaplygin-sleigh-vakonomic", DAL_EFFORT_IDENTITY, "gauss4", 0.1);
    const dal_setting speed = {"y1'", 1.0}, multiplier = {"g1", 1.0};
    is_refused(&s, 1.0, &speed, 1, DAL_STATUS_UNSUPPORTED, "there is no rest");
    s.settings.rest = false;
    s.settings.aim = true;
    is_refused(&s, 1.0, &speed, 1, DAL_STATUS_UNSUPPORTED, "there is no aim");
    s.settings.aim = false;
    is_refused(&s, 1.0, &speed, 1, DAL_STATUS_UNSUPPORTED, "'y1'' cannot be given");
    is_refused(&s, 1.0, &multiplier, 1, DAL_STATUS_UNSUPPORTED, "'g1' cannot be given");
    steered_close(&s);
    steered_open(&s, "coordinates: [x]\nlagrangian: x'^2/2\ngauge: {mu_e: 1}\n",
                 DAL_EFFORT_IDENTITY, "gauss4", 0.1);
    is_refused(&s, 1.0, target, 1, DAL_STATUS_UNSUPPORTED, "constant e");
    const dal_setting infinite = {"e", INFINITY};
    steered_close(&s);
    steered_open(&s, steered_unstable, DAL_EFFORT_IDENTITY, "gauss4", 0.1);
    s.spec.start = &infinite;
    s.spec.start_count = 1;
    is_refused(&s, 1.0, target, 1, DAL_STATUS_UNSUPPORTED, "1/e = 0");
    steered_close(&s);
    steered_open(&s, circle, DAL_EFFORT_IDENTITY, "dla", 0.1);
    is_refused(&s, 1.0, target, 1, DAL_STATUS_UNSUPPORTED, "dla cannot act on");
    dal_model *const made = s.model;
    s.model = fixture_model("coordinates: [x, y]\nlagrangian: x'^2/2\n");
    is_refused(&s, 1.0, target, 1, DAL_STATUS_SINGULAR_MASS, "mass matrix is singular");
    dal_model_free(made);
    steered_close(&s);
}

void suite_steer_ends(void)
{
    CU_pSuite suite = CU_add_suite("what steering can reach", NULL, NULL);
    CU_add_test(suite, "targets that are not reached", test_unreached);
    CU_add_test(suite, "an interruption between many steps", test_many_steps);
    CU_add_test(suite, "an end that is moved", test_continuation);
    CU_add_test(suite, "an end that is moved, on the lift", test_continuation_of_lift);
    CU_add_test(suite, "a distance without jumps", test_distance_alone);
    CU_add_test(suite, "an end whose move is stopped", test_stopped_continuation);
    CU_add_test(suite, "a search that is stopped anywhere", test_stopped_anywhere);
    CU_add_test(suite, "a holonomic constraint, closed form", test_circle);
    CU_add_test(suite, "two masses, one pushed", test_controlled);
    CU_add_test(suite, "targets on other leaves", test_leaves);
    CU_add_test(suite, "a sleigh has one leaf", test_one_leaf);
    CU_add_test(suite, "what is refused", test_refuses);
}
