/* differences.c - derivatives by central differences of order 8, with increments that adapt.
 *
 *     d/dt f(q,v,t) along the motion = d/ds f(q + s v, v + s F, t + s) at s = 0 */
#include "analysis/differences.h"
#include "core/error.h"
#include "core/settings.h"
#include "core/vectors.h"
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* An increment is good where orders 8 and 6 agree to the first of these or to the roundings of the
 * values; two are, where both agree to the second, the error of order 8 then being near 2e-9, and
 * with each other: what oscillates fast may look smooth once. */
static const double close_agreement = 1e-10, agreement = 1e-7, rounding = 2e-14;
/* No power of it is near 1/2: what is periodic does not look smooth twice. */
static const double shortening = 0.37;
enum { ATTEMPTS = 24 };

static const double order_8[4] = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
static const double order_6[4] = {3.0 / 4.0, -3.0 / 20.0, 1.0 / 60.0, 0.0};

/* The derivative by the increment d into out; by how much order 8 and order 6 differ, relative to
 * max(1, |derivative|), and how much of that the roundings of the values may be. */
static dal_status difference(dal__vector_function *curve, void *user, double d, int count,
                             double *scratch, double *out, double *gap, double *noise)
{
    double *lower = scratch + count, size = 0.0;
    for (int i = 0; i < count; i++) out[i] = lower[i] = 0.0;
    for (int k = 4; k >= 1; k--) {
        for (int side = -1; side <= 1; side += 2) {
            DAL_TRY(curve(user, side * k * d, scratch));
            const double weight = side * order_8[k - 1] / d, less = side * order_6[k - 1] / d;
            for (int i = 0; i < count; i++) out[i] += weight * scratch[i];
            for (int i = 0; i < count; i++) lower[i] += less * scratch[i];
            size = fmax(size, dal__max_abs(scratch, (size_t)count));
        }
    }
    *gap = dal__distance(out, lower, NULL, (size_t)count);
    *noise = isfinite(size) ? rounding * size / d : 0.0;
    return DAL_STATUS_OK;
}

dal_status dal__differentiate(dal__vector_function *curve, void *user, double d, int count,
                              double *scratch, double *out)
{
    double *best = scratch + 2 * count, min = INFINITY, gap, noise;
    dal_status failure = DAL_STATUS_OK;
    bool good = false;
    for (int i = 0; i < count; i++) best[i] = NAN;
    for (int k = 0; k < ATTEMPTS && !good; k++, d *= shortening) {
        const dal_status status = difference(curve, user, d, count, scratch, out, &gap, &noise);
        if (status != DAL_STATUS_OK && failure == DAL_STATUS_OK) failure = status;
        if (status != DAL_STATUS_OK) continue;
        good = gap <= fmax(close_agreement, noise) ||
               fmax(fmax(gap, min), dal__distance(best, out, NULL, (size_t)count)) <= agreement;
        if (!(gap < min)) continue;
        min = gap;
        memcpy(best, out, (size_t)count * sizeof(double));
    }
    memcpy(out, best, (size_t)count * sizeof(double));
    return isinf(min) ? failure : DAL_STATUS_OK;
}

typedef struct varied {
    double *x, held;
    dal__values *values;
    void *user;
} varied;

static dal_status vary(void *user, double s, double *out)
{
    const varied *w = user;
    *w->x = w->held + s;
    const dal_status status = w->values(w->user, out);
    *w->x = w->held;
    return status;
}

dal_status dal__differentiate_by(double *x, dal__values *values, void *user, double d, int count,
                                 double *scratch, double *out)
{
    varied w = {x, *x, values, user};
    return dal__differentiate(vary, &w, d, count, scratch, out);
}

/* ---- the rate of a quantity along the motion ---- */

typedef struct flow {
    dal_evaluator *evaluator;
    dal_callback *callback;
    const dal_point *at;
    int n, nw;
    double *field, *q, *v; /* [nw], [n], [nw] */
} flow;

static dal_status along_flow(void *user, double s, double *out)
{
    flow *f = user;
    for (int i = 0; i < f->n; i++) f->q[i] = f->at->q[i] + s * f->at->v[i];
    for (int i = 0; i < f->nw; i++) f->v[i] = f->at->v[i] + s * f->field[i];
    return dal_evaluator_call(f->evaluator, f->callback, f->at->t + s, f->q, f->v, NULL, out);
}

