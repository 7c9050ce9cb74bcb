/* test_derivative.c - derivatives against closed forms and against differences. */
#include "allocation.h"
#include "formula.h"

#include <CUnit/Basic.h>
#include <math.h>
#include <stdio.h>

/* Away from the edges of all domains below. */
static const double points[][SYMBOLS] = {
    {1.3, -0.7, 0.3, 0.6, 0.45, 0.75, 4.0, -3.5},
    {0.4, 2.1, 0.8, 0.25, 0.7, -0.3, 0.2, 1.5},
};
enum { POINTS = sizeof points / sizeof points[0] };

static bool close_to(double value, double expected, double relative)
{
    return fabs(value - expected) <= relative * (1.0 + fabs(expected));
}

/* Values of two nodes at all points. */
static void check_equal(dal__graph *graph, dal__node f, dal__node expected, const char *what)
{
    for (int i = 0; i < POINTS; i++) {
        double value = dal__evaluate(graph, f, points[i]);
        double right = dal__evaluate(graph, expected, points[i]);
        CU_ASSERT(close_to(value, right, 1e-13));
        if (!close_to(value, right, 1e-13)) {
            fprintf(stderr, "%s: %.17g, not %.17g\n", what, value, right);
        }
    }
}

/* f, df/dx, d2f/dx2 of every function of the language, from tables of derivatives. */
static const char *const closed_forms[][3] = {
    {"x + y", "1", "0"},
    {"y - x", "-1", "0"},
    {"x*y", "y", "0"},
    {"y/x", "-y/x^2", "2*y/x^3"},
    {"x/y", "1/y", "0"},
    {"-x", "-1", "0"},
    {"x^3", "3*x^2", "6*x"},
    {"x^-2", "-2/x^3", "6/x^4"},
    {"x^1.5", "1.5*x^0.5", "0.75*x^-0.5"},
    {"x^y", "y*x^(y - 1)", "y*(y - 1)*x^(y - 2)"},
    {"y^x", "log(y)*y^x", "log(y)^2*y^x"},
    {"x^x", "x^x*(log(x) + 1)", "x^x*(log(x) + 1)^2 + x^x/x"},
    {"sqrt(x)", "1/(2*sqrt(x))", "-1/(4*x*sqrt(x))"},
    {"exp(2*x)", "2*exp(2*x)", "4*exp(2*x)"},
    {"log(x)", "1/x", "-1/x^2"},
    {"sin(2*x)", "2*cos(2*x)", "-4*sin(2*x)"},
    {"cos(2*x)", "-2*sin(2*x)", "-4*cos(2*x)"},
    {"tan(x)", "1/cos(x)^2", "2*sin(x)/cos(x)^3"},
    {"asin(x)", "1/sqrt(1 - x^2)", "x/(1 - x^2)^1.5"},
    {"acos(x)", "-1/sqrt(1 - x^2)", "-x/(1 - x^2)^1.5"},
    {"atan(x)", "1/(1 + x^2)", "-2*x/(1 + x^2)^2"},
    {"atan2(x, y)", "y/(x^2 + y^2)", "-2*x*y/(x^2 + y^2)^2"},
    {"atan2(y, x)", "-y/(x^2 + y^2)", "2*x*y/(x^2 + y^2)^2"},
    {"sinh(x)", "cosh(x)", "sinh(x)"},
    {"cosh(x)", "sinh(x)", "cosh(x)"},
    {"tanh(x)", "1/cosh(x)^2", "-2*sinh(x)/cosh(x)^3"},
    {"asinh(x)", "1/sqrt(1 + x^2)", "-x/(1 + x^2)^1.5"},
    {"abs(x - y)*x", "abs(x - y) + x*(x - y)/abs(x - y)", "2*(x - y)/abs(x - y)"},
    {"a*sin(b*x)^2/a", "b*sin(2*b*x)", "2*b^2*cos(2*b*x)"},
    {"exp(sin(x*y))", "y*cos(x*y)*exp(sin(x*y))", "y^2*exp(sin(x*y))*(cos(x*y)^2 - sin(x*y))"},
    {"(x + y)*(x - y)/(x*y)", "1/y + y/x^2", "-2*y/x^3"},
    {"y + a*z", "0", "0"},
    {"hypot(x, y)", "x/sqrt(x^2 + y^2)", "y^2/sqrt(x^2 + y^2)^3"},
    {"hypot(y, x)", "x/sqrt(x^2 + y^2)", "y^2/sqrt(x^2 + y^2)^3"},
    {"min(x^2, y - 10)", "0", "0"},
    {"max(x^3, y - 10)", "3*x^2", "6*x"},
    {"min(10, x^3)", "3*x^2", "6*x"},
    {"max(x^3, x^2 + 10, y)", "2*x", "2"},
    {"if(x < 2, x^3, x)*y", "3*x^2*y", "6*x*y"},
    {"if(x > 2, x^3, exp(y*x))", "y*exp(y*x)", "y^2*exp(y*x)"},
    {"floor(x)*x^2 + sign(x)*x", "1", "0"},
    {"if(x < 2, if(y < 9, x^2, x), x^5)^2", "4*x^3", "12*x^2"},
};

