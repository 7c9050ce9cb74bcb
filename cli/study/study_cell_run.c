/* study_cell_run.c - one cell of a study: a run in a directory of its own, and what became of it.
 *
 * What is told of a cell is read from that directory, whether the run was made now, taken up, or
 * finished before: quantities from the statistics in its checkpoint, tracks from its rows.  Rows
 * are taken after whole numbers of steps, so that the trajectory is that of the steps alone. */
#include "dalembert.h"
#include "io/file.h"
#include "io/trajectory_reader.h"
#include "run/keep.h"
#include "study.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT = 512 };

typedef struct walk {
    const study_plan *plan;
    study_cell *cell;
    run_request request;
    char **text; /* of its options */
    size_t texts;
    char *directory;
    cli_keep keep;
    trajectory_reader reader;
    int n, m;
    int energy, hamiltonian, momenta, invariants, error; /* places among the observables, or -1 */
    double *values, *first;                              /* [observables] */
} walk;

/* ---- the request ---- */

CLI_PRINTF(3, 4) static int give(walk *w, int option, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    char *text = cli_format_list(format, list);
    va_end(list);
    w->text = cli_realloc(w->text, (w->texts + 1) * sizeof *w->text);
    w->text[w->texts] = text;
    return request_parse_option(&w->request, option, w->text[w->texts++]);
}

static int give_settings(walk *w, int option, const dal_setting *setting, int count, double unit)
{
    int status = CLI_DONE;
    for (int i = 0; i < count && status == CLI_DONE; i++)
        status = give(w, option, "%s=%.17g", setting[i].name, setting[i].value * unit);
    return status;
}

/* p_i = d, -d/2, d/3, ... and pi_i = d/2, -d/3, ...: no two alike, and not along the motion. */
static int displace(walk *w, double size)
{
    const dal_system *s = w->cell->of_case->system;
    int status = CLI_DONE;
    for (int i = 0; i < s->n && status == CLI_DONE; i++) {
        const double signed_size = i % 2 ? -size : size;
        status = give(w, REQUEST_start, "p_%s=%.17g", s->coordinate[i], signed_size / (i + 1));
        if (status == CLI_DONE)
            status = give(w, REQUEST_start, "pi_%s=%.17g", s->coordinate[i], signed_size / (i + 2));
    }
    return status;
}

static int give_start(walk *w)
{
    const study_case *e = w->cell->of_case;
    int status = give_settings(w, REQUEST_start, e->start, e->start_count, 1.0);
    if (status != CLI_DONE || w->cell->start != STUDY_DISPLACED) return status;
    if (e->displace_count == 0) return displace(w, e->displacement);
    return give_settings(w, REQUEST_start, e->displace, e->displace_count, e->displacement);
}

static int give_options(walk *w)
{
    const study_case *e = w->cell->of_case;
    int status = CLI_DONE;
    for (int i = 0; i < STUDY_OPTIONS && status == CLI_DONE; i++)
        if (e->option[i])
            status = give(w, request_find_option(study_option_word(i)), "%s", e->option[i]);
    return status;
}

static int give_all(walk *w)
{
    static const char *const space[] = {
#define X(code, word, space, about) space,
        STUDY_START_LIST(X)
#undef X
    };
    const study_cell *c = w->cell;
    const study_case *e = c->of_case;
    char method[STUDY_NAME];
    w->request.system = e->system;
    w->request.system_name = e->copy ? e->copy : e->name;
    int status =
        give(w, REQUEST_integrator, "%s", dal_method_name(c->method, method, sizeof method));
    if (status == CLI_DONE) status = give(w, REQUEST_step, "%.17g", c->step);
    if (status == CLI_DONE) status = give(w, REQUEST_time, "%.17g", e->time);
    if (status == CLI_DONE) status = give(w, REQUEST_samples, "%lld", e->samples);
    if (status == CLI_DONE) status = give(w, REQUEST_sampling, "steps");
    if (status == CLI_DONE) status = give(w, REQUEST_statistics, "%lld", e->statistics);
    if (status == CLI_DONE) status = give(w, REQUEST_space, "%s", space[c->start]);
    if (status == CLI_DONE) status = give_options(w);
    if (status == CLI_DONE) status = give_settings(w, REQUEST_set, e->set, e->set_count, 1.0);
    return status == CLI_DONE ? give_start(w) : status;
}

