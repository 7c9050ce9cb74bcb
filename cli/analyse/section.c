/* section.c - `dalembert section`: where a motion crosses a surface g(q,v,t) = 0.
 *
 * The formula of g becomes one more invariant of the system's model, so that it may name whatever
 * invariants may, and is evaluated as they are. */
#include "analysis.h"
#include "io/gnuplot.h"
#include "io/trajectory_writer.h"
#include "run/native.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* name, value, default, help */
#define OWN_LIST(X)                                                                                \
    X(on, "FORMULA[=VALUE]", NULL, "the surface: x - 1, y*x' = 0.5, sin(3*t)")                     \
    X(direction, "up|down|both", "both", "crossings from below it to above, from above, or all")   \
    X(transient, "T0", "0", "leave out what is crossed before")                                    \
    X(axes, "X,Y", NULL,                                                                           \
      "columns of the picture (the last coordinate that varies with its velocity)")                \
    X(native, "auto|on|off", "auto", "compile the steps, which changes no bit: when it pays")      \
    X(output, "DIR|FILE|-", "-", "write there: .csv, .npy, a directory with a picture, or stdout")

enum { OWN_LIST(CLI_OWN) OWN_OPTIONS };

static const cli_option own[OWN_OPTIONS] = {OWN_LIST(CLI_OPTION)};

static const char notes[] =
    "SYSTEM is a built-in name or the path of a system file.  The formula may name coordinates,\n"
    "velocities, parameters, what the system file has under let, and t.\n"
    "\n"
    "A crossing is found where the formula changes its sign within a step: a step of another size\n"
    "of the same method, from where that one began, meets it to rounding.  So the trajectory is\n"
    "that of 'dalembert run'.  Pairs of crossings within one step are found too, of more some may\n"
    "be missed; a touch is no crossing and is counted apart; a start on the surface is none.\n"
    "\n"
    "Rows are CSV with 17 digits: crossing (from 1), t, direction (1 or -1), then the state as\n"
    "'dalembert run' has it.  A directory gets section.csv and, by gnuplot, section.svg with its\n"
    "script.\n";

enum { NAME = 80 };

/* What comes before the state in a row. */
enum { COLUMN_CROSSING, COLUMN_T, COLUMN_DIRECTION, COLUMNS_BEFORE };

typedef struct wishes {
    const char *on, *axes, *output;
    int direction;
    double transient;
    native_mode native;
} wishes;

typedef struct section {
    run_request request;
    const wishes *w;
    trajectory_writer table;
    int columns;
    char **names;               /* [columns], pieces of one text */
    double *row, *least, *most; /* [columns] of a row, and of all */
    long long rows;
    int told; /* exit status of a failure of the program's own */
} section;

static int take_direction(wishes *w, const char *value)
{
    static const char *const words[] = {"down", "both", "up"};
    for (int i = 0; i < 3; i++) {
        if (strcmp(value, words[i]) != 0) continue;
        w->direction = i - 1;
        return CLI_DONE;
    }
    return cli_fail(CLI_USAGE, "--direction: '%s' is not up, down or both", value);
}

static int take(void *user, int k, const char *value)
{
    wishes *w = user;
    switch (k) {
    case OWN_on:
        w->on = value;
        return CLI_DONE;
    case OWN_direction:
        return take_direction(w, value);
    case OWN_transient:
        return cli_number("--transient", value, &w->transient);
    case OWN_axes:
        w->axes = value;
        return CLI_DONE;
    case OWN_native:
        return native_parse(value, &w->native);
    default:
        w->output = value;
        return CLI_DONE;
    }
}

/* ---- the model with the section among its invariants --------------------------------------- */

static int is_taken(const dal_system *system, const char *name)
{
    for (int i = 0; i < system->invariants; i++)
        if (strcmp(system->invariant[i], name) == 0) return 1;
    for (int i = 0; i < system->n; i++)
        if (strcmp(system->coordinate[i], name) == 0) return 1;
    return 0;
}

