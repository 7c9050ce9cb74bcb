/* section.c - where a motion crosses a surface g(q,v,t) = 0.
 *
 * The formula of g becomes one more invariant of the system's model: it may name whatever an
 * invariant may, and is evaluated as invariants are. */
#include "section.h"
#include "analysis.h"
#include "dalembert_dynamics.h"
#include "dalembert_evaluator.h"
#include "io/store.h"
#include "io/trajectory.h"
#include "run/columns.h"
#include "run/request_json.h"
#include "run/system.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/screen.h"
#include "ui/signals.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_NAME = 80, SCREEN_ROWS = 12 /* on a terminal */ };

/* The columns of a row before the state. */
enum { COLUMN_CROSSING, COLUMN_T, COLUMN_DIRECTION, FIRST_STATE_COLUMN };

typedef struct section {
    const section_settings *set;
    run_simulation *simulation;
    trajectory_writer table; /* where rows go, unless they go to stdout as JSON */
    int columns;
    char **names;            /* [columns], then their texts */
    double *row, *min, *max; /* [columns] of a row, and of all */
    long long rows, capacity;
    double *kept; /* [rows * columns] for JSON; NULL: none are kept */
    dal_crossings found;
    int write_status; /* of the last row, */
    int status;       /* and of the run */
    native_run native;
    int axis[2]; /* columns of the figure; -1: not given */
} section;

/* ---- the model with the section among its invariants --------------------------------------- */

/* Reads the model and makes it with one more invariant, whose text begins in a column of --on. */
static int load_with_invariant(run_simulation *simulation, const char *name, const char *formula,
                               int column)
{
    dal_error error = {0};
    dal_model_free(simulation->model);
    int status = cli_read(simulation->request.system_name, &simulation->model);
    if (status == CLI_DONE) status = cli_choose(&simulation->model, &simulation->request.choices);
    if (status != CLI_DONE) return status;
    dal_status made =
        dal_model_add(simulation->model, DAL_SECTION_INVARIANTS, name, formula, 1, column, &error);
    if (made == DAL_STATUS_OK)
        made = dal_model_system(simulation->model, &simulation->system, &error);
    if (made == DAL_STATUS_OK) return CLI_DONE;
    /* The user knows --on, not the invariant. */
    char prefix[MAX_NAME + 16];
    const size_t n = (size_t)snprintf(prefix, sizeof prefix, "invariant %s: ", name);
    if (strncmp(error.message, prefix, n) == 0)
        memmove(error.message, error.message + n, strlen(error.message + n) + 1);
    return cli_error(cli_input_exit(made), "--on", &error);
}

static int load_section(section *s)
{
    run_simulation *simulation = s->simulation;
    char name[MAX_NAME] = "section_1";
    const char *equals = strchr(s->set->on, '=');
    if (simulation->system->events > 0)
        return cli_fail(CLI_USAGE, "%s: %s has events: sections would pass over them",
                        simulation->request.system_name, simulation->system->name);
    /* The system has been loaded without the section: any error is one of the section. */
    for (int k = 2; cli_has_name(simulation->system, name); k++)
        snprintf(name, sizeof name, "section_%d", k);
    if (!equals) return load_with_invariant(simulation, name, s->set->on, 1);
    /* "A = B" means (A) - (B).  Each side is made alone first, so that an error names its column in
     * --on. */
    const int length = (int)(equals - s->set->on);
    char *left = cli_format("%.*s", length, s->set->on);
    char *difference = cli_format("(%s)-(%s)", left, equals + 1);
    int status = load_with_invariant(simulation, name, left, 1);
    if (status == CLI_DONE) status = load_with_invariant(simulation, name, equals + 1, length + 2);
    if (status == CLI_DONE) status = load_with_invariant(simulation, name, difference, 1);
    free(left);
    free(difference);
    return status;
}

/* ---- rows ---------------------------------------------------------------------------------- */

