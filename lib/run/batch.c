/* batch.c - many runs of one spec, stepped several lanes at a time.
 *
 * A scalar run makes the starts and explains failures; blocks of width lanes do the steps.  A
 * system or an integrator without the width asked for is stepped one lane at a time: the bits are
 * the same. */
#include "run/run.h"
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef struct block {
    void *engine;
    double *carried, *work;
    unsigned alive;
} block;

struct dal_batch {
    dal_run *scalar;
    int width, count, blocks;
    block *block;     /* [blocks] */
    dal_error *error; /* [count] */
    void *memory;     /* of the engines */
};

/* What differs from width to width. */
typedef struct width_table {
    int width;
    size_t (*bytes)(const dal__shape *shape);
    void *(*place)(const dal__shape *shape, void *memory, double **carried, double **work);
    unsigned (*step)(void *engine, double h, unsigned lanes, dal_status *why);
} width_table;

static const width_table widths[] = {
    {8, dal__engine_bytes_x8, dal__engine_place_x8, dal__engine_step_x8},
    {4, dal__engine_bytes_x4, dal__engine_place_x4, dal__engine_step_x4},
    {1, dal__engine_bytes_x1, dal__engine_place_x1, dal__engine_step_x1},
};

static const width_table *table(int width)
{
    const width_table *k = widths;
    while (k->width != width) k++;
    return k;
}

static bool available(const dal__shape *k, int width)
{
    if (width == 1) return true;
    if (width == 4 ? !k->system->wide4 : !k->system->wide8) return false;
    for (int i = 0; i < k->depth; i++)
        if (!dal__integrator_wide(k->method.chain[i], width)) return false;
    return true;
}

static int choose_width(const dal__shape *k, int width, int count)
{
    if (width == 0) width = count >= 8 ? 8 : count >= 4 ? 4 : 1;
    return available(k, width) ? width : 1;
}

static void spread(double *wide, const double *single, size_t numbers, int width, int lane)
{
    for (size_t i = 0; i < numbers; i++) wide[i * (size_t)width + (size_t)lane] = single[i];
}

static void gather(double *single, const double *wide, size_t numbers, int width, int lane)
{
    for (size_t i = 0; i < numbers; i++) single[i] = wide[i * (size_t)width + (size_t)lane];
}

/* The scalar run's start and parameters into one lane. */
static void put_lane(dal_batch *batch, const block *b, int lane)
{
    const dal__shape *k = &batch->scalar->shape;
    spread(b->carried, batch->scalar->carried, k->carried, batch->width, lane);
    spread(b->work, batch->scalar->work, k->workspace, batch->width, lane);
}

static void get_lane(dal_batch *batch, const block *b, int lane)
{
    const dal__shape *k = &batch->scalar->shape;
    gather(batch->scalar->carried, b->carried, k->carried, batch->width, lane);
    gather(batch->scalar->work, b->work, k->workspace, batch->width, lane);
}

/* Lanes past the count hold a copy of the start, so that they compute nothing unusual. */
static void place_blocks(dal_batch *batch, const width_table *k, size_t bytes)
{
    char *at = (char *)batch->memory + (64 - (uintptr_t)batch->memory % 64) % 64;
    for (int i = 0; i < batch->blocks; i++, at += bytes) {
        block *b = &batch->block[i];
        b->engine = k->place(&batch->scalar->shape, at, &b->carried, &b->work);
        for (int lane = 0; lane < batch->width; lane++) {
            put_lane(batch, b, lane);
            if (i * batch->width + lane < batch->count) b->alive |= 1u << lane;
        }
    }
}

static dal_status allocate(dal_batch *batch, dal_error *error)
{
    const width_table *k = table(batch->width);
    const size_t bytes = (k->bytes(&batch->scalar->shape) + 63) / 64 * 64;
    const size_t blocks = (size_t)batch->blocks;
    if (bytes <= (SIZE_MAX - 64) / blocks) {
        batch->block = calloc(blocks, sizeof *batch->block);
        batch->error = calloc((size_t)batch->count, sizeof *batch->error);
        batch->memory = malloc(bytes * blocks + 64);
    }
    if (!batch->block || !batch->error || !batch->memory)
        return dal__error(error, DAL_MEMORY, 0, 0, "no memory for a batch of %d", batch->count);
    place_blocks(batch, k, bytes);
    return DAL_OK;
}