/* A message about the invariant is one about --on, of which the user knows. */
static void leave_out_name(const char *name, dal_error *error)
{
    char words[NAME + 16];
    const int n = snprintf(words, sizeof words, "invariant %s: ", name);
    if (strncmp(error->message, words, (size_t)n) == 0)
        memmove(error->message, error->message + n, strlen(error->message + n) + 1);
}

/* Reads the model and makes it with one more invariant, whose text begins in a column of --on. */
static int make_with(run_request *request, const char *name, const char *formula, int column)
{
    dal_error error = {0};
    dal_model_free(request->model);
    int status = cli_read(request->system_name, &request->model);
    if (status != CLI_DONE) return status;
    dal_status made =
        dal_model_add(request->model, DAL_SECTION_INVARIANTS, name, formula, 1, column, &error);
    if (made == DAL_OK) made = dal_model_system(request->model, &request->system, &error);
    if (made == DAL_OK) return CLI_DONE;
    leave_out_name(name, &error);
    return cli_error(cli_input_exit(made), "--on", &error);
}

/* "A = B" means (A) - (B).  Each side is made alone first, so that what is wrong in it is told of
 * it and in its column. */
static int make_difference(run_request *request, const char *name, const char *on,
                           const char *equals)
{
    char *left = cli_format("%.*s", (int)(equals - on), on);
    char *text = cli_format("(%s)-(%s)", left, equals + 1);
    int status = make_with(request, name, left, 1);
    if (status == CLI_DONE) status = make_with(request, name, equals + 1, (int)(equals - on) + 2);
    if (status == CLI_DONE) status = make_with(request, name, text, 1);
    free(left);
    free(text);
    return status;
}

static int load(section *s)
{
    run_request *request = &s->request;
    char name[NAME] = "section_1";
    const char *on = s->w->on, *equals = strchr(on, '=');
    /* First without the section: then what is wrong later is wrong with it. */
    int status = cli_load(request->system_name, &request->model, &request->system);
    if (status != CLI_DONE) return status;
    for (int k = 2; is_taken(request->system, name); k++)
        snprintf(name, sizeof name, "section_%d", k);
    return equals ? make_difference(request, name, on, equals) : make_with(request, name, on, 1);
}

/* ---- rows ---------------------------------------------------------------------------------- */

static int name_columns(section *s)
{
    static const char *const before[COLUMNS_BEFORE] = {"crossing", "t", "direction"};
    s->columns = COLUMNS_BEFORE + dal_run_dimension(s->request.run);
    s->names = cli_calloc((size_t)s->columns, sizeof *s->names);
    s->row = cli_calloc(3 * (size_t)s->columns, sizeof *s->row);
    char *text = cli_calloc((size_t)s->columns, NAME);
    s->least = s->row + s->columns;
    s->most = s->least + s->columns;
    for (int i = 0; i < s->columns; i++) {
        s->least[i] = INFINITY;
        s->most[i] = -INFINITY;
        s->names[i] = text + i * NAME;
        if (i < COLUMNS_BEFORE)
            snprintf(s->names[i], NAME, "%s", before[i]);
        else
            dal_run_name(s->request.run, i - COLUMNS_BEFORE, s->names[i], NAME);
    }
    return CLI_DONE;
}

static dal_status cross(void *user, dal_run *run, const dal_crossing *crossing)
{
    section *s = user;
    if (crossing->t < s->w->transient) return DAL_OK;
    s->row[COLUMN_CROSSING] = (double)++s->rows;
    s->row[COLUMN_T] = crossing->t;
    s->row[COLUMN_DIRECTION] = crossing->direction;
    memcpy(s->row + COLUMNS_BEFORE, dal_run_state(run),
           (size_t)dal_run_dimension(run) * sizeof *s->row);
    for (int i = 0; i < s->columns; i++) {
        s->least[i] = fmin(s->least[i], s->row[i]);
        s->most[i] = fmax(s->most[i], s->row[i]);
    }
    s->told = writer_append(&s->table, s->row);
    return s->told == CLI_DONE ? DAL_OK : DAL_IO;
}

