/* test_phase_volume.c - exponents where coordinates travel far, and the balance of phase volume. */
#include "fixtures.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <string.h>

/* ---- coordinates that travel far ---- */

static dal_balance balance_of(dal_lyapunov *s)
{
    dal_balance b = {0};
    dal_error error = {0};
    CU_ASSERT_EQUAL(dal_lyapunov_balance(s, &b, &error), DAL_STATUS_OK);
    CU_ASSERT(b.holds && fabs(b.difference) <= b.margin);
    return b;
}

/* A run by differences from the given start, steps long. */
static dal_lyapunov *differences(const char *text, const char *method, const dal_setting *start,
                                 int count, long long steps)
{
    dal_run_spec spec = fixture_spec(fixture_system(text), method, DAL_PHYSICAL, 0.05);
    dal_lyapunov *s = NULL;
    dal_error error = {0};
    spec.start = start;
    spec.start_count = count;
    CU_ASSERT_EQUAL_FATAL(dal_lyapunov_create(&s, &spec, NULL, 0, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_lyapunov_advance(s, steps, &error), DAL_STATUS_OK);
    balance_of(s);
    return s;
}

/* x and y are cyclic: where the sleigh is does not matter, to the bit. */
static void test_translation(void)
{
    static const char *const methods[] = {"rk4", "rk4+project", "gauss4+symmetric-project",
                                          "mclachlan-perlmutter", "rk4+project-energy"};
    const long long steps = 200 / case_stride(8);
    const dal_setting far[] = {{"x", 1e6}, {"y", -3e7}};
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k += (size_t)case_stride(2)) {
        double near[6];
        int count;
        dal_lyapunov *s = differences("chaplygin-sleigh-offset", methods[k], NULL, 0, steps);
        count = dal_lyapunov_count(s);
        for (int i = 0; i < count; i++) near[i] = fixture_exponent(s, i);
        dal_lyapunov_free(s);
        s = differences("chaplygin-sleigh-offset", methods[k], far, 2, steps);
        CU_ASSERT_EQUAL_FATAL(dal_lyapunov_count(s), count);
        for (int i = 0; i < count; i++)
            CU_ASSERT_DOUBLE_EQUAL(fixture_exponent(s, i), near[i], 1e-9);
        dal_lyapunov_free(s);
    }
}

/* The attractor of that sleigh: along the blade with any V > 0, where phi'' = -(m a/J) V phi' with
 * J = I + m a^2 = 2, m = a = 1.  The other directions, x, y, phi, V (and D, where it is free), keep
 * their length or grow like t. */
