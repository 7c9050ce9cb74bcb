/* study_cell.c - one cell of a study: its run in a directory, and its results.
 *
 * Its tracks follow the rows that the recorder hands on; where the run was begun before, its
 * directory has the first ones.  Rows are taken after whole numbers of steps, so that the
 * trajectory consists of the steps alone.  A cell that keeps no rows has no directory: its results
 * go to the results of the study, and its bits are taken at both ends. */
#include "study_cell.h"
#include "dalembert_evaluator.h"

#include "dalembert_program.h"
#include "io/file.h"
#include "io/trajectory.h"
#include "run/manifest.h"
#include "run/recorder.h"
#include "run/simulation.h"
#include "study_predict.h"
#include "study_results.h"
#include "ui/clock.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/signals.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* The cells of a study that take the steps of this one, in units of its own steps. */
static double cells_alike(const study_cell *c)
{
    return *study_cell_method_steps(c) / study_cell_length(c);
}

/* Interpreted steps that take as long as to compile them. */
#define STEPS_WORTH 500000.0

/* --native of a cell: `on` compiles before the first of the cells that take such steps where that
 * takes less time than they do. */
static native_mode cell_native(const study_plan *plan, const study_cell *c)
{
    const bool is_long = *study_cell_method_steps(c) >= STEPS_WORTH;
    return plan->native == NATIVE_ON && !is_long ? NATIVE_AUTO : plan->native;
}

/* What of a column is on a track: its size, or its change since the start. */
typedef enum column_measure { NOT_TRACKED, MAX_ABS, CHANGE } column_measure;

typedef struct tracked_column {
    column_measure measure;
    int track;
    int observable; /* the number of one */
    double first;
    double max[STUDY_WINDOWS]; /* NaN: no rows */
} tracked_column;

typedef struct cell_run {
    const study_plan *plan;
    study_cell *cell;
    run_simulation simulation;
    dal_run_spec spec; /* of its run */
    run_directory dir;
    run_recorder recorder;
    tracked_column *column; /* [columns of the recorder] */
    long long rows;         /* that are on the tracks */
} cell_run;

/* ---- the request ---- */

static void add_settings(request_settings *to, const request_settings *from, double unit)
{
    for (int i = 0; i < from->count; i++)
        request_add_setting(to, from->item[i].name, from->item[i].value * unit);
}

/* The units of pi_i, and by time of p_i,
 *
 *     pi_i:  k/(l_i tau^2),   p_i:  k/(l_i tau^3),   k = min l_i^2,
 *
 * in the system's own units l_i and tau: pi = 1 changes no v'_i by more than its unit l_i/tau^2,
 * and p_i and pi_i change under the adjoint equations as 1/l_i.  size[2n], p first. */
static void find_momentum_units(const cell_run *r, double *size)
{
    const run_request *request = &r->simulation.request;
    const dal_system *system = r->simulation.system;
    const int n = system->n;
    dal_setting *start = cli_calloc((size_t)request->start.count + 1, sizeof *start);
    dal_run_spec spec = {.system = system,
                         .options = request->options,
                         .parameters = request->set.item,
                         .parameter_count = request->set.count,
                         .start = start,
                         .start_time = request->from};
    for (int i = 0; i < request->start.count; i++) /* p and pi have no part in the units */
        if (strncmp(request->start.item[i].name, "p_", 2) != 0 &&
            strncmp(request->start.item[i].name, "pi_", 3) != 0)
            start[spec.start_count++] = request->start.item[i];
    dal_scaled *scaled;
    double min = INFINITY;
    const bool found = dal_scaled_create(&scaled, &spec, NULL) == DAL_STATUS_OK;
    const double *units = dal_scaled_units(scaled), tau = found ? units[0] : 1.0;
    for (int i = 0; i < n && found; i++) min = fmin(min, units[1 + i]);
    for (int i = 0; i < n; i++) {
        size[n + i] = found ? min / units[1 + i] * min / tau / tau : 1.0;
        size[i] = size[n + i] / tau;
    }
    dal_scaled_free(scaled);
    free(start);
}

/* Adds a value in units of d: of p and pi in their units size[2n], of all else in its own. */
static void add_in_units(cell_run *r, const double *size, const char *name, double value)
{
    const study_case *e = r->cell->of_case;
    const int n = e->system->n;
    double d = e->displacement;
    for (int k = 0; k < 2 * n; k++) {
        char *momentum = cli_format("%s_%s", k < n ? "p" : "pi", e->system->coordinate[k % n]);
        if (strcmp(momentum, name) == 0) d *= size[k];
        free(momentum);
    }
    request_add_setting(&r->simulation.request.start, name, d * value);
}

