/* test_extension.c - the option extend-energy: F continued off D = 0 so that E is a true integral.
 */
#include "fixtures.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* m = 2, D linear in v, a full mass matrix that depends on q. */
static const char two[] = "coordinates: [x, y, z, u]\n"
                          "lagrangian: >-\n"
                          "  (2 + cos(y))/2*x'^2 + (3 + x^2/4)/2*y'^2 + z'^2 + u'^2/2\n"
                          "  + 0.3*x'*y'*cos(z) + 0.2*z'*u'*sin(y) - (x^2 + 1.5*y^2 + z^2*u^2)/2\n"
                          "constraints: [z' - y*x', u' - x*y' + sin(z)*x']\n"
                          "start: {x: 0.5, y: 0.3, x': 1, y': 0.5, z': 0.3, u': 0.25}\n";

/* A force that does no work on D = 0, and a reaction with a direction of its own. */
static const char pushed[] = "coordinates: [x, y, z]\n"
                             "lagrangian: (x'^2 + 2*y'^2 + z'^2 - x^2 - y^2)/2 + 0.2*x'*z'\n"
                             "forces: {y: x*(z' - y*x')}\n"
                             "constraints: [z' - y*x']\n"
                             "reactions: [{x: -y + (z' - y*x'), z: 1}]\n"
                             "start: {x: 0.5, y: 0.3, x': 1, y': 0.5, z': 0.3}\n";

/* Where D is not 0. */
static const double q[] = {0.3, -0.4, 0.7, 0.2}, v[] = {0.9, 0.5, -0.6, 0.35};

static const char *const names[] = {
    "contact-oscillator", "chaplygin-sleigh", "appell-hamel", "vertical-disk", two, pushed};
enum { NAMES = sizeof names / sizeof *names, MAX = 8 };

static dal_evaluator *evaluator_of(const dal_system *system)
{
    dal_evaluator *evaluator = NULL;
    CU_ASSERT_PTR_NOT_NULL_FATAL(system);
    CU_ASSERT_EQUAL_FATAL(dal_evaluator_create(&evaluator, system, NULL, 0, NULL), DAL_STATUS_OK);
    return evaluator;
}

static void field(dal_evaluator *evaluator, const double *at_v, double *F)
{
    const dal_system *system = dal_evaluator_system(evaluator);
    CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, system->call.field, 0.0, q, at_v, NULL, F),
                    DAL_STATUS_OK);
}

/* Along F~ neither E nor D changes, by differences. */
static void check_rates(dal_evaluator *extended)
{
    const dal_system *system = dal_evaluator_system(extended);
    const dal_point at = {.t = 0.0, .q = q, .v = v};
    double rate[MAX];
    CU_ASSERT_EQUAL(dal_evaluator_measure_rate(extended, system->energy, 1, &at, rate),
                    DAL_STATUS_OK);
    if (!(fabs(rate[0]) <= 1e-11)) printf("\n  %s: dE/dt %.2e\n", system->name, rate[0]);
    CU_ASSERT(fabs(rate[0]) <= 1e-11);
    CU_ASSERT_EQUAL(dal_evaluator_measure_rate(extended, system->constraints, system->m, &at, rate),
                    DAL_STATUS_OK);
    for (int a = 0; a < system->m; a++) CU_ASSERT(fabs(rate[a]) <= 1e-11);
}

/* Off D = 0 the two fields differ, on it they do not. */
static void check_surface(dal_evaluator *plain, dal_evaluator *extended)
{
    const int n = dal_evaluator_system(plain)->n;
    double on[MAX], F[2][MAX], off_by = 0.0, on_by = 0.0;
    memcpy(on, v, sizeof v);
    CU_ASSERT_EQUAL(dal_evaluator_project_velocity(plain, 0.0, q, on), DAL_STATUS_OK);
    field(plain, v, F[0]);
    field(extended, v, F[1]);
    for (int i = 0; i < n; i++) off_by = fmax(off_by, fabs(F[1][i] - F[0][i]));
    field(plain, on, F[0]);
    field(extended, on, F[1]);
    for (int i = 0; i < n; i++) on_by = fmax(on_by, fabs(F[1][i] - F[0][i]));
    CU_ASSERT(off_by > 1e-4);
    CU_ASSERT(on_by <= 1e-14);
}

static void test_field(void)
{
    for (int i = 0; i < NAMES; i++) {
        const dal_system *system = fixture_system(names[i]);
        dal_evaluator *plain = evaluator_of(system), *extended = evaluator_of(system->extended);
        CU_ASSERT(!(system->properties & DAL_E_EXACT));
        CU_ASSERT(system->extended->properties & DAL_E_EXACT);
        check_rates(extended);
        check_surface(plain, extended);
        dal_evaluator_free(plain);
        dal_evaluator_free(extended);
    }
}

/* What is exact already is its own extension. */
static void test_exact(void)
{
    const dal_system *system = fixture_system("chaplygin-sleigh-nonlinear");
    CU_ASSERT(system->properties & DAL_E_EXACT);
    CU_ASSERT_PTR_EQUAL(system->extended, system);
}

/* ---- the normal of E = const ---- */

