/* test_latex.c - equations in LaTeX: read again as a mathematician reads them, they have the values
 * of the system; names, numbers and brackets. */
#include "allocation.h"
#include "core/buffer.h"
#include "dalembert_codegen.h"
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_ROWS = 256, NAME = 128 };
#define PI 3.14159265358979323846

/* ---- a reader of the formulas -------------------------------------------------------------- */

/* The rows of an alignment, and the values of names. */
typedef struct sheet {
    char *text;
    int rows;
    char *left[MAX_ROWS], *right[MAX_ROWS]; /* in text */
    const dal_system *system;
    const double *parameters, *q, *v;
    double t;
    int depth;
} sheet;

typedef struct reader {
    sheet *page;
    const char *at;
} reader;

static double read_sum(reader *r);
static double find_value(sheet *page, const char *name);

static bool take(reader *r, const char *word)
{
    while (*r->at == ' ' || *r->at == '\n') r->at++;
    if (strncmp(r->at, word, strlen(word)) != 0) return false;
    r->at += strlen(word);
    return true;
}

static void want(reader *r, const char *word)
{
    if (take(r, word)) return;
    printf("\n  no %s at: %.60s", word, r->at);
    CU_FAIL("LaTeX that is not understood");
    r->at += strlen(r->at);
}

static double read_group(reader *r)
{
    want(r, "{");
    const double x = read_sum(r);
    want(r, "}");
    return x;
}

/* The end of a name with its accents and subscript. */
static const char *end_of_name(const char *at)
{
    if (*at == '\\')
        for (at++; (*at >= 'a' && *at <= 'z') || (*at >= 'A' && *at <= 'Z');) at++;
    else
        at++;
    for (int suffix = 0; suffix < 2; suffix++) {
        if (suffix == 1 && *at != '_') break;
        at += suffix;
        if (*at != '{') continue;
        int depth = 0;
        do depth += (*at == '{') - (*at == '}');
        while (at++, depth > 0);
    }
    return at;
}

static double arsinh(double x) { return asinh(x); }
static double sign(double x) { return (x > 0.0) - (x < 0.0); }

static double apply(const char *name, double x, double y)
{
    static const struct {
        const char *name;
        double (*f)(double);
    } one[] = {{"\\sin", sin},   {"\\cos", cos},     {"\\tan", tan},     {"\\exp", exp},
               {"\\ln", log},    {"\\arcsin", asin}, {"\\arccos", acos}, {"\\arctan", atan},
               {"\\sinh", sinh}, {"\\cosh", cosh},   {"\\tanh", tanh},   {"arsinh", arsinh},
               {"sign", sign}};
    static const struct {
        const char *name;
        double (*f)(double, double);
    } two[] = {{"atan2", atan2}, {"min", fmin}, {"max", fmax}};
    for (size_t i = 0; i < sizeof one / sizeof *one; i++)
        if (strcmp(one[i].name, name) == 0) return one[i].f(x);
    for (size_t i = 0; i < sizeof two / sizeof *two; i++)
        if (strcmp(two[i].name, name) == 0) return two[i].f(x, y);
    printf("\n  no function %s", name);
    CU_FAIL("unknown function");
    return NAN;
}

/* f(x), f^{2}(x) or f\left(x, y\right) after the name. */
static double read_call(reader *r, const char *name)
{
    const double power = take(r, "^") ? read_group(r) : 1.0;
    const bool is_wide = take(r, "\\left(");
    if (!is_wide) want(r, "(");
    const double x = read_sum(r), y = take(r, ",") ? read_sum(r) : NAN;
    want(r, is_wide ? "\\right)" : ")");
    return pow(apply(name, x, y), power);
}

/* \begin{cases} a & \text{if } x < y \\ b & \text{else} \end{cases} */
static double read_cases(reader *r)
{
    const double a = read_sum(r);
    want(r, "& \\text{if }");
    const double x = read_sum(r);
    const int is_less = take(r, "<"), is_at_most = !is_less && take(r, "\\le");
    if (!is_less && !is_at_most) want(r, "=");
    const double y = read_sum(r);
    want(r, "\\\\");
    const double b = read_sum(r);
    want(r, "& \\text{else} \\end{cases}");
    return (is_less ? x < y : is_at_most ? x <= y : x == y) ? a : b;
}

