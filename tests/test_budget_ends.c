/* test_budget_ends.c - error budgets that are interrupted, and comparisons that are left out. */
#include "allocation.h"
#include "fixtures.h"
#include <CUnit/CUnit.h>

static dal_error_budget *explained(const dal_run_spec *spec, long long steps, long long quad_steps)
{
    dal_error_budget *e = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_error_budget_create(&e, spec, steps, quad_steps, NULL, NULL),
                          DAL_STATUS_OK);
    return e;
}

/* Whichever report is interrupted, all ends there. */
typedef struct watch {
    int calls, max_calls;
} watch;

static dal_status interrupt_once(void *user, double done)
{
    watch *w = user;
    (void)done;
    return ++w->calls == w->max_calls ? DAL_STATUS_INTERRUPTED : DAL_STATUS_OK;
}

static void test_each_interruption(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system("knife-edge"), "gauss4", DAL_PHYSICAL, 0.1);
    for (int quad_steps = 0; quad_steps <= 2; quad_steps += 2) {
        watch w = {.max_calls = 0};
        const dal_error_budget_observer observer = {&w, interrupt_once, NULL};
        dal_error_budget *e = NULL;
        CU_ASSERT_EQUAL(dal_error_budget_create(&e, &spec, 3, quad_steps, &observer, NULL),
                        DAL_STATUS_OK);
        dal_error_budget_free(e);
        const int all = w.calls;
        CU_ASSERT(all > 20);
        for (int k = 1; k <= all; k++) {
            w = (watch){.max_calls = k};
            CU_ASSERT_EQUAL(dal_error_budget_create(&e, &spec, 3, quad_steps, &observer, NULL),
                            DAL_STATUS_INTERRUPTED);
            CU_ASSERT(e == NULL && w.calls == k);
        }
    }
}

/* Gravity towards a point: rk4 passes it, the exact motion ends there, at t = pi/(2 sqrt 2). */
static void test_collision(void)
{
    static const char text[] = "coordinates: [x]\nlagrangian: x'^2/2 + 1/abs(x)\nstart: {x: 1}\n";
    const dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.125);
    dal_error_budget *e = explained(&spec, 8, 0);
    CU_ASSERT(e->ran[DAL_COMPARISON_EXACT] && e->exact_steps > 0);
    dal_error_budget_free(e);
    e = explained(&spec, 16, 0);
    CU_ASSERT(!e->ran[DAL_COMPARISON_EXACT] && e->exact_steps == 0);
    CU_ASSERT(e->reason[DAL_COMPARISON_EXACT][0] != '\0');
    dal_error_budget_free(e);
}

/* Steps in quad precision that fail leave the comparisons with them out. */
static dal_status end_early(const dal_system *system, const dal_point *at, double *out)
{
    if (at->t > 0.25) return DAL_STATUS_IO;
    return fixture_system("knife-edge")->quad->call.field(system, at, out);
}

static void test_quad_fails(void)
{
    dal_system system = *fixture_system("knife-edge");
    if (!system.quad) return;
    dal_system quad = *system.quad;
    quad.call.field = end_early;
    system.quad = &quad;
    const dal_run_spec spec = fixture_spec(&system, "rk4", DAL_PHYSICAL, 0.125);
    dal_error_budget *e = explained(&spec, 8, 8);
    CU_ASSERT(!e->ran[DAL_COMPARISON_QUAD] && !e->ran[DAL_COMPARISON_QUAD_HALVED]);
    CU_ASSERT_EQUAL(e->quad_steps, 0);
    CU_ASSERT(e->reason[DAL_COMPARISON_QUAD][0] != '\0');
    CU_ASSERT_STRING_EQUAL(e->reason[DAL_COMPARISON_QUAD], e->reason[DAL_COMPARISON_QUAD_HALVED]);
    dal_error_budget_free(e);
}

/* A method without room for one more modifier has no comparison with a projection. */
static void test_full_method(void)
{
    dal_run_spec spec = fixture_spec(fixture_system("chaplygin-sleigh"), "stormer-verlet+yoshida4",
                                     DAL_PHYSICAL, 0.1);
    dal_integrator again[DAL_LAYERS]; /* as of a caller: it could stay at order 2 */
    for (int k = 1; k < DAL_LAYERS; k++) {
        again[k] = *spec.method.layer[1];
        again[k].order = 2;
    }
    for (int k = 1; k < DAL_LAYERS; k++) spec.method.layer[k] = &again[k];
    dal_error_budget *e = explained(&spec, 4, 0);
    CU_ASSERT(!e->ran[DAL_COMPARISON_PROJECTION]);
    CU_ASSERT_STRING_EQUAL(e->reason[DAL_COMPARISON_PROJECTION],
                           "the method has no room for one more modifier");
    dal_error_budget_free(e);
}

/* The start is near the exact solution beside its size up to 1024 steps later, but not beside its
 * size up to 1024 half steps: the run with half the step has no error. */
static void test_other_observables(void)
{
    const double h = 0.125, closeness = 1e-10;
    const dal_setting start = {"x", 768.0 * h * closeness};
    dal_run_spec spec = fixture_spec(fixture_system("coordinates: [x]\nlagrangian: x'^2/2\n"
                                                    "start: {x': 1}\nexact: {x: t}\n"),
                                     "rk4", DAL_PHYSICAL, h);
    allocation_trial trial = {0};
    spec.start = &start;
    spec.start_count = 1;
    while (allocation_next(&trial)) { /* which sees what is not freed */
        dal_error_budget *e = NULL;
        allocation_start(&trial);
        if (!allocation_end(&trial, dal_error_budget_create(&e, &spec, 4, 0, NULL, NULL)))
            CU_ASSERT_STRING_EQUAL(e->reason[DAL_COMPARISON_HALVED], "it has other observables");
        dal_error_budget_free(e);
    }
}

void suite_budget_ends(void)
{
    CU_pSuite suite = CU_add_suite("ends of error budgets", NULL, NULL);
    CU_add_test(suite, "each interruption", test_each_interruption);
    CU_add_test(suite, "a collision", test_collision);
    CU_add_test(suite, "quad precision that fails", test_quad_fails);
    CU_add_test(suite, "a method without room", test_full_method);
    CU_add_test(suite, "other observables", test_other_observables);
}
