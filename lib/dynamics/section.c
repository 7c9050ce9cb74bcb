/* section.c - Poincare sections: where a run crosses g(q,v,t) = 0, found by lib/run/crossing.c. */
#include "analysis/differences.h"
#include "analysis/scaled.h"
#include "core/error.h"
#include "core/settings.h"
#include "core/vectors.h"
#include "dalembert_dynamics.h"
#include "dalembert_order.h"
#include "run/crossing.h"
#include "run/observe.h"
#include <float.h>
#include <stdlib.h>

/* A minimum of |g| below this fraction of max |g| is a touch; rounding errors are far smaller. */
static const double touching = 1e-12;
/* Roundings of its terms that |g| may consist of, where they cancel. */
static const double roundings = 64.0;

/* After this number of steps the motion has changed as a whole. */
static const double many_steps = 100.0;

enum { POLL = 1000 };

typedef struct search {
    const dal_poincare *section;
    dal_crossings *found;
    dal_error *error;
    dal_evaluator *evaluator;
    dal__zero_search zeros;
    double *values; /* [count] of the callback */
    double max_g;   /* max |g| */
    dal_crossing crossing;
} search;

/* ---- values of g ---- */

static dal_status no_value(double t, double value, dal_status status, dal_error *error)
{
    return dal__fail(error, status == DAL_STATUS_OK ? DAL_STATUS_NOT_FINITE : status,
                     "the section has no value at t = %.17g: %g", t, value);
}

static dal_status value_of(void *user, dal_run *run, double *value, dal_error *error)
{
    search *w = user;
    const dal_poincare *p = w->section;
    const dal_point at = dal__here(run);
    const dal_status status =
        dal_evaluator_call(w->evaluator, p->callback, at.t, at.q, at.v, NULL, w->values);
    *value = w->values[p->index];
    if (status != DAL_STATUS_OK || !isfinite(*value)) return no_value(at.t, *value, status, error);
    w->max_g = fmax(w->max_g, fabs(*value));
    return DAL_STATUS_OK;
}

/* The rate of g; NaN where it has none. */
static dal_status rate_of(void *user, dal_run *run, double *rate, dal_error *error)
{
    search *w = user;
    const dal_poincare *p = w->section;
    const dal_point at = dal__here(run);
    const dal__rate of = {.evaluator = w->evaluator,
                          .callback = p->callback,
                          .count = p->count,
                          .index = p->index,
                          .time = many_steps * dal_run_step_size(run),
                          .size = w->max_g};
    const dal_status status = dal__rate_in_units(&of, &at, rate);
    if (status != DAL_STATUS_OK) *rate = NAN;
    if (status == DAL_STATUS_OK || status == DAL_STATUS_NOT_FINITE) return DAL_STATUS_OK;
    return no_value(at.t, *rate, status, error);
}

static dal_status rounding_of(void *user, dal_run *run, double *value, double *rate,
                              dal_error *error)
{
    const search *w = user;
    const dal_poincare *p = w->section;
    const bool is_invariant = p->callback == dal_run_system(run)->invariant_values;
    const double *scales = is_invariant ? dal_run_scales(run) : NULL;
    (void)error;
    *value = touching * w->max_g;
    *rate = 0.0;
    if (!scales) return DAL_STATUS_OK;
    for (int kind = 0; kind < DAL__OBSERVE_INVARIANTS; kind++)
        scales += dal__observable_count(&run->layout, kind, run->exact);
    *value = fmax(*value, roundings * DBL_EPSILON * scales[p->index]);
    return DAL_STATUS_OK;
}

static int both_directions(void *user, const dal_run *run, int k)
{
    (void)user;
    (void)run;
    (void)k;
    return 0;
}

/* ---- the run ---- */

static dal_status report_crossing(void *user, dal_run *run)
{
    search *w = user;
    w->crossing.t = dal_run_time(run);
    return w->section->cross(w->section->user, run, &w->crossing);
}

/* The crossing at a distance in the step. */
static dal_status cross(search *w, double distance)
{
    dal__zero_search *c = &w->zeros;
    const int to = -dal__side_sign(c->zero[0].side), wanted = w->section->direction;
    *(to > 0 ? &w->found->up : &w->found->down) += 1;
    if (wanted && wanted != to) return DAL_STATUS_OK;
    w->crossing.direction = to;
    w->crossing.number++;
    if (!w->section->cross) return DAL_STATUS_OK;
    return distance > 0.0
               ? dal__observe_intermediate(c->run, c->h, distance, report_crossing, w, w->error)
               : report_crossing(w, c->run);
}

static dal_status search_step(search *w)
{
    dal__zero_search *c = &w->zeros;
    double distance = 0.0;
    DAL_TRY(dal__crossing_begin(c, dal_run_step_size(c->run), w->error));
    for (;;) {
        DAL_TRY(dal__crossing_next(c, &distance));
        if (!isfinite(distance)) break;
        DAL_TRY(cross(w, distance));
    }
    dal__crossing_take(c);
    return DAL_STATUS_OK;
}

static dal_status search_steps(search *w, long long steps)
{
    const dal_poincare *p = w->section;
    dal_status status = DAL_STATUS_OK;
    for (long long step = 1; step <= steps && status == DAL_STATUS_OK; step++) {
        status = search_step(w);
        if (status == DAL_STATUS_OK && p->poll && step % POLL == 0)
            status = p->poll(p->user, w->zeros.run);
    }
    w->found->touches = w->zeros.touches;
    w->found->unresolved = w->zeros.unresolved;
    w->found->first_unresolved = w->zeros.first_unresolved;
    return status;
}

/* ---- making one ---- */

static dal_status check_section(const dal_run *run, const dal_poincare *section, dal_error *error)
{
    const double h = dal_run_step_size(run);
    if (section->callback == NULL || section->index < 0 || section->index >= section->count)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "the section is value %d of %d",
                         section->index + 1, section->callback == NULL ? 0 : section->count);
    if (h < 0.0)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "a section needs a positive step; it is %g",
                         h);
    return dal__refuse_events(dal_run_system(run), "sections", error);
}

dal_status dal_run_crossings(dal_run *run, double T, const dal_poincare *section,
                             dal_crossings *found, dal_error *error)
{
    DAL_REQUIRE(run, error);
    DAL_REQUIRE(section, error);
    DAL_REQUIRE(found, error);
    search w = {.section = section, .found = found, .error = error};
    const dal__functions functions = {.count = 1,
                                      .user = &w,
                                      .values = value_of,
                                      .rates = rate_of,
                                      .roundings = rounding_of,
                                      .direction = both_directions};
    *found = (dal_crossings){0};
    DAL_TRY(check_section(run, section, error));
    const double h = dal_run_step_size(run);
    const long long steps = dal_whole_steps(dal_run_time(run), T, h);
    if (steps == 0)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "time %g is not a whole number of steps of %g",
                         T, h);
    size_t stored;
    dal_run_save(run, &stored);
    const size_t numbers = dal__crossing_numbers(1, stored);
    double *block = dal__numbers(1, numbers + (size_t)section->count);
    if (block == NULL) return dal__memory_error(error);
    w.values = block + numbers;
    dal__crossing_init(&w.zeros, run, &functions, block);
    dal_status status = dal__evaluator_of_run(&w.evaluator, NULL, run, error);
    if (status == DAL_STATUS_OK) status = search_steps(&w, steps);
    dal_evaluator_free(w.evaluator);
    free(block);
    return status;
}
