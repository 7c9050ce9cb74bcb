/* test_steer.c - boundary values of the lift, against closed forms of optimal control and against
 * runs from the start that is found. */
#include "allocation.h"
#include "failing.h"
#include "fixtures.h"
#include "null.h"
#include "quick.h"
#include "steer/direct.h"
#include "steered.h"
#include <CUnit/CUnit.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* x'' = w^2 x - k^2 x' + u from (1, 0) to (0, 0) with w = k = 1, T = 1.5: S = d.G^-1 d/2 with the
 * Gramian G of (e^(tJ) b), d = e^(TJ)(1, 0); in closed form by a computer algebra. */
static const double unstable_action = 3.744703461964342;

static void test_gramian(void)
{
    const dal_setting target = {"x", 0.0};
    double deviation[2];
    steered s;
    steered_open(&s, steered_unstable, DAL_EFFORT_IDENTITY, "gauss8", 0.015);
    steered_find(&s, 1.5, &target, 1);
    CU_ASSERT_DOUBLE_EQUAL(s.best->S, unstable_action, 1e-12);
    CU_ASSERT_EQUAL(s.best->rank, 2);
    CU_ASSERT_EQUAL(s.steering->allowed, 2);
    CU_ASSERT_EQUAL(s.best->conjugate_times, 0); /* a linear problem is convex */
    CU_ASSERT_EQUAL(s.steering->rows, 101);
    CU_ASSERT_DOUBLE_EQUAL(steered_row(&s, 100)[5], s.best->S, 1e-14); /* pi_e, e = 1 */
    /* S has the order of the method */
    for (int k = 0; k < 2; k++) {
        s.spec = fixture_spec(s.spec.system, "gauss4", DAL_LIFTED, k == 0 ? 0.05 : 0.025);
        steered_find(&s, 1.5, &target, 1);
        deviation[k] = s.best->S - unstable_action;
    }
    CU_ASSERT_DOUBLE_EQUAL(log2(deviation[0] / deviation[1]), 4.0, 0.05);
    steered_close(&s);
}

/* x'' = u, e = 2: with a free velocity at the end S = 3 e d^2/(2 T^3), at rest four times as much;
 * with free velocities at both ends nothing is to be paid. */
static void test_free_ends(void)
{
    static const char cart[] =
        "coordinates: [x]\nlagrangian: x'^2/2\ngauge: {e: 2}\nstart: {x: 0.5}\n";
    static const char *const frees[] = {"x'"};
    const dal_setting target = {"x", 1.2};
    const double T = 2.0, unit = 2.0 * 0.7 * 0.7 / (T * T * T);
    steered s;
    steered_open(&s, cart, DAL_EFFORT_IDENTITY, "gauss4", 0.125);
    steered_find(&s, T, &target, 1);
    CU_ASSERT_DOUBLE_EQUAL(s.best->S, 6.0 * unit, 1e-13);
    CU_ASSERT_EQUAL(s.steering->inputs, 1);
    CU_ASSERT_DOUBLE_EQUAL(s.best->u[0], 6.0 * 0.7 / (T * T), 1e-12); /* whatever e is */
    CU_ASSERT_DOUBLE_EQUAL(s.best->u[16], -s.best->u[0], 1e-12);
    s.settings.rest = false;
    steered_find(&s, T, &target, 1);
    CU_ASSERT_DOUBLE_EQUAL(s.best->S, 1.5 * unit, 1e-13);
    CU_ASSERT_DOUBLE_EQUAL(steered_row(&s, 16)[4], 0.0, 1e-13); /* pi at the end */
    CU_ASSERT_EQUAL(s.best->conjugate_times, -1);
    s.settings.free_starts = frees;
    s.settings.frees = 1;
    steered_find(&s, T, &target, 1);
    CU_ASSERT_DOUBLE_EQUAL(s.best->S, 0.0, 1e-25);
    CU_ASSERT_DOUBLE_EQUAL(steered_row(&s, 0)[1], 0.35, 1e-13);
    steered_close(&s);
}

/* ---- Gauss-Newton alone ---- */

enum { GRID = 24 };

typedef struct directly {
    dal_setting target;
    steered s;
    dal__problem p;
    dal__shooting grid;
    dal__direct d;
} directly;

