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
    const dal_status status = dal_error_budget_create(&e, spec, steps, quad_steps, NULL, &error);
    if (status != DAL_STATUS_OK) printf("\n  %s\n", error.message);
    CU_ASSERT_EQUAL_FATAL(status, DAL_STATUS_OK);
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
    CU_ASSERT(says(e, "D1", DAL_SOURCE_TRUNCATION, "nothing of it remains"));
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
    CU_ASSERT(energy->is_motion && !energy->is_conserved);
    CU_ASSERT(energy->share[DAL_SOURCE_MOTION] > 1.0 - 1e-5);
    CU_ASSERT(energy->share[DAL_SOURCE_TRUNCATION] < 1e-5);
    CU_ASSERT(fabs(energy->order - 4.0) < 0.1);
    CU_ASSERT(says(e, "E", DAL_SOURCE_MOTION, "along the exact motion the drift is 1 times"));
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
    CU_ASSERT(says(e, "D1", DAL_SOURCE_TRUNCATION, "in quad precision nothing of it remains"));
    /* E, which this method does not keep, drifts by truncation. */
    CU_ASSERT(fabs(of(e, "E")->share[DAL_SOURCE_TRUNCATION] - 1.0) < 1e-6);
    CU_ASSERT(fabs(of(e, "E")->order - 2.0) < 0.1);
    dal_error_budget_free(e);
}

/* Equations solved to 1e-8: what the solver leaves moves D by far more than truncation does, whose
 * part is as large as when they are solved. */
