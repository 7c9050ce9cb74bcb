/* predict_steps.c - single steps of a method on the exact motion, block by block. */
#include "dynamics/predict_steps.h"
#include "core/error.h"
#include "core/vectors.h"
#include "dynamics/predict_sums.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The prediction of a method that leaves D = 0 is wrong by about defect_constant (h/tau)^p t/tau,
 * relative to the change; its curve ends where that passes defect_allowed. */
static const double defect_constant = 0.4, defect_allowed = 0.02;
/* A displacement, in units, that leaves oscillations in phase to about twice as much. */
static const double in_phase = 0.005;
/* What counts as rounding, in roundings of one step. */
static const double roundings = 64.0;
/* Steps change so little, in the mean of a block, that doubles do not resolve it to a percent. */
static const double resolved = 1e3;
/* Less than this, in roundings of doubles, is nothing. */
static const double negligible = 1e-6;

typedef dal__prediction_work work;
enum { GAUSS = DAL__GAUSS_POINTS };

static long long all_steps(const work *w) { return w->steps * (w->pieces > 0 ? w->pieces : 1); }

/* ---- a block of steps ---- */

/* Notes how far the motion goes in either half. */
static void note_reach(work *w, long long k, const double *x)
{
    double *reach = &w->reach[2 * k >= all_steps(w)];
    for (int i = 0; i < 2 * w->n; i++)
        if (w->general[i]) *reach = fmax(*reach, fabs(x[i]) / w->local.unit[1 + i]);
}

/* Gathers exact states of steps first .. first + count - 1, as many as there are. */
static dal_status gather_states(work *w, long long first, int count, int *made)
{
    const size_t size = 2 * (size_t)w->n;
    for (*made = 0; *made < count; ++*made) {
        const long long k = first + *made;
        double *x = w->x + (size_t)*made * size, *points = w->points + (size_t)*made * size * GAUSS;
        const double t = w->t[*made] = w->of->from + (double)k * w->of->step;
        DAL_TRY(dal__orbit_state(w->orbit, k, 0.0, x, w->error));
        for (int g = 0; g < GAUSS && w->has_points; g++)
            DAL_TRY(
                dal__orbit_state(w->orbit, k, dal__gauss_points[g], points + g * size, w->error));
        note_reach(w, k, x);
        if (k % w->apart == 0 && w->divergences <= DAL__DIVERGENCES)
            w->divergence[w->divergences++] = dal__local_divergence(&w->local, t, x);
        if (w->reversals && dal__reversals_meet(w->reversals, w->orbit, k, t, x, w->even)) {
            dal__reversals_free(w->reversals);
            w->reversals = NULL;
        }
    }
    return DAL_STATUS_OK;
}

/* ---- the first block ---- */

/* The mean |change| of an observable by steps of a block, in roundings. */
static double mean_change(const work *w, int steps, int observable)
{
    double sum = 0.0;
    for (int i = 0; i < steps; i++)
        sum += fabs(w->local_change[(size_t)i * (size_t)w->count + (size_t)observable]);
    return sum / (steps * w->of->predicted[observable].rounding);
}

static void find_defect(work *w, int steps)
{
    for (int i = 0; i < steps && !w->local.enforces_D; i++)
        for (int a = 0; a < w->local.m; a++)
            w->of->leaves_D |= fabs(w->local_change[(size_t)i * (size_t)w->count + (size_t)a]) >
                               roundings * w->of->predicted[a].rounding;
}

/* Takes the steps of the block in quad precision instead where doubles hide what they change of a
 * conserved quantity, and quad precision shows that this is something. */
static dal_status try_quad(work *w, int steps)
{
    dal__local quad;
    const size_t numbers = (size_t)steps * (size_t)w->count;
    double *kept = dal__numbers(1, numbers + 1);
    int made = 0;
    if (!kept) return dal__memory_error(w->error);
    memcpy(kept, w->local_change, numbers * sizeof *kept);
    dal_status status = dal__local_create(&quad, &w->spec, w->run, DAL_QUAD, NULL);
    if (status == DAL_STATUS_OK)
        status = dal__local_steps(&quad, steps, w->t, w->x, w->local_change, &made, NULL);
    for (int j = w->local.m; j < w->count && status == DAL_STATUS_OK; j++)
        w->of->is_quad |= w->hidden[j] && mean_change(w, steps, j) > negligible;
    if (w->of->is_quad) {
        w->local.quad = quad.quad;
        quad.quad = NULL;
    } else {
        memcpy(w->local_change, kept, numbers * sizeof *kept);
    }
    dal__local_free(&quad);
    free(kept);
    return status == DAL_STATUS_MEMORY ? dal__memory_error(w->error) : DAL_STATUS_OK;
}

