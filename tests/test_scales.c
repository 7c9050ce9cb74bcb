/* test_scales.c - the sizes of the terms that quantities are made of: S(f) by hand, in other units,
 * of systems written in C, along runs, and what sizes of drifts are stated by it. */
#include "expr/terms.h"
#include "fixtures.h"
#include "formula.h"
#include <CUnit/CUnit.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- one formula ---- */

/* The scales of count formulas that are evaluated together; returns the doubles that takes. */
static size_t scale_together(const char *const *text, int count, const double *symbol, double *out)
{
    enum { MAX_COUNT = 32 };
    dal__graph *graph = formula_graph();
    dal__node f[MAX_COUNT];
    CU_ASSERT_FATAL(count <= MAX_COUNT);
    for (int k = 0; k < count; k++) f[k] = formula_node(graph, text[k]);
    dal__terms *terms = dal__terms_create(graph, f, count);
    CU_ASSERT_PTR_NOT_NULL_FATAL(terms);
    const size_t size = dal__terms_memory(terms);
    double *memory = calloc(size, sizeof *memory);
    for (size_t i = 0; i < size; i++) memory[i] = NAN; /* as it comes */
    dal__terms_scales(terms, symbol, memory, out);
    free(memory);
    dal__terms_free(terms);
    dal__graph_free(graph);
    return size;
}

static double scale_of(const char *text, const double *symbol)
{
    double out = NAN;
    scale_together(&text, 1, symbol, &out);
    return out;
}

/* a = 2, b = 3, x = 5, y = -7, z = 0, x' = 11, y' = 13, z' = 0 */
static const double symbols[SYMBOLS] = {2, 3, 5, -7, 0, 11, 13, 0};

/* The largest |df/dn n| over the nodes of each formula, by hand. */
static void test_by_hand(void)
{
    static const struct {
        const char *formula;
        double scale;
    } cases[] = {
        {"x*y' - y*x'", 77.0 + 65.0},       /* the value itself */
        {"x*y' + y*x'", 77.0},              /* 65 - 77: the larger term */
        {"a*x^2", 100.0},                   /* x df/dx = 2 a x^2 */
        {"(x + y)^2", 28.0},                /* 2 (x + y) y */
        {"sin(a*x)", 0.0},                  /* set below: |a x cos(a x)| */
        {"exp(x)", 0.0},                    /* x exp(x) */
        {"x^(b + 0.5)", 0.0},               /* 3.5 x^3.5: exponents are no terms */
        {"log(x)", 0.0},                    /* the value, here above x dlog/dx = 1 */
        {"sqrt(z)", 0.0},                   /* 0, though its derivative is infinite */
        {"z*y'", 0.0},                      /* no term */
        {"if(x > 0, y, 1/z)", 7.0},         /* a branch that is not taken, and infinite */
        {"min(x, 1/z)", 5.0},               /* likewise */
        {"abs(y) + 0*x", 7.0},              /* */
        {"1/z", INFINITY},                  /* */
        {"log(z) + x", INFINITY},           /* */
        {"floor(y') + x", 18.0},            /* a step has no derivative */
        {"hypot(x, y)*0 + hypot(z, z)", 0}, /* */
        {"a*b", 6.0},                       /* constant along a run */
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        double right = cases[k].scale;
        if (strcmp(cases[k].formula, "sin(a*x)") == 0) right = fabs(10.0 * cos(10.0));
        if (strcmp(cases[k].formula, "exp(x)") == 0) right = 5.0 * exp(5.0);
        if (strcmp(cases[k].formula, "x^(b + 0.5)") == 0) right = 3.5 * pow(5.0, 3.5);
        if (strcmp(cases[k].formula, "log(x)") == 0) right = log(5.0);
        const double scale = scale_of(cases[k].formula, symbols);
        const bool is_right =
            isinf(right) ? scale == right : fabs(scale - right) <= 8.0 * DBL_EPSILON * right;
        if (!is_right) printf("\n  S(%s) = %.17g, not %.17g", cases[k].formula, scale, right);
        CU_ASSERT(is_right);
    }
}

