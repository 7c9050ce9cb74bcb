/* test_long_clock.c - runs near step 1e10: the count of steps, the clock and the times of rows.
 *
 * The clock is a sum with its residue.  As long as k < 2^50 or so, every sum is a multiple of the
 * last place of h that fits into both together, so that nothing is ever lost and
 *     t_k = k h, rounded once.
 * A far step differs from the first in nothing but the clock: the motion of a system that does not
 * know the time must have the same bits. */
#include "fixtures.h"
#include "run/run.h"
#include <CUnit/CUnit.h>
#include <float.h>
#include <math.h>
#include <string.h>

static const char oscillator[] = "coordinates: [x]\nlagrangian: x'^2/2 - x^2/2\nstart: {x: 1}\n";
static const double h = 0.01;
static const long long far_step = 10000000000LL;

/* Puts the clock and the count of a run at step k. */
static void set_step(dal_run *run, long long k)
{
    size_t count;
    double memory[256];
    const double *now = dal_run_save(run, &count);
    CU_ASSERT_FATAL(count <= sizeof memory / sizeof *memory);
    memcpy(memory, now, count * sizeof *memory);
    const double t = (double)k * h;
    memory[dal__at(&run->layout, DAL__TIME)] = t;
    memory[dal__at(&run->layout, DAL__TIME_ERROR)] = fma((double)k, h, -t);
    memory[dal__at(&run->layout, DAL__STEPS)] = (double)k;
    CU_ASSERT_EQUAL(dal_run_restore(run, memory, count, NULL), DAL_STATUS_OK);
}

