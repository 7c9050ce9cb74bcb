/* recorder.c - observes a run: rows, statistics, progress and checkpoints. */
#include "recorder.h"

#include "io/csv_cells.h"
#include "io/file.h"
#include "io/file_output.h"
#include "io/json.h"
#include "io/trend.h"
#include "manifest.h"
#include "row_times.h"
#include "ui/clock.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/signals.h"

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- results -------------------------------------------------------------------------------- */

void run_results_begin(run_results *r, const dal_run *run)
{
    *r = (run_results){.observables = dal_run_observables(run)};
    r->statistics = cli_calloc((size_t)r->observables + 1, sizeof *r->statistics);
    r->trend = cli_calloc((size_t)r->observables + 1, sizeof *r->trend);
    dal_statistics_start(r->statistics, r->observables);
}

void run_results_free(run_results *r)
{
    free(r->statistics);
    free(r->trend);
    record_free(&r->record);
}

static dal_status add_values(void *user, dal_run *run, int count, const double *t,
                             const double *values, size_t stride)
{
    const run_results *r = user;
    (void)run;
    dal_statistics_add_many(r->statistics, r->observables, count, t, values, stride);
    return DAL_STATUS_OK;
}

static dal_status add_scales(void *user, dal_run *run, const double *scales)
{
    const run_results *r = user;
    (void)run;
    dal_statistics_add_scales(r->statistics, r->observables, scales);
    return DAL_STATUS_OK;
}

void run_results_observe(dal_observer *observer)
{
    observer->values = add_values;
    observer->scales = add_scales;
}

observed_steps recorder_observed(run_recorder *r)
{
    return (observed_steps){r->results.statistics, r->results.observables, &r->results.record,
                            r->simulation->sensitivity};
}

/* ---- opening -------------------------------------------------------------------------------- */

/* Begins the record of a run in a directory whose rows show a part of its steps. */
static void begin_record(run_recorder *r)
{
    const run_simulation *s = r->simulation;
    const double every = (double)s->request.statistics * fabs(dal_run_step_size(s->run));
    const double steps = every > 0.0 ? fabs(s->end - s->request.from) / every : 0.0;
    const int n = s->system->n;
    r->results.record = record_of(n, 2 * n, r->results.observables);
    if (r->dir && steps > RECORD_STEPS_A_ROW * (double)s->samples)
        record_allocate(&r->results.record);
}

/* The columns were checked when the simulation was made. */
static void allocate_values(run_recorder *r)
{
    (void)columns_make(&r->columns, r->simulation);
    r->dimension = dal_run_dimension(r->simulation->run);
    const size_t count = (size_t)r->columns.values;
    r->values = cli_calloc(count, sizeof *r->values);
    r->row = cli_calloc(count, sizeof *r->row);
    run_results_begin(&r->results, r->simulation->run);
    r->results.names = (const char *const *)r->columns.name + 1 + r->dimension;
    begin_record(r);
}

static int open_writer(run_recorder *r, const char *output)
{
    const run_columns *c = &r->columns;
    char **names = cli_calloc((size_t)c->count, sizeof *names);
    for (int i = 0; i < c->count; i++) names[i] = c->name[c->index[i]];
    run_directory *dir = r->dir;
    int status = CLI_DONE;
    if (dir)
        writer_attach(&r->writer, dir->rows, dir->descriptor, names, c->count);
    else
        status = writer_create(&r->writer, output, names, c->count);
    free(names);
    if (!dir) return status;
    dir->descriptor = -1;
    const observed_steps observed = recorder_observed(r);
    status = checkpoint_load(dir, &r->writer, &r->results.position, r->simulation->run, &observed);
    if (status != CLI_DONE) return status;
    return writer_continue(&r->writer, r->results.position.row, &r->results.position.sum);
}

static bool is_interrupted(void *user)
{
    (void)user;
    return cli_interrupted();
}

static int write_state(run_recorder *r, store_state state, const char *message)
{
    return manifest_write(r->dir, r->simulation, &r->results.position, state, message);
}

int recorder_open(run_recorder *r, const run_simulation *simulation, run_directory *dir,
                  const char *output)
{
    *r = (run_recorder){.simulation = simulation, .dir = dir, .stop = is_interrupted};
    r->no_line = !isatty(STDERR_FILENO);
    r->shows_rows = !dir && strcmp(output, "-") == 0 && isatty(STDOUT_FILENO);
    allocate_values(r);
    int status = open_writer(r, output);
    if (status == CLI_DONE && dir && simulation->system->events > 0)
        status = event_log_open(&r->events, simulation, dir->events);
    if (status != CLI_DONE || !recorder_is_finished(r)) return status;
    dal_run_classify(simulation->run, r->results.statistics, DAL_STATUS_OK, r->results.trend);
    /* The run may have been killed between its last checkpoint and the manifest. */
    bool has_ended;
    status = manifest_read_end(dir->manifest, &has_ended);
    return status != CLI_DONE || has_ended ? status : write_state(r, STORE_DONE, "");
}

