/* test_coefficients.c - Taylor coefficients against closed forms and identities, interpreted and
 * as C. */
#include "compiler.h"
#include "expr/taylor_emit.h"
#include "formula.h"
#include <CUnit/CUnit.h>
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { ORDER = 24, STRIDE = ORDER + 1, MAX_FORMULAS = 80 };

/* Coefficients of formulas over x, y, z, x', y', z' whose own are given. */
typedef struct expansion {
    dal__graph *graph;
    dal__tapes *tapes;
    dal__taylor *taylor;
    double *work, *memory;
    double unit; /* of time */
} expansion;

/* a = 3, b = 0.7; orders: of how many all coefficients are needed;
 * coordinates: how many inputs after x have the ones after them as derivatives. */
static expansion expand_some(const char *const *formulas, int count, int orders, int coordinates)
{
    expansion e = {.graph = formula_graph()};
    dal__node nodes[MAX_FORMULAS];
    uint32_t places[INPUTS];
    for (int i = 0; i < count; i++) nodes[i] = formula_node(e.graph, formulas[i]);
    e.tapes = dal__tapes_create(e.graph, PARAMETERS, INPUTS);
    CU_ASSERT_EQUAL_FATAL(dal__tapes_add(e.tapes, nodes, count), 0);
    CU_ASSERT_EQUAL_FATAL(dal__tapes_finish(e.tapes), DAL_STATUS_OK);
    for (int i = 0; i < INPUTS; i++) places[i] = (uint32_t)e.tapes->first_input + (uint32_t)i;
    e.taylor = dal__taylor_create(INPUTS, coordinates);
    CU_ASSERT_EQUAL_FATAL(dal__taylor_add(e.taylor, e.tapes, 0, orders, places), DAL_STATUS_OK);
    e.work = formula_work(e.tapes->workspace);
    e.memory = formula_work((size_t)e.taylor->slots * STRIDE);
    e.work[A] = 3.0;
    e.work[B] = 0.7;
    e.unit = 1.0;
    dal__tapes_prepare_x1(e.tapes, e.work);
    return e;
}

static expansion expand(const char *const *formulas, int count)
{
    return expand_some(formulas, count, count, 0);
}

static void expand_free(expansion *e)
{
    free(e->work);
    free(e->memory);
    dal__taylor_free(e->taylor);
    dal__tapes_free(e->tapes);
    dal__graph_free(e->graph);
}

/* Coefficients of the outputs, out[k*count + i], from the inputs' in[k*INPUTS + i]. */
static void run(const char *const *formulas, int count, const double *in, double *out)
{
    expansion e = expand(formulas, count);
    CU_ASSERT_PTR_NULL(e.taylor->refused);
    for (int k = 0; k < STRIDE; k++) {
        dal__taylor_run_x1(e.taylor, e.unit, k, STRIDE, in + k * INPUTS, e.work, e.memory);
        dal__taylor_read_x1(e.taylor, 0, count, k, STRIDE, e.work, e.memory, out + k * count);
    }
    expand_free(&e);
}

/* Closed forms of coefficient k >= 1. */
static double factorial(int k) { return tgamma(k + 1.0); }
static double binomial(double r, int k)
{
    double product = 1.0;
    for (int j = 0; j < k; j++) product *= (r - j) / (j + 1);
    return product;
}
static double of_exp(int k) { return 1.0 / factorial(k); }
static double of_cosh(int k) { return k % 2 ? 0.0 : of_exp(k); }
static double of_sinh(int k) { return k % 2 ? of_exp(k) : 0.0; }
static double of_cos(int k) { return k % 4 == 2 ? -of_cosh(k) : of_cosh(k); }
static double of_sin(int k) { return k % 4 == 3 ? -of_sinh(k) : of_sinh(k); }
static double of_log(int k) { return (k % 2 ? 1.0 : -1.0) / k; }
static double of_atan(int k) { return k % 2 == 0 ? 0.0 : (k % 4 == 1 ? 1.0 : -1.0) / k; }
static double of_asin(int k) { return k % 2 ? fabs(binomial(-0.5, k / 2)) / k : 0.0; }
static double of_acos(int k) { return -of_asin(k); }
static double of_asinh(int k) { return k % 4 == 3 ? -of_asin(k) : of_asin(k); }
static double of_inverse(int k) { return k % 2 ? -1.0 : 1.0; }
static double of_sqrt(int k) { return binomial(0.5, k); }
static double of_power(int k) { return binomial(0.7, k); }
static double of_hypot(int k) { return k % 2 ? 0.0 : binomial(0.5, k / 2); }
static double of_exponent(int k) { return pow(log(3.0), k) / factorial(k); }
/* tan t = sum_(odd j) 8 t/(j^2 pi^2 - 4 t^2) */
static double of_tan(int k)
{
    double sum = 0.0;
    for (int j = 29999; j > 0; j -= 2) sum += pow(j, -k - 1.0);
    return k == 1 ? 1.0 : k % 2 ? 2.0 * pow(2.0 / acos(-1.0), k + 1) * sum : 0.0;
}
static double of_tanh(int k) { return k % 4 == 3 ? -of_tan(k) : of_tan(k); }

