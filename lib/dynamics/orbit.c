/* orbit.c - the exact motion from the start of a run, at any time within its steps.
 *
 * taylor has substeps as long as it likes, which divide a step of 2 LONG steps of the user, and
 * states are of their polynomials; that step is never taken, since it begins again after
 * LONG of them, or where a constraint turns too far in it.  Where F has no
 * Taylor series dop853 integrates the system in units of its own, as for error budgets; its steps
 * are the steps of the run, since its polynomials within a step are of a lower order.
 *
 * Rounding moves D of the motion, and an error of D changes E and invariants: every LONG steps the
 * velocities go back to D = 0. */
#include "dynamics/orbit.h"
#include "analysis/reference.h"
#include "analysis/scaled.h"
#include "core/error.h"
#include "core/vectors.h"
#include <stdlib.h>
#include <string.h>

enum { LONG = 256, NAME = 128 };
/* Of substeps of taylor: below rounding. */
static const double series_tolerance = 1e-18;

struct dal__orbit {
    dal_scaled *scaled; /* of dop853; NULL: by taylor */
    dal_run *run;
    dal_evaluator *evaluator; /* of its system */
    double *state;            /* [size] */
    int size;                 /* of (q, v) */
    long long first, last;    /* the steps of the user where a step of run begins, and state is */
    double start, step;       /* start time, and step of the user, in units of run */
    double *out;
};

void dal__orbit_free(dal__orbit *o)
{
    if (!o) return;
    dal_run_free(o->run);
    dal_scaled_free(o->scaled);
    dal_evaluator_free(o->evaluator);
    free(o->state);
    free(o);
}

bool dal__orbit_has_series(const dal__orbit *o) { return o->scaled == NULL; }

/* A run of taylor from the (q, v) of a run. */
static dal_status create_series(dal__orbit *o, dal_run_spec own, const dal_run *run,
                                dal_error *error)
{
    const size_t size = (size_t)o->size;
    dal_setting *start = calloc(size, sizeof *start + NAME);
    char *names = (char *)(start + size);
    if (!start) return dal__fail(error, DAL_STATUS_MEMORY, "out of memory");
    for (size_t i = 0; i < size; i++)
        start[i] = (dal_setting){dal_run_component_name(run, (int)i, names + i * NAME, NAME),
                                 dal_run_state(run)[i]};
    own.start = start;
    own.start_count = o->size;
    o->start = own.start_time = dal_run_time(run);
    own.options.step = 2.0 * LONG * o->step;
    dal_status status = dal_run_create(&o->run, &own, error);
    if (status == DAL_STATUS_OK)
        status = dal_run_set_state(o->run, own.start_time, dal_run_state(run), error);
    free(start);
    return status;
}

dal_status dal__orbit_create(dal__orbit **orbit, const dal_run_spec *spec, const dal_run *run,
                             dal_error *error)
{
    const dal_system *system = dal_run_system(run);
    dal__orbit *o = calloc(1, sizeof *o);
    *orbit = NULL;
    if (!o) return dal__fail(error, DAL_STATUS_MEMORY, "out of memory");
    o->size = 2 * system->n;
    o->step = dal_run_step_size(run);
    dal_run_spec own = {.system = system,
                        .parameters = spec->parameters,
                        .parameter_count = spec->parameter_count,
                        .options = dal_options_default()};
    own.options.space = DAL_PHYSICAL;
    const bool has_series = system->series && !system->series->refused &&
                            dal_method_parse(&own.method, "taylor", NULL) == DAL_STATUS_OK;
    own.options.tolerance = has_series ? series_tolerance : DAL__REFERENCE_TOLERANCE;
    o->state = dal__numbers(1, (size_t)o->size);
    dal_status status =
        o->state ? DAL_STATUS_OK : dal__fail(error, DAL_STATUS_MEMORY, "out of memory");
    if (status == DAL_STATUS_OK && has_series) status = create_series(o, own, run, error);
    if (status == DAL_STATUS_OK && !has_series)
        status = dal_scaled_create_at(&o->scaled, run, error);
    if (status == DAL_STATUS_OK && !has_series) {
        const double tau = dal_scaled_units(o->scaled)[0];
        own.system = dal_scaled_system(o->scaled);
        own.start_time = o->start = dal_run_time(run) / tau;
        own.options.step = o->step /= tau;
        dal__scaled_from_user(o->scaled, dal_run_state(run), o->state);
        status = dal_method_parse(&own.method, "dop853", error);
        if (status == DAL_STATUS_OK) status = dal_run_create(&o->run, &own, error);
        if (status == DAL_STATUS_OK)
            status = dal_run_set_state(o->run, own.start_time, o->state, error);
    }
    if (status == DAL_STATUS_OK && system->m > 0)
        status = dal__evaluator_of_run(&o->evaluator, o->scaled, run, error);
    if (status == DAL_STATUS_OK)
        *orbit = o;
    else
        dal__orbit_free(o);
    return status;
}

static dal_status copy_state(void *user, dal_run *run)
{
    const dal__orbit *o = user;
    if (o->scaled)
        dal__scaled_to_user(o->scaled, dal_run_state(run), o->out);
    else
        memcpy(o->out, dal_run_state(run), (size_t)o->size * sizeof *o->out);
    return DAL_STATUS_OK;
}

/* Copies the state after part of a step of the run. */
static dal_status copy_within(dal__orbit *o, double part, double *out, dal_error *error)
{
    o->out = out;
    if (part == 0.0) return copy_state(o, o->run);
    return dal_run_intermediate(o->run, part, copy_state, o, error);
}

/* Begins a step of the run at the state of step number last, with velocities on D = 0. */
static dal_status begin_again(dal__orbit *o, dal_error *error)
{
    const double t = o->start + (double)o->last * o->step;
    if (o->evaluator && dal_evaluator_project_velocity(o->evaluator, t, o->state,
                                                       o->state + o->size / 2) == DAL_STATUS_MEMORY)
        return dal__fail(error, DAL_STATUS_MEMORY, "out of memory"); /* else v stays as it is */
    o->first = o->last;
    return dal_run_set_state(o->run, t, o->state, error);
}

dal_status dal__orbit_state(dal__orbit *o, long long k, double part, double *out, dal_error *error)
{
    while (o->scaled && o->last < k) {
        DAL_TRY(dal_run_advance(o->run, 1, error));
        memcpy(o->state, dal_run_state(o->run), (size_t)o->size * sizeof *o->state);
        o->first = ++o->last;
        if (o->last % LONG == 0) DAL_TRY(begin_again(o, error));
    }
    if (k - o->first > LONG) DAL_TRY(begin_again(o, error));
    dal_status status = copy_within(o, ((double)(k - o->first) + part) * o->step, out, error);
    if (status != DAL_STATUS_OK && o->last > o->first) {
        DAL_TRY(begin_again(o, error));
        status = copy_within(o, ((double)(k - o->first) + part) * o->step, out, error);
    }
    if (o->scaled || part > 0.0 || status != DAL_STATUS_OK) return status;
    o->last = k;
    memcpy(o->state, out, (size_t)o->size * sizeof *o->state);
    return DAL_STATUS_OK;
}
