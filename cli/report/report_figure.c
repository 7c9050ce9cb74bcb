/* report_figure.c - the figures of one label of a study.
 *
 * At each step the envelopes of what should not change, max |x - x(0)| up to t, over t, log-log: a
 * drift ~ t^k is a line of slope k.  Over all steps the error against the work and, where there are
 * several, against h.  And the path of the most accurate run. */
#include "io/output.h"
#include "report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* column of series/LABEL.csv, the column of cells.csv that is empty where a system lacks it, the
 * start whose runs are shown and another that has the same numbers, title, label, file name */
typedef struct track {
    const char *column, *value, *start, *other, *title, *ylabel, *name;
} track;

static const track tracks[] = {
    {"D", "D_max", "physical", "surface", "Constraints", "max |D|", "D"},
    {"E", "E_deviation", "physical", "surface", "Energy", "max |E - E(0)|", "E"},
    {"invariants", "invariant_deviation", "physical", "surface", "Invariants",
     "max |I - I(0)| / max(1, |I(0)|)", "I"},
    {"H", "H_deviation", "displaced", "displaced", "H, started off p = pi = 0", "max |H - H(0)|",
     "H"},
    {"error", "error_max", "physical", "surface", "Error", "max |q - exact|", "error"},
};

enum { TRACKS = sizeof tracks / sizeof tracks[0] };

typedef struct figure {
    report *r;
    const report_cells *c;
    const char *label;
    report_csv series;
    report_words methods; /* those drawn: without modifiers, if there are such */
    report_words steps;
    const char *accuracy; /* the column that tells errors; NULL: none does */
} figure;

/* ---- what there is ---- */

static int find_plain(const figure *f, const char *method, const char *step)
{
    return report_find(f->c, f->label, method, step, "physical", "surface");
}

/* Which column can tell accuracy: the error, or what the system keeps. */
static const char *find_accuracy(const figure *f)
{
    static const char *const columns[] = {"error_max", "invariant_deviation", "E_deviation"};
    for (int k = 0; k < 3; k++)
        for (int row = 1; row < f->c->csv.rows; row++) {
            int kept = k < 2 || !report_is(f->c, row, "E_trend", "");
            if (report_is(f->c, row, "label", f->label) && kept &&
                report_get(f->c, row, columns[k])[0])
                return columns[k];
        }
    return NULL;
}

static void add_methods(figure *f, int modified)
{
    for (int row = 1; row < f->c->csv.rows; row++) {
        const char *method = report_get(f->c, row, "integrator");
        if (report_is(f->c, row, "label", f->label) && !report_is(f->c, row, "steps", "0") &&
            (modified || !strchr(method, '+')))
            report_add_word(&f->methods, method);
    }
}

static void survey(figure *f)
{
    for (int row = 1; row < f->c->csv.rows; row++)
        if (report_is(f->c, row, "label", f->label))
            report_add_word(&f->steps, report_get(f->c, row, "step"));
    add_methods(f, 0);
    if (f->methods.count == 0) add_methods(f, 1);
    f->accuracy = find_accuracy(f);
}

static int read_series(figure *f)
{
    char name[PLOT_NAME];
    snprintf(name, sizeof name, "series/%.160s.csv", f->label);
    char *path = cli_join(f->r->directory, name);
    int status = report_csv_read(&f->series, path);
    free(path);
    return status;
}

/* ---- envelopes ---- */

/* The rows of a cell stand together: the first, or -1. */
static int find_rows(const figure *f, const char *method, const char *step, const char *start)
{
    for (int row = 1; row < f->series.rows; row++)
        if (strcmp(report_csv_get(&f->series, row, "integrator"), method) == 0 &&
            strcmp(report_csv_get(&f->series, row, "step"), step) == 0 &&
            strcmp(report_csv_get(&f->series, row, "start"), start) == 0)
            return row;
    return -1;
}

static int same_cell(const figure *f, int row, int first)
{
    static const char *const keys[] = {"integrator", "step", "start"};
    for (int k = 0; k < 3; k++)
        if (strcmp(report_csv_get(&f->series, row, keys[k]),
                   report_csv_get(&f->series, first, keys[k])) != 0)
            return 0;
    return 1;
}

