/* report_run.c - the page of a run: its end in words, its motion, what moves and how, sizes and
 * trends, its path, its coordinates, and what should not change, over t and as envelopes over
 * log t; then the command that makes the run. */
#include "report_run.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/screen.h"

#include "io/csv_table.h"
#include "io/file.h"
#include "io/trajectory.h"
#include "io/trend.h"
#include "report_data.h"
#include "report_events.h"
#include "report_path.h"
#include "report_plot.h"
#include "report_rows.h"
#include "report_system.h"
#include "run/columns.h"
#include "run/manifest.h"
#include "run/request_command.h"
#include "run/run_screen.h"
#include "run/simulation.h"
#include "run/system.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* An envelope has a point wherever t has grown by a factor. */
static const double envelope_factor = 1.05;

static const char event_caption[] = "Vertical lines mark events.";
static const char event_drift_caption[] =
    "Vertical lines mark events; what these change at once is left out.";

/* The figures over t; columns of those before the invariants are known by their names alone.
 * code, file name, title, label of the axis, what the page says instead when all values at all rows
 * are 0 */
#define PANEL_LIST(PANEL)                                                                          \
    PANEL(COORDINATES, "coordinates", "Coordinates", "q", NULL)                                    \
    PANEL(ANGLES, "angles", "Angles", "q in radians", NULL)                                        \
    PANEL(D, "D", "Constraints", "D", "D is 0 at all rows.")                                       \
    PANEL(E, "E", "Energy", "E - E(0)", "E is the same at all rows.")                              \
    PANEL(H, "H", "H of the lift", "H - H(0)", "H is the same at all rows.")                       \
    PANEL(OBSERVED, "observed", "Observed formulas", "value",                                      \
          "The observed formulas are 0 at all rows.")                                              \
    PANEL(INVARIANTS, "I", "Invariants", "I - I(0)", "The invariants are the same at all rows.")   \
    PANEL(REACTIONS, "R", "Reactions", "h, R", "The reactions are 0 at all rows.")                 \
    PANEL(ERROR, "error", "Error", "max |q - exact|", "The error is 0 at all rows.")

enum {
#define PANEL_CODE(code, name, title, ylabel, zero_text) PANEL_##code,
    PANEL_LIST(PANEL_CODE)
#undef PANEL_CODE
        PANELS,
    NO_PANEL = -1
};

typedef struct run_column {
    int panel;                    /* or NO_PANEL */
    plot_curve *curve, *envelope; /* NULL: it has none, or there are too many */
    row_series *series;           /* of the curve */
    int velocity;                 /* the column of a coordinate's velocity, 0: there is none */
    row_distance distance;        /* of a coordinate */
    bool is_conserved;            /* it should not change */
    double first, max_abs;        /* at the first row; of all rows so far; for E, H and the
                                     invariants less first */
} run_column;

typedef struct run_page {
    report *r;
    const run_request *request;
    dal_model *model;
    trajectory_reader reader;
    csv_table summary;        /* no rows unless the run is over */
    row_steps steps;          /* of the observables in the summary */
    const dal_system *system; /* NULL: it is not known */
    run_column *column;       /* [columns of the reader] */
    report_events events;
    double envelope_time; /* since the start, of the last point of the envelopes */
    report_plot plot[PANELS], drift;
    char *drift_caption;
} run_page;

/* ---- columns ------------------------------------------------------------------------------- */

static bool is_angle(const run_page *run, const char *name)
{
    return run->model && report_is_angle(run->model, name);
}

static int observable_panel(const run_page *run, const char *name)
{
    if (request_observes(run->request, name)) return PANEL_OBSERVED;
    if (run->system && run->request->columns && columns_need_reactions(run->system, name))
        return PANEL_REACTIONS;
    if (name[0] == 'D' && name[1] && name[1 + strspn(name + 1, "0123456789")] == '\0')
        return PANEL_D;
    return strcmp(name, "E") == 0       ? PANEL_E
           : strcmp(name, "H") == 0     ? PANEL_H
           : strcmp(name, "error") == 0 ? PANEL_ERROR
                                        : PANEL_INVARIANTS;
}

static plot_curve *add_curve(report_plot *plot, const char *title)
{
    return plot->count < PLOT_CURVES ? report_curve(plot, title) : NULL;
}

