/* test_chains.c - large chains of springs with constraints that couple neighbours.
 *
 *     L = sum x_i'^2/2 + gamma_i x_i' x_(i+1)' - (x_(i+1) - x_i)^2/2,   gamma_i = gamma or
 *                                                                    gamma cos(x_i)
 *     D_a = x_s' + cos(x_(s+1)) x_(s+1)' + (2 + sin(x_(s+3))) x_(s+2)' + x_(s+2)/2 x_(s+3)'
 *
 * with s = stride a; or, where any coefficient may vanish,
 *
 *     D_a = cos(x_(s+1)) x_s' + cos(x_(s+2)) x_(s+1)' + cos(x_(s+3)) x_(s+2)' + cos(x_s) x_(s+3)'
 *
 * Their equations are checked coordinate by coordinate, by formulas. */
#include "core/vectors.h"
#include "fixtures.h"
#include "model/model.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Rounding of a sum of some ten terms, over the size of the terms of all. */
static const double SAME = 1e-13;
enum { WIDTH = 4, MAX_N = 1024 };

/* In a quick run most chains have an eighth of the coordinates. */
typedef struct chain {
    int n, stride;
    double gamma;
    bool may_vanish; /* the second form of D_a */
    bool varies;     /* the second form of gamma_i */
} chain;

/* Constraints of disjoint neighbours. */
static const chain disjoint[] = {{256, WIDTH, 0.0, false, false},
                                 {512, WIDTH, 0.0, false, false},
                                 {1024, WIDTH, 0.0, false, false}};

/* Constraints that share coordinates, a mass matrix that couples neighbours, and both. */
static const chain coupled[] = {{256, 2, 0.0, false, false},     {512, 2, 0.0, false, false},
                                {256, WIDTH, 0.2, false, false}, {512, WIDTH, 0.2, false, false},
                                {128, 2, 0.2, false, false},     {256, 2, 0.2, false, true},
                                {1024, 2, 0.2, false, true}};

static chain sized(chain c)
{
    c.n /= case_stride(8);
    return c;
}

static int constraints(const chain *c) { return (c->n - WIDTH) / c->stride + 1; }

/* The model, to be freed, and its system. */
static dal_model *make(const chain *c, const dal_system **system)
{
    static const char coordinates[] = "coordinates: ['x[0..%d]']\n"
                                      "lagrangian: sum(i, 0, %d, x[i]'^2)/2 + %g*sum(i, 0, %d, "
                                      "%sx[i]'*x[i+1]') - sum(i, 0, %d, (x[i+1] - x[i])^2)/2\n";
    static const char rows[] = "constraints: [{for: i = 0..%d, is: \"x[%d*i]' + cos(x[%d*i+1])*"
                               "x[%d*i+1]' + (2 + sin(x[%d*i+3]))*x[%d*i+2]' + "
                               "x[%d*i+2]/2*x[%d*i+3]'\"}]\n";
    static const char vanishing[] =
        "constraints: [{for: i = 0..%d, is: \"cos(x[%d*i+1])*x[%d*i]' + "
        "cos(x[%d*i+2])*x[%d*i+1]' + cos(x[%d*i+3])*x[%d*i+2]' + "
        "cos(x[%d*i])*x[%d*i+3]'\"}]\n";
    char text[1024];
    const int last = c->n - 1, k = c->stride;
    int length = snprintf(text, sizeof text, coordinates, last, last, c->gamma, last - 1,
                          c->varies ? "cos(x[i])*" : "", last - 1);
    const size_t left = sizeof text - (size_t)length;
    length +=
        c->may_vanish
            ? snprintf(text + length, left, vanishing, constraints(c) - 1, k, k, k, k, k, k, k, k)
            : snprintf(text + length, left, rows, constraints(c) - 1, k, k, k, k, k, k, k);
    dal_model *model = NULL;
    dal_error error;
    CU_ASSERT_EQUAL_FATAL(dal_model_read(&model, "chain", text, (size_t)length, &error),
                          DAL_STATUS_OK);
    const dal_status status = dal_model_system(model, system, &error);
    if (status != DAL_STATUS_OK) printf("\n  n = %d: %s\n", c->n, error.message);
    CU_ASSERT_EQUAL_FATAL(status, DAL_STATUS_OK);
    CU_ASSERT_EQUAL((*system)->m, constraints(c));
    return model;
}

/* ---- the equations by formulas ---- */

