/* events.h - steps of a run whose system has events.
 *
 * Memory of events, after all else in the persistent state:
 *
 *     side[events] | count[events] | stopped | stalled | jump[observables]
 *
 * side     where `when` is, a dal__side: 1 above 0, -1 below, 2 and -2 when an event has just left
 *          it there, 0 not known yet
 * count    how often the event has happened
 * stopped  the number of the event that ended the run, from 1; 0: none
 * stalled  successive events at one time
 * jump     what events have added to E and to the invariants */
#ifndef DAL_RUN_EVENTS_H
#define DAL_RUN_EVENTS_H

#include "run/layout.h"

enum { DAL__MAX_STALLED = 1000 /* successive events at one time; more are endless */ };

/* What to call after each event; happened may be NULL. */
typedef struct dal__event_listener {
    dal_status (*happened)(void *user, dal_run *run, const dal_occurrence *event);
    void *user;
} dal__event_listener;

/* Takes count steps; one that would pass an event ends there, and the event acts.  listener may be
 * NULL.  Errors: as for a step, what the listener returns, DAL_STATUS_EVENT, DAL_STATUS_STOPPED,
 * DAL_STATUS_UNSUPPORTED where p, pi or pi_e is not 0. */
dal_status dal__advance_events(dal_run *run, long long count, const dal__event_listener *listener,
                               dal_error *error);
/* The distance of the first event within the next step, or, where none can be searched that long,
 * within one of size h; infinite where there is none.  The run stays as it is.  Errors: as for a
 * step. */
dal_status dal__next_event(dal_run *run, double h, double *distance, dal_error *error);
/* DAL_STATUS_STOPPED with its message where an event has ended the run; DAL_STATUS_UNSUPPORTED on
 * the lifted space off p = pi = 0: an event acts on (q, v) alone, p and pi would need its
 * derivatives. */
dal_status dal__check_events(const dal_run *run, dal_error *error);

#endif
