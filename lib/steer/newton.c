/* newton.c - Newton's method on multiple shooting, damped. */
#include "steer/newton.h"
#include "core/error.h"
#include "core/vectors.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Singular values below this part of the largest count as 0. */
static const double rank_tolerance = 1e-11;
static const double min_damping = 1.0 / 256.0;
static const double converged = 1e-9; /* a step below this: the rest is rounding */
static const double coarse = 1e-3;    /* the same where the motion is a guess for more steps */
static const double kept_rate = 0.1;  /* steps that shrink by this keep their derivative */

typedef struct newton {
    dal__shooting *s;
    dal__problem *p;
    dal__border border;
    dal__two_point linear;
    double *step, *simplified; /* [(pieces + 1)*unknowns + extra] */
    double *jump;              /* [pieces*unknowns] */
    double *point, *end;       /* tried ones, as in s */
    double weight[2];          /* size of (q, v), of momenta, in units; at least 1 */
    double rate;               /* of the last step, undamped: what the next one is of it */
} newton;

static dal_status open_newton(newton *k, dal__shooting *s)
{
    *k = (newton){.s = s, .p = s->problem};
    DAL_TRY(dal__border_open(&k->border, s));
    const int extra = dal__border_extra(&k->border), d = k->p->unknowns;
    const size_t count = (size_t)s->pieces + 1, numbers = count * (size_t)k->p->dimension;
    if (!dal__two_point_open(&k->linear, d, s->pieces, extra, dal__border_rows(&k->border)))
        return DAL_STATUS_MEMORY;
    const size_t unknowns = count * (size_t)d + (size_t)extra;
    k->step = dal__numbers(3, unknowns);
    k->point = dal__numbers(2, numbers);
    if (!k->step || !k->point) return DAL_STATUS_MEMORY;
    k->simplified = k->step + unknowns;
    k->jump = k->simplified + unknowns;
    k->end = k->point + numbers;
    return DAL_STATUS_OK;
}

/* The root of the mean square of a step. */
static double length_of_step(const newton *k, const double *step)
{
    const int d = k->p->unknowns, count = (k->s->pieces + 1) * d;
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        const double x = step[i] / k->weight[i % d >= 2 * k->p->n];
        sum += x * x;
    }
    return sqrt(sum / count);
}

/* The largest jump and distance from the ends, relative, at s->point and s->end; and weights. */
static double find_residual(newton *k)
{
    const dal__shooting *s = k->s;
    const dal__problem *p = k->p;
    const int d = p->unknowns;
    double max = 0.0;
    k->weight[0] = k->weight[1] = 1.0;
    for (int i = 0; i < (s->pieces + 1) * d; i++) {
        const double z = s->point[i / d * p->dimension + dal__place_of(p, i % d)];
        double *weight = &k->weight[i % d >= 2 * p->n];
        *weight = fmax(*weight, fabs(z) / p->unit[i % d]);
    }
    dal__shooting_jumps(s, s->point, s->end, d, k->jump);
    for (int i = 0; i < s->pieces * d; i++) {
        const double x = fabs(k->jump[i]) / k->weight[i % d >= 2 * k->p->n];
        if (!(x <= max)) max = x;
    }
    const double *slack = k->step + (s->pieces + 1) * d;
    return fmax(max, dal__border_distance(&k->border, s->point, &k->linear, slack) / k->weight[0]);
}

static void try_points(newton *k, double damping)
{
    const dal__problem *p = k->p;
    const int count = k->s->pieces + 1;
    memcpy(k->point, k->s->point, (size_t)(count * p->dimension) * sizeof *k->point);
    for (int j = 0; j < count; j++)
        for (int i = 0; i < p->unknowns; i++)
            k->point[j * p->dimension + dal__place_of(p, i)] +=
                damping * k->step[j * p->unknowns + i] * p->unit[i];
}

static void accept_points(newton *k)
{
    const size_t numbers = ((size_t)k->s->pieces + 1) * (size_t)k->p->dimension;
    memcpy(k->s->point, k->point, numbers * sizeof *k->point);
    memcpy(k->s->end, k->end, (numbers - (size_t)k->p->dimension) * sizeof *k->end);
}

/* Finds a damping, from *out down to min, with which the next step is shorter, and goes there.
 * Errors: DAL_STATUS_NOT_CONVERGED: there is none; DAL_STATUS_MEMORY; what the observer
 * returned. */
