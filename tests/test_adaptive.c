/* test_adaptive.c - steps divided under a tolerance: the error follows the tolerance, the work the
 * motion; bits where they are promised; what is refused, and what a step says that fails. */
#include "compiler.h"
#include "dalembert_codegen.h"
#include "fixtures.h"
#include "quick.h"
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
    CU_ASSERT_EQUAL(dal_run_observe(run, out), DAL_STATUS_OK);
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
    CU_ASSERT_EQUAL(dal_run_advance(reference, 1000, NULL), DAL_STATUS_OK);
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
        CU_ASSERT_EQUAL(dal_run_advance(run, steps, NULL), DAL_STATUS_OK);
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
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i += (size_t)case_stride(3)) {
        const dal_run_spec spec =
            spec_of(fixture_system(cases[i].text), cases[i].space, cases[i].T / 2, 0.0);
        const double seen = slope(spec, 2, cases[i].displacement, cases[i].error);
        if (!(fabs(seen - 1.0) <= 0.15)) printf("\n  case %d: slope %.3f\n", (int)i, seen);
        CU_ASSERT(fabs(seen - 1.0) <= 0.15);
    }
}

/* The largest error of (q,v) at T, relative to the largest number. */
static double error_at(const char *text, double T, double tolerance, const double *exact)
{
    const dal_run_spec spec = spec_of(fixture_system(text), DAL_PHYSICAL, T, tolerance);
    dal_run *run = fixture_stepped(&spec, 1);
    double error = 0.0, size = 0.0;
    for (int i = 0; i < dal_run_dimension(run); i++) {
        error = fmax(error, fabs(dal_run_state(run)[i] - exact[i]));
        size = fmax(size, fabs(exact[i]));
    }
    dal_run_free(run);
    return error / size;
}

/* A force of t alone with a peak of width w at t = c passes between the stages of long substeps:
 * x' = w (atan((t - c)/w) + atan(c/w)).  Without the comparison with the substep before, the error
 * is 76 times either tolerance at one c in a hundred. */
static void test_peak(void)
{
    static const char peak[] = "coordinates: [x]\nparameters: {c: 1, w: 0.1}\n"
                               "lagrangian: x'^2/2 + x*w^2/((t - c)^2 + w^2)\n";
    static const double tolerances[] = {1e-4, 1e-6}, w = 0.003, T = 8.0;
    const dal_system *system = fixture_system(peak);
    for (int i = 0; i < 400; i += case_stride(29)) {
        const double c = 3.0 + 0.01 * (i / 2);
        const dal_setting parameters[] = {{"c", c}, {"w", w}};
        const double exact = w * (atan((T - c) / w) + atan(c / w));
        dal_run_spec spec = spec_of(system, DAL_PHYSICAL, T, tolerances[i % 2]);
        spec.parameters = parameters;
        spec.parameter_count = 2;
        dal_run *run = fixture_stepped(&spec, 1);
        const double error = fabs(dal_run_state(run)[1] - exact);
        if (!(error <= spec.options.tolerance)) printf("\n  c = %.2f: %.2g\n", c, error);
        CU_ASSERT(error <= spec.options.tolerance);
        dal_run_free(run);
    }
}

/* With a small tolerance nothing grows but the rounding of F: not the phase of an
 * oscillator, which the doubles nearest to the coefficients shift by 7e-17 in a unit of time.  The
 * end of the sleigh is from Gragg's extrapolation of order 28 in quad precision, with 1000
 * steps as with 500. */
