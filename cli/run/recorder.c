/* recorder.c - looks on while a run goes and keeps what is seen. */
#include "recorder.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { NAME_SIZE = 256 };

/* ---- columns ------------------------------------------------------------------------------- */

/* The norms |p|, |pi|, |pi_e| repeat what other columns say: they are for the summary alone. */
static int is_column(const char *name) { return name[0] != '|'; }

static const char *value_name(const run_recorder *r, int i, char *buffer)
{
    const dal_run *run = r->request->run;
    if (i == 0) return "t";
    if (i <= r->dimension) return dal_run_name(run, i - 1, buffer, NAME_SIZE);
    return dal_run_observable_name(run, i - 1 - r->dimension, buffer, NAME_SIZE);
}

static void name_values(run_recorder *r, int count)
{
    char buffer[NAME_SIZE];
    for (int i = 0; i < count; i++) {
        const char *name = value_name(r, i, buffer);
        r->names[i] = cli_strdup(name ? name : "?");
        if (is_column(r->names[i])) r->column[r->columns++] = i;
    }
}

static void make_room(run_recorder *r)
{
    r->dimension = dal_run_dimension(r->request->run);
    r->observables = dal_run_observables(r->request->run);
    size_t count = 1 + (size_t)r->dimension + (size_t)r->observables;
    r->values = cli_calloc(count, sizeof *r->values);
    r->row = cli_calloc(count, sizeof *r->row);
    r->names = cli_calloc(count, sizeof *r->names);
    r->column = cli_calloc(count, sizeof *r->column);
    r->statistics = cli_calloc((size_t)r->observables + 1, sizeof *r->statistics);
    r->trend = cli_calloc((size_t)r->observables + 1, sizeof *r->trend);
    name_values(r, (int)count);
    dal_statistics_start(r->statistics, r->observables);
}

/* With a directory the table goes on where its checkpoint says. */
static int open_table(run_recorder *r, const char *output)
{
    char **names = cli_calloc((size_t)r->columns, sizeof *names);
    for (int i = 0; i < r->columns; i++) names[i] = r->names[r->column[i]];
    run_directory *s = r->dir;
    int status = CLI_DONE;
    if (s)
        writer_attach(&r->writer, s->rows, s->descriptor, names, r->columns);
    else
        status = writer_create(&r->writer, output, names, r->columns);
    free(names);
    if (!s) return status;
    s->descriptor = -1;
    status = checkpoint_load(s, &r->writer, &r->position, r->request->run, r->statistics,
                             r->observables);
    return status == CLI_DONE ? writer_continue(&r->writer, r->position.row, &r->position.sum)
                              : status;
}

static int interrupted(void *user)
{
    (void)user;
    return cli_interrupted();
}

static const char *state_word(int status)
{
    return status == CLI_DONE ? "done" : status == CLI_SIGNAL ? "interrupted" : "failed";
}

int recorder_open(run_recorder *r, const run_request *request, run_directory *dir,
                  const char *output)
{
    *r = (run_recorder){.request = request, .dir = dir, .stop = interrupted};
    r->quiet =
        !isatty(STDERR_FILENO) || (!dir && strcmp(output, "-") == 0 && isatty(STDOUT_FILENO));
    make_room(r);
    const int status = open_table(r, output);
    if (status != CLI_DONE || !recorder_is_finished(r)) return status;
    dal_run_classify(request->run, r->statistics, 0, r->trend);
    /* Killed between its last checkpoint and the manifest. */
    return manifest_has_ended(dir->manifest)
               ? CLI_DONE
               : manifest_write(dir, request, &r->position, state_word(CLI_DONE), "");
}

void recorder_close(run_recorder *r)
{
    writer_close(&r->writer);
    for (int i = 0; r->names && i < 1 + r->dimension + r->observables; i++) free(r->names[i]);
    free(r->values);
    free(r->row);
    free(r->names);
    free(r->column);
    free(r->statistics);
    free(r->trend);
}

int recorder_is_finished(const run_recorder *r) { return r->position.row > r->request->samples; }

const char *recorder_observable_name(const run_recorder *r, int i)
{
    return r->names[1 + r->dimension + i];
}

/* ---- looking on ---------------------------------------------------------------------------- */

/* Stops the clock of steps and rows while the program does something else, and starts it again. */
static double pause_clock(run_recorder *r)
{
    const double gone = cli_seconds() - r->since;
    r->position.seconds += gone;
    r->stretch += gone;
    return gone;
}

static void start_clock(run_recorder *r) { r->since = cli_seconds(); }

static dal_status tell(run_recorder *r, int exit_status)
{
    r->told = exit_status;
    return exit_status == CLI_DONE ? DAL_OK : DAL_IO;
}

static dal_status take_row(run_recorder *r, dal_run *run, double t)
{
    double *state = r->values + 1, *observed = state + r->dimension;
    r->values[0] = t;
    memcpy(state, dal_run_state(run), (size_t)r->dimension * sizeof *state);
    dal_status status = dal_run_observe(run, observed);
    if (status != DAL_OK) return status;
    for (int i = 0; i < r->columns; i++) r->row[i] = r->values[r->column[i]];
    r->position.row++;
    return tell(r, writer_append(&r->writer, r->row));
}

