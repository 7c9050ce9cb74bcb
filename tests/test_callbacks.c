/* test_callbacks.c - callbacks of a system that fail (trial.h), and allocations that do:
 * DAL_STATUS_MEMORY, nothing else, and no block is left. */
#include "failing.h"
#include "fixtures.h"
#include "trial.h"
#include <CUnit/CUnit.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define DIFFERENCES 1e-6 /* the error of differences is smaller */

static dal_status create(trial *t)
{
    dal_run *run = NULL;
    const dal_status status = dal_run_create(&run, &t->spec, &t->error);
    if (status == DAL_STATUS_OK) trial_add_run(t, run);
    dal_run_free(run);
    return status;
}

static dal_status create_consistent(trial *t)
{
    t->spec.options.consistent = true;
    return create(t);
}

static dal_status step(trial *t)
{
    dal_run *run = NULL;
    dal_status status = dal_run_create(&run, &t->spec, &t->error);
    if (status == DAL_STATUS_OK) status = dal_run_advance(run, 3, &t->error);
    if (status == DAL_STATUS_OK) trial_add_run(t, run);
    dal_run_free(run);
    return status;
}

static dal_status observe(trial *t)
{
    dal_run *run = NULL;
    double values[32] = {0};
    dal_status status = dal_run_create(&run, &t->spec, &t->error);
    if (!status) status = t->error.status = dal_run_observe(run, values);
    const double *scales = status == DAL_STATUS_OK ? dal_run_scales(run) : NULL;
    if (scales) trial_add(t, scales, dal_run_observables(run));
    if (status == DAL_STATUS_OK && !scales)
        status = t->error.status = DAL_STATUS_IO; /* as documented */
    trial_add(t, values, (int)(sizeof values / sizeof *values));
    dal_run_free(run);
    return status;
}

static dal_status keep_sample(void *user, dal_run *run, long long row, double time)
{
    trial *t = user;
    double values[8] = {0};
    (void)row, (void)time;
    const dal_status status =
        dal_run_observables(run) <= 8 ? dal_run_observe(run, values) : DAL_STATUS_OK;
    trial_add(t, values, (int)(sizeof values / sizeof *values));
    trial_add_run(t, run);
    return status;
}
static dal_status keep_values(void *user, dal_run *run, int count, const double *time,
                              const double *values, size_t stride)
{
    (void)run, (void)time, (void)stride;
    trial_add(user, values, count);
    return DAL_STATUS_OK;
}
static dal_status keep_step(void *user, dal_run *run)
{
    trial_add_run(user, run);
    return DAL_STATUS_OK;
}
static dal_status keep_scales(void *user, dal_run *run, const double *scales)
{
    (void)run;
    trial_add(user, scales, 1);
    return DAL_STATUS_OK;
}
static dal_status sample(trial *t)
{
    dal_run *run = NULL;
    const dal_observer observer = {
        .user = t, .sample = keep_sample, .values = keep_values, .scales = keep_scales, .every = 1};
    const double T = 4.0 * t->spec.options.step;
    dal_status status = dal_run_create(&run, &t->spec, &t->error);
    if (status == DAL_STATUS_OK) status = dal_run_sample(run, T, 3, 0, &observer, &t->error);
    dal_run_free(run);
    return status;
}

static dal_status change(trial *t)
{
    dal_run *run = NULL;
    dal_status status = dal_run_create(&run, &t->spec, &t->error);
    if (status == DAL_STATUS_OK)
        status = dal_run_set_parameter(run, t->spec.system->parameter[0], 1.25, &t->error);
    if (status == DAL_STATUS_OK) status = dal_run_step(run, &t->error);
    if (status == DAL_STATUS_OK) trial_add_run(t, run);
    dal_run_free(run);
    return status;
}

