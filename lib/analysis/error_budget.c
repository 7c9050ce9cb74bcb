/* error_budget.c - a run and its twins, and what each observable does in them.
 *
 * All are looked at at the same times, at most LOOKS of them, so that their series can be taken
 * from each other.  Quad precision, being slow, are for the first steps alone; there the run, its
 * twin solved further and the same in quad precision go side by side. */
#include "analysis/block_means.h"
#include "analysis/error_shares.h"
#include "analysis/vectors.h"
#include "core/arguments.h"
#include "core/words.h"
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LOOKS = 1 << 15, LONGER = 100 /* times slower, to tell how much is done */ };

static const double looser = 1e-10, looser_by = 1e3;
enum { FURTHER = 2 }; /* sweeps */

typedef struct comparisons {
    dal_error_budget *of;
    const dal_error_budget_observer *observer;
    dal_statistics *series; /* [DAL__SERIES][observables] */
    dal_trend *trends;      /* [DAL__SERIES][observables] */
    double *values;         /* [4][observables] */
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

static bool is_projection(const dal_integrator *link)
{
    return (link->properties & DAL_MODIFIER) && (link->needs & DAL_NEEDS_CONSTRAINT);
}

/* The place of the outermost projection in a method; 0: it has none. */
static int projection_in(const dal_method *method)
{
    for (int k = depth(method) - 1; k > 0; k--)
        if (is_projection(method->layer[k])) return k;
    return 0;
}

/* Takes the projection off a method, or puts one on; why it cannot. */
static const char *project(dal_run_spec *spec)
{
    dal_method *method = &spec->method, projected;
    const int place = projection_in(method), end = depth(method);
    if (place > 0) {
        for (int k = place; k < DAL_LAYERS; k++)
            method->layer[k] = k + 1 < end ? method->layer[k + 1] : NULL;
        return NULL;
    }
    if (spec->system->m == 0) return "there is no constraint";
    if (end == DAL_LAYERS) return "the method has no room for one more modifier";
    if (dal_method_parse(&projected, "rk4+project", NULL) != DAL_OK) return "there is no +project";
    method->layer[end] = projected.layer[1];
    return NULL;
}

/* Makes the spec of a run that of a twin; why there is none, NULL: there is. */
static const char *become(dal_run_spec *spec, dal_comparison_run comparison)
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
        return project(spec);
    case DAL_COMPARISON_QUAD:
        o->precision = DAL_QUAD;
        break;
    case DAL_COMPARISON_QUAD_HALVED:
        o->precision = DAL_QUAD; /* and */
        o->step *= 0.5;
        break;
    case DAL_COMPARISON_HALVED:
        o->step *= 0.5;
        return NULL;
    default:
        break;
    }
    o->solver_tolerance = 0.0;
    o->extra_iterations += FURTHER;
    return comparison == DAL_COMPARISON_TIGHTER && !solves(spec) ? nothing : NULL;
}

/* ---- going ---- */

static dal_status tell(comparisons *w, double work)
{
    const dal_error_budget_observer *o = w->observer;
    w->done += work;
    if (!o || !o->step) return DAL_OK;
    const dal_status status = o->step(o->user, fmin(w->done / w->work, 1.0));
    if (status == DAL_OK) return DAL_OK;
    return dal__fail(w->error, status, "%s", dal_status_text(status));
}

static dal_statistics *series(const comparisons *w, int which)
{
    return w->series + (size_t)which * (size_t)w->of->observables;
}

static dal_status create(comparisons *w, const dal_run_spec *spec, long long steps, dal_run **run,
                         dal_error *error)
{
    DAL_TRY(dal_run_create(run, spec, error));
    const dal_error_budget_observer *o = w->observer;
    if (o && o->begin && spec->options.precision == DAL_DOUBLE) o->begin(o->user, *run, steps);
    return DAL_OK;
}

/* Steps between two looks at a run of so many. */
static long long stride_of(long long steps) { return (steps + LOOKS - 1) / LOOKS; }

/* Follows a run that takes `per` steps for each step of the explained one. */
static dal_status follow(comparisons *w, dal_run *run, int which, int per, dal_error *error)
{
    const long long steps = w->of->steps, stride = stride_of(steps);
    const int count = w->of->observables;
    for (long long at = 0; at <= steps; at += stride) {
        if (at > 0) DAL_TRY(dal_run_advance(run, stride * per, error));
        DAL_TRY(dal_run_observe(run, w->values));
        dal_statistics_add(series(w, which), count, (double)at * w->of->spec.options.step,
                           w->values);
        if (tell(w, (double)(stride * per)) != DAL_OK) return DAL_INTERRUPTED;
    }
    return DAL_OK;
}

/* The observables of a twin are those of the run, so one with others cannot be compared. */
static bool is_like(const comparisons *w, const dal_run *run)
{
    return dal_run_observables(run) == w->of->observables;
}

static void give_up(comparisons *w, dal_comparison_run comparison, const char *reason)
{
    snprintf(w->of->reason[comparison], sizeof w->of->reason[comparison], "%s", reason);
}

