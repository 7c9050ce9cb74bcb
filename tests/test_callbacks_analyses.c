/* test_callbacks_analyses.c - callbacks of a system that fail in analyses: Lyapunov exponents,
 * predictions, pairings, error budgets, sensitivities and steering; and allocations
 * that do (trial.h). */
#include "allocation.h"
#include "failing.h"
#include "fixtures.h"
#include "run/quad.h"
#include "run/run.h"
#include "trial.h"
#include <CUnit/CUnit.h>
#include <limits.h>
#include <math.h>

#define DIFFERENCES 1e-6 /* the error of differences is smaller */

/* What a result says instead of a status is one here. */
static dal_status without_value(trial *t) { return t->error.status = DAL_STATUS_NOT_FINITE; }

/* The system of a tangent map: either its callbacks fail or the callbacks of the system. */
static const dal_system *tangent;

/* The sum of the exponents; each of them depends on which vectors the first step moves most. */
static dal_status finish_lyapunov(trial *t, dal_lyapunov *l, dal_status status)
{
    dal_average average = {0};
    dal_balance balance = {0};
    if (status == DAL_STATUS_OK) status = dal_lyapunov_advance(l, 2, &t->error);
    if (status == DAL_STATUS_OK) dal_lyapunov_divergence(l, &average);
    if (status == DAL_STATUS_OK && t->spec.options.space == DAL_PHYSICAL)
        status = dal_lyapunov_balance(l, &balance, &t->error);
    if (status == DAL_STATUS_UNSUPPORTED) status = without_value(t);
    trial_add_number(t, (double)average.mean);
    trial_add_number(t, balance.difference);
    dal_lyapunov_free(l);
    return status;
}

static dal_status measure_exponents(trial *t)
{
    dal_lyapunov *l = NULL;
    const dal_status status = dal_lyapunov_create(&l, &t->spec, tangent, 0, &t->error);
    return finish_lyapunov(t, l, status);
}

/* Each of them, along what the method enforces, whose gradients are known. */
static dal_status measure_each_exponent(trial *t)
{
    dal_lyapunov *l = NULL;
    dal_balance balance;
    dal_status status = dal_lyapunov_create(&l, &t->spec, NULL, 0, &t->error);
    if (status == DAL_STATUS_OK) status = dal_lyapunov_advance(l, 1, &t->error);
    if (status == DAL_STATUS_OK) status = dal_lyapunov_balance(l, &balance, &t->error);
    if (status == DAL_STATUS_UNSUPPORTED) status = without_value(t);
    for (int i = 0; status == DAL_STATUS_OK && i < dal_lyapunov_count(l); i++) {
        dal_average average;
        dal_lyapunov_exponent(l, i, &average);
        trial_add_number(t, (double)average.mean);
    }
    dal_lyapunov_free(l);
    return status;
}

static dal_status measure_lifted_exponents(trial *t)
{
    dal_lyapunov *l = NULL;
    const dal_status status = dal_lyapunov_create_lifted(&l, &t->spec, tangent, 0, &t->error);
    return finish_lyapunov(t, l, status);
}

static dal_status measure_pairing(trial *t)
{
    const double direction[] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
    const dal_setting adjoint[] = {{"p_y1", 0.7}, {"pi_y2", 0.4}, {"pi_phi", -0.2}};
    dal_run_spec spec = t->spec;
    dal_statistics statistics = {0};
    spec.start = adjoint;
    spec.start_count = 3;
    const dal_status status =
        dal_adjoint_pairing(&spec, tangent, direction, 3, &statistics, &t->error);
    if (status == DAL_STATUS_OK) trial_add_number(t, dal_statistics_max_abs(&statistics));
    if (status == DAL_STATUS_OK) trial_add_number(t, dal_statistics_deviation(&statistics));
    if (status == DAL_STATUS_OK) trial_add_number(t, statistics.last);
    return status;
}

