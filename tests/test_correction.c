/* test_correction.c - the correction that brings v to D = 0, by the factors of F, against
 * -B G^-1 D from D, A and B, against a closed form, and along runs with +project. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Rounding of two ways to eliminate, of the largest velocity. */
static const double SAME = 1e-13;
/* Rounding in the terms of D, over their size. */
static const double OF_D = 16 * DBL_EPSILON;

/* ---- at points ---- */

/* x = g^-1 rhs, [size]; both are destroyed. */
static void solve(int size, double *g, double *rhs, double *x)
{
    for (int k = 0; k < size; k++) {
        int best = k;
        for (int i = k + 1; i < size; i++)
            best = fabs(g[i * size + k]) > fabs(g[best * size + k]) ? i : best;
        for (int j = 0; j < size; j++) {
            const double other = g[k * size + j];
            g[k * size + j] = g[best * size + j];
            g[best * size + j] = other;
        }
        const double other = rhs[k];
        rhs[k] = rhs[best];
        rhs[best] = other;
        for (int i = k + 1; i < size; i++) {
            const double factor = g[i * size + k] / g[k * size + k];
            for (int j = k; j < size; j++) g[i * size + j] -= factor * g[k * size + j];
            rhs[i] -= factor * rhs[k];
        }
    }
    for (int k = size; k-- > 0;) {
        x[k] = rhs[k];
        for (int j = k + 1; j < size; j++) x[k] -= g[k * size + j] * x[j];
        x[k] /= g[k * size + k];
    }
}

/* The largest difference of the correction from -B G^-1 D at a point, over the largest of them. */
static double correction_error(const dal_system *system, double t, const double *q, const double *v)
{
    enum { MAX_N = 64, MAX_M = 16 };
    static double out[MAX_M + 2 * MAX_M * MAX_N], g[MAX_M * MAX_M], l[MAX_M], x[MAX_N];
    const int n = system->n, m = system->m;
    const double *A = out + m, *B = A + m * n;
    double error = 0.0, size = 0.0;
    dal_evaluator *evaluator = fixture_evaluator(system);
    CU_ASSERT_FATAL(n <= MAX_N && m <= MAX_M);
    CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, system->call.constraint, t, q, v, NULL, out),
                    DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, system->call.correction, t, q, v, NULL, x),
                    DAL_STATUS_OK);
    for (int k = 0; k < m * m; k++) {
        g[k] = 0.0;
        for (int i = 0; i < n; i++) g[k] += A[k / m * n + i] * B[i * m + k % m];
    }
    solve(m, g, out, l);
    for (int i = 0; i < n; i++) {
        double expected = 0.0;
        for (int a = 0; a < m; a++) expected -= B[i * m + a] * l[a];
        error = fmax(error, fabs(x[i] - expected));
        size = fmax(size, fabs(expected));
    }
    dal_evaluator_free(evaluator);
    CU_ASSERT(size > 0.0);
    return error / size;
}

/* The largest error at points near the start, where v is off D = 0. */
static double largest_error(const dal_system *system)
{
    enum { POINTS = 4 };
    double max = 0.0;
    dal_run_spec spec = fixture_spec(system, "rk4", DAL_PHYSICAL, 0.1);
    dal_run *run = fixture_run(&spec);
    double *y = malloc((size_t)dal_run_dimension(run) * sizeof *y);
    CU_ASSERT_PTR_NOT_NULL_FATAL(y);
    for (int k = 0; k < POINTS; k++) {
        for (int i = 0; i < dal_run_dimension(run); i++)
            y[i] = dal_run_state(run)[i] + 0.1 * sin(1.0 + 3.0 * i + 7.0 * k);
        max = fmax(max, correction_error(system, 0.1 * k, y, y + system->n));
    }
    free(y);
    dal_run_free(run);
    return max;
}

static void test_builtin(void)
{
    int found = 0;
    for (int i = 0; dal_builtin_name(i); i++) {
        const dal_system *system = fixture_system(dal_builtin_name(i));
        if (system->m == 0 || !system->call.constraint) continue;
        const double error = largest_error(system);
        if (!(error <= SAME)) printf("\n  %s: %.2g\n", dal_builtin_name(i), error);
        CU_ASSERT_PTR_NOT_NULL(system->call.correction);
        CU_ASSERT(error <= SAME);
        found++;
    }
    CU_ASSERT(found > 10);
    CU_ASSERT(largest_error(fixture_system(fixture_full)) <= SAME);
    CU_ASSERT(largest_error(fixture_system(fixture_quadratic)) <= SAME);
}

