/* test_large.c - the systems of the examples that are given as C callbacks: a contact chain of 101
 * coordinates and an isokinetic fluid of 256 spheres. */
#include "../examples/contact_chain.h"
#include "../examples/isokinetic_fluid.h"
#include "chain_one.h"
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <stdlib.h>

/* Central differences with this step err by about its square and by rounding over it. */
static const double DELTA = 1e-5, NEAR = 1e-8;

static double dot(const double *a, const double *b, int n)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* Contact oscillator, eps = 0.3, at T = 1: an end state found by two other integrations. */
static void test_one_link(void)
{
    static const double expected[] = {0.2697845407561,  0.1292207494387, 0.9132110728864,
                                      -0.6961539931339, 0.7623144460279, -0.1266709767770};
    const dal_run_spec spec = fixture_spec(chain_one(), "gauss8", DAL_PHYSICAL, 0.02);
    dal_run *run = fixture_stepped(&spec, 50);
    for (int i = 0; i < 6; i++) CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[i], expected[i], 1e-11);
    dal_run_free(run);
}

/* q, v, pi of no particular kind, off D = 0. */
static void chain_point(double *q, double *v, double *pi)
{
    for (int i = 0; i < CHAIN_N; i++) {
        q[i] = 0.7 * cos(1.0 + 3.0 * i);
        v[i] = 0.9 * sin(2.0 + 5.0 * i);
        pi[i] = cos(0.3 + 2.0 * i);
    }
}

/* d(pi.F)/dx for x, a component of at's q or v. */
static double chain_difference(const dal_point *at, double *x)
{
    double F[CHAIN_N], kept = *x, above;
    *x = kept + DELTA;
    chain_field(&chain_system, at, F);
    above = dot(at->pi, F, CHAIN_N);
    *x = kept - DELTA;
    chain_field(&chain_system, at, F);
    *x = kept;
    return (above - dot(at->pi, F, CHAIN_N)) / (2.0 * DELTA);
}

static void test_chain_adjoint(void)
{
    double q[CHAIN_N], v[CHAIN_N], pi[CHAIN_N], eps = 0.3, adjoint[3 * CHAIN_N], F[CHAIN_N];
    const dal_point at = {0.0, q, v, pi, &eps, NULL};
    chain_point(q, v, pi);
    chain_field(&chain_system, &at, F);
    chain_adjoint(&chain_system, &at, adjoint);
    CU_ASSERT_EQUAL(memcmp(F, adjoint, sizeof F), 0);
    for (int i = 0; i < CHAIN_N; i++) {
        CU_ASSERT_DOUBLE_EQUAL(adjoint[CHAIN_N + i], chain_difference(&at, &q[i]), NEAR);
        CU_ASSERT_DOUBLE_EQUAL(adjoint[2 * CHAIN_N + i], chain_difference(&at, &v[i]), NEAR);
    }
}

/* dD/dt = D_q v + A F = 0 on every level of D, and A = D_v. */
static void test_chain_constraint(void)
{
    double q[CHAIN_N], v[CHAIN_N], pi[CHAIN_N], eps = 0.3, c[1 + 2 * CHAIN_N], F[CHAIN_N], D;
    const dal_point at = {0.0, q, v, pi, &eps, NULL};
    chain_point(q, v, pi);
    chain_field(&chain_system, &at, F);
    chain_constraint(&chain_system, &at, c);
    const double Dq_v = dot(v + CHAIN_Y, v + 1, CHAIN_K);
    CU_ASSERT_DOUBLE_EQUAL(Dq_v + dot(c + 1, F, CHAIN_N), 0.0, 1e-13);
    for (int i = 0; i < CHAIN_N; i++) {
        v[i] += 1.0;
        chain_constraints(&chain_system, &at, &D);
        v[i] -= 1.0;
        CU_ASSERT_DOUBLE_EQUAL(c[1 + i], D - c[0], 1e-13);
    }
    CU_ASSERT_EQUAL(memcmp(c + 1, c + 1 + CHAIN_N, CHAIN_N * sizeof *c), 0);
}

