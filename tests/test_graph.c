/* test_graph.c - nodes: one for equal expressions, simplified without a change of value. */
#include "expr/graph.h"
#include "formula.h"
#include "quick.h"

#include <CUnit/Basic.h>
#include <math.h>
#include <stdio.h>

static const double point[SYMBOLS] = {1.3, -0.7, 0.3, 2.5, -1.25, 0.75, 4.0, -3.5};

/* ---- one node ---- */

static const char *const same[][2] = {
    {"x + y", "y + x"},
    {"x*y", "y*x"},
    {"x*y*sin(z)", "sin(z)*(y*x)"},
    {"x + 0", "x"},
    {"0*x", "0"},
    {"1*x", "x"},
    {"x/1", "x"},
    {"0/x", "0"},
    {"-1*x", "-x"},
    {"x/-1", "-x"},
    {"--x", "x"},
    {"x - x", "0"},
    {"x/x", "1"},
    {"x + x", "2*x"},
    {"3*x - 2*x", "x"},
    {"2*x + x", "3*x"},
    {"a*x + b*x", "(a + b)*x"},
    {"a*x + a*y", "a*(x + y)"},
    {"(y + a*x) - a*x", "y"},
    {"x + (y - x)", "y"},
    {"x - (y + x)", "-y"},
    {"x - -y", "x + y"},
    {"x + -y", "x - y"},
    {"-x - y", "-(x + y)"},
    {"-(x - y)", "y - x"},
    {"(-x)*(-y)", "x*y"},
    {"(-x)/y", "-(x/y)"},
    {"x + -2*y", "x - 2*y"},
    {"2*(3*x)", "6*x"},
    {"(2*x)*(a*y)", "2*a*(x*y)"},
    {"x*0.5", "x/2"},
    {"x/a", "x*(1/a)"},
    {"a*x/a", "x"},
    {"x/(1/a)", "a*x"},
    {"(x/y)/z", "x/(y*z)"},
    {"x/(y/z)", "x*z/y"},
    {"x/y + z/y", "(x + z)/y"},
    {"2*x/y - x/y", "x/y"},
    {"x^2", "x*x"},
    {"x^0.5", "sqrt(x)"},
    {"x^-2", "1/(x*x)"},
    {"x^0", "1"},
    {"x^1", "x"},
    {"1^x", "1"},
    {"x^-0.5", "1/sqrt(x)"},
    {"4^1.5", "8"},
    {"sqrt(x)^2", "x"},
    {"abs(-x)", "abs(x)"},
    {"abs(abs(x))", "abs(x)"},
    {"sin(-x)", "-sin(x)"},
    {"cos(-x)", "cos(x)"},
    {"tan(-x)", "-tan(x)"},
    {"asin(-x)", "-asin(x)"},
    {"atan(-x)", "-atan(x)"},
    {"sinh(-x)", "-sinh(x)"},
    {"cosh(-x)", "cosh(x)"},
    {"tanh(-x)", "-tanh(x)"},
    {"asinh(-x)", "-asinh(x)"},
    {"cos(y - x)", "cos(x - y)"},
    {"sin(y - x)", "-sin(x - y)"},
    {"sin(x)^2 + cos(x)^2", "1"},
    {"cos(2*x)^2 + sin(2*x)^2", "1"},
    {"sin(x)^2/a + cos(x)^2/a", "1/a"},
    {"(y*sin(x))^2 + (y*cos(x))^2", "y*y"},
    {"z + a*sin(x)^2 + a*cos(x)^2", "z + a"},
    {"-sin(x)^2*y - cos(x)^2*y", "-y"},
    {"sin(x)^2/z + cos(x)^2/z", "1/z"},
    {"sin(0) + cos(0) + exp(0)", "2"},
};

static void test_same_node(void)
{
    dal__graph *graph = formula_graph();
    enum { PASSES = 20 }; /* what was simplified before limits nothing that comes later */
    for (size_t i = 0; i < PASSES * sizeof same / sizeof same[0]; i++) {
        const char *const *pair = same[i % (sizeof same / sizeof same[0])];
        dal__node first = formula_node(graph, pair[0]), second = formula_node(graph, pair[1]);
        CU_ASSERT_EQUAL(first, second);
        if (first != second) fprintf(stderr, "%s is not %s\n", pair[0], pair[1]);
    }
    CU_ASSERT_EQUAL(graph->depth, 0);
    CU_ASSERT_EQUAL(dal__number(graph, -0.0), dal__number(graph, 0.0));
    dal__graph_free(graph);
}

