/* test_phase_lift.c - explicit methods of high order and their cotangent lifts: dop853 from its
 * printed digits; NAME+lift is symplectic where NAME is not, and has its bits on the surface. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* The method's own file, tables and all, without its descriptor. */
#include <dalembert_kernel.h>
#undef DAL_INTEGRATOR
#define DAL_INTEGRATOR(identifier, function, ...) enum { unused_##identifier }
#include "../integrators/dop853.c"

/* ---- order conditions of dop853 ---- */

static long double a(int i, int j) { return a853[i * (i - 1) / 2 + j]; }

/* out_i = sum_j a_ij x_j */
static void apply(const long double *x, long double *out)
{
    for (int i = 0; i < STAGES_853; i++) {
        out[i] = 0.0L;
        for (int j = 0; j < i; j++) out[i] += a(i, j) * x[j];
    }
}

/* Coefficients up to 43 with rounding in their last places enter. */
static void check_weighted(const double *weight, const long double *x, long double expected)
{
    long double sum = 0.0L;
    for (int i = 0; i < STAGES_853; i++) sum += (long double)weight[i] * x[i];
    CU_ASSERT(fabsl(sum - expected) <= 1e3L * DBL_EPSILON);
}
static void check_sum(const long double *x, long double expected)
{
    check_weighted(b853, x, expected);
}

/* Trees with a stem of m edges under k leaves, sum b A^m c^(k-1): all of them up to order 8. */
static void test_tall_trees(void)
{
    for (int k = 1; k <= 8; k++) {
        long double x[STAGES_853], next[STAGES_853], expected = 1.0L / k;
        for (int i = 0; i < STAGES_853; i++) x[i] = powl(c853[i], k - 1);
        for (int m = 0; k + m <= 8; m++) {
            check_sum(x, expected);
            apply(x, next);
            memcpy(x, next, sizeof x);
            expected /= k + m + 1;
        }
    }
}

/* sum_i b_i c_i^l (A c^(k-1))_i = 1/(k (k + l + 1)) */
static void check_bush(const long double *power, int k, int l)
{
    long double x[STAGES_853];
    apply(power, x);
    for (int i = 0; i < STAGES_853; i++) x[i] *= powl(c853[i], l);
    check_sum(x, 1.0L / (k * (k + l + 1)));
}

static void test_bushy_trees(void)
{
    for (int k = 1; k <= 7; k++) {
        long double power[STAGES_853];
        for (int i = 0; i < STAGES_853; i++) power[i] = powl(c853[i], k - 1);
        for (int l = 0; k + l <= 7; l++) check_bush(power, k, l);
    }
}

static void test_times(void)
{
    long double ones[STAGES_853], x[STAGES_853];
    for (int i = 0; i < STAGES_853; i++) ones[i] = 1.0L;
    apply(ones, x);
    for (int i = 0; i < STAGES_853; i++) CU_ASSERT(fabsl(x[i] - c853[i]) <= 1e2L * DBL_EPSILON);
}

static void multiply(const long double *x, const long double *y, long double *out)
{
    for (int i = 0; i < STAGES_853; i++) out[i] = x[i] * y[i];
}

/* The estimates of the error: third853 solves the conditions of the trees up to order 3, fifth853
 * is orthogonal to all 17 up to order 5. */
static void test_estimates(void)
{
    static const double third[] = {1.0, 1.0 / 2.0, 1.0 / 3.0, 1.0 / 6.0};
    long double x[17][STAGES_853];
    for (int i = 0; i < STAGES_853; i++) x[0][i] = 1.0L;
    for (int i = 0; i < STAGES_853; i++) x[1][i] = c853[i];
    multiply(x[1], x[1], x[2]);
    apply(x[1], x[3]);
    multiply(x[1], x[2], x[4]);
    multiply(x[1], x[3], x[5]);
    apply(x[2], x[6]);
    apply(x[3], x[7]);
    for (int i = 0; i < 4; i++) multiply(x[1], x[4 + i], x[8 + i]);
    for (int i = 0; i < 4; i++) apply(x[4 + i], x[12 + i]);
    multiply(x[3], x[3], x[16]);
    for (int i = 0; i < 4; i++) check_weighted(third853, x[i], third[i]);
    for (int i = 0; i < 17; i++) check_weighted(fifth853, x[i], 0.0L);
}

/* ---- the lift ---- */

static const char *const bases[] = {"rk4", "dop853"};
enum { BASES = 2 };

static const char *lifted_name(int i)
{
    static char name[32];
    snprintf(name, sizeof name, "%s+lift", bases[i]);
    return name;
}

static void test_symplectic(void)
{
    for (int i = 0; i < BASES; i++) {
        const dal_run_spec spec =
            fixture_spec(fixture_system(fixture_full), lifted_name(i), DAL_LIFTED, 0.1);
        const double defect = fixture_symplectic_defect(&spec);
        if (!(defect <= 1e-9)) printf("\n  %s: defect %.2e\n", lifted_name(i), defect);
        CU_ASSERT(defect <= 1e-9);
    }
    const dal_run_spec rk4 = fixture_spec(fixture_system(fixture_full), "rk4", DAL_LIFTED, 0.1);
    CU_ASSERT(fixture_symplectic_defect(&rk4) >= 1e-7);
}

