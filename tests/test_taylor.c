/* test_taylor.c - the integrator taylor against closed forms and quad references; spaces, lanes,
 * refusals and failures. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PERIOD 6.283185307179586477

static dal_run_spec spec_of(const char *system, dal_space space, double step, double tolerance)
{
    dal_run_spec spec = fixture_spec(fixture_system(system), "taylor", space, step);
    spec.options.tolerance = tolerance;
    return spec;
}

static double distance(const double *x, const double *y, int count)
{
    double max = 0.0;
    for (int i = 0; i < count; i++) max = fmax(max, fabs(x[i] - y[i]));
    return max;
}

/* Kepler motion of eccentricity 0.9 after two periods, and the circle of a linear oscillator. */
static const char kepler[] = "coordinates: [x, y]\n"
                             "lagrangian: (x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2)\n"
                             "start: {x: 0.1, y: 0, x': 0, y': sqrt(19)}\n";
static const char oscillator[] = "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x: 1}\n";

/* The error per tolerance grows with the motion: Kepler's amplifies errors by some 1e4. */
static void test_closed_motion(void)
{
    static const double tolerances[] = {1e-6, 1e-10, 1e-13, 1e-18};
    for (int k = 0; k < 4; k++) {
        const double error = tolerances[k] + 4e-16;
        dal_run *a = NULL, *b = NULL;
        dal_run_spec spec = spec_of(oscillator, DAL_PHYSICAL, 3.7, tolerances[k]);
        a = fixture_stepped(&spec, 10);
        CU_ASSERT(fabs(dal_run_state(a)[0] - cos(37.0)) <= 40.0 * error);
        CU_ASSERT(fabs(dal_run_state(a)[1] + sin(37.0)) <= 40.0 * error);
        spec = spec_of(kepler, DAL_PHYSICAL, PERIOD, tolerances[k]);
        b = fixture_stepped(&spec, 2);
        CU_ASSERT(fabs(dal_run_state(b)[0] - 0.1) <= 1e4 * error);
        CU_ASSERT(fabs(dal_run_state(b)[1]) <= 1e4 * error);
        dal_run_free(a);
        dal_run_free(b);
    }
}

/* One step of 1 along a circle is a single substep at 1e-6, of order 11: what it lacks of cos 1 and
 * -sin 1 are the terms 1/12! and -1/13! of their series, and 1/182 and 1/210 of these. */
static void test_order(void)
{
    static const double factorial_12 = 479001600.0, factorial_13 = 6227020800.0;
    dal_run_spec spec = spec_of(oscillator, DAL_PHYSICAL, 1.0, 1e-6);
    dal_run *run = fixture_stepped(&spec, 1);
    const double *state = dal_run_state(run);
    CU_ASSERT_DOUBLE_EQUAL((cos(1.0) - state[0]) * factorial_12, 1.0, 0.01);
    CU_ASSERT_DOUBLE_EQUAL((-sin(1.0) - state[1]) * factorial_13, -1.0, 0.01);
    dal_run_free(run);
}

/* Against gauss12 in quad precision: time-dependent and velocity-dependent forces, a full mass
 * matrix, nonlinear constraints; displaced momenta on the lifted space. */
static void test_quad_reference(void)
{
    static const double tolerances[] = {1e-6, 1e-10, 1e-13, 1e-18};
    dal_run_spec spec = fixture_spec(fixture_system(fixture_gentle), "gauss12", DAL_LIFTED, 0.02);
    spec.options.precision = DAL_QUAD;
    for (int lifted = 0; lifted < 2; lifted++) {
        spec.options.space = lifted ? DAL_LIFTED : DAL_PHYSICAL;
        dal_run *reference = fixture_run(&spec);
        const int dim = dal_run_dimension(reference);
        if (lifted) fixture_perturb(reference, 0.3);
        CU_ASSERT_EQUAL(dal_run_advance(reference, 50, NULL), DAL_STATUS_OK);
        for (int k = 0; k < 4; k++) {
            dal_run_spec own = spec_of(fixture_gentle, spec.options.space, 0.5, tolerances[k]);
            dal_run *run = fixture_run(&own);
            if (lifted) fixture_perturb(run, 0.3);
            CU_ASSERT_EQUAL(dal_run_advance(run, 2, NULL), DAL_STATUS_OK);
            const double error = distance(dal_run_state(run), dal_run_state(reference), dim);
            if (!(error <= 10.0 * (tolerances[k] + 2e-16)))
                printf("\n  %d, tolerance %g: error %g\n", lifted, tolerances[k], error);
            CU_ASSERT(error <= 10.0 * (tolerances[k] + 2e-16));
            dal_run_free(run);
        }
        dal_run_free(reference);
    }
}

