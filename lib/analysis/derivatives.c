/* derivatives.c - the derivatives that a system returns, compared with differences. */
#include "analysis/derivatives.h"
#include "analysis/differences.h"
#include "core/error.h"
#include "core/settings.h"
#include "core/vectors.h"
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

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
