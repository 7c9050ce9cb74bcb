/* test_adaptive.c - steps divided under a tolerance: the error follows the tolerance, the work the
 * motion; bits where they are promised; what is refused, and what a step says that fails. */
#include "dalembert_codegen.h"
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Evaluations of a substep of dop853. */
enum { STAGES = 12 };

/* An ellipse of eccentricity 0.9, from its pericentre on; the period is 2 pi. */
static const char kepler[] = "coordinates: [x, y]\n"
                             "lagrangian: (x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2)\n"
                             "start: {x: 0.1, y: 0, x': 0, y': sqrt(19)}\n";
#define PERIOD 6.283185307179586

/* ---- error and work ---- */

static dal_run_spec spec_of(const dal_system *system, dal_space space, double step,
                            double tolerance)
{
    dal_run_spec spec = fixture_spec(system, "dop853", space, step);
    spec.options.tolerance = tolerance;
    return spec;
}

/* The observable `error`, against the closed form that the system has. */
static double exact_error(dal_run *run)
{
    double out[32];
    char name[32];
    const int last = dal_run_observables(run) - 1;
    CU_ASSERT_STRING_EQUAL(dal_run_observable_name(run, last, name, sizeof name), "error");
    CU_ASSERT_EQUAL(dal_run_observe(run, out), DAL_OK);
    return out[last];
}

/* After whole periods. */
static double kepler_error(dal_run *run)
{
    const double *y = dal_run_state(run);
    return fmax(fabs(y[0] - 0.1), fabs(y[1]));
}

/* Against gauss10 with small steps, from displaced momenta. */
static double displaced_error(dal_run *run)
{
    static const double size = 0.3;
    const double T = dal_run_time(run);
    dal_run_spec spec = fixture_spec(dal_run_system(run), "gauss10", DAL_LIFTED, T / 1000);
    dal_run *reference = fixture_run(&spec);
    double error = 0.0;
    fixture_perturb(reference, size);
    CU_ASSERT_EQUAL(dal_run_advance(reference, 1000, NULL), DAL_OK);
    for (int i = 0; i < dal_run_dimension(run); i++)
        error = fmax(error, fabs(dal_run_state(run)[i] - dal_run_state(reference)[i]));
    dal_run_free(reference);
    return error;
}

typedef double error_function(dal_run *run);

/* Slope of log error over log tolerance, by least squares over six decades. */
static double slope(dal_run_spec spec, int steps, double displacement, error_function *error)
{
    enum { COUNT = 13 };
    double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (int k = 0; k < COUNT; k++) {
        spec.options.tolerance = pow(10.0, -4.0 - 0.5 * k);
        dal_run *run = fixture_run(&spec);
        if (displacement != 0.0) fixture_perturb(run, displacement);
        CU_ASSERT_EQUAL(dal_run_advance(run, steps, NULL), DAL_OK);
        const double x = log(spec.options.tolerance), y = log(error(run));
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
        dal_run_free(run);
    }
    return (COUNT * sxy - sx * sy) / (COUNT * sxx - sx * sx);
}

static void test_error(void)
{
    const struct {
        const char *text;
        dal_space space;
        double T, displacement;
        error_function *error;
    } cases[] = {{kepler, DAL_PHYSICAL, PERIOD, 0.0, kepler_error},
                 {"knife-edge", DAL_PHYSICAL, 10.0, 0.0, exact_error},
                 {"damped-oscillator", DAL_PHYSICAL, 10.0, 0.0, exact_error},
                 {fixture_full, DAL_LIFTED, 1.0, 0.3, displaced_error}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const dal_run_spec spec =
            spec_of(fixture_system(cases[i].text), cases[i].space, cases[i].T / 2, 0.0);
        const double seen = slope(spec, 2, cases[i].displacement, cases[i].error);
        if (!(fabs(seen - 1.0) <= 0.15)) printf("\n  case %d: slope %.3f\n", (int)i, seen);
        CU_ASSERT(fabs(seen - 1.0) <= 0.15);
    }
}

/* Times go with r^(3/2), 83 times longer at the far end than at the near one; a step is a 20th of
 * the period and sees some of that.  Free motion needs no division. */