static void test_far_attractor(void)
{
    static const struct {
        const char *method;
        int count;
    } methods[] = {{"gauss4+project", 5}, {"mclachlan-perlmutter", 5}, {"rk4+project-energy", 4}};
    const double V = 30.0, rate = -V / 2.0, phi = 0.3;
    const dal_setting start[] = {
        {"x", 1e5}, {"x'", V * cos(phi)}, {"y'", V * sin(phi)}, {"phi'", 0.0}};
    const long long steps = 400;
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k += (size_t)case_stride(3)) {
        dal_run_spec spec = fixture_spec(fixture_system("chaplygin-sleigh-offset"),
                                         methods[k].method, DAL_PHYSICAL, 0.001);
        dal_lyapunov *s = NULL;
        spec.start = start;
        spec.start_count = 4;
        CU_ASSERT_EQUAL_FATAL(dal_lyapunov_create(&s, &spec, NULL, 0, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL_FATAL(dal_lyapunov_count(s), methods[k].count);
        CU_ASSERT_EQUAL(dal_lyapunov_advance(s, 1000, NULL), DAL_STATUS_OK);
        dal_lyapunov_discard_transient(s);
        CU_ASSERT_EQUAL(dal_lyapunov_advance(s, steps, NULL), DAL_STATUS_OK);
        CU_ASSERT_DOUBLE_EQUAL(fixture_exponent(s, methods[k].count - 1), rate, 2e-3);
        CU_ASSERT_DOUBLE_EQUAL(fixture_sum(s), rate, 2e-3);
        CU_ASSERT_DOUBLE_EQUAL(fixture_divergence(s), rate, 1e-9);
        balance_of(s);
        dal_lyapunov_free(s);
    }
}

/* The units of the time, of n coordinates and of their velocities: unit[1 + 2*n]. */
static void find_units(const char *name, const dal_setting *start, int count, double *unit)
{
    dal_run_spec spec = fixture_spec(fixture_system(name), "rk4+project", DAL_PHYSICAL, 0.05);
    dal_scaled *scaled;
    spec.start = start;
    spec.start_count = count;
    CU_ASSERT_EQUAL_FATAL(dal_scaled_create(&scaled, &spec, NULL), DAL_STATUS_OK);
    memcpy(unit, dal_scaled_units(scaled), (1 + 2 * (size_t)spec.system->n) * sizeof *unit);
    dal_scaled_free(scaled);
}

static double square_of_gradient(const double unit[7], double phi, double v)
{
    return pow(unit[3] * v, 2.0) + pow(unit[4] * sin(phi), 2.0) + pow(unit[5] * cos(phi), 2.0) +
           pow(unit[6], 2.0);
}

/* 40000 steps and 2900 lengths: with increments like x the angle was turned round and round. */
static void test_long_way(void)
{
    const long long steps = long_run(40000);
    dal_lyapunov *s = differences("chaplygin-sleigh-offset", "rk4+project", NULL, 0, steps);
    const double T = 0.05 * (double)steps;
    for (int i = 0; i < 4; i++) CU_ASSERT(fabs(fixture_exponent(s, i)) < 2.0 * log(T) / T);
    if (steps == 40000) {
        /* tau = V t/J + tau0: the integral of the divergence, -log(cosh tau/cosh tau0), and
         * log |grad D| by (q/l, v/u), D having the gradient v by phi and -sin(phi), cos(phi), -1 by
         * x', y', phi'. */
        const double V = sqrt(2.11), tau0 = atanh(0.7 / V), tau = tau0 + V / 2.0 * T;
        const double phi = dal_run_state(dal_lyapunov_run(s))[2], log_cosh = tau - log(2.0);
        double unit[7];
        find_units("chaplygin-sleigh-offset", NULL, 0, unit);
        const double density =
            0.5 * log(square_of_gradient(unit, phi, V) / square_of_gradient(unit, 0.3, 0.7));
        const double mean = -(log_cosh - log(cosh(tau0))) / T;
        CU_ASSERT_DOUBLE_EQUAL(fixture_sum(s), mean + density / T, 1e-5);
        CU_ASSERT_DOUBLE_EQUAL(balance_of(s).surface, density / T, 1e-7);
        CU_ASSERT_DOUBLE_EQUAL(fixture_exponent(s, 4), -V / 2.0, 1e-3);
    }
    dal_lyapunov_free(s);
}

/* A particle of constant speed in a field: theta = 0 attracts with f/V = 1, and x goes away.  By
 * t = 422 differences with increments like x turned v round and no projection converged. */
static void test_long_isokinetic(void)
{
    const dal_setting start[] = {{"x'", cos(0.1)}, {"y'", sin(0.1)}};
    const long long steps = long_run(10000);
    dal_lyapunov *s = differences("isokinetic", "rk4+project", start, 2, steps);
    const double T = 0.05 * (double)steps, theta = 2.0 * atan(tan(0.05) * exp(-T));
    CU_ASSERT_EQUAL_FATAL(dal_lyapunov_count(s), 3);
    /* theta' = -sin theta: d theta grows by sin(theta)/sin(0.1), and |grad D| in units changes: the
     * gradient by x', y' is (cos theta, sin theta). */
    double unit[5];
    find_units("isokinetic", start, 2, unit);
    const double density = log(hypot(unit[3] * cos(theta), unit[4] * sin(theta)) /
                               hypot(unit[3] * cos(0.1), unit[4] * sin(0.1)));
    const double growth = log(sin(theta) / sin(0.1)) + density;
    CU_ASSERT_DOUBLE_EQUAL(fixture_sum(s), growth / T, 1e-4);
    dal_lyapunov_free(s);
}

static double log_rk4(double z)
{
    return log(1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0))));
}

