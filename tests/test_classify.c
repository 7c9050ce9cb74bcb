/* test_classify.c - which observables of a run have a size and a trend: E and H where the motion of
 * the run conserves them (theory: dE/dt = v.Q + sum_a h_a v.A_a, dH/dt = pi.F_t). */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <dalembert.h>
#include <dalembert_analysis.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { STEPS = 400, MAX = 32, STARTS = 2 };

typedef struct followed {
    int count;
    char names[MAX][64];
    dal_trend trend[MAX];
} followed;

static int follow(const dal_run_spec *spec, followed *f)
{
    dal_statistics statistics[MAX];
    double values[MAX];
    dal_run *run;
    dal_error error;
    if (dal_run_create(&run, spec, &error) != DAL_STATUS_OK) {
        printf("\n  %s", error.message);
        return 0;
    }
    f->count = dal_run_observables(run);
    dal_statistics_start(statistics, f->count);
    for (int k = 0; k <= STEPS; k++) {
        if (k > 0 && dal_run_step(run, &error) != DAL_STATUS_OK) break;
        dal_run_observe(run, values);
        dal_statistics_add(statistics, f->count, dal_run_time(run), values);
    }
    dal_run_classify(run, statistics, DAL_STATUS_OK, f->trend);
    for (int i = 0; i < f->count; i++)
        dal_run_observable_name(run, i, f->names[i], sizeof f->names[i]);
    dal_run_free(run);
    return 1;
}

/* What becomes of an observable along 400 steps; "" is a run without it. */
static const char *fate(const dal_system *system, const char *method, const dal_options *options,
                        const dal_setting *start, const char *name)
{
    dal_run_spec spec = {.system = system, .options = *options, .start = start};
    while (spec.start_count < STARTS && start[spec.start_count].name) spec.start_count++;
    followed f = {.count = 0};
    if (dal_method_parse(&spec.method, method, NULL) != DAL_STATUS_OK || !follow(&spec, &f))
        return "";
    for (int i = 0; i < f.count; i++)
        if (strcmp(f.names[i], name) == 0) return dal_conservation_text(f.trend[i].conservation);
    return "";
}

static const char *fate_of(const char *name, const char *of, const char *method, int space,
                           int extend, const dal_setting *start)
{
    dal_options options = dal_options_default();
    options.step = 0.05;
    options.space = space;
    options.extend_energy = extend;
    return fate(fixture_system(of), method, &options, start, name);
}

static void test_energy(void)
{
    static const struct {
        const char *of, *method;
        int space, extend;
        dal_setting start[STARTS];
        dal_conservation conservation;
    } cases[] = {
        /* friction; a turning table, whose D is affine; D homogeneous, but with a thermostat */
        {"damped-oscillator", "gauss4", DAL_PHYSICAL, 0, {{NULL, 0}}, DAL_NOT_CONSERVED},
        {"turntable-ball", "gauss4", DAL_PHYSICAL, 0, {{NULL, 0}}, DAL_NOT_CONSERVED},
        {"isokinetic", "gauss4", DAL_PHYSICAL, 0, {{NULL, 0}}, DAL_NOT_CONSERVED},
        /* D linear and homogeneous: E is conserved on D = 0 only, which rk4 leaves */
        {"contact-oscillator", "rk4", DAL_PHYSICAL, 0, {{NULL, 0}}, DAL_OFF_SURFACE},
        {"contact-oscillator", "rk4+project", DAL_PHYSICAL, 0, {{NULL, 0}}, DAL_CONSERVED},
        {"contact-oscillator", "stormer-verlet", DAL_PHYSICAL, 0, {{NULL, 0}}, DAL_CONSERVED},
        {"contact-oscillator", "rk4", DAL_LIFTED, 0, {{NULL, 0}}, DAL_OFF_SURFACE},
        /* F continued off D = 0 so that E is exact */
        {"contact-oscillator", "rk4", DAL_PHYSICAL, 1, {{NULL, 0}}, DAL_CONSERVED},
        /* degree 0 in v: on every level */
        {"pursuit", "rk4", DAL_PHYSICAL, 0, {{NULL, 0}}, DAL_CONSERVED},
        /* pi/e does work unless 1/e = 0; without constraints, too */
        {"contact-oscillator", "gauss4", DAL_LIFTED, 0, {{"pi_x", 1e-9}}, DAL_MOVED_BY_PI},
        {"pursuit", "gauss4", DAL_LIFTED, 0, {{"pi_x", 1e-9}}, DAL_MOVED_BY_PI},
        {"contact-oscillator",
         "gauss4",
         DAL_LIFTED,
         0,
         {{"pi_x", 1e-9}, {"e", INFINITY}},
         DAL_CONSERVED},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const char *text = fate_of("E", cases[i].of, cases[i].method, cases[i].space,
                                   cases[i].extend, cases[i].start);
        const char *wanted = dal_conservation_text(cases[i].conservation);
        if (strcmp(text, wanted) != 0)
            printf("\n  %s, %s: %s, not %s", cases[i].of, cases[i].method, text, wanted);
        CU_ASSERT_STRING_EQUAL(text, wanted);
    }
}