/* The column of the velocity of a coordinate; 0: there is none. */
static int find_velocity(const run_page *run, const char *coordinate)
{
    for (int i = 1; i < run->reader.columns; i++)
        if (columns_is_velocity(run->request, run->reader.name[i], coordinate)) return i;
    return 0;
}

/* Of a velocity, a multiplier or the lift. */
static bool is_rest_of_state(const run_page *run, const char *name)
{
    for (int i = 0; i < run->system->n; i++)
        if (columns_is_velocity(run->request, name, run->system->coordinate[i])) return true;
    return strncmp(name, "p_", 2) == 0 || strncmp(name, "pi_", 3) == 0 || strcmp(name, "e") == 0 ||
           (name[0] == 'g' && name[1] && !name[1 + strspn(name + 1, "0123456789")]);
}

/* Whether the inputs of a steered motion change what the panel shows: all but H, and D where they
 * are along the constraints. */
static bool inputs_move(const run_page *run, int panel)
{
    const dal_effort effort = run->system ? run->system->effort : DAL_EFFORT_IDENTITY;
    const bool keep_D = effort == DAL_EFFORT_CONSTRAINT || effort == DAL_EFFORT_CONTROLS;
    return run->r->begin && panel != PANEL_H && !(panel == PANEL_D && keep_D);
}

/* Gives each column its curves.  The columns are t, q, q', the rest of the state, then D1.., E, H,
 * invariants, observed formulas, error.  A coordinate may have the name D1 or E; only after the
 * state is a column an observable.  Without a system and its names the state ends at the first D1,
 * E or H. */
static void place_columns(run_page *run)
{
    const trajectory_reader *t = &run->reader;
    const dal_system *system = run->system;
    int n = 0, observables;
    if (!system) {
        while (1 + n < t->columns && !columns_is_velocity(run->request, t->name[1 + n], t->name[1]))
            n++;
        observables = 1 + 2 * n;
        while (observables < t->columns &&
               observable_panel(run, t->name[observables]) >= PANEL_INVARIANTS)
            observables++;
    } else if (!run->request->columns) {
        n = system->n;
        const bool is_lifted = t->columns > 4 * n + 2 && strcmp(t->name[1 + 2 * n], "e") == 0 &&
                               strncmp(t->name[2 + 2 * n], "p_", 2) == 0;
        observables = 1 + (is_lifted ? 4 * n + 2 : 2 * n + system->multipliers);
    } else {
        while (1 + n < t->columns && cli_find_coordinate(system, t->name[1 + n]) >= 0) n++;
        observables = 1 + n;
        while (observables < t->columns && is_rest_of_state(run, t->name[observables]))
            observables++;
    }
    run->column = cli_calloc((size_t)t->columns, sizeof *run->column);
    for (int i = 1; i < t->columns; i++) {
        run_column *c = &run->column[i];
        const char *name = t->name[i];
        c->panel = i >= observables      ? observable_panel(run, name)
                   : i > n               ? NO_PANEL
                   : is_angle(run, name) ? PANEL_ANGLES
                                         : PANEL_COORDINATES;
        if (i <= n) c->velocity = find_velocity(run, name);
        /* Of E and H the summary knows: it gives a trend to what should not change. */
        bool has_trend = c->panel != PANEL_E && c->panel != PANEL_H;
        for (int row = 1; row < run->summary.rows; row++)
            has_trend |= csv_table_is(&run->summary, row, "observable", name) &&
                         !csv_table_is(&run->summary, row, "trend", "");
        c->is_conserved = i >= observables && has_trend && c->panel != PANEL_OBSERVED &&
                          c->panel != PANEL_REACTIONS && !inputs_move(run, c->panel);
        if (c->panel != NO_PANEL) c->curve = add_curve(&run->plot[c->panel], name);
        if (c->curve) c->series = cli_calloc(1, sizeof *c->series);
        if (c->is_conserved) c->envelope = add_curve(&run->drift, name);
    }
}

/* ---- figures over t ------------------------------------------------------------------------ */

