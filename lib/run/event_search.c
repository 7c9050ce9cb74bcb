/* event_search.c - the formulas of events, whose zeros crossing.c finds along a run. */
#include "run/event_search.h"
#include <float.h>

/* Multiples of DBL_EPSILON: below the first, |f| is 0 but for its rounding; below the second, a
 * rate is. */
static const double value_factor = 16.0, rate_factor = 64.0;

enum { MAX_HALVES = 12 };

/* ---- memory ---- */

enum { ARRAYS = 3 /* f, rate, there */ };

size_t dal__event_memory(const dal__layout *k)
{
    const size_t events = (size_t)k->system->events;
    return events > 0 ? 2 * events + 2 + (size_t)dal__max_observables(k) : 0;
}

/* Numbers that hold a dal__crossing. */
static size_t crossing_numbers(void)
{
    return (sizeof(dal__crossing) + sizeof(double) - 1) / sizeof(double);
}

size_t dal__event_scratch(const dal__layout *k, size_t stored)
{
    const size_t events = (size_t)k->system->events, n = (size_t)k->n;
    if (events == 0) return 0;
    return (ARRAYS + 1 + 4 * n) * events + (size_t)k->dim + (size_t)dal__max_observables(k) +
           crossing_numbers() + dal__crossing_numbers(events, stored);
}

dal__event_places dal__event_places_of(const dal_run *run)
{
    const dal__layout *k = &run->layout;
    const size_t E = (size_t)k->system->events, n = (size_t)k->n;
    double *side = run->persistent + dal__at_events(k), *at = run->event_scratch;
    return (dal__event_places){.side = side,
                               .count = side + E,
                               .stopped = side + 2 * E,
                               .stalled = side + 2 * E + 1,
                               .jump = side + 2 * E + 2,
                               .f = at,
                               .rate = at + E,
                               .there = at + 2 * E,
                               .normals = at + ARRAYS * E,
                               .states = at + (ARRAYS + 1 + 2 * n) * E,
                               .before = at + (ARRAYS + 1 + 4 * n) * E,
                               .observed = at + (ARRAYS + 1 + 4 * n) * E + k->dim};
}

/* ---- values ---- */

const char *dal__event_name(const dal_system *system, int k)
{
    return system->event[k].name ? system->event[k].name : "an event";
}

static dal_status evaluate(dal_run *run, dal_callback *callback, double *out, dal_error *error)
{
    const dal_system *system = run->layout.system;
    const dal_point at = dal__here(run);
    const dal_status status = callback(system, &at, out);
    for (int k = 0; k < system->events; k++)
        if (status != DAL_OK || !isfinite(out[k]))
            return dal__fail(error, status == DAL_OK ? DAL_NOT_FINITE : status,
                             "%s has no value at t = %.17g", dal__event_name(system, k), at.t);
    return DAL_OK;
}

static dal_status values_of(void *user, dal_run *run, double *out, dal_error *error)
{
    (void)user;
    return evaluate(run, run->layout.system->event_values, out, error);
}

static dal_status rates_of(void *user, dal_run *run, double *out, dal_error *error)
{
    (void)user;
    return evaluate(run, run->layout.system->event_rates, out, error);
}

dal_status dal__evaluate_events(const dal__event_search *w)
{
    DAL_TRY(values_of(NULL, w->run, w->m.f, w->error));
    return dal__evaluate_event_rates(w);
}

dal_status dal__evaluate_event_rates(const dal__event_search *w)
{
    return rates_of(NULL, w->run, w->m.rate, w->error);
}

const double *dal__event_normal(const dal__event_search *w, int k)
{
    return w->m.normals + (size_t)k * (1 + 2 * (size_t)w->system->n);
}

dal_status dal__evaluate_event_normals(const dal__event_search *w)
{
    const dal_point at = dal__here(w->run);
    const dal_status status = w->system->event_normals(w->system, &at, w->m.normals);
    if (status == DAL_OK) return DAL_OK;
    return dal__fail(w->error, status, "the events have no normals at t = %.17g", at.t);
}

