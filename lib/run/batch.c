/* batch.c - many runs of one spec, stepped several lanes at a time.
 *
 * A scalar run makes the starts and explains failures.  Groups of lanes are stepped together: as
 * many of the widest engine as the count fills, then narrower ones.  Where a system or an
 * integrator has no wide variants a group has one lane; the bits are the same.
 *
 * A group has the numbers that pass from one step to the next, and no more.  Interpreted, they are
 * copied to the one engine of their width, which has the scratch, and back after a block of steps;
 * compiled steps change them in place:
 *
 *     engines   one of each width | groups   persistent state | workspace, interleaved by lanes */
#include "run/batch.h"
#include "core/settings.h"
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

/* The engine of all groups of one width. */
typedef struct lane_engine {
    void *engine;
    double *persistent; /* its own, and after it the workspace */
} lane_engine;

typedef struct group {
    const dal__engine_kind *kind;
    lane_engine *engine;
    int first; /* lane 0 of the group is this lane of the batch */
    double *persistent, *work;
    dal__lanes alive;
} group;

struct dal_batch {
    dal_run *scalar;
    int count, groups;
    bool stepped;     /* lanes share their time: none may be started again */
    group *group;     /* [groups] */
    dal_error *error; /* [count] */
    void *memory;     /* of the engines and the groups */
    lane_engine engine[WIDTHS];
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

/* The number of the engine of the next group: the widest that the remaining lanes fill by more than
 * half. */
static int next_kind(const engine_choice *from, int remaining)
{
    int i = 0;
    while (i < from->count - 1 && remaining <= from->kind[i]->width / 2) i++;
    return i;
}

/* Groups before a lane's own are at most as many as the widest would be. */
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

static size_t group_numbers(const dal__layout *k, const dal__engine_kind *kind)
{
    return (k->persistent + k->workspace) * (size_t)kind->width;
}

/* All lanes of a group begin as copies of the start. */
static void place_group(dal_batch *batch, group *b, int lanes, double *memory)
{
    const dal__layout *k = &batch->scalar->layout;
    const size_t width = (size_t)b->kind->width;
    b->persistent = memory;
    b->work = memory + k->persistent * width;
    b->alive = ((dal__lanes)1 << lanes) - 1;
    for (size_t i = 0; i < k->persistent * width; i++)
        b->persistent[i] = batch->scalar->persistent[i / width];
    for (size_t i = 0; i < k->workspace * width; i++) b->work[i] = batch->scalar->work[i / width];
}

/* Places the engines in memory and counts their bytes; NULL: counts them alone. */
static size_t place_engines(dal_batch *batch, const engine_choice *from, char *memory)
{
    const dal__layout *k = &batch->scalar->layout;
    size_t bytes = 0;
    double *work;
    for (int i = 0; i < from->count; i++) {
        const dal__engine *engine = from->kind[i]->engine;
        lane_engine *e = &batch->engine[i];
        if (memory) e->engine = engine->place(k, memory + bytes, &e->persistent, &work, NULL);
        bytes += dal__align(engine->bytes(k));
    }
    return bytes;
}

/* Counts groups and bytes of their numbers, and places them unless memory is NULL; false: too many
 * bytes. */
static bool place_groups(dal_batch *batch, const engine_choice *from, char *memory, size_t *bytes)
{
    *bytes = 0;
    batch->groups = 0;
    for (int rest = batch->count; rest > 0; batch->groups++) {
        const int choice = next_kind(from, rest), width = from->kind[choice]->width;
        const size_t more =
            dal__align(sizeof(double) * group_numbers(&batch->scalar->layout, from->kind[choice]));
        if (more > SIZE_MAX / 4 - *bytes) return false;
        if (memory) {
            group *b = &batch->group[batch->groups];
            *b = (group){.kind = from->kind[choice],
                         .engine = &batch->engine[choice],
                         .first = batch->count - rest};
            place_group(batch, b, rest < width ? rest : width, (double *)(void *)(memory + *bytes));
        }
        *bytes += more;
        rest -= width;
    }
    return true;
}

static dal_status allocate(dal_batch *batch, const engine_choice *from, dal_error *error)
{
    const size_t engines = place_engines(batch, from, NULL);
    size_t bytes;
    if (place_groups(batch, from, NULL, &bytes)) {
        batch->group = calloc((size_t)batch->groups, sizeof *batch->group);
        batch->error = calloc((size_t)batch->count, sizeof *batch->error);
        batch->memory = malloc(engines + bytes + ALIGNMENT);
    }
    if (!batch->group || !batch->error || !batch->memory)
        return dal__fail(error, DAL_STATUS_MEMORY, "no memory for a batch of %d", batch->count);
    char *aligned = (char *)batch->memory + (ALIGNMENT - (uintptr_t)batch->memory % ALIGNMENT);
    place_engines(batch, from, aligned);
    place_groups(batch, from, aligned + engines, &bytes);
    return DAL_STATUS_OK;
}

dal_status dal__batch_of_variant(dal_batch **batch, const dal_run_spec *spec, int count, int width,
                                 dal__variant only, dal_error *error)
{
    dal_batch *made = calloc(1, sizeof *made);
    *batch = NULL;
    if (!made) return dal__fail(error, DAL_STATUS_MEMORY, "no memory for a batch");
    dal_status status = dal_run_create(&made->scalar, spec, error);
    if (status == DAL_STATUS_OK && only != DAL__VARIANTS &&
        !dal__engine_can(&made->scalar->layout, only))
        status = dal__fail(error, DAL_STATUS_UNSUPPORTED, "variant %d cannot run here", (int)only);
    if (status == DAL_STATUS_OK) {
        const engine_choice one = {{&dal__engine_kinds[only % DAL__VARIANTS]}, 1};
        const engine_choice from =
            only == DAL__VARIANTS ? choose(&made->scalar->layout, width) : one;
        made->count = count;
        status = allocate(made, &from, error);
    }
    if (status == DAL_STATUS_OK)
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
    if (count < 1)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "a batch of %d runs is empty", count);
    bool known = width == 0;
    for (int i = 0; i < WIDTHS; i++) known |= width == widths[i];
    if (!known) return dal__fail(error, DAL_STATUS_ARGUMENT, "width %d is not 0, 1, 4 or 8", width);
    if (spec->options.precision != DAL_DOUBLE)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED, "a batch has no lanes in quad precision");
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
    dal__compiled_free(&batch->native);
    free_groups(batch);
    free(batch);
}