static void test_fine(void)
{
    static const char swing[] = "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x': 1}\n";
    static const char sleigh[] =
        "coordinates: [y1, y2, phi]\nparameters: {G: 0.3, K: 0.7}\n"
        "lagrangian: (y1'^2 + y2'^2 + phi'^2)/2 - G*y1 - K*(1 - cos(phi))\n"
        "constraints: [y1'*sin(phi) - y2'*cos(phi)]\nstart: {y1': 1, phi': 1}\n";
    static const double end[] = {-518.08265246974633225,  25.809874007261836947,
                                 -0.33242973412678152580, -16.692458020079117117,
                                 5.7629364676130301005,   0.96091263844096878127};
    CU_ASSERT(error_at(swing, 20.0, 1e-17, (double[]){sin(20.0), cos(20.0)}) <= 1e-15);
    CU_ASSERT(error_at(swing, 200.0, 1e-17, (double[]){sin(200.0), cos(200.0)}) <= 4e-15);
    CU_ASSERT(error_at(sleigh, 100.0, 1e-17, end) <= 1e-15);
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
        CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
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

static void same_state_as(const dal_run *run, const double *state)
{
    const size_t bytes = (size_t)dal_run_dimension(run) * sizeof *state;
    CU_ASSERT_EQUAL(memcmp(dal_run_state(run), state, bytes), 0);
}

/* Where the error of h is below the tolerance the divided step is the fixed one. */
static void test_whole(void)
{
    const dal_run_spec fixed = spec_of(fixture_system(fixture_full), DAL_LIFTED, 0.01, 0.0);
    const dal_run_spec loose = spec_of(fixture_system(fixture_full), DAL_LIFTED, 0.01, 1e-3);
    dal_run *a = fixture_run(&fixed), *b = fixture_run(&loose);
    fixture_perturb(a, 0.3);
    fixture_perturb(b, 0.3);
    CU_ASSERT_EQUAL(dal_run_advance(a, 50, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(b, 50, NULL), DAL_STATUS_OK);
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
    CU_ASSERT_EQUAL(dal_run_advance(whole, 20, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(first, 7, NULL), DAL_STATUS_OK);
    const double *memory = dal_run_save(first, &count);
    CU_ASSERT_EQUAL(dal_run_restore(second, memory, count, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(second, 13, NULL), DAL_STATUS_OK);
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
    fixture_lanes(spec_of(fixture_system(kepler), DAL_PHYSICAL, PERIOD / 20, 1e-9), 9, 7, "x", 0.1,
                  0.05);
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
        CU_ASSERT_EQUAL(dal_run_observe(run, out), DAL_STATUS_OK);
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
        CU_ASSERT_EQUAL_FATAL(dal_method_parse(&method, name, NULL), DAL_STATUS_OK);
        dal_run_spec spec =
            fixture_spec(fixture_system("contact-oscillator"), name, DAL_PHYSICAL, 0.1);
        if (!fixture_accepts(&method, spec.system, DAL_PHYSICAL)) continue;
        spec.options.tolerance = 1e-6;
        if (dal_method_properties(&method) & DAL_ADAPTIVE)
            dal_run_free(fixture_run(&spec));
        else
            fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, name);
    }
    dal_run_spec spec =
        fixture_spec(fixture_system("contact-oscillator"), "dop853+lift", DAL_LIFTED, 0.1);
    spec.options.tolerance = 1e-6;
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, "dop853+lift has no control of its step size");
    spec = spec_of(spec.system, DAL_LIFTED, 0.1, -1e-6);
    fixture_refused(&spec, DAL_STATUS_ARGUMENT, "option tolerance: -1e-06 is not from 0 to 1");
    spec.options.tolerance = NAN;
    fixture_refused(&spec, DAL_STATUS_ARGUMENT, "is not from 0 to 1");
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
        CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
        const double *z = dal_run_state(run);
        CU_ASSERT_DOUBLE_EQUAL(z[3], sin(20.0), 20.0 * tolerances[k]);
        CU_ASSERT_DOUBLE_EQUAL(z[4], cos(20.0), 20.0 * tolerances[k]);
        CU_ASSERT(z[0] == 0.0 && z[1] == 0.0);
        dal_run_free(run);
    }
}

/* ---- compiled steps ---- */

