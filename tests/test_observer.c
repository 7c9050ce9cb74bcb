/* test_observer.c - an observer that is called every K steps, and rows at times of its own. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <math.h>

typedef struct samples {
    long long count, every;
    double last, shown[4];
} samples;

static const double times[4] = {0.0, 0.25, 7.0, 10.0};

static dal_status look(void *user, dal_run *run)
{
    samples *l = user;
    CU_ASSERT_EQUAL(dal_run_steps(run), l->count * l->every);
    l->count++;
    l->last = dal_run_time(run);
    return DAL_OK;
}

static dal_status show(void *user, dal_run *run, long long row, double t)
{
    samples *l = user;
    CU_ASSERT_DOUBLE_EQUAL(dal_run_time(run), t, 1e-12);
    l->shown[row] = t;
    return DAL_OK;
}

static double given(void *user, long long row)
{
    (void)user;
    return times[row];
}

/* 100 steps of 0.1; rows on, between and at the end of steps do not disturb the observer. */
static void test_calls(void)
{
    const dal_system *system = fixture_system("chaplygin-sleigh");
    const dal_run_spec spec = fixture_spec(system, "rk4", DAL_PHYSICAL, 0.1);
    for (int every = 1; every <= 7; every += 3) {
        samples l = {.every = every};
        const dal_observer observer = {
            .user = &l, .sample = show, .step = look, .every = every, .row_time = given};
        dal_run *run = fixture_run(&spec);
        CU_ASSERT_EQUAL(dal_run_sample(run, 10.0, 3, 0, &observer, NULL), DAL_OK);
        CU_ASSERT_EQUAL(l.count, 1 + 100 / every);
        CU_ASSERT_DOUBLE_EQUAL(l.last, 0.1 * (100 - 100 % every), 1e-12);
        for (int i = 0; i < 4; i++) CU_ASSERT_EQUAL(l.shown[i], times[i]);
        CU_ASSERT_EQUAL(dal_run_steps(run), 100);
        dal_run_free(run);
    }
}

void suite_observer(void)
{
    CU_pSuite suite = CU_add_suite("observer", NULL, NULL);
    CU_add_test(suite, "at steps, and rows at given times", test_calls);
}
