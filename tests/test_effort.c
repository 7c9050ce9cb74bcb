/* test_effort.c - K of the lift: closed forms, D as an integral for all p and pi, symplecticity,
 * and the same bits on p = pi = 0. */
#include "failing.h"
#include "fixtures.h"
#include "quick.h"
#include <CUnit/CUnit.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX = 16, WORKSPACE = 4096 };

#define SLEIGH                                                                                     \
    "coordinates: [x, y, phi]\nparameters: {m: 2, I: 3}\n"                                         \
    "lagrangian: m/2*(x'^2 + y'^2) + I/2*phi'^2\nconstraints: [x'*sin(phi) - y'*cos(phi)]\n"
/* One control drives, the other one pushes at the centre: the sideways part of it does nothing. */
static const char sleigh[] =
    SLEIGH "controls: [{x: cos(phi), y: sin(phi)}, {phi: 5, x: sin(phi), y: -cos(phi)}]\n"
           "start: {x': 0.5, phi': 0.3}\n";

static const dal_system *system_of(dal_model **model, const char *text, dal_effort effort)
{
    const dal_system *system = NULL;
    *model = fixture_model(text);
    CU_ASSERT_EQUAL(dal_model_set_effort(*model, effort, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_model_system(*model, &system, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(system->effort, effort);
    return system;
}

/* ---- K ---- */

static void evaluate(const char *text, dal_effort effort, const double *q, const double *v,
                     const double *pi, double *out)
{
    dal_model *model;
    const dal_system *system = system_of(&model, text, effort);
    dal_evaluator *evaluator = fixture_evaluator(system);
    CU_ASSERT_EQUAL(dal_evaluator_call(evaluator, system->call.effort, 0.0, q, v, pi, out),
                    DAL_STATUS_OK);
    dal_derivatives d;
    const dal_point at = {.q = q, .v = v};
    CU_ASSERT_EQUAL(dal_evaluator_check_derivatives(evaluator, &at, &d), DAL_STATUS_OK);
    CU_ASSERT(d.effort <= 1e-10);
    CU_ASSERT(effort == DAL_EFFORT_MASS ? isnan(d.effort_constraint)
                                        : d.effort_constraint <= 1e-14);
    dal_evaluator_free(evaluator);
    dal_model_free(model);
}

/* With u = (cos, sin) along the sleigh, and n = (sin, -cos) across it, which no reaction lets move:
 *     mass pi/(m, m, I)      constraint u u^T/m + 1/I      controls u u^T/m^2 + 25/I^2 */
static void test_closed_forms(void)
{
    const double m = 2.0, I = 3.0, phi = 0.7, q[] = {0.2, -0.3, phi}, v[] = {0.5, 0.1, -0.4};
    const double pi[] = {0.9, -0.6, 0.35}, c = cos(phi), s = sin(phi);
    const double along = c * pi[0] + s * pi[1], across = -s * pi[0] + c * pi[1];
    double out[9];
    evaluate(sleigh, DAL_EFFORT_MASS, q, v, pi, out);
    for (int i = 0; i < 9; i++)
        CU_ASSERT_DOUBLE_EQUAL(out[i], i < 2 ? pi[i] / m : i == 2 ? pi[2] / I : 0.0, 1e-15);
    for (int controls = 0; controls < 2; controls++) {
        const double by = controls ? 1.0 / (m * m) : 1.0 / m,
                     turn = controls ? 25.0 / (I * I) : 1 / I;
        evaluate(sleigh, controls ? DAL_EFFORT_CONTROLS : DAL_EFFORT_CONSTRAINT, q, v, pi, out);
        CU_ASSERT_DOUBLE_EQUAL(out[0], by * along * c, 1e-15);
        CU_ASSERT_DOUBLE_EQUAL(out[1], by * along * s, 1e-15);
        CU_ASSERT_DOUBLE_EQUAL(out[2], turn * pi[2], 1e-15);
        CU_ASSERT_DOUBLE_EQUAL(out[5], by * along * across, 1e-15);
        for (int i = 3; i < 9; i++)
            if (i != 5) CU_ASSERT_DOUBLE_EQUAL(out[i], 0.0, 1e-15);
    }
}

/* K = M W M^T with M = P W^-1 for reactions of their own: by hand for one constraint,
 * P = 1 - R A/(A R) and R = W^-1 B, A = (-y, 0, 1), B = (1, 0, 2), W = diag(1, 2, 4). */
static void test_reactions(void)
{
    static const char text[] =
        "coordinates: [x, y, z]\nlagrangian: x'^2/2 + y'^2 + 2*z'^2\n"
        "constraints: [z' - y*x']\nreactions: [{x: 1, z: 2}]\nstart: {y: 0.3}\n";
    const double q[] = {0.4, -0.7, 0.1}, v[] = {0.2, 0.3, -0.5}, pi[] = {0.5, 0.8, -0.9};
    const double W[] = {1.0, 2.0, 4.0}, A[] = {-q[1], 0.0, 1.0}, R[] = {1.0, 0.0, 0.5};
    const double AR = A[0] * R[0] + A[2] * R[2];
    double P[3][3], K[3][3] = {{0}}, out[9];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) P[i][j] = (i == j) - R[i] * A[j] / AR;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++) K[i][j] += P[i][k] * P[j][k] / W[k];
    evaluate(text, DAL_EFFORT_CONSTRAINT, q, v, pi, out);
    for (int i = 0; i < 3; i++) {
        double sum = 0.0;
        for (int j = 0; j < 3; j++) sum += K[i][j] * pi[j];
        CU_ASSERT_DOUBLE_EQUAL(out[i], sum, 1e-14);
    }
}

/* W is singular, and on ker A it is not. */
static void test_restricted(void)
{
    static const char text[] = "coordinates: [x, y]\nlagrangian: x'^2/2 - y^2/2\n"
                               "constraints: [y' - cos(x)*x']\nstart: {x': 0.4}\n";
    const double q[] = {0.3, 0.2}, v[] = {0.1, 0.4}, pi[] = {0.5, -0.8};
    const double u[] = {1.0, cos(0.3)}, along = pi[0] + pi[1] * cos(0.3);
    dal_error error = {0};
    const dal_system *system;
    double out[6];
    evaluate(text, DAL_EFFORT_CONSTRAINT, q, v, pi, out);
    for (int i = 0; i < 2; i++) CU_ASSERT_DOUBLE_EQUAL(out[i], u[i] * along, 1e-14);
    dal_model *model = fixture_model(text);
    CU_ASSERT_EQUAL(dal_model_set_effort(model, DAL_EFFORT_MASS, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_model_system(model, &system, &error), DAL_STATUS_UNSUPPORTED);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "effort mass: the mass matrix is singular"));
    dal_model_free(model);
}