/* dE by component k of (q, v), by the central difference of order 8. */
static double slope(dal_evaluator *evaluator, int k)
{
    static const double weight[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    const dal_system *system = dal_evaluator_system(evaluator);
    const double step = 0.02;
    double sum = 0.0, E[2], x[2 * MAX];
    for (int j = 0; j < 4; j++) {
        for (int side = 0; side < 2; side++) {
            memcpy(x, q, sizeof q);
            memcpy(x + MAX, v, sizeof v);
            x[k] += (side ? -1 : 1) * (j + 1) * step;
            CU_ASSERT_EQUAL(
                dal_evaluator_call(evaluator, system->energy, 0.0, x, x + MAX, NULL, &E[side]),
                DAL_STATUS_OK);
        }
        sum += weight[j] * (E[0] - E[1]) / step;
    }
    return sum;
}

static void test_normal(void)
{
    for (int i = 0; i < NAMES; i++) {
        const dal_system *system = fixture_system(names[i]);
        dal_evaluator *evaluator = evaluator_of(system);
        const int n = system->n;
        double E, out[1 + 3 * MAX], again[1 + 3 * MAX];
        dal_callback *normal = system->call.energy_normal;
        CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, normal, 0.0, q, v, NULL, out), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, system->energy, 0.0, q, v, NULL, &E),
                        DAL_STATUS_OK);
        CU_ASSERT_EQUAL(out[0], E);
        for (int j = 0; j < n; j++) {
            CU_ASSERT_DOUBLE_EQUAL(out[1 + j], slope(evaluator, j), 1e-11);
            CU_ASSERT_DOUBLE_EQUAL(out[1 + n + j], slope(evaluator, MAX + j), 1e-11);
        }
        /* E_v is W v, and so E_q where v is W^-1 E_q. */
        const double *x = out + 1 + 2 * n;
        CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, normal, 0.0, q, x, NULL, again),
                        DAL_STATUS_OK);
        for (int j = 0; j < n; j++) CU_ASSERT_DOUBLE_EQUAL(again[1 + n + j], out[1 + j], 1e-13);
        dal_evaluator_free(evaluator);
    }
}

/* ---- runs ---- */

/* The largest |dE/E| on count steps of gauss8 with h = 0.1, observed a thousand times. */
static double energy_error(const dal_system *system, int extend, long long count)
{
    dal_run_spec spec = fixture_spec(system, "gauss8", DAL_PHYSICAL, 0.1);
    double first[16], now[16], max = 0.0;
    spec.options.extend_energy = extend;
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_observe(run, first), DAL_STATUS_OK);
    for (int i = 0; i < 1000; i++) {
        CU_ASSERT_EQUAL_FATAL(dal_run_advance(run, count / 1000, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_observe(run, now), DAL_STATUS_OK);
        max = fmax(max, fabs(now[1] / first[1] - 1.0));
    }
    dal_run_free(run);
    return max;
}

/* 1e-12 after 4e6 steps, growing no faster than the square root of their number: a random walk.
 * Without the extension rounding in D feeds E, and E drifts with the square of the number. */
static void test_long(void)
{
    const long long count = long_run(100000);
    const double bound = 1e-12 * sqrt((double)count / 4e6);
    const dal_system *system = fixture_system("contact-oscillator");
    const double error = energy_error(system, 1, count);
    if (count < 100000) { /* here it is the method's own error that is seen */
        CU_ASSERT(error <= 1e-13);
    } else {
        if (!(error <= bound)) printf("\n  |dE/E| %.2e\n", error);
        CU_ASSERT(error <= bound);
        CU_ASSERT(energy_error(system, 0, count) > 10.0 * bound);
    }
}

/* The lift of F~ is a canonical system like the lift of F. */
static void test_lifted(void)
{
    dal_run_spec spec =
        fixture_spec(fixture_system("contact-oscillator"), "gauss4", DAL_LIFTED, 0.1);
    const dal_setting start[] = {{"x", 0.8},    {"y", 0.6},  {"z", -0.5},
                                 {"x'", -0.24}, {"y'", 0.7}, {"z'", 0.4}};
    double defect = NAN;
    spec.options.extend_energy = 1;
    spec.start = start;
    spec.start_count = 6;
    dal_run *run = fixture_run(&spec);
    fixture_perturb(run, 0.3);
    CU_ASSERT_EQUAL(dal_check_symplecticity(&spec, 0.0, dal_run_state(run), 0.0, &defect, NULL),
                    DAL_STATUS_OK);
    CU_ASSERT(defect <= 1e-9);
    dal_run_free(run);
}

/* ---- refusals ---- */

static void refused(const char *text, const char *reason)
{
    dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.1);
    spec.options.extend_energy = 1;
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, reason);
}

static void test_refused(void)
{
    refused("isokinetic", "extend-energy cannot act on isokinetic: the motion does not conserve");
    refused("chaplygin-sleigh-friction", "the motion does not conserve its energy");
    refused("chaplygin-sleigh-vakonomic", "vakonomic");
    refused("coordinates: [x]\naccelerations: {x: -x}\n", "the system has no energy");
    dal_system by_hand = *fixture_system("contact-oscillator");
    dal_run_spec spec = fixture_spec(&by_hand, "rk4", DAL_PHYSICAL, 0.1);
    dal_error error = {0};
    dal_run *run = NULL;
    by_hand.extended = NULL;
    spec.options.extend_energy = 1;
    CU_ASSERT_EQUAL(dal_run_create(&run, &spec, &error), DAL_STATUS_UNSUPPORTED);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "the system has no such extension"));
}

void suite_extension(void)
{
    CU_pSuite suite = CU_add_suite("extension", NULL, NULL);
    CU_add_test(suite, "E and D are integrals of F~, which is F on D = 0", test_field);
    CU_add_test(suite, "E exact already", test_exact);
    CU_add_test(suite, "the normal of E = const", test_normal);
    CU_add_test(suite, "gauss8, 1e5 steps: E is a random walk", test_long);
    CU_add_test(suite, "lifted: symplectic", test_lifted);
    CU_add_test(suite, "refused with the reason", test_refused);
}
