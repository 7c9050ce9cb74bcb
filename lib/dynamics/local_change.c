/* local_change.c - what single steps of a method change, each begun on the exact motion.
 *
 *     d_k = D(S_h(x_k)) - D(x_k),     c_k = I(S_h(x_k)) - I(x_k)
 *
 * D(x_k) is rounding alone, and as such is in both; a method that enforces D leaves none of it.
 * The steps are lanes of a batch, each with its own time and state, or one by one in quad
 * precision.
 *
 * Off D = 0 an invariant changes at the rate lambda.D + O(D^2).  With a right inverse U of A = D_v,
 * A U = 1, the velocity v + U D has that D, so that
 *
 *     lambda.D = d/ds w(q, v + s U D) at s = 0,     w = I_q v + I_v F + I_t
 *
 * for any U, since w = 0 on D = 0; here U = A^T (A A^T)^-1 in the units of the velocities.  w is a
 * difference of order 4 along (v, F, 1).  Since w = 0 on D = 0 one w is enough for d/ds: its error
 * is of the first order in s, and lambda is right to some 1e-5, as no other part of a prediction
 * is.  These differences are what a prediction off D = 0 costs beside its orbit. */
#include "dynamics/local_change.h"
#include "analysis/scaled.h"
#include "core/error.h"
#include "core/vectors.h"
#include "run/quad.h"
#include "run/run.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Sizes of differences, of v and of t in units. */
static const double displaced = 1e-3, ahead = 1e-3, off_surface = 1e-5;

void dal__local_free(dal__local *k)
{
    dal_batch_free(k->batch);
    dal_run_free(k->quad);
    dal_evaluator_free(k->evaluator);
    dal_scaled_free(k->scaled);
    free(k->values);
    free(k->scales);
    free(k->ends);
    *k = (dal__local){0};
}

dal_status dal__local_create(dal__local *k, const dal_run_spec *spec, const dal_run *run,
                             dal_precision precision, dal_error *error)
{
    const dal_system *s = dal_run_system(run);
    *k = (dal__local){.system = s,
                      .step = dal_run_step_size(run),
                      .enforces_D = (dal_method_properties(&spec->method) & DAL_PRESERVES_D) != 0,
                      .n = s->n,
                      .m = s->constraints ? s->m : 0,
                      .has_energy = s->energy != NULL,
                      .invariants = s->invariant_values ? s->invariants : 0};
    k->count = k->m + k->has_energy + k->invariants;
    /* Quad numbers of the observables, twice; or vectors and matrices. */
    const size_t n = (size_t)k->n, m = (size_t)k->m;
    k->values = dal__numbers(1, 4 * (size_t)k->count + 12 * n + 2 * m * n + m * (2 * m + 8) + 64);
    k->scales = dal__numbers(1, (size_t)(s->m + 1 + s->invariants + s->holonomic));
    k->ends = dal__numbers(DAL__LOCAL_STEPS, 2 * n);
    if (!k->values || !k->scales || !k->ends) return dal__memory_error(error);
    DAL_TRY(dal__evaluator_of_run(&k->evaluator, NULL, run, error));
    DAL_TRY(dal_scaled_create_at(&k->scaled, run, error));
    k->unit = dal_scaled_units(k->scaled);
    if (precision == DAL_DOUBLE)
        return dal_batch_create(&k->batch, spec, DAL__LOCAL_STEPS, 0, error);
    dal_run_spec own = *spec;
    own.options.precision = DAL_QUAD;
    return dal_run_create(&k->quad, &own, error);
}

/* E and the invariants at (q, v), out[m] to out[count - 1]. */
static dal_status observe_conserved(dal__local *k, double t, const double *x, double *out)
{
    const dal_system *s = k->system;
    const double *v = x + k->n;
    dal_evaluator *e = k->evaluator;
    if (k->has_energy) DAL_TRY(dal_evaluator_call(e, s->energy, t, x, v, NULL, out + k->m));
    if (k->invariants == 0) return DAL_STATUS_OK;
    return dal_evaluator_call(e, s->invariant_values, t, x, v, NULL, out + k->m + k->has_energy);
}

dal_status dal__local_observe(dal__local *k, double t, const double *x, double *out)
{
    const dal_system *s = k->system;
    const double *v = x + k->n;
    dal_evaluator *e = k->evaluator;
    if (k->m > 0) DAL_TRY(dal_evaluator_call(e, s->constraints, t, x, v, NULL, out));
    return observe_conserved(k, t, x, out);
}

dal_status dal__local_scales(dal__local *k, double t, const double *x, double *out)
{
    const int m = k->system->m, own = k->m + k->has_energy;
    DAL_TRY(dal_evaluator_scales(k->evaluator, t, x, x + k->n, k->scales));
    for (int i = 0; i < k->count; i++)
        out[i] = k->scales[i < k->m ? i : i < own ? m : m + 1 + i - own];
    return DAL_STATUS_OK;
}

/* ---- steps ---- */

/* The observables, or a message. */
static dal_status observe(dal__local *k, double t, const double *x, double *out, dal_error *error)
{
    const dal_status status = dal__local_observe(k, t, x, out);
    if (status == DAL_STATUS_OK) return DAL_STATUS_OK;
    return dal__fail(error, status, "the observables at t = %.17g: %s", t, dal_status_text(status));
}