/* By default p_i = d, -d/2, d/3, ... and pi_i = d/2, -d/3, ... in their units: no two alike, and
 * not along the motion. */
static void add_displacement(cell_run *r)
{
    const study_case *e = r->cell->of_case;
    const int n = e->system->n;
    double *size = cli_calloc(2 * (size_t)n, sizeof *size);
    find_momentum_units(r, size);
    for (int j = 0; j < e->displace.count; j++)
        add_in_units(r, size, e->displace.item[j].name, e->displace.item[j].value);
    for (int i = 0; e->displace.count == 0 && i < n; i++) {
        const double sign = i % 2 ? -1.0 : 1.0;
        char *p = cli_format("p_%s", e->system->coordinate[i]);
        char *pi = cli_format("pi_%s", e->system->coordinate[i]);
        add_in_units(r, size, p, sign / (i + 1));
        add_in_units(r, size, pi, sign / (i + 2));
        free(p);
        free(pi);
    }
    free(size);
}

/* Gives an option a number. */
static int give_number(run_request *request, int option, double x)
{
    char text[JSON_NUMBER];
    return request_give(request, option, cli_strdup(json_format_number(text, x)));
}

/* All but the displacement. */
static int give_options(run_request *request, const study_cell *c)
{
    char method[256];
#define START_SPACE(code, word, space, about) space == DAL_LIFTED ? "lifted" : "physical",
    static const char *const space[] = {STUDY_START_LIST(START_SPACE)};
#undef START_SPACE
    const study_case *e = c->of_case;
    request->system_name = study_case_system(e);
    request->options = e->options;
    request->choices = e->choices;
    memcpy(request->text, e->option, sizeof request->text);
    dal_method_name(c->method, method, sizeof method);
    const long long samples = e->rows == STUDY_ROWS_NONE ? 1 : e->samples;
    int status = request_give(request, REQUEST_integrator, cli_strdup(method));
    status |= give_number(request, REQUEST_step, c->step);
    status |= request_parse_option(request, REQUEST_space, space[c->start]);
    status |= request_give(request, REQUEST_samples, cli_format("%lld", samples));
    status |= request_parse_option(request, REQUEST_sampling, "steps");
    status |= request_give(request, REQUEST_statistics, cli_format("%lld", e->statistics));
    status |= e->run_steps > 0
                  ? request_give(request, REQUEST_steps, cli_format("%lld", e->run_steps))
                  : give_number(request, REQUEST_time, e->time);
    if (e->from != 0.0) status |= give_number(request, REQUEST_from, e->from);
    if (c->tolerance > 0.0) status |= give_number(request, REQUEST_tolerance, c->tolerance);
    if (e->observe) status |= request_parse_option(request, REQUEST_observe, e->observe);
    if (status != CLI_DONE) return CLI_USAGE;
    add_settings(&request->set, &e->set, 1.0);
    add_settings(&request->start, &e->start, 1.0);
    return CLI_DONE;
}

static int make_request(cell_run *r)
{
    run_request *request = &r->simulation.request;
    r->simulation.system = r->cell->of_case->system;
    const int status = give_options(request, r->cell);
    dal_method_complete(&request->method, r->simulation.system, &request->options, NULL, NULL);
    if (status == CLI_DONE && r->cell->start == STUDY_DISPLACED) add_displacement(r);
    return status;
}

uint64_t study_cell_key(const study_cell *cell, uint64_t system)
{
    const study_case *e = cell->of_case;
    run_request request = request_default();
    if (give_options(&request, cell) == CLI_DONE && cell->start == STUDY_DISPLACED) {
        request_add_setting(&request.start, "displacement", e->displacement);
        add_settings(&request.start, &e->displace, 1.0);
    }
    char *input = manifest_input(&request);
    uint64_t key = dal__hash(system, cell->name, strlen(cell->name) + 1);
    key = dal__hash(key, input, strlen(input));
    free(input);
    request_free(&request);
    return key;
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
    int status = make_request(r);
    if (status == CLI_DONE) status = simulation_complete(&r->simulation, &r->spec);
    if (status != CLI_DONE) return status;
    const dal_status created = dal_run_create(&r->simulation.run, &r->spec, &r->cell->error);
    if (cli_is_ok(created)) return CLI_DONE;
    r->simulation.run = NULL;
    set_failure(r->cell, created == DAL_STATUS_UNSUPPORTED ? STUDY_REFUSED : STUDY_FAILED, created);
    return CLI_DONE;
}