/* The coefficients of constraint a. */
static void coefficients(const chain *c, int a, const double *x, double A[WIDTH])
{
    const double *y = x + a * c->stride;
    for (int k = 0; k < WIDTH && c->may_vanish; k++) A[k] = cos(y[(k + 1) % WIDTH]);
    if (c->may_vanish) return;
    A[0] = 1.0;
    A[1] = cos(y[1]);
    A[2] = 2.0 + sin(y[3]);
    A[3] = y[2] / 2.0;
}

/* What D_a' has besides A_a v'. */
static double curvature(const chain *c, int a, const double *x, const double *v)
{
    const double *y = x + a * c->stride, *u = v + a * c->stride;
    double sum = 0.0;
    for (int k = 0; k < WIDTH; k++) sum -= sin(y[(k + 1) % WIDTH]) * u[(k + 1) % WIDTH] * u[k];
    if (c->may_vanish) return sum;
    return -sin(y[1]) * u[1] * u[1] + cos(y[3]) * u[3] * u[2] + u[2] * u[3] / 2.0;
}

/* gamma_i. */
static double coupling(const chain *c, const double *x, int i)
{
    return c->varies ? c->gamma * cos(x[i]) : c->gamma;
}

/* Row i of W y; adds the size of its terms. */
static double mass_row(const chain *c, int i, const double *x, const double *y, double *size)
{
    const double below = i > 0 ? coupling(c, x, i - 1) * y[i - 1] : 0.0;
    const double above = i + 1 < c->n ? coupling(c, x, i) * y[i + 1] : 0.0;
    *size += fabs(y[i]) + fabs(below) + fabs(above);
    return y[i] + below + above;
}

/* b_i; adds the size of its terms. */
static double force(const chain *c, int i, const double *x, const double *v, double *size)
{
    double sum = 0.0;
    for (int j = i - 1; j <= i + 1; j += 2) {
        if (j < 0 || j >= c->n) continue;
        sum -= x[i] - x[j];
        *size += fabs(x[i]) + fabs(x[j]);
    }
    if (!c->varies || i == 0) return sum;
    const double term = c->gamma * sin(x[i - 1]) * v[i - 1] * v[i - 1];
    *size += fabs(term);
    return sum + term;
}

/* The largest residual of W F - A^T h = b and A F = -c, over the largest size of their terms. */
static double residual(const chain *c, const double *x, const double *v, const double *F,
                       const double *h)
{
    static double row[MAX_N];
    double A[WIDTH], size, largest = 0.0, worst = 0.0;
    for (int i = 0; i < c->n; i++) {
        size = 0.0;
        row[i] = mass_row(c, i, x, F, &size) - force(c, i, x, v, &size);
        largest = fmax(largest, size);
    }
    for (int a = 0; a < constraints(c); a++) {
        const int first = a * c->stride;
        double sum = curvature(c, a, x, v);
        coefficients(c, a, x, A);
        for (int k = 0; k < WIDTH; k++) {
            row[first + k] -= A[k] * h[a];
            sum += A[k] * F[first + k];
            largest = fmax(largest, fmax(fabs(A[k] * h[a]), fabs(A[k] * F[first + k])));
        }
        worst = fmax(worst, fabs(sum));
    }
    for (int i = 0; i < c->n; i++) worst = fmax(worst, fabs(row[i]));
    return worst / largest;
}

/* The largest |D_a| over the largest of all terms. */
static double defect(const chain *c, const double *x, const double *v)
{
    double A[WIDTH], worst = 0.0, largest = 0.0;
    for (int a = 0; a < constraints(c); a++) {
        double sum = 0.0;
        coefficients(c, a, x, A);
        for (int k = 0; k < WIDTH; k++) {
            const double term = A[k] * v[a * c->stride + k];
            sum += term;
            largest = fmax(largest, fabs(term));
        }
        worst = fmax(worst, fabs(sum));
    }
    return worst / largest;
}

/* A point of no particular kind; or one where of the coefficients of each constraint, or of each
 * other one, two are 0, which a pivot must not be. */
static void choose_point(int n, bool is_regular, double *x, double *v)
{
    for (int i = 0; i < n; i++) {
        x[i] = 0.7 * cos(1.0 + 3.0 * i);
        v[i] = 0.9 * sin(2.0 + 5.0 * i);
        if (is_regular) continue;
        if (i % WIDTH == 1) x[i] = acos(0.0);
        if (i % WIDTH == 2) x[i] = 0.0;
    }
}

/* D, A, W^-1 A^T, W^-1 b and c of the blocks by W times each column; also of the constraint, which
 * has the first three. */