static double read_atom(reader *r)
{
    static const char *const functions[] = {"\\sinh",   "\\cosh",   "\\tanh",  "\\sin",
                                            "\\cos",    "\\tan",    "\\exp",   "\\ln",
                                            "\\arcsin", "\\arccos", "\\arctan"};
    double x;
    if (take(r, "\\frac") || take(r, "\\tfrac")) {
        x = read_group(r);
        return x / read_group(r);
    }
    if (take(r, "\\left(")) {
        x = read_sum(r);
        want(r, "\\right)");
        return x;
    }
    if (take(r, "\\left|")) {
        x = read_sum(r);
        want(r, "\\right|");
        return fabs(x);
    }
    if (take(r, "\\left\\lfloor")) {
        x = read_sum(r);
        want(r, "\\right\\rfloor");
        return floor(x);
    }
    if (take(r, "\\sqrt")) return sqrt(read_group(r));
    if (take(r, "\\begin{cases}")) return read_cases(r);
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        if (take(r, functions[i])) return read_call(r, functions[i]);
    char name[NAME];
    if (take(r, "\\operatorname{")) {
        snprintf(name, sizeof name, "%.*s", (int)strcspn(r->at, "}"), r->at);
        r->at += strlen(name) + 1;
        return read_call(r, name);
    }
    if (*r->at >= '0' && *r->at <= '9') {
        char *end;
        x = strtod(r->at, &end);
        r->at = end;
        return x;
    }
    const char *end = end_of_name(r->at);
    snprintf(name, sizeof name, "%.*s", (int)(end - r->at), r->at);
    r->at = end;
    return find_value(r->page, name);
}

static double read_factor(reader *r)
{
    const double x = read_atom(r);
    return take(r, "^") ? pow(x, read_group(r)) : x;
}

/* Factors beside each other are multiplied. */
static double read_term(reader *r)
{
    double x = read_factor(r);
    while (take(r, "\\,") || take(r, "\\cdot")) x *= read_factor(r);
    if (r->at[0] && !strchr("+-}),&|<=", r->at[0]) && strncmp(r->at, "\\", 1) != 0)
        return NAN; /* an operand without an operation */
    return x;
}

static double read_sum(reader *r)
{
    double x = take(r, "-") ? -read_term(r) : read_term(r);
    for (;;) {
        if (take(r, "+"))
            x += read_term(r);
        else if (take(r, "-"))
            x -= read_term(r);
        else
            return x;
    }
}

/* ---- values of names ----------------------------------------------------------------------- */

/* How a name of the fixtures and of shipped systems is written: letters, then digits or one word
 * after _ as its subscript. */
static void write_name(const char *name, const char *accent, char *out)
{
    static const char *const greek[] = {
        "alpha", "beta",  "gamma", "delta", "theta", "lambda",  "mu", "nu",  "rho",  "sigma", "phi",
        "psi",   "omega", "Omega", "kappa", "tau",   "epsilon", "xi", "eta", "zeta", "chi"};
    char letters[NAME], subscript[NAME] = "";
    const size_t n = strcspn(name, "_0123456789");
    snprintf(letters, sizeof letters, n > 1 ? "\\mathrm{%.*s}" : "%.*s", (int)n, name);
    for (size_t i = 0; i < sizeof greek / sizeof *greek; i++)
        if (strlen(greek[i]) == n && strncmp(greek[i], name, n) == 0)
            snprintf(letters, sizeof letters, "\\%s%s", strcmp(greek[i], "phi") ? "" : "var",
                     greek[i]);
    const char *rest = name + n + (name[n] == '_');
    for (size_t i = 0; i < sizeof greek / sizeof *greek; i++)
        if (strcmp(rest, greek[i]) == 0)
            snprintf(subscript, sizeof subscript, "_{\\%s%s}", strcmp(rest, "phi") ? "" : "var",
                     rest);
    if (*rest && !*subscript)
        snprintf(subscript, sizeof subscript,
                 rest[1] && strspn(rest, "0123456789") < strlen(rest) ? "_{\\mathrm{%s}}" : "_{%s}",
                 rest);
    if (accent)
        snprintf(out, NAME, "%s{%.50s}%.50s", accent, letters, subscript);
    else
        snprintf(out, NAME, "%.60s%.60s", letters, subscript);
}

static double row_value(sheet *page, int row)
{
    CU_ASSERT_FATAL(page->depth++ < MAX_ROWS); /* no row means itself */
    reader r = {page, page->right[row]};
    const double x = read_sum(&r);
    page->depth--;
    return x;
}