static void name_plots(run_page *run)
{
    const bool from_0 = run->request->from == 0.0 && run->request->time >= 0.0;
    const bool has_events = run->events.count > 0;
    const char *caption = has_events ? event_caption : "";
#define NAME_PLOT(code, file, text, label, zero)                                                   \
    run->plot[PANEL_##code] = (report_plot){file,                                                  \
                                            text,                                                  \
                                            "t",                                                   \
                                            label,                                                 \
                                            caption,                                               \
                                            .zero_text = zero,                                     \
                                            .mark = run->events.t,                                 \
                                            .marks = run->events.count};
    PANEL_LIST(NAME_PLOT)
#undef NAME_PLOT
    run->drift_caption = cli_format("%s%s%s", report_envelope_caption, has_events ? " " : "",
                                    has_events ? event_drift_caption : "");
    run->drift = (report_plot){.name = "drift",
                               .title = "Drift of what should not change",
                               .xlabel = from_0 ? "t" : "|t - t(0)|",
                               .ylabel = "max |x - x(0)|",
                               .log_x = true,
                               .log_y = true,
                               .zero_text = "Nothing that should not change does so at any row.",
                               .caption = run->drift_caption,
                               .mark = run->events.passed,
                               .marks = run->events.count};
}

/* Whether events add to a column: its rows have that, the statistics of all steps do not. */
static bool jumps(const run_page *run, const run_column *c)
{
    return run->events.count > 0 && (c->panel == PANEL_E || c->panel == PANEL_INVARIANTS);
}

/* What a figure takes from an observable. */
static double subtracted(const run_column *c)
{
    return c->panel == PANEL_E || c->panel == PANEL_H || c->panel == PANEL_INVARIANTS ? c->first
                                                                                      : 0.0;
}

/* The present row, number k. */
static void add_row(run_page *run, long long k)
{
    const trajectory_reader *reader = &run->reader;
    const double t = reader->row[0];
    const bool is_last = k == reader->count - 1;
    const double passed = fabs(t - run->request->from);
    const bool has_envelope = passed >= envelope_factor * run->envelope_time || is_last;
    for (int i = 1; i < reader->columns; i++) {
        run_column *c = &run->column[i];
        if (k == 0) c->first = reader->row[i];
        if (c->panel == NO_PANEL) continue;
        const double x = reader->row[i] - subtracted(c);
        if (c->series) row_series_add(c->series, t, x);
        if (c->velocity > 0) row_distance_add(&c->distance, t, x, reader->row[c->velocity]);
        if (!(fabs(x) <= c->max_abs)) c->max_abs = fabs(x);
        if (has_envelope && c->envelope && !jumps(run, c))
            report_point(&run->drift, c->envelope, passed, c->max_abs);
    }
    if (has_envelope) run->envelope_time = passed;
}

/* The row of an observable in the summary, or 0. */
static int find_observable(const run_page *run, const char *name)
{
    int row = run->summary.rows - 1;
    while (row > 0 && !csv_table_is(&run->summary, row, "observable", name)) row--;
    return row > 0 ? row : 0;
}

/* Draws a column from all steps; false: its rows show it. */
static bool draw_steps(const run_page *run, run_column *c, const char *name, bool is_sparse)
{
    const report_plot *plot = &run->plot[c->panel];
    const int row = find_observable(run, name);
    const bool is_coordinate = c->panel < PANEL_D;
    if (is_coordinate && (!run->system || !(is_sparse || row_series_is_aliased(c->series))))
        return false;
    if (is_coordinate)
        return row_steps_draw_coordinate(&run->steps, cli_find_coordinate(run->system, name), plot,
                                         c->curve);
    if (row == 0 || c->panel == PANEL_REACTIONS || c->panel == PANEL_OBSERVED || jumps(run, c) ||
        !row_steps_draw_observable(&run->steps, row - 1, subtracted(c), run->reader.count, plot,
                                   c->curve))
        return false;
    c->max_abs = fmax(c->max_abs, c->curve->max_abs);
    return true;
}

/* Completes the curve of what should not change; max |x - x(0)|. */
static double draw_drift(const run_page *run, const run_column *c, const char *name)
{
    const int row = find_observable(run, name);
    if (!jumps(run, c)) return c->max_abs;
    return row > 0 ? row_steps_draw_drift(&run->steps, row - 1, &run->drift, c->envelope) : 0.0;
}

