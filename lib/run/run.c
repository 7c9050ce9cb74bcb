/* run.c - the state of a run, and its steps. */
#include "run/run.h"
#include <math.h>
#include <string.h>

void dal__run_hold(dal_run *run, const double *point)
{
    run->kind->engine->hold(run->engine, point);
    if (DAL__IS_QUAD(run)) dal__quad_hold(&run->quad, point);
    run->is_held = point != NULL;
}

dal_status dal__step_run(dal_run *run, double h, long long count)
{
    dal_status status = DAL_STATUS_OK;
    if (run->native.traced && !run->is_held) {
        unsigned failed = 0;
        int reason = DAL_STATUS_OK;
        run->native.traced(run->persistent, run->work, h, count, &failed, &reason, NULL, 0);
        return failed ? (dal_status)reason : DAL_STATUS_OK;
    }
    if (DAL__IS_QUAD(run)) {
        for (long long i = 0; i < count && status == DAL_STATUS_OK; i++)
            status = dal__quad_step(&run->quad, h);
        dal__quad_pull(&run->quad, run->persistent);
        return status;
    }
    for (long long i = 0; i < count; i++)
        if (run->kind->engine->step(run->engine, h, 1u, &status)) return status;
    return DAL_STATUS_OK;
}

dal_status dal__step_intermediate(dal_run *run, double h, double size)
{
    dal_status status = DAL_STATUS_OK;
    if (run->layout.options.tolerance == 0.0 || size == h) return dal__step_run(run, size, 1);
    if (!DAL__IS_QUAD(run)) {
        run->kind->engine->step_intermediate(run->engine, h, size, &status);
        return status;
    }
    status = dal__quad_step_intermediate(&run->quad, h, size);
    dal__quad_pull(&run->quad, run->persistent);
    return status;
}

const dal_system *dal_run_system(const dal_run *run) { return run ? run->layout.system : NULL; }
int dal_run_dimension(const dal_run *run) { return run ? run->layout.dim : 0; }
const double *dal_run_state(const dal_run *run) { return run ? run->persistent : NULL; }
const double *dal_run_parameters(const dal_run *run) { return run ? run->work : NULL; }

double dal_run_time(const dal_run *run)
{
    return run ? run->persistent[dal__at(&run->layout, DAL__TIME)] : NAN;
}

double dal_run_step_size(const dal_run *run) { return run ? run->layout.options.step : NAN; }

double dal_run_tolerance(const dal_run *run) { return run ? run->layout.options.tolerance : NAN; }

long long dal_run_steps(const dal_run *run)
{
    return run ? (long long)run->persistent[dal__at(&run->layout, DAL__STEPS)] : 0;
}

long long dal_run_evaluations(const dal_run *run)
{
    return run ? (long long)run->persistent[dal__at(&run->layout, DAL__EVALUATIONS)] : 0;
}

dal_status dal_run_set_state(dal_run *run, double t, const double *state, dal_error *error)
{
    DAL_REQUIRE(run, error);
    DAL_REQUIRE(state, error);
    const dal__layout *k = &run->layout;
    for (int i = 0; i < k->dim; i++)
        if (!dal__is_possible(k, (size_t)i, state[i]))
            return dal__fail(error, DAL_STATUS_NOT_FINITE, "state component %d is not finite: %g",
                             i + 1, state[i]);
    if (!isfinite(t)) return dal__fail(error, DAL_STATUS_NOT_FINITE, "time %g is not finite", t);
    memset(run->persistent, 0, dal__at_changed(k) * sizeof *run->persistent);
    memset(run->persistent + dal__at_events(k), 0, k->event_memory * sizeof *run->persistent);
    for (int i = 0; i < k->dim; i++) run->persistent[i] = state[i] + 0.0;
    run->persistent[dal__at(k, DAL__TIME)] = t;
    if (DAL__IS_QUAD(run)) dal__quad_push(&run->quad, run->persistent, 0);
    return DAL_STATUS_OK;
}

dal_status dal__run_prepare(dal_run *run)
{
    const dal__layout *k = &run->layout;
    const dal_point at = dal__here(run);
    if (k->system->prepare) DAL_TRY(k->system->prepare(k->system, &at, NULL));
    if (!DAL__IS_QUAD(run)) return DAL_STATUS_OK;
    dal__quad_push(&run->quad, run->persistent, k->persistent);
    return dal__quad_prepare(&run->quad, dal_run_time(run));
}

dal_status dal__run_load(dal_run *run, const double *saved)
{
    const size_t count = dal__saved_count(&run->layout), width = run->stored / count;
    const size_t first = run->layout.persistent * width, bytes = sizeof *saved;
    const bool same =
        memcmp(run->storage + first, saved + first, (run->stored - first) * bytes) == 0;
    memcpy(run->storage, saved, run->stored * bytes);
    if (DAL__IS_QUAD(run)) dal__quad_pull(&run->quad, run->persistent);
    return same ? DAL_STATUS_OK : dal__run_prepare(run);
}

void dal__run_back_up(dal_run *run)
{
    memcpy(run->shadow, run->storage, run->stored * sizeof *run->storage);
}

void dal__run_revert(dal_run *run) { dal__run_load(run, run->shadow); }
