/* test_taylor.c - Taylor coefficients against closed forms and identities; the integrator against
 * closed forms and quad references; spaces, lanes, refusals and failures. */
#include "compiler.h"
#include "expr/taylor_emit.h"
#include "fixtures.h"
#include "formula.h"
#include <CUnit/CUnit.h>
#include <dlfcn.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

/* ---- coefficients ---- */

enum { ORDER = 24, STRIDE = ORDER + 1, MAX_FORMULAS = 80 };

/* Coefficients of formulas over x, y, z, x', y', z' whose own are given. */
typedef struct expansion {
    dal__graph *graph;
    dal__tapes *tapes;
    dal__taylor *taylor;
    double *work, *memory;
} expansion;

/* a = 3, b = 0.7; orders: of how many all coefficients are needed. */
static expansion expand_some(const char *const *formulas, int count, int orders)
{
    expansion e = {.graph = formula_graph()};
    dal__node nodes[MAX_FORMULAS];
    uint32_t places[INPUTS];
    for (int i = 0; i < count; i++) nodes[i] = formula_node(e.graph, formulas[i]);
    e.tapes = dal__tapes_create(e.graph, PARAMETERS, INPUTS);
    CU_ASSERT_EQUAL_FATAL(dal__tapes_add(e.tapes, nodes, count), 0);
    CU_ASSERT_EQUAL_FATAL(dal__tapes_finish(e.tapes), DAL_STATUS_OK);
    for (int i = 0; i < INPUTS; i++) places[i] = (uint32_t)e.tapes->first_input + (uint32_t)i;
    e.taylor = dal__taylor_create(INPUTS, 0);
    CU_ASSERT_EQUAL_FATAL(dal__taylor_add(e.taylor, e.tapes, 0, orders, places), DAL_STATUS_OK);
    e.work = formula_work(e.tapes->workspace);
    e.memory = formula_work((size_t)e.taylor->slots * STRIDE);
    e.work[A] = 3.0;
    e.work[B] = 0.7;
    dal__tapes_prepare_x1(e.tapes, e.work);
    return e;
}

