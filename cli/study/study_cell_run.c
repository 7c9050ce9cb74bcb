/* study_cell_run.c - runs one cell of a study in its directory.
 *
 * The results are read from that directory, whether the run was made now, resumed, or finished
 * before: trends from the statistics in its checkpoint, tracks from its rows.  Rows are taken after
 * whole numbers of steps, so that the trajectory is that of the steps alone. */
#include "study_cell_run.h"

#include "io/file.h"
#include "io/output.h"
#include "io/trajectory_reader.h"
#include "run/manifest.h"
#include "run/recorder.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef struct cell_run {
    const study_plan *plan;
    study_cell *cell;
    run_request request;
    run_directory dir;
    run_recorder recorder;
    trajectory_reader reader;
    int n, m;
    int energy, hamiltonian, momenta, invariants, error; /* places among the observables, or -1 */
    double *values, *first;                              /* [observables] */
} cell_run;

/* ---- the request ---- */

static void add_settings(request_settings *settings, const dal_setting *setting, int count,
                         double unit)
{
    for (int i = 0; i < count; i++)
        request_add_setting(settings, setting[i].name, setting[i].value * unit);
}

/* By default p_i = d, -d/2, d/3, ... and pi_i = d/2, -d/3, ...: no two alike, and not along the
 * motion. */
static void add_displacement(cell_run *r)
{
    const study_case *e = r->cell->of_case;
    request_settings *start = &r->request.start;
    add_settings(start, e->displace, e->displace_count, e->displacement);
    for (int i = 0; e->displace_count == 0 && i < e->system->n; i++) {
        const double size = i % 2 ? -e->displacement : e->displacement;
        char *p = cli_format("p_%s", e->system->coordinate[i]);
        char *pi = cli_format("pi_%s", e->system->coordinate[i]);
        request_add_setting(start, p, size / (i + 1));
        request_add_setting(start, pi, size / (i + 2));
        free(p);
        free(pi);
    }
}

static void make_request(cell_run *r)
{
#define START_SPACE(code, word, space, about) space,
    static const dal_choice space[] = {STUDY_START_LIST(START_SPACE)};
#undef START_SPACE
    const study_cell *c = r->cell;
    const study_case *e = c->of_case;
    run_request *request = &r->request;
    request->system = e->system;
    request->system_name = e->copy ? e->copy : e->name;
    request->method = *c->method;
    request->options = e->options;
    request->options.step = c->step;
    request->options.space = space[c->start];
    request->time = e->time;
    request->samples = e->samples;
    request->sampling = REQUEST_SAMPLING_STEPS;
    request->statistics = e->statistics;
    request->typed = REQUEST_OPTION(integrator) | REQUEST_OPTION(step) | REQUEST_OPTION(space) |
                     REQUEST_OPTION(time) | REQUEST_OPTION(samples) | REQUEST_OPTION(sampling) |
                     REQUEST_OPTION(statistics);
    memcpy(request->text, e->option, sizeof request->text);
    add_settings(&request->set, e->set, e->set_count, 1.0);
    add_settings(&request->start, e->start, e->start_count, 1.0);
    if (c->start == STUDY_DISPLACED) add_displacement(r);
}

static void set_failure(study_cell *c, study_state state, dal_status status)
{
    c->state = state;
    c->error.status = status;
    if (!c->error.message[0])
        snprintf(c->error.message, sizeof c->error.message, "%s", dal_status_text(status));
}

/* A cell whose run cannot be created has that as its result, and no run. */
static int create_run(cell_run *r)
{
    dal_run_spec spec;
    make_request(r);
    const int status = request_complete(&r->request, &spec);
    if (status != CLI_DONE) return status;
    const dal_status created = dal_run_create(&r->request.run, &spec, &r->cell->error);
    if (cli_is_ok(created)) return CLI_DONE;
    r->request.run = NULL;
    set_failure(r->cell, created == DAL_UNSUPPORTED ? STUDY_REFUSED : STUDY_FAILED, created);
    return CLI_DONE;
}