dal_status dal_batch_create(dal_batch **batch, const dal_run_spec *spec, int count, int width,
                            dal_error *error)
{
    *batch = NULL;
    if (count < 1)
        return dal__error(error, DAL_ARGUMENT, 0, 0, "a batch of %d runs is empty", count);
    if (width != 0 && width != 1 && width != 4 && width != 8)
        return dal__error(error, DAL_ARGUMENT, 0, 0, "width %d is not 0, 1, 4 or 8", width);
    dal_batch *made = calloc(1, sizeof *made);
    if (!made) return dal__error(error, DAL_MEMORY, 0, 0, "no memory for a batch");
    dal_status status = dal_run_create(&made->scalar, spec, error);
    if (status == DAL_OK) {
        made->count = count;
        made->width = choose_width(&made->scalar->shape, width, count);
        made->blocks = (count - 1) / made->width + 1;
        status = allocate(made, error);
    }
    if (status == DAL_OK)
        *batch = made;
    else
        dal_batch_free(made);
    return status;
}

void dal_batch_free(dal_batch *batch)
{
    if (!batch) return;
    dal_run_free(batch->scalar);
    free(batch->block);
    free(batch->error);
    free(batch->memory);
    free(batch);
}

static block *block_of(const dal_batch *batch, int lane)
{
    return &batch->block[lane / batch->width];
}

dal_status dal_batch_start(dal_batch *batch, int lane, const dal_setting *parameters,
                           int parameter_count, const dal_setting *start, int start_count,
                           dal_error *error)
{
    if (lane < 0 || lane >= batch->count)
        return dal__error(error, DAL_ARGUMENT, 0, 0, "lane %d of %d does not exist", lane,
                          batch->count);
    DAL_TRY(dal__run_start(batch->scalar, parameters, parameter_count, start, start_count, error));
    put_lane(batch, block_of(batch, lane), lane % batch->width);
    return DAL_OK;
}

/* The scalar run repeats the failing step, to say why. */
static void record(dal_batch *batch, block *b, int first, unsigned failed, const dal_status *why)
{
    for (int lane = 0; lane < batch->width; lane++) {
        if (!(failed >> lane & 1)) continue;
        get_lane(batch, b, lane);
        dal__explain(batch->scalar, batch->scalar->shape.options.step, why[lane],
                     &batch->error[first + lane]);
    }
    b->alive &= ~failed;
}

dal_status dal_batch_advance(dal_batch *batch, long long count)
{
    const width_table *k = table(batch->width);
    const double h = batch->scalar->shape.options.step;
    dal_status why[8] = {DAL_OK}, last = DAL_OK;
    unsigned alive = 0;
    for (int i = 0; i < batch->blocks; i++) {
        block *b = &batch->block[i];
        for (long long step = 0; step < count && b->alive; step++) {
            const unsigned failed = k->step(b->engine, h, b->alive, why);
            if (failed) record(batch, b, i * batch->width, failed, why);
        }
        alive |= b->alive;
        if (!b->alive) last = batch->error[i * batch->width].status;
    }
    return alive ? DAL_OK : last;
}

int dal_batch_count(const dal_batch *batch) { return batch->count; }

dal_status dal_batch_status(const dal_batch *batch, int lane, dal_error *error)
{
    if (lane < 0 || lane >= batch->count)
        return dal__error(error, DAL_ARGUMENT, 0, 0, "lane %d of %d does not exist", lane,
                          batch->count);
    if (error) *error = batch->error[lane];
    return batch->error[lane].status;
}

double dal_batch_time(const dal_batch *batch, int lane)
{
    double t;
    const size_t place = dal__at(&batch->scalar->shape, DAL__TIME);
    const size_t width = (size_t)batch->width;
    gather(&t, block_of(batch, lane)->carried + place * width, 1, batch->width,
           lane % batch->width);
    return t;
}

void dal_batch_state(const dal_batch *batch, int lane, double *state)
{
    gather(state, block_of(batch, lane)->carried, (size_t)batch->scalar->shape.dim, batch->width,
           lane % batch->width);
}
