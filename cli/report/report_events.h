/* report_events.h - the events of a run on its page. */
#ifndef DAL_CLI_REPORT_EVENTS_H
#define DAL_CLI_REPORT_EVENTS_H

#include "dalembert_system.h"
#include "report_page.h"

#include <stdio.h>

typedef struct event_kind {
    long long count;
    double first, last; /* t */
} event_kind;

typedef struct report_events {
    const dal_system *system; /* NULL: it has no events */
    event_kind *kind;         /* [system->events] */
    double *t;                /* [count] of all */
    double *passed;           /* [count] since the start */
    int count, capacity;
} report_events;

/* Reads the events of a run that began at `from`; free them in any case. */
int report_events_read(report_events *e, const char *path, const dal_system *system, double from);
void report_events_free(report_events *e);
/* A table of the events of the system: how often each happened, first and last. */
void report_events_write(report *r, const report_events *e);

#endif
