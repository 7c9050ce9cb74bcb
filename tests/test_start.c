/* test_start.c - the tolerances of a start: how far it may violate a constraint, how dependent two
 * constraints may be, how far from an exact solution it may begin.  Each from both sides. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* The status of a run of a text with its start overridden. */
static dal_status status_of(const char *text, const dal_setting *start, int count)
{
    dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.1);
    dal_run *run = NULL;
    spec.start = start;
    spec.start_count = count;
    const dal_status status = dal_run_create(&run, &spec, NULL);
    dal_run_free(run);
    return status;
}

/* |D| <= 1e-10 |A|_1 |v|_max: D = s (3 x' + y') at x' = w, y' = -3 w + d. */
static dal_status inconsistent(double s, double w, double relative)
{
    char text[256];
    snprintf(text, sizeof text,
             "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\nconstraints: [%g*(3*x' + y')]\n",
             s);
    const dal_setting start[] = {{"x'", w}, {"y'", -3.0 * w + relative * 4.0 * 3.0 * w}};
    return status_of(text, start, 2);
}

static void test_consistent(void)
{
    static const double scale[] = {1.0, 1e6, 1e-6}, speed[] = {1.0, 1e5, 1e-5};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int sign = -1; sign <= 1; sign += 2) {
                CU_ASSERT_EQUAL(inconsistent(scale[i], speed[j], sign * 0.9e-10), DAL_OK);
                CU_ASSERT_EQUAL(inconsistent(scale[i], speed[j], sign * 1.1e-10), DAL_INCONSISTENT);
            }
}

/* D1 = x' - y', D2 = x' - (1 + s) y' with unit masses: the second pivot of G is s^2/2 and its
 * diagonal entry 2 + 2 s + s^2, so that the pivot is s^2/4 (1 - s ...) of it; 1e-12 at s = 2e-6. */
static dal_status rank(double s)
{
    char text[256];
    snprintf(text, sizeof text,
             "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n"
             "parameters: {s: %.17g}\nconstraints: [x' - y', x' - (1 + s)*y']\n",
             s);
    const dal_setting start = {"z'", 1.0};
    return status_of(text, &start, 1);
}

static void test_rank(void)
{
    CU_ASSERT_EQUAL(rank(2.1e-6), DAL_OK);
    CU_ASSERT_EQUAL(rank(1.9e-6), DAL_RANK);
    CU_ASSERT_EQUAL(rank(-2.1e-6), DAL_OK);
    CU_ASSERT_EQUAL(rank(-1.9e-6), DAL_RANK);
}

/* x = 2 exp(-t): the error is observed where |x - 2|, |x' + 2| <= 1e-10 (1 + 2). */
static int observables(const char *name, double off)
{
    dal_run_spec spec =
        fixture_spec(fixture_system("coordinates: [x]\naccelerations: {x: x}\n"
                                    "start: {x: 2, x': -2}\nexact: {x: 2*exp(-t)}\n"),
                     "rk4", DAL_PHYSICAL, 0.1);
    const dal_setting start = {name, (name[1] ? -2.0 : 2.0) + off};
    spec.start = &start;
    spec.start_count = 1;
    dal_run *run = fixture_run(&spec);
    const int count = dal_run_observables(run);
    dal_run_free(run);
    return count;
}

static void test_exact(void)
{
    static const char *const names[] = {"x", "x'"};
    for (int i = 0; i < 2; i++)
        for (int sign = -1; sign <= 1; sign += 2) {
            CU_ASSERT_EQUAL(observables(names[i], sign * 2.8e-10), 1);
            CU_ASSERT_EQUAL(observables(names[i], sign * 3.2e-10), 0);
        }
}

/* A start that the parameters make infinite is named, with its value. */
static void test_not_finite(void)
{
    dal_run_spec spec =
        fixture_spec(fixture_system("coordinates: [x]\nlagrangian: x'^2/2\nparameters: {k: 0}\n"
                                    "start: {x: 1e200*exp(k), x': 1}\n"),
                     "rk4", DAL_PHYSICAL, 0.1);
    const dal_setting k = {"k", 500.0};
    spec.parameters = &k;
    spec.parameter_count = 1;
    fixture_refused(&spec, DAL_NOT_FINITE, "start x is not finite: inf");
}

/* Formulas of a start know what it has given before, through let, too. */
static void test_formulas(void)
{
    static const char begin[] = "coordinates: [x, y]\nparameters: {k: 2}\n"
                                "let: {r: \"sqrt(x^2 + y^2)\", turn: x*y' - y*x'}\n"
                                "lagrangian: (x'^2 + y'^2)/2\nstart: ";
    static const struct {
        const char *start, *message;
    } bad[] = {
        {"{x': y, y: 1}", "'y' may not stand here: only parameters and what start gives before"},
        {"{x: 1, y: r}", "let 'r' may not stand here"},
        {"{x: 1, y: 1, x': 2, y': turn}", "let 'turn' may not stand here"},
        {"{x: x}", "coordinate 'x' may not stand here"},
    };
    char text[512];
    dal_model *model = NULL;
    const dal_system *system;
    snprintf(text, sizeof text, "%s{x: 3*k, y: 4*k, x': r/5, y': x' - y}\n", begin);
    const dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.1);
    dal_run *run = fixture_run(&spec);
    static const double expected[4] = {6.0, 8.0, 2.0, -6.0};
    for (int i = 0; i < 4; i++) CU_ASSERT_EQUAL(dal_run_state(run)[i], expected[i]);
    dal_run_free(run);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        dal_error error = {0};
        snprintf(text, sizeof text, "%s%s\n", begin, bad[i].start);
        CU_ASSERT_EQUAL_FATAL(dal_model_read(&model, NULL, text, strlen(text), NULL), DAL_OK);
        CU_ASSERT_EQUAL(dal_model_system(model, &system, &error), DAL_NAME);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.message, bad[i].message));
        if (!strstr(error.message, bad[i].message)) printf("\n  '%s'\n", error.message);
        CU_ASSERT_EQUAL(error.line, 5);
        dal_model_free(model);
    }
}

