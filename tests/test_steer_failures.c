/* test_steer_failures.c - what steering makes of callbacks, allocations and observers that fail in
 * the steps inside it, and the parts whose values are known by hand. */
#include "allocation.h"
#include "failing.h"
#include "fixtures.h"
#include "quick.h"
#include "steer/border.h"
#include "steer/continuation.h"
#include "steer/direct.h"
#include "steer/guess.h"
#include "steer/reach.h"
#include "steer/vakonomic.h"
#include "steered.h"
#include <CUnit/CUnit.h>
#include <limits.h>
#include <math.h>
#include <string.h>

#define PENDULUM "coordinates: [x]\nlagrangian: x'^2/2 + cos(x)\n"
static const char pendulum[] = PENDULUM;
static const char parabola[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                               "constraints: [\"y' - x*x'\"]\n";
static const char area[] = "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n"
                           "constraints: [z' - (x*y' - y*x')/2]\nmechanics: vakonomic\n";
static const dal_setting targets[] = {{"x", 0.8}, {"y", 0.32}, {"z", 0.3}};

/* A search in T = 1 that has been opened. */
typedef struct search {
    steered s;
    dal__problem problem;
    dal__shooting shooting;
    dal__newton_result result;
} search;

/* The system of a model, which a caller cannot change. */
static dal_system *changed(const dal_system *system)
{
    return (dal_system *)(void *)(size_t)(const void *)system;
}

/* Straight from the start to the target, with momenta of 0. */
static void draw_line(search *w)
{
    const dal__problem *p = &w->problem;
    const int n = p->n, pieces = w->shooting.pieces;
    memset(w->shooting.point, 0, (size_t)((pieces + 1) * p->dimension) * sizeof(double));
    for (int k = 0; k <= pieces; k++)
        for (int i = 0; i < n; i++) {
            double *z = w->shooting.point + k * p->dimension;
            const double length = p->target[i] - p->start[i];
            z[i] = p->start[i] + k * length / pieces;
            z[n + i] = k > 0 && k < pieces ? length / (p->T - p->from) : 0.0;
            if (p->is_lifted) z[2 * n] = 1.0;
        }
}

/* A new search in the same problem. */
static void restart(search *w)
{
    w->problem.stopped = DAL_STATUS_OK;
    w->problem.iterations = w->problem.guess = 0;
    w->problem.limit = w->s.settings.iterations;
    draw_line(w);
}

/* Of the system, or of the tangent system, the callbacks with these names, or all, may fail. */
static bool fails_by_tangent;

static void open_search(search *w, const char *text, dal_effort effort, const char *const *names,
                        int steps, int pieces)
{
    const bool is_vakonomic = text == area;
    steered *s = &w->s;
    steered_open(s, text, effort, "rk4", 1.0 / steps);
    const dal_system *tangent;
    CU_ASSERT_EQUAL_FATAL(dal_model_tangent(s->model, &tangent, NULL), DAL_STATUS_OK);
    const dal_system *const system = fails_by_tangent ? tangent : s->spec.system;
    *changed(system) = failing_system(system, names);
    failing_begin(0, 0);
    s->settings.rest = !is_vakonomic;
    s->settings.target = targets;
    s->settings.targets = s->spec.system->n;
    CU_ASSERT_EQUAL_FATAL(
        dal__problem_open(&w->problem, s->model, &s->spec, 1.0, &s->settings, NULL, &s->record),
        DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal__vakonomic_open(&w->problem), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal__shooting_open(&w->shooting, &w->problem, steps, pieces),
                          DAL_STATUS_OK);
    restart(w);
}

static void close_search(search *w)
{
    failing_begin(0, 0);
    dal__shooting_close(&w->shooting);
    dal__vakonomic_close(&w->problem);
    dal__problem_close(&w->problem);
    steered_close(&w->s);
}

/* ---- what searches ---- */

static dal_status by_newton(search *w) { return dal__newton(&w->shooting, &w->result); }

static dal_status measure(search *w) { return dal__newton_measure(&w->shooting, &w->result); }

static dal_status iterate_directly(search *w)
{
    dal__direct d;
    dal_status status = dal__direct_open(&d, &w->shooting);
    if (status == DAL_STATUS_OK) status = dal__direct_iterate(&d);
    dal__direct_close(&d);
    return status;
}

static dal_status by_guess(search *w) { return dal__guess_solve(&w->shooting, &w->result); }

static dal_status by_continuation(search *w)
{
    return dal__continuation_solve(&w->shooting, &w->result);
}

static dal_status move(search *w)
{
    return dal__shooting_move(&w->shooting, w->shooting.point, w->shooting.end);
}

static dal_status differentiate(search *w)
{
    return dal__shooting_differentiate(&w->shooting, DAL__COLUMNS_OF_ALL);
}

/* Whether the pieces are one motion. */
static bool is_one_motion(search *w)
{
    double jump[48 * 16];
    failing_begin(0, 0);
    CU_ASSERT_EQUAL(move(w), DAL_STATUS_OK);
    const int width = w->problem.unknowns, count = w->shooting.pieces * width;
    dal__shooting_jumps(&w->shooting, w->shooting.point, w->shooting.end, width, jump);
    bool is_one = true;
    for (int i = 0; i < count; i++) is_one = is_one && fabs(jump[i]) < 1e-8;
    return is_one;
}

/* ---- callbacks ---- */

/* A call fails alone, or with all after it: what is found nevertheless is a motion. */
static void test_calls(void)
{
    static const struct {
        const char *text;
        dal_effort effort;
        dal_status (*solve)(search *);
    } cases[] = {{pendulum, DAL_EFFORT_IDENTITY, by_newton},
                 {pendulum, DAL_EFFORT_IDENTITY, by_guess},
                 {parabola, DAL_EFFORT_CONSTRAINT, by_guess}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        search w;
        open_search(&w, cases[i].text, cases[i].effort, NULL, 48, 12);
        CU_ASSERT_EQUAL(cases[i].solve(&w), DAL_STATUS_OK);
        const long total = failing_calls();
        CU_ASSERT(is_one_motion(&w));
        for (long k = 1; k <= total; k += 1 + case_stride(4) * total / 120) {
            for (long last = k; last >= k; last = last == k ? LONG_MAX : 0) {
                restart(&w);
                failing_begin(k, last);
                CU_ASSERT(cases[i].solve(&w) != DAL_STATUS_OK || is_one_motion(&w));
            }
        }
        close_search(&w);
    }
}

/* Where all fail their status is returned; where none but the first motion can be made Newton's
 * method ends with the iteration in which it finds no other. */
static void test_all_calls(void)
{
    dal_status (*const step[])(search *) = {by_newton, measure, iterate_directly, move};
    search w;
    open_search(&w, pendulum, DAL_EFFORT_IDENTITY, NULL, 20, 10);
    for (size_t i = 0; i < sizeof step / sizeof *step; i++) {
        restart(&w);
        failing_begin(1, LONG_MAX);
        CU_ASSERT_EQUAL(step[i](&w), DAL_STATUS_IO);
    }
    failing_begin(0, 0);
    CU_ASSERT_EQUAL(move(&w), DAL_STATUS_OK);
    const long calls = failing_calls();
    restart(&w);
    failing_begin(calls + 1, LONG_MAX);
    CU_ASSERT_EQUAL(by_newton(&w), DAL_STATUS_NOT_CONVERGED);
    CU_ASSERT_EQUAL(w.problem.iterations, 1);
    close_search(&w);
}

/* The last step is so short that it is not damped: where its motion cannot be made this is the
 * status.  Some targets may be reached without it. */
static void test_last_call(void)
{
    int undamped = 0;
    search w;
    open_search(&w, pendulum, DAL_EFFORT_IDENTITY, NULL, 20, 10);
    for (int k = 1; k <= 8; k++) {
        w.problem.target[0] = 0.1 * k;
        restart(&w);
        failing_begin(0, 0);
        CU_ASSERT_EQUAL(by_newton(&w), DAL_STATUS_OK);
        const long total = failing_calls();
        restart(&w);
        failing_begin(total, LONG_MAX);
        const dal_status status = by_newton(&w);
        undamped += status == DAL_STATUS_IO;
        CU_ASSERT(status == DAL_STATUS_IO || (status == DAL_STATUS_OK && is_one_motion(&w)));
    }
    CU_ASSERT(undamped > 0);
    close_search(&w);
}

/* Nothing is found by derivatives that cannot be evaluated. */
static void test_derivatives(void)
{
    search w;
    open_search(&w, pendulum, DAL_EFFORT_IDENTITY, NULL, 20, 10);
    w.shooting.point[3 * w.problem.dimension] = NAN;
    CU_ASSERT_EQUAL(differentiate(&w), DAL_STATUS_NOT_FINITE);
    close_search(&w);
    /* callbacks of the tangent system alone fail */
    fails_by_tangent = true;
    open_search(&w, pendulum, DAL_EFFORT_IDENTITY, NULL, 20, 10);
    fails_by_tangent = false;
    failing_begin(1, LONG_MAX);
    CU_ASSERT_EQUAL(by_newton(&w), DAL_STATUS_IO);
    CU_ASSERT_EQUAL(w.problem.iterations, 1);
    close_search(&w);
}

/* Callbacks that fail where a problem is opened, at its start or at its target. */
static void test_opening(void)
{
    static const char circle[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                                 "holonomic: [x^2 + y^2 - 1]\nstart: {x: 1}\n";
    static const struct {
        const char *text, *name;
        dal_effort effort;
        bool aim;
        dal_setting target[2];
    } cases[] = {
        {parabola, "constraints", DAL_EFFORT_IDENTITY, true, {{"x", 0.8}, {"y", 0.32}}},
        {parabola, "constraints", DAL_EFFORT_CONSTRAINT, false, {{"x", 0.8}, {"y", 0.32}}},
        {parabola, "effort", DAL_EFFORT_CONSTRAINT, false, {{"x", 0.8}, {"y", 0.32}}},
        {circle, "holonomic", DAL_EFFORT_CONSTRAINT, false, {{"x", 0.6}, {"y", 0.8}}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *const names[] = {cases[i].name, NULL};
        long total = 1;
        for (long k = 0; k <= total; k++) {
            dal__problem p;
            steered s;
            steered_open(&s, cases[i].text, cases[i].effort, "gauss4", 0.1);
            s.settings.rest = !cases[i].aim;
            s.settings.aim = cases[i].aim;
            s.settings.target = cases[i].target;
            s.settings.targets = 2;
            s.spec.options.bare = true;
            *changed(s.spec.system) = failing_system(s.spec.system, names);
            failing_begin(k, k);
            CU_ASSERT_EQUAL(
                dal__problem_open(&p, s.model, &s.spec, 1.0, &s.settings, NULL, &s.record),
                k > 0 ? DAL_STATUS_IO : DAL_STATUS_OK);
            if (k == 0) total = failing_calls();
            dal__problem_close(&p);
            steered_close(&s);
        }
        CU_ASSERT(total > 0);
        failing_begin(0, 0);
    }
}

/* D of the rows that are listed: where it cannot be evaluated there are none. */
static void test_rows(void)
{
    static const char *const names[] = {"constraints", NULL};
    long total = 0;
    for (int k = 0; k < 2; k++) {
        steered s;
        steered_open(&s, parabola, DAL_EFFORT_IDENTITY, "rk4", 0.1);
        *changed(s.spec.system) = failing_system(s.spec.system, names);
        failing_begin(k > 0 ? total : 0, k > 0 ? LONG_MAX : 0);
        CU_ASSERT_EQUAL_FATAL(steered_try(&s, 1.0, targets, 2), DAL_STATUS_OK);
        if (k == 0) total = failing_calls();
        CU_ASSERT_EQUAL(s.best->status == DAL_STATUS_OK, k == 0);
        CU_ASSERT(k == 0 ? s.best->max_D < 1.0 : isnan(s.best->max_D));
        steered_close(&s);
    }
    failing_begin(0, 0);
}

/* A line that overflows has neither rows nor a cost. */
static void test_infinite_line(void)
{
    const dal_setting target = {"x", 1.7e308};
    steered s;
    steered_open(&s, "coordinates: [x]\nlagrangian: x'^2/2\nstart: {x: -1.7e308}\n",
                 DAL_EFFORT_IDENTITY, "rk4", 0.1);
    CU_ASSERT_EQUAL_FATAL(steered_try(&s, 1.0, &target, 1), DAL_STATUS_OK);
    CU_ASSERT_NOT_EQUAL(s.best->status, DAL_STATUS_OK);
    CU_ASSERT(isnan(s.best->S) && isinf(s.best->residual) && isinf(s.best->distance));
    CU_ASSERT(isnan(steered_row(&s, 1)[0]));
    steered_close(&s);
}

/* K that overflows in the units of v is no K. */
static void test_infinite_effort(void)
{
    search w;
    open_search(&w, pendulum, DAL_EFFORT_IDENTITY, NULL, 20, 10);
    CU_ASSERT_EQUAL(iterate_directly(&w), DAL_STATUS_OK);
    restart(&w);
    w.problem.unit[1] = 1e-200;
    CU_ASSERT_EQUAL(iterate_directly(&w), DAL_STATUS_NOT_FINITE);
    close_search(&w);
}

/* ---- an observer that ends the search ---- */

typedef struct call_count {
    int made, last, of_first_guess;
} call_count;

static dal_status stop_at_last(void *user, int guess, int iteration, double residual)
{
    call_count *c = user;
    (void)iteration;
    (void)residual;
    c->made++;
    c->of_first_guess += guess == 0;
    return c->made == c->last ? DAL_STATUS_STOPPED : DAL_STATUS_OK;
}

/* Whenever an observer ends a step of a search, between many steps too, this is its status, and it
 * is not called again. */
static void test_stopped_steps(void)
{
    dal_status (*const step[])(search *) = {by_newton, by_guess, iterate_directly, by_continuation};
    for (size_t i = 0; i < sizeof step / sizeof *step; i++) {
        search w;
        call_count c = {0};
        const dal_steer_observer observer = {&c, NULL, stop_at_last};
        open_search(&w, pendulum, DAL_EFFORT_IDENTITY, NULL, 130, 2);
        w.problem.observer = &observer;
        CU_ASSERT_EQUAL(step[i](&w), DAL_STATUS_OK);
        const int total = c.made;
        CU_ASSERT(total > 3);
        for (int last = 1; last <= total; last += 1 + total / 60) {
            c = (call_count){.last = last};
            restart(&w);
            CU_ASSERT_EQUAL(step[i](&w), DAL_STATUS_STOPPED);
            CU_ASSERT_EQUAL(c.made, last);
        }
        CU_ASSERT_EQUAL(move(&w), DAL_STATUS_STOPPED);
        CU_ASSERT_EQUAL(differentiate(&w), DAL_STATUS_STOPPED);
        close_search(&w);
    }
}

/* A motion of many steps of which nothing is measured is left out: when the observer ends the
 * search in the first guess, also while its distance is measured or its rows are filled. */
static void test_stopped_motions(void)
{
    static const struct {
        long long steps;
        int iterations;
        bool is_found;
    } cases[] = {{24 * 65, 1, false}, {8200, 200, true}};
    const dal_setting target = {"x", 0.5};
    for (int i = 0; i < 2; i++) {
        int total = 0;
        for (int last = 0; last <= total; last++) {
            call_count c = {.last = last};
            const dal_steer_observer observer = {&c, NULL, stop_at_last};
            steered s;
            if (cases[i].is_found && last == 1) last = total; /* the rows alone */
            c.last = last;
            steered_open(&s, pendulum, DAL_EFFORT_IDENTITY, "rk4", 1.0 / (double)cases[i].steps);
            s.settings.iterations = cases[i].iterations;
            s.observer = &observer;
            CU_ASSERT_EQUAL_FATAL(steered_try(&s, 1.0, &target, 1), DAL_STATUS_OK);
            if (last == 0) total = c.of_first_guess;
            CU_ASSERT_EQUAL(s.steering->count, last == 0);
            if (last == 0) CU_ASSERT_EQUAL(s.best->status == DAL_STATUS_OK, cases[i].is_found);
            if (last > 0) CU_ASSERT_EQUAL(c.made, last);
            steered_close(&s);
        }
        CU_ASSERT(total > 3);
    }
}

/* No further guess is made after the search has ended. */
static void test_stopped_guesses(void)
{
    call_count c = {.last = 1};
    const dal_steer_observer observer = {&c, NULL, stop_at_last};
    const dal_setting target = {"x", 0.5};
    steered s;
    steered_open(&s, pendulum, DAL_EFFORT_IDENTITY, "rk4", 0.1);
    s.settings.starts = 5;
    s.observer = &observer;
    CU_ASSERT_EQUAL_FATAL(steered_try(&s, 1.0, &target, 1), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(c.made, 1);
    CU_ASSERT_EQUAL(s.steering->count, 1);
    CU_ASSERT_EQUAL(s.best->status, DAL_STATUS_STOPPED);
    steered_close(&s);
}

/* ---- iterations ---- */

static void test_limits(void)
{
    search w;
    open_search(&w, pendulum, DAL_EFFORT_IDENTITY, NULL, 20, 10);
    w.problem.limit = 0;
    CU_ASSERT_EQUAL(by_newton(&w), DAL_STATUS_NOT_CONVERGED);
    CU_ASSERT_EQUAL(iterate_directly(&w), DAL_STATUS_NOT_CONVERGED);
    CU_ASSERT_EQUAL(w.problem.iterations, 0);
    close_search(&w);
}

/* ---- continuation ---- */

/* A motion from a draw is used where it could be made: a draw whose velocities cannot be projected,
 * or which is not finite, is no motion, and one whose steps fail ends with the first piece. */
static void test_draws(void)
{
    enum { DRAWS = 8 };
    static const char *const field[] = {"field", NULL};
    for (int i = 0; i < 5; i++) {
        search w;
        call_count c = {.last = i == 3};
        const dal_steer_observer observer = {&c, NULL, stop_at_last};
        open_search(&w, area, DAL_EFFORT_IDENTITY, i == 2 ? field : NULL, 48, 24);
        w.problem.observer = &observer;
        if (i == 1) w.problem.unit[6] = INFINITY;
        if (i == 0 || i == 2) failing_begin(1, LONG_MAX);
        if (i == 4) w.s.settings.iterations = 1;
        CU_ASSERT_EQUAL(by_continuation(&w),
                        i == 3 ? DAL_STATUS_STOPPED : DAL_STATUS_NOT_CONVERGED);
        if (i < 4) CU_ASSERT_EQUAL(c.made, i < 2 ? 0 : i == 2 ? DRAWS : 1);
        if (i == 3) CU_ASSERT_EQUAL(dal_run_time(w.problem.run), 0.0);
        for (int k = 0; k < 3; k++) CU_ASSERT_EQUAL(w.problem.target[k], targets[k].value);
        close_search(&w);
    }
}

/* ---- memory ---- */

static dal_status starve_continuation(void *user, int guess, int iteration, double residual)
{
    (void)user;
    (void)iteration;
    (void)residual;
    if (guess < 0) allocation_fail_after(0);
    return DAL_STATUS_OK;
}

/* Also where guesses have led nowhere. */
static void test_memory_of_continuation(void)
{
    const dal_steer_observer observer = {NULL, NULL, starve_continuation};
    const dal_setting target = {"x", 0.5};
    steered s;
    steered_open(&s, pendulum, DAL_EFFORT_IDENTITY, "rk4", 0.1);
    s.settings.iterations = 1;
    s.observer = &observer;
    const dal_status status = steered_try(&s, 1.0, &target, 1);
    CU_ASSERT(allocation_failed());
    allocation_fail_after(-1);
    CU_ASSERT_EQUAL(status, DAL_STATUS_MEMORY);
    CU_ASSERT_PTR_NULL(s.steering);
    steered_close(&s);
}

/* Each allocation of a search by a coarse grid. */
static void test_memory(void)
{
    allocation_trial trial = {0};
    search w;
    open_search(&w, parabola, DAL_EFFORT_CONSTRAINT, NULL, 48, 12);
    while (allocation_next(&trial)) {
        restart(&w);
        allocation_start(&trial);
        allocation_end(&trial, by_guess(&w));
        if (!trial.passed && !trial.is_single) trial.failures += case_stride(9) - 1;
    }
    CU_ASSERT(trial.failures > 50);
    close_search(&w);
}

/* ---- ends ---- */

/* Which integrals both ends give and which no end does: D = y' - x x' is given by an end whose
 * x, x' and y' are. */
static void test_ends(void)
{
    static const struct {
        bool is_free[2]; /* the velocity at the start, at the end */
        int extra;
    } cases[] = {{{false, false}, 1}, {{false, true}, 0}, {{true, false}, 0}, {{true, true}, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        search w;
        dal__border border;
        open_search(&w, parabola, DAL_EFFORT_CONSTRAINT, NULL, 10, 5);
        for (int k = 0; k < 4; k++) w.problem.is_free[k / 2][2 + k % 2] = cases[i].is_free[k / 2];
        CU_ASSERT_EQUAL(dal__border_open(&border, &w.shooting), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal__border_extra(&border), cases[i].extra);
        CU_ASSERT_EQUAL(dal__border_rows(&border), 8 + cases[i].extra);
        dal__border_close(&border);
        close_search(&w);
    }
}

/* ---- ranks and conjugate times ---- */

/* The derivative of each piece turns (x, momentum) by an angle in the directions that are
 * orthogonal to normal[2n], and is the identity along it: J(k) = sin(k angle) there. */
static void turn(dal__shooting *s, double angle, const double *normal)
{
    const int d = s->problem->unknowns, w = d / 2;
    for (int k = 0; k < s->pieces; k++)
        for (int i = 0; i < w; i++)
            for (int j = 0; j < w; j++) {
                double *const at = s->derivative + k * d * d;
                const double along = normal[i] * normal[j], across = (i == j) - along;
                at[i * d + j] = at[(w + i) * d + w + j] = cos(angle) * across + along;
                at[i * d + w + j] = sin(angle) * across;
                at[(w + i) * d + j] = -sin(angle) * across;
            }
}

/* det J = +-sin^r changes its sign where the angle passes multiples of pi if the rank r is odd. */
static void test_conjugate_times(void)
{
    static const char line[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                               "constraints: [\"x' - y'\"]\n";
    const double along_D[4] = {0.0, 0.0, sqrt(0.5), -sqrt(0.5)};
    static const struct {
        const char *text;
        double angle;
        int rank, times;
        double first;
    } cases[] = {{line, 0.5, 3, 3, 0.35}, /* 10 > 3 pi, and 7 pieces pass pi */
                 {line, 0.1, 3, 0, NAN},
                 {pendulum, 0.5, 2, 0, NAN}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        search w;
        dal_extremal x;
        open_search(&w, cases[i].text, DAL_EFFORT_CONSTRAINT, NULL, 20, 20);
        turn(&w.shooting, cases[i].angle, w.problem.n == 2 ? along_D : (double[4]){0.0});
        CU_ASSERT_EQUAL(dal__reach_measure(&w.shooting, &x), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(x.rank, cases[i].rank);
        CU_ASSERT_EQUAL(x.conjugate_times, cases[i].times);
        if (cases[i].times > 0) CU_ASSERT_DOUBLE_EQUAL(x.first_conjugate, cases[i].first, 1e-12);
        CU_ASSERT_EQUAL(isnan(x.first_conjugate), cases[i].times == 0);
        close_search(&w);
    }
}

void suite_steer_failures(void)
{
    CU_pSuite suite = CU_add_suite("steps of steering that fail", NULL, NULL);
    CU_add_test(suite, "callbacks", test_calls);
    CU_add_test(suite, "all callbacks", test_all_calls);
    CU_add_test(suite, "a last call", test_last_call);
    CU_add_test(suite, "derivatives", test_derivatives);
    CU_add_test(suite, "callbacks where a problem is opened", test_opening);
    CU_add_test(suite, "callbacks of rows", test_rows);
    CU_add_test(suite, "a line that is not finite", test_infinite_line);
    CU_add_test(suite, "an effort that is not finite", test_infinite_effort);
    CU_add_test(suite, "steps that are stopped", test_stopped_steps);
    CU_add_test(suite, "motions that are stopped", test_stopped_motions);
    CU_add_test(suite, "guesses after the search is stopped", test_stopped_guesses);
    CU_add_test(suite, "iterations", test_limits);
    CU_add_test(suite, "draws that fail", test_draws);
    CU_add_test(suite, "no memory for continuation", test_memory_of_continuation);
    CU_add_test(suite, "no memory for guesses", test_memory);
    CU_add_test(suite, "integrals that ends give", test_ends);
    CU_add_test(suite, "conjugate times", test_conjugate_times);
}