/* ---- results ---- */

static int find_observable(const study_cell *c, const char *name)
{
    for (int i = 0; i < c->observables; i++)
        if (strcmp(c->names[i], name) == 0) return i;
    return -1;
}

static void take_trends(cell_run *r)
{
    study_cell *c = r->cell;
    const run_recorder *recorder = &r->recorder;
    const size_t count = (size_t)recorder->observables + 1;
    c->trend = cli_calloc(count, sizeof *c->trend);
    c->names = cli_calloc(count, sizeof *c->names);
    c->windows = cli_calloc(STUDY_WINDOWS, sizeof *c->windows);
    r->values = cli_calloc(2 * count, sizeof *r->values);
    r->first = r->values + count;
    c->observables = recorder->observables;
    for (int i = 0; i < c->observables; i++) {
        c->trend[i] = recorder->trend[i];
        snprintf(c->names[i], sizeof c->names[i], "%s", recorder_observable_name(recorder, i));
    }
    r->n = c->of_case->system->n;
    r->m = c->of_case->system->m;
    r->energy = find_observable(c, "E");
    r->hamiltonian = find_observable(c, "H");
    r->momenta = find_observable(c, "|p|");
    r->error = find_observable(c, "error");
    r->invariants = c->observables - c->of_case->system->invariants - (r->error >= 0);
}

/* Not a number counts as infinite. */
static void raise_to(double *max, double x)
{
    if (!(x <= *max)) *max = isnan(x) ? INFINITY : x;
}

static double max_norm(const double *x, int count)
{
    double max = 0.0;
    for (int i = 0; i < count; i++)
        if (!(fabs(x[i]) <= max)) max = fabs(x[i]);
    return max;
}

/* The observables of a row, in which |p|, |pi| and |pi_e| are left out: they follow from p, pi. */
static void read_values(cell_run *r)
{
    const double *row = r->reader.row, *p = row + 2 + 2 * r->n;
    const double *next = row + r->reader.columns - r->cell->observables;
    if (r->momenta >= 0) next += 3;
    for (int i = 0; i < r->cell->observables; i++) {
        const int k = r->momenta >= 0 ? i - r->momenta : -1;
        r->values[i] = k >= 0 && k < 3 ? max_norm(p + k * r->n, k < 2 ? r->n : 1) : *next++;
    }
}

static void raise_tracks(const cell_run *r, double *max)
{
    const double *x = r->values, *first = r->first;
    const int E = r->energy, H = r->hamiltonian, invariants = r->cell->of_case->system->invariants;
    for (int a = 0; a < r->m; a++) raise_to(&max[STUDY_TRACK_D], fabs(x[a]));
    if (E >= 0) raise_to(&max[STUDY_TRACK_E], fabs(x[E] - first[E]));
    if (H >= 0) raise_to(&max[STUDY_TRACK_H], fabs(x[H] - first[H]));
    if (r->momenta >= 0) {
        raise_to(&max[STUDY_TRACK_P], x[r->momenta]);
        raise_to(&max[STUDY_TRACK_PI], x[r->momenta + 1]);
    }
    for (int i = r->invariants; i < r->invariants + invariants; i++)
        raise_to(&max[STUDY_TRACK_INVARIANTS], fabs(x[i] - first[i]) / fmax(1.0, fabs(first[i])));
    if (r->error >= 0) raise_to(&max[STUDY_TRACK_ERROR], x[r->error]);
}