/* Equations S = M q'' + s: K of mass is M^-1 M^-T, with which the lift has the action (nh8). */
static void test_equations(void)
{
    static const char text[] =
        "coordinates: [x, y]\n"
        "equations: [2*x'' + (1 + y^2)*y'' + x, x'' - 3*y'' + y*x']\nstart: {x: 1}\n";
    const double q[] = {0.3, 0.2}, v[] = {0.1, 0.4}, pi[] = {0.5, -0.8};
    const double c = 1.0 + q[1] * q[1], determinant = -6.0 - c;
    const double w[] = {(-3.0 * pi[0] - pi[1]) / determinant,
                        (-c * pi[0] + 2.0 * pi[1]) / determinant};
    double out[6];
    evaluate(text, DAL_EFFORT_MASS, q, v, pi, out);
    CU_ASSERT_DOUBLE_EQUAL(out[0], (-3.0 * w[0] - c * w[1]) / determinant, 1e-15);
    CU_ASSERT_DOUBLE_EQUAL(out[1], (-w[0] + 2.0 * w[1]) / determinant, 1e-15);
}

/* ---- runs ---- */

static dal_run *perturbed(const dal_system *system, const char *method, double step)
{
    dal_run_spec spec = fixture_spec(system, method, DAL_LIFTED, step);
    dal_run *run = fixture_run(&spec);
    fixture_perturb(run, 0.3);
    return run;
}

