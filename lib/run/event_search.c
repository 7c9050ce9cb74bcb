/* event_search.c - where the formulas of events pass through 0 along a run.
 *
 * Within a step from z at t, a formula f is a function of the size s of a step of the same method,
 *
 *     f(s) = f(step(z, s), t + s),   0 <= s <= h,
 *
 * and its root is the event (core/root.h); under a tolerance step(z, s) is the dense output of
 * step(z, h).  f has a root where its sign at the end of the step is not that at the beginning, and
 * a pair of them where d|f|/dt is negative at the beginning and positive at the end, and f has the
 * other sign where it is 0 between.  Where an event has just left f = 0, f(0) is only rounding; the
 * step is halved then until f has the sign of the side that it left to.
 *
 * A step that was divided under a tolerance may be long beside the motion: it is searched in parts,
 * some for each substep. */
#include "run/event_search.h"
#include "core/root.h"
#include "run/event_actions.h"
#include "run/events.h"
#include "run/failure.h"
#include <float.h>

/* Multiples of DBL_EPSILON: below the first, |f| is 0 but for its rounding; below the second, a
 * rate is. */
static const double value_factor = 16.0, rate_factor = 64.0;

/* An upper bound of the parts, and the evaluations of F in each: a substep has 12 with dop853, with
 * taylor as many as its order. */
enum { MAX_HALVES = 12, MAX_PARTS = 10000, PART_EVALUATIONS = 4 };

/* ---- memory ---- */

enum { ARRAYS = 7 /* now, f0, r0, f1, r1, s, there */ };

size_t dal__event_memory(const dal__layout *k)
{
    const size_t events = (size_t)k->system->events;
    return events > 0 ? 2 * events + 2 + (size_t)dal__max_observables(k) : 0;
}

size_t dal__event_scratch(const dal__layout *k)
{
    const size_t events = (size_t)k->system->events, n = (size_t)k->n;
    if (events == 0) return 0;
    return (ARRAYS + 1 + 4 * n) * events + (size_t)k->dim + (size_t)dal__max_observables(k);
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
                               .now = at,
                               .f0 = at + E,
                               .r0 = at + 2 * E,
                               .f1 = at + 3 * E,
                               .r1 = at + 4 * E,
                               .s = at + 5 * E,
                               .there = at + 6 * E,
                               .normals = at + ARRAYS * E,
                               .states = at + (ARRAYS + 1 + 2 * n) * E,
                               .before = at + (ARRAYS + 1 + 4 * n) * E,
                               .observed = at + (ARRAYS + 1 + 4 * n) * E + k->dim};
}

dal__event_search dal__event_search_begin(dal_run *run, dal_error *error)
{
    const double h = run->layout.options.step;
    return (dal__event_search){.run = run,
                               .error = error,
                               .system = run->layout.system,
                               .m = dal__event_places_of(run),
                               .h = h,
                               .toward = copysign(1.0, h)};
}

const char *dal__event_name(const dal__event_search *w, int k)
{
    return w->system->event[k].name ? w->system->event[k].name : "an event";
}

/* ---- values ---- */

dal_status dal__evaluate_events(const dal__event_search *w, dal_callback *callback, double *out)
{
    const dal_point at = dal__here(w->run);
    const dal_status status = callback(w->system, &at, out);
    for (int k = 0; k < w->system->events; k++)
        if (status != DAL_OK || !isfinite(out[k]))
            return dal__fail(w->error, status == DAL_OK ? DAL_NOT_FINITE : status,
                             "%s has no value at t = %.17g", dal__event_name(w, k), at.t);
    return DAL_OK;
}

dal_status dal__evaluate_events_and_rates(const dal__event_search *w, double *f, double *rate)
{
    DAL_TRY(dal__evaluate_events(w, w->system->event_values, f));
    return dal__evaluate_events(w, w->system->event_rates, rate);
}

static dal_status evaluate_there(void *user, dal_run *run)
{
    const dal__event_search *w = user;
    (void)run;
    return dal__evaluate_events(w, w->rate ? w->system->event_rates : w->system->event_values,
                                w->m.there);
}

/* The value, or the rate, of an event a step of size s from here. */
static dal_status value_at(void *user, double s, double *value)
{
    dal__event_search *w = user;
    if (s == 0.0)
        DAL_TRY(evaluate_there(w, w->run));
    else
        DAL_TRY(dal__observe_part(w->run, w->h, s, evaluate_there, w, w->error));
    *value = w->m.there[w->event];
    return DAL_OK;
}