/* The fluid some way from its lattice; work is [workspace], to be freed. */
static double *fluid_point(double *qv)
{
    double *work = calloc(fluid_system.workspace, sizeof *work);
    double start[2 * FLUID_N + 1];
    CU_ASSERT_PTR_NOT_NULL_FATAL(work);
    memcpy(work, fluid_value, sizeof fluid_value);
    const dal_point at = {0.0, start, start + FLUID_N, NULL, work, NULL};
    fluid_start(&fluid_system, &at, start);
    memcpy(qv, start, 2 * FLUID_N * sizeof *qv);
    for (int i = 0; i < FLUID_N; i++) qv[i] += 0.1 * sin(7.0 * i) - (i % 5 == 0) * work[FLUID_SIDE];
    return work;
}

/* f = -U_q, and v.F = 0: the power of the thermostat is the power of the forces. */
static void test_fluid_forces(void)
{
    double qv[2 * FLUID_N], f[FLUID_N], F[FLUID_N], above, below;
    double *work = fluid_point(qv);
    const dal_point at = {0.0, qv, qv + FLUID_N, NULL, work, NULL};
    CU_ASSERT_EQUAL_FATAL(fluid_forces(&at, f), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(fluid_field(&fluid_system, &at, F), DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(dot(F, qv + FLUID_N, FLUID_N), 0.0, 1e-10);
    for (int i = 0; i < FLUID_N; i += 61) {
        const double kept = qv[i];
        qv[i] = kept + DELTA;
        fluid_energy(&fluid_system, &at, &above);
        qv[i] = kept - DELTA;
        fluid_energy(&fluid_system, &at, &below);
        qv[i] = kept;
        CU_ASSERT(fabs(f[i]) > 1e-3);
        CU_ASSERT_DOUBLE_EQUAL(f[i], (below - above) / (2.0 * DELTA), 1e-5);
    }
    free(work);
}

/* The same bits with a list made elsewhere and with a new one; and too many neighbours. */
static void test_fluid_list(void)
{
    double qv[2 * FLUID_N], old[FLUID_N], new[FLUID_N];
    double *work = fluid_point(qv);
    const dal_point at = {0.0, qv, qv + FLUID_N, NULL, work, NULL};
    CU_ASSERT_EQUAL_FATAL(fluid_forces(&at, old), DAL_STATUS_OK);
    for (int i = 0; i < FLUID_N; i++) qv[i] += 0.08 * cos(11.0 * i);
    CU_ASSERT_EQUAL(fluid_forces(&at, old), DAL_STATUS_OK);
    CU_ASSERT(fluid_list_of(&at)->origin[1] != qv[1]);
    CU_ASSERT_EQUAL(fluid_prepare(&fluid_system, &at, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(fluid_forces(&at, new), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(fluid_list_of(&at)->origin[1], qv[1]);
    CU_ASSERT_EQUAL(memcmp(old, new, sizeof old), 0);
    qv[1] += 0.2;
    CU_ASSERT_EQUAL(fluid_forces(&at, new), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(fluid_list_of(&at)->origin[1], qv[1]);
    for (int i = 0; i < FLUID_N; i++) qv[i] = 1e-3 * i;
    CU_ASSERT_EQUAL(fluid_forces(&at, new), DAL_STATUS_TOO_LARGE);
    free(work);
}

void suite_large(void)
{
    CU_pSuite suite = CU_add_suite("large systems by callbacks", NULL, NULL);
    CU_add_test(suite, "chain of one link: reference end state", test_one_link);
    CU_add_test(suite, "chain: adjoint against differences", test_chain_adjoint);
    CU_add_test(suite, "chain: constraint", test_chain_constraint);
    CU_add_test(suite, "fluid: forces against differences", test_fluid_forces);
    CU_add_test(suite, "fluid: the list of pairs leaves no trace", test_fluid_list);
}