/* An interruption and a lack of memory end all of it; any other failure is that of one run. */
static bool ends_all(const comparisons *w, dal_status status, const dal_error *error)
{
    if (status == DAL_MEMORY && w->error) *w->error = *error;
    return status == DAL_INTERRUPTED || status == DAL_MEMORY;
}

/* A twin along all steps. */
static dal_status run_comparison(comparisons *w, dal_comparison_run comparison)
{
    dal_run_spec spec = w->of->spec;
    dal_run *run = NULL;
    dal_error error = {0};
    const int per = comparison == DAL_COMPARISON_HALVED ? 2 : 1;
    const char *fault = become(&spec, comparison);
    if (fault) return give_up(w, comparison, fault), DAL_OK;
    dal_status status = create(w, &spec, w->of->steps * per, &run, &error);
    if (status == DAL_OK && !is_like(w, run)) {
        give_up(w, comparison, "it has other observables");
        return dal_run_free(run), DAL_OK;
    }
    if (status == DAL_OK) status = follow(w, run, 1 + (int)comparison, per, &error);
    dal_run_free(run);
    w->of->ran[comparison] = status == DAL_OK;
    if (ends_all(w, status, &error)) return status;
    if (status != DAL_OK) give_up(w, comparison, error.message);
    return DAL_OK;
}

/* ---- side by side ---- */

/* The run; solved further; in quad precision; those with half the step. */
enum { RUN, TIGHT, LONG, HALF, ABREAST };

static void add_beginning(comparisons *w, double t)
{
    const int count = w->of->observables;
    double *run = w->values, *tight = run + count, *quad = tight + count, *half = quad + count;
    dal_statistics_add(series(w, DAL__FIRST_RUN), count, t, run);
    dal_statistics_add(series(w, 1 + DAL_COMPARISON_QUAD), count, t, quad);
    dal_statistics_add(series(w, 1 + DAL_COMPARISON_QUAD_HALVED), count, t, half);
    for (int i = 0; i < count; i++) {
        const double all = run[i] - quad[i];
        run[i] -= tight[i];
        tight[i] -= quad[i];
        quad[i] = all;
    }
    dal_statistics_add(series(w, DAL__FIRST_SOLVER), count, t, run);
    dal_statistics_add(series(w, DAL__FIRST_ROUNDING), count, t, tight);
    dal_statistics_add(series(w, DAL__FIRST_SOLVER_AND_ROUNDING), count, t, quad);
}

static dal_status advance_abreast(comparisons *w, dal_run **run, long long stride, dal_error *error)
{
    for (int k = 0; k < ABREAST; k++) {
        if (stride > 0) DAL_TRY(dal_run_advance(run[k], k == HALF ? 2 * stride : stride, error));
        DAL_TRY(dal_run_observe(run[k], w->values + k * w->of->observables));
    }
    return DAL_OK;
}

static dal_status follow_abreast(comparisons *w, dal_run **run, dal_error *error)
{
    const long long steps = w->of->quad_steps, stride = stride_of(steps);
    for (long long at = 0; at <= steps; at += stride) {
        DAL_TRY(advance_abreast(w, run, at > 0 ? stride : 0, error));
        add_beginning(w, (double)at * w->of->spec.options.step);
        if (tell(w, 3.0 * LONGER * (double)stride) != DAL_OK) return DAL_INTERRUPTED;
    }
    return DAL_OK;
}

static dal_status run_beginning(comparisons *w)
{
    static const dal_comparison_run comparison[] = {
        DAL_COMPARISONS, DAL_COMPARISON_TIGHTER, DAL_COMPARISON_QUAD, DAL_COMPARISON_QUAD_HALVED};
    dal_run *run[ABREAST] = {NULL};
    dal_error error = {0};
    dal_status status = DAL_OK;
    for (int k = 0; k < ABREAST && status == DAL_OK; k++) {
        dal_run_spec spec = w->of->spec;
        if (k != RUN) become(&spec, comparison[k]);
        status = create(w, &spec, w->of->quad_steps, &run[k], &error);
    }
    if (status == DAL_OK) status = follow_abreast(w, run, &error);
    for (int k = 0; k < ABREAST; k++) dal_run_free(run[k]);
    const int ran = status == DAL_OK;
    w->of->ran[DAL_COMPARISON_QUAD] = w->of->ran[DAL_COMPARISON_QUAD_HALVED] = ran;
    if (ends_all(w, status, &error)) return status;
    if (ran) return DAL_OK;
    give_up(w, DAL_COMPARISON_QUAD, error.message);
    give_up(w, DAL_COMPARISON_QUAD_HALVED, error.message);
    w->of->quad_steps = 0;
    return DAL_OK;
}

/* ---- the whole ---- */

static const dal_trend *trend_of(const comparisons *w, int which, int i)
{
    return w->trends + (size_t)which * (size_t)w->of->observables + i;
}

/* Rates of parts add up to that of the whole, so they are those of least squares, which are linear
 * in the values. */