static double find_value(sheet *page, const char *name)
{
    const dal_system *s = page->system;
    char written[NAME];
    for (int i = 0; i < 2 * s->n; i++) {
        write_name(s->coordinate[i % s->n], i < s->n ? NULL : "\\dot", written);
        if (strcmp(written, name) == 0) return i < s->n ? page->q[i] : page->v[i - s->n];
    }
    for (int i = 0; i < s->parameters; i++) {
        write_name(s->parameter[i], NULL, written);
        if (strcmp(written, name) == 0) return page->parameters[i];
    }
    for (int a = 0; a < s->multipliers; a++) {
        snprintf(written, sizeof written, "g_{%d}", a + 1);
        if (strcmp(written, name) == 0) return page->v[s->n + a];
    }
    for (int row = 0; row < page->rows; row++)
        if (strcmp(page->left[row], name) == 0) return row_value(page, row);
    if (strcmp(name, "t") == 0) return page->t;
    if (strcmp(name, "\\pi") == 0) return PI;
    printf("\n  no name %s", name);
    CU_FAIL("unknown name");
    return NAN;
}

/* ---- the rows ------------------------------------------------------------------------------ */

static const char begin[] = "\\begin{align*}\n  ", end[] = "\n\\end{align*}\n";

/* Splits "left &= right \\" rows; a continued line belongs to its row. */
static void open_page(sheet *page, char *text, const dal_system *system)
{
    page->text = text;
    page->system = system;
    CU_ASSERT_FATAL(strncmp(text, begin, strlen(begin)) == 0);
    char *last = strstr(text, end);
    CU_ASSERT_PTR_NOT_NULL_FATAL(last);
    *last = '\0';
    for (char *more; (more = strstr(text, " \\\\\n    &\\quad"));) memset(more, ' ', 14);
    char *row = text + strlen(begin);
    while (row) {
        char *next = strstr(row, " \\\\\n  ");
        if (next) {
            *next = '\0';
            next += strlen(" \\\\\n  ");
        }
        char *sign = strstr(row, " &= ");
        CU_ASSERT_FATAL(sign && page->rows < MAX_ROWS);
        *sign = '\0';
        for (int i = 0; i < page->rows; i++) CU_ASSERT(strcmp(page->left[i], row) != 0);
        page->left[page->rows] = row;
        page->right[page->rows++] = sign + strlen(" &= ");
        row = next;
    }
}

static int find_row(const sheet *page, const char *left)
{
    for (int row = 0; row < page->rows; row++)
        if (strcmp(page->left[row], left) == 0) return row;
    printf("\n  no row %s", left);
    CU_FAIL_FATAL("a row is missing");
    return 0;
}

static void compare(double found, double expected, const char *what)
{
    const double scale = fabs(expected) > 1.0 ? fabs(expected) : 1.0;
    const bool is_equal =
        fabs(found - expected) <= 1e-11 * scale || (isnan(found) && isnan(expected));
    if (!is_equal) printf("\n  %s: %.17g, not %.17g", what, found, expected);
    CU_ASSERT(is_equal);
}

/* C, D and h of holonomic constraints: what the callbacks return at the point of a page. */
static void check_constraints(sheet *page, dal_evaluator *e, double *out)
{
    const dal_system *s = page->system;
    const int velocities = s->m - s->holonomic;
    char left[NAME];
    if (s->constraints) dal_evaluator_call(e, s->constraints, page->t, page->q, page->v, NULL, out);
    for (int a = 0; a < s->m; a++) {
        const int n = snprintf(left, sizeof left, "D_{%d}", a + 1);
        if (a >= velocities)
            snprintf(left + n, sizeof left - (size_t)n, " = \\tfrac{d}{dt}\\,C_{%d}",
                     a - velocities + 1);
        compare(row_value(page, find_row(page, left)), out[a], s->name);
    }
    if (s->holonomic == 0) return;
    dal_evaluator_call(e, s->call.holonomic, page->t, page->q, page->v, NULL, out);
    for (int k = 0; k < s->holonomic; k++) {
        snprintf(left, sizeof left, "C_{%d}", k + 1);
        compare(row_value(page, find_row(page, left)), out[k], s->name);
    }
    dal_evaluator_call(e, s->reactions, page->t, page->q, page->v, NULL, out);
    for (int a = velocities; a < s->m; a++) {
        snprintf(left, sizeof left, "h_{%d}", a + 1);
        compare(row_value(page, find_row(page, left)), out[a], s->name);
    }
}

