/* test_start.c - the tolerances of a start: how far it may violate a constraint, how dependent two
 * constraints may be, how far from an exact solution it may begin.  Each from both sides. */
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <math.h>
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
                CU_ASSERT_EQUAL(inconsistent(scale[i], speed[j], sign * 0.9e-10), DAL_STATUS_OK);
                CU_ASSERT_EQUAL(inconsistent(scale[i], speed[j], sign * 1.1e-10),
                                DAL_STATUS_INCONSISTENT);
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
    CU_ASSERT_EQUAL(rank(2.1e-6), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(rank(1.9e-6), DAL_STATUS_RANK);
    CU_ASSERT_EQUAL(rank(-2.1e-6), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(rank(-1.9e-6), DAL_STATUS_RANK);
}

/* D restricts no velocity at the start: no name of one can help. */
static void test_no_hint(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system("coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                                    "constraints: [\"x*y' - 1\"]\n"),
                     "rk4", DAL_PHYSICAL, 0.1);
    dal_run *run = NULL;
    dal_error error;
    CU_ASSERT_EQUAL(dal_run_create(&run, &spec, &error), DAL_STATUS_INCONSISTENT);
    CU_ASSERT_STRING_EQUAL(error.message, "the start violates constraint 1: D1 = -1");
    dal_run_free(run);
}

static dal_status rest(const dal_system *system, const dal_point *at, double *out)
{
    (void)at;
    for (int i = 0; i < system->n; i++) out[i] = 0.0;
    return DAL_STATUS_OK;
}

/* The same of a parameter that changes, where F has values all the same. */
static void test_rank_of_parameters(void)
{
    dal_system system =
        *fixture_system("coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n"
                        "parameters: {s: 1}\nconstraints: [x' - y', x' - (1 + s)*y']\n");
    system.call.field = rest;
    system.diagnose = NULL;
    const dal_run_spec spec = fixture_spec(&system, "rk4", DAL_PHYSICAL, 0.1);
    dal_run *run = fixture_run(&spec);
    dal_error error;
    CU_ASSERT_EQUAL(dal_run_set_parameter(run, "s", 2.1e-6, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_run_set_parameter(run, "s", 1.9e-6, &error), DAL_STATUS_RANK);
    CU_ASSERT_PTR_NOT_NULL(
        strstr(error.message, "parameter s = 1.9e-06: constraint 2 restricts, except for"));
    CU_ASSERT_EQUAL(dal_run_parameters(run)[0], 2.1e-6);
    dal_run_free(run);
}

/* x = 2 exp(-t): the error is observed where |x - 2|, |x' + 2| <= 1e-10 2. */
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
            CU_ASSERT_EQUAL(observables(names[i], sign * 1.8e-10), 1);
            CU_ASSERT_EQUAL(observables(names[i], sign * 2.2e-10), 0);
        }
}

/* cos(t - pi/2) is 6e-17 at t = 0, and sin(t) is 0: the same, beside the 1 that both become, in all
 * units; 1e-9 is another start. */
static void test_exact_zero(void)
{
    static const double starts[] = {0.0, 1e-11, 1e-9}, units[] = {1.0, 0x1p-60, 0x1p60};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            char text[256];
            snprintf(text, sizeof text,
                     "coordinates: [x]\naccelerations: {x: -x}\n"
                     "start: {x: %.17g*%.17g, x': %.17g}\nexact: {x: %.17g*cos(t - pi/2)}\n",
                     units[k], starts[i], units[k], units[k]);
            const dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.1);
            dal_run *run = fixture_run(&spec);
            CU_ASSERT_EQUAL(dal_run_observables(run), i < 2);
            dal_run_free(run);
        }
}

/* x = 2, and 10^6 from t = 0.5 on; between 0.1 and 0.5 it has no value. */
static dal_status interrupted(const dal_system *system, const dal_point *at, double *exact)
{
    (void)system;
    if (at->t > 0.1 && at->t < 0.5) return DAL_STATUS_NOT_FINITE;
    exact[0] = at->t < 0.5 ? 2.0 : 1e6;
    exact[1] = 0.0;
    return DAL_STATUS_OK;
}

