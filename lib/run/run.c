/* run.c - a run: one system, one method, one block of memory. */
#include "run/run.h"
#include "run/event_search.h"
#include "run/events.h"
#include "run/failure.h"
#include "run/saved.h"
#include "run/scales.h"
#include "run/start.h"
#include <dalembert_kernel.h>
#include <stdlib.h>

/* Doubles in a checkpoint. */
static size_t stored_count(const dal__layout *k)
{
    const size_t count = dal__saved_count(k);
    return k->options.precision == DAL_DOUBLE ? count : count * dal__quad_width();
}

/* Doubles beside those of the engines. */
static size_t own_numbers(const dal__layout *k)
{
    const size_t time_and_observables = 1 + (size_t)k->m + 6 + (size_t)k->system->invariants;
    const size_t reactions = k->options.reactions ? (size_t)(k->n + 2 * k->m) : 0;
    return stored_count(k) + (size_t)(k->n + k->nw) + dal__event_scratch(k, stored_count(k)) +
           time_and_observables + reactions + dal__scale_numbers(k);
}

static size_t quad_bytes(const dal__layout *k)
{
    return k->options.precision == DAL_DOUBLE ? 0 : dal__quad_bytes(k);
}

static size_t total_bytes(const dal__layout *k)
{
    return 64 + dal__align(sizeof(dal_run)) + dal__align(own_numbers(k) * sizeof(double)) +
           dal__align(dal__engine_best(k, 1)->engine->bytes(k)) + quad_bytes(k);
}

size_t dal_run_size(const dal_run_spec *spec)
{
    dal__layout layout;
    return dal__layout_init(&layout, spec, NULL) == DAL_OK ? total_bytes(&layout) : 0;
}

static dal_run *place(const dal__layout *layout, void *memory)
{
    char *at = (char *)memory + (dal__align((uintptr_t)memory) - (uintptr_t)memory);
    dal_run *run = (dal_run *)(void *)at;
    *run = (dal_run){.layout = *layout};
    at += dal__align(sizeof *run);
    run->shadow = (double *)(void *)at;
    run->point = run->shadow + stored_count(layout);
    run->event_scratch = run->point + layout->n + layout->nw;
    run->scales = run->event_scratch + dal__event_scratch(layout, stored_count(layout));
    run->observations.times = run->scales + dal__scale_numbers(layout);
    run->observations.values = run->observations.times + 1;
    run->observations.capacity = 1;
    at += dal__align(own_numbers(layout) * sizeof(double));
    run->kind = dal__engine_best(layout, 1);
    run->engine = run->kind->engine->place(layout, at, &run->persistent, &run->work, &run->scratch);
    run->storage = run->persistent;
    run->stored = stored_count(layout);
    at += dal__align(run->kind->engine->bytes(layout));
    if (quad_bytes(layout) > 0) {
        dal__quad_place(&run->quad, layout, at);
        run->storage = run->quad.persistent;
    }
    return run;
}

dal_status dal_run_init(dal_run **run, void *memory, size_t bytes, const dal_run_spec *spec,
                        dal_error *error)
{
    DAL_REQUIRE(run, error);
    dal__layout layout;
    *run = NULL;
    DAL_REQUIRE(memory, error);
    DAL_TRY(dal__layout_init(&layout, spec, error));
    if (bytes < total_bytes(&layout))
        return dal__fail(error, DAL_MEMORY, "a run of %s needs %zu bytes, not %zu",
                         layout.system->name ? layout.system->name : "this system",
                         total_bytes(&layout), bytes);
    dal_run *made = place(&layout, memory);
    DAL_TRY(dal__run_start(made, spec->parameters, spec->parameter_count, spec->start,
                           spec->start_count, NULL, error));
    if (made->quad.engine) dal__quad_push(&made->quad, made->persistent, 0);
    DAL_TRY(dal__check_events(made, error));
    *run = made;
    return DAL_OK;
}

dal_status dal_run_create(dal_run **run, const dal_run_spec *spec, dal_error *error)
{
    DAL_REQUIRE(run, error);
    dal__layout layout;
    *run = NULL;
    DAL_TRY(dal__layout_init(&layout, spec, error));
    const size_t bytes = total_bytes(&layout);
    void *memory = malloc(bytes);
    if (!memory) return dal__fail(error, DAL_MEMORY, "no %zu bytes for a run", bytes);
    const dal_status status = dal_run_init(run, memory, bytes, spec, error);
    if (status == DAL_OK)
        (*run)->owned = memory;
    else
        free(memory);
    return status;
}

void dal_run_free(dal_run *run)
{
    if (!run) return;
    dal__native_free(&run->native);
    dal__native_free(&run->observations.code);
    free(run->observations.states);
    free(run->owned);
}

