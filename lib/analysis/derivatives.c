/* derivatives.c - derivatives by central differences of order 8, with increments that adapt, and
 * the derivatives that a system returns compared with them.
 *
 *     d/dt f(q,v,t) along the motion = d/ds f(q + s v, v + s F, t + s) at s = 0 */
#include "analysis/derivatives.h"
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

/* ---- derivatives ---- */

/* A callback as a function of one component of (q, v, g), the others held. */
typedef struct comparison {
    dal_evaluator *evaluator;
    const dal_system *s;
    dal_callback *callback; /* that is differentiated */
    int n, nw, m;
    double t;
    double *x;           /* [n + nw] the point */
    double *differences; /* [rows * (n + nw)] row-major */
    double *given, *scratch, *pi;
} comparison;

static dal_status values_of(void *user, double *out)
{
    const comparison *d = user;
    return dal_evaluator_call(d->evaluator, d->callback, d->t, d->x, d->x + d->n, d->pi, out);
}

/* differences[rows*(n+nw)] of a callback's first rows values. */
static dal_status tabulate(comparison *d, dal_callback *callback, int rows)
{
    const int columns = d->n + d->nw;
    double *out = d->scratch + 3 * rows;
    d->callback = callback;
    for (int j = 0; j < columns; j++) {
        const double size = DAL__INCREMENT * fmax(1.0, j < d->n ? 0.0 : fabs(d->x[j]));
        DAL_TRY(dal__differentiate_by(&d->x[j], values_of, d, size, rows, d->scratch, out));
        for (int i = 0; i < rows; i++) d->differences[i * columns + j] = out[i];
    }
    const double size = dal__max_abs(d->differences, (size_t)rows * (size_t)columns);
    return isfinite(size) ? DAL_STATUS_OK : DAL_STATUS_NOT_FINITE;
}

dal_status dal__gradients(dal_evaluator *evaluator, dal_callback *callback, int rows,
                          const dal_point *at, double *differences)
{
    const dal_system *s = dal_evaluator_system(evaluator);
    const int nw = s->n + s->multipliers;
    const size_t width = (size_t)(s->n + nw);
    if (callback == NULL) return DAL_STATUS_UNSUPPORTED;
    double *x = dal__numbers(1, width + 4 * (size_t)rows);
    if (x == NULL) return DAL_STATUS_MEMORY;
    memcpy(x, at->q, (size_t)s->n * sizeof(double));
    memcpy(x + s->n, at->v, (size_t)nw * sizeof(double));
    comparison d = {
        .evaluator = evaluator, .n = s->n, .nw = nw, .t = at->t, .x = x, .scratch = x + width};
    d.differences = differences;
    const dal_status status = tabulate(&d, callback, rows);
    free(x);
    return status;
}

static dal_status call(comparison *d, dal_callback *callback, double *out)
{
    return dal_evaluator_call(d->evaluator, callback, d->t, d->x, d->x + d->n, d->pi, out);
}

/* The block rows*columns at given against columns first.. of the differences. */
static double compare(const comparison *d, const double *given, int rows, int first, int columns)
{
    double max = 0.0;
    for (int i = 0; i < rows; i++) {
        const double *difference = d->differences + i * (d->n + d->nw) + first;
        max = fmax(max, dal__distance(given + i * columns, difference, NULL, (size_t)columns));
    }
    return max;
}

static dal_status compare_jacobian(comparison *d, double *defect)
{
    if (d->s->call.jacobian == NULL) return DAL_STATUS_OK;
    DAL_TRY(call(d, d->s->call.jacobian, d->given));
    *defect = fmax(compare(d, d->given, d->nw, 0, d->n),
                   compare(d, d->given + d->nw * d->n, d->nw, d->n, d->nw));
    return DAL_STATUS_OK;
}

static dal_status compare_adjoint(comparison *d, double *defect)
{
    if (d->s->call.adjoint == NULL) return DAL_STATUS_OK;
    int n = d->n, columns = n + d->nw;
    double *field = d->scratch, *products = d->scratch + d->nw;
    DAL_TRY(call(d, d->s->call.adjoint, d->given));
    DAL_TRY(call(d, d->s->call.field, field));
    for (int j = 0; j < 2 * n; j++) {
        products[j] = 0.0;
        for (int i = 0; i < n; i++) products[j] += d->pi[i] * d->differences[i * columns + j];
    }
    *defect = fmax(dal__distance(d->given, field, NULL, (size_t)n),
                   dal__distance(d->given + n, products, NULL, (size_t)(2 * n)));
    return DAL_STATUS_OK;
}