/* The size of an exact solution is its largest value as far as it has values: what comes later
 * makes no start right that is 1e-9 off. */
static void test_exact_ends(void)
{
    static const char text[] =
        "coordinates: [x]\naccelerations: {x: 0}\nstart: {x: 2}\nexact: {x: 2}\n";
    static const double off[] = {0.0, 1e-9};
    for (int i = 0; i < 2; i++) {
        dal_system system = *fixture_system(text);
        const dal_setting start = {"x", 2.0 + off[i]};
        system.exact = interrupted;
        dal_run_spec spec = fixture_spec(&system, "rk4", DAL_PHYSICAL, 0.2);
        spec.start = &start;
        spec.start_count = 1;
        dal_run *run = fixture_run(&spec);
        CU_ASSERT_EQUAL(dal_run_observables(run), i == 0);
        dal_run_free(run);
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
    fixture_refused(&spec, DAL_STATUS_NOT_FINITE, "start x is not finite: inf");
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
        {"{x': y, y: 1}", "'y' may not stand here: only parameters, t and what start gives before"},
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
        CU_ASSERT_EQUAL_FATAL(dal_model_read(&model, NULL, text, strlen(text), NULL),
                              DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal_model_system(model, &system, &error), DAL_STATUS_NAME);
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
                                      DAL_STATUS_OK, "", z);
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
                        DAL_STATUS_OK, "", z);
    CU_ASSERT_FATAL(made);
    CU_ASSERT_DOUBLE_EQUAL(z[2] * z[2] + 4.0 * z[3] * z[3], 1.0, 1e-14);
    CU_ASSERT_DOUBLE_EQUAL((z[2] - 0.7) * 4.0 * z[3] - (z[3] - 0.5) * z[2], 0.0, 1e-14);
}

/* The metric is taken at the velocities given.  W = diag(1 + x'^2, 1), diag(5, 1) at (2, 1/2), and
 * A = (1, 1): v - v0 = -(1/5, 1) (x' + y' - 1)/(6/5). */
static void test_metric(void)
{
    double z[4];
    const bool made = make_consistent("coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + x'^4/12\n"
                                      "constraints: [x' + y' - 1]\nstart: {x': 2, y': 0.5}\n",
                                      DAL_STATUS_OK, "", z);
    CU_ASSERT_FATAL(made);
    CU_ASSERT_DOUBLE_EQUAL(z[2], 1.75, 1e-15);
    CU_ASSERT_DOUBLE_EQUAL(z[3], -0.75, 1e-15);
}

/* d/ds of d.W d/2 with v = (cos s, sin s/2) on the ellipse, d = v - v0, and the W at v0 of
 * L = (x'^2 + y'^2)/2 + x'^2 y'^2/2, which is (1 + y'^2, 2 x' y'; 2 x' y', 1 + x'^2). */
static double slope(double s, double vx, double vy)
{
    const double dx = cos(s) - vx, dy = 0.5 * sin(s) - vy;
    const double px = (1.0 + vy * vy) * dx + 2.0 * vx * vy * dy;
    const double py = 2.0 * vx * vy * dx + (1.0 + vx * vx) * dy;
    return -px * sin(s) + 0.5 * py * cos(s);
}

/* The nearest point of the ellipse x'^2 + 4 y'^2 = 1 in that metric, by bisection; also from far
 * outside, where steps that are not damped alternate between both sides of it. */
