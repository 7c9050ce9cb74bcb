/* test_units.c - runs in other units: with
 *
 *     q_i = s_i Q_i,   t = tau T,   L' = c L,   D' = d D
 *
 * and powers of two, the same motion has the same bits: Q_i s_i = q_i, V_i s_i/tau = v_i. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>

/* The units of a run; what is 0 is 1. */
typedef struct units {
    double s[3], tau, c, d;
} units;

static const units one = {{1.0, 1.0, 1.0}, 1.0, 1.0, 1.0};
static const units others[] = {
    {{0x1p-30, 0x1p40, 0x1p3}, 0x1p-20, 0x1p5, 0x1p-9},
    {{0x1p60, 0x1p-59, 0x1p-1}, 0x1p9, 0x1p-60, 0x1p60},
    {{0x1p-7, 0x1p-7, 0x1p-60}, 0x1p-60, 0x1p31, 0x1p-31},
};
enum { OTHERS = 3 };

/* A system of x, y, z as a text in which these are in units: sx*x, ux*x', tau*t; L times c, D times
 * d.  As parameters the units change no formula. */
static const dal_system *in_units(const char *text, const units *u)
{
    char yaml[2048];
    snprintf(yaml, sizeof yaml,
             "parameters: {sx: %.17g, sy: %.17g, sz: %.17g, ux: %.17g, uy: %.17g, uz: %.17g, "
             "tau: %.17g, c: %.17g, d: %.17g}\n%s",
             u->s[0], u->s[1], u->s[2], u->s[0] / u->tau, u->s[1] / u->tau, u->s[2] / u->tau,
             u->tau, u->c, u->d, text);
    return fixture_system(yaml);
}

static dal_run_spec spec_in_units(const char *text, const units *u, const char *method, double h)
{
    dal_run_spec spec = fixture_spec(in_units(text, u), method, DAL_PHYSICAL, h / u->tau);
    spec.options.sums = DAL_SUMS_PLAIN;
    return spec;
}

static dal_run *run_in_units(const char *text, const units *u, const char *method, double h,
                             long long steps, const dal_options *options)
{
    dal_run_spec spec = spec_in_units(text, u, method, h);
    if (options) {
        spec.options.tolerance = options->tolerance;
        spec.options.solver = options->solver;
        spec.options.precision = options->precision;
    }
    return fixture_stepped(&spec, steps);
}

/* Whether two runs have the same state up to their units, to a number of roundings. */
static bool is_same(const dal_run *run, const units *u, const dal_run *plain, int n,
                    double roundings)
{
    const double *Y = dal_run_state(run), *y = dal_run_state(plain);
    bool same = true;
    for (int i = 0; i < 2 * n; i++) {
        const double unit = u->s[i % n] / (i < n ? 1.0 : u->tau);
        same = same && fabs(Y[i] * unit - y[i]) <= roundings * 0x1p-53 * fabs(y[i]);
        if (!same) printf("\n  number %d: %a, not %a", i + 1, Y[i] * unit, y[i]);
    }
    return same;
}

/* The same bits, and as many evaluations, by a method in all units. */
static void check_same_with(const char *text, const char *method, double h, long long steps,
                            const dal_options *options)
{
    dal_run *plain = run_in_units(text, &one, method, h, steps, options);
    const int n = dal_run_dimension(plain) / 2;
    for (int i = 0; i < OTHERS; i++) {
        dal_run *run = run_in_units(text, &others[i], method, h, steps, options);
        if (!run || !is_same(run, &others[i], plain, n, 0.0)) {
            CU_FAIL("other bits in other units");
            printf("\n  %s in units %d", method, i + 1);
        }
        CU_ASSERT_EQUAL(dal_run_evaluations(run), dal_run_evaluations(plain));
        dal_run_free(run);
    }
    dal_run_free(plain);
}

static void check_same(const char *text, const char *method, double h, long long steps)
{
    check_same_with(text, method, h, steps, NULL);
}

/* A double pendulum, whose W is full. */
static const char pendulum[] =
    "coordinates: [x, y]\n"
    "lagrangian: c*((ux*x')^2 + (uy*y')^2/2 + cos(sx*x - sy*y)*ux*x'*uy*y'\n"
    "  + 2*cos(sx*x) + cos(sy*y))\n"
    "start: {x: 1.5/sx, y: 0.5/sy, x': 0.25/ux}\n";
/* W is 0 on the diagonal, and indefinite. */
static const char crossed[] = "coordinates: [x, y]\n"
                              "lagrangian: c*(ux*x'*uy*y' - sx*x*sy*y)\n"
                              "start: {x: 1/sx, y': 0.5/uy}\n";
static const char triangle[] =
    "coordinates: [x, y, z]\n"
    "lagrangian: c*(ux*x'*uy*y' + uy*y'*uz*z' + uz*z'*ux*x' - (sx*x)^2 - (sz*z)^2)\n"
    "start: {x: 1/sx, z: 0.5/sz}\n";
