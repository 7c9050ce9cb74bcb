/* test_tape.c - tapes: the bits of dal__evaluate at every width, in as few instructions as can be.
 */
#include "allocation.h"
#include "formula.h"

#include <CUnit/Basic.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

typedef void runner(const dal__tapes *tapes, int program, double *work, double *out);
static const struct {
    int lanes;
    dal__instructions set;
    runner *run;
} variants[] = {
#define X(name, variant, lanes, set) {lanes, DAL__##set, name##_##variant},
    X(dal__tape_run, x1, 1, BASE) DAL__VARIANT_LIST(X, dal__tape_run)
#undef X
};
enum { VARIANTS = sizeof variants / sizeof variants[0] };

static bool same_bits(double x, double y)
{
    return memcmp(&x, &y, sizeof x) == 0 || (isnan(x) && isnan(y));
}

/* Every operation, and sums and products in all their combinations. */
static const char *const formulas[] = {
    "x",
    "a",
    "3",
    "a + b",
    "-x",
    "x + y",
    "x - y",
    "x*y",
    "x/y",
    "x^y",
    "x/a",
    "x/3",
    "sqrt(x)",
    "exp(x)",
    "log(x)",
    "sin(x)",
    "cos(x)",
    "sin(y)",
    "cos(z)",
    "tan(x)",
    "asin(x)",
    "acos(x)",
    "atan(x)",
    "atan2(x, y)",
    "sinh(x)",
    "cosh(x)",
    "tanh(x)",
    "asinh(x)",
    "abs(x)",
    "x*y + z",
    "x*y - z",
    "z - x*y",
    "x*y + z*x'",
    "x*y - x'*z",
    "x*x + x",
    "x - x*x",
    "x*sin(y) + y*cos(y)",
    "sin(x*y) + exp(x*y)*z + tanh(x*y)*cos(x*y)",
    "cos(z')*sin(z')",
    "exp(a)*x + log(3*a)*y",
    "(x + y)*(x - y)/(z + 2)",
    "sign(x)",
    "floor(x*y)",
    "min(x, y, z)",
    "max(x, y, z)",
    "hypot(x, y)",
    "x < y",
    "x >= y",
    "x == y",
    "x != y",
    "if(x < y, z, x')",
    "if(x, log(y), sqrt(z))*x' + if(a < b, x, y)",
    "x*if(y > 0, sqrt(y), z*x) + y",
};
enum { FORMULAS = sizeof formulas / sizeof formulas[0] };

static const double specials[] = {0.0, -0.0, 1.0,   -1.0,   0.5,    INFINITY, -INFINITY,
                                  NAN, 2.0,  1e308, -1e308, 5e-324, 1e-300,   3.0,
                                  1e7, 1e22, 0.7,   -0.3,   1.25,   -2.5};
enum { SPECIALS = sizeof specials / sizeof specials[0] };

/* Different special values for all inputs and all lanes. */
static double input(int round, int symbol, int lane)
{
    return specials[(round * 7 + symbol * (3 + round % 5) + lane * 11) % SPECIALS];
}

static const double parameters[PARAMETERS] = {1.3, -0.7};

/* Work at one width: parameters, prepared constants, inputs of a round. */
static double *filled_work(const dal__tapes *tapes, int lanes, int round)
{
    size_t size = tapes->workspace;
    double *single = formula_work(size), *work = formula_work(size * (size_t)lanes);
    for (size_t i = 0; i < size * (size_t)lanes; i++) work[i] = NAN;
    memcpy(single, parameters, sizeof parameters);
    dal__tapes_prepare_x1(tapes, single);
    int first = (int)tapes->first_input;
    for (int lane = 0; lane < lanes; lane++) {
        for (int i = 0; i < first; i++) work[i * lanes + lane] = single[i];
        for (int i = 0; i < INPUTS; i++) {
            work[(first + i) * lanes + lane] = input(round, PARAMETERS + i, lane);
        }
    }
    free(single);
    return work;
}

static double expected(dal__graph *graph, dal__node node, int round, int lane)
{
    double values[SYMBOLS] = {parameters[A], parameters[B]};
    for (int i = PARAMETERS; i < SYMBOLS; i++) values[i] = input(round, i, lane);
    return dal__evaluate(graph, node, values);
}

