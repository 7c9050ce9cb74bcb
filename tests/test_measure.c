/* test_measure.c - measures of a system: evaluator, rates, derivatives, constraints. */
#include "allocation.h"
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <string.h>

/* ---- a system by hand: x'' = -x^3 - v/2, with one claim that can be made wrong ---- */

static double wrong; /* added to F_x where the system speaks of its derivatives */

static dal_status cubic_field(const dal_system *s, const dal_point *at, double *out)
{
    (void)s;
    out[0] = -at->q[0] * at->q[0] * at->q[0] - 0.5 * at->v[0];
    return DAL_STATUS_OK;
}

static dal_status cubic_jacobian(const dal_system *s, const dal_point *at, double *out)
{
    (void)s;
    out[0] = -3.0 * at->q[0] * at->q[0] + wrong;
    out[1] = -0.5;
    return DAL_STATUS_OK;
}

static dal_status cubic_adjoint(const dal_system *s, const dal_point *at, double *out)
{
    cubic_field(s, at, out);
    out[1] = (-3.0 * at->q[0] * at->q[0] + wrong) * at->pi[0];
    out[2] = -0.5 * at->pi[0];
    return DAL_STATUS_OK;
}

static dal_status cubic_energy(const dal_system *s, const dal_point *at, double *out)
{
    const double x2 = at->q[0] * at->q[0];
    (void)s;
    out[0] = 0.5 * at->v[0] * at->v[0] + 0.25 * x2 * x2;
    return DAL_STATUS_OK;
}

static const dal_system cubic = {
    .name = "cubic",
    .n = 1,
    .call = {.field = cubic_field, .jacobian = cubic_jacobian, .adjoint = cubic_adjoint},
    .energy = cubic_energy};

/* ---- evaluator ---- */

static void test_evaluator(void)
{
    const dal_system *system = fixture_system("chaplygin-sleigh");
    const dal_setting set[] = {{"v0", 3.0}}, start[] = {{"phi'", 2.0}, {"e", 5.0}};
    dal_evaluator *evaluator;
    double x[7];
    CU_ASSERT_EQUAL_FATAL(dal_evaluator_create(&evaluator, system, set, 1, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_evaluator_start(evaluator, start, 2, x, NULL), DAL_STATUS_OK);
    const double expected[] = {0, 0, 0, 3, 0, 2, 5};
    for (int i = 0; i < 7; i++) CU_ASSERT_EQUAL(x[i], expected[i]);
    /* E = (v0^2 + phi'^2)/2 */
    double energy;
    CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, system->energy, 0.0, x, x + 3, NULL, &energy),
                    DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(energy, 6.5, 1e-15);
    CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, NULL, 0.0, x, x + 3, NULL, &energy),
                    DAL_STATUS_UNSUPPORTED);
    dal_evaluator_free(evaluator);
}

static void test_evaluator_pi(void)
{
    const dal_system *system = fixture_system("coordinates: [x]\nparameters: {turn: 2*pi}\n"
                                              "lagrangian: x'^2/2 - pi*x\nstart: {x': turn}\n");
    dal_evaluator *evaluator = fixture_evaluator(system);
    double x[3], force;
    CU_ASSERT_EQUAL(dal_evaluator_start(evaluator, NULL, 0, x, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(x[1], 2.0 * acos(-1.0));
    CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, system->call.field, 0.0, x, x + 1, NULL, &force),
                    DAL_STATUS_OK);
    CU_ASSERT_EQUAL(force, -acos(-1.0));
    dal_evaluator_free(evaluator);
}

static void test_evaluator_names(void)
{
    const dal_setting set[] = {{"omge", 3.0}}, start[] = {{"phy", 2.0}}, inf = {"m", INFINITY};
    dal_error error;
    dal_evaluator *evaluator;
    double x[7];
    const dal_system *system = fixture_system("chaplygin-sleigh");
    CU_ASSERT_EQUAL(dal_evaluator_create(&evaluator, system, set, 1, &error), DAL_STATUS_NAME);
    CU_ASSERT_PTR_NULL(evaluator);
    CU_ASSERT(strstr(error.message, "'omge'; did you mean 'omega'?") != NULL);
    CU_ASSERT_EQUAL(dal_evaluator_create(&evaluator, system, &inf, 1, &error),
                    DAL_STATUS_NOT_FINITE);
    evaluator = fixture_evaluator(system);
    CU_ASSERT_EQUAL(dal_evaluator_start(evaluator, start, 1, x, &error), DAL_STATUS_NAME);
    CU_ASSERT(strstr(error.message, "'phy'; did you mean 'phi'?") != NULL);
    dal_evaluator_free(evaluator);
}

