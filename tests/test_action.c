/* test_action.c - the actions of curves by closed forms and on exact motions, and the discrete
 * actions of methods at rows made by hand. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <string.h>

enum { ROWS = 41 };
static const char free_particle[] = "coordinates: [x]\naccelerations: {x: 0}\n";

/* Rows at different distances from 0 to T. */
static void times(double *t, double T)
{
    for (int k = 0; k < ROWS; k++) {
        const double s = (double)k / (ROWS - 1);
        t[k] = T * s * (0.7 + 0.3 * s);
    }
}

static dal_action action_of(const char *system, const dal_curve *curve, dal_action_form form)
{
    dal_evaluator *evaluator = fixture_evaluator(fixture_system(system));
    dal_action action = {NAN, NAN};
    CU_ASSERT_EQUAL(dal_evaluator_integrate_action(evaluator, curve, form, &action, NULL),
                    DAL_STATUS_OK);
    dal_evaluator_free(evaluator);
    return action;
}

/* x = a t^2/2 where the law is x'' = 0: the spline is exact.  (nh10) is a^2/2 int e dt; (nh11) with
 * v = b t and lambda = c adds c int (a - b) t dt; (nh23) with p = c, pi = d t, pi_e = f is
 * int c (a - b) t + d b t + f e' - d^2 t^2/(2e) dt. */
static void test_closed_forms(void)
{
    const double a = 0.7, b = 0.4, c = -1.3, d = 0.9, f = 0.6, T = 2.0;
    double t[ROWS], x[ROWS], v[ROWS], lambda[ROWS], pi[ROWS], e[ROWS], pi_e[ROWS];
    times(t, T);
    for (int k = 0; k < ROWS; k++) {
        x[k] = 0.5 * a * t[k] * t[k], v[k] = b * t[k], lambda[k] = c, pi[k] = d * t[k];
        e[k] = 1.0 + t[k], pi_e[k] = f;
    }
    dal_curve curve = {.rows = ROWS, .t = t, .q = x};
    dal_action got = action_of(free_particle, &curve, DAL_ACTION_SECOND_ORDER);
    CU_ASSERT_DOUBLE_EQUAL(got.value, 0.5 * a * a * T, 1e-12);
    CU_ASSERT(got.error < 1e-12);
    /* Without v both are the same. */
    got = action_of(free_particle, &curve, DAL_ACTION_FIRST_ORDER);
    CU_ASSERT_DOUBLE_EQUAL(got.value, 0.5 * a * a * T, 1e-12);
    curve.e = e, curve.v = v, curve.lambda = lambda, curve.p = lambda, curve.pi = pi;
    curve.pi_e = pi_e;
    const double of_e = T + 0.5 * T * T;
    got = action_of(free_particle, &curve, DAL_ACTION_SECOND_ORDER);
    CU_ASSERT_DOUBLE_EQUAL(got.value, 0.5 * a * a * of_e, 1e-12);
    got = action_of(free_particle, &curve, DAL_ACTION_FIRST_ORDER);
    CU_ASSERT_DOUBLE_EQUAL(got.value, 0.5 * b * b * of_e + 0.5 * c * (a - b) * T * T, 1e-12);
    got = action_of(free_particle, &curve, DAL_ACTION_HAMILTONIAN);
    CU_ASSERT_DOUBLE_EQUAL(got.value,
                           0.5 * (c * (a - b) + d * b) * T * T + f * T -
                               0.5 * d * d * (0.5 * T * T - T + log1p(T)),
                           1e-12);
}

/* General equations: S1 = 2 x'' - c, S2 = x' y'' - y - t; on x = t^2, y = 3 t they are 4 - c and
 * -4 t, so that S = int ((4 - c)^2 + 16 t^2)/2 dt. */
