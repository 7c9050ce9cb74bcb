/* error_budget.c - a run, the runs it is compared with, and the trends of their observables.
 *
 * All are sampled at the same times, at most SAMPLES of them, so that their series can be
 * subtracted.  Quad precision is slow and covers the first steps alone; there the run, the same
 * solved further, and both step sizes in quad precision advance together. */
#include "analysis/conserved.h"
#include "analysis/error_shares.h"
#include "analysis/reference.h"
#include "core/error.h"
#include "core/settings.h"
#include "core/vectors.h"
#include "core/words.h"
#include "statistics/statistics.h"
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SAMPLES = 1 << 15, QUAD_COST = 100 /* in double steps, for progress */ };

static const double looser = 1e-10, looser_by = 1e3;
enum { FURTHER = 2 }; /* iterations */

typedef struct comparisons {
    dal_error_budget *of;
    const dal_error_budget_observer *observer;
    dal_statistics *series; /* [DAL__COMPARED_SERIES][observables] */
    dal_trend *trends;      /* [DAL__COMPARED_SERIES][observables] */
    double *values;         /* [TOGETHER + 1][observables] */
    bool *conserved;        /* [observables] */
    double work, done;
    dal_error *error;
} comparisons;

const char *dal_comparison_name(dal_comparison_run comparison)
{
    DAL__RETURN_WORD(DAL_COMPARISON_LIST, DAL__SECOND, comparison, "?");
}

const char *dal_comparison_text(dal_comparison_run comparison)
{
    DAL__RETURN_WORD(DAL_COMPARISON_LIST, DAL__THIRD, comparison, "?");
}

/* ---- the specs ---- */

static bool solves(const dal_run_spec *spec)
{
    return !(dal_method_properties(&spec->method) & DAL_EXPLICIT) || spec->method.layer[1];
}

static int depth(const dal_method *method)
{
    int k = 0;
    while (k < DAL_LAYERS && method->layer[k]) k++;
    return k;
}

/* The place of the outermost projection in a method; 0: it has none. */
static int projection_in(const dal_method *method)
{
    for (int k = depth(method) - 1; k > 0; k--)
        if ((method->layer[k]->properties & DAL_MODIFIER) &&
            (method->layer[k]->needs & DAL_NEEDS_CONSTRAINT))
            return k;
    return 0;
}

/* Removes the projection of a method, or adds one; NULL, or the reason why it cannot. */
static const char *change_projection(dal_run_spec *spec)
{
    dal_method *method = &spec->method;
    const int place = projection_in(method), end = depth(method);
    if (place > 0) {
        for (int k = place; k < DAL_LAYERS; k++)
            method->layer[k] = k + 1 < end ? method->layer[k + 1] : NULL;
        return NULL;
    }
    if (spec->system->m == 0) return "there is no constraint";
    if (end == DAL_LAYERS) return "the method has no room for one more modifier";
    method->layer[end] = dal__library_method("rk4+project").layer[1];
    return NULL;
}

/* Under a tolerance, substeps become half as long where it is divided by 2^p. */
static void halve(dal_run_spec *spec)
{
    dal_options *o = &spec->options;
    o->step *= 0.5;
    o->tolerance = ldexp(o->tolerance, -dal_method_order(&spec->method));
}

/* Turns the spec of a run into the spec of a comparison; NULL, or the reason why there is none. */
static const char *change_spec(dal_run_spec *spec, dal_comparison_run comparison)
{
    static const char nothing[] = "the method solves no equations";
    dal_options *o = &spec->options;
    switch (comparison) {
    case DAL_COMPARISON_LOOSER:
        o->extra_iterations = 0;
        o->solver_tolerance = fmin(fmax(looser_by * o->solver_tolerance, looser), 1.0);
        return solves(spec) ? NULL : nothing;
    case DAL_COMPARISON_SUMS:
        o->sums = o->sums == DAL_SUMS_PLAIN ? DAL_SUMS_COMPENSATED : DAL_SUMS_PLAIN;
        return NULL;
    case DAL_COMPARISON_PROJECTION:
        return change_projection(spec);
    case DAL_COMPARISON_QUAD:
        o->precision = DAL_QUAD;
        break;
    case DAL_COMPARISON_QUAD_HALVED:
        o->precision = DAL_QUAD;
        halve(spec);
        break;
    case DAL_COMPARISON_HALVED:
        halve(spec);
        return NULL;
    default:
        break;
    }
    o->solver_tolerance = 0.0;
    o->extra_iterations += FURTHER;
    return comparison == DAL_COMPARISON_TIGHTER && !solves(spec) ? nothing : NULL;
}

