/* test_trend_runs.c - trends of runs of shipped systems: those that were named wrongly once, and
 * whether a run fifty times as long contradicts the statement about a short one. */
#include "fixtures.h"
#include "quick.h"
#include "trend_matrix.h"
#include <CUnit/CUnit.h>
#include <dalembert.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { OBSERVABLES = 64 };

static dal_status take(void *user, dal_run *run, int samples, const double *at,
                       const double *values, size_t stride)
{
    dal_statistics_add_many(user, dal_run_observables(run), samples, at, values, stride);
    return DAL_STATUS_OK;
}

/* All trends of a run; the place of an observable, or -1. */
static int run_trends(const char *system, const char *method, double h, double T,
                      const char *observable, dal_trend *trend)
{
    const dal_run_spec spec = fixture_spec(fixture_system(system), method, DAL_PHYSICAL, h);
    dal_statistics statistics[OBSERVABLES];
    const dal_observer observer = {.user = statistics, .values = take, .every = 1};
    dal_run *run = NULL; /* a method may refuse the system */
    char name[64];
    int place = -1;
    dal_statistics_start(statistics, OBSERVABLES);
    if (dal_run_create(&run, &spec, NULL) == DAL_STATUS_OK &&
        dal_run_sample(run, T, 1, 0, &observer, NULL) == DAL_STATUS_OK) {
        dal_run_classify(run, statistics, DAL_STATUS_OK, trend);
        for (int i = 0; i < dal_run_observables(run); i++) {
            dal_run_observable_name(run, i, name, sizeof name);
            CU_ASSERT(trend_is_consistent(&trend[i]));
            if (strcmp(name, observable) == 0) place = i;
        }
    }
    dal_run_free(run);
    return place;
}

enum {
    NONE = 1 << DAL_TREND_NONE,
    SETTLES = 1 << DAL_TREND_SETTLES,
    LINEAR = 1 << DAL_TREND_LINEAR,
    GROWING = 1 << DAL_TREND_GROWING,
    UNDECIDED = 1 << DAL_TREND_UNDECIDED
};

static void test_runs(void)
{
    static const struct {
        const char *system, *method;
        double h, T;
        const char *observable;
        dal_size_class size;
        int trends;
    } cases[] = {
        {"chaplygin-sleigh-full-turn", "mclachlan-perlmutter", 0.02, 30.0, "E", DAL_SIZE_LARGER,
         NONE | SETTLES | UNDECIDED},
        {"chaplygin-sleigh-offset", "stormer-verlet", 0.05, 40.0, "E", DAL_SIZE_LARGER,
         NONE | SETTLES | UNDECIDED},
        {"nonholonomic-particle-free", "stormer-verlet", 0.05, 30.0, "E", DAL_SIZE_LARGER,
         NONE | SETTLES | UNDECIDED},
        {"contact-oscillator", "gauss4", 0.01, 20.0, "E", DAL_SIZE_LARGER,
         NONE | SETTLES | UNDECIDED},
        {"contact-oscillator", "gauss4", 0.01, 40.0, "E", DAL_SIZE_LARGER,
         NONE | SETTLES | UNDECIDED},
        {"contact-oscillator", "gauss8", 0.1, 4e4, "Hxz", DAL_SIZE_LARGER,
         LINEAR | GROWING | UNDECIDED},
        {"isokinetic", "mclachlan4", 0.01, 5.0, "D1", DAL_SIZE_LARGER, NONE | SETTLES | UNDECIDED},
        {"chaplygin-sleigh", "gauss6", 0.02, 100.0, "D1", DAL_SIZE_ROUNDING, LINEAR},
        {"chaplygin-sleigh", "gauss6", 0.02, 1000.0, "D1", DAL_SIZE_ROUNDING, LINEAR},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        if (cases[i].T / cases[i].h > (double)long_run(1000000)) continue;
        dal_trend trend[OBSERVABLES];
        const int at = run_trends(cases[i].system, cases[i].method, cases[i].h, cases[i].T,
                                  cases[i].observable, trend);
        CU_ASSERT(at >= 0);
        if (at < 0) continue;
        const dal_trend *const f = &trend[at];
        printf("\n  %s, %s, T = %g: %s: %s, %s, %.2f, R %.1e, rate %.3e (%.3e %.3e)",
               cases[i].system, cases[i].method, cases[i].T, cases[i].observable,
               dal_size_text(f->size), dal_trend_text(f->trend), f->confidence, f->deviation,
               f->rate, f->rate_low, f->rate_high);
        CU_ASSERT_EQUAL(f->size, cases[i].size);
        CU_ASSERT(cases[i].trends >> f->trend & 1);
    }
    printf("\n");
}

