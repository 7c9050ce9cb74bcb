/* report_study.c - the page of a study: D, E, the invariants and H under each method.
 *
 * First tables of sizes and trends, methods against systems; then the expectations; then the
 * figures of each label: at each step the envelopes of what should not change, max |x - x(0)| up
 * to t, over t, log-log, where a drift ~ t^k is a line of slope k; over all steps the error against
 * the work and, where there are several, against h; and the path of the most accurate run. */
#include "report_study.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/signals.h"

#include "io/csv_table.h"
#include "io/document.h"
#include "io/file.h"
#include "report_cells.h"
#include "report_data.h"
#include "report_family.h"
#include "report_matrix.h"
#include "report_motion.h"
#include "report_overview.h"
#include "report_path.h"
#include "report_plot.h"
#include "report_system.h"
#include "run/system.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- expectations -------------------------------------------------------------------------- */

typedef enum which_expectations { ALL_EXPECTATIONS, UNMET_EXPECTATIONS } which_expectations;

static void write_expectations(FILE *page, const csv_table *csv, which_expectations which)
{
    static const char *const heads[] = {"integrator", "start",    "step",
                                        "quantity",   "expected", "found"};
    fputs(REPORT_TABLE "<th>system</th><th>integrator</th><th>start</th><th>h</th>"
                       "<th>quantity</th><th>expected</th><th>found</th><th></th>" REPORT_ROWS,
          page);
    for (int row = 1; row < csv->rows; row++) {
        const bool is_met = csv_table_is(csv, row, "met", "yes");
        if (which == UNMET_EXPECTATIONS && is_met) continue;
        char title[STUDY_DIVISION];
        const char *step = csv_table_get(csv, row, "step");
        report_row(page, csv_table_get(csv, row, "label"));
        for (size_t k = 0; k < sizeof heads / sizeof heads[0]; k++)
            if (strcmp(heads[k], "step") == 0)
                report_element(page, "td", step[0] ? step_title(title, step) + 4 : "–");
            else
                report_element(page, "td", csv_table_get(csv, row, heads[k]));
        fprintf(page, "<td class=\"%s\">%s</td></tr>\n", is_met ? "kept" : "large",
                is_met ? "met" : "not met");
    }
    fputs(REPORT_TABLE_END, page);
}

/* Those that are met; those that are not since a run failed, or a value was not finite. */
static void write_met(report *r, const csv_table *csv, int met)
{
    FILE *page = r->page;
    static const char *const words[] = {"failed", "aborted"};
    report_heading(r, "expectations", "Expectations");
    fprintf(page, "<p>%d of %d are met", met, csv->rows - 1);
    for (size_t k = 0; k < sizeof words / sizeof words[0]; k++) {
        int count = 0;
        for (int row = 1; row < csv->rows; row++)
            count += csv_table_is(csv, row, "found", words[k]) &&
                     csv_table_is(csv, row, "met", "no") &&
                     !csv_table_is(csv, row, "quantity", "state");
        if (count > 0) fprintf(page, "; %d %s", count, words[k]);
    }
    fputs(".</p>\n", page);
}

/* A study need not have expectations.  Those that are not met are open on the page, above the fold
 * of all. */
static int report_expectations(report *r)
{
    csv_table csv = {.text = NULL};
    char *path = cli_join(r->directory, "expectations.csv");
    const int status = file_exists(path) ? read_steps(&csv, path) : CLI_DONE;
    int met = 0;
    for (int row = 1; row < csv.rows; row++) met += csv_table_is(&csv, row, "met", "yes");
    if (csv.rows > 1) {
        write_met(r, &csv, met);
        if (met < csv.rows - 1) write_expectations(r->page, &csv, UNMET_EXPECTATIONS);
        fputs("<details><summary>all of them</summary>\n", r->page);
        write_expectations(r->page, &csv, ALL_EXPECTATIONS);
        fputs("</details>\n", r->page);
    }
    csv_table_free(&csv);
    free(path);
    return status;
}

/* ---- the figures of a label ---------------------------------------------------------------- */

typedef struct label_figures {
    const study_page *s;
    const char *label;
    int number; /* of the label on the page, from 1 */
    csv_table series;
    csv_words methods; /* those drawn: of many one of each family */
    bool are_families;
    csv_words steps;
    const char *accuracy; /* the column of errors, or NULL */
} label_figures;

