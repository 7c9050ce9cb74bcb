/* test_quad.c - quad precision: its functions against MPFR, and runs in it. */
#define DAL_NUM_QUAD
#include "dalembert_codegen.h"
#include "fixtures.h"
#include "kernel/elementary.h"
#include <CUnit/CUnit.h>
#include <mpfr.h>
#include <stdio.h>
#include <stdlib.h>

enum { BITS = 400 };

/* ---- elementary functions ---- */

/* Exactly: a long number is a sum of three doubles. */
static void set_long(mpfr_t to, num x)
{
    mpfr_set_zero(to, 1);
    for (int i = 0; i < 4; i++) {
        const double digits = (double)x;
        mpfr_add_d(to, to, digits, MPFR_RNDN);
        x -= digits;
    }
}

/* The error of y in units in the last place of the right value. */
static double error_of(num y, mpfr_t right)
{
    mpfr_t seen;
    mpfr_init2(seen, BITS);
    set_long(seen, y);
    mpfr_sub(seen, seen, right, MPFR_RNDN);
    if (!mpfr_zero_p(right))
        mpfr_mul_2si(seen, seen, DAL_QUAD_DIGITS - mpfr_get_exp(right), MPFR_RNDN);
    const double error = fabs(mpfr_get_d(seen, MPFR_RNDN));
    mpfr_clear(seen);
    return error;
}

typedef struct function {
    const char *name;
    num (*unary)(num);
    num (*binary)(num, num);
    int (*right1)(mpfr_t, const mpfr_t, mpfr_rnd_t);
    int (*right2)(mpfr_t, const mpfr_t, const mpfr_t, mpfr_rnd_t);
    double from, to;
} function;

static const function functions[] = {
    {"sin", dal_sin, NULL, mpfr_sin, NULL, -50, 50},
    {"cos", dal_cos, NULL, mpfr_cos, NULL, -1e6, 1e6},
    {"tan", dal_tan, NULL, mpfr_tan, NULL, -5, 5},
    {"asin", dal_asin, NULL, mpfr_asin, NULL, -1, 1},
    {"acos", dal_acos, NULL, mpfr_acos, NULL, -1, 1},
    {"atan", dal_atan, NULL, mpfr_atan, NULL, -9, 9},
    {"sinh", dal_sinh, NULL, mpfr_sinh, NULL, -9, 9},
    {"cosh", dal_cosh, NULL, mpfr_cosh, NULL, -9, 9},
    {"tanh", dal_tanh, NULL, mpfr_tanh, NULL, -9, 9},
    {"asinh", dal_asinh, NULL, mpfr_asinh, NULL, -9, 9},
    {"exp", dal_exp, NULL, mpfr_exp, NULL, -30, 30},
    {"log", dal_log, NULL, mpfr_log, NULL, 1e-3, 30},
    {"sqrt", dal_sqrt, NULL, mpfr_sqrt, NULL, 0, 30},
    {"pow", NULL, dal_pow, NULL, mpfr_pow, 1e-3, 9},
    {"atan2", NULL, dal_atan2, NULL, mpfr_atan2, -9, 9},
};

/* A number with digits in all its places. */
static num random_in(double from, double to, unsigned long long *state)
{
    num unit = 0.0;
    for (int i = 0; i < 3; i++) {
        *state = *state * 6364136223846793005u + 1442695040888963407u;
        unit = (unit + (double)(*state >> 16)) * 0x1p-48;
    }
    return from + unit * ((num)to - from);
}

static void test_functions(void)
{
    static const double limit = 2.0; /* what glibc promises of them, and of its own sums */
    unsigned long long state = 1;
    mpfr_t a, b, right;
    mpfr_inits2(BITS, a, b, right, (mpfr_ptr)0);
    for (size_t k = 0; k < sizeof functions / sizeof *functions; k++) {
        const function *f = &functions[k];
        double max_error = 0.0;
        for (int i = 0; i < 300; i++) {
            const num x = random_in(f->from, f->to, &state), y = random_in(f->from, f->to, &state);
            set_long(a, x);
            set_long(b, y);
            if (f->unary)
                f->right1(right, a, MPFR_RNDN);
            else
                f->right2(right, a, b, MPFR_RNDN);
            max_error = fmax(max_error, error_of(f->unary ? f->unary(x) : f->binary(x, y), right));
        }
        if (!(max_error <= limit)) printf("\n  %s: off by %g units\n", f->name, max_error);
        CU_ASSERT(max_error <= limit);
    }
    mpfr_clears(a, b, right, (mpfr_ptr)0);
}