static dal_status restore(trial *t)
{
    dal_run *run = NULL, *other = NULL;
    size_t count;
    dal_status status = dal_run_create(&run, &t->spec, &t->error);
    if (status == DAL_STATUS_OK) status = dal_run_create(&other, &t->spec, &t->error);
    if (status == DAL_STATUS_OK) status = dal_run_step(run, &t->error);
    const double *saved = status == DAL_STATUS_OK ? dal_run_save(run, &count) : NULL;
    if (saved) status = dal_run_restore(other, saved, count, &t->error);
    if (status == DAL_STATUS_OK) status = dal_run_step(other, &t->error);
    if (status == DAL_STATUS_OK) trial_add_run(t, other);
    dal_run_free(run);
    dal_run_free(other);
    return status;
}

static dal_status advance_batch(trial *t)
{
    dal_batch *batch = NULL;
    double state[32];
    dal_status status = dal_batch_create(&batch, &t->spec, 2, 1, &t->error);
    if (status == DAL_STATUS_OK && dal_batch_advance(batch, 3) != DAL_STATUS_OK)
        status = dal_batch_status(batch, 0, &t->error);
    for (int lane = 0; lane < 2 && status == DAL_STATUS_OK; lane++) {
        status = dal_batch_status(batch, lane, &t->error);
        dal_batch_state(batch, lane, state);
        trial_add(t, state, 2 * t->spec.system->n);
    }
    dal_batch_free(batch);
    return status;
}

/* With a parameter and a start that vary, and another one of each. */
static dal_status make_ensemble(trial *t)
{
    const dal_system *s = t->spec.system;
    const dal_setting parameter = {s->parameter[1], 1.5}, start = {s->coordinate[1], 0.25};
    dal_variation variations[2] = {{.distribution = DAL_UNIFORM, .first = 1.0, .second = 1.25}};
    dal_ensemble *ensemble = NULL;
    dal_run_spec spec = t->spec;
    spec.parameters = &parameter, spec.parameter_count = 1;
    spec.start = &start, spec.start_count = 1;
    variations[1] = variations[0];
    snprintf(variations[0].name, sizeof variations[0].name, "%s", s->parameter[0]);
    snprintf(variations[1].name, sizeof variations[1].name, "%s", s->coordinate[0]);
    const dal_status status = dal_ensemble_create(&ensemble, &spec, variations, 2, 1, 4, &t->error);
    dal_ensemble_free(ensemble);
    return status;
}

static dal_status observe_reactions(trial *t) { return t->spec.options.reactions = 1, observe(t); }

static dal_status measure_lyapunov(trial *t)
{
    dal_lyapunov *l = NULL;
    dal_average average[2];
    dal_balance balance = {0};
    dal_status status = dal_lyapunov_create(&l, &t->spec, NULL, 0, &t->error);
    if (status == DAL_STATUS_OK) status = dal_lyapunov_advance(l, 3, &t->error);
    if (status == DAL_STATUS_OK) {
        dal_lyapunov_exponent(l, 0, &average[0]);
        dal_lyapunov_divergence(l, &average[1]);
        trial_add_number(t, (double)average[0].mean);
        trial_add_number(t, (double)average[1].mean);
        status = dal_lyapunov_balance(l, &balance, &t->error);
    }
    trial_add_number(t, balance.difference);
    trial_add_number(t, balance.surface);
    trial_add_number(t, balance.margin);
    dal_lyapunov_free(l);
    return status;
}

/* An evaluator and the start of the system, x[2n]. */
static dal_status begin(trial *t, dal_evaluator **evaluator, double *x, dal_point *at)
{
    dal_status status = dal_evaluator_create(evaluator, t->spec.system, NULL, 0, &t->error);
    if (status == DAL_STATUS_OK) status = dal_evaluator_start(*evaluator, NULL, 0, x, &t->error);
    *at = (dal_point){.q = x, .v = x + t->spec.system->n};
    return status;
}

static dal_status finish(trial *t, dal_evaluator *evaluator, dal_status status)
{
    dal_evaluator_free(evaluator);
    return t->error.status = status;
}

static dal_status measure_rate(trial *t)
{
    dal_evaluator *evaluator = NULL;
    double x[32], rate = 0.0;
    dal_point at;
    dal_status status = begin(t, &evaluator, x, &at);
    if (!status)
        status = dal_evaluator_measure_rate(evaluator, t->spec.system->energy, 1, &at, &rate);
    trial_add_number(t, (double)rate);
    return finish(t, evaluator, status);
}