/* Linear: x'' = -0.3 x' and y'' = 0, far away and fast; rk4 multiplies x' by R(-0.3 h). */
static void test_linear_far(void)
{
    const dal_setting start[] = {{"y", 1e6}, {"y'", 100.0}, {"x", -1e5}, {"x'", 1.0}};
    dal_lyapunov *s = differences("coordinates: [x, y]\n"
                                  "accelerations: {x: -0.3*x', y: 0}\nstart: {x: 0}\n",
                                  "rk4", start, 4, 1000);
    CU_ASSERT_DOUBLE_EQUAL(fixture_sum(s), log_rk4(-0.015) / 0.05, 1e-9);
    CU_ASSERT_DOUBLE_EQUAL(fixture_divergence(s), -0.3, 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(fixture_exponent(s, 3), log_rk4(-0.015) / 0.05, 1e-1);
    dal_lyapunov_free(s);
}

/* In quad precision the state is displaced as a whole. */
static void test_quad(void)
{
    dal_run_spec spec = fixture_spec(fixture_system("chaplygin-sleigh-offset"), "gauss4+project",
                                     DAL_PHYSICAL, 0.05);
    const int steps = 20 / case_stride(5);
    double value[2][5];
    for (int k = 0; k < 2; k++) {
        dal_lyapunov *s = NULL;
        spec.options.precision = k == 0 ? DAL_DOUBLE : DAL_QUAD;
        CU_ASSERT_EQUAL_FATAL(dal_lyapunov_create(&s, &spec, NULL, 0, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL_FATAL(dal_lyapunov_count(s), 5);
        CU_ASSERT_EQUAL(dal_lyapunov_advance(s, steps, NULL), DAL_STATUS_OK);
        for (int i = 0; i < 5; i++) value[k][i] = fixture_exponent(s, i);
        dal_lyapunov_free(s);
    }
    for (int i = 0; i < 5; i++) CU_ASSERT_DOUBLE_EQUAL(value[0][i], value[1][i], 1e-9);
}

/* ---- the balance of volume ---- */

/* J from the tangent system of another motion: x'' = -0.5 x' instead of -0.3 x'. */
static void test_wrong_derivative(void)
{
    const char *const model = "coordinates: [x]\naccelerations: {x: -0.3*x'}\n";
    const dal_run_spec spec = fixture_spec(fixture_system(model), "rk4", DAL_PHYSICAL, 0.05);
    const dal_system *tangent[] = {
        fixture_tangent(model), fixture_tangent("coordinates: [x]\naccelerations: {x: -0.5*x'}\n")};
    for (int k = 0; k < 2; k++) {
        dal_lyapunov *s = NULL;
        dal_balance b;
        CU_ASSERT_EQUAL_FATAL(dal_lyapunov_create(&s, &spec, tangent[k], 0, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_lyapunov_advance(s, 100, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_lyapunov_balance(s, &b, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(b.holds, k == 0);
        CU_ASSERT_DOUBLE_EQUAL(b.difference, k == 0 ? 0.0 : -0.2, 1e-6);
        CU_ASSERT_EQUAL(b.surface, 0.0);
        dal_lyapunov_free(s);
    }
}

/* Of the flow the sum is the divergence and the growth of |grad D|, at every time and for every
 * method, as far as its order goes. */
static void test_balance(void)
{
    static const char *const methods[] = {
        "gauss8", "gauss6+project", "rk4+project",          "gauss4+symmetric-project",
        "spark4", "gauss-spark4",   "gauss6+project-energy"};
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k += (size_t)case_stride(2)) {
        dal_lyapunov *s = differences("chaplygin-sleigh-offset", methods[k], NULL, 0, 100);
        const dal_balance b = balance_of(s);
        CU_ASSERT(fabs(b.difference) < 1e-4);
        CU_ASSERT(k == 0 ? b.surface == 0.0 : fabs(b.surface) > 1e-3);
        dal_lyapunov_free(s);
    }
}

static void test_no_balance(void)
{
    const dal_system *system = fixture_system("chaplygin-sleigh-offset");
    dal_balance b;
    dal_error error;
    dal_lyapunov *s = NULL;
    const struct {
        const char *method;
        int count;
        double step;
        const char *reason;
    } cases[] = {{"rk4", 2, 0.05, "2 of 6"},
                 {"discrete-gradient", 0, 0.05, "D into -D"},
                 {"gauss4", 0, 1.5, "too long"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const dal_run_spec spec =
            fixture_spec(system, cases[k].method, DAL_PHYSICAL, cases[k].step);
        CU_ASSERT_EQUAL_FATAL(dal_lyapunov_create(&s, &spec, NULL, cases[k].count, NULL),
                              DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_lyapunov_advance(s, 3, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_lyapunov_balance(s, &b, &error), DAL_STATUS_UNSUPPORTED);
        CU_ASSERT(strstr(error.message, cases[k].reason) != NULL);
        dal_lyapunov_free(s);
    }
}

void suite_phase_volume(void)
{
    CU_pSuite suite = CU_add_suite("exponents far away, balance of volume", NULL, NULL);
    CU_add_test(suite, "cyclic coordinates, translated", test_translation);
    CU_add_test(suite, "an attractor, closed form", test_far_attractor);
    CU_add_test(suite, "a long way to an attractor, closed form", test_long_way);
    CU_add_test(suite, "a long way at constant speed", test_long_isokinetic);
    CU_add_test(suite, "linear and far away, closed form", test_linear_far);
    CU_add_test(suite, "quad precision", test_quad);
    CU_add_test(suite, "a wrong derivative is found", test_wrong_derivative);
    CU_add_test(suite, "volume in balance", test_balance);
    CU_add_test(suite, "no balance to compare", test_no_balance);
}