/* ---- rates and derivatives ---- */

static void test_rate(void)
{
    const double q = 0.8, v = -1.3;
    const dal_point at = {.t = 0.0, .q = &q, .v = &v};
    dal_evaluator *evaluator = fixture_evaluator(&cubic);
    double rate;
    /* dE/dt = v (v' + x^3) = -v^2/2 */
    CU_ASSERT_EQUAL(dal_evaluator_measure_rate(evaluator, cubic.energy, 1, &at, &rate),
                    DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(rate, -0.5 * v * v, 1e-12);
    CU_ASSERT_EQUAL(dal_evaluator_measure_rate(evaluator, NULL, 1, &at, &rate),
                    DAL_STATUS_UNSUPPORTED);
    dal_evaluator_free(evaluator);
}

static void test_derivatives_find_faults(void)
{
    const double q = 0.8, v = -1.3;
    const dal_point at = {.t = 0.0, .q = &q, .v = &v};
    dal_evaluator *evaluator = fixture_evaluator(&cubic);
    dal_derivatives d;
    wrong = 0.0;
    CU_ASSERT_EQUAL(dal_evaluator_check_derivatives(evaluator, &at, &d), DAL_STATUS_OK);
    CU_ASSERT(d.jacobian >= 0.0 && d.jacobian < 1e-12);
    CU_ASSERT(d.adjoint >= 0.0 && d.adjoint < 1e-12);
    CU_ASSERT(isnan(d.constraint_jacobian) && isnan(d.gram)); /* nothing to compare */
    wrong = 1e-6;
    CU_ASSERT_EQUAL(dal_evaluator_check_derivatives(evaluator, &at, &d), DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(d.jacobian, 1e-6 / (3.0 * q * q - 1e-6), 1e-11);
    CU_ASSERT(d.adjoint > 1e-8);
    wrong = 0.0;
    dal_evaluator_free(evaluator);
}

static void test_derivatives_of_systems(void)
{
    const char *const texts[] = {fixture_full, fixture_bilinear, fixture_quadratic, "vertical-disk",
                                 "chaplygin-sleigh-nonlinear"};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
        dal_evaluator *evaluator = fixture_evaluator(fixture_system(texts[k]));
        double x[16];
        dal_derivatives d;
        CU_ASSERT_EQUAL(dal_evaluator_start(evaluator, NULL, 0, x, NULL), DAL_STATUS_OK);
        const dal_point at = {.t = 0.3, .q = x, .v = x + fixture_system(texts[k])->n};
        CU_ASSERT_EQUAL(dal_evaluator_check_derivatives(evaluator, &at, &d), DAL_STATUS_OK);
        CU_ASSERT(d.jacobian >= 0.0 && d.jacobian < 1e-10);
        CU_ASSERT(d.adjoint >= 0.0 && d.adjoint < 1e-10);
        CU_ASSERT(d.constraint_jacobian >= 0.0 && d.constraint_jacobian < 1e-10);
        CU_ASSERT(d.gram >= 0.0 && d.gram < 1e-14);
        dal_evaluator_free(evaluator);
    }
}

/* ---- constraints ---- */

/* The second constraint repeats the first at z = 0, near which the test evaluates it. */
static const char twice[] = "coordinates: [x, y, z]\n"
                            "lagrangian: (x'^2 + y'^2 + z'^2)/2\n"
                            "constraints: [x' - y', 3*x' - (3 + z)*y']\n"
                            "start: {z: 1}\n";

static void test_rank(void)
{
    const struct {
        const char *text;
        int rank;
    } cases[] = {{"vertical-disk", 2}, {twice, 1}, {fixture_full, 2}, {"knife-edge", 1}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        dal_evaluator *evaluator = fixture_evaluator(fixture_system(cases[k].text));
        double x[16], pivot;
        int rank;
        CU_ASSERT_EQUAL(dal_evaluator_start(evaluator, NULL, 0, x, NULL), DAL_STATUS_OK);
        if (cases[k].text == twice) x[2] = 1e-12;
        const dal_point at = {.t = 0.0, .q = x, .v = x + fixture_system(cases[k].text)->n};
        CU_ASSERT_EQUAL(dal_evaluator_measure_rank(evaluator, &at, &rank, &pivot), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(rank, cases[k].rank);
        CU_ASSERT(rank == fixture_system(cases[k].text)->m ? pivot > 0.01 : pivot == 0.0);
        dal_evaluator_free(evaluator);
    }
}

static void test_project_velocity(void)
{
    const dal_system *system = fixture_system(fixture_full);
    dal_evaluator *evaluator = fixture_evaluator(system);
    const double q[] = {0.1, 0.4, 0.3, 0.2};
    double v[] = {0.9, 0.7, 0.1, 1.3}, D[2];
    CU_ASSERT_EQUAL(dal_evaluator_project_velocity(evaluator, 0.4, q, v), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, system->constraints, 0.4, q, v, NULL, D),
                    DAL_STATUS_OK);
    CU_ASSERT(fabs(D[0]) < 1e-15 && fabs(D[1]) < 1e-15);
    dal_evaluator_free(evaluator);
}

static dal_status no_scales(const dal_system *system, const dal_point *at, double *memory,
                            double *out)
{
    (void)system, (void)at, (void)memory, (void)out;
    return DAL_STATUS_IO;
}

static void test_scales_fail(void)
{
    dal_system system = *fixture_system(fixture_full);
    double x[8] = {0.0}, out[8];
    system.scales = no_scales;
    dal_evaluator *evaluator = fixture_evaluator(&system);
    CU_ASSERT_EQUAL(dal_evaluator_scales(evaluator, 0.0, x, x + 4, out), DAL_STATUS_IO);
    dal_evaluator_free(evaluator);
}

/* The nearest point of a circle; its center has none, and comes back as it was. */
static void test_project_position(void)
{
    dal_evaluator *evaluator = fixture_evaluator(fixture_system(
        "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\nholonomic: [x^2 + y^2 - 1]\n"
        "start: {x: 1}\n"));
    const double v[] = {0.0, 0.0};
    double q[] = {3.0, 4.0}, center[] = {0.0, 0.0};
    CU_ASSERT_EQUAL(dal_evaluator_project_position(evaluator, 0.0, q, v), DAL_STATUS_OK);
    CU_ASSERT(fabs(q[0] - 0.6) < 1e-15 && fabs(q[1] - 0.8) < 1e-15);
    CU_ASSERT_EQUAL(dal_evaluator_project_position(evaluator, 0.0, center, v), DAL_STATUS_SINGULAR);
    CU_ASSERT(center[0] == 0.0 && center[1] == 0.0);
    dal_evaluator_free(evaluator);
}

/* x'^2 + y'^2 + 1 has no zero: v must come back as it was. */
static void test_project_velocity_nothing(void)
{
    dal_evaluator *evaluator =
        fixture_evaluator(fixture_system("coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                                         "constraints: [x'^2 + y'^2 + 1]\nstart: {x': 1}\n"));
    const double q[] = {0.0, 0.0};
    double v[] = {0.6, 0.3};
    CU_ASSERT_NOT_EQUAL(dal_evaluator_project_velocity(evaluator, 0.0, q, v), DAL_STATUS_OK);
    CU_ASSERT(v[0] == 0.6 && v[1] == 0.3);
    dal_evaluator_free(evaluator);
}

/* At rest the gradient of D = x'^2 + y'^2 - 1 is 0: no step is determined. */
static void test_project_velocity_singular(void)
{
    dal_evaluator *evaluator =
        fixture_evaluator(fixture_system("coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                                         "constraints: [x'^2 + y'^2 - 1]\nstart: {x': 1}\n"));
    const double q[] = {0.0, 0.0};
    double v[] = {0.0, 0.0};
    CU_ASSERT_EQUAL(dal_evaluator_project_velocity(evaluator, 0.0, q, v), DAL_STATUS_SINGULAR);
    CU_ASSERT(v[0] == 0.0 && v[1] == 0.0);
    v[0] = 0.9;
    CU_ASSERT_EQUAL(dal_evaluator_project_velocity(evaluator, 0.0, q, v), DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(v[0], 1.0, 1e-13);
    CU_ASSERT_EQUAL(v[1], 0.0);
    dal_evaluator_free(evaluator);
}

/* D = sqrt(x'^2 + d^2) has no zero, and Newton's method goes from x' = d to -d, where |D| is the
 * same.  Below 1e-13 of the terms of D, or of 1 if they are smaller, |D| counts as 0. */
static void test_project_velocity_rounding(void)
{
    for (int k = 0; k < 2; k++) {
        const dal_setting d = {"d", (k ? 1.5e-13 : 0.9e-13) / sqrt(2.0)};
        dal_evaluator *evaluator = NULL;
        CU_ASSERT_EQUAL_FATAL(
            dal_evaluator_create(&evaluator,
                                 fixture_system("coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                                                "parameters: {d: 1}\n"
                                                "constraints: [sqrt(x'^2 + d^2)]\n"),
                                 &d, 1, NULL),
            DAL_STATUS_OK);
        const double q[] = {0.0, 0.0};
        double v[] = {d.value, 0.0};
        CU_ASSERT_EQUAL(dal_evaluator_project_velocity(evaluator, 0.0, q, v),
                        k ? DAL_STATUS_NOT_CONVERGED : DAL_STATUS_OK);
        dal_evaluator_free(evaluator);
    }
}

#define PLANE "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: "

typedef struct kind {
    const char *text;
    int linear, constant, bilinear, quadratic, parity, homogeneous, reversible;
    double degree;
} kind;

static const kind kinds[] = {
    {PLANE "[x' + 2*y' - z']\n", 1, 1, 1, 1, -1, 1, 1, 1},
    {PLANE "[x' + 2*y' - z' + 0.3*x]\n", 1, 1, 1, 1, 0, 0, 0, 0},
    {PLANE "[x' + 2*y' - 0.1*t]\n", 1, 0, 0, 0, -1, 0, 1, 0},
    {PLANE "[x' + y*z']\n", 1, 0, 1, 1, -1, 1, 1, 1},
    {PLANE "[x' + y*z' + 0.1*t]\n", 1, 0, 0, 0, -1, 0, 1, 0},
    {PLANE "[x'*sin(z) - y'*cos(z)]\n", 1, 0, 0, 0, -1, 1, 1, 1},
    {PLANE "[x'^2 + y'^2 - z'^2]\nstart: {x': 0.6, y': 0.8, z': 1}\n", 0, 0, 0, 1, 1, 1, 1, 2},
    {PLANE "[x'^2 + y'^2 - z'^2 + y*x']\nstart: {x': 0.6, y': 0.8, z': 1}\n", 0, 0, 0, 1, 0, 0, 0,
     0},
    {PLANE "[x'^3 - y'^3]\nstart: {x': 1, y': 1}\n", 0, 0, 0, 0, -1, 1, 1, 3},
    /* g goes to -g with v */
    {PLANE "[x' + y*z']\nmechanics: vakonomic\nstart: {g1: 0.5}\n", 1, 0, 1, 1, -1, 1, 1, 1},
    {PLANE "[x'^2 - y'^2]\nmechanics: vakonomic\nstart: {x': 1, y': 1, g1: 0.2}\n", 0, 0, 0, 1, 1,
     1, 1, 2},
};

static void examine_kind(const kind *expected)
{
    dal_evaluator *evaluator = fixture_evaluator(fixture_system(expected->text));
    double x[8], degree = -1.0;
    dal_constraint_class d;
    CU_ASSERT_EQUAL(dal_evaluator_start(evaluator, NULL, 0, x, NULL), DAL_STATUS_OK);
    const dal_point at = {.t = 0.0, .q = x, .v = x + 3};
    CU_ASSERT_EQUAL(dal_evaluator_classify_constraints(evaluator, &at, &d, &degree), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(d.linear, expected->linear);
    CU_ASSERT_EQUAL(d.constant, expected->constant);
    CU_ASSERT_EQUAL(d.bilinear, expected->bilinear);
    CU_ASSERT_EQUAL(d.quadratic, expected->quadratic);
    CU_ASSERT_EQUAL(d.parity, expected->parity);
    CU_ASSERT_EQUAL(d.homogeneous, expected->homogeneous);
    if (d.homogeneous) CU_ASSERT_DOUBLE_EQUAL(degree, expected->degree, 1e-9);
    CU_ASSERT_EQUAL(d.reversible, expected->reversible);
    dal_evaluator_free(evaluator);
}

static void test_degree(void)
{
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) examine_kind(&kinds[k]);
}

/* D = x' + 2 y' - z' with k times something of another kind: below 1e-11 that is rounding, and
 * parts of 1e-9 are seen.  Homogeneous is a D of one degree to 1e-8. */
static void test_nearly(void)
{
    static const struct {
        const char *more;
        int linear, constant, bilinear, quadratic, parity, homogeneous;
    } cases[] = {{"x'^2", 0, 0, 0, 1, 0, 0},
                 {"x*x'", 1, 0, 1, 1, -1, 1},
                 {"t*x'", 1, 0, 0, 0, 0, 1},
                 {"x'^3", 0, 0, 0, 0, -1, 0},
                 {"(1 + x)", 1, 1, 1, 1, 0, 0}};
    static const double factor[] = {1e-13, 1e-6};
    for (int i = 0; i < 10; i++) {
        char text[256];
        double x[8];
        dal_constraint_class d;
        snprintf(text, sizeof text, PLANE "[x' + 2*y' - z' + %g*%s]\nstart: {x': 1, z': 1}\n",
                 factor[i % 2], cases[i / 2].more);
        dal_evaluator *evaluator = fixture_evaluator(fixture_system(text));
        CU_ASSERT_EQUAL(dal_evaluator_start(evaluator, NULL, 0, x, NULL), DAL_STATUS_OK);
        const dal_point at = {.t = 0.0, .q = x, .v = x + 3};
        CU_ASSERT_EQUAL(dal_evaluator_classify_constraints(evaluator, &at, &d, NULL),
                        DAL_STATUS_OK);
        CU_ASSERT_EQUAL(d.linear, i % 2 ? cases[i / 2].linear : 1);
        CU_ASSERT_EQUAL(d.constant, i % 2 ? cases[i / 2].constant : 1);
        CU_ASSERT_EQUAL(d.bilinear, i % 2 ? cases[i / 2].bilinear : 1);
        CU_ASSERT_EQUAL(d.quadratic, i % 2 ? cases[i / 2].quadratic : 1);
        CU_ASSERT_EQUAL(d.parity, i % 2 ? cases[i / 2].parity : -1);
        CU_ASSERT_EQUAL(d.homogeneous, i % 2 ? cases[i / 2].homogeneous : 1);
        dal_evaluator_free(evaluator);
    }
}

/* D1 = x' - y', D2 = x' - (1 + s) y': scaled to a unit diagonal G is [1 c; c 1] with
 * 1 - c^2 = s^2/4 (1 - s ...), its columns 2^(1/2) long at first and s^2/4 2^(-1/2) at last: the
 * pivot is s^2/8, 1e-10 at s = 2.83e-5. */
static void test_nearly_dependent(void)
{
    static const double s[] = {3.0e-5, -3.0e-5, 2.65e-5, -2.65e-5, 0.1};
    for (int i = 0; i < 5; i++) {
        char text[256];
        double x[8], pivot = -1.0;
        int rank = 0;
        snprintf(text, sizeof text,
                 PLANE "[x' - y', x' - (1 + s)*y']\n"
                       "parameters: {s: %g}\n",
                 s[i]);
        dal_evaluator *evaluator = fixture_evaluator(fixture_system(text));
        CU_ASSERT_EQUAL(dal_evaluator_start(evaluator, NULL, 0, x, NULL), DAL_STATUS_OK);
        const dal_point at = {.t = 0.0, .q = x, .v = x + 3};
        CU_ASSERT_EQUAL(dal_evaluator_measure_rank(evaluator, &at, &rank, &pivot), DAL_STATUS_OK);
        const int full = i < 2 || i == 4;
        CU_ASSERT_EQUAL(rank, full ? 2 : 1);
        CU_ASSERT_DOUBLE_EQUAL(pivot, full ? s[i] * s[i] / 8.0 : 0.0, 0.15 * s[i] * s[i] / 8.0);
        dal_evaluator_free(evaluator);
    }
}

/* A friction k x' changes F by 2 k x' under v -> -v, x' being drawn from 1 +- 0.3 and F below 1:
 * the defect is between 2 k and 2.6 k, and 1e-10 of it parts reversible from not. */
static void test_nearly_reversible(void)
{
    static const double frictions[] = {0.0, 1e-12, 3.7e-11, 5.1e-11, 1e-9, 1e-4};
    for (int i = 0; i < 6; i++) {
        const dal_setting k = {"k", frictions[i]};
        dal_evaluator *evaluator;
        double x[3];
        dal_constraint_class d;
        CU_ASSERT_EQUAL_FATAL(
            dal_evaluator_create(
                &evaluator,
                fixture_system("coordinates: [x]\nparameters: {k: 0}\n"
                               "accelerations: {x: -0.5*x - k*x'}\nstart: {x': 1}\n"),
                &k, 1, NULL),
            DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_evaluator_start(evaluator, NULL, 0, x, NULL), DAL_STATUS_OK);
        const dal_point at = {.t = 0.0, .q = x, .v = x + 1};
        CU_ASSERT_EQUAL(dal_evaluator_classify_constraints(evaluator, &at, &d, NULL),
                        DAL_STATUS_OK);
        CU_ASSERT(d.force_defect >= 2.0 * frictions[i] - 1e-15);
        CU_ASSERT(d.force_defect <= 2.6 * frictions[i] + 1e-15);
        CU_ASSERT_EQUAL(d.reversible, i < 3);
        dal_evaluator_free(evaluator);
    }
}

/* ---- what cannot be measured ---- */

/* D is not a number anywhere, log(-k), though its derivatives and F are. */
static const char no_values[] = "coordinates: [x, y]\nparameters: {k: 1}\n"
                                "lagrangian: (x'^2 + y'^2)/2\n"
                                "constraints: [\"x'*cos(y) - y'*sin(y) + log(-k)\"]\n";

static dal_status no_field(const dal_system *s, const dal_point *at, double *out)
{
    (void)s;
    (void)at;
    out[0] = NAN;
    return DAL_STATUS_OK;
}

static void test_unmeasured(void)
{
    const double q[] = {0.1, 0.2}, v[] = {1.0, 0.5};
    const dal_point at = {.t = 0.0, .q = q, .v = v};
    const dal_system *system = fixture_system(no_values);
    dal_evaluator *evaluator = fixture_evaluator(system);
    dal_derivatives derivatives;
    dal_constraint_class class;
    double rate;
    CU_ASSERT_EQUAL(dal_evaluator_measure_rate(evaluator, system->constraints, 1, &at, &rate),
                    DAL_STATUS_NOT_FINITE);
    CU_ASSERT_EQUAL(dal_evaluator_check_derivatives(evaluator, &at, &derivatives),
                    DAL_STATUS_NOT_FINITE);
    CU_ASSERT_EQUAL(dal_evaluator_classify_constraints(evaluator, &at, &class, NULL),
                    DAL_STATUS_NOT_FINITE);
    CU_ASSERT(!class.linear && !class.constant && !class.bilinear && !class.quadratic);
    CU_ASSERT(!class.homogeneous);
    dal_evaluator_free(evaluator);
    const dal_system empty = {.name = "empty", .n = 1, .call = {.field = no_field}};
    evaluator = fixture_evaluator(&empty);
    CU_ASSERT_EQUAL(dal_evaluator_classify_constraints(evaluator, &at, &class, NULL),
                    DAL_STATUS_OK);
    CU_ASSERT(isnan(class.force_defect) && !class.reversible);
    dal_evaluator_free(evaluator);
    dal_system unknown = *fixture_system("knife-edge");
    unknown.constraints = NULL;
    evaluator = fixture_evaluator(&unknown);
    CU_ASSERT_EQUAL(dal_evaluator_classify_constraints(evaluator, &at, &class, NULL),
                    DAL_STATUS_UNSUPPORTED);
    dal_evaluator_free(evaluator);
}

/* ---- far away and near by ---- */

/* F = -sin(phi): its jacobian against differences at phi = 1e5, and of -1e-6 sin(1e6 x + 1). */
static void test_derivatives_anywhere(void)
{
    const char *const texts[] = {"coordinates: [x]\naccelerations: {x: -sin(x)}\n",
                                 "coordinates: [x]\naccelerations: {x: -1e-6*sin(1e6*x + 1)}\n"};
    const double place[] = {1e5, 0.0}, v = 0.3;
    for (int k = 0; k < 2; k++) {
        dal_evaluator *evaluator = fixture_evaluator(fixture_system(texts[k]));
        const dal_point at = {.t = 0.0, .q = &place[k], .v = &v};
        dal_derivatives d;
        CU_ASSERT_EQUAL(dal_evaluator_check_derivatives(evaluator, &at, &d), DAL_STATUS_OK);
        CU_ASSERT(d.jacobian >= 0.0 && d.jacobian < 1e-8);
        CU_ASSERT(d.adjoint >= 0.0 && d.adjoint < 1e-8);
        dal_evaluator_free(evaluator);
    }
}

/* ---- memory ---- */

static dal_status all_measures(const dal_system *system)
{
    dal_evaluator *evaluator;
    double x[16], numbers[16];
    int rank;
    dal_derivatives derivatives;
    dal_constraint_class class;
    dal_status status = dal_evaluator_create(&evaluator, system, NULL, 0, NULL);
    if (status != DAL_STATUS_OK) return status;
    status = dal_evaluator_start(evaluator, NULL, 0, x, NULL);
    const dal_point at = {.t = 0.0, .q = x, .v = x + system->n};
    if (!status) status = dal_evaluator_measure_rate(evaluator, system->energy, 1, &at, numbers);
    if (!status) status = dal_evaluator_check_derivatives(evaluator, &at, &derivatives);
    if (!status) status = dal_evaluator_measure_rank(evaluator, &at, &rank, numbers);
    if (!status) status = dal_evaluator_project_velocity(evaluator, 0.0, x, x + system->n);
    if (!status) status = dal_evaluator_classify_constraints(evaluator, &at, &class, NULL);
    dal_evaluator_free(evaluator);
    return status;
}

static void test_out_of_memory(void)
{
    const dal_system *system = fixture_system("chaplygin-sleigh");
    allocation_trial trial = {0};
    while (allocation_next(&trial)) {
        allocation_start(&trial);
        allocation_end(&trial, all_measures(system));
    }
    CU_ASSERT(trial.failures >= 7);
}

void suite_measure(void)
{
    CU_pSuite suite = CU_add_suite("measures of a system", NULL, NULL);
    CU_add_test(suite, "an evaluator", test_evaluator);
    CU_add_test(suite, "the number pi", test_evaluator_pi);
    CU_add_test(suite, "unknown names", test_evaluator_names);
    CU_add_test(suite, "rate along the motion", test_rate);
    CU_add_test(suite, "wrong derivatives are found", test_derivatives_find_faults);
    CU_add_test(suite, "derivatives of systems", test_derivatives_of_systems);
    CU_add_test(suite, "what cannot be measured", test_unmeasured);
    CU_add_test(suite, "derivatives far away and of small lengths", test_derivatives_anywhere);
    CU_add_test(suite, "rank of G", test_rank);
    CU_add_test(suite, "velocities projected to D = 0", test_project_velocity);
    CU_add_test(suite, "scales that fail", test_scales_fail);
    CU_add_test(suite, "positions projected to a circle", test_project_position);
    CU_add_test(suite, "no projection to a D without zero", test_project_velocity_nothing);
    CU_add_test(suite, "no projection where the gradients of D are 0",
                test_project_velocity_singular);
    CU_add_test(suite, "projection to a D of the size of rounding", test_project_velocity_rounding);
    CU_add_test(suite, "kinds of D", test_degree);
    CU_add_test(suite, "nearly of another kind", test_nearly);
    CU_add_test(suite, "nearly dependent constraints", test_nearly_dependent);
    CU_add_test(suite, "reversible within 1e-10", test_nearly_reversible);
    CU_add_test(suite, "out of memory", test_out_of_memory);
}