static void test_equations(void)
{
    static const char text[] = "coordinates: [x, y]\nparameters: {c: 1.5}\n"
                               "accelerations: {x: c/2, y: 0}\n"
                               "equations: [2*x'' - c, x'*y'' - y - t]\n";
    static const char alone[] = "coordinates: [x, y]\nparameters: {c: 1.5}\n"
                                "equations: [2*x'' - c, x'*y'' - y - t]\nstart: {x': 1}\n";
    const double T = 1.2;
    double t[ROWS], q[2 * ROWS];
    times(t, T);
    for (int k = 0; k < ROWS; k++) q[2 * k] = t[k] * t[k], q[2 * k + 1] = 3.0 * t[k];
    const dal_curve curve = {.rows = ROWS, .t = t, .q = q};
    dal_action got = action_of(text, &curve, DAL_ACTION_EQUATIONS);
    CU_ASSERT_DOUBLE_EQUAL(got.value, 0.5 * 2.5 * 2.5 * T + 8.0 / 3.0 * T * T * T, 1e-11);
    got = action_of(alone, &curve, DAL_ACTION_EQUATIONS);
    CU_ASSERT_DOUBLE_EQUAL(got.value, 0.5 * 2.5 * 2.5 * T + 8.0 / 3.0 * T * T * T, 1e-11);
    CU_ASSERT_EQUAL(fixture_system(text)->equations, 2);
    dal_evaluator *evaluator = fixture_evaluator(fixture_system(free_particle));
    dal_action action;
    CU_ASSERT_EQUAL(
        dal_evaluator_integrate_action(evaluator, &curve, DAL_ACTION_EQUATIONS, &action, NULL),
        DAL_STATUS_UNSUPPORTED);
    dal_evaluator_free(evaluator);
}

/* With F = -x + sin t and e = 1 on x = t^3, which the spline is: int (6 t + t^3 - sin t)^2/2 dt. */
static void test_field(void)
{
    const double T = 1.5;
    double t[ROWS], x[ROWS];
    times(t, T);
    for (int k = 0; k < ROWS; k++) x[k] = t[k] * t[k] * t[k];
    const dal_curve curve = {.rows = ROWS, .t = t, .q = x};
    const dal_action got = action_of("coordinates: [x]\naccelerations: {x: -x + sin(t)}\n", &curve,
                                     DAL_ACTION_SECOND_ORDER);
    const double s = sin(T), c = cos(T);
    const double polynomial = 12.0 * pow(T, 3) + 12.0 / 5.0 * pow(T, 5) + pow(T, 7) / 7.0;
    const double mixed = 6.0 * (s - T * c) + (3.0 * T * T - 6.0) * s - (T * T - 6.0) * T * c;
    CU_ASSERT_DOUBLE_EQUAL(got.value, 0.5 * (polynomial - 2.0 * mixed + 0.5 * (T - s * c)), 1e-11);
}

/* On the circle (nh30) the action of the sleigh vanishes like h^4, h being the distance of rows,
 * with a term h^5 of the intervals at the ends; on the circle moved by s sin^4 along y1 it does
 * not. */
static void circle(int rows, double moved, double *t, double *q)
{
    const double T = 2.0, pi = acos(-1.0);
    for (int k = 0; k < rows; k++) {
        t[k] = T * k / (rows - 1);
        q[3 * k] = sin(t[k]) + moved * pow(sin(pi * t[k] / T), 4.0);
        q[3 * k + 1] = 1.0 - cos(t[k]);
        q[3 * k + 2] = t[k];
    }
}

static void test_sleigh(void)
{
    enum { MOST = 161 };
    double t[MOST], q[3 * MOST], before = 0.0;
    for (int rows = 41; rows <= MOST; rows = 2 * rows - 1) {
        const dal_curve curve = {.rows = rows, .t = t, .q = q};
        circle(rows, 0.0, t, q);
        const dal_action still = action_of("chaplygin-sleigh", &curve, DAL_ACTION_SECOND_ORDER);
        circle(rows, 1e-2, t, q);
        const dal_action moved = action_of("chaplygin-sleigh", &curve, DAL_ACTION_SECOND_ORDER);
        CU_ASSERT(still.value > 0.0 && still.value < still.error);
        CU_ASSERT(moved.value > 100.0 * still.value && moved.value > 3.0 * moved.error);
        if (before > 0.0) {
            const double order = log2(before / still.value);
            CU_ASSERT(order > 3.9 && order < 5.1);
        }
        before = still.value;
    }
}