static const char partly[] =
    "coordinates: [x, y, z]\n"
    "lagrangian: c*(ux*x'*uy*y' + uy*y'*uz*z' + (uz*z')^2 - (sx*x)^2 - (sz*z)^2)/2\n"
    "start: {x: 1/sx, z: 0.5/sz}\n";
static const char rolling[] =
    "coordinates: [x, y, z]\n"
    "lagrangian: c*((ux*x')^2 + 3*(uy*y')^2 + (uz*z')^2 - (sx*x)^2 - (sz*z)^2)/2\n"
    "constraints: [d*(sy*y*ux*x' + uy*y' + uz*z'), d*(ux*x' - sx*x*uz*z')]\n"
    "start: {x: 1/sx, y: 0.125/sy, x': 1/ux, y': -1.125/uy, z': 1/uz}\n";

static void test_pivots(void)
{
    static const char *const texts[] = {pendulum, crossed, triangle, partly, rolling};
    for (int i = 0; i < 5; i++) check_same(texts[i], "rk4", 0x1p-5, 100);
}

/* ---- norms ---- */

/* D is 0 in all of the motion; two constraints of unlike size. */
static const char unlike[] =
    "coordinates: [x, y, z]\n"
    "lagrangian: c*(3*(ux*x')^2 + (uy*y')^2 + 5*(uz*z')^2 - (sx*x)^2 - 2*sx*x*uy*y' - (sz*z)^2)/2\n"
    "constraints: [d*(sy*y*ux*x' + uy*y' + uz*z'), 64*d*(ux*x' - sx*x*uz*z')]\n"
    "start: {x: 1/sx, y: 0.125/sy, x': 1/ux, y': -1.125/uy, z': 1/uz}\n";

/* Implicit equations end after as many iterations, at the same numbers. */
static void test_solvers(void)
{
    static const char *const methods[] = {"gauss4",
                                          "gauss8",
                                          "symplectic-euler-11",
                                          "lobatto6",
                                          "rk4+project",
                                          "rk4+project-energy",
                                          "gauss4+symmetric-project",
                                          "dla",
                                          "gni",
                                          "spark4",
                                          "gauss-spark4",
                                          "lobatto-nonholonomic4",
                                          "mclachlan-perlmutter"};
    static const char *const texts[] = {pendulum, crossed, triangle, partly};
    dal_options newton = dal_options_default();
    newton.solver = DAL_NEWTON;
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        check_same(rolling, methods[i], 0x1p-3, 30);
        check_same(unlike, methods[i], 0x1p-3, 30);
    }
    for (int i = 0; i < 4; i++) check_same(texts[i], "gauss6", 0x1p-2, 30);
    for (int i = 0; i < 4; i++) check_same_with(texts[i], "gauss6", 0x1p-2, 30, &newton);
    for (int i = 0; i < 4; i++) check_same_with(texts[i], "implicit-midpoint", 0x1p-2, 30, &newton);
}

/* Substeps have the same sizes: the absolute part of a tolerance has the units of x, and the series
 * of taylor are in a unit of t. */
static void test_tolerances(void)
{
    static const char *const texts[] = {pendulum, crossed, triangle, partly, rolling, unlike};
    dal_options options = dal_options_default();
    for (int i = 0; i < 6; i++) {
        options.tolerance = 1e-6;
        check_same_with(texts[i], "dop853", 1.0, 8, &options);
        options.tolerance = 1e-12;
        check_same_with(texts[i], "dop853", 1.0, 8, &options);
        check_same_with(texts[i], "taylor", 1.0, 8, &options);
        options.tolerance = 1e-15;
        check_same_with(texts[i], "taylor", 1.0, 8, &options);
        check_same(texts[i], "taylor", 0x1p-5, 8);
        options.precision = DAL_QUAD;
        check_same_with(texts[i], "taylor", 1.0, 1, &options);
        options.precision = DAL_DOUBLE;
    }
}

/* Lanes and single runs have the same bits in other units, too. */
static void test_lanes(void)
{
    for (int i = 0; i < OTHERS; i++) {
        const units *u = &others[i];
        dal_run_spec spec = spec_in_units(pendulum, u, "taylor", 0.5);
        spec.options.tolerance = 1e-10;
        fixture_lanes(spec, 5, 4, "x", 1.0 / u->s[0], 0.25 / u->s[0]);
    }
}

/* A map of a step is as far from the identity. */
static void test_reversibility(void)
{
    double plain = 0.0;
    for (int i = -1; i < OTHERS; i++) {
        const dal_run_spec spec = spec_in_units(unlike, i < 0 ? &one : &others[i], "rk4", 0x1p-2);
        double defect = 0.0;
        CU_ASSERT_EQUAL(dal_check_reversibility(&spec, 0.0, NULL, &defect, NULL), DAL_STATUS_OK);
        if (i < 0) plain = defect;
        CU_ASSERT(defect > 1e-12 && defect < 1.0);
        CU_ASSERT_EQUAL(defect, plain);
    }
}

