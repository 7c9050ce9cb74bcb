/* test_error_budget.c - what drifts come from, where it is known beforehand. */
#include "allocation.h"
#include "fixtures.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static dal_error_budget *explained(const dal_run_spec *spec, long long steps, long long quad_steps)
{
    dal_error_budget *e = NULL;
    dal_error error = {0};
    const dal_status status = dal_error_budget_create(spec, steps, quad_steps, NULL, &e, &error);
    if (status != DAL_OK) printf("\n  %s\n", error.message);
    CU_ASSERT_EQUAL_FATAL(status, DAL_OK);
    return e;
}

static int number_of(const dal_error_budget *e, const char *name)
{
    for (int i = 0; i < e->observables; i++)
        if (strcmp(e->shares[i].name, name) == 0) return i;
    CU_FAIL("no such observable");
    return 0;
}

static const dal_shares *of(const dal_error_budget *e, const char *name)
{
    return &e->shares[number_of(e, name)];
}

static double sum_of_shares(const dal_shares *a)
{
    double sum = 0.0;
    for (int k = DAL_SOURCE_TRUNCATION; k <= DAL_SOURCE_ROUNDING; k++)
        sum += isnan(a->share[k]) ? 0.0 : a->share[k];
    return sum;
}

static int says(const dal_error_budget *e, const char *name, dal_error_source source,
                const char *fragment)
{
    char words[512];
    dal_error_budget_describe(e, number_of(e, name), source, words, sizeof words);
    const int found = strstr(words, fragment) != NULL;
    if (!found) printf("\n  '%s' lacks '%s'\n", words, fragment);
    return found;
}

/* rk4 does not keep the sleigh's D, which its truncation moves like h^4; nor, without D = 0, E.
 * With +project D stays, and E moves like h^5 alone. */
static void test_truncation(void)
{
    dal_run_spec spec = fixture_spec(fixture_system("chaplygin-sleigh"), "rk4", DAL_PHYSICAL, 0.1);
    dal_error_budget *e = explained(&spec, 600, 400);
    const dal_shares *d = of(e, "D1"), *energy = of(e, "E");
    CU_ASSERT(fabs(d->share[DAL_SOURCE_TRUNCATION] - 1.0) < 1e-6);
    CU_ASSERT(fabs(d->order - 4.0) < 0.05);
    CU_ASSERT(d->share[DAL_SOURCE_ROUNDING] < 1e-6);
    CU_ASSERT_EQUAL(d->share[DAL_SOURCE_SOLVER], 0.0);
    CU_ASSERT(d->share[DAL_SOURCE_PROJECTION] > 1.0 - 1e-9);
    CU_ASSERT(energy->share[DAL_SOURCE_PROJECTION] > 0.99);
    CU_ASSERT(fabs(energy->share[DAL_SOURCE_TRUNCATION] - 1.0) < 1e-6);
    CU_ASSERT(says(e, "D1", DAL_SOURCE_TRUNCATION, "falls by 16 = 2^4.00") ||
              says(e, "D1", DAL_SOURCE_TRUNCATION, "falls by 15.9 = 2^3.99"));
    CU_ASSERT(says(e, "D1", DAL_SOURCE_SOLVER, "solves no equations"));
    dal_error_budget_free(e);
    spec = fixture_spec(spec.system, "rk4+project", DAL_PHYSICAL, 0.1);
    e = explained(&spec, 600, 400);
    CU_ASSERT(e->has_projection);
    CU_ASSERT(fabs(of(e, "E")->order - 5.0) < 0.05);
    CU_ASSERT(of(e, "E")->by_rate);
    CU_ASSERT(fabs(of(e, "E")->share[DAL_SOURCE_TRUNCATION] - 1.0) < 1e-4);
    CU_ASSERT_EQUAL(of(e, "D1")->share[DAL_SOURCE_PROJECTION], 0.0);
    CU_ASSERT(of(e, "D1")->comparison[DAL_COMPARISON_PROJECTION].deviation > 1e-5);
    CU_ASSERT(fabs(of(e, "D1")->share[DAL_SOURCE_ROUNDING] - 1.0) < 1e-9);
    CU_ASSERT(says(e, "D1", DAL_SOURCE_TRUNCATION, "nothing of it is left"));
    dal_error_budget_free(e);
}