static const struct {
    const char *formula;
    double (*coefficient)(int k);
} closed[] = {{"exp(x)", of_exp},        {"sin(x)", of_sin},           {"cos(x)", of_cos},
              {"sinh(x)", of_sinh},      {"cosh(x)", of_cosh},         {"tan(x)", of_tan},
              {"tanh(x)", of_tanh},      {"asin(x)", of_asin},         {"acos(x)", of_acos},
              {"asinh(x)", of_asinh},    {"atan(x)", of_atan},         {"atan2(x, 1)", of_atan},
              {"hypot(x, 1)", of_hypot}, {"hypot(1, x)", of_hypot},    {"log(1 + x)", of_log},
              {"sqrt(1 + x)", of_sqrt},  {"(1 + x)^b", of_power},      {"a^x", of_exponent},
              {"1/(1 + x)", of_inverse}, {"1 - x/(1 + x)", of_inverse}};

/* Functions of x = t. */
static void test_closed(void)
{
    double in[STRIDE * INPUTS] = {0.0}, out[STRIDE];
    in[INPUTS + 0] = 1.0;
    for (size_t i = 0; i < sizeof closed / sizeof *closed; i++) {
        run(&closed[i].formula, 1, in, out);
        for (int k = 1; k < STRIDE; k++) {
            const double expected = closed[i].coefficient(k);
            if (!(fabs(out[k] - expected) <= 1e-13 * fmax(fabs(expected), 1e-300)))
                printf("\n  %s: coefficient %d is %.17g, not %.17g\n", closed[i].formula, k, out[k],
                       expected);
            CU_ASSERT(fabs(out[k] - expected) <= 1e-13 * fmax(fabs(expected), 1e-300));
        }
    }
}

/* Sine and cosine of a coordinate y = 0.5 + 1.5 t, whose derivative is an input, in s = t/tau:
 * coefficient k has (1.5 tau)^k. */
static void test_turns(void)
{
    static const char *const formulas[] = {"sin(y)", "cos(y)"};
    for (int i = 0; i < 4; i++) {
        double in[INPUTS], out[2], power = 1.0;
        expansion e = expand_some(formulas, 2, 2, 2);
        e.unit = ldexp(1.0, 3 * i - 6);
        for (int k = 0; k < STRIDE; k++) {
            if (k > 0) power *= 1.5 * e.unit / k;
            memset(in, 0, sizeof in);
            if (k < 2) in[1] = k == 0 ? 0.5 : 1.5 * e.unit;
            if (k == 0) in[3] = 1.5;
            dal__taylor_run_x1(e.taylor, e.unit, k, STRIDE, in, e.work, e.memory);
            dal__taylor_read_x1(e.taylor, 0, 2, k, STRIDE, e.work, e.memory, out);
            const double turned = 0.5 + k * asin(1.0);
            CU_ASSERT_DOUBLE_EQUAL(out[0], power * sin(turned), 1e-13 * power);
            CU_ASSERT_DOUBLE_EQUAL(out[1], power * cos(turned), 1e-13 * power);
        }
        expand_free(&e);
    }
}

