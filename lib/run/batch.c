/* batch.c - many runs of one spec, stepped several lanes at a time.
 *
 * A scalar run makes the starts and explains failures.  Groups of lanes are stepped together: as
 * many of the widest engine as the count fills, then narrower ones.  Where a system or an
 * integrator has no wide variants a group has one lane; the bits are the same. */
#include "run/batch.h"
#include "dalembert_codegen.h"
#include "run/failure.h"
#include "run/start.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The widths of groups, the widest first. */
static const int widths[] = {8, 4, 1};
enum { WIDTHS = sizeof widths / sizeof *widths };
typedef struct engine_choice {
    const dal__engine_kind *kind[WIDTHS];
    int count;
} engine_choice;

typedef struct group {
    const dal__engine_kind *kind;
    int first; /* lane 0 of the group is this lane of the batch */
    void *engine;
    double *persistent, *work;
    dal__lanes alive;
} group;

struct dal_batch {
    dal_run *scalar;
    int count, groups;
    bool stepped;     /* lanes share their time: none may be started again */
    group *group;     /* [groups] */
    dal_error *error; /* [count] */
    void *memory;     /* of the engines */
    dal__native_code native;
};

/* ---- choice of the engines ---- */

/* The best engines up to a width (0: all). */
static engine_choice choose(const dal__layout *k, int width)
{
    engine_choice made = {{NULL}, 0};
    for (int i = 0; i < WIDTHS; i++) {
        const dal__engine_kind *best = dal__engine_best(k, widths[i]);
        if (best && (width == 0 || widths[i] <= width)) made.kind[made.count++] = best;
    }
    return made;
}

/* The engine of the next group: the widest that the remaining lanes fill by more than half. */
static const dal__engine_kind *next_kind(const engine_choice *from, int remaining)
{
    int i = 0;
    while (i < from->count - 1 && remaining <= from->kind[i]->width / 2) i++;
    return from->kind[i];
}

/* Groups before that of a lane are at most as many as the widest would be. */
static group *group_of(const dal_batch *batch, int lane)
{
    group *b = &batch->group[lane / batch->group[0].kind->width];
    while (lane >= b->first + b->kind->width) b++;
    return b;
}

/* ---- memory ---- */

static void scatter(double *wide, const double *single, size_t numbers, int width, int lane)
{
    for (size_t i = 0; i < numbers; i++) wide[i * (size_t)width + (size_t)lane] = single[i];
}

static void gather(double *single, const double *wide, size_t numbers, int width, int lane)
{
    for (size_t i = 0; i < numbers; i++) single[i] = wide[i * (size_t)width + (size_t)lane];
}

/* Copies start and parameters of the scalar run to one lane of a group. */
static void scatter_lane(dal_batch *batch, const group *b, int lane)
{
    const dal__layout *k = &batch->scalar->layout;
    scatter(b->persistent, batch->scalar->persistent, k->persistent, b->kind->width, lane);
    scatter(b->work, batch->scalar->work, k->workspace, b->kind->width, lane);
}

static void gather_lane(dal_batch *batch, const group *b, int lane)
{
    const dal__layout *k = &batch->scalar->layout;
    gather(batch->scalar->persistent, b->persistent, k->persistent, b->kind->width, lane);
    gather(batch->scalar->work, b->work, k->workspace, b->kind->width, lane);
}

enum { ALIGNMENT = DAL__MAX_LANES * sizeof(double) };

/* Lanes past the count are copies of the start. */
static void place_group(dal_batch *batch, group *b, const dal__engine_kind *kind, int first,
                        void *memory)
{
    *b = (group){.kind = kind, .first = first};
    b->engine = kind->engine->place(&batch->scalar->layout, memory, &b->persistent, &b->work, NULL);
    for (int lane = 0; lane < kind->width; lane++) {
        scatter_lane(batch, b, lane);
        if (first + lane < batch->count) b->alive |= (dal__lanes)1 << lane;
    }
}

/* Counts groups and bytes of their engines, and places them unless memory is NULL; false: too many
 * bytes. */
static bool place_groups(dal_batch *batch, const engine_choice *from, char *memory, size_t *bytes)
{
    *bytes = 0;
    batch->groups = 0;
    for (int left = batch->count; left > 0; batch->groups++) {
        const dal__engine_kind *kind = next_kind(from, left);
        const size_t more = dal__align(kind->engine->bytes(&batch->scalar->layout));
        if (more > SIZE_MAX / 2 - *bytes) return false;
        if (memory)
            place_group(batch, &batch->group[batch->groups], kind, batch->count - left,
                        memory + *bytes);
        *bytes += more;
        left -= kind->width;
    }
    return true;
}