/* Compiled from the middle on. */
static void test_native(void)
{
    const struct {
        const char *text, *method;
        dal_space space;
        double step, tolerance;
    } cases[] = {{kepler, "dop853", DAL_PHYSICAL, PERIOD / 5, 1e-9},
                 {fixture_full, "dop853", DAL_LIFTED, 0.7, 1e-16},
                 {fixture_full, "dop853", DAL_LIFTED, 0.7, 1e-9},
                 {"knife-edge", "dop853+project", DAL_PHYSICAL, 5.0, 1e-9}};
    enum { CASES = sizeof cases / sizeof *cases };
    for (int i = 0; compiler_works && i < CASES; i += case_stride(3)) {
        dal_run_spec spec = fixture_spec(fixture_system(cases[i].text), cases[i].method,
                                         cases[i].space, cases[i].step);
        spec.options.tolerance = cases[i].tolerance;
        dal_run *tape = fixture_run(&spec), *native = fixture_run(&spec);
        size_t count;
        dal_error error = {0};
        CU_ASSERT_EQUAL(dal_run_advance(tape, 4, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_advance(native, 1, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_native(native, &compiler_options, &error), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_advance(native, 3, NULL), DAL_STATUS_OK);
        CU_ASSERT(dal_run_evaluations(tape) > 2 * 4 * STAGES);
        const double *memory = dal_run_save(tape, &count);
        CU_ASSERT_EQUAL(memcmp(memory, dal_run_save(native, &count), count * sizeof *memory), 0);
        dal_run_free(tape);
        dal_run_free(native);
    }
}

/* A batch where neighbours need other substeps, one lane fails, and the force depends on t: bits,
 * times and reasons of single runs, interpreted and compiled. */
static void same_lanes(const dal_run_spec *of, int width, bool native)
{
    enum { LANES = 11, STEPS = 4 };
    dal_run_spec spec = *of;
    dal_batch *batch = NULL;
    dal_error reason = {0}, error = {0};
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, LANES, width, NULL), DAL_STATUS_OK);
    dal_setting x[LANES];
    for (int lane = 0; lane < LANES; lane++) {
        x[lane] = (dal_setting){"x", lane == 6 ? 4.3 : 0.1 + 0.09 * lane};
        CU_ASSERT_EQUAL(dal_batch_start(batch, lane, NULL, 0, &x[lane], 1, NULL), DAL_STATUS_OK);
    }
    if (native) CU_ASSERT_EQUAL(dal_batch_native(batch, &compiler_options, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_batch_advance(batch, STEPS), DAL_STATUS_OK);
    for (int lane = 0; lane < LANES; lane++) {
        double state[8];
        spec.start = &x[lane];
        spec.start_count = 1;
        dal_run *run = fixture_run(&spec);
        CU_ASSERT_FATAL(dal_run_dimension(run) <= 8);
        const dal_status status = dal_run_advance(run, STEPS, &reason);
        dal_batch_state(batch, lane, state);
        CU_ASSERT_EQUAL(status == DAL_STATUS_OK, lane != 6);
        CU_ASSERT_EQUAL(dal_batch_status(batch, lane, &error), status);
        if (status != DAL_STATUS_OK) CU_ASSERT_STRING_EQUAL(error.message, reason.message);
        CU_ASSERT_EQUAL(dal_batch_time(batch, lane), dal_run_time(run));
        same_state_as(run, state);
        dal_run_free(run);
    }
    dal_batch_free(batch);
}

static void test_lanes(void)
{
    static const char swing[] =
        "coordinates: [x, y]\n"
        "accelerations: {x: -sin(x + t) + 1e-30*sqrt(4.6 - x), y: x*cos(t)}\n"
        "start: {x': 1, y: 0.3}\n";
    static const int widths[] = {0, 1, 4, 8};
    dal_run_spec spec = spec_of(fixture_system(swing), DAL_PHYSICAL, 0.7, 1e-10);
    for (int i = 0; i < 4; i++) same_lanes(&spec, widths[i], false);
    if (compiler_works) same_lanes(&spec, 0, true);
    spec.options.tolerance = 1e-16;
    same_lanes(&spec, 0, false);
}

/* A step that fails says how, and leaves everything as it was. */
static void fails(const char *text, double step, const char *reason, double reached)
{
    const dal_run_spec spec = spec_of(fixture_system(text), DAL_PHYSICAL, step, 1e-10);
    dal_error error = {0};
    CU_ASSERT_EQUAL(fixture_failed_step(&spec, &error), DAL_STATUS_NOT_CONVERGED);
    if (!strstr(error.message, reason)) printf("\n  %s\n", error.message);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, reason));
    CU_ASSERT(error.line == 0 && error.column == 0);
    const char *where = strstr(error.message, "at t = ");
    CU_ASSERT_PTR_NOT_NULL_FATAL(where);
    if (reached > 0.0) CU_ASSERT(fabs(strtod(where + strlen("at t = "), NULL) - reached) <= 1e-6);
}

/* x = 1/(1 - t) ends at 1, and its scale goes with it; sqrt(1 - t) has no value after 1; 160000
 * turns are too many. */
static void test_failures(void)
{
    if (case_stride(2) == 1) /* both ways to too many substeps take 100000 */
        fails("coordinates: [x]\naccelerations: {x: 2*x^3}\nstart: {x: 1, x': 1}\n", 2.0,
              "too many substeps", 1.0);
    fails("coordinates: [x]\naccelerations: {x: sqrt(1 - t)}\n", 2.0,
          "the step size went to zero at t = ", 1.0);
    fails("coordinates: [x]\naccelerations: {x: -x}\nstart: {x: 1}\n", 1e6,
          "too many substeps (more than 100000) for tolerance 1e-10 in the step of 1e+06", 0.0);
}

void suite_adaptive(void)
{
    CU_pSuite suite = CU_add_suite("adaptive", compiler_set_up, compiler_tear_down);
    CU_add_test(suite, "the error follows the tolerance", test_error);
    CU_add_test(suite, "a peak between stages", test_peak);
    CU_add_test(suite, "down to rounding", test_fine);
    CU_add_test(suite, "the work follows the motion", test_work);
    CU_add_test(suite, "an undivided step is the fixed one", test_whole);
    CU_add_test(suite, "the surface, whatever the space and the gauge", test_surface);
    CU_add_test(suite, "loaded in the middle", test_load);
    CU_add_test(suite, "lanes of a batch", test_batch);
    CU_add_test(suite, "inside projections", test_projected);
    CU_add_test(suite, "who takes a tolerance", test_claims);
    CU_add_test(suite, "compiled", test_native);
    CU_add_test(suite, "lanes with their own substeps", test_lanes);
    CU_add_test(suite, "momenta alone divide a step", test_momenta_alone);
    CU_add_test(suite, "steps that fail", test_failures);
}