/* ---- starts ---- */

#define SLEDGE(start)                                                                              \
    "coordinates: [x, y]\n"                                                                        \
    "lagrangian: c*((ux*x')^2 + (uy*y')^2)/2\n"                                                    \
    "constraints: [d*(ux*x' + uy*y')]\n"                                                           \
    "start: {x': 1/ux, y': " start "/uy}\n"

/* A start is as near to D = 0 in all units, and as far from it. */
static void test_start_tolerance(void)
{
    for (int i = -1; i < OTHERS; i++) {
        const units *u = i < 0 ? &one : &others[i];
        dal_run_spec spec = spec_in_units(SLEDGE("-1.000000000001"), u, "rk4", 0x1p-5);
        dal_run_free(fixture_run(&spec));
        spec = spec_in_units(SLEDGE("-1.00000001"), u, "rk4", 0x1p-5);
        fixture_refused(&spec, DAL_STATUS_INCONSISTENT, "violates constraint 1");
    }
}

/* |v| = 1 in the units of one: the nearest velocity to u is u/|u|, here (0.6, 0.8). */
static const char unit_speed[] = "coordinates: [x, y]\n"
                                 "lagrangian: c*((ux*x')^2 + (uy*y')^2)/2\n"
                                 "constraints: [d*((ux*x')^2 + (uy*y')^2 - 1)]\n"
                                 "start: {x': 0.75/ux, y': 1/uy}\n";
/* X + 2 Y = 1 and X - Y = -1: X = -1/3, Y = 2/3. */
static const char solved[] =
    "coordinates: [x, y, z]\n"
    "lagrangian: c*((ux*x')^2 + (uy*y')^2 + (uz*z')^2)/2\n"
    "constraints: [d*(ux*x' + 2*uy*y' - uz*z'), d*(ux*x' - uy*y' + uz*z')]\n"
    "start: {z': 1/uz, solve: [x', y']}\n";

static void check_start(const char *text, double x, double y)
{
    dal_run *plain = NULL;
    for (int i = -1; i < OTHERS; i++) {
        const units *u = i < 0 ? &one : &others[i];
        dal_run_spec spec = spec_in_units(text, u, "rk4", 0x1p-5);
        const int n = spec.system->n;
        spec.options.consistent = 1;
        dal_run *run = fixture_run(&spec);
        const double *v = dal_run_state(run) + n;
        CU_ASSERT_DOUBLE_EQUAL(v[0] * u->s[0] / u->tau, x, 4 * 0x1p-53);
        CU_ASSERT_DOUBLE_EQUAL(v[1] * u->s[1] / u->tau, y, 4 * 0x1p-53);
        if (plain) CU_ASSERT(is_same(run, u, plain, n, 0.0));
        if (plain) dal_run_free(run);
        if (!plain) plain = run;
    }
    dal_run_free(plain);
}

static void test_consistent_starts(void)
{
    check_start(unit_speed, 0.6, 0.8);
    check_start(solved, -1.0 / 3.0, 2.0 / 3.0);
}

#define TWO_SPRINGS(y)                                                                             \
    "coordinates: [x, y]\n"                                                                        \
    "lagrangian: c*((ux*x')^2 + (uy*y')^2 - (sx*x)^2 - (sy*y)^2)/2\n"                              \
    "start: {x: 1/sx, y: " y "/sy}\n"                                                              \
    "exact: {x: cos(tau*t)/sx, y: 0.5*cos(tau*t)/sy}\n"

/* The exact solution fits a start, or does not, in all units: there is an error to observe. */
static void test_exact_solutions(void)
{
    for (int i = -1; i < OTHERS; i++) {
        const units *u = i < 0 ? &one : &others[i];
        dal_run_spec spec = spec_in_units(TWO_SPRINGS("0.5"), u, "rk4", 0x1p-5);
        dal_run *exact = fixture_run(&spec);
        spec = spec_in_units(TWO_SPRINGS("0.500001"), u, "rk4", 0x1p-5);
        dal_run *other = fixture_run(&spec);
        CU_ASSERT_EQUAL(dal_run_observables(exact), dal_run_observables(other) + 1);
        dal_run_free(exact);
        dal_run_free(other);
    }
}

void suite_units(void)
{
    CU_pSuite suite = CU_add_suite("units", NULL, NULL);
    CU_add_test(suite, "pivots", test_pivots);
    CU_add_test(suite, "solvers", test_solvers);
    CU_add_test(suite, "tolerances", test_tolerances);
    CU_add_test(suite, "lanes of series", test_lanes);
    CU_add_test(suite, "reversibility", test_reversibility);
    CU_add_test(suite, "tolerance of starts", test_start_tolerance);
    CU_add_test(suite, "consistent starts", test_consistent_starts);
    CU_add_test(suite, "exact solutions", test_exact_solutions);
}