static void name_row(section *s)
{
    static const char *const first[FIRST_STATE_COLUMN] = {"crossing", "t", "direction"};
    s->columns = FIRST_STATE_COLUMN + dal_run_dimension(s->simulation->run);
    const size_t columns = (size_t)s->columns;
    s->names = cli_calloc(columns, sizeof *s->names + MAX_NAME);
    s->row = cli_calloc(3 * columns, sizeof *s->row);
    s->min = s->row + columns;
    s->max = s->min + columns;
    for (int i = 0; i < s->columns; i++) {
        s->min[i] = INFINITY;
        s->max[i] = -INFINITY;
        s->names[i] = (char *)(s->names + columns) + i * MAX_NAME;
        if (i < FIRST_STATE_COLUMN)
            snprintf(s->names[i], MAX_NAME, "%s", first[i]);
        else
            dal_run_component_name(s->simulation->run, i - FIRST_STATE_COLUMN, s->names[i],
                                   MAX_NAME);
    }
}

static void keep_row(section *s)
{
    const size_t columns = (size_t)s->columns;
    if (s->rows == s->capacity) {
        s->capacity = 2 * s->capacity + 64;
        s->kept = cli_realloc(s->kept, (size_t)s->capacity * columns * sizeof *s->kept);
    }
    memcpy(s->kept + (size_t)s->rows * columns, s->row, columns * sizeof *s->row);
}

static dal_status write_crossing(void *user, dal_run *run, const dal_crossing *crossing)
{
    section *s = user;
    if (crossing->t < s->set->transient) return DAL_STATUS_OK;
    s->row[COLUMN_CROSSING] = (double)s->rows + 1.0;
    s->row[COLUMN_T] = crossing->t;
    s->row[COLUMN_DIRECTION] = crossing->direction;
    memcpy(s->row + FIRST_STATE_COLUMN, dal_run_state(run),
           (size_t)dal_run_dimension(run) * sizeof *s->row);
    for (int i = 0; i < s->columns; i++) {
        s->min[i] = fmin(s->min[i], s->row[i]);
        s->max[i] = fmax(s->max[i], s->row[i]);
    }
    if (s->set->json || (s->set->is_screen && s->rows < SCREEN_ROWS)) keep_row(s);
    s->rows++;
    if (s->table.path) s->write_status = writer_append(&s->table, s->row);
    return s->write_status == CLI_DONE ? DAL_STATUS_OK : DAL_STATUS_IO;
}

static dal_status poll_signals(void *user, dal_run *run)
{
    section *s = user;
    native_poll(&s->native);
    cli_progress("t = %.6g of %.6g, %lld crossings", dal_run_time(run), s->simulation->end,
                 s->rows);
    return cli_interrupted() ? DAL_STATUS_INTERRUPTED : DAL_STATUS_OK;
}

/* The crossings on a terminal: their number, and of the first ones as many columns as fit. */
static int print_screen(const section *s)
{
    enum { DIGITS = 6 };
    static const char *const directions[] = {"down", "touch", "up"};
    const long long rows = s->rows < SCREEN_ROWS ? s->rows : SCREEN_ROWS;
    char method[MAX_NAME], count[SCREEN_NUMBER], x[SCREEN_NUMBER];
    screen out;
    screen_open(&out, stdout, SCREEN_TEXT);
    screen_say(&out, 2, "%s by %s crosses %s%s %s times until t = %.6g",
               s->simulation->request.system_name,
               dal_method_name(&s->simulation->request.method, method, sizeof method), s->set->on,
               strchr(s->set->on, '=') ? "" : " = 0", screen_count(count, s->rows),
               dal_run_time(s->simulation->run));
    screen_say(&out, 2, "%lld upwards, %lld downwards, %lld touches", s->found.up, s->found.down,
               s->found.touches);
    screen_skip(&out);
    screen_table t = {.columns = s->columns};
    for (int i = 0; i < s->columns; i++)
        screen_add_cell(&t, SCREEN_PLAIN, "%s", i == COLUMN_CROSSING ? "" : s->names[i]);
    for (long long k = 0; k < rows * s->columns; k++) {
        const long long i = k % s->columns;
        if (i == COLUMN_DIRECTION)
            screen_add_cell(&t, SCREEN_PLAIN, "%s", directions[(int)s->kept[k] + 1]);
        else
            screen_add_cell(&t, SCREEN_PLAIN, "%s", screen_number(x, s->kept[k], DIGITS));
    }
    const int left_out = screen_add_table(&out, &t, "rrlr", 0);
    screen_free_table(&t);
    if (rows < s->rows) screen_say(&out, 2, "... and %lld more (--details)", s->rows - rows);
    screen_skip(&out);
    if (left_out > 0) screen_say(&out, 2, "%d more columns: --details, or -o FILE.csv", left_out);
    if (strcmp(s->set->output, "-") == 0)
        screen_say(&out, 2, "Rows:  -o FILE.csv, or a pipe; a page: -o DIR");
    else
        screen_say(&out, 2, "Rows:  %lld in %s", s->rows, s->set->output);
    return screen_close(&out, "--details");
}

