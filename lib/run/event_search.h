/* event_search.h - the first event within the next step of a run. */
#ifndef DAL_RUN_EVENT_SEARCH_H
#define DAL_RUN_EVENT_SEARCH_H

#include "run/run.h"

/* The memory of events, and scratch; E events. */
typedef struct dal__event_places {
    double *side, *count, *stopped, *stalled, *jump; /* see events.h */
    double *now;                                     /* [E] the side at the begin of a step */
    double *f0, *r0;                                 /* [E] values and rates there, */
    double *f1, *r1;                                 /* [E] and at its end */
    double *s;        /* [E] sizes of the steps to the events; infinite: none */
    double *there;    /* [E] values at an intermediate step */
    double *normals;  /* [(1 + 2n)*E] */
    double *states;   /* [2n*E] */
    double *before;   /* [dim] the state before an event */
    double *observed; /* [observables] */
} dal__event_places;

typedef struct dal__event_search {
    dal_run *run;
    dal_error *error;
    const dal_system *system;
    dal__event_places m;
    double h, toward; /* the step, and its sign */
    double from, to;  /* the part of it that is searched */
    bool any;         /* whether that may have events */
    int event;        /* the one that is located */
    bool rate;        /* by its rate, or by its value */
} dal__event_search;

/* Numbers of that memory, and of what else a run with events needs beside it. */
size_t dal__event_memory(const dal__layout *layout);
size_t dal__event_scratch(const dal__layout *layout);
/* Both of a run. */
dal__event_places dal__event_places_of(const dal_run *run);
dal__event_search dal__event_search_begin(dal_run *run, dal_error *error);

/* Takes a step and finds the first event in it: s of each, and the distance of the first, infinite
 * where there is none; only then the step is not taken back.  f0, r0 and now are those of the begin
 * of the part that was searched last, f1 and r1 those of its end.  Errors: those of a step,
 * DAL_NOT_FINITE, DAL_EVENT. */
dal_status dal__search_events(dal__event_search *w, double *distance);

/* Values of event_values or event_rates at the present state; both; and the normals. */
dal_status dal__evaluate_events(const dal__event_search *w, dal_callback *callback, double *out);
dal_status dal__evaluate_events_and_rates(const dal__event_search *w, double *f, double *rate);
dal_status dal__evaluate_event_normals(const dal__event_search *w);
/* The normal of an event: restitution, f_q, W^-1 f_q. */
const double *dal__event_normal(const dal__event_search *w, int k);
/* After dal__evaluate_event_normals: what is no more than the rounding of f, or of its rate. */
double dal__event_rounding(const dal__event_search *w, int k);
double dal__event_rate_rounding(const dal__event_search *w, int k);
/* The least time that the clock resolves. */
double dal__event_time_rounding(const dal__event_search *w);

const char *dal__event_name(const dal__event_search *w, int k);
/* Whether leaving a side is the event, or returning to it is. */
bool dal__is_event_from(const dal__event_search *w, int k, double side);
/* The error that an event happens infinitely often. */
dal_status dal__events_endless(const dal__event_search *w, int k);

static inline double dal__sign(double x) { return (double)((x > 0.0) - (x < 0.0)); }

#endif