/* ---- runs along all steps ---- */

static dal_status report_progress(comparisons *w, double work)
{
    const dal_error_budget_observer *o = w->observer;
    w->done += work;
    if (!o || !o->step) return DAL_STATUS_OK;
    const dal_status status = o->step(o->user, fmin(w->done / w->work, 1.0));
    return status == DAL_STATUS_OK ? status
                                   : dal__fail(w->error, status, "%s", dal_status_text(status));
}

static dal_statistics *series(const comparisons *w, int which)
{
    return w->series + (size_t)which * (size_t)w->of->observables;
}

static dal_trend *trends(const comparisons *w, int which)
{
    return w->trends + (size_t)which * (size_t)w->of->observables;
}

static dal_status create(comparisons *w, const dal_run_spec *spec, long long steps, dal_run **run,
                         dal_error *error)
{
    DAL_TRY(dal_run_create(run, spec, error));
    const dal_error_budget_observer *o = w->observer;
    if (o && o->begin && spec->options.precision == DAL_DOUBLE) o->begin(o->user, *run, steps);
    return DAL_STATUS_OK;
}

/* Steps between two samples of a run. */
static long long stride_of(long long steps) { return (steps + SAMPLES - 1) / SAMPLES; }

static dal_status observe(dal_run *run, double *values, dal_error *error)
{
    const dal_status status = dal_run_observe(run, values);
    if (status == DAL_STATUS_OK) return DAL_STATUS_OK;
    return dal__fail(error, status, "the observables at t = %.17g: %s", dal_run_time(run),
                     dal_status_text(status));
}

static void add_values(comparisons *w, int which, double t, const double *values,
                       const double *scales)
{
    dal_statistics_add(series(w, which), w->of->observables, t, values);
    dal_statistics_add_scales(series(w, which), w->of->observables, scales);
}

/* Adds what is observed of a run after `at` steps of the first one; work: steps since the last. */
static dal_status add_sample(comparisons *w, dal_run *run, int which, long long at, long long work,
                             dal_error *error)
{
    DAL_TRY(observe(run, w->values, error));
    add_values(w, which, (double)at * w->of->spec.options.step, w->values, dal_run_scales(run));
    const dal_status status = report_progress(w, (double)work);
    return status == DAL_STATUS_OK ? status : DAL_STATUS_INTERRUPTED;
}

/* Samples a run that takes `per` steps for each step of the first one. */
static dal_status sample_run(comparisons *w, dal_run *run, int which, int per, dal_error *error)
{
    const long long stride = stride_of(w->of->steps);
    for (long long at = 0; at <= w->of->steps; at += stride) {
        if (at > 0) DAL_TRY(dal_run_advance(run, stride * per, error));
        DAL_TRY(add_sample(w, run, which, at, stride * per, error));
    }
    return DAL_STATUS_OK;
}

static dal_status sample_reference(comparisons *w, dal__reference *reference, dal_error *error)
{
    const long long stride = stride_of(w->of->steps);
    dal_run *run = dal__reference_run(reference);
    for (long long at = 0; at <= w->of->steps; at += stride) {
        if (at > 0) DAL_TRY(dal__reference_advance(reference, stride, error));
        DAL_TRY(add_sample(w, run, 1 + DAL_COMPARISON_EXACT, at, stride, error));
    }
    return DAL_STATUS_OK;
}

static void leave_out(comparisons *w, dal_comparison_run comparison, const char *reason)
{
    snprintf(w->of->reason[comparison], sizeof w->of->reason[comparison], "%s", reason);
}

/* An interruption and a lack of memory end all of it; any other failure concerns one run only. */
static bool ends_all(const comparisons *w, dal_status status, const dal_error *error)
{
    if (status == DAL_STATUS_MEMORY && w->error) *w->error = *error;
    return status == DAL_STATUS_INTERRUPTED || status == DAL_STATUS_MEMORY;
}

