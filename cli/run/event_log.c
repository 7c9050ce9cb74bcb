/* event_log.c - the events of a run as CSV, written and read. */
#include "event_log.h"
#include "columns.h"
#include "ui/memory.h"
#include "ui/message.h"

#include "io/csv_cells.h"
#include "io/file.h"
#include "io/file_output.h"

#include <limits.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { NAME_SIZE = 256 };

static long long events_so_far(const dal_run *run)
{
    const dal_system *system = dal_run_system(run);
    long long count = 0;
    for (int k = 0; k < system->events; k++) count += dal_run_event_count(run, k);
    return count;
}

static void write_event_head(const event_log *log)
{
    const dal_run *run = log->simulation->run;
    char name[NAME_SIZE];
    fputs("t,event", log->file);
    for (int i = 0; i < dal_run_dimension(run); i++) {
        dal_run_component_name(run, i, name, sizeof name);
        columns_rename(&log->simulation->request, name);
        fputc(',', log->file);
        csv_put_text(log->file, name);
    }
    fputc('\n', log->file);
}

/* The bytes of a head and count lines of a file; -1 where it has fewer lines. */
static long long bytes_of(const char *text, size_t length, long long count)
{
    const char *at = text;
    for (long long line = 0; line <= count; line++) {
        at = memchr(at, '\n', length - (size_t)(at - text));
        if (!at) return -1;
        at++;
    }
    return at - text;
}

/* Cuts off what is after the events that the run has had. */
static int keep_events(event_log *log, long long count)
{
    size_t length;
    char *text = file_read(log->path, &length);
    if (!text) return CLI_IO;
    const long long bytes = bytes_of(text, length, count);
    free(text);
    if (bytes < 0)
        return cli_fail(CLI_USAGE, "'%s' has fewer than the %lld events of the run", log->path,
                        count);
    if (truncate(log->path, bytes) != 0) return cli_io("write", log->path);
    log->file = fopen(log->path, "ab");
    return log->file ? CLI_DONE : cli_io("write", log->path);
}

int event_log_open(event_log *log, const run_simulation *simulation, const char *path)
{
    *log = (event_log){.path = path, .simulation = simulation};
    const long long count = events_so_far(simulation->run);
    if (count > 0) return keep_events(log, count);
    const int status = file_stream_output(path, &log->file);
    if (status == CLI_DONE) write_event_head(log);
    return status;
}

static int write_failure(event_log *log)
{
    log->failed = true;
    return cli_io("write", log->path);
}

int event_log_add(event_log *log, const dal_occurrence *event)
{
    if (!log->file) return CLI_DONE;
    const dal_run *run = log->simulation->run;
    const double *state = dal_run_state(run);
    csv_put(log->file, event->t);
    fprintf(log->file, ",%d", event->event + 1);
    for (int i = 0; i < dal_run_dimension(run); i++) {
        fputc(',', log->file);
        csv_put(log->file, state[i]);
    }
    fputc('\n', log->file);
    return ferror(log->file) ? write_failure(log) : CLI_DONE;
}

int event_log_flush(event_log *log, file_sync sync)
{
    if (!log->file) return CLI_DONE;
    if (fflush(log->file) != 0 || (sync == FILE_SYNCED && fsync(fileno(log->file)) != 0))
        return write_failure(log);
    return CLI_DONE;
}

int event_log_close(event_log *log)
{
    FILE *file = log->file;
    if (!file) return CLI_DONE;
    log->file = NULL;
    if (!log->failed) return cli_close(file, log->path);
    if (file != stdout) fclose(file);
    return CLI_IO;
}

/* ---- reading ------------------------------------------------------------------------------- */

int event_reader_open(event_reader *r, const char *path, int dimension)
{
    size_t length;
    *r = (event_reader){.dimension = dimension};
    r->state = cli_calloc((size_t)dimension, sizeof *r->state);
    if (!file_exists(path)) return CLI_DONE;
    r->text = file_read(path, &length);
    if (!r->text) return CLI_IO;
    r->at = strchr(r->text, '\n');
    return CLI_DONE;
}

/* Reads the cell after a place, where `before` is, and moves the place to its end. */
static bool read_cell(const char **at, char before, double *x)
{
    char *end;
    if (**at != before) return false;
    *x = strtod(*at + 1, &end);
    const bool is_cell = end != *at + 1 && (*end == ',' || *end == '\n');
    *at = end;
    return is_cell;
}

bool event_reader_next(event_reader *r)
{
    const char *end = r->at ? strchr(r->at + 1, '\n') : NULL;
    double number;
    if (!end) return false;
    bool is_event = read_cell(&r->at, '\n', &r->t) && read_cell(&r->at, ',', &number) &&
                    number >= 1.0 && number <= INT_MAX;
    for (int i = 0; is_event && i < r->dimension; i++)
        is_event = read_cell(&r->at, ',', &r->state[i]);
    if (is_event) r->event = (int)number - 1;
    r->at = is_event ? end : NULL;
    return is_event;
}

void event_reader_close(event_reader *r)
{
    free(r->text);
    free(r->state);
    *r = (event_reader){.text = NULL};
}