static void test_work(void)
{
    dal_run_spec spec = spec_of(fixture_system(kepler), DAL_PHYSICAL, PERIOD / 20, 1e-9);
    dal_run *run = fixture_run(&spec);
    long long min = 1000000, max = 0;
    for (int i = 0; i < 20; i++) {
        const long long before = dal_run_evaluations(run);
        CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_OK);
        const long long made = dal_run_evaluations(run) - before;
        min = made < min ? made : min;
        max = made > max ? made : max;
    }
    CU_ASSERT(max >= 10 * min);
    CU_ASSERT_EQUAL(dal_run_time(run), 20 * spec.options.step);
    dal_run_free(run);
    const char *const free_motion = "coordinates: [x]\nlagrangian: x'^2/2\nstart: {x: 1, x': 3}\n";
    spec = spec_of(fixture_system(free_motion), DAL_PHYSICAL, 0.5, 1e-9);
    run = fixture_stepped(&spec, 10);
    CU_ASSERT_EQUAL(dal_run_evaluations(run), 10 * STAGES);
    dal_run_free(run);
}

/* ---- bits ---- */

static void same_state(const dal_run *a, const dal_run *b, int count)
{
    CU_ASSERT_EQUAL(memcmp(dal_run_state(a), dal_run_state(b), (size_t)count * sizeof(double)), 0);
}

/* Where the error of h is below the tolerance the divided step is the fixed one. */
static void test_whole(void)
{
    const dal_run_spec fixed = spec_of(fixture_system(fixture_full), DAL_LIFTED, 0.01, 0.0);
    const dal_run_spec loose = spec_of(fixture_system(fixture_full), DAL_LIFTED, 0.01, 1e-3);
    dal_run *a = fixture_run(&fixed), *b = fixture_run(&loose);
    fixture_perturb(a, 0.3);
    fixture_perturb(b, 0.3);
    CU_ASSERT_EQUAL(dal_run_advance(a, 50, NULL), DAL_OK);
    CU_ASSERT_EQUAL(dal_run_advance(b, 50, NULL), DAL_OK);
    CU_ASSERT_EQUAL(dal_run_evaluations(a), 50 * STAGES);
    CU_ASSERT_EQUAL(dal_run_evaluations(b), 50 * STAGES);
    same_state(a, b, dal_run_dimension(a));
    dal_run_free(a);
    dal_run_free(b);
}

static void test_surface(void)
{
    const double gauges[] = {1.0, -3.0, INFINITY};
    const dal_system *system = fixture_system(fixture_full);
    const dal_run_spec physical = spec_of(system, DAL_PHYSICAL, 0.7, 1e-8);
    dal_run *below = fixture_stepped(&physical, 5);
    CU_ASSERT(dal_run_evaluations(below) > 2 * 5 * STAGES);
    for (int i = 0; i < 3; i++) {
        const dal_setting e = {"e", gauges[i]};
        dal_run_spec lifted = spec_of(system, DAL_LIFTED, 0.7, 1e-8);
        lifted.start = &e;
        lifted.start_count = 1;
        dal_run *above = fixture_stepped(&lifted, 5);
        CU_ASSERT_EQUAL(dal_run_evaluations(above), dal_run_evaluations(below));
        same_state(above, below, 2 * system->n);
        dal_run_free(above);
    }
    dal_run_free(below);
}

/* What is planned travels with the state. */
static void test_load(void)
{
    const dal_run_spec spec = spec_of(fixture_system(kepler), DAL_PHYSICAL, PERIOD / 20, 1e-9);
    dal_run *whole = fixture_run(&spec), *first = fixture_run(&spec), *second = fixture_run(&spec);
    size_t count, again;
    CU_ASSERT_EQUAL(dal_run_advance(whole, 20, NULL), DAL_OK);
    CU_ASSERT_EQUAL(dal_run_advance(first, 7, NULL), DAL_OK);
    const double *memory = dal_run_save(first, &count);
    CU_ASSERT_EQUAL(dal_run_restore(second, memory, count, NULL), DAL_OK);
    CU_ASSERT_EQUAL(dal_run_advance(second, 13, NULL), DAL_OK);
    memory = dal_run_save(whole, &count);
    CU_ASSERT_EQUAL(memcmp(memory, dal_run_save(second, &again), count * sizeof *memory), 0);
    CU_ASSERT_EQUAL(count, again);
    dal_run_free(whole);
    dal_run_free(first);
    dal_run_free(second);
}

