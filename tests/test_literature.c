/* test_literature.c - closed forms of the paper and of the field, by gauss8 with h = 0.01. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* The observable of a run by name; NAN when it has none of it. */
static double observable(dal_run *run, const char *name)
{
    double values[64];
    char label[64];
    CU_ASSERT_EQUAL(dal_run_observe(run, values), DAL_STATUS_OK);
    for (int i = 0; dal_run_observable_name(run, i, label, sizeof label); i++)
        if (strcmp(label, name) == 0) return values[i];
    return NAN;
}

/* The largest error on the way, relative to the size of the solution. */
static double closed_form_error(dal_run *run, long long steps)
{
    const int n = dal_run_system(run)->n;
    double error = 0.0, scale = 1.0;
    for (long long i = 0; i < steps; i++) {
        CU_ASSERT_EQUAL_FATAL(dal_run_step(run, NULL), DAL_STATUS_OK);
        for (int j = 0; j < n; j++) scale = fmax(scale, fabs(dal_run_state(run)[j]));
        error = fmax(error, observable(run, "error"));
    }
    return error / scale;
}

static void test_closed_forms(void)
{
    static const char *const names[] = {"chaplygin-sleigh",
                                        "chaplygin-sleigh-nonlinear",
                                        "chaplygin-sleigh-friction",
                                        "damped-oscillator",
                                        "knife-edge",
                                        "vertical-disk",
                                        "appell-hamel",
                                        "isokinetic"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        for (int space = 0; space < 2; space++) {
            const dal_run_spec spec =
                fixture_spec(fixture_system(names[i]), "gauss8", (dal_space)space, 0.01);
            dal_run *run = fixture_run(&spec);
            const double error = closed_form_error(run, 100);
            if (!(error <= 1e-13)) printf("\n  %s: error %.2e\n", names[i], error);
            CU_ASSERT(error <= 1e-13);
            dal_run_free(run);
        }
    }
}

/* Parameters other than the shipped ones: the closed forms are formulas, not numbers. */
static void test_other_parameters(void)
{
    static const struct {
        const char *name;
        dal_setting set[3];
    } cases[] = {
        {"chaplygin-sleigh", {{"v0", 1.7}, {"omega", -2.3}, {"m", 0.4}}},
        {"chaplygin-sleigh-friction", {{"k", 9.0}, {"m", 1.3}, {"omega", 1.7}}},
        {"damped-oscillator", {{"omega", 0.7}, {"k", 1.9}, {"k", 1.9}}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        dal_run_spec spec =
            fixture_spec(fixture_system(cases[i].name), "gauss8", DAL_PHYSICAL, 0.01);
        spec.parameters = cases[i].set;
        spec.parameter_count = 3;
        dal_run *run = fixture_run(&spec);
        const double error = closed_form_error(run, 100);
        if (!(error <= 1e-13)) printf("\n  %s: error %.2e\n", cases[i].name, error);
        CU_ASSERT(error <= 1e-13);
        dal_run_free(run);
    }
}

/* (nh29): the sleigh with friction ends at y1 = 2 v0 m/k; DOP853 gave 0.31777778 for m = 1.3,
 * k = 9, v0 = 1.1, omega = 1.7, where the printed formula gives 0.1869. */
static void test_friction_end(void)
{
    const dal_setting set[] = {{"m", 1.3}, {"k", 9.0}, {"v0", 1.1}, {"omega", 1.7}};
    dal_run_spec spec =
        fixture_spec(fixture_system("chaplygin-sleigh-friction"), "gauss6", DAL_PHYSICAL, 0.02);
    spec.parameters = set;
    spec.parameter_count = 4;
    dal_run *run = fixture_stepped(&spec, 3000);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[0], 0.31777778, 5e-9);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[0], 2.0 * 1.1 * 1.3 / 9.0, 1e-12);
    dal_run_free(run);
}

/* Largest distance from the circle (nh30) up to T = 2 with friction k. */
static double distance_to_circle(const dal_system *system, double k)
{
    const dal_setting set[] = {{"k", k}, {"v0", 1.0}, {"omega", 1.0}, {"m", 1.0}};
    dal_run_spec spec = fixture_spec(system, "gauss8", DAL_PHYSICAL, 0.01);
    double distance = 0.0;
    spec.parameters = set;
    spec.parameter_count = 4;
    dal_run *run = fixture_run(&spec);
    for (int i = 0; i < 200; i++) {
        CU_ASSERT_EQUAL_FATAL(dal_run_step(run, NULL), DAL_STATUS_OK);
        const double *q = dal_run_state(run), t = dal_run_time(run);
        distance = fmax(distance, hypot(q[0] - sin(t), q[1] - (1.0 - cos(t))));
    }
    dal_run_free(run);
    return distance;
}

