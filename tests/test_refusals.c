/* test_refusals.c - what functions refuse, and the message that says why. */
#include "dynamics/local_change.h"
#include "failing.h"
#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <dalembert_codegen.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static void refused(dal_status got, dal_status expected, const dal_error *error,
                    const char *message)
{
    CU_ASSERT_EQUAL(got, expected);
    CU_ASSERT_EQUAL(error->status, expected);
    CU_ASSERT_STRING_EQUAL(error->message, message);
}

/* D(q,v) -> -D in each step of discrete-gradient, which only preserves D between its ends; dla
 * preserves D itself, too. */
static void test_modifiers(void)
{
    const dal_system *system = fixture_system(fixture_constant);
    dal_run_spec spec =
        fixture_spec(system, "discrete-gradient+symmetric-project", DAL_PHYSICAL, 0.1);
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED,
                    "+symmetric-project has no solution around discrete-gradient, which turns D "
                    "into -D in every step");
    spec = fixture_spec(system, "dla+symmetric-project", DAL_PHYSICAL, 0.1);
    dal_run_free(fixture_stepped(&spec, 1));
}

static void test_tolerances(void)
{
    dal_run_spec spec = fixture_spec(fixture_system("knife-edge"), "rk4", DAL_PHYSICAL, 0.1);
    spec.options.tolerance = 1e-9;
    fixture_refused(&spec, DAL_STATUS_UNSUPPORTED,
                    "rk4 has no control of its step size: the tolerance must be 0");
    spec.options.tolerance = 1e-40;
    fixture_refused(&spec, DAL_STATUS_ARGUMENT, "option tolerance: 1e-40 is below");
}

static void test_batches(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system("knife-edge"), "rk4", DAL_PHYSICAL, 0.1);
    dal_error error;
    dal_batch *batch = NULL;
    refused(dal_batch_create(&batch, &spec, 2, 3, &error), DAL_STATUS_ARGUMENT, &error,
            "width 3 is not 0, 1, 4 or 8");
    CU_ASSERT_PTR_NULL(batch);
    refused(dal_batch_create(&batch, &spec, 0, 1, &error), DAL_STATUS_ARGUMENT, &error,
            "a batch of 0 runs is empty");
    CU_ASSERT_EQUAL_FATAL(dal_batch_create(&batch, &spec, 2, 1, &error), DAL_STATUS_OK);
    for (int lane = -1; lane <= 2; lane += 3) {
        char message[64];
        snprintf(message, sizeof message, "lane %d of 2 does not exist", lane);
        refused(dal_batch_start(batch, lane, NULL, 0, NULL, 0, &error), DAL_STATUS_ARGUMENT, &error,
                message);
        refused(dal_batch_status(batch, lane, &error), DAL_STATUS_ARGUMENT, &error, message);
    }
    dal_batch_free(batch);
}

static double backwards(void *user, long long row)
{
    (void)user;
    return row < 2 ? 0.5 * (double)row : 0.25;
}
static double nowhere(void *user, long long row)
{
    (void)user;
    return row < 2 ? 0.5 * (double)row : NAN;
}

static void test_runs(void)
{
    const dal_run_spec spec =
        fixture_spec(fixture_system("knife-edge"), "rk4", DAL_PHYSICAL, 0.125);
    dal_run *run = fixture_run(&spec);
    dal_error error;
    dal_observer observer = {.row_time = backwards};
    refused(dal_run_advance(run, -1, &error), DAL_STATUS_ARGUMENT, &error,
            "-1 steps: a run goes forward");
    refused(dal_run_sample(run, 1.0, 3, 0, &observer, &error), DAL_STATUS_ARGUMENT, &error,
            "row 2 is at t = 0.25, the row before it at 0.5");
    observer.row_time = nowhere;
    refused(dal_run_sample(run, 1.0, 3, 0, &observer, &error), DAL_STATUS_ARGUMENT, &error,
            "row 2 is at t = nan, the row before it at 0.5");
    observer = (dal_observer){.every = -1};
    refused(dal_run_sample(run, 1.0, 3, 0, &observer, &error), DAL_STATUS_ARGUMENT, &error,
            "observations every -1 steps cannot be made");
    observer = (dal_observer){.polling = -1};
    refused(dal_run_sample(run, 1.0, 3, 0, &observer, &error), DAL_STATUS_ARGUMENT, &error,
            "polls every -1 steps cannot be made");
    CU_ASSERT_EQUAL(dal_run_steps(run), 0);
    dal_run_free(run);
}