static void check_clock(const dal_system *system, const char *method, dal_space space)
{
    const dal_run_spec spec = fixture_spec(system, method, space, h);
    dal_run *first = fixture_run(&spec), *run = fixture_run(&spec);
    set_step(run, far_step);
    for (int i = 1; i <= 1000; i++) {
        CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
        if (dal_run_time(run) != (double)(far_step + i) * h) CU_FAIL("the clock is not k h");
    }
    CU_ASSERT_EQUAL(dal_run_steps(run), far_step + 1000);
    CU_ASSERT_EQUAL(dal_run_advance(first, 1000, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(memcmp(dal_run_state(first), dal_run_state(run),
                           (size_t)dal_run_dimension(run) * sizeof(double)),
                    0);
    dal_run_free(first);
    dal_run_free(run);
}

static void test_clock(void)
{
    check_clock(fixture_system(oscillator), "rk4", DAL_PHYSICAL);
    check_clock(fixture_system(oscillator), "gauss4", DAL_LIFTED);
    check_clock(fixture_system(oscillator), "stormer-verlet", DAL_PHYSICAL);
}

/* The clock from step 0 on, 200000 steps, against k h. */
static void test_from_the_start(void)
{
    dal_run_spec spec =
        fixture_spec(fixture_system(oscillator), "symplectic-euler", DAL_PHYSICAL, h);
    dal_run *run = fixture_run(&spec);
    for (long long k = 1; k <= 200000; k++) {
        CU_ASSERT_EQUAL_FATAL(dal_run_step(run, NULL), DAL_STATUS_OK);
        if (dal_run_time(run) != (double)k * h) {
            CU_FAIL("the clock is not k h");
            break;
        }
    }
    dal_run_free(run);
}

/* ---- rows ---- */

enum { ROWS = 8 };

typedef struct seen {
    int count, max;
    double t[ROWS], x[ROWS], clock[ROWS];
    long long steps[ROWS];
} seen;

static dal_status see(void *user, dal_run *run, long long row, double t)
{
    seen *s = user;
    (void)row;
    s->clock[s->count] = dal_run_time(run);
    s->t[s->count] = t;
    s->x[s->count] = dal_run_state(run)[0];
    s->steps[s->count] = dal_run_steps(run);
    return ++s->count == s->max ? DAL_STATUS_INTERRUPTED : DAL_STATUS_OK;
}

static void test_rows_on_steps(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system(oscillator), "rk4", DAL_PHYSICAL, h);
    dal_run *run = fixture_run(&spec);
    const long long rows = far_step / 1000 + 3;
    const double T = (double)(1000 * rows) * h;
    seen s = {.max = ROWS};
    const dal_observer observer = {.user = &s, .sample = see};
    set_step(run, far_step);
    CU_ASSERT_EQUAL(dal_run_sample(run, T, rows, rows - 2, &observer, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(s.count, 3);
    for (int i = 0; i < 3; i++) {
        CU_ASSERT_EQUAL(s.steps[i], far_step + 1000 * (i + 1));
        CU_ASSERT_DOUBLE_EQUAL(s.t[i], (double)s.steps[i] * h, T * DBL_EPSILON);
    }
    CU_ASSERT_EQUAL(s.t[2], T);
    dal_run_free(run);
}

/* Row number row a few last places of t from the end of step far_step + row + 1. */
static const double off[] = {0.0, 5.0, -5.0, 7.0, -7.0, 0.0, 0.0};

static double near_steps(void *user, long long row)
{
    const double t = (double)(far_step + row + 1) * h;
    (void)user;
    return t + off[row] * (nextafter(t, INFINITY) - t);
}

/* The rounding of the clock is 4 DBL_EPSILON t, 5.96 of the last places that t = 1e8 has: a row
 * nearer than that to a step is shown at the step, one farther off at its own time. */
static void test_rows_near_steps(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system(oscillator), "rk4", DAL_PHYSICAL, h);
    dal_run *run = fixture_run(&spec);
    seen s = {.max = ROWS};
    const dal_observer observer = {.user = &s, .sample = see, .row_time = near_steps};
    set_step(run, far_step);
    CU_ASSERT_EQUAL(dal_run_sample(run, (double)(far_step + 7) * h, 6, 0, &observer, NULL),
                    DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(s.count, 7);
    for (int i = 0; i < 7; i++) {
        const double step = (double)(far_step + i + 1) * h;
        CU_ASSERT_EQUAL(s.t[i], i < 6 ? near_steps(NULL, i) : step);
        CU_ASSERT_EQUAL(s.clock[i], fabs(off[i]) < 6.0 ? step : s.t[i]);
        CU_ASSERT_EQUAL(s.steps[i], far_step + i + 1 + (off[i] > 6.0));
    }
    dal_run_free(run);
}

/* Early in a run the tolerance is 1e-9 of a step. */
static double near_step_one(void *user, long long row)
{
    static const double fraction[] = {0.0, 1.0 - 1.1e-9, 1.0 - 0.9e-9, 1.0 + 0.9e-9, 1.0 + 1.1e-9};
    (void)user;
    return fraction[row] * h;
}

static void test_rows_near_early_steps(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system(oscillator), "rk4", DAL_PHYSICAL, h);
    dal_run *run = fixture_run(&spec);
    seen s = {.max = ROWS};
    const dal_observer observer = {.user = &s, .sample = see, .row_time = near_step_one};
    CU_ASSERT_EQUAL(dal_run_sample(run, 2.0 * h, 5, 0, &observer, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(s.count, 6);
    for (int i = 0; i < 6; i++) {
        const double t = i < 5 ? near_step_one(NULL, i) : 2.0 * h;
        CU_ASSERT_EQUAL(s.t[i], t);
        CU_ASSERT_DOUBLE_EQUAL(s.clock[i], i == 2 || i == 3 ? h : t, 1e-17);
    }
    dal_run_free(run);
}

/* Rows in the middle of steps, from x = 1, x' = 0 at the far step: x = cos(t - far_step h), as far
 * as t itself is known. */
static void test_rows_between_steps(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system(oscillator), "gauss8", DAL_PHYSICAL, h);
    dal_run *run = fixture_run(&spec);
    const long long steps = far_step + 1000;
    const double T = (double)steps * h;
    seen s = {.max = ROWS};
    const dal_observer observer = {.user = &s, .sample = see};
    set_step(run, far_step);
    CU_ASSERT_EQUAL(dal_run_sample(run, T, 2 * steps, 2 * far_step + 1, &observer, NULL),
                    DAL_STATUS_INTERRUPTED);
    CU_ASSERT_EQUAL(s.count, ROWS);
    for (int i = 0; i < s.count; i++) {
        CU_ASSERT_DOUBLE_EQUAL(s.t[i], ((double)far_step + 0.5 * (i + 1)) * h, T * DBL_EPSILON);
        CU_ASSERT_DOUBLE_EQUAL(s.x[i], cos(0.5 * h * (i + 1)), 2.0 * T * DBL_EPSILON);
    }
    dal_run_free(run);
}

void suite_long_clock(void)
{
    CU_pSuite suite = CU_add_suite("long clock", NULL, NULL);
    CU_add_test(suite, "the clock near step 1e10", test_clock);
    CU_add_test(suite, "the clock from the start", test_from_the_start);
    CU_add_test(suite, "rows on steps", test_rows_on_steps);
    CU_add_test(suite, "rows beside steps", test_rows_near_steps);
    CU_add_test(suite, "rows beside early steps", test_rows_near_early_steps);
    CU_add_test(suite, "rows between steps", test_rows_between_steps);
}