static dal_status check_derivatives(trial *t)
{
    dal_evaluator *evaluator = NULL;
    double x[32];
    dal_point at;
    dal_derivatives derivatives = {0};
    dal_status status = begin(t, &evaluator, x, &at);
    if (!status) status = dal_evaluator_check_derivatives(evaluator, &at, &derivatives);
    const double numbers[] = {
        derivatives.jacobian, derivatives.adjoint, derivatives.constraint_jacobian,
        derivatives.gram,     derivatives.effort,  derivatives.effort_constraint};
    trial_add(t, numbers, 6);
    return finish(t, evaluator, status);
}

static dal_status measure_rank(trial *t)
{
    dal_evaluator *evaluator = NULL;
    double x[32], pivot = 0.0;
    int rank = 0;
    dal_point at;
    dal_status status = begin(t, &evaluator, x, &at);
    if (!status) status = dal_evaluator_measure_rank(evaluator, &at, &rank, &pivot);
    trial_add_number(t, (double)rank);
    trial_add_number(t, (double)pivot);
    return finish(t, evaluator, status);
}

static dal_status project_velocity(trial *t)
{
    dal_evaluator *evaluator = NULL;
    double x[32];
    dal_point at;
    const int n = t->spec.system->n;
    dal_status status = begin(t, &evaluator, x, &at);
    if (!status) x[n] += 0.1;
    if (!status) status = dal_evaluator_project_velocity(evaluator, 0.0, x, x + n);
    if (!status) trial_add(t, x + n, n);
    return finish(t, evaluator, status);
}

static dal_status classify_constraints(trial *t)
{
    dal_evaluator *evaluator = NULL;
    double x[32], degree[8] = {0};
    dal_point at;
    dal_constraint_class class = {0};
    dal_status status = begin(t, &evaluator, x, &at);
    if (!status) status = dal_evaluator_classify_constraints(evaluator, &at, &class, degree);
    if (isnan(class.force_defect)) status = DAL_STATUS_NOT_FINITE; /* F has no values */
    /* Where few points have values no parity and no degree are found. */
    const double parity = class.parity ? class.parity : NAN;
    const double numbers[] = {class.linear,    class.constant, class.bilinear,
                              class.quadratic, parity,         class.reversible};
    trial_add(t, numbers, 6);
    for (int a = 0; a < t->spec.system->m; a++)
        trial_add_number(t, class.homogeneous ? degree[a] : NAN);
    return finish(t, evaluator, status);
}

/* Beside D = 0, where no number is 0. */
static dal_status measure_scales(trial *t)
{
    dal_evaluator *evaluator = NULL;
    double x[32], scales[16] = {0};
    dal_point at;
    dal_status status = begin(t, &evaluator, x, &at);
    x[t->spec.system->n] += 0.1;
    if (!status) status = dal_evaluator_scales(evaluator, 0.0, at.q, at.v, scales);
    trial_add(t, scales, 16);
    return finish(t, evaluator, status);
}

static dal_status measure_action(trial *t)
{
    enum { ROWS = 12 };
    dal_evaluator *evaluator;
    const dal_system *system = t->spec.system;
    const int n = system->n;
    double q[ROWS * 8], states[3 * 34], action = 0.0, defect = 0.0;
    dal_status status = dal_evaluator_create(&evaluator, system, NULL, 0, &t->error);
    if (status != DAL_STATUS_OK) return status;
    for (int i = 0; i < ROWS * n; i++) q[i] = sin(0.1 * i);
    for (int i = 0; i < 3 * (4 * n + 2); i++) states[i] = 1.0 + 0.01 * i;
    status = dal_evaluator_measure_action(evaluator, 0.0, 0.1, ROWS, q, 1.0, &action);
    if (!status) status = dal_evaluator_check_stationarity(evaluator, 0.0, 0.1, 3, states, &defect);
    trial_add_number(t, (double)action);
    trial_add_number(t, (double)defect);
    return finish(t, evaluator, status);
}