/* Formulas that share parts have their own scales, in any order. */
static void test_together(void)
{
    static const char *const texts[] = {
        "x*y' - y*x'", "x*y'", "y*x'", "(x + y)^2", "x + y", "1/z", "x", "x*y' - y*x' + x", "a*b"};
    static const double scales[] = {142, 65, 77, 28, 7, INFINITY, 5, 147, 6};
    enum { COUNT = sizeof texts / sizeof *texts };
    double out[COUNT];
    for (int first = 0; first < COUNT; first++) {
        const char *turned[COUNT];
        for (int k = 0; k < COUNT; k++) turned[k] = texts[(first + k) % COUNT];
        scale_together(turned, COUNT, symbols, out);
        for (int k = 0; k < COUNT; k++) CU_ASSERT_EQUAL(out[k], scales[(first + k) % COUNT]);
    }
}

/* Ten multiples of one long sum take memory for it once: beside it for two products and a number
 * each, twice and a mark. */
static void test_shared(void)
{
    static const char sum[] = "(x + exp(x) + sin(y) + cos(y) + x*y + x*y^2 + x^2*y + exp(x*y))";
    enum { COUNT = 10 };
    char multiple[COUNT][128];
    const char *text[COUNT];
    double out[COUNT];
    for (int k = 0; k < COUNT; k++) {
        snprintf(multiple[k], sizeof multiple[k], "%s*%d*z", sum, k + 2);
        text[k] = multiple[k];
    }
    const size_t one = scale_together(text, 1, symbols, out);
    const size_t all = scale_together(text, COUNT, symbols, out);
    CU_ASSERT(all <= one + (COUNT - 1) * 7);
}

/* A constant counts with its size: (x + 1e10) - 1e10 cannot be better than eps of it. */
static void test_offset(void)
{
    static const double at[SYMBOLS] = {1e10, 3, 5, 0, 0, 0, 0, 0};
    CU_ASSERT_DOUBLE_EQUAL(scale_of("sin((x + a)/b)*b", at), fabs(cos((5 + 1e10) / 3) * (5 + 1e10)),
                           1e-3);
    CU_ASSERT_EQUAL(scale_of("x - y*0", at), 5.0);
}

/* ---- systems ---- */

/* An oscillator in the plane with a knife edge, in units: length s, angle 1, time tau, Lagrangian
 * c, constraint d. */
static const char oscillator[] =
    "title: units\n"
    "coordinates: [x, y, phi]\n"
    "parameters: {m: %.17g, J: %.17g, k: %.17g, d: %.17g}\n"
    "lagrangian: m/2*(x'^2 + y'^2) + J/2*phi'^2 - k/2*(x^2 + 2*y^2)\n"
    "constraints: [\"d*(x'*sin(phi) - y'*cos(phi))\"]\n"
    "start: {x: %.17g, y: %.17g, phi: 0.7, x': %.17g, y': %.17g, phi': %.17g}\n"
    "invariants: {spin: \"J*phi'\", moment: \"m*(x*y' - y*x')\"}\n";

static const dal_system *in_units(double s, double tau, double c, double d)
{
    static char text[1024];
    const double speed = 0.5 * s / tau;
    snprintf(text, sizeof text, oscillator, c * tau * tau / (s * s), c * tau * tau, c / (s * s),
             d * tau / s, s * 0.25, -s * 0.125, speed * cos(0.7), speed * sin(0.7), 0.375 / tau);
    return fixture_system(text);
}

enum { MAX = 16 };

typedef struct sizes {
    int count;
    double scale[MAX];
    dal_trend trend[MAX];
} sizes;

typedef struct follower {
    dal_statistics statistics[MAX];
    int count, scaled;
} follower;

