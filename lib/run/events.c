/* events.c - steps of a run, and changes of its parameters, with the events of its system:
 * event_search.c finds them.
 *
 * An impact with restitution c changes v by
 *
 *     W (v+ - v-) = f_q L + A^T x,   D(q, v+, t) = 0,   df/dt+ = -c df/dt-,
 *
 * the least change in the mass metric with these values (run/consistent.h): c = 1 conserves
 * v.Wv/2 where D is linear and homogeneous, and f and D do not depend on t. */
#include "run/events.h"
#include "run/consistent.h"
#include "run/event_search.h"
#include "run/failure.h"
#include "run/start.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- actions ---- */

enum { MAX_ROUNDS = 100 };

/* The memory of events was changed. */
static void commit_events(const dal__event_search *w)
{
    if (DAL__IS_QUAD(w->run))
        dal__quad_push(&w->run->quad, w->run->persistent, dal__at_events(&w->run->layout));
}

/* Changes q and v as event k says, first what it sets, then the rate of its formula, which becomes
 * -c times what it was. */
static dal_status change(const dal__event_search *w, int k)
{
    dal_run *run = w->run;
    const dal_point at = dal__here(run);
    const unsigned actions = w->system->event[k].actions;
    const size_t n = (size_t)w->system->n, dim = (size_t)run->layout.dim;
    const double *set = w->m.states + (size_t)k * 2 * n, *normal = dal__event_normal(w, k);
    const double c = normal[0];
    const bool is_impact = actions & DAL_EVENT_IMPACT;
    dal__condition condition = {normal + 1, normal + 1 + n, -(1.0 + c) * w->m.rate[k]};
    if (is_impact && (!(c >= 0.0) || !isfinite(c)))
        return dal__fail(w->error, DAL_STATUS_EVENT, "%s has the restitution %g at t = %.17g",
                         dal__event_name(w->system, k), c, at.t);
    for (size_t i = 0; is_impact && i < n; i++) condition.value += normal[1 + i] * at.v[i];
    if (actions & DAL_EVENT_SETS) {
        const dal_status status = w->system->event_states(w->system, &at, w->m.states);
        for (size_t i = 0; i < 2 * n; i++)
            if (status != DAL_STATUS_OK || !isfinite(set[i]))
                return dal__fail(w->error, status == DAL_STATUS_OK ? DAL_STATUS_NOT_FINITE : status,
                                 "%s sets a value that is not finite at t = %.17g",
                                 dal__event_name(w->system, k), at.t);
        memcpy(run->persistent, set, 2 * n * sizeof *set);
    }
    if (actions & (DAL_EVENT_SETS | DAL_EVENT_IMPACT)) {
        char place[128];
        snprintf(place, sizeof place, "%.80s at t = %.17g", dal__event_name(w->system, k), at.t);
        dal__linearised g = dal__linearised_coordinates(run, place);
        const bool is_set = actions & DAL_EVENT_SETS && g.c.rows > 0;
        dal_status status = is_set ? dal__make_consistent(&g, w->error) : DAL_STATUS_OK;
        dal__linearised D = dal__linearised_of(run, is_impact ? &condition : NULL, place);
        if (status == DAL_STATUS_OK) status = dal__make_consistent(&D, w->error);
        if (status != DAL_STATUS_OK && w->error) w->error->status = DAL_STATUS_EVENT;
        if (status != DAL_STATUS_OK) return DAL_STATUS_EVENT;
    }
    for (size_t i = 0; i < 2 * n; i++) {
        run->persistent[i] += 0.0; /* no -0: see lib/kernel/step.h */
        if (run->persistent[i] == w->m.before[i]) continue;
        run->persistent[dim + i] = 0.0;
        if (!DAL__IS_QUAD(run)) continue;
        dal__quad_set(&run->quad, run->persistent, i);
        dal__quad_set(&run->quad, run->persistent, dim + i);
    }
    return DAL_STATUS_OK;
}

/* The events up to the distance `last`, which are at one time, act in the order of the file; an
 * impact once more where another has turned the motion against it again. */