static dal_status poll(void *user, dal_run *run)
{
    const section *s = user;
    cli_progress("t = %.6g of %.6g, %lld crossings", dal_run_time(run), s->request.time, s->rows);
    return cli_interrupted() ? DAL_INTERRUPTED : DAL_OK;
}

static int ended(const section *s, dal_status status, const dal_error *error)
{
    if (status == DAL_OK) return CLI_DONE;
    if (s->told != CLI_DONE) return s->told;
    if (status == DAL_INTERRUPTED) return CLI_SIGNAL;
    return cli_error(status == DAL_ARGUMENT ? CLI_USAGE : cli_exit(status), s->request.system_name,
                     error);
}

static int go(section *s, const char *path)
{
    dal_error error = {0};
    dal_crossings found = {0};
    const dal_system *system = s->request.system;
    const dal_poincare poincare = {.callback = system->invariant_values,
                                   .count = system->invariants,
                                   .index = system->invariants - 1,
                                   .direction = s->w->direction,
                                   .user = s,
                                   .cross = cross,
                                   .poll = poll};
    int status = writer_create(&s->table, path, s->names, s->columns);
    if (status == CLI_DONE) {
        cli_catch_signals();
        native_compile_steps(s->request.run, &s->request.method,
                             s->request.time / s->request.options.step, s->w->native);
        const dal_status crossed =
            dal_run_crossings(s->request.run, s->request.time, &poincare, &found, &error);
        cli_progress_end();
        status = ended(s, crossed, &error);
    }
    const int closed = writer_close(&s->table);
    FILE *out = strcmp(path, "-") == 0 ? stderr : stdout;
    if (out == stdout || isatty(STDERR_FILENO))
        fprintf(out, "t = %g: %lld upwards, %lld downwards, %lld touches; %lld rows\n",
                dal_run_time(s->request.run), found.up, found.down, found.touches, s->rows);
    return status == CLI_DONE ? closed : status;
}

/* ---- the picture --------------------------------------------------------------------------- */

static int find_column(const section *s, const char *name)
{
    for (int i = 1; i < s->columns; i++)
        if (strcmp(s->names[i], name) == 0) return i;
    cli_unknown("column", name, (const char *const *)s->names, s->columns);
    return -1;
}

/* The columns that were asked for, or -1 and -1. */
static int find_axes(const section *s, int axis[2])
{
    char first[NAME];
    axis[0] = axis[1] = -1;
    if (!s->w->axes) return CLI_DONE;
    const size_t length = strcspn(s->w->axes, ",");
    if (!s->w->axes[length] || length >= sizeof first)
        return cli_fail(CLI_USAGE, "--axes: '%s' is not two columns, X,Y", s->w->axes);
    memcpy(first, s->w->axes, length);
    first[length] = '\0';
    axis[0] = find_column(s, first);
    axis[1] = axis[0] < 0 ? -1 : find_column(s, s->w->axes + length + 1);
    return axis[1] < 0 ? CLI_USAGE : CLI_DONE;
}

/* To the eye, and by more than an error of the method: against what it is itself, and against the
 * largest of all coordinates, or of all velocities. */
static int varies(const section *s, int column)
{
    const int n = s->request.system->n;
    const int first = column < COLUMNS_BEFORE + n ? COLUMNS_BEFORE : COLUMNS_BEFORE + n;
    const double range = s->most[column] - s->least[column];
    const double size = fmax(fabs(s->least[column]), fabs(s->most[column]));
    double scale = 0.0;
    for (int i = first; i < first + n; i++)
        scale = fmax(scale, fmax(fabs(s->least[i]), fabs(s->most[i])));
    return range > 1e-3 * size && range > 1e-6 * scale;
}