static dal_status allocate(dal_batch *batch, const engine_choice *from, dal_error *error)
{
    size_t bytes;
    if (place_groups(batch, from, NULL, &bytes)) {
        batch->group = calloc((size_t)batch->groups, sizeof *batch->group);
        batch->error = calloc((size_t)batch->count, sizeof *batch->error);
        batch->memory = malloc(bytes + ALIGNMENT);
    }
    if (!batch->group || !batch->error || !batch->memory)
        return dal__fail(error, DAL_MEMORY, "no memory for a batch of %d", batch->count);
    char *aligned = (char *)batch->memory + (ALIGNMENT - (uintptr_t)batch->memory % ALIGNMENT);
    place_groups(batch, from, aligned, &bytes);
    return DAL_OK;
}

dal_status dal__batch_of_variant(dal_batch **batch, const dal_run_spec *spec, int count, int width,
                                 dal__variant only, dal_error *error)
{
    dal_batch *made = calloc(1, sizeof *made);
    *batch = NULL;
    if (!made) return dal__fail(error, DAL_MEMORY, "no memory for a batch");
    dal_status status = dal_run_create(&made->scalar, spec, error);
    if (status == DAL_OK && only != DAL__VARIANTS && !dal__engine_can(&made->scalar->layout, only))
        status = dal__fail(error, DAL_UNSUPPORTED, "variant %d cannot run here", (int)only);
    if (status == DAL_OK) {
        const engine_choice one = {{&dal__engine_kinds[only % DAL__VARIANTS]}, 1};
        const engine_choice from =
            only == DAL__VARIANTS ? choose(&made->scalar->layout, width) : one;
        made->count = count;
        status = allocate(made, &from, error);
    }
    if (status == DAL_OK)
        *batch = made;
    else
        dal_batch_free(made);
    return status;
}

dal_status dal_batch_create(dal_batch **batch, const dal_run_spec *spec, int count, int width,
                            dal_error *error)
{
    DAL_REQUIRE(batch, error);
    *batch = NULL;
    DAL_TRY(dal__check_spec(spec, error));
    if (count < 1) return dal__fail(error, DAL_ARGUMENT, "a batch of %d runs is empty", count);
    bool known = width == 0;
    for (int i = 0; i < WIDTHS; i++) known |= width == widths[i];
    if (!known) return dal__fail(error, DAL_ARGUMENT, "width %d is not 0, 1, 4 or 8", width);
    if (spec->options.precision != DAL_DOUBLE)
        return dal__fail(error, DAL_UNSUPPORTED, "a batch has no lanes in quad precision");
    DAL_TRY(dal__refuse_events(spec->system, "batches", error));
    return dal__batch_of_variant(batch, spec, count, width, DAL__VARIANTS, error);
}

static void free_groups(dal_batch *batch)
{
    free(batch->group);
    free(batch->error);
    free(batch->memory);
}

void dal_batch_free(dal_batch *batch)
{
    if (!batch) return;
    dal_run_free(batch->scalar);
    dal__native_free(&batch->native);
    free_groups(batch);
    free(batch);
}

/* ---- compiled steps ---- */

const dal__layout *dal__batch_layout(const dal_batch *batch) { return &batch->scalar->layout; }

/* A full register, or less for few lanes: surplus lanes cost almost nothing, and code for other
 * numbers of lanes would have to be compiled as well. */
int dal__batch_native_lanes(const dal_batch *batch)
{
    const dal__layout *k = &batch->scalar->layout;
    if (batch->count == 1 || !dal__engine_best(k, 4)) return 1;
    return batch->count > 4 && dal__engine_best(k, 8) ? 8 : 4;
}

/* Copies the lanes of a batch to the groups of another. */
static void move_lanes(dal_batch *from, dal_batch *to)
{
    for (int lane = 0; lane < from->count; lane++) {
        group *a = group_of(from, lane), *b = group_of(to, lane);
        gather_lane(from, a, lane - a->first);
        scatter_lane(to, b, lane - b->first);
        to->error[lane] = from->error[lane];
        if (to->error[lane].status != DAL_OK) b->alive &= ~((dal__lanes)1 << (lane - b->first));
    }
}

dal_status dal__batch_install(dal_batch *batch, int lanes, const dal__native_code *native,
                              dal_error *error)
{
    const engine_choice one = {{dal__engine_best(&batch->scalar->layout, lanes)}, 1};
    dal_batch made = {.scalar = batch->scalar, .count = batch->count, .stepped = batch->stepped};
    const dal_status status = allocate(&made, &one, error);
    if (status != DAL_OK) {
        free_groups(&made);
        return status;
    }
    move_lanes(batch, &made);
    free_groups(batch);
    *batch = made;
    batch->native = *native;
    return DAL_OK;
}

int dal_batch_is_native(const dal_batch *batch) { return batch && batch->native.steps != NULL; }

/* ---- use ---- */