/* ---- memory and places ---- */

static int find(const study_cell *c, const char *name)
{
    for (int i = 0; i < c->observables; i++)
        if (strcmp(c->names[i], name) == 0) return i;
    return -1;
}

static int make_memory(walk *w)
{
    study_cell *c = w->cell;
    const run_recorder *r = &w->keep.recorder;
    const size_t count = (size_t)r->observables + 1;
    c->trend = cli_calloc(count, sizeof *c->trend);
    c->names = cli_calloc(count, sizeof *c->names);
    c->windows = cli_calloc(STUDY_WINDOWS, sizeof *c->windows);
    w->values = cli_calloc(2 * count, sizeof *w->values);
    w->first = w->values + count;
    c->observables = r->observables;
    for (int i = 0; i < c->observables; i++) {
        c->trend[i] = r->trend[i];
        snprintf(c->names[i], sizeof c->names[i], "%s", recorder_observable_name(r, i));
    }
    w->n = c->of_case->system->n;
    w->m = c->of_case->system->m;
    w->energy = find(c, "E");
    w->hamiltonian = find(c, "H");
    w->momenta = find(c, "|p|");
    w->error = find(c, "error");
    w->invariants = c->observables - c->of_case->system->invariants - (w->error >= 0);
    return CLI_DONE;
}

/* ---- rows ---- */

static double max_norm(const double *x, int count)
{
    double most = 0.0;
    for (int i = 0; i < count; i++)
        if (!(fabs(x[i]) <= most)) most = fabs(x[i]);
    return most;
}

/* The observables of a row, in which |p|, |pi| and |pi_e| are left out: they follow from p, pi. */
static void take_values(walk *w)
{
    const double *row = w->reader.row, *p = row + 2 + 2 * w->n;
    const double *next = row + w->reader.columns - w->cell->observables;
    if (w->momenta >= 0) next += 3;
    for (int i = 0; i < w->cell->observables; i++) {
        if (w->momenta >= 0 && i >= w->momenta && i < w->momenta + 3)
            w->values[i] = max_norm(p + (i - w->momenta) * w->n, i < w->momenta + 2 ? w->n : 1);
        else
            w->values[i] = *next++;
    }
}

static void raise_to(double *most, double x)
{
    if (!(x <= *most)) *most = isnan(x) ? INFINITY : x;
}

static void track(const walk *w, double *most)
{
    const double *x = w->values, *first = w->first;
    for (int a = 0; a < w->m; a++) raise_to(&most[STUDY_TRACK_D], fabs(x[a]));
    if (w->energy >= 0) raise_to(&most[STUDY_TRACK_E], fabs(x[w->energy] - first[w->energy]));
    if (w->hamiltonian >= 0)
        raise_to(&most[STUDY_TRACK_H], fabs(x[w->hamiltonian] - first[w->hamiltonian]));
    if (w->momenta >= 0) {
        raise_to(&most[STUDY_TRACK_P], x[w->momenta]);
        raise_to(&most[STUDY_TRACK_PI], x[w->momenta + 1]);
    }
    for (int i = w->invariants; i < w->invariants + w->cell->of_case->system->invariants; i++)
        raise_to(&most[STUDY_TRACK_INVARIANTS], fabs(x[i] - first[i]) / fmax(1.0, fabs(first[i])));
    if (w->error >= 0) raise_to(&most[STUDY_TRACK_ERROR], x[w->error]);
}

static void take_row(walk *w, long long k)
{
    study_cell *c = w->cell;
    const double samples = (double)w->request.samples;
    take_values(w);
    if (k == 0) memcpy(w->first, w->values, (size_t)c->observables * sizeof *w->first);
    const int window = (int)((double)k / (samples + 1.0) * STUDY_WINDOWS);
    track(w, c->windows[window]);
    c->window_count = window + 1;
    c->bits = file_hash(c->bits, w->reader.row + 1, 2 * (size_t)w->n * sizeof(double));
}