/* The normal of an event: restitution, f_q, W^-1 f_q. */
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

/* The rounding of f, from that of q; and of its rate, from that of v.  After evaluate_normals. */
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

/* The least time that the clock resolves. */
double dal__event_time_rounding(const dal__event_search *w)
{
    return 4.0 * DBL_EPSILON * fmax(fabs(dal_run_time(w->run)), fabs(w->h));
}

/* ---- where events are ---- */

/* Whether leaving a side is the event, or returning to it is. */
bool dal__is_event_from(const dal__event_search *w, int k, double side)
{
    const int direction = w->system->event[k].direction;
    return direction == 0 || direction == -dal__sign(side);
}

dal_status dal__events_endless(const dal__event_search *w, int k)
{
    const char *name = dal__event_name(w, k);
    const double t = dal_run_time(w->run);
    if (w->m.count[k] == 0.0)
        return dal__fail(w->error, DAL_EVENT, "%s happens infinitely often from t = %.17g on", name,
                         t);
    return dal__fail(w->error, DAL_EVENT,
                     "%s happens infinitely often: number %lld is at t = %.17g, and the next ones "
                     "follow closer than can be resolved",
                     name, (long long)w->m.count[k], t);
}

/* The size of the step to event k, which mark_events has marked: between both ends of the part; of
 * a pair of roots about the least |f|, the first or the second; where an event has just left f = 0,
 * behind the place where it is on its side again. */
static dal_status locate(dal__event_search *w, int k)
{
    const double side = dal__sign(w->m.now[k]), mark = w->m.s[k];
    const bool has_left = mark == 1.0 && fabs(w->m.now[k]) == 2.0;
    const bool is_at_begin = mark == 1.0 && !has_left && side * w->m.f0[k] <= 0.0;
    dal__value_at begin = {w->from, w->m.f0[k]}, end = {w->to, w->m.f1[k]}, middle = end;
    double root;
    w->event = k;
    w->m.s[k] = is_at_begin ? fabs(w->from) : INFINITY;
    if (mark == 0.0 || is_at_begin) return DAL_OK;
    if (mark == 2.0) {
        w->rate = true;
        const dal_status status = dal__find_root(value_at, w, (dal__value_at){begin.s, w->m.r0[k]},
                                                 (dal__value_at){end.s, w->m.r1[k]}, &middle.s);
        w->rate = false;
        DAL_TRY(status);
        DAL_TRY(value_at(w, middle.s, &middle.f));
        if (!(side * middle.f < -dal__event_rounding(w, k))) return DAL_OK;
        *(dal__is_event_from(w, k, side) ? &end : &begin) = middle;
    }
    while (has_left && side * middle.f <= 0.0) {
        end = middle;
        middle.s = w->from + 0.5 * (end.s - w->from);
        if (fabs(middle.s - w->from) <= dal__event_time_rounding(w))
            return dal__events_endless(w, k);
        DAL_TRY(value_at(w, middle.s, &middle.f));
        begin = middle;
    }
    DAL_TRY(dal__find_root(value_at, w, begin, end, &root));
    w->m.s[k] = fabs(root);
    return DAL_OK;
}

/* Marks the events that a part of a step may have, at whose end the run is: 1 a root, 2 a pair of
 * roots, which needs that the tangents at both ends meet beyond 0.  Where an event has just left
 * f = 0, an |f| that is only rounding is none. */
static dal_status mark_events(void *user, dal_run *run)
{
    dal__event_search *w = user;
    const double size = fabs(w->to - w->from);
    (void)run;
    w->any = false;
    DAL_TRY(dal__evaluate_events_and_rates(w, w->m.f1, w->m.r1));
    for (int k = 0; k < w->system->events; k++) {
        const double side = w->m.now[k], end = dal__sign(side) * w->m.f1[k];
        const bool is_beyond = end < 0.0 && dal__is_event_from(w, k, side);
        double zero = 0.0;
        if (is_beyond && fabs(side) == 2.0) {
            DAL_TRY(dal__evaluate_event_normals(w));
            zero = dal__event_rounding(w, k) + size * dal__event_rate_rounding(w, k);
        }
        w->m.s[k] = 0.0;
        if (is_beyond && -end > 4.0 * zero) w->m.s[k] = 1.0;
        const double begin = dal__sign(side) * w->m.f0[k], toward = dal__sign(side) * w->toward;
        const double r0 = toward * w->m.r0[k], r1 = toward * w->m.r1[k];
        const bool turns = fabs(side) == 1.0 && begin >= 0.0 && end > 0.0 && r0 < 0.0 && r1 > 0.0;
        const double meeting = (end - begin - size * r1) / (r0 - r1);
        if (turns && begin + meeting * r0 <= 0.0) w->m.s[k] = 2.0;
        w->any = w->any || w->m.s[k] != 0.0;
    }
    return DAL_OK;
}