/* ---- runs ---- */

/* The last observable, which is the error against the closed form. */
static double error_at_end(const dal_run_spec *spec, int steps)
{
    double out[32];
    dal_run *run = fixture_stepped(spec, steps);
    CU_ASSERT_EQUAL(dal_run_observe(run, out), DAL_STATUS_OK);
    const double error = out[dal_run_observables(run) - 1];
    dal_run_free(run);
    return error;
}

/* The order of a method where doubles would not see its error any more.  The coefficients of
 * gauss8 are good to 20 digits, the midpoint rule has none to speak of. */
static void test_order(void)
{
    static const struct {
        const char *method;
        int order;
        double step;
        double time;
    } cases[] = {{"implicit-midpoint", 2, 0x1p-18, 0x1p-15}, {"gauss8", 8, 0x1p-4, 0.5}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        dal_run_spec spec = fixture_spec(fixture_system("chaplygin-sleigh"), cases[i].method,
                                         DAL_PHYSICAL, cases[i].step);
        spec.options.precision = DAL_QUAD;
        const int steps = (int)(cases[i].time / cases[i].step);
        const double coarse = error_at_end(&spec, steps);
        spec.options.step /= 2;
        const double fine = error_at_end(&spec, 2 * steps);
        const double slope = log2(coarse / fine);
        if (!(fabs(slope - cases[i].order) < 0.02))
            printf("\n  %s: %g, %g: order %.3f\n", cases[i].method, coarse, fine, slope);
        CU_ASSERT(fabs(slope - cases[i].order) < 0.02);
        CU_ASSERT(coarse < 1e-16);
    }
}

/* The midpoint rule keeps quadratic D; its one coefficient is 1/2. */
static void test_constraint(void)
{
    double out[32];
    dal_run_spec spec =
        fixture_spec(fixture_system(fixture_quadratic), "implicit-midpoint", DAL_PHYSICAL, 0.05);
    dal_run *in_double = fixture_stepped(&spec, 200);
    spec.options.precision = DAL_QUAD;
    dal_run *start = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_observe(start, out), DAL_STATUS_OK);
    const double before = out[0];
    dal_run *in_quad = fixture_stepped(&spec, 200);
    CU_ASSERT_EQUAL(dal_run_observe(in_quad, out), DAL_STATUS_OK);
    CU_ASSERT(fabs(out[0] - before) < 1e-30);
    CU_ASSERT_EQUAL(dal_run_observe(in_double, out), DAL_STATUS_OK);
    CU_ASSERT(fabs(out[0] - before) > 1e-18);
    dal_run_free(in_double);
    dal_run_free(start);
    dal_run_free(in_quad);
}