/* Each lane of a batch has the substeps, and the bits, of a run by itself. */
static void test_batch(void)
{
    enum { LANES = 9, STEPS = 7 };
    dal_run_spec spec = spec_of(fixture_system(kepler), DAL_PHYSICAL, PERIOD / 20, 1e-9);
    dal_batch *batch = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, LANES, 0, NULL), DAL_OK);
    for (int lane = 0; lane < LANES; lane++) {
        const dal_setting x = {"x", 0.1 + 0.05 * lane};
        CU_ASSERT_EQUAL(dal_batch_start(batch, lane, NULL, 0, &x, 1, NULL), DAL_OK);
    }
    CU_ASSERT_EQUAL(dal_batch_advance(batch, STEPS), DAL_OK);
    for (int lane = 0; lane < LANES; lane++) {
        const dal_setting x = {"x", 0.1 + 0.05 * lane};
        double state[4];
        spec.start = &x;
        spec.start_count = 1;
        dal_run *run = fixture_stepped(&spec, STEPS);
        dal_batch_state(batch, lane, state);
        CU_ASSERT_EQUAL(memcmp(state, dal_run_state(run), sizeof state), 0);
        dal_run_free(run);
    }
    dal_batch_free(batch);
}

/* ---- projections ---- */

/* The base keeps its substeps inside; D is back to rounding after each step of h. */
static void test_projected(void)
{
    static const char *const names[] = {"dop853+project", "dop853+project-energy"};
    for (int i = 0; i < 2; i++) {
        dal_run_spec spec = fixture_spec(fixture_system("knife-edge"), names[i], DAL_PHYSICAL, 5.0);
        double out[32];
        spec.options.tolerance = 1e-9;
        dal_run *run = fixture_stepped(&spec, 2);
        CU_ASSERT(dal_run_evaluations(run) > 4 * STAGES);
        CU_ASSERT_EQUAL(dal_run_observe(run, out), DAL_OK);
        CU_ASSERT(fabs(out[0]) <= 1e-14);
        CU_ASSERT(exact_error(run) <= 1e-6);
        dal_run_free(run);
    }
}

/* ---- refusals and failures ---- */

/* Who claims control takes a tolerance, and nobody else does. */
static void test_claims(void)
{
    for (int i = 0; dal_integrator_at(i); i++) {
        char name[96];
        dal_method method;
        fixture_method(i, name, sizeof name);
        CU_ASSERT_EQUAL_FATAL(dal_method_parse(&method, name, NULL), DAL_OK);
        dal_run_spec spec =
            fixture_spec(fixture_system("contact-oscillator"), name, DAL_PHYSICAL, 0.1);
        if (!fixture_accepts(&method, spec.system, DAL_PHYSICAL)) continue;
        spec.options.tolerance = 1e-6;
        if (dal_method_properties(&method) & DAL_ADAPTIVE)
            dal_run_free(fixture_run(&spec));
        else
            fixture_refused(&spec, DAL_UNSUPPORTED, name);
    }
    dal_run_spec spec =
        fixture_spec(fixture_system("contact-oscillator"), "dop853+lift", DAL_LIFTED, 0.1);
    spec.options.tolerance = 1e-6;
    fixture_refused(&spec, DAL_UNSUPPORTED, "dop853+lift has no control of its step size");
    spec = spec_of(spec.system, DAL_LIFTED, 0.1, -1e-6);
    fixture_refused(&spec, DAL_ARGUMENT, "option tolerance: -1e-06 is not from 0 to 1");
    spec.options.tolerance = NAN;
    fixture_refused(&spec, DAL_ARGUMENT, "is not from 0 to 1");
}

/* At rest, x = x' = 0, nothing but the momenta moves: with 1/e = 0, p' = pi and pi' = -p, so that
 * pi = cos t and p = sin t, which one step of h = 20 must divide for their sake alone. */