/* right[count*MAX_LANES]: what the outputs are in each lane. */
static void check_variant(int v, const dal__tapes *tapes, int program, int count, int round,
                          const double *right)
{
    const int lanes = variants[v].lanes;
    double *work = filled_work(tapes, lanes, round);
    double *out = formula_work((size_t)(count * lanes));
    int wrong = 0;
    variants[v].run(tapes, program, work, out);
    for (int i = 0; i < count * lanes; i++)
        wrong += !same_bits(out[i], right[i / lanes * DAL__MAX_LANES + i % lanes]);
    CU_ASSERT_EQUAL(wrong, 0);
    if (wrong > 0) fprintf(stderr, "program %d, variant %d: %d wrong\n", program, v, wrong);
    free(work);
    free(out);
}

static void check_program(dal__graph *graph, const dal__tapes *tapes, int program,
                          const dal__node *nodes, int count, int round)
{
    double *right = formula_work((size_t)count * DAL__MAX_LANES);
    for (int i = 0; i < count * DAL__MAX_LANES; i++)
        right[i] = expected(graph, nodes[i / DAL__MAX_LANES], round, i % DAL__MAX_LANES);
    for (int v = 0; v < VARIANTS; v++)
        if (dal__machine_has(variants[v].set))
            check_variant(v, tapes, program, count, round, right);
    free(right);
}

/* All formulas in one program, each in one of its own, and their gradients in another. */
static void test_same_bits(void)
{
    enum { ROUNDS = 12 };
    const int symbols[] = {X, Y, Z};
    dal__graph *graph = formula_graph();
    dal__node nodes[FORMULAS], gradients[3 * FORMULAS];
    for (int i = 0; i < FORMULAS; i++) nodes[i] = formula_node(graph, formulas[i]);
    for (int i = 0; i < FORMULAS; i++) {
        dal__gradient(graph, nodes[i], symbols, 3, &gradients[3 * i]);
    }
    dal__tapes *tapes = dal__tapes_create(graph, PARAMETERS, INPUTS);
    for (int i = 0; i < FORMULAS; i++) {
        CU_ASSERT_EQUAL(dal__tapes_add(tapes, &nodes[i], 1), i);
    }
    dal__tapes_add(tapes, nodes, FORMULAS);
    dal__tapes_add(tapes, gradients, 3 * FORMULAS);
    CU_ASSERT_EQUAL_FATAL(dal__tapes_finish(tapes), DAL_STATUS_OK);
    for (int round = 0; round < ROUNDS; round++) {
        for (int i = 0; i < FORMULAS; i++) {
            check_program(graph, tapes, i, &nodes[i], 1, round);
        }
        check_program(graph, tapes, FORMULAS, nodes, FORMULAS, round);
        check_program(graph, tapes, FORMULAS + 1, gradients, 3 * FORMULAS, round);
    }
    dal__tapes_free(tapes);
    dal__graph_free(graph);
}

static int below(unsigned *state, int n)
{
    *state = *state * 1664525u + 1013904223u;
    return (int)((*state >> 8) % (unsigned)n);
}

/* Any operations on any nodes before them, and several of the last as outputs. */
static void test_random_programs(void)
{
    enum { GRAPHS = 150, NODES = 60, OUTPUTS = 6 };
    static const dal__op ops[] = {DAL__ADD, DAL__SUB,  DAL__MUL, DAL__MUL, DAL__SIN,
                                  DAL__COS, DAL__SIN,  DAL__COS, DAL__DIV, DAL__TANH,
                                  DAL__MAX, DAL__LESS, DAL__IF};
    unsigned state = 1;
    for (int g = 0; g < GRAPHS; g++) {
        dal__graph *graph = formula_graph();
        dal__node node[NODES];
        for (int i = 0; i < NODES; i++) {
            dal__op op = ops[below(&state, sizeof ops / sizeof ops[0])];
            int any = below(&state, i + 1), near = i - below(&state, 8);
            node[i] = i < SYMBOLS ? dal__symbol(graph, i) : 0;
            if (node[i]) continue;
            const dal__node left = node[any - (any == i)], right = node[near - 1];
            node[i] = op == DAL__IF ? dal__node_if(graph, left, right, node[i / 2])
                                    : dal__apply(graph, op, left, right);
        }
        dal__tapes *tapes = dal__tapes_create(graph, PARAMETERS, INPUTS);
        dal__tapes_add(tapes, &node[NODES - OUTPUTS], OUTPUTS);
        CU_ASSERT_EQUAL_FATAL(dal__tapes_finish(tapes), DAL_STATUS_OK);
        check_program(graph, tapes, 0, &node[NODES - OUTPUTS], OUTPUTS, g);
        dal__tapes_free(tapes);
        dal__graph_free(graph);
    }
}

