/* constraints.c - the class of the constraints, the rank of G, and projection to D = 0.
 *
 * A polynomial of degree k along every line has vanishing (k+1)-th differences:
 *     D(x+d) - 2 D(x) + D(x-d) = 0            affine along d
 *     D(x+2d) - 3 D(x+d) + 3 D(x) - D(x-d) = 0  of degree <= 2 along d
 * Each property is tried on lines through points about the given one; one line that fails
 * decides against it, points where D is not finite decide nothing.
 *
 *     G = A W^-1 A^T;     v <- v - W^-1 A^T G^-1 D until D = 0 (Newton), q likewise to g = 0 */
#include "analysis/derivatives.h"
#include "core/error.h"
#include "core/settings.h"
#include "core/vectors.h"
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { TRIALS = 24 };
/* How far from the given point the lines pass and reach, in units of the system. */
static const double neighbourhood = 0.3;
/* A difference of values near 1 over steps near 0.3 carries a few 1e-16; anything of this size is
 * not rounding. */
static const double tolerance = 1e-11;

typedef struct survey {
    dal_evaluator *evaluator;
    const dal_system *s;
    int n, nw, m;
    dal_point at;
    dal__random random;
    double *x, *d, *y;            /* [n+nw] base, direction, point on the line */
    double *value[4];             /* [max(m, nw)] */
    double *sign, *degree, *rate; /* [m] */
    double t, dt;                 /* the same of time */
    bool undecided;               /* D had no values at any point tried */
} survey;

static dal_status values_at(survey *w, double s, double *out)
{
    for (int i = 0; i < w->n + w->nw; i++) w->y[i] = w->x[i] + s * w->d[i];
    return dal_evaluator_call(w->evaluator, w->s->constraints, w->t + s * w->dt, w->y, w->y + w->n,
                              NULL, out);
}

static void draw_base(survey *w)
{
    for (int i = 0; i < w->n + w->nw; i++) {
        double x = i < w->n ? w->at.q[i] : w->at.v[i - w->n];
        w->x[i] = x + neighbourhood * dal__uniform(&w->random);
    }
    w->t = w->at.t + dal__uniform(&w->random);
}

enum { IN_Q = 1, IN_V = 2, IN_T = 4 };

/* Whether the difference with these weights of the values at s = -1, 0, ... vanishes for every
 * constraint on every line tried, in the directions of coordinates, velocities or time. */
static bool vanishes(survey *w, unsigned directions, int count, const double *weight)
{
    bool decided = false;
    w->dt = directions & IN_T ? 0.5 : 0.0;
    for (int trial = 0; trial < TRIALS; trial++) {
        bool good = true;
        draw_base(w);
        for (int i = 0; i < w->n + w->nw; i++) {
            const bool varies = i < w->n ? directions & IN_Q : directions & IN_V && i < 2 * w->n;
            w->d[i] = varies ? neighbourhood * dal__uniform(&w->random) : 0.0;
        }
        for (int k = 0; k < count && good; k++)
            good = values_at(w, k - 1.0, w->value[k]) == DAL_STATUS_OK &&
                   isfinite(dal__max_abs(w->value[k], (size_t)w->m));
        decided |= good;
        for (int a = 0; a < w->m && good; a++) {
            double sum = 0.0, size = 1.0;
            for (int k = 0; k < count; k++) {
                sum += weight[k] * w->value[k][a];
                size = fmax(size, fabs(w->value[k][a]));
            }
            if (fabs(sum) > tolerance * size) return false;
        }
    }
    w->undecided |= !decided;
    w->dt = 0.0;
    return decided;
}

/* ---- v -> -v ---- */

static void reverse(survey *w)
{
    for (int i = w->n; i < 2 * w->n; i++) w->x[i] = -w->x[i];
    for (int a = 0; a < w->s->multipliers; a++) w->x[2 * w->n + a] *= w->sign[a];
    w->t = -w->t;
}

/* +1, -1 or 0 for each constraint into w->sign; returns the first, or 0 when one has none. */
static int find_parity(survey *w)
{
    for (int a = 0; a < w->m; a++) w->sign[a] = 2.0;
    for (int trial = 0; trial < TRIALS; trial++) {
        draw_base(w);
        if (values_at(w, 0.0, w->value[0]) != DAL_STATUS_OK) continue;
        reverse(w);
        if (values_at(w, 0.0, w->value[1]) != DAL_STATUS_OK) continue;
        for (int a = 0; a < w->m; a++) {
            double x = w->value[0][a], y = w->value[1][a], size = tolerance * fmax(1.0, fabs(x));
            double sign = fabs(x - y) <= size ? 1.0 : fabs(x + y) <= size ? -1.0 : 0.0;
            if (isnan(x) || isnan(y) || fabs(x) <= size) continue;
            w->sign[a] = w->sign[a] == 2.0 || w->sign[a] == sign ? sign : 0.0;
        }
    }
    int common = 0;
    for (int a = 0; a < w->m; a++) {
        if (w->sign[a] == 2.0) w->sign[a] = 0.0;
        if (a == 0) common = (int)w->sign[a];
        if (w->sign[a] == 0.0) return 0;
    }
    return common;
}

