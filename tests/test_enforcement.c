/* test_enforcement.c - what enforces D at a velocity, by the factors of F: its equations by the
 * blocks a, A, R of the same system, methods without it, and gni, which begins a step with what the
 * last one ended with. */
#include "expr/tape.h"
#include "fixtures.h"
#include "model/programs.h"
#include "run/run.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Rounding of the terms of an equation, over the largest of them. */
static const double SAME = 1e-12;

static const char *const texts[] = {
    fixture_full,         fixture_gentle, fixture_bilinear,
    fixture_quadratic,    "snakeboard",   "chaplygin-sleigh",
    "falling-disk",       "roller-racer", "chaplygin-sleigh-nonlinear",
    "chaotic-oscillators"};
enum { TEXTS = sizeof texts / sizeof *texts };

/* ---- at points ---- */

enum { MAX_N = 16, MAX_M = 8 };

/* The largest residual of y = beta a + R l, A y = A pi + c, and of y = beta a + R l for given l,
 * over their terms; pi[n + m + 1] is pi, c and beta. */
static double residual(const dal_system *system, double t, const double *q, const double *v,
                       double *pi)
{
    const int n = system->n, m = system->m;
    const double beta = pi[n + m];
    double blocks[2 * (MAX_M + MAX_M * MAX_N) + MAX_N], out[MAX_N + MAX_M], D[MAX_M], z[MAX_N];
    double worst = 0.0, size = 0.0;
    dal_evaluator *evaluator = fixture_evaluator(system);
    CU_ASSERT_FATAL(n <= MAX_N && m <= MAX_M);
    const double *A = blocks + m, *R = A + m * n, *a = R + m * n, *y = out;
    double *l = out + n;
    CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, system->call.blocks, t, q, v, NULL, blocks),
                    DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, system->call.enforcement, t, q, v, pi, out),
                    DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, system->call.constraint_value, t, q, v, NULL, D),
                    DAL_STATUS_OK);
    l[m] = beta;
    CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, system->call.reaction, t, q, v, l, z),
                    DAL_STATUS_OK);
    for (int b = 0; b < m; b++) CU_ASSERT_EQUAL(D[b], blocks[b]);
    for (int i = 0; i < n; i++) {
        double sum = beta * a[i];
        size = fmax(size, fabs(sum));
        for (int b = 0; b < m; b++) {
            sum += R[i * m + b] * l[b];
            size = fmax(size, fabs(R[i * m + b] * l[b]));
        }
        worst = fmax(worst, fmax(fabs(sum - y[i]), fabs(sum - z[i])));
    }
    for (int b = 0; b < m; b++) {
        double sum = pi[n + b];
        for (int i = 0; i < n; i++) {
            sum += A[b * n + i] * (pi[i] - y[i]);
            size = fmax(size, fabs(A[b * n + i]) * (fabs(y[i]) + fabs(pi[i])));
        }
        worst = fmax(worst, fabs(sum));
    }
    dal_evaluator_free(evaluator);
    CU_ASSERT(size > 0.0);
    return worst / size;
}

static void test_equations(void)
{
    enum { POINTS = 4 };
    for (int j = 0; j < TEXTS; j++) {
        const dal_system *system = fixture_system(texts[j]);
        const dal_run_spec spec = fixture_spec(system, "rk4", DAL_PHYSICAL, 0.1);
        dal_run *run = fixture_run(&spec);
        const int n = system->n;
        CU_ASSERT_PTR_NOT_NULL_FATAL(system->call.enforcement);
        for (int p = 0; p < POINTS; p++) {
            double y[2 * MAX_N], pi[MAX_N + MAX_M + 1];
            for (int i = 0; i < 2 * n; i++)
                y[i] = dal_run_state(run)[i] + 0.1 * sin(1.0 + 3.0 * i + 7.0 * p);
            for (int i = 0; i < n + system->m; i++) pi[i] = cos(2.0 * i + p);
            pi[n + system->m] = p % 2 == 0 ? 1.0 : 0.0;
            const double error = residual(system, 0.1 * p, y, y + n, pi);
            if (!(error <= SAME)) printf("\n  %d: %.2g\n", j, error);
            CU_ASSERT(error <= SAME);
        }
        dal_run_free(run);
    }
}