/* ---- compiled steps ---- */

const dal__layout *dal__batch_layout(const dal_batch *batch) { return &batch->scalar->layout; }
const dal_run *dal__batch_scalar(const dal_batch *batch) { return batch->scalar; }

/* A full register, or less for few lanes: surplus lanes cost almost nothing, and code for other
 * numbers of lanes would have to be compiled as well. */
int dal__batch_native_lanes(const dal_batch *batch)
{
    const dal__layout *k = &batch->scalar->layout;
    if (batch->count == 1 || !dal__engine_best(k, 4)) return 1;
    return batch->count > 4 && dal__engine_best(k, 8) ? 8 : 4;
}

/* Copies the lanes of a batch to the groups of another, which takes over their errors. */
static void move_lanes(dal_batch *from, dal_batch *to)
{
    for (int lane = 0; lane < from->count; lane++) {
        group *a = group_of(from, lane), *b = group_of(to, lane);
        gather_lane(from, a, lane - a->first);
        scatter_lane(to, b, lane - b->first);
        if (!(a->alive >> (lane - a->first) & 1)) b->alive &= ~((dal__lanes)1 << (lane - b->first));
    }
    dal_error *const errors = to->error;
    to->error = from->error;
    from->error = errors;
}

/* Whether all groups are of a kind that steps that number of lanes. */
static bool has_width(const dal_batch *batch, int lanes)
{
    for (int i = 0; i < batch->groups; i++)
        if (batch->group[i].kind->width != lanes) return false;
    return true;
}