static dal_status add_values(void *user, dal_run *run, int count, const double *t,
                             const double *values, size_t stride)
{
    follower *f = user;
    (void)run;
    dal_statistics_add_many(f->statistics, f->count, count, t, values, stride);
    return DAL_STATUS_OK;
}

static dal_status add_scales(void *user, dal_run *run, const double *scales)
{
    follower *f = user;
    (void)run;
    f->scaled++;
    dal_statistics_add_scales(f->statistics, f->count, scales);
    return DAL_STATUS_OK;
}

static follower sample(dal_run *run, double T, dal_status right)
{
    follower f = {.count = dal_run_observables(run)};
    const dal_observer observer = {
        .user = &f, .values = add_values, .scales = add_scales, .every = 1};
    dal_statistics_start(f.statistics, f.count);
    CU_ASSERT_EQUAL(dal_run_sample(run, T, 1, 0, &observer, NULL), right);
    return f;
}

static sizes measure(const dal_system *system, const char *method, double h, int steps,
                     dal_space space)
{
    const dal_run_spec spec = fixture_spec(system, method, space, h);
    dal_run *run = fixture_run(&spec);
    sizes out = {.count = dal_run_observables(run)};
    const follower f = sample(run, h * steps, DAL_STATUS_OK);
    for (int i = 0; i < f.count; i++) out.scale[i] = f.statistics[i].scale;
    dal_run_classify(run, f.statistics, DAL_STATUS_OK, out.trend);
    dal_run_free(run);
    return out;
}

/* Of D, E, the invariants: with units s, tau, c, d the scales are those with unit 1 times d, c, and
 * c tau of momenta; words are the same. */
static void test_units(void)
{
    static const double units[][4] = {{0x1p30, 0x1p-20, 0x1p40, 0x1p-50},
                                      {0x1p-55, 0x1p-60, 0x1p-58, 0x1p60},
                                      {0x1p-3, 0x1p17, 1.0, 0x1p-17}};
    static const char *const methods[] = {"rk4", "rk4+project", "gauss4"};
    for (int m = 0; m < 3; m++) {
        const sizes one = measure(in_units(1, 1, 1, 1), methods[m], 0x1p-5, 600, DAL_PHYSICAL);
        CU_ASSERT_EQUAL_FATAL(one.count, 4);
        for (int u = 0; u < 3; u++) {
            const double *k = units[u], by[4] = {k[3], k[2], k[2] * k[1], k[2] * k[1]};
            const sizes other = measure(in_units(k[0], k[1], k[2], k[3]), methods[m], 0x1p-5 * k[1],
                                        600, DAL_PHYSICAL);
            for (int i = 0; i < 4; i++) {
                CU_ASSERT(one.scale[i] > 0.0);
                CU_ASSERT_EQUAL(other.scale[i], one.scale[i] * by[i]);
                CU_ASSERT_EQUAL(other.trend[i].size, one.trend[i].size);
                CU_ASSERT_EQUAL(other.trend[i].trend, one.trend[i].trend);
            }
        }
        CU_ASSERT_EQUAL(one.trend[0].size, m == 1 ? DAL_SIZE_ROUNDING : DAL_SIZE_LARGER);
    }
}

/* An atom of 1.67e-27 kg on a spring of 500 N/m, 1e-11 m off: at 1.1 steps to a radian rk4 loses
 * most of E, which is no rounding although E is 2.5e-20. */
static void test_atom(void)
{
    static const char atom[] = "coordinates: [x]\n"
                               "parameters: {m: 1.67e-27, k: 500}\n"
                               "lagrangian: m/2*x'^2 - k/2*x^2\n"
                               "start: {x: 1e-11}\n";
    const sizes s = measure(fixture_system(atom), "rk4", 2e-15, 100, DAL_PHYSICAL);
    CU_ASSERT_DOUBLE_EQUAL(s.scale[0], 5e-20, 1e-24); /* x dE/dx = k x^2 */
    CU_ASSERT(s.trend[0].deviation > 0.8 * 2.5e-20);
    CU_ASSERT_EQUAL(s.trend[0].size, DAL_SIZE_LARGER);
}

