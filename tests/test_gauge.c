/* test_gauge.c - mu_e(q, v, e, t) of the lift: closed forms, orders, symplecticity, the same bits
 * of (q, v) in every gauge, and steps that cannot be solved. */
#include "fixtures.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { MAX = 64 };

/* A force of q and v, and one of q alone. */
static const char sleigh[] =
    "coordinates: [x, y, phi]\nparameters: {m: 2, I: 3}\n"
    "lagrangian: m/2*(x'^2 + y'^2) + I/2*phi'^2\nconstraints: [x'*sin(phi) - y'*cos(phi)]\n"
    "controls: [{x: cos(phi), y: sin(phi)}, {phi: 5, x: sin(phi), y: -cos(phi)}]\n"
    "start: {x': 0.5, phi': 0.3}\n";
static const char positional[] = "coordinates: [x, y]\nlagrangian: x'^2/2 + y'^2 - cos(x)*y^2\n"
                                 "start: {x: 0.4, y: 0.7, y': 0.3}\n";
static const char *const gauges[] = {
    "e = 1.5, mu_e = 0.3*sin(x)*y' - 0.2*e*phi' + 0.1*e^2/(1 + x^2) + 0.1*cos(t)",
    "e = 1.5, mu_e = 0.3*sin(x)*y' - 0.2*e*x' + 0.1*e^2/(1 + y^2) + 0.1*cos(t)"};

static const struct {
    const char *name;
    int order, steps, is_symplectic; /* of (q, v, e, p, pi, pi_e), where p and pi are not 0 */
} methods[] = {
    {"symplectic-euler-00", 1, 40, 1},
    {"symplectic-euler-10", 1, 40, 1},
    {"symplectic-euler-01", 1, 40, 1},
    {"symplectic-euler-11", 1, 40, 1},
    {"stormer-verlet", 2, 20, 1},
    {"implicit-midpoint", 2, 20, 1},
    {"rk4+lift", 2, 20, 1},
    {"dop853+lift", 2, 20, 1},
    {"rk4", 4, 20, 0},
    {"gauss4", 4, 10, 1},
    {"lobatto4", 4, 10, 1},
    {"mclachlan4", 4, 10, 1},
    {"stormer-verlet+yoshida4", 4, 20, 1},
    {"gauss6", 6, 6, 1},
    {"lobatto6", 6, 6, 1},
    {"bm6", 6, 10, 1},
    {"gauss8", 8, 3, 1},
    {"lobatto8", 8, 3, 1},
    {"dop853", 8, 3, 0},
    {"taylor", 10, 3, 0},
};
enum { METHODS = sizeof methods / sizeof *methods };

static dal_model *model_with(const char *text, const char *gauge, const dal_system **system)
{
    dal_model *model = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_model_read(&model, "test", text, strlen(text), NULL), DAL_STATUS_OK);
    if (text == sleigh)
        CU_ASSERT_EQUAL(dal_model_set_effort(model, DAL_EFFORT_CONTROLS, NULL), DAL_STATUS_OK);
    if (gauge) CU_ASSERT_EQUAL(dal_model_set_gauge(model, gauge, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_model_system(model, system, NULL), DAL_STATUS_OK);
    return model;
}