/* F, C, D and h of the rows at a point about the start are what the callbacks return. */
static void check_system(dal_model *model)
{
    const dal_system *s;
    dal_error error = {0};
    sheet page = {.t = 0.3};
    char *text = NULL, left[2 * NAME + 8], name[NAME], coordinate[NAME];
    CU_ASSERT_EQUAL_FATAL(dal_model_system(model, &s, &error), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_model_latex(model, &text, &error), DAL_STATUS_OK);
    open_page(&page, text, s);
    dal_evaluator *e = fixture_evaluator(s);
    const int n = s->n, nw = n + s->multipliers;
    double *x = calloc((size_t)(2 * (n + nw) + s->m * (1 + n) + n + 1), sizeof *x),
           *out = x + n + nw + 1; /* h, R too */
    dal_evaluator_start(e, NULL, 0, x, &error);
    for (int i = 0; i < n + nw; i++) x[i] += 0.01 * (i + 1);
    page.q = x, page.v = x + n, page.parameters = s->value;
    CU_ASSERT_EQUAL(dal_evaluator_call(e, s->call.field, page.t, page.q, page.v, NULL, out),
                    DAL_STATUS_OK);
    for (int i = 0; i < nw; i++) {
        snprintf(left, sizeof left, "\\dot{g}_{%d}", i - n + 1);
        if (i < n) write_name(s->coordinate[i], "\\ddot", left);
        if (i < n) write_name(s->coordinate[i], NULL, coordinate);
        if (s->multipliers == 0) snprintf(left + strlen(left), NAME, " = F_{%.100s}", coordinate);
        snprintf(name, sizeof name, "%.60s: %.50s", s->name, left);
        compare(row_value(&page, find_row(&page, left)), out[i], name);
    }
    check_constraints(&page, e, out);
    free(x);
    dal_evaluator_free(e);
    free(text);
}

static void latex_builtins(void)
{
    const char *name;
    for (int i = 0; (name = dal_builtin_name(i)); i++) {
        dal_model *model;
        CU_ASSERT_EQUAL_FATAL(dal_model_builtin(&model, name, NULL), DAL_STATUS_OK);
        check_system(model);
        dal_model_free(model);
    }
}

static dal_model *model_of(const char *yaml);

/* Each name has one row: a let of L, Q, D and F, and long terms that F shares with L and Q. */
static void latex_names(void)
{
    char yaml[2048], sum[1024] = "x";
    for (int i = 2; i < 30; i++)
        snprintf(sum + strlen(sum), sizeof sum - strlen(sum), " + sin(%d*x)/%d", i, i);
    dal_model *model =
        model_of("coordinates: [x, y]\nlet: {w: 2 + sin(x), k: w*(1 + x^2)}\n"
                 "lagrangian: (x'^2 + y'^2)/2 - k*y\nforces: {x: -k*x'}\n"
                 "constraints: [x' - k*y']\nstart: {x: 0.4, y': 0.3, solve: [x']}\n");
    check_system(model);
    dal_model_free(model);
    snprintf(yaml, sizeof yaml,
             "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (%s)*y\n"
             "forces: {x: -y'*(%s), y: x'*(%s)}\nstart: {x: 0.4, y: 0.7, x': 0.3, y': 0.2}\n",
             sum, sum, sum);
    model = model_of(yaml);
    check_system(model);
    dal_model_free(model);
}

/* Alone, and two with t beside a constraint of velocities. */
static void latex_holonomic(void)
{
    static const char *const files[] = {
        "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - 9.81*y\nholonomic: [x^2 + y^2 - 4]\n"
        "start: {y: -2, x': 0.3}\n",
        "coordinates: [x, y, z, u]\nparameters: {m: 2}\nlagrangian: m/2*(x'^2 + y'^2 + z'^2 + "
        "u'^2) - 9.81*z\n"
        "holonomic: [x^2 + y^2 - z - 0.1*sin(t), x - y]\nconstraints: [u' - x*y']\nstart: {x: 0, "
        "z: 0}\n",
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        dal_model *model = model_of(files[i]);
        check_system(model);
        dal_model_free(model);
    }
}

static dal_model *model_of(const char *yaml)
{
    dal_model *model = NULL;
    dal_error error = {0};
    if (dal_model_read(&model, "hand", yaml, strlen(yaml), &error) != DAL_STATUS_OK)
        printf("\n  %s", error.message);
    CU_ASSERT_PTR_NOT_NULL_FATAL(model);
    return model;
}

