/* test_scaled.c - systems in units of their own: the same motions, the same derivatives, and units
 * that change with the user's. */
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
    if (dal_scaled_create(&scaled, &spec, &error) != DAL_STATUS_OK) printf("\n  %s", error.message);
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
            CU_ASSERT_FATAL(dal_method_parse(&method, others[k], NULL) == DAL_STATUS_OK);
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

static double observed(dal_run *run, const char *name)
{
    double values[64];
    char other[64];
    CU_ASSERT_FATAL(dal_run_observables(run) <= 64);
    CU_ASSERT_EQUAL(dal_run_observe(run, values), DAL_STATUS_OK);
    for (int i = 0; dal_run_observable_name(run, i, other, sizeof other); i++)
        if (strcmp(name, other) == 0) return values[i];
    CU_FAIL("no such observable");
    return NAN;
}

/* A pendulum of a kilometre, nonholonomic too: positions that are projected move alike, and
 * R = B^T h is an energy over a length. */
static void test_holonomic(void)
{
    static const char text[] = "coordinates: [x, y, z, u]\n"
                               "parameters: {l: 1000, g: 10, M: 1e-6}\n"
                               "lagrangian: (x'^2 + y'^2 + z'^2)/2 + M*u'^2/2 - g*z\n"
                               "constraints: [u' - 1e3*x' - y'*x]\n"
                               "holonomic: [x^2 + y^2 + z^2 - (l + 50*sin(t/10))^2]\n"
                               "start: {x: 600, z: -800, x': 40, y': 30, solve: [u', z']}\n";
    static const char *const forces[] = {"R_x", "R_y", "R_z", "R_u"};
    const dal_system *system = fixture_system(text);
    CU_ASSERT(distance_after(system, "rk4+project", DAL_PHYSICAL) <= 1e-13);
    CU_ASSERT(distance_after(system, "rk4+project", DAL_LIFTED) <= 1e-13);
    dal_scaled *scaled = scale(system);
    const double *units = dal_scaled_units(scaled);
    dal_run *runs[2];
    for (int i = 0; i < 2; i++) {
        dal_run_spec spec = fixture_spec(i ? dal_scaled_system(scaled) : system, "rk4+project",
                                         DAL_PHYSICAL, i ? 0.125 / units[0] : 0.125);
        spec.options.reactions = true;
        runs[i] = fixture_stepped(&spec, 10);
    }
    const double energy = observed(runs[0], "E") / observed(runs[1], "E");
    for (int i = 0; i < 4; i++) {
        const double plain = observed(runs[0], forces[i]);
        CU_ASSERT(fabs(plain) > 1e-9);
        CU_ASSERT_DOUBLE_EQUAL(observed(runs[1], forces[i]) * energy / units[1 + i], plain,
                               1e-10 * fabs(plain));
    }
    for (int i = 0; i < 2; i++) dal_run_free(runs[i]);
    dal_scaled_free(scaled);
}

/* All derivatives are derivatives of the scaled values, by differences. */
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
        CU_ASSERT_FATAL(dal_evaluator_start(evaluator, NULL, 0, start, NULL) == DAL_STATUS_OK);
        const dal_point at = {.t = 0.25, .q = start, .v = start + n};
        CU_ASSERT_FATAL(dal_evaluator_check_derivatives(evaluator, &at, &d) == DAL_STATUS_OK);
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
        CU_ASSERT_FATAL(dal_evaluator_start(evaluator, NULL, 0, start, NULL) == DAL_STATUS_OK);
        CU_ASSERT_FATAL(dal_evaluator_call(evaluator, system->call.constraint, 0.0, start,
                                           start + n, NULL, block) == DAL_STATUS_OK);
        for (int a = 0; a <= m; a++) {
            const double *row = block + m + a * n;
            CU_ASSERT_FATAL(dal_evaluator_call(evaluator, system->call.energy_normal, 0.0, start,
                                               start + n, NULL, normal) == DAL_STATUS_OK);
            for (int i = 0; i < n; i++)
                v[i] = a < m ? block[m + m * n + i * m + a] : normal[1 + 2 * n + i];
            if (a == m) row = normal + 1;
            CU_ASSERT_FATAL(dal_evaluator_call(evaluator, system->call.energy_normal, 0.0, start, v,
                                               NULL, other) == DAL_STATUS_OK);
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
    CU_ASSERT_FATAL(dal_evaluator_start(evaluator, NULL, 0, start, NULL) == DAL_STATUS_OK);
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < n; i++) q[i] = start[i] + (k - 1) * d * start[n + i];
        CU_ASSERT_FATAL(dal_evaluator_call(evaluator, system->call.potential, 0.0, q, start + n,
                                           NULL, U[k]) == DAL_STATUS_OK);
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