/* Notes whether a comparison ran to its end. */
static dal_status end_comparison(comparisons *w, dal_comparison_run comparison, dal_status status,
                                 const dal_error *error)
{
    w->of->ran[comparison] = status == DAL_STATUS_OK;
    if (ends_all(w, status, error)) return status;
    if (status != DAL_STATUS_OK) leave_out(w, comparison, error->message);
    return DAL_STATUS_OK;
}

static dal_status run_comparison(comparisons *w, dal_comparison_run comparison)
{
    dal_run_spec spec = w->of->spec;
    dal_run *run = NULL;
    dal_error error = {0};
    const int per = comparison == DAL_COMPARISON_HALVED ? 2 : 1;
    const char *reason = change_spec(&spec, comparison);
    if (reason) return leave_out(w, comparison, reason), DAL_STATUS_OK;
    dal_status status = create(w, &spec, w->of->steps * per, &run, &error);
    if (status == DAL_STATUS_OK && dal_run_observables(run) != w->of->observables) {
        leave_out(w, comparison, "it has other observables");
        return dal_run_free(run), DAL_STATUS_OK;
    }
    if (status == DAL_STATUS_OK) status = sample_run(w, run, 1 + (int)comparison, per, &error);
    dal_run_free(run);
    return end_comparison(w, comparison, status, &error);
}

static dal_status run_reference(comparisons *w)
{
    dal__reference *reference = NULL;
    dal_error error = {0};
    dal_status status = dal__reference_create(&reference, &w->of->spec, &error);
    if (status == DAL_STATUS_OK) status = sample_reference(w, reference, &error);
    if (status == DAL_STATUS_OK) w->of->exact_steps = dal__reference_steps(reference);
    dal__reference_free(reference);
    return end_comparison(w, DAL_COMPARISON_EXACT, status, &error);
}

/* ---- the beginning ---- */

/* The run; solved further; in quad precision; the same with half the step. */
enum { RUN, TIGHT, QUAD, HALF, TOGETHER };

static bool is_of_beginning(int which)
{
    return which >= DAL__FIRST_RUN || which == 1 + DAL_COMPARISON_QUAD ||
           which == 1 + DAL_COMPARISON_QUAD_HALVED;
}

typedef struct beginning {
    dal_run *run[TOGETHER];
    dal__reference *exact; /* NULL: none */
} beginning;

static void subtract(int count, const double *x, const double *y, double *out)
{
    for (int i = 0; i < count; i++) out[i] = x[i] - y[i];
}

/* values: of the runs in their order, and of the exact motion.  Differences have the scales of the
 * run, too. */
static void add_beginning(comparisons *w, double t, const double *scales, bool is_exact)
{
    const int count = w->of->observables;
    double *run = w->values, *tight = run + count, *quad = tight + count, *half = quad + count,
           *exact = half + count;
    add_values(w, DAL__FIRST_RUN, t, run, scales);
    add_values(w, 1 + DAL_COMPARISON_QUAD, t, quad, scales);
    add_values(w, 1 + DAL_COMPARISON_QUAD_HALVED, t, half, scales);
    if (is_exact) {
        add_values(w, DAL__FIRST_MOTION, t, exact, scales);
        subtract(count, half, exact, half);
        add_values(w, DAL__FIRST_ERROR_HALVED, t, half, scales);
        subtract(count, quad, exact, exact);
        add_values(w, DAL__FIRST_ERROR, t, exact, scales);
    }
    subtract(count, run, quad, half);
    add_values(w, DAL__FIRST_SOLVER_AND_ROUNDING, t, half, scales);
    subtract(count, run, tight, run);
    add_values(w, DAL__FIRST_SOLVER, t, run, scales);
    subtract(count, tight, quad, tight);
    add_values(w, DAL__FIRST_ROUNDING, t, tight, scales);
}