static void test_other_node(void)
{
    static const char *const differ[][2] = {
        {"x - y", "y - x"},
        {"x/y", "y/x"},
        {"x^y", "y^x"},
        {"atan2(x, y)", "atan2(y, x)"},
        {"x", "x'"},
        {"sin(x)^2 - cos(x)^2", "1"},
        {"sin(x)^2 + cos(y)^2", "1"},
        {"sin(x)*sin(y) + cos(x)^2", "1"},
        {"exp(-x)", "exp(x)"},
        {"acos(-x)", "acos(x)"},
        {"sin(x)^2*y + cos(x)^2*z", "1"},
        {"(x + 1e16) + 1", "x + (1e16 + 1)"}, /* 1e16 + 1 is no double */
        {"sqrt(x*x)", "x"},
        {"x/3", "x*(1/3)"}, /* 1/3 is no double */
    };
    dal__graph *graph = formula_graph();
    for (size_t i = 0; i < sizeof differ / sizeof differ[0]; i++) {
        CU_ASSERT_NOT_EQUAL(formula_node(graph, differ[i][0]), formula_node(graph, differ[i][1]));
    }
    dal__graph_free(graph);
}

/* What has no value stays a node, and its value is found when it is evaluated. */
static void test_never_folded(void)
{
    static const char *const texts[] = {"log(0)",   "sqrt(-1)",      "asin(2)",  "exp(1e4)",
                                        "1e308*10", "1e308 + 1e308", "(-8)^0.3", "1e200/1e-200"};
    dal__graph *graph = formula_graph();
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        dal__node node = formula_node(graph, texts[i]);
        CU_ASSERT_NOT_EQUAL(dal__inspect(graph, node).op, DAL__NUMBER);
        CU_ASSERT_FALSE(isfinite(dal__evaluate(graph, node, point)));
    }
    dal__node zero = dal__number(graph, 0.0), x = dal__symbol(graph, X);
    CU_ASSERT_EQUAL(dal__inspect(graph, dal__node_div(graph, x, zero)).op, DAL__DIV);
    CU_ASSERT_EQUAL(dal__inspect(graph, dal__node_div(graph, zero, zero)).op, DAL__DIV);
    dal__graph_free(graph);
}

/* Factors that would over- or underflow together stay apart. */
static void test_extreme_factors(void)
{
    double at[SYMBOLS] = {1.0, 1.0, 1e-300};
    dal__graph *graph = formula_graph();
    CU_ASSERT_EQUAL(dal__evaluate(graph, formula_node(graph, "1e200*(1e200*x)"), at), 1e100);
    at[X] = 1e300;
    CU_ASSERT_EQUAL(dal__evaluate(graph, formula_node(graph, "1e-200*(1e-200*x)"), at),
                    1e-200 * (1e-200 * 1e300));
    dal__graph_free(graph);
}

static void test_depends(void)
{
    dal__graph *graph = formula_graph();
    dal__node f = formula_node(graph, "a*sin(x + y') - 0*z");
    CU_ASSERT(dal__depends(graph, f, A, A + 1));
    CU_ASSERT_FALSE(dal__depends(graph, f, B, B + 1));
    CU_ASSERT(dal__depends(graph, f, X, Z));
    CU_ASSERT_FALSE(dal__depends(graph, f, Y, XP + 1));
    CU_ASSERT(dal__depends(graph, f, YP, SYMBOLS));
    CU_ASSERT_FALSE(dal__depends(graph, formula_node(graph, "a + b"), X, SYMBOLS));
    CU_ASSERT_FALSE(dal__depends(graph, 0, 0, SYMBOLS));
    dal__graph_free(graph);
}

static void test_substitute(void)
{
    dal__graph *graph = formula_graph();
    dal__node f = formula_node(graph, "x^2 + sin(y)*x' - z/a");
    const int symbols[] = {X, Z, A};
    dal__node by[] = {formula_node(graph, "y + 1"), formula_node(graph, "x*y"),
                      formula_node(graph, "2")};
    CU_ASSERT_EQUAL(dal__substitute(graph, f, symbols, 3, by),
                    formula_node(graph, "(y + 1)^2 + sin(y)*x' - x*y/2"));
    /* All at once: what comes in is not replaced again. */
    const int both[] = {X, Y};
    dal__node swapped[] = {dal__symbol(graph, Y), dal__symbol(graph, X)};
    CU_ASSERT_EQUAL(dal__substitute(graph, formula_node(graph, "x - 2*y"), both, 2, swapped),
                    formula_node(graph, "y - 2*x"));
    CU_ASSERT_EQUAL(dal__substitute(graph, f, symbols, 0, by), f);
    dal__graph_free(graph);
}

/* ---- no change of value ---- */

/* A random formula as text, its value as a long double, and a bound of its rounding. */
typedef struct sample {
    char text[4096];
    long double value, bound;
} sample;

static unsigned random_state = 1;

static int below(int n)
{
    random_state = random_state * 1664525u + 1013904223u;
    return (int)((random_state >> 8) % (unsigned)n);
}

static const long double unit = 0x1p-53L;

static sample leaf(void)
{
    static const char *const names[] = {"a", "b", "x", "y", "z", "x'", "y'", "z'"};
    static const double numbers[] = {0, 1, -1, 2, 0.5, 3, 0.1, -2.5};
    sample s = {.bound = 0.0L};
    int i = below(8);
    s.value = below(3) ? (long double)point[i] : (long double)numbers[i];
    if (s.value == (long double)point[i]) {
        snprintf(s.text, sizeof s.text, "%s", names[i]);
    } else {
        snprintf(s.text, sizeof s.text, "(%g)", numbers[i]);
    }
    return s;
}