void dal__run_hold(dal_run *run, const double *point)
{
    run->kind->engine->hold(run->engine, point);
    if (run->quad.engine) dal__quad_hold(&run->quad, point);
    run->is_held = point != NULL;
}

dal_status dal__step_run(dal_run *run, double h, long long count)
{
    dal_status status = DAL_OK;
    if (run->native.traced && !run->is_held) {
        unsigned failed = 0;
        int reason = DAL_OK;
        run->native.traced(run->persistent, run->work, h, count, &failed, &reason, NULL, 0);
        return failed ? (dal_status)reason : DAL_OK;
    }
    if (run->quad.engine) {
        for (long long i = 0; i < count && status == DAL_OK; i++)
            status = dal__quad_step(&run->quad, h);
        dal__quad_pull(&run->quad, run->persistent);
        return status;
    }
    for (long long i = 0; i < count; i++)
        if (run->kind->engine->step(run->engine, h, 1u, &status)) return status;
    return DAL_OK;
}

dal_status dal__step_part(dal_run *run, double h, double part)
{
    dal_status status = DAL_OK;
    if (run->layout.options.tolerance == 0.0 || part == h) return dal__step_run(run, part, 1);
    if (!run->quad.engine) {
        run->kind->engine->step_part(run->engine, h, part, &status);
        return status;
    }
    status = dal__quad_step_part(&run->quad, h, part);
    dal__quad_pull(&run->quad, run->persistent);
    return status;
}

dal_status dal_run_advance(dal_run *run, long long count, dal_error *error)
{
    DAL_REQUIRE(run, error);
    const double h = run->layout.options.step;
    if (count < 0) return dal__fail(error, DAL_ARGUMENT, "%lld steps: a run goes forward", count);
    if (run->layout.system->events > 0) return dal__advance_events(run, count, NULL, error);
    const dal_status status = dal__step_run(run, h, count);
    return status == DAL_OK ? DAL_OK : dal__failure_reason(run, h, status, error);
}

dal_status dal_run_step(dal_run *run, dal_error *error) { return dal_run_advance(run, 1, error); }

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
            return dal__fail(error, DAL_NOT_FINITE, "state component %d is not finite: %g", i + 1,
                             state[i]);
    if (!isfinite(t)) return dal__fail(error, DAL_NOT_FINITE, "time %g is not finite", t);
    memset(run->persistent, 0, dal__at_changed(k) * sizeof *run->persistent);
    memset(run->persistent + dal__at_events(k), 0, k->event_memory * sizeof *run->persistent);
    for (int i = 0; i < k->dim; i++) run->persistent[i] = state[i] + 0.0;
    run->persistent[dal__at(k, DAL__TIME)] = t;
    if (run->quad.engine) dal__quad_push(&run->quad, run->persistent, 0);
    return DAL_OK;
}

dal_status dal__run_prepare(dal_run *run)
{
    const dal__layout *k = &run->layout;
    const dal_point at = dal__here(run);
    if (k->system->prepare) DAL_TRY(k->system->prepare(k->system, &at, NULL));
    if (!run->quad.engine) return DAL_OK;
    dal__quad_push(&run->quad, run->persistent, k->persistent);
    return dal__quad_prepare(&run->quad, dal_run_time(run));
}

const double *dal_run_save(const dal_run *run, size_t *count)
{
    if (count) *count = run ? run->stored : 0;
    return run && count ? run->storage : NULL;
}

dal_status dal__run_load(dal_run *run, const double *saved)
{
    const size_t count = dal__saved_count(&run->layout), width = run->stored / count;
    const size_t first = run->layout.persistent * width, bytes = sizeof *saved;
    const bool same =
        memcmp(run->storage + first, saved + first, (run->stored - first) * bytes) == 0;
    memcpy(run->storage, saved, run->stored * bytes);
    if (run->quad.engine) dal__quad_pull(&run->quad, run->persistent);
    return same ? DAL_OK : dal__run_prepare(run);
}

dal_status dal_run_restore(dal_run *run, const double *memory, size_t count, dal_error *error)
{
    DAL_REQUIRE(run, error);
    DAL_REQUIRE(memory, error);
    if (count != run->stored)
        return dal__fail(error, DAL_ARGUMENT,
                         "the persistent state of this run has %zu numbers, not %zu", run->stored,
                         count);
    DAL_TRY(dal__check_saved(run, memory, error));
    dal__run_back_up(run);
    const dal_status status = dal__run_load(run, memory);
    if (status == DAL_OK) return DAL_OK;
    dal__run_revert(run);
    return dal__fail(error, status, "the system cannot be prepared with the saved parameters");
}

void dal__run_back_up(dal_run *run)
{
    memcpy(run->shadow, run->storage, run->stored * sizeof *run->storage);
}

void dal__run_revert(dal_run *run) { dal__run_load(run, run->shadow); }