static dal_status sample_beginning(comparisons *w, const beginning *b, dal_error *error)
{
    const long long steps = w->of->quad_steps, stride = stride_of(steps);
    const int count = w->of->observables;
    for (long long at = 0; at <= steps; at += stride) {
        for (int k = 0; k < TOGETHER; k++) {
            if (at > 0) DAL_TRY(dal_run_advance(b->run[k], k == HALF ? 2 * stride : stride, error));
            DAL_TRY(observe(b->run[k], w->values + k * count, error));
        }
        if (b->exact && at > 0) DAL_TRY(dal__reference_advance(b->exact, stride, error));
        if (b->exact)
            DAL_TRY(dal_run_observe(dal__reference_run(b->exact), w->values + TOGETHER * count));
        add_beginning(w, (double)at * w->of->spec.options.step, dal_run_scales(b->run[RUN]),
                      b->exact != NULL);
        if (report_progress(w, 3.0 * QUAD_COST * (double)stride) != DAL_STATUS_OK)
            return DAL_STATUS_INTERRUPTED;
    }
    return DAL_STATUS_OK;
}

static dal_status run_beginning(comparisons *w)
{
    static const dal_comparison_run comparison[] = {
        DAL_COMPARISONS, DAL_COMPARISON_TIGHTER, DAL_COMPARISON_QUAD, DAL_COMPARISON_QUAD_HALVED};
    beginning b = {.exact = NULL};
    dal_error error = {0};
    dal_status status = DAL_STATUS_OK;
    for (int k = 0; k < TOGETHER && status == DAL_STATUS_OK; k++) {
        dal_run_spec spec = w->of->spec;
        if (k != RUN) change_spec(&spec, comparison[k]);
        status = create(w, &spec, w->of->quad_steps, &b.run[k], &error);
    }
    if (status == DAL_STATUS_OK && w->of->ran[DAL_COMPARISON_EXACT])
        status = dal__reference_create(&b.exact, &w->of->spec, &error);
    if (status == DAL_STATUS_OK) status = sample_beginning(w, &b, &error);
    for (int k = 0; k < TOGETHER; k++) dal_run_free(b.run[k]);
    dal__reference_free(b.exact);
    const bool ran = status == DAL_STATUS_OK;
    w->of->ran[DAL_COMPARISON_QUAD] = w->of->ran[DAL_COMPARISON_QUAD_HALVED] = ran;
    if (ends_all(w, status, &error)) return status;
    if (ran) return DAL_STATUS_OK;
    leave_out(w, DAL_COMPARISON_QUAD, error.message);
    leave_out(w, DAL_COMPARISON_QUAD_HALVED, error.message);
    w->of->quad_steps = 0;
    return DAL_STATUS_OK;
}

/* ---- the whole ---- */

/* Rates of parts add up to the rate of the whole, so they are rates of least squares, which are
 * linear in the values. */
static double rate_of_line(const comparisons *w, int which, int i)
{
    dal_trend line = trends(w, which)[i];
    dal__trend_line(series(w, which) + i, &line);
    return line.rate;
}

static void make_rates_linear(comparisons *w)
{
    for (int which = 0; which < DAL__COMPARED_SERIES; which++)
        for (int i = 0; i < w->of->observables && is_of_beginning(which); i++) {
            dal_trend *const f = trends(w, which) + i;
            f->rate = rate_of_line(w, which, i);
            f->rate_low = fmin(f->rate_low, f->rate);
            f->rate_high = fmax(f->rate_high, f->rate);
        }
}

static void collect_trends(const comparisons *w, int i, dal_shares *s)
{
    s->whole = trends(w, DAL__WHOLE_RUN)[i];
    s->is_conserved = w->conserved[i];
    for (int k = 0; k < DAL_COMPARISONS; k++)
        if (w->of->ran[k]) s->comparison[k] = trends(w, 1 + k)[i];
    if (w->of->quad_steps == 0) return;
    s->beginning = trends(w, DAL__FIRST_RUN)[i];
    s->rounding = trends(w, DAL__FIRST_ROUNDING)[i];
    s->solver = trends(w, DAL__FIRST_SOLVER)[i];
    s->solver_and_rounding = trends(w, DAL__FIRST_SOLVER_AND_ROUNDING)[i];
    s->motion = trends(w, DAL__FIRST_MOTION)[i];
    s->error = trends(w, DAL__FIRST_ERROR)[i];
    s->error_halved = trends(w, DAL__FIRST_ERROR_HALVED)[i];
}