int recorder_close(run_recorder *r)
{
    const int closed = writer_close(&r->writer), logged = event_log_close(&r->events);
    free(r->values);
    free(r->row);
    columns_free(&r->columns);
    run_results_free(&r->results);
    return closed != CLI_DONE ? closed : logged;
}

bool recorder_is_finished(const run_recorder *r)
{
    return r->results.position.row > r->simulation->samples ||
           dal_run_stopped(r->simulation->run) > 0;
}

/* ---- progress ------------------------------------------------------------------------------ */

/* A line that replaces itself on a terminal, or lines of JSON on stderr for scripts:
 *
 *     t = 4310 (43 %), 35 s to go, 1.63e+07 steps/s, moved: D1 2.2e-16, E 3.1e-12
 *
 * moved is max |x - first|, of as many observables as fit the terminal. */

static const double json_interval = 1.0, line_interval = 0.1; /* seconds between two lines */

enum { LINE = 256 };

/* A line as it is made; a piece that does not fit is left out as a whole. */
typedef struct progress_line {
    char text[LINE];
    int length, capacity;
} progress_line;

static CLI_PRINTF(2, 3) bool append_piece(progress_line *line, const char *format, ...)
{
    char piece[LINE];
    va_list list;
    va_start(list, format);
    const int n = vsnprintf(piece, sizeof piece, format, list);
    va_end(list);
    if (n < 0 || line->length + n > line->capacity) return false;
    memcpy(line->text + line->length, piece, (size_t)n + 1);
    line->length += n;
    return true;
}

/* Seconds to the end, if the steps take as long as the steps of this process took so far. */
static double remaining(const run_recorder *r, double t)
{
    const double done = t - r->start_time;
    return done != 0.0 ? r->seconds * (r->simulation->end - t) / done : INFINITY;
}

static void append_remaining(progress_line *line, double seconds)
{
    static const struct {
        double max, seconds;
        const char *unit;
    } unit[] = {{120, 1, "s"}, {7200, 60, "min"}, {172800, 3600, "h"}, {INFINITY, 86400, "days"}};
    int i = 0;
    if (!isfinite(seconds)) return;
    while (seconds >= unit[i].max) i++;
    append_piece(line, ", %.0f %s to go", seconds / unit[i].seconds, unit[i].unit);
}

static void show_line(const run_recorder *r, double t)
{
    const int width = cli_width() - 1;
    progress_line line = {.capacity = width < LINE ? width : LINE - 1};
    const long long steps = dal_run_steps(r->simulation->run) - r->start_step;
    const double fraction =
        (t - r->simulation->request.from) / (r->simulation->end - r->simulation->request.from);
    append_piece(&line, "t = %.6g (%.0f %%)", t, floor(100.0 * fraction));
    append_remaining(&line, remaining(r, t));
    if (r->seconds > 0.0) append_piece(&line, ", %.2e steps/s", (double)steps / r->seconds);
    const char *before = ", moved: ";
    for (int i = 0; i < r->results.observables; i++) {
        const char *name = r->results.names[i];
        if (name[0] == '|') continue; /* the norms of p and pi are for the summary */
        if (!append_piece(&line, "%s%s %.2g", before, name,
                          dal_statistics_deviation(&r->results.statistics[i])))
            break;
        before = ", ";
    }
    cli_progress("%s", line.text);
}

static void show_json(const run_recorder *r, double t)
{
    json_writer w = {.out = stderr};
    json_open(&w, NULL, JSON_ON_ONE_LINE);
    json_put_number(&w, "t", t);
    json_put_number(&w, "time", r->simulation->end);
    json_put_integer(&w, "steps", dal_run_steps(r->simulation->run));
    json_put_integer(&w, "rows", r->results.position.row);
    json_put_number(&w, "seconds", r->results.position.seconds);
    json_put_number(&w, "remaining", fmax(0.0, remaining(r, t)));
    json_open(&w, "deviation", JSON_ON_ONE_LINE);
    for (int i = 0; i < r->results.observables; i++)
        json_put_number(&w, r->results.names[i],
                        dal_statistics_deviation(&r->results.statistics[i]));
    json_close(&w);
    json_close(&w);
    fputc('\n', w.out);
}