static void test_momenta_alone(void)
{
    const dal_setting start[] = {{"e", INFINITY}, {"pi_x", 1.0}};
    for (int k = 0; k < 3; k++) {
        static const double tolerances[] = {1e-6, 1e-9, 1e-12};
        dal_run_spec spec =
            spec_of(fixture_system("coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\n"), DAL_LIFTED,
                    20.0, tolerances[k]);
        spec.start = start;
        spec.start_count = 2;
        dal_run *run = fixture_run(&spec);
        CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_OK);
        const double *z = dal_run_state(run);
        CU_ASSERT_DOUBLE_EQUAL(z[3], sin(20.0), 20.0 * tolerances[k]);
        CU_ASSERT_DOUBLE_EQUAL(z[4], cos(20.0), 20.0 * tolerances[k]);
        CU_ASSERT(z[0] == 0.0 && z[1] == 0.0);
        dal_run_free(run);
    }
}

static void test_not_generated(void)
{
    const dal_run_spec spec =
        spec_of(fixture_system("contact-oscillator"), DAL_PHYSICAL, 0.1, 1e-6);
    dal_error error = {0};
    char *text = NULL;
    CU_ASSERT_EQUAL(dal_generate(&spec, 1, NULL, &text, &error), DAL_UNSUPPORTED);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "tolerance"));
    CU_ASSERT(error.line == 0 && error.column == 0);
    CU_ASSERT_PTR_NULL(text);
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_native(run, NULL, &error), DAL_UNSUPPORTED);
    CU_ASSERT_FALSE(dal_run_is_native(run));
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_OK);
    dal_run_free(run);
}

/* A step that fails says how, and leaves everything as it was. */
static void fails(const char *text, double step, const char *reason, double reached)
{
    const dal_run_spec spec = spec_of(fixture_system(text), DAL_PHYSICAL, step, 1e-10);
    dal_run *run = fixture_run(&spec);
    dal_error error = {0};
    double before[64];
    size_t count;
    const double *memory = dal_run_save(run, &count);
    CU_ASSERT_FATAL(count <= 64);
    memcpy(before, memory, count * sizeof *memory);
    CU_ASSERT_EQUAL(dal_run_step(run, &error), DAL_NOT_CONVERGED);
    if (!strstr(error.message, reason)) printf("\n  %s\n", error.message);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, reason));
    CU_ASSERT(error.line == 0 && error.column == 0);
    const char *where = strstr(error.message, "at t = ");
    CU_ASSERT_PTR_NOT_NULL_FATAL(where);
    if (reached > 0.0) CU_ASSERT(fabs(strtod(where + strlen("at t = "), NULL) - reached) <= 1e-6);
    CU_ASSERT_EQUAL(memcmp(before, memory, count * sizeof *memory), 0);
    dal_run_free(run);
}

/* x = 1/(1 - t) ends at 1, and its scale goes with it; sqrt(1 - t) has no value behind 1; 160000
 * turns are too many. */
static void test_failures(void)
{
    fails("coordinates: [x]\naccelerations: {x: 2*x^3}\nstart: {x: 1, x': 1}\n", 2.0,
          "too many substeps", 1.0);
    fails("coordinates: [x]\naccelerations: {x: sqrt(1 - t)}\n", 2.0,
          "the step size went to zero at t = ", 1.0);
    fails("coordinates: [x]\naccelerations: {x: -x}\nstart: {x: 1}\n", 1e6,
          "too many substeps (more than 100000) for tolerance 1e-10 in the step of 1e+06", 0.0);
}

void suite_adaptive(void)
{
    CU_pSuite suite = CU_add_suite("adaptive", NULL, NULL);
    CU_add_test(suite, "the error follows the tolerance", test_error);
    CU_add_test(suite, "the work follows the motion", test_work);
    CU_add_test(suite, "an undivided step is the fixed one", test_whole);
    CU_add_test(suite, "the surface, whatever the space and the gauge", test_surface);
    CU_add_test(suite, "loaded in the middle", test_load);
    CU_add_test(suite, "lanes of a batch", test_batch);
    CU_add_test(suite, "inside projections", test_projected);
    CU_add_test(suite, "who takes a tolerance", test_claims);
    CU_add_test(suite, "not generated", test_not_generated);
    CU_add_test(suite, "momenta alone divide a step", test_momenta_alone);
    CU_add_test(suite, "steps that fail", test_failures);
}