static dal_status damp(newton *k, double length, double min, double *out)
{
    dal__shooting *s = k->s;
    for (double damping = *out; damping >= min; damping /= 2.0) {
        try_points(k, damping);
        if (dal__shooting_move(s, k->point, k->end) != DAL_STATUS_OK) {
            DAL_TRY(k->p->stopped);
            continue;
        }
        dal__shooting_jumps(s, k->point, k->end, k->p->unknowns, k->jump);
        const dal_status status = dal__border_right(&k->border, k->point, s->pieces, &k->linear);
        if (status == DAL_STATUS_MEMORY) return status;
        if (status != DAL_STATUS_OK) continue;
        dal__two_point_solve(&k->linear, k->jump, k->simplified);
        const double next = length_of_step(k, k->simplified);
        if (!(next <= (1.0 - damping / 4.0) * length) && !(next < 1e-13)) continue;
        accept_points(k);
        k->rate = damping < 1.0 ? 1.0 : next / length;
        *out = damping;
        return DAL_STATUS_OK;
    }
    return DAL_STATUS_NOT_CONVERGED;
}

/* Factors the derivative at the points. */
static dal_status linearise(newton *k)
{
    dal__shooting *s = k->s;
    DAL_TRY(dal__shooting_differentiate(s, DAL__COLUMNS_OF_ALL));
    DAL_TRY(dal__border_fill(&k->border, s->point, s->pieces, &k->linear));
    return dal__two_point_factor(&k->linear, s->derivative, rank_tolerance) ? DAL_STATUS_OK
                                                                            : DAL_STATUS_MEMORY;
}

static dal_status iterate_newton(newton *k)
{
    dal__shooting *s = k->s;
    double damping = 1.0, before = INFINITY, linearised = INFINITY; /* the step when it was */
    DAL_TRY(dal__shooting_move(s, s->point, s->end));
    for (k->rate = 1.0;;) {
        k->p->residual = find_residual(k);
        DAL_TRY(dal__problem_iterate(k->p));
        const bool is_kept = before < converged || k->rate < kept_rate;
        if (is_kept)
            DAL_TRY(dal__border_right(&k->border, s->point, s->pieces, &k->linear));
        else
            DAL_TRY(linearise(k));
        dal__shooting_jumps(s, s->point, s->end, k->p->unknowns, k->jump);
        dal__two_point_solve(&k->linear, k->jump, k->step);
        const double length = length_of_step(k, k->step);
        if (!isfinite(length)) return DAL_STATUS_NOT_CONVERGED;
        if (length < coarse && s->steps < k->p->steps) return DAL_STATUS_OK;
        if (!is_kept) linearised = length;
        if (length < converged && (length > before / 4.0 || length < 1e-15)) break;
        before = length;
        if (length < converged) { /* rounding would fail the test */
            try_points(k, 1.0);
            DAL_TRY(dal__shooting_move(s, k->point, k->end));
            accept_points(k);
            continue;
        }
        damping = fmin(1.0, 4.0 * damping);
        const dal_status status = damp(k, length, is_kept ? 1.0 : min_damping, &damping);
        if (status == DAL_STATUS_NOT_CONVERGED && is_kept)
            k->rate = 1.0; /* the next step has a derivative of its own */
        else
            DAL_TRY(status);
    }
    k->p->residual = find_residual(k);
    if (!(k->p->residual <= k->p->settings->tolerance)) return DAL_STATUS_NOT_CONVERGED;
    return linearised < converged ? DAL_STATUS_OK : linearise(k); /* for ranks along the motion */
}

static dal_status measure_points(newton *k)
{
    DAL_TRY(dal__shooting_move(k->s, k->s->point, k->s->end));
    k->p->residual = find_residual(k);
    return DAL_STATUS_OK;
}

/* Opens Newton's method, does something with it, and measures how far the points are. */
static dal_status run_newton(dal__shooting *s, dal_status (*run)(newton *),
                             dal__newton_result *result)
{
    newton k;
    dal_status status = open_newton(&k, s);
    if (status == DAL_STATUS_OK) status = run(&k);
    result->residual = s->problem->residual;
    result->condition = k.linear.condition;
    dal__border_close(&k.border);
    dal__two_point_close(&k.linear);
    free(k.step);
    free(k.point);
    return status;
}

dal_status dal__newton(dal__shooting *s, dal__newton_result *result)
{
    return run_newton(s, iterate_newton, result);
}

dal_status dal__newton_measure(dal__shooting *s, dal__newton_result *result)
{
    return run_newton(s, measure_points, result);
}