/* The largest change of D within a time 2, p and pi being of order 1. */
static double change_of_D(const char *text, dal_effort effort, const char *method, double step)
{
    dal_model *model;
    const dal_system *system = system_of(&model, text, effort);
    dal_run *run = perturbed(system, method, step);
    double first[64], now[64], max = 0.0;
    CU_ASSERT_EQUAL(dal_run_observe(run, first), DAL_STATUS_OK);
    for (int k = 0; k < 8; k++) {
        CU_ASSERT_EQUAL(dal_run_advance(run, (long long)round(0.25 / step), NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_observe(run, now), DAL_STATUS_OK);
        for (int a = 0; a < system->m; a++) max = fmax(max, fabs(now[a] - first[a]));
    }
    dal_run_free(run);
    dal_model_free(model);
    return max;
}

/* D is kept to rounding by the methods that preserve its kind, else to their order; with the
 * identity the push pi/e moves it. */
static void test_constraints_kept(void)
{
    const struct {
        const char *text, *method;
    } kept[] = {{fixture_constant, "rk4"},
                {fixture_constant, "stormer-verlet"},
                {fixture_bilinear, "stormer-verlet"},
                {fixture_bilinear, "lobatto4"},
                {fixture_quadratic, "gauss4"}};
    for (size_t k = 0; k < sizeof kept / sizeof *kept; k++) {
        const double error = change_of_D(kept[k].text, DAL_EFFORT_CONSTRAINT, kept[k].method, 0.05);
        if (!(error <= 1e-13)) printf("\n  %zu, %s: D changes by %.2e\n", k, kept[k].method, error);
        CU_ASSERT(error <= 1e-13);
        CU_ASSERT(change_of_D(kept[k].text, DAL_EFFORT_IDENTITY, kept[k].method, 0.05) > 1e-3);
    }
    const char *const fourth[] = {"rk4", "gauss4", "lobatto4"};
    for (int k = 0; k < 3; k++)
        for (int controls = 0; controls < 2; controls++) {
            const dal_effort effort = controls ? DAL_EFFORT_CONTROLS : DAL_EFFORT_CONSTRAINT;
            const double order = log2(change_of_D(sleigh, effort, fourth[k], 0.05) /
                                      change_of_D(sleigh, effort, fourth[k], 0.025));
            CU_ASSERT(order > 3.5);
        }
}

/* The extremal from rest to rest of a free coordinate is a cubic, which these methods integrate
 * exactly; on the sleigh forwards by d, and turned by theta, at the cost 6 m d^2/T^3 and
 * 6 I theta^2/T^3, which pi_e accumulates. */
static void test_rest_to_rest(void)
{
    const double T = 1.5, d = 0.8, inertia[] = {2.0, 3.0};
    const char *const methods[] = {"gauss4", "lobatto4", "taylor"};
    for (int k = 0; k < 3; k++)
        for (int turns = 0; turns < 2; turns++) {
            dal_model *model;
            dal_run_spec spec = fixture_spec(system_of(&model, SLEIGH, DAL_EFFORT_CONSTRAINT),
                                             methods[k], DAL_LIFTED, T / 20.0);
            const double a = 6.0 * inertia[turns] * d / (T * T);
            const dal_setting start[] = {{turns ? "pi_phi" : "pi_x", a},
                                         {turns ? "p_phi" : "p_x", 2.0 * a / T}};
            spec.start = start;
            spec.start_count = 2;
            dal_run *run = fixture_stepped(&spec, 20);
            const double *y = dal_run_state(run);
            CU_ASSERT_DOUBLE_EQUAL(y[turns ? 2 : 0], d, 1e-14);
            CU_ASSERT_DOUBLE_EQUAL(y[turns ? 5 : 3], 0.0, 1e-13);
            CU_ASSERT_DOUBLE_EQUAL(y[13], 6.0 * inertia[turns] * d * d / (T * T * T), 1e-13);
            dal_run_free(run);
            dal_model_free(model);
        }
}

/* H = pi.K pi/(2e) + .. is the Hamiltonian of the steps: they are symplectic, and the methods of
 * high order keep it. */
static void test_hamiltonian(void)
{
    const char *const methods[] = {"symplectic-euler-10",
                                   "symplectic-euler-01",
                                   "symplectic-euler-00",
                                   "stormer-verlet",
                                   "gauss4",
                                   "rk4+lift"};
    for (int effort = DAL_EFFORT_MASS; effort < DAL_EFFORT_COUNT; effort++) {
        dal_model *model;
        const dal_system *system = system_of(&model, sleigh, (dal_effort)effort);
        for (int k = 0; k < 6; k++) {
            const dal_run_spec spec = fixture_spec(system, methods[k], DAL_LIFTED, 0.1);
            CU_ASSERT(fixture_symplectic_defect(&spec) <= 1e-9);
        }
        const char *const exact[] = {"gauss12", "taylor"};
        for (int k = 0; k < 2; k++) {
            dal_run *run = perturbed(system, exact[k], 0.02);
            fixture_keeps_H(run, 50);
            dal_run_free(run);
        }
        dal_model_free(model);
    }
}

/* On p = pi = 0 no effort changes a bit; F may depend on v or not, W may be full. */
static void test_surface(void)
{
    const char *const texts[] = {sleigh, fixture_full, "vertical-disk"};
    const char *const methods[] = {"rk4",    "dop853",         "gauss4",  "symplectic-euler-10",
                                   "taylor", "stormer-verlet", "lobatto4"};
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 7; i++) {
            double states[DAL_EFFORT_COUNT][2 * MAX];
            for (int effort = 0; effort < DAL_EFFORT_COUNT - (k > 0); effort++) {
                dal_model *model;
                const dal_system *system = system_of(&model, texts[k], (dal_effort)effort);
                dal_run_spec spec = fixture_spec(system, methods[i], DAL_LIFTED, 0.05);
                dal_run *run = fixture_stepped(&spec, 40);
                const size_t size = 2 * (size_t)system->n * sizeof(double);
                memcpy(states[effort], dal_run_state(run), size);
                CU_ASSERT(memcmp(states[effort], states[0], size) == 0);
                dal_run_free(run);
                dal_model_free(model);
            }
        }
}