static void add_envelope(const figure *f, report_plot *plot, const char *method, const char *step,
                         const track *t)
{
    char slope[32] = "";
    int row = report_find(f->c, f->label, method, step, t->start, t->other);
    const int is_there = row >= 0 && report_get(f->c, row, t->value)[0];
    int first = !is_there ? -1 : find_rows(f, method, step, report_get(f->c, row, "start"));
    if (first < 0) return;
    plot_curve *curve = report_curve(plot, method);
    double most = 0.0;
    for (row = first; row < f->series.rows && same_cell(f, row, first); row++) {
        const double x = report_csv_number(&f->series, row, t->column);
        if (!(x <= most)) most = x;
        report_point(plot, report_csv_number(&f->series, row, "until"), most);
    }
    if (curve->count == 0)
        snprintf(slope, sizeof slope, most == 0.0 ? " (0)" : " (not finite)");
    else if (isfinite(report_slope(curve)))
        snprintf(slope, sizeof slope, " (%.1f)", fabs(report_slope(curve)));
    snprintf(curve->title, sizeof curve->title, "%.60s%s", method, slope);
}

/* A file name of a label, of what is drawn and of numbers that tell figures apart. */
static void name_plot(report_plot *plot, const figure *f, const char *what, int step, int part)
{
    char more[48] = "";
    if (step > 0) snprintf(more, sizeof more, "-h%d", step + 1);
    if (part > 0) snprintf(more + strlen(more), sizeof more - strlen(more), "-%d", part + 1);
    snprintf(plot->name, sizeof plot->name, "%.120s-%s%s", f->label, what, more);
}

/* "max |D| is 0 at all rows with A, B, C." */
static void say_zero(const report_plot *plot, char *text, size_t size)
{
    size_t n = (size_t)snprintf(text, size, "%s is 0 at all rows with", plot->ylabel);
    for (int i = 0; i < plot->count && n < size; i++) {
        const char *title = plot->curve[i].title;
        n += (size_t)snprintf(text + n, size - n, "%s %.*s", i ? "," : "", (int)strcspn(title, " "),
                              title);
    }
    if (n < size) snprintf(text + n, size - n, ".");
}

static int draw_track(const figure *f, const track *t, int step, int part)
{
    report_plot plot = {.log_x = 1, .log_y = 1, .xlabel = "t", .caption = report_envelope};
    name_plot(&plot, f, t->name, step, part);
    snprintf(plot.title, sizeof plot.title, "%s, h = %g", t->title,
             strtod(f->steps.word[step], NULL));
    snprintf(plot.ylabel, sizeof plot.ylabel, "%s", t->ylabel);
    const int first = part * PLOT_CURVES;
    for (int m = first; m < f->methods.count && m < first + PLOT_CURVES; m++)
        add_envelope(f, &plot, f->methods.word[m], f->steps.word[step], t);
    char text[PLOT_CURVES * PLOT_TITLE];
    say_zero(&plot, text, sizeof text);
    plot.nothing = text;
    return report_draw(f->r, &plot);
}

/* ---- error against work and step ---- */

static void add_errors(const figure *f, report_plot *plot, const char *method, int against_work)
{
    report_curve(plot, method);
    for (int h = 0; h < f->steps.count; h++) {
        const int row = find_plain(f, method, f->steps.word[h]);
        if (row < 0 || !report_is(f->c, row, "state", "done")) continue;
        const double work = report_csv_number(&f->c->csv, row, "evaluations") /
                            report_csv_number(&f->c->csv, row, "time");
        report_point(plot, against_work ? work : strtod(f->steps.word[h], NULL),
                     report_csv_number(&f->c->csv, row, f->accuracy));
    }
}