/* Two actions and D of a curve. */
static dal_status measure_curve(trial *t)
{
    enum { ROWS = 8, MAX_N = 4 };
    const int n = t->spec.system->n;
    dal_evaluator *evaluator;
    double time[ROWS], q[ROWS * MAX_N], pi[ROWS * MAX_N], defect = 0.0;
    dal_action second_order = {0}, hamiltonian = {0};
    for (int i = 0; i < ROWS; i++) time[i] = TRIAL_STEP * i;
    for (int i = 0; i < ROWS * n; i++) q[i] = sin(0.1 * i);
    for (int i = 0; i < ROWS * n; i++) pi[i] = 0.2 + 0.01 * i;
    const dal_curve curve = {.rows = ROWS, .t = time, .q = q, .pi = pi};
    dal_status status = dal_evaluator_create(&evaluator, t->spec.system, NULL, 0, &t->error);
    if (status != DAL_STATUS_OK) return status;
    status = dal_evaluator_integrate_action(evaluator, &curve, DAL_ACTION_SECOND_ORDER,
                                            &second_order, &t->error);
    if (!status)
        status = dal_evaluator_integrate_action(evaluator, &curve, DAL_ACTION_HAMILTONIAN,
                                                &hamiltonian, &t->error);
    if (!status) status = dal_evaluator_measure_curve(evaluator, &curve, &defect, &t->error);
    trial_add_number(t, second_order.value);
    trial_add_number(t, hamiltonian.value);
    trial_add_number(t, defect);
    dal_evaluator_free(evaluator);
    return status;
}

/* Rows beside steps of the method. */
static dal_status check_discrete(trial *t)
{
    enum { ROWS = 3, MAX_N = 4 };
    double time[ROWS], q[ROWS * MAX_N], v[ROWS * MAX_N];
    for (int i = 0; i < ROWS; i++) time[i] = TRIAL_STEP * i;
    for (int i = 0; i < ROWS * t->spec.system->n; i++) q[i] = sin(0.1 * i), v[i] = cos(0.1 * i);
    const dal_curve curve = {.rows = ROWS, .t = time, .q = q, .v = v};
    dal_discrete_action action = {0};
    const dal_status status = dal_check_discrete_action(&t->spec, &curve, &action, &t->error);
    trial_add_number(t, action.defect);
    return status;
}

static dal_status measure_order(trial *t)
{
    dal_order order = {0};
    const dal_status status = dal_order_measure(&order, &t->spec, 4.0 * t->spec.options.step, 2,
                                                NULL, NULL, NULL, &t->error);
    trial_add(t, order.error, order.levels);
    return status;
}

static dal_status check_maps(trial *t)
{
    double symplectic = 0.0, reverse = 0.0;
    dal_status status = dal_check_symplecticity(&t->spec, 0.0, NULL, 0.0, &symplectic, &t->error);
    if (!status) status = dal_check_reversibility(&t->spec, 0.0, NULL, &reverse, &t->error);
    trial_add_number(t, (double)symplectic);
    trial_add_number(t, (double)reverse);
    return status;
}

static dal_status budget(trial *t)
{
    dal_error_budget *e = NULL;
    const dal_status status = dal_error_budget_create(&e, &t->spec, 4, 0, NULL, &t->error);
    for (int i = 0; e && i < e->observables; i++) trial_add_number(t, e->shares[i].whole.deviation);
    dal_error_budget_free(e);
    return status;
}

static dal_status keep_crossing(void *user, dal_run *run, const dal_crossing *crossing)
{
    (void)run;
    trial_add(user, &crossing->t, 1);
    return DAL_STATUS_OK;
}
static dal_status cross(trial *t)
{
    dal_run *run = NULL;
    dal_crossings found = {0};
    const dal_system *system = t->spec.system;
    const dal_poincare section = {.callback = system->invariant_values,
                                  .count = system->invariants,
                                  .user = t,
                                  .cross = keep_crossing};
    dal_status status = dal_run_create(&run, &t->spec, &t->error);
    if (status == DAL_STATUS_OK)
        status = dal_run_crossings(run, 40.0 * t->spec.options.step, &section, &found, &t->error);
    trial_add_number(t, (double)found.up);
    trial_add_number(t, (double)found.down);
    dal_run_free(run);
    return status;
}

