/* event_log.h - the events of a run as CSV: t, the number of the event, the state after it. */
#ifndef DAL_CLI_EVENT_LOG_H
#define DAL_CLI_EVENT_LOG_H

#include "request.h"

#include <stdio.h>

typedef struct event_log {
    FILE *file; /* NULL: none is written */
    const char *path;
    const run_request *request;
} event_log;

/* Creates a file; or, for a run that continues, cuts off what is behind the events that it has
 * had.  These return CLI_DONE, or print and return CLI_USAGE or CLI_IO. */
int event_log_open(event_log *log, const run_request *request, const char *path);
/* Writes an event that has just happened. */
int event_log_add(event_log *log, const dal_occurrence *event);
/* Brings what is written to the file; with sync to the disk. */
int event_log_flush(event_log *log, int sync);
int event_log_close(event_log *log);

#endif