static void check_blocks(const chain *c, const dal_system *system, const double *x, const double *v)
{
    static double column[MAX_N];
    const int n = c->n, m = constraints(c), width = m + 2 * m * n;
    double *out = calloc((size_t)(2 * width + n + m), sizeof *out),
           *constraint = out + width + n + m;
    double worst = 0.0, size = 1.0, A[WIDTH];
    CU_ASSERT_PTR_NOT_NULL_FATAL(out);
    dal_evaluator *evaluator = fixture_evaluator(system);
    CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, system->call.blocks, 0.0, x, v, NULL, out),
                    DAL_STATUS_OK);
    CU_ASSERT_EQUAL(
        dal_evaluator_call(evaluator, system->call.constraint, 0.0, x, v, NULL, constraint),
        DAL_STATUS_OK);
    CU_ASSERT(memcmp(out, constraint, (size_t)width * sizeof *out) == 0);
    for (int a = 0; a < m; a++) {
        double *const row = out + m + a * n, *const first = row + a * c->stride;
        coefficients(c, a, x, A);
        for (int i = 0; i < n; i++) column[i] = out[m + m * n + i * m + a];
        for (int i = 0; i < n; i++)
            worst = fmax(worst, fabs(mass_row(c, i, x, column, &size) - row[i]));
        for (int k = 0; k < WIDTH; k++) worst = fmax(worst, fabs(first[k] - A[k]));
        for (int k = 0; k < WIDTH; k++) first[k] = 0.0;
        CU_ASSERT_EQUAL(dal__max_abs(row, (size_t)n), 0.0);
        worst = fmax(worst, fabs(out[width + n + a] - curvature(c, a, x, v)));
    }
    for (int i = 0; i < n; i++)
        worst = fmax(worst, fabs(mass_row(c, i, x, out + width, &size) - force(c, i, x, v, &size)));
    CU_ASSERT(worst <= 1e-14);
    dal_evaluator_free(evaluator);
    free(out);
}

static void check_point(const chain *c, const dal_system *system, const double *x, const double *v)
{
    static double F[MAX_N];
    const int m = constraints(c);
    double *h = calloc((size_t)m * (1 + (size_t)c->n), sizeof *h);
    CU_ASSERT_PTR_NOT_NULL_FATAL(h);
    dal_evaluator *evaluator = fixture_evaluator(system);
    CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, system->call.field, 0.0, x, v, NULL, F),
                    DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, system->reactions, 0.0, x, v, NULL, h),
                    DAL_STATUS_OK);
    const double error = residual(c, x, v, F, h);
    if (!(error <= SAME)) printf("\n  n = %d: %.2g\n", c->n, error);
    CU_ASSERT(error <= SAME);
    dal_evaluator_free(evaluator);
    free(h);
}

static void check_equations(const chain *c, bool is_regular)
{
    static double x[MAX_N], v[MAX_N];
    const dal_system *system;
    dal_model *model = make(c, &system);
    choose_point(c->n, is_regular, x, v);
    check_point(c, system, x, v);
    if (is_regular) check_blocks(c, system, x, v);
    dal_model_free(model);
}

/* A few steps from rest, by the forces, end on D = 0. */
static void check_steps(const chain *c, const char *method)
{
    enum { STEPS = 3, STARTS = 16 };
    static char name[STARTS][16];
    const dal_system *system;
    dal_model *model = make(c, &system);
    dal_setting start[STARTS];
    for (int i = 0; i < STARTS; i++) {
        snprintf(name[i], sizeof name[i], "x%d", i * (c->n / STARTS));
        start[i] = (dal_setting){name[i], 0.5 * cos(i)};
    }
    dal_run_spec spec = fixture_spec(system, method, DAL_PHYSICAL, 0.1);
    spec.start = start;
    spec.start_count = STARTS;
    dal_run *run = fixture_stepped(&spec, STEPS);
    const double *y = dal_run_state(run);
    CU_ASSERT(fabs(y[c->n]) > 1e-3);
    CU_ASSERT(defect(c, y, y + c->n) <= SAME);
    dal_run_free(run);
    dal_model_free(model);
}

static void test_equations(void)
{
    for (size_t k = 0; k < sizeof disjoint / sizeof *disjoint; k += (size_t)case_stride(3)) {
        const chain c = sized(disjoint[k]);
        check_equations(&c, true);
    }
    for (size_t k = 0; k < sizeof coupled / sizeof *coupled; k += (size_t)case_stride(2)) {
        const chain c = sized(coupled[k]);
        check_equations(&c, true);
        if (coupled[k].n <= 256) check_equations(&c, false);
    }
}