/* The state at time 1 after count steps, from p, pi and pi_e of the given size. */
static void end_state(dal_run_spec spec, int count, double size, double *state)
{
    const int n = spec.system->n;
    spec.options.step = 1.0 / count;
    dal_run *run = fixture_run(&spec);
    memcpy(state, dal_run_state(run), (size_t)(4 * n + 2) * sizeof *state);
    for (int i = 2 * n + 1; i < 4 * n + 2; i++) state[i] = size * (1.0 - 0.2 * i);
    CU_ASSERT_EQUAL(dal_run_set_state(run, 0.0, state, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(run, count, NULL), DAL_STATUS_OK);
    memcpy(state, dal_run_state(run), (size_t)(4 * n + 2) * sizeof *state);
    dal_run_free(run);
}

/* ---- closed forms ---- */

/* x' = b for ever: mu_e = a e + c sin(x) has e' - a e = c sin(b t).  From p = pi = 0 and a pi_e so
 * small that pi does not move x, pi_e = pi_e(0) exp(-a t), p' = -c cos(x) pi_e and pi' = -p. */
static void free_particle(double t, double pi_e, double *y)
{
    const double a = 0.4, b = 0.8, c = 0.3, scale = c / (a * a + b * b);
    const double decay = exp(-a * t), sine = sin(b * t), cosine = cos(b * t);
    y[0] = b * t;
    y[1] = b;
    y[2] = (1.0 + scale * b) * exp(a * t) - scale * (a * sine + b * cosine);
    y[3] = -pi_e * scale * (a + decay * (b * sine - a * cosine));
    /* the integral of decay (b sin - a cos) is -decay (2 a b sin(b t) + (b^2 - a^2) cos)/(..) */
    const double square = a * a + b * b;
    const double integral =
        ((b * b - a * a) - decay * (2.0 * a * b * sine + (b * b - a * a) * cosine)) / square;
    y[4] = pi_e * scale * (a * t + integral);
    y[5] = pi_e * decay;
}

/* The action of Caldirola and Kanai's free particle has the weight e = exp(k t), mu_e = k e:
 * pi = pi(0) - p t, v' = pi exp(-k t), (pi_e exp(k t))' = pi^2 exp(-k t)/2. */
static void weighted_particle(double t, const double *start, double *y)
{
    const double k = 0.7, p = start[3], pi = start[4], w = exp(-k * t);
    const double i0 = (1.0 - w) / k, i1 = (i0 - t * w) / k, i2 = (2.0 * i1 - t * t * w) / k;
    y[1] = start[1] + pi * i0 - p * i1;
    y[2] = 1.0 / w;
    y[3] = p;
    y[4] = pi - p * t;
    y[5] = w * (start[5] + 0.5 * (pi * pi * i0 - 2.0 * pi * p * i1 + p * p * i2));
}

static void check_particle(const char *method, bool weighted)
{
    static const char text[] = "coordinates: [x]\naccelerations: {x: 0}\nstart: {x': 0.8}\n";
    const double small = 1e-18, start[] = {0.0, 0.8, 1.0, 0.3, -0.5, 0.2};
    const double surface[] = {0.0, 0.8, 1.0, 0.0, 0.0, small};
    const dal_system *system;
    dal_model *model =
        model_with(text, weighted ? "mu_e = 0.7*e" : "mu_e = 0.4*e + 0.3*sin(x)", &system);
    const dal_run_spec spec = fixture_spec(system, method, DAL_LIFTED, 1.0 / 32.0);
    double y[6];
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_set_state(run, 0.0, weighted ? start : surface, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(run, 32, NULL), DAL_STATUS_OK);
    if (weighted)
        weighted_particle(1.0, start, y);
    else
        free_particle(1.0, small, y);
    for (int i = weighted; i < 6; i++)
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[i], y[i],
                               !weighted && i > 2 ? 1e-12 * small : 1e-13);
    dal_run_free(run);
    dal_model_free(model);
}

static void test_closed_forms(void)
{
    const char *const exact[] = {"gauss12", "lobatto8", "gauss10", "taylor"};
    for (int k = 0; k < 4; k++)
        for (int weighted = 0; weighted < 2; weighted++) check_particle(exact[k], weighted);
}

/* ---- orders, symplecticity, H ---- */

/* The largest error of the canonical variables at time 1. */
static double error_of(dal_run_spec spec, int count, const double *reference)
{
    double state[MAX], error = 0.0;
    end_state(spec, count, 0.3, state);
    for (int i = 0; i < 4 * spec.system->n + 2; i++)
        error = fmax(error, fabs(state[i] - reference[i]));
    return error;
}

/* All canonical variables have the order of the method, against Dormand and Prince's explicit
 * method of order 8. */
static void test_orders(void)
{
    for (int s = 0; s < 2; s++) {
        const dal_system *system;
        dal_model *model = model_with(s ? positional : sleigh, gauges[s], &system);
        double reference[MAX];
        end_state(fixture_spec(system, "dop853", DAL_LIFTED, 1.0), 200, 0.3, reference);
        for (int k = 0; k < METHODS; k++) {
            const dal_run_spec spec = fixture_spec(system, methods[k].name, DAL_LIFTED, 1.0);
            const double coarse = error_of(spec, methods[k].steps, reference);
            const double fine = error_of(spec, 2 * methods[k].steps, reference);
            const double order = log2(coarse / fine), excess = order - methods[k].order;
            if (!(excess > -0.4 && excess < 1.0))
                printf("\n  system %d, %s: %.2e, %.2e\n", s, methods[k].name, coarse, fine);
            CU_ASSERT(excess > -0.4 && excess < 1.0);
        }
        dal_model_free(model);
    }
}