static double force_defect(survey *w)
{
    double max = 0.0;
    bool decided = false;
    dal_callback *field = w->s->call.field;
    for (int trial = 0; trial < TRIALS; trial++) {
        draw_base(w);
        dal_status here =
            dal_evaluator_call(w->evaluator, field, w->t, w->x, w->x + w->n, NULL, w->value[0]);
        reverse(w);
        dal_status there =
            dal_evaluator_call(w->evaluator, field, w->t, w->x, w->x + w->n, NULL, w->value[1]);
        if (here != DAL_STATUS_OK || there != DAL_STATUS_OK) continue;
        /* dg/dt of a multiplier that changes its sign with v keeps its own, and the reverse. */
        for (int a = 0; a < w->s->multipliers; a++) w->value[1][w->n + a] *= -w->sign[a];
        if (!isfinite(dal__max_abs(w->value[0], (size_t)w->nw))) continue;
        max = fmax(max, dal__distance(w->value[0], w->value[1], NULL, (size_t)w->nw));
        decided = true;
    }
    return decided ? max : NAN;
}

/* ---- homogeneity ---- */

static dal_status along_scaling(void *user, double s, double *out)
{
    survey *w = user;
    return values_at(w, s, out);
}

/* v.D_v = k D with the same k at every point; k into w->degree. */
static bool is_homogeneous(survey *w)
{
    for (int a = 0; a < w->m; a++) w->degree[a] = NAN;
    for (int trial = 0; trial < TRIALS; trial++) {
        draw_base(w);
        memset(w->d, 0, (size_t)(w->n + w->nw) * sizeof(double));
        memcpy(w->d + w->n, w->x + w->n, (size_t)w->n * sizeof(double));
        if (values_at(w, 0.0, w->value[0]) != DAL_STATUS_OK) continue;
        if (dal__differentiate(along_scaling, w, DAL__INCREMENT, w->m, w->value[1], w->rate))
            continue;
        for (int a = 0; a < w->m; a++) {
            double k = w->rate[a] / w->value[0][a];
            if (!(fabs(w->value[0][a]) > 1e-3)) continue;
            if (!(isnan(w->degree[a]) || fabs(k - w->degree[a]) <= 1e-8)) return false;
            w->degree[a] = k;
        }
    }
    for (int a = 0; a < w->m; a++)
        if (isnan(w->degree[a])) return false;
    return true;
}

/* ---- the class ---- */

dal_status dal_evaluator_classify_constraints(dal_evaluator *evaluator, const dal_point *at,
                                              dal_constraint_class *out, double *degree)
{
    static const double first[] = {-1.0, 1.0}, second[] = {1.0, -2.0, 1.0};
    static const double third[] = {-1.0, 3.0, -3.0, 1.0};
    DAL_REQUIRE(evaluator && dal__has_state(at) && out, NULL);
    const dal_system *s = dal_evaluator_system(evaluator);
    if (s->m > 0 && s->constraints == NULL) return DAL_STATUS_UNSUPPORTED;
    size_t nw = (size_t)s->n + (size_t)s->multipliers, x = (size_t)s->n + nw;
    size_t rows = nw > (size_t)s->m ? nw : (size_t)s->m;
    double *block = dal__numbers(1, 3 * x + 7 * rows);
    if (block == NULL) return DAL_STATUS_MEMORY;
    survey w = {.evaluator = evaluator, .s = s, .n = s->n, .nw = (int)nw, .m = s->m, .at = *at};
    w.random.state = 7;
    w.x = block, w.d = block + x, w.y = block + 2 * x;
    for (size_t k = 0; k < 4; k++) w.value[k] = block + 3 * x + k * rows;
    w.sign = w.value[3] + rows, w.degree = w.sign + rows, w.rate = w.degree + rows;
    *out = (dal_constraint_class){0};
    if (w.m > 0) {
        const bool steady = vanishes(&w, IN_T, 2, first);
        out->linear = vanishes(&w, IN_V, 3, second);
        out->constant = steady && vanishes(&w, IN_Q | IN_V, 3, second);
        out->bilinear = steady && out->linear && vanishes(&w, IN_Q, 3, second);
        out->quadratic = steady && vanishes(&w, IN_Q | IN_V, 4, third);
        out->homogeneous = is_homogeneous(&w);
        out->parity = find_parity(&w);
    }
    for (int a = 0; a < w.m && degree != NULL; a++) degree[a] = w.degree[a];
    out->force_defect = force_defect(&w);
    const bool has_parity = w.s->multipliers == 0 || out->parity != 0;
    out->reversible = has_parity && out->force_defect <= 1e-10;
    free(block);
    return w.undecided ? DAL_STATUS_NOT_FINITE : DAL_STATUS_OK;
}

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
