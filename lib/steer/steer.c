/* steer.c - finds extremals between two ends: from first guesses (guess.c) and, where none of them
 * leads to the target, from a motion that is known, by moving its end (continuation.c). */
#include "core/error.h"
#include "core/vectors.h"
#include "steer/continuation.h"
#include "steer/guess.h"
#include "steer/leaf.h"
#include "steer/reach.h"
#include "steer/vakonomic.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MORE_GUESSES = 8, ROWS_PER_CALL = 8192 };

/* ---- results ---- */

/* Rows of a motion, which begins again at each point; pi_e is added up.  Where a step fails rows
 * after it are NaN, and so is what the whole motion has.  The observer is
 * called between many rows. */
static dal_status fill_rows(const dal__shooting *s, dal_extremal *out)
{
    dal__problem *p = s->problem;
    const int d = p->dimension;
    double *z = s->scratch, values[64];
    double action = 0.0, max_D = 0.0;
    out->S = out->max_D = NAN;
    out->distance = INFINITY;
    for (long long i = 0; i < (p->steps + 1) * d; i++) out->z[i] = NAN;
    for (long long i = 0; i < (p->steps + 1) * p->inputs; i++) out->u[i] = NAN;
    for (int k = 0; k < s->pieces; k++) {
        memcpy(z, s->point + k * d, (size_t)d * sizeof *z);
        for (int i = 0; i < 2 * p->n && k == 0; i++)
            if (!p->is_free[0][i]) z[i] = p->start[i];
        if (p->is_lifted) z[d - 1] = action;
        DAL_TRY(dal_run_set_state(p->run, dal__shooting_time(s, k), z, p->error));
        for (long long row = s->first[k]; row <= s->first[k + 1]; row++) {
            const double *y = dal_run_state(p->run);
            if (row < s->first[k + 1] || k == s->pieces - 1) {
                memcpy(out->z + (size_t)row * (size_t)d, y, (size_t)d * sizeof *z);
                DAL_TRY(dal__problem_inputs(p, dal_run_time(p->run), y,
                                            out->u + row * (long long)p->inputs));
            }
            if (p->is_lifted) action = y[d - 1];
            if (p->constraints + p->holonomic <= 64) {
                DAL_TRY(dal__problem_constraints(p, dal_run_time(p->run), y, values));
                max_D = fmax(max_D, dal__max_abs(values, (size_t)p->constraints));
            }
            if (row == s->first[k + 1]) break;
            if ((row + 1) % ROWS_PER_CALL == 0) DAL_TRY(dal__problem_poll(p));
            if (p->multipliers > 0) DAL_TRY(dal__vakonomic_add_action(p, &action));
            DAL_TRY(dal_run_step(p->run, p->error));
        }
    }
    out->S = p->is_lifted ? p->e * action : action;
    out->max_D = max_D;
    out->distance = 0.0;
    for (int i = 0; i < 2 * p->n; i++)
        if (!p->is_free[1][i])
            out->distance = fmax(out->distance, fabs(dal_run_state(p->run)[i] - p->target[i]));
    return DAL_STATUS_OK;
}

static void explain(const dal__problem *p, const dal_steering *steering, dal_extremal *out)
{
    dal_error record = {.status = out->status};
    if (out->status == DAL_STATUS_OK) return;
    if (out->status == DAL_STATUS_NOT_CONVERGED && !isfinite(out->distance))
        dal__fail(&record, out->status,
                  "no motion was found in %d iterations: along the nearest a step fails; a shorter "
                  "time, smaller steps or a nearer target may help",
                  out->iterations);
    else if (out->status == DAL_STATUS_NOT_CONVERGED && steering->allowed >= 0 &&
             steering->allowed < 2 * p->n - p->integrals)
        dal__fail(&record, out->status,
                  "no motion was found in %d iterations; the nearest is off by %.3g: only %d of "
                  "%d numbers of the end can be reached%s",
                  out->iterations, out->distance, steering->allowed, 2 * p->n,
                  p->knows_leaf ? "" : "; is the target on another leaf?");
    else if (out->status == DAL_STATUS_NOT_CONVERGED)
        dal__fail(&record, out->status,
                  "no motion was found in %d iterations: jumps of %.3g remain; more starts or a "
                  "nearer target may help",
                  out->iterations, out->residual);
    else
        dal__fail(&record, out->status, "%s after %d iterations", dal_status_text(out->status),
                  out->iterations);
    memcpy(out->message, record.message, sizeof out->message);
}

/* Whether two motions have the same coordinates. */
static bool is_same(const dal__problem *p, const dal_steering *s, const double *a, const double *b)
{
    const double same = 1e-6;
    for (long long row = 0; row < s->rows; row++)
        for (int i = 0; i < s->n; i++) {
            const long long at = row * s->dimension + i;
            if (fabs(a[at] - b[at]) > same * (p->unit[i] + fabs(a[at]))) return false;
        }
    return true;
}

static void free_motion(dal_extremal *x)
{
    free(x->z);
    free(x->u);
}

/* Whether a motion is listed before another: those that reach the target by S, then the rest by
 * what remains. */
static bool precedes(const dal_extremal *x, const dal_extremal *other)
{
    const bool is_found = x->status == DAL_STATUS_OK;
    if (is_found != (other->status == DAL_STATUS_OK)) return is_found;
    return is_found ? x->S < other->S : x->residual < other->residual;
}