static int draw_errors(const figure *f, int against_work, int part)
{
    const char *what = strcmp(f->accuracy, "error_max") == 0     ? "max error"
                       : strcmp(f->accuracy, "E_deviation") == 0 ? "max |E - E(0)|"
                                                                 : "max |I - I(0)|";
    report_plot plot = {.log_x = 1, .log_y = 1, .marks = 1};
    plot.caption = against_work ? "Lower left is better: less error for less work."
                                : "A method of order p is a line of slope p.";
    name_plot(&plot, f, against_work ? "work" : "order", 0, part);
    snprintf(plot.title, sizeof plot.title, against_work ? "Work and precision" : "Order");
    snprintf(plot.xlabel, sizeof plot.xlabel, "%s",
             against_work ? "evaluations of F per unit of t" : "step h");
    snprintf(plot.ylabel, sizeof plot.ylabel, "%s", what);
    const int first = part * PLOT_CURVES;
    for (int m = first; m < f->methods.count && m < first + PLOT_CURVES; m++)
        add_errors(f, &plot, f->methods.word[m], against_work);
    return report_draw(f->r, &plot);
}

/* ---- the path of one run ---- */

/* The most accurate run that was kept; -1: none was. */
static int best_run(const figure *f)
{
    int best = -1;
    double least = INFINITY;
    for (int row = 1; row < f->c->csv.rows; row++) {
        if (!report_is(f->c, row, "label", f->label) || !report_get(f->c, row, "run")[0] ||
            !report_is(f->c, row, "state", "done") || report_is(f->c, row, "start", "displaced"))
            continue;
        double error = f->accuracy ? report_csv_number(&f->c->csv, row, f->accuracy) : 0.0;
        if (best >= 0 && !(error < least)) continue;
        best = row;
        least = error;
    }
    return best;
}

static int draw_path(const figure *f)
{
    char name[PLOT_NAME], caption[2 * PLOT_NAME];
    const int row = best_run(f);
    if (row < 0) return CLI_DONE;
    snprintf(name, sizeof name, "%.120s-path", f->label);
    snprintf(caption, sizeof caption, "The path by %.80s with h = %g.",
             report_get(f->c, row, "integrator"), report_csv_number(&f->c->csv, row, "step"));
    char *path = cli_join(f->r->directory, report_get(f->c, row, "run"));
    int status = report_path(f->r, path, name, caption);
    free(path);
    return status;
}

/* ---- the whole ---- */

static int draw_part(const figure *f, int part)
{
    int status = CLI_DONE;
    for (int h = 0; h < f->steps.count; h++)
        for (int k = 0; k < TRACKS && status == CLI_DONE; k++)
            status = draw_track(f, &tracks[k], h, part);
    if (status == CLI_DONE && f->accuracy) status = draw_errors(f, 1, part);
    if (status == CLI_DONE && f->accuracy && f->steps.count > 1) status = draw_errors(f, 0, part);
    return status;
}

static int draw_all(const figure *f)
{
    int status = CLI_DONE, parts = (f->methods.count + PLOT_CURVES - 1) / PLOT_CURVES;
    for (int part = 0; part < parts && status == CLI_DONE; part++) {
        if (part) {
            const char *first = f->methods.word[part * PLOT_CURVES];
            fputs("<details><summary>further methods: ", f->r->page);
            report_text(f->r->page, first);
            fputs(" ...</summary>\n", f->r->page);
        }
        fputs("<div class=\"figures\">\n", f->r->page);
        if (part == 0) status = draw_path(f);
        if (status == CLI_DONE) status = draw_part(f, part);
        fputs(part ? "</div></details>\n" : "</div>\n", f->r->page);
    }
    return status;
}

int report_figures(report *r, const report_cells *c, const char *label)
{
    figure *f = cli_calloc(1, sizeof *f);
    *f = (figure){.r = r, .c = c, .label = label};
    survey(f);
    int status = CLI_DONE;
    if (f->methods.count == 0)
        fputs("<p>No run has numbers to show.</p>\n", r->page);
    else
        status = read_series(f);
    if (status == CLI_DONE && f->methods.count > 0) status = draw_all(f);
    report_csv_free(&f->series);
    free(f);
    return status;
}
