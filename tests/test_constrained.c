/* test_constrained.c - methods that enforce D themselves: refusals, what they preserve,
 * their persistent multipliers, and the long runs by which they differ. */
#include "fixtures.h"
#include "quick.h"
#include "run/run.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- refusals ---- */

static dal_status refusal(const dal_system *system, const char *method, dal_space space,
                          const char *reason)
{
    dal_run *run = NULL;
    dal_error error = {0};
    const dal_run_spec spec = fixture_spec(system, method, space, 0.1);
    const dal_status status = dal_run_create(&run, &spec, &error);
    dal_run_free(run);
    if (status != DAL_STATUS_OK && !strstr(error.message, reason))
        printf("\n  %s\n", error.message);
    CU_ASSERT(status == DAL_STATUS_OK || strstr(error.message, reason) != NULL);
    return status;
}

static void test_refusals(void)
{
    dal_system system = *fixture_system(fixture_full);
    const dal_system *vakonomic = fixture_system("chaplygin-sleigh-vakonomic");
    CU_ASSERT_EQUAL(refusal(&system, "gni", DAL_LIFTED, "lifted"), DAL_STATUS_UNSUPPORTED);
    CU_ASSERT_EQUAL(refusal(&system, "gni", DAL_PHYSICAL, ""), DAL_STATUS_OK);
    system.call.blocks = NULL;
    CU_ASSERT_EQUAL(refusal(&system, "gni", DAL_PHYSICAL, "blocks"), DAL_STATUS_UNSUPPORTED);
    CU_ASSERT_EQUAL(refusal(vakonomic, "mclachlan-perlmutter", DAL_PHYSICAL, "blocks"),
                    DAL_STATUS_UNSUPPORTED);
}

/* ---- persistent multipliers ---- */

/* Where the multipliers lie among the persistent numbers. */
static double *multipliers(dal_run *run, double *memory)
{
    const size_t first =
        dal__at(&run->layout, DAL__CLOCK_SIZE) + 2; /* after stiff and derivatives_h */
    CU_ASSERT_EQUAL(memory[first], 1.0);            /* they have been set */
    return memory + first + 1;
}

/* A copy of the persistent numbers; the caller frees it. */
static double *memory_of(const dal_run *run, size_t *count)
{
    const double *memory = dal_run_save(run, count);
    double *copy = malloc(*count * sizeof *copy);
    CU_ASSERT_PTR_NOT_NULL_FATAL(copy);
    return memcpy(copy, memory, *count * sizeof *copy);
}

/* One step, turned round with its multipliers, which are even where D is odd in v, and one more
 * step: back at the start, to rounding. */