/* ---- results ---- */

static void begin_results(study_cell *c, const dal_run *run)
{
    c->observables = dal_run_observables(run);
    c->names = cli_calloc((size_t)c->observables, sizeof *c->names);
    c->trend = cli_calloc((size_t)c->observables, sizeof *c->trend);
    c->bits = DAL__HASH_START;
    for (int i = 0; i < c->observables; i++)
        dal_run_observable_name(run, i, c->names[i], sizeof c->names[i]);
}

/* Adds (q,v) as it is in files: zero has no sign, and what is not a number has one form. */
static void add_bits(study_cell *c, const double *state)
{
    for (int i = 0; i < 2 * c->of_case->system->n; i++) {
        const double x = isnan(state[i]) ? (double)NAN : state[i] + 0.0;
        c->bits = dal__hash(c->bits, &x, sizeof x);
    }
}

/* The columns of p and pi, and of observables, which come last and without |p|, |pi|,
 * |pi_e|.  Reactions and formulas that are observed need not be conserved. */
static void choose_tracks(cell_run *r)
{
    const study_cell *c = r->cell;
    const dal_system *s = c->of_case->system;
    const int error = c->observables - (study_cell_trend(c, "error") != NULL);
    const int columns = r->recorder.columns.count;
    const bool is_lifted = study_cell_trend(c, "|p|") != NULL;
    int reactions = error; /* the first of them */
    while (c->of_case->options.reactions && strcmp(c->names[reactions], "h1") != 0) reactions--;
    r->column = cli_calloc((size_t)columns, sizeof *r->column);
    for (int i = 0; i < columns * STUDY_WINDOWS; i++)
        r->column[i / STUDY_WINDOWS].max[i % STUDY_WINDOWS] = NAN;
    for (int i = 0; is_lifted && i < 2 * s->n; i++) {
        r->column[2 + 2 * s->n + i].measure = MAX_ABS;
        r->column[2 + 2 * s->n + i].track = i < s->n ? STUDY_TRACK_P : STUDY_TRACK_PI;
    }
    tracked_column *next = r->column + columns - c->observables + (is_lifted ? 3 : 0);
    for (int i = 0; i < c->observables; i++) {
        const char *name = c->names[i];
        if (name[0] == '|') continue;
        next->observable = i;
        next->measure = i < s->m || i == error                      ? MAX_ABS
                        : i >= reactions - s->observed && i < error ? NOT_TRACKED
                                                                    : CHANGE;
        next->track = i < s->m                         ? STUDY_TRACK_D
                      : i == error                     ? STUDY_TRACK_ERROR
                      : i >= reactions - s->invariants ? STUDY_TRACK_INVARIANTS
                      : strcmp(name, "E") == 0         ? STUDY_TRACK_E
                                                       : STUDY_TRACK_H;
        next++;
    }
}

/* A row of the run.  Not a number counts as infinite. */
static void track_row(void *user, const double *row)
{
    cell_run *r = user;
    const double fraction = (double)r->rows / ((double)r->simulation.samples + 1.0);
    const int window = (int)(fraction * STUDY_WINDOWS);
    for (int i = 0; i < r->recorder.columns.count; i++) {
        tracked_column *c = &r->column[i];
        if (r->rows == 0 && c->measure == CHANGE) c->first = row[i];
        const double x = fabs(row[i] - c->first);
        if (!(x <= c->max[window])) c->max[window] = isnan(x) ? INFINITY : x;
    }
    add_bits(r->cell, row + 1);
    r->cell->window_count = window + 1;
    r->rows++;
}

/* The rows of a run that was begun before. */
static int read_rows(cell_run *r)
{
    trajectory_reader reader;
    int status = reader_open(&reader, r->dir.path), more = 0;
    if (status != CLI_DONE) return status;
    while (r->rows <= r->simulation.samples && (more = reader_next(&reader)) > 0)
        track_row(r, reader.row);
    reader_close(&reader);
    return more < 0 ? CLI_IO : CLI_DONE;
}

