/* problem.c - opens a boundary value problem: checks it, and finds its ends, its units
 * and the integrals that the momenta cannot move. */
#include "steer/problem.h"
#include "core/error.h"
#include "core/settings.h"
#include "core/vectors.h"
#include "dynamics/tangent_map.h"
#include "expr/traversal.h"
#include "model/model.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

dal_steer_settings dal_steer_settings_default(void)
{
    return (dal_steer_settings){.starts = 1, .seed = 1, .iterations = 200, .tolerance = 1e-11};
}

/* ---- what is refused ---- */

static dal_status check_steer_settings(const dal_steer_settings *s, dal_error *error)
{
    DAL_REQUIRE(s, error);
    DAL_TRY(dal__check_settings(s->target, s->targets, "targets", error));
    DAL_REQUIRE_COUNT(s->frees, error);
    DAL_REQUIRE(s->free_starts || s->frees == 0, error);
    for (int i = 0; i < s->frees; i++) DAL_REQUIRE(s->free_starts[i], error);
    if (s->starts < 1 || s->iterations < 1 || !(s->tolerance > 0.0))
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "%d first guesses, %d iterations and a tolerance of %g: each must be "
                         "above 0",
                         s->starts, s->iterations, s->tolerance);
    return DAL_STATUS_OK;
}

static dal_status check_request(dal__problem *p, double T, dal_error *error)
{
    const dal_system *system = p->system;
    const double length = p->spec.options.step;
    const double steps = round((T - p->from) / length);
    p->T = T;
    p->h = length;
    if (!(steps >= 1.0 && steps <= 1e7) ||
        fabs(steps * length - (T - p->from)) > 1e-9 * fabs(T - p->from))
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "the time %.17g is no whole number of steps of %.17g after %.17g", T,
                         length, p->from);
    p->steps = (long long)steps;
    if (p->multipliers > 0 && (p->settings->rest || p->settings->aim))
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "the ends of vakonomic motion are in q alone: there is no %s",
                         p->settings->rest ? "rest" : "aim");
    DAL_TRY(dal__refuse_events(system, "steering", error));
    if (p->is_lifted && system->call.gauge)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "steering is at constant e, and mu_e of the gauge is not 0");
    char name[128], other[128];
    dal_method method = p->spec.method;
    dal_run_spec bare = p->spec;
    bool added = false;
    DAL_TRY(dal_method_complete(&method, system, &p->spec.options, &added, error));
    const char *fault = added ? "it is projected to holonomic constraints"
                              : dal__tangent_fault(&p->spec, p->spec.options.space);
    if (!fault) return DAL_STATUS_OK;
    bare.method = (dal_method){.layer = {method.layer[0]}};
    bare.options.tolerance = 0.0;
    if (dal__tangent_fault(&bare, bare.options.space))
        (void)dal_method_parse(&bare.method, "gauss8", NULL);
    const bool has_other = !dal__tangent_fault(&bare, bare.options.space);
    return dal__fail(error, DAL_STATUS_UNSUPPORTED, "no steering by %s: %s%s%s%s",
                     dal_method_name(&p->spec.method, name, sizeof name), fault,
                     has_other ? "; take " : "",
                     has_other ? dal_method_name(&bare.method, other, sizeof other) : "",
                     !has_other                        ? ""
                     : p->spec.options.tolerance > 0.0 ? " without a tolerance"
                     : system->holonomic > 0           ? " with the option bare"
                                                       : "");
}

/* ---- the ends ---- */

static dal_status find_component(const dal__problem *p, const char *name, int *out)
{
    *out = dal_run_component_index(p->run, name);
    if (*out >= p->n && p->multipliers > 0)
        return dal__fail(p->error, DAL_STATUS_UNSUPPORTED,
                         "the ends of vakonomic motion are in q alone: '%.63s' cannot be given",
                         name);
    if (*out >= 0 && *out < 2 * p->n) return DAL_STATUS_OK;
    return dal__fail(p->error, DAL_STATUS_NAME,
                     "'%.63s' is no coordinate or velocity of the system", name);
}