static void test_closed_forms(void)
{
    const int symbol = X;
    for (size_t i = 0; i < sizeof closed_forms / sizeof closed_forms[0]; i++) {
        dal__graph *graph = formula_graph();
        const char *const *form = closed_forms[i];
        dal__node f = formula_node(graph, form[0]), first, second;
        dal__gradient(graph, f, &symbol, 1, &first);
        dal__gradient(graph, first, &symbol, 1, &second);
        check_equal(graph, first, formula_node(graph, form[1]), form[0]);
        check_equal(graph, second, formula_node(graph, form[2]), form[1]);
        dal__graph_free(graph);
    }
}

/* No logarithm of a base that may be negative, where the exponent is constant. */
static void test_negative_base(void)
{
    const double at[SYMBOLS] = {3.0, 0.0, -2.0};
    const int symbol = X;
    dal__graph *graph = formula_graph();
    dal__node f = formula_node(graph, "x^a"), df;
    dal__gradient(graph, f, &symbol, 1, &df);
    CU_ASSERT_DOUBLE_EQUAL(dal__evaluate(graph, f, at), -8.0, 1e-15);
    CU_ASSERT_DOUBLE_EQUAL(dal__evaluate(graph, df, at), 12.0, 1e-14);
    dal__graph_free(graph);
}

static void test_abs_at_zero(void)
{
    double at[SYMBOLS] = {0.0};
    const int symbol = X;
    dal__graph *graph = formula_graph();
    dal__node df;
    dal__gradient(graph, formula_node(graph, "abs(x)"), &symbol, 1, &df);
    CU_ASSERT_EQUAL(dal__evaluate(graph, df, at), 0.0);
    at[X] = -3.0;
    CU_ASSERT_EQUAL(dal__evaluate(graph, df, at), -1.0);
    at[X] = NAN;
    CU_ASSERT(isnan(dal__evaluate(graph, df, at)));
    dal__graph_free(graph);
}

/* Only the branch that is taken counts: the other one has no number here, nor have its derivatives,
 * and what a sum of two such branches gives is one. */