/* Lanes have the bits of single runs, and quad precision agrees to the rounding of double. */
static void test_forms(void)
{
    const char *const methods[] = {"rk4", "gauss4", "stormer-verlet", "taylor", "dop853"};
    dal_model *model;
    const dal_system *system = system_of(&model, sleigh, DAL_EFFORT_CONSTRAINT);
    for (int k = 0; k < 5; k++) {
        dal_run_spec spec = fixture_spec(system, methods[k], DAL_LIFTED, 0.05);
        fixture_lanes(spec, 9, 20, "pi_x", 0.3, 0.02);
        if (!system->quad) continue;
        const dal_setting start[] = {{"pi_x", 0.4}, {"p_phi", -0.2}, {"pi_phi", 0.1}};
        spec.start = start;
        spec.start_count = 3;
        dal_run *runs[2];
        for (int quad = 0; quad < 2; quad++) {
            spec.options.precision = quad ? DAL_QUAD : DAL_DOUBLE;
            runs[quad] = fixture_stepped(&spec, 20);
        }
        for (int i = 0; i < dal_run_dimension(runs[0]); i++)
            CU_ASSERT_DOUBLE_EQUAL(dal_run_state(runs[0])[i], dal_run_state(runs[1])[i], 1e-14);
        dal_run_free(runs[0]);
        dal_run_free(runs[1]);
    }
    dal_model_free(model);
}

/* ---- refusals ---- */

static void refused(const char *text, dal_effort effort, dal_status status, const char *fragment)
{
    dal_model *model = fixture_model(text);
    const dal_system *system;
    dal_error error = {0};
    CU_ASSERT_EQUAL(dal_model_set_effort(model, effort, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_model_system(model, &system, &error), status);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, fragment));
    dal_model_free(model);
}