/* W = diag(1, 4), D = x' - y', b = (2, 0): l = 4/5 (pi_x - pi_y + c - 2 beta). */
static void test_closed_form(void)
{
    const dal_system *system = fixture_system("coordinates: [x, y]\n"
                                              "lagrangian: x'^2/2 + 2*y'^2 + 2*x\n"
                                              "constraints: [x' - y']\n");
    const double q[] = {0.3, 0.7}, v[] = {2.0, 0.75};
    const double pi[][4] = {{0.5, -0.75, 0.25, 1.0}, {0.5, -0.75, 0.25, 0.0}};
    const double enforced[][3] = {{1.6, 0.1, -0.4}, {1.2, -0.3, 1.2}};
    const double l[] = {0.8, 0.5}, reaction[] = {1.8, -0.2};
    double out[3];
    dal_evaluator *evaluator = fixture_evaluator(system);
    for (int k = 0; k < 2; k++) {
        CU_ASSERT_EQUAL(
            dal_evaluator_call(evaluator, system->call.enforcement, 0.0, q, v, pi[k], out),
            DAL_STATUS_OK);
        for (int i = 0; i < 3; i++) CU_ASSERT_DOUBLE_EQUAL(out[i], enforced[k][i], 1e-15);
    }
    CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, system->call.reaction, 0.0, q, v, l, out),
                    DAL_STATUS_OK);
    for (int i = 0; i < 2; i++) CU_ASSERT_DOUBLE_EQUAL(out[i], reaction[i], 1e-15);
    CU_ASSERT_EQUAL(
        dal_evaluator_call(evaluator, system->call.constraint_value, 0.0, q, v, NULL, out),
        DAL_STATUS_OK);
    CU_ASSERT_EQUAL(out[0], 1.25);
    dal_evaluator_free(evaluator);
}

/* ---- methods ---- */

static double distance(const dal_run *a, const dal_run *b)
{
    double max = 0.0;
    for (int i = 0; i < dal_run_dimension(a); i++)
        max = fmax(max, fabs(dal_run_state(a)[i] - dal_run_state(b)[i]));
    return max;
}

/* Without the callbacks methods have the blocks, and modifiers the constraint. */
static void test_without(void)
{
    static const char *const methods[] = {"gni",
                                          "spark4",
                                          "gauss-spark4",
                                          "lobatto-nonholonomic4",
                                          "gauss4+symmetric-project",
                                          "rk4+project-energy"};
    enum { METHODS = sizeof methods / sizeof *methods };
    for (int j = 0; j < TEXTS * METHODS; j++) {
        dal_method method;
        dal_system other = *fixture_system(texts[j % TEXTS]);
        const bool by_constraint = strchr(methods[j / TEXTS], '+');
        CU_ASSERT_EQUAL_FATAL(dal_method_parse(&method, methods[j / TEXTS], NULL), DAL_STATUS_OK);
        if (!fixture_accepts(&method, &other, DAL_PHYSICAL)) continue;
        const dal_run_spec spec = fixture_spec(&other, methods[j / TEXTS], DAL_PHYSICAL, 0.01);
        dal_run *with = fixture_stepped(&spec, 20);
        other.call.enforcement = other.call.reaction = other.call.constraint_value = NULL;
        if (by_constraint) other.call.blocks = other.call.correction = NULL;
        dal_run *without = fixture_stepped(&spec, 20);
        const double error = distance(with, without);
        if (!(error <= SAME)) printf("\n  %s, %d: %.2g\n", methods[j / TEXTS], j % TEXTS, error);
        CU_ASSERT(error <= SAME);
        dal_run_free(with);
        dal_run_free(without);
    }
}

