/* predict.c - the drift of D, E and invariants, predicted from single steps on the exact motion.
 *
 * The sums are in predict_sums.c, the single steps in predict_steps.c, mean rates and walks in
 * predict_rates.c; this file says what cannot be predicted, and prepares the rest. */
#include "analysis/conserved.h"
#include "core/error.h"
#include "core/settings.h"
#include "core/vectors.h"
#include "core/words.h"
#include "dalembert_order.h"
#include "dalembert_predict.h"
#include "dynamics/exact_motion.h"
#include "dynamics/predict_rates.h"
#include "dynamics/predict_steps.h"
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BINS = 1 << 20, CURVE_ROWS = 200, MAX_ROWS = 1 << 24, QUAD_STEPS = 200000 };

typedef dal__prediction_work work;

const char *dal_prediction_end_name(dal_prediction_end end)
{
    DAL__RETURN_WORD(DAL_PREDICTION_END_LIST, DAL__SECOND, end, "?");
}

const char *dal_prediction_end_text(dal_prediction_end end)
{
    DAL__RETURN_WORD(DAL_PREDICTION_END_LIST, DAL__THIRD, end, "?");
}

dal_predict_settings dal_predict_settings_default(void)
{
    return (dal_predict_settings){.rows = CURVE_ROWS, .quad_steps = QUAD_STEPS};
}

void dal_prediction_free(dal_prediction *p)
{
    if (!p) return;
    free(p->predicted);
    free(p->t);
    free(p->change);
    free(p);
}

/* The run that is predicted, on the physical space, where (q, v) have the same bits. */
static dal_status create_run(work *w, const dal_run_spec *spec, const dal_exact_motion *motion)
{
    bool on_D;
    DAL_TRY(dal__create_physical(spec, &w->spec, &w->run, &on_D, w->error));
    if (!on_D) return dal__predict_refuse(w, "p and pi are not 0, and move the motion off D = 0");
    if (!motion || dal__exact_motion_begins(motion, w->run)) return DAL_STATUS_OK;
    return dal__fail(w->error, DAL_STATUS_ARGUMENT,
                     "the exact motion has another start, direction or parameters");
}

/* ---- memory ---- */

static dal_status allocate_work(work *w, long long rows)
{
    const size_t count = (size_t)w->count, size = 2 * (size_t)w->n, block = DAL__LOCAL_STEPS;
    dal_prediction *p = w->of;
    const long long all = w->steps * (w->pieces > 0 ? w->pieces : 1);
    w->steps_of_bin = (all + BINS - 1) / BINS;
    w->bin_count = (all + w->steps_of_bin - 1) / w->steps_of_bin;
    w->apart = all / DAL__DIVERGENCES + 1;
    w->t = dal__numbers(1, block * (1 + size * (1 + DAL__GAUSS_POINTS) + count) + 9 * count +
                               DAL__DIVERGENCES + 1);
    w->bins = dal__numbers((size_t)w->bin_count, count);
    w->even = calloc(2 * count + size + 1, sizeof *w->even);
    w->conserved = calloc(count + 1, sizeof *w->conserved);
    p->predicted = calloc(count + 1, sizeof *p->predicted);
    p->t = dal__numbers(1, (size_t)rows + 1);
    p->change = dal__numbers((size_t)rows + 1, count + 1);
    if (!w->t || !w->bins || !w->even || !w->conserved || !p->predicted || !p->t || !p->change)
        return dal__memory_error(w->error);
    w->hidden = w->even + count;
    w->general = w->hidden + count;
    w->x = w->t + block;
    w->points = w->x + block * size;
    w->local_change = w->points + block * size * DAL__GAUSS_POINTS;
    w->total = w->local_change + block * count;
    w->rest = w->total + count;
    w->half = w->rest + count;
    w->pull = w->half + count;
    w->scale = w->pull + count;
    w->moments = w->scale + count;
    w->increment = w->moments + 3 * count;
    w->divergence = w->increment + count;
    return DAL_STATUS_OK;
}

/* ---- all ---- */