static dal_status predict(trial *t)
{
    dal_prediction *p = NULL;
    dal_predict_settings settings = dal_predict_settings_default();
    settings.rows = 4;
    dal_status status =
        dal_predict_create(&p, &t->spec, 8.0 * TRIAL_STEP, &settings, NULL, &t->error);
    /* What cannot be evaluated is not known to be conserved. */
    if (status == DAL_STATUS_UNSUPPORTED) status = without_value(t);
    if (status == DAL_STATUS_OK && p->reason != DAL_PREDICTION_TIME) status = without_value(t);
    if (status == DAL_STATUS_OK) trial_add(t, p->change, (int)p->rows * p->observables);
    dal_prediction_free(p);
    return status;
}

/* Along a motion that is kept, and continued where it ends. */
static dal_status predict_by_motion(trial *t)
{
    dal_exact_motion *motion = NULL;
    dal_prediction *p = NULL;
    dal_predict_settings settings = dal_predict_settings_default();
    settings.rows = 4;
    dal_status status = dal_exact_motion_create(&motion, &t->spec, 0, &t->error);
    if (status == DAL_STATUS_OK)
        status = dal_exact_motion_extend(motion, 4.5 * TRIAL_STEP, NULL, &t->error);
    settings.motion = motion;
    if (status == DAL_STATUS_OK)
        status = dal_predict_create(&p, &t->spec, 8.0 * TRIAL_STEP, &settings, NULL, &t->error);
    if (status == DAL_STATUS_UNSUPPORTED) status = without_value(t);
    if (status == DAL_STATUS_OK && p->reason != DAL_PREDICTION_TIME) status = without_value(t);
    if (status == DAL_STATUS_OK) trial_add(t, p->change, (int)p->rows * p->observables);
    dal_prediction_free(p);
    dal_exact_motion_free(motion);
    return status;
}

/* Along a motion of which almost nothing may be kept: a second one continues it.  It is long enough
 * to be moved to D = 0 again. */
static dal_status predict_by_short_motion(trial *t)
{
    dal_exact_motion *motion = NULL;
    dal_prediction *p = NULL;
    dal_run_spec spec = t->spec;
    dal_predict_settings settings = dal_predict_settings_default();
    spec.options.step = 50.0 * TRIAL_STEP;
    dal_status status = dal_exact_motion_create(&motion, &spec, 1, &t->error);
    settings.motion = motion;
    if (status == DAL_STATUS_OK)
        status =
            dal_predict_create(&p, &spec, 12.0 * spec.options.step, &settings, NULL, &t->error);
    if (status == DAL_STATUS_OK) trial_add(t, p->change, (int)p->rows * p->observables);
    dal_prediction_free(p);
    dal_exact_motion_free(motion);
    return status;
}

/* Enough steps for velocities to go back to D = 0 where F has no Taylor series. */
static dal_status predict_longer(trial *t)
{
    dal_prediction *p = NULL;
    const double T = 260.0 * TRIAL_STEP;
    const dal_status status = dal_predict_create(&p, &t->spec, T, NULL, NULL, &t->error);
    dal_prediction_free(p);
    return status;
}

/* What a step changes of D, E and invariants, in quad precision. */
static dal_status change_in_quad(trial *t)
{
    enum { MAX = 8 };
    _Alignas(16) double memory[4 * MAX];
    double change[MAX] = {0};
    dal_run *run = NULL;
    t->spec.options.precision = DAL_QUAD;
    dal_status status = dal_run_create(&run, &t->spec, &t->error);
    if (status == DAL_STATUS_OK)
        status = t->error.status = dal__quad_change(&run->quad, TRIAL_STEP, memory, change);
    trial_add(t, change, MAX);
    dal_run_free(run);
    return status;
}

static dal_status predict_pieces(trial *t)
{
    dal_prediction *p = NULL;
    dal_predict_settings settings = dal_predict_settings_default();
    settings.pieces = 2;
    settings.rows = 2;
    dal_status status =
        dal_predict_create(&p, &t->spec, 8.0 * TRIAL_STEP, &settings, NULL, &t->error);
    if (status == DAL_STATUS_OK && (p->reason != DAL_PREDICTION_TIME || p->pieces < 2))
        status = without_value(t);
    for (int i = 0; status == DAL_STATUS_OK && i < p->observables; i++)
        trial_add_number(t, p->predicted[i].walk);
    dal_prediction_free(p);
    return status;
}