static void test_curved(void)
{
    static const double start[][2] = {{0.4, 0.3}, {-0.3, 0.5}, {2.0, 0.4}, {0.5, 1.5}};
    char text[256];
    double z[4];
    for (size_t k = 0; k < sizeof start / sizeof *start; k++) {
        const double vx = start[k][0], vy = start[k][1], middle = atan2(2.0 * vy, vx);
        double low = middle - 1.0, high = middle + 1.0;
        CU_ASSERT_FATAL(slope(low, vx, vy) < 0.0 && slope(high, vx, vy) > 0.0);
        for (int i = 0; i < 60; i++) {
            const double half = 0.5 * (low + high);
            *(slope(half, vx, vy) < 0.0 ? &low : &high) = half;
        }
        snprintf(text, sizeof text,
                 "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + x'^2*y'^2/2\n"
                 "constraints: [(x'^2 + 4*y'^2 - 1)/2]\nstart: {x': %g, y': %g}\n",
                 vx, vy);
        const bool made = make_consistent(text, DAL_STATUS_OK, "", z);
        CU_ASSERT_FATAL(made);
        CU_ASSERT_DOUBLE_EQUAL(z[2], cos(low), 1e-13);
        CU_ASSERT_DOUBLE_EQUAL(z[3], 0.5 * sin(low), 1e-13);
    }
}

/* ---- velocities that are solved ---- */

#define PLANE "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
#define SPACE "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n"
static const char circle[] = PLANE "constraints: [(x'^2 + y'^2 - 25)/2]\n"
                                   "start: {x': 3, y': -1, solve: [y']}\n";

/* x' + 2 y' - z' = 1 and y' - z' = x at x = 3, x' = 2: y' = -4, z' = -7, of the run and of the
 * evaluator; the name in D1 alone may be solved alone where D2 = 0. */
static void test_solved_linear(void)
{
    static const char text[] = SPACE "constraints: [x' + 2*y' - z' - 1, 1e-6*(y' - z' - x)]\n"
                                     "start: {x: 3, x': 2, y': 11, solve: [z', y']}\n";
    static const char alone[] = SPACE "constraints: [x' + y' - 1, z' - 2]\n"
                                      "start: {x': 3, z': 2, solve: [y']}\n";
    static const double expected[] = {2.0, -4.0, -7.0};
    dal_run_spec spec = fixture_spec(fixture_system(text), "rk4", DAL_PHYSICAL, 0.1);
    dal_run *run = fixture_run(&spec);
    dal_evaluator *evaluator = fixture_evaluator(fixture_system(text));
    double start[7];
    CU_ASSERT_EQUAL(dal_evaluator_start(evaluator, NULL, 0, start, NULL), DAL_STATUS_OK);
    for (int i = 0; i < 3; i++) {
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[3 + i], expected[i], 1e-14);
        CU_ASSERT_EQUAL(dal_run_state(run)[3 + i], start[3 + i]);
    }
    dal_evaluator_free(evaluator);
    dal_run_free(run);
    spec = fixture_spec(fixture_system(alone), "rk4", DAL_PHYSICAL, 0.1);
    run = fixture_run(&spec);
    CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[4], -2.0, 1e-15);
    const dal_setting off = {"z'", 2.5};
    spec.start = &off;
    spec.start_count = 1;
    fixture_refused(&spec, DAL_STATUS_INCONSISTENT,
                    "violates constraint 2: D2 = 0.5; solve under start can name one more "
                    "velocity, as z'");
    dal_run_free(run);
}

/* The first guess chooses the root of x'^2 + y'^2 = 25; a lane has the start of the run. */
static void test_solved_roots(void)
{
    dal_run_spec spec = fixture_spec(fixture_system(circle), "rk4", DAL_PHYSICAL, 0.1);
    fixture_lanes(spec, 2, 0, "y'", -0.5, 1.0);
    for (int sign = -1; sign <= 1; sign += 2) {
        const dal_setting guess = {"y'", 0.5 * sign};
        spec.start = &guess;
        spec.start_count = 1;
        dal_run *run = fixture_run(&spec);
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[3], 4.0 * sign, 1e-14);
        dal_run_free(run);
    }
}