/* The maxima of the columns, of an invariant divided by its scale. */
static void take_tracks(const cell_run *r)
{
    study_cell *c = r->cell;
    c->windows = cli_calloc(STUDY_WINDOWS, sizeof *c->windows);
    for (int i = 0; i < STUDY_WINDOWS * STUDY_TRACKS; i++)
        c->windows[i / STUDY_TRACKS][i % STUDY_TRACKS] = NAN;
    for (int i = 0; i < r->recorder.columns.count; i++) {
        const tracked_column *column = &r->column[i];
        const bool has_scale = column->track == STUDY_TRACK_INVARIANTS;
        const double scale = has_scale ? c->trend[column->observable].scale : 1.0;
        for (int k = 0; k < c->window_count && column->measure != NOT_TRACKED; k++) {
            const double x = column->max[k] / (scale > 0.0 && isfinite(scale) ? scale : 1.0);
            double *max = &c->windows[k][column->track];
            if (!isnan(x) && !(x <= *max)) *max = x;
        }
    }
}

static void take_end(cell_run *r, const dal_error *error, bool has_failed)
{
    study_cell *c = r->cell;
    const dal_run *run = r->simulation.run;
    c->time = dal_run_time(run);
    c->steps = dal_run_steps(run);
    c->evaluations = dal_run_evaluations(run);
    c->state = STUDY_FINISHED;
    c->error = *error;
    if (has_failed) set_failure(c, STUDY_FAILED, error->status);
}

/* ---- the run ---- */

/* Whether a run differs from the one that is held in a later end alone: the study was given more
 * time, and the rows of the run are at other distances then. */
static bool lasts_longer(const run_request *request, const run_request *held)
{
    static const int ends[] = {REQUEST_time, REQUEST_steps};
    const double more = copysign(1.0, held->options.step) * (request->time - held->time);
    const bool is_later =
        held->steps > 0 ? request->steps > held->steps : request->steps == 0 && more > 0.0;
    run_request longer = *held;
    for (int i = 0; i < 2; i++) longer.text[ends[i]] = request->text[ends[i]];
    char *one = manifest_input(&longer), *other = manifest_input(request);
    const bool is_same = strcmp(one, other) == 0;
    free(one);
    free(other);
    return is_later && is_same;
}

/* Begins the run in its directory, or compares it with the run that is there.  Nothing waits for
 * the disk until the run is longer than the interval of checkpoints: what a power cut takes of a
 * shorter one is computed again. */
static int open_recorder(cell_run *r)
{
    run_directory *dir = &r->dir;
    const bool has_run = run_directory_has_run(dir);
    dir->sync = FILE_UNSYNCED;
    bool is_longer = false;
    int status = file_make_directory(dir->path);
    if (status == CLI_DONE) status = run_directory_lock(dir, has_run ? RUN_EXISTING : RUN_NEW);
    if (status == CLI_DONE && has_run) {
        run_request held = request_default();
        status = manifest_read(dir, &held);
        is_longer = status == CLI_DONE && lasts_longer(&r->simulation.request, &held);
        if (status == CLI_DONE && !is_longer)
            status = manifest_compare(dir, &held, &r->simulation.request);
        request_free(&held);
    }
    if (status == CLI_DONE && (!has_run || is_longer)) {
        free(dir->input);
        dir->input = NULL;
        status = manifest_begin(dir, &r->simulation);
    }
    if (status == CLI_DONE) status = recorder_open(&r->recorder, &r->simulation, dir, dir->path);
    if (status != CLI_DONE) return status;
    begin_results(r->cell, r->simulation.run);
    choose_tracks(r);
    r->recorder.row_user = r;
    r->recorder.add_row = track_row;
    return r->recorder.results.position.row > 0 ? read_rows(r) : CLI_DONE;
}

static int run_in_directory(cell_run *r, const work_stop *stop)
{
    run_recorder *recorder = &r->recorder;
    dal_error error = {0};
    int ended = open_recorder(r);
    if (ended == CLI_DONE && !recorder_is_finished(recorder)) {
        recorder->stop = stop->stop;
        recorder->stop_user = stop->user;
        recorder->interval = r->plan->interval;
        recorder->progress = PROGRESS_OFF;
        recorder->native = native_begin(r->simulation.run, r->simulation.end, 0.0,
                                        cells_alike(r->cell), cell_native(r->plan, r->cell));
        ended = recorder_run(recorder, &error);
    }
    if (ended != CLI_DONE && ended != CLI_FAILED) return ended;
    study_cell *c = r->cell;
    memcpy(c->trend, recorder->results.trend, (size_t)c->observables * sizeof *c->trend);
    take_tracks(r);
    c->seconds = recorder->results.position.seconds;
    take_end(r, &error, ended == CLI_FAILED);
    return CLI_DONE;
}