/* The rounding of f, from the rounding of q; and of its rate, from that of v. */
static double rounding_of(const dal__event_search *w, int k, const double *x)
{
    const double *normal = dal__event_normal(w, k) + 1;
    double sum = 0.0;
    for (int i = 0; i < w->system->n; i++) sum += fabs(normal[i] * x[i]);
    return DBL_EPSILON * sum;
}

double dal__event_rounding(const dal__event_search *w, int k)
{
    return value_factor * rounding_of(w, k, w->run->persistent);
}

double dal__event_rate_rounding(const dal__event_search *w, int k)
{
    return rate_factor * rounding_of(w, k, w->run->persistent + w->system->n);
}

static dal_status roundings_of(void *user, dal_run *run, double *value, double *rate,
                               dal_error *error)
{
    const dal__event_search w = dal__event_search_begin(run, error);
    (void)user;
    DAL_TRY(dal__evaluate_event_normals(&w));
    for (int k = 0; k < w.system->events; k++) {
        value[k] = dal__event_rounding(&w, k);
        rate[k] = dal__event_rate_rounding(&w, k);
    }
    return DAL_OK;
}

static int direction_of(void *user, const dal_run *run, int k)
{
    (void)user;
    return run->layout.system->event[k].direction;
}

/* ---- the search ---- */

dal__event_search dal__event_search_begin(dal_run *run, dal_error *error)
{
    const dal__layout *k = &run->layout;
    const dal__functions functions = {.count = k->system->events,
                                      .values = values_of,
                                      .rates = rates_of,
                                      .roundings = roundings_of,
                                      .direction = direction_of};
    const dal__event_places m = dal__event_places_of(run);
    double *at = m.observed + dal__max_observables(k);
    if (!run->crossing && functions.count > 0) {
        run->crossing = (dal__crossing *)(void *)at;
        dal__crossing_init(run->crossing, run, &functions, at + crossing_numbers());
    }
    return (dal__event_search){.run = run,
                               .error = error,
                               .system = k->system,
                               .m = m,
                               .crossing = run->crossing,
                               .toward = copysign(1.0, k->options.step)};
}

dal_status dal__events_endless(const dal__event_search *w, int k)
{
    const char *name = dal__event_name(w->system, k);
    const double t = dal_run_time(w->run);
    if (w->m.count[k] == 0.0)
        return dal__fail(w->error, DAL_EVENT, "%s happens infinitely often from t = %.17g on", name,
                         t);
    return dal__fail(w->error, DAL_EVENT,
                     "%s happens infinitely often: number %lld is at t = %.17g, and the next ones "
                     "follow closer than can be resolved",
                     name, (long long)w->m.count[k], t);
}

static dal_status search_step(const dal__event_search *w, double h, double *distance,
                              dal_error *error)
{
    dal__crossing *c = w->crossing;
    for (int k = 0; k < w->system->events; k++) c->zero[k].side = (dal__side)w->m.side[k];
    c->is_begun = false;
    DAL_TRY(dal__crossing_begin(c, h, error));
    return dal__crossing_next(c, distance);
}

/* The same of the next step.  Where it fails, as beyond a wall, a shorter one may have an event. */
dal_status dal__search_events(dal__event_search *w, double *distance)
{
    dal__crossing *c = w->crossing;
    const double h = w->run->layout.options.step;
    dal_error reason = {0}, ignored = {0};
    if (dal__crossing_is_kept(c, distance)) return DAL_OK;
    const dal_status status = search_step(w, h, distance, &reason);
    double low = 0.0, high = h;
    bool found = status == DAL_OK;
    for (int i = 0; i < MAX_HALVES && !found; i++) {
        const double middle = 0.5 * (low + high);
        const dal_status shorter = search_step(w, middle, distance, &ignored);
        found = shorter == DAL_OK && isfinite(*distance);
        *(shorter == DAL_OK ? &low : &high) = middle;
    }
    if (found)
        dal__crossing_keep(c, *distance);
    else if (w->error)
        *w->error = reason;
    return found ? DAL_OK : status;
}