static double turning_defect(const char *method, const char *fixture, double sign)
{
    const dal_system *system = fixture_system(fixture);
    const dal_run_spec spec = fixture_spec(system, method, DAL_PHYSICAL, 0.1);
    dal_run *run = fixture_run(&spec);
    size_t count;
    double defect = 0.0, begin[64];
    const int n = system->n;
    CU_ASSERT_EQUAL(dal_run_advance(run, 3, NULL), DAL_STATUS_OK);
    memcpy(begin, dal_run_state(run), 2 * (size_t)n * sizeof *begin);
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
    double *memory = memory_of(run, &count);
    for (int i = 0; i < n; i++) memory[n + i] = -memory[n + i];
    for (int i = 0; i < n; i++) memory[run->layout.dim + n + i] = -memory[run->layout.dim + n + i];
    for (int i = 0; i < system->m; i++) multipliers(run, memory)[i] *= sign;
    if (sign < 0.0) multipliers(run, memory)[system->m] = 0.0; /* no acceleration is known */
    CU_ASSERT_EQUAL(dal_run_restore(run, memory, count, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
    for (int i = 0; i < n; i++) {
        defect = fmax(defect, fabs(dal_run_state(run)[i] - begin[i]));
        defect = fmax(defect, fabs(dal_run_state(run)[n + i] + begin[n + i]));
    }
    free(memory);
    dal_run_free(run);
    return defect;
}

static const char *const carriers[] = {"gni", "lobatto-nonholonomic2", "lobatto-nonholonomic4",
                                       "lobatto-nonholonomic6"};
enum { CARRIERS = sizeof carriers / sizeof *carriers };

static void test_turning(void)
{
    for (int i = 0; i < CARRIERS; i++) {
        CU_ASSERT(turning_defect(carriers[i], fixture_bilinear, 1.0) <= 1e-14);
        CU_ASSERT(turning_defect(carriers[i], fixture_quadratic, -1.0) <= 1e-14);
        CU_ASSERT(turning_defect(carriers[i], fixture_bilinear, -1.0) >= 1e-10);
    }
}

/* The state at t = 1 after count steps; the multipliers persistent into the first are 0 if wrong.
 * */
static void end_state(const dal_system *system, const char *method, int count, bool wrong,
                      double *state)
{
    const dal_run_spec spec = fixture_spec(system, method, DAL_PHYSICAL, 1.0 / count);
    dal_run *run = fixture_run(&spec);
    size_t size;
    double *memory = memory_of(run, &size);
    if (wrong) memory[dal__at(&run->layout, DAL__CLOCK_SIZE) + 2] = 1.0;
    CU_ASSERT_EQUAL(dal_run_restore(run, memory, size, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(run, count, NULL), DAL_STATUS_OK);
    memcpy(state, dal_run_state(run), 2 * (size_t)system->n * sizeof *state);
    free(memory);
    dal_run_free(run);
}

static double carried_order(const dal_system *system, const char *method, bool wrong)
{
    double reference[16], state[16], error[2] = {0.0, 0.0};
    end_state(system, "gauss10", 400, false, reference);
    for (int k = 0; k < 2; k++) {
        end_state(system, method, 20 << k, wrong, state);
        for (int i = 0; i < 2 * system->n; i++)
            error[k] = fmax(error[k], fabs(state[i] - reference[i]));
    }
    return log2(error[0] / error[1]);
}

/* The multipliers that a run begins with must be the motion's: others cost the methods of
 * higher order two orders for good. */
static void test_beginning(void)
{
    const dal_system *system = fixture_system(fixture_bilinear);
    CU_ASSERT_DOUBLE_EQUAL(carried_order(system, "lobatto-nonholonomic4", false), 4.0, 0.1);
    CU_ASSERT_DOUBLE_EQUAL(carried_order(system, "lobatto-nonholonomic4", true), 2.0, 0.1);
    CU_ASSERT_DOUBLE_EQUAL(carried_order(system, "lobatto-nonholonomic6", false), 6.0, 0.1);
    CU_ASSERT_DOUBLE_EQUAL(carried_order(system, "lobatto-nonholonomic6", true), 4.0, 0.1);
}

/* A run set to a state begins again, with the multipliers that belong to it: a fresh run's.
 */
static void test_set_state(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system(fixture_full), "gni", DAL_PHYSICAL, 0.05);
    dal_run *run = fixture_run(&spec), *fresh = fixture_run(&spec);
    double start[16];
    size_t count;
    memcpy(start, dal_run_state(run), 8 * sizeof *start);
    CU_ASSERT_EQUAL(dal_run_advance(run, 7, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_set_state(run, 0.0, start, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(run, 5, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(fresh, 5, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(memcmp(dal_run_state(run), dal_run_state(fresh), 8 * sizeof *start), 0);
    /* A checkpoint has them: without them the next step is another one. */
    double *memory = memory_of(run, &count);
    CU_ASSERT_EQUAL(dal_run_restore(fresh, memory, count, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_step(fresh, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(memcmp(dal_run_state(run), dal_run_state(fresh), 8 * sizeof *start), 0);
    CU_ASSERT_EQUAL(dal_run_set_state(fresh, memory[16], memory, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_step(fresh, NULL), DAL_STATUS_OK);
    CU_ASSERT_NOT_EQUAL(memcmp(dal_run_state(run), dal_run_state(fresh), 8 * sizeof *start), 0);
    free(memory);
    dal_run_free(run);
    dal_run_free(fresh);
}

/* ---- long runs ---- */

/* d log(Hf)/dt by the values at T/2 and T. */
static double growth(const dal_system *system, const char *method, double spin, double h, double T)
{
    const dal_setting speed = {"spin", spin};
    dal_run_spec spec = fixture_spec(system, method, DAL_PHYSICAL, h);
    double seen[2][8];
    spec.parameters = &speed;
    spec.parameter_count = 1;
    dal_run *run = fixture_run(&spec);
    const int Hf = 2; /* after D1 and E */
    for (int i = 0; i < 2; i++) {
        CU_ASSERT_EQUAL_FATAL(dal_run_advance(run, llround(0.5 * T / h), NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_observe(run, seen[i]), DAL_STATUS_OK);
    }
    dal_run_free(run);
    return log(seen[1][Hf] / seen[0][Hf]) / (0.5 * T);
}

/* With a rotating driver McLachlan-Perlmutter loses the fibre energy, and gains it when the driver
 * turns the other way, at a rate like h^2; with a librating one, and for gni, it stays. */
static void test_transmission(void)
{
    const dal_system *system = fixture_system("pendulum-cvt");
    const bool full = long_run(8000) == 8000; /* what is slow does not show in a quick run */
    const double T = (double)long_run(8000);
    const double coarse = growth(system, "mclachlan-perlmutter", 2.6, 0.1, T);
    const double fine = growth(system, "mclachlan-perlmutter", 2.6, 0.05, T);
    const double back = growth(system, "mclachlan-perlmutter", -2.6, 0.1, T);
    /* About 1 % of it is the oscillation of Hf, which the two ends do not share. */
    const double librating = growth(system, "mclachlan-perlmutter", 1.0, 0.1, T);
    const double gni = growth(system, "gni", 2.6, 0.1, T);
    const double gradient = growth(system, "discrete-gradient", 2.6, 0.1, T);
    const double midpoint = growth(system, "implicit-midpoint", 2.6, 0.1, T);
    CU_ASSERT(!full || coarse < -5e-5);
    CU_ASSERT(!full || fabs(log2(coarse / fine) - 2.0) < 0.05);
    CU_ASSERT(!full || fabs(back / coarse + 1.0) < 0.05);
    CU_ASSERT(!full || fabs(librating) < 1e-6);
    CU_ASSERT(!full || fabs(gni) < 1e-6);
    CU_ASSERT(!full || fabs(gradient) < 1e-16);
    CU_ASSERT(!full || midpoint > 5e-5);
}

/* The largest |E - E(0)| within the next count rows, steps apart that no period divides. */
static double max_change(dal_run *run, double E, long long count)
{
    double seen[8], max = 0.0;
    for (long long i = 0; i < count; i++) {
        CU_ASSERT_EQUAL_FATAL(dal_run_advance(run, 37, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_observe(run, seen), DAL_STATUS_OK);
        max = fmax(max, fabs(seen[1] - E));
    }
    return max;
}

/* Contact oscillator, h = 2 sin(pi/40), forty steps to a period: the error of the energy in the
 * last of many periods is what it was in the first. */
static void test_bounded(void)
{
    const double h = 2.0 * sin(acos(-1.0) / 40.0);
    const long long rows = long_run(10000) * 40 / 37 / 10;
    const dal_run_spec spec =
        fixture_spec(fixture_system("contact-oscillator"), "mclachlan-perlmutter", DAL_PHYSICAL, h);
    dal_run *run = fixture_run(&spec);
    double seen[8];
    CU_ASSERT_EQUAL(dal_run_observe(run, seen), DAL_STATUS_OK);
    const double first = max_change(run, seen[1], rows);
    max_change(run, seen[1], 8 * rows);
    const double last = max_change(run, seen[1], rows);
    const bool full = long_run(10000) == 10000;
    CU_ASSERT(first < h * h && (!full || first > 1e-3));
    CU_ASSERT(!full || fabs(last / first - 1.0) < 0.02);
    dal_run_free(run);
}

enum { STARTS = 41 };

/* The spread of E over the lanes: their root mean square distance from the mean. */
static double spread(const dal_batch *batch, dal_evaluator *evaluator)
{
    const dal_system *system = dal_evaluator_system(evaluator);
    double state[16], E[STARTS], mean = 0.0, sum = 0.0;
    for (int i = 0; i < STARTS; i++) {
        dal_batch_state(batch, i, state);
        CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, system->energy, 0.0, state, state + system->n,
                                           NULL, &E[i]),
                        DAL_STATUS_OK);
        mean += E[i] / STARTS;
    }
    for (int i = 0; i < STARTS; i++) sum += (E[i] - mean) * (E[i] - mean);
    return sqrt(sum / STARTS);
}

/* Chaotic oscillators from 41 starts of one energy: the energies walk at random, apart like the
 * square root of time.  With 41 of them a spread is known to 11 %. */
static void test_walk(void)
{
    const long long steps = long_run(5000);
    const dal_run_spec spec = fixture_spec(fixture_system("chaotic-oscillators"),
                                           "mclachlan-perlmutter", DAL_PHYSICAL, 0.2);
    dal_batch *batch = NULL;
    dal_evaluator *evaluator = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, STARTS, 0, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_evaluator_create(&evaluator, spec.system, NULL, 0, NULL),
                          DAL_STATUS_OK);
    for (int i = 0; i < STARTS; i++) {
        const dal_setting angle = {"angle", acos(-1.0) * i / 80.0};
        CU_ASSERT_EQUAL(dal_batch_start(batch, i, &angle, 1, NULL, 0, NULL), DAL_STATUS_OK);
    }
    CU_ASSERT(spread(batch, evaluator) < 1e-14);
    CU_ASSERT_EQUAL(dal_batch_advance(batch, steps), DAL_STATUS_OK);
    const double early = spread(batch, evaluator);
    CU_ASSERT_EQUAL(dal_batch_advance(batch, 15 * steps), DAL_STATUS_OK);
    const double ratio = spread(batch, evaluator) / early;
    CU_ASSERT(steps < 5000 || (ratio > 2.3 && ratio < 7.0));
    dal_evaluator_free(evaluator);
    dal_batch_free(batch);
}

/* ---- large systems ---- */

/* Copies of a sleigh on a slope, side by side: COPIES * 3 coordinates. */
static void write_sleighs(char *text, size_t size, int copies)
{
    size_t at = (size_t)snprintf(text, size, "coordinates: [");
#define ADD(...) at += (size_t)snprintf(text + at, size - at, __VA_ARGS__)
    for (int i = 0; i < copies; i++) ADD("%sx%d, y%d, a%d", i ? ", " : "", i, i, i);
    ADD("]\nlagrangian: ");
    for (int i = 0; i < copies; i++)
        ADD("%s(x%d'^2 + y%d'^2 + 0.5*a%d'^2 + 0.2*x%d'*a%d')/2 - y%d", i ? " + " : "", i, i, i, i,
            i, i);
    ADD("\nconstraints:\n");
    for (int i = 0; i < copies; i++) ADD("  - x%d'*sin(a%d) - y%d'*cos(a%d)\n", i, i, i, i);
    ADD("start: {");
    for (int i = 0; i < copies; i++) ADD("%sa%d: 0.3, a%d': 1.1", i ? ", " : "", i, i);
    ADD("}\n");
#undef ADD
    CU_ASSERT(at < size);
}

/* Systems beside each other move as each alone: what skips zeros of many coordinates agrees with
 * what does not. */
static void test_copies(void)
{
    enum { COPIES = 17, STEPS = 10 };
    static const char *const methods[] = {"gni",          "dla",        "mclachlan-perlmutter",
                                          "spark4",       "spark6",     "lobatto-nonholonomic4",
                                          "gauss-spark4", "rk4+project"};
    static char one[4096], many[1 << 14];
    write_sleighs(one, sizeof one, 1);
    write_sleighs(many, sizeof many, COPIES);
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
        const dal_run_spec small = fixture_spec(fixture_system(one), methods[k], DAL_PHYSICAL, 0.1);
        const dal_run_spec large =
            fixture_spec(fixture_system(many), methods[k], DAL_PHYSICAL, 0.1);
        dal_run *alone = fixture_stepped(&small, STEPS), *all = fixture_stepped(&large, STEPS);
        const double *x = dal_run_state(alone), *y = dal_run_state(all);
        double error = 0.0;
        for (int i = 0; i < 3 * COPIES; i++) {
            error = fmax(error, fabs(y[i] - x[i % 3]));
            error = fmax(error, fabs(y[3 * COPIES + i] - x[3 + i % 3]));
        }
        if (!(error <= 1e-13)) printf("\n  %s: %.2g\n", methods[k], error);
        CU_ASSERT(error <= 1e-13);
        dal_run_free(alone);
        dal_run_free(all);
    }
}

void suite_constrained(void)
{
    CU_pSuite suite = CU_add_suite("constrained", NULL, NULL);
    CU_add_test(suite, "refusals", test_refusals);
    CU_add_test(suite, "turned round with its multipliers", test_turning);
    CU_add_test(suite, "multipliers to begin with", test_beginning);
    CU_add_test(suite, "multipliers of a state set, and of a checkpoint", test_set_state);
    CU_add_test(suite, "a driven transmission", test_transmission);
    CU_add_test(suite, "bounded energy", test_bounded);
    CU_add_test(suite, "energies that walk", test_walk);
    CU_add_test(suite, "copies of a system beside each other", test_copies);
}
