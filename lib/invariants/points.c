/* points.c - formulas of a model at random points of g = 0 and D = 0, in quad precision.
 *
 * Newton's iteration moves q to g = 0, then v to D = 0 by the least change in units u of v,
 *
 *     v <- v - u B^T (B B^T)^-1 D,    B = A u,    A = D_v
 *
 * and likewise q.  Another point is drawn where it does not converge or an output is not finite. */
#define DAL_NUM_QUAD
#include "invariants/points.h"
#include "core/vectors.h"
#include "expr/tape.h"
#include "kernel/num.h"
#include <float.h>
#include <stdlib.h>

enum { TO_SURFACE, OUTPUTS, MAX_ATTEMPTS = 200, MAX_ITERATIONS = 40 };

struct dal__points {
    const dal__equations *e;
    const dal__region *region;
    dal__tapes *tapes;
    dal__random random;
    num *work;    /* of the tapes */
    num *surface; /* [m + m*n + holonomic] D, A, g */
    num *matrix;  /* [m*(m+1)] B B^T and D beside it */
    num *out;     /* [count] */
    int count;
};

void dal__points_free(dal__points *points)
{
    if (!points) return;
    dal__tapes_free(points->tapes);
    free(points->work);
    free(points);
}

dal_status dal__points_create(dal__points **points, const dal__equations *e,
                              const dal__region *region, const dal__node *output, int count)
{
    const size_t m = (size_t)e->m, rows = m + m * (size_t)e->n, matrix = m * (m + 1);
    const size_t values = rows + (size_t)e->holonomic;
    dal__node *surface = malloc((values + 1) * sizeof *surface);
    dal__points *p = *points = calloc(1, sizeof *p);
    dal_status status = DAL_STATUS_MEMORY;
    for (size_t i = 0; surface && i < values; i++)
        surface[i] = i < m ? e->constraint[i] : i < rows ? e->A[i - m] : e->position[i - rows];
    if (surface && p)
        p->tapes = dal__tapes_create(e->graph, e->parameters, e->symbols - e->parameters);
    if (surface && p && p->tapes && dal__tapes_add(p->tapes, surface, (int)values) == TO_SURFACE &&
        dal__tapes_add(p->tapes, output, count) == OUTPUTS)
        status = dal__tapes_finish(p->tapes);
    free(surface);
    if (status == DAL_STATUS_OK) {
        const size_t work = p->tapes->workspace;
        p->e = e;
        p->region = region;
        p->count = count;
        p->work = calloc(work + values + matrix + (size_t)count, sizeof *p->work);
        if (p->work) {
            p->surface = p->work + work;
            p->matrix = p->surface + values;
            p->out = p->matrix + matrix;
            return DAL_STATUS_OK;
        }
        status = DAL_STATUS_MEMORY;
    }
    dal__points_free(p);
    *points = NULL;
    return status;
}

void dal__points_begin(dal__points *p, const double *parameter)
{
    for (int i = 0; i < p->e->parameters; i++) p->work[i] = parameter[i];
    p->random.state = 2025;
    dal__tapes_prepare_x1_QUAD(p->tapes, (double *)p->work);
}

/* The place of a symbol that is no parameter. */
static num *input(const dal__points *p, int symbol)
{
    return p->work + p->tapes->first_input + (symbol - p->e->parameters);
}

/* B B^T y = D, by elimination with pivots; false where B B^T is singular. */
static bool solve_gram(num *matrix, int m)
{
    const int width = m + 1;
    for (int k = 0; k < m; k++) {
        int pivot = k;
        for (int i = k + 1; i < m; i++)
            if (dal_abs(matrix[i * width + k]) > dal_abs(matrix[pivot * width + k])) pivot = i;
        if (!(dal_abs(matrix[pivot * width + k]) > 0.0)) return false;
        for (int j = k; j < width; j++) {
            const num x = matrix[k * width + j];
            matrix[k * width + j] = matrix[pivot * width + j];
            matrix[pivot * width + j] = x;
        }
        for (int i = 0; i < m; i++) {
            if (i == k) continue;
            const num factor = matrix[i * width + k] / matrix[k * width + k];
            for (int j = k; j < width; j++) matrix[i * width + j] -= factor * matrix[k * width + j];
        }
    }
    return true;
}

/* Constraints that one kind of variable is moved to: rows first to first + m of A, their values,
 * and the first symbol of the variables. */
typedef struct target {
    int first, m;
    const num *value;
    int symbol;
} target;

/* One iteration: the largest change of a variable, relative to its unit; NaN where it fails. */
static double iterate(dal__points *p, const target *to)
{
    const int n = p->e->n, m = to->m, width = m + 1;
    const double *u = p->region->reach + to->symbol;
    const num *A = p->surface + p->e->m + to->first * n;
    double max = 0.0;
    dal__tape_run_x1_QUAD(p->tapes, TO_SURFACE, (double *)p->work, (double *)p->surface);
    for (int a = 0; a < m; a++) {
        for (int b = 0; b < m; b++) {
            num sum = 0.0;
            for (int i = 0; i < n; i++) sum += A[a * n + i] * u[i] * u[i] * A[b * n + i];
            p->matrix[a * width + b] = sum;
        }
        p->matrix[a * width + m] = to->value[a];
    }
    if (!solve_gram(p->matrix, m)) return NAN;
    for (int i = 0; i < n; i++) {
        num change = 0.0;
        for (int a = 0; a < m; a++)
            change += A[a * n + i] * p->matrix[a * width + m] / p->matrix[a * width + a];
        *input(p, to->symbol + i) -= u[i] * u[i] * change;
        const double size = (double)dal_abs(u[i] * change);
        if (!(size <= max)) max = size;
    }
    return max;
}

/* Whether the variables could be moved to their constraints. */
static bool move_to(dal__points *p, const target *to)
{
    const double rounding = 4096.0 * DBL_EPSILON * DAL_QUAD_ULP_RATIO;
    double change = to->m > 0 ? INFINITY : 0.0;
    for (int i = 0; i < MAX_ITERATIONS && change > rounding; i++) change = iterate(p, to);
    return change <= rounding;
}

dal_status dal__points_next(dal__points *p, double *out)
{
    const dal__equations *e = p->e;
    const target positions = {e->m - e->holonomic, e->holonomic, p->surface + e->m + e->m * e->n,
                              e->q};
    const target velocities = {0, e->m, p->surface, e->v};
    for (int k = 0; k < MAX_ATTEMPTS; k++) {
        for (int i = p->e->parameters; i < p->e->symbols; i++)
            *input(p, i) = p->region->centre[i] + p->region->reach[i] * dal__uniform(&p->random);
        if (!move_to(p, &positions) || !move_to(p, &velocities)) continue;
        dal__tape_run_x1_QUAD(p->tapes, OUTPUTS, (double *)p->work, (double *)p->out);
        bool is_finite = true;
        for (int i = 0; i < p->count; i++) {
            out[i] = (double)p->out[i];
            is_finite = is_finite && isfinite(out[i]);
        }
        if (is_finite) return DAL_STATUS_OK;
    }
    return DAL_STATUS_NOT_FINITE;
}