/* x'' = x^3 from x = 10 is infinite at t = 0.13: what is lost is neither exact nor rounding. */
static void test_blow_up(void)
{
    static const char text[] = "coordinates: [x]\n"
                               "lagrangian: x'^2/2 + x^4/4\n"
                               "start: {x: 10, x': 70}\n";
    const dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_LIFTED, 0.01);
    dal_run *run = fixture_run(&spec);
    dal_trend trend[MAX];
    follower f = sample(run, 10.0, DAL_STATUS_NOT_FINITE);
    dal_run_classify(run, f.statistics, DAL_STATUS_NOT_FINITE, trend);
    CU_ASSERT(trend[0].max_abs > 1e20);
    CU_ASSERT_EQUAL(trend[0].size, DAL_SIZE_LARGER);
    const double infinite[MAX] = {INFINITY};
    dal_statistics_add_scales(f.statistics, 1, infinite);
    dal_run_classify(run, f.statistics, DAL_STATUS_NOT_FINITE, trend);
    CU_ASSERT_EQUAL(trend[0].size, DAL_SIZE_LARGER);
    dal_statistics one;
    dal_statistics_start(&one, 1);
    for (int i = 0; i < 3; i++) dal_statistics_add(&one, 1, i, &(double){i < 2 ? 1.0 : NAN});
    dal_statistics_classify(&one, 1.0, DAL_STATUS_OK, trend);
    CU_ASSERT_EQUAL(trend[0].size, DAL_SIZE_LARGER); /* a value was lost */
    dal_run_free(run);
}

/* D = x' - 2 y' of a system written in C, at v = (7, 3): |D| + |7| + |-6|; with the energy of its
 * normal |E| + |E_q q| + |E_v v|. */
static dal_status constraint_by_hand(const dal_system *system, const dal_point *at, double *out)
{
    const double D = at->v[0] - 2.0 * at->v[1], all[] = {D, 1.0, -2.0, 1.0, -2.0};
    (void)system;
    memcpy(out, all, sizeof all);
    return DAL_STATUS_OK;
}
static dal_status D_by_hand(const dal_system *system, const dal_point *at, double *out)
{
    (void)system;
    *out = at->v[0] - 2.0 * at->v[1];
    return DAL_STATUS_OK;
}
static dal_status energy_by_hand(const dal_system *system, const dal_point *at, double *out)
{
    (void)system;
    *out = 0.5 * (at->v[0] * at->v[0] + at->v[1] * at->v[1]) - 100.0;
    return DAL_STATUS_OK;
}
static dal_status rest(const dal_system *system, const dal_point *at, double *out)
{
    (void)system, (void)at;
    out[0] = out[1] = 0.0;
    return DAL_STATUS_OK;
}

static void test_system_in_c(void)
{
    const dal_system system = {.n = 2,
                               .m = 1,
                               .call = {.field = rest, .constraint = constraint_by_hand},
                               .constraints = D_by_hand,
                               .energy = energy_by_hand};
    const double state[] = {0.0, 0.0, 7.0, 3.0};
    const dal_run_spec spec = fixture_spec(&system, "rk4", DAL_PHYSICAL, 0.1);
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_FATAL(dal_run_set_state(run, 0.0, state, NULL) == DAL_STATUS_OK);
    const double *scales = dal_run_scales(run);
    CU_ASSERT_PTR_NOT_NULL_FATAL(scales);
    CU_ASSERT_EQUAL(scales[0], 14.0);
    CU_ASSERT_EQUAL(scales[1], 71.0);
    dal_run_free(run);
}

/* ---- along a run ---- */