static dal_status no_values(const dal_system *system, const dal_point *at, double *out)
{
    (void)system, (void)at, (void)out;
    return DAL_STATUS_NOT_FINITE;
}

static void test_systems(void)
{
    static const struct {
        dal_system system;
        dal_status status;
        const char *message;
    } bad[] = {
        {{.n = 0}, DAL_STATUS_ARGUMENT, "a system needs coordinates; n is 0"},
        {{.n = 1, .pivots = -1}, DAL_STATUS_ARGUMENT, "a dimension of the system is negative"},
        {{.n = 3, .m = 2, .multipliers = 1},
         DAL_STATUS_ARGUMENT,
         "1 multipliers for 2 constraints"},
        {{.n = 1, .parameters = 3, .workspace = 2},
         DAL_STATUS_ARGUMENT,
         "3 parameters in a workspace of 2"},
        {{.n = 1, .pivots = 2, .workspace = 1},
         DAL_STATUS_ARGUMENT,
         "2 pivots in a workspace of 1"},
        {{.n = 1, .m = 2}, DAL_STATUS_TOO_LARGE, "1 coordinates, 2 constraints"},
        {{.n = 100001}, DAL_STATUS_TOO_LARGE, "100001 coordinates, 0 constraints"},
        {{.n = 1, .start = no_values}, DAL_STATUS_NOT_FINITE, "the system has no start with these"},
        {{.name = "hand", .n = 1, .start = no_values},
         DAL_STATUS_NOT_FINITE,
         "hand has no start with"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        dal_system system = bad[i].system;
        system.call.field = fixture_oscillate;
        const dal_run_spec spec = fixture_spec(&system, "rk4", DAL_PHYSICAL, 0.1);
        fixture_refused(&spec, bad[i].status, bad[i].message);
    }
}

/* What a method, a space or an option needs, and a system lacks. */
static void test_lacking(void)
{
    static const char spring[] = "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\n";
    static const char position[] = "coordinates: [x]\nlagrangian: (1 + x^2)*x'^2/2\n";
    static const char vakonomic[] = "coordinates: [x, y]\nmechanics: vakonomic\n"
                                    "lagrangian: (x'^2 + y'^2)/2\nconstraints: [\"y' - x*x'\"]\n";
    const dal_system whole = *fixture_system(spring);
    dal_system no_field = whole, no_normal = whole, no_energy = whole, no_potential = whole;
    no_field.call.field = NULL;
    no_normal.call.energy_normal = NULL;
    no_energy.energy = NULL;
    no_potential.call.potential = NULL;
    const struct {
        const dal_system *system;
        const char *method, *message;
        bool extends;
    } cases[] = {
        {&no_field, "rk4", ": the system has no field", false},
        {&no_normal, "rk4+project-energy", ": the system has no energy_normal", false},
        {&no_energy, "rk4+project-energy", ": the system has no energy", false},
        {&no_potential, "discrete-gradient", ": the system has no potential (its", false},
        {fixture_system(position), "discrete-gradient", ": the system has no constant mass", false},
        {fixture_system(vakonomic), "rk4", ": vakonomic motion does not conserve the", true},
        {&no_energy, "rk4", ": the system has no energy", true}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        dal_run_spec spec = fixture_spec(cases[i].system, cases[i].method, DAL_PHYSICAL, 0.1);
        spec.options.extend_energy = cases[i].extends;
        fixture_refused(&spec, DAL_STATUS_UNSUPPORTED, cases[i].message);
    }
}

static void test_models(void)
{
    dal_error error;
    dal_model *model = dal_model_create("late");
    CU_ASSERT_EQUAL(dal_model_add(model, DAL_SECTION_COORDINATES, NULL, "x", 1, 1, NULL),
                    DAL_STATUS_OK);
    refused(dal_model_add(model, DAL_SECTION_TABLES, "f", "f.csv", 2, 3, &error),
            DAL_STATUS_ARGUMENT, &error, "tables are added by dal_model_add_table");
    CU_ASSERT(error.line == 2 && error.column == 3);
    CU_ASSERT_EQUAL(dal_model_observe(model, "x^2", 3, 1, NULL), DAL_STATUS_OK);
    refused(dal_model_add(model, DAL_SECTION_COORDINATES, NULL, "y", 4, 5, &error),
            DAL_STATUS_ARGUMENT, &error, "formulas to observe come after all other entries");
    CU_ASSERT(error.line == 4 && error.column == 5);
    dal_model_free(model);
}

/* A ball that is faster after each passage upwards could not have come from there. */
static void test_events(void)
{
    static const char ball[] = "coordinates: [y]\nlagrangian: y'^2/2 - y\nstart: {y: -1, y': 2}\n"
                               "events:\n  - {when: y, direction: up, set: {y': 2*y'}}\n";
    const dal_run_spec spec = fixture_spec(fixture_system(ball), "gauss4", DAL_PHYSICAL, 0.0625);
    dal_run *run = fixture_run(&spec);
    dal_error error;
    /* y = -1 + 2t - t^2/2 is 0 at t = 2 - sqrt(2), where y' = sqrt(2) becomes 2 sqrt(2). */
    CU_ASSERT_EQUAL(fixture_events(run, 2.0, NULL, NULL, &error), DAL_STATUS_EVENT);
    CU_ASSERT_PTR_NOT_NULL(
        strstr(error.message, ": the velocities after it still lead out, d(when)/dt = 2.82843"));
    CU_ASSERT_PTR_NOT_NULL(strstr(error.message, "at t = 0.5857864376269"));
    dal_run_free(run);
}

/* Names and paths of any length are copied to places of a size. */
static void test_lengths(void)
{
    char long_name[4100];
    memset(long_name, 'a', sizeof long_name - 1);
    long_name[sizeof long_name - 1] = '\0';
    const dal_run_spec spec =
        fixture_spec(fixture_system("knife-edge"), "rk4", DAL_PHYSICAL, 0.125);
    dal_error error;
    dal_method method;
    char *text = NULL, expected[DAL_MESSAGE_SIZE];
    snprintf(expected, sizeof expected, "prefix '%.60s...' is too long", long_name);
    refused(dal_generate(&spec, &(dal_generate_options){.prefix = long_name}, &text, &error),
            DAL_STATUS_ARGUMENT, &error, expected);
    CU_ASSERT_PTR_NULL(text);
    snprintf(expected, sizeof expected, "integrator name '%.60s...' is too long", long_name);
    refused(dal_method_parse(&method, long_name, &error), DAL_STATUS_NAME, &error, expected);
    dal_run *run = fixture_run(&spec);
    const dal_native_options options = {.cache = "unused", .compiler = long_name};
    snprintf(expected, sizeof expected, "the path '%.80s...' is too long", long_name);
    refused(dal_run_native(run, &options, &error), DAL_STATUS_ARGUMENT, &error, expected);
    refused(dal_run_native(run, NULL, &error), DAL_STATUS_ARGUMENT, &error,
            "no directory for compiled steps");
    CU_ASSERT_FALSE(dal_run_is_native(run));
    dal_run_free(run);
}

static dal_status no_section(void *user, dal_run *run, const dal_crossing *crossing)
{
    (void)user, (void)run, (void)crossing;
    return DAL_STATUS_OK;
}

static void test_sections(void)
{
    dal_run_spec spec =
        fixture_spec(fixture_system("chaplygin-sleigh"), "rk4", DAL_PHYSICAL, -0.125);
    dal_error error;
    dal_crossings found;
    dal_poincare section = {.callback = spec.system->energy, .count = 1, .cross = no_section};
    dal_run *run = fixture_run(&spec);
    refused(dal_run_crossings(run, -1.0, &section, &found, &error), DAL_STATUS_ARGUMENT, &error,
            "a section needs a positive step; it is -0.125");
    section.index = 1;
    refused(dal_run_crossings(run, -1.0, &section, &found, &error), DAL_STATUS_ARGUMENT, &error,
            "the section is value 2 of 1");
    dal_lyapunov *exponents = NULL;
    refused(dal_lyapunov_create(&exponents, &spec, NULL, 0, &error), DAL_STATUS_ARGUMENT, &error,
            "exponents need a positive step; it is -0.125");
    CU_ASSERT_PTR_NULL(exponents);
    dal_run_free(run);
}

/* The balance of exponents needs the divergence of F, which is found by the Jacobian. */
static void test_balance(void)
{
    const dal_system hand = {.name = "hand", .n = 1, .call.field = fixture_oscillate};
    dal_run_spec spec = fixture_spec(&hand, "rk4", DAL_PHYSICAL, 0.125);
    dal_lyapunov *exponents = NULL;
    dal_balance balance;
    dal_error error;
    CU_ASSERT_EQUAL_FATAL(dal_lyapunov_create(&exponents, &spec, NULL, 0, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_lyapunov_advance(exponents, 10, NULL), DAL_STATUS_OK);
    refused(dal_lyapunov_balance(exponents, &balance, &error), DAL_STATUS_UNSUPPORTED, &error,
            "there is no divergence: no step, or no jacobian");
    dal_lyapunov_free(exponents);
}

/* It needs the gradients of what the method enforces at its end, too. */
static void test_gradients(void)
{
    static const char *const names[] = {"constraints", NULL};
    const dal_system system = failing_system(fixture_system(fixture_bilinear), names);
    const dal_run_spec spec = fixture_spec(&system, "rk4+project", DAL_PHYSICAL, 0.125);
    dal_lyapunov *exponents = NULL;
    dal_balance balance;
    dal_error error;
    failing_begin(0, 0);
    CU_ASSERT_EQUAL_FATAL(dal_lyapunov_create(&exponents, &spec, NULL, 0, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_lyapunov_advance(exponents, 2, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_lyapunov_balance(exponents, &balance, NULL), DAL_STATUS_OK);
    failing_begin(1, LONG_MAX);
    refused(dal_lyapunov_balance(exponents, &balance, &error), DAL_STATUS_UNSUPPORTED, &error,
            "the gradient of D or E is not finite");
    failing_begin(0, 0);
    dal_lyapunov_free(exponents);
}

/* What would pass over the events of a system refuses it. */
static void test_passing_events(void)
{
    static const char ball[] = "coordinates: [y]\nparameters: {g: 9.8}\nlagrangian: y'^2/2 - g*y\n"
                               "start: {y: 1}\nevents: [{when: y, restitution: 0.5}]\n";
    static const char *const parameter[] = {"g"};
    dal_model *model = fixture_model(ball);
    const dal_setting target = {"y", 0.5};
    const double direction[] = {1.0, 0.0};
    const dal_system *system, *tangent;
    dal_steer_settings settings = dal_steer_settings_default();
    settings.target = &target;
    settings.targets = 1;
    CU_ASSERT_EQUAL_FATAL(dal_model_system(model, &system, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_model_tangent(model, &tangent, NULL), DAL_STATUS_OK);
    const dal_run_spec spec = fixture_spec(system, "gauss4", DAL_PHYSICAL, 0.1);
    const dal_run_spec lifted = fixture_spec(system, "gauss4", DAL_LIFTED, 0.1);
    dal_error error[9];
    dal_run *run = fixture_run(&spec);
    const dal_poincare section = {.callback = system->energy, .count = 1, .cross = no_section};
    dal_crossings found;
    dal_error_budget *budget = NULL;
    dal_order order;
    dal_statistics statistics;
    dal_lyapunov *lyapunov = NULL;
    dal_sensitivity *sensitivity = NULL;
    dal_steering *steering = NULL;
    dal_batch *batch = NULL;
    double defect;
    const struct {
        dal_status status;
        const char *what;
    } got[] = {
        {dal_error_budget_create(&budget, &spec, 4, 0, NULL, &error[0]), "error budgets"},
        {dal_order_measure(&order, &spec, 1.0, 2, NULL, NULL, NULL, &error[1]),
         "tables of the order"},
        {dal_check_symplecticity(&lifted, 0.0, NULL, 0.0, &defect, &error[2]), "maps of a step"},
        {dal_adjoint_pairing(&spec, tangent, direction, 3, &statistics, &error[3]),
         "adjoint pairings"},
        {dal_lyapunov_create(&lyapunov, &spec, tangent, 0, &error[4]), "tangent vectors"},
        {dal_sensitivity_create(&sensitivity, model, &spec, parameter, 1, &error[5]),
         "sensitivities"},
        {dal_steer_create(&steering, model, &lifted, 1.0, &settings, NULL, &error[6]), "steering"},
        {dal_batch_create(&batch, &spec, 2, 1, &error[7]), "batches"},
        {dal_run_crossings(run, 1.0, &section, &found, &error[8]), "sections"}};
    for (size_t i = 0; i < sizeof got / sizeof *got; i++) {
        char message[100];
        snprintf(message, sizeof message, "%s has events: %s would pass over them", system->name,
                 got[i].what);
        refused(got[i].status, DAL_STATUS_UNSUPPORTED, &error[i], message);
    }
    CU_ASSERT(!budget && !lyapunov && !sensitivity && !steering && !batch);
    dal_run_free(run);
    dal_model_free(model);
}

static void test_states(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system("knife-edge"), "gauss4", DAL_LIFTED, 0.1);
    dal_run *run = fixture_run(&spec);
    double state[32] = {[1] = NAN}, defect;
    CU_ASSERT_FATAL(dal_run_dimension(run) <= 32);
    dal_error error;
    refused(dal_check_symplecticity(&spec, 0.0, state, 0.0, &defect, &error), DAL_STATUS_NOT_FINITE,
            &error, "state component 2 is not finite: nan");
    refused(dal_check_reversibility(&spec, 0.0, state, &defect, &error), DAL_STATUS_NOT_FINITE,
            &error, "state component 2 is not finite: nan");
    dal_run_free(run);
}

/* The change by steps from states of the exact motion, one of whose callbacks fails. */
static void test_local_change(void)
{
    static const char *const names[] = {"field", "constraint", "constraints", "energy",
                                        "invariant_values"};
    static const char text[] =
        "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2 - x^2)/2\nconstraints: [\"y' - x*x'\"]\n"
        "start: {x: 0.5, x': 1, y': 0.5}\ninvariants: {g: x}\n";
    const double x[] = {0.5, 0.0, 1.0, 0.5}, D[] = {1e-3}, unknown[] = {0.5, 0.0, NAN, 0.5};
    double t = 0.0, out[8];
    int made;
    for (int i = 0; i < 5; i++) {
        const char *const one[] = {names[i], NULL};
        const dal_system system = failing_system(fixture_system(text), one);
        const dal_run_spec spec = fixture_spec(&system, "rk4", DAL_PHYSICAL, 0.125);
        const bool is_observed = i >= 2, is_field = i == 0;
        dal__local local;
        dal_error error = {0};
        dal_run *run = fixture_run(&spec);
        CU_ASSERT_EQUAL_FATAL(dal__local_create(&local, &spec, run, DAL_DOUBLE, NULL),
                              DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal__local_pull(&local, t, x, D, out), DAL_STATUS_OK);
        CU_ASSERT(isfinite(dal__local_divergence(&local, t, x)));
        failing_begin(1, LONG_MAX);
        CU_ASSERT_EQUAL(dal__local_observe(&local, t, x, out),
                        is_observed ? DAL_STATUS_IO : DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal__local_scales(&local, t, x, out),
                        is_observed ? DAL_STATUS_IO : DAL_STATUS_OK);
        CU_ASSERT_EQUAL(dal__local_pull(&local, t, x, D, out),
                        i == 2 ? DAL_STATUS_OK : DAL_STATUS_IO);
        CU_ASSERT_EQUAL(dal__local_steps(&local, 1, &t, x, out, &made, &error),
                        is_observed || is_field ? DAL_STATUS_IO : DAL_STATUS_OK);
        CU_ASSERT(!is_observed || strstr(error.message, "the observables at t = 0: ") != NULL);
        CU_ASSERT_EQUAL(isnan(dal__local_divergence(&local, t, x)), is_field);
        failing_begin(0, 0);
        refused(dal__local_steps(&local, 1, &t, unknown, out, &made, &error), DAL_STATUS_NOT_FINITE,
                &error, "state component 3 is not finite: nan");
        CU_ASSERT_EQUAL(made, 0);
        dal__local_free(&local);
        if (dal__local_create(&local, &spec, run, DAL_QUAD, NULL) == DAL_STATUS_OK)
            refused(dal__local_steps(&local, 1, &t, unknown, out, &made, &error),
                    DAL_STATUS_NOT_FINITE, &error, "state component 3 is not finite: nan");
        dal__local_free(&local);
        dal_run_free(run);
    }
}

/* What needs the system of a model says why there is none. */
static void test_without_system(void)
{
    static const char text[] = "coordinates: [x]\nparameters: {k: 1}\nlagrangian: x\n";
    static const char message[] = "the mass matrix";
    const char *const names[] = {"k"};
    const dal_setting target = {"x", 0.5};
    const dal_system *system;
    const dal_run_spec spec = fixture_spec(fixture_system("knife-edge"), "gauss4", DAL_LIFTED, 0.1);
    dal_steer_settings settings = dal_steer_settings_default();
    dal_sensitivity *sensitivity;
    dal_steering *steering;
    settings.target = &target;
    settings.targets = 1;
    for (int i = 0; i < 4; i++) {
        dal_model *model = fixture_model(text);
        dal_error error = {0};
        const dal_status status =
            i == 0   ? dal_model_tangent(model, &system, &error)
            : i == 1 ? dal_model_tangent_by(model, "k", &system, &error)
            : i == 2 ? dal_sensitivity_create(&sensitivity, model, &spec, names, 1, &error)
                     : dal_steer_create(&steering, model, &spec, 1.0, &settings, NULL, &error);
        CU_ASSERT_EQUAL(status, DAL_STATUS_SINGULAR_MASS);
        CU_ASSERT(strstr(error.message, message) != NULL);
        dal_model_free(model);
    }
    dal_model *model = fixture_model("coordinates: [x]\nlagrangian: x'^2/2\n");
    dal_error error;
    refused(dal_model_tangent_by(model, "k", &system, &error), DAL_STATUS_NAME, &error,
            "unknown parameter 'k'");
    dal_model_free(model);
}

void suite_refusals(void)
{
    CU_pSuite suite = CU_add_suite("refusals", NULL, NULL);
    CU_add_test(suite, "modifiers", test_modifiers);
    CU_add_test(suite, "tolerances", test_tolerances);
    CU_add_test(suite, "batches", test_batches);
    CU_add_test(suite, "runs", test_runs);
    CU_add_test(suite, "systems made by hand", test_systems);
    CU_add_test(suite, "what systems lack", test_lacking);
    CU_add_test(suite, "models", test_models);
    CU_add_test(suite, "events that lead out", test_events);
    CU_add_test(suite, "events that would be passed over", test_passing_events);
    CU_add_test(suite, "models without a system", test_without_system);
    CU_add_test(suite, "states that are not finite", test_states);
    CU_add_test(suite, "changes by single steps", test_local_change);
    CU_add_test(suite, "names that are too long", test_lengths);
    CU_add_test(suite, "sections and exponents backwards", test_sections);
    CU_add_test(suite, "exponents without a Jacobian", test_balance);
    CU_add_test(suite, "exponents without gradients", test_gradients);
}