/* Figures of the last steps, where there are many more than rows. */
static int draw_last_steps(run_page *run)
{
    const step_record *record = &run->steps.record;
    char title[PANELS][PLOT_NAME], name[PANELS][PLOT_NAME], part[PLOT_NOTE];
    report_plot *last = cli_calloc(PANELS, sizeof *last);
    int status = CLI_DONE;
    if (!record->number || !run->system) {
        free(last);
        return status;
    }
    snprintf(part, sizeof part, "the last %d steps", record_last_steps(record));
    for (int g = 0; g < PANELS; g++) {
        last[g] = run->plot[g];
        snprintf(title[g], sizeof title[g], "%s, %s", last[g].title, part);
        snprintf(name[g], sizeof name[g], "%s-last", last[g].name);
        last[g].title = title[g];
        last[g].name = name[g];
        last[g].part = part;
        last[g].count = 0;
        last[g].zero_text = NULL;
    }
    for (int i = 1; i < run->reader.columns; i++) {
        const run_column *c = &run->column[i];
        const bool is_coordinate = c->panel == PANEL_COORDINATES || c->panel == PANEL_ANGLES;
        const int row = find_observable(run, run->reader.name[i]);
        if (c->panel == NO_PANEL || (!is_coordinate && row == 0)) continue;
        const int column = is_coordinate ? 1 + cli_find_coordinate(run->system, run->reader.name[i])
                                         : record->state + row;
        plot_curve *curve = add_curve(&last[c->panel], run->reader.name[i]);
        if (curve) row_steps_draw_last(&run->steps, column, subtracted(c), &last[c->panel], curve);
    }
    for (int g = 0; g < PANELS; g++) {
        const int drawn = report_draw(run->r, &last[g]);
        if (status == CLI_DONE) status = drawn;
    }
    free(last);
    return status;
}

static int draw_figures(run_page *run)
{
    report *r = run->r;
    int more, status = CLI_DONE;
    report_heading(r, "figures", "Figures");
    fputs("<div class=\"figures\">\n", r->page);
    if (run->reader.count < 2)
        fputs("<p>The run has one row, too few for figures.</p>\n", r->page);
    else if (run->request->system_name)
        status = report_path(r, r->directory, "path", "");
    if (status == CLI_DONE && r->draw) status = r->draw(r);
    if (status != CLI_DONE || run->reader.count < 2) {
        fputs("</div>\n", r->page);
        return status;
    }
    for (long long k = 0; (more = reader_next(&run->reader)) > 0; k++) add_row(run, k);
    if (more < 0) status = CLI_IO;
    bool is_sparse = false;
    for (int i = 1; i < run->reader.columns; i++)
        is_sparse |= row_distance_is_sparse(&run->column[i].distance);
    for (int i = 1; i < run->reader.columns; i++) {
        run_column *c = &run->column[i];
        if (c->is_conserved && draw_drift(run, c, run->reader.name[i]) != 0.0)
            run->drift.zero_text = NULL;
        if (c->series && !draw_steps(run, c, run->reader.name[i], is_sparse))
            row_series_draw(c->series, &run->plot[c->panel], c->curve, is_sparse);
        if (c->envelope) report_title_envelope(c->envelope);
        /* A sentence about all values needs all columns and all rows; figures leave some out. */
        if (c->panel != NO_PANEL && c->max_abs != 0.0) run->plot[c->panel].zero_text = NULL;
    }
    int drawn = report_draw(run->r, &run->drift);
    for (int g = 0; g < PANELS; g++) {
        if (status == CLI_DONE) status = drawn;
        drawn = report_draw(run->r, &run->plot[g]);
    }
    if (status == CLI_DONE) status = drawn;
    if (status == CLI_DONE) status = draw_last_steps(run);
    fputs("</div>\n", r->page);
    return status;
}

/* ---- the summary --------------------------------------------------------------------------- */