static void find_shares(comparisons *w, dal_run *run)
{
    for (int which = 0; which < DAL__COMPARED_SERIES; which++)
        if (w->of->observables > 0 && series(w, which)->count > 0)
            dal_run_classify(run, series(w, which), DAL_STATUS_OK, trends(w, which));
    make_rates_linear(w);
    for (int i = 0; i < w->of->observables; i++) {
        double rate[1 + DAL_COMPARISONS];
        for (int which = 0; which <= DAL_COMPARISONS; which++)
            rate[which] = rate_of_line(w, which, i);
        collect_trends(w, i, &w->of->shares[i]);
        dal__find_shares(w->of, &w->of->shares[i], rate);
    }
}

static dal_status allocate(comparisons *w, const dal_run *run)
{
    const int count = dal_run_observables(run);
    const size_t rows = count > 0 ? (size_t)count : 1;
    w->of->observables = count;
    w->of->shares = calloc(rows, sizeof *w->of->shares);
    w->series = calloc(rows * DAL__COMPARED_SERIES, sizeof *w->series);
    w->trends = calloc(rows * DAL__COMPARED_SERIES, sizeof *w->trends);
    w->values = dal__numbers(rows, TOGETHER + 1);
    w->conserved = calloc(rows, sizeof *w->conserved);
    if (!w->of->shares || !w->series || !w->trends || !w->values || !w->conserved)
        return dal__memory_error(w->error);
    for (int i = 0; i < count; i++)
        dal_run_observable_name(run, i, w->of->shares[i].name, sizeof w->of->shares[i].name);
    dal_statistics_start(w->series, count * DAL__COMPARED_SERIES);
    return DAL_STATUS_OK;
}

static dal_status run_all(comparisons *w)
{
    dal_run *run;
    DAL_TRY(create(w, &w->of->spec, w->of->steps, &run, w->error));
    dal_status status = allocate(w, run);
    if (status == DAL_STATUS_OK)
        status = dal__find_conserved(&w->of->spec, run, w->conserved, w->error);
    if (status == DAL_STATUS_OK) status = sample_run(w, run, DAL__WHOLE_RUN, 1, w->error);
    /* The observer may use the run that was begun last: here `run`. */
    if (status == DAL_STATUS_OK) status = run_reference(w);
    for (int k = 0; k < DAL_COMPARISON_EXACT && status == DAL_STATUS_OK; k++)
        status = run_comparison(w, (dal_comparison_run)k);
    if (status == DAL_STATUS_OK && w->of->quad_steps > 0) status = run_beginning(w);
    if (status == DAL_STATUS_OK) find_shares(w, run);
    dal_run_free(run);
    return status;
}

dal_status dal_error_budget_create(dal_error_budget **budget, const dal_run_spec *spec,
                                   long long steps, long long quad_steps,
                                   const dal_error_budget_observer *observer, dal_error *error)
{
    DAL_REQUIRE(budget, error);
    *budget = NULL;
    DAL_TRY(dal__check_spec(spec, error));
    DAL_TRY(dal__refuse_events(spec->system, "error budgets", error));
    if (steps < 1 || quad_steps < 0)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "%lld steps, %lld of them in quad precision",
                         steps, quad_steps);
    if (spec->options.precision != DAL_DOUBLE)
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "an error budget needs a run in doubles; quad precision is one of "
                         "its comparisons");
    dal_error_budget *made = calloc(1, sizeof *made);
    if (!made) return dal__memory_error(error);
    made->spec = *spec;
    made->steps = steps / stride_of(steps) * stride_of(steps);
    quad_steps = quad_steps < made->steps ? quad_steps : made->steps;
    made->quad_steps =
        quad_steps > 0 ? quad_steps / stride_of(quad_steps) * stride_of(quad_steps) : 0;
    made->has_projection = projection_in(&spec->method) > 0;
    if (made->quad_steps == 0)
        snprintf(made->reason[DAL_COMPARISON_QUAD], DAL_MESSAGE_SIZE, "not requested");
    comparisons w = {.of = made, .observer = observer, .error = error};
    w.work = (DAL_COMPARISON_QUAD + 2.0) * (double)made->steps +
             3.0 * QUAD_COST * (double)made->quad_steps;
    const dal_status status = run_all(&w);
    free(w.series);
    free(w.trends);
    free(w.values);
    free(w.conserved);
    if (status == DAL_STATUS_OK)
        *budget = made;
    else
        dal_error_budget_free(made);
    return status;
}

void dal_error_budget_free(dal_error_budget *budget)
{
    if (!budget) return;
    free(budget->shares);
    free(budget);
}