/* Decides by the first block whether quad precision is needed and where the curve ends. */
static dal_status begin_blocks(work *w, int steps)
{
    dal_prediction *p = w->of;
    bool is_hidden = false;
    for (int i = 0; i < steps; i++) {
        DAL_TRY(
            dal__local_scales(&w->local, w->t[i], w->x + (size_t)i * 2 * (size_t)w->n, w->scale));
        for (int j = 0; j < w->count; j++)
            p->predicted[j].rounding = fmax(p->predicted[j].rounding, DBL_EPSILON * w->scale[j]);
    }
    for (int j = w->local.m; j < w->count; j++) {
        w->hidden[j] = w->conserved[j] && mean_change(w, steps, j) < resolved;
        is_hidden |= w->hidden[j];
    }
    if (is_hidden && all_steps(w) <= w->quad_steps) DAL_TRY(try_quad(w, steps));
    find_defect(w, steps);
    const double tau = p->unit_of_time, h = fabs(p->step);
    const double ratio = pow(h / tau, dal_method_order(&w->spec.method));
    const double end = defect_allowed / (defect_constant * ratio) * tau / h;
    if (!p->leaves_D || !(end < (double)w->whole)) return DAL_STATUS_OK;
    w->steps = (long long)fmax(end, 1.0);
    w->pieces = 0;
    p->reason = DAL_PREDICTION_DEFECT;
    return DAL_STATUS_OK;
}

/* Notes when step k, number i of a block, begins too far from the exact motion for oscillations to
 * be in phase.  Quad precision is for changes that are small beside roundings: it does not matter
 * there. */
static void note_displacement(work *w, long long k, int i)
{
    const size_t size = 2 * (size_t)w->n;
    if (!w->displacement) return;
    if (!w->of->is_quad && k < w->steps &&
        dal__displacement_add(w->displacement, k, w->t[i], w->x + (size_t)i * size,
                              w->local.ends + (size_t)i * size, w->general) <= in_phase)
        return;
    w->of->in_phase = w->of->is_quad || k >= w->steps ? NAN : w->t[i];
    dal__displacement_free(w->displacement);
    w->displacement = NULL;
}

/* A block of steps from number k on; *done of them. */
static dal_status take_block(work *w, long long k, int *done)
{
    const long long rest = all_steps(w) - k;
    int gathered = 0;
    *done = 0;
    const dal_status gathering =
        gather_states(w, k, rest < DAL__LOCAL_STEPS ? (int)rest : DAL__LOCAL_STEPS, &gathered);
    dal_status status = DAL_STATUS_OK;
    if (gathered > 0)
        status = dal__local_steps(&w->local, gathered, w->t, w->x, w->local_change, done, w->error);
    if (k == 0 && *done > 0) DAL_TRY(begin_blocks(w, *done));
    find_defect(w, *done);
    for (int i = 0; i < *done && k + i < all_steps(w); i++) {
        note_displacement(w, k + i, i);
        if (dal__predict_add_step(w, k + i, i) != DAL_STATUS_OK)
            return dal__predict_refuse(
                w, "it leaves D = 0, and the system has no constraint Jacobian");
    }
    w->of->steps += *done;
    return status == DAL_STATUS_OK ? gathering : status;
}

dal_status dal__predict_steps(work *w)
{
    dal_prediction *p = w->of;
    const dal_predict_observer *o = w->observer;
    dal__predict_add_row(w, p->from);
    for (long long k = 0; k < all_steps(w);) {
        int done = 0;
        const dal_status status = take_block(w, k, &done);
        k += done;
        if (status != DAL_STATUS_OK) {
            if (k == 0 || status == DAL_STATUS_MEMORY || status == DAL_STATUS_UNSUPPORTED)
                return status;
            if (p->pieces == 0) p->reason = DAL_PREDICTION_FAILED;
            if (w->error) snprintf(p->message, sizeof p->message, "%s", w->error->message);
            break;
        }
        if (!o || !o->step || o->step(o->user, (double)k / (double)all_steps(w)) == DAL_STATUS_OK)
            continue;
        if (k < w->steps) p->reason = DAL_PREDICTION_INTERRUPTED;
        break;
    }
    if (w->row > 0 && p->t[w->row - 1] != p->end && p->reason != DAL_PREDICTION_TIME)
        dal__predict_add_row(w, p->end);
    return DAL_STATUS_OK;
}