/* Comparisons that fail are left out, and change the shares. */
static dal_status budget(trial *t)
{
    static int most;
    int ran = 0;
    dal_error_budget *e = NULL;
    dal_status status = dal_error_budget_create(&e, &t->spec, 4, 2, NULL, &t->error);
    for (int k = 0; e && k < DAL_COMPARISONS; k++) ran += e->ran[k];
    most = ran > most ? ran : most;
    if (e && ran < most) status = without_value(t);
    for (int i = 0; e && i < e->observables; i++) {
        trial_add_number(t, e->shares[i].whole.deviation);
        for (int k = 0; k < DAL_ERROR_SOURCES; k++) trial_add_number(t, e->shares[i].share[k]);
    }
    dal_error_budget_free(e);
    return status;
}

/* By a start and by a parameter. */
static dal_status differentiate(trial *t)
{
    const dal_system *s = t->spec.system;
    const char *const names[] = {s->parameter[0], s->coordinate[0]};
    dal_sensitivity *x = NULL, *y = NULL;
    size_t count = 0;
    dal_status status = dal_sensitivity_create(&x, t->model, &t->spec, names, 2, &t->error);
    if (status == DAL_STATUS_OK) status = dal_sensitivity_advance(x, 2.5 * TRIAL_STEP, &t->error);
    if (status == DAL_STATUS_OK)
        status = dal_sensitivity_create(&y, t->model, &t->spec, names, 2, &t->error);
    const double *saved = status == DAL_STATUS_OK ? dal_sensitivity_save(x, &count) : NULL;
    if (saved) status = dal_sensitivity_restore(y, saved, count, &t->error);
    if (status == DAL_STATUS_OK) status = dal_sensitivity_advance(y, 3.0 * TRIAL_STEP, &t->error);
    for (int k = 0; k < 2 && status == DAL_STATUS_OK; k++)
        trial_add(t, dal_sensitivity_column(y, k), dal_sensitivity_dimension(y));
    dal_sensitivity_free(x);
    dal_sensitivity_free(y);
    return status;
}

static dal_status steer(trial *t)
{
    const dal_setting target = {t->spec.system->coordinate[0], 0.1};
    dal_steer_settings settings = dal_steer_settings_default();
    dal_steering *s = NULL;
    settings.target = &target;
    settings.targets = 1;
    dal_status status =
        dal_steer_create(&s, t->model, &t->spec, 8.0 * TRIAL_STEP, &settings, NULL, &t->error);
    if (status == DAL_STATUS_OK && s->extremal[0].status != DAL_STATUS_OK)
        status = without_value(t);
    if (status == DAL_STATUS_OK) trial_add_number(t, s->extremal[0].S);
    dal_steer_free(s);
    return status;
}

/* ---- the suite ---- */

static const char sleigh[] = "chaplygin-sleigh";
/* A field without constraints, with an energy and an invariant. */
static const char pendulum[] = "coordinates: [x]\nparameters: {k: 1}\n"
                               "lagrangian: x'^2/2 + k*cos(x)\nstart: {x: 1}\n"
                               "invariants: {g: x'^2 - 2*k*cos(x)}\n";
/* Its steps reduce volumes. */
static const char damped[] = "coordinates: [x]\nlagrangian: x'^2/2 - x^2/2\nforces: {x: -x'}\n"
                             "start: {x: 1}\n";
static const char pursuit[] =
    "coordinates: [x, y]\nparameters: {k: 1}\n"
    "lagrangian: (x'^2 + y'^2)/2 - k*x^2/2\n"
    "constraints: [\"x' - y' - 0.1*x\"]\nstart: {x: 0.5, x': 0.5, y': 0.45}\n";

static const char vakonomic[] =
    "coordinates: [x, y]\nmechanics: vakonomic\nlagrangian: (x'^2 + y'^2)/2\n"
    "constraints: [\"y' - x*x'\"]\nstart: {x: 0.2}\n";