static bool is_of_label(const label_figures *f, int row)
{
    return is_cell(f->s, row, "label", f->label);
}

/* The column of the error, or else of what the system conserves. */
static const char *find_accuracy(const label_figures *f)
{
    static const char *const columns[] = {"error_max", "invariant_deviation", "E_deviation"};
    for (int k = 0; k < 3; k++)
        for (int row = 1; row < f->s->cells.rows; row++) {
            const bool is_conserved = k < 2 || !is_cell(f->s, row, "E_trend", "");
            if (is_of_label(f, row) && is_conserved && !is_cell(f->s, row, columns[k], ""))
                return columns[k];
        }
    return NULL;
}

/* A file name: "3-E-h2" is E at the second step of the third label. */
static const char *name_plot(char name[PLOT_NAME], const label_figures *f, const char *what,
                             int step)
{
    const int n = snprintf(name, PLOT_NAME, "%d-%s", f->number, what);
    if (step > 0) snprintf(name + n, PLOT_NAME - (size_t)n, "-h%d", step + 1);
    return name;
}

/* The curve of a method: "gauss4", or "Gauss: gauss4" in the colour of its family. */
static plot_curve *add_method(const label_figures *f, report_plot *plot, const char *method)
{
    char name[PLOT_TITLE];
    const method_family family = method_family_of(method);
    if (!f->are_families) return report_curve(plot, method);
    snprintf(name, sizeof name, "%s: %.60s", method_family_name[family], method);
    plot_curve *curve = report_curve(plot, name);
    curve->colour = (int)family;
    return curve;
}

static void add_envelope(const label_figures *f, report_plot *plot, const char *method,
                         const char *step, const quantity *t)
{
    const int cell = find_cell(f->s, f->label, method, step, t->start);
    if (cell == 0 || is_cell(f->s, cell, t->value, "")) return;
    const char *start = get_cell(f->s, cell, "start");
    plot_curve *curve = NULL;
    double max = 0.0;
    /* The rows of a cell are together. */
    for (int row = 1; row < f->series.rows; row++) {
        if (!csv_table_is(&f->series, row, "integrator", method) ||
            !csv_table_is(&f->series, row, "step", step) ||
            !csv_table_is(&f->series, row, "start", start)) {
            if (curve) break;
            continue;
        }
        if (!curve) curve = add_method(f, plot, method);
        const double x = csv_table_number(&f->series, row, t->column);
        if (x > max) max = x;
        report_point(plot, curve, csv_table_number(&f->series, row, "until"), max);
    }
    if (curve) report_title_envelope(curve);
}

static int draw_quantity(const label_figures *f, const quantity *t, int step)
{
    const char *h = f->steps.word[step];
    char name[PLOT_NAME], heading[PLOT_NAME], division[STUDY_DIVISION],
        text[PLOT_METHODS * PLOT_TITLE];
    report_plot plot = {.name = name_plot(name, f, t->name, step),
                        .title = heading,
                        .xlabel = "time since the start",
                        .ylabel = t->ylabel,
                        .caption = report_envelope_caption,
                        .log_x = true,
                        .log_y = true};
    snprintf(heading, sizeof heading, "%s, %s", t->title, step_title(division, h));
    /* "max |D| is 0 at all rows with A, B, C." */
    size_t n = (size_t)snprintf(text, sizeof text, "%s is 0 at all rows with", plot.ylabel);
    for (int m = 0; m < f->methods.count && n < sizeof text; m++) {
        const int before = plot.count;
        add_envelope(f, &plot, f->methods.word[m], h, t);
        if (plot.count > before)
            n += (size_t)snprintf(text + n, sizeof text - n, "%s %.60s", before > 0 ? "," : "",
                                  f->methods.word[m]);
    }
    if (n < sizeof text) snprintf(text + n, sizeof text - n, ".");
    plot.zero_text = text;
    return report_draw(f->s->r, &plot);
}

/* What errors are drawn over. */
typedef enum error_axis { OVER_WORK, OVER_STEP, OVER_TOLERANCE } error_axis;

