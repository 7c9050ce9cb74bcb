/* create.c - makes runs: one system, one method, one block of memory. */
#include "run/event_search.h"
#include "run/events.h"
#include "run/scales.h"
#include "run/start.h"
#include <stdlib.h>

/* Whether a run of the layout has an engine in quad precision. */
#define HAS_QUAD(layout) (DAL__HAS_QUAD && (layout)->options.precision == DAL_QUAD)

/* Doubles in a checkpoint. */
static size_t stored_count(const dal__layout *k)
{
    const size_t count = dal__saved_count(k);
    return HAS_QUAD(k) ? count * dal__quad_width() : count;
}

/* Doubles beside the engines' own. */
static size_t own_numbers(const dal__layout *k)
{
    const size_t time_and_observables =
        1 + (size_t)k->m + 6 + (size_t)(k->system->invariants + k->system->holonomic);
    const size_t reactions = k->options.reactions ? (size_t)(k->n + 2 * k->m) : 0;
    return stored_count(k) + (size_t)(k->n + k->nw) + dal__event_scratch(k, stored_count(k)) +
           time_and_observables + reactions + dal__scale_numbers(k);
}

static size_t total_bytes(const dal__layout *k)
{
    return 64 + dal__align(sizeof(dal_run)) + dal__align(own_numbers(k) * sizeof(double)) +
           dal__align(dal__engine_best(k, 1)->engine->bytes(k)) +
           (HAS_QUAD(k) ? dal__quad_bytes(k) : 0);
}

size_t dal_run_size(const dal_run_spec *spec)
{
    dal__layout layout;
    return dal__layout_init(&layout, spec, NULL) == DAL_STATUS_OK ? total_bytes(&layout) : 0;
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
    run->matrices = run->scratch;
    run->storage = run->persistent;
    run->stored = stored_count(layout);
    at += dal__align(run->kind->engine->bytes(layout));
    if (HAS_QUAD(layout)) {
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
        return dal__fail(error, DAL_STATUS_MEMORY, "a run of %s needs %zu bytes, not %zu",
                         layout.system->name ? layout.system->name : "this system",
                         total_bytes(&layout), bytes);
    dal_run *made = place(&layout, memory);
    DAL_TRY(dal__run_start(made, spec->parameters, spec->parameter_count, spec->start,
                           spec->start_count, NULL, error));
    if (DAL__IS_QUAD(made)) dal__quad_push(&made->quad, made->persistent, 0);
    DAL_TRY(dal__check_events(made, error));
    *run = made;
    return DAL_STATUS_OK;
}

dal_status dal_run_create(dal_run **run, const dal_run_spec *spec, dal_error *error)
{
    DAL_REQUIRE(run, error);
    dal__layout layout;
    *run = NULL;
    DAL_TRY(dal__layout_init(&layout, spec, error));
    const size_t bytes = total_bytes(&layout);
    void *memory = malloc(bytes);
    if (!memory) return dal__fail(error, DAL_STATUS_MEMORY, "no %zu bytes for a run", bytes);
    const dal_status status = dal_run_init(run, memory, bytes, spec, error);
    if (status == DAL_STATUS_OK)
        (*run)->owned = memory;
    else
        free(memory);
    return status;
}

void dal_run_free(dal_run *run)
{
    if (!run) return;
    dal__compiled_free(&run->native);
    dal__compiled_free(&run->observations.code);
    free(run->observations.states);
    free(run->owned);
}