dal_status dal_batch_start(dal_batch *batch, int lane, const dal_setting *parameters,
                           int parameter_count, const dal_setting *start, int start_count,
                           dal_error *error)
{
    DAL_REQUIRE(batch, error);
    if (lane < 0 || lane >= batch->count)
        return dal__fail(error, DAL_ARGUMENT, "lane %d of %d does not exist", lane, batch->count);
    if (batch->stepped)
        return dal__fail(error, DAL_ARGUMENT,
                         "lane %d cannot be started again: its batch has been stepped", lane);
    DAL_TRY(dal__check_settings(parameters, parameter_count, "parameters", error));
    DAL_TRY(dal__check_settings(start, start_count, "start values", error));
    DAL_TRY(dal__run_start(batch->scalar, parameters, parameter_count, start, start_count, error));
    const group *b = group_of(batch, lane);
    scatter_lane(batch, b, lane - b->first);
    return DAL_OK;
}

dal_status dal_batch_set_parameter(dal_batch *batch, int lane, const char *name, double value,
                                   dal_error *error)
{
    DAL_REQUIRE(batch, error);
    DAL_TRY(dal_batch_status(batch, lane, error));
    const group *b = group_of(batch, lane);
    gather_lane(batch, b, lane - b->first);
    const dal_status status = dal_run_set_parameter(batch->scalar, name, value, error);
    if (status == DAL_OK || status == DAL_INCONSISTENT) scatter_lane(batch, b, lane - b->first);
    return status;
}

/* The scalar run repeats the failing step, to say reason. */
static void record_failures(dal_batch *batch, group *b, dal__lanes failed, const dal_status *reason)
{
    for (int lane = 0; lane < b->kind->width; lane++) {
        if (!(failed >> lane & 1)) continue;
        gather_lane(batch, b, lane);
        dal__failure_reason(batch->scalar, batch->scalar->layout.options.step, reason[lane],
                            &batch->error[b->first + lane]);
    }
    b->alive &= ~failed;
}

/* Takes up to count steps of a group, until a lane fails; returns the number of steps tried. */
static long long step_group(dal_batch *batch, group *b, double h, long long count,
                            dal__lanes *failed, dal_status *reason)
{
    unsigned lanes = 0;
    int reasons[DAL__MAX_LANES];
    if (batch->native.steps) {
        count = batch->native.steps(b->persistent, b->work, h, count, (unsigned)b->alive, &lanes,
                                    reasons);
        for (int i = 0; i < b->kind->width; i++)
            if (lanes >> i & 1) reason[i] = (dal_status)reasons[i];
        *failed = lanes;
        return count;
    }
    for (long long step = 1; step <= count; step++)
        if ((*failed = b->kind->engine->step(b->engine, h, b->alive, reason)) != 0) return step;
    return count;
}

dal_status dal_batch_advance(dal_batch *batch, long long count)
{
    DAL_REQUIRE(batch, NULL);
    DAL_REQUIRE_COUNT(count, NULL);
    const double h = batch->scalar->layout.options.step;
    dal_status reason[DAL__MAX_LANES] = {DAL_OK}, last = DAL_OK;
    dal__lanes failed = 0;
    bool alive = false;
    batch->stepped = batch->stepped || count > 0;
    for (int i = 0; i < batch->groups; i++) {
        group *b = &batch->group[i];
        for (long long left = count; left > 0 && b->alive;) {
            left -= step_group(batch, b, h, left, &failed, reason);
            if (failed) record_failures(batch, b, failed, reason);
        }
        alive |= b->alive != 0;
        if (!b->alive) last = batch->error[b->first].status;
    }
    return alive ? DAL_OK : last;
}

int dal_batch_count(const dal_batch *batch) { return batch ? batch->count : 0; }

dal_status dal_batch_status(const dal_batch *batch, int lane, dal_error *error)
{
    DAL_REQUIRE(batch, error);
    if (lane < 0 || lane >= batch->count)
        return dal__fail(error, DAL_ARGUMENT, "lane %d of %d does not exist", lane, batch->count);
    if (error) *error = batch->error[lane];
    return batch->error[lane].status;
}

double dal_batch_time(const dal_batch *batch, int lane)
{
    if (!batch || lane < 0 || lane >= batch->count) return NAN;
    const size_t place = dal__at(&batch->scalar->layout, DAL__TIME);
    const group *b = group_of(batch, lane);
    return b->persistent[place * (size_t)b->kind->width + (size_t)(lane - b->first)];
}

void dal_batch_state(const dal_batch *batch, int lane, double *state)
{
    if (!batch || !state || lane < 0 || lane >= batch->count) return;
    const group *b = group_of(batch, lane);
    gather(state, b->persistent, (size_t)batch->scalar->layout.dim, b->kind->width,
           lane - b->first);
}

void dal_batch_states(const dal_batch *batch, double *states)
{
    const size_t dimension = batch ? (size_t)batch->scalar->layout.dim : 0;
    for (int lane = 0; states && lane < dal_batch_count(batch); lane++)
        dal_batch_state(batch, lane, states + (size_t)lane * dimension);
}