/* In quad precision the energy of an elliptic motion holds to 30 digits. */
static void test_quad(void)
{
    dal_run_spec spec = spec_of(oscillator, DAL_PHYSICAL, 2.5, 1e-32);
    double out[8];
    spec.options.precision = DAL_QUAD;
    dal_run *run = fixture_stepped(&spec, 4);
    CU_ASSERT_EQUAL(dal_run_observe(run, out), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(out[0], 0.5);
    CU_ASSERT_EQUAL(dal_run_state(run)[0], cos(10.0));
    dal_run_free(run);
}

/* On the surface (q,v) has the same bits in both spaces and for any gauge. */
static void test_surface(void)
{
    static const double tolerances[] = {0.0, 1e-9};
    for (int k = 0; k < 2; k++) {
        dal_run_spec spec = spec_of(fixture_full, DAL_PHYSICAL, 0.1, tolerances[k]);
        dal_run *physical = fixture_stepped(&spec, 5);
        spec.options.space = DAL_LIFTED;
        dal_run *lifted = fixture_stepped(&spec, 5);
        const int count = dal_run_dimension(physical);
        CU_ASSERT_EQUAL(
            memcmp(dal_run_state(physical), dal_run_state(lifted), (size_t)count * sizeof(double)),
            0);
        for (int i = count + 1; i < 2 * count + 2; i++) CU_ASSERT(dal_run_state(lifted)[i] == 0.0);
        dal_run_free(physical);
        dal_run_free(lifted);
    }
}

/* At rest nothing but the momenta moves: with 1/e = 0, pi = cos t and p = sin t. */
static void test_momenta_alone(void)
{
    const dal_setting start[] = {{"x", 0.0}, {"e", INFINITY}, {"pi_x", 1.0}};
    dal_run_spec spec = spec_of(oscillator, DAL_LIFTED, 20.0, 1e-10);
    spec.start = start;
    spec.start_count = 3;
    dal_run *run = fixture_stepped(&spec, 1);
    const double *z = dal_run_state(run);
    CU_ASSERT_DOUBLE_EQUAL(z[3], sin(20.0), 2e-9);
    CU_ASSERT_DOUBLE_EQUAL(z[4], cos(20.0), 2e-9);
    CU_ASSERT(z[0] == 0.0 && z[1] == 0.0 && z[2] == INFINITY);
    dal_run_free(run);
}

/* x'' = 0 with a moving e = 2 + sin t: p' = 0, pi = pi_0 - p t, v' = pi/e, pi_e' = pi^2/2e^2. */
static void test_gauge(void)
{
    static const char free_point[] = "coordinates: [x]\nlagrangian: x'^2/2\n"
                                     "gauge: {e: 2, mu_e: cos(t)}\nstart: {x: 1, x': 0.3}\n";
    const dal_setting start[] = {{"pi_x", 0.7}, {"p_x", 0.1}};
    dal_run_spec spec = spec_of(free_point, DAL_LIFTED, 2.0, 1e-13);
    spec.start = start;
    spec.start_count = 2;
    dal_run *run = fixture_stepped(&spec, 1);
    const double *z = dal_run_state(run);
    double v = 0.3, pi_e = 0.0, x = 1.0;
    enum { INTERVALS = 20000 };
    for (int i = 0; i <= INTERVALS; i++) { /* Simpson's rule; x by parts */
        const double t = 2.0 * i / INTERVALS, w = (0.7 - 0.1 * t) / (2.0 + sin(t));
        const double weight = (i == 0 || i == INTERVALS ? 1.0
                               : i % 2                  ? 4.0
                                                        : 2.0) *
                              2.0 / INTERVALS / 3.0;
        v += weight * w;
        pi_e += weight * w * w / 2.0;
        x += weight * (2.0 - t) * w;
    }
    CU_ASSERT_DOUBLE_EQUAL(z[0], x + 0.6, 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(z[1], v, 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(z[2], 2.0 + sin(2.0), 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(z[3], 0.1, 1e-15);
    CU_ASSERT_DOUBLE_EQUAL(z[4], 0.5, 1e-15);
    CU_ASSERT_DOUBLE_EQUAL(z[5], pi_e, 1e-12);
    dal_run_free(run);
}

/* Lanes have the bits of single runs, with steps of one size and with their own.  Of t^50 - 400 x
 * the lane that begins at 0 rejects substeps while others accept theirs. */
static void test_lanes(void)
{
    static const char forced[] = "coordinates: [x]\naccelerations: {x: t^50 - 400*x}\n";
    fixture_lanes(spec_of(forced, DAL_PHYSICAL, 1.2, 1e-10), 5, 2, "x", 0.0, 0.5);
    for (int k = 0; k < 2; k++)
        fixture_lanes(spec_of(kepler, DAL_LIFTED, PERIOD / 100, k == 0 ? 0.0 : 1e-11), 13, 5, "x",
                      0.3, 0.05);
}

/* Where all last coefficients vanish at the start, or most of them everywhere, the defect at the
 * end of a step shows it: x'' = t^50, and x'' = -x^7, whose series from x = 0 has each eighth
 * term. */
static void test_gaps(void)
{
    static const char monomial[] = "coordinates: [x]\naccelerations: {x: t^50}\n";
    static const char septic[] = "coordinates: [x]\nlagrangian: x'^2/2 - x^8/8\nstart: {x': 1}\n";
    dal_run_spec spec = spec_of(monomial, DAL_PHYSICAL, 1.2, 1e-10);
    dal_run *run = fixture_stepped(&spec, 1);
    const double x = pow(1.2, 52) / (51 * 52), v = pow(1.2, 51) / 51;
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[0], x, 1e-9 * fmax(1.0, v));
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[1], v, 1e-9 * fmax(1.0, v));
    dal_run_free(run);
    spec = spec_of(septic, DAL_PHYSICAL, 30.0, 1e-10);
    run = fixture_stepped(&spec, 1);
    double out[8];
    CU_ASSERT_EQUAL(dal_run_observe(run, out), DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(out[0], 0.5, 1e-8);
    dal_run_free(run);
}

/* An oscillator with steps that are long beside its motion keeps its amplitude to within roundings,
 * which differ from step to step: after n steps sqrt(n) of them are left.  Coefficients that are
 * rounded alike in each step leave n. */
static void test_long_steps(void)
{
    static const char text[] = "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x: 1}\n";
    enum { STEPS = 10000 };
    static const double step[] = {1.0, 2.0, 2.5};
    for (int i = 0; i < 3; i++)
        for (dal_space space = DAL_LIFTED; space <= DAL_PHYSICAL; space++) {
            const dal_run_spec spec = spec_of(text, space, step[i], 1e-17);
            dal_run *run = fixture_stepped(&spec, STEPS);
            const double amplitude = hypot(dal_run_state(run)[0], dal_run_state(run)[1]);
            CU_ASSERT_DOUBLE_EQUAL(amplitude, 1.0, DBL_EPSILON * sqrt(STEPS) * step[i]);
            dal_run_free(run);
        }
}

/* A circle about a centre that attracts with the potential r^3: r = 1 at the rate sqrt(3); in both
 * spaces, whose second derivatives are branches at r = 0, too. */
static void test_hypot(void)
{
    static const char text[] = "coordinates: [x, y]\n"
                               "lagrangian: (x'^2 + y'^2)/2 - hypot(x, y)^3\n"
                               "start: {x: 1, y': sqrt(3)}\n";
    for (int i = 0; i < 2; i++) {
        const dal_run_spec spec = spec_of(text, i ? DAL_LIFTED : DAL_PHYSICAL, 2.0, 1e-14);
        dal_run *run = fixture_stepped(&spec, 1);
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[0], cos(2.0 * sqrt(3.0)), 1e-13);
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[1], sin(2.0 * sqrt(3.0)), 1e-13);
        dal_run_free(run);
    }
}

static void test_refused(void)
{
    static const char kinked[] = "coordinates: [x]\naccelerations: {x: -abs(x)}\nstart: {x: 1}\n";
    const dal_system hand = {.name = "by hand", .n = 1, .call = {.field = fixture_oscillate}};
    dal_run_spec spec = spec_of(kinked, DAL_PHYSICAL, 0.1, 0.0);
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED,
                    "the equations contain abs, which has no Taylor series");
    spec.system = &hand;
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, "no Taylor series, not being made from a model");
}