static int read_rows(walk *w)
{
    int status = reader_open(&w->reader, w->directory);
    if (status != CLI_DONE) return status;
    w->cell->bits = FILE_HASH_START;
    int more = 1;
    for (long long k = 0; k <= w->request.samples && (more = reader_next(&w->reader)) > 0; k++)
        take_row(w, k);
    reader_close(&w->reader);
    return more < 0 ? CLI_IO : CLI_DONE;
}

/* ---- the run ---- */

static void fail(study_cell *c, study_state state, dal_status status)
{
    c->state = state;
    c->error.status = status;
    if (!c->error.message[0])
        snprintf(c->error.message, sizeof c->error.message, "%s", dal_status_text(status));
}

/* The run itself; a cell whose run cannot be made is settled thereby. */
static int make_run(walk *w)
{
    dal_run_spec spec;
    study_cell *c = w->cell;
    int status = give_all(w);
    if (status == CLI_DONE) status = request_complete(&w->request, &spec);
    if (status != CLI_DONE) return status;
    const dal_status made = dal_run_create(&w->request.run, &spec, &c->error);
    if (cli_is_ok(made)) return CLI_DONE;
    w->request.run = NULL;
    fail(c, made == DAL_UNSUPPORTED ? STUDY_REFUSED : STUDY_FAILED, made);
    return CLI_DONE;
}

static int collect(walk *w, const dal_error *error, int ended)
{
    study_cell *c = w->cell;
    int status = make_memory(w);
    if (status == CLI_DONE) status = read_rows(w);
    if (status != CLI_DONE) return status;
    c->time = dal_run_time(w->request.run);
    c->steps = dal_run_steps(w->request.run);
    c->evaluations = dal_run_evaluations(w->request.run);
    c->seconds = w->keep.recorder.position.seconds;
    c->state = STUDY_FINISHED;
    c->error = *error;
    if (ended == CLI_FAILED) fail(c, STUDY_FAILED, error->status);
    return CLI_DONE;
}

static int go(walk *w, const study_stop_check *watch)
{
    const study_case *e = w->cell->of_case;
    dal_error error = {0};
    int ended = keep_open(&w->keep, &w->request, w->directory);
    if (ended == CLI_DONE && !keep_is_finished(&w->keep)) {
        const double left = (double)(w->request.time - dal_run_time(w->request.run));
        if (watch) {
            w->keep.recorder.stop = watch->stop;
            w->keep.recorder.stop_user = watch->user;
        }
        w->keep.recorder.interval = w->plan->interval;
        native_compile_steps(w->request.run, w->cell->method, left / w->cell->step, e->native);
        ended = keep_go(&w->keep, &error);
    }
    if (ended != CLI_DONE && ended != CLI_FAILED) return ended;
    return collect(w, &error, ended);
}

static void leave(walk *w)
{
    for (size_t i = 0; i < w->texts; i++) free(w->text[i]);
    free(w->text);
    free(w->directory);
    free(w->values);
    request_free(&w->request);
}

int study_cell_run(const study_plan *plan, study_cell *cell, const study_stop_check *watch)
{
    walk w = {.plan = plan, .cell = cell, .request = request_default()};
    int status = make_run(&w);
    if (status == CLI_DONE && w.request.run) {
        w.directory = study_cell_directory(plan, cell);
        status = go(&w, watch);
        keep_close(&w.keep);
    }
    if (status != CLI_DONE) study_cell_free(cell);
    leave(&w);
    return status;
}

int study_cell_is_runnable(study_cell *cell)
{
    walk w = {.cell = cell, .request = request_default()};
    const int can = make_run(&w) == CLI_DONE && w.request.run;
    leave(&w);
    study_cell_free(cell);
    return can;
}

void study_cell_free(study_cell *cell)
{
    free(cell->trend);
    free(cell->names);
    free(cell->windows);
    *cell = (study_cell){.of_case = cell->of_case,
                         .method = cell->method,
                         .step = cell->step,
                         .start = cell->start,
                         .elsewhere = cell->elsewhere};
}