/* Both options, the second of which moves the rest. */
static void test_solved_and_moved(void)
{
    double z[6];
    const bool made = make_consistent(SPACE "constraints: [x' + y' - 1, z' - 2]\n"
                                            "start: {x': 3, z': 2.5, solve: [y']}\n",
                                      DAL_STATUS_OK, "", z);
    CU_ASSERT_FATAL(made);
    CU_ASSERT_DOUBLE_EQUAL(z[3], 3.0, 1e-15);
    CU_ASSERT_DOUBLE_EQUAL(z[4], -2.0, 1e-15);
    CU_ASSERT_DOUBLE_EQUAL(z[5], 2.0, 1e-15);
}

static void test_not_solved(void)
{
    static const struct {
        const char *text, *message;
        dal_status status;
        int column;
    } cases[] = {
        {PLANE "constraints: [(x'^2 + y'^2 - 25)/2]\nstart: {x': 6, y': 1, solve: [y']}\n",
         "cannot be solved for y': no root of constraint 1 was found", DAL_STATUS_INCONSISTENT, 31},
        {PLANE "constraints: [(x'^2 + y'^2 - 25)/2]\nstart: {x': 3, solve: [y']}\n",
         "for y': no constraint restricts it at the first guess 0; give another one",
         DAL_STATUS_RANK, 24},
        {PLANE "constraints: [log(x' + y')]\nstart: {x': -3, solve: [y']}\n",
         "no root of constraint 1 was found from these first guesses, D1 = ", DAL_STATUS_NOT_FINITE,
         25},
        {SPACE "constraints: [x' + y' - 1, z' - 2]\nstart: {z': 2, solve: [x', y']}\n",
         "for both x' and y', which constraint 1 restricts", DAL_STATUS_RANK, 28},
        {SPACE "constraints: [z' - 2, x' + y' - 1]\nstart: {solve: [y', z']}\n", "", DAL_STATUS_OK,
         0},
        {PLANE "holonomic: [x^2 + y^2 - y + 1]\nstart: {solve: [y]}\n",
         "cannot be solved for y: no root of", DAL_STATUS_INCONSISTENT, 17},
        {SPACE "constraints: [x' - 2]\nstart: {x': 2, solve: [y']}\n",
         "for y': no constraint restricts it", DAL_STATUS_RANK, 24},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const dal_run_spec spec =
            fixture_spec(fixture_system(cases[k].text), "rk4", DAL_PHYSICAL, 0.1);
        dal_evaluator *evaluator = fixture_evaluator(spec.system);
        for (int by_evaluator = 0; by_evaluator <= 1; by_evaluator++) {
            double start[7];
            dal_error error = {0};
            dal_run *run = NULL;
            CU_ASSERT_EQUAL(by_evaluator ? dal_evaluator_start(evaluator, NULL, 0, start, &error)
                                         : dal_run_create(&run, &spec, &error),
                            cases[k].status);
            CU_ASSERT_PTR_NOT_NULL(strstr(error.message, cases[k].message));
            if (!strstr(error.message, cases[k].message)) printf("\n  '%s'\n", error.message);
            CU_ASSERT_EQUAL(error.line, cases[k].column ? 4 : 0);
            CU_ASSERT_EQUAL(error.column, cases[k].column);
            dal_run_free(run);
        }
        dal_evaluator_free(evaluator);
    }
}

/* What is wrong in the file itself. */
static void test_solve_misspelt(void)
{
    static const struct {
        const char *start, *message;
        int column;
    } cases[] = {
        {"{solve: y'}", "solve must be a list of velocities, as [x', y']", 16},
        {"{solve: {y': 1}}", "solve must be a list of velocities, as [x', y']", 16},
        {"{solve: [y]}", "unknown velocity in solve 'y'; did you mean 'y''?", 17},
        {"{solve: [y', y']}", "duplicate 'y'' in solve", 21},
        {"{solve: [y', x']}", "for x': there is 1 constraint, and as many velocities before it",
         21},
        {"{y': 1, x: y', solve: [y']}", "the velocity of 'y' may not stand here", 19},
        {"{solve: ['x y']}", "'x y' in start is not a name", 17},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char text[256];
        dal_model *model = NULL;
        const dal_system *system;
        dal_error error = {0};
        snprintf(text, sizeof text, PLANE "constraints: [x' + y']\nstart: %s\n", cases[k].start);
        if (dal_model_read(&model, NULL, text, strlen(text), &error) == DAL_STATUS_OK)
            dal_model_system(model, &system, &error);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.message, cases[k].message));
        if (!strstr(error.message, cases[k].message)) printf("\n  '%s'\n", error.message);
        CU_ASSERT_EQUAL(error.line, 4);
        CU_ASSERT_EQUAL(error.column, cases[k].column);
        dal_model_free(model);
    }
}