/* On a grid of one step a piece, from rest on a straight line to x. */
static void open_directly(directly *w, double T, double x)
{
    steered *const s = &w->s;
    dal__problem *const p = &w->p;
    dal__shooting *const grid = &w->grid;
    w->target = (dal_setting){"x", x};
    s->settings.target = &w->target;
    s->settings.targets = 1;
    CU_ASSERT_EQUAL_FATAL(
        dal__problem_open(p, s->model, &s->spec, T, &s->settings, NULL, &s->record), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal__shooting_open(grid, p, GRID, GRID), DAL_STATUS_OK);
    for (int k = 0; k <= GRID; k++) {
        double *z = grid->point + k * p->dimension;
        z[0] = p->start[0] + k * (p->target[0] - p->start[0]) / GRID;
        z[1] = k > 0 && k < GRID ? (p->target[0] - p->start[0]) / T : 0.0;
        z[2] = 1.0;
    }
    CU_ASSERT_EQUAL_FATAL(dal__direct_open(&w->d, grid), DAL_STATUS_OK);
}

/* Its cost after some iterations; the multipliers are in d. */
static double iterate_directly(directly *w, const char *system, dal_effort effort, double T,
                               double x, int iterations)
{
    double S = 0.0;
    steered_open(&w->s, system, effort, "gauss4", T / GRID);
    open_directly(w, T, x);
    for (int i = 0; i < iterations; i++) CU_ASSERT_EQUAL(dal__direct_iterate(&w->d), DAL_STATUS_OK);
    for (int k = 0; k < GRID; k++) S += w->grid.end[k * w->p.dimension + 5];
    return S;
}

static void close_directly(directly *w)
{
    dal__direct_close(&w->d);
    dal__shooting_close(&w->grid);
    dal__problem_close(&w->p);
    steered_close(&w->s);
}

/* x'' = u by constant u in each of N pieces, rest to rest: S = 6 d^2/T^3 N^2/(N^2 - 1), which the
 * first iteration finds and the others keep.  Newton's method would repair what is wrong here. */
static void test_direct(void)
{
    const double T = 1.5, least = 6.0 * 0.49 / (T * T * T) * GRID * GRID / (GRID * GRID - 1.0);
    for (int iterations = 2; iterations <= 5; iterations += 3) {
        directly w;
        const double S = iterate_directly(&w, "coordinates: [x]\nlagrangian: x'^2/2\n",
                                          DAL_EFFORT_IDENTITY, T, 0.7, iterations);
        CU_ASSERT_DOUBLE_EQUAL(S, least, 1e-5 * least);
        close_directly(&w);
    }
}

/* A piece that cannot begin has no end, not the one that it had before. */
static void test_pieces(void)
{
    directly w;
    iterate_directly(&w, "coordinates: [x]\nlagrangian: x'^2/2\n", DAL_EFFORT_IDENTITY, 1.5, 0.7,
                     1);
    dal__shooting *const grid = &w.grid;
    double *const x = grid->point + 3 * w.p.dimension;
    CU_ASSERT_EQUAL(dal__shooting_move(grid, grid->point, grid->end), DAL_STATUS_OK);
    *x = NAN;
    CU_ASSERT_EQUAL(dal__shooting_move(grid, grid->point, grid->end), DAL_STATUS_NOT_FINITE);
    close_directly(&w);
}

/* Nothing is found by derivatives that could not be evaluated. */
static void test_failing_derivatives(void)
{
    directly w;
    const dal_system *tangent;
    steered_open(&w.s, "coordinates: [x]\nlagrangian: x'^2/2\n", DAL_EFFORT_IDENTITY, "gauss4",
                 1.5 / GRID);
    CU_ASSERT_EQUAL_FATAL(dal_model_tangent(w.s.model, &tangent, NULL), DAL_STATUS_OK);
    /* It is the model's, which a caller cannot change. */
    *(dal_system *)(void *)(size_t)(const void *)tangent = failing_system(tangent, NULL);
    open_directly(&w, 1.5, 0.7);
    failing_begin(1, LONG_MAX);
    CU_ASSERT_EQUAL(dal__direct_iterate(&w.d), DAL_STATUS_IO);
    failing_begin(0, 0);
    CU_ASSERT_EQUAL(dal__direct_iterate(&w.d), DAL_STATUS_OK);
    close_directly(&w);
}