/* Substeps half as long: the tolerance falls by 2^8, and so does the error, about. */
static void test_tolerance(void)
{
    dal_run_spec spec =
        fixture_spec(fixture_system("chaplygin-sleigh"), "dop853", DAL_PHYSICAL, 3.0);
    spec.options.tolerance = 1e-8;
    dal_error_budget *e = explained(&spec, 40, 40);
    const dal_shares *d = of(e, "D1");
    CU_ASSERT(fabs(d->share[DAL_SOURCE_TRUNCATION] - 1.0) < 0.1);
    CU_ASSERT(fabs(d->order - 8.0) < 0.5);
    CU_ASSERT(!d->is_motion && d->comparison[DAL_COMPARISON_EXACT].deviation < 1e-13);
    dal_error_budget_free(e);
}

/* On a constraint nonlinear in v, whose forces do work: E changes by the motion itself. */
static void test_nonlinear(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system("isokinetic"), "rk4", DAL_PHYSICAL, 0.05);
    dal_error_budget *e = explained(&spec, 400, 200);
    const dal_shares *d = of(e, "D1"), *energy = of(e, "E");
    CU_ASSERT(fabs(d->share[DAL_SOURCE_TRUNCATION] - 1.0) < 1e-5);
    CU_ASSERT(fabs(d->order - 4.0) < 0.1);
    CU_ASSERT(energy->is_motion);
    CU_ASSERT(isnan(energy->share[DAL_SOURCE_TRUNCATION]));
    CU_ASSERT(says(e, "E", DAL_SOURCE_TRUNCATION, "the motion itself"));
    CU_ASSERT(says(e, "E", DAL_SOURCE_TRUNCATION, "along the exact motion the drift is 1 times"));
    CU_ASSERT(e->ran[DAL_COMPARISON_EXACT]);
    dal_error_budget_free(e);
}

/* The midpoint rule keeps a bilinear D, and its one coefficient is 1/2: what moves is rounding. */
static void test_rounding(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system("contact-oscillator"), "implicit-midpoint", DAL_PHYSICAL, 0.1);
    dal_error_budget *e = explained(&spec, 2000, 500);
    const dal_shares *d = of(e, "D1");
    CU_ASSERT(fabs(d->share[DAL_SOURCE_ROUNDING] - 1.0) < 1e-9);
    CU_ASSERT(d->vanishes_in_quad);
    CU_ASSERT(fabs(d->share[DAL_SOURCE_TRUNCATION]) < 1e-12);
    CU_ASSERT_EQUAL(d->share[DAL_SOURCE_COEFFICIENTS], 0.0);
    CU_ASSERT(!(d->share[DAL_SOURCE_SOLVER] > 0.0));
    CU_ASSERT(says(e, "D1", DAL_SOURCE_TRUNCATION, "in quad precision nothing of it is left"));
    /* E, which this method does not keep, drifts by truncation. */
    CU_ASSERT(fabs(of(e, "E")->share[DAL_SOURCE_TRUNCATION] - 1.0) < 1e-6);
    CU_ASSERT(fabs(of(e, "E")->order - 2.0) < 0.1);
    dal_error_budget_free(e);
}

/* Equations solved to 1e-8: what the solver leaves moves D by far more than truncation does, whose
 * part is as large as when they are solved. */
static void test_solver(void)
{
    dal_run_spec spec =
        fixture_spec(fixture_system("chaplygin-sleigh"), "gauss8", DAL_PHYSICAL, 0.1);
    dal_error_budget *solved = explained(&spec, 400, 400);
    spec.options.solver_tolerance = 1e-8;
    dal_error_budget *e = explained(&spec, 400, 400);
    const dal_shares *d = of(e, "D1");
    CU_ASSERT(d->solver_is_significant);
    CU_ASSERT(d->share[DAL_SOURCE_SOLVER] > 0.99);
    CU_ASSERT(d->share[DAL_SOURCE_TRUNCATION] < 0.01);
    CU_ASSERT(d->share[DAL_SOURCE_ROUNDING] < 0.01);
    CU_ASSERT(d->by_rate);
    CU_ASSERT(fabs(sum_of_shares(d) - 1.0) < 1e-9);
    CU_ASSERT(d->comparison[DAL_COMPARISON_LOOSER].deviation > 3 * d->whole.deviation);
    CU_ASSERT(d->comparison[DAL_COMPARISON_TIGHTER].deviation < 0.01 * d->whole.deviation);
    CU_ASSERT_EQUAL(d->comparison[DAL_COMPARISON_QUAD].deviation,
                    of(solved, "D1")->comparison[DAL_COMPARISON_QUAD].deviation);
    CU_ASSERT(says(e, "D1", DAL_SOURCE_SOLVER, "solved to rounding"));
    dal_error_budget_free(solved);
    dal_error_budget_free(e);
}