/* The errors of some methods. */
static int draw_errors(const label_figures *f, error_axis axis)
{
    static const struct {
        const char *name, *title, *xlabel, *caption;
    } figures[] = {{"work", "Work and precision", "evaluations of F per unit of t",
                    "Lower left is better: less error for less work."},
                   {"order", "Order", "step h", "A method of order p is a line of slope p."},
                   {"tolerance", "Tolerance", "tolerance",
                    "An error that follows the tolerance is a line of slope 1."}};
    const csv_table *cells = &f->s->cells;
    char name[PLOT_NAME];
    report_plot plot = {.name = name_plot(name, f, figures[axis].name, 0),
                        .title = figures[axis].title,
                        .xlabel = figures[axis].xlabel,
                        .ylabel = strcmp(f->accuracy, "error_max") == 0     ? "max error"
                                  : strcmp(f->accuracy, "E_deviation") == 0 ? "max |E - E(0)|"
                                                                            : "max |I - I(0)|",
                        .caption = figures[axis].caption,
                        .log_x = true,
                        .log_y = true,
                        .has_marks = true};
    for (int m = 0; m < f->methods.count; m++) {
        const char *method = f->methods.word[m];
        plot_curve *curve = add_method(f, &plot, method);
        for (int h = 0; h < f->steps.count; h++) {
            const char *step = f->steps.word[h];
            const int row = find_cell(f->s, f->label, method, step, ON_SURFACE);
            if (row == 0 || !is_cell(f->s, row, "state", "done")) continue;
            const double size = fabs(strtod(step, NULL)), tolerance = step_tolerance(step);
            if (axis != OVER_WORK && (tolerance > 0.0) != (axis == OVER_TOLERANCE)) continue;
            const double work = csv_table_number(cells, row, "evaluations") /
                                (csv_table_number(cells, row, "steps") * size);
            report_point(&plot, curve,
                         axis == OVER_WORK   ? work
                         : axis == OVER_STEP ? size
                                             : tolerance,
                         csv_table_number(cells, row, f->accuracy));
        }
    }
    return report_draw(f->s->r, &plot);
}

/* The run of a row of the label that is done, was kept and does not start off p = pi = 0. */
static bool is_kept(const label_figures *f, int row)
{
    return is_of_label(f, row) && !is_cell(f->s, row, "run", "") &&
           is_cell(f->s, row, "state", "done") && !is_cell(f->s, row, "start", "displaced");
}

static double error_of(const label_figures *f, int row)
{
    return f->accuracy ? csv_table_number(&f->s->cells, row, f->accuracy) : 0.0;
}

/* The row of the most accurate run among those that were kept, or 0. */
static int find_best(const label_figures *f)
{
    int best = 0;
    for (int row = 1; row < f->s->cells.rows; row++)
        if (is_kept(f, row) && (best == 0 || error_of(f, row) < error_of(f, best))) best = row;
    return best;
}

/* Its path. */
static int draw_best_path(const label_figures *f)
{
    const study_page *s = f->s;
    const int best = find_best(f);
    if (best == 0) return CLI_DONE;
    char name[PLOT_NAME], caption[2 * PLOT_NAME], division[STUDY_DIVISION];
    snprintf(caption, sizeof caption, "The path by %.80s with %s.", get_cell(s, best, "integrator"),
             step_title(division, get_cell(s, best, "step")));
    char *run = cli_join(s->r->directory, get_cell(s, best, "run"));
    const int status = report_path(s->r, run, name_plot(name, f, "path", 0), caption);
    free(run);
    return status;
}

/* ---- the motions of a label ---------------------------------------------------------------- */

/* A run whose motion leaves the best one is no longer seen beside it where its path is more
 * than this many times as large; runs that are tried for one. */
static const double max_extent = 2.0;
enum { MAX_TRIES = 12 };

static int read_motion(const label_figures *f, int row, motion *m)
{
    char *run = cli_join(f->s->r->directory, get_cell(f->s, row, "run"));
    const int status = motion_read(m, NULL, run, MOTION_STUDY_FRAMES);
    free(run);
    return status;
}

static double step_of(const label_figures *f, int row)
{
    return csv_table_number(&f->s->cells, row, "step");
}

