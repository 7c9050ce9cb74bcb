/* constraints.c - the class of the constraints.
 *
 * A polynomial of degree k along every line has vanishing (k+1)-th differences:
 *     D(x+d) - 2 D(x) + D(x-d) = 0            affine along d
 *     D(x+2d) - 3 D(x+d) + 3 D(x) - D(x-d) = 0  of degree <= 2 along d
 * Each property is tried on lines through points about the given one; one line that fails
 * decides against it, points where D is not finite decide nothing. */
#include "analysis/differences.h"
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
    double *points, *largest;     /* [m] those with values, and the largest |D| there */
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

/* v.D_v = k D with the same k at all points, of which a quarter has values; k into w->degree. */
static bool is_homogeneous(survey *w)
{
    double *points = w->points, *largest = w->largest;
    for (int a = 0; a < w->m; a++) {
        w->degree[a] = NAN;
        points[a] = largest[a] = 0.0;
    }
    for (int trial = 0; trial < TRIALS; trial++) {
        draw_base(w);
        memset(w->d, 0, (size_t)(w->n + w->nw) * sizeof(double));
        memcpy(w->d + w->n, w->x + w->n, (size_t)w->n * sizeof(double));
        if (values_at(w, 0.0, w->value[0]) != DAL_STATUS_OK) continue;
        if (dal__differentiate(along_scaling, w, DAL__INCREMENT, w->m, w->value[1], w->rate))
            continue;
        for (int a = 0; a < w->m; a++) {
            const double k = w->rate[a] / w->value[0][a], size = fabs(w->value[0][a]);
            if (!(size > 1e-3)) continue;
            /* The rate has the error of values of size 1. */
            const double rounding = 1e-8 / fmin(1.0, fmin(size, largest[a]));
            if (points[a] > 0.0 && !(fabs(k - w->degree[a]) <= rounding)) return false;
            points[a]++;
            if (size <= largest[a]) continue;
            w->degree[a] = k;
            largest[a] = size;
        }
    }
    for (int a = 0; a < w->m; a++)
        if (points[a] < TRIALS / 4.0) return false;
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
    double *block = dal__numbers(1, 3 * x + 9 * rows);
    if (block == NULL) return DAL_STATUS_MEMORY;
    survey w = {.evaluator = evaluator, .s = s, .n = s->n, .nw = (int)nw, .m = s->m, .at = *at};
    w.random.state = 7;
    w.x = block, w.d = block + x, w.y = block + 2 * x;
    for (size_t k = 0; k < 4; k++) w.value[k] = block + 3 * x + k * rows;
    w.sign = w.value[3] + rows, w.degree = w.sign + rows, w.rate = w.degree + rows;
    w.points = w.rate + rows, w.largest = w.points + rows;
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
