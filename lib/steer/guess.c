/* guess.c - from a first guess to a motion.
 *
 * From the straight line in q, or a bent one, Gauss-Newton on a coarse grid comes near an extremal,
 * Newton's method on multiple shooting finds the one of the coarse grid, and once more the one of
 * the steps of the run. */
#include "steer/guess.h"
#include "core/error.h"
#include "core/pi.h"
#include "core/vectors.h"
#include "steer/direct.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PIECES = DAL__STEER_PIECES, BENDS = 3, DIRECT_BEFORE_NEWTON = 8 };

/* ---- first guesses ---- */

/* Points on a line from start to target, bent by sines of random sizes; multipliers of vakonomic
 * motion are the start's, and random ones are added. */
static dal_status guess_points(dal__shooting *s)
{
    dal__problem *p = s->problem;
    const int n = p->n;
    dal__random random = {p->settings->seed + (unsigned long long)p->guess};
    double bend[BENDS];
    memset(s->point, 0, (size_t)((s->pieces + 1) * p->dimension) * sizeof *s->point);
    for (int i = 0; i < n; i++) {
        const double length = p->target[i] - p->start[i], T = p->T - p->from;
        for (int j = 0; j < BENDS; j++)
            bend[j] = p->guess > 0 ? dal__uniform(&random) * fmax(fabs(length), p->unit[i]) : 0.0;
        for (int k = 0; k <= s->pieces; k++) {
            const double part = (dal__shooting_time(s, k) - p->from) / T;
            double *z = s->point + k * p->dimension;
            z[i] = p->start[i] + part * length;
            z[n + i] = length / T;
            for (int j = 0; j < BENDS; j++) {
                z[i] += bend[j] * sin((j + 1) * DAL__PI * part);
                z[n + i] += bend[j] * (j + 1) * DAL__PI / T * cos((j + 1) * DAL__PI * part);
            }
        }
    }
    for (int a = 2 * n; a < 2 * n + p->multipliers; a++) {
        const double g = dal_run_state(p->run)[a];
        const double change =
            p->guess > 0 ? dal__uniform(&random) * fmax(fabs(g), p->unit[a]) : 0.0;
        for (int k = 0; k <= s->pieces; k++) s->point[k * p->dimension + a] = g + change;
    }
    for (int k = 0; k <= s->pieces; k++) {
        double *z = s->point + k * p->dimension;
        if (p->is_lifted) z[2 * n] = p->e;
        if (k > 0 && k < s->pieces && p->constraints > 0 &&
            dal_evaluator_project_velocity(p->evaluator, dal__shooting_time(s, k), z, z + n) ==
                DAL_STATUS_MEMORY)
            return DAL_STATUS_MEMORY;
        for (int i = 0; i < 2 * n; i++) {
            if (k == 0 && (!p->is_free[0][i] || i < n)) z[i] = p->start[i];
            if (k == s->pieces && !p->is_free[1][i]) z[i] = p->target[i];
        }
    }
    return DAL_STATUS_OK;
}

/* Points of another grid, by lines between them. */
static void interpolate_points(const dal__shooting *from, dal__shooting *to)
{
    const int dimension = from->problem->dimension;
    for (int k = 0, j = 0; k <= to->pieces; k++) {
        const double t = dal__shooting_time(to, k);
        while (j < from->pieces - 1 && fabs(dal__shooting_time(from, j + 1) - from->problem->from) <
                                           fabs(t - from->problem->from))
            j++;
        const double begin = dal__shooting_time(from, j), end = dal__shooting_time(from, j + 1);
        const double part = k == to->pieces ? 1.0 : (t - begin) / (end - begin);
        const double *z = from->point + j * dimension;
        for (int i = 0; i < dimension; i++)
            to->point[k * dimension + i] = z[i] + part * (z[dimension + i] - z[i]);
    }
}

/* ---- one guess ---- */

/* Errors that end the search for a motion. */
static bool is_final(const dal__problem *p, dal_status status)
{
    return status == DAL_STATUS_MEMORY || p->stopped != DAL_STATUS_OK || p->iterations >= p->limit;
}

/* By Gauss-Newton until Newton's method converges. */
static dal_status solve_directly(dal__shooting *s, dal__newton_result *result)
{
    dal__problem *p = s->problem;
    dal__direct d;
    const size_t bytes = (size_t)((s->pieces + 1) * p->dimension) * sizeof(double);
    double *saved = malloc(bytes);
    dal_status status = saved ? dal__direct_open(&d, s) : DAL_STATUS_MEMORY;
    for (int i = 0; status == DAL_STATUS_OK; i++) {
        status = dal__direct_iterate(&d);
        const bool is_near = d.jump < 0.02 && d.change < 0.3;
        if (status != DAL_STATUS_OK || !(is_near || (i + 1) % DIRECT_BEFORE_NEWTON == 0)) continue;
        memcpy(saved, s->point, bytes);
        dal__direct_extremal(&d, s->point);
        status = dal__newton(s, result);
        if (status == DAL_STATUS_OK || is_final(p, status)) break;
        memcpy(s->point, saved, bytes);
        status = DAL_STATUS_OK;
    }
    if (saved) dal__direct_close(&d);
    free(saved);
    return status;
}

dal_status dal__guess_solve(dal__shooting *s, dal__newton_result *result)
{
    dal__problem *p = s->problem;
    dal__shooting coarse;
    dal_status status;
    DAL_TRY(guess_points(s));
    if (!p->is_lifted) return dal__newton(s, result);
    if (s->steps < 2 * PIECES) return solve_directly(s, result);
    status = dal__shooting_open(&coarse, p, PIECES, PIECES);
    if (status == DAL_STATUS_OK) {
        status = guess_points(&coarse);
        if (status == DAL_STATUS_OK) status = solve_directly(&coarse, result);
        interpolate_points(&coarse, s);
    }
    dal__shooting_close(&coarse);
    if (status != DAL_STATUS_OK && is_final(p, status)) {
        if (status != DAL_STATUS_MEMORY) dal__shooting_move(s, s->point, s->end);
        return status;
    }
    if (status == DAL_STATUS_OK) status = dal__newton(s, result);
    if (status == DAL_STATUS_OK || is_final(p, status)) return status;
    DAL_TRY(guess_points(s));
    return solve_directly(s, result);
}
