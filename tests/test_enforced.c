/* test_enforced.c - methods that enforce D = 0, each by the equations that define it. */
#include "fixtures.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Time-dependent and velocity-dependent forces, m = 2, D nonlinear, and a full W that is constant.
 */
static const char forced[] =
    "coordinates: [x, y, z, u]\n"
    "lagrangian: >-\n"
    "  x'^2 + 0.8*y'^2 + 0.7*z'^2 + 1.1*u'^2 + 0.3*x'*y' - 0.2*z'*u' + 0.4*y*x'\n"
    "  - (x^2 + 1.5*y^2 + z^2*y^2/2 + cos(u)) + 0.3*x*sin(t)\n"
    "forces: {x: -0.1*x' + 0.2*sin(2*t), y: 0.3*x'*z, u: -0.2*u'*(1 + x^2) + 0.1*t}\n"
    "constraints:\n"
    "  - z' - y*x' - 0.1*sin(t)\n"
    "  - (u'^2 - x'^2 - y'^2)/2 + 0.1*x*x'\n"
    "start: {y: 0.5, z: 0.3, u: 0.2, x': 0.6, y': 0.8, z': 0.3, u': 1}\n";

/* ---- order, where the fixtures of the conformance suite do not serve ---- */

static void end_state(const dal_system *system, const char *method, int count, double *state)
{
    const dal_run_spec spec = fixture_spec(system, method, DAL_PHYSICAL, 1.0 / count);
    dal_run *run = fixture_stepped(&spec, count);
    memcpy(state, dal_run_state(run), 2 * (size_t)system->n * sizeof *state);
    dal_run_free(run);
}

static void check_order(const char *text, const char *method)
{
    const dal_system *system = fixture_system(text);
    double reference[16], state[16], error[2] = {0.0, 0.0};
    end_state(system, "gauss10", 200, reference);
    for (int k = 0; k < 2; k++) {
        end_state(system, method, 40 << k, state);
        for (int i = 0; i < 2 * system->n; i++)
            error[k] = fmax(error[k], fabs(state[i] - reference[i]));
    }
    const double seen = log2(error[0] / error[1]);
    const dal_method declared = fixture_spec(system, method, DAL_PHYSICAL, 1.0).method;
    if (fabs(seen - 2.0) > 0.1) printf("\n  %s: order %.3f\n", method, seen);
    CU_ASSERT_DOUBLE_EQUAL(seen, 2.0, 0.1);
    CU_ASSERT_EQUAL(dal_method_order(&declared), 2);
}

static void test_order(void)
{
    check_order(forced, "discrete-gradient");
    check_order(fixture_quadratic, "discrete-gradient");
    check_order("isokinetic", "isokinetic-splitting");
    check_order("relativistic-scalar", "isokinetic-splitting");
}

/* ---- D at the midpoints ---- */

static double midpoint_defect(const char *text, const char *method)
{
    const double h = 0.1;
    const dal_system *system = fixture_system(text);
    const dal_run_spec spec = fixture_spec(system, method, DAL_PHYSICAL, h);
    const int n = system->n;
    double q[8], v[8], D[8], defect = 0.0;
    dal_run *run = fixture_run(&spec);
    dal_evaluator *evaluator = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_evaluator_create(&evaluator, system, NULL, 0, NULL), DAL_STATUS_OK);
    for (int k = 0; k < 20; k++) {
        const double t = dal_run_time(run) + 0.5 * h, *state = dal_run_state(run);
        for (int i = 0; i < n; i++) q[i] = state[i];
        CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
        for (int i = 0; i < n; i++) {
            v[i] = (state[i] - q[i]) / h;
            q[i] = 0.5 * (q[i] + state[i]);
        }
        CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, system->constraints, t, q, v, NULL, D),
                        DAL_STATUS_OK);
        for (int a = 0; a < system->m; a++) defect = fmax(defect, fabs(D[a]));
    }
    dal_evaluator_free(evaluator);
    dal_run_free(run);
    return defect;
}

