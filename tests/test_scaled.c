/* test_scaled.c - systems in units of their own: the same motions, the same derivatives, and units
 * that change as those of the user do. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static dal_scaled *scale(const dal_system *system)
{
    const dal_run_spec spec = {.system = system};
    dal_scaled *scaled = NULL;
    dal_error error = {0};
    if (dal_scaled_create(&scaled, &spec, &error) != DAL_OK) printf("\n  %s", error.message);
    CU_ASSERT_PTR_NOT_NULL_FATAL(scaled);
    return scaled;
}

/* max |x unit - y| / max |y| of the coordinates of two runs, of the scaled and of the plain
 * system. */
static double distance(const dal_run *scaled, const dal_run *plain, const double *units, int n)
{
    double max = 0.0;
    for (int i = 0; i < n; i++) {
        const double x = dal_run_state(scaled)[i] * units[1 + i], y = dal_run_state(plain)[i];
        const double u = dal_run_state(scaled)[n + i] * units[1 + i] / units[0];
        const double v = dal_run_state(plain)[n + i];
        if (x != y) max = fmax(max, fabs(x - y) / fabs(y));
        if (u != v) max = fmax(max, fabs(u - v) / fabs(v));
    }
    return max;
}

static double distance_after(const dal_system *system, const char *method, dal_space space)
{
    enum { STEPS = 20 };
    dal_scaled *scaled = scale(system);
    const double *units = dal_scaled_units(scaled), h = 0x1p-6;
    dal_run_spec plain = fixture_spec(system, method, space, h);
    dal_run_spec other = fixture_spec(dal_scaled_system(scaled), method, space, h / units[0]);
    plain.options.sums = other.options.sums = DAL_SUMS_PLAIN;
    dal_run *a = fixture_stepped(&other, STEPS), *b = fixture_stepped(&plain, STEPS);
    const double max = a && b ? distance(a, b, units, system->n) : INFINITY;
    if (!(max <= 1e-11)) printf("\n  %s by %s: %g", system->name, method, max);
    dal_run_free(a);
    dal_run_free(b);
    dal_scaled_free(scaled);
    return max;
}

/* F and the constraint blocks give the same bits where no equation is solved, and all callbacks of
 * the steps the same motion. */
static void test_motions(void)
{
    static const char *const systems[] = {"chaplygin-sleigh-incline", "falling-disk", "snakeboard",
                                          "contact-oscillator", "turntable-ball"};
    static const char *const others[] = {"gni",    "spark4",        "dla", "rk4+project-energy",
                                         "gauss4", "stormer-verlet"};
    for (int s = 0; s < 5; s++) {
        const dal_system *system = fixture_system(systems[s]);
        CU_ASSERT_EQUAL(distance_after(system, "rk4", DAL_PHYSICAL), 0.0);
        CU_ASSERT_EQUAL(distance_after(system, "rk4", DAL_LIFTED), 0.0);
        CU_ASSERT(distance_after(system, "rk4+project", DAL_PHYSICAL) <= 1e-13);
        for (int k = 0; k < 6; k++) {
            dal_method method;
            CU_ASSERT_FATAL(dal_method_parse(&method, others[k], NULL) == DAL_OK);
            if (fixture_accepts(&method, system, DAL_PHYSICAL))
                CU_ASSERT(distance_after(system, others[k], DAL_PHYSICAL) <= 1e-11);
        }
    }
    CU_ASSERT(distance_after(fixture_system(fixture_full), "gauss4", DAL_LIFTED) <= 1e-11);
    CU_ASSERT(distance_after(fixture_system("unequal-springs"), "discrete-gradient",
                             DAL_PHYSICAL) <= 1e-10);
    CU_ASSERT_EQUAL(
        distance_after(fixture_system("chaplygin-sleigh-vakonomic"), "rk4", DAL_PHYSICAL), 0.0);
}

/* All derivatives are those of the scaled values, by differences. */
static void test_derivatives(void)
{
    static const char *const systems[] = {"chaplygin-sleigh-incline", "falling-disk", "benenti",
                                          "chaplygin-sleigh-vakonomic", fixture_full};
    for (int s = 0; s < 5; s++) {
        dal_scaled *scaled = scale(fixture_system(systems[s]));
        dal_evaluator *evaluator = fixture_evaluator(dal_scaled_system(scaled));
        const int n = dal_scaled_system(scaled)->n;
        double start[64];
        dal_derivatives d;
        CU_ASSERT_FATAL(dal_evaluator_start(evaluator, NULL, 0, start, NULL) == DAL_OK);
        const dal_point at = {.t = 0.25, .q = start, .v = start + n};
        CU_ASSERT_FATAL(dal_check_derivatives(evaluator, &at, &d) == DAL_OK);
        CU_ASSERT(d.jacobian <= 1e-9);
        CU_ASSERT(isnan(d.adjoint) || d.adjoint <= 1e-9);
        CU_ASSERT(d.constraint_jacobian <= 1e-9);
        CU_ASSERT(d.gram <= 1e-12);
        dal_evaluator_free(evaluator);
        dal_scaled_free(scaled);
    }
}

/* What is solved with W is: E_v = W v of a natural system gives A_a at v = W^-1 A_a^T, and E_q at
 * v = W^-1 E_q. */
