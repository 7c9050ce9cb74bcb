/* test_motion.c - F against other ways to it: by W^-1 alone, and reduced by hand; and the passes
 * that write it in few operations. */
#include "allocation.h"
#include "expr/angles.h"
#include "expr/collect.h"
#include "formula.h"
#include "model/programs.h"
#include "reference.h"

#include <CUnit/CUnit.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { POINTS = 20 };

/* Numbers between -1 and 1 of no particular kind. */
static double irregular(int number) { return sin(1.0 + 12.9898 * number); }

static void set_point(int n, int number, double *q, double *v)
{
    for (int i = 0; i < n; i++) {
        q[i] = 0.8 + 0.7 * irregular(2 * (number * n + i));
        v[i] = irregular(2 * (number * n + i) + 1);
    }
}

/* ---- by W^-1 alone ---- */

/* F = a + R h with (A R) h = -(c + A a) from the blocks D, A, R = W^-1 B^T, a = W^-1 b, c; h[m]. */
static void motion_of_blocks(int n, int m, const double *blocks, double *F, double *h)
{
    const double *jacobian = blocks + m, *R = jacobian + m * n, *a = R + m * n, *c = a + n;
    double s[REFERENCE_MAX * (REFERENCE_MAX + 1)];
    for (int k = 0; k < m; k++) {
        s[k * (m + 1) + m] = -c[k];
        for (int i = 0; i < n; i++) s[k * (m + 1) + m] -= jacobian[k * n + i] * a[i];
        for (int l = 0; l < m; l++) {
            s[k * (m + 1) + l] = 0.0;
            for (int i = 0; i < n; i++) s[k * (m + 1) + l] += jacobian[k * n + i] * R[i * m + l];
        }
    }
    reference_solve(m, s);
    for (int k = 0; k < m; k++) h[k] = s[k * (m + 1) + m];
    for (int i = 0; i < n; i++) {
        F[i] = a[i];
        for (int k = 0; k < m; k++) F[i] += R[i * m + k] * h[k];
    }
}

/* tolerance: some 1e-14 times the condition of A W^-1 A^T at the worst of the points. */
static void compare_blocks(const reference *b, const char *name, double tolerance)
{
    const int n = b->system->n, m = b->system->m;
    double q[REFERENCE_MAX], v[REFERENCE_MAX], blocks[REFERENCE_OUT], F[2][REFERENCE_MAX];
    double h[REFERENCE_MAX], reactions[REFERENCE_OUT];
    for (int number = 0; number < POINTS; number++) {
        set_point(n, number, q, v);
        if (reference_call(b, b->system->call.blocks, 0.3, q, v, blocks) != DAL_STATUS_OK) continue;
        reference_call(b, b->system->call.field, 0.3, q, v, F[0]);
        motion_of_blocks(n, m, blocks, F[1], h);
        const double distance = reference_distance(n, F[0], F[1]);
        CU_ASSERT(!(distance > tolerance));
        if (distance > tolerance) fprintf(stderr, "%s, point %d: %g\n", name, number, distance);
        if (!b->system->reactions) continue;
        reference_call(b, b->system->reactions, 0.3, q, v, reactions);
        CU_ASSERT(!(reference_distance(m, reactions, h) > tolerance));
    }
}

static void test_builtins_by_blocks(void)
{
    for (int i = 0; dal_builtin_name(i); i++) {
        reference b = reference_builtin(dal_builtin_name(i));
        if (b.system->call.blocks && b.system->n <= REFERENCE_MAX)
            compare_blocks(&b, dal_builtin_name(i), 1e-9);
        reference_free(&b);
    }
}

/* Two constraints that are solved for x and y, which W couples with each other and with the rest,
 * and one that is left; then two that are paired. */