static void test_refused(void)
{
    dal_model *model;
    dal_error error = {0};
    const dal_system *system = system_of(&model, sleigh, DAL_EFFORT_MASS);
    CU_ASSERT_EQUAL(dal_model_set_effort(model, DAL_EFFORT_IDENTITY, &error), DAL_STATUS_ARGUMENT);
    CU_ASSERT_STRING_EQUAL(error.message, "'fixture' already has its system: its effort is mass");
    CU_ASSERT_PTR_NOT_NULL(system);
    dal_model_free(model);
    model = fixture_model(sleigh);
    CU_ASSERT_EQUAL(dal_model_set_effort(model, DAL_EFFORT_COUNT, &error), DAL_STATUS_ARGUMENT);
    dal_model_free(model);
    refused(SLEIGH, DAL_EFFORT_CONTROLS, DAL_STATUS_MODEL, "effort controls: the system has none");
    refused("chaplygin-sleigh-vakonomic", DAL_EFFORT_MASS, DAL_STATUS_UNSUPPORTED,
            "effort mass: vakonomic motion has no lift");
    refused(SLEIGH "controls: [{z: 1}]\n", DAL_EFFORT_IDENTITY, DAL_STATUS_NAME,
            "unknown coordinate in controls 'z'");
    refused(SLEIGH "controls: [{x: u}]\n", DAL_EFFORT_IDENTITY, DAL_STATUS_NAME, "control");
    /* A mass that depends on v: pi.K pi/2 has no flow in closed form. */
    system = system_of(&model, "coordinates: [x]\nlagrangian: x'^2/2 + x'^4/4\n", DAL_EFFORT_MASS);
    dal_run_spec spec = fixture_spec(system, "rk4+lift", DAL_LIFTED, 0.1);
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, "K of the effort depends on v");
    spec = fixture_spec(system, "symplectic-euler-10", DAL_LIFTED, 0.1);
    CU_ASSERT(fixture_symplectic_defect(&spec) <= 1e-9);
    dal_model_free(model);
}

/* ---- gauges ---- */

/* A gauge has the bits of the same one in the file, replaces it, and changes no bit of (q, v)
 * on p = pi = 0. */
static void test_gauge(void)
{
    const char *const methods[] = {"rk4", "gauss4", "stormer-verlet"};
    static const char gauge[] = "e = 2 + I/8, mu_e = 0.1*min(cos(t), 2)";
    static const char in_file[] = SLEIGH "gauge: {e: 2 + I/8, mu_e: '0.1*min(cos(t), 2)'}\n"
                                         "start: {x': 0.5, phi': 0.3}\n";
    for (int k = 0; k < 3; k++) {
        double states[3][14];
        for (int i = 0; i < 3; i++) {
            const dal_system *system;
            dal_model *model = fixture_model(i < 2 ? in_file : sleigh);
            if (i != 1)
                CU_ASSERT_EQUAL(dal_model_set_gauge(model, i == 0 ? "mu_e = -0.01" : gauge, NULL),
                                DAL_STATUS_OK);
            CU_ASSERT_EQUAL_FATAL(dal_model_system(model, &system, NULL), DAL_STATUS_OK);
            dal_run_spec spec = fixture_spec(system, methods[k], DAL_LIFTED, 0.125);
            dal_run *run = fixture_stepped(&spec, 8);
            memcpy(states[i], dal_run_state(run), sizeof states[i]);
            dal_run_free(run);
            dal_model_free(model);
        }
        CU_ASSERT(memcmp(states[1], states[2], sizeof states[1]) == 0);
        CU_ASSERT(memcmp(states[0], states[1], 6 * sizeof(double)) == 0);
        CU_ASSERT_DOUBLE_EQUAL(states[0][6], 0.99, 1e-15);
        CU_ASSERT_DOUBLE_EQUAL(states[1][6], 2.375 + 0.1 * sin(1.0), 1e-3);
    }
}