static sample unary(const sample *x)
{
    static const char *const forms[] = {"-(%s)",   "sin(%s)", "cos(%s)",
                                        "abs(%s)", "(%s)^2",  "(%s)^3"};
    int form = below(6);
    long double v = x->value, size = fabsl(v);
    const long double values[] = {-v, sinl(v), cosl(v), size, v * v, v * v * v};
    const long double slopes[] = {1, 1, 1, 1, 2 * size, 3 * v * v};
    sample s = {.value = values[form], .bound = x->bound * slopes[form]};
    s.bound += 2 * unit * fabsl(s.value);
    snprintf(s.text, sizeof s.text, forms[form], x->text);
    return s;
}

static sample binary(const sample *x, const sample *y)
{
    static const char operators[] = "+-*/";
    int op = below(4);
    long double u = x->value, v = y->value, size = fabsl(u), other = fabsl(v);
    const long double values[] = {u + v, u - v, u * v, u / v};
    const long double bounds[] = {x->bound + y->bound, x->bound + y->bound,
                                  x->bound * other + y->bound * size,
                                  x->bound / other + y->bound * size / (v * v)};
    sample s = {.value = values[op], .bound = bounds[op]};
    s.bound += unit * (op < 2 ? size + other : fabsl(s.value));
    int written = snprintf(s.text, sizeof s.text, "(%s) %c (%s)", x->text, operators[op], y->text);
    if (written >= (int)sizeof s.text) return *x;
    return s;
}

/* Fills a forest bottom up: leaves, then what joins two of the trees before it. */
static sample random_formula(void)
{
    enum { TREES = 16 };
    static sample tree[TREES];
    for (int i = 0; i < TREES; i++) {
        if (i < 5) {
            tree[i] = leaf();
        } else if (below(3) == 0) {
            tree[i] = unary(&tree[below(i)]);
        } else {
            const sample *left = &tree[below(i)], *right = &tree[below(i)];
            tree[i] = binary(left, right);
        }
        if (strlen(tree[i].text) > 800) tree[i] = leaf();
    }
    return tree[TREES - 1];
}

static void test_values_kept(void)
{
    const int formulas = (int)long_run(20000);
    static const long double slack = 16; /* other orders of the same operations */
    int tried = 0;
    dal__graph *graph = formula_graph();
    for (int i = 0; i < formulas; i++) {
        sample s = random_formula();
        dal__node node;
        bool usable = isfinite(s.value) && isfinite(s.bound) && s.bound < 1e-9L;
        if (!usable || formula_parse(graph, s.text, &node, NULL) != DAL_STATUS_OK) continue;
        tried++;
        double value = dal__evaluate(graph, node, point);
        bool right = fabsl(value - s.value) <= slack * s.bound;
        if (!right) {
            fprintf(stderr, "%s: %.17g, not %.17Lg (+-%.3Lg)\n", s.text, value, s.value, s.bound);
        }
        CU_ASSERT(right);
    }
    CU_ASSERT(tried > formulas / 2);
    dal__graph_free(graph);
}

/* ---- limits ---- */

static void test_too_large(void)
{
    dal__graph *graph = formula_graph();
    CU_ASSERT(graph->limit >= 1000000);
    graph->limit = 1000;
    dal__node x = dal__symbol(graph, X), f = x;
    while (f) f = dal__apply(graph, DAL__EXP, f, 0);
    CU_ASSERT_EQUAL(graph->status, DAL_STATUS_TOO_LARGE);
    CU_ASSERT_EQUAL(graph->count, 1000);
    /* The graph remembers, and node 0 is nothing to everybody. */
    CU_ASSERT_EQUAL(dal__symbol(graph, X), 0);
    CU_ASSERT_EQUAL(dal__node_add(graph, x, x), 0);
    CU_ASSERT_EQUAL(dal__node_mul(graph, 0, x), 0);
    CU_ASSERT_EQUAL(dal__apply(graph, DAL__SIN, 0, 0), 0);
    CU_ASSERT_EQUAL(dal__tangent(graph, 0, NULL, 0, NULL), 0);
    CU_ASSERT(isnan(dal__evaluate(graph, 0, point)));
    dal_error error;
    CU_ASSERT_EQUAL(formula_parse(graph, "x + 1", &f, &error), DAL_STATUS_TOO_LARGE);
    dal__graph_free(graph);
}

void suite_graph(void)
{
    CU_pSuite suite = CU_add_suite("graph", NULL, NULL);
    CU_add_test(suite, "equal expressions are one node", test_same_node);
    CU_add_test(suite, "different expressions are not", test_other_node);
    CU_add_test(suite, "what has no value is not folded", test_never_folded);
    CU_add_test(suite, "extreme factors stay apart", test_extreme_factors);
    CU_add_test(suite, "dependence on symbols", test_depends);
    CU_add_test(suite, "substitution", test_substitute);
    CU_add_test(suite, "values of random formulas", test_values_kept);
    CU_add_test(suite, "too large a graph", test_too_large);
}