/* Every function of formulas, and every place where brackets are needed. */
static void latex_functions(void)
{
    static const char *const formulas[] = {
        "sin(x)*cos(y)^2 + tan(x/4) - sinh(x*y)",
        "cosh(x) + tanh(y) + asinh(x) + exp(-x) + log(2 + x)",
        "asin(x/3) + acos(y/3) + atan(x) + atan2(x, y)",
        "abs(x - y) + sign(x)*y + min(x, y) + max(x, y)*hypot(x, y)",
        "floor(7*x)/3 + sqrt(2 + y)",
        "if(x < y, x, -y) + 2*if(x <= y, 1, 2)",
        "x^1.5 + (x + 1)^(y + 2) + (x/3)^0.3",
        "-(x - y)*(x + y) - (-x)*(3 - (y - 2))",
        "x - (y - (x - (y - 1)))",
        "1/(x + 1/(y + 1/(x + 2)))",
        "1.5e-9*x + 6.02e23*y + 12345.678 + x/3 + pi*y/2 + 0.1",
        "2*3.5*x*(-y) + x*4 - 1e-3*x",
    };
    for (size_t i = 0; i < sizeof formulas / sizeof *formulas; i++) {
        char yaml[512];
        snprintf(yaml, sizeof yaml,
                 "coordinates: [x, y]\naccelerations:\n  x: \"%s\"\n  y: \"x'*(%s)\"\n"
                 "start: {x: 0.4, y: 0.7, x': 0.3, y': 0.2}\n",
                 formulas[i], formulas[i]);
        dal_model *model = model_of(yaml);
        check_system(model);
        dal_model_free(model);
    }
}

/* Texts that were written by hand. */
static void latex_texts(void)
{
    static const char *const wanted[] = {
        "L &= \\tfrac{1}{2}\\,m_{\\mathrm{ball}}\\,\\left(\\dot{\\varphi}^{2} + "
        "\\dot{x}_{12}^{2}\\right)",
        "Q_{x_{12}} &= 1 \\cdot 10^{-7}\\,\\dot{\\varphi}",
        "D_{1} &= \\dot{\\varphi}\\,\\sin^{2}(x_{12}) - \\dot{x}_{12} = 0",
        "\\ddot{\\varphi} = F_{\\varphi} &= ",
        "H &= \\frac{\\pi_{\\varphi}^{2} + \\pi_{x_{12}}^{2}}{2\\,e} + "
        "\\pi_{\\varphi}\\,F_{\\varphi}"
        " + \\pi_{x_{12}}\\,F_{x_{12}} + p_{\\varphi}\\,\\dot{\\varphi} + "
        "p_{x_{12}}\\,\\dot{x}_{12}"};
    dal_model *model =
        model_of("coordinates: [phi, x12]\nparameters: {m_ball: 2}\n"
                 "lagrangian: m_ball/2*(phi'^2 + x12'^2)\n"
                 "forces: {x12: 1e-7*phi'}\n" /* the one before it is 0 */
                 "constraints: [phi'*sin(x12)^2 - x12']\nstart: {x12: 1, solve: [x12']}\n");
    char *text = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_model_latex(model, &text, NULL), DAL_STATUS_OK);
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
        CU_ASSERT_PTR_NOT_NULL(strstr(text, wanted[i]));
        if (!strstr(text, wanted[i])) printf("\n  no %s in\n%s", wanted[i], text);
    }
    free(text);
    dal_model_free(model);
}