static dal_status act_in_rounds(const dal__event_search *w, double last,
                                const dal__event_listener *listener)
{
    const int events = w->system->events;
    bool any = true;
    for (int round = 0; any && round < MAX_ROUNDS; round++) {
        any = false;
        for (int k = 0; k < events; k++) {
            const bool is_impact = w->system->event[k].actions & DAL_EVENT_IMPACT;
            if (w->crossing->zero[k].s > last || (round > 0 && !is_impact)) continue;
            DAL_TRY(dal__evaluate_event_rates(w));
            DAL_TRY(dal__evaluate_event_normals(w));
            const int from = dal__side_sign(w->crossing->zero[k].side);
            const double rate = from * w->toward * w->m.rate[k];
            if (is_impact && rate >= -dal__event_rate_rounding(w, k)) continue; /* leads back */
            any = any || is_impact;
            memcpy(w->m.before, w->run->persistent, (size_t)w->run->layout.dim * sizeof(double));
            DAL_TRY(change(w, k));
            w->m.count[k]++;
            if (w->system->event[k].actions & DAL_EVENT_STOPS && *w->m.stopped == 0.0)
                *w->m.stopped = k + 1;
            commit_events(w);
            if (!listener || !listener->happened) continue;
            const dal_occurrence event = {.event = k,
                                          .number = (long long)w->m.count[k],
                                          .direction = -from,
                                          .t = dal_run_time(w->run),
                                          .before = w->m.before};
            DAL_TRY(listener->happened(listener->user, w->run, &event));
        }
    }
    for (int k = 0; any && k < events; k++)
        if (w->crossing->zero[k].s <= last && w->system->event[k].actions & DAL_EVENT_IMPACT)
            return dal__events_endless(w, k);
    return DAL_STATUS_OK;
}

/* Sets the side that event k has left to.  Error: DAL_STATUS_EVENT where that is out of a wall. */
static dal_status leave_event(const dal__event_search *w, int k)
{
    const dal_event *event = &w->system->event[k];
    const double f = w->m.f[k], rate = w->toward * w->m.rate[k];
    const int from = dal__side_sign(w->crossing->zero[k].side);
    const bool is_wall = event->actions & (DAL_EVENT_IMPACT | DAL_EVENT_TURNS) &&
                         (event->direction != 0 || event->actions & DAL_EVENT_IMPACT);
    double accuracy;
    DAL_TRY(dal__zero_accuracy(w->crossing, k, &accuracy, w->error));
    const bool is_set = fabs(f) > dal__event_rounding(w, k) && event->actions & DAL_EVENT_SETS &&
                        f != w->m.there[k];
    const bool is_off = is_set || fabs(w->m.there[k]) > accuracy; /* by a jump of f */
    const bool leaves = fabs(rate) > dal__event_rate_rounding(w, k);
    const int across = is_wall ? from : -from;
    const dal__side to =
        is_off ? (dal__side)dal__sign_of(f) : dal__just(leaves ? dal__sign_of(rate) : across);
    w->m.side[k] = to;
    if (dal__event_slides(w, k) && !(event->actions & DAL_EVENT_STOPS))
        return dal__fail(w->error, DAL_STATUS_EVENT,
                         "%s at t = %.17g: on both sides of it F leads back, so that the motion "
                         "would slide along it, which no step does",
                         dal__event_name(w->system, k), dal_run_time(w->run));
    if (!is_wall || dal__side_sign(to) == from || event->actions & DAL_EVENT_STOPS)
        return DAL_STATUS_OK;
    return dal__fail(w->error, DAL_STATUS_EVENT,
                     "%s at t = %.17g: the velocities after it still lead out, d(when)/dt = %.6g",
                     dal__event_name(w->system, k), dal_run_time(w->run), w->m.rate[k]);
}

/* The side of an event that did not act where others did, and may have set its formula. */
static dal__side side_beside(const dal__event_search *w, int k)
{
    const double f = w->m.f[k], rounding = dal__event_rounding(w, k);
    const double slack = rounding + fabs(w->crossing->h) * dal__event_rate_rounding(w, k);
    if (f != w->m.there[k] && fabs(f) > rounding) return (dal__side)dal__sign_of(f);
    return dal__side_at(w->crossing, k, f, slack);
}

/* ---- one event ---- */

/* Adds factor times E and the invariants of the present state to what events have changed; formulas
 * that are observed alone need not be conserved between events. */