/* The same cart by y = e^x, whose cost depends on x: effort mass does not depend on coordinates, so
 * that S and the momentum of x at the start, (6 d/T^2) e^x, are as with y, to 1/N^2. */
static void test_direct_of_state(void)
{
    const double T = 1.5, d_y = exp(1.0) - 1.0;
    directly w;
    const double S = iterate_directly(&w, "coordinates: [x]\nlagrangian: exp(2*x)*x'^2/2\n",
                                      DAL_EFFORT_MASS, T, 1.0, 12);
    const double S_y = 6.0 * d_y * d_y / (T * T * T), pi_y = 6.0 * d_y / (T * T);
    const double grid_error = 3.0 / (GRID * GRID); /* u is constant in each piece */
    CU_ASSERT_DOUBLE_EQUAL(S, S_y, grid_error * S_y);
    CU_ASSERT_DOUBLE_EQUAL(w.d.costate[1] / w.p.unit[1], pi_y, grid_error * pi_y);
    CU_ASSERT(w.d.change < 1e-9);
    close_directly(&w);
}

/* Straight by d: 6 m d^2/T^3.  A turn by theta: 6 I theta^2/T^3.  Both start where to first order
 * the sleigh cannot move sideways. */
static void test_sleigh(void)
{
    const double T = 1.5, d = 0.7, theta = 1.1;
    const dal_setting straight[] = {{"x", d}, {"y", 0.0}, {"phi", 0.0}};
    const dal_setting turn[] = {{"x", 0.0}, {"y", 0.0}, {"phi", theta}};
    steered s;
    steered_open(&s, steered_sleigh, DAL_EFFORT_CONSTRAINT, "gauss8", 0.015);
    steered_find(&s, T, straight, 3);
    CU_ASSERT_DOUBLE_EQUAL(s.best->S, 6.0 * 1.3 * d * d / (T * T * T), 1e-12);
    CU_ASSERT(s.steering->has_growth && s.steering->growth.rank[1] == 3);
    CU_ASSERT_EQUAL(s.steering->allowed, 5);
    steered_find(&s, T, turn, 3);
    CU_ASSERT_DOUBLE_EQUAL(s.best->S, 6.0 * 0.7 * theta * theta / (T * T * T), 1e-12);
    steered_close(&s);
}

/* A motion to the side: a run from its start, alone, ends at the target; D is kept by Gauss's
 * method, momenta at the start are orthogonal to the gradients of D. */
static void test_parking(void)
{
    const dal_setting target[] = {{"x", 0.4}, {"y", 1.0}, {"phi", 0.5}};
    steered s;
    steered_open(&s, steered_sleigh, DAL_EFFORT_CONSTRAINT, "gauss8", 0.02);
    steered_find(&s, 2.0, target, 3);
    const double *z = steered_row(&s, 0);
    CU_ASSERT_EQUAL(s.best->rank, 5);
    CU_ASSERT(s.best->max_D <= 1e-13);
    CU_ASSERT(s.best->condition > 1.0 && s.best->condition < 1e8);
    /* D = x' sin phi - y' cos phi at rest, phi = 0: its gradient is along y' */
    CU_ASSERT_DOUBLE_EQUAL(z[11], 0.0, 1e-9);
    s.spec.start_count = 0;
    dal_run *run = fixture_run(&s.spec);
    CU_ASSERT_EQUAL(dal_run_set_state(run, 0.0, z, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(run, 100, NULL), DAL_STATUS_OK);
    for (int i = 0; i < 3; i++) {
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[i], target[i].value, 1e-10);
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[3 + i], 0.0, 1e-10);
    }
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[13], s.best->S, 1e-9 * s.best->S);
    CU_ASSERT_DOUBLE_EQUAL(s.steering->t[100], 2.0, 0.0);
    dal_run_free(run);
    steered_close(&s);
}

/* Straight to the side: the line is no guess to first order, since it is symmetric; of the motions
 * that bent ones lead to two are mirror images, and the others cost more. */