static int read_rows(cell_run *r)
{
    study_cell *c = r->cell;
    int status = reader_open(&r->reader, r->dir.path), more = 1;
    if (status != CLI_DONE) return status;
    c->bits = FILE_HASH_START;
    for (long long k = 0; k <= r->request.samples && (more = reader_next(&r->reader)) > 0; k++) {
        read_values(r);
        if (k == 0) memcpy(r->first, r->values, (size_t)c->observables * sizeof *r->first);
        const double part = (double)k / ((double)r->request.samples + 1.0);
        const int window = (int)(part * STUDY_WINDOWS);
        raise_tracks(r, c->windows[window]);
        c->window_count = window + 1;
        c->bits = file_hash(c->bits, r->reader.row + 1, 2 * (size_t)r->n * sizeof(double));
    }
    reader_close(&r->reader);
    return more < 0 ? CLI_IO : CLI_DONE;
}

static int take_results(cell_run *r, const dal_error *error, int ended)
{
    study_cell *c = r->cell;
    const dal_run *run = r->request.run;
    take_trends(r);
    const int status = read_rows(r);
    if (status != CLI_DONE) return status;
    c->time = dal_run_time(run);
    c->steps = dal_run_steps(run);
    c->evaluations = dal_run_evaluations(run);
    c->seconds = r->recorder.position.seconds;
    c->state = STUDY_FINISHED;
    c->error = *error;
    if (ended == CLI_FAILED) set_failure(c, STUDY_FAILED, error->status);
    return CLI_DONE;
}

/* ---- the run ---- */

/* Begins the run in its directory, or compares it with the run that is there.  Nothing waits for
 * the disk until the run is longer than the interval of checkpoints: what a power cut takes of a
 * shorter one is computed again. */
static int open_recorder(cell_run *r)
{
    run_directory *dir = &r->dir;
    const int has_run = run_directory_has_run(dir);
    dir->sync = 0;
    int status = cli_directory(dir->path);
    if (status == CLI_DONE) status = run_directory_lock(dir, !has_run);
    if (status == CLI_DONE && has_run) {
        run_request held = request_default();
        status = manifest_read(dir, &held);
        if (status == CLI_DONE) status = manifest_compare(dir, &held, &r->request);
        request_free(&held);
    } else if (status == CLI_DONE) {
        status = manifest_begin(dir, &r->request);
    }
    return status == CLI_DONE ? recorder_open(&r->recorder, &r->request, dir, dir->path) : status;
}

static int run_in_directory(cell_run *r, const study_stop_check *check)
{
    run_recorder *recorder = &r->recorder;
    dal_error error = {0};
    int ended = open_recorder(r);
    if (ended == CLI_DONE && !recorder_is_finished(recorder)) {
        const double left = r->request.time - dal_run_time(r->request.run);
        if (check) {
            recorder->stop = check->stop;
            recorder->stop_user = check->user;
        }
        recorder->interval = r->plan->interval;
        recorder->progress = PROGRESS_OFF;
        native_compile_steps(r->request.run, r->cell->method, left / r->cell->step,
                             r->cell->of_case->native);
        ended = recorder_run(recorder, &error);
    }
    return ended == CLI_DONE || ended == CLI_FAILED ? take_results(r, &error, ended) : ended;
}

static void free_run(cell_run *r)
{
    free(r->values);
    request_free(&r->request);
}

int study_cell_run(const study_plan *plan, study_cell *cell, const study_stop_check *check)
{
    cell_run r = {.plan = plan, .cell = cell, .request = request_default()};
    int status = create_run(&r);
    if (status == CLI_DONE && r.request.run) {
        char *directory = study_cell_directory(plan, cell);
        run_directory_open(&r.dir, directory);
        status = run_in_directory(&r, check);
        recorder_close(&r.recorder);
        run_directory_close(&r.dir);
        free(directory);
    }
    if (status != CLI_DONE) study_cell_free(cell);
    free_run(&r);
    return status;
}

bool study_cell_is_runnable(study_cell *cell)
{
    cell_run r = {.cell = cell, .request = request_default()};
    const int can = create_run(&r) == CLI_DONE && r.request.run;
    free_run(&r);
    study_cell_free(cell);
    return can;
}