/* Masses that couple, constraints that overlap, some of them not linear in v. */
static void write_random(char *text, size_t size, unsigned seed)
{
    const int n = 4 + (int)(seed % 5), m = 1 + (int)(seed % 3);
    size_t at = (size_t)snprintf(text, size, "coordinates: [");
#define ADD(...) at += (size_t)snprintf(text + at, size - at, __VA_ARGS__)
    for (int i = 0; i < n; i++) ADD("%sx%d", i ? ", " : "", i);
    ADD("]\nlagrangian: ");
    for (int i = 0; i < n; i++)
        ADD("%s(%g + cos(x%d)^2)*x%d'^2 + 0.%u*x%d'*x%d'", i ? " + " : "", 1.0 + i % 3, (i + 1) % n,
            i, 1 + (seed + (unsigned)i) % 4, i, (i + 2) % n);
    ADD("\nconstraints:\n");
    for (int a = 0; a < m; a++)
        ADD("  - x%d'*cos(x%d) + (1 + x%d^2)*x%d' + 0.%u*x%d'*x%d'\n", a, n - 1, a, a + 1,
            (seed + (unsigned)a) % 2, a + 1, n - 1);
#undef ADD
    CU_ASSERT(at < size);
}

static void test_random(void)
{
    enum { SYSTEMS = 30 };
    char text[4096];
    for (unsigned seed = 0; seed < SYSTEMS; seed++) {
        write_random(text, sizeof text, seed);
        const double error = largest_error(fixture_system(text));
        if (!(error <= SAME)) printf("\n  %u: %.2g\n%s", seed, error, text);
        CU_ASSERT(error <= SAME);
    }
}

/* W = diag(1, 4), D = x' - y': W x = A^T l with A = (1, -1) and A x = -D give -D (4, -1)/5. */
static void test_closed_form(void)
{
    const dal_system *system = fixture_system("coordinates: [x, y]\n"
                                              "lagrangian: x'^2/2 + 2*y'^2\n"
                                              "constraints: [x' - y']\n");
    const double q[] = {0.3, 0.7}, v[] = {2.0, 0.75};
    double x[2];
    dal_evaluator *evaluator = fixture_evaluator(system);
    CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, system->call.correction, 0.0, q, v, NULL, x),
                    DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(x[0], -1.0, 4 * DBL_EPSILON);
    CU_ASSERT_DOUBLE_EQUAL(x[1], 0.25, 4 * DBL_EPSILON);
    dal_evaluator_free(evaluator);
}

/* ---- along runs ---- */

/* The largest |D| over its scale after a step of 0.1 from a start off D = 0. */
static double defect_after(const char *text, const char *method)
{
    const dal_run_spec spec = fixture_spec(fixture_system(text), method, DAL_PHYSICAL, 0.1);
    double defect = 0.0, y[64], D[64];
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_FATAL(dal_run_dimension(run) <= 64);
    for (int i = 0; i < dal_run_dimension(run); i++)
        y[i] = dal_run_state(run)[i] + 0.1 * cos(3.0 * i);
    CU_ASSERT_EQUAL(dal_run_set_state(run, 0.0, y, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_observe(run, D), DAL_STATUS_OK);
    const double *scale = dal_run_scales(run);
    for (int a = 0; a < spec.system->m; a++) defect = fmax(defect, fabs(D[a]) / scale[a]);
    dal_run_free(run);
    return defect;
}

static void test_defect(void)
{
    const char *const texts[] = {
        fixture_full,       fixture_gentle, fixture_bilinear, fixture_quadratic,
        "chaplygin-sleigh", "falling-disk", "roller-racer",   "chaplygin-sleigh-nonlinear"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        const double defect = defect_after(texts[i], "rk4+project");
        if (!(defect <= OF_D)) printf("\n  %zu: %.2g\n", i, defect);
        CU_ASSERT(defect <= OF_D);
    }
}

/* Without the callback the correction is made of the callback `constraint`. */
static void test_without(void)
{
    const char *const texts[] = {fixture_full, fixture_quadratic, "snakeboard"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        dal_system other = *fixture_system(texts[i]);
        dal_run_spec spec = fixture_spec(&other, "gauss4+project", DAL_PHYSICAL, 0.01);
        dal_run *with = fixture_stepped(&spec, 20);
        other.call.correction = NULL;
        dal_run *without = fixture_stepped(&spec, 20);
        for (int c = 0; c < dal_run_dimension(with); c++)
            CU_ASSERT_DOUBLE_EQUAL(dal_run_state(with)[c], dal_run_state(without)[c], SAME);
        dal_run_free(with);
        dal_run_free(without);
    }
}

static void test_lanes(void)
{
    dal_run_spec spec =
        fixture_spec(fixture_system(fixture_full), "rk4+project", DAL_PHYSICAL, 0.05);
    spec.options.consistent = true;
    fixture_lanes(spec, 11, 20, spec.system->coordinate[0], 0.1, 0.05);
}

void suite_correction(void)
{
    CU_pSuite suite = CU_add_suite("corrections to D = 0", NULL, NULL);
    CU_add_test(suite, "shipped systems: -B G^-1 D", test_builtin);
    CU_add_test(suite, "random systems: -B G^-1 D", test_random);
    CU_add_test(suite, "closed form", test_closed_form);
    CU_add_test(suite, "D is a rounding after a step", test_defect);
    CU_add_test(suite, "runs without the callback", test_without);
    CU_add_test(suite, "lanes", test_lanes);
}