static void test_midpoints(void)
{
    CU_ASSERT(midpoint_defect(fixture_full, "dla") <= 1e-14);
    CU_ASSERT(midpoint_defect(forced, "discrete-gradient") <= 1e-14);
    CU_ASSERT(midpoint_defect(fixture_full, "mclachlan-perlmutter") >= 1e-5);
}

/* ---- energy ---- */

/* The largest change of observable number which (from 0; m: E) over some steps. */
static double change(const char *text, const char *method, double h, long long steps, int which)
{
    const dal_system *system = fixture_system(text);
    const dal_run_spec spec = fixture_spec(system, method, DAL_PHYSICAL, h);
    dal_run *run = fixture_run(&spec);
    double first[64], now[64], max = 0.0;
    CU_ASSERT_EQUAL(dal_run_observe(run, first), DAL_STATUS_OK);
    for (long long i = 0; i < steps; i++) {
        CU_ASSERT_EQUAL_FATAL(dal_run_step(run, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_observe(run, now), DAL_STATUS_OK);
        max = fmax(max, fabs(now[which] - first[which]));
    }
    dal_run_free(run);
    return max;
}

static void test_energy(void)
{
    const long long steps = long_run(10000);
    CU_ASSERT(change("contact-oscillator", "discrete-gradient", 0.1, steps, 1) <= 1e-13);
    CU_ASSERT(change("chaplygin-sleigh-incline", "discrete-gradient", 0.02, 500, 1) <= 1e-13);
    CU_ASSERT(change("appell-hamel-harmonic", "discrete-gradient", 0.01, 100, 1) <= 1e-14);
    CU_ASSERT(change("contact-oscillator", "mclachlan-perlmutter", 0.1, steps, 1) >= 1e-6);
}

static void test_isokinetic(void)
{
    const long long steps = long_run(100000);
    CU_ASSERT(change("isokinetic", "isokinetic-splitting", 0.1, steps, 0) <= 1e-15);
    CU_ASSERT(change("isokinetic-cluster", "isokinetic-splitting", 0.01, 10000, 0) <= 1e-14);
}

/* ---- dla and gni by what they are ---- */

/* f = -U_q of the bilinear fixture. */
static void force(const double *q, double *f)
{
    f[0] = -q[0] - 0.3 * q[0] * q[2] * q[2];
    f[1] = -q[1];
    f[2] = -q[2] - 0.3 * q[0] * q[0] * q[2];
}

/* Contact oscillator: (q0 - 2 q1 + q2)/h - h/2 (f(q0 + q1)/2 + f(q1 + q2)/2) is along
 * A = (1, 0, y).
 */
static void test_two_step(void)
{
    const double h = 0.1;
    const dal_run_spec spec =
        fixture_spec(fixture_system(fixture_bilinear), "dla", DAL_PHYSICAL, h);
    dal_run *run = fixture_run(&spec);
    double q[3][3], middle[3], f[2][3], rest[3];
    for (int k = 0; k < 30; k++) {
        memmove(q[0], q[1], 2 * sizeof q[0]);
        memcpy(q[2], dal_run_state(run), sizeof q[2]);
        CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
        if (k < 2) continue;
        for (int side = 0; side < 2; side++) {
            for (int i = 0; i < 3; i++) middle[i] = 0.5 * (q[side][i] + q[side + 1][i]);
            force(middle, f[side]);
        }
        for (int i = 0; i < 3; i++)
            rest[i] = (q[0][i] - 2.0 * q[1][i] + q[2][i]) / h - 0.5 * h * (f[0][i] + f[1][i]);
        CU_ASSERT_DOUBLE_EQUAL(rest[1], 0.0, 2e-14);
        CU_ASSERT_DOUBLE_EQUAL(rest[2], q[1][1] * rest[0], 2e-14);
    }
    dal_run_free(run);
}

/* Without forces gni reflects: the speed between the nodes is kept. */
static void test_reflection(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system("nonholonomic-particle-free"), "gni", DAL_PHYSICAL, 0.1);
    dal_run *run = fixture_run(&spec);
    double q[3], first = 0.0;
    for (int k = 0; k < 1000; k++) {
        double square = 0.0;
        memcpy(q, dal_run_state(run), sizeof q);
        CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
        for (int i = 0; i < 3; i++) square += pow((dal_run_state(run)[i] - q[i]) / 0.1, 2.0);
        if (k == 0) first = square;
        /* The differences of q have lost up to three digits. */
        CU_ASSERT_DOUBLE_EQUAL(square / first, 1.0, 1e-11);
    }
    dal_run_free(run);
}

