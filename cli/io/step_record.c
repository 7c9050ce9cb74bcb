/* step_record.c - the ranges of coordinates along a run, and its last steps. */
#include "step_record.h"
#include "ui/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS, LENGTH, BLOCKS };

static const double max_steps = 0x1p53;

static size_t block_size(const step_record *r) { return 2 * (size_t)r->coordinates + 1; }

static double *block_at(const step_record *r, long long block)
{
    return r->number + BLOCKS + (size_t)block * block_size(r);
}

static double *column_at(const step_record *r, int column)
{
    return block_at(r, RECORD_BLOCKS) + (size_t)column * RECORD_STEPS;
}

step_record record_of(int coordinates, int state, int observables)
{
    step_record r = {.coordinates = coordinates, .state = state, .observables = observables};
    r.count =
        BLOCKS + RECORD_BLOCKS * block_size(&r) + (size_t)(1 + state + observables) * RECORD_STEPS;
    return r;
}

void record_allocate(step_record *r)
{
    r->number = cli_calloc(r->count, sizeof *r->number);
    r->number[LENGTH] = 1.0;
}

void record_free(step_record *r)
{
    free(r->number);
    r->number = NULL;
}

long long record_steps_added(const step_record *r) { return (long long)r->number[STEPS]; }

/* ---- blocks -------------------------------------------------------------------------------- */

int record_blocks(const step_record *r) { return (int)ceil(r->number[STEPS] / r->number[LENGTH]); }

step_block record_block(const step_record *r, int block)
{
    const double *at = block_at(r, block);
    return (step_block){at[2 * r->coordinates], at, at + r->coordinates};
}

/* Each two neighbours become one. */
static void halve_blocks(const step_record *r)
{
    const int n = r->coordinates;
    for (int b = 0; b < RECORD_BLOCKS / 2; b++) {
        double *at = block_at(r, b);
        const double *one = block_at(r, 2 * b), *two = block_at(r, 2 * b + 1);
        const double from = one[2 * n];
        for (int i = 0; i < n; i++) {
            const double low = fmin(one[i], two[i]), high = fmax(one[n + i], two[n + i]);
            at[i] = low;
            at[n + i] = high;
        }
        at[2 * n] = from;
    }
    r->number[LENGTH] *= 2.0;
}

/* Widens a range by values that follow each other; NaN is left out. */
static void widen(double *low, double *high, const double *x, int count)
{
    double min = *low, max = *high;
    for (int k = 0; k < count; k++) {
        min = x[k] < min ? x[k] : min;
        max = x[k] > max ? x[k] : max;
    }
    *low = min;
    *high = max;
}

/* ---- steps --------------------------------------------------------------------------------- */

/* Adds steps that lie in one block and do not pass the end of the columns. */
static void add_within(const step_record *r, const record_steps *s, int first, int count)
{
    const int n = r->coordinates;
    const long long before = record_steps_added(r), length = (long long)r->number[LENGTH];
    const long long place = before % RECORD_STEPS;
    const size_t bytes = (size_t)count * sizeof(double);
    double *block = block_at(r, before / length);
    for (int i = 0; i < n && before % length == 0; i++) {
        block[i] = INFINITY;
        block[n + i] = -INFINITY;
    }
    if (before % length == 0) block[2 * n] = s->t[first];
    memcpy(column_at(r, 0) + place, s->t + first, bytes);
    for (int i = 0; i < r->state; i++) {
        const double *x = s->states + (size_t)i * s->state_stride + first;
        memcpy(column_at(r, 1 + i) + place, x, bytes);
        if (i < n) widen(&block[i], &block[n + i], x, count);
    }
    for (int i = 0; i < r->observables; i++)
        memcpy(column_at(r, 1 + r->state + i) + place, s->values + (size_t)i * s->stride + first,
               bytes);
    r->number[STEPS] += count;
}

void record_add(step_record *r, const record_steps *s)
{
    for (long long first = 0, count; r->number && first < s->count; first += count) {
        const long long before = record_steps_added(r);
        if (before == RECORD_BLOCKS * (long long)r->number[LENGTH]) halve_blocks(r);
        const long long length = (long long)r->number[LENGTH];
        const long long of_block = length - before % length;
        const long long of_columns = RECORD_STEPS - before % RECORD_STEPS;
        count = of_block < of_columns ? of_block : of_columns;
        if (s->count - first < count) count = s->count - first;
        add_within(r, s, (int)first, (int)count);
    }
}

int record_last_steps(const step_record *r)
{
    return r->number[STEPS] < RECORD_STEPS ? (int)r->number[STEPS] : RECORD_STEPS;
}

double record_value(const step_record *r, int column, int k)
{
    const long long first = record_steps_added(r) - record_last_steps(r);
    return column_at(r, column)[(first + k) % RECORD_STEPS];
}

bool record_is_sound(const step_record *r)
{
    const double steps = r->number[STEPS], length = r->number[LENGTH];
    return steps >= 0.0 && steps <= max_steps && steps == floor(steps) && length >= 1.0 &&
           length <= max_steps && length == floor(length) && steps <= RECORD_BLOCKS * length;
}