/* The row of the largest error below a bound, with the step of another row; 0: there is none. */
static int find_worst(const label_figures *f, double bound, double step)
{
    int worst = 0;
    for (int row = 1; row < f->s->cells.rows; row++)
        if (is_kept(f, row) && step_of(f, row) == step && error_of(f, row) < bound &&
            (worst == 0 || error_of(f, row) > error_of(f, worst)))
            worst = row;
    return worst;
}

/* The motion of the most accurate run, and the least accurate that stays in sight of it. */
static int write_motions(const label_figures *f, json_writer *data)
{
    motion pair[2] = {{.frames = 0}, {.frames = 0}};
    const int best = find_best(f);
    int status = best > 0 ? read_motion(f, best, &pair[0]) : CLI_DONE, row = best;
    double bound = INFINITY;
    for (int tries = 0; pair[0].frames > 0 && tries < MAX_TRIES && status == CLI_DONE; tries++) {
        row = find_worst(f, bound, step_of(f, best));
        if (row == 0 || row == best) break;
        status = read_motion(f, row, &pair[1]);
        if (pair[1].start == pair[0].start && pair[1].frames > 1 &&
            motion_extent(&pair[1]) <= max_extent * motion_extent(&pair[0]))
            break;
        motion_free(&pair[1]);
        bound = error_of(f, row);
    }
    data_write_motions(data, pair, 2);
    motion_free(&pair[0]);
    motion_free(&pair[1]);
    return status;
}

static int write_data(const label_figures *f)
{
    json_writer data = data_begin(f->s->r->page);
    data_write_envelopes(&data, f->s, f->label, &f->steps, &f->series);
    const int status = write_motions(f, &data);
    data_end(&data);
    return status;
}

static int draw_label(const label_figures *f)
{
    FILE *page = f->s->r->page;
    fputs("<div class=\"figures\">\n", page);
    int status = draw_best_path(f);
    for (int i = 0; i < f->steps.count * REPORT_QUANTITIES && status == CLI_DONE; i++)
        status = draw_quantity(f, &quantities[i % REPORT_QUANTITIES], i / REPORT_QUANTITIES);
    int levels[] = {2, 0, 0}; /* the work is drawn of one step, too */
    for (int i = 0; i < f->steps.count; i++)
        levels[step_tolerance(f->steps.word[i]) > 0.0 ? OVER_TOLERANCE : OVER_STEP]++;
    for (int axis = OVER_WORK; axis <= OVER_TOLERANCE; axis++)
        if (status == CLI_DONE && f->accuracy && levels[axis] > 1)
            status = draw_errors(f, (error_axis)axis);
    fputs("</div>\n", page);
    return status;
}

/* The methods of a label that have numbers: all in the figures, or of many one of each family. */
static void choose_methods(label_figures *f)
{
    const study_page *s = f->s;
    csv_words all = {.count = 0}, preferred = {.count = 0};
    for (int row = 1; row < s->cells.rows; row++)
        if (is_of_label(f, row) && csv_table_number(&s->cells, row, "steps") > 0.0)
            csv_add_word(&all, get_cell(s, row, "integrator"));
    for (int i = 0; i < all.count; i++)
        for (int k = 0; k < s->representatives.count; k++)
            if (strcmp(all.word[i], s->representatives.word[k]) == 0)
                csv_add_word(&preferred, all.word[i]);
    f->are_families = all.count > PLOT_METHODS;
    if (f->are_families)
        method_family_members(&all, &preferred, &f->methods);
    else
        f->methods = all;
}

/* Label i of the page. */
static int report_label(const study_page *s, int i)
{
    const char *label = s->labels.word[i];
    label_figures *f = cli_calloc(1, sizeof *f);
    *f = (label_figures){.s = s, .label = label, .number = i + 1};
    f->accuracy = find_accuracy(f);
    for (int row = 1; row < s->cells.rows; row++)
        if (is_of_label(f, row)) csv_add_word(&f->steps, get_cell(s, row, "step"));
    choose_methods(f);
    char *path = cli_format("%s/series/%s.csv", s->r->directory, label);
    int status = CLI_DONE;
    if (f->methods.count == 0) {
        fputs("<p>No run has numbers to show.</p>\n", s->r->page);
    } else if (!file_exists(path)) {
        fputs("<p>The runs keep no rows, so there is nothing to draw over time.</p>\n", s->r->page);
    } else {
        status = read_steps(&f->series, path);
        if (status == CLI_DONE) status = write_data(f);
        if (status == CLI_DONE) status = draw_label(f);
    }
    free(path);
    csv_table_free(&f->series);
    free(f);
    return status;
}