static void test_other_branch(void)
{
    static const struct {
        const char *text;
        double value, first, second;
    } cases[] = {
        {"if(x > 0, sqrt(x), 3*x^2)", 12.0, -12.0, 6.0},
        {"if(x > 0, sqrt(x), 0) + if(x > 1, sqrt(x), x)", -2.0, 1.0, 0.0},
        {"x*if(x < 0, x, log(x))", 4.0, -4.0, 2.0},
        {"if(x > 0, if(x > 1, x^0.5, log(x)), x^3)", -8.0, 12.0, -12.0},
        {"if(x > -1, 1/(x + 2), x)", -2.0, 1.0, 0.0},
        {"min(x, 5/(x - 1)^2)", -2.0, 1.0, 0.0},
        {"hypot(x + 2, 0*y)", 0.0, 0.0, 0.0},
        {"sign(x + 2)*x", 0.0, 0.0, 0.0},
    };
    const double at[SYMBOLS] = {1.0, 1.0, -2.0, 3.0};
    const int symbol = X;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        dal__graph *graph = formula_graph();
        const dal__node one = dal__number(graph, 1.0);
        dal__node f = formula_node(graph, cases[i].text), first, second;
        dal__gradient(graph, f, &symbol, 1, &first);
        dal__gradient(graph, first, &symbol, 1, &second);
        CU_ASSERT_DOUBLE_EQUAL(dal__evaluate(graph, f, at), cases[i].value, 1e-14);
        CU_ASSERT_DOUBLE_EQUAL(dal__evaluate(graph, first, at), cases[i].first, 1e-14);
        CU_ASSERT_DOUBLE_EQUAL(dal__evaluate(graph, second, at), cases[i].second, 1e-14);
        dal__node along = dal__tangent(graph, f, &symbol, 1, &one);
        CU_ASSERT_DOUBLE_EQUAL(dal__evaluate(graph, along, at), cases[i].first, 1e-14);
        dal__graph_free(graph);
    }
}

static const char *const mixtures[] = {
    "max(x*y, z)*if(x' > y', sin(x), min(x*y', exp(z), y))*hypot(x - 5, y*z)",
    "sin(x*y)*exp(z) + x'*y'/(1 + z^2) - a*atan2(x, y + 2)",
    "sqrt(1 + x^2 + y^2)*tanh(z*x') + b*log(3 + cos(x - y))",
    "(x' - y*z)^2/(2*a) + asinh(x)*acos(z/3)^1.5 - sinh(y)*cosh(x*x')",
    "x^(1 + y^2)*tan(z/2) + abs(x' - 5)*asin(x/2)*atan(y') + (x + y)*(x + y)^-2",
};

/* Richardson's extrapolation of central differences: error O(h^4). */
static double difference(dal__graph *graph, dal__node f, const double *at, int symbol)
{
    static const double h = 1e-3;
    double d[2];
    for (int k = 0; k < 2; k++) {
        double step = h / (1 + k), moved[2][SYMBOLS];
        memcpy(moved[0], at, sizeof moved[0]);
        memcpy(moved[1], at, sizeof moved[1]);
        moved[0][symbol] -= step;
        moved[1][symbol] += step;
        d[k] = (dal__evaluate(graph, f, moved[1]) - dal__evaluate(graph, f, moved[0])) / (2 * step);
    }
    return d[1] + (d[1] - d[0]) / 3.0;
}

static void test_differences(void)
{
    const int symbols[] = {X, Y, Z, XP, YP, ZP, A, B};
    for (size_t i = 0; i < sizeof mixtures / sizeof mixtures[0]; i++) {
        dal__graph *graph = formula_graph();
        dal__node f = formula_node(graph, mixtures[i]), gradient[SYMBOLS];
        dal__gradient(graph, f, symbols, SYMBOLS, gradient);
        for (int p = 0; p < POINTS; p++) {
            for (int k = 0; k < SYMBOLS; k++) {
                double exact = dal__evaluate(graph, gradient[k], points[p]);
                CU_ASSERT(close_to(difference(graph, f, points[p], symbols[k]), exact, 1e-9));
            }
        }
        dal__graph_free(graph);
    }
}

/* d2f/dy dx = d2f/dx dy, and the second is the difference of the first. */
static void test_second_derivatives(void)
{
    enum { N = 4 };
    const int symbols[N] = {X, Y, Z, XP};
    for (size_t i = 0; i < sizeof mixtures / sizeof mixtures[0]; i++) {
        dal__graph *graph = formula_graph();
        dal__node f = formula_node(graph, mixtures[i]), first[N], second[N][N];
        dal__gradient(graph, f, symbols, N, first);
        for (int j = 0; j < N; j++) dal__gradient(graph, first[j], symbols, N, second[j]);
        for (int j = 0; j < N * N; j++) {
            dal__node h = second[j / N][j % N];
            check_equal(graph, h, second[j % N][j / N], mixtures[i]);
            double numeric = difference(graph, first[j / N], points[0], symbols[j % N]);
            CU_ASSERT(close_to(numeric, dal__evaluate(graph, h, points[0]), 1e-8));
        }
        dal__graph_free(graph);
    }
}