static dal_status scale(trial *t)
{
    dal_scaled *scaled = NULL;
    const dal_status status = dal_scaled_create(&scaled, &t->spec, &t->error);
    if (status == DAL_STATUS_OK) trial_add(t, dal_scaled_units(scaled), 1 + t->spec.system->n);
    dal_scaled_free(scaled);
    return status;
}

/* ---- the suite ---- */

static const char sleigh[] = "chaplygin-sleigh";
static const char gauged[] = "coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x: 1}\n"
                             "gauge: {e: 1, mu_e: 50*cos(t)}\n";
static const char swing[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2 - x^2)/2\n"
                            "start: {x: 1, y': 1}\ninvariants: {g: x}\n";
static const char solved[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                             "constraints: [\"y' - x'^3\"]\nstart: {x': 1, solve: [\"y'\"]}\n";
static const char ball[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - y\n"
                           "start: {y: 1}\n"
                           "events:\n  - {when: y, direction: down, restitution: 0.5}\n"
                           "  - {when: y - 0.2, direction: up, set: {x: x + 1}}\n";
static const char hanging[] = "coordinates: [x, y]\nparameters: {g: 1}\n"
                              "lagrangian: (x'^2 + y'^2)/2 - g*y\n"
                              "holonomic: [x^2 + y^2 - 1]\nstart: {x: 1}\n";

/* The start is where consistency moves it. */
static const char off[] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - y\n"
                          "holonomic: [x^2 + y^2 - 1]\nstart: {x: 1.1, x': 0.2}\n";

static void test_memory(void)
{
    trial_work *const runs[] = {create, step, sample, observe, change, restore, advance_batch};
    trial_work *const rates[] = {measure_rate, check_derivatives, measure_rank, measure_scales};
    trial_work *const others[] = {project_velocity, scale, measure_action, measure_order};
    trial_work *const last[] = {make_ensemble, observe_reactions, classify_constraints,
                                measure_lyapunov};
    for (int i = 0; i < 7; i++) {
        trial_each_allocation(sleigh, "rk4", DAL_PHYSICAL, runs[i]);
        trial_each_allocation(hanging, "gauss4+project", DAL_PHYSICAL, runs[i]);
    }
    trial_each_allocation(sleigh, "gauss4", DAL_PHYSICAL, restore);
    trial_each_allocation(sleigh, "dla", DAL_PHYSICAL, create_consistent);
    for (int i = 0; i < 4; i++) {
        trial_each_allocation(sleigh, "rk4", DAL_PHYSICAL, rates[i]);
        trial_each_allocation(sleigh, "rk4", DAL_PHYSICAL, others[i]);
        trial_each_allocation(sleigh, "rk4", DAL_PHYSICAL, last[i]);
    }
    trial_each_allocation(sleigh, "gauss4", DAL_LIFTED, check_maps);
    trial_each_allocation(sleigh, "gauss4", DAL_PHYSICAL, budget);
    trial_each_allocation(sleigh, "gauss4", DAL_LIFTED, measure_curve);
    trial_each_allocation(sleigh, "gauss4", DAL_LIFTED, check_discrete);
    trial_each_allocation(swing, "rk4", DAL_PHYSICAL, cross);
}

static void each_work_fails(const char *text, const char *method, dal_space space, double tolerance,
                            trial_work *const *work)
{
    for (; *work; work++) trial_each_call(text, method, space, tolerance, *work);
}

static void test_runs(void)
{
    static const char *const methods[] = {"rk4", "gauss4", "dla", "gauss4+project", "dop853"};
    trial_work *const all[] = {create, step, sample, advance_batch, NULL},
                      *const lifted[] = {create, step, sample, observe, NULL},
                      *const implicit[] = {observe, change, NULL},
                      *const explicit[] = {restore, observe_reactions, NULL};
    for (int i = 0; i < 5; i++) each_work_fails(sleigh, methods[i], DAL_PHYSICAL, 0.0, all);
    each_work_fails(sleigh, "gauss4", DAL_LIFTED, 0.0, lifted);
    each_work_fails(sleigh, "gauss4", DAL_PHYSICAL, 0.0, implicit);
    each_work_fails(sleigh, "rk4", DAL_PHYSICAL, 0.0, explicit);
    trial_each_call(solved, "rk4", DAL_PHYSICAL, 0.0, create);
    trial_each_call(sleigh, "rk4", DAL_PHYSICAL, 0.0, create_consistent);
    trial_each_call(off, "gauss4+project", DAL_PHYSICAL, 0.0, create_consistent);
    trial_each_call(hanging, "gauss4+project", DAL_PHYSICAL, 0.0, change);
}

static dal_status step_in_quad(trial *t) { return t->spec.options.precision = DAL_QUAD, step(t); }

/* With rows within a step. */
static dal_status sample_in_quad(trial *t)
{
    t->spec.options.precision = DAL_QUAD;
    t->spec.options.tolerance = 1e-6;
    return sample(t);
}

/* Alone, without values that an observer has. */
static dal_status sample_steps(trial *t)
{
    dal_run *run = NULL;
    const dal_observer observer = {.user = t, .step = keep_step, .every = 2};
    const double T = 6.0 * t->spec.options.step;
    dal_status status = dal_run_create(&run, &t->spec, &t->error);
    if (status == DAL_STATUS_OK) status = dal_run_sample(run, T, 1, 0, &observer, &t->error);
    dal_run_free(run);
    return status;
}

static void test_steps(void)
{
    static const char *const field[] = {"field", NULL}, *const energy[] = {"energy", NULL},
                             *const constraints[] = {"constraints", NULL};
    trial_each_call_of(field, sleigh, "rk4", TRIAL_FAILS, step);
    trial_each_call_of(field, sleigh, "rk4", TRIAL_FAILS, step_in_quad);
    trial_each_call_of(field, sleigh, "dop853", 1e-5, sample_in_quad); /* substeps halve */
    trial_each_call_of(field, sleigh, "rk4", TRIAL_FAILS, sample_steps);
    trial_each_call_of(energy, ball, "rk4", TRIAL_FAILS, sample);
    trial_each_call_of(energy, sleigh, "rk4", TRIAL_FAILS, observe);
    trial_each_call_of(constraints, sleigh, "rk4", TRIAL_FAILS, observe);
}

static void test_measures(void)
{
    trial_work *const both[] =
        {measure_rate,         check_derivatives, measure_rank, project_velocity,
         classify_constraints, measure_scales,    NULL},
                      *const exact[] = {measure_order, scale, NULL},
                      *const close[] = {measure_action, measure_lyapunov, NULL};
    each_work_fails(sleigh, "rk4", DAL_PHYSICAL, DIFFERENCES, both);
    each_work_fails(fixture_quadratic, "rk4", DAL_PHYSICAL, DIFFERENCES, both);
    each_work_fails(sleigh, "rk4", DAL_PHYSICAL, DIFFERENCES, close);
    each_work_fails(sleigh, "rk4", DAL_PHYSICAL, 0.0, exact);
    trial_each_call(sleigh, "gauss4", DAL_LIFTED, DIFFERENCES, check_maps);
    trial_each_call(sleigh, "gauss4", DAL_PHYSICAL, 0.0, budget);
    trial_each_call(swing, "rk4", DAL_PHYSICAL, 0.0, measure_scales);
    each_work_fails(hanging, "gauss4+project", DAL_PHYSICAL, DIFFERENCES, both);
    trial_each_call(hanging, "gauss4+project", DAL_PHYSICAL, 0.0, observe);
    trial_each_call(hanging, "gauss4+project", DAL_PHYSICAL, 0.0, sample);
    trial_each_lifted_call(sleigh, DAL_EFFORT_CONSTRAINT, "gauss4", 0.0, observe);
    trial_each_lifted_call(sleigh, DAL_EFFORT_MASS, "gauss4", 0.0, sample);
    trial_each_lifted_call(sleigh, DAL_EFFORT_MASS, "gauss4", DIFFERENCES, check_maps);
    trial_each_lifted_call(sleigh, DAL_EFFORT_CONSTRAINT, "gauss4", DIFFERENCES, check_derivatives);
    trial_each_lifted_call(fixture_bilinear, DAL_EFFORT_CONSTRAINT, "gauss4", DIFFERENCES,
                           check_derivatives);
    trial_each_lifted_call(sleigh, DAL_EFFORT_MASS, "gauss4", DIFFERENCES, measure_action);
    trial_each_lifted_call(sleigh, DAL_EFFORT_MASS, "gauss4", 0.0, measure_curve);
    trial_each_call(sleigh, "gauss4", DAL_LIFTED, 0.0, check_discrete);
    trial_each_call(swing, "rk4", DAL_PHYSICAL, 0.0, cross);
    trial_each_call(ball, "rk4", DAL_PHYSICAL, 1e-13, sample); /* between events */
}

/* A callback that always fails gives its own status. */
static void test_statuses(void)
{
    trial_work *const works[] = {measure_rate, check_derivatives, measure_rank, project_velocity,
                                 measure_scales};
    for (size_t i = 0; i < sizeof works / sizeof *works; i++) {
        trial_each_callback(sleigh, DAL_EFFORT_IDENTITY, "rk4", DAL_PHYSICAL, works[i]);
        trial_each_callback(hanging, DAL_EFFORT_IDENTITY, "gauss4+project", DAL_PHYSICAL, works[i]);
        trial_each_callback(sleigh, DAL_EFFORT_CONSTRAINT, "gauss4", DAL_LIFTED, works[i]);
        trial_each_callback(swing, DAL_EFFORT_IDENTITY, "rk4", DAL_PHYSICAL, works[i]);
    }
    trial_each_callback(gauged, DAL_EFFORT_IDENTITY, "gauss4", DAL_LIFTED, measure_action);
    trial_each_callback(gauged, DAL_EFFORT_IDENTITY, "gauss4", DAL_LIFTED, measure_curve);
}

/* A run has no scales where a callback fails that they are made of. */
static void no_scales(const char *text, bool is_plain, dal_space space, bool reactions)
{
    int made = 0;
    for (const char *const *name = failing_callbacks; *name; name++) {
        const char *const one[] = {*name, NULL};
        dal_system system = failing_system(fixture_system(text), one);
        if (is_plain) system.call.constraint = NULL, system.call.energy_normal = NULL;
        dal_run_spec spec = fixture_spec(&system, "rk4", space, TRIAL_STEP);
        char pi[64];
        const dal_setting start = {pi, 0.3};
        snprintf(pi, sizeof pi, "pi_%s", system.coordinate[0]);
        spec.start = &start;
        spec.start_count = space == DAL_LIFTED;
        spec.options.reactions = reactions;
        failing_begin(0, 0);
        dal_run *run = fixture_run(&spec);
        failing_begin(0, 0);
        CU_ASSERT_PTR_NOT_NULL(dal_run_scales(run));
        if (failing_calls() > 0) {
            made++;
            failing_begin(1, LONG_MAX);
            CU_ASSERT_PTR_NULL(dal_run_scales(run));
        }
        dal_run_free(run);
    }
    CU_ASSERT(made > 0);
    failing_begin(0, 0);
}

static void test_scales(void)
{
    for (int is_plain = 0; is_plain < 2; is_plain++) {
        no_scales(sleigh, is_plain, DAL_PHYSICAL, false);
        no_scales(swing, is_plain, DAL_PHYSICAL, false);
        no_scales(sleigh, is_plain, DAL_LIFTED, false);
    }
    no_scales(sleigh, false, DAL_PHYSICAL, true);
    no_scales(hanging, false, DAL_PHYSICAL, false);
}

void suite_callbacks(void)
{
    CU_pSuite suite = CU_add_suite("callbacks that fail", NULL, NULL);
    CU_add_test(suite, "runs and batches", test_runs);
    CU_add_test(suite, "steps", test_steps);
    CU_add_test(suite, "measures, crossings and rows", test_measures);
    CU_add_test(suite, "the status of a callback", test_statuses);
    CU_add_test(suite, "scales", test_scales);
    CU_add_test(suite, "out of memory", test_memory);
}
