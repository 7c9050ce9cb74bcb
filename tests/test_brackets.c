/* test_brackets.c - measures of the lift: brackets, actions. */
#include "core/vectors.h"
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <string.h>

/* ---- brackets ---- */

/* z = (x, y, z; p_x, p_y, p_z): components of x cross p. */
static double angular(void *user, const double *z)
{
    const int i = *(int *)user, j = (i + 1) % 3, k = (i + 2) % 3;
    return z[j] * z[3 + k] - z[k] * z[3 + j];
}

static void test_brackets(void)
{
    double z[] = {0.3, -0.7, 1.1, 0.9, 0.2, -0.4}, gradient[3][6];
    const double before = z[4];
    for (int i = 0; i < 3; i++) dal_measure_gradient(angular, &i, 6, z, gradient[i]);
    CU_ASSERT_EQUAL(z[4], before);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        /* {L_i, L_j} = L_k */
        CU_ASSERT_DOUBLE_EQUAL(dal_poisson(gradient[i], gradient[j], 3), angular(&k, z), 1e-12);
        CU_ASSERT_DOUBLE_EQUAL(dal_poisson(gradient[j], gradient[i], 3), -angular(&k, z), 1e-12);
    }
}

/* ---- actions ---- */

/* x = a t^2/2 where the law is x'' = 0: S = e/2 a^2 times the time the inner nodes cover. */
static void test_action_closed_form(void)
{
    enum { NODES = 40 };
    dal_evaluator *evaluator =
        fixture_evaluator(fixture_system("coordinates: [x]\naccelerations: {x: 0}\n"));
    const double h = 0.05, a = 0.7, e = 1.5;
    double x[NODES], action;
    for (int k = 0; k < NODES; k++) x[k] = 0.5 * a * h * k * h * k;
    CU_ASSERT_EQUAL(dal_evaluator_measure_action(evaluator, 0.0, h, NODES, x, e, &action),
                    DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(action, 0.5 * e * a * a * h * (NODES - 9), 1e-11);
    CU_ASSERT_EQUAL(dal_evaluator_measure_action(evaluator, 0.0, h, 9, x, e, &action),
                    DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_evaluator_measure_action(evaluator, 0.0, 0.0, NODES, x, e, &action),
                    DAL_STATUS_ARGUMENT);
    CU_ASSERT_EQUAL(dal_evaluator_measure_action(evaluator, 0.0, h, NODES, x, INFINITY, &action),
                    DAL_STATUS_NOT_FINITE);
    dal_evaluator_free(evaluator);
}

/* On the circle (nh30) the action of the sleigh vanishes; moved by s sin(t) along y1, which changes
 * y1'' - F^1 by terms of order s, it does not. */
static void test_action_of_the_sleigh(void)
{
    enum { NODES = 80 };
    dal_evaluator *evaluator = fixture_evaluator(fixture_system("chaplygin-sleigh"));
    double q[3 * NODES], action[2];
    for (int moved = 0; moved < 2; moved++) {
        for (int k = 0; k < NODES; k++) {
            const double t = 0.02 * k;
            q[3 * k] = sin(t) + moved * 1e-3 * sin(3.0 * t);
            q[3 * k + 1] = 1.0 - cos(t);
            q[3 * k + 2] = t;
        }
        CU_ASSERT_EQUAL(
            dal_evaluator_measure_action(evaluator, 0.0, 0.02, NODES, q, 1.0, &action[moved]),
            DAL_STATUS_OK);
    }
    CU_ASSERT(action[0] < 1e-21);
    CU_ASSERT(action[1] > 1e-6);
    dal_evaluator_free(evaluator);
}

enum { STATES = 12, WIDE = 4 * 4 + 2 };

static void trajectory(const dal_system *system, const char *method, double *states)
{
    const dal_run_spec spec = fixture_spec(system, method, DAL_LIFTED, 0.05);
    dal_run *run = fixture_run(&spec);
    const size_t width = (size_t)dal_run_dimension(run);
    fixture_perturb(run, 0.3);
    for (size_t k = 0; k < STATES; k++) {
        memcpy(states + k * width, dal_run_state(run), width * sizeof *states);
        CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
    }
    dal_run_free(run);
}

/* (nh23) at midpoints is the discrete principle of the implicit midpoint rule and of no other. */
static void test_stationarity(void)
{
    const dal_system *system = fixture_system(fixture_full);
    dal_evaluator *evaluator = fixture_evaluator(system);
    double states[STATES * WIDE], midpoint, other;
    trajectory(system, "gauss4", states);
    CU_ASSERT_EQUAL(dal_evaluator_check_stationarity(evaluator, 0.0, 0.05, STATES, states, &other),
                    DAL_STATUS_OK);
    trajectory(system, "implicit-midpoint", states);
    CU_ASSERT_EQUAL(
        dal_evaluator_check_stationarity(evaluator, 0.0, 0.05, STATES, states, &midpoint),
        DAL_STATUS_OK);
    CU_ASSERT(midpoint < 1e-10);
    CU_ASSERT(other > 1e-6);
    /* One node moved: no longer stationary. */
    states[5 * WIDE + 1] += 1e-4;
    CU_ASSERT_EQUAL(dal_evaluator_check_stationarity(evaluator, 0.0, 0.05, STATES, states, &other),
                    DAL_STATUS_OK);
    CU_ASSERT(other > 1e-4);
    dal_evaluator_free(evaluator);
}

/* Vakonomic motion has no lift, whose actions these are. */
static void test_no_lift(void)
{
    const dal_system *system = fixture_system("chaplygin-sleigh-vakonomic");
    dal_evaluator *evaluator = fixture_evaluator(system);
    double states[STATES * WIDE] = {0.0}, value;
    CU_ASSERT_EQUAL(dal_evaluator_measure_action(evaluator, 0.0, 0.05, 10, states, 1.0, &value),
                    DAL_STATUS_UNSUPPORTED);
    CU_ASSERT_EQUAL(dal_evaluator_check_stationarity(evaluator, 0.0, 0.05, 3, states, &value),
                    DAL_STATUS_UNSUPPORTED);
    dal_evaluator_free(evaluator);
}

void suite_brackets(void)
{
    CU_pSuite suite = CU_add_suite("measures of the lift", NULL, NULL);
    CU_add_test(suite, "brackets", test_brackets);
    CU_add_test(suite, "the action, closed form", test_action_closed_form);
    CU_add_test(suite, "the action of the sleigh", test_action_of_the_sleigh);
    CU_add_test(suite, "the first-order action", test_stationarity);
    CU_add_test(suite, "no lift", test_no_lift);
}