dal_status dal__local_steps(dal__local *k, int steps, const double *t, const double *x,
                            double *change, int *made, dal_error *error)
{
    const size_t size = 2 * (size_t)k->n, count = (size_t)k->count;
    double *after = k->values;
    for (*made = 0; k->quad && *made < steps; ++*made) {
        DAL_TRY(dal_run_set_state(k->quad, t[*made], x + (size_t)*made * size, error));
        const dal_status status =
            dal__quad_change(&k->quad->quad, k->step, k->values, change + (size_t)*made * count);
        if (status != DAL_STATUS_OK) return dal__fail(error, status, "%s", dal_status_text(status));
    }
    if (k->quad) return DAL_STATUS_OK;
    DAL_TRY(dal_batch_clear(k->batch));
    for (int i = 0; i < steps; i++)
        DAL_TRY(dal_batch_set_state(k->batch, i, t[i], x + (size_t)i * size, error));
    dal_batch_advance(k->batch, 1);
    for (; *made < steps; ++*made) {
        const double *from = x + (size_t)*made * size;
        double *out = change + (size_t)*made * count, *end = k->ends + (size_t)*made * size;
        DAL_TRY(dal_batch_status(k->batch, *made, error));
        dal_batch_state(k->batch, *made, end);
        DAL_TRY(observe(k, t[*made], from, out, error));
        DAL_TRY(observe(k, t[*made] + k->step, end, after, error));
        const size_t first = k->enforces_D ? (size_t)k->m : 0;
        for (size_t i = 0; i < first; i++) out[i] = after[i];
        for (size_t i = first; i < count; i++) out[i] = after[i] - out[i];
    }
    return DAL_STATUS_OK;
}

/* ---- off D = 0 ---- */

double dal__local_divergence(dal__local *k, double t, const double *x)
{
    const int n = k->n;
    double *at = k->values, *F = at + 2 * n, sum = 0.0;
    memcpy(at, x, 2 * (size_t)n * sizeof *at);
    for (int i = 0; i < n; i++) {
        const double step = displaced * k->unit[1 + n + i];
        for (int side = -1; side <= 1; side += 2) {
            at[n + i] = x[n + i] + side * step;
            if (dal_evaluator_call(k->evaluator, k->system->call.field, t, at, at + n, NULL, F) !=
                DAL_STATUS_OK)
                return NAN;
            sum += side * F[i] / (2.0 * step);
        }
        at[n + i] = x[n + i];
    }
    return sum;
}

/* Adds factor times w of E and the invariants at (q, v) to out[count]; scratch of 3n + count. */
static dal_status add_rates(dal__local *k, double t, const double *x, double factor, double *out,
                            double *scratch)
{
    static const double weight[] = {8.0, -1.0}; /* over 12 s */
    const int n = k->n;
    const double s = ahead * k->unit[0];
    double *F = scratch, *at = F + n, *value = at + 2 * n;
    DAL_TRY(dal_evaluator_call(k->evaluator, k->system->call.field, t, x, x + n, NULL, F));
    for (int side = -2; side <= 2; side++) {
        if (side == 0) continue;
        for (int i = 0; i < n; i++) {
            at[i] = x[i] + side * s * x[n + i];
            at[n + i] = x[n + i] + side * s * F[i];
        }
        DAL_TRY(observe_conserved(k, t + side * s, at, value));
        const double w = (side > 0 ? 1.0 : -1.0) * weight[abs(side) - 1] / (12.0 * s);
        for (int i = k->m; i < k->count; i++) out[i] += factor * w * value[i];
    }
    return DAL_STATUS_OK;
}

dal_status dal__local_pull(dal__local *k, double t, const double *x, const double *D, double *out)
{
    const int n = k->n, m = k->m;
    const double *unit = k->unit + 1 + n;
    double *u = k->values, *at = u + n, *scratch = at + 2 * n;
    double *A = scratch + m, *gram = A + 2 * m * n, *right = gram + m * m, *y = right + m;
    memset(out, 0, (size_t)k->count * sizeof *out);
    DAL_TRY(
        dal_evaluator_call(k->evaluator, k->system->call.constraint, t, x, x + n, NULL, scratch));
    for (int a = 0; a < m; a++) {
        for (int i = 0; i < n; i++) A[a * n + i] *= unit[i];
        right[a] = D[a];
    }
    for (int a = 0; a < m; a++)
        for (int b = 0; b < m; b++) gram[a * m + b] = dal__dot_product(n, A + a * n, A + b * n);
    dal__least_squares(m, m, gram, right, y, DBL_EPSILON, NULL, y + m);
    for (int i = 0; i < n; i++) { /* u = U D */
        u[i] = 0.0;
        for (int a = 0; a < m; a++) u[i] += unit[i] * A[a * n + i] * y[a];
    }
    const double size = dal__max_in_units(n, u, unit);
    if (!(size > 0.0)) return DAL_STATUS_OK;
    const double s = off_surface / size;
    for (int i = 0; i < n; i++) {
        at[i] = x[i];
        at[n + i] = x[n + i] + s * u[i];
    }
    return add_rates(k, t, at, 1.0 / s, out, scratch);
}