static void test_exponents(void)
{
    tangent = NULL;
    trial_each_call(pendulum, "rk4", DAL_PHYSICAL, DIFFERENCES, measure_exponents);
    trial_each_call(damped, "rk4", DAL_PHYSICAL, DIFFERENCES, measure_exponents);
    trial_each_call(pursuit, "gauss4+project", DAL_PHYSICAL, DIFFERENCES, measure_exponents);
    trial_each_call(pendulum, "rk4+project-energy", DAL_PHYSICAL, DIFFERENCES,
                    measure_each_exponent);
    trial_each_call("heisenberg", "dla", DAL_PHYSICAL, DIFFERENCES, measure_exponents);
    tangent = fixture_tangent(sleigh);
    trial_each_call(sleigh, "gauss4", DAL_PHYSICAL, 0.0, measure_exponents);
    trial_each_call(sleigh, "gauss4", DAL_LIFTED, 0.0, measure_lifted_exponents);
    trial_each_tangent_call(sleigh, "gauss4", DAL_PHYSICAL, 0.0, measure_exponents, &tangent);
    trial_each_tangent_call(sleigh, "gauss4", DAL_LIFTED, 0.0, measure_lifted_exponents, &tangent);
}

/* div F where a motion begins. */
static void test_divergence(void)
{
    static const char *const jacobian[] = {"jacobian", NULL};
    const dal_system system = failing_system(fixture_system(damped), jacobian);
    const dal_run_spec spec = fixture_spec(&system, "rk4", DAL_PHYSICAL, 0.1);
    dal_lyapunov *l = NULL;
    dal_error error;
    failing_begin(1, LONG_MAX);
    CU_ASSERT_EQUAL(dal_lyapunov_create(&l, &spec, NULL, 0, &error), DAL_STATUS_IO);
    CU_ASSERT_STRING_EQUAL(error.message, "t = 0: no jacobian: input or output failed");
    failing_begin(0, 0);
    dal_lyapunov_free(l);
}

static void test_pairings(void)
{
    tangent = fixture_tangent(sleigh);
    trial_each_call(sleigh, "gauss4", DAL_PHYSICAL, 0.0, measure_pairing);
    trial_each_tangent_call(sleigh, "gauss4", DAL_PHYSICAL, 0.0, measure_pairing, &tangent);
}

static void test_predictions(void)
{
    static const char *const names[][2] = {
        {"field"}, {"constraints"}, {"energy"}, {"invariant_values"}};
    for (int k = 0; k < 3; k++)
        trial_each_call_of(names[k], sleigh, "rk4", TRIAL_FAILS, change_in_quad);
    for (int k = 0; k < 4; k += 3)
        trial_each_call_of(names[k], pendulum, "rk4", TRIAL_FAILS, change_in_quad);
    trial_each_call(sleigh, "rk4", DAL_PHYSICAL, DIFFERENCES, predict);
    trial_each_call(pendulum, "rk4", DAL_PHYSICAL, DIFFERENCES, predict);
    trial_each_call(pendulum, "gauss4", DAL_PHYSICAL, DIFFERENCES, predict_pieces);
    trial_each_call(sleigh, "rk4", DAL_PHYSICAL, DIFFERENCES, predict_by_motion);
    trial_each_call(pendulum, "gauss4", DAL_PHYSICAL, DIFFERENCES, predict_by_motion);
    trial_each_call(sleigh, "rk4", DAL_PHYSICAL, 0.0, budget);
}

static dal_status stop_after_half(void *user, double fraction)
{
    *(double *)user = fraction;
    return fraction < 0.5 ? DAL_STATUS_OK : DAL_STATUS_STOPPED;
}