static void test_solver(void)
{
    const int steps = 400 / case_stride(4);
    dal_run_spec spec =
        fixture_spec(fixture_system("chaplygin-sleigh"), "gauss8", DAL_PHYSICAL, 0.1);
    dal_error_budget *solved = explained(&spec, steps, steps);
    spec.options.solver_tolerance = 1e-8;
    dal_error_budget *e = explained(&spec, steps, steps);
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

/* gauss8 keeps a bilinear D except for its coefficients, good to 20 digits: what these do to
 * D in a unit of time is proportional to h (h^2 in a step), and far below rounding. */
static void test_coefficients(void)
{
    const int steps = 600 / case_stride(6);
    const dal_run_spec spec =
        fixture_spec(fixture_system("contact-oscillator"), "gauss8", DAL_PHYSICAL, 0.1);
    dal_error_budget *e = explained(&spec, steps, steps);
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
    const int steps = 20000 / case_stride(4);
    dal_error_budget *e = explained(&spec, steps, steps);
    const dal_shares *error = of(e, "error");
    CU_ASSERT(fabs(error->share[DAL_SOURCE_ROUNDING] - 1.0) < 0.05);
    CU_ASSERT(error->comparison[DAL_COMPARISON_SUMS].deviation < 0.05 * error->whole.deviation);
    CU_ASSERT(says(e, "error", DAL_SOURCE_ROUNDING, "with compensated sums"));
    dal_error_budget_free(e);
}

/* ---- closed forms ---- */

static int sums_up(const dal_error_budget *e, const char *name, const char *expected)
{
    char words[512];
    dal_error_budget_summarise(e, number_of(e, name), words, sizeof words);
    const int found = strstr(words, expected) != NULL;
    if (!found) printf("\n  '%s' lacks '%s'\n", words, expected);
    return found;
}

/* x'' = -k x: a step of rk4 multiplies E by |R(i z)|^2 = 1 - z^6/72 + z^8/576, z = h sqrt(k). */
static void test_oscillator(void)
{
    const dal_run_spec spec = fixture_spec(
        fixture_system("coordinates: [x]\nlagrangian: (x'^2 - 9*x^2)/2\nstart: {x: 2}\n"), "rk4",
        DAL_PHYSICAL, 0.03125);
    const int steps = 640;
    dal_error_budget *e = explained(&spec, steps, steps);
    const dal_shares *a = of(e, "E");
    double lost[2];
    for (int k = 0; k < 2; k++) {
        const double z = 3.0 * spec.options.step / (1 << k), z2 = z * z;
        lost[k] = -18.0 * expm1(steps * (1 << k) * log1p(z2 * z2 * z2 * (z2 / 8.0 - 1.0) / 72.0));
    }
    CU_ASSERT_DOUBLE_EQUAL(a->whole.deviation / lost[0], 1.0, 1e-6);
    CU_ASSERT_DOUBLE_EQUAL(a->comparison[DAL_COMPARISON_QUAD_HALVED].deviation / lost[1], 1.0,
                           1e-6);
    CU_ASSERT(a->is_conserved && !a->is_motion && a->by_rate);
    CU_ASSERT_DOUBLE_EQUAL(a->share[DAL_SOURCE_TRUNCATION], 1.0, 1e-6);
    CU_ASSERT_DOUBLE_EQUAL(a->order, log2(lost[0] / lost[1]), 1e-3);
    CU_ASSERT_EQUAL(a->share[DAL_SOURCE_MOTION], 0.0);
    CU_ASSERT_EQUAL(a->share[DAL_SOURCE_BRANCHES], 0.0);
    CU_ASSERT_EQUAL(a->share[DAL_SOURCE_COEFFICIENTS], 0.0);
    CU_ASSERT(sums_up(e, "E", "drifts by truncation (100 %): halve the step and it falls by 3"));
    dal_error_budget_free(e);
}

/* x'' = -x - c x' from x = 1: E of the motion, and of rk4, whose steps multiply (x, v) by
 * 1 + B + B^2/2 + B^3/6 + B^4/24, B = h (0 1; -1 -c). */
static double damped_energy(double c, double t)
{
    const double w = sqrt(1.0 - 0.25 * c * c), decay = exp(-0.5 * c * t);
    const double x = decay * (cos(w * t) + 0.5 * c / w * sin(w * t)), v = -decay / w * sin(w * t);
    return 0.5 * (x * x + v * v);
}

static void step_damped(double c, double h, double *x, double *v)
{
    double term[2] = {*x, *v};
    for (int k = 1; k <= 4; k++) {
        const double next[2] = {h / k * term[1], h / k * (-term[0] - c * term[1])};
        *x += term[0] = next[0];
        *v += term[1] = next[1];
    }
}

static void test_friction(void)
{
    static const double c = 0.05, h[] = {0.125, 1.0};
    const dal_system *system = fixture_system("coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\n"
                                              "forces: {x: -0.05*x'}\nstart: {x: 1}\n");
    for (int k = 0; k < 2; k++) {
        const int steps = (int)(64.0 / h[k]);
        const dal_run_spec spec = fixture_spec(system, "rk4", DAL_PHYSICAL, h[k]);
        double motion = 0.0, error = 0.0, x = 1.0, v = 0.0;
        for (int i = 0; i <= steps; i++) {
            const double exact = damped_energy(c, i * h[k]);
            motion = fmax(motion, fabs(exact - 0.5));
            error = fmax(error, fabs(0.5 * (x * x + v * v) - exact));
            step_damped(c, h[k], &x, &v);
        }
        dal_error_budget *e = explained(&spec, steps, steps);
        const dal_shares *a = of(e, "E");
        CU_ASSERT(!a->is_conserved && a->is_motion);
        CU_ASSERT_DOUBLE_EQUAL(a->motion.deviation, motion, 1e-13);
        CU_ASSERT_DOUBLE_EQUAL(a->error.deviation, error, 1e-13);
        CU_ASSERT_EQUAL(a->by_rate, 0);
        CU_ASSERT_DOUBLE_EQUAL(a->share[DAL_SOURCE_MOTION], motion / (motion + error), 1e-10);
        CU_ASSERT_DOUBLE_EQUAL(a->share[DAL_SOURCE_TRUNCATION], error / (motion + error), 1e-10);
        CU_ASSERT(sums_up(e, "E", k ? "and truncation (" : "the motion itself (100 %); truncat"));
        dal_error_budget_free(e);
    }
}

/* E of x'^2/2 - |x| is conserved, and rk4 in steps across x = 0, where F jumps, is of order 1: it
 * errs by branches. */
static void test_kink(void)
{
    const dal_system *system =
        fixture_system("coordinates: [x]\nlagrangian: x'^2/2 - abs(x)\nstart: {x: 1}\n"
                       "invariants: {twice: x'^2 + 2*abs(x), no: x'^2 + abs(x)}\n");
    for (int quad = 0; quad < 2; quad++) {
        const dal_run_spec spec = fixture_spec(system, "rk4", DAL_PHYSICAL, 0.01);
        dal_error_budget *e = explained(&spec, 5000, quad ? 5000 : 0);
        for (int i = 0; i < 2; i++) {
            const char *name = i == 0 ? "E" : "twice";
            const dal_shares *a = of(e, name);
            CU_ASSERT(a->is_conserved && !a->is_motion);
            CU_ASSERT_EQUAL(a->share[DAL_SOURCE_MOTION], 0.0);
            CU_ASSERT(a->share[DAL_SOURCE_BRANCHES] > 0.999);
            CU_ASSERT(!(a->share[DAL_SOURCE_TRUNCATION] > 0.0));
            CU_ASSERT(a->order > 0.5 && a->order < 2.0);
            CU_ASSERT(sums_up(e, name, "by truncation at branches (100 %): halve the step and"));
            CU_ASSERT(says(e, name, DAL_SOURCE_BRANCHES, "the equations contain sign"));
        }
        CU_ASSERT(!of(e, "no")->is_conserved && of(e, "no")->is_motion);
        dal_error_budget_free(e);
    }
}

/* ---- what the motion conserves ---- */

static void test_conserved(void)
{
    const dal_system *system =
        fixture_system("coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + 4e14/sqrt(x^2 + y^2)\n"
                       "start: {x: 7e6, y': 7546}\n"
                       "invariants: {moment: x*y' - y*x', almost: x*y' - 1.001*y*x', here: x}\n");
    dal_run_spec spec = fixture_spec(system, "rk4", DAL_LIFTED, 30.0);
    dal_error_budget *e = explained(&spec, 400, 100);
    CU_ASSERT(of(e, "E")->is_conserved && of(e, "moment")->is_conserved);
    CU_ASSERT(!of(e, "almost")->is_conserved && !of(e, "here")->is_conserved);
    CU_ASSERT(of(e, "almost")->is_motion && of(e, "here")->is_motion);
    dal_error_budget_free(e);
    /* p moves pi, and pi/e moves (q, v): all but D is the motion's. */
    spec.start = &(dal_setting){"p_x", 1e3};
    spec.start_count = 1;
    e = explained(&spec, 100, 0);
    CU_ASSERT(!e->ran[DAL_COMPARISON_EXACT]);
    CU_ASSERT_PTR_NOT_NULL(strstr(e->reason[DAL_COMPARISON_EXACT], "p and pi are not 0"));
    CU_ASSERT(!of(e, "E")->is_conserved && !of(e, "|pi|")->is_conserved);
    CU_ASSERT(of(e, "H")->is_conserved);
    dal_error_budget_free(e);
    /* With 1/e = 0 they do not, and an identity says so of E. */
    spec.start = (dal_setting[]){{"p_x", 1e3}, {"e", INFINITY}};
    spec.start_count = 2;
    e = explained(&spec, 100, 0);
    CU_ASSERT(!e->ran[DAL_COMPARISON_EXACT]);
    CU_ASSERT(of(e, "E")->is_conserved && !of(e, "almost")->is_conserved);
    CU_ASSERT(!of(e, "E")->is_motion && of(e, "E")->order > 4.5);
    dal_error_budget_free(e);

    /* On D = 0 only, which truncation leaves: E is conserved, and does not drift by the motion. */
    spec = fixture_spec(fixture_system("contact-oscillator"), "rk4", DAL_PHYSICAL, 0.1);
    e = explained(&spec, 100, 0);
    CU_ASSERT_EQUAL(of(e, "E")->whole.conservation, DAL_OFF_SURFACE);
    CU_ASSERT(of(e, "E")->is_conserved && of(e, "D1")->is_conserved);
    CU_ASSERT(!of(e, "E")->is_motion && !of(e, "D1")->is_motion);
    dal_error_budget_free(e);
}

/* In units 2^40 and 2^-40 times larger all is the same, except for roundings. */
static void test_units(void)
{
    double share[3][DAL_ERROR_SOURCES], order[3];
    for (int k = 0; k < 3; k++) {
        const double unit = ldexp(1.0, 40 * (k - 1));
        char text[256];
        snprintf(text, sizeof text,
                 "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nforces: {x: -0.1*x'}\n"
                 "start: {x: %.17g}\n",
                 unit);
        const dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.5);
        dal_error_budget *e = explained(&spec, 64, 64);
        const dal_shares *a = of(e, "E");
        memcpy(share[k], a->share, sizeof share[k]);
        order[k] = a->order;
        CU_ASSERT(a->is_motion && a->share[DAL_SOURCE_TRUNCATION] > 1e-4);
        CU_ASSERT_DOUBLE_EQUAL(order[k], order[0], 1e-8);
        for (int i = 0; i < DAL_SOURCE_ROUNDING; i++)
            CU_ASSERT_DOUBLE_EQUAL(share[k][i], share[0][i], 1e-10);
        dal_error_budget_free(e);
    }
}