static void fails(const char *text, double step, const char *reason)
{
    const dal_run_spec spec = spec_of(text, DAL_PHYSICAL, step, 1e-10);
    dal_error error = {0};
    CU_ASSERT_EQUAL(fixture_failed_step(&spec, &error), DAL_STATUS_NOT_CONVERGED);
    if (!strstr(error.message, reason)) printf("\n  %s\n", error.message);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, reason));
}

static void test_failures(void)
{
    fails("coordinates: [x]\naccelerations: {x: 2*x^3}\nstart: {x: 1, x': 1}\n", 2.0, "at t = 1");
    fails("coordinates: [x]\naccelerations: {x: sqrt(1 - t)}\n", 2.0,
          "the step size went to zero at t = 1");
}

void suite_taylor(void)
{
    CU_pSuite suite = CU_add_suite("taylor", NULL, NULL);
    CU_add_test(suite, "motions in closed form", test_closed_motion);
    CU_add_test(suite, "the order for a tolerance", test_order);
    CU_add_test(suite, "quad references", test_quad_reference);
    CU_add_test(suite, "quad precision", test_quad);
    CU_add_test(suite, "the surface, whatever the space", test_surface);
    CU_add_test(suite, "momenta alone divide a step", test_momenta_alone);
    CU_add_test(suite, "a moving gauge", test_gauge);
    CU_add_test(suite, "lanes of a batch", test_lanes);
    CU_add_test(suite, "vanishing coefficients", test_gaps);
    CU_add_test(suite, "long steps of an oscillator", test_long_steps);
    CU_add_test(suite, "along a circle by hypot", test_hypot);
    CU_add_test(suite, "what is refused", test_refused);
    CU_add_test(suite, "steps that fail", test_failures);
}