/* D = y1' sin(phi) - y2' cos(phi) on y1 = 2 t, phi = pi/6: 1 everywhere. */
static void test_constraint(void)
{
    double t[ROWS], q[3 * ROWS], D;
    times(t, 1.0);
    for (int k = 0; k < ROWS; k++)
        q[3 * k] = 2.0 * t[k], q[3 * k + 1] = 0.3, q[3 * k + 2] = acos(-1.0) / 6.0;
    const dal_curve curve = {.rows = ROWS, .t = t, .q = q};
    dal_evaluator *evaluator = fixture_evaluator(fixture_system("chaplygin-sleigh"));
    CU_ASSERT_EQUAL(dal_evaluator_measure_curve(evaluator, &curve, &D, NULL), DAL_STATUS_OK);
    CU_ASSERT_DOUBLE_EQUAL(D, 1.0, 1e-12);
    dal_evaluator_free(evaluator);
    evaluator = fixture_evaluator(fixture_system(free_particle));
    CU_ASSERT_EQUAL(dal_evaluator_measure_curve(evaluator, &curve, &D, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(D, 0.0);
    dal_evaluator_free(evaluator);
}

static void refused(const char *system, const dal_curve *curve, dal_status status,
                    const char *fragment)
{
    dal_evaluator *evaluator = fixture_evaluator(fixture_system(system));
    dal_action action;
    dal_error error = {0};
    CU_ASSERT_EQUAL(
        dal_evaluator_integrate_action(evaluator, curve, DAL_ACTION_SECOND_ORDER, &action, &error),
        status);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, fragment));
    if (status == DAL_STATUS_ARGUMENT) {
        double defect;
        error = (dal_error){0};
        CU_ASSERT_EQUAL(dal_evaluator_measure_curve(evaluator, curve, &defect, &error), status);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.message, fragment));
    }
    dal_evaluator_free(evaluator);
}

static void test_refused(void)
{
    double t[ROWS], x[3 * ROWS] = {0.0}, e[ROWS];
    dal_curve curve = {.rows = ROWS, .t = t, .q = x};
    times(t, 1.0);
    for (int k = 0; k < ROWS; k++) e[k] = 1.0;
    refused("chaplygin-sleigh-vakonomic", &curve, DAL_STATUS_UNSUPPORTED, "vakonomic");
    for (int k = 0; k < ROWS; k++) x[k] = 0.5 - t[k];
    refused("coordinates: [x]\naccelerations: {x: log(x)}\n", &curve, DAL_STATUS_NOT_FINITE,
            "not determined at t = 0.5");
    curve.rows = DAL_CURVE_ROWS - 1;
    refused(free_particle, &curve, DAL_STATUS_ARGUMENT, "6 rows, not 7 or more");
    curve.rows = ROWS, curve.e = e, e[4] = 0.0;
    refused(free_particle, &curve, DAL_STATUS_ARGUMENT, "row 5: a number is not finite, or e is 0");
    e[4] = 1.0, x[7] = NAN;
    refused(free_particle, &curve, DAL_STATUS_ARGUMENT, "row 8: a number is not finite");
    x[7] = 0.0, t[3] = t[2];
    refused(free_particle, &curve, DAL_STATUS_ARGUMENT, "row 4: t = ");
}

/* ---- discrete actions ---- */

static dal_status discrete(const char *system, const char *method, double h, const dal_curve *curve,
                           dal_discrete_action *out, dal_error *error)
{
    const dal_run_spec spec = fixture_spec(fixture_system(system), method, DAL_LIFTED, h);
    return dal_check_discrete_action(&spec, curve, out, error);
}