/* ---- the page ------------------------------------------------------------------------------ */

static const char introduction[] =
    "<details><summary>What sizes, trends and colours mean</summary>\n"
    "<p>Each cell has the number that the heading names, a size and a trend; – means that the "
    "method needs what the system lacks.</p>\n"
    "<ul class=\"key\">\n"
    "<li class=\"kept\">exact: never changed; rounding: no larger than the roundings of as many "
    "steps. With a trend, as a random walk, roundings add up.</li>\n"
    "<li class=\"small\">larger, below 1e-9. Without a trend it is about one value; settles: it "
    "changes once; random walk, linear, power law, exponential, growing oscillation: it grows so; "
    "undecided: too few samples, or too slow an oscillation, to decide</li>\n"
    "<li class=\"medium\">larger, below 1e-4</li>\n"
    "<li class=\"large\">larger, from 1e-4 on; or failed, aborted: the run ended early</li>\n"
    "<li class=\"off\">not stated: E where the motion of the run need not conserve it</li>\n"
    "</ul></details>\n";

static const char about_lift[] =
    "<details><summary>What the lift adds</summary>\n<p>On p = π = 0 a lifted method is the same "
    "method on (q,v), bit for bit. That a method is\n"
    "symplectic on the lift has no consequence there for D or the energy: every one-step method\n"
    "whose step is locally invertible, explicit Euler included, is the restriction of a\n"
    "symplectic one. D and E are preserved, or not, for other reasons: the form of D, whether D\n"
    "is enforced or projected, reversibility. What symplecticity does preserve shows off\n"
    "p = π = 0, in H. A step that lands in D = 0 has no lift of 4n+2 variables; restricted to\n"
    "D = 0 it lifts to T*{D = 0}, of dimension 2(2n − m).</p></details>\n";

/* The methods that the study file has among its representatives. */
static void list_representatives(study_page *s, const document *doc, yaml_node_t *list)
{
    for (int i = 0; list && i < document_count(list); i++) {
        const char *name = document_scalar(doc, document_item(doc, list, i), "representatives");
        for (int m = 0; name && m < s->methods.count; m++)
            if (strcmp(s->methods.word[m], name) == 0)
                csv_add_word(&s->representatives, s->methods.word[m]);
    }
}

/* With the title and the representatives of study.yaml. */
static int begin_study(study_page *s)
{
    document doc = {.place = "study.yaml"};
    size_t length = 0;
    char *path = cli_join(s->r->directory, "study.yaml"), *bytes = file_read(path, &length);
    int status = bytes ? document_parse(&doc, path, bytes, length) : CLI_IO;
    if (status == CLI_DONE) {
        const yaml_node_t *root = document_node(&doc, 1);
        const yaml_node_t *title = document_value(&doc, root, "title");
        const char *text = title ? document_scalar(&doc, title, "title") : "A study of drift";
        if (!text) status = CLI_USAGE;
        report_title(s->r, text ? text : "");
        list_representatives(s, &doc, document_value(&doc, root, "representatives"));
        yaml_document_delete(&doc.yaml);
    }
    free(bytes);
    free(path);
    return status;
}

static int read_titles(study_page *s)
{
    int status = CLI_DONE;
    for (int i = 0; i < s->labels.count && status == CLI_DONE; i++) {
        dal_model *model;
        status = read_label_model(s, s->labels.word[i], &model);
        s->title[i] = cli_strdup(report_model_title(model, s->labels.word[i]));
        dal_model_free(model);
    }
    return status;
}

static int write_equations(const study_page *s, const char *label)
{
    dal_model *model;
    const int status = read_label_model(s, label, &model);
    if (model) report_folded_equations(s->r->page, model);
    dal_model_free(model);
    return status;
}