/* Steps of which each begins with the multipliers of the last, and evaluates a and B there. */
static void test_forgotten(void)
{
    static const char *const methods[] = {"gni", "gni+yoshida4", "gni+project-energy",
                                          "gni+symmetric-project"};
    enum { STEPS = 20, METHODS = sizeof methods / sizeof *methods };
    for (int j = 0; j < TEXTS * METHODS; j++) {
        dal_method method;
        const dal_system *system = fixture_system(texts[j % TEXTS]);
        CU_ASSERT_EQUAL_FATAL(dal_method_parse(&method, methods[j / TEXTS], NULL), DAL_STATUS_OK);
        if (!fixture_accepts(&method, system, DAL_PHYSICAL)) continue;
        const dal_run_spec spec = fixture_spec(system, methods[j / TEXTS], DAL_PHYSICAL, 0.01);
        dal_run *run = fixture_run(&spec), *other = fixture_run(&spec);
        const size_t has = dal__at(&run->layout, DAL__CLOCK_SIZE) + 3 + (size_t)system->m;
        for (int i = 0; i < STEPS; i++) {
            size_t count;
            CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
            CU_ASSERT_EQUAL(dal_run_step(other, NULL), DAL_STATUS_OK);
            const double *saved = dal_run_save(other, &count);
            double *numbers = malloc(count * sizeof *numbers);
            CU_ASSERT_PTR_NOT_NULL_FATAL(numbers);
            memcpy(numbers, saved, count * sizeof *numbers);
            CU_ASSERT_EQUAL(numbers[has], 1.0);
            numbers[has] = 0.0;
            CU_ASSERT_EQUAL(dal_run_restore(other, numbers, count, NULL), DAL_STATUS_OK);
            free(numbers);
        }
        const double error = distance(run, other);
        if (!(error <= SAME)) printf("\n  %d: %.2g\n", j, error);
        CU_ASSERT(error <= SAME);
        dal_run_free(run);
        dal_run_free(other);
    }
}

/* Where forces depend on q alone a step has one evaluation, the first two; a changed parameter
 * leaves nothing to begin with. */
static void test_evaluations(void)
{
    const dal_system *system = fixture_system("chaotic-oscillators");
    const dal_run_spec spec = fixture_spec(system, "gni", DAL_PHYSICAL, 0.01);
    dal_run *run = fixture_stepped(&spec, 10);
    CU_ASSERT_EQUAL(dal_run_evaluations(run), 11);
    CU_ASSERT_EQUAL(dal_run_set_parameter(run, system->parameter[0], 1.5 * system->value[0], NULL),
                    DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_step(run, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_evaluations(run), 13);
    dal_run_free(run);
}

/* x'' = -sign(x), x(0) = 1: beyond x = 0, passed at t = sqrt(2) with the speed sqrt(2), a step does
 * not begin with the force before it. */
static void test_jump(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system("coordinates: [x]\nlagrangian: x'^2/2\nforces: {x: -sign(x)}\n"
                                    "start: {x: 1}\nevents: [{when: x}]\n"),
                     "gni", DAL_PHYSICAL, 0.1);
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_EQUAL(fixture_events(run, 2.5, NULL, NULL, NULL), DAL_STATUS_OK);
    const double after = dal_run_time(run) - sqrt(2.0);
    CU_ASSERT_EQUAL(dal_run_event_count(run, 0), 1);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[0], after * (0.5 * after - sqrt(2.0)), SAME);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[1], after - sqrt(2.0), SAME);
    dal_run_free(run);
}

static void test_lanes(void)
{
    dal_run_spec spec = fixture_spec(fixture_system(fixture_full), "gni", DAL_PHYSICAL, 0.05);
    spec.options.consistent = true;
    fixture_lanes(spec, 11, 20, spec.system->coordinate[0], 0.1, 0.05);
}

/* ---- many constraints ---- */

/* A particle under a potential, with D linear or homogeneous in v, and copies of it that do not
 * see each other. */
typedef struct particle {
    const char *constraint, *potential; /* of copy i */
    bool is_linear;
} particle;

static const particle particles[] = {
    {"z[i]' - y[i]*x[i]'", "x[i]^2 + z[i]^2*y[i]^2", true},
    {"z[i]'^2*(1 + x[i]^2) - x[i]'^2 - y[i]'^2", "x[i]^2 + z[i]*y[i]^2", false}};