/* ---- consistent starts ---- */

/* q and v of a run of the text whose start was made consistent; false: it was refused so. */
static bool make_consistent(const char *text, dal_status status, const char *fragment,
                            double *state)
{
    dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.1);
    dal_run *run = NULL;
    dal_error error = {0};
    spec.options.consistent = 1;
    CU_ASSERT_EQUAL(dal_run_create(&run, &spec, &error), status);
    if (!strstr(error.message, fragment)) printf("\n  '%s'\n", error.message);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, fragment));
    if (run) memcpy(state, dal_run_state(run), 2 * (size_t)spec.system->n * sizeof *state);
    dal_run_free(run);
    return run != NULL;
}

/* W = diag(2, 1), A = (1, 1): v - v0 = -(1/2, 1) (x' + y' - 1)/(3/2). */
static void test_linear(void)
{
    double z[4];
    const bool made = make_consistent("coordinates: [x, y]\nlagrangian: x'^2 + y'^2/2\n"
                                      "constraints: [x' + y' - 1]\nstart: {x: 5, x': 2, y': 0.5}\n",
                                      DAL_OK, "", z);
    CU_ASSERT_FATAL(made);
    CU_ASSERT_EQUAL(z[0], 5.0);
    CU_ASSERT_DOUBLE_EQUAL(z[2], 1.5, 1e-15);
    CU_ASSERT_DOUBLE_EQUAL(z[3], -0.5, 1e-15);
}

/* The nearest point of an ellipse: v - v0 is along its normal at v, which one Newton projection
 * along the normal at v0 would not reach. */
static void test_nonlinear(void)
{
    double z[4];
    const bool made =
        make_consistent("coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                        "constraints: [(x'^2 + 4*y'^2 - 1)/2]\nstart: {x': 0.7, y': 0.5}\n",
                        DAL_OK, "", z);
    CU_ASSERT_FATAL(made);
    CU_ASSERT_DOUBLE_EQUAL(z[2] * z[2] + 4.0 * z[3] * z[3], 1.0, 1e-14);
    CU_ASSERT_DOUBLE_EQUAL((z[2] - 0.7) * 4.0 * z[3] - (z[3] - 0.5) * z[2], 0.0, 1e-14);
}

/* A lane has the start of the run; without the option the message names it. */
static void test_lanes(void)
{
    static const char text[] = "coordinates: [x, y]\nlagrangian: x'^2 + y'^2/2\n"
                               "constraints: [x' + x*y' - 1]\nstart: {x: 5, x': 2, y': 0.5}\n";
    const dal_setting place = {"x", -0.5};
    dal_run_spec spec = fixture_spec(fixture_system(text), "gauss4", DAL_LIFTED, 0.1);
    fixture_refused(&spec, DAL_INCONSISTENT, "the option consistent moves its velocities to D = 0");
    spec.options.consistent = 1;
    dal_batch *batch = NULL;
    double state[10];
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, 5, 0, NULL), DAL_OK);
    CU_ASSERT_EQUAL(dal_batch_start(batch, 4, NULL, 0, &place, 1, NULL), DAL_OK);
    CU_ASSERT_EQUAL(dal_batch_advance(batch, 10), DAL_OK);
    spec.start = &place;
    spec.start_count = 1;
    dal_run *run = fixture_run(&spec);
    CU_ASSERT_EQUAL(dal_run_advance(run, 10, NULL), DAL_OK);
    dal_batch_state(batch, 4, state);
    CU_ASSERT_EQUAL(memcmp(state, dal_run_state(run), sizeof state), 0);
    dal_run_free(run);
    dal_batch_free(batch);
}

static void test_unsolvable(void)
{
    double z[4];
    make_consistent("coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                    "constraints: [x'^2 + y'^2 + 1]\nstart: {x': 1, y': 0.3}\n",
                    DAL_INCONSISTENT, "satisfy constraint 1: D1 = ", z);
    make_consistent("coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n"
                    "constraints: [x' - y', (z'^2 - 1)/2]\nstart: {x': 1}\n",
                    DAL_RANK, "constraint 2 restricts no velocity", z);
}

void suite_start(void)
{
    CU_pSuite suite = CU_add_suite("start", NULL, NULL);
    CU_add_test(suite, "constraints are violated by 1e-10 at most", test_consistent);
    CU_add_test(suite, "an infinite start", test_not_finite);
    CU_add_test(suite, "formulas in what is given before", test_formulas);
    CU_add_test(suite, "made consistent, linear D", test_linear);
    CU_add_test(suite, "made consistent, nonlinear D", test_nonlinear);
    CU_add_test(suite, "made consistent, lanes", test_lanes);
    CU_add_test(suite, "what cannot be made consistent", test_unsolvable);
    CU_add_test(suite, "pivots are 1e-12 at least", test_rank);
    CU_add_test(suite, "an exact solution begins there within 1e-10", test_exact);
}
