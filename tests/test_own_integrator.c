/* test_own_integrator.c - an integrator outside the library that wants more scratch than its
 * descriptor declares. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <dalembert_kernel.h>
#include <string.h>

enum { MAX_VECTORS = 100 };

/* Explicit Euler with `order` vectors of scratch, each filled. */
DAL_INLINE dal_status step(dal_step *s)
{
    num *last = NULL;
    for (int k = 0; k < s->layer[0]->order; k++) {
        DAL_VECTOR(s, derivative, DAL_DIM(s));
        dal_field(s, s->t, s->y, derivative);
        last = derivative;
    }
    return dal_update_multiple(s, s->h, s->h, last);
}

DAL_INTEGRATOR(frugal, step, .name = "frugal", .order = 1, .stages = 1, .properties = DAL_EXPLICIT,
               .needs = DAL_NEEDS_FIELD);
DAL_INTEGRATOR(greedy, step, .name = "greedy", .order = MAX_VECTORS, .stages = 1,
               .properties = DAL_EXPLICIT, .needs = DAL_NEEDS_FIELD);

/* Too little scratch is an error of the step, which leaves the run as it was. */
static void test_scratch(void)
{
    dal_run_spec spec = fixture_spec(fixture_system(fixture_full), "rk4", DAL_PHYSICAL, 0.01);
    dal_error error;
    size_t count;
    spec.method = (dal_method){{&dal_integrator_frugal}};
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_advance(run, 3, &error), DAL_STATUS_OK);
    dal_run_free(run);
    spec.method = (dal_method){{&dal_integrator_greedy}};
    run = fixture_run(&spec);
    const double *saved = dal_run_save(run, &count);
    double before[64];
    CU_ASSERT_FATAL(count <= sizeof before / sizeof *before);
    memcpy(before, saved, count * sizeof *before);
    CU_ASSERT_EQUAL(dal_run_step(run, &error), DAL_STATUS_MEMORY);
    CU_ASSERT_EQUAL(error.status, DAL_STATUS_MEMORY);
    CU_ASSERT_EQUAL(memcmp(before, dal_run_save(run, &count), count * sizeof *before), 0);
    CU_ASSERT_EQUAL(dal_run_steps(run), 0);
    dal_run_free(run);
}

void suite_own_integrator(void);
void suite_own_integrator(void)
{
    CU_pSuite suite = CU_add_suite("own integrator", NULL, NULL);
    CU_add_test(suite, "too little scratch", test_scratch);
}