/* By q and v the derivative of pi.K pi/2 at a fixed pi is the one of K pi times pi/2.  Efforts
 * along the constraints have A K = 0. */
static dal_status compare_effort(comparison *d, dal_derivatives *out)
{
    const int n = d->n, m = d->m, columns = n + d->nw;
    if (d->s->call.effort == NULL) return DAL_STATUS_OK;
    DAL_TRY(tabulate(d, d->s->call.effort, 3 * n));
    DAL_TRY(call(d, d->s->call.effort, d->given));
    double *products = d->scratch;
    for (int j = 0; j < 2 * n; j++) {
        products[j] = 0.0;
        for (int i = 0; i < n; i++) products[j] += 0.5 * d->pi[i] * d->differences[i * columns + j];
    }
    out->effort = dal__distance(d->given + n, products, NULL, (size_t)(2 * n));
    if (d->s->effort < DAL_EFFORT_CONSTRAINT || m == 0 || !d->s->call.constraint)
        return DAL_STATUS_OK;
    const double *A = d->differences + m;
    DAL_TRY(call(d, d->s->call.constraint, d->differences));
    out->effort_constraint = 0.0;
    for (int a = 0; a < m; a++) {
        double sum = 0.0, size = 0.0;
        for (int i = 0; i < n; i++) {
            sum += A[a * n + i] * d->given[i];
            size += fabs(A[a * n + i] * d->given[i]);
        }
        if (size > 0.0) out->effort_constraint = fmax(out->effort_constraint, fabs(sum) / size);
    }
    return DAL_STATUS_OK;
}

static dal_status compare_constraint(comparison *d, dal_derivatives *out)
{
    if (d->m == 0 || d->s->call.constraint == NULL) return DAL_STATUS_OK;
    DAL_TRY(tabulate(d, d->s->constraints, d->m));
    DAL_TRY(call(d, d->s->call.constraint, d->given));
    out->constraint_jacobian = compare(d, d->given + d->m, d->m, d->n, d->n);
    const double *A = d->given + d->m;
    dal__gram_matrix(d->n, d->m, A, A + d->m * d->n, d->scratch);
    const double *gram = d->scratch, size = dal__max_abs(gram, (size_t)d->m * (size_t)d->m);
    double max = 0.0;
    for (int i = 0; i < d->m; i++)
        for (int j = 0; j < i; j++) max = fmax(max, fabs(gram[i * d->m + j] - gram[j * d->m + i]));
    out->gram = size > 0.0 ? max / size : 0.0;
    return DAL_STATUS_OK;
}

static dal_status compare_all(comparison *d, const dal_point *at, dal_derivatives *out)
{
    dal__random random = {1};
    *out = (dal_derivatives){NAN, NAN, NAN, NAN, NAN, NAN};
    memcpy(d->x, at->q, (size_t)d->n * sizeof(double));
    memcpy(d->x + d->n, at->v, (size_t)d->nw * sizeof(double));
    for (int i = 0; i < d->n; i++) d->pi[i] = dal__uniform(&random);
    DAL_TRY(tabulate(d, d->s->call.field, d->nw));
    DAL_TRY(compare_jacobian(d, &out->jacobian));
    DAL_TRY(compare_adjoint(d, &out->adjoint));
    DAL_TRY(compare_effort(d, out));
    return compare_constraint(d, out);
}

dal_status dal_evaluator_check_derivatives(dal_evaluator *evaluator, const dal_point *at,
                                           dal_derivatives *out)
{
    DAL_REQUIRE(evaluator && dal__has_state(at) && out, NULL);
    const dal_system *s = dal_evaluator_system(evaluator);
    size_t n = (size_t)s->n, nw = n + (size_t)s->multipliers, m = (size_t)s->m;
    size_t rows = m > 3 * n ? m : 3 * n, columns = n + nw;
    if (rows < nw) rows = nw;
    size_t given = nw * columns + m * (1 + 2 * n) + 3 * n;
    size_t scratch = 4 * rows + 3 * columns + m * m;
    double *block = dal__numbers(1, columns + rows * columns + given + scratch + n);
    if (block == NULL) return DAL_STATUS_MEMORY;
    double *differences = block + columns, *values = differences + rows * columns;
    comparison d = {.evaluator = evaluator,
                    .s = s,
                    .n = s->n,
                    .nw = s->n + s->multipliers,
                    .m = s->m,
                    .t = at->t,
                    .x = block,
                    .differences = differences,
                    .given = values,
                    .scratch = values + given,
                    .pi = values + given + scratch};
    dal_status status = compare_all(&d, at, out);
    free(block);
    return status;
}
