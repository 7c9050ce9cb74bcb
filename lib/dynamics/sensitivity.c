/* sensitivity.c - derivatives of a run by its start and its parameters.
 *
 * For each column the method integrates a tangent system of the model (lift/tangent.c), whose
 * states hold a state of the run and the column.  A component of the start and a parameter differ
 * in the system, and in where the column begins.  Where p = pi = 0 they stay 0, and so do their
 * derivatives: (q, v) alone is then integrated, with the same bits. */
#include "core/error.h"
#include "core/settings.h"
#include "core/vectors.h"
#include "dalembert_sensitivity.h"
#include "dynamics/tangent_map.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct dal_sensitivity {
    const dal_system *system;
    int n, dimension, count;
    bool is_lifted;     /* momenta are integrated */
    dal_run **run;      /* [count] of the tangent systems */
    double *column;     /* [count*dimension] */
    double *saved;      /* [saved_count] of all runs */
    size_t saved_count; /* and of one run */
    size_t run_count;
};

/* One column while it is made. */
typedef struct column_start {
    const dal_run_spec *spec;
    const dal_run *run; /* at the start */
    const char *name;
    int component; /* of the state; -1: the name is a parameter's */
} column_start;

static dal_space space_of(const dal_sensitivity *s)
{
    return s->is_lifted ? DAL_LIFTED : DAL_PHYSICAL;
}

static double *column_at(const dal_sensitivity *s, int k)
{
    return s->column + (size_t)k * (size_t)s->dimension;
}

/* ---- what is refused ---- */

static dal_status check_spec(const dal_run_spec *spec, dal_error *error)
{
    const dal_system *system = spec->system;
    dal_method method = spec->method;
    char name[128];
    bool added = false;
    DAL_TRY(dal__refuse_events(system, "sensitivities", error));
    if (system->solved_coordinates + system->solved_velocities > 0 || spec->options.consistent)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "the start is solved from its constraints: sensitivities need a start "
                         "that is given");
    DAL_TRY(dal_method_complete(&method, system, &spec->options, &added, error));
    if (added)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "the steps are projected to holonomic constraints, and sensitivities are "
                         "not: take the option bare");
    const char *fault = dal__tangent_fault(spec, DAL_PHYSICAL);
    if (!fault) return DAL_STATUS_OK;
    return dal__fail(error, DAL_STATUS_UNSUPPORTED, "no sensitivities of %s: %s",
                     dal_method_name(&spec->method, name, sizeof name), fault);
}

/* The names, and whether momenta are integrated. */
static dal_status check_names(dal_sensitivity *s, const dal_run *run, const dal_run_spec *spec,
                              const char *const *names, dal_error *error)
{
    const double *z = dal_run_state(run);
    const bool has_momenta = s->dimension == 4 * s->n + 2;
    for (int i = 2 * s->n + 1; has_momenta && i < 4 * s->n + 1; i++)
        s->is_lifted = s->is_lifted || z[i] != 0.0;
    for (int k = 0; k < s->count; k++) {
        DAL_REQUIRE(names[k], error);
        const int component = dal_run_component_index(run, names[k]);
        if (has_momenta && component == 2 * s->n)
            return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                             "sensitivities are at constant e: there is none by the start of e");
        s->is_lifted = s->is_lifted || (has_momenta && component > 2 * s->n);
    }
    const char *fault = s->is_lifted ? dal__tangent_fault(spec, DAL_LIFTED) : NULL;
    if (!fault) return DAL_STATUS_OK;
    return dal__fail(error, DAL_STATUS_UNSUPPORTED, "no sensitivities off p = pi = 0: %s", fault);
}

/* ---- making one ---- */

static dal_status start_column(dal_sensitivity *s, dal_model *model, const column_start *c, int k,
                               dal_error *error)
{
    dal_run_spec spec = *c->spec;
    spec.start_count = 0;
    spec.options.space = space_of(s);
    spec.options.precision = DAL_DOUBLE;
    spec.options.reactions = false;
    if (c->component < 0)
        DAL_TRY(dal_model_tangent_by(model, c->name, &spec.system, error));
    else
        DAL_TRY(dal_model_tangent(model, &spec.system, error));
    DAL_TRY(dal_run_create(&s->run[k], &spec, error));
    double *vector = column_at(s, k);
    double *state = dal__numbers(1, (size_t)dal_run_dimension(s->run[k]));
    if (!state) return dal__memory_error(error);
    dal__tangent_gather(s->system, space_of(s), dal_run_state(s->run[k]), vector);
    for (int i = 0; i < c->spec->start_count; i++) { /* what the run sets depends on nothing */
        const int given = dal_run_component_index(c->run, c->spec->start[i].name);
        if (given >= 0) vector[given] = 0.0;
    }
    if (c->component >= 0) vector[c->component] = 1.0;
    dal__tangent_scatter(s->system, space_of(s), dal_run_state(c->run), vector, state);
    const dal_status status = dal_run_set_state(s->run[k], dal_run_time(c->run), state, error);
    free(state);
    return status;
}