static void use_linear_rates(const comparisons *w, int which)
{
    for (int i = 0; i < w->of->observables; i++) {
        dal_trend *const f = w->trends + (size_t)which * (size_t)w->of->observables + i;
        dal_trend line = *f;
        dal__trend_line(series(w, which) + i, &line);
        f->rate = line.rate;
        f->rate_low = fmin(f->rate_low, line.rate);
        f->rate_high = fmax(f->rate_high, line.rate);
    }
}

static void classify_all(comparisons *w, const dal_run *run)
{
    static const int parts[] = {DAL__FIRST_RUN,          DAL__FIRST_ROUNDING,
                                DAL__FIRST_SOLVER,       DAL__FIRST_SOLVER_AND_ROUNDING,
                                1 + DAL_COMPARISON_QUAD, 1 + DAL_COMPARISON_QUAD_HALVED};
    for (int which = 0; which < DAL__SERIES; which++)
        if (w->of->observables > 0 && series(w, which)->count > 0)
            dal_run_classify(run, series(w, which), 0,
                             w->trends + (size_t)which * (size_t)w->of->observables);
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) use_linear_rates(w, parts[i]);
    for (int i = 0; i < w->of->observables; i++) {
        dal_shares *a = &w->of->shares[i];
        a->whole = *trend_of(w, DAL__WHOLE_RUN, i);
        for (int k = 0; k < DAL_COMPARISONS; k++)
            if (w->of->ran[k]) a->comparison[k] = *trend_of(w, 1 + k, i);
        if (w->of->quad_steps > 0) {
            a->beginning = *trend_of(w, DAL__FIRST_RUN, i);
            a->rounding = *trend_of(w, DAL__FIRST_ROUNDING, i);
            a->solver = *trend_of(w, DAL__FIRST_SOLVER, i);
            a->solver_and_rounding = *trend_of(w, DAL__FIRST_SOLVER_AND_ROUNDING, i);
        }
        dal__find_shares(w->of, a);
    }
}

static dal_status allocate(comparisons *w, const dal_run *run)
{
    const int count = dal_run_observables(run);
    const size_t room = count > 0 ? (size_t)count : 1;
    w->of->observables = count;
    w->of->shares = calloc(room, sizeof *w->of->shares);
    w->series = calloc(room * DAL__SERIES, sizeof *w->series);
    w->trends = calloc(room * DAL__SERIES, sizeof *w->trends);
    w->values = dal__numbers(room, ABREAST);
    if (!w->of->shares || !w->series || !w->trends || !w->values)
        return dal__fail(w->error, DAL_MEMORY, "out of memory");
    for (int i = 0; i < count; i++)
        dal_run_observable_name(run, i, w->of->shares[i].name, sizeof w->of->shares[i].name);
    dal_statistics_start(w->series, count * DAL__SERIES);
    return DAL_OK;
}

static dal_status run_all(comparisons *w)
{
    dal_run *run;
    DAL_TRY(create(w, &w->of->spec, w->of->steps, &run, w->error));
    dal_status status = allocate(w, run);
    if (status == DAL_OK) status = follow(w, run, DAL__WHOLE_RUN, 1, w->error);
    for (int k = 0; k < DAL_COMPARISON_QUAD && status == DAL_OK; k++)
        status = run_comparison(w, (dal_comparison_run)k);
    if (status == DAL_OK && w->of->quad_steps > 0) status = run_beginning(w);
    if (status == DAL_OK) classify_all(w, run);
    dal_run_free(run);
    return status;
}

dal_status dal_error_budget_create(const dal_run_spec *spec, long long steps, long long quad_steps,
                                   const dal_error_budget_observer *observer,
                                   dal_error_budget **budget, dal_error *error)
{
    DAL_REQUIRE(budget, error);
    *budget = NULL;
    DAL_TRY(dal__check_spec(spec, error));
    if (steps < 1 || quad_steps < 0)
        return dal__fail(error, DAL_ARGUMENT, "%lld steps, %lld of them in quad precision", steps,
                         quad_steps);
    if (spec->options.precision != DAL_DOUBLE)
        return dal__fail(error, DAL_ARGUMENT,
                         "a run in doubles is explained, by quad precision among others");
    dal_error_budget *made = calloc(1, sizeof *made);
    if (!made) return dal__fail(error, DAL_MEMORY, "out of memory");
    made->spec = *spec;
    made->steps = steps / stride_of(steps) * stride_of(steps);
    quad_steps = quad_steps < made->steps ? quad_steps : made->steps;
    made->quad_steps =
        quad_steps > 0 ? quad_steps / stride_of(quad_steps) * stride_of(quad_steps) : 0;
    made->has_projection = projection_in(&spec->method) > 0;
    if (made->quad_steps == 0)
        snprintf(made->reason[DAL_COMPARISON_QUAD], DAL_MESSAGE_SIZE, "not asked for");
    comparisons w = {.of = made, .observer = observer, .error = error};
    w.work =
        (DAL_COMPARISON_QUAD + 2.0) * (double)made->steps + 3.0 * LONGER * (double)made->quad_steps;
    const dal_status status = run_all(&w);
    free(w.series);
    free(w.trends);
    free(w.values);
    if (status == DAL_OK)
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
