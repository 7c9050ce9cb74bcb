/* test_formula.c - the language of formulas: what it means, and what it says to what is wrong. */
#include "allocation.h"
#include "core/error.h"
#include "formula.h"
#include "skip.h"

#include <CUnit/Basic.h>
#include <limits.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static const double point[SYMBOLS] = {1.3, -0.7, 0.3, 2.5, -1.25, 0.75, 4.0, -3.5};

static double value_of(const char *text)
{
    dal__graph *graph = formula_graph();
    double value = dal__evaluate(graph, formula_node(graph, text), point);
    dal__graph_free(graph);
    return value;
}

/* ---- meaning ---- */

static void test_precedence(void)
{
    static const struct {
        const char *text;
        double value;
    } cases[] = {
        {"1 + 2*3", 7},       {"(1 + 2)*3", 9},   {"8 - 4 - 2", 2},   {"8 - (4 - 2)", 6},
        {"16/4/2", 2},        {"16/(4/2)", 8},    {"2^3^2", 512},     {"(2^3)^2", 64},
        {"-2^2", -4},         {"(-2)^2", 4},      {"2^-3", 0.125},    {"2^-2^2", 0.0625},
        {"2*-3", -6},         {"-3 - -4", 1},     {"--5", 5},         {"+5 - +3", 2},
        {"2*3^2", 18},        {"-2*3", -6},       {"6/-3", -2},       {"1 - 2 + 3", 2},
        {"2^0.5^2", 0},       {"x' * 4", 3},      {"y'^2", 16},       {"- y' + z'", -7.5},
        {"((((7))))", 7},     {"sqrt(2 + 2)", 2}, {"abs(-2) + 1", 3}, {"atan2(0, 1)", 0},
        {"sqrt(abs(-9))", 3}, {"1\n+\n\t2\r", 3}, {"y*y'", 10},       {"y'-y", 1.5},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        double expected = strcmp(cases[i].text, "2^0.5^2") ? cases[i].value : exp2(0.25);
        CU_ASSERT_DOUBLE_EQUAL(value_of(cases[i].text), expected, 0.0);
    }
}

/* What is not negative and not folded: the value of each function by libm, at numbers and at
 * symbols. */
static void test_functions(void)
{
    static const struct {
        const char *name;
        double (*f)(double);
    } functions[] = {{"sqrt", sqrt},   {"exp", exp},   {"log", log},   {"sin", sin},
                     {"cos", cos},     {"tan", tan},   {"asin", asin}, {"acos", acos},
                     {"atan", atan},   {"sinh", sinh}, {"cosh", cosh}, {"tanh", tanh},
                     {"asinh", asinh}, {"abs", fabs}};
    for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++) {
        char number[32], symbol[32];
        double expected = functions[i].f(point[X]);
        snprintf(number, sizeof number, "%s(0.3)", functions[i].name);
        snprintf(symbol, sizeof symbol, "%s(x)", functions[i].name);
        CU_ASSERT_DOUBLE_EQUAL(value_of(number), expected, 2e-16);
        CU_ASSERT_DOUBLE_EQUAL(value_of(symbol), expected, 2e-16);
    }
    CU_ASSERT_DOUBLE_EQUAL(value_of("atan2(y, z)"), atan2(2.5, -1.25), 0.0);
    CU_ASSERT_DOUBLE_EQUAL(value_of("pi"), acos(-1.0), 0.0);
    CU_ASSERT_DOUBLE_EQUAL(value_of("y^x"), pow(2.5, 0.3), 0.0);
    CU_ASSERT_DOUBLE_EQUAL(value_of("y^1.5"), pow(2.5, 1.5), 0.0);
}