/* Shows the time that the run has reached, not too often. */
static void show_progress(run_recorder *r, double t)
{
    const bool is_json = r->progress == PROGRESS_JSON;
    const double now = cli_seconds();
    if (r->progress == PROGRESS_OFF || (!is_json && r->no_line)) return;
    if (now - r->shown < (is_json ? json_interval : line_interval)) return;
    r->shown = now;
    if (is_json)
        show_json(r, t);
    else
        show_line(r, t);
}

/* ---- observing ----------------------------------------------------------------------------- */

/* Stops the clock of steps and rows; returns the seconds since its start. */
static double stop_clock(run_recorder *r)
{
    const double seconds = cli_seconds() - r->clock;
    r->results.position.seconds += seconds;
    r->seconds += seconds;
    return seconds;
}

static dal_status library_status(run_recorder *r, int exit_status)
{
    r->failure = exit_status;
    return exit_status == CLI_DONE ? DAL_STATUS_OK : DAL_STATUS_IO;
}

static dal_status add_event(void *user, dal_run *run, const dal_occurrence *event)
{
    run_recorder *r = user;
    (void)run;
    return library_status(r, event_log_add(&r->events, event));
}

/* The derivatives at time t, after the observables. */
static dal_status add_derivatives(run_recorder *r, double t)
{
    dal_sensitivity *s = r->simulation->sensitivity;
    double *out = r->values + 1 + r->dimension + r->results.observables;
    const dal_status status = dal_sensitivity_advance(s, t, NULL);
    for (int k = 0; k < dal_sensitivity_count(s); k++, out += r->columns.derivatives)
        memcpy(out, dal_sensitivity_column(s, k), (size_t)r->columns.derivatives * sizeof *out);
    return status;
}

static dal_status add_row(void *user, dal_run *run, long long row, double t)
{
    run_recorder *r = user;
    double *state = r->values + 1;
    (void)row;
    r->values[0] = t;
    memcpy(state, dal_run_state(run), (size_t)r->dimension * sizeof *state);
    dal_status status = dal_run_observe(run, state + r->dimension);
    if (status == DAL_STATUS_OK && r->simulation->sensitivity) status = add_derivatives(r, t);
    if (status != DAL_STATUS_OK) return status;
    for (int i = 0; i < r->columns.count; i++) r->row[i] = r->values[r->columns.index[i]];
    r->results.position.row++;
    if (r->shows_rows) cli_progress_end();
    if (r->add_row) r->add_row(r->row_user, r->row);
    status = library_status(r, writer_append(&r->writer, r->row));
    /* In a directory the next poll ends the run: only there may a checkpoint be taken, and not
     * within a step that has a row between its ends. */
    return status == DAL_STATUS_OK && !r->dir && r->stop(r->stop_user) ? DAL_STATUS_INTERRUPTED
                                                                       : status;
}

/* The states of the steps whose observables come next. */
static dal_status add_states(void *user, dal_run *run, int count, const double *t,
                             const double *states, size_t stride)
{
    run_recorder *r = user;
    (void)run;
    r->steps = (record_steps){.count = count, .t = t, .states = states, .state_stride = stride};
    return DAL_STATUS_OK;
}

static dal_status add_steps(void *user, dal_run *run, int count, const double *t,
                            const double *values, size_t stride)
{
    run_recorder *r = user;
    r->steps.values = values;
    r->steps.stride = stride;
    record_add(&r->results.record, &r->steps);
    return add_values(user, run, count, t, values, stride);
}

static int save(run_recorder *r)
{
    int status = writer_sync(&r->writer, r->dir->sync);
    if (status == CLI_DONE) status = event_log_flush(&r->events, r->dir->sync);
    r->results.position.sum = r->writer.sum;
    const observed_steps observed = recorder_observed(r);
    if (status == CLI_DONE)
        status = checkpoint_save(r->dir, &r->results.position, r->simulation->run, &observed);
    r->saved = cli_seconds();
    return status;
}

/* A run that lives until a checkpoint is due waits for the disk from then on.  The rows come before
 * the manifest: without memory for it the program ends, and the rows are kept. */
static int save_and_sync(run_recorder *r)
{
    int status = CLI_DONE;
    if (r->dir->sync == FILE_UNSYNCED) {
        status = writer_sync(&r->writer, FILE_UNSYNCED);
        r->dir->sync = FILE_SYNCED;
        if (status == CLI_DONE) status = write_state(r, STORE_RUNNING, "");
    }
    return status == CLI_DONE ? save(r) : status;
}