static int run_section(section *s, const char *path)
{
    const run_simulation *r = s->simulation;
    dal_error error = {0};
    const dal_poincare poincare = {.callback = r->system->invariant_values,
                                   .count = r->system->invariants,
                                   .index = r->system->invariants - 1,
                                   .direction = s->set->direction,
                                   .user = s,
                                   .cross = write_crossing,
                                   .poll = poll_signals};
    for (int i = 0; i < s->columns; i++)
        columns_rename(&r->request, s->names[i]); /* --axes is read */
    const bool is_stdout = strcmp(path, "-") == 0,
               has_table = !((s->set->json || s->set->is_screen) && is_stdout);
    int status = has_table ? writer_create(&s->table, path, s->names, s->columns) : CLI_DONE;
    if (status == CLI_DONE) {
        cli_catch_signals();
        s->native = native_begin(r->run, r->end, 0.0, 1.0, s->set->native);
        const dal_status done = dal_run_crossings(r->run, r->end, &poincare, &s->found, &error);
        cli_progress_end();
        if (s->write_status != CLI_DONE)
            status = s->write_status;
        else if (done == DAL_STATUS_INTERRUPTED)
            status = cli_fail(CLI_SIGNAL, "interrupted; %lld rows are kept", s->rows);
        else if (done != DAL_STATUS_OK)
            status = cli_error(done == DAL_STATUS_ARGUMENT ? CLI_USAGE : cli_exit(done),
                               r->request.system_name, &error);
    }
    const int closed = has_table ? writer_close(&s->table) : CLI_DONE;
    if (s->found.unresolved > 0)
        cli_note("%lld steps may hide crossings, the first from t = %g: |dg/dt| h > pi max |g| in "
                 "their intervals",
                 s->found.unresolved, s->found.first_unresolved);
    FILE *out = is_stdout ? stderr : stdout;
    if (s->set->is_screen && status != CLI_USAGE)
        return print_screen(s) == CLI_DONE ? status : CLI_IO;
    if (!s->set->json && (!is_stdout || isatty(STDERR_FILENO)))
        fprintf(out, "t = %g: %lld upwards, %lld downwards, %lld touches; %lld rows\n",
                dal_run_time(r->run), s->found.up, s->found.down, s->found.touches, s->rows);
    return status == CLI_DONE ? closed : status;
}

/* ---- JSON ---------------------------------------------------------------------------------- */

static void put_run(json_writer *w, const section *s)
{
    static const char *const directions[] = {"down", "both", "up"};
    request_open_json(w, s->simulation, SECTION_WITHOUT);
    json_put_text(w, "on", s->set->on);
    json_put_text(w, "direction", directions[s->set->direction + 1]);
    json_put_number(w, "transient", s->set->transient);
    json_close(w);
    json_put_text(w, "state", store_state_words[store_end_state(s->status)]);
    json_put_number(w, "to", dal_run_time(s->simulation->run));
    json_put_integer(w, "up", s->found.up);
    json_put_integer(w, "down", s->found.down);
    json_put_integer(w, "touches", s->found.touches);
    json_put_integer(w, "unresolved", s->found.unresolved);
    json_put_number(w, "first_unresolved", s->found.first_unresolved);
}

static int put_section(const section *s)
{
    json_writer w = json_begin_results("section");
    put_run(&w, s);
    json_open_list(&w, "columns", JSON_ON_ONE_LINE);
    for (int i = 0; i < s->columns; i++) json_put_text(&w, NULL, s->names[i]);
    json_close(&w);
    json_open_list(&w, "rows", JSON_LINES);
    for (long long k = 0; k < s->rows; k++) {
        json_open_list(&w, NULL, JSON_ON_ONE_LINE);
        for (int i = 0; i < s->columns; i++) json_put_number(&w, NULL, s->kept[k * s->columns + i]);
        json_close(&w);
    }
    json_close(&w);
    json_end_results(&w);
    return cli_close(stdout, "standard output");
}