/* An observer ends the extension of a motion. */
static void test_interrupted_motion(void)
{
    const dal_run_spec spec = fixture_spec(fixture_system(pendulum), "rk4", DAL_PHYSICAL, 0.1);
    dal_exact_motion *motion = NULL;
    dal_error error = {0};
    double last = 0.0;
    const dal_predict_observer observer = {.user = &last, .step = stop_after_half};
    CU_ASSERT_EQUAL_FATAL(dal_exact_motion_create(&motion, &spec, 0, NULL), DAL_STATUS_OK);
    CU_ASSERT_EQUAL(dal_exact_motion_extend(motion, 40.0, &observer, &error),
                    DAL_STATUS_INTERRUPTED);
    CU_ASSERT_EQUAL(last, 0.5);
    CU_ASSERT_STRING_EQUAL(error.message, "interrupted");
    dal_exact_motion_free(motion);
}

static void test_models(void)
{
    trial_each_model_call(sleigh, "rk4", DAL_PHYSICAL, 0.0, differentiate);
    trial_each_model_call(pendulum, "gauss4", DAL_LIFTED, 0.0, differentiate);
    trial_each_model_call(pendulum, "rk4", DAL_LIFTED, DIFFERENCES, steer);
    trial_each_model_call(pursuit, "rk4", DAL_LIFTED, DIFFERENCES, steer);
    trial_each_model_call(vakonomic, "gauss4", DAL_PHYSICAL, DIFFERENCES, steer);
}

/* Its motions have no Taylor series. */
static const char rough[] = "coordinates: [x]\nlagrangian: x'^2/2 - abs(x)^3\nstart: {x: 1}\n";

static const char rough_track[] =
    "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - abs(x)^3\nconstraints: [y' - x*x']\n"
    "start: {x: 1}\n";

/* The first sensitivities of a model find its tangent systems. */
static void each_allocation_of_tangents(void)
{
    allocation_trial allocations = {0};
    while (allocation_next(&allocations)) {
        dal_model *model = fixture_model(pendulum);
        const dal_system *system;
        CU_ASSERT_EQUAL_FATAL(dal_model_system(model, &system, NULL), DAL_STATUS_OK);
        trial t = {.spec = fixture_spec(system, "gauss4", DAL_PHYSICAL, TRIAL_STEP),
                   .model = model};
        allocation_start(&allocations);
        allocation_end(&allocations, differentiate(&t));
        dal_model_free(model);
    }
    CU_ASSERT(allocations.failures > 20);
}

static void test_memory(void)
{
    tangent = NULL;
    trial_each_allocation(pursuit, "gauss4+project", DAL_PHYSICAL, measure_exponents);
    tangent = fixture_tangent(sleigh);
    trial_each_allocation(sleigh, "rk4", DAL_PHYSICAL, predict);
    trial_each_allocation(rough, "rk4", DAL_PHYSICAL, predict);
    trial_each_allocation(rough_track, "rk4", DAL_PHYSICAL, predict_longer);
    trial_each_allocation(sleigh, "rk4", DAL_PHYSICAL, predict_by_motion);
    trial_each_allocation(rough, "rk4", DAL_PHYSICAL, predict_by_motion);
    trial_each_allocation(sleigh, "gauss4", DAL_PHYSICAL, predict_by_short_motion);
    trial_each_allocation(pendulum, "gauss4", DAL_PHYSICAL, predict_pieces);
    trial_each_allocation(sleigh, "gauss4", DAL_PHYSICAL, measure_exponents);
    trial_each_allocation(sleigh, "gauss4", DAL_LIFTED, measure_lifted_exponents);
    trial_each_allocation(sleigh, "gauss4", DAL_PHYSICAL, measure_pairing);
    trial_each_allocation(sleigh, "rk4", DAL_PHYSICAL, budget);
    each_allocation_of_tangents();
}

void suite_callbacks_analyses(void)
{
    CU_pSuite suite = CU_add_suite("callbacks that fail in analyses", NULL, NULL);
    CU_add_test(suite, "exponents", test_exponents);
    CU_add_test(suite, "a divergence", test_divergence);
    CU_add_test(suite, "pairings", test_pairings);
    CU_add_test(suite, "predictions and budgets", test_predictions);
    CU_add_test(suite, "an observer that ends a motion", test_interrupted_motion);
    CU_add_test(suite, "sensitivities and steering", test_models);
    CU_add_test(suite, "out of memory", test_memory);
}