/* gauss8 keeps a bilinear D but for its coefficients, which are good to 20 digits: what they do to
 * D in a unit of time is proportional to h (h^2 in a step), and far below rounding. */
static void test_coefficients(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system("contact-oscillator"), "gauss8", DAL_PHYSICAL, 0.1);
    dal_error_budget *e = explained(&spec, 600, 600);
    const dal_shares *d = of(e, "D1");
    CU_ASSERT(fabs(d->order - 1.0) < 0.1);
    CU_ASSERT_EQUAL(d->share[DAL_SOURCE_TRUNCATION], 0.0);
    CU_ASSERT(fabs(d->share[DAL_SOURCE_COEFFICIENTS]) > 1e-8);
    CU_ASSERT(fabs(d->share[DAL_SOURCE_COEFFICIENTS]) < 1e-3);
    CU_ASSERT(fabs(d->share[DAL_SOURCE_ROUNDING] - 1.0) < 1e-3);
    CU_ASSERT(says(e, "D1", DAL_SOURCE_COEFFICIENTS, "coefficients are doubles"));
    dal_error_budget_free(e);
}

/* x + h v in plain sums: all of the error is rounding, and goes in compensated ones. */
static void test_sums(void)
{
    dal_run_spec spec =
        fixture_spec(fixture_system("coordinates: [x]\nlagrangian: x'^2/2\nstart: {x': 0.1}\n"
                                    "exact: {x: 0.1*t}\n"),
                     "symplectic-euler-10", DAL_PHYSICAL, 0.01);
    spec.options.sums = DAL_SUMS_PLAIN;
    dal_error_budget *e = explained(&spec, 20000, 20000);
    const dal_shares *error = of(e, "error");
    CU_ASSERT(fabs(error->share[DAL_SOURCE_ROUNDING] - 1.0) < 0.05);
    CU_ASSERT(error->comparison[DAL_COMPARISON_SUMS].deviation < 0.05 * error->whole.deviation);
    CU_ASSERT(says(e, "error", DAL_SOURCE_ROUNDING, "with compensated sums"));
    dal_error_budget_free(e);
}

/* ---- what cannot be had ---- */

static dal_status energy(const dal_system *system, const dal_point *at, double *out)
{
    (void)system;
    out[0] = 0.5 * (at->v[0] * at->v[0] + at->q[0] * at->q[0]);
    return DAL_OK;
}
static dal_status start(const dal_system *system, const dal_point *at, double *out)
{
    (void)system, (void)at;
    out[0] = 1.0;
    out[1] = 0.0;
    return DAL_OK;
}

/* Without quad precision halving alone decides: rk4 on an oscillator loses energy like h^5. */
static void test_by_hand(void)
{
    const dal_system spring = {.name = "spring",
                               .n = 1,
                               .call = {.field = fixture_oscillate},
                               .energy = energy,
                               .start = start};
    const dal_run_spec spec = fixture_spec(&spring, "rk4", DAL_PHYSICAL, 0.1);
    dal_error_budget *e = explained(&spec, 1000, 100);
    const dal_shares *loss = of(e, "E");
    CU_ASSERT_EQUAL(e->quad_steps, 0);
    CU_ASSERT_PTR_NOT_NULL(strstr(e->reason[DAL_COMPARISON_QUAD], "spring has no form in it"));
    CU_ASSERT_PTR_NOT_NULL(strstr(e->reason[DAL_COMPARISON_PROJECTION], "no constraint"));
    CU_ASSERT(!e->ran[DAL_COMPARISON_EXACT]);
    CU_ASSERT_PTR_NOT_NULL(strstr(e->reason[DAL_COMPARISON_EXACT], "taylor"));
    CU_ASSERT(fabs(loss->order - 5.0) < 0.05);
    CU_ASSERT(isnan(loss->share[DAL_SOURCE_ROUNDING]));
    CU_ASSERT(isnan(loss->share[DAL_SOURCE_COEFFICIENTS]));
    CU_ASSERT(says(e, "E", DAL_SOURCE_ROUNDING, "no quad precision"));
    dal_error_budget_free(e);
}