/* x'' = -x + cos t: H changes off pi = 0 alone. */
static const char driven[] = "coordinates: [x]\naccelerations: {x: -x + cos(t)}\n";

static void test_hamiltonian(void)
{
    const dal_system *system = fixture_system(driven);
    const dal_options options = dal_options_default();
    const dal_setting pushed[STARTS] = {{"pi_x", 1.0}}, none[STARTS] = {{NULL, 0.0}};
    const char *off = fate(system, "gauss4", &options, pushed, "H");
    const char *on = fate(system, "gauss4", &options, none, "H");
    CU_ASSERT_STRING_EQUAL(off, dal_conservation_text(DAL_NOT_CONSERVED));
    CU_ASSERT_STRING_EQUAL(on, dal_conservation_text(DAL_CONSERVED));
    CU_ASSERT_STRING_EQUAL(fate_of("H", "contact-oscillator", "gauss4", DAL_LIFTED, 0, pushed),
                           dal_conservation_text(DAL_CONSERVED));
}

/* On a level of D other than 0, where a state was set, E is not conserved although D does not
 * drift: D = x' - y z' of the contact oscillator under a method that keeps it. */
static void test_other_level(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system("contact-oscillator"), "stormer-verlet",
                                           DAL_PHYSICAL, dal_options_default().step);
    dal_statistics statistics[MAX];
    dal_trend trend[MAX];
    dal_run *run = fixture_run(&spec);
    double values[MAX], state[6] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
    CU_ASSERT_FATAL(dal_run_set_state(run, 0.0, state, NULL) == DAL_STATUS_OK);
    const int count = dal_run_observables(run);
    dal_statistics_start(statistics, count);
    for (int k = 0; k <= STEPS; k++) {
        if (k > 0) CU_ASSERT_FATAL(dal_run_step(run, NULL) == DAL_STATUS_OK);
        dal_run_observe(run, values);
        dal_statistics_add(statistics, count, dal_run_time(run), values);
    }
    dal_run_classify(run, statistics, DAL_STATUS_OK, trend);
    CU_ASSERT(fabs(trend[0].first) > 0.1 && trend[0].size != DAL_SIZE_LARGER);
    CU_ASSERT_EQUAL(trend[1].conservation, DAL_OFF_SURFACE);
    dal_run_free(run);
}

/* exp(k s), 0 <= s <= 1, modulated by half, to one side or to both. */
static dal_trend_class trend_of_exponential(double k, int both_sides)
{
    enum { VALUES = 40000 };
    dal_statistics statistics;
    dal_trend trend;
    dal_statistics_start(&statistics, 1);
    for (int i = 0; i <= VALUES; i++) {
        const double s = (double)i / VALUES, wave = sin(3000.0 * s);
        const double x = exp(k * s) * (both_sides ? wave : 1.0 + 0.5 * wave);
        dal_statistics_add(&statistics, 1, s, &x);
    }
    dal_statistics_classify(&statistics, dal_statistics_max_abs(&statistics), DAL_STATUS_OK,
                            &trend);
    return trend.trend;
}

static void test_many_folds(void)
{
    static const double folds[] = {10.0, 20.0, 40.0, 92.0, 300.0, 600.0};
    for (size_t i = 0; i < sizeof folds / sizeof folds[0]; i++) {
        CU_ASSERT_EQUAL(trend_of_exponential(folds[i], 0), DAL_TREND_EXPONENTIAL);
        CU_ASSERT_EQUAL(trend_of_exponential(folds[i], 1), DAL_TREND_GROWING);
    }
}

void suite_classify(void)
{
    CU_pSuite suite = CU_add_suite("classification of a run", NULL, NULL);
    CU_add_test(suite, "where E has a trend", test_energy);
    CU_add_test(suite, "where H has a trend", test_hamiltonian);
    CU_add_test(suite, "E on another level of D", test_other_level);
    CU_add_test(suite, "exponentials over many e-folds", test_many_folds);
}
