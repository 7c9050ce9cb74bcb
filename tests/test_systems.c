/* test_systems.c - the built-in systems: their exact solutions against their own equations, their
 * invariants along the motion, the closed forms and reference end states of the literature, and
 * what is known of each. */
#include "reference.h"

#include <CUnit/Basic.h>
#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846
/* Differences of order 8 with steps of 0.005: rounding some 1e-14, truncation below. */
#define BY_DIFFERENCES 1e-11
/* RK4 in a thousand steps to the unit of time. */
#define BY_RK4 1e-10

static const double weight[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
static const double step = 0.005;

/* ---- a small integrator: q, v, g by RK4 ---- */

static void slope(const reference *b, double t, const double *x, double *out)
{
    int n = b->system->n;
    memcpy(out, x + n, (size_t)n * sizeof *out);
    reference_call(b, b->system->call.field, t, x, x + n, out + n);
}

static void shifted(int count, const double *x, double s, const double *k, double *out)
{
    for (int i = 0; i < count; i++) out[i] = x[i] + s * k[i];
}

static void rk4(const reference *b, double t, double h, double *x)
{
    int count = 2 * b->system->n + b->system->multipliers;
    double k[4][3 * REFERENCE_MAX], y[3 * REFERENCE_MAX];
    slope(b, t, x, k[0]);
    shifted(count, x, h / 2, k[0], y);
    slope(b, t + h / 2, y, k[1]);
    shifted(count, x, h / 2, k[1], y);
    slope(b, t + h / 2, y, k[2]);
    shifted(count, x, h, k[2], y);
    slope(b, t + h, y, k[3]);
    for (int i = 0; i < count; i++) x[i] += h / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
}

static void go(const reference *b, double from, double to, double *x)
{
    int steps = (int)lround((to - from) * 1000);
    for (int i = 0; i < steps; i++) rk4(b, from + (to - from) * i / steps, (to - from) / steps, x);
}

static void start(const reference *b, double *x)
{
    CU_ASSERT(reference_call(b, b->system->start, 0.0, NULL, NULL, x) == DAL_STATUS_OK);
}

/* ---- exact solutions ---- */

static void exact(const reference *b, double t, double *x)
{
    CU_ASSERT(reference_call(b, b->system->exact, t, NULL, NULL, x) == DAL_STATUS_OK);
}

static void exact_rate(const reference *b, double t, double *rate)
{
    double above[2 * REFERENCE_MAX], below[2 * REFERENCE_MAX];
    for (int i = 0; i < 2 * b->system->n; i++) rate[i] = 0.0;
    for (int k = 0; k < 4; k++) {
        exact(b, t + (k + 1) * step, above);
        exact(b, t - (k + 1) * step, below);
        for (int i = 0; i < 2 * b->system->n; i++)
            rate[i] += weight[k] * (above[i] - below[i]) / step;
    }
}

static void check_exact(const reference *b)
{
    int n = b->system->n;
    double x[3 * REFERENCE_MAX], rate[2 * REFERENCE_MAX], D[REFERENCE_MAX] = {0.0},
                                                          zero[REFERENCE_MAX] = {0.0};
    start(b, x);
    exact(b, 0.0, rate);
    CU_ASSERT(reference_distance(2 * n, rate, x) < 1e-15);
    for (double t = 0.1; t < 1.2; t += 0.21) {
        double expected[2 * REFERENCE_MAX];
        exact(b, t, x);
        slope(b, t, x, expected);
        exact_rate(b, t, rate);
        CU_ASSERT(reference_distance(2 * n, rate, expected) < BY_DIFFERENCES);
        if (b->system->m) reference_call(b, b->system->constraints, t, x, x + n, D);
        CU_ASSERT(reference_distance(b->system->m, D, zero) < 1e-14);
    }
}

/* Away from the default parameters, so that none of them is forgotten in a formula. */
static void unlike(reference *b)
{
    for (int i = 0; i < b->system->parameters; i++)
        reference_set(b, b->system->parameter[i], b->system->value[i] * (1.1 + 0.07 * i) + 0.03);
}

static void test_exact(void)
{
    for (int i = 0; dal_builtin_name(i); i++) {
        reference b = reference_builtin(dal_builtin_name(i));
        if (b.system->exact) check_exact(&b);
        unlike(&b);
        if (b.system->exact) check_exact(&b);
        reference_free(&b);
    }
}

/* ---- invariants ---- */

/* Invariants and their rates along the field, by differences on the line x + s dx/dt. */
static void invariant_rates(const reference *b, double t, const double *x, double *rate)
{
    int n = b->system->n, count = 2 * n + b->system->multipliers;
    double k[3 * REFERENCE_MAX], y[3 * REFERENCE_MAX], above[REFERENCE_MAX], below[REFERENCE_MAX];
    slope(b, t, x, k);
    for (int i = 0; i < b->system->invariants; i++) rate[i] = 0.0;
    for (int j = 0; j < 4; j++) {
        double s = (j + 1) * step;
        shifted(count, x, s, k, y);
        reference_call(b, b->system->invariant_values, t + s, y, y + n, above);
        shifted(count, x, -s, k, y);
        reference_call(b, b->system->invariant_values, t - s, y, y + n, below);
        for (int i = 0; i < b->system->invariants; i++)
            rate[i] += weight[j] * (above[i] - below[i]) / step;
    }
}

static void check_invariants(const reference *b)
{
    double x[3 * REFERENCE_MAX], rate[REFERENCE_MAX], zero[REFERENCE_MAX] = {0.0};
    start(b, x);
    for (int k = 0; k < 4; k++) {
        invariant_rates(b, 0.2 * k, x, rate);
        CU_ASSERT(reference_distance(b->system->invariants, rate, zero) < BY_RK4);
        go(b, 0.2 * k, 0.2 * (k + 1), x);
    }
}

static void test_invariants(void)
{
    for (int i = 0; dal_builtin_name(i); i++) {
        reference b = reference_builtin(dal_builtin_name(i));
        if (b.system->invariants) check_invariants(&b);
        unlike(&b);
        if (b.system->invariants) check_invariants(&b);
        reference_free(&b);
    }
}

/* ---- what is known ---- */

enum {
    POSITIONAL = DAL_BLOCKS_POSITIONAL,
    AFFINE = DAL_D_LINEAR | POSITIONAL,
    FIXED = DAL_AUTONOMOUS | DAL_MASS_CONSTANT
};

static const struct {
    const char *name;
    int n, m, guards;
    unsigned properties;
} known[] = {
    {"chaplygin-sleigh", 3, 1, 0, AFFINE | DAL_E_ON_D | FIXED},
    {"chaplygin-sleigh-nonlinear", 3, 1, 2, DAL_D_RANK_CHECKED | DAL_E_EXACT | FIXED},
    {"chaplygin-sleigh-friction", 3, 0, 0, FIXED},
    {"chaplygin-sleigh-vakonomic", 3, 1, 0, DAL_D_LINEAR | DAL_E_ON_D | DAL_VAKONOMIC | FIXED},
    {"damped-oscillator", 1, 0, 0, FIXED},
    {"nonholonomic-particle", 3, 1, 0,
     AFFINE | DAL_D_BILINEAR | DAL_D_QUADRATIC | DAL_E_ON_D | FIXED},
    {"contact-oscillator", 3, 1, 0, AFFINE | DAL_D_BILINEAR | DAL_D_QUADRATIC | DAL_E_ON_D | FIXED},
    {"knife-edge", 3, 1, 0, AFFINE | DAL_E_ON_D | FIXED},
    {"vertical-disk", 4, 2, 0, AFFINE | DAL_E_ON_D | FIXED},
    {"appell-hamel", 3, 1, 0, DAL_D_QUADRATIC | DAL_D_RANK_CHECKED | DAL_E_ON_D | FIXED},
    {"isokinetic", 2, 1, 0, DAL_D_QUADRATIC | DAL_D_RANK_CHECKED | DAL_D_ISOKINETIC | FIXED},
};
enum { KNOWN = sizeof known / sizeof *known };

static void test_known(void)
{
    for (int k = 0; k < KNOWN; k++) {
        reference b = reference_builtin(known[k].name);
        const dal_system *s = b.system;
        CU_ASSERT_STRING_EQUAL(s->name, known[k].name);
        CU_ASSERT(s->title && s->reference && s->tags > 0);
        CU_ASSERT(s->n == known[k].n && s->m == known[k].m && s->guards == known[k].guards);
        CU_ASSERT(s->properties == (known[k].properties | DAL_WIDE_TIMES));
        CU_ASSERT(s->call.field && s->call.jacobian && s->start && s->prepare && s->energy);
        CU_ASSERT(!s->call.adjoint == !!(s->properties & DAL_VAKONOMIC));
        reference_free(&b);
    }
    CU_ASSERT(dal_builtin_name(-1) == NULL);
}

/* ---- closed forms and end states ---- */

/* (nh29) as corrected: the phases, and 2 v0 m/k where the motion ends. */
static void test_friction(void)
{
    double m = 1.3, k = 9.0, v0 = 1.1, w = 1.7, x[6], expected[2];
    reference b = reference_builtin("chaplygin-sleigh-friction");
    reference_set(&b, "m", m), reference_set(&b, "v0", v0), reference_set(&b, "omega", w);
    double root = sqrt(k * k - 4 * w * w * m * m), d1 = (k - root) / (2 * m);
    double d2 = (k + root) / (2 * m), phase1 = asin(-2 * w * d1 / (w * w + d1 * d1));
    double phase2 = PI - asin(-2 * w * d2 / (w * w + d2 * d2)), factor = v0 / (w * (d2 - d1));
    for (double t = 0.0; t < 3.0; t += 0.4) {
        double e1 = d2 * exp(-d1 * t), e2 = d1 * exp(-d2 * t);
        expected[0] =
            2 * v0 * m / k + factor * (e1 * sin(w * t + phase1) - e2 * sin(w * t + phase2));
        expected[1] = v0 / w - factor * (e1 * cos(w * t + phase1) - e2 * cos(w * t + phase2));
        exact(&b, t, x);
        CU_ASSERT(reference_distance(2, x, expected) < 1e-13);
    }
    exact(&b, 60.0, x);
    CU_ASSERT(fabs(x[0] - 0.31777778) < 1e-8);
    reference_free(&b);
}

/* The distance to the circle (nh30) falls like 1/k. */
static void test_strong_friction(void)
{
    reference b = reference_builtin("chaplygin-sleigh-friction");
    double x[6], distance[4];
    for (int i = 0; i < 4; i++) {
        reference_set(&b, "k", pow(10.0, i + 1));
        exact(&b, 1.0, x);
        distance[i] = hypot(x[0] - sin(1.0), x[1] - (1 - cos(1.0)));
    }
    for (int i = 1; i < 3; i++) CU_ASSERT(fabs(distance[i] / distance[i + 1] - 10.0) < 0.2);
    reference_free(&b);
}

/* (nh36) as corrected; (nh35) has the constants p1 = m v0 and p2 = -g(0). */
static void test_vakonomic_angle(void)
{
    double m = 1.3, I = 0.7, v0 = 1.1, p2 = -0.4, x[8], F[4], E[2];
    reference b = reference_builtin("chaplygin-sleigh-vakonomic");
    reference_set(&b, "m", m), reference_set(&b, "I", I), reference_set(&b, "v0", v0),
        reference_set(&b, "g0", -p2);
    start(&b, x);
    reference_call(&b, b.system->energy, 0.0, x, x + 3, &E[0]);
    for (int k = 0; k < 5; k++) {
        double two = 2 * x[2], p1 = m * v0;
        double right = (p1 * p1 - p2 * p2) * sin(two) - 2 * p2 * p1 * cos(two);
        reference_call(&b, b.system->call.field, 0.0, x, x + 3, F);
        CU_ASSERT(fabs(2 * I * m * F[2] - right) < BY_RK4);
        reference_call(&b, b.system->energy, 0.0, x, x + 3, &E[1]);
        CU_ASSERT(fabs(E[1] - E[0]) < BY_RK4);
        go(&b, 0.0, 0.4, x);
    }
    reference_free(&b);
}

/* End states known to 13 digits from two independent integrations of order above 8. */
static void check_end(const char *text, double T, const double *expected)
{
    reference b = reference_of_text(text);
    double x[2 * REFERENCE_MAX];
    start(&b, x);
    go(&b, 0.0, T, x);
    CU_ASSERT(reference_distance(2 * b.system->n, x, expected) < BY_RK4);
    reference_free(&b);
}

static void test_end_states(void)
{
    check_end("coordinates: [x, y, z]\n"
              "parameters: {eps: 0.3}\n"
              "lagrangian: (x'^2 + y'^2 + z'^2)/2 - (x^2 + y^2 + z^2 + eps*x^2*z^2)/2\n"
              "constraints: [x' + y*z']\n"
              "start: {x: 0.8, y: 0.6, z: -0.5, x': -0.24, y': 0.7, z': 0.4}\n",
              1.0,
              (double[]){0.2697845407561, 0.9132110728864, 0.1292207494387, -0.6961539931339,
                         -0.1266709767770, 0.7623144460279});
    check_end("coordinates: [x, y, th]\n"
              "lagrangian: (x'^2 + y'^2 + th'^2)/2 - y/2\n"
              "constraints: [-sin(th)*x' + cos(th)*y' - th']\n"
              "parameters: {v: 0.7, w: 0.9, h: 0.3}\n"
              "start: {x: cos(h), y: sin(h), th: h, x': v*cos(h) - w*sin(h),\n"
              "        y': v*sin(h) + w*cos(h), th': w}\n",
              1.0,
              (double[]){1.2303173219572, 1.3259998066095, 0.9477957970084, 0.1327768526135,
                         0.9333477376258, 0.4367524563532});
    check_end("coordinates: [x, y, z]\n"
              "lagrangian: (x'^2 + y'^2 + z'^2)/2 - (x^2 + 1.7*y^2 + 0.6*z^2)/2\n"
              "constraints: [(x'^2 + y'^2 - nu2*z'^2)/2]\n"
              "parameters: {nu2: 0.8, s: sqrt(nu2)*1.2}\n"
              "start: {x: 0.4, y: -0.3, z: 0.5, x': s*cos(0.6), y': s*sin(0.6), z': 1.2}\n",
              1.0,
              (double[]){0.9408992146138, 0.3536347529745, 1.4660252969470, 0.1246609633716,
                         0.5302439477038, 0.6089940474516});
}

void suite_systems(void)
{
    CU_pSuite suite = CU_add_suite("systems", NULL, NULL);
    CU_add_test(suite, "exact solutions", test_exact);
    CU_add_test(suite, "invariants", test_invariants);
    CU_add_test(suite, "what is known of each", test_known);
    CU_add_test(suite, "friction: corrected closed form", test_friction);
    CU_add_test(suite, "friction: the limit of the circle", test_strong_friction);
    CU_add_test(suite, "vakonomic: corrected equation of the angle", test_vakonomic_angle);
    CU_add_test(suite, "reference end states", test_end_states);
}