/* Pairs of formulas that are equal, for arguments that are series themselves. */
static const char *const equal[][2] = {{"x*x + 2*x*y + y*y", "(x + y)^2"},
                                       {"sin(x)*cos(y) + cos(x)*sin(y)", "sin(x + y)"},
                                       {"sin(x)", "cos(x - asin(1))"},
                                       {"exp(log(x))", "x"},
                                       {"exp(b*log(x))", "x^b"},
                                       {"exp(y*log(x))", "x^y"},
                                       {"exp(y*log(a))", "a^y"},
                                       {"sqrt(x)*sqrt(x)", "x"},
                                       {"tan(y)*cos(y)", "sin(y)"},
                                       {"tan(atan(x))", "x"},
                                       {"sin(asin(y))", "y"},
                                       {"cos(acos(y))", "y"},
                                       {"sinh(asinh(x))", "x"},
                                       {"tanh(y)*cosh(y)", "sinh(y)"},
                                       {"exp(x)", "sinh(x) + cosh(x)"},
                                       {"hypot(x, y)*hypot(x, y)", "x*x + y*y"},
                                       {"tan(atan2(y, x))", "y/x"},
                                       {"atan2(y, 2)", "atan(y/2)"},
                                       {"atan2(2, x)", "acos(0) - atan(x/2)"},
                                       {"(a*x + y)/b*b - a*x", "y"},
                                       {"a*x - y*z + x*y - 2", "x*(a + y) - (2 + y*z)"},
                                       {"x/y*y/x", "1"}};

/* Inputs without any zeros. */
static void general(double *in)
{
    for (int k = 0; k < STRIDE; k++)
        for (int i = 0; i < INPUTS; i++)
            in[k * INPUTS + i] = k == 0 ? 1.1 - 0.5 * i : sin(2.0 + 3.0 * k + i) / (1 << k);
}

static void test_identities(void)
{
    double in[STRIDE * INPUTS], out[2 * STRIDE];
    general(in);
    for (size_t i = 0; i < sizeof equal / sizeof *equal; i++) {
        double size = 1.0;
        run(equal[i], 2, in, out);
        for (int k = 0; k < STRIDE; k++) {
            size = fmax(size, fabs(out[2 * k]));
            if (!(fabs(out[2 * k] - out[2 * k + 1]) <= 1e-12 * size))
                printf("\n  %s = %s: coefficients %d are %.17g, %.17g\n", equal[i][0], equal[i][1],
                       k, out[2 * k], out[2 * k + 1]);
            CU_ASSERT(fabs(out[2 * k] - out[2 * k + 1]) <= 1e-12 * size);
        }
    }
}

/* ---- written as C ---- */

enum { LANES = 8, CACHE_LINE = 64 };

/* Bodies of a single run, or of lanes. */
static bool write_file(const expansion *e, int order, int lanes, const char *path)
{
    dal__buffer text = {0};
    dal__buffer_print(&text,
                      "#define DAL_LANES %d\n"
                      "#include \"kernel/elementary.h\"\n#include \"kernel/series.h\"\n"
                      "#define DAL_WORK(place) dal_num(w[place])\n"
                      "enum { DAL_FIXED_TAYLOR_ORDER = %d };\n"
                      "#define DAL_FIXED_UNIT_OF_TIME %g\n",
                      lanes, order, e->unit);
    for (int first = 0; first < 2; first++) {
        dal__buffer_print(&text,
                          "void %s(const double *w, int k, num *memory, num *l, num *out)\n{\n"
                          "    num (*const c)[%d] = (num (*)[%d])memory;\n"
                          "    (void)w, (void)k, (void)l;\n",
                          first ? "first" : "next", order + 1, order + 1);
        dal__taylor_write(e->taylor, e->tapes, first ? DAL__FIRST : DAL__NEXT, lanes, &text);
        for (int i = 0; i < e->taylor->outputs; i++) {
            dal__buffer_print(&text, "    out[%d] = ", i);
            dal__taylor_write_output(e->taylor, e->tapes, i, first ? DAL__FIRST : DAL__NEXT, &text);
            dal__buffer_append(&text, ";\n");
        }
        dal__buffer_append(&text, "}\n");
    }
    FILE *file = fopen(path, "w");
    const bool good = file && !text.out_of_memory && fputs(text.bytes, file) >= 0;
    if (file) fclose(file);
    dal__buffer_free(&text);
    return good;
}