/* Forces balance along z, which rounding moves, or the error of a step.  z has the length of equal
 * energy, of x or y of a conical pendulum; where no energy is known, |z|. */
static void test_balanced_coordinate(void)
{
    static const char *const conical =
        "coordinates: [x, y, z]\n"
        "parameters: {s: %g, h: 0.7, g: 9.81}\n"
        "lagrangian: 0.3*s^2*(x'^2 + y'^2 + z'^2)/2 - 0.3*g*s*z\n"
        "holonomic: [(s^2*(x^2 + y^2 + z^2) - 1.3^2)/2]\n"
        "start: {x: sqrt(1.3^2 - h^2)/s, z: -h/s, y': sqrt((1.3^2 - h^2)*g/h)/s}\n";
    static const char *const given = "coordinates: [x, z]\n"
                                     "parameters: {s: %g}\n"
                                     "accelerations: {x: -7*x*(1 + s*z), z: -9.81/s - 21*z}\n"
                                     "start: {x: 1/s, z: -9.81/21/s, x': 1/s}\n";
    static const double scales[] = {1.0, 1e-9, 1e9};
    for (int k = 0; k < 3; k++) {
        char text[512];
        snprintf(text, sizeof text, conical, scales[k]);
        dal_scaled *scaled = scale(fixture_system(text));
        const double *units = dal_scaled_units(scaled);
        CU_ASSERT_EQUAL(units[3], fmax(units[1], units[2]));
        dal_scaled_free(scaled);
        snprintf(text, sizeof text, given, scales[k]);
        scaled = scale(fixture_system(text));
        const double length = dal_scaled_units(scaled)[2] * scales[k];
        CU_ASSERT(length > 0.5 * 9.81 / 21 && length < 2.0 * 9.81 / 21);
        dal_scaled_free(scaled);
    }
}

/* The units of a run at its start, and of its velocities. */
static void test_run(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system("snakeboard"), "rk4", DAL_PHYSICAL, 0.05);
    dal_scaled *scaled, *other;
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_EQUAL_FATAL(dal_scaled_create(&scaled, &spec, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_scaled_create_at(&other, run, NULL), DAL_STATUS_OK);
    const double *units = dal_scaled_units(scaled), *at_run = dal_scaled_units(other);
    const int n = spec.system->n;
    for (int i = 0; i <= n; i++) CU_ASSERT_EQUAL(units[i], at_run[i]);
    for (int i = 1; i <= n; i++) CU_ASSERT_EQUAL(units[n + i], units[i] / units[0]);
    dal_scaled_free(other);
    dal_scaled_free(scaled);
    dal_run_free(run);
}

/* x, y, z in units a, b, c.  A magnetic field along z conserves E, by an identity that sums of
 * formulas do not show; friction r along z does not, however small z is beside x and y. */
static unsigned energy_in_units(double a, double b, double c, double r)
{
    char text[512];
    snprintf(text, sizeof text,
             "coordinates: [x, y, z]\n"
             "lagrangian: ((%.17g*x')^2 + (%.17g*y')^2 + (%.17g*z')^2)/2\n"
             "forces: {x: %.17g*y'*(sin(%.17g*x)^2 + cos(%.17g*x)^2), y: -%.17g*x', "
             "z: -%.17g*z'}\nstart: {x': %.17g, z': %.17g}\n",
             a, b, c, a * b, a, a, a * b, r * c * c, 1.0 / a, 0.5 / c);
    return fixture_system(text)->properties & (DAL_E_EXACT | DAL_E_ON_D);
}