static void test_mass(void)
{
    enum { MAX = 256 };
    static const char *const systems[] = {"falling-disk", "chaplygin-sleigh-incline", "snakeboard"};
    for (int s = 0; s < 3; s++) {
        dal_scaled *scaled = scale(fixture_system(systems[s]));
        const dal_system *system = dal_scaled_system(scaled);
        dal_evaluator *evaluator = fixture_evaluator(system);
        const int n = system->n, m = system->m;
        double start[MAX], block[MAX], normal[MAX], other[MAX], v[MAX];
        CU_ASSERT_FATAL(dal_evaluator_start(evaluator, NULL, 0, start, NULL) == DAL_OK);
        CU_ASSERT_FATAL(dal_evaluator_call(evaluator, system->call.constraint, 0.0, start,
                                           start + n, NULL, block) == DAL_OK);
        for (int a = 0; a <= m; a++) {
            const double *row = block + m + a * n;
            CU_ASSERT_FATAL(dal_evaluator_call(evaluator, system->call.energy_normal, 0.0, start,
                                               start + n, NULL, normal) == DAL_OK);
            for (int i = 0; i < n; i++)
                v[i] = a < m ? block[m + m * n + i * m + a] : normal[1 + 2 * n + i];
            if (a == m) row = normal + 1;
            CU_ASSERT_FATAL(dal_evaluator_call(evaluator, system->call.energy_normal, 0.0, start, v,
                                               NULL, other) == DAL_OK);
            for (int i = 0; i < n; i++)
                CU_ASSERT_DOUBLE_EQUAL(other[1 + n + i], row[i], 1e-13 * (1.0 + fabs(row[i])));
        }
        dal_evaluator_free(evaluator);
        dal_scaled_free(scaled);
    }
}

/* U_q.v of the potential is the rate of U along v, by differences. */
static void test_potential(void)
{
    dal_scaled *scaled = scale(fixture_system("coordinates: [x]\n"
                                              "lagrangian: x'^2/2 - 4*x^4\n"
                                              "start: {x: 1, x': 0.5}\n"));
    const dal_system *system = dal_scaled_system(scaled);
    CU_ASSERT(dal_scaled_units(scaled)[0] < 0.5);
    dal_evaluator *evaluator = fixture_evaluator(system);
    const int n = system->n;
    const double d = 1e-5;
    double start[16], q[16], U[3][48], sum[3] = {0.0}, rate = 0.0;
    CU_ASSERT_FATAL(dal_evaluator_start(evaluator, NULL, 0, start, NULL) == DAL_OK);
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < n; i++) q[i] = start[i] + (k - 1) * d * start[n + i];
        CU_ASSERT_FATAL(dal_evaluator_call(evaluator, system->call.potential, 0.0, q, start + n,
                                           NULL, U[k]) == DAL_OK);
        for (int i = 0; i < n; i++) sum[k] += U[k][i];
    }
    for (int i = 0; i < n; i++) rate += U[1][n + i];
    CU_ASSERT(fabs(rate) > 0.01);
    CU_ASSERT_DOUBLE_EQUAL(rate, (sum[2] - sum[0]) / (2.0 * d), 1e-6);
    dal_evaluator_free(evaluator);
    dal_scaled_free(scaled);
}

/* An oscillator of mass m on a spring k, amplitude a: tau = sqrt(m/k), l = a; energies k a^2/2. */
static void test_units(void)
{
    static const double cases[][3] = {
        {1, 1, 1}, {0x1p-89, 0x1p9, 0x1p-36}, {1, 0x1p-40, 0x1p30}, {0x1p60, 1, 1}};
    for (int k = 0; k < 4; k++) {
        const double m = cases[k][0], stiffness = cases[k][1], a = cases[k][2];
        char text[256];
        snprintf(text, sizeof text,
                 "coordinates: [x]\nlagrangian: %.17g*x'^2/2 - %.17g*x^2/2\nstart: {x: %.17g}\n", m,
                 stiffness, a);
        dal_scaled *scaled = scale(fixture_system(text));
        const double *units = dal_scaled_units(scaled), tau = sqrt(m / stiffness);
        CU_ASSERT(units[0] > 0.5 * tau && units[0] < 2.0 * tau);
        CU_ASSERT(units[1] > 0.25 * a && units[1] < 4.0 * a);
        /* Each is a power of two. */
        int exponent;
        CU_ASSERT_EQUAL(frexp(units[0], &exponent), 0.5);
        CU_ASSERT_EQUAL(frexp(units[1], &exponent), 0.5);
        dal_scaled_free(scaled);
    }
}

/* A free particle that moves along x alone: y gets the length of equal energy. */
static void test_coordinate_at_rest(void)
{
    dal_scaled *scaled = scale(fixture_system("coordinates: [x, y]\n"
                                              "lagrangian: (x'^2 + 1e-18*y'^2)/2\n"
                                              "start: {x': 3e-6}\n"));
    const double *units = dal_scaled_units(scaled);
    CU_ASSERT(units[2] > 0.4e9 * units[1] && units[2] < 2.1e9 * units[1]);
    dal_scaled_free(scaled);
}

static void test_refused(void)
{
    dal_scaled *scaled;
    dal_error error;
    const dal_setting unknown = {"mass", 1.0};
    const dal_run_spec spec = {
        .system = fixture_system("chaplygin-sleigh"), .parameters = &unknown, .parameter_count = 1};
    CU_ASSERT_EQUAL(dal_scaled_create(&scaled, &spec, &error), DAL_NAME);
    CU_ASSERT_PTR_NULL(scaled);
}

void suite_scaled(void)
{
    CU_pSuite suite = CU_add_suite("scaled systems", NULL, NULL);
    CU_add_test(suite, "the same motions", test_motions);
    CU_add_test(suite, "derivatives of scaled callbacks", test_derivatives);
    CU_add_test(suite, "what the mass matrix solves", test_mass);
    CU_add_test(suite, "the potential", test_potential);
    CU_add_test(suite, "units of an oscillator", test_units);
    CU_add_test(suite, "a coordinate that rests", test_coordinate_at_rest);
    CU_add_test(suite, "unknown parameters", test_refused);
}