static expansion expand(const char *const *formulas, int count)
{
    return expand_some(formulas, count, count);
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
        dal__taylor_run_x1(e.taylor, k, STRIDE, in + k * INPUTS, e.work, e.memory);
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

/* Bodies of lanes, and of a single run. */
static const char *const body_names[2][2] = {{"next", "first"}, {"next_packed", "first_packed"}};

static bool write_file(const expansion *e, const char *path)
{
    dal__buffer text = {0};
    dal__buffer_print(&text,
                      "#include \"kernel/elementary.h\"\n#include \"kernel/series.h\"\n"
                      "#define DAL_WORK(place) w[place]\nenum { DAL_FIXED_TAYLOR_ORDER = %d };\n",
                      STRIDE);
    for (int body = 0; body < 4; body++) {
        dal__buffer_print(&text, "void %s(const double *w, int k, double (*c)[%d], double *l)\n{\n",
                          body_names[body / 2][body % 2], STRIDE + 1);
        dal__buffer_append(&text, "    (void)w, (void)k, (void)l;\n");
        dal__taylor_write(e->taylor, e->tapes, body % 2, body / 2, &text);
        dal__buffer_append(&text, "}\n");
    }
    FILE *file = fopen(path, "w");
    const bool good = file && !text.out_of_memory && fputs(text.bytes, file) >= 0;
    if (file) fclose(file);
    dal__buffer_free(&text);
    return good;
}

typedef void body(const double *w, int k, double (*c)[STRIDE + 1], double *l);

/* All coefficients of all series by compiled bodies; whether they are e's. */
static bool run_compiled(const expansion *e, void *handle, const char *const *name,
                         const double *in)
{
    void *at[] = {dlsym(handle, name[0]), dlsym(handle, name[1])};
    body *bodies[2];
    CU_ASSERT_FATAL(at[0] && at[1]);
    memcpy(bodies, at, sizeof bodies);
    const size_t slots = (size_t)e->taylor->slots;
    double *memory = formula_work(slots * (STRIDE + 1));
    double *packed = formula_work((size_t)dal__taylor_packed(e->taylor) * (STRIDE + 1));
    double(*c)[STRIDE + 1] = (double(*)[STRIDE + 1]) memory;
    memset(memory, 0, slots * (STRIDE + 1) * sizeof *memory);
    bool same = true;
    for (int k = 0; k < STRIDE; k++) {
        for (int i = 0; i < INPUTS; i++) c[i][k] = in[k * INPUTS + i];
        bodies[k == 0](e->work, k, c, packed);
    }
    for (size_t i = 0; i < slots; i++)
        same &= memcmp(c[i], e->memory + i * STRIDE, STRIDE * sizeof(double)) == 0;
    free(memory);
    free(packed);
    return same;
}

/* Written bodies have the bits of the interpreted ones, whatever the compiler does. */
static void test_written(void)
{
    const char *const levels[][2] = {{"-O0", ""}, {"-O2", ""}, {"-O3", compiler_machine()}};
    const char *formulas[MAX_FORMULAS] = {"if(a < b, x, y)", "x/a", "b - x"};
    double in[STRIDE * INPUTS], out[MAX_FORMULAS];
    char folder[] = "/tmp/dal-taylor-XXXXXX", source[64], path[64], command[512];
    int count = 3;
    for (size_t i = 0; i < sizeof closed / sizeof *closed; i++)
        formulas[count++] = closed[i].formula;
    for (size_t i = 0; i < 2 * sizeof equal / sizeof *equal; i++)
        formulas[count++] = equal[i / 2][i % 2];
    if (!compiler_there()) return;
    general(in);
    in[0] = 0.8; /* where asin has a value */
    expansion e = expand(formulas, count);
    memset(e.memory, 0, (size_t)e.taylor->slots * STRIDE * sizeof *e.memory);
    for (int k = 0; k < STRIDE; k++)
        dal__taylor_run_x1(e.taylor, k, STRIDE, in + k * INPUTS, e.work, e.memory);
    dal__taylor_read_x1(e.taylor, 0, count, ORDER, STRIDE, e.work, e.memory, out);
    CU_ASSERT(isfinite(out[0]) && isfinite(out[count - 1]));
    CU_ASSERT_PTR_NOT_NULL_FATAL(mkdtemp(folder));
    snprintf(source, sizeof source, "%s/series.c", folder);
    CU_ASSERT_FATAL(write_file(&e, source));
    for (int i = 0; i < 3; i++) {
        snprintf(path, sizeof path, "%s/series%d.so", folder, i);
        snprintf(command, sizeof command,
                 "cc -std=gnu11 %s%s -ffp-contract=off -shared -fPIC -Ilib -o %s %s -lm",
                 levels[i][0], levels[i][1], path, source);
        CU_ASSERT_EQUAL_FATAL(system(command), 0);
        void *handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
        CU_ASSERT_PTR_NOT_NULL_FATAL(handle);
        CU_ASSERT(run_compiled(&e, handle, body_names[0], in));
        CU_ASSERT(run_compiled(&e, handle, body_names[1], in));
        dlclose(handle);
        unlink(path);
    }
    unlink(source);
    rmdir(folder);
    expand_free(&e);
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
    expansion e = expand_some(formulas, 2, 1);
    CU_ASSERT_PTR_NULL(e.taylor->refused);
    for (int k = 0; k < 2; k++)
        dal__taylor_run_x1(e.taylor, k, STRIDE, in + k * INPUTS, e.work, e.memory);
    dal__taylor_read_x1(e.taylor, 0, 2, 0, STRIDE, e.work, e.memory, out);
    CU_ASSERT_EQUAL(out[0], in[0] * in[0]);
    CU_ASSERT_EQUAL(out[1], fabs(in[1] - in[0]));
    dal__taylor_read_x1(e.taylor, 0, 1, 1, STRIDE, e.work, e.memory, out);
    CU_ASSERT_DOUBLE_EQUAL(out[0], 2.0 * in[0] * in[INPUTS], 1e-15);
    expand_free(&e);
}

/* ---- runs ---- */

static dal_run_spec spec_of(const char *system, dal_space space, double step, double tolerance)
{
    dal_run_spec spec = fixture_spec(fixture_system(system), "taylor", space, step);
    spec.options.tolerance = tolerance;
    return spec;
}

static double distance(const double *x, const double *y, int count)
{
    double max = 0.0;
    for (int i = 0; i < count; i++) max = fmax(max, fabs(x[i] - y[i]));
    return max;
}

/* Kepler motion of eccentricity 0.9 after two periods, and the circle of a linear oscillator. */
static const char kepler[] = "coordinates: [x, y]\n"
                             "lagrangian: (x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2)\n"
                             "start: {x: 0.1, y: 0, x': 0, y': sqrt(19)}\n";
static const char oscillator[] = "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x: 1}\n";
#define PERIOD 6.283185307179586477

/* The error per tolerance grows with the motion: Kepler's amplifies errors by some 1e4. */
static void test_closed_motion(void)
{
    static const double tolerances[] = {1e-6, 1e-10, 1e-13, 1e-18};
    for (int k = 0; k < 4; k++) {
        const double error = tolerances[k] + 4e-16;
        dal_run *a = NULL, *b = NULL;
        dal_run_spec spec = spec_of(oscillator, DAL_PHYSICAL, 3.7, tolerances[k]);
        a = fixture_stepped(&spec, 10);
        CU_ASSERT(fabs(dal_run_state(a)[0] - cos(37.0)) <= 40.0 * error);
        CU_ASSERT(fabs(dal_run_state(a)[1] + sin(37.0)) <= 40.0 * error);
        spec = spec_of(kepler, DAL_PHYSICAL, PERIOD, tolerances[k]);
        b = fixture_stepped(&spec, 2);
        CU_ASSERT(fabs(dal_run_state(b)[0] - 0.1) <= 1e4 * error);
        CU_ASSERT(fabs(dal_run_state(b)[1]) <= 1e4 * error);
        dal_run_free(a);
        dal_run_free(b);
    }
}

/* Against gauss12 in quad precision: time-dependent and velocity-dependent forces, a full mass
 * matrix, nonlinear constraints; displaced momenta on the lifted space. */
static void test_quad_reference(void)
{
    static const double tolerances[] = {1e-6, 1e-10, 1e-13, 1e-18};
    dal_run_spec spec = fixture_spec(fixture_system(fixture_gentle), "gauss12", DAL_LIFTED, 0.02);
    spec.options.precision = DAL_QUAD;
    for (int lifted = 0; lifted < 2; lifted++) {
        spec.options.space = lifted ? DAL_LIFTED : DAL_PHYSICAL;
        dal_run *reference = fixture_run(&spec);
        const int dim = dal_run_dimension(reference);
        if (lifted) fixture_perturb(reference, 0.3);
        CU_ASSERT_EQUAL(dal_run_advance(reference, 50, NULL), DAL_STATUS_OK);
        for (int k = 0; k < 4; k++) {
            dal_run_spec own = spec_of(fixture_gentle, spec.options.space, 0.5, tolerances[k]);
            dal_run *run = fixture_run(&own);
            if (lifted) fixture_perturb(run, 0.3);
            CU_ASSERT_EQUAL(dal_run_advance(run, 2, NULL), DAL_STATUS_OK);
            const double error = distance(dal_run_state(run), dal_run_state(reference), dim);
            if (!(error <= 10.0 * (tolerances[k] + 2e-16)))
                printf("\n  %d, tolerance %g: error %g\n", lifted, tolerances[k], error);
            CU_ASSERT(error <= 10.0 * (tolerances[k] + 2e-16));
            dal_run_free(run);
        }
        dal_run_free(reference);
    }
}

/* In quad precision the energy of an elliptic motion holds to 30 digits. */
static void test_quad(void)
{
    dal_run_spec spec = spec_of(oscillator, DAL_PHYSICAL, 2.5, 1e-32);
    double out[8];
    spec.options.precision = DAL_QUAD;
    dal_run *run = fixture_stepped(&spec, 4);
    CU_ASSERT_EQUAL(dal_run_observe(run, out), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(out[0], 0.5);
    CU_ASSERT_EQUAL(dal_run_state(run)[0], cos(10.0));
    dal_run_free(run);
}

/* On the surface (q,v) has the same bits in both spaces and for any gauge. */
static void test_surface(void)
{
    static const double tolerances[] = {0.0, 1e-9};
    for (int k = 0; k < 2; k++) {
        dal_run_spec spec = spec_of(fixture_full, DAL_PHYSICAL, 0.1, tolerances[k]);
        dal_run *physical = fixture_stepped(&spec, 5);
        spec.options.space = DAL_LIFTED;
        dal_run *lifted = fixture_stepped(&spec, 5);
        const int count = dal_run_dimension(physical);
        CU_ASSERT_EQUAL(
            memcmp(dal_run_state(physical), dal_run_state(lifted), (size_t)count * sizeof(double)),
            0);
        for (int i = count + 1; i < 2 * count + 2; i++) CU_ASSERT(dal_run_state(lifted)[i] == 0.0);
        dal_run_free(physical);
        dal_run_free(lifted);
    }
}

/* At rest nothing but the momenta moves: with 1/e = 0, pi = cos t and p = sin t. */
static void test_momenta_alone(void)
{
    const dal_setting start[] = {{"x", 0.0}, {"e", INFINITY}, {"pi_x", 1.0}};
    dal_run_spec spec = spec_of(oscillator, DAL_LIFTED, 20.0, 1e-10);
    spec.start = start;
    spec.start_count = 3;
    dal_run *run = fixture_stepped(&spec, 1);
    const double *z = dal_run_state(run);
    CU_ASSERT_DOUBLE_EQUAL(z[3], sin(20.0), 2e-9);
    CU_ASSERT_DOUBLE_EQUAL(z[4], cos(20.0), 2e-9);
    CU_ASSERT(z[0] == 0.0 && z[1] == 0.0 && z[2] == INFINITY);
    dal_run_free(run);
}

/* x'' = 0 with a moving e = 2 + sin t: p' = 0, pi = pi_0 - p t, v' = pi/e, pi_e' = pi^2/2e^2. */
static void test_gauge(void)
{
    static const char free_point[] = "coordinates: [x]\nlagrangian: x'^2/2\n"
                                     "gauge: {e: 2, mu_e: cos(t)}\nstart: {x: 1, x': 0.3}\n";
    const dal_setting start[] = {{"pi_x", 0.7}, {"p_x", 0.1}};
    dal_run_spec spec = spec_of(free_point, DAL_LIFTED, 2.0, 1e-13);
    spec.start = start;
    spec.start_count = 2;
    dal_run *run = fixture_stepped(&spec, 1);
    const double *z = dal_run_state(run);
    double v = 0.3, pi_e = 0.0, x = 1.0;
    enum { PARTS = 20000 };
    for (int i = 0; i <= PARTS; i++) { /* Simpson's rule; x by parts */
        const double t = 2.0 * i / PARTS, w = (0.7 - 0.1 * t) / (2.0 + sin(t));
        const double weight = (i == 0 || i == PARTS ? 1.0 : i % 2 ? 4.0 : 2.0) * 2.0 / PARTS / 3.0;
        v += weight * w;
        pi_e += weight * w * w / 2.0;
        x += weight * (2.0 - t) * w;
    }
    CU_ASSERT_DOUBLE_EQUAL(z[0], x + 0.6, 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(z[1], v, 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(z[2], 2.0 + sin(2.0), 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(z[3], 0.1, 1e-15);
    CU_ASSERT_DOUBLE_EQUAL(z[4], 0.5, 1e-15);
    CU_ASSERT_DOUBLE_EQUAL(z[5], pi_e, 1e-12);
    dal_run_free(run);
}

/* Lanes have the bits of single runs, with steps of one size and with their own.  Of t^50 - 400 x
 * the lane that begins at 0 rejects substeps while others accept theirs. */
static void test_lanes(void)
{
    static const char forced[] = "coordinates: [x]\naccelerations: {x: t^50 - 400*x}\n";
    fixture_lanes(spec_of(forced, DAL_PHYSICAL, 1.2, 1e-10), 5, 2, "x", 0.0, 0.5);
    for (int k = 0; k < 2; k++)
        fixture_lanes(spec_of(kepler, DAL_LIFTED, PERIOD / 100, k == 0 ? 0.0 : 1e-11), 13, 5, "x",
                      0.3, 0.05);
}

/* Where all last coefficients vanish at the start, or most of them everywhere, the defect at the
 * end of a step shows it: x'' = t^50, and x'' = -x^7, whose series from x = 0 has each eighth
 * term. */
static void test_gaps(void)
{
    static const char monomial[] = "coordinates: [x]\naccelerations: {x: t^50}\n";
    static const char septic[] = "coordinates: [x]\nlagrangian: x'^2/2 - x^8/8\nstart: {x': 1}\n";
    dal_run_spec spec = spec_of(monomial, DAL_PHYSICAL, 1.2, 1e-10);
    dal_run *run = fixture_stepped(&spec, 1);
    const double x = pow(1.2, 52) / (51 * 52), v = pow(1.2, 51) / 51;
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[0], x, 1e-9 * fmax(1.0, v));
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[1], v, 1e-9 * fmax(1.0, v));
    dal_run_free(run);
    spec = spec_of(septic, DAL_PHYSICAL, 30.0, 1e-10);
    run = fixture_stepped(&spec, 1);
    double out[8];
    CU_ASSERT_EQUAL(dal_run_observe(run, out), DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(out[0], 0.5, 1e-8);
    dal_run_free(run);
}

/* An oscillator with steps that are long beside its motion keeps its amplitude to within roundings,
 * which differ from step to step: after n steps sqrt(n) of them are left.  Coefficients that are
 * rounded alike in each step leave n. */
static void test_long_steps(void)
{
    static const char text[] = "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x: 1}\n";
    enum { STEPS = 10000 };
    static const double step[] = {1.0, 2.0, 2.5};
    for (int i = 0; i < 3; i++)
        for (dal_space space = DAL_LIFTED; space <= DAL_PHYSICAL; space++) {
            const dal_run_spec spec = spec_of(text, space, step[i], 1e-17);
            dal_run *run = fixture_stepped(&spec, STEPS);
            const double amplitude = hypot(dal_run_state(run)[0], dal_run_state(run)[1]);
            CU_ASSERT_DOUBLE_EQUAL(amplitude, 1.0, DBL_EPSILON * sqrt(STEPS) * step[i]);
            dal_run_free(run);
        }
}

/* A circle about a centre that attracts with the potential r^3: r = 1 at the rate sqrt(3); in both
 * spaces, whose second derivatives are branches at r = 0, too. */
static void test_hypot(void)
{
    static const char text[] = "coordinates: [x, y]\n"
                               "lagrangian: (x'^2 + y'^2)/2 - hypot(x, y)^3\n"
                               "start: {x: 1, y': sqrt(3)}\n";
    for (int i = 0; i < 2; i++) {
        const dal_run_spec spec = spec_of(text, i ? DAL_LIFTED : DAL_PHYSICAL, 2.0, 1e-14);
        dal_run *run = fixture_stepped(&spec, 1);
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[0], cos(2.0 * sqrt(3.0)), 1e-13);
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[1], sin(2.0 * sqrt(3.0)), 1e-13);
        dal_run_free(run);
    }
}

static void test_refused(void)
{
    static const char kinked[] = "coordinates: [x]\naccelerations: {x: -abs(x)}\nstart: {x: 1}\n";
    const dal_system hand = {.name = "by hand", .n = 1, .call = {.field = fixture_oscillate}};
    dal_run_spec spec = spec_of(kinked, DAL_PHYSICAL, 0.1, 0.0);
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED,
                    "the equations contain abs, which has no Taylor series");
    spec.system = &hand;
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, "no Taylor series, not being made from a model");
}

