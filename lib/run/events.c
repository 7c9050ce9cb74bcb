/* events.c - steps of a run whose system has events: event_search.c finds them, event_actions.c
 * lets them act. */
#include "run/events.h"
#include "run/event_actions.h"
#include "run/failure.h"
#include "run/start.h"
#include <math.h>
#include <string.h>

/* Adds factor times E and the invariants of the present state to what events have changed; formulas
 * that are observed alone need not be conserved between events. */
static dal_status add_jump(const dal__event_search *w, double factor)
{
    const dal__layout *k = &w->run->layout;
    double *values = w->m.observed;
    const dal_status status = dal_run_observe(w->run, values);
    if (status != DAL_OK)
        return dal__fail(w->error, status,
                         "the observables have no values at the event at t = %.17g",
                         dal_run_time(w->run));
    for (int group = 0, i = 0; group < DAL__OBSERVABLE_GROUPS; group++) {
        const bool jumps = group == DAL__OBSERVE_E || group == DAL__OBSERVE_INVARIANTS;
        const int end = i + dal__observable_count(k, group, w->run->exact);
        for (; i < end; i++)
            if (jumps && !(group == DAL__OBSERVE_INVARIANTS && i >= end - k->system->observed))
                w->m.jump[i] += factor * values[i];
    }
    return DAL_OK;
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
    const dal__crossing *c = w->crossing;
    double last = distance;
    dal_status left = DAL_OK;
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
    DAL_TRY(dal__act_events(w, last, listener));
    DAL_TRY(evaluate_all(w));
    DAL_TRY(add_jump(w, 1.0));
    for (int k = 0; k < w->system->events && left == DAL_OK; k++) {
        if (c->zero[k].s <= last)
            left = dal__leave_event(w, k);
        else
            w->m.side[k] = dal__side_beside(w, k);
    }
    return left;
}

/* Steps to the event at a distance, and lets it act; where that fails, as for events too close for
 * one time to pass between them, the run stays as it is. */
static dal_status take_events(const dal__event_search *w, double distance,
                              const dal__event_listener *listener)
{
    const dal__crossing *c = w->crossing;
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
        dal__hold_as_searched(w, true);
        dal_status status = dal__step_part(w->run, c->h, s);
        if (status != DAL_OK) status = dal__failure_reason(w->run, s, status, w->error);
        dal__hold_as_searched(w, false);
        DAL_TRY(status);
    }
    *w->m.stalled = is_stalled ? *w->m.stalled + 1.0 : 0.0;
    const dal_status status = act(w, distance, listener);
    if (status == DAL_OK)
        dal__commit_events(w);
    else
        dal__run_revert(w->run);
    return status;
}

/* ---- steps ---- */

dal_status dal__check_events(const dal_run *run, dal_error *error)
{
    const dal__layout *layout = &run->layout;
    if (layout->system->events == 0) return DAL_OK;
    const int k = (int)*dal__event_places_of(run).stopped - 1;
    const char *name = k >= 0 ? layout->system->event[k].name : NULL;
    if (k >= 0)
        return dal__fail(error, DAL_STOPPED, "%s stopped the run at t = %.17g",
                         name ? name : "an event", dal_run_time(run));
    for (int i = 2 * layout->n + 1; layout->lifted && i < layout->dim; i++)
        if (run->persistent[i] != 0.0)
            return dal__fail(error, DAL_UNSUPPORTED,
                             "events act on p = pi = 0 only: p, pi or pi_e is not 0");
    return DAL_OK;
}

dal_status dal__advance_events(dal_run *run, long long count, const dal__event_listener *listener,
                               dal_error *error)
{
    dal__event_search w = dal__event_search_begin(run, error);
    double distance;
    DAL_TRY(dal__check_events(run, error));
    for (long long i = 0; i < count; i++) {
        DAL_TRY(dal__search_events(&w, &distance));
        if (isfinite(distance)) {
            DAL_TRY(take_events(&w, distance, listener));
            DAL_TRY(dal__check_events(run, error));
            continue;
        }
        dal__crossing_take(w.crossing);
        for (int k = 0; k < w.system->events; k++) w.m.side[k] = w.crossing->zero[k].side;
        *w.m.stalled = 0.0;
        dal__commit_events(&w);
    }
    return DAL_OK;
}

double dal__next_event(dal_run *run)
{
    double distance = INFINITY;
    dal__event_search w = dal__event_search_begin(run, NULL);
    return dal__search_events(&w, &distance) == DAL_OK ? distance : INFINITY;
}

void dal__change_sides(dal_run *run)
{
    if (run->layout.system->events == 0) return;
    const dal__event_search w = dal__event_search_begin(run, NULL);
    if (evaluate_all(&w) != DAL_OK) return;
    for (int k = 0; k < w.system->events; k++) {
        const bool is_off = fabs(w.m.f[k]) > dal__event_rounding(&w, k);
        if (is_off && w.m.side[k] != DAL__SIDE_UNKNOWN) w.m.side[k] = dal__sign(w.m.f[k]);
    }
    *w.m.stalled = 0.0;
    dal__commit_events(&w);
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
    const dal__crossing *c = run ? run->crossing : NULL;
    if (from) *from = c ? c->first_unresolved : NAN;
    return c ? c->unresolved : 0;
}

double dal_run_jump(const dal_run *run, int observable)
{
    if (!run || run->layout.system->events == 0) return 0.0;
    const bool is_one = observable >= 0 && observable < dal_run_observables(run);
    return is_one ? dal__event_places_of(run).jump[observable] : 0.0;
}
