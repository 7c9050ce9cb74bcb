/* event_search.h - the first event within the next step of a run. */
#ifndef DAL_RUN_EVENT_SEARCH_H
#define DAL_RUN_EVENT_SEARCH_H

#include "run/crossing.h"

/* The memory of events, and scratch; E events. */
typedef struct dal__event_places {
    double *side, *count, *stopped, *stalled, *jump; /* see events.h */
    double *f, *rate;                                /* [E] values and rates at the present state */
    double *there;                                   /* [E] values before events acted */
    double *normals;                                 /* [(1 + 2n)*E] */
    double *states;                                  /* [2n*E] */
    double *before;                                  /* [dim] the state before an event */
    double *observed;                                /* [observables] */
} dal__event_places;

/* A branch of F as a step holds it. */
typedef struct dal__held_branch {
    double lower, upper; /* its argument stays between them */
    double size;         /* of which eps is the rounding of the argument */
    double scale;        /* max |rate| of the argument, at an end on both of its sides */
    bool is_at_end;      /* the argument is at one of them except for rounding */
    bool is_sliding;     /* and the rates lead back there from both sides */
} dal__held_branch;

/* What a search with the branches held needs; B branches, E events. */
typedef struct dal__held_places {
    dal__zero_search *crossing; /* of the E formulas `when`, and of how far the B branches hold */
    dal__held_branch *branch;   /* [B] */
    double *point;              /* [B] where they decide */
    double *value;              /* [2B] arguments, and sizes */
    double *rate, *across;      /* [B] rates of the arguments; with one of them on its other side */
    double *event_rate;         /* [E] */
    double *event_scale;        /* [E] max |rate| of `when` on both sides of an end; 0: at none */
} dal__held_places;

typedef struct dal__event_search {
    dal_run *run;
    dal_error *error;
    const dal_system *system;
    dal__event_places m;
    dal__held_places held;  /* branch is NULL where the system has no branches */
    dal__zero_search *free; /* of the formulas `when`, in a step as it is */
    dal__zero_search
        *crossing;   /* free or held.crossing: sides, and sizes of the steps to the events */
    double toward;   /* the sign of the step */
    bool has_failed; /* the step as it is */
} dal__event_search;

/* Numbers of what a run with events needs beside that memory; stored: numbers in a checkpoint. */
size_t dal__event_scratch(const dal__layout *layout, size_t stored);
/* The memory and scratch of a run. */
dal__event_places dal__event_places_of(const dal_run *run);
/* The search of the next step as it is; NULL: none was begun. */
const dal__zero_search *dal__event_crossing(const dal_run *run);
dal__event_search dal__event_search_begin(dal_run *run, dal_error *error);

/* Finds the first event within the next step, or a shorter one of size h: its distance, infinite
 * where there is none.  The run stays as it is, and the result is kept until it changes.  Errors:
 * as for a step, DAL_STATUS_NOT_FINITE. */
dal_status dal__search_events(dal__event_search *w, double h, double *distance);

/* Holds the branches as the search did that was kept for the present state, if any were held; and
 * the same where the caller has that search, until they are let go. */
void dal__hold_as_kept(dal_run *run);
void dal__hold_as_searched(const dal__event_search *w);
void dal__let_go_as_searched(const dal__event_search *w);
/* Whether the rates lead back, from both sides, to a branch that is where event k was found. */
bool dal__event_slides(const dal__event_search *w, int k);

/* Evaluates at the present state the values f and the rates, the rates alone, or the normals.
 * Where a branch of F changes, rates are taken on the side to which the motion leads. */
dal_status dal__evaluate_events(const dal__event_search *w);
dal_status dal__evaluate_event_rates(const dal__event_search *w);
dal_status dal__evaluate_event_normals(const dal__event_search *w);
/* The normal of an event: restitution, f_q, W^-1 f_q. */
const double *dal__event_normal(const dal__event_search *w, int k);
/* After dal__evaluate_event_normals: what is no more than the rounding of f, or of its rate. */
double dal__event_rounding(const dal__event_search *w, int k);
double dal__event_rate_rounding(const dal__event_search *w, int k);

const char *dal__event_name(const dal_system *system, int k);
/* The error that an event happens infinitely often. */
dal_status dal__events_endless(const dal__event_search *w, int k);

#endif