/* ---- how much work it is ---- */

static dal__tapes *tapes_of(dal__graph *graph, const char *const *texts, int count)
{
    dal__node nodes[FORMULAS];
    for (int i = 0; i < count; i++) nodes[i] = formula_node(graph, texts[i]);
    dal__tapes *tapes = dal__tapes_create(graph, PARAMETERS, INPUTS);
    CU_ASSERT_EQUAL(dal__tapes_add(tapes, nodes, count), 0);
    CU_ASSERT_EQUAL(dal__tapes_finish(tapes), DAL_STATUS_OK);
    return tapes;
}

static int length_of(const char *const *texts, int count)
{
    dal__graph *graph = formula_graph();
    dal__tapes *tapes = tapes_of(graph, texts, count);
    int length = tapes->tape[0].length;
    dal__tapes_free(tapes);
    dal__graph_free(graph);
    return length;
}

static void test_lengths(void)
{
    static const struct {
        const char *text[3];
        int length;
    } cases[] = {
        {{"x", "a", "7"}, 0},
        {{"exp(a)/(1 + b^2)", "sqrt(a)", "sin(a*b)"}, 0}, /* hoisted */
        {{"x/a", "y/a", "0"}, 2},                         /* products with one reciprocal */
        {{"sin(x)", "cos(x)", "0"}, 1},                   /* both at once */
        {{"x*y + z", "0", "0"}, 1},                       /* a product and a sum at once */
        {{"x*y + z", "x*y", "0"}, 2},                     /* the product is wanted elsewhere */
        {{"sin(x + y)*z", "sin(y + x) + 1", "0"}, 4},     /* common parts */
        {{"exp(a)*x*log(b + 9)*sqrt(a)", "0", "0"}, 1},   /* one coefficient */
        {{"-(a*x)", "0", "0"}, 1},                        /* with its sign */
        /* Chaplygin's sleigh: sin and cos, c.v, times rate and mass ratio, two products, a sign */
        {{"-((x'*cos(z) + y'*sin(z))*z'/(sin(z)^2/a + cos(z)^2/a))*sin(z)/a",
          "((x'*cos(z) + y'*sin(z))*z'/(sin(z)^2/a + cos(z)^2/a))*cos(z)/a", "0"},
         7},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        int length = length_of(cases[i].text, 3);
        CU_ASSERT_EQUAL(length, cases[i].length);
        if (length != cases[i].length) fprintf(stderr, "%s: %d\n", cases[i].text[0], length);
    }
}

