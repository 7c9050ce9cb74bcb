/* test_rattle.c - rattle and gauss-spark beside holonomic constraints: high orders, what they are
 * without the callbacks of a model, and E over long runs. */
#include "fixtures.h"
#include "holonomic.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* The order from larger steps, whose errors are above rounding. */
static void test_high_order(void)
{
    static const struct {
        const char *system, *method;
        double order;
    } cases[] = {{skate, "gauss-spark6", 6.0},      {general, "gauss-spark6", 6.0},
                 {steady, "gauss-spark6", 6.0},     {skate, "rattle+kahan-li6", 6.0},
                 {steady, "rattle+kahan-li6", 6.0}, {skate, "rattle+suzuki8", 8.0},
                 {steady, "rattle+suzuki8", 8.0}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const bool is_composed = strchr(cases[k].method, '+');
        const dal_run_spec spec =
            fixture_spec(fixture_system(cases[k].system), cases[k].method, DAL_PHYSICAL, 0.1);
        const double order =
            fixture_order(spec, 1.0, is_composed ? 8 : 4, is_composed ? 16 : 8, 0.0);
        CU_ASSERT(fabs(order - cases[k].order) < 0.35);
    }
}

static dal_run *stepped(const char *text, const char *method)
{
    const dal_run_spec spec = fixture_spec(fixture_system(text), method, DAL_PHYSICAL, 0.1);
    return fixture_stepped(&spec, 100);
}

static double max_difference(const dal_run *a, const dal_run *b)
{
    double max = 0.0;
    for (int i = 0; i < dal_run_dimension(a); i++)
        max = fmax(max, fabs(dal_run_state(a)[i] - dal_run_state(b)[i]));
    return max;
}

/* With a constant force and without D both have the equations of RATTLE. */
static void test_rattle_is_gauss_spark(void)
{
    dal_run *a = stepped(pendulum, "rattle");
    dal_run *b = stepped(pendulum, "gauss-spark2");
    CU_ASSERT(max_difference(a, b) < 1e-13);
    dal_run_free(a);
    dal_run_free(b);
}

/* Without the callbacks that a model makes, by D, A, W^-1 A^T and W^-1 b. */
static void test_without_callbacks(void)
{
    static const char *const methods[] = {"rattle",         "gauss-spark2",
                                          "gauss-spark4",   "gauss-spark6",
                                          "gauss4+project", "gauss4+symmetric-project"};
    static const char *const systems[] = {skate, steady};
    for (size_t k = 0; k < 2 * sizeof methods / sizeof *methods; k++) {
        dal_system other = *fixture_system(systems[k % 2]);
        const dal_run_spec spec = fixture_spec(&other, methods[k / 2], DAL_PHYSICAL, 0.05);
        dal_run *with = fixture_stepped(&spec, 20);
        other.call.enforcement = other.call.reaction = other.call.constraint_value = NULL;
        other.call.position = other.call.correction = NULL;
        dal_run *without = fixture_stepped(&spec, 20);
        CU_ASSERT(max_difference(with, without) <= 1e-13);
        dal_run_free(with);
        dal_run_free(without);
    }
}

/* max |E - E(0)| over a quarter of a run, and over the rest. */
static void energies(const char *method, int steps, double max[2])
{
    const dal_run_spec spec = fixture_spec(fixture_system(skate), method, DAL_PHYSICAL, 0.05);
    dal_run *run = fixture_run(&spec);
    double values[16], first = 0.0;
    int E = -1;
    char name[16];
    for (int i = 0; dal_run_observable_name(run, i, name, sizeof name); i++)
        if (strcmp(name, "E") == 0) E = i;
    CU_ASSERT_FATAL(E >= 0 && dal_run_observables(run) <= 16);
    max[0] = max[1] = 0.0;
    for (int k = 0; k <= steps; k++) {
        CU_ASSERT_EQUAL(dal_run_observe(run, values), DAL_STATUS_OK);
        if (k == 0) first = values[E];
        double *const to = &max[4 * k > steps];
        *to = fmax(*to, fabs(values[E] - first));
        CU_ASSERT_EQUAL_FATAL(dal_run_step(run, NULL), DAL_STATUS_OK);
    }
    dal_run_free(run);
}

/* The skate's motion is reversible: E of symmetric methods stays within what it is at first, and
 * E of a projected one drifts linearly. */
static void test_energy(void)
{
    static const char *const methods[] = {"rattle", "gauss-spark2", "gauss-spark4", "gauss-spark6",
                                          "gauss4+symmetric-project"};
    double max[2];
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k += (size_t)case_stride(2)) {
        energies(methods[k], 4000, max);
        CU_ASSERT(max[1] <= 1.1 * max[0] && max[0] > 0.0);
    }
    energies("rk4+project", 4000, max);
    CU_ASSERT(max[1] > 3.0 * max[0]);
}

void suite_rattle(void)
{
    CU_pSuite suite = CU_add_suite("rattle", NULL, NULL);
    CU_add_test(suite, "orders 6 and 8", test_high_order);
    CU_add_test(suite, "rattle and gauss-spark2 are one", test_rattle_is_gauss_spark);
    CU_add_test(suite, "methods without the callbacks", test_without_callbacks);
    CU_add_test(suite, "the energy of symmetric methods", test_energy);
}