static void test_gauge_refused(void)
{
    const struct {
        const char *text;
        dal_status status;
        int column;
        const char *fragment;
    } bad[] = {{"", DAL_STATUS_SYNTAX, 1, "a gauge is 'e = 1, mu_e"},
               {"e = 1, ", DAL_STATUS_SYNTAX, 8, "a gauge is 'e = 1, mu_e"},
               {"e = 1,  mu = 2", DAL_STATUS_NAME, 9, "'mu' is not e or mu_e"},
               {"e = 1, e = 2", DAL_STATUS_MODEL, 8, "duplicate 'e' in gauge"},
               {"mu_e = 0.1*y1", DAL_STATUS_NAME, 12, "gauge mu_e: "},
               {"mu_e = cos(", DAL_STATUS_SYNTAX, 12, "gauge mu_e"},
               {"e = t", DAL_STATUS_NAME, 5, "gauge e: "},
               {"mu_e =", DAL_STATUS_SYNTAX, 7, "gauge mu_e"},
               {"e = I - 3", DAL_STATUS_MODEL, 5, "gauge e: 0 is not above 0"},
               {"e = -1", DAL_STATUS_MODEL, 5, "gauge e: -1 is not above 0"},
               {"e = exp(I*1000)", DAL_STATUS_MODEL, 5, "gauge e: "}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        dal_model *model = fixture_model(sleigh);
        const dal_system *system;
        dal_error error = {0};
        dal_status status = dal_model_set_gauge(model, bad[i].text, &error);
        if (status == DAL_STATUS_OK) status = dal_model_system(model, &system, &error);
        CU_ASSERT_EQUAL(status, bad[i].status);
        if (!strstr(error.message, bad[i].fragment) || error.column != bad[i].column)
            printf("\n  %s: %d: %s\n", bad[i].text, error.column, error.message);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.message, bad[i].fragment));
        CU_ASSERT_EQUAL(error.line, 1);
        CU_ASSERT_EQUAL(error.column, bad[i].column);
        dal_model_free(model);
    }
    dal_model *model;
    system_of(&model, sleigh, DAL_EFFORT_IDENTITY);
    CU_ASSERT_EQUAL(dal_model_set_gauge(model, "e = 2", NULL), DAL_STATUS_ARGUMENT);
    dal_model_free(model);
}

/* ---- gauges of the state ---- */

/* A free particle with x' = b and mu_e = c e + d x' has e = (1 + d b/c) exp(c t) - d b/c.  From
 * p = pi = 0 a small pi_e decays like exp(-c t), p stays 0, and pi' = -d pi_e. */