/* p.dq + pi.dv with 1/e = 0: kept to rounding, though the base loses it. */
static void test_pairing(void)
{
    const dal_setting start[] = {{"e", INFINITY}, {"p_x", 0.7}, {"p_z", -0.4}, {"pi_y", 1.1}};
    const double direction[] = {0.3, -0.2, 0.5, 0.1, 0.4, -0.6};
    const dal_system *tangent = fixture_tangent(fixture_bilinear);
    for (int i = 0; i < 2 * BASES; i++) {
        const bool lifted = i < BASES;
        dal_statistics pairing;
        dal_run_spec spec =
            fixture_spec(fixture_system(fixture_bilinear), lifted ? lifted_name(i) : "rk4",
                         DAL_LIFTED, lifted ? 0.01 : 0.1);
        spec.start = start;
        spec.start_count = 4;
        CU_ASSERT_EQUAL(dal_adjoint_pairing(&spec, tangent, direction, 300, &pairing, NULL),
                        DAL_STATUS_OK);
        const double moved = dal_statistics_deviation(&pairing);
        const double size = fmax(1.0, dal_statistics_max_abs(&pairing));
        CU_ASSERT(lifted ? moved <= 1e-13 * size : moved > 1e-8);
    }
}

static void end_state(const dal_system *system, const char *name, dal_space space, double *state)
{
    const dal_run_spec spec = fixture_spec(system, name, space, 0.05);
    dal_run *run = fixture_stepped(&spec, 100);
    memcpy(state, dal_run_state(run), (size_t)dal_run_dimension(run) * sizeof *state);
    dal_run_free(run);
}

/* The bits of the base, on either space. */
static void test_surface(void)
{
    const dal_system *system = fixture_system(fixture_full);
    const size_t bytes = 2 * (size_t)system->n * sizeof(double);
    for (int i = 0; i < BASES; i++) {
        double base[32], lift[32], physical[32];
        end_state(system, bases[i], DAL_PHYSICAL, base);
        end_state(system, lifted_name(i), DAL_PHYSICAL, physical);
        end_state(system, lifted_name(i), DAL_LIFTED, lift);
        CU_ASSERT_EQUAL(memcmp(base, physical, bytes), 0);
        CU_ASSERT_EQUAL(memcmp(base, lift, bytes), 0);
        for (int j = 2 * system->n + 1; j < 4 * system->n + 2; j++) CU_ASSERT_EQUAL(lift[j], 0.0);
    }
}

/* On the surface the order of the base; off it the order of the splitting. */
static void test_order(void)
{
    const dal_system *full = fixture_system(fixture_full), *weak = fixture_system(fixture_gentle);
    const dal_run_spec rk4 = fixture_spec(full, "rk4+lift", DAL_LIFTED, 0.1);
    const dal_run_spec dop853 = fixture_spec(weak, "dop853+lift", DAL_LIFTED, 0.1);
    CU_ASSERT(fabs(fixture_order(rk4, 1.0, 40, 400, 0.0) - 4.0) <= 0.1);
    CU_ASSERT(fabs(fixture_order(rk4, 1.0, 40, 400, 0.02) - 2.0) <= 0.1);
    CU_ASSERT(fabs(fixture_order(dop853, 20.0, 46, 82, 0.0) - 8.0) <= 0.1);
}

/* ---- what cannot be lifted ---- */

static void refused(const dal_system *system, const char *name, const char *reason)
{
    const dal_run_spec spec = fixture_spec(system, name, DAL_LIFTED, 0.1);
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, reason);
}

static void test_refused(void)
{
    dal_system blind = *fixture_system(fixture_full);
    refused(&blind, "gauss4+lift", "gauss4 is not one");
    refused(&blind, "symplectic-euler-10+lift", "symplectic-euler-10 is not one");
    refused(&blind, "rk4+project+lift", "rk4+project is not one");
    blind.call.jacobian = NULL;
    refused(&blind, "rk4+lift", "the system has no jacobian");
}

void suite_phase_lift(void)
{
    CU_pSuite suite = CU_add_suite("explicit methods and their lifts", NULL, NULL);
    CU_add_test(suite, "dop853: tall trees", test_tall_trees);
    CU_add_test(suite, "dop853: bushy trees", test_bushy_trees);
    CU_add_test(suite, "dop853: times of the stages", test_times);
    CU_add_test(suite, "dop853: orders of the estimates of its error", test_estimates);
    CU_add_test(suite, "the lift is symplectic", test_symplectic);
    CU_add_test(suite, "adjoint pairing with 1/e = 0", test_pairing);
    CU_add_test(suite, "on the surface: the bits of the base", test_surface);
    CU_add_test(suite, "order on the surface and off it", test_order);
    CU_add_test(suite, "what is refused, and why", test_refused);
}