static bool is_stationary(const char *system, const char *method, double h, const dal_curve *curve)
{
    dal_discrete_action out = {.defect = NAN};
    CU_ASSERT_EQUAL(discrete(system, method, h, curve, &out, NULL), DAL_STATUS_OK);
    return out.is_stationary;
}

/* x'' = 0 with pi = c, p = 0 is v = c t, x = c t^2/2, pi_e = c^2 t/2, which these methods have
 * exactly: S_d = c^2 T/2. */
static void test_discrete_value(void)
{
    static const char *const methods[] = {"implicit-midpoint", "gauss4", "gauss6", "lobatto4",
                                          "stormer-verlet"};
    const double c = 0.8, h = 0.125;
    double t[ROWS], x[ROWS], v[ROWS], pi[ROWS], e[ROWS], pi_e[ROWS];
    for (int k = 0; k < ROWS; k++) {
        t[k] = k * h, v[k] = c * t[k], x[k] = 0.5 * c * t[k] * t[k], pi[k] = c;
        e[k] = 1.0, pi_e[k] = 0.5 * c * c * t[k];
    }
    const dal_curve curve = {ROWS, t, x, v, NULL, NULL, pi, e, pi_e};
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
        dal_discrete_action out;
        CU_ASSERT_EQUAL(discrete(free_particle, methods[k], h, &curve, &out, NULL), DAL_STATUS_OK);
        CU_ASSERT(out.is_stationary);
        CU_ASSERT(out.defect < 1e-12);
        CU_ASSERT_DOUBLE_EQUAL(out.value, pi_e[ROWS - 1], 1e-12);
        x[20] += 1e-6; /* a row that is no step */
        CU_ASSERT_EQUAL(discrete(free_particle, methods[k], h, &curve, &out, NULL), DAL_STATUS_OK);
        CU_ASSERT(!out.is_stationary);
        CU_ASSERT_DOUBLE_EQUAL(out.defect, 1e-6 / h, 1e-9);
        x[20] = 0.5 * c * t[20] * t[20];
    }
    e[ROWS - 1] = 2.0; /* e is not constant: there is no value */
    dal_discrete_action out;
    CU_ASSERT_EQUAL(discrete(free_particle, "gauss4", h, &curve, &out, NULL), DAL_STATUS_OK);
    CU_ASSERT(isnan(out.value) && !out.is_stationary);
}

/* x'' = -x: the midpoint rule turns by 2 arctan(h/2) a step; between two rows of Stormer and Verlet
 * are positions y with y_(k+1) - 2 y_k + y_(k-1) = -h^2 y_k, v_k = (y_k - y_(k-1))/h and x_k their
 * mean. */
static void test_recurrences(void)
{
    static const char oscillator[] = "coordinates: [x]\naccelerations: {x: -x}\n";
    const double h = 0.1;
    double t[ROWS], x[ROWS], v[ROWS];
    const dal_curve curve = {.rows = ROWS, .t = t, .q = x, .v = v};
    for (int k = 0; k < ROWS; k++) {
        const double angle = 2.0 * atan(0.5 * h) * k;
        t[k] = k * h, x[k] = cos(angle), v[k] = -sin(angle);
    }
    CU_ASSERT(is_stationary(oscillator, "implicit-midpoint", h, &curve));
    CU_ASSERT(!is_stationary(oscillator, "stormer-verlet", h, &curve));
    CU_ASSERT(!is_stationary(oscillator, "gauss4", h, &curve));
    double before = 1.0, y = 0.98;
    for (int k = 0; k < ROWS; k++) {
        x[k] = 0.5 * (before + y), v[k] = (y - before) / h;
        const double next = 2.0 * y - before - h * h * y;
        before = y, y = next;
    }
    CU_ASSERT(is_stationary(oscillator, "stormer-verlet", h, &curve));
    CU_ASSERT(!is_stationary(oscillator, "implicit-midpoint", h, &curve));
}