/* Scales come with the first 32 values and then with every second, fourth, ... of them. */
static void test_how_often(void)
{
    const dal_run_spec spec = fixture_spec(in_units(1, 1, 1, 1), "rk4", DAL_LIFTED, 0x1p-5);
    static const int values[][2] = {{1, 1}, {32, 32}, {33, 32}, {64, 48}, {1024, 112}, {4096, 144}};
    for (int k = 0; k < 6; k++) {
        dal_run *run = fixture_run(&spec);
        follower f = {.count = dal_run_observables(run)};
        if (values[k][0] > 1) {
            f = sample(run, (values[k][0] - 1) * 0x1p-5, DAL_STATUS_OK);
            CU_ASSERT_EQUAL(f.scaled, values[k][1]);
        }
        dal_run_free(run);
    }
}

/* H = p.v + pi.F + pi^2/2e at p = (3, 0, 0), pi = (0, 0, 5), e = 2 and v' = (0.5 cos 0.7, ..): the
 * largest of 3 x', 25/4 and 5 F_phi = 0. */
static void test_lift(void)
{
    const dal_run_spec spec = fixture_spec(in_units(1, 1, 1, 1), "rk4", DAL_LIFTED, 0x1p-5);
    dal_run *run = fixture_run(&spec);
    double state[14];
    memcpy(state, dal_run_state(run), sizeof state);
    CU_ASSERT_EQUAL(dal_run_scales(run)[2], 0.0);
    state[6] = 2.0;
    state[7] = 30.0;
    state[12] = 5.0;
    CU_ASSERT_FATAL(dal_run_set_state(run, 0.0, state, NULL) == DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_scales(run)[2], 30.0 * 0.5 * cos(0.7), 1e-14);
    state[7] = 3.0;
    CU_ASSERT_FATAL(dal_run_set_state(run, 0.0, state, NULL) == DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_scales(run)[2], 25.0 / 4.0);
    dal_run_free(run);
}

/* A knife edge at phi = 0 with speed 2 and turning rate 3: h = -(x' cos(phi) + y' sin(phi)) phi',
 * so S = |h|; R_y = -h cos(phi) has the square of cos(phi), and the derivative by it counts
 * twice. */
static void test_reactions(void)
{
    dal_run_spec spec = fixture_spec(fixture_system("coordinates: [x, y, phi]\n"
                                                    "lagrangian: (x'^2 + y'^2 + phi'^2)/2\n"
                                                    "constraints: [\"x'*sin(phi) - y'*cos(phi)\"]\n"
                                                    "start: {x': 2, phi': 3}\n"),
                                     "rk4", DAL_PHYSICAL, 0.1);
    spec.options.reactions = 1;
    dal_run *run = fixture_run(&spec);
    const double *scales = dal_run_scales(run);
    CU_ASSERT_PTR_NOT_NULL_FATAL(scales);
    const double h = 6.0, R[] = {0.0, 12.0, 0.0};
    CU_ASSERT_DOUBLE_EQUAL(scales[2], h, 1e-14);
    for (int i = 0; i < 3; i++) CU_ASSERT_DOUBLE_EQUAL(scales[3 + i], R[i], 1e-14);
    dal_run_free(run);
}

void suite_scales(void)
{
    CU_pSuite suite = CU_add_suite("scales", NULL, NULL);
    CU_add_test(suite, "the largest term of formulas, by hand", test_by_hand);
    CU_add_test(suite, "formulas that share parts", test_together);
    CU_add_test(suite, "memory for parts once", test_shared);
    CU_add_test(suite, "a constant counts with its size", test_offset);
    CU_add_test(suite, "scales in other units", test_units);
    CU_add_test(suite, "an atom that loses its energy", test_atom);
    CU_add_test(suite, "a motion that becomes infinite", test_blow_up);
    CU_add_test(suite, "a system written in C", test_system_in_c);
    CU_add_test(suite, "how often a run gives scales", test_how_often);
    CU_add_test(suite, "the lift", test_lift);
    CU_add_test(suite, "reactions", test_reactions);
}
