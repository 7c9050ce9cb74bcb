/* event_actions.h - what the events of a run do. */
#ifndef DAL_RUN_EVENT_ACTIONS_H
#define DAL_RUN_EVENT_ACTIONS_H

#include "run/event_search.h"
#include "run/events.h"

/* The events up to the distance `last`, which are at one time, act in the order of the file; an
 * impact once more where another has turned the motion against it again. */
dal_status dal__act_events(const dal__event_search *w, double last,
                           const dal__event_listener *listener);
/* Sets the side that event k has left to.  Error: DAL_EVENT where that is out of a wall. */
dal_status dal__leave_event(const dal__event_search *w, int k);
/* The side of an event that did not act where others did, and may have set its formula. */
dal__side dal__side_beside(const dal__event_search *w, int k);
/* The memory of events was changed. */
void dal__commit_events(const dal__event_search *w);

#endif