/* The spec with velocities of 0 at its start where it names none. */
static dal_status rest_at_start(dal__problem *p)
{
    const size_t n = (size_t)p->n, count = (size_t)p->spec.start_count;
    size_t length = 0;
    for (size_t i = 0; i < n; i++) length += strlen(p->system->coordinate[i]) + 2;
    dal_setting *made = calloc(count + n, sizeof *made);
    char *name = malloc(length);
    p->setting = made;
    p->names = name;
    if (!made || !name) return DAL_STATUS_MEMORY;
    if (count > 0) memcpy(made, p->spec.start, count * sizeof *made);
    p->spec.start = made;
    for (size_t i = 0; i < n; i++) {
        const size_t letters = strlen(p->system->coordinate[i]);
        memcpy(name, p->system->coordinate[i], letters);
        memcpy(name + letters, "'", 2);
        bool is_named = false;
        for (size_t k = 0; k < count; k++) is_named = is_named || strcmp(made[k].name, name) == 0;
        if (!is_named) made[p->spec.start_count++].name = name;
        name += letters + 2;
    }
    return DAL_STATUS_OK;
}

static dal_status find_ends(dal__problem *p)
{
    const dal_steer_settings *s = p->settings;
    const double *z = dal_run_state(p->run);
    int i;
    for (int k = 0; k < 2 * p->n; k++) {
        p->start[k] = z[k];
        p->is_free[0][k] = !p->is_lifted && k >= p->n;
        p->is_free[1][k] = !(s->rest && k >= p->n);
    }
    for (int k = 0; k < s->frees; k++) {
        DAL_TRY(find_component(p, s->free_starts[k], &i));
        p->is_free[0][i] = true;
    }
    memcpy(p->target, p->start, 2 * (size_t)p->n * sizeof *p->target);
    for (int k = p->n; k < 2 * p->n && s->rest; k++) p->target[k] = 0.0;
    for (int k = 0; k < s->targets; k++) {
        DAL_TRY(find_component(p, s->target[k].name, &i));
        if (!isfinite(s->target[k].value))
            return dal__fail(p->error, DAL_STATUS_ARGUMENT, "the target %.63s = %g is not finite",
                             s->target[k].name, s->target[k].value);
        p->target[i] = s->target[k].value;
        p->is_free[1][i] = false;
    }
    if (s->targets == 0 && !s->rest)
        return dal__fail(p->error, DAL_STATUS_ARGUMENT, "there is no target");
    return DAL_STATUS_OK;
}

/* Refuses a target at which D or g is not 0 by given components alone. */
static dal_status check_target(dal__problem *p)
{
    const int m = p->constraints, count = m + p->holonomic;
    double *values = dal__numbers(1, (size_t)count + 1);
    double *rows = dal__numbers((size_t)count + 1, 2 * (size_t)p->n);
    const double *x = p->target;
    dal_status status = values && rows ? DAL_STATUS_OK : DAL_STATUS_MEMORY;
    if (status == DAL_STATUS_OK) status = dal__problem_constraints(p, p->T, x, values);
    if (status == DAL_STATUS_OK) status = dal__problem_gradients(p, p->T, x, rows);
    for (int a = 0; a < count && status == DAL_STATUS_OK; a++) {
        double size = 0.0, free_size = 0.0;
        for (int i = 0; i < 2 * p->n; i++) {
            const double entry = fabs(rows[a * 2 * p->n + i]);
            size += entry * (1.0 + fabs(x[i]) / p->unit[i]);
            if (p->is_free[1][i]) free_size += entry;
        }
        if (free_size > 0.0 || fabs(values[a]) <= 1e-10 * size) continue;
        status = dal__fail(p->error, DAL_STATUS_INCONSISTENT,
                           "the target is off %s = 0 by %.3g: every motion keeps %s, so that it "
                           "cannot be reached",
                           a < m ? "D" : "g", values[a],
                           a < m ? DAL__CONSTRAINT_NAME(p->system, a) : "g");
    }
    free(values);
    free(rows);
    return status;
}

/* ---- integrals and units ---- */

dal_status dal__problem_evaluate(dal__problem *p, const int *node, int count, double t,
                                 const double *x, double *out)
{
    const dal__equations *e = &p->model->equations;
    const size_t n = (size_t)p->n;
    p->value[e->t] = t;
    memcpy(p->value + e->q, x, n * sizeof *x);
    memcpy(p->value + e->v, x + n, n * sizeof *x);
    return dal__evaluate_all(e->graph, node, count, p->value, out) ? DAL_STATUS_OK
                                                                   : DAL_STATUS_MEMORY;
}