static dal_status poll(void *user, dal_run *run)
{
    /* Polls come ten to a hundred times a second, however slow the steps. */
    enum { MAX_POLLING = 1024 };
    const double too_soon = 0.01, too_late = 0.1;
    run_recorder *r = user;
    const bool stop = r->stop(r->stop_user);
    dal_status status = DAL_STATUS_OK;
    const double seconds = stop_clock(r);
    if (seconds < too_soon && r->observer.polling < MAX_POLLING) r->observer.polling *= 2;
    if (seconds > too_late && r->observer.polling > 1) r->observer.polling /= 2;
    if (r->dir && cli_seconds() - r->saved >= r->interval)
        status = library_status(r, save_and_sync(r));
    else if (r->dir && stop)
        status = library_status(r, save(r));
    show_progress(r, dal_run_time(run));
    native_poll(&r->native);
    r->clock = cli_seconds();
    return status == DAL_STATUS_OK && stop ? DAL_STATUS_INTERRUPTED : status;
}

/* ---- the end ------------------------------------------------------------------------------- */

/* The exit status of an end; *error has a message only where none was printed yet. */
static int end_status(const run_recorder *r, dal_status status, dal_error *error)
{
    if (status == DAL_STATUS_OK || status == DAL_STATUS_STOPPED) return CLI_DONE;
    if (r->failure != CLI_DONE || status == DAL_STATUS_INTERRUPTED) error->message[0] = '\0';
    if (r->failure != CLI_DONE) return r->failure;
    if (status != DAL_STATUS_INTERRUPTED && error->message[0] == '\0')
        snprintf(error->message, sizeof error->message, "%s", dal_status_text(status));
    error->line = 0;
    return cli_exit(status);
}

/* Size and trend of each observable, as summary.csv. */
static int write_summary(const run_recorder *r)
{
    char *text;
    size_t length;
    FILE *out = cli_memstream_open(&text, &length);
    fprintf(out, "observable,first,final,maximum,deviation,%s\n", cli_trend_heads);
    for (int i = 0; i < r->results.observables; i++) {
        csv_put_text(out, r->results.names[i]);
        cli_put_values(out, &r->results.trend[i]);
        fputc('\n', out);
    }
    cli_memstream_close(out);
    const int status = file_replace(r->dir->summary, text, length, r->dir->sync);
    free(text);
    return status;
}

/* The summary comes before the checkpoint of a finished run, so that it is never missing.  A run
 * that failed has a checkpoint of that point: resumed, it fails again at once. */
static int write_end(run_recorder *r, int status, const char *message)
{
    int written = CLI_DONE;
    if (r->dir && (status == CLI_DONE || status == CLI_FAILED)) {
        written = writer_sync(&r->writer, FILE_UNSYNCED);
        if (written == CLI_DONE) written = write_summary(r);
        if (written == CLI_DONE) written = save(r);
    }
    if (r->dir && written == CLI_DONE && status != CLI_IO)
        written = write_state(r, store_end_state(status), message);
    const int closed = writer_close(&r->writer), logged = event_log_close(&r->events);
    if (status != CLI_DONE) return status;
    if (logged != CLI_DONE) return logged;
    return written != CLI_DONE ? written : closed;
}

static double row_time(void *user, long long row)
{
    const run_recorder *r = user;
    return row_times_get(r->simulation, row);
}

int recorder_run(run_recorder *r, dal_error *error)
{
    const run_simulation *s = r->simulation;
    dal_run *run = s->run;
    r->observer = (dal_observer){.user = r,
                                 .sample = add_row,
                                 .poll = poll,
                                 .event = add_event,
                                 .every = s->request.statistics,
                                 .row_time = s->row_time || s->request.steps > 0 ? row_time : NULL,
                                 .polling = 1};
    run_results_observe(&r->observer);
    if (r->results.record.number) {
        r->observer.states = add_states;
        r->observer.values = add_steps;
    }
    *error = (dal_error){0};
    if (r->dir && r->results.position.row > 0 && write_state(r, STORE_RUNNING, "") != CLI_DONE)
        return CLI_IO;
    r->saved = cli_seconds();
    r->start_time = dal_run_time(run);
    r->start_step = dal_run_steps(run);
    r->clock = cli_seconds();
    const dal_status status =
        dal_run_sample(run, s->end, s->samples, r->results.position.row, &r->observer, error);
    stop_clock(r);
    if (r->progress != PROGRESS_OFF) cli_progress_end();
    if (r->progress == PROGRESS_JSON) show_json(r, dal_run_time(run));
    dal_run_classify(run, r->results.statistics, status, r->results.trend);
    return write_end(r, end_status(r, status, error), error->message);
}