/* ---- the figure ---------------------------------------------------------------------------- */

/* The columns given by --axes, or -1 and -1; the number of a crossing is none of them. */
static int find_axes(section *s)
{
    int *axis = s->axis;
    axis[0] = axis[1] = -1;
    if (!s->set->axes) return CLI_DONE;
    const int status = columns_find_axes(s->set->axes, (const char *const *)s->names + COLUMN_T,
                                         s->columns - COLUMN_T, axis);
    for (int i = 0; i < 2; i++) axis[i] += COLUMN_T;
    return status;
}

/* Visibly, and by more than an error of the method: relative to the column itself, and to the unit
 * of the coordinate or the velocity. */
static bool varies(const section *s, int column, const double *units)
{
    const double range = s->max[column] - s->min[column];
    const double size = fmax(fabs(s->min[column]), fabs(s->max[column]));
    return range > 1e-3 * size && range > 1e-6 * units[column - FIRST_STATE_COLUMN];
}

/* The last coordinate that varies together with its velocity; else the last two of q and v that
 * vary; else t and the one that does. */
static int choose_axes(section *s)
{
    const int n = s->simulation->system->n, q = FIRST_STATE_COLUMN;
    int *axis = s->axis, i = q + n - 1;
    dal_scaled *scaled;
    dal_error error = {0};
    const dal_status made = dal_scaled_create_at(&scaled, s->simulation->run, &error);
    if (made != DAL_STATUS_OK)
        return cli_error(cli_exit(made), s->simulation->request.system_name, &error);
    const double *units = dal_scaled_units(scaled) + 1;
    while (i >= q && !(varies(s, i, units) && varies(s, i + n, units))) i--;
    axis[0] = i;
    axis[1] = i + n;
    if (i < q) {
        axis[1] = q + 2 * n - 1;
        while (axis[1] > q && !varies(s, axis[1], units)) axis[1]--;
        axis[0] = axis[1] - 1;
        while (axis[0] >= q && !varies(s, axis[0], units)) axis[0]--;
        if (axis[0] < q) axis[0] = COLUMN_T;
    }
    dal_scaled_free(scaled);
    return CLI_DONE;
}

/* The run, and the columns of the figure. */
static void put_figure(json_writer *w, const void *results)
{
    const section *s = results;
    put_run(w, s);
    json_open_list(w, "axes", JSON_ON_ONE_LINE);
    for (int i = 0; i < 2; i++) json_put_text(w, NULL, s->names[s->axis[i]]);
    json_close(w);
}

/* ---- all ----------------------------------------------------------------------------------- */

int section_find(section_settings *settings)
{
    section s = {.set = settings, .simulation = &settings->simulation};
    analysis_output output = {0};
    int status = load_section(&s);
    if (status != CLI_DONE) return status;
    status = simulation_create(s.simulation);
    if (status != CLI_DONE) return status;
    if (settings->transient >= s.simulation->end && s.simulation->request.options.step > 0.0)
        return cli_fail(CLI_USAGE, "--transient %g: no crossing remains, the run ends at t = %g",
                        settings->transient, s.simulation->end);
    name_row(&s);
    status = find_axes(&s);
    if (status == CLI_DONE && !settings->force) status = analysis_check_directory(settings->output);
    if (status == CLI_DONE) status = analysis_open(&output, settings->output, "section");
    if (status == CLI_DONE) s.status = status = run_section(&s, output.table);
    if (settings->json && status != CLI_USAGE && status != CLI_IO) {
        const int written = put_section(&s);
        if (status == CLI_DONE) status = written;
    }
    if ((status == CLI_DONE || status == CLI_SIGNAL) && output.directory) {
        int written = s.axis[0] < 0 ? choose_axes(&s) : CLI_DONE;
        if (written == CLI_DONE)
            written = analysis_describe(&output, "section", s.simulation, put_figure, &s);
        if (status == CLI_DONE) status = written;
    }
    analysis_close(&output, status);
    free(s.names);
    free(s.row);
    free(s.kept);
    return status;
}