static void test_symplectic(void)
{
    for (int s = 0; s < 2; s++) {
        const dal_system *system;
        dal_model *model = model_with(s ? positional : sleigh, gauges[s], &system);
        for (int k = 0; k < METHODS; k++) {
            const dal_run_spec spec = fixture_spec(system, methods[k].name, DAL_LIFTED, 0.1);
            double state[MAX], defect = NAN;
            end_state(spec, 4, 0.3, state);
            CU_ASSERT_EQUAL(dal_check_symplecticity(&spec, 0.0, state, 0.0, &defect, NULL),
                            DAL_STATUS_OK);
            if (methods[k].is_symplectic && !(defect <= 1e-9))
                printf("\n  system %d, %s: %.2e\n", s, methods[k].name, defect);
            CU_ASSERT(!methods[k].is_symplectic || defect <= 1e-9);
        }
        dal_model_free(model);
    }
}

/* Where mu_e does not depend on t, H is an integral. */
static void test_hamiltonian(void)
{
    const char *const exact[] = {"gauss12", "lobatto8", "taylor"};
    const dal_system *system;
    dal_model *model =
        model_with(sleigh, "mu_e = 0.3*sin(x)*y' - 0.2*e*phi' + 0.1*e^2/(1 + x^2)", &system);
    for (int k = 0; k < 3; k++) {
        const dal_run_spec spec = fixture_spec(system, exact[k], DAL_LIFTED, 1.0 / 64.0);
        double state[MAX];
        end_state(spec, 4, 0.3, state);
        dal_run *run = fixture_run(&spec);
        CU_ASSERT_EQUAL(dal_run_set_state(run, 0.0, state, NULL), DAL_STATUS_OK);
        fixture_keeps_H(run, 64);
        dal_run_free(run);
    }
    dal_model_free(model);
}

/* ---- bits ---- */

/* The state after 20 steps from p = pi = pi_e = 0, which they stay. */
static void surface_state(const char *text, const char *gauge, int k, double *state)
{
    const dal_system *system;
    dal_model *model = model_with(text, gauge, &system);
    const int n = system->n;
    dal_run_spec spec = fixture_spec(system, methods[k].name, DAL_LIFTED, 1.0);
    if (k % 2) spec.options.solver = DAL_NEWTON;
    end_state(spec, 20, 0.0, state);
    for (int i = 2 * n + 1; i < 4 * n + 2; i++) CU_ASSERT_EQUAL(state[i], 0.0);
    dal_model_free(model);
}

/* On p = pi = pi_e = 0 no gauge changes a bit of (q, v). */
static void test_surface(void)
{
    for (int k = 0; k < METHODS; k++) {
        double states[2][MAX];
        for (int gauge = 0; gauge < 2; gauge++)
            surface_state(sleigh, gauge ? gauges[0] : NULL, k, states[gauge]);
        CU_ASSERT(memcmp(states[0], states[1], 6 * sizeof(double)) == 0);
        for (int gauge = 0; gauge < 2; gauge++)
            surface_state(positional, gauge ? gauges[1] : NULL, k, states[gauge]);
        CU_ASSERT(memcmp(states[0], states[1], 4 * sizeof(double)) == 0);
    }
}

/* With a gauge of the state lanes have the bits of single runs, and quad precision agrees. */
static void test_forms(void)
{
    const dal_system *system;
    dal_model *model = model_with(sleigh, gauges[0], &system);
    for (int k = 0; k < METHODS; k += case_stride(3)) {
        dal_run_spec spec = fixture_spec(system, methods[k].name, DAL_LIFTED, 0.05);
        double states[2][MAX];
        const dal_setting start[] = {{"pi_y", 0.4}, {"p_phi", -0.2}, {"pi_e", 0.3}};
        spec.start = start;
        spec.start_count = 3;
        fixture_lanes(spec, 9, 20, "pi_x", 0.3, 0.02);
        if (!system->quad) continue;
        for (int quad = 0; quad < 2; quad++) {
            spec.options.precision = quad ? DAL_QUAD : DAL_DOUBLE;
            end_state(spec, 20, 0.3, states[quad]);
        }
        for (int i = 0; i < 4 * system->n + 2; i++)
            CU_ASSERT_DOUBLE_EQUAL(states[0][i], states[1][i], 2e-14);
    }
    dal_model_free(model);
}

