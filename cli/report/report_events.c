/* report_events.c - the events of a run on its page. */
#include "report_events.h"
#include "ui/memory.h"

#include "report_page.h"
#include "run/event_log.h"

#include <math.h>
#include <stdlib.h>

enum { BEGIN_CAPACITY = 64 };

int report_events_read(report_events *e, const char *path, const dal_system *system, double from)
{
    *e = (report_events){.system = system};
    if (!system) return CLI_DONE;
    e->kind = cli_calloc((size_t)system->events, sizeof *e->kind);
    event_reader reader;
    const int status = event_reader_open(&reader, path, 0);
    while (event_reader_next(&reader)) {
        if (reader.event >= system->events) continue;
        event_kind *kind = &e->kind[reader.event];
        if (kind->count++ == 0) kind->first = reader.t;
        kind->last = reader.t;
        if (e->count == e->capacity) {
            e->capacity = e->capacity ? 2 * e->capacity : BEGIN_CAPACITY;
            e->t = cli_realloc(e->t, (size_t)e->capacity * sizeof *e->t);
            e->passed = cli_realloc(e->passed, (size_t)e->capacity * sizeof *e->passed);
        }
        e->passed[e->count] = fabs(reader.t - from);
        e->t[e->count++] = reader.t;
    }
    event_reader_close(&reader);
    return status;
}

void report_events_free(report_events *e)
{
    free(e->kind);
    free(e->t);
    free(e->passed);
    *e = (report_events){.system = NULL};
}

/* "impact, stops the run" */
static void write_actions(FILE *page, unsigned actions)
{
    fprintf(page, "<td>%s%s%s</td>",
            actions & DAL_EVENT_IMPACT ? "impact"
            : actions & DAL_EVENT_SETS ? "sets values"
                                       : "",
            actions & DAL_EVENT_STOPS && actions != DAL_EVENT_STOPS ? ", " : "",
            actions & DAL_EVENT_STOPS ? "stops the run"
            : actions == 0            ? "is counted"
                                      : "");
}

void report_events_write(report *r, const report_events *e)
{
    FILE *page = r->page;
    if (!e->system) return;
    report_heading(r, "events", "Events");
    fputs(REPORT_TABLE
          "<td></td><th>action</th><th>how often</th><th>first t</th><th>last t</th>" REPORT_ROWS,
          page);
    for (int k = 0; k < e->system->events; k++) {
        const event_kind *kind = &e->kind[k];
        report_row(page, e->system->event[k].name);
        write_actions(page, e->system->event[k].actions);
        report_number(page, "%.0f", (double)kind->count);
        report_number(page, "%.9g", kind->count ? kind->first : NAN);
        report_number(page, "%.9g", kind->count ? kind->last : NAN);
        fputs("</tr>\n", page);
    }
    fputs(REPORT_TABLE_END, page);
}
