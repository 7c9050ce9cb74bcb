/* event_actions.c - what the events of a run do.
 *
 * An impact with restitution c changes v by
 *
 *     W (v+ - v-) = f_q L + A^T x,   D(q, v+, t) = 0,   df/dt+ = -c df/dt-,
 *
 * the least change in the mass metric with these values (run/consistent.h): c = 1 conserves
 * v.Wv/2 where D is linear and homogeneous, and f and D do not depend on t. */
#include "run/event_actions.h"
#include "run/consistent.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX_ROUNDS = 100 };

void dal__commit_events(const dal__event_search *w)
{
    if (w->run->quad.engine)
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
        return dal__fail(w->error, DAL_EVENT, "%s has the restitution %g at t = %.17g",
                         dal__event_name(w->system, k), c, at.t);
    for (size_t i = 0; is_impact && i < n; i++) condition.value += normal[1 + i] * at.v[i];
    if (actions & DAL_EVENT_SETS) {
        const dal_status status = w->system->event_states(w->system, &at, w->m.states);
        for (size_t i = 0; i < 2 * n; i++)
            if (status != DAL_OK || !isfinite(set[i]))
                return dal__fail(w->error, status == DAL_OK ? DAL_NOT_FINITE : status,
                                 "%s sets a value that is not finite at t = %.17g",
                                 dal__event_name(w->system, k), at.t);
        memcpy(run->persistent, set, 2 * n * sizeof *set);
    }
    if (actions & (DAL_EVENT_SETS | DAL_EVENT_IMPACT)) {
        char place[128];
        snprintf(place, sizeof place, "%.80s at t = %.17g", dal__event_name(w->system, k), at.t);
        dal__linearised D = dal__linearised_of(run, is_impact ? &condition : NULL, place);
        const dal_status status = dal__make_consistent(&D, w->error);
        if (status != DAL_OK && w->error) w->error->status = DAL_EVENT;
        if (status != DAL_OK) return DAL_EVENT;
    }
    for (size_t i = 0; i < 2 * n; i++) {
        run->persistent[i] += 0.0; /* no -0: see lib/kernel/step.h */
        if (run->persistent[i] == w->m.before[i]) continue;
        run->persistent[dim + i] = 0.0;
        if (!run->quad.engine) continue;
        dal__quad_set(&run->quad, run->persistent, i);
        dal__quad_set(&run->quad, run->persistent, dim + i);
    }
    return DAL_OK;
}

dal_status dal__act_events(const dal__event_search *w, double last,
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
            dal__commit_events(w);
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
    return DAL_OK;
}

dal_status dal__leave_event(const dal__event_search *w, int k)
{
    const dal_event *event = &w->system->event[k];
    const double f = w->m.f[k], rate = w->toward * w->m.rate[k];
    const int from = dal__side_sign(w->crossing->zero[k].side);
    const bool is_wall = event->actions & (DAL_EVENT_IMPACT | DAL_EVENT_TURNS) &&
                         (event->direction != 0 || event->actions & DAL_EVENT_IMPACT);
    double accuracy;
    DAL_TRY(dal__zero_accuracy(w->crossing, k, &accuracy));
    const bool is_set = fabs(f) > dal__event_rounding(w, k) && event->actions & DAL_EVENT_SETS &&
                        f != w->m.there[k];
    const bool is_off = is_set || fabs(w->m.there[k]) > accuracy; /* by a jump of f */
    const bool leaves = fabs(rate) > dal__event_rate_rounding(w, k);
    const int across = is_wall ? from : -from;
    const dal__side to =
        is_off ? (dal__side)dal__sign(f) : dal__just(leaves ? dal__sign(rate) : across);
    w->m.side[k] = to;
    if (dal__event_slides(w, k) && !(event->actions & DAL_EVENT_STOPS))
        return dal__fail(w->error, DAL_EVENT,
                         "%s at t = %.17g: on both sides of it F leads back, so that the motion "
                         "would slide along it, which no step does",
                         dal__event_name(w->system, k), dal_run_time(w->run));
    if (!is_wall || dal__side_sign(to) == from || event->actions & DAL_EVENT_STOPS) return DAL_OK;
    return dal__fail(w->error, DAL_EVENT,
                     "%s at t = %.17g: the velocities after it still lead out, d(when)/dt = %.6g",
                     dal__event_name(w->system, k), dal_run_time(w->run), w->m.rate[k]);
}

dal__side dal__side_beside(const dal__event_search *w, int k)
{
    const double f = w->m.f[k], rounding = dal__event_rounding(w, k);
    const double slack = rounding + fabs(w->crossing->h) * dal__event_rate_rounding(w, k);
    if (f != w->m.there[k] && fabs(f) > rounding) return (dal__side)dal__sign(f);
    return dal__side_at(w->crossing, k, f, slack);
}