static const char *const coupled[] = {
    "coordinates: [x, y, z, u, w]\n"
    "parameters: {k: 0.3}\n"
    "lagrangian: (x'^2 + 2*y'^2 + 3*z'^2 + 2*u'^2 + w'^2)/2 + k*x'*y' + k*cos(z)*x'*u'\n"
    "     + k*sin(u)*y'*z' + k*sin(w)*z'*w' + k*x'*w' - cos(z) - x*w\n"
    "forces: {u: -u', x: cos(t)}\n"
    "constraints:\n"
    "  - 2*x' - sin(z)*z' + cos(u)*w' - k\n"
    "  - 3*y' + sin(z)*cos(w)*u' + k*x\n"
    "  - z' + w*u' + z*w'\n",
    "coordinates: [x, y, z, u]\n"
    "lagrangian: (x'^2 + y'^2 + z'^2 + u'^2)/2 + cos(x)\n"
    "constraints:\n"
    "  - cos(z + u)*x' + sin(z + u)*y' - z'\n"
    "  - cos(z - u)*x' + sin(z - u)*y' + z' + 0.3*u'\n",
};

static void test_coupled_by_blocks(void)
{
    for (size_t i = 0; i < sizeof coupled / sizeof *coupled; i++) {
        reference b = reference_of_text(coupled[i]);
        compare_blocks(&b, "coupled", 1e-12);
        reference_free(&b);
    }
}

/* ---- reduced by hand ---- */

/* Off D = 0, too: D is an integral of F on every level. */
static void compare_by_hand(const char *name, const char *path, double ratio)
{
    reference derived = reference_builtin(name), hand = {.model = NULL};
    CU_ASSERT_FATAL(dal_model_read_file(&hand.model, path, NULL) == DAL_STATUS_OK);
    CU_ASSERT_FATAL(dal_model_system(hand.model, &hand.system, NULL) == DAL_STATUS_OK);
    double q[REFERENCE_MAX], v[REFERENCE_MAX], F[2][REFERENCE_MAX], work[512] = {0};
    const dal_point at = {.t = 0.0, .q = q, .v = v, .work = work};
    CU_ASSERT_FATAL(hand.system->workspace <= 512);
    for (int i = 0; i < hand.system->parameters; i++) work[i] = hand.system->value[i];
    hand.system->prepare(hand.system, &at, NULL);
    for (int number = 0; number < POINTS; number++) {
        set_point(hand.system->n, number, q, v);
        reference_call(&derived, derived.system->call.field, 0.0, q, v, F[0]);
        hand.system->call.field(hand.system, &at, F[1]);
        CU_ASSERT(reference_distance(hand.system->n, F[0], F[1]) < 1e-13);
    }
    const dal__programs *x = dal__programs_of(derived.system), *y = dal__programs_of(hand.system);
    const dal__program *fx = &x->program[DAL__PROGRAM_FIELD];
    dal__graph *graph = x->equations->graph;
    const dal__tape *tape = &x->tapes->tape[fx->tape];
    const int cost = dal__cost(graph, tape->output, tape->outputs);
    const int by_hand = dal__cost(y->equations->graph, y->equations->F, hand.system->n);
    CU_ASSERT(cost <= ratio * by_hand);
    if (cost > ratio * by_hand) fprintf(stderr, "%s: %d, by hand %d\n", name, cost, by_hand);
    dal_model_free(hand.model);
    reference_free(&derived);
}

static void test_by_hand(void)
{
    compare_by_hand("falling-disk", "bench/systems/disk_by_hand.yaml", 1.15);
    compare_by_hand("snakeboard", "bench/systems/snakeboard_by_hand.yaml", 1.15);
}

/* ---- few operations ---- */

static const double point[SYMBOLS] = {1.3, -0.7, 0.3, 2.5, -1.25, 0.75, 4.0, -3.5};