/* The distance of the first event of those that are marked; the run is where the step begins. */
static dal_status locate_first(dal__event_search *w, double *distance)
{
    DAL_TRY(dal__evaluate_event_normals(w));
    for (int k = 0; k < w->system->events; k++) {
        DAL_TRY(locate(w, k));
        *distance = fmin(*distance, w->m.s[k]);
    }
    return DAL_OK;
}

/* The sides where the run is.  Where f is 0 at the start of a run, an event of one direction
 * happens at once if f leads that way. */
static dal_status begin_search(dal__event_search *w)
{
    DAL_TRY(dal__evaluate_events_and_rates(w, w->m.f0, w->m.r0));
    for (int k = 0; k < w->system->events; k++) {
        const double direction = w->system->event[k].direction;
        const double rate = dal__sign(w->toward * w->m.r0[k]), f = dal__sign(w->m.f0[k]);
        const bool is_now = direction != 0.0 && rate == direction;
        const double begun = f != 0.0 ? f
                             : is_now ? -direction
                                      : 2.0 * (rate != 0.0 ? rate : -direction);
        w->m.now[k] = w->m.side[k] != 0.0 ? w->m.side[k] : begun;
    }
    return DAL_OK;
}

/* Searches a step from its begin, where the run is, in parts. */
static dal_status search_parts(dal__event_search *w, long long parts, double *distance)
{
    for (long long i = 1; i <= parts; i++) {
        w->from = w->to;
        w->to = i < parts ? w->h * ((double)i / (double)parts) : w->h;
        DAL_TRY(dal__observe_part(w->run, w->h, w->to, mark_events, w, w->error));
        if (w->any) DAL_TRY(locate_first(w, distance));
        if (isfinite(*distance) || i == parts) break;
        for (int k = 0; k < w->system->events; k++) {
            w->m.now[k] = dal__side_after(w, k, NULL);
            w->m.f0[k] = w->m.f1[k];
            w->m.r0[k] = w->m.r1[k];
        }
    }
    return DAL_OK;
}

/* Takes a step and finds the first event in it, at a distance.  The step is taken back unless it
 * has no events. */
static dal_status search_within(dal__event_search *w, double *distance)
{
    const long long evaluations = dal_run_evaluations(w->run);
    long long parts = 1;
    *distance = INFINITY;
    DAL_TRY(begin_search(w));
    dal__run_back_up(w->run);
    DAL_TRY(dal__step_run(w->run, w->h, 1));
    if (w->run->layout.options.tolerance > 0.0)
        parts = (dal_run_evaluations(w->run) - evaluations) / PART_EVALUATIONS;
    w->from = 0.0;
    w->to = parts > 1 ? 0.0 : w->h;
    const dal_status status = parts > 1 ? DAL_OK : mark_events(w, w->run);
    if (status == DAL_OK && parts <= 1 && !w->any) return DAL_OK;
    dal__run_revert(w->run);
    DAL_TRY(status);
    if (parts > 1)
        DAL_TRY(search_parts(w, parts < MAX_PARTS ? parts : MAX_PARTS, distance));
    else
        DAL_TRY(locate_first(w, distance));
    return isfinite(*distance) ? DAL_OK : dal__step_run(w->run, w->h, 1); /* as before */
}

/* The same of the next step.  Where it fails, as beyond a wall, a shorter one may have an event. */
dal_status dal__search_events(dal__event_search *w, double *distance)
{
    const double h = w->h;
    dal_error reason = {0}, ignored = {0}, *const error = w->error;
    w->error = &reason;
    const dal_status status = search_within(w, distance);
    w->error = &ignored;
    double low = 0.0, high = h;
    bool found = status == DAL_OK;
    for (int i = 0; i < MAX_HALVES && !found && status != DAL_EVENT; i++) {
        w->h = 0.5 * (low + high);
        const dal_status shorter = search_within(w, distance);
        found = shorter == DAL_OK && isfinite(*distance);
        if (shorter == DAL_OK && !found) dal__run_revert(w->run);
        *(shorter == DAL_OK ? &low : &high) = w->h;
    }
    w->error = error;
    if (found) return DAL_OK;
    if (reason.status != status) return dal__failure_reason(w->run, h, status, error);
    if (error) *error = reason;
    return status;
}