dal_status dal__problem_gradients(dal__problem *p, double t, const double *x, double *out)
{
    const int n = p->n, count = (p->constraints + p->holonomic) * 2 * n;
    if (count == 0) return DAL_STATUS_OK;
    DAL_TRY(dal__problem_evaluate(p, p->gradient, count, t, x, out));
    for (int i = 0; i < count; i++) out[i] *= p->unit[i % (2 * n)];
    return DAL_STATUS_OK;
}

dal_status dal__problem_constraints(dal__problem *p, double t, const double *x, double *out)
{
    const int n = p->n;
    if (p->constraints > 0)
        DAL_TRY(dal_evaluator_call(p->evaluator, p->system->constraints, t, x, x + n, NULL, out));
    if (p->holonomic > 0)
        DAL_TRY(dal_evaluator_call(p->evaluator, p->system->call.holonomic, t, x, x + n, NULL,
                                   out + p->constraints));
    return DAL_STATUS_OK;
}

dal_status dal__problem_effort(dal__problem *p, double t, const double *x, double *out)
{
    const int n = p->n;
    double *pi = dal__numbers(4, (size_t)n), *column = pi + n;
    dal_status status = pi ? DAL_STATUS_OK : DAL_STATUS_MEMORY;
    for (int j = 0; j < n && status == DAL_STATUS_OK; j++) {
        memset(pi, 0, 4 * (size_t)n * sizeof *pi);
        pi[j] = 1.0;
        if (p->system->call.effort)
            status =
                dal_evaluator_call(p->evaluator, p->system->call.effort, t, x, x + n, pi, column);
        else
            column[j] = 1.0;
        for (int i = 0; i < n; i++) out[i * n + j] = column[i] / (p->unit[n + i] * p->unit[n + j]);
    }
    free(pi);
    return status;
}

dal_status dal__problem_inputs(dal__problem *p, double t, const double *z, double *out)
{
    const dal__equations *e = &p->model->equations;
    const size_t n = (size_t)p->n, inputs = (size_t)p->inputs;
    const double *pi = z + 3 * n + 1;
    dal_status status = DAL_STATUS_OK;
    if (inputs == 0) return DAL_STATUS_OK;
    if (p->system->effort == DAL_EFFORT_CONTROLS) {
        memcpy(p->value + e->pi, pi, n * sizeof *z);
        status = dal__problem_evaluate(p, e->control_cost, p->inputs, t, z, out);
    } else if (p->system->call.effort) {
        double *K_pi = dal__numbers(3, n);
        status =
            K_pi ? dal_evaluator_call(p->evaluator, p->system->call.effort, t, z, z + n, pi, K_pi)
                 : DAL_STATUS_MEMORY;
        if (status == DAL_STATUS_OK) memcpy(out, K_pi, n * sizeof *out);
        free(K_pi);
    } else {
        memcpy(out, pi, n * sizeof *out);
    }
    for (size_t i = 0; i < inputs && status == DAL_STATUS_OK; i++) out[i] /= p->e;
    return status;
}

/* Units of momenta are such that both ends change each other by about 1. */
static dal_status find_units_of_ends(dal__problem *p)
{
    const int n = p->n;
    const double T = fabs(p->T - p->from);
    double *K = dal__numbers((size_t)n, (size_t)n);
    if (!K) return DAL_STATUS_MEMORY;
    for (int i = 0; i < n; i++) {
        p->unit[i] = p->system->units ? p->system->units[i] : 1.0;
        p->unit[n + i] = p->unit[i] / T;
    }
    dal_status status = DAL_STATUS_OK;
    if (p->is_lifted) status = dal__problem_effort(p, p->from, p->start, K);
    const double size = dal__max_abs(K, (size_t)(n * n));
    const double scale = size > 0.0 && isfinite(size) ? p->e / (T * size) : 1.0;
    for (int i = 2 * n; i < p->unknowns; i++)
        p->unit[i] = p->is_lifted       ? scale / p->unit[i - 2 * n]
                     : p->system->units ? p->system->units[i]
                                        : 1.0;
    free(K);
    return status;
}

/* ---- the whole ---- */