/* Every so many steps: what the summary is made of. */
static dal_status follow(void *user, dal_run *run, int looks, const double *t, const double *values,
                         size_t stride)
{
    run_recorder *r = user;
    (void)run;
    dal_statistics_add_many(r->statistics, r->observables, looks, t, values, stride);
    return DAL_OK;
}

static dal_status sample(void *user, dal_run *run, long long row, double t)
{
    run_recorder *r = user;
    (void)row;
    const dal_status status = take_row(r, run, t);
    /* With a directory the next poll ends the run: only there does the run stand where a checkpoint
     * may be taken, and not within a step that shows a row between two others. */
    return status == DAL_OK && !r->dir && r->stop(r->stop_user) ? DAL_INTERRUPTED : status;
}

static int save(run_recorder *r, const dal_run *run)
{
    int status = writer_sync(&r->writer, r->dir->sync);
    r->position.sum = r->writer.sum;
    if (status == CLI_DONE)
        status = checkpoint_save(r->dir, &r->position, run, r->statistics, r->observables);
    r->saved = cli_seconds();
    return status;
}

/* What is worth a checkpoint by the clock is worth waiting for the disk from now on.  The rows come
 * before the manifest: without memory for it the program ends, and the rows are kept. */
static int save_to_last(run_recorder *r, const dal_run *run)
{
    int status = CLI_DONE;
    if (!r->dir->sync) {
        status = writer_sync(&r->writer, 0);
        r->dir->sync = 1;
        if (status == CLI_DONE)
            status = manifest_write(r->dir, r->request, &r->position, "running", "");
    }
    return status == CLI_DONE ? save(r, run) : status;
}

/* Polls come some ten to a hundred times a second, however slow the steps. */
static void pace(dal_observer *observer, double gone)
{
    enum { MOST = 1024 };
    const double soon = 0.01, late = 0.1;
    if (gone < soon && observer->polling < MOST) observer->polling *= 2;
    if (gone > late && observer->polling > 1) observer->polling /= 2;
}

static dal_status poll(void *user, dal_run *run)
{
    run_recorder *r = user;
    const int stop = r->stop(r->stop_user);
    dal_status status = DAL_OK;
    pace(&r->observer, pause_clock(r));
    if (r->dir && cli_seconds() - r->saved >= r->interval)
        status = tell(r, save_to_last(r, run));
    else if (r->dir && stop)
        status = tell(r, save(r, run));
    progress_show(r, dal_run_time(run), 0);
    start_clock(r);
    return status == DAL_OK && stop ? DAL_INTERRUPTED : status;
}

/* ---- the end ------------------------------------------------------------------------------- */

/* The exit status of an end, and a message where none was given yet. */
static int conclude(const run_recorder *r, dal_status status, dal_error *error)
{
    if (status == DAL_OK) return CLI_DONE;
    if (r->told != CLI_DONE || status == DAL_INTERRUPTED) error->message[0] = '\0';
    if (r->told != CLI_DONE) return r->told;
    if (status != DAL_INTERRUPTED && error->message[0] == '\0')
        snprintf(error->message, sizeof error->message, "%s", dal_status_text(status));
    error->line = 0;
    return cli_exit(status);
}

/* The summary comes before the checkpoint that says "finished", so that it is never missing.  A run
 * that failed keeps where it stood: going on with it fails again at once. */
static int keep(run_recorder *r, int status, const char *why)
{
    int kept = CLI_DONE;
    if (r->dir && (status == CLI_DONE || status == CLI_FAILED)) {
        kept = writer_sync(&r->writer, 0);
        if (kept == CLI_DONE) kept = summary_write(r, r->dir->summary);
        if (kept == CLI_DONE) kept = save(r, r->request->run);
    }
    if (r->dir && kept == CLI_DONE && status != CLI_IO)
        kept = manifest_write(r->dir, r->request, &r->position, state_word(status), why);
    int closed = writer_close(&r->writer);
    if (status != CLI_DONE) return status;
    return kept != CLI_DONE ? kept : closed;
}

static double row_time(void *user, long long row)
{
    const run_recorder *r = user;
    return r->request->row_time[row];
}

int recorder_run(run_recorder *r, dal_error *error)
{
    r->observer = (dal_observer){.user = r,
                                 .sample = sample,
                                 .poll = poll,
                                 .values = follow,
                                 .every = r->request->statistics,
                                 .row_time = r->request->row_time ? row_time : NULL,
                                 .polling = 1};
    *error = (dal_error){0};
    if (r->dir && r->position.row > 0 &&
        manifest_write(r->dir, r->request, &r->position, "running", "") != CLI_DONE)
        return CLI_IO;
    r->saved = cli_seconds();
    r->begun = dal_run_time(r->request->run);
    r->begun_steps = dal_run_steps(r->request->run);
    start_clock(r);
    dal_status status = dal_run_sample(r->request->run, r->request->time, r->request->samples,
                                       r->position.row, &r->observer, error);
    pause_clock(r);
    if (r->progress != PROGRESS_OFF) cli_progress_end();
    progress_show(r, dal_run_time(r->request->run), 1);
    dal_run_classify(r->request->run, r->statistics, status != DAL_OK, r->trend);
    return keep(r, conclude(r, status, error), error->message);
}