static int write_study(study_page *s, const report_overview *overview)
{
    report *r = s->r;
    int status = begin_study(s);
    if (status != CLI_DONE) return status;
    bool is_lifted = false;
    report_overview_write(r, overview);
    status = report_expectations(r);
    report_heading(r, "methods", "All methods");
    fputs(introduction, r->page);
    for (int row = 1; row < s->cells.rows; row++)
        is_lifted |= !is_cell(s, row, "start", "physical");
    if (is_lifted) fputs(about_lift, r->page);
    report_matrices(s);
    if (status == CLI_DONE) status = report_predicted(s);
    report_heading(r, "systems", "Systems");
    for (int i = 0; i < s->labels.count && status != CLI_IO; i++) {
        if (cli_interrupted())
            return cli_fail(CLI_SIGNAL, "interrupted; 'dalembert report %s' makes the page",
                            r->directory);
        cli_progress("report: %s", s->labels.word[i]);
        char *id = cli_format("s%d", i + 1);
        report_subheading(r, id, s->short_name[i]);
        fprintf(r->page, "<h3 id=\"%s\">", id);
        report_text(r->page, s->title[i]);
        if (strcmp(s->title[i], s->labels.word[i]) != 0) {
            fputc(' ', r->page);
            report_element(r->page, "small", s->labels.word[i]);
        }
        fputs("</h3>\n", r->page);
        free(id);
        const int typeset = write_equations(s, s->labels.word[i]);
        const int drawn = report_label(s, i);
        if (status == CLI_DONE) status = typeset == CLI_DONE ? drawn : typeset;
    }
    report_heading(r, "again", "How to make it again");
    fputs("<pre>dalembert study study.yaml --output DIR\ndalembert report DIR</pre>\n", r->page);
    report_file(r, "study.yaml", "study.yaml");
    report_file(r, "manifest.json", "what it was made with: manifest.json");
    report_file(r, "tables.txt", "the tables: tables.txt");
    return status;
}

/* Systems in the order of the screen, those with a constraint first, then what it does not know. */
static void list_labels(study_page *s, const report_overview *overview)
{
    for (int i = 0; i < overview->matrix.columns; i++)
        for (int row = 1; row < s->cells.rows; row++)
            if (is_cell(s, row, "label", overview->matrix.column[i]->label))
                csv_add_word(&s->labels, get_cell(s, row, "label"));
    for (int row = 1; row < s->cells.rows; row++)
        csv_add_word(&s->labels, get_cell(s, row, "label"));
    for (int i = 0; i < s->labels.count; i++)
        s->short_name[i] = report_short_name(overview, s->labels.word[i]);
}

int report_study(report *r)
{
    study_page *s = cli_calloc(1, sizeof *s);
    report_overview overview = {.name = NULL};
    char *path = cli_join(r->directory, "cells.csv");
    s->r = r;
    int status = read_steps(&s->cells, path);
    for (int row = 1; status == CLI_DONE && row < s->cells.rows; row++) {
        status = check_cell_names(s, path, row);
        csv_add_word(&s->methods, get_cell(s, row, "integrator"));
    }
    if (status == CLI_DONE && s->cells.rows < 2)
        status = cli_fail(CLI_USAGE, "'%s' has no rows", path);
    for (int k = 0; status == CLI_DONE && k < REPORT_QUANTITIES; k++)
        if (quantities[k].trend) status = csv_table_require(&s->cells, path, quantities[k].trend);
    if (status == CLI_DONE) status = report_overview_read(&overview, r->directory, &s->cells);
    if (status == CLI_DONE) list_labels(s, &overview);
    if (status == CLI_DONE) status = read_titles(s);
    if (status == CLI_DONE) status = write_study(s, &overview);
    for (int i = 0; i < s->labels.count; i++) free(s->title[i]);
    report_overview_free(&overview);
    csv_table_free(&s->cells);
    free(s);
    free(path);
    return status;
}

int report_after_study(const char *directory, int status, report_naming naming)
{
    report r = {.directory = directory};
    char *cells = cli_join(directory, "cells.csv");
    const bool has_results =
        (status == CLI_DONE || status == CLI_CHECK || status == CLI_FAILED) && file_exists(cells);
    free(cells);
    if (!has_results || cli_interrupted()) return status;
    const int made = report_make(&r, report_study);
    if (made == CLI_DONE && naming == REPORT_NAMED) printf("Page: %s\n", r.page_path);
    if (status == CLI_DONE) status = made;
    free(r.place);
    free(r.page_path);
    const int printed = cli_close(stdout, "standard output");
    return printed == CLI_DONE ? status : printed;
}
