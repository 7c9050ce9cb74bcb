/* test_functions.c - what a system file defines for its own formulas: functions, sizes, indices. */
#include "fixtures.h"
#include "quick.h"
#include "reference.h"

#include <CUnit/Basic.h>
#include <dalembert_analysis.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define XY "coordinates: [x, y]\nparameters: {a: 0.7, b: 2}\n"

/* F at a point of two systems. */
static double field_difference(const char *one, const char *other)
{
    const double q[] = {0.3, -0.8}, v[] = {1.1, 0.4};
    double F[2][2];
    const char *const texts[] = {one, other};
    for (int k = 0; k < 2; k++) {
        reference b = reference_of_text(texts[k]);
        CU_ASSERT_EQUAL(reference_call(&b, b.system->call.field, 0.6, q, v, F[k]), DAL_STATUS_OK);
        reference_free(&b);
    }
    return fmax(fabs(F[0][0] - F[1][0]), fabs(F[0][1] - F[1][1]));
}

/* Every call means its formula: with numbers, parameters and functions as arguments, and with
 * arguments that have the names of parameters, of t or of coordinates. */
static void test_calls(void)
{
    static const char *const cases[][2] = {
        {"functions: {V(r): a*r^2}\nforces: {x: V(x) + V(2*y')*V(3)}",
         "forces: {x: a*x^2 + 4*a*y'^2*9*a}"},
        {"functions: {\"f(r, n)\": r^n/a}\nforces: {x: \"f(y, 3) + f(b, x)\"}",
         "forces: {x: y^3/a + b^x/a}"},
        {"functions: {\"f(a, t)\": a/t}\nforces: {x: \"f(x, y)*a + t\"}", "forces: {x: x/y*a + t}"},
        {"functions: {\"f(x, y)\": x - 2*y}\nforces: {x: \"f(y, x)\"}", "forces: {x: y - 2*x}"},
        {"functions: {f(r): sin(r), g(r): f(r)^2 + f(2*r)}\nlet: {c: g(x)}\nforces: {x: c*g(g(y))}",
         "let: {c: sin(x)^2 + sin(2*x), d: sin(y)^2 + sin(2*y)}\n"
         "forces: {x: c*(sin(d)^2 + sin(2*d))}"},
        {"functions: {max(r): r + 1}\nforces: {x: max(x)}", "forces: {x: x + 1}"},
        {"functions: {V(r): \"if(r > 0, sqrt(r), -r)\"}\nforces: {x: V(x) + V(y)}",
         "forces: {x: sqrt(x) - y}"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[2][512];
        for (int k = 0; k < 2; k++) {
            strcpy(text[k], XY "lagrangian: (x'^2 + y'^2)/2\n");
            strcat(strcat(text[k], cases[i][k]), "\n");
        }
        CU_ASSERT(field_difference(text[0], text[1]) < 4e-15);
    }
    CU_ASSERT(field_difference(XY "functions: {V(r): r^4 + a*r}\n"
                                  "lagrangian: (x'^2 + y'^2)/2 - V(x - y)\n",
                               XY "lagrangian: (x'^2 + y'^2)/2 - (x - y)^4 - a*(x - y)\n") < 4e-15);
    CU_ASSERT(field_difference(XY "functions: {V(r): r}\nlagrangian: (x'^2 + y'^2)/2 - V(x)\n",
                               XY "lagrangian: (x'^2 + y'^2)/2 - y\n") > 0.1);
}

/* A function that calls the one before it twice, many times over, stays small. */
static void test_nesting(void)
{
    char text[4096] = "coordinates: [x]\nlagrangian: x'^2/2\nfunctions:\n  f0(r): r/2\n", line[64];
    for (int i = 1; i < 60; i++) {
        snprintf(line, sizeof line, "  f%d(r): f%d(r)/2 + f%d(r)/2\n", i, i - 1, i - 1);
        strcat(text, line);
    }
    reference b = reference_of_text(strcat(text, "forces: {x: f59(x)}\n"));
    const double q = 3.0, v = 0.0;
    double F = 0.0;
    CU_ASSERT_EQUAL(reference_call(&b, b.system->call.field, 0.0, &q, &v, &F), DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(F, 1.5, 1e-15);
    reference_free(&b);
}

/* ---- sizes, indices, sums ---- */

/* What means many formulas, against the formulas written out. */
static void test_indices(void)
{
    static const char many[] =
        "sizes: {N: 2, M: N + 1}\ncoordinates: [\"u[1..N]\"]\n"
        "parameters: {\"k[i]\": {for: i = 1..M, is: i/2}, a: 3}\n"
        "let:\n  \"d[i]\": {for: i = 1..N, is: \"k[i]*u[i] + i\"}\n"
        "  s: sum(i, 1, N, sum(j, i, N, i*j*u[j]))\n"
        "lagrangian: sum(i, 1, N, u[i]'^2)/2 - sum(i, 2, 1, u[i]/0)\n"
        "forces:\n  \"u[i]\": \"for i = 1..N: -d[i]*u[M - i]' + (i == N)*(s + t)\"\n"
        "start: {\"u[N]\": a, \"u[1..N]'\": 0.5}\n";
    static const char written[] =
        "coordinates: [u1, u2]\nparameters: {k1: 0.5, k2: 1, k3: 1.5, a: 3}\n"
        "lagrangian: (u1'^2 + u2'^2)/2\n"
        "forces: {u1: -(k1*u1 + 1)*u2', u2: -(k2*u2 + 2)*u1' + t + u1 + 2*u2 + 4*u2}\n";
    CU_ASSERT(field_difference(many, written) < 1e-15);
    reference b = reference_of_text(many);
    CU_ASSERT(b.system->n == 2 && b.system->parameters == 4);
    CU_ASSERT_STRING_EQUAL(b.system->coordinate[1], "u2");
    CU_ASSERT_STRING_EQUAL(b.system->parameter[2], "k3");
    double start[5];
    CU_ASSERT_EQUAL(reference_call(&b, b.system->start, 0.0, NULL, NULL, start), DAL_STATUS_OK);
    CU_ASSERT(start[0] == 0.0 && start[1] == 3.0 && start[2] == 0.5 && start[3] == 0.5);
    reference_free(&b);
}

/* A system of a file of the examples, evaluated at its start moved by a pattern. */
typedef struct large {
    dal_model *model;
    const dal_system *system;
    dal_evaluator *evaluator;
    double start[2 * 303 + 1], F[303];
} large;

static large open_large(const char *path)
{
    large z = {.model = NULL};
    CU_ASSERT_FATAL(dal_model_read_file(&z.model, path, NULL) == DAL_STATUS_OK);
    CU_ASSERT_FATAL(dal_model_system(z.model, &z.system, NULL) == DAL_STATUS_OK);
    CU_ASSERT_FATAL(dal_evaluator_create(&z.evaluator, z.system, NULL, 0, NULL) == DAL_STATUS_OK);
    CU_ASSERT_FATAL(dal_evaluator_start(z.evaluator, NULL, 0, z.start, NULL) == DAL_STATUS_OK);
    return z;
}

static void evaluate_large(large *z)
{
    CU_ASSERT_EQUAL(dal_evaluator_call(z->evaluator, z->system->call.field, 0.0, z->start,
                                       z->start + z->system->n, NULL, z->F),
                    DAL_STATUS_OK);
}

static void close_large(large *z)
{
    dal_evaluator_free(z->evaluator);
    dal_model_free(z->model);
}

/* D_i = x' + y z' alone acts on link i: h = -(y' z' + b_x + y b_z)/(1 + y^2), b = -U_q. */
static void test_chain(void)
{
    enum { N = 101 };
    static const double eps = 0.1, kappa = 0.05;
    large z = open_large("examples/chain-of-101.yaml");
    CU_ASSERT(z.system->n == 3 * N && z.system->m == N);
    for (int i = 0; i < 6 * N; i++) z.start[i] += 0.3 * sin(1.0 + 2.0 * i);
    evaluate_large(&z);
    const double *x = z.start, *y = x + N, *q = y + N, *v = q + N;
    for (int i = 0; i < N; i++) {
        const double left = i > 0 ? x[i] - x[i - 1] : 0.0;
        const double right = i < N - 1 ? x[i + 1] - x[i] : 0.0;
        const double bx = -x[i] * (1 + eps * q[i] * q[i]) - kappa * (left - right);
        const double bz = -q[i] * (1 + eps * x[i] * x[i]);
        const double h = -(v[N + i] * v[2 * N + i] + bx + y[i] * bz) / (1 + y[i] * y[i]);
        CU_ASSERT_DOUBLE_EQUAL(z.F[i], bx + h, 1e-14);
        CU_ASSERT_DOUBLE_EQUAL(z.F[N + i], -y[i], 1e-15);
        CU_ASSERT_DOUBLE_EQUAL(z.F[2 * N + i], bz + y[i] * h, 1e-14);
    }
    close_large(&z);
}

static double pair_force(double r) { return 24 * (2 * pow(r, -13) - pow(r, -7)); }

/* Every corner of an icosahedron of radius r has five neighbours at the edge a, five at the golden
 * ratio times a, and one at 2r; the force on it is along r. */
static void test_cluster(void)
{
    enum { N = 12 };
    large z = open_large("examples/lennard-jones-12.yaml");
    CU_ASSERT(z.system->n == 3 * N && z.system->m == 0);
    evaluate_large(&z);
    const double r = 1.1, golden = (1 + sqrt(5.0)) / 2, a = r / sin(2 * acos(-1.0) / 5);
    const double outwards = 5 * pair_force(a) * a / (2 * r) +
                            5 * pair_force(golden * a) * golden * a / (2 * r) + pair_force(2 * r);
    for (int i = 0; i < N; i++) {
        const double *q = z.start + i, *F = z.F + i;
        CU_ASSERT_DOUBLE_EQUAL(hypot(hypot(q[0], q[N]), q[2 * N]), r, 1e-14);
        for (int k = 0; k < 3; k++)
            CU_ASSERT_DOUBLE_EQUAL(F[k * N], outwards * q[k * N] / r, 1e-12 * fabs(outwards));
    }
    close_large(&z);
}

static reference reference_of_size(int size, const char *text)
{
    char sized[1024];
    snprintf(sized, sizeof sized, "sizes: {N: %d}\n%s", size, text);
    return reference_of_text(sized);
}

/* The equations of 1,023 coordinates that few springs couple, in a fraction of a minute. */
static void test_thousand(void)
{
    enum { N = 1023 };
    static const char text[] =
        "coordinates: [\"x[1..N]\"]\n"
        "lagrangian: sum(i, 1, N, x[i]'^2)/2 - sum(i, 2, N, (x[i] - x[i-1])^4)\n"
        "start: {\"x[i]\": {for: i = 1..N, is: i^2/N}}\n";
    const int n = large_size(N);
    double F[N], q[N], v[N] = {0.0};
    reference b = reference_of_size(n, text);
    for (int i = 0; i < n; i++) q[i] = 0.1 * i * i;
    CU_ASSERT_EQUAL(reference_call(&b, b.system->call.field, 0.0, q, v, F), DAL_STATUS_OK);
    for (int i = 1; i < n - 1; i++) {
        const double left = q[i] - q[i - 1], right = q[i + 1] - q[i];
        const double expected = 4 * (right * right * right - left * left * left);
        CU_ASSERT_DOUBLE_EQUAL(F[i], expected, 1e-12 * fabs(expected));
    }
    reference_free(&b);
}

/* W of 512 pairs, 2 on the diagonal and cos(x)/4, of the first x, beside it: W F must be b, which
 * at rest is -U_q = -x. */
static void test_sparse(void)
{
    enum { N = 1024 };
    static const char text[] = "coordinates: [\"x[1..N]\"]\n"
                               "lagrangian: sum(i, 1, N, x[i]'^2 - x[i]^2/2) + sum(i, 1, N/2, "
                               "cos(x[2*i-1])*x[2*i-1]'*x[2*i]')/4\n"
                               "start: {\"x[i]\": {for: i = 1..N, is: i/N}}\n";
    const int n = large_size(N);
    double F[N], q[N], v[N] = {0.0};
    reference b = reference_of_size(n, text);
    for (int i = 0; i < n; i++) q[i] = sin(1.0 + i);
    CU_ASSERT_EQUAL(reference_call(&b, b.system->call.field, 0.0, q, v, F), DAL_STATUS_OK);
    for (int i = 0; i < n; i++) {
        const int first = i / 2 * 2, other = 2 * first + 1 - i;
        CU_ASSERT_DOUBLE_EQUAL(2 * F[i] + cos(q[first]) / 4 * F[other], -q[i], 1e-14);
    }
    reference_free(&b);
}

/* Equations whose elimination would take all memory are refused before: a full mass matrix, one of
 * a cube of 10^3 particles that neighbours couple, which the elimination fills, and a full one of
 * vakonomic motion. */
static void test_dense(void)
{
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"sizes: {N: 300}\ncoordinates: [\"x[1..N]\"]\n"
         "lagrangian: sum(i, 1, N, x[i]'^2)/2 + sum(i, 1, N, x[i]*x[i]')^2\n",
         "the mass matrix of 300 coordinates couples too many of them"},
        {"sizes: {N: 10, M: N^3}\ncoordinates: [\"x[1..M]\"]\n"
         "lagrangian: >\n  sum(i, 1, M, 3*x[i]'^2) + sum(i, 1, M-1, cos(x[i])*x[i]'*x[i+1]')\n"
         "  + sum(i, 1, M-N, cos(x[i])*x[i]'*x[i+N]')\n"
         "  + sum(i, 1, M-N^2, cos(x[i])*x[i]'*x[i+N^2]')\n",
         "the mass matrix of 1000 coordinates couples too many of them"},
        {"sizes: {N: 300}\nmechanics: vakonomic\ncoordinates: [\"x[1..N]\"]\n"
         "lagrangian: sum(i, 1, N, x[i]'^2)/2 + sum(i, 1, N, x[i]*x[i]')^2\n"
         "constraints: [\"x[1]' - x[2]'\"]\n",
         "the equations of the system are too large"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i += (size_t)case_stride(2)) {
        dal_error error;
        dal_model *model = NULL;
        const dal_system *system;
        const size_t length = strlen(cases[i].text);
        CU_ASSERT_EQUAL_FATAL(dal_model_read(&model, "dense", cases[i].text, length, NULL),
                              DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_model_system(model, &system, &error), DAL_STATUS_TOO_LARGE);
        CU_ASSERT_STRING_EQUAL(error.message, cases[i].message);
        dal_model_free(model);
    }
}

/* A constraint with more denominators than a run can check. */
static void test_guards(void)
{
    static const char text[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                               "constraints: [\"y' - sum(i, 1, 4097, x'/(x + i))\"]\n";
    dal_model *model = fixture_model(text);
    const dal_system *system;
    dal_error error = {0};
    CU_ASSERT_EQUAL(dal_model_system(model, &system, &error), DAL_STATUS_TOO_LARGE);
    CU_ASSERT_STRING_EQUAL(error.message, "the equations of the system are too large");
    dal_model_free(model);
}

void suite_functions(void)
{
    CU_pSuite suite = CU_add_suite("functions", NULL, NULL);
    CU_add_test(suite, "calls", test_calls);
    CU_add_test(suite, "calls of calls", test_nesting);
    CU_add_test(suite, "indices against formulas written out", test_indices);
    CU_add_test(suite, "a chain of 101 links", test_chain);
    CU_add_test(suite, "a cluster of 12 particles", test_cluster);
    CU_add_test(suite, "a thousand coordinates", test_thousand);
    CU_add_test(suite, "a sparse mass matrix", test_sparse);
    CU_add_test(suite, "equations that are too dense", test_dense);
    CU_add_test(suite, "too many denominators", test_guards);
}