dal_status dal__batch_install(dal_batch *batch, int lanes, const dal__native_code *native,
                              dal_error *error)
{
    const engine_choice one = {{dal__engine_best(&batch->scalar->layout, lanes)}, 1};
    dal_batch made = {.scalar = batch->scalar, .count = batch->count, .stepped = batch->stepped};
    if (!has_width(batch, lanes)) {
        const dal_status status = allocate(&made, &one, error);
        if (status != DAL_STATUS_OK) {
            free_groups(&made);
            return status;
        }
        move_lanes(batch, &made);
        free_groups(batch);
        *batch = made;
        for (int i = 0; i < batch->groups; i++) batch->group[i].engine = batch->engine;
    }
    batch->native = *native;
    return DAL_STATUS_OK;
}

bool dal_batch_is_native(const dal_batch *batch) { return batch && batch->native.steps != NULL; }

/* ---- use ---- */

static dal_status check_lane(const dal_batch *batch, int lane, dal_error *error)
{
    if (lane >= 0 && lane < batch->count) return DAL_STATUS_OK;
    return dal__fail(error, DAL_STATUS_ARGUMENT, "lane %d of %d does not exist", lane,
                     batch->count);
}

dal_status dal_batch_start(dal_batch *batch, int lane, const dal_setting *parameters,
                           int parameter_count, const dal_setting *start, int start_count,
                           dal_error *error)
{
    DAL_REQUIRE(batch, error);
    DAL_TRY(dal__check_settings(parameters, parameter_count, "parameters", error));
    DAL_TRY(dal__check_settings(start, start_count, "start values", error));
    return dal__batch_start_varied(batch, lane, parameters, parameter_count, start, start_count,
                                   NULL, error);
}

dal_status dal__batch_start_varied(dal_batch *batch, int lane, const dal_setting *parameters,
                                   int parameter_count, const dal_setting *start, int start_count,
                                   const double *added, dal_error *error)
{
    DAL_TRY(check_lane(batch, lane, error));
    if (batch->stepped)
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "lane %d cannot be started again: its batch has been stepped", lane);
    DAL_TRY(dal__run_start(batch->scalar, parameters, parameter_count, start, start_count, added,
                           error));
    group *b = group_of(batch, lane);
    scatter_lane(batch, b, lane - b->first);
    b->alive |= (dal__lanes)1 << (lane - b->first);
    return DAL_STATUS_OK;
}

dal_status dal_batch_set_state(dal_batch *batch, int lane, double t, const double *state,
                               dal_error *error)
{
    DAL_REQUIRE(batch, error);
    DAL_REQUIRE(state, error);
    DAL_TRY(check_lane(batch, lane, error));
    DAL_TRY(dal_run_set_state(batch->scalar, t, state, error));
    group *b = group_of(batch, lane);
    scatter(b->persistent, batch->scalar->persistent, batch->scalar->layout.persistent,
            b->kind->width, lane - b->first);
    b->alive |= (dal__lanes)1 << (lane - b->first);
    batch->error[lane].status = DAL_STATUS_OK;
    return DAL_STATUS_OK;
}

void dal__batch_refuse(dal_batch *batch, int lane, const dal_error *reason)
{
    batch->error[lane] = *reason;
}

dal_status dal_batch_clear(dal_batch *batch)
{
    DAL_REQUIRE(batch, NULL);
    for (int i = 0; i < batch->groups; i++) batch->group[i].alive = 0;
    for (int lane = 0; lane < batch->count; lane++)
        if (batch->error[lane].status != DAL_STATUS_OK)
            batch->error[lane] = (dal_error){.status = DAL_STATUS_OK};
    batch->stepped = false;
    return DAL_STATUS_OK;
}