static dal_status add_jump(const dal__event_search *w, double factor)
{
    const dal__layout *k = &w->run->layout;
    double *values = w->m.observed;
    const dal_status status = dal_run_observe(w->run, values);
    if (status != DAL_STATUS_OK)
        return dal__fail(w->error, status,
                         "the observables have no values at the event at t = %.17g",
                         dal_run_time(w->run));
    for (int kind = 0, i = 0; kind < DAL__OBSERVABLE_KINDS; kind++) {
        const bool jumps = kind == DAL__OBSERVE_E || kind == DAL__OBSERVE_INVARIANTS;
        const int end = i + dal__observable_count(k, kind, w->run->exact);
        for (; i < end; i++)
            if (jumps && !(kind == DAL__OBSERVE_INVARIANTS && i >= end - k->system->observed))
                w->m.jump[i] += factor * values[i];
    }
    return DAL_STATUS_OK;
}

/* Values, rates and normals of the present state. */
static dal_status evaluate_all(const dal__event_search *w)
{
    DAL_TRY(dal__evaluate_events(w));
    return dal__evaluate_event_normals(w);
}

/* The events at a distance act on the present state, which is there; those within rounding of the
 * first are at the same time. */
static dal_status act(const dal__event_search *w, double distance,
                      const dal__event_listener *listener)
{
    const dal__zero_search *c = w->crossing;
    double last = distance;
    dal_status status = DAL_STATUS_OK;
    DAL_TRY(evaluate_all(w));
    memcpy(w->m.there, w->m.f, (size_t)w->system->events * sizeof(double));
    for (int k = 0; k < w->system->events; k++) {
        const double rate = fabs(w->m.rate[k]);
        const double own = rate > 0.0 ? dal__event_rounding(w, k) / rate : 0.0;
        if (c->zero[k].s <= distance + dal__crossing_resolution(c) + fmin(own, 1e-9 * fabs(c->h)))
            last = fmax(last, c->zero[k].s);
    }
    DAL_TRY(add_jump(w, -1.0));
    dal__restart_method(w->run);
    DAL_TRY(act_in_rounds(w, last, listener));
    DAL_TRY(evaluate_all(w));
    DAL_TRY(add_jump(w, 1.0));
    for (int k = 0; k < w->system->events && status == DAL_STATUS_OK; k++) {
        if (c->zero[k].s <= last)
            status = leave_event(w, k);
        else
            w->m.side[k] = side_beside(w, k);
    }
    return status;
}

/* Steps to the event at a distance, and lets it act; where that fails, as for events too close for
 * one time to pass between them, the run stays as it is. */
static dal_status take_events(const dal__event_search *w, double distance,
                              const dal__event_listener *listener)
{
    const dal__zero_search *c = w->crossing;
    const double s = w->toward * distance;
    const bool is_stalled = distance <= dal__crossing_resolution(c);
    DAL_TRY(dal__evaluate_event_normals(w));
    for (int k = 0; k < w->system->events; k++) {
        const bool is_close =
            is_stalled || distance * fabs(c->begin.rate[k]) <= dal__event_rounding(w, k);
        const bool is_again = dal__is_just(c->zero[k].side) && is_close;
        const bool is_endless = is_again || (is_stalled && *w->m.stalled >= DAL__MAX_STALLED);
        if (c->zero[k].s <= distance && is_endless) return dal__events_endless(w, k);
    }
    dal__run_back_up(w->run);
    if (distance > 0.0) {
        dal__hold_as_searched(w);
        dal_status status = dal__step_intermediate(w->run, c->h, s);
        if (status != DAL_STATUS_OK) status = dal__failure_reason(w->run, s, status, w->error);
        dal__let_go_as_searched(w);
        DAL_TRY(status);
    }
    *w->m.stalled = is_stalled ? *w->m.stalled + 1.0 : 0.0;
    const dal_status status = act(w, distance, listener);
    if (status == DAL_STATUS_OK)
        commit_events(w);
    else
        dal__run_revert(w->run);
    return status;
}

/* ---- steps ---- */

dal_status dal__check_events(const dal_run *run, dal_error *error)
{
    const dal__layout *layout = &run->layout;
    if (layout->system->events == 0) return DAL_STATUS_OK;
    const int k = (int)*dal__event_places_of(run).stopped - 1;
    const char *name = k >= 0 ? layout->system->event[k].name : NULL;
    if (k >= 0)
        return dal__fail(error, DAL_STATUS_STOPPED, "%s stopped the run at t = %.17g",
                         name ? name : "an event", dal_run_time(run));
    for (int i = 2 * layout->n + 1; layout->lifted && i < layout->dim; i++)
        if (run->persistent[i] != 0.0)
            return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                             "events act on p = pi = 0 only: p, pi or pi_e is not 0");
    return DAL_STATUS_OK;
}