/* A checkpoint in the middle of a run continues to the same bits. */
static void test_resumed(void)
{
    const dal_system *system;
    dal_model *model = model_with(sleigh, gauges[0], &system);
    for (int k = 0; k < METHODS; k += case_stride(4)) {
        dal_run_spec spec = fixture_spec(system, methods[k].name, DAL_LIFTED, 0.05);
        const dal_setting start[] = {{"pi_x", 0.4}, {"p_phi", -0.2}, {"pi_e", 0.3}};
        spec.start = start;
        spec.start_count = 3;
        dal_run *run = fixture_stepped(&spec, 7), *other = fixture_run(&spec);
        size_t count;
        const double *saved = dal_run_save(run, &count);
        CU_ASSERT_EQUAL(dal_run_restore(other, saved, count, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_advance(run, 9, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_advance(other, 9, NULL), DAL_STATUS_OK);
        CU_ASSERT(memcmp(dal_run_state(run), dal_run_state(other),
                         (size_t)dal_run_dimension(run) * sizeof(double)) == 0);
        dal_run_free(run);
        dal_run_free(other);
    }
    dal_model_free(model);
}

/* Where F depends on q and t alone a step of stormer-verlet evaluates it once, and has the bits of
 * two steps of symplectic Euler, which evaluate it once each; sums are plain, so that these have no
 * more than their state. */
static void test_leapfrog(void)
{
    static const char *const names[] = {"stormer-verlet", "symplectic-euler-10",
                                        "symplectic-euler-01"};
    enum { STEPS = 20, DIM = 10 };
    const double h = 0.0625;
    const dal_system *system;
    dal_model *model = model_with(positional, gauges[1], &system);
    dal_run *run[3];
    double state[DIM], t = 0.0;
    for (int k = 0; k < 3; k++) {
        dal_run_spec spec = fixture_spec(system, names[k], DAL_LIFTED, k == 0 ? h : 0.5 * h);
        spec.options.sums = DAL_SUMS_PLAIN;
        run[k] = fixture_run(&spec);
    }
    fixture_perturb(run[0], 0.3);
    memcpy(state, dal_run_state(run[0]), sizeof state);
    const long long before = dal_run_evaluations(run[0]);
    CU_ASSERT_EQUAL(dal_run_advance(run[0], STEPS, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_evaluations(run[0]) - before, STEPS);
    for (int half = 0; half < 2 * STEPS; half++) {
        dal_run *const euler = run[1 + half % 2];
        CU_ASSERT_EQUAL(dal_run_set_state(euler, t, state, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_advance(euler, 1, NULL), DAL_STATUS_OK);
        memcpy(state, dal_run_state(euler), sizeof state);
        t += 0.5 * h;
    }
    CU_ASSERT(memcmp(state, dal_run_state(run[0]), sizeof state) == 0);
    for (int k = 0; k < 3; k++) dal_run_free(run[k]);
    dal_model_free(model);
}

/* ---- failures ---- */

/* e1 = e + h (5 e1^2 + 5) has no real solution from e = 1 for h = 1/2, nor have the stages: the
 * step fails as others do that cannot be solved; with a smaller mu_e it is taken. */
static void test_unsolved(void)
{
    static const char text[] = "coordinates: [x]\naccelerations: {x: -sin(x) - x'}\n"
                               "start: {x: 1}\nparameters: {c: 5}\n";
    const char *const implicit[] = {"symplectic-euler-10", "symplectic-euler-11", "gauss4",
                                    "implicit-midpoint", "lobatto6"};
    const dal_system *system;
    dal_model *model = model_with(text, "mu_e = c*(e^2 + 1)", &system);
    for (int k = 0; k < 5; k++) {
        dal_error error = {0};
        dal_run_spec spec = fixture_spec(system, implicit[k], DAL_LIFTED, 0.5);
        CU_ASSERT_EQUAL(fixture_failed_step(&spec, &error), DAL_STATUS_NOT_CONVERGED);
        const dal_setting slow[] = {{"c", 0.1}};
        spec.parameters = slow;
        spec.parameter_count = 1;
        dal_run *run = fixture_stepped(&spec, 1);
        dal_run_free(run);
    }
    dal_model_free(model);
}

void suite_gauge(void);
void suite_gauge(void)
{
    CU_pSuite suite = CU_add_suite("gauge of the state", NULL, NULL);
    CU_ADD_TEST(suite, test_closed_forms);
    CU_ADD_TEST(suite, test_orders);
    CU_ADD_TEST(suite, test_symplectic);
    CU_ADD_TEST(suite, test_hamiltonian);
    CU_ADD_TEST(suite, test_surface);
    CU_ADD_TEST(suite, test_forms);
    CU_ADD_TEST(suite, test_resumed);
    CU_ADD_TEST(suite, test_leapfrog);
    CU_ADD_TEST(suite, test_unsolved);
}
