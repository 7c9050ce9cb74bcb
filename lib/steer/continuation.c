/* continuation.c - from a motion to another target, by moving its end.
 *
 * A motion whose end is x_0 is moved to the target x_1 by Newton's method for the targets
 *
 *     x_0 + s (x_1 - x_0),    s from 0 to 1,
 *
 * each from the motion before; the step of s is doubled where it converges, and halved where not
 * (Allgower and Georg 1990, Numerical Continuation Methods, DOI 10.1007/978-3-642-61257-2).
 *
 * Natural and vakonomic motion begin at a motion whose velocities and multipliers at the start are
 * drawn.  On the lift such a motion is near rest or leaves the region of F, and what moves its end
 * is nearly singular: there targets about x_1 are drawn until the straight line leads to one. */
#include "steer/continuation.h"
#include "core/error.h"
#include "core/vectors.h"
#include "steer/guess.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DRAWS = 8, PER_DRAW = 60, SOLVES = 40, PER_SOLVE = 15, SIZES = 4 };
static const double first_part = 0.125, least_part = 1.0 / 1024.0;
static const double drawn_about = 0.5; /* of what the target is away */

/* Sets the iterations of what is solved next, within what a guess and its repetitions have. */
static void allow(dal__problem *p, int iterations)
{
    const double all = (double)DRAWS * p->settings->iterations;
    p->limit = (int)fmin(fmin(p->iterations + (double)iterations, all), 2e9);
}

/* How far the target is away in coordinate i, at least a unit. */
static double way(const dal__problem *p, int i)
{
    return fmax(fabs(p->target[i] - p->start[i]), p->unit[i]);
}

/* Runs from the start with velocities and multipliers of a size, and ends there. */
static dal_status draw_motion(dal__shooting *s, dal__random *random, double size)
{
    dal__problem *p = s->problem;
    const int n = p->n, d = p->dimension;
    double *z = s->scratch;
    memcpy(z, p->start, 2 * (size_t)n * sizeof *z);
    for (int i = 0; i < n; i++)
        z[n + i] = size * way(p, i) / fabs(p->T - p->from) * dal__uniform(random);
    for (int i = 2 * n; i < d; i++) z[i] = size * p->unit[i] * dal__uniform(random);
    if (p->constraints > 0)
        DAL_TRY(dal_evaluator_project_velocity(p->evaluator, p->from, z, z + n));
    DAL_TRY(dal_run_set_state(p->run, p->from, z, NULL));
    for (int k = 0; k <= s->pieces; k++) {
        memcpy(s->point + k * d, dal_run_state(p->run), (size_t)d * sizeof *z);
        if (k == s->pieces) break;
        DAL_TRY(dal__problem_poll(p));
        DAL_TRY(dal_run_advance(p->run, s->first[k + 1] - s->first[k], NULL));
    }
    memcpy(p->target, s->point + s->pieces * d, 2 * (size_t)n * sizeof *z);
    return DAL_STATUS_OK;
}

/* A motion in s, whose end p->target is then. */
static dal_status find_first_motion(dal__shooting *s, dal__random *random, int number,
                                    dal__newton_result *result)
{
    dal__problem *p = s->problem;
    if (!p->is_lifted) return draw_motion(s, random, (double)(1 << number % SIZES));
    for (int i = 0; i < p->n; i++)
        if (!p->is_free[1][i]) p->target[i] += drawn_about * way(p, i) * dal__uniform(random);
    allow(p, PER_DRAW);
    return dal__guess_solve(s, result);
}

/* Moves the end of the motion in s from p->target to another one; saved has room for its points. */
static dal_status walk(dal__shooting *s, const double *to, double *from, double *saved,
                       dal__newton_result *result)
{
    dal__problem *p = s->problem;
    const int width = 2 * p->n;
    const size_t numbers = (size_t)((s->pieces + 1) * p->dimension);
    dal_status status = DAL_STATUS_NOT_CONVERGED;
    double part = 0.0, step = first_part;
    memcpy(from, p->target, (size_t)width * sizeof *from);
    memcpy(saved, s->point, numbers * sizeof *saved);
    for (int k = 0; k < SOLVES && part < 1.0 && step >= least_part; k++) {
        const double next = fmin(part + step, 1.0);
        for (int i = 0; i < width; i++)
            p->target[i] = next < 1.0 ? from[i] + next * (to[i] - from[i]) : to[i];
        allow(p, PER_SOLVE);
        status = dal__newton(s, result);
        if (status == DAL_STATUS_MEMORY || p->stopped != DAL_STATUS_OK) return status;
        const bool good = status == DAL_STATUS_OK;
        memcpy(good ? saved : s->point, good ? s->point : saved, numbers * sizeof *saved);
        part = good ? next : part;
        step *= good ? 2.0 : 0.5;
    }
    return part < 1.0 ? DAL_STATUS_NOT_CONVERGED : DAL_STATUS_OK;
}

dal_status dal__continuation_solve(dal__shooting *s, dal__newton_result *result)
{
    dal__problem *p = s->problem;
    const size_t width = 2 * (size_t)p->n;
    double *wanted = dal__numbers(2, width);
    double *saved = dal__numbers((size_t)s->pieces + 1, (size_t)p->dimension);
    dal__random random = {p->settings->seed};
    dal_status status = wanted && saved ? DAL_STATUS_NOT_CONVERGED : DAL_STATUS_MEMORY;
    if (wanted) memcpy(wanted, p->target, width * sizeof *wanted);
    p->guess = -1;
    for (int k = 0; k < DRAWS && status == DAL_STATUS_NOT_CONVERGED; k++) {
        memcpy(p->target, wanted, width * sizeof *wanted);
        status = find_first_motion(s, &random, k, result);
        if (status == DAL_STATUS_OK) status = walk(s, wanted, wanted + width, saved, result);
        if (status != DAL_STATUS_OK && status != DAL_STATUS_MEMORY && p->stopped == DAL_STATUS_OK)
            status = DAL_STATUS_NOT_CONVERGED;
    }
    if (wanted) memcpy(p->target, wanted, width * sizeof *wanted);
    free(wanted);
    free(saved);
    return status;
}