/* Copies first to last, stepped; y[6] gets q and v of the last one. */
static void step_copies(const particle *p, const char *method, int first, int last, double *y)
{
    enum { STEPS = 10, MAX_COPIES = 16, EACH = 6 };
    static char text[1024], name[EACH * MAX_COPIES][8];
    dal_setting start[EACH * MAX_COPIES];
    const int count = last - first + 1, end = count - 1;
    snprintf(text, sizeof text,
             "coordinates: ['x[0..%d]', 'y[0..%d]', 'z[0..%d]']\n"
             "lagrangian: sum(i, 0, %d, x[i]'^2 + 2*y[i]'^2 + z[i]'^2 - (%s))/2\n"
             "constraints: [{for: i = 0..%d, is: \"%s\"}]\n",
             end, end, end, end, p->potential, end, p->constraint);
    for (int k = 0; k < EACH * count; k++) {
        const int i = k / EACH, j = k % EACH;
        const double a = 0.3 + 0.05 * (first + i), u = 0.8, w = 0.4 - 0.02 * (first + i);
        const double speed = p->is_linear ? a * u : sqrt((u * u + w * w) / (1.0 + a * a));
        const double value[EACH] = {a, a, 0.5 * a, u, w, speed};
        snprintf(name[k], sizeof name[k], "%c%d%s", "xyz"[j % 3], i, j < 3 ? "" : "'");
        start[k] = (dal_setting){name[k], value[j]};
    }
    dal_run_spec spec = fixture_spec(fixture_system(text), method, DAL_PHYSICAL, 0.05);
    spec.start = start;
    spec.start_count = EACH * count;
    dal_run *run = fixture_stepped(&spec, STEPS);
    for (int j = 0; j < EACH; j++)
        y[j] = dal_run_state(run)[j / 3 * 3 * count + j % 3 * count + end];
    dal_run_free(run);
}

/* Sixteen constraints are enforced by the factors of F, one by a matrix. */
static void test_many(void)
{
    static const char *const methods[] = {"mclachlan-perlmutter", "dla", "discrete-gradient"};
    enum { METHODS = sizeof methods / sizeof *methods, LAST = 15 };
    for (int j = 0; j < 2 * METHODS; j++) {
        double all[6], one[6], error = 0.0;
        step_copies(&particles[j % 2], methods[j / 2], 0, LAST, all);
        step_copies(&particles[j % 2], methods[j / 2], LAST, LAST, one);
        for (int i = 0; i < 6; i++) error = fmax(error, fabs(all[i] - one[i]));
        if (!(error <= SAME)) printf("\n  %s, %d: %.2g\n", methods[j / 2], j % 2, error);
        CU_ASSERT(error <= SAME);
    }
}

/* ---- large systems ---- */

/* A chain of n springs with n/4 constraints whose Jacobian varies, as in bench/dal.c. */
static int chain_operations(int n)
{
    static char text[1 << 14];
    size_t at = (size_t)snprintf(text, sizeof text, "coordinates: [x0");
#define ADD(...) at += (size_t)snprintf(text + at, sizeof text - at, __VA_ARGS__)
    for (int i = 1; i < n; i++) ADD(", x%d", i);
    ADD("]\nlagrangian: (x0'^2");
    for (int i = 1; i < n; i++) ADD(" + x%d'^2 - (x%d - x%d)^2", i, i, i - 1);
    ADD(")/2\nconstraints:\n");
    for (int i = 0; i < n; i += 4)
        ADD("  - x%d'*cos(x%d) + x%d'*sin(x%d) - x%d'*x%d\n", i, i + 2, i + 1, i + 2, (i + 4) % n,
            i + 3);
#undef ADD
    CU_ASSERT_FATAL(at < sizeof text);
    const dal__programs *p = dal__programs_of(fixture_system(text));
    const dal__program *program = &p->program[DAL__PROGRAM_ENFORCEMENT];
    return dal__tape_operations(&p->tapes->tape[program->tape]);
}

/* Constraints that couple neighbours: twice the size is twice the work. */
static void test_growth(void)
{
    const int small = chain_operations(16), middle = chain_operations(32),
              large = chain_operations(64);
    CU_ASSERT(large - middle <= 2 * (middle - small) + small / 8);
}

void suite_enforcement(void)
{
    CU_pSuite suite = CU_add_suite("enforcement of D", NULL, NULL);
    CU_add_test(suite, "equations, by the blocks", test_equations);
    CU_add_test(suite, "closed form", test_closed_form);
    CU_add_test(suite, "methods without the callbacks", test_without);
    CU_add_test(suite, "gni with nothing kept of the last step", test_forgotten);
    CU_add_test(suite, "evaluations of gni", test_evaluations);
    CU_add_test(suite, "gni where the force jumps", test_jump);
    CU_add_test(suite, "lanes", test_lanes);
    CU_add_test(suite, "many constraints as one", test_many);
    CU_add_test(suite, "operations of a chain", test_growth);
}