/* K of each effort, and pi.K pi of H, in both forms; the transpose is U+1D5B3. */
static void latex_efforts(void)
{
    static const char *const wanted[] = {
        [DAL_EFFORT_MASS] = "K &= W^{-1}",
        [DAL_EFFORT_CONSTRAINT] = "K &= P\\,W^{-1} P^{\\mathsf{T}}",
        [DAL_EFFORT_CONTROLS] = "K &= P\\,W^{-1} C\\,C^{\\mathsf{T}} W^{-1} P^{\\mathsf{T}}"};
    for (dal_effort effort = DAL_EFFORT_MASS; effort <= DAL_EFFORT_CONTROLS; effort++) {
        dal_model *model = model_of("coordinates: [x, y]\nlagrangian: (x'^2 + 2*y'^2)/2\n"
                                    "constraints: [x' - 2*y']\ncontrols: [{x: 1}]\n");
        char *text = NULL;
        int transposes = 0;
        CU_ASSERT_EQUAL(dal_model_set_effort(model, effort, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL_FATAL(dal_model_latex(model, &text, NULL), DAL_STATUS_OK);
        CU_ASSERT_PTR_NOT_NULL(strstr(text, wanted[effort]));
        CU_ASSERT_PTR_NOT_NULL(strstr(text, "\\pi^{\\mathsf{T}} K\\,\\pi"));
        free(text);
        CU_ASSERT_EQUAL_FATAL(dal_model_mathml(model, &text, NULL), DAL_STATUS_OK);
        for (const char *at = text; (at = strstr(at, "<mi>&#x1D5B3;</mi>")); at++) transposes++;
        CU_ASSERT_EQUAL(transposes, 1 + (int)(effort - DAL_EFFORT_MASS));
        free(text);
        dal_model_free(model);
    }
}

/* The size of a text does not double with each let; what vakonomic motion has no lift for is left
 * out; no memory is a status. */
static void latex_limits(void)
{
    char yaml[4096];
    int length = snprintf(yaml, sizeof yaml, "coordinates: [x]\nlet:\n  a0: x + x^2\n");
    for (int i = 1; i <= 40; i++)
        length += snprintf(yaml + length, sizeof yaml - (size_t)length, "  a%d: a%d*(1 + a%d)\n", i,
                           i - 1, i - 1);
    snprintf(yaml + length, sizeof yaml - (size_t)length,
             "accelerations: {x: a40}\nstart: {x: 0.1}\n");
    dal_model *model = model_of(yaml);
    char *text = NULL;
    CU_ASSERT_EQUAL_FATAL(dal_model_latex(model, &text, NULL), DAL_STATUS_OK);
    CU_ASSERT(strlen(text) < 10000);
    free(text);
    dal_model_free(model);
    CU_ASSERT_EQUAL_FATAL(dal_model_builtin(&model, "chaplygin-sleigh-vakonomic", NULL),
                          DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_model_latex(model, &text, NULL), DAL_STATUS_OK);
    CU_ASSERT_PTR_NULL(strstr(text, "H &="));
    free(text);
    allocation_trial trial = {0};
    while (allocation_next(&trial)) {
        allocation_start(&trial);
        allocation_end(&trial, dal_model_latex(model, &text, NULL));
        free(text);
    }
    for (trial = (allocation_trial){0}; allocation_next(&trial);) {
        allocation_start(&trial);
        allocation_end(&trial, dal_model_mathml(model, &text, NULL));
        free(text);
    }
    dal_model_free(model);
}

/* MathML of a sine of a sine of .. x; its brackets nest as often. */
static dal_status nested_status(int times)
{
    dal__buffer yaml = {0};
    char *text;
    dal__buffer_append(&yaml, "coordinates: [x]\naccelerations: {x: \"");
    for (int i = 0; i < times; i++) dal__buffer_append(&yaml, "sin(");
    dal__buffer_append(&yaml, "x");
    for (int i = 0; i < times; i++) dal__buffer_append(&yaml, ")");
    dal__buffer_append(&yaml, "\"}\nstart: {x: 0.1}\n");
    dal_model *model = model_of(yaml.bytes);
    const dal_status status = dal_model_mathml(model, &text, NULL);
    CU_ASSERT_EQUAL(text == NULL, status != DAL_STATUS_OK);
    free(text);
    dal_model_free(model);
    dal__buffer_free(&yaml);
    return status;
}

/* The documented 400 levels: the row itself and 399 brackets, but not one more. */
static void latex_depth(void)
{
    CU_ASSERT_EQUAL(nested_status(399), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(nested_status(400), DAL_STATUS_TOO_LARGE);
}

void suite_latex(void)
{
    CU_pSuite suite = CU_add_suite("latex", NULL, NULL);
    CU_add_test(suite, "F and D of every system, read again", latex_builtins);
    CU_add_test(suite, "every function and bracket", latex_functions);
    CU_add_test(suite, "holonomic constraints", latex_holonomic);
    CU_add_test(suite, "each name once", latex_names);
    CU_add_test(suite, "texts written by hand", latex_texts);
    CU_add_test(suite, "efforts", latex_efforts);
    CU_add_test(suite, "long formulas, no lift, no memory", latex_limits);
    CU_add_test(suite, "deep formulas as MathML", latex_depth);
}