/* The same field as a difference of terms that are 1e12 times as large, as are their roundings. */
static void test_cancelling_energy(void)
{
    const dal_system *system =
        fixture_system("coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                       "forces: {x: y'*((x + 1)^2 - x^2 - 2*x), y: -x'}\nstart: {x: 1e6, x': 1}\n");
    CU_ASSERT(system->properties & DAL_E_EXACT);
}

static void test_energy(void)
{
    static const double units[][3] = {{1, 1, 1},
                                      {0x1p60, 0x1p60, 0x1p60},
                                      {0x1p-60, 0x1p60, 0x1p40},
                                      {0x1p-60, 0x1p-50, 0x1p60},
                                      {0x1p50, 0x1p60, 0x1p-60}};
    for (int k = 0; k < 5; k++) {
        const double *u = units[k];
        CU_ASSERT_EQUAL(energy_in_units(u[0], u[1], u[2], 0.0), DAL_E_EXACT);
        CU_ASSERT_EQUAL(energy_in_units(u[0], u[1], u[2], 1e-3), 0);
    }
}

/* x'' = x - y', y'' = -y + x' in units s of x, r of y and tau of t. */
static dal_run_spec coupled(double s, double r, double tau)
{
    char text[512];
    snprintf(text, sizeof text,
             "coordinates: [x, y]\naccelerations: {x: %.17g*x - %.17g*y', y: -%.17g*y + %.17g*x'}\n"
             "start: {x: %.17g, y': %.17g}\n",
             tau * tau, r * tau / s, tau * tau, s * tau / r, 1.0 / s, tau / r);
    return fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0x1p-4 / tau);
}

/* The errors are ratios: the same digits where all that is compared scales, and 1e-7 of them the
 * reference, whose equations are solved to a tolerance. */
static void test_order(void)
{
    const dal_run_spec plain = coupled(1.0, 1.0, 1.0);
    const dal_run_spec other = coupled(0x1p-60, 0x1p50, 0x1p-40);
    dal_order order[2];
    CU_ASSERT_EQUAL(dal_order_measure(&order[0], &plain, 2.0, 4, NULL, NULL, NULL, NULL),
                    DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_order_measure(&order[1], &other, 0x1p41, 4, NULL, NULL, NULL, NULL),
                    DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(order[0].order, 4.0, 0.1);
    CU_ASSERT_DOUBLE_EQUAL(order[1].order, order[0].order, 1e-5);
    for (int i = 0; i < 4; i++)
        CU_ASSERT_DOUBLE_EQUAL(order[1].error[i], order[0].error[i], 1e-6 * order[0].error[i]);
}

/* Exponents are rates.  J is found by differences, whose increments are in these units, too. */
static void test_exponents(void)
{
    const double tau = 0x1p-40;
    const dal_run_spec spec[] = {coupled(1.0, 1.0, 1.0), coupled(0x1p-60, 0x1p50, tau)};
    double exponent[2][4], unit[2];
    for (int k = 0; k < 2; k++) {
        dal_lyapunov *s;
        CU_ASSERT_EQUAL_FATAL(dal_lyapunov_create(&s, &spec[k], NULL, 0, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL_FATAL(dal_lyapunov_count(s), 4);
        CU_ASSERT_EQUAL(dal_lyapunov_advance(s, 400, NULL), DAL_STATUS_OK);
        for (int i = 0; i < 4; i++) exponent[k][i] = fixture_exponent(s, i);
        unit[k] = dal_lyapunov_time_unit(s);
        dal_lyapunov_free(s);
    }
    CU_ASSERT_EQUAL(unit[1] * tau, unit[0]);
    for (int i = 0; i < 4; i++) CU_ASSERT_DOUBLE_EQUAL(exponent[1][i] / tau, exponent[0][i], 1e-9);
}

static void test_refused(void)
{
    dal_scaled *scaled;
    dal_error error;
    const dal_setting unknown = {"mass", 1.0};
    const dal_run_spec spec = {
        .system = fixture_system("chaplygin-sleigh"), .parameters = &unknown, .parameter_count = 1};
    CU_ASSERT_EQUAL(dal_scaled_create(&scaled, &spec, &error), DAL_STATUS_NAME);
    CU_ASSERT_PTR_NULL(scaled);
}

void suite_scaled(void)
{
    CU_pSuite suite = CU_add_suite("scaled systems", NULL, NULL);
    CU_add_test(suite, "the same motions", test_motions);
    CU_add_test(suite, "positions that are projected, and reactions", test_holonomic);
    CU_add_test(suite, "derivatives of scaled callbacks", test_derivatives);
    CU_add_test(suite, "what the mass matrix solves", test_mass);
    CU_add_test(suite, "the potential", test_potential);
    CU_add_test(suite, "units of an oscillator", test_units);
    CU_add_test(suite, "a coordinate that rests", test_coordinate_at_rest);
    CU_add_test(suite, "a coordinate whose forces balance", test_balanced_coordinate);
    CU_add_test(suite, "units at the state of a run", test_run);
    CU_add_test(suite, "an energy that is conserved in all units", test_energy);
    CU_add_test(suite, "an energy whose terms cancel", test_cancelling_energy);
    CU_add_test(suite, "orders in other units", test_order);
    CU_add_test(suite, "exponents in other units", test_exponents);
    CU_add_test(suite, "unknown parameters", test_refused);
}