/* ---- what cannot be had ---- */

static dal_status energy(const dal_system *system, const dal_point *at, double *out)
{
    (void)system;
    out[0] = 0.5 * (at->v[0] * at->v[0] + at->q[0] * at->q[0]);
    return DAL_STATUS_OK;
}
static dal_status start(const dal_system *system, const dal_point *at, double *out)
{
    (void)system, (void)at;
    out[0] = 1.0;
    out[1] = 0.0;
    return DAL_STATUS_OK;
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
    /* The system does not say that it conserves E; its exact motion does. */
    CU_ASSERT(e->ran[DAL_COMPARISON_EXACT] && loss->is_conserved);
    CU_ASSERT(fabs(loss->share[DAL_SOURCE_TRUNCATION] - 1.0) < 1e-3);
    CU_ASSERT(fabs(loss->order - 5.0) < 0.05);
    CU_ASSERT(isnan(loss->share[DAL_SOURCE_ROUNDING]));
    CU_ASSERT(isnan(loss->share[DAL_SOURCE_COEFFICIENTS]));
    CU_ASSERT(says(e, "E", DAL_SOURCE_ROUNDING, "no quad precision"));
    dal_error_budget_free(e);
}

typedef struct watch {
    int calls, max_calls, runs;
    double done;
    const dal_run *last; /* begun; it exists whenever step is called */
} watch;