static void test_gauge_of_state(void)
{
    static const char text[] = "coordinates: [x]\naccelerations: {x: 0}\nstart: {x': 0.5}\n"
                               "parameters: {c: 0.7, d: 0.3}\n";
    const char *const methods[] = {"rk4", "dop853"};
    for (int k = 0; k < 2; k++) {
        dal_model *model = fixture_model(text);
        const dal_system *system;
        CU_ASSERT_EQUAL(dal_model_set_gauge(model, "mu_e = c*e + d*x'", NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL_FATAL(dal_model_system(model, &system, NULL), DAL_STATUS_OK);
        dal_run_spec spec = fixture_spec(system, methods[k], DAL_LIFTED, 1.0 / 64.0);
        const dal_setting start[] = {{"pi_e", 1e-9}};
        dal_run *run = fixture_stepped(&spec, 64);
        const double *y = dal_run_state(run), c = 0.7, d = 0.3, b = 0.5;
        CU_ASSERT_DOUBLE_EQUAL(y[0], 0.5, 1e-15);
        CU_ASSERT_DOUBLE_EQUAL(y[2], (1.0 + d * b / c) * exp(c) - d * b / c, 1e-8);
        dal_run_free(run);
        spec.start = start;
        spec.start_count = 1;
        run = fixture_stepped(&spec, 64);
        y = dal_run_state(run);
        CU_ASSERT_DOUBLE_EQUAL(y[3], 0.0, 1e-20);
        CU_ASSERT_DOUBLE_EQUAL(y[5] * 1e9, exp(-c), 1e-8);
        CU_ASSERT_DOUBLE_EQUAL(y[4] * 1e9, -d * (1.0 - exp(-c)) / c, 1e-8);
        dal_run_free(run);
        dal_model_free(model);
    }
}

/* With every term of mu_e, off the surface: H is an integral, to the order of the method, which it
 * is with all derivatives and their signs alone.  On p = pi = 0 no bit of (q, v) changes, and lanes
 * and quad precision follow. */
static void test_gauge_of_all(void)
{
    static const char gauge[] = "e = 1.5, mu_e = 0.3*sin(x)*y' - 0.2*e*phi' + 0.1*e^2/(1 + x^2)";
    double drift[2], ends[2][6];
    dal_model *models[2];
    const dal_system *systems[2];
    for (int i = 0; i < 2; i++) {
        models[i] = fixture_model(sleigh);
        dal_model_set_effort(models[i], DAL_EFFORT_CONSTRAINT, NULL);
        if (i == 1) CU_ASSERT_EQUAL(dal_model_set_gauge(models[i], gauge, NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL_FATAL(dal_model_system(models[i], &systems[i], NULL), DAL_STATUS_OK);
        const dal_run_spec spec = fixture_spec(systems[i], "rk4", DAL_LIFTED, 0.05);
        dal_run *run = fixture_stepped(&spec, 40);
        memcpy(ends[i], dal_run_state(run), sizeof ends[i]);
        dal_run_free(run);
    }
    CU_ASSERT(memcmp(ends[0], ends[1], sizeof ends[0]) == 0);
    const dal_setting start[] = {{"pi_x", 0.4}, {"p_phi", -0.2}, {"pi_phi", 0.1}, {"pi_e", 0.7}};
    for (int i = 0; i < 2; i++) {
        dal_run_spec spec = fixture_spec(systems[1], "rk4", DAL_LIFTED, 0.05 / (1 + i));
        spec.start = start;
        spec.start_count = 4;
        double first[64], last[64];
        dal_run *run = fixture_stepped(&spec, 0);
        CU_ASSERT_EQUAL(dal_run_observe(run, first), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_advance(run, 20 * (1 + i), NULL), DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_run_observe(run, last), DAL_STATUS_OK);
        drift[i] = fabs(last[2] - first[2]); /* D1, E, H */
        CU_ASSERT(fabs(first[2]) > 0.01);
        dal_run_free(run);
    }
    CU_ASSERT(drift[0] < 1e-6 && log2(drift[0] / drift[1]) > 3.5);
    dal_run_spec spec = fixture_spec(systems[1], "dop853", DAL_LIFTED, 0.05);
    fixture_lanes(spec, 9, 20, "pi_x", 0.3, 0.02);
    spec.start = start;
    spec.start_count = 4;
    dal_run *runs[2];
    for (int quad = 0; quad < 2; quad++) {
        spec.options.precision = quad && systems[1]->quad ? DAL_QUAD : DAL_DOUBLE;
        runs[quad] = fixture_stepped(&spec, 20);
    }
    for (int i = 0; i < dal_run_dimension(runs[0]); i++)
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(runs[0])[i], dal_run_state(runs[1])[i], 1e-14);
    for (int i = 0; i < 2; i++) {
        dal_run_free(runs[i]);
        dal_model_free(models[i]);
    }
}

/* ---- checkpoints ---- */

/* A state of another effort or mu_e is refused by name, and changes nothing. */
static void test_restored(void)
{
    static const struct {
        dal_effort effort;
        const char *gauge;
    } lifts[] = {{DAL_EFFORT_IDENTITY, NULL},
                 {DAL_EFFORT_CONSTRAINT, NULL},
                 {DAL_EFFORT_IDENTITY, "e = 2, mu_e = 0.1*cos(t)"},
                 {DAL_EFFORT_IDENTITY, "e = 2, mu_e = 0.2*cos(t)"}};
    static const char *const refusal[4][4] = {
        {NULL, "effort constraint, and the run of effort identity", "whose mu_e is 0",
         "whose mu_e is 0"},
        {"effort identity, and the run of effort constraint", NULL, "effort identity",
         "effort identity"},
        {"whose mu_e is 0.1*cos(t)", "effort constraint, and the run of effort identity", NULL,
         "another gauge than the run, whose mu_e is 0.1*cos(t)"},
        {"whose mu_e is 0.2*cos(t)", "effort constraint", "whose mu_e is 0.2*cos(t)", NULL}};
    enum { LIFTS = sizeof lifts / sizeof *lifts };
    for (int quad = 0; quad < 2; quad++) {
        dal_model *models[LIFTS];
        dal_run *runs[LIFTS];
        for (int i = 0; i < LIFTS; i++) {
            const dal_system *system;
            models[i] = fixture_model(sleigh);
            dal_model_set_effort(models[i], lifts[i].effort, NULL);
            if (lifts[i].gauge) dal_model_set_gauge(models[i], lifts[i].gauge, NULL);
            CU_ASSERT_EQUAL_FATAL(dal_model_system(models[i], &system, NULL), DAL_STATUS_OK);
            dal_run_spec spec = fixture_spec(system, "gauss4", DAL_LIFTED, 0.125);
            if (quad && system->quad) spec.options.precision = DAL_QUAD;
            runs[i] = fixture_stepped(&spec, 2 + i);
        }
        for (int k = 0; k < LIFTS * LIFTS; k++) {
            const int from = k % LIFTS, to = k / LIFTS;
            size_t count;
            dal_error error = {0};
            const double *saved = dal_run_save(runs[from], &count), t = dal_run_time(runs[to]);
            const dal_status status = dal_run_restore(runs[to], saved, count, &error);
            const char *expected = refusal[to][from];
            CU_ASSERT_EQUAL(status, expected ? DAL_STATUS_ARGUMENT : DAL_STATUS_OK);
            if (expected && !strstr(error.message, expected))
                printf("\n  %d to %d: %s\n", from, to, error.message);
            CU_ASSERT(!expected || strstr(error.message, expected) != NULL);
            CU_ASSERT_EQUAL(dal_run_time(runs[to]), t);
        }
        for (int i = 0; i < LIFTS; i++) {
            dal_run_free(runs[i]);
            dal_model_free(models[i]);
        }
    }
}

/* Whichever call of K is the first that fails, so does what compares its derivatives. */
static void test_failures(void)
{
    static const char *const names[] = {"effort", NULL};
    const double q[] = {0.2, -0.3, 0.7}, v[] = {0.5, 0.1, -0.4};
    const dal_point at = {.q = q, .v = v};
    dal_model *model;
    const dal_system failing =
        failing_system(system_of(&model, sleigh, DAL_EFFORT_CONSTRAINT), names);
    dal_evaluator *evaluator = fixture_evaluator(&failing);
    long calls = 0;
    for (long call = 0; call <= calls; call++) {
        dal_derivatives d;
        failing_begin(call, call > 0 ? LONG_MAX : 0);
        const dal_status status = dal_evaluator_check_derivatives(evaluator, &at, &d);
        CU_ASSERT(call == 0 ? status == DAL_STATUS_OK : status != DAL_STATUS_OK);
        if (call == 0) calls = failing_calls();
    }
    failing_begin(0, 0);
    CU_ASSERT(calls > 12); /* a difference by each of q and v, and K itself */
    dal_evaluator_free(evaluator);
    dal_model_free(model);
}

void suite_effort(void)
{
    CU_pSuite suite = CU_add_suite("effort", NULL, NULL);
    CU_ADD_TEST(suite, test_closed_forms);
    CU_ADD_TEST(suite, test_failures);
    CU_ADD_TEST(suite, test_reactions);
    CU_ADD_TEST(suite, test_restricted);
    CU_add_test(suite, "K of equations", test_equations);
    CU_ADD_TEST(suite, test_constraints_kept);
    CU_ADD_TEST(suite, test_rest_to_rest);
    CU_ADD_TEST(suite, test_hamiltonian);
    CU_ADD_TEST(suite, test_surface);
    CU_ADD_TEST(suite, test_forms);
    CU_ADD_TEST(suite, test_refused);
    CU_ADD_TEST(suite, test_gauge);
    CU_ADD_TEST(suite, test_gauge_refused);
    CU_ADD_TEST(suite, test_gauge_of_state);
    CU_ADD_TEST(suite, test_gauge_of_all);
    CU_ADD_TEST(suite, test_restored);
}