static void write_summary(const run_page *run, double time)
{
    static const char *const columns[] = {"confidence", "first",     "final",
                                          "maximum",    "deviation", "rate",
                                          "rate_low",   "rate_high", "exponent"};
    const csv_table *csv = &run->summary;
    FILE *page = run->r->page;
    if (csv->rows < 2) return;
    report_heading(run->r, "trends", "Size and trend");
    fputs(REPORT_TABLE
          "<td></td><th>size, "
          "trend</th><th>confi&shy;dence</th><th>first</th><th>final</th><th>max |x|</th>"
          "<th>max |x − first|</th><th>rate</th><th>rate, from</th><th>to (95 %)</th>"
          "<th>exponent</th>" REPORT_ROWS,
          page);
    for (int row = 1; row < csv->rows; row++) {
        /* Without a trend: the largest drift that the interval of the rate admits. */
        char drift[64] = "";
        const double max_rate = fmax(fabs(csv_table_number(csv, row, "rate_low")),
                                     fabs(csv_table_number(csv, row, "rate_high")));
        if (csv_table_is(csv, row, "trend", "none") && !csv_table_is(csv, row, "size", "exact"))
            snprintf(drift, sizeof drift, "|drift| ≤ %.1e", max_rate * time);
        report_row(page, csv_table_get(csv, row, "observable"));
        report_trend(page, csv_table_get(csv, row, "size"), csv_table_get(csv, row, "trend"),
                     csv_table_number(csv, row, "deviation"), drift);
        for (size_t k = 0; k < sizeof columns / sizeof columns[0]; k++)
            report_number(page, "%.4g", csv_table_number(csv, row, columns[k]));
        fputs("</tr>\n", page);
    }
    fputs(REPORT_TABLE_END, page);
    for (int row = 1; row < csv->rows; row++)
        if (csv_table_is(csv, row, "trend", "")) {
            fputs("<p>", page);
            report_text(page, csv_table_get(csv, row, "observable"));
            fputs(" has neither size nor trend: the motion of this run need not conserve it.</p>\n",
                  page);
        }
}

/* ---- the verdicts --------------------------------------------------------------------------- */

static void write_value(const run_page *run, int i)
{
    char number[SCREEN_NUMBER];
    fputs(" <span>", run->r->page);
    report_text(run->r->page, run->reader.name[i]);
    fprintf(run->r->page, " = %s</span>", screen_number(number, run->reader.row[i], 4));
}

/* What was run, and the present row: "t = 1000 x = 12.31 y = -4.02 x' = 0.61 y' = -0.79". */
static void write_state(const run_page *run)
{
    const run_request *request = run->request;
    char number[SCREEN_NUMBER];
    if (run->r->begin) run->r->begin(run->r);
    if (request->system_name) {
        fputs("<p class=\"lead\">", run->r->page);
        report_text(run->r->page, request->system_name);
        fputs(" by ", run->r->page);
        report_text(run->r->page,
                    request->text[REQUEST_integrator] ? request->text[REQUEST_integrator] : "");
        fprintf(run->r->page, ", h = %s, t = %.6g .. %.6g</p>\n",
                screen_number(number, request->options.step, 4), request->from, run->reader.row[0]);
    }
    fputs("<p class=\"numbers\">", run->r->page);
    write_value(run, 0);
    for (int i = 1; i < run->reader.columns; i++)
        if (run->column[i].panel == PANEL_COORDINATES || run->column[i].panel == PANEL_ANGLES)
            write_value(run, i);
    for (int i = 1; i < run->reader.columns; i++)
        if (run->column[i].velocity > 0) write_value(run, run->column[i].velocity);
    fputs("</p>\n", run->r->page);
}

/* The words of the screen of a run: a row for each quantity, and what explains the first that
 * moves. */
static void write_verdicts(const run_page *run, const dal_system *system)
{
    const csv_table *csv = &run->summary;
    const int n = csv->rows - 1;
    FILE *page = run->r->page;
    if (n < 1) return;
    dal_trend *trend = cli_calloc((size_t)n, sizeof *trend);
    const char **names = cli_calloc((size_t)n, sizeof *names);
    const run_quantities shown = {trend, names, n, 2 * n, 80};
    screen_table t = {.columns = 3};
    int left_out;
    for (int i = 0; i < n; i++) {
        trend[i] = cli_get_trend(csv, i + 1);
        names[i] = csv_table_get(csv, i + 1, "observable");
        if (system && trend[i].conservation != DAL_CONSERVED && strcmp(names[i], "E") == 0 &&
            system->properties & (DAL_E_EXACT | DAL_E_ON_D))
            trend[i].conservation = DAL_OFF_SURFACE;
    }
    const int moving = run_add_verdicts(&t, &shown, &left_out);
    fputs("<div class=\"wide\" tabindex=\"0\"><table class=\"verdicts\"><tbody>\n", page);
    for (int i = 0; i < t.cells; i += t.columns) {
        report_row(page, t.cell[i].text);
        fprintf(page, "<td class=\"%s\">", report_colour(t.cell[i + 1].colour));
        report_element(page, "b", t.cell[i + 1].text);
        fputs("</td>", page);
        report_element(page, "td class=\"words\"", t.cell[i + 2].text);
        fputs("</tr>\n", page);
    }
    fputs(REPORT_TABLE_END, page);
    if (moving >= 0 && run->request->system_name) {
        char *command = request_format_command(run->request, "explain", run->request->system_name,
                                               REQUEST_ROW_OPTIONS);
        fputs("<p>Why ", page);
        report_text(page, names[moving]);
        fputs(" moves: ", page);
        report_element(page, "code", command);
        fputs("</p>\n", page);
        free(command);
    }
    screen_free_table(&t);
    free(names);
    free(trend);
}