/* The tangent along seeds is the gradient times them. */
static void test_tangent(void)
{
    enum { N = 3 };
    const int symbols[N] = {X, Z, XP};
    for (size_t i = 0; i < sizeof mixtures / sizeof mixtures[0]; i++) {
        dal__graph *graph = formula_graph();
        dal__node f = formula_node(graph, mixtures[i]), gradient[N], sum = dal__number(graph, 0.0);
        dal__node seeds[N] = {formula_node(graph, "y"), formula_node(graph, "-2"),
                              formula_node(graph, "sin(x) + a")};
        dal__gradient(graph, f, symbols, N, gradient);
        for (int k = 0; k < N; k++) {
            sum = dal__node_add(graph, sum, dal__node_mul(graph, gradient[k], seeds[k]));
        }
        check_equal(graph, dal__tangent(graph, f, symbols, N, seeds), sum, mixtures[i]);
        dal__graph_free(graph);
    }
}

/* One sweep of reverse mode costs a small multiple of the function, for any number of symbols:
 * the product x1 x2 ... has gradients of as many operations as itself, not of its square. */
static void test_gradient_is_cheap(void)
{
    enum { N = 2000 };
    static int symbols[N];
    static dal__node gradient[N];
    dal__graph *graph = dal__graph_create(0);
    dal__node f = dal__number(graph, 1.0);
    for (int i = 0; i < N; i++) {
        symbols[i] = i;
        dal__node x = dal__symbol(graph, i);
        f = dal__node_mul(graph, f, dal__apply(graph, DAL__SIN, x, 0));
    }
    int before = graph->count;
    /* By one symbol, only what depends on it is visited: no more than the N products. */
    dal__gradient(graph, f, &symbols[1], 1, gradient);
    CU_ASSERT(graph->count <= before + N + 10);
    dal__gradient(graph, f, symbols, N, gradient);
    CU_ASSERT(graph->count < 6 * before);
    dal__graph_free(graph);
}

static void test_out_of_memory(void)
{
    const int symbols[] = {X, Y, Z};
    allocation_trial trial = {0};
    while (allocation_next(&trial)) {
        dal__graph *graph = formula_graph();
        dal__node f = formula_node(graph, mixtures[3]), out[3], one = dal__number(graph, 1.0);
        dal__node seeds[3] = {one, one, one};
        allocation_start(&trial);
        dal__gradient(graph, f, symbols, 3, out);
        for (int k = 0; k < 3; k++) dal__gradient(graph, out[k], symbols, 3, out);
        dal__node t = dal__tangent(graph, out[0], symbols, 3, seeds);
        dal__node s = dal__substitute(graph, t, symbols, 3, out);
        CU_ASSERT_EQUAL(s == 0, allocation_end(&trial, graph->status));
        dal__graph_free(graph);
    }
}

void suite_derivative(void)
{
    CU_pSuite suite = CU_add_suite("derivative", NULL, NULL);
    CU_add_test(suite, "first and second against closed forms", test_closed_forms);
    CU_add_test(suite, "powers of a negative base", test_negative_base);
    CU_add_test(suite, "abs around 0", test_abs_at_zero);
    CU_add_test(suite, "the branch that is not taken", test_other_branch);
    CU_add_test(suite, "gradients against differences", test_differences);
    CU_add_test(suite, "second derivatives", test_second_derivatives);
    CU_add_test(suite, "tangents against gradients", test_tangent);
    CU_add_test(suite, "the cost of a gradient", test_gradient_is_cheap);
    CU_add_test(suite, "out of memory", test_out_of_memory);
}