static dal_status open_run(dal__problem *p)
{
    DAL_TRY(dal_run_create(&p->run, &p->spec, p->error));
    p->e = p->is_lifted ? dal_run_state(p->run)[2 * p->n] : 1.0;
    p->dimension = dal_run_dimension(p->run);
    p->unknowns = p->is_lifted ? 4 * p->n : 2 * p->n + p->multipliers;
    if (isinf(p->e))
        return dal__fail(p->error, DAL_STATUS_UNSUPPORTED, "where 1/e = 0 nothing can be steered");
    DAL_TRY(dal_evaluator_create(&p->evaluator, p->system, p->spec.parameters,
                                 p->spec.parameter_count, p->error));
    const size_t n = (size_t)p->n, rows = (size_t)(p->constraints + p->holonomic);
    p->start = dal__numbers(2, 2 * n);
    p->unit = dal__numbers(1, 4 * n + (size_t)p->multipliers);
    p->is_free[0] = calloc(4 * n, sizeof *p->is_free[0]);
    p->gradient = calloc(rows * 2 * n + 1, sizeof *p->gradient);
    p->value = dal__numbers(1, (size_t)p->model->equations.symbols + 1);
    if (!p->start || !p->unit || !p->is_free[0] || !p->gradient || !p->value)
        return DAL_STATUS_MEMORY;
    p->target = p->start + 2 * n;
    p->is_free[1] = p->is_free[0] + 2 * n;
    dal__equations *e = &p->model->equations;
    for (int a = 0; a < (int)rows; a++) {
        int *row = p->gradient + a * 2 * p->n;
        const dal__node f = a < p->constraints ? e->constraint[a] : e->position[a - p->constraints];
        dal__gradient(e->graph, f, e->symbol + e->q, p->n, row);
        dal__gradient(e->graph, f, e->symbol + e->v, p->n, row + p->n);
    }
    memcpy(p->value, e->value, (size_t)e->symbols * sizeof *p->value);
    memcpy(p->value, dal_run_parameters(p->run), (size_t)e->parameters * sizeof *p->value);
    return dal__check_size(e->graph->status, p->error);
}

dal_status dal__problem_open(dal__problem *p, dal_model *model, const dal_run_spec *spec, double T,
                             const dal_steer_settings *settings, const dal_steer_observer *observer,
                             dal_error *error)
{
    const dal_system *system;
    *p = (dal__problem){.model = model, .settings = settings, .observer = observer, .error = error};
    DAL_REQUIRE(model, error);
    DAL_TRY(dal__check_spec(spec, error));
    DAL_TRY(check_steer_settings(settings, error));
    DAL_TRY(dal_model_system(model, &system, error));
    if (spec->system != system)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "the system of the spec is not the model's");
    p->system = system;
    p->spec = *spec;
    p->n = system->n;
    p->multipliers = system->multipliers;
    p->is_lifted = !settings->aim && p->multipliers == 0;
    p->from = spec->start_time;
    p->limit = settings->iterations;
    p->constraints = system->m;
    p->holonomic = system->holonomic;
    p->spec.options.space = p->is_lifted ? DAL_LIFTED : DAL_PHYSICAL;
    p->spec.options.precision = DAL_DOUBLE;
    p->spec.options.reactions = false;
    const dal_effort effort = system->effort;
    if (p->is_lifted && (effort == DAL_EFFORT_CONSTRAINT || effort == DAL_EFFORT_CONTROLS))
        p->integrals = p->constraints + p->holonomic;
    const int controls = model->equations.controls;
    p->inputs = !p->is_lifted ? 0 : effort == DAL_EFFORT_CONTROLS ? controls : p->n;
    DAL_TRY(check_request(p, T, error));
    if (settings->rest) DAL_TRY(rest_at_start(p));
    DAL_TRY(open_run(p));
    DAL_TRY(find_ends(p));
    DAL_TRY(find_units_of_ends(p));
    if (settings->aim || p->integrals > 0) DAL_TRY(check_target(p));
    return DAL_STATUS_OK;
}

void dal__problem_close(dal__problem *p)
{
    dal_run_free(p->run);
    dal_evaluator_free(p->evaluator);
    free(p->setting);
    free(p->names);
    free(p->start);
    free(p->unit);
    free(p->is_free[0]);
    free(p->gradient);
    free(p->value);
}

dal_status dal__problem_poll(dal__problem *p)
{
    if (p->stopped == DAL_STATUS_OK && p->observer && p->observer->step)
        p->stopped = p->observer->step(p->observer->user, p->guess, p->iterations, p->residual);
    return p->stopped;
}

dal_status dal__problem_iterate(dal__problem *p)
{
    DAL_TRY(dal__problem_poll(p));
    if (p->iterations >= p->limit) return DAL_STATUS_NOT_CONVERGED;
    p->iterations++;
    return DAL_STATUS_OK;
}