/* ---- short and long runs ---- */

/* What a longer run says against what was said of a shorter one, over T; NULL: nothing. */
static const char *contradiction(const dal_trend *s, const dal_trend *l, double T)
{
    const bool grows = s->trend == DAL_TREND_LINEAR || s->trend == DAL_TREND_POWER ||
                       s->trend == DAL_TREND_EXPONENTIAL || s->trend == DAL_TREND_GROWING;
    if (grows && l->trend == DAL_TREND_NONE) return "grows, then does not";
    if (s->trend != DAL_TREND_NONE) return NULL;
    if (l->trend == DAL_TREND_POWER || l->trend == DAL_TREND_EXPONENTIAL) return "none, then grows";
    const double min_rate = fmin(fabs(l->rate_low), fabs(l->rate_high));
    return l->trend == DAL_TREND_LINEAR && min_rate * T > s->max_drift ? "none, then a line" : NULL;
}

/* Adds the observables of one system and method to the counts. */
static void compare_lengths(const char *system, const char *method, int *quantities, int *refuted)
{
    const double h = 0.05, T = long_run(100) < 100 ? 2.0 : 20.0;
    dal_trend brief[OBSERVABLES], lengthy[OBSERVABLES];
    for (int i = 0; i < OBSERVABLES; i++) brief[i].trend = lengthy[i].trend = DAL_TREND_ABORTED;
    run_trends(system, method, h, T, "", brief);
    run_trends(system, method, h, 50.0 * T, "", lengthy);
    for (int i = 0; i < OBSERVABLES; i++) {
        if (brief[i].trend == DAL_TREND_ABORTED || lengthy[i].trend == DAL_TREND_ABORTED) continue;
        const char *const reason = contradiction(&brief[i], &lengthy[i], T);
        *quantities += 1;
        *refuted += reason != NULL;
        if (reason) printf("\n  %s, %s, observable %d: %s", system, method, i, reason);
    }
}

/* An oscillation of many times T is a line up to T, in any series.  Hence one in a hundred. */
static void test_lengths(void)
{
    static const char *const methods[] = {"rk4", "gauss4", "stormer-verlet", "mclachlan-perlmutter",
                                          "rk4+project"};
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
    const int every = 10;
#else
    const int every = long_run(10) < 10 ? 10 : 1;
#endif
    int quantities = 0, refuted = 0;
    for (int i = 0; dal_builtin_name(i); i++) {
        /* knife-edge-reaction has the motion of knife-edge, which counts once. */
        if (i % every != 0 || strcmp(dal_builtin_name(i), "knife-edge-reaction") == 0) continue;
        for (size_t k = 0; k < sizeof methods / sizeof methods[0]; k++)
            compare_lengths(dal_builtin_name(i), methods[k], &quantities, &refuted);
    }
    printf("\n  %d quantities, %d refuted\n", quantities, refuted);
    CU_ASSERT(quantities >= 500 / every);
    CU_ASSERT(100 * refuted <= quantities);
}

void suite_trend_runs(void)
{
    CU_pSuite suite = CU_add_suite("trends of runs", NULL, NULL);
    CU_add_test(suite, "known ones", test_runs);
    CU_add_test(suite, "short and long", test_lengths);
}