static void fails(const char *text, double step, const char *reason)
{
    const dal_run_spec spec = spec_of(text, DAL_PHYSICAL, step, 1e-10);
    dal_error error = {0};
    CU_ASSERT_EQUAL(fixture_failed_step(&spec, &error), DAL_STATUS_NOT_CONVERGED);
    if (!strstr(error.message, reason)) printf("\n  %s\n", error.message);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, reason));
}

static void test_failures(void)
{
    fails("coordinates: [x]\naccelerations: {x: 2*x^3}\nstart: {x: 1, x': 1}\n", 2.0, "at t = 1");
    fails("coordinates: [x]\naccelerations: {x: sqrt(1 - t)}\n", 2.0,
          "the step size went to zero at t = 1");
}

void suite_taylor(void)
{
    CU_pSuite suite = CU_add_suite("taylor", NULL, NULL);
    CU_add_test(suite, "closed forms of coefficients", test_closed);
    CU_add_test(suite, "identities of series", test_identities);
    CU_add_test(suite, "formulas without Taylor series", test_refused_formulas);
    CU_add_test(suite, "values without coefficients", test_values);
    CU_add_test(suite, "written as C", test_written);
    CU_add_test(suite, "motions in closed form", test_closed_motion);
    CU_add_test(suite, "quad references", test_quad_reference);
    CU_add_test(suite, "quad precision", test_quad);
    CU_add_test(suite, "the surface, whatever the space", test_surface);
    CU_add_test(suite, "momenta alone divide a step", test_momenta_alone);
    CU_add_test(suite, "a moving gauge", test_gauge);
    CU_add_test(suite, "lanes of a batch", test_lanes);
    CU_add_test(suite, "vanishing coefficients", test_gaps);
    CU_add_test(suite, "long steps of an oscillator", test_long_steps);
    CU_add_test(suite, "along a circle by hypot", test_hypot);
    CU_add_test(suite, "what is refused", test_refused);
    CU_add_test(suite, "steps that fail", test_failures);
}