typedef struct watch {
    int calls, max_calls, runs;
    double done;
} watch;

static dal_status step(void *user, double done)
{
    watch *w = user;
    CU_ASSERT(done >= w->done && done <= 1.0);
    w->done = done;
    return ++w->calls < w->max_calls ? DAL_OK : DAL_INTERRUPTED;
}
static void begin(void *user, dal_run *run, long long steps)
{
    (void)run;
    CU_ASSERT(steps >= 50);
    ((watch *)user)->runs++;
}

static void test_observer(void)
{
    dal_run_spec spec = fixture_spec(fixture_system("knife-edge"), "gauss4", DAL_PHYSICAL, 0.1);
    dal_error_budget *e = NULL;
    dal_error error = {0};
    watch w = {.max_calls = 1 << 30};
    const dal_error_budget_observer observer = {&w, step, begin};
    CU_ASSERT_EQUAL(dal_error_budget_create(&spec, 100, 50, &observer, &e, &error), DAL_OK);
    CU_ASSERT_EQUAL(w.runs, 9); /* the run, six comparisons, and the beginning in doubles */
    CU_ASSERT(w.done > 0.99);
    dal_error_budget_free(e);
    const int all = w.calls;
    for (int max_calls = 1; max_calls < all; max_calls += all / 7) {
        w = (watch){.max_calls = max_calls};
        CU_ASSERT_EQUAL(dal_error_budget_create(&spec, 100, 50, &observer, &e, &error),
                        DAL_INTERRUPTED);
        CU_ASSERT_PTR_NULL(e);
    }
    CU_ASSERT_EQUAL(dal_error_budget_create(&spec, 0, 50, NULL, &e, &error), DAL_ARGUMENT);
    spec.options.precision = DAL_QUAD;
    CU_ASSERT_EQUAL(dal_error_budget_create(&spec, 100, 50, NULL, &e, &error), DAL_ARGUMENT);
    spec.options.precision = DAL_DOUBLE;
    spec.options.iterations = 1;
    CU_ASSERT_EQUAL(dal_error_budget_create(&spec, 100, 50, NULL, &e, &error), DAL_NOT_CONVERGED);
    CU_ASSERT_PTR_NULL(e);
}

/* An explicit method has no equations that could be solved more or less exactly. */
static void test_explicit(void)
{
    static const dal_comparison_run solver[] = {DAL_COMPARISON_TIGHTER, DAL_COMPARISON_LOOSER};
    const dal_run_spec spec = fixture_spec(fixture_system("knife-edge"), "rk4", DAL_PHYSICAL, 0.1);
    dal_error_budget *e = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_error_budget_create(&spec, 4, 2, NULL, &e, NULL), DAL_OK);
    for (int i = 0; i < 2; i++) {
        CU_ASSERT(!e->ran[solver[i]]);
        CU_ASSERT_STRING_EQUAL(e->reason[solver[i]], "the method solves no equations");
    }
    dal_error_budget_free(e);
}

static void test_out_of_memory(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system("knife-edge"), "gauss4", DAL_PHYSICAL, 0.1);
    allocation_trial trial = {0};
    while (allocation_next(&trial)) {
        dal_error_budget *e = NULL;
        allocation_start(&trial);
        const dal_status status = dal_error_budget_create(&spec, 4, 2, NULL, &e, NULL);
        CU_ASSERT_EQUAL(e == NULL, allocation_end(&trial, status));
        dal_error_budget_free(e);
    }
    CU_ASSERT(trial.failures >= 10);
}

void suite_error_budget(void)
{
    CU_pSuite suite = CU_add_suite("error budget", NULL, NULL);
    CU_add_test(suite, "truncation", test_truncation);
    CU_add_test(suite, "a tolerance", test_tolerance);
    CU_add_test(suite, "a nonlinear constraint", test_nonlinear);
    CU_add_test(suite, "rounding", test_rounding);
    CU_add_test(suite, "the solver", test_solver);
    CU_add_test(suite, "coefficients", test_coefficients);
    CU_add_test(suite, "sums", test_sums);
    CU_add_test(suite, "without quad precision", test_by_hand);
    CU_add_test(suite, "an explicit method", test_explicit);
    CU_add_test(suite, "observers", test_observer);
    CU_add_test(suite, "out of memory", test_out_of_memory);
}
