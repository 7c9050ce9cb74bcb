/* test_lyapunov.c - Lyapunov exponents and phase volume. */
#include "allocation.h"
#include "analysis/differences.h"
#include "fixtures.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <string.h>

/* ---- exponents ---- */

/* The exponents of a fixture after a transient and then steps more. */
static dal_lyapunov *lyapunov_of(const char *model, const char *method, double step,
                                 long long transient, long long steps)
{
    dal_lyapunov *s = NULL;
    dal_error error = {0};
    const dal_run_spec spec = fixture_spec(fixture_system(model), method, DAL_PHYSICAL, step);
    const dal_system *tangent = fixture_tangent(model);
    CU_ASSERT_EQUAL_FATAL(dal_lyapunov_create(&s, &spec, tangent, 0, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_lyapunov_advance(s, transient, &error), DAL_STATUS_OK);
    dal_lyapunov_discard_transient(s);
    CU_ASSERT_EQUAL(dal_lyapunov_advance(s, steps, &error), DAL_STATUS_OK);
    return s;
}

/* log|R(a + ib)| of the stability functions R = 1 + z + z^2/2 + z^3/6 + z^4/24 by Horner's rule,
 * and R = (1 + z/2)/(1 - z/2). */
static double log_rk4(double a, double b)
{
    double x = 1.0, y = 0.0;
    for (int k = 4; k >= 1; k--) {
        const double next = 1.0 + (a * x - b * y) / k;
        y = (a * y + b * x) / k;
        x = next;
    }
    return log(hypot(x, y));
}

static double log_midpoint(double a, double b)
{
    return log(hypot(1.0 + a / 2.0, b / 2.0) / hypot(1.0 - a / 2.0, b / 2.0));
}

/* x'' = x: the step map is R(h A) with A's eigenvalues 1 and -1 and orthogonal eigenvectors. */
static void test_saddle(void)
{
    const double h = 0.1;
    dal_lyapunov *s =
        lyapunov_of("coordinates: [x]\naccelerations: {x: x}\nstart: {x: 0}\n", "rk4", h, 300, 200);
    CU_ASSERT(dal_lyapunov_is_exact(s));
    CU_ASSERT(dal_lyapunov_is_whole(s));
    CU_ASSERT_EQUAL_FATAL(dal_lyapunov_count(s), 2);
    CU_ASSERT_DOUBLE_EQUAL(fixture_exponent(s, 0), log_rk4(h, 0.0) / h, 1e-13);
    CU_ASSERT_DOUBLE_EQUAL(fixture_exponent(s, 1), log_rk4(-h, 0.0) / h, 1e-13);
    CU_ASSERT_EQUAL(fixture_divergence(s), 0.0);
    dal_lyapunov_free(s);
}

/* x'' = -x - k x': a spiral; det J = |R(h lambda)|^2 in every step. */
static void test_spiral(void)
{
    const double h = 0.1, k = 0.3;
    const double a = -h * k / 2.0, b = h * sqrt(1.0 - k * k / 4.0);
    const double by_rk4 = log_rk4(a, b) / h, by_midpoint = log_midpoint(a, b) / h;
    const char *const model = "coordinates: [x]\naccelerations: {x: -x - 0.3*x'}\nstart: {x: 1}\n";
    dal_lyapunov *s = lyapunov_of(model, "rk4", h, 0, 20000);
    CU_ASSERT_DOUBLE_EQUAL(fixture_sum(s), 2.0 * by_rk4, 1e-13);
    CU_ASSERT_DOUBLE_EQUAL(fixture_divergence(s), -k, 1e-15);
    CU_ASSERT_DOUBLE_EQUAL(fixture_exponent(s, 0), by_rk4, 1e-3); /* turning vectors: 2/T at most */
    CU_ASSERT_DOUBLE_EQUAL(fixture_exponent(s, 1), by_rk4, 1e-3);
    dal_lyapunov_free(s);
    s = lyapunov_of(model, "implicit-midpoint", h, 0, 100);
    CU_ASSERT_DOUBLE_EQUAL(fixture_sum(s), 2.0 * by_midpoint, 1e-13);
    dal_lyapunov_free(s);
}

/* Lorenz's system as velocities: 0.9056, 0, -14.5723 (Sprott, Chaos and Time-Series Analysis, 2003,
 * 4.8.2), three 0 of the coordinates; the divergence is -(10 + 1 + 8/3) everywhere. */
static const char lorenz[] = "coordinates: [a, b, c]\n"
                             "accelerations: {a: 10*(b' - a'), b: a'*(28 - c') - b',\n"
                             "                c: a'*b' - 8/3*c'}\n"
                             "start: {a': 1, b': 1, c': 20}\n";

enum { LONG = 40000 };

static void test_lorenz(void)
{
    const long long steps = long_run(LONG);
    dal_lyapunov *s = lyapunov_of(lorenz, "rk4", 0.01, 2000, steps);
    dal_average a;
    CU_ASSERT_DOUBLE_EQUAL(fixture_divergence(s), -41.0 / 3.0, 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(fixture_sum(s), -41.0 / 3.0, 1e-3);
    dal_lyapunov_exponent(s, 0, &a);
    if (steps == LONG) {
        CU_ASSERT(a.low < 0.9056 && 0.9056 < a.high && a.high - a.low < 0.2);
        for (int i = 1; i < 5; i++) CU_ASSERT_DOUBLE_EQUAL(fixture_exponent(s, i), 0.0, 0.05);
        CU_ASSERT_DOUBLE_EQUAL(fixture_exponent(s, 5), -14.5723, 0.05);
    }
    dal_lyapunov_free(s);
}

/* Henon and Heiles at E = 1/8, a chaotic orbit; a symplectic map has exponents in pairs. */
static void test_pairs(void)
{
    const long long steps = long_run(LONG);
    dal_lyapunov *s = lyapunov_of("coordinates: [x, y]\n"
                                  "lagrangian: >-\n"
                                  "  (x'^2 + y'^2 - x^2 - y^2)/2 - x^2*y + y^3/3\n"
                                  "start: {y: -0.25, x': 0.4208127057650699}\n",
                                  "stormer-verlet", 0.05, 1000, steps);
    dal_average a;
    CU_ASSERT_DOUBLE_EQUAL(fixture_sum(s), 0.0, 1e-13);
    CU_ASSERT_EQUAL(fixture_divergence(s), 0.0);
    dal_lyapunov_exponent(s, 0, &a);
    if (steps == LONG) {
        CU_ASSERT(a.low > 0.02 && a.high < 0.15);
        CU_ASSERT_DOUBLE_EQUAL(fixture_exponent(s, 0) + fixture_exponent(s, 3), 0.0, 1e-2);
        CU_ASSERT_DOUBLE_EQUAL(fixture_exponent(s, 1), 0.0, 1e-2);
        CU_ASSERT_DOUBLE_EQUAL(fixture_exponent(s, 2), 0.0, 1e-2);
    }
    dal_lyapunov_free(s);
}

/* ---- the tangent system against differences ---- */

static void compare_ways(const char *model, const char *method, double tolerance)
{
    dal_lyapunov *way[2] = {NULL, NULL};
    const dal_run_spec spec = fixture_spec(fixture_system(model), method, DAL_PHYSICAL, 0.05);
    const dal_system *tangent = fixture_tangent(model);
    for (int k = 0; k < 2; k++) {
        const dal_system *given = k == 0 ? tangent : NULL;
        CU_ASSERT_EQUAL_FATAL(dal_lyapunov_create(&way[k], &spec, given, 0, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_lyapunov_advance(way[k], 10, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_lyapunov_is_exact(way[k]), k == 0);
    }
    for (int i = 0; i < dal_lyapunov_count(way[0]); i++)
        CU_ASSERT_DOUBLE_EQUAL(fixture_exponent(way[0], i), fixture_exponent(way[1], i), tolerance);
    CU_ASSERT_DOUBLE_EQUAL(fixture_divergence(way[0]), fixture_divergence(way[1]), 0.0);
    for (int k = 0; k < 2; k++) dal_lyapunov_free(way[k]);
}

static void test_ways(void)
{
    static const char *const methods[] = {
        "rk4", "symplectic-euler-10",       "stormer-verlet", "gauss4", "lobatto4", "dop853",
        "bm4", "implicit-midpoint+yoshida4"};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++)
        compare_ways(fixture_full, methods[i], 1e-9);
}

/* A system of small lengths: increments of 2e-3 lead round the circle many times. */
static void test_small_lengths(void)
{
    const char *const model = "coordinates: [x]\n"
                              "accelerations: {x: -1e-5*sin(x*7e4) - 0.1*x'}\n"
                              "start: {x: 1e-5}\n";
    compare_ways(model, "rk4", 1e-6);
    compare_ways(model, "gauss4", 1e-6);
}

/* ---- what a step map has ---- */

static void test_rank(void)
{
    static const char *const forcing[] = {"gauss4+project", "mclachlan-perlmutter", "dla"};
    dal_lyapunov *s = NULL;
    dal_error error;
    const dal_system *tangent = fixture_tangent("chaplygin-sleigh-offset");
    for (size_t i = 0; i < sizeof forcing / sizeof *forcing; i++) {
        const dal_run_spec spec =
            fixture_spec(fixture_system("chaplygin-sleigh-offset"), forcing[i], DAL_PHYSICAL, 0.05);
        CU_ASSERT_EQUAL_FATAL(dal_lyapunov_create(&s, &spec, tangent, 0, &error), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_lyapunov_count(s), 5);
        CU_ASSERT(dal_lyapunov_is_whole(s) && !dal_lyapunov_is_exact(s));
        CU_ASSERT_EQUAL(dal_lyapunov_advance(s, 20, &error), DAL_STATUS_OK);
        dal_lyapunov_free(s);
        CU_ASSERT_EQUAL(dal_lyapunov_create(&s, &spec, NULL, 2, &error), DAL_STATUS_OK);
        CU_ASSERT(!dal_lyapunov_is_whole(s));
        dal_lyapunov_free(s);
        CU_ASSERT_EQUAL(dal_lyapunov_create(&s, &spec, tangent, 6, &error), DAL_STATUS_ARGUMENT);
        CU_ASSERT_PTR_NULL(s);
        CU_ASSERT(strstr(error.message, "the step map has 5") != NULL);
        CU_ASSERT(error.line == 0 && error.column == 0);
    }
}

/* ---- what the shipped systems say of their measure ---- */

static bool has_tag(const dal_system *system, const char *tag)
{
    for (int i = 0; i < system->tags; i++)
        if (strcmp(system->tag[i], tag) == 0) return true;
    return false;
}

/* A density of the phase space that grows without bound along a motion that does not return spoils
 * the mean: y = b t of the free particle, the speed on the incline. */
static bool returns(const char *name)
{
    return strcmp(name, "nonholonomic-particle-free") != 0 &&
           strcmp(name, "chaplygin-sleigh-incline") != 0;
}

static void check_tags(const char *model, const char *name)
{
    const dal_system *system = fixture_system(model);
    const bool kept = has_tag(system, "measure-preserving"), lost = has_tag(system, "attractor");
    dal_average a;
    CU_ASSERT(!kept || !lost);
    if (system->multipliers || system->holonomic || !returns(name) || !(kept || lost)) return;
    dal_lyapunov *s = lyapunov_of(model, "rk4", 0.05, 0, 500);
    dal_lyapunov_divergence(s, &a);
    const bool is_zero = fabs(a.mean) < 1e-14 || (a.low < 0.0 && 0.0 < a.high);
    const bool is_right = kept ? is_zero : a.mean < -0.1;
    if (!is_right) printf("\n  %s: %g (%g %g)\n", name, a.mean, a.low, a.high);
    CU_ASSERT(is_right);
    CU_ASSERT_DOUBLE_EQUAL(fixture_sum(s), a.mean, 1e-2);
    dal_lyapunov_free(s);
}

static void test_tags(void)
{
    const char *name;
    for (int i = 0; (name = dal_builtin_name(i)) != NULL; i++) {
        check_tags(name, name);
    }
}

/* On D = 0 the sum is the divergence whatever forces D: the mean over the surface is the same. */
static void test_attractor(void)
{
    static const char *const methods[] = {"gauss4", "gauss4+project"};
    const char *const model = "chaplygin-sleigh-offset";
    for (int i = 0; i < 2; i++) {
        dal_lyapunov *s = lyapunov_of(model, methods[i], 0.02, 500, 500);
        CU_ASSERT(fixture_divergence(s) < -0.1);
        CU_ASSERT_DOUBLE_EQUAL(fixture_sum(s), fixture_divergence(s), 1e-3);
        dal_lyapunov_free(s);
        /* Without a transient: nothing but the density, of order 1, may come in. */
        s = lyapunov_of(model, methods[i], 0.02, 0, 100);
        CU_ASSERT_DOUBLE_EQUAL(2.0 * fixture_sum(s), 2.0 * fixture_divergence(s), 0.5);
        dal_lyapunov_free(s);
    }
}

/* The sleigh with J = I + m a^2 = 4, m = a = 1: on D = 0 the divergence is -(m a/J) v with v = V
 * tanh tau and dtau/dt = V/4, so that its integral is -log(cosh tau/cosh tau0). */
static void test_full_turn(void)
{
    const double V = sqrt(0.8 * 0.8 + 1.0), tau0 = asinh(-0.8), T = 10.0;
    const double exact = -log(cosh(tau0 + V / 4.0 * T) / cosh(tau0)) / T;
    dal_lyapunov *s = lyapunov_of("chaplygin-sleigh-full-turn", "gauss8", 0.02, 0, 500);
    CU_ASSERT_DOUBLE_EQUAL(fixture_sum(s), exact, 1e-6);
    CU_ASSERT_DOUBLE_EQUAL(fixture_divergence(s), exact, 1e-5);
    dal_lyapunov_free(s);
}

static void test_vakonomic(void)
{
    const char *const name = "chaplygin-sleigh-vakonomic";
    const dal_run_spec spec = fixture_spec(fixture_system(name), "gauss6", DAL_PHYSICAL, 0.05);
    double first[2];
    for (int exact = 0; exact < 2; exact++) {
        dal_lyapunov *s = NULL;
        const dal_system *tangent = exact ? fixture_tangent(name) : NULL;
        CU_ASSERT_EQUAL_FATAL(dal_lyapunov_create(&s, &spec, tangent, 0, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_lyapunov_count(s), 7);
        CU_ASSERT_EQUAL(dal_lyapunov_is_exact(s), exact);
        CU_ASSERT_EQUAL(dal_lyapunov_advance(s, 100, NULL), DAL_STATUS_OK);
        CU_ASSERT_DOUBLE_EQUAL(fixture_sum(s), fixture_divergence(s), 1e-5);
        first[exact] = fixture_exponent(s, 0);
        dal_lyapunov_free(s);
    }
    CU_ASSERT_DOUBLE_EQUAL(first[1], first[0], 1e-8); /* of differences */
}

static void test_same_bits(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system(fixture_full), "gauss4", DAL_PHYSICAL, 0.05);
    dal_run *run = fixture_run(&spec);
    dal_lyapunov *s = lyapunov_of(fixture_full, "gauss4", 0.05, 7, 23);
    size_t count, other;
    CU_ASSERT_EQUAL(dal_run_advance(run, 30, NULL), DAL_STATUS_OK);
    const double *memory = dal_run_save(run, &count);
    CU_ASSERT_EQUAL(
        memcmp(memory, dal_run_save(dal_lyapunov_run(s), &other), count * sizeof *memory), 0);
    dal_lyapunov_free(s);
    dal_run_free(run);
}

/* ---- the lift ---- */

/* log R(z) of gauss4. */
static double log_gauss4(double z)
{
    return log((1.0 + z / 2.0 + z * z / 12.0) / (1.0 - z / 2.0 + z * z / 12.0));
}

/* The exponents of the lift from a start, after a transient. */
static dal_lyapunov *lifted_of(const char *model, const char *method, double step,
                               const dal_setting *start, int count)
{
    dal_lyapunov *s = NULL;
    dal_error error = {0};
    dal_run_spec spec = fixture_spec(fixture_system(model), method, DAL_LIFTED, step);
    spec.start = start;
    spec.start_count = count;
    const dal_system *tangent = fixture_tangent(model);
    CU_ASSERT_EQUAL_FATAL(dal_lyapunov_create_lifted(&s, &spec, tangent, 0, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_lyapunov_advance(s, 1200, &error), DAL_STATUS_OK);
    dal_lyapunov_discard_transient(s);
    CU_ASSERT_EQUAL(dal_lyapunov_advance(s, 100, &error), DAL_STATUS_OK);
    CU_ASSERT(dal_lyapunov_is_exact(s) && dal_lyapunov_is_whole(s));
    return s;
}

/* Ends what lifted_of began: the exponents are these, and their sum agrees with div = 0. */
static void check_lifted(dal_lyapunov *s, const double *expected)
{
    dal_balance balance;
    CU_ASSERT_EQUAL_FATAL(dal_lyapunov_count(s), 4);
    for (int i = 0; i < 4; i++) CU_ASSERT_DOUBLE_EQUAL(fixture_exponent(s, i), expected[i], 1e-11);
    CU_ASSERT_EQUAL(fixture_divergence(s), 0.0);
    CU_ASSERT_EQUAL(dal_lyapunov_balance(s, &balance, NULL), DAL_STATUS_OK);
    CU_ASSERT_TRUE(balance.holds);
    dal_lyapunov_free(s);
}

/* x'' = 2 x - x': the eigenvalues 1 and -2 of (x, x'), and -1 and 2 of (p, pi), on p = pi = 0. */
static void test_lift(void)
{
    static const char model[] = "coordinates: [x]\naccelerations: {x: 2*x - x'}\nstart: {x: 0}\n";
    static const double eigenvalue[] = {2.0, 1.0, -1.0, -2.0};
    const double h = 0.1;
    double by_rk4[4], by_gauss4[4];
    for (int i = 0; i < 4; i++) {
        by_rk4[i] = log_rk4(h * eigenvalue[i], 0.0) / h;
        by_gauss4[i] = log_gauss4(h * eigenvalue[i]) / h;
    }
    check_lifted(lifted_of(model, "rk4", h, NULL, 0), by_rk4);
    check_lifted(lifted_of(model, "gauss4", h, NULL, 0), by_gauss4);
}

/* x'' = 1 + a x^2 - x' + pi, p' = -2 a x pi, pi' = -p + pi rest at x = 0, p = pi = -1; with
 * a = 0.105 the eigenvalues have lambda^4 - lambda^2 + 2 a = 0: lambda^2 = 0.7 and 0.3. */
static void test_pairs_of_lift(void)
{
    static const char model[] =
        "coordinates: [x]\naccelerations: {x: 1 + 0.105*x^2 - x'}\nstart: {x: 0}\n";
    const dal_setting start[] = {{"p_x", -1.0}, {"pi_x", -1.0}};
    const double h = 0.1, a = log_gauss4(h * sqrt(0.7)) / h, b = log_gauss4(h * sqrt(0.3)) / h;
    check_lifted(lifted_of(model, "gauss4", h, start, 2), (double[]){a, b, -b, -a});
}

/* Sums of pairs, and of all: J is symplectic, wherever p and pi are. */
static void test_symplectic_lift(void)
{
    static const char *const methods[] = {"gauss4", "stormer-verlet", "implicit-midpoint+yoshida4"};
    const dal_setting start[] = {{"p_x", 0.1}, {"pi_y", 0.2}};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        dal_lyapunov *s = lifted_of("heisenberg", methods[i], 0.02, start, 2);
        CU_ASSERT_EQUAL(dal_lyapunov_count(s), 12);
        CU_ASSERT_DOUBLE_EQUAL(fixture_sum(s), 0.0, 1e-11);
        dal_lyapunov_free(s);
    }
}

/* ---- holonomic constraints ---- */

/* A pendulum at rest upside down: 1 and -1, on the tangent space of g = 0. */
static void test_holonomic(void)
{
    static const char model[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - y\n"
                                "holonomic: [x^2 + y^2 - 1]\nstart: {y: 1}\n";
    const double h = 0.1;
    dal_balance balance;
    dal_lyapunov *s = lyapunov_of(model, "gauss4", h, 100, 100);
    CU_ASSERT_EQUAL_FATAL(dal_lyapunov_count(s), 2);
    CU_ASSERT(dal_lyapunov_is_whole(s) && !dal_lyapunov_is_exact(s));
    CU_ASSERT_DOUBLE_EQUAL(fixture_exponent(s, 0), log_gauss4(h) / h, 1e-9);
    CU_ASSERT_DOUBLE_EQUAL(fixture_exponent(s, 1), log_gauss4(-h) / h, 1e-9);
    CU_ASSERT_EQUAL(dal_lyapunov_balance(s, &balance, NULL), DAL_STATUS_OK);
    CU_ASSERT_TRUE(balance.holds);
    dal_lyapunov_free(s);
}

/* ---- what is refused ---- */

static void test_refuses(void)
{
    dal_lyapunov *s = NULL;
    dal_error error;
    dal_run_spec spec = fixture_spec(fixture_system("chaplygin-sleigh"), "gni", DAL_PHYSICAL, 0.05);
    CU_ASSERT_EQUAL(dal_lyapunov_create(&s, &spec, NULL, 0, &error), DAL_STATUS_UNSUPPORTED);
    CU_ASSERT(strstr(error.message, "has a multiplier") != NULL);
    CU_ASSERT(error.line == 0 && error.column == 0);
    spec = fixture_spec(fixture_system("chaplygin-sleigh"), "dop853", DAL_PHYSICAL, 0.05);
    spec.options.tolerance = 1e-8;
    CU_ASSERT_EQUAL(dal_lyapunov_create(&s, &spec, NULL, 0, &error), DAL_STATUS_UNSUPPORTED);
    CU_ASSERT(strstr(error.message, "tolerance") != NULL);
    CU_ASSERT(error.line == 0 && error.column == 0);
    spec.options.tolerance = 0.0;
    CU_ASSERT_EQUAL(dal_lyapunov_create_lifted(&s, &spec, NULL, 0, &error), DAL_STATUS_UNSUPPORTED);
    CU_ASSERT(strstr(error.message, "no tangent system") != NULL);
    const dal_system *tangent = fixture_tangent("chaplygin-sleigh");
    spec = fixture_spec(spec.system, "spark2", DAL_LIFTED, 0.05);
    CU_ASSERT_EQUAL(dal_lyapunov_create_lifted(&s, &spec, tangent, 0, &error),
                    DAL_STATUS_UNSUPPORTED);
    CU_ASSERT(strstr(error.message, "spark2: its step uses more") != NULL);
    CU_ASSERT_EQUAL(dal_lyapunov_create(&s, &spec, NULL, -1, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_PTR_NULL(s);
}

/* Friction by which a step of symplectic Euler takes v to 0 begins after the vectors did; a unit of
 * momenta, an action over a length, is beyond all numbers. */
static void test_fails(void)
{
    static const char stops[] = "coordinates: [x]\nstart: {x': 1}\n"
                                "accelerations: {x: -4*(1 + sign(t - 0.45))*x'}\n";
    static const char short_length[] = "coordinates: [x, y]\nstart: {x: 1e-200, y: 1, y': 1e150}\n"
                                       "accelerations: {x: 0, y: 0}\n";
    dal_lyapunov *s = NULL;
    dal_error error = {0};
    for (int k = 0; k < 2; k++) {
        const dal_run_spec spec =
            fixture_spec(fixture_system(stops), "symplectic-euler", DAL_PHYSICAL, 0.125);
        CU_ASSERT_EQUAL_FATAL(
            dal_lyapunov_create(&s, &spec, k ? fixture_tangent(stops) : NULL, 0, NULL),
            DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_lyapunov_advance(s, 20, &error), DAL_STATUS_SINGULAR);
        CU_ASSERT(strstr(error.message, "the derivative of the step takes a vector to 0") != NULL);
        dal_lyapunov_free(s);
    }
    const dal_run_spec spec = fixture_spec(fixture_system(short_length), "rk4", DAL_LIFTED, 0.125);
    CU_ASSERT_EQUAL(dal_lyapunov_create_lifted(&s, &spec, fixture_tangent(short_length), 0, &error),
                    DAL_STATUS_NOT_FINITE);
    CU_ASSERT(strstr(error.message, "is not finite: inf") != NULL);
    CU_ASSERT_PTR_NULL(s);
}

/* Two springs, at rest at 0.  Every fourth call, the first stage of a step of rk4, is at the state
 * itself: it counts those whose largest component is no multiple of the increment. */
static int calls, others;

static dal_status two_springs(const dal_system *system, const dal_point *at, double *out)
{
    (void)system;
    out[0] = -at->q[0], out[1] = -2.0 * at->q[1];
    if (calls++ % 4 != 0) return DAL_STATUS_OK;
    const double size =
        fmax(fmax(fabs(at->q[0]), fabs(at->q[1])), fmax(fabs(at->v[0]), fabs(at->v[1]))) /
        DAL__INCREMENT;
    others += !(fabs(size - round(size)) < 1e-12);
    return DAL_STATUS_OK;
}

static void test_increments(void)
{
    const dal_system system = {.name = "springs", .n = 2, .call.field = two_springs};
    const dal_run_spec spec = fixture_spec(&system, "rk4", DAL_PHYSICAL, 0.1);
    dal_lyapunov *s = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_lyapunov_create(&s, &spec, NULL, 4, NULL), DAL_STATUS_OK);
    calls = others = 0;
    CU_ASSERT_EQUAL(dal_lyapunov_advance(s, 10, NULL), DAL_STATUS_OK);
    CU_ASSERT(calls >= 10 * 4 * 4 * 8);
    CU_ASSERT_EQUAL(others, 0);
    dal_lyapunov_free(s);
}

static void test_out_of_memory(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system(fixture_bilinear), "rk4", DAL_PHYSICAL, 0.25);
    allocation_trial trial = {0};
    while (allocation_next(&trial)) {
        dal_lyapunov *s = NULL;
        allocation_start(&trial);
        allocation_end(&trial, dal_lyapunov_create(&s, &spec, NULL, 0, NULL));
        dal_lyapunov_free(s);
    }
    CU_ASSERT(trial.failures >= 6);
}

void suite_lyapunov(void)
{
    CU_pSuite suite = CU_add_suite("exponents and volume", NULL, NULL);
    CU_add_test(suite, "a saddle, closed form", test_saddle);
    CU_add_test(suite, "a spiral, closed form", test_spiral);
    CU_add_test(suite, "Lorenz", test_lorenz);
    CU_add_test(suite, "Henon and Heiles: pairs", test_pairs);
    CU_add_test(suite, "tangent system against differences", test_ways);
    CU_add_test(suite, "small lengths", test_small_lengths);
    CU_add_test(suite, "directions of a step map", test_rank);
    CU_add_test(suite, "an attractor", test_attractor);
    CU_add_test(suite, "a full turn of the sleigh, closed form", test_full_turn);
    CU_add_test(suite, "the measures of the shipped systems", test_tags);
    CU_add_test(suite, "vakonomic motion", test_vakonomic);
    CU_add_test(suite, "the trajectory is a run's", test_same_bits);
    CU_add_test(suite, "the lift, on p = pi = 0", test_lift);
    CU_add_test(suite, "the lift, off p = pi = 0", test_pairs_of_lift);
    CU_add_test(suite, "sums of the lift", test_symplectic_lift);
    CU_add_test(suite, "holonomic constraints", test_holonomic);
    CU_add_test(suite, "what is refused", test_refuses);
    CU_add_test(suite, "steps that fail", test_fails);
    CU_add_test(suite, "increments of differences", test_increments);
    CU_add_test(suite, "out of memory", test_out_of_memory);
}