/* Where forces do not depend on v the Lobatto method of two stages is gni. */
static void test_same_method(void)
{
    double a[16], b[16];
    end_state(fixture_system(fixture_bilinear), "gni", 50, a);
    end_state(fixture_system(fixture_bilinear), "lobatto-nonholonomic2", 50, b);
    for (int i = 0; i < 6; i++) CU_ASSERT_DOUBLE_EQUAL(a[i], b[i], 1e-14);
}

/* ---- lanes, stiffness, failure ---- */

static void test_lanes(void)
{
    const struct {
        const char *system, *method, *name;
        double from;
    } cases[] = {{forced, "discrete-gradient", "u", 0.1},
                 {"isokinetic-cluster", "isokinetic-splitting", "x1", 0.1},
                 {"damped-oscillator", "mclachlan-perlmutter", "x", 0.3}};
    for (int i = 0; i < 3; i++)
        fixture_lanes(
            fixture_spec(fixture_system(cases[i].system), cases[i].method, DAL_PHYSICAL, 0.05), 8,
            50, cases[i].name, cases[i].from, 0.07);
}

/* Friction 3000 times faster than the step: only Newton solves these. */
static void test_stiff(void)
{
    static const char *const methods[] = {"mclachlan-perlmutter", "gni", "spark4", "gauss-spark4"};
    const dal_setting k = {"k", 3e5};
    for (int i = 0; i < 4; i++) {
        dal_run_spec spec = fixture_spec(fixture_system("chaplygin-sleigh-friction"), methods[i],
                                         DAL_PHYSICAL, 0.01);
        spec.parameters = &k;
        spec.parameter_count = 1;
        dal_run *run = fixture_run(&spec);
        dal_error error = {0};
        if (dal_run_advance(run, 50, &error) != DAL_STATUS_OK) printf("\n  %s\n", error.message);
        CU_ASSERT(error.status == DAL_STATUS_OK);
        dal_run_free(run);
    }
}

static void test_failure(void)
{
    static const char *const methods[] = {"dla", "discrete-gradient", "spark6", "gauss-spark4",
                                          "lobatto-nonholonomic4"};
    for (int i = 0; i < 5; i++) {
        const dal_run_spec spec =
            fixture_spec(fixture_system(fixture_bilinear), methods[i], DAL_PHYSICAL, 1e3);
        fixture_failed_step(&spec, NULL);
    }
}

void suite_enforced(void)
{
    CU_pSuite suite = CU_add_suite("methods that enforce D = 0", NULL, NULL);
    CU_add_test(suite, "order", test_order);
    CU_add_test(suite, "D at the midpoints", test_midpoints);
    CU_add_test(suite, "discrete gradient: energy", test_energy);
    CU_add_test(suite, "isokinetic splitting: kinetic energy", test_isokinetic);
    CU_add_test(suite, "dla solves its two-step equations", test_two_step);
    CU_add_test(suite, "gni without forces is a reflection", test_reflection);
    CU_add_test(suite, "two stages of Lobatto are gni", test_same_method);
    CU_add_test(suite, "lanes are single runs", test_lanes);
    CU_add_test(suite, "stiff friction", test_stiff);
    CU_add_test(suite, "a step that fails", test_failure);
}