/* A long chain keeps few numbers at a time. */
static void test_places_are_reused(void)
{
    enum { LINKS = 1000, FIXED = PARAMETERS + INPUTS, FEW = 4 };
    dal__graph *graph = formula_graph();
    dal__node f = dal__symbol(graph, X), y = dal__symbol(graph, Y), z = dal__symbol(graph, Z);
    for (int i = 0; i < LINKS; i++) {
        dal__node s = dal__apply(graph, DAL__SIN, f, 0), c = dal__apply(graph, DAL__COS, f, 0);
        dal__node g = dal__apply(graph, DAL__EXP, dal__node_mul(graph, s, c), 0);
        f = dal__node_add(graph, dal__node_mul(graph, g, y), z);
    }
    dal__tapes *tapes = dal__tapes_create(graph, PARAMETERS, INPUTS);
    dal__tapes_add(tapes, &f, 1);
    CU_ASSERT_EQUAL(dal__tapes_finish(tapes), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(tapes->tape[0].length, 4 * LINKS);
    CU_ASSERT(tapes->workspace <= FIXED + FEW);
    dal__tapes_free(tapes);
    dal__graph_free(graph);
}

/* Work is overwritten nowhere but among the temporaries, so one prepared block serves all runs. */
static void test_constants_stay(void)
{
    dal__graph *graph = formula_graph();
    dal__tapes *tapes = tapes_of(graph, formulas, FORMULAS);
    double *work = filled_work(tapes, 1, 0), out[FORMULAS];
    size_t kept = (tapes->first_input + INPUTS) * sizeof *work;
    double *before = formula_work(kept / sizeof *work);
    memcpy(before, work, kept);
    dal__tape_run_x1(tapes, 0, work, out);
    CU_ASSERT_EQUAL(memcmp(before, work, kept), 0);
    free(before);
    free(work);
    dal__tapes_free(tapes);
    dal__graph_free(graph);
}

/* New parameter values come into force with dal__tapes_prepare_x1, without a new tape. */
static void test_parameters_change(void)
{
    static const char *const texts[] = {"x*exp(a)/(a + b)", "sqrt(a) - b"};
    dal__graph *graph = formula_graph();
    dal__tapes *tapes = tapes_of(graph, texts, 2);
    double *work = formula_work(tapes->workspace), out[2];
    for (double a = 1.0; a < 4.0; a++) {
        work[A] = a;
        work[B] = 0.5;
        dal__tapes_prepare_x1(tapes, work);
        for (int i = 0; i < INPUTS; i++) work[tapes->first_input + (size_t)i] = 2.0;
        dal__tape_run_x1(tapes, 0, work, out);
        CU_ASSERT_DOUBLE_EQUAL(out[0], 2.0 * exp(a) / (a + 0.5), 1e-14);
        CU_ASSERT_DOUBLE_EQUAL(out[1], sqrt(a) - 0.5, 1e-15);
    }
    free(work);
    dal__tapes_free(tapes);
    dal__graph_free(graph);
}

/* ---- faults ---- */

static void test_faults(void)
{
    dal__graph *graph = formula_graph();
    dal__node beyond = dal__symbol(graph, SYMBOLS), nothing = 0;
    dal__tapes *tapes = dal__tapes_create(graph, PARAMETERS, INPUTS);
    dal__tapes_add(tapes, &beyond, 1);
    CU_ASSERT_EQUAL(dal__tapes_finish(tapes), DAL_STATUS_ARGUMENT);
    dal__tapes_free(tapes);
    tapes = dal__tapes_create(graph, PARAMETERS, INPUTS);
    dal__tapes_add(tapes, &nothing, 1);
    CU_ASSERT_EQUAL(dal__tapes_finish(tapes), DAL_STATUS_ARGUMENT);
    dal__tapes_free(tapes);
    dal__graph_free(graph);
}

static void test_out_of_memory(void)
{
    dal__graph *graph = formula_graph();
    dal__node nodes[FORMULAS];
    for (int i = 0; i < FORMULAS; i++) nodes[i] = formula_node(graph, formulas[i]);
    allocation_trial trial = {0};
    while (allocation_next(&trial)) {
        allocation_start(&trial);
        dal__tapes *tapes = dal__tapes_create(graph, PARAMETERS, INPUTS);
        bool added = tapes && dal__tapes_add(tapes, nodes, FORMULAS) == 0;
        added = added && dal__tapes_add(tapes, nodes, 2) == 1;
        allocation_end(&trial, added ? dal__tapes_finish(tapes) : DAL_STATUS_MEMORY);
        dal__tapes_free(tapes);
    }
    dal__graph_free(graph);
}

void suite_tape(void)
{
    CU_pSuite suite = CU_add_suite("tape", NULL, NULL);
    CU_add_test(suite, "the bits of evaluation at every width", test_same_bits);
    CU_add_test(suite, "random programs", test_random_programs);
    CU_add_test(suite, "numbers of instructions", test_lengths);
    CU_add_test(suite, "places are used again", test_places_are_reused);
    CU_add_test(suite, "constants stay", test_constants_stay);
    CU_add_test(suite, "parameters change", test_parameters_change);
    CU_add_test(suite, "faults", test_faults);
    CU_add_test(suite, "out of memory", test_out_of_memory);
}