/* Every integrator, and every observable off p = pi = 0: only rounding separates the two. */
static void compare(const dal_run_spec *of)
{
    double a[64], b[64];
    char name[128];
    dal_run_spec spec = *of;
    dal_run *in_double = fixture_run(&spec);
    spec.options.precision = DAL_QUAD;
    dal_run *in_quad = fixture_run(&spec);
    if (spec.options.space == DAL_LIFTED) {
        fixture_perturb(in_double, 0.1);
        fixture_perturb(in_quad, 0.1);
    }
    CU_ASSERT_EQUAL(dal_run_advance(in_double, 5, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_advance(in_quad, 5, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_time(in_quad), dal_run_time(in_double));
    CU_ASSERT_EQUAL(dal_run_steps(in_quad), 5);
    double max_error = 0.0, min_error = 0.0;
    for (int i = 0; i < dal_run_dimension(in_double); i++) {
        const double d = fabs(dal_run_state(in_quad)[i] - dal_run_state(in_double)[i]);
        max_error = fmax(max_error, d);
        min_error = fmax(min_error, d);
    }
    CU_ASSERT_EQUAL(dal_run_observe(in_double, a), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_observe(in_quad, b), DAL_STATUS_OK);
    for (int i = 0; i < dal_run_observables(in_double); i++)
        max_error = fmax(max_error, fabs(a[i] - b[i]));
    dal_method_name(&spec.method, name, sizeof name);
    if (!(max_error < 1e-12)) printf("\n  %s: %g\n", name, max_error);
    CU_ASSERT(max_error < 1e-12);
    dal_run_free(in_double);
    dal_run_free(in_quad);
}

static void test_methods(void)
{
    const dal_system *system = fixture_system("contact-oscillator");
    char name[128];
    int compared = 0;
    for (int i = 0; dal_integrator_at(i); i++) {
        fixture_method(i, name, sizeof name);
        for (dal_space space = DAL_LIFTED; space <= DAL_PHYSICAL; space++) {
            const dal_run_spec spec = fixture_spec(system, name, space, 0.02);
            if (!fixture_accepts(&spec.method, system, space)) continue;
            compare(&spec);
            compared++;
        }
    }
    CU_ASSERT(compared >= 50);
    const dal_run_spec spec =
        fixture_spec(fixture_system(fixture_full), "gauss4", DAL_LIFTED, 0.02);
    compare(&spec);
}

/* ---- memory ---- */

static dal_status nothing(void *user, dal_run *run, long long row, double t)
{
    (void)run, (void)row, (void)t;
    ++*(int *)user;
    return DAL_STATUS_OK;
}

/* Rows between steps, and a copy of the memory in the middle, change no bit. */
static void test_memory(void)
{
    dal_run_spec spec = fixture_spec(fixture_system("knife-edge"), "gauss4", DAL_LIFTED, 0.125);
    spec.options.precision = DAL_QUAD;
    dal_run *straight = fixture_stepped(&spec, 16), *sampled = fixture_run(&spec);
    int rows = 0;
    const dal_observer observer = {.user = &rows, .sample = nothing};
    dal_error error = {0};
    CU_ASSERT_EQUAL(dal_run_sample(sampled, 1.0, 7, 0, &observer, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(rows, 8);
    size_t count, other;
    const double *memory = dal_run_save(sampled, &count);
    dal_run *loaded = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_restore(loaded, memory, count, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_time(loaded), 1.0);
    CU_ASSERT_EQUAL(dal_run_advance(loaded, 8, NULL), DAL_STATUS_OK);
    const double *x = dal_run_save(loaded, &count), *y = dal_run_save(straight, &other);
    CU_ASSERT_EQUAL_FATAL(count, other);
    CU_ASSERT_EQUAL(memcmp(x, y, count * sizeof *x), 0);
    CU_ASSERT_EQUAL(dal_run_restore(loaded, x, count - 1, &error), DAL_STATUS_ARGUMENT);
    num *bad = malloc(count * sizeof(double));
    memcpy(bad, x, count * sizeof(double));
    bad[1] = NAN;
    CU_ASSERT_EQUAL(dal_run_restore(loaded, (double *)bad, count, &error), DAL_STATUS_NOT_FINITE);
    free(bad);
    dal_run_free(straight);
    dal_run_free(sampled);
    dal_run_free(loaded);
}

/* ---- refusals ---- */

static void test_refused(void)
{
    const dal_system by_hand = {.name = "spring", .n = 1, .call = {.field = fixture_oscillate}};
    dal_run_spec spec = fixture_spec(&by_hand, "rk4", DAL_PHYSICAL, 0.1);
    dal_error error = {0};
    dal_batch *batch;
    char *text;
    spec.options.precision = DAL_QUAD;
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, "quad precision: spring has no form in it");
    spec = fixture_spec(fixture_system("knife-edge"), "rk4", DAL_PHYSICAL, 0.1);
    spec.options.precision = DAL_QUAD;
    CU_ASSERT_EQUAL(dal_batch_create(&batch, &spec, 4, 0, &error), DAL_STATUS_UNSUPPORTED);
    CU_ASSERT_EQUAL(dal_generate(&spec, NULL, &text, &error), DAL_STATUS_UNSUPPORTED);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "quad precision"));
    CU_ASSERT(error.line == 0 && error.column == 0);
    dal_integrator outside = *spec.method.layer[0];
    spec.method.layer[0] = &outside;
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, "'rk4' has no form in it");
}

void suite_quad(void)
{
    CU_pSuite suite = CU_add_suite("quad precision", NULL, NULL);
    CU_add_test(suite, "elementary functions", test_functions);
    CU_add_test(suite, "order below the rounding of doubles", test_order);
    CU_add_test(suite, "a constraint kept below it", test_constraint);
    CU_add_test(suite, "every method", test_methods);
    CU_add_test(suite, "memory, and rows between steps", test_memory);
    CU_add_test(suite, "what is refused", test_refused);
}