static dal_status step(void *user, double done)
{
    watch *w = user;
    CU_ASSERT(done >= w->done && done <= 1.0);
    CU_ASSERT(dal_run_steps(w->last) >= 0 && dal_run_system(w->last)->n == 3);
    w->done = done;
    return ++w->calls < w->max_calls ? DAL_STATUS_OK : DAL_STATUS_INTERRUPTED;
}
static void begin(void *user, dal_run *run, long long steps)
{
    CU_ASSERT(steps >= 50);
    ((watch *)user)->runs++;
    ((watch *)user)->last = run;
}

static void test_observer(void)
{
    dal_run_spec spec = fixture_spec(fixture_system("knife-edge"), "gauss4", DAL_PHYSICAL, 0.1);
    dal_error_budget *e = NULL;
    dal_error error = {0};
    watch w = {.max_calls = 1 << 30};
    const dal_error_budget_observer observer = {&w, step, begin};
    CU_ASSERT_EQUAL(dal_error_budget_create(&e, &spec, 100, 50, &observer, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(w.runs, 8); /* the run, five comparisons, and the beginning in doubles */
    CU_ASSERT(w.done > 0.99);
    dal_error_budget_free(e);
    const int all = w.calls;
    for (int max_calls = 1; max_calls < all; max_calls += all / 7) {
        w = (watch){.max_calls = max_calls};
        CU_ASSERT_EQUAL(dal_error_budget_create(&e, &spec, 100, 50, &observer, &error),
                        DAL_STATUS_INTERRUPTED);
        CU_ASSERT_PTR_NULL(e);
    }
    CU_ASSERT_EQUAL(dal_error_budget_create(&e, &spec, 0, 50, NULL, &error), DAL_STATUS_ARGUMENT);
    spec.options.precision = DAL_QUAD;
    CU_ASSERT_EQUAL(dal_error_budget_create(&e, &spec, 100, 50, NULL, &error), DAL_STATUS_ARGUMENT);
    spec.options.precision = DAL_DOUBLE;
    spec.options.iterations = 1;
    CU_ASSERT_EQUAL(dal_error_budget_create(&e, &spec, 100, 50, NULL, &error),
                    DAL_STATUS_NOT_CONVERGED);
    CU_ASSERT_PTR_NULL(e);
}

/* An explicit method has no equations that could be solved more or less exactly. */
static void test_explicit(void)
{
    static const dal_comparison_run solver[] = {DAL_COMPARISON_TIGHTER, DAL_COMPARISON_LOOSER};
    const dal_run_spec spec = fixture_spec(fixture_system("knife-edge"), "rk4", DAL_PHYSICAL, 0.1);
    dal_error_budget *e = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_error_budget_create(&e, &spec, 4, 2, NULL, NULL), DAL_STATUS_OK);
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
        const dal_status status = dal_error_budget_create(&e, &spec, 4, 2, NULL, NULL);
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
    CU_add_test(suite, "an oscillator", test_oscillator);
    CU_add_test(suite, "friction", test_friction);
    CU_add_test(suite, "a kink", test_kink);
    CU_add_test(suite, "what the motion conserves", test_conserved);
    CU_add_test(suite, "units", test_units);
    CU_add_test(suite, "without quad precision", test_by_hand);
    CU_add_test(suite, "an explicit method", test_explicit);
    CU_add_test(suite, "observers", test_observer);
    CU_add_test(suite, "out of memory", test_out_of_memory);
}