static void test_discrete_refused(void)
{
    double t[ROWS], x[3 * ROWS] = {0.0};
    dal_curve curve = {.rows = ROWS, .t = t, .q = x, .v = x};
    dal_discrete_action out;
    dal_error error = {0};
    for (int k = 0; k < ROWS; k++) t[k] = 0.1 * k;
    CU_ASSERT_EQUAL(discrete(free_particle, "rk4", 0.1, &curve, &out, &error),
                    DAL_STATUS_UNSUPPORTED);
    CU_ASSERT_STRING_EQUAL(error.message, "rk4 has no discrete action: it is not symplectic");
    CU_ASSERT_EQUAL(discrete(free_particle, "gauss4", 0.2, &curve, &out, &error),
                    DAL_STATUS_ARGUMENT);
    CU_ASSERT_STRING_EQUAL(error.message, "row 2: t = 0.1 is not 1 steps of 0.2 after 0");
    x[5] = NAN;
    CU_ASSERT_EQUAL(discrete(free_particle, "gauss4", 0.1, &curve, &out, &error),
                    DAL_STATUS_NOT_FINITE);
    CU_ASSERT_EQUAL(discrete("chaplygin-sleigh-vakonomic", "gauss4", 0.1, &curve, &out, &error),
                    DAL_STATUS_UNSUPPORTED);
    curve.v = NULL;
    CU_ASSERT_EQUAL(discrete(free_particle, "gauss4", 0.1, &curve, &out, &error),
                    DAL_STATUS_ARGUMENT);
}

/* Rows may miss their times by 1e-9 h, and no more. */
static void test_step(void)
{
    double t[5];
    const dal_curve curve = {.rows = 5, .t = t};
    for (int which = 0; which < 3; which++) {
        for (int k = 0; k < 5; k++) t[k] = -3.0 + 0.1 * k;
        t[2] += 0.1 * (which == 0 ? 0.0 : which == 1 ? 0.5e-9 : 2e-9);
        CU_ASSERT_DOUBLE_EQUAL(dal_curve_step(&curve), which < 2 ? 0.1 : 0.0, 1e-15);
    }
    for (int k = 0; k < 5; k++) t[k] = 1.0;
    CU_ASSERT_EQUAL(dal_curve_step(&curve), 0.0);
}

/* -H has the term -mu_e pi_e: with mu_e = 0.3 + 0.1 t and pi_e = f the action of a point at rest,
 * where all else vanishes, is f int e' - mu_e dt. */
static void test_gauge(void)
{
    static const char gauged[] =
        "coordinates: [x]\naccelerations: {x: 0}\ngauge: {mu_e: 0.3 + 0.1*t}\n";
    const double f = 0.6, T = 2.0;
    double t[ROWS], x[ROWS] = {0.0}, e[ROWS], pi_e[ROWS];
    times(t, T);
    for (int k = 0; k < ROWS; k++) e[k] = 1.0 + 0.5 * t[k], pi_e[k] = f;
    const dal_curve curve = {.rows = ROWS, .t = t, .q = x, .v = x, .e = e, .pi_e = pi_e};
    const dal_action got = action_of(gauged, &curve, DAL_ACTION_HAMILTONIAN);
    CU_ASSERT_DOUBLE_EQUAL(got.value, f * (0.5 * T - (0.3 * T + 0.05 * T * T)), 1e-12);
}

void suite_action(void)
{
    CU_pSuite suite = CU_add_suite("action", NULL, NULL);
    CU_ADD_TEST(suite, test_closed_forms);
    CU_ADD_TEST(suite, test_equations);
    CU_ADD_TEST(suite, test_field);
    CU_ADD_TEST(suite, test_sleigh);
    CU_ADD_TEST(suite, test_constraint);
    CU_ADD_TEST(suite, test_refused);
    CU_ADD_TEST(suite, test_discrete_value);
    CU_ADD_TEST(suite, test_recurrences);
    CU_ADD_TEST(suite, test_discrete_refused);
    CU_ADD_TEST(suite, test_step);
    CU_ADD_TEST(suite, test_gauge);
}