/* Values from the definitions, at numbers and at the point. */
static void test_branches(void)
{
    static const struct {
        const char *text;
        double value;
    } cases[] = {
        {"min(3, -2)", -2},
        {"max(3, -2, 7)", 7},
        {"min(x, y, z) + 0", -1.25},
        {"max(z, x)", 0.3},
        {"sign(-3)", -1},
        {"sign(0)", 0},
        {"sign(y)", 1},
        {"sign(-y)", -1},
        {"floor(-1.5)", -2},
        {"floor(y)", 2},
        {"floor(-y)", -3},
        {"hypot(-3, 4)", 5},
        {"hypot(0, 0)", 0},
        {"hypot(3e200*y, 4e200*y)", 5e200 * 2.5},
        {"1 < 2", 1},
        {"2 < 1", 0},
        {"1 < 1", 0},
        {"1 <= 1", 1},
        {"x < y", 1},
        {"x > y", 0},
        {"y >= y", 1},
        {"x == 0.3", 1},
        {"x != 0.3", 0},
        {"x != y", 1},
        {"x + 1 < y*2", 1},
        {"(x < y)*(y < z)", 0},
        {"if(x < y, 5, 6)", 5},
        {"if(x > y, 5, 6)", 6},
        {"if(0.5, y, z)", 2.5},
        {"if(y > 3, 1, if(y > 2, 2, 3))", 2},
        {"if(z > 0, sqrt(z), y)", 2.5},
        {"2 + if(x < y, 1, 0)*3", 5},
        {"-(x < y)", -1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const double value = value_of(cases[i].text);
        CU_ASSERT_DOUBLE_EQUAL(value, cases[i].value, 4e-16 * fabs(cases[i].value));
        if (fabs(value - cases[i].value) > 4e-16 * fabs(cases[i].value))
            fprintf(stderr, "%s: %g\n", cases[i].text, value);
    }
    /* What is no number stays none. */
    CU_ASSERT(isnan(value_of("max(sqrt(z), y)")) && isnan(value_of("max(y, sqrt(z))")));
    CU_ASSERT(isnan(value_of("min(sqrt(z), y)")) && isnan(value_of("min(y, sqrt(z))")));
    CU_ASSERT(isnan(value_of("hypot(sqrt(z), y)")) && isnan(value_of("hypot(y, sqrt(z))")));
}

/* Hexadecimal constants are the nearest doubles, from the C standard's own conversion rules. */
static void test_numbers(void)
{
    static const struct {
        const char *text;
        double value;
    } cases[] = {
        {"0.1", 0x1.999999999999ap-4},
        {".5", 0.5},
        {"5.", 5.0},
        {"1e-3", 0x1.0624dd2f1a9fcp-10},
        {"1E+3", 1000.0},
        {"12.5e1", 125.0},
        {"0.000125e4", 1.25},
        {"00012", 12.0},
        {"9007199254740993", 0x1p53}, /* a tie: to even */
        {"9007199254740993.00000000000000000001", 0x1.0000000000001p53},
        {"2.2250738585072011e-308", 0x0.fffffffffffffp-1022},
        {"4.9406564584124654e-324", 0x1p-1074},
        {"2e-324", 0.0},
        {"1e-99999999999999999999", 0.0},
        {"1e-18446744073709551617", 0.0}, /* 2^64 + 1 */
        {"0e99999999999", 0.0},
        {"1.7976931348623157e308", 0x1.fffffffffffffp1023},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        CU_ASSERT_DOUBLE_EQUAL(value_of(cases[i].text), cases[i].value, 0.0);
    }
}

/* A tie that only the last of a thousand digits breaks. */
static void test_long_number(void)
{
    char text[1100];
    int n = snprintf(text, sizeof text, "9007199254740993.%01000d", 0);
    CU_ASSERT_EQUAL(value_of(text), 0x1p53);
    text[n - 1] = '1';
    CU_ASSERT_EQUAL(value_of(text), 0x1.0000000000001p53);
    n = snprintf(text, sizeof text, "3%01000de-1000", 0);
    CU_ASSERT_EQUAL(value_of(text), 3.0);
    n = snprintf(text, sizeof text, "0.%01000d1e1000", 0);
    CU_ASSERT_EQUAL(value_of(text), 0.1);
}

static void test_locale(void)
{
    if (!getenv("LOCPATH")) return; /* under the leak checkers: see the Makefile */
    static const char *const comma[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE"};
    locale_t locale = (locale_t)0;
    for (size_t i = 0; i < sizeof comma / sizeof comma[0] && !locale; i++) {
        locale = newlocale(LC_ALL_MASK, comma[i], (locale_t)0);
    }
    if (!locale) {
        skip_test("no locale with a decimal comma");
        return;
    }
    locale_t before = uselocale(locale);
    char shown[8];
    snprintf(shown, sizeof shown, "%.1f", 1.5);
    CU_ASSERT_STRING_EQUAL(shown, "1,5");
    CU_ASSERT_EQUAL(value_of("1.5 + .25e1"), 4.0);
    uselocale(before);
    freelocale(locale);
}

/* ---- errors ---- */

#define TWENTY "xxxxxxxxxxxxxxxxxxxx"

static const struct {
    const char *text;
    dal_status status;
    int line, column;
    const char *message;
} faults[] = {
    {"", DAL_STATUS_SYNTAX, 1, 1, "the formula is empty"},
    {" \n ", DAL_STATUS_SYNTAX, 1, 1, "the formula is empty"},
    {"2x", DAL_STATUS_SYNTAX, 1, 2, "write 2*x"},
    {"x + 2.5 y'", DAL_STATUS_SYNTAX, 1, 9, "write 2.5*y'"},
    {"2(x)", DAL_STATUS_SYNTAX, 1, 2, "write 2*("},
    {"2sin(x)", DAL_STATUS_SYNTAX, 1, 2, "write 2*sin"},
    {"x y", DAL_STATUS_SYNTAX, 1, 3, "an operator is missing before 'y'"},
    {"(x)(y)", DAL_STATUS_SYNTAX, 1, 4, "an operator is missing before '('"},
    {"1.2.3", DAL_STATUS_SYNTAX, 1, 4, "an operator is missing before '.3'"},
    {"(x", DAL_STATUS_SYNTAX, 1, 1, "'(' is never closed"},
    {"x*((y + 1)", DAL_STATUS_SYNTAX, 1, 3, "'(' is never closed"},
    {"sin(x", DAL_STATUS_SYNTAX, 1, 1, "'(' is never closed"},
    {"x)", DAL_STATUS_SYNTAX, 1, 2, "')' closes no '('"},
    {"()", DAL_STATUS_SYNTAX, 1, 2, "a value is missing before ')'"},
    {"x +", DAL_STATUS_SYNTAX, 1, 4, "a value is missing at the end"},
    {"x + * y", DAL_STATUS_SYNTAX, 1, 5, "a value is missing before '*'"},
    {"-", DAL_STATUS_SYNTAX, 1, 2, "a value is missing at the end"},
    {"^2", DAL_STATUS_SYNTAX, 1, 1, "a value is missing before '^'"},
    {"x, y", DAL_STATUS_SYNTAX, 1, 2, "',' outside the arguments of a function"},
    {"(x, y)", DAL_STATUS_SYNTAX, 1, 3, "',' outside the arguments of a function"},
    {"sin(x, y)", DAL_STATUS_SYNTAX, 1, 1, "sin takes 1 argument, not 2"},
    {"1 + sqrt()", DAL_STATUS_SYNTAX, 1, 5, "sqrt takes 1 argument, not 0"},
    {"atan2(x)", DAL_STATUS_SYNTAX, 1, 1, "atan2 takes 2 arguments, not 1"},
    {"atan2(x, y, z)", DAL_STATUS_SYNTAX, 1, 1, "atan2 takes 2 arguments, not 3"},
    {"atan2(x,)", DAL_STATUS_SYNTAX, 1, 9, "a value is missing before ')'"},
    {"x + sin", DAL_STATUS_SYNTAX, 1, 5, "sin is a function"},
    {"x + sine(y)", DAL_STATUS_NAME, 1, 5, "unknown function 'sine'; did you mean 'sin'?"},
    {"SQRT(y)", DAL_STATUS_NAME, 1, 1, "did you mean 'sqrt'?"},
    {"x'(y)", DAL_STATUS_SYNTAX, 1, 1, "x' is not a function: write x'*(...)"},
    {"q'(y)", DAL_STATUS_NAME, 1, 1, "unknown function 'q''"},
    {"a + q'", DAL_STATUS_NAME, 1, 5, "no such name: q'"},
    {"x + pi'", DAL_STATUS_NAME, 1, 5, "no such name: pi'"},
    {"x\n + 3*\n  qq", DAL_STATUS_NAME, 3, 3, "no such name: qq"},
    {"x''", DAL_STATUS_SYNTAX, 1, 3, "second derivative"},
    {"x '", DAL_STATUS_SYNTAX, 1, 3, "unexpected '"},
    {"x/0", DAL_STATUS_SYNTAX, 1, 2, "division by zero"},
    {"1 + 1/(1 - 1)", DAL_STATUS_SYNTAX, 1, 6, "division by zero"},
    {"x/0 + y", DAL_STATUS_SYNTAX, 1, 2, "division by zero"},
    {"(x/0)", DAL_STATUS_SYNTAX, 1, 3, "division by zero"},
    {"max(x/0, y)", DAL_STATUS_SYNTAX, 1, 6, "division by zero"},
    {"x[1/0]", DAL_STATUS_SYNTAX, 1, 4, "division by zero"},
    {"x/(y - y)", DAL_STATUS_SYNTAX, 1, 2, "division by zero"},
    {"0^-1", DAL_STATUS_SYNTAX, 1, 2, "division by zero"},
    {"1/(0*x)", DAL_STATUS_SYNTAX, 1, 2, "division by zero"},
    {"1e999", DAL_STATUS_SYNTAX, 1, 1, "the number 1e999 is too large"},
    {"x + .", DAL_STATUS_SYNTAX, 1, 5, "unexpected '.'"},
    {"x $ y", DAL_STATUS_SYNTAX, 1, 3, "unexpected '$'"},
    {"x = y", DAL_STATUS_SYNTAX, 1, 3, "unexpected '='; a comparison is written =="},
    {"x <", DAL_STATUS_SYNTAX, 1, 4, "a value is missing at the end"},
    {"x < <= y", DAL_STATUS_SYNTAX, 1, 5, "a value is missing before '<='"},
    {"x < y < z", DAL_STATUS_SYNTAX, 1, 7, "comparisons make no chain"},
    {"x ! y", DAL_STATUS_SYNTAX, 1, 3, "unexpected '!'"},
    {"if(x < 1, 2)", DAL_STATUS_SYNTAX, 1, 1, "if takes 3 arguments, not 2"},
    {"min(x)", DAL_STATUS_SYNTAX, 1, 1, "min takes 2 or more arguments, not 1"},
    {"x + max", DAL_STATUS_SYNTAX, 1, 5, "max is a function"},
    {"maxi(x, y)", DAL_STATUS_NAME, 1, 1, "unknown function 'maxi'; did you mean 'max'?"},
    {"x \xc2\xb7 y", DAL_STATUS_SYNTAX, 1, 3, "unexpected byte 0xc2"},
    {"x +\n\ty +\n \x01", DAL_STATUS_SYNTAX, 3, 2, "unexpected byte 0x01"},
    {"x**2", DAL_STATUS_SYNTAX, 1, 2, "a power is written ^, not **"},
    {"x + sum(i, 2, 1, (x", DAL_STATUS_SYNTAX, 1, 5, "a '(' is never closed"},
    {"(x[1)", DAL_STATUS_SYNTAX, 1, 2, "a '[' is never closed"},
    {"1 + " TWENTY TWENTY TWENTY TWENTY TWENTY TWENTY TWENTY "[1]", DAL_STATUS_SYNTAX, 1, 5,
     "a name is too long"},
    {"sum(i, 1, 2, x, y)", DAL_STATUS_SYNTAX, 1, 1, "a sum is written sum(i, 1, N, formula in i)"},
};

/* The formula with a character that none has at one of its marks, |. */
static void test_each_token(void)
{
    static const char marked[] = "|a|*|x|+|sum(|i|,|1|,|3|,|i|*|y|)|-|max(|x|,|y'|)|^|-|2|<"
                                 "|(|z|)|+|sum(|k|,|2|,|1|,|(|x|)|*|k|)|+|x|[|1|+|1|]";
    for (int k = 0;; k++) {
        dal__graph *graph = formula_graph();
        dal__node node = 1;
        dal_error error = {.status = DAL_STATUS_OK};
        char text[sizeof marked + 1];
        int length = 0, column = 0, mark = 0;
        for (const char *c = marked; *c; c++) {
            if (*c != '|') text[length++] = *c;
            if (*c == '|' && mark++ == k)
                text[length++] = ' ', text[length++] = '$', column = length;
        }
        text[length] = '\0';
        const dal_status status = formula_parse(graph, text, &node, &error);
        dal__graph_free(graph);
        if (!column) break;
        const bool is_right = status == DAL_STATUS_SYNTAX && error.column == column &&
                              strcmp(error.message, "unexpected '$'") == 0;
        CU_ASSERT(is_right);
        if (!is_right) printf("\n%s: %d: %s\n", text, error.column, error.message);
    }
}

static void test_faults(void)
{
    for (size_t i = 0; i < sizeof faults / sizeof faults[0]; i++) {
        dal__graph *graph = formula_graph();
        dal__node node = 1;
        dal_error error = {.status = DAL_STATUS_OK};
        dal_status status = formula_parse(graph, faults[i].text, &node, &error);
        bool right = status == faults[i].status && error.status == status && node == 0 &&
                     error.line == faults[i].line && error.column == faults[i].column &&
                     strstr(error.message, faults[i].message);
        CU_ASSERT(right);
        if (!right) {
            fprintf(stderr, "\n%s: %s %d:%d %s\n", faults[i].text, dal_status_name(status),
                    error.line, error.column, error.message);
        }
        CU_ASSERT_EQUAL(formula_parse(graph, faults[i].text, &node, NULL), faults[i].status);
        dal__graph_free(graph);
    }
}

static void test_zero_byte(void)
{
    dal__graph *graph = formula_graph();
    dal__node node;
    dal_error error;
    const dal__names names = {.resolve = formula_resolve, .user = graph};
    dal_status status = dal__parse(graph, "x + \0y", 6, &names, &node, &error);
    CU_ASSERT_EQUAL(status, DAL_STATUS_SYNTAX);
    CU_ASSERT_EQUAL(error.column, 5);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "unexpected byte 0x00"));
    /* A length that no int can hold is refused before a byte is read. */
    CU_ASSERT_EQUAL(dal__parse(graph, "x", INT_MAX, &names, &node, &error), DAL_STATUS_TOO_LARGE);
    CU_ASSERT_STRING_EQUAL(error.message, "the formula is too long");
    /* What lies after the end is not read. */
    CU_ASSERT_EQUAL(dal__parse(graph, "x + y'", 5, &names, &node, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal__inspect(graph, node).op, DAL__ADD);
    CU_ASSERT_EQUAL(dal__symbol(graph, Y), dal__inspect(graph, node).b);
    dal__graph_free(graph);
}

static void test_function_names(void)
{
    CU_ASSERT(dal__is_function("sin", 3));
    CU_ASSERT(dal__is_function("atan2", 5));
    CU_ASSERT_FALSE(dal__is_function("atan2", 4) && !dal__is_function("atan", 4));
    CU_ASSERT_FALSE(dal__is_function("si", 2));
    CU_ASSERT_FALSE(dal__is_function("sign", 4)); /* a system may use it */
    CU_ASSERT(dal__hides_function("sign") && dal__hides_function("if"));
    CU_ASSERT_FALSE(dal__hides_function("sin") || dal__hides_function("x"));
}

/* ---- size ---- */

/* count times piece, between a head and a tail. */
static char *repeated(const char *head, const char *piece, const char *middle, const char *last,
                      int count)
{
    size_t p = strlen(piece), l = strlen(last), size = (p + l) * (size_t)count;
    char *text = malloc(strlen(head) + size + strlen(middle) + 1), *at = text;
    at += sprintf(at, "%s", head);
    for (int i = 0; i < count; i++, at += p) memcpy(at, piece, p);
    at += sprintf(at, "%s", middle);
    for (int i = 0; i < count; i++, at += l) memcpy(at, last, l);
    *at = '\0';
    return text;
}

static void check_repeated(const char *head, const char *piece, const char *middle,
                           const char *last, int count, double expected)
{
    char *text = repeated(head, piece, middle, last, count);
    double value = value_of(text);
    CU_ASSERT_DOUBLE_EQUAL(value, expected, 1e-9 * fabs(expected));
    free(text);
}

static void test_deep_nesting(void)
{
    check_repeated("", "(", "x", ")", 100000, 0.3);
    check_repeated("", "-", "x", "", 100000, 0.3);
    check_repeated("", "cos(", "x", ")", 20000, 0.7390851332151607); /* cos x = x */
    check_repeated("", "1^", "x", "", 50000, 1.0);
    check_repeated("", "atan2(0*x,", "y", ")", 10000, 0.0);
    check_repeated("", "if(x<1,", "y", ",x)", 10000, 2.5);
}

/* The first terms do not show how many there are: 1 + (1 + 2 + ... + 2900) = 4 206 451. */
static void test_sums_that_grow(void)
{
    dal__graph *graph = formula_graph();
    dal__node node;
    dal_error error = {.status = DAL_STATUS_OK};
    const char *text = "sum(i, 1, 2901, sum(j, 2, i, 1))";
    CU_ASSERT_EQUAL(formula_parse(graph, text, &node, &error), DAL_STATUS_TOO_LARGE);
    CU_ASSERT_STRING_EQUAL(error.message, "sums of more than 4000000 terms in a formula");
    dal__graph_free(graph);
}

static void test_deep_sums(void)
{
    check_repeated("", "sum(i,1,1,", "x", ")", 16, 0.3);
    char *text = repeated("", "sum(i,1,1,", "x", ")", 17);
    dal__graph *graph = formula_graph();
    dal__node node;
    dal_error error = {.status = DAL_STATUS_OK};
    CU_ASSERT_EQUAL(formula_parse(graph, text, &node, &error), DAL_STATUS_SYNTAX);
    CU_ASSERT(error.status == DAL_STATUS_SYNTAX && error.line == 1 && error.column == 16 * 10 + 1);
    CU_ASSERT_STRING_EQUAL(error.message, "sums nest deeper than 16");
    dal__graph_free(graph);
    free(text);
}

/* ---- functions of the caller ---- */

enum { NEXT, NEVER };

static const char *own_name(void *user, int i, int *arity)
{
    (void)user;
    *arity = 1;
    return i == NEXT ? "next" : i == NEVER ? "never" : NULL;
}

static dal__node call_own(void *user, int i, const dal__node *argument, dal_error *error)
{
    if (i == NEXT) return dal__node_add(user, argument[0], dal__number(user, 1.0));
    error->status = DAL_STATUS_MODEL;
    snprintf(error->message, sizeof error->message, "never has no value");
    return 0;
}

/* What a function refuses is at its name; a graph that is full, at the bracket that calls it. */
static void test_own_functions(void)
{
    static const struct {
        const char *text;
        int limit;
        dal_status status;
        int column;
        const char *message;
    } cases[] = {
        {"2*next(x)", 100, DAL_STATUS_OK, 0, ""},
        {"2*next(x)", 3, DAL_STATUS_TOO_LARGE, 9, "the formula is too large"},
        {"2*next(x)", 2, DAL_STATUS_TOO_LARGE, 9, "the formula is too large"},
        {"2*never(x)", 100, DAL_STATUS_MODEL, 3, "never has no value"},
        {"2*next(x, y)", 100, DAL_STATUS_SYNTAX, 3, "next takes 1 argument, not 2"},
        {"2*next", 100, DAL_STATUS_SYNTAX, 3, "next is a function: write next(...)"},
        {"2*nest(x)", 100, DAL_STATUS_NAME, 3, "unknown function 'nest'; did you mean 'next'?"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        dal__graph *graph = formula_graph();
        const dal__names names = {formula_resolve, own_name, call_own, graph, false};
        dal__node node = 0;
        dal_error error = {.status = DAL_STATUS_OK};
        graph->limit = cases[i].limit;
        CU_ASSERT_EQUAL(
            dal__parse(graph, cases[i].text, strlen(cases[i].text), &names, &node, &error),
            cases[i].status);
        CU_ASSERT_EQUAL(error.status, cases[i].status);
        if (cases[i].status == DAL_STATUS_OK)
            CU_ASSERT_EQUAL(dal__evaluate(graph, node, point), 2.6);
        if (cases[i].status != DAL_STATUS_OK)
            CU_ASSERT_STRING_EQUAL(error.message, cases[i].message);
        if (cases[i].status != DAL_STATUS_OK) CU_ASSERT_EQUAL(error.column, cases[i].column);
        dal__graph_free(graph);
    }
}

static void test_long_formulas(void)
{
    check_repeated("0", "+x*y", "", "", 25000, 25000 * 0.75);
    check_repeated("y", "+1e-4*x", "", "", 14000, 2.5 + 14000 * 0.3e-4);
    check_repeated("1", "*(1 + 1e-4*x)", "", "", 10000, pow(1.0 + 0.3e-4, 10000));
}

/* The seconds of the processor for a sum of different terms. */
static double seconds_of_terms(int terms)
{
    char *text = malloc(32 * (size_t)terms), *at = text;
    double expected = 0.0;
    for (int i = 1; i <= terms; i++) {
        at += sprintf(at, "%ssin(%d*x)*y", i == 1 ? "" : "+", i);
        expected += sin(i * 0.3) * 2.5;
    }
    const clock_t start = clock();
    CU_ASSERT_DOUBLE_EQUAL(value_of(text), expected, 1e-9);
    const clock_t end = clock();
    free(text);
    return (double)(end - start) / CLOCKS_PER_SEC;
}

/* Four times as many terms take four times as long, and not sixteen times. */
static void test_many_terms(void)
{
    double few = HUGE_VAL, many = HUGE_VAL;
    for (int i = 0; i < 20 && !(many < 8.0 * few); i++) {
        few = fmin(few, seconds_of_terms(4000));
        many = fmin(many, seconds_of_terms(16000));
    }
    CU_ASSERT(many < 8.0 * few);
}

static void check_memory(const char *text)
{
    allocation_trial trial = {0};
    while (allocation_next(&trial)) {
        dal__node node = 0;
        dal_error error;
        allocation_start(&trial);
        dal__graph *graph = formula_graph();
        const dal__names names = {.resolve = formula_resolve_index, .user = graph};
        allocation_end(&trial, graph ? dal__parse(graph, text, strlen(text), &names, &node, &error)
                                     : DAL_STATUS_MEMORY);
        dal__graph_free(graph);
    }
}

/* No argument is lost where memory runs out for one alone: the first, or the 17th, for which the
 * list of arguments grows. */
static void test_out_of_memory(void)
{
    char *deep = repeated("", "(sin(x)+", "y", ")", 500);
    char *wide = repeated("max(", "x, ", "y)", "", 16);
    /* What is opened when the list of these grows. */
    static const char *const last[] = {"(x)", "-x", "x[1]", "sin(x)", "sum(i, 1, 1, x)", "x + x"};
    for (size_t i = 0; i < sizeof last / sizeof *last; i++) {
        char *full = repeated("", "(", last[i], ")", 31);
        check_memory(full);
        free(full);
    }
    check_memory(deep);
    check_memory("atan2(x, y)");
    check_memory(wide);
    free(deep);
    free(wide);
}

/* A graph that holds no more than a given number of nodes: the status and the column belong to
 * the token that needs the next one, be it of a number, a name, an index, an operation or a sum. */
static void test_every_node(void)
{
    static const struct {
        const char *text;
        int column[8]; /* of the token that needs node 1, 2, ...; 0: no more, or not compared */
    } cases[] = {{"7", {1}},
                 {"x", {1}},
                 {"pi", {1}},
                 {"-x", {2, 3}},
                 {"3 - x[1]", {1, 7, 8, 9}},
                 {"sum(i, 4, 3, x)", {8, 11, 15}},
                 {"sum(i, 4, 3, x) + y", {8, 11, 15, 19}},
                 {"x'^2 + 3*y/(z/2)", {0}},
                 {"x != y", {1, 6}},
                 {"if(x < y, 5, 6)", {0}},
                 {"min(x, y, 3)", {0}},
                 {"sum(i, 1, 3, i*x)", {0}},
                 {"sum(i, 1, 2, i)*sin(cos(y))", {0}}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        dal_status status = DAL_STATUS_TOO_LARGE;
        for (int limit = 0; status != DAL_STATUS_OK && limit < 100; limit++) {
            dal__graph *graph = formula_graph();
            dal__node node = 0;
            dal_error error = {.status = DAL_STATUS_OK};
            graph->limit = limit;
            const dal__names names = {.resolve = formula_resolve_index, .user = graph};
            status = dal__parse(graph, cases[i].text, strlen(cases[i].text), &names, &node, &error);
            const int column = limit < 8 ? cases[i].column[limit] : 0;
            CU_ASSERT_EQUAL(status, graph->status);
            CU_ASSERT_EQUAL(status, error.status);
            CU_ASSERT_EQUAL(status == DAL_STATUS_OK, node > 0);
            if (status != DAL_STATUS_OK)
                CU_ASSERT_STRING_EQUAL(error.message, "the formula is too large");
            if (status != DAL_STATUS_OK && column) CU_ASSERT_EQUAL(error.column, column);
            if (status != DAL_STATUS_OK && column && error.column != column)
                printf("\n%s, node %d: column %d\n", cases[i].text, limit + 1, error.column);
            dal__graph_free(graph);
        }
        CU_ASSERT_EQUAL(status, DAL_STATUS_OK);
    }
}

void suite_formula(void)
{
    CU_pSuite suite = CU_add_suite("formula", NULL, NULL);
    CU_add_test(suite, "precedence and association", test_precedence);
    CU_add_test(suite, "functions against libm", test_functions);
    CU_add_test(suite, "branches and comparisons", test_branches);
    CU_add_test(suite, "numbers to the nearest double", test_numbers);
    CU_add_test(suite, "numbers of a thousand digits", test_long_number);
    CU_add_test(suite, "a decimal comma in the locale", test_locale);
    CU_add_test(suite, "faults: line, column, message", test_faults);
    CU_add_test(suite, "a wrong character at each token", test_each_token);
    CU_add_test(suite, "the byte 0, and the end", test_zero_byte);
    CU_add_test(suite, "names of functions", test_function_names);
    CU_add_test(suite, "deep nesting", test_deep_nesting);
    CU_add_test(suite, "sums in sums", test_deep_sums);
    CU_add_test(suite, "sums that grow", test_sums_that_grow);
    CU_add_test(suite, "functions of the caller", test_own_functions);
    CU_add_test(suite, "long formulas", test_long_formulas);
    CU_add_test(suite, "a graph that is full at each node", test_every_node);
    CU_add_test(suite, "ten thousand terms", test_many_terms);
    CU_add_test(suite, "out of memory", test_out_of_memory);
}