typedef void body(const double *w, int k, double *memory, double *l, double *out);

/* Memory of as many numbers, which are NaN. */
static double *numbers(size_t count)
{
    const size_t bytes = (count * sizeof(double) / CACHE_LINE + 1) * CACHE_LINE;
    double *x = aligned_alloc(CACHE_LINE, bytes);
    CU_ASSERT_PTR_NOT_NULL_FATAL(x);
    memset(x, -1, bytes);
    return x;
}

/* Whether lanes of coefficients have the bits of a number. */
static bool all_are(const double *x, int lanes, const double *expected)
{
    bool same = true;
    for (int i = 0; i < lanes; i++) same &= memcmp(x + i, expected, sizeof *x) == 0;
    return same;
}

/* The coefficients below an order by compiled bodies, from the same inputs in all lanes; whether
 * outputs and series that later orders need are e's, where these have a value. */
static bool run_compiled(const expansion *e, int order, int lanes, void *handle, const double *in)
{
    void *at[] = {dlsym(handle, "next"), dlsym(handle, "first")};
    body *bodies[2];
    CU_ASSERT_FATAL(at[0] && at[1]);
    memcpy(bodies, at, sizeof bodies);
    const size_t slots = (size_t)e->taylor->slots, stride = (size_t)order + 1;
    const size_t extra = (size_t)dal__taylor_extra(e->taylor, lanes, order);
    const size_t width = (size_t)lanes, outputs = (size_t)e->taylor->outputs;
    double *memory = numbers(slots * stride * width), *l = numbers(extra * stride * width);
    double *out = numbers(outputs * width), expected[MAX_FORMULAS];
    bool same = true;
    for (int k = 0; k < order; k++) {
        for (size_t i = 0; i < INPUTS * width; i++)
            memory[(i / width * stride + (size_t)k) * width + i % width] =
                in[(size_t)k * INPUTS + i / width];
        bodies[k == 0](e->work, k, memory, l, out);
        dal__taylor_read_x1(e->taylor, 0, (int)outputs, k, STRIDE, e->work, e->memory, expected);
        for (size_t i = 0; i < outputs; i++) same &= all_are(out + i * width, lanes, expected + i);
    }
    for (size_t i = 0; i < slots; i++) {
        const double *x = e->memory + i * STRIDE;
        for (size_t k = 0; k < (e->taylor->kept[i] ? (size_t)order : 1) && !isnan(x[k]); k++)
            same &= all_are(memory + (i * stride + k) * width, lanes, x + k);
    }
    free(memory);
    free(l);
    free(out);
    return same;
}

/* Compiles bodies with options of the compiler, and compares them with the interpreted ones. */
static void check_compiled(const expansion *e, int order, int lanes, const char *options,
                           const double *in)
{
    char folder[] = "/tmp/dal-taylor-XXXXXX", source[64], path[64], command[512];
    CU_ASSERT_PTR_NOT_NULL_FATAL(mkdtemp(folder));
    snprintf(source, sizeof source, "%s/series.c", folder);
    snprintf(path, sizeof path, "%s/series.so", folder);
    snprintf(command, sizeof command,
             "cc -std=gnu11 -w -Wno-psabi %s -ffp-contract=off -shared -fPIC -Ilib -o %s %s -lm",
             options, path, source);
    CU_ASSERT_FATAL(write_file(e, order, lanes, source));
    CU_ASSERT_EQUAL_FATAL(system(command), 0);
    void *handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    CU_ASSERT_PTR_NOT_NULL_FATAL(handle);
    CU_ASSERT(run_compiled(e, order, lanes, handle, in));
    dlclose(handle);
    unlink(path);
    unlink(source);
    rmdir(folder);
}