static void test_friction_limit(void)
{
    const dal_system *system = fixture_system("chaplygin-sleigh-friction");
    double last = distance_to_circle(system, 1e1);
    for (double k = 1e2; k < 2e4; k *= 10.0) {
        const double now = distance_to_circle(system, k);
        const double slope = log10(last / now);
        /* d = C/k (1 + O(1/k)): the first decade still shows the second order. */
        CU_ASSERT_DOUBLE_EQUAL(slope, 1.0, k < 5e2 ? 0.15 : 0.02);
        last = now;
    }
}

/* Reference end states R1 and R3 of two independent high-order integrations. */
static void reference_state(const char *text, double T, const double *state)
{
    const dal_run_spec spec = fixture_spec(fixture_system(text), "gauss10", DAL_PHYSICAL, 0.02);
    dal_run *run = fixture_stepped(&spec, llround(T / 0.02));
    for (int i = 0; i < 6; i++) CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[i], state[i], 2e-13);
    dal_run_free(run);
}

static void test_references(void)
{
    const char *contact = "coordinates: [x, y, z]\n"
                          "parameters: {eps: 0.3}\n"
                          "lagrangian: (x'^2+y'^2+z'^2)/2 - (x^2+y^2+z^2+eps*x^2*z^2)/2\n"
                          "constraints: [x' + y*z']\n"
                          "start: {x: 0.8, y: 0.6, z: -0.5, x': -0.24, y': 0.7, z': 0.4}\n";
    const double r1[] = {0.2697845407561,  0.9132110728864,  0.1292207494387,
                         -0.6961539931339, -0.1266709767770, 0.7623144460279};
    const double r1_10[] = {0.0023416305916, -0.8842576950684, -0.1547264214258,
                            0.7046811164488, -0.2609374038199, 0.7969182743660};
    reference_state(contact, 1.0, r1);
    reference_state(contact, 10.0, r1_10);
    /* The speed s of the horizontal motion is sqrt(.8)*1.2, at the angle .6. */
    const char *appell =
        "coordinates: [x, y, z]\n"
        "parameters: {nu2: 0.8}\n"
        "lagrangian: (x'^2+y'^2+z'^2)/2 - (x^2+1.7*y^2+0.6*z^2)/2\n"
        "constraints: [(x'^2 + y'^2 - nu2*z'^2)/2]\n"
        "start: {x: 0.4, y: -0.3, z: 0.5, x': sqrt(nu2)*1.2*cos(0.6), y': sqrt(nu2)*1.2*sin(0.6), "
        "z': 1.2}\n";
    const double r3[] = {0.9408992146138, 0.3536347529745, 1.4660252969470,
                         0.1246609633716, 0.5302439477038, 0.6089940474516};
    reference_state(appell, 1.0, r3);
}

static void test_sleigh_reference(void)
{
    /* R2: centre-of-mass coordinates, m = I = a = 1, force -0.5 in y, contact point at 0. */
    const char *sleigh =
        "coordinates: [x, y, th]\n"
        "lagrangian: (x'^2 + y'^2 + th'^2)/2 - 0.5*y\n"
        "constraints: [\"-sin(th)*x' + cos(th)*y' - th'\"]\n"
        "start: {x: cos(0.3), y: sin(0.3), th: 0.3, x': 0.7*cos(0.3) - 0.9*sin(0.3), "
        "y': 0.7*sin(0.3) + 0.9*cos(0.3), th': 0.9}\n";
    const double r2[] = {1.2303173219572, 1.3259998066095, 0.9477957970084,
                         0.1327768526135, 0.9333477376258, 0.4367524563532};
    const double r2_5[] = {0.8966762690773,  1.4683575456213,  1.7336135677658,
                           -0.0628236813976, -0.9418771886772, 0.2146699968446};
    reference_state(sleigh, 1.0, r2);
    reference_state(sleigh, 5.0, r2_5);
}

void suite_literature(void)
{
    CU_pSuite suite = CU_add_suite("closed forms of the literature", NULL, NULL);
    CU_add_test(suite, "closed forms to rounding", test_closed_forms);
    CU_add_test(suite, "closed forms, other parameters", test_other_parameters);
    CU_add_test(suite, "friction: where the sleigh ends", test_friction_end);
    CU_add_test(suite, "friction: 1/k to the circle", test_friction_limit);
    CU_add_test(suite, "reference states R1 and R3", test_references);
    CU_add_test(suite, "reference state R2", test_sleigh_reference);
}
