/* projection.c - the rank of G, and projection to g = 0 and D = 0.
 *
 *     G = A W^-1 A^T;     v <- v - W^-1 A^T G^-1 D until D = 0 (Newton), q likewise to g = 0 */
#include "core/error.h"
#include "core/settings.h"
#include "core/vectors.h"
#include "dalembert_evaluator.h"
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* ---- the rank of G ---- */

/* Pivots of the scaled G below this leave F less than six digits. */
static const double rank_tolerance = 1e-10;

/* D, A, W^-1 A^T in one block out[m + m*n + n*m]. */
static dal_status constraint_blocks(dal_evaluator *evaluator, double t, const double *q,
                                    const double *v, double *out)
{
    const dal_system *s = dal_evaluator_system(evaluator);
    size_t count = (size_t)s->m * (1 + 2 * (size_t)s->n);
    DAL_TRY(dal_evaluator_call(evaluator, s->call.constraint, t, q, v, NULL, out));
    return isfinite(dal__max_abs(out, count)) ? DAL_STATUS_OK : DAL_STATUS_NOT_FINITE;
}

dal_status dal_evaluator_measure_rank(dal_evaluator *evaluator, const dal_point *at, int *rank,
                                      double *pivot)
{
    DAL_REQUIRE(evaluator && dal__has_state(at) && rank && pivot, NULL);
    const dal_system *s = dal_evaluator_system(evaluator);
    size_t n = (size_t)s->n, m = (size_t)s->m;
    double *block = dal__numbers(1, m * (1 + 2 * n) + m * m + m + m * (m + 2));
    if (block == NULL) return DAL_STATUS_MEMORY;
    double *gram = block + m * (1 + 2 * n), *size = gram + m * m;
    dal_status status = constraint_blocks(evaluator, at->t, at->q, at->v, block);
    if (status == DAL_STATUS_OK) {
        dal__gram_matrix(s->n, s->m, block + m, block + m + m * n, gram);
        /* Scaled by the root of the largest entry of each row: constraints in any units. */
        for (size_t a = 0; a < m; a++) size[a] = sqrt(dal__max_abs(gram + a * m, m));
        for (size_t k = 0; k < m * m; k++) {
            const double scale = size[k / m] * size[k % m];
            if (size[k / m] > 0.0 && size[k % m] > 0.0) gram[k] /= scale;
        }
        *rank = dal__least_squares(s->m, s->m, gram, NULL, NULL, rank_tolerance, pivot, size + m);
    }
    free(block);
    return status;
}

/* ---- projection to g = 0 and D = 0 ---- */

/* |D| a Newton iteration at stagnation must have reached, relative to sum |A| |v|; |g| likewise. */
static const double projection_tolerance = 1e-13;
enum { MAX_NEWTON_STEPS = 50 };

typedef struct projection {
    dal_evaluator *evaluator;
    const dal_system *s;
    double t;
    const double *q, *v;
    int first, rows;      /* of A: those that x is moved to */
    double *x, *best;     /* [n] q or v, which is moved */
    double *block, *gram; /* [m(1+2n)], [rows*rows] */
    double *value, *step; /* [rows] g or D, multipliers */
    double *work;         /* [rows(rows+2)] */
} projection;

static double natural_size(const projection *p)
{
    const int n = p->s->n;
    const double *A = p->block + p->s->m + p->first * n;
    double max = 1.0;
    for (int a = 0; a < p->rows; a++) {
        double sum = 0.0;
        for (int i = 0; i < n; i++) sum += fabs(A[a * n + i] * p->best[i]);
        max = fmax(max, sum);
    }
    return max;
}

static dal_status evaluate_rows(projection *p)
{
    DAL_TRY(constraint_blocks(p->evaluator, p->t, p->q, p->v, p->block));
    memcpy(p->value, p->block + p->first, (size_t)p->rows * sizeof *p->value);
    if (p->x == p->v) return DAL_STATUS_OK;
    DAL_TRY(
        dal_evaluator_call(p->evaluator, p->s->call.holonomic, p->t, p->q, p->v, NULL, p->value));
    return isfinite(dal__max_abs(p->value, (size_t)p->rows)) ? DAL_STATUS_OK
                                                             : DAL_STATUS_NOT_FINITE;
}

static dal_status newton_step(projection *p)
{
    const int n = p->s->n, m = p->s->m, rows = p->rows;
    const double *A = p->block + m + p->first * n, *B = p->block + m + m * n + p->first;
    for (int a = 0; a < rows; a++)
        for (int b = 0; b < rows; b++) {
            double sum = 0.0;
            for (int i = 0; i < n; i++) sum += A[a * n + i] * B[i * m + b];
            p->gram[a * rows + b] = sum;
        }
    if (dal__least_squares(rows, rows, p->gram, p->value, p->step, rank_tolerance, NULL, p->work) <
        rows)
        return DAL_STATUS_SINGULAR;
    for (int i = 0; i < n; i++)
        for (int a = 0; a < rows; a++) p->x[i] -= B[i * m + a] * p->step[a];
    return DAL_STATUS_OK;
}

/* Iterates until the rows no longer fall; the best x is in p->best. */
static dal_status stagnate(projection *p)
{
    double min = INFINITY;
    for (int k = 0; k < MAX_NEWTON_STEPS; k++) {
        DAL_TRY(evaluate_rows(p));
        double size = dal__max_abs(p->value, (size_t)p->rows);
        if (size >= min) break;
        min = size;
        memcpy(p->best, p->x, (size_t)p->s->n * sizeof(double));
        if (size == 0.0) break;
        DAL_TRY(newton_step(p));
    }
    return min <= projection_tolerance * natural_size(p) ? DAL_STATUS_OK : DAL_STATUS_NOT_CONVERGED;
}

/* Moves `to`, which is q or v, until its rows are 0, and leaves it as it was where that fails. */
static dal_status project(dal_evaluator *evaluator, double t, const double *q, const double *v,
                          double *to)
{
    const dal_system *s = dal_evaluator_system(evaluator);
    const size_t n = (size_t)s->n, m = (size_t)s->m, nw = n + (size_t)s->multipliers;
    const int rows = to == v ? s->m : s->holonomic;
    if (rows == 0) return DAL_STATUS_OK;
    double *block = dal__numbers(1, m * (1 + 2 * n) + 2 * m * m + 4 * m + n + nw);
    if (block == NULL) return DAL_STATUS_MEMORY;
    double *moved = block + m * (1 + 2 * n);
    projection p = {.evaluator = evaluator, .s = s, .t = t, .q = q, .v = v, .rows = rows};
    p.first = s->m - rows, p.block = block, p.x = moved, p.best = moved + nw;
    p.gram = p.best + n, p.value = p.gram + m * m, p.step = p.value + m, p.work = p.step + m;
    memcpy(moved, to, (to == v ? nw : n) * sizeof *moved);
    *(to == v ? &p.v : &p.q) = moved;
    const dal_status status = stagnate(&p);
    if (status == DAL_STATUS_OK) memcpy(to, p.best, n * sizeof *to);
    free(block);
    return status;
}

dal_status dal_evaluator_project_position(dal_evaluator *evaluator, double t, double *q,
                                          const double *v)
{
    DAL_REQUIRE(evaluator && q && v, NULL);
    return project(evaluator, t, q, v, q);
}

dal_status dal_evaluator_project_velocity(dal_evaluator *evaluator, double t, const double *q,
                                          double *v)
{
    DAL_REQUIRE(evaluator && q && v, NULL);
    return project(evaluator, t, q, v, v);
}