/* ---- the run of a cell that keeps no rows ---- */

enum { POLLING = 124 /* steps */ };

typedef struct short_run {
    run_results results;
    cell_run *of_cell;
    const work_stop *stop;
    native_run native;
} short_run;

static double end_time(void *user, long long row)
{
    return ((short_run *)user)->of_cell->simulation.row_time[row];
}

static dal_status add_end(void *user, dal_run *run, long long row, double t)
{
    (void)row;
    (void)t;
    add_bits(((short_run *)user)->of_cell->cell, dal_run_state(run));
    return DAL_STATUS_OK;
}

static dal_status poll_short_run(void *user, dal_run *run)
{
    short_run *s = user;
    (void)run;
    native_poll(&s->native);
    return s->stop->stop(s->stop->user) ? DAL_STATUS_INTERRUPTED : DAL_STATUS_OK;
}

/* Runs the cell from its start to its end, however often it was begun. */
static dal_status integrate(cell_run *r, short_run *s, dal_error *error)
{
    const run_simulation *simulation = &r->simulation;
    study_cell *c = r->cell;
    dal_observer observer = {.user = s,
                             .sample = add_end,
                             .poll = poll_short_run,
                             .every = simulation->request.statistics,
                             .row_time = simulation->row_time ? end_time : NULL,
                             .polling = POLLING};
    const double alike = cells_alike(c), steps = simulation->end / c->step,
                 start = cli_thread_seconds();
    s->native = native_begin(simulation->run, simulation->end,
                             alike * steps / (double)simulation->request.statistics, alike,
                             cell_native(r->plan, c));
    run_results_observe(&observer);
    const dal_status status =
        dal_run_sample(simulation->run, simulation->end, 1, 0, &observer, error);
    const bool has_ended = status == DAL_STATUS_OK || status == DAL_STATUS_STOPPED;
    dal_run_classify(simulation->run, s->results.statistics, status, c->trend);
    c->seconds = cli_thread_seconds() - start;
    return has_ended ? DAL_STATUS_OK : status;
}

static int run_without_rows(cell_run *r, const work_stop *stop)
{
    study_cell *c = r->cell;
    const int number = (int)(c - r->plan->cells);
    dal_error error = {0};
    begin_results(c, r->simulation.run);
    study_results *results = r->plan->results[STUDY_STORED_RUNS];
    if (study_results_get(results, number, c)) return CLI_DONE;
    short_run s = {.of_cell = r, .stop = stop};
    run_results_begin(&s.results, r->simulation.run);
    const dal_status status = integrate(r, &s, &error);
    run_results_free(&s.results);
    if (status == DAL_STATUS_INTERRUPTED) return CLI_SIGNAL;
    take_end(r, &error, status != DAL_STATUS_OK);
    return study_results_add(results, number, c, r->plan->interval);
}

int study_cell_run(const study_plan *plan, study_cell *cell, const work_stop *stop)
{
    cell_run r = {.plan = plan, .cell = cell, .simulation = simulation_default()};
    int status = create_run(&r);
    if (status == CLI_DONE && r.simulation.run && cell->of_case->rows == STUDY_ROWS_NONE) {
        status = run_without_rows(&r, stop);
    } else if (status == CLI_DONE && r.simulation.run) {
        char *directory = cli_join(plan->runs, cell->name);
        run_directory_open(&r.dir, directory);
        status = run_in_directory(&r, stop);
        free(r.column);
        const int closed = recorder_close(&r.recorder);
        if (status == CLI_DONE) status = closed;
        run_directory_close(&r.dir);
        free(directory);
    }
    if (status == CLI_DONE && r.simulation.run && cell->of_case->predict)
        status = study_predict_cell(plan, cell, &r.spec, r.simulation.end, stop);
    if (status != CLI_DONE) study_cell_free(cell);
    simulation_free(&r.simulation);
    return status;
}

bool study_cell_is_runnable(study_cell *cell)
{
    cell_run r = {.cell = cell, .simulation = simulation_default()};
    const bool can = create_run(&r) == CLI_DONE && r.simulation.run;
    simulation_free(&r.simulation);
    study_cell_free(cell);
    return can;
}