static void test_starts(void)
{
    const dal_setting target[] = {{"x", 0.0}, {"y", 1.0}, {"phi", 0.0}};
    steered s;
    if (case_stride(2) > 1) return; /* as many steps as all other tests */
    steered_open(&s, steered_sleigh, DAL_EFFORT_CONSTRAINT, "gauss4", 0.08);
    s.settings.starts = 6;
    steered_find(&s, 2.0, target, 3);
    CU_ASSERT(s.steering->count > 1 && s.steering->count <= 6);
    const dal_extremal *other = s.best + 1;
    CU_ASSERT_EQUAL(other->status, DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(other->S, s.best->S, 1e-9 * s.best->S);
    double side = 0.0;
    for (int row = 0; row < s.steering->rows; row++) {
        const double x = steered_row(&s, row)[0];
        side = fmax(side, fabs(x));
        CU_ASSERT_DOUBLE_EQUAL(other->z[row * 14], -x, 1e-7);
    }
    CU_ASSERT(side > 0.01);
    for (int i = 0; i < 2; i++) {
        CU_ASSERT_EQUAL(s.best[i].conjugate_times, 0);
        CU_ASSERT(isnan(s.best[i].first_conjugate));
    }
    for (int i = 1; i < s.steering->count; i++)
        if (s.best[i].status == DAL_STATUS_OK) CU_ASSERT(s.best[i].S >= s.best[i - 1].S);
    steered_close(&s);
}

/* Aiming: a ball's velocity in closed form; a sleigh goes on a circle, whose chord has half the
 * angle. */
static void test_aim(void)
{
    static const char ball[] = "coordinates: [x, y]\nparameters: {g: 9}\n"
                               "lagrangian: (x'^2 + y'^2)/2 - g*y\n";
    const dal_setting target[] = {{"x", 3.0}, {"y", 1.0}};
    const double T = 1.5;
    steered s;
    steered_open(&s, ball, DAL_EFFORT_IDENTITY, "gauss4", 0.015);
    s.settings.rest = false;
    s.settings.aim = true;
    steered_find(&s, T, target, 2);
    CU_ASSERT_EQUAL(s.steering->dimension, 4);
    CU_ASSERT_EQUAL(s.steering->inputs, 0);
    CU_ASSERT_DOUBLE_EQUAL(steered_row(&s, 0)[2], 2.0, 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(steered_row(&s, 0)[3], (1.0 + 4.5 * T * T) / T, 1e-11);
    CU_ASSERT_EQUAL(s.best->S, 0.0);
    steered_close(&s);
    steered_open(&s, steered_sleigh, DAL_EFFORT_CONSTRAINT, "gauss8", 0.015);
    s.settings.rest = false;
    s.settings.aim = true;
    steered_find(&s, T, target, 2);
    const double turn = 2.0 * atan2(1.0, 3.0), radius = sqrt(10.0) / 2.0 / sin(turn / 2.0);
    CU_ASSERT_DOUBLE_EQUAL(steered_row(&s, 0)[5], turn / T, 1e-10);
    CU_ASSERT_DOUBLE_EQUAL(steered_row(&s, 0)[3], radius * turn / T, 1e-10);
    CU_ASSERT_DOUBLE_EQUAL(steered_row(&s, 0)[4], 0.0, 1e-12);
    steered_close(&s);
}

/* ---- vakonomic motion ---- */

static const char plane[] = "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2)/2\n"
                            "constraints: [z' - (x*y' - y*x')/2]\nmechanics: vakonomic\n";

/* A loop from the origin to itself around an area A is a circle, S = 2 pi A/T (Dido). */
static void test_loop(void)
{
    const dal_setting target[] = {{"x", 0.0}, {"y", 0.0}, {"z", 0.3}};
    const double T = 1.5, pi = acos(-1.0), radius = sqrt(0.3 / pi);
    steered s;
    steered_open(&s, plane, DAL_EFFORT_IDENTITY, "gauss8", 0.03);
    s.settings.rest = false;
    s.settings.starts = 3; /* to first order the straight line, a point, encloses nothing */
    steered_find(&s, T, target, 3);
    CU_ASSERT_EQUAL(s.steering->dimension, 7);
    CU_ASSERT_DOUBLE_EQUAL(s.best->S, 2.0 * pi * 0.3 / T, 1e-11);
    CU_ASSERT(s.best->max_D <= 1e-13 && s.best->rank == -1 && s.best->conjugate_times == -1);
    CU_ASSERT_DOUBLE_EQUAL(fabs(steered_row(&s, 50)[6]), 2.0 * pi / T,
                           1e-10); /* |x'| = |g| radius */
    CU_ASSERT_DOUBLE_EQUAL(hypot(steered_row(&s, 0)[3], steered_row(&s, 0)[4]),
                           2.0 * pi * radius / T, 1e-10);
    const double *opposite = steered_row(&s, 25);
    CU_ASSERT_DOUBLE_EQUAL(hypot(opposite[0], opposite[1]), 2.0 * radius, 1e-10);
    steered_close(&s);
}

/* Where the straight line leads nowhere further guesses are made; a circle that is gone through k
 * times has k times the action. */
static void test_further_guesses(void)
{
    const dal_setting target[] = {{"x", 0.0}, {"y", 0.0}, {"z", 0.3}};
    steered s;
    steered_open(&s, plane, DAL_EFFORT_IDENTITY, "gauss8", 0.03);
    s.settings.rest = false;
    steered_find(&s, 1.5, target, 3);
    CU_ASSERT_EQUAL(s.steering->count, 1);
    const double times = s.best->S / (2.0 * acos(-1.0) * 0.3 / 1.5);
    CU_ASSERT(times > 0.5);
    CU_ASSERT_DOUBLE_EQUAL(times, nearbyint(times), 1e-10);
    steered_close(&s);
}

/* An elastic rod of length T between pins, its angles being free there: phi moves as a pendulum
 * from k = sin(phi(0)/2) to the other side; with omega T = 2 K and the complete integrals K, E of
 * modulus k the chord is (2 E/K - 1) T and S = 4 omega (E - (1 - k^2) K). */
static void test_elastica(void)
{
    enum { POINTS = 64 };
    static const char rod[] = "coordinates: [x, y, phi]\nlagrangian: phi'^2/2\n"
                              "constraints: [x' - cos(phi), y' - sin(phi)]\n"
                              "mechanics: vakonomic\n";
    static const char *const frees[] = {"phi"};
    const double T = 1.5, angle = 1.2, k = sin(angle / 2.0), pi = acos(-1.0);
    double K = 0.0, E = 0.0;
    for (int i = 0; i < POINTS; i++) { /* exact to rounding, being periodic */
        const double w = sqrt(1.0 - pow(k * sin(pi * (i + 0.5) / POINTS), 2.0));
        K += pi / 2.0 / POINTS / w;
        E += pi / 2.0 / POINTS * w;
    }
    const dal_setting target[] = {{"x", (2.0 * E / K - 1.0) * T}, {"y", 0.0}};
    steered s;
    steered_open(&s, rod, DAL_EFFORT_IDENTITY, "gauss8", 0.03);
    s.settings.rest = false;
    s.settings.free_starts = frees;
    s.settings.frees = 1;
    s.settings.starts = 4; /* the straight rod buckles to both sides */
    steered_find(&s, T, target, 2);
    CU_ASSERT_DOUBLE_EQUAL(s.best->S, 8.0 * K / T * (E - (1.0 - k * k) * K), 1e-10);
    CU_ASSERT_DOUBLE_EQUAL(fabs(steered_row(&s, 0)[2]), angle, 1e-10);
    CU_ASSERT_DOUBLE_EQUAL(steered_row(&s, 0)[5], 0.0, 1e-12); /* the momentum of phi */
    CU_ASSERT_DOUBLE_EQUAL(steered_row(&s, 50)[5], 0.0, 1e-12);
    steered_close(&s);
}

/* Each allocation fails once; a model whose memory has failed is not used again. */
static void fail_allocations(const char *system, dal_effort effort, const dal_setting *target)
{
    allocation_trial trial = {0};
    while (allocation_next(&trial)) {
        steered s;
        steered_open(&s, system, effort, "rk4", 0.5);
        s.settings.rest = effort != DAL_EFFORT_IDENTITY;
        s.settings.target = target;
        s.settings.targets = 3;
        allocation_start(&trial);
        allocation_end(
            &trial, dal_steer_create(&s.steering, s.model, &s.spec, 1.0, &s.settings, NULL, NULL));
        steered_close(&s);
        if (!trial.passed && !trial.is_single) trial.failures += case_stride(9) - 1;
    }
    CU_ASSERT(trial.failures >= 20);
}

static void test_out_of_memory(void)
{
    const dal_setting target[] = {{"x", 0.2}, {"y", 0.0}, {"phi", 0.0}};
    const dal_setting area[] = {{"x", 0.2}, {"y", 0.3}, {"z", 0.1}};
    const dal_setting along[] = {{"x", 0.2}, {"y", 0.2}, {"z", 0.1}};
    static const char integrable[] = "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n"
                                     "constraints: [x' - y']\n";
    static const char driven[] = "coordinates: [x, y, phi]\n"
                                 "lagrangian: (x'^2 + y'^2 + phi'^2)/2\n"
                                 "constraints: [x'*sin(phi) - y'*cos(phi)]\n"
                                 "controls: [{x: cos(phi), y: sin(phi)}, {phi: 1}]\n";
    fail_allocations(steered_sleigh, DAL_EFFORT_CONSTRAINT, target);
    fail_allocations(plane, DAL_EFFORT_IDENTITY, area);
    fail_allocations(integrable, DAL_EFFORT_CONSTRAINT, along);
    fail_allocations(driven, DAL_EFFORT_CONTROLS, target);
}

/* ---- arguments ---- */

FUNCTIONS_dalembert_steer(DECLARE_NULL_TEST)

    static void null_dal_steer_create(void)
{
    dal_model *model;
    dal_run_spec spec;
    static const dal_setting target = {"y1", 0.1};
    static const char *const free_names[] = {NULL};
    dal_steering *s = NULL;
    dal_steer_settings settings = dal_steer_settings_default(), bad;
    settings.target = &target;
    settings.targets = 1;
    CU_ASSERT_EQUAL_FATAL(open_spec(&model, &spec), DAL_STATUS_OK);
    REFUSED(dal_steer_create(NULL, model, &spec, 1.0, &settings, NULL, error));
    REFUSED(dal_steer_create(&s, NULL, &spec, 1.0, &settings, NULL, error));
    REFUSED(dal_steer_create(&s, model, &spec, 1.0, NULL, NULL, error));
    REFUSED(dal_steer_create(&s, model, &spec, NAN, &settings, NULL, error));
    for (int i = 0; i < BAD_SPECS; i++)
        REFUSED(dal_steer_create(&s, model, spoil_spec(&spec, i), 1.0, &settings, NULL, error));
    for (int i = 0; i < 8; i++) {
        bad = settings;
        if (i == 0) bad.target = NULL;
        if (i == 1) bad.targets = -1;
        if (i == 2) bad.target = nameless;
        if (i == 3) bad.frees = 1;
        if (i == 4) bad.frees = 1, bad.free_starts = free_names;
        if (i == 5) bad.starts = 0;
        if (i == 6) bad.iterations = 0;
        if (i == 7) bad.tolerance = 0.0;
        REFUSED(dal_steer_create(&s, model, &spec, 1.0, &bad, NULL, error));
    }
    CU_ASSERT_PTR_NULL(s);
    dal_model_free(model);
}

static void null_dal_steer_free(void) { dal_steer_free(NULL); }
static void null_dal_steer_settings_default(void)
{
    CU_ASSERT_EQUAL(dal_steer_settings_default().starts, 1);
}

void suite_steer(void)
{
    CU_pSuite suite = CU_add_suite("boundary values of the lift", NULL, NULL);
    CU_add_test(suite, "a linear problem, closed form", test_gramian);
    CU_add_test(suite, "free ends, closed form", test_free_ends);
    CU_add_test(suite, "Gauss-Newton alone", test_direct);
    CU_add_test(suite, "pieces of a motion", test_pieces);
    CU_add_test(suite, "derivatives that fail", test_failing_derivatives);
    CU_add_test(suite, "Gauss-Newton where the cost depends on q", test_direct_of_state);
    CU_add_test(suite, "a sleigh straight and turned, closed form", test_sleigh);
    CU_add_test(suite, "a sleigh to the side", test_parking);
    CU_add_test(suite, "several first guesses", test_starts);
    CU_add_test(suite, "aiming, closed form", test_aim);
    CU_add_test(suite, "a vakonomic loop, closed form", test_loop);
    CU_add_test(suite, "further guesses", test_further_guesses);
    CU_add_test(suite, "an elastic rod, closed form", test_elastica);
    CU_add_test(suite, "out of memory", test_out_of_memory);
    FUNCTIONS_dalembert_steer(ADD_NULL_TEST)
}
