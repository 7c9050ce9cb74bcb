/* gram.c - the constraints at a point: the rank of G and the way onto D = 0.
 *
 *     G = A W^-1 A^T;     v <- v - W^-1 A^T G^-1 D until D = 0 (Newton) */
#include "analysis/measure.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Pivots of the scaled G below this leave F less than six digits. */
static const double rank_tolerance = 1e-10;
/* |D| a Newton iteration at stagnation must have reached, relative to sum |A| |v|. */
static const double projection_tolerance = 1e-13;
enum { NEWTON_MOST = 50 };

dal_status dal__constraint_at(dal_evaluator *evaluator, double t, const double *q, const double *v,
                              double *out)
{
    const dal_system *s = dal_evaluator_system(evaluator);
    size_t count = (size_t)s->m * (1 + 2 * (size_t)s->n);
    DAL_TRY(dal_evaluator_call(evaluator, s->call.constraint, t, q, v, NULL, out));
    return isfinite(dal__greatest(out, count)) ? DAL_OK : DAL_NOT_FINITE;
}

void dal__gram(const dal_system *s, const double *block, double *gram)
{
    int n = s->n, m = s->m;
    const double *normal = block + m, *raised = block + m + m * n;
    for (int a = 0; a < m; a++) {
        for (int b = 0; b < m; b++) {
            double sum = 0.0;
            for (int i = 0; i < n; i++) sum += normal[a * n + i] * raised[i * m + b];
            gram[a * m + b] = sum;
        }
    }
}

/* G scaled by the root of the greatest entry of each row: constraints in any units. */
static void scale_gram(double *gram, double *size, int m)
{
    for (int a = 0; a < m; a++) size[a] = sqrt(dal__greatest(gram + a * m, (size_t)m));
    for (int a = 0; a < m; a++)
        for (int b = 0; b < m; b++)
            if (size[a] > 0.0 && size[b] > 0.0) gram[a * m + b] /= size[a] * size[b];
}

dal_status dal_measure_rank(dal_evaluator *evaluator, const dal_point *at, int *rank, double *pivot)
{
    DAL_REQUIRE(evaluator, NULL);
    DAL_REQUIRE_POINT(at);
    DAL_REQUIRE(rank, NULL);
    DAL_REQUIRE(pivot, NULL);
    const dal_system *s = dal_evaluator_system(evaluator);
    size_t n = (size_t)s->n, m = (size_t)s->m;
    double *block = dal__numbers(1, m * (1 + 2 * n) + m * m + m + m * (m + 2));
    if (block == NULL) return DAL_MEMORY;
    double *gram = block + m * (1 + 2 * n), *size = gram + m * m;
    dal_status status = dal__constraint_at(evaluator, at->t, at->q, at->v, block);
    if (status == DAL_OK) {
        dal__gram(s, block, gram);
        scale_gram(gram, size, s->m);
        *rank = dal__least_squares(s->m, s->m, gram, NULL, NULL, rank_tolerance, pivot, size + m);
    }
    free(block);
    return status;
}

/* ---- onto D = 0 ---- */

typedef struct projection {
    dal_evaluator *evaluator;
    const dal_system *s;
    double t;
    const double *q;
    double *v, *best;                           /* [n] */
    double *block, *gram, *step, *right, *work; /* [m(1+2n)], [m*m], [m], [m], [m(m+2)] */
} projection;

static double natural_size(const projection *p)
{
    double max = 1.0;
    for (int a = 0; a < p->s->m; a++) {
        double sum = 0.0;
        for (int i = 0; i < p->s->n; i++)
            sum += fabs(p->block[p->s->m + a * p->s->n + i] * p->best[i]);
        max = fmax(max, sum);
    }
    return max;
}

static dal_status newton_step(projection *p)
{
    int n = p->s->n, m = p->s->m;
    memcpy(p->right, p->block, (size_t)m * sizeof(double));
    dal__gram(p->s, p->block, p->gram);
    if (dal__least_squares(m, m, p->gram, p->right, p->step, rank_tolerance, NULL, p->work) < m)
        return DAL_SINGULAR;
    for (int i = 0; i < n; i++)
        for (int a = 0; a < m; a++) p->v[i] -= p->block[m + m * n + i * m + a] * p->step[a];
    return DAL_OK;
}

/* Newton until |D| no longer falls; the best v is in p->best. */
static dal_status stagnate(projection *p)
{
    double min = INFINITY;
    for (int k = 0; k < NEWTON_MOST; k++) {
        DAL_TRY(dal__constraint_at(p->evaluator, p->t, p->q, p->v, p->block));
        double size = dal__greatest(p->block, (size_t)p->s->m);
        if (size >= min) break;
        min = size;
        memcpy(p->best, p->v, (size_t)p->s->n * sizeof(double));
        if (size == 0.0) break;
        DAL_TRY(newton_step(p));
    }
    return min <= projection_tolerance * natural_size(p) ? DAL_OK : DAL_NOT_CONVERGED;
}

dal_status dal_project_velocity(dal_evaluator *evaluator, double t, const double *q, double *v)
{
    DAL_REQUIRE(evaluator, NULL);
    DAL_REQUIRE(q, NULL);
    DAL_REQUIRE(v, NULL);
    const dal_system *s = dal_evaluator_system(evaluator);
    size_t n = (size_t)s->n, m = (size_t)s->m;
    size_t bytes = (n + (size_t)s->multipliers) * sizeof(double);
    if (m == 0) return DAL_OK;
    double *block = dal__numbers(1, m * (1 + 2 * n) + 2 * m * m + 4 * m + 2 * n + m);
    if (block == NULL) return DAL_MEMORY;
    double *gram = block + m * (1 + 2 * n), *step = gram + m * m, *best = step + 2 * m;
    double *moved = best + n;
    projection p = {.evaluator = evaluator, .s = s, .t = t, .q = q, .v = moved, .best = best};
    p.block = block, p.gram = gram, p.step = step, p.right = step + m;
    p.work = moved + n + (size_t)s->multipliers;
    memcpy(moved, v, bytes);
    dal_status status = stagnate(&p);
    if (status == DAL_OK) memcpy(v, best, n * sizeof(double));
    free(block);
    return status;
}