/* Where W couples coordinates, the pivot of a constraint comes after all coordinates that it holds:
 * at points where but one of its coefficients is not 0, whichever that is, none vanishes. */
static void test_vanishing(void)
{
    static double x[MAX_N], v[MAX_N];
    const chain c = sized((chain){256, WIDTH, 0.2, true, false});
    const dal_system *system;
    dal_model *model = make(&c, &system);
    for (int k = 0; k < WIDTH; k++) {
        choose_point(c.n, true, x, v);
        for (int i = 0; i < c.n; i++)
            if (i % WIDTH != k) x[i] = acos(0.0);
        check_point(&c, system, x, v);
    }
    dal_model_free(model);
}

static void test_steps(void)
{
    static const char *const methods[] = {"rk4+project", "gni", "mclachlan-perlmutter", "dla"};
    const chain chains[] = {sized(disjoint[0]), sized(coupled[0]), sized(coupled[2]),
                            sized(coupled[5])};
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k += (size_t)case_stride(2))
        for (int i = 0; i < 4; i++) check_steps(&chains[i], methods[k]);
}

/* ---- growth ---- */

static int nodes(int n)
{
    const chain c = {n, WIDTH, 0.0, false, false};
    const dal_system *system;
    dal_model *model = make(&c, &system);
    const int count = model->equations.graph->count;
    dal_model_free(model);
    return count;
}

/* What n more coordinates add does not depend on how many there are. */
static void test_nodes(void)
{
    const int n = 128 / case_stride(4), small = nodes(n), middle = nodes(2 * n),
              large = nodes(4 * n);
    CU_ASSERT((large - middle) / 2 < 1.05 * (middle - small));
}

/* So do operations of F, also where they begin to be made in one way alone. */
static int operations(int n)
{
    const chain c = {n, WIDTH, 0.0, false, false};
    const dal_system *system;
    dal_model *model = make(&c, &system);
    const int count = system->field_operations;
    dal_model_free(model);
    return count;
}

static void test_operations(void)
{
    const int at_8 = operations(8), at_16 = operations(16), at_32 = operations(32);
    CU_ASSERT(at_32 - at_16 <= 2 * (at_16 - at_8));
}