/* memory[n + 2*nw] */
static dal_status find_flow(flow *f, double *memory)
{
    const dal_system *s = dal_evaluator_system(f->evaluator);
    f->n = s->n;
    f->nw = s->n + s->multipliers;
    f->field = memory;
    f->q = memory + f->nw;
    f->v = f->q + f->n;
    const dal_point *at = f->at;
    DAL_TRY(dal_evaluator_call(f->evaluator, s->call.field, at->t, at->q, at->v, NULL, f->field));
    return isfinite(dal__max_abs(f->field, (size_t)f->nw)) &&
                   isfinite(dal__max_abs(at->v, (size_t)f->n))
               ? DAL_STATUS_OK
               : DAL_STATUS_NOT_FINITE;
}

static dal_status rate_in(flow *f, int count, double *scratch, double *out)
{
    double speed = dal__max_abs(f->field, (size_t)f->nw);
    speed = fmax(1.0, fmax(speed, dal__max_abs(f->at->v, (size_t)f->n)));
    DAL_TRY(dal__differentiate(along_flow, f, DAL__INCREMENT / speed, count, scratch, out));
    return isfinite(dal__max_abs(out, (size_t)count)) ? DAL_STATUS_OK : DAL_STATUS_NOT_FINITE;
}

dal_status dal_evaluator_measure_rate(dal_evaluator *evaluator, dal_callback *callback, int count,
                                      const dal_point *at, double *out)
{
    DAL_REQUIRE(evaluator && dal__has_state(at) && out, NULL);
    DAL_REQUIRE_COUNT(count, NULL);
    const dal_system *s = dal_evaluator_system(evaluator);
    const size_t n = (size_t)s->n, nw = n + (size_t)s->multipliers;
    if (callback == NULL) return DAL_STATUS_UNSUPPORTED;
    double *block = dal__numbers(1, n + 2 * nw + 3 * (size_t)count);
    if (block == NULL) return DAL_STATUS_MEMORY;
    flow f = {.evaluator = evaluator, .callback = callback, .at = at};
    dal_status status = find_flow(&f, block);
    if (status == DAL_STATUS_OK) status = rate_in(&f, count, block + n + 2 * nw, out);
    free(block);
    return status;
}

/* One of the values in units of its size, s in units of a time. */
typedef struct scaled_flow {
    flow flow;
    int index;
    double time, size;
    double *values; /* of the callback */
} scaled_flow;

static dal_status along_scaled_flow(void *user, double s, double *out)
{
    scaled_flow *f = user;
    DAL_TRY(along_flow(&f->flow, s * f->time, f->values));
    *out = f->values[f->index] / f->size;
    return DAL_STATUS_OK;
}

dal_status dal__rate_in_units(const dal__rate *of, const dal_point *at, double *rate)
{
    const dal_system *s = dal_evaluator_system(of->evaluator);
    const size_t n = (size_t)s->n, nw = n + (size_t)s->multipliers;
    double *block = dal__numbers(1, n + 2 * nw + 3 + (size_t)of->count), found[2] = {NAN, NAN};
    if (block == NULL) return DAL_STATUS_MEMORY;
    double *scratch = block + n + 2 * nw;
    scaled_flow f = {.flow = {.evaluator = of->evaluator, .callback = of->callback, .at = at},
                     .index = of->index,
                     .time = of->time,
                     .size = 1.0,
                     .values = scratch + 3};
    dal_status status = find_flow(&f.flow, block);
    for (int k = 0; k < 2 && status == DAL_STATUS_OK; k++) /* f may have no value on one side */
        along_scaled_flow(&f, k ? DAL__INCREMENT : -DAL__INCREMENT, &found[k]);
    f.size = fmax(of->size, fmax(fabs(found[0]), fabs(found[1])));
    if (!(f.size > 0.0) || !isfinite(f.size)) f.size = 1.0;
    if (status == DAL_STATUS_OK)
        status = dal__differentiate(along_scaled_flow, &f, DAL__INCREMENT, 1, scratch, rate);
    *rate *= f.size / f.time;
    free(block);
    return status != DAL_STATUS_OK || isfinite(*rate) ? status : DAL_STATUS_NOT_FINITE;
}