dal_status dal_batch_set_parameter(dal_batch *batch, int lane, const char *name, double value,
                                   dal_error *error)
{
    DAL_REQUIRE(batch, error);
    DAL_TRY(dal_batch_status(batch, lane, error));
    const group *b = group_of(batch, lane);
    gather_lane(batch, b, lane - b->first);
    const dal_status status = dal_run_set_parameter(batch->scalar, name, value, error);
    if (status == DAL_STATUS_OK || status == DAL_STATUS_INCONSISTENT)
        scatter_lane(batch, b, lane - b->first);
    return status;
}

/* The scalar run repeats the failing step, to say why. */
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

/* Whether the lanes of a group must be stepped one by one: engines and compiled steps read the time
 * of one of them. */
static bool has_own_times(const dal_batch *batch, const group *b)
{
    const dal__layout *k = &batch->scalar->layout;
    const size_t width = (size_t)b->kind->width;
    const double *time = b->persistent + dal__at(k, DAL__TIME) * width;
    double first = NAN;
    if (k->system->properties & DAL_AUTONOMOUS && !(k->lifted && k->system->call.gauge))
        return false;
    for (size_t i = 0; i < width; i++) {
        if (!(b->alive >> i & 1)) continue;
        if (isnan(first)) first = time[i];
        if (time[i] != first) return true;
    }
    return false;
}

/* Takes up to count steps of a group, until a lane fails; returns the number of steps tried. */
static long long step_group(dal_batch *batch, group *b, double h, long long count,
                            dal__lanes *failed, dal_status *reason)
{
    unsigned lanes = 0;
    int reasons[DAL__MAX_LANES];
    if (has_own_times(batch, b)) { /* lane by lane in the scalar run */
        *failed = 0;
        for (int lane = 0; lane < b->kind->width; lane++) {
            if (!(b->alive >> lane & 1)) continue;
            gather_lane(batch, b, lane);
            reason[lane] = dal__step_run(batch->scalar, h, count);
            scatter_lane(batch, b, lane);
            if (reason[lane] != DAL_STATUS_OK) *failed |= (dal__lanes)1 << lane;
        }
        return count;
    }
    if (batch->native.steps) {
        count = batch->native.steps(b->persistent, b->work, h, count, (unsigned)b->alive, &lanes,
                                    reasons);
        for (int i = 0; i < b->kind->width; i++)
            if (lanes >> i & 1) reason[i] = (dal_status)reasons[i];
        *failed = lanes;
        return count;
    }
    const size_t bytes = sizeof(double) * group_numbers(&batch->scalar->layout, b->kind);
    long long step = 0;
    memcpy(b->engine->persistent, b->persistent, bytes);
    for (*failed = 0; step < count && *failed == 0; step++)
        *failed = b->kind->engine->step(b->engine->engine, h, b->alive, reason);
    memcpy(b->persistent, b->engine->persistent, bytes);
    return step;
}

dal_status dal_batch_advance(dal_batch *batch, long long count)
{
    DAL_REQUIRE(batch, NULL);
    DAL_REQUIRE_COUNT(count, NULL);
    const double h = batch->scalar->layout.options.step;
    dal_status reason[DAL__MAX_LANES] = {DAL_STATUS_OK}, last = DAL_STATUS_OK;
    dal__lanes failed = 0;
    bool alive = false;
    batch->stepped = batch->stepped || count > 0;
    for (int i = 0; i < batch->groups; i++) {
        group *b = &batch->group[i];
        for (long long rest = count; rest > 0 && b->alive;) {
            rest -= step_group(batch, b, h, rest, &failed, reason);
            if (failed) record_failures(batch, b, failed, reason);
        }
        alive |= b->alive != 0;
        if (!b->alive) last = batch->error[b->first].status;
    }
    return alive ? DAL_STATUS_OK : last;
}

int dal_batch_count(const dal_batch *batch) { return batch ? batch->count : 0; }

dal_status dal_batch_status(const dal_batch *batch, int lane, dal_error *error)
{
    DAL_REQUIRE(batch, error);
    DAL_TRY(check_lane(batch, lane, error));
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