/* A star: a coordinate whose velocity is coupled to all others', before them. */
static int operations_of_star(int n)
{
    char text[256];
    const dal_system *system;
    dal_model *model = NULL;
    snprintf(text, sizeof text,
             "coordinates: ['x[0..%d]']\nlagrangian: sum(i, 0, %d, (2 + cos(x[i]))*x[i]'^2)/2 + "
             "sum(i, 1, %d, sin(x[i])*x[0]'*x[i]')/100\n",
             n - 1, n - 1, n - 1);
    CU_ASSERT_EQUAL_FATAL(dal_model_read(&model, "star", text, strlen(text), NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_model_system(model, &system, NULL), DAL_STATUS_OK);
    const int count = system->field_operations;
    dal_model_free(model);
    return count;
}

/* Eliminated first, it would couple each two of the others. */
static void test_star(void)
{
    const int at_24 = operations_of_star(24), at_48 = operations_of_star(48),
              at_96 = operations_of_star(96);
    CU_ASSERT(at_96 - at_48 <= 2.1 * (at_48 - at_24));
}

/* Numbers of a workspace, and the bound of what the rank check compares, grow with n: also where
 * the pivots of a Jacobian of 2 n^2 numbers are checked, or the pivots of n m directions. */
static void check_workspace(const chain *whole)
{
    const chain c = sized(*whole);
    const dal_system *system;
    dal_model *model = make(&c, &system);
    CU_ASSERT(c.n < whole->n || system->workspace < 64 * (size_t)c.n);
    CU_ASSERT(system->pivots > 0);
    CU_ASSERT(system->pivots <= system->m);
    dal_model_free(model);
}

static void test_workspace(void)
{
    static const chain checked = {512, WIDTH, 0.0, true, false};
    check_workspace(&checked);
    for (int k = 0; k < 2; k += case_stride(2)) check_workspace(&coupled[k]);
    if (case_stride(2) == 1) check_workspace(&coupled[5]);
}

/* Two matrices of Newton's method, (stages n)^2 numbers each, are reserved where it may be used. */
static void test_size(void)
{
    const chain c = {256 / case_stride(2), WIDTH, 0.0, false, false};
    const size_t square = (size_t)c.n * (size_t)c.n * sizeof(double);
    const size_t vectors = 512 * (size_t)c.n * sizeof(double); /* two squares of 256 */
    const dal_system *system;
    dal_model *model = make(&c, &system);
    dal_run_spec spec = fixture_spec(system, "gauss4", DAL_PHYSICAL, 0.1);
    CU_ASSERT(dal_run_size(&spec) > 8 * square);
    CU_ASSERT(dal_run_size(&spec) < 12 * square + vectors);
    spec.options.solver = DAL_FIXED_POINT;
    CU_ASSERT(dal_run_size(&spec) < vectors);
    spec = fixture_spec(system, "symplectic-euler", DAL_LIFTED, 0.1);
    CU_ASSERT(dal_run_size(&spec) > 2 * square);
    dal_model_free(model);
}

static const char *const without_newton[] = {
    "rk4", "gauss4", "rk4+project", "gni", "mclachlan-perlmutter", "dla", "spark4"};
enum { METHODS = sizeof without_newton / sizeof *without_newton };

/* Bytes of runs without Newton's method. */
static void measure_runs(chain c, size_t bytes[METHODS])
{
    const dal_system *system;
    dal_model *model = make(&c, &system);
    for (int i = 0; i < METHODS; i++) {
        dal_run_spec spec = fixture_spec(system, without_newton[i], DAL_PHYSICAL, 0.1);
        spec.options.solver = DAL_FIXED_POINT;
        bytes[i] = dal_run_size(&spec);
    }
    dal_model_free(model);
}

/* Else no matrix is: twice the coordinates are at most 2.2 times the memory.  Of constraints that
 * share coordinates this is so where the Jacobian of F, which is full, is no longer made. */
static void test_growth(void)
{
    static const chain halves[] = {{128, WIDTH, 0.0, false, false}, {256, 2, 0.0, false, false}};
    size_t small[METHODS], large[METHODS];
    for (int k = 0; k < 2; k += case_stride(2)) {
        chain c = halves[k];
        c.n /= case_stride(4);
        measure_runs(c, small);
        c.n *= 2;
        measure_runs(c, large);
        for (int i = 0; i < METHODS; i++) {
            if (5 * large[i] > 11 * small[i])
                printf("\n  %s: %zu, %zu\n", without_newton[i], small[i], large[i]);
            CU_ASSERT(5 * large[i] <= 11 * small[i]);
        }
    }
}

/* What is reserved is enough, also where the fixed point and a first attempt fail. */
static void check_reserved(const dal_system *system, const char *method, dal_space space)
{
    static const double sizes[] = {0.01, 2.0};
    dal_run_spec spec = fixture_spec(system, method, space, 0.0);
    if (!fixture_accepts(&spec.method, system, space)) return;
    for (int i = 0; i < 4; i++) {
        spec.options.step = sizes[i % 2];
        spec.options.solver = i < 2 ? DAL_NEWTON : DAL_SOLVER_AUTO;
        dal_run *run = NULL;
        if (dal_run_create(&run, &spec, NULL) != DAL_STATUS_OK) continue;
        const dal_status status = dal_run_advance(run, 2, NULL);
        if (status == DAL_STATUS_MEMORY) printf("\n  %s, %g\n", method, sizes[i % 2]);
        CU_ASSERT_NOT_EQUAL(status, DAL_STATUS_MEMORY);
        dal_run_free(run);
    }
}

static void test_reserved(void)
{
    static const chain chains[] = {{10, WIDTH, 0.0, false, false}, {36, 2, 0.0, false, false}};
    char name[64];
    for (int k = 0; k < 2; k++) {
        const dal_system *system;
        dal_model *model = make(&chains[k], &system);
        for (int i = 0; dal_integrator_at(i); i += case_stride(3)) {
            fixture_method(i, name, sizeof name);
            check_reserved(system, name, DAL_PHYSICAL);
            check_reserved(system, name, DAL_LIFTED);
        }
        dal_model_free(model);
    }
}

void suite_chains(void)
{
    CU_pSuite suite = CU_add_suite("large chains with constraints", NULL, NULL);
    CU_add_test(suite, "accelerations and multipliers by their equations", test_equations);
    CU_add_test(suite, "all coefficients but one vanish", test_vanishing);
    CU_add_test(suite, "steps that enforce D end on D = 0", test_steps);
    CU_add_test(suite, "expressions in proportion to n", test_nodes);
    CU_add_test(suite, "operations in proportion to n", test_operations);
    CU_add_test(suite, "operations of a star", test_star);
    CU_add_test(suite, "workspaces in proportion to n", test_workspace);
    CU_add_test(suite, "memory of Newton's method where it may be used", test_size);
    CU_add_test(suite, "memory in proportion to n", test_growth);
    CU_add_test(suite, "memory that methods need", test_reserved);
}