/* Written bodies have the bits of the interpreted ones, whatever the compiler does. */
static void check_written(const char *const *formulas, int count, int order, const double *in)
{
    double out[MAX_FORMULAS];
    char machine[128];
    expansion e = expand_some(formulas, count, count, 2);
    snprintf(machine, sizeof machine, "-O2%s", compiler_machine());
    e.unit = 0.25;
    memset(e.memory, -1, (size_t)e.taylor->slots * STRIDE * sizeof *e.memory);
    for (int k = 0; k < STRIDE; k++)
        dal__taylor_run_x1(e.taylor, e.unit, k, STRIDE, in + k * INPUTS, e.work, e.memory);
    dal__taylor_read_x1(e.taylor, 0, count, ORDER, STRIDE, e.work, e.memory, out);
    for (int i = 0; i < count; i++) CU_ASSERT(isfinite(out[i]));
    check_compiled(&e, order, 1, "-O0", in);
    check_compiled(&e, order, 1, machine, in);
    check_compiled(&e, order, LANES, machine, in);
    expand_free(&e);
}

/* Of programs with few sums and with many, whose pairs of orders begin with even orders or odd
 * ones. */
static void test_written(void)
{
    const char *formulas[MAX_FORMULAS] = {"if(a < b, x, y)", "x/a", "b - x", "x*y*z", "x^2/y"};
    double in[STRIDE * INPUTS];
    const int few = 5;
    int count = few;
    for (size_t i = 0; i < sizeof closed / sizeof *closed; i++)
        formulas[count++] = closed[i].formula;
    for (size_t i = 0; i < 2 * sizeof equal / sizeof *equal; i++)
        formulas[count++] = equal[i / 2][i % 2];
    if (!compiler_there()) return;
    general(in);
    in[0] = 0.8; /* where asin has a value */
    check_written(formulas, few, STRIDE, in);
    check_written(formulas, count, STRIDE, in);
    check_written(formulas, count, STRIDE - 1, in);
}

/* What has a jump or a kink is named, but where it is constant. */
static void test_refused_formulas(void)
{
    static const char *const formulas[][2] = {{"abs(x)", "abs"},
                                              {"y + sign(x)", "sign"},
                                              {"floor(x)", "floor"},
                                              {"min(x, y)", "min"},
                                              {"max(x, y)", "max"},
                                              {"if(x < y, x, y)", "if"},
                                              {"x*(x < y)", "a comparison"},
                                              {"abs(a)*x", NULL},
                                              {"if(a < b, x, y)", NULL}};
    for (size_t i = 0; i < sizeof formulas / sizeof *formulas; i++) {
        expansion e = expand(formulas[i], 1);
        const char *expected = formulas[i][1], *seen = e.taylor->refused;
        CU_ASSERT_EQUAL(!seen, !expected);
        CU_ASSERT(!seen || !expected || strcmp(seen, expected) == 0);
        expand_free(&e);
    }
}

/* What is needed by its value alone may have a kink; it is not expanded. */
static void test_values(void)
{
    const char *const formulas[] = {"x*x", "abs(y - x)"};
    double in[STRIDE * INPUTS], out[2];
    general(in);
    expansion e = expand_some(formulas, 2, 1, 0);
    CU_ASSERT_PTR_NULL(e.taylor->refused);
    for (int k = 0; k < 2; k++)
        dal__taylor_run_x1(e.taylor, e.unit, k, STRIDE, in + k * INPUTS, e.work, e.memory);
    dal__taylor_read_x1(e.taylor, 0, 2, 0, STRIDE, e.work, e.memory, out);
    CU_ASSERT_EQUAL(out[0], in[0] * in[0]);
    CU_ASSERT_EQUAL(out[1], fabs(in[1] - in[0]));
    dal__taylor_read_x1(e.taylor, 0, 1, 1, STRIDE, e.work, e.memory, out);
    CU_ASSERT_DOUBLE_EQUAL(out[0], 2.0 * in[0] * in[INPUTS], 1e-15);
    expand_free(&e);
}

void suite_coefficients(void)
{
    CU_pSuite suite = CU_add_suite("coefficients", NULL, NULL);
    CU_add_test(suite, "closed forms of coefficients", test_closed);
    CU_add_test(suite, "sine and cosine of a coordinate", test_turns);
    CU_add_test(suite, "identities of series", test_identities);
    CU_add_test(suite, "formulas without Taylor series", test_refused_formulas);
    CU_add_test(suite, "values without coefficients", test_values);
    CU_add_test(suite, "written as C", test_written);
}
