/* event_log.h - the events of a run as CSV, written and read: t, the number of the event, the state
 * after it. */
#ifndef DAL_CLI_EVENT_LOG_H
#define DAL_CLI_EVENT_LOG_H

#include "io/file.h"
#include "request_data.h"

#include <stdbool.h>
#include <stdio.h>

typedef struct event_log {
    FILE *file; /* NULL: none is written */
    const char *path;
    const run_simulation *simulation;
    bool failed; /* which was printed */
} event_log;

/* Creates a file; or, for a run that continues, cuts off what is after the events that it has
 * had.  These return CLI_DONE, or print and return CLI_USAGE or CLI_IO. */
int event_log_open(event_log *log, const run_simulation *simulation, const char *path);
/* Writes an event that has just happened. */
int event_log_add(event_log *log, const dal_occurrence *event);
/* Brings what is written to the file; with sync to the disk. */
int event_log_flush(event_log *log, file_sync sync);
int event_log_close(event_log *log);

/* The events of a file, one after the other. */
typedef struct event_reader {
    char *text;     /* of the file; NULL: there is none */
    const char *at; /* the end of the line before the next event */
    double t;
    int event; /* its number in the system, from 0 */
    int dimension;
    double *state; /* [dimension] the first components of the state after it */
} event_reader;

/* Opens a file, which may be missing: then there are no events.  Close it in any case. */
int event_reader_open(event_reader *r, const char *path, int dimension);
/* Reads an event; false after the last one, and after the last whole line of a file that a killed
 * run has left. */
bool event_reader_next(event_reader *r);
void event_reader_close(event_reader *r);

#endif