/* Without a file: the names are added to a model, or the system is filled by hand. */
static void test_solved_by_hand(void)
{
    static const dal_solved y = {.number = 1};
    dal_model *model = NULL;
    const dal_system *system = NULL;
    const char text[] = PLANE "constraints: [x' + 2*y' - 4]\nstart: {x': 2}\n";
    CU_ASSERT_EQUAL_FATAL(dal_model_read(&model, NULL, text, strlen(text), NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_model_add(model, DAL_SECTION_START, "solve.y'", "", 0, 0, NULL),
                    DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_model_system(model, &system, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(system->solved_velocities, 1);
    CU_ASSERT_EQUAL(system->solved[0].number, 1);
    dal_system by_hand = *fixture_system(text);
    by_hand.solved_velocities = 1;
    by_hand.solved = &y;
    for (int k = 0; k < 2; k++) {
        const dal_run_spec spec = fixture_spec(k ? &by_hand : system, "rk4", DAL_PHYSICAL, 0.1);
        dal_run *run = fixture_run(&spec);
        CU_ASSERT_DOUBLE_EQUAL(dal_run_state(run)[3], 1.0, 1e-15);
        dal_run_free(run);
    }
    const dal_solved none = {.number = 2}, both[] = {{.number = 0}, {.number = 1}};
    const dal_run_spec spec = fixture_spec(&by_hand, "rk4", DAL_PHYSICAL, 0.1);
    by_hand.solved = &none;
    fixture_refused(&spec, DAL_STATUS_ARGUMENT,
                    "1 velocities to be solved from 1 constraints, of 2 velocities");
    by_hand.solved = both;
    by_hand.solved_velocities = 2;
    fixture_refused(&spec, DAL_STATUS_ARGUMENT, "2 velocities to be solved from 1 constraints");
    dal_model_free(model);
}

/* A lane has the start of the run; without the option the message names it. */
static void test_lanes(void)
{
    static const char text[] = "coordinates: [x, y]\nlagrangian: x'^2 + y'^2/2\n"
                               "constraints: [x' + x*y' - 1]\nstart: {x: 5, x': 2, y': 0.5}\n";
    dal_run_spec spec = fixture_spec(fixture_system(text), "gauss4", DAL_LIFTED, 0.1);
    fixture_refused(&spec, DAL_STATUS_INCONSISTENT,
                    "the option consistent moves its velocities to D = 0");
    spec.options.consistent = 1;
    fixture_lanes(spec, 5, 10, "x", -0.5, 0.25);
}

static void test_unsolvable(void)
{
    double z[4];
    make_consistent("coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                    "constraints: [x'^2 + y'^2 + 1]\nstart: {x': 1, y': 0.3}\n",
                    DAL_STATUS_INCONSISTENT, "satisfy constraint 1: D1 = ", z);
    make_consistent("coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n"
                    "constraints: [x' - y', (z'^2 - 1)/2]\nstart: {x': 1}\n",
                    DAL_STATUS_RANK, "constraint 2 restricts no velocity at the start", z);
    dal_run_spec spec =
        fixture_spec(fixture_system("coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                                    "constraints: [y' - sqrt(x')]\nstart: {x': 0}\n"),
                     "rk4", DAL_PHYSICAL, 0.1);
    for (int consistent = 0; consistent <= 1; consistent++) {
        spec.options.consistent = consistent;
        fixture_refused(&spec, DAL_STATUS_RANK, "constraint 1 has infinite derivatives");
    }
    make_consistent("coordinates: [x, y]\nlagrangian: (x'^2 - y'^2)/2\nstart: {x': 1}\n"
                    "constraints: [x' - (1 + x)*y']\n",
                    DAL_STATUS_RANK, "constraint 1 has 0 on the diagonal of G", z);
}

/* The pivots of G = A A^T are 1 + k^2 and s^2 (k - l)^2/(1 + k^2). */
static void test_dependent(void)
{
    static const char text[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                               "parameters: {k: 1, l: 2, s: 1}\n"
                               "constraints: [x' + k*y', s*(x' + l*y')]\n";
    static const char few[] = "constraint 2 restricts, except for rounding, only velocities that "
                              "constraint 1 restricts at the start";
    static const char scaled[] = "constraint 2 is badly scaled: its derivatives by the velocities "
                                 "reach ";
    const struct {
        double k, l, s;
        const char *message;
    } cases[] = {{1.0, 1.0, 1.0, few},
                 {1e-9, 2e-9, 1.0, few},
                 {0.5, 0.5, 1e6, few},
                 {0.0, 2.0, 1e-200, scaled},
                 {0.0, 2.0, 1e200, scaled},
                 {0.0, 0.0, -1e-170, scaled},
                 {0.0, 2.0, 0.0, "constraint 2 restricts no velocity at the start"}};
    const dal_system *system = fixture_system(text);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const dal_setting set[] = {{"k", cases[i].k}, {"l", cases[i].l}, {"s", cases[i].s}};
        dal_run_spec spec = fixture_spec(system, "rk4", DAL_PHYSICAL, 0.1);
        spec.parameters = set;
        spec.parameter_count = 3;
        fixture_refused(&spec, DAL_STATUS_RANK, cases[i].message);
        spec.options.consistent = 1;
        fixture_refused(&spec, DAL_STATUS_RANK, cases[i].message);
    }
}

void suite_start(void)
{
    CU_pSuite suite = CU_add_suite("start", NULL, NULL);
    CU_add_test(suite, "constraints that depend on others", test_dependent);
    CU_add_test(suite, "constraints are violated by 1e-10 at most", test_consistent);
    CU_add_test(suite, "an infinite start", test_not_finite);
    CU_add_test(suite, "formulas in what is given before", test_formulas);
    CU_add_test(suite, "made consistent, linear D", test_linear);
    CU_add_test(suite, "made consistent, nonlinear D", test_nonlinear);
    CU_add_test(suite, "made consistent, metric of the velocities given", test_metric);
    CU_add_test(suite, "made consistent, nearest point of an ellipse", test_curved);
    CU_add_test(suite, "made consistent, lanes", test_lanes);
    CU_add_test(suite, "solved, linear D", test_solved_linear);
    CU_add_test(suite, "solved, two roots", test_solved_roots);
    CU_add_test(suite, "solved, then made consistent", test_solved_and_moved);
    CU_add_test(suite, "solved, none or many solutions", test_not_solved);
    CU_add_test(suite, "solved, by hand", test_solved_by_hand);
    CU_add_test(suite, "what is no list of velocities", test_solve_misspelt);
    CU_add_test(suite, "what cannot be made consistent", test_unsolvable);
    CU_add_test(suite, "pivots are 1e-12 at least", test_rank);
    CU_add_test(suite, "pivots of a parameter that changes", test_rank_of_parameters);
    CU_add_test(suite, "a constraint without velocities", test_no_hint);
    CU_add_test(suite, "an exact solution begins there within 1e-10", test_exact);
    CU_add_test(suite, "an exact solution that begins at 0, in all units", test_exact_zero);
    CU_add_test(suite, "an exact solution that ends", test_exact_ends);
}