/* Adds a motion, unless it is there; of more than settings->starts the last is left out. */
static void add_extremal(const dal__problem *p, dal_steering *steering, dal_extremal *x)
{
    dal_extremal *const all = steering->extremal;
    int at = 0;
    for (int i = 0; i < steering->count && x->status == DAL_STATUS_OK; i++)
        if (all[i].status == DAL_STATUS_OK && is_same(p, steering, x->z, all[i].z)) {
            free_motion(x);
            return;
        }
    while (at < steering->count && !precedes(x, &all[at])) at++;
    memmove(all + at + 1, all + at, (size_t)(steering->count - at) * sizeof *x);
    all[at] = *x;
    if (steering->count == p->settings->starts)
        free_motion(&all[steering->count]);
    else
        steering->count++;
}

static bool ends_search(const dal__problem *p, dal_status status)
{
    return status == DAL_STATUS_MEMORY || (status != DAL_STATUS_OK && status == p->stopped);
}

/* Solves from a guess, or by continuation, and adds what comes out, unless the search ends before
 * it is measured.  Errors: DAL_STATUS_MEMORY, what the observer returned. */
static dal_status add_solution(dal__shooting *s, dal_steering *steering,
                               dal_status (*solve)(dal__shooting *, dal__newton_result *))
{
    dal__problem *p = s->problem;
    dal_extremal x = {.status = DAL_STATUS_OK};
    dal__newton_result result = {.residual = INFINITY};
    x.z = dal__numbers((size_t)steering->rows, (size_t)p->dimension);
    x.u = dal__numbers((size_t)steering->rows, (size_t)p->inputs + 1);
    p->iterations = 0;
    x.status = x.z && x.u ? solve(s, &result) : DAL_STATUS_MEMORY;
    dal_status status = x.status == DAL_STATUS_MEMORY ? x.status : dal__reach_measure(s, &x);
    if (x.status != DAL_STATUS_OK && status != DAL_STATUS_MEMORY)
        status = dal__newton_measure(s, &result);
    x.iterations = p->iterations;
    x.condition = result.condition;
    if (!ends_search(p, status)) status = fill_rows(s, &x);
    x.residual = isfinite(x.distance) ? result.residual : INFINITY;
    if (ends_search(p, status)) {
        free_motion(&x);
        return status;
    }
    if (x.status == DAL_STATUS_OK) x.status = status;
    explain(p, steering, &x);
    add_extremal(p, steering, &x);
    return p->stopped;
}

/* Where no guess leads to the target more are made: the straight line alone may be singular, as of
 * a loop, which has no way back to first order. */
static dal_status fill_steering(dal__problem *p, dal_steering *steering)
{
    const int starts = p->settings->starts;
    dal__shooting s = {.problem = p};
    steering->n = p->n;
    steering->dimension = p->dimension;
    steering->inputs = p->inputs;
    steering->rows = p->steps + 1;
    steering->t = dal__numbers(1, (size_t)steering->rows);
    steering->extremal = calloc((size_t)p->settings->starts + 1, sizeof *steering->extremal);
    if (!steering->t || !steering->extremal) return DAL_STATUS_MEMORY;
    for (long long k = 0; k <= p->steps; k++)
        steering->t[k] = k == p->steps ? p->T : p->from + (double)k * p->h;
    DAL_TRY(dal__reach_find(p, steering));
    if (p->observer && p->observer->reach)
        p->stopped = p->observer->reach(p->observer->user, steering);
    dal_status status = p->stopped;
    if (status == DAL_STATUS_OK) status = dal__leaf_check(p, steering);
    if (status == DAL_STATUS_OK) status = dal__shooting_open(&s, p, p->steps, DAL__STEER_PIECES);
    bool is_found = false;
    for (p->guess = 0; status == DAL_STATUS_OK && p->guess < starts + (is_found ? 0 : MORE_GUESSES);
         p->guess++) {
        p->limit = p->settings->iterations;
        status = add_solution(&s, steering, dal__guess_solve);
        is_found = steering->count > 0 && steering->extremal->status == DAL_STATUS_OK;
    }
    if (status == DAL_STATUS_OK && !is_found)
        status = add_solution(&s, steering, dal__continuation_solve);
    dal__shooting_close(&s);
    return status == p->stopped ? DAL_STATUS_OK : status;
}

dal_status dal_steer_create(dal_steering **steering, dal_model *model, const dal_run_spec *spec,
                            double T, const dal_steer_settings *settings,
                            const dal_steer_observer *observer, dal_error *error)
{
    dal__problem problem;
    DAL_REQUIRE(steering, error);
    *steering = NULL;
    dal_status status = dal__problem_open(&problem, model, spec, T, settings, observer, error);
    if (status == DAL_STATUS_OK) status = dal__vakonomic_open(&problem);
    if (status == DAL_STATUS_OK) {
        dal_steering *made = calloc(1, sizeof *made);
        status = made ? fill_steering(&problem, made) : DAL_STATUS_MEMORY;
        if (status == DAL_STATUS_OK)
            *steering = made;
        else
            dal_steer_free(made);
    }
    dal__vakonomic_close(&problem);
    dal__problem_close(&problem);
    return status == DAL_STATUS_MEMORY ? dal__memory_error(error) : status;
}

void dal_steer_free(dal_steering *steering)
{
    if (!steering) return;
    for (int i = 0; i < steering->count; i++) free_motion(&steering->extremal[i]);
    free(steering->extremal);
    free(steering->t);
    free(steering);
}