static dal_status start_columns(dal_sensitivity *s, dal_model *model, const dal_run_spec *spec,
                                const char *const *names, dal_run *run, dal_error *error)
{
    const size_t count = (size_t)s->count;
    s->n = spec->system->n;
    s->dimension = dal_run_dimension(run);
    DAL_TRY(check_names(s, run, spec, names, error));
    s->run = calloc(count + 1, sizeof(dal_run *));
    s->column = dal__numbers(count + 1, (size_t)s->dimension);
    if (!s->run || !s->column) return dal__memory_error(error);
    for (int k = 0; k < s->count; k++) {
        const column_start c = {spec, run, names[k], dal_run_component_index(run, names[k])};
        DAL_TRY(start_column(s, model, &c, k, error));
        dal_run_save(s->run[k], &s->run_count);
        s->saved_count += s->run_count;
    }
    s->saved = dal__numbers(1, s->saved_count + 1);
    return s->saved ? DAL_STATUS_OK : dal__memory_error(error);
}

dal_status dal_sensitivity_create(dal_sensitivity **sensitivity, dal_model *model,
                                  const dal_run_spec *spec, const char *const *names, int count,
                                  dal_error *error)
{
    const dal_system *system;
    dal_run *run;
    DAL_REQUIRE(sensitivity, error);
    *sensitivity = NULL;
    DAL_REQUIRE(model, error);
    DAL_REQUIRE(names, error);
    DAL_REQUIRE_COUNT(count, error);
    DAL_TRY(dal__check_spec(spec, error));
    DAL_TRY(dal_model_system(model, &system, error));
    if (spec->system != system)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "the system of the spec is not the model's");
    DAL_TRY(check_spec(spec, error));
    DAL_TRY(dal_run_create(&run, spec, error));
    dal_sensitivity *s = calloc(1, sizeof *s);
    if (s) *s = (dal_sensitivity){.system = system, .count = count};
    const dal_status status =
        s ? start_columns(s, model, spec, names, run, error) : dal__memory_error(error);
    dal_run_free(run);
    if (status == DAL_STATUS_OK)
        *sensitivity = s;
    else
        dal_sensitivity_free(s);
    return status;
}

void dal_sensitivity_free(dal_sensitivity *s)
{
    if (!s) return;
    for (int k = 0; s->run && k < s->count; k++) dal_run_free(s->run[k]);
    free(s->run);
    free(s->column);
    free(s->saved);
    free(s);
}

/* ---- moving ---- */

typedef struct target {
    const dal_sensitivity *sensitivity;
    double *column;
} target;

static dal_status read_column(void *user, dal_run *run)
{
    const target *at = user;
    const dal_sensitivity *s = at->sensitivity;
    dal__tangent_gather(s->system, space_of(s), dal_run_state(run), at->column);
    return DAL_STATUS_OK;
}

/* Times are compared as dal_run_sample compares them. */
static dal_status advance_column(dal_run *run, double t, target *at, dal_error *error)
{
    const double aligned = 1e-9, h = dal_run_step_size(run), length = fabs(h);
    const double near = fmax(aligned * length, 4.0 * DBL_EPSILON * fabs(t));
    for (;;) {
        const double rest = copysign(1.0, h) * (t - dal_run_time(run));
        if (rest < -near)
            return dal__fail(error, DAL_STATUS_ARGUMENT,
                             "sensitivities are at t = %.17g already, after %.17g",
                             dal_run_time(run), t);
        if (rest <= near) return read_column(at, run);
        if (rest < length - near)
            return dal_run_intermediate(run, copysign(rest, h), read_column, at, error);
        const double steps = rest / length - 2.0;
        DAL_TRY(dal_run_advance(run, steps < 1.0 ? 1 : (long long)steps, error));
    }
}

dal_status dal_sensitivity_advance(dal_sensitivity *s, double t, dal_error *error)
{
    DAL_REQUIRE(s, error);
    if (!isfinite(t))
        return dal__fail(error, DAL_STATUS_ARGUMENT, "sensitivities at t = %g do not exist", t);
    for (int k = 0; k < s->count; k++) {
        target at = {s, column_at(s, k)};
        DAL_TRY(advance_column(s->run[k], t, &at, error));
    }
    return DAL_STATUS_OK;
}

/* ---- results ---- */

int dal_sensitivity_count(const dal_sensitivity *s) { return s ? s->count : 0; }
int dal_sensitivity_dimension(const dal_sensitivity *s) { return s ? s->dimension : 0; }
bool dal_sensitivity_is_lifted(const dal_sensitivity *s) { return s && s->is_lifted; }

const double *dal_sensitivity_column(const dal_sensitivity *s, int k)
{
    return s && k >= 0 && k < s->count ? column_at(s, k) : NULL;
}

const double *dal_sensitivity_save(dal_sensitivity *s, size_t *count)
{
    if (!s || !count) return NULL;
    double *to = s->saved;
    for (int k = 0; k < s->count; k++, to += s->run_count) {
        size_t size;
        const double *from = dal_run_save(s->run[k], &size);
        memcpy(to, from, size * sizeof *to);
    }
    *count = s->saved_count;
    return s->saved;
}

dal_status dal_sensitivity_restore(dal_sensitivity *s, const double *saved, size_t count,
                                   dal_error *error)
{
    DAL_REQUIRE(s, error);
    DAL_REQUIRE(saved, error);
    if (count != s->saved_count)
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "%zu saved numbers of sensitivities where there are %zu", count,
                         s->saved_count);
    for (int k = 0; k < s->count; k++) {
        target at = {s, column_at(s, k)};
        DAL_TRY(dal_run_restore(s->run[k], saved + (size_t)k * s->run_count, s->run_count, error));
        DAL_TRY(read_column(&at, s->run[k]));
    }
    return DAL_STATUS_OK;
}