/* ---- the page ------------------------------------------------------------------------------ */

/* Why the run ended where it did not reach its end. */
static void write_end(const run_page *run, const document *manifest)
{
    FILE *page = run->r->page;
    const char *message;
    if (!run->model) return;
    const store_state state = store_stated(manifest, &message);
    if (state == STORE_DONE && message) {
        report_element(page, "p", message);
        fputc('\n', page);
    } else if (state < STORE_DONE) {
        fprintf(page, "<p><strong>The run %s",
                state == STORE_FAILED        ? "failed"
                : state == STORE_INTERRUPTED ? "was interrupted"
                                             : "is not finished");
        fputs(message ? ": " : "", page);
        report_text(page, message ? message : "");
        fputs(".</strong></p>\n", page);
    }
}

/* What moves and how. */
static void write_facts(const run_page *run)
{
    FILE *page = run->r->page;
    if (!run->model) return;
    fputs(REPORT_FACTS, page);
    report_fact(page, "system", run->request->system_name);
    report_system(page, run->model, run->request);
    report_method(page, run->request);
    fputs(REPORT_FACTS_END, page);
}

int report_run(report *r)
{
    run_directory dir = {.descriptor = -1};
    run_simulation simulation = simulation_default();
    run_request *request = &simulation.request;
    run_page *run = cli_calloc(1, sizeof *run);
    char *summary = cli_join(r->directory, "summary.csv"); /* written when the run is over */
    *run = (run_page){.r = r, .request = request};
    int status = reader_open(&run->reader, r->directory);
    const bool is_open = status == CLI_DONE;
    if (is_open && run->reader.count == 0)
        status = cli_fail(CLI_USAGE, "'%s' has no rows", run->reader.path);
    run_directory_open(&dir, r->directory);
    if (status == CLI_DONE && file_exists(dir.manifest)) status = manifest_read(&dir, request);
    if (status == CLI_DONE && request->system_name)
        status = cli_load(request->system_name, &request->choices, &simulation.model,
                          &simulation.system);
    const bool has_events = simulation.system && simulation.system->events > 0;
    run->system = simulation.system;
    if (status == CLI_DONE)
        status = report_events_read(&run->events, dir.events, has_events ? simulation.system : NULL,
                                    request->from);
    run->model = simulation.model;
    if (status == CLI_DONE && file_exists(summary)) status = csv_table_read(&run->summary, summary);
    if (status == CLI_DONE && run->summary.rows > 0)
        status = csv_table_require(&run->summary, summary, "trend");
    if (status == CLI_DONE)
        status = row_steps_read(&run->steps, &dir, simulation.system ? simulation.system->n : 0,
                                run->summary.rows - 1);
    if (status == CLI_DONE) status = reader_peek_last(&run->reader);
    if (status == CLI_DONE) {
        report_title(r, report_model_title(simulation.model, "A run"));
        name_plots(run);
        place_columns(run);
        write_state(run);
        if (!r->begin) write_verdicts(run, simulation.system);
        write_end(run, dir.doc);
        if (request->system_name) status = data_write_run(r);
        write_facts(run);
        if (!r->begin) write_summary(run, fabs(run->reader.row[0] - request->from));
        report_events_write(r, &run->events);
        if (status == CLI_DONE) status = draw_figures(run);
        if (request->system_name) report_command(r, request);
        report_file(r, "manifest.json", "what it was made with: manifest.json");
    }
    for (int i = 1; run->column && i < run->reader.columns; i++) free(run->column[i].series);
    if (is_open) reader_close(&run->reader);
    csv_table_free(&run->summary);
    report_events_free(&run->events);
    free(run->drift_caption);
    row_steps_free(&run->steps);
    free(run->column);
    free(run);
    free(summary);
    simulation_free(&simulation);
    run_directory_close(&dir);
    return status;
}