/* A sum, and what it is when collected. */
static const char *const collected[][2] = {
    {"sin(x)*(a*sin(x) + b*cos(x)) + cos(x)*(a*cos(x) - b*sin(x))", "a"},
    {"(x*sin(y) + z*cos(y))^2 + (x*cos(y) - z*sin(y))^2", "x*x + z*z"},
    {"(x*sin(y) + z*cos(y))*x*sin(y) + x^2*cos(y)^2", "x*(x + z*sin(y)*cos(y))"},
    {"x*(y + z) - y*x", "x*z"},
    {"a*x*(y - z) + z*a*x - a*x*y", "0"},
    {"x'*y'*z + x'*y'*x + x'*x*z", "x'*(y'*(x + z) + x*z)"},
    {"x*z*y + x*z*x' + z*y' + x*(y + x') - x*y - x*x'", "z*(x*(y + x') + y')"},
    {"sin(x)^2*y + cos(x)^2*z", "sin(x)^2*y + cos(x)^2*z"},
    {"(x + y)*(x - y)", "(x + y)*(x - y)"},
};

static void test_collect(void)
{
    dal__graph *graph = formula_graph();
    for (size_t i = 0; i < sizeof collected / sizeof *collected; i++) {
        const dal__node given = formula_node(graph, collected[i][0]);
        const dal__node expected = formula_node(graph, collected[i][1]);
        const dal__node node = dal__collect(graph, given);
        const double x = dal__evaluate(graph, node, point);
        CU_ASSERT(dal__cost(graph, &node, 1) <= dal__cost(graph, &expected, 1));
        CU_ASSERT(fabs(x - dal__evaluate(graph, given, point)) <= 1e-13 * fmax(1.0, fabs(x)));
    }
    dal__graph_free(graph);
}

/* Without memory it is not known how few operations are needed. */
static void test_cost_memory(void)
{
    dal__graph *graph = formula_graph();
    const dal__node node = formula_node(graph, "x + y");
    CU_ASSERT_EQUAL(dal__cost(graph, &node, 1), 1);
    allocation_fail_after(0);
    const int cost = dal__cost(graph, &node, 1);
    allocation_fail_after(-1);
    CU_ASSERT_EQUAL(cost, INT_MAX);
    dal__graph_free(graph);
}

/* Sums of angles are expanded where there are more of them than angles. */
static void test_expand_angles(void)
{
    dal__graph *graph = formula_graph();
    dal__node few[] = {formula_node(graph, "sin(x + y)"), formula_node(graph, "cos(z)")};
    const dal__node kept = few[0];
    dal__expand_angles(graph, few, 2);
    CU_ASSERT_EQUAL(few[0], kept);
    dal__node many[] = {formula_node(graph, "sin(x + y) + cos(x)"),
                        formula_node(graph, "cos(x - y - z)*sin(y) + cos(z + (x - y))"),
                        formula_node(graph, "sin(z - y) + cos(z - x)*cos(z + y)")};
    const int cost = dal__cost(graph, many, 3);
    double before[3];
    for (int i = 0; i < 3; i++) before[i] = dal__evaluate(graph, many[i], point);
    dal__expand_angles(graph, many, 3);
    CU_ASSERT(dal__cost(graph, many, 3) < cost);
    for (int i = 0; i < 3; i++)
        CU_ASSERT_DOUBLE_EQUAL(dal__evaluate(graph, many[i], point), before[i], 1e-15);
    dal__graph_free(graph);
}

void suite_motion(void)
{
    CU_pSuite suite = CU_add_suite("motion", NULL, NULL);
    CU_add_test(suite, "built-in systems by W^-1 alone", test_builtins_by_blocks);
    CU_add_test(suite, "coupled masses by W^-1 alone", test_coupled_by_blocks);
    CU_add_test(suite, "reduced by hand", test_by_hand);
    CU_add_test(suite, "sums in few operations", test_collect);
    CU_add_test(suite, "operations without memory", test_cost_memory);
    CU_add_test(suite, "sines of sums", test_expand_angles);
}