static dal_status begin_prediction(work *w, const dal_run_spec *spec, double T,
                                   const dal_predict_settings *settings)
{
    DAL_TRY(dal__predict_check_method(w));
    const double h = w->spec.options.step;
    if (settings->pieces < 0 || settings->pieces == 1 || settings->pieces > BINS)
        return dal__fail(w->error, DAL_STATUS_ARGUMENT, "%lld pieces are not 0, or 2 to %d",
                         settings->pieces, BINS);
    if (settings->rows < 1 || settings->rows > MAX_ROWS)
        return dal__fail(w->error, DAL_STATUS_ARGUMENT, "%lld rows are not 1 to %d", settings->rows,
                         MAX_ROWS);
    if (settings->quad_steps < 0)
        return dal__fail(w->error, DAL_STATUS_ARGUMENT, "%lld steps in quad precision",
                         settings->quad_steps);
    w->of->from = w->spec.start_time;
    w->whole = w->steps = dal_whole_steps(w->of->from, T, h);
    w->pieces = settings->pieces;
    w->quad_steps = settings->quad_steps;
    w->rows = settings->rows < w->whole ? settings->rows : w->whole;
    if (w->whole == 0 || w->whole > LLONG_MAX / (w->pieces + 1))
        return dal__fail(w->error, DAL_STATUS_ARGUMENT,
                         "from t = %g to %g there is no whole number of steps of %g", w->of->from,
                         T, h);
    if (w->pieces > 0 && w->whole % 2 != 0)
        return dal__fail(w->error, DAL_STATUS_ARGUMENT,
                         "pieces of %lld steps have no middle: the number must be even", w->whole);
    DAL_TRY(create_run(w, spec, settings->motion));
    DAL_TRY(dal__local_create(&w->local, &w->spec, w->run, DAL_DOUBLE, w->error));
    w->n = w->local.n;
    w->count = w->local.count;
    w->has_points = w->local.m > 0 && !w->local.enforces_D;
    if (w->has_points && !w->local.system->call.constraint)
        return dal__predict_refuse(w, "it leaves D = 0 and the system has no constraint callback");
    w->of->to = T;
    w->of->end = w->of->from;
    w->of->in_phase = NAN;
    w->of->step = w->spec.options.step;
    w->of->unit_of_time = w->local.unit[0];
    DAL_TRY(allocate_work(w, w->rows));
    DAL_TRY(dal__find_conserved(&w->spec, w->run, w->conserved, w->error));
    DAL_TRY(dal__orbit_create(&w->orbit, &w->spec, w->run, settings->motion, w->error));
    w->of->has_series = dal__orbit_has_series(w->orbit);
    DAL_TRY(dal__reversals_create(&w->reversals, &w->local, &w->spec, dal_run_time(w->run),
                                  dal_run_state(w->run), w->error));
    DAL_TRY(dal__displacement_create(&w->displacement, &w->local, w->local.unit[0], w->error));
    for (int i = 0; i < w->n; i++) {
        w->general[i] = w->reversals && dal__reversals_depend(w->reversals, i);
        w->general[w->n + i] = true;
    }
    return DAL_STATUS_OK;
}

dal_status dal_predict_create(dal_prediction **prediction, const dal_run_spec *spec, double T,
                              const dal_predict_settings *settings,
                              const dal_predict_observer *observer, dal_error *error)
{
    DAL_REQUIRE(prediction, error);
    *prediction = NULL;
    DAL_TRY(dal__check_spec(spec, error));
    const dal_predict_settings usual = dal_predict_settings_default();
    work w = {.of = calloc(1, sizeof *w.of), .observer = observer, .spec = *spec, .error = error};
    if (!w.of) return dal__memory_error(error);
    dal_status status = begin_prediction(&w, spec, T, settings ? settings : &usual);
    if (status == DAL_STATUS_OK) status = dal__predict_steps(&w);
    if (status == DAL_STATUS_OK) status = dal__predict_results(&w);
    dal__reversals_free(w.reversals);
    dal__displacement_free(w.displacement);
    dal__orbit_free(w.orbit);
    dal__local_free(&w.local);
    dal_run_free(w.run);
    free(w.t);
    free(w.bins);
    free(w.even);
    free(w.conserved);
    if (status == DAL_STATUS_OK)
        *prediction = w.of;
    else
        dal_prediction_free(w.of);
    return status;
}