/* Otherwise the last coordinate that varies together with its velocity; else the last two of q and
 * v that vary; else t and the one that does. */
static void choose_axes(const section *s, int axis[2])
{
    const int n = s->request.system->n, q = COLUMNS_BEFORE;
    if (axis[0] >= 0) return;
    for (int i = q + n - 1; i >= q; i--) {
        if (!varies(s, i) || !varies(s, i + n)) continue;
        axis[0] = i;
        axis[1] = i + n;
        return;
    }
    axis[1] = q + 2 * n - 1;
    while (axis[1] > q && !varies(s, axis[1])) axis[1]--;
    axis[0] = axis[1] - 1;
    while (axis[0] >= q && !varies(s, axis[0])) axis[0]--;
    if (axis[0] < q) axis[0] = COLUMN_T;
}

static int draw(const section *s, const char *directory, const int axis[2])
{
    char *path, title[256];
    int missing;
    FILE *script = gnuplot_open(directory, "section", "svg", 800, 600, &path);
    if (!script) return CLI_IO;
    snprintf(title, sizeof title, "%.80s: %.80s, h = %g, t to %g", s->request.system_name, s->w->on,
             s->request.options.step, dal_run_time(s->request.run));
    fputs("set title ", script);
    gnuplot_quote(script, title);
    fputs("\nset xlabel ", script);
    gnuplot_quote(script, s->names[axis[0]]);
    fputs("\nset ylabel ", script);
    gnuplot_quote(script, s->names[axis[1]]);
    fputs("\nset key outside top right reverse Left\nset offsets graph 0.02, graph 0.02, "
          "graph 0.02, graph 0.02\nside(d, x) = column('direction') == d ? x : NaN\nplot \\\n",
          script);
    for (int side = 1; side >= -1; side -= 2) {
        if (s->w->direction == -side) continue;
        fprintf(script,
                "  'section.csv' using (side(%d, column(%d))):%d with points pt 7 ps 0.3 "
                "lc rgb '%s' title '%s'%s\n",
                side, axis[0] + 1, axis[1] + 1, gnuplot_colour(side > 0 ? 11 : 1),
                side > 0 ? "upwards" : "downwards", side > 0 && s->w->direction == 0 ? ", \\" : "");
    }
    const int status = gnuplot_draw(directory, script, path, &missing);
    free(path);
    return status;
}

/* ---- the command --------------------------------------------------------------------------- */

static int run(section *s)
{
    analysis_output place = {0};
    int axis[2] = {-1, -1};
    if (!s->w->on) return cli_fail(CLI_USAGE, "--on is missing");
    int status = load(s);
    if (status == CLI_DONE) status = request_create_run(&s->request);
    if (status == CLI_DONE) status = name_columns(s);
    if (status == CLI_DONE) status = find_axes(s, axis);
    if (status == CLI_DONE) status = analysis_open(&place, s->w->output, "section");
    if (status == CLI_DONE) status = go(s, place.table);
    const int whole = status == CLI_DONE || status == CLI_SIGNAL;
    if (whole && place.directory && s->rows > 0) {
        choose_axes(s, axis);
        const int drawn = draw(s, place.directory, axis);
        if (status == CLI_DONE) status = drawn;
    }
    free(place.table);
    return status;
}

int command_section(int argc, char **argv)
{
    const analysis_command command = {own, OWN_OPTIONS, ANALYSIS_ROWS, notes, take, NULL};
    wishes w = {.output = own[OWN_output].initial};
    section s = {.request = request_default(), .w = &w};
    int status = analysis_read(argc, argv, &command, &s.request, &w);
    if (status == CLI_GO_ON) status = run(&s);
    if (s.names) free(s.names[0]);
    free(s.names);
    free(s.row);
    request_free(&s.request);
    return status;
}