dal_status dal__advance_events(dal_run *run, long long count, const dal__event_listener *listener,
                               dal_error *error)
{
    dal__event_search w = dal__event_search_begin(run, error);
    double distance;
    DAL_TRY(dal__check_events(run, error));
    for (long long i = 0; i < count; i++) {
        DAL_TRY(dal__search_events(&w, run->layout.options.step, &distance));
        if (isfinite(distance)) {
            DAL_TRY(take_events(&w, distance, listener));
            DAL_TRY(dal__check_events(run, error));
            continue;
        }
        dal__crossing_take(w.crossing);
        for (int k = 0; k < w.system->events; k++) w.m.side[k] = w.crossing->zero[k].side;
        *w.m.stalled = 0.0;
        commit_events(&w);
    }
    return DAL_STATUS_OK;
}

dal_status dal_run_advance(dal_run *run, long long count, dal_error *error)
{
    DAL_REQUIRE(run, error);
    const double h = run->layout.options.step;
    if (count < 0)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "%lld steps: a run goes forward", count);
    if (run->layout.system->events > 0) return dal__advance_events(run, count, NULL, error);
    const dal_status status = dal__step_run(run, h, count);
    return status == DAL_STATUS_OK ? DAL_STATUS_OK : dal__failure_reason(run, h, status, error);
}

dal_status dal_run_step(dal_run *run, dal_error *error) { return dal_run_advance(run, 1, error); }

dal_status dal__next_event(dal_run *run, double h, double *distance, dal_error *error)
{
    *distance = INFINITY;
    if (run->layout.system->events == 0) return DAL_STATUS_OK;
    dal__event_search w = dal__event_search_begin(run, NULL);
    if (dal__search_events(&w, run->layout.options.step, distance) == DAL_STATUS_OK)
        return DAL_STATUS_OK;
    w.error = error;
    return dal__search_events(&w, h, distance);
}

/* ---- a parameter between steps ---- */

/* After a change of parameters: an event whose formula is now on the other side has not happened by
 * that. */
static void change_sides(dal_run *run)
{
    if (run->layout.system->events == 0) return;
    const dal__event_search w = dal__event_search_begin(run, NULL);
    if (evaluate_all(&w) != DAL_STATUS_OK) return;
    for (int k = 0; k < w.system->events; k++) {
        const bool is_off = fabs(w.m.f[k]) > dal__event_rounding(&w, k);
        if (is_off && w.m.side[k] != DAL__SIDE_UNKNOWN) w.m.side[k] = dal__sign_of(w.m.f[k]);
    }
    *w.m.stalled = 0.0;
    commit_events(&w);
}

dal_status dal_run_set_parameter(dal_run *run, const char *name, double value, dal_error *error)
{
    DAL_REQUIRE(run, error);
    DAL_REQUIRE(name, error);
    const dal_status status = dal__change_parameter(run, name, value, error);
    if (status == DAL_STATUS_OK || status == DAL_STATUS_INCONSISTENT) change_sides(run);
    return status;
}

/* ---- what has happened ---- */

long long dal_run_event_count(const dal_run *run, int event)
{
    if (!run || event < 0 || event >= run->layout.system->events) return -1;
    return (long long)dal__event_places_of(run).count[event];
}

int dal_run_stopped(const dal_run *run)
{
    return run && run->layout.system->events > 0 ? (int)*dal__event_places_of(run).stopped : 0;
}

long long dal_run_unresolved(const dal_run *run, double *from)
{
    const dal__zero_search *c = run ? dal__event_crossing(run) : NULL;
    if (from) *from = c ? c->first_unresolved : NAN;
    return c ? c->unresolved : 0;
}

double dal_run_event_jump(const dal_run *run, int observable)
{
    if (!run || run->layout.system->events == 0) return 0.0;
    const bool is_one = observable >= 0 && observable < dal_run_observables(run);
    return is_one ? dal__event_places_of(run).jump[observable] : 0.0;
}
