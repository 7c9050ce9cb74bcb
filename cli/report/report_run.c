/* report_run.c - the page of a run: what was asked for, its path, its coordinates, and what should
 * not change, over t and as envelopes over log t. */
#include "io/output.h"
#include "report.h"

#include "io/trajectory_reader.h"
#include "run/run_directory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Of more rows than these a figure over t shows every k-th; an envelope has a point for every so
 * many per cent of t. */
enum { POINTS = 2000 };
static const double denser = 1.02;

/* What is drawn over t: code, file name, title, label of the axis, what the page says instead when
 * all values at all rows are 0 */
#define GROUP_LIST(GROUP)                                                                          \
    GROUP(COORDINATES, "coordinates", "Coordinates", "q", NULL)                                    \
    GROUP(D, "D", "Constraints", "D", "D is 0 at all rows.")                                       \
    GROUP(E, "E", "Energy", "E - E(0)", "E is the same at all rows.")                              \
    GROUP(H, "H", "H of the lift", "H - H(0)", "H is the same at all rows.")                       \
    GROUP(INVARIANTS, "I", "Invariants", "I - I(0)", "The invariants are the same at all rows.")   \
    GROUP(ERROR, "error", "Error", "max |q - exact|", "The error is 0 at all rows.")

enum {
#define GROUP_CODE(code, name, title, ylabel, nothing) GROUP_##code,
    GROUP_LIST(GROUP_CODE)
#undef GROUP_CODE
        GROUPS
};

typedef struct run_page {
    report *r;
    trajectory_reader reader;
    report_csv summary; /* no rows unless the run is over */
    int n;              /* coordinates, in columns 1.. */
    int observables;    /* the first column behind the state */
    double *first;      /* [columns] of the first row */
    double *most;       /* [columns] so far */
    double told;        /* t of the last point of the envelopes */
    report_plot plot[GROUPS], drift;
    int *group;    /* [columns] which plot, or -1 */
    int *place;    /* [columns] which curve of it, or -1: there are too many */
    int *envelope; /* [columns] which curve of the drift, or -1 */
} run_page;

/* ---- columns ---- */

static int is_numbered(const char *name)
{
    return name[0] == 'D' && name[1] && name[1 + strspn(name + 1, "0123456789")] == '\0';
}

static int is_observable(const char *name)
{
    return strcmp(name, "E") == 0 || strcmp(name, "H") == 0 || is_numbered(name);
}

static int group_of(const run_page *run, int column)
{
    const char *name = run->reader.name[column];
    if (column <= run->n) return GROUP_COORDINATES;
    if (column < run->observables) return -1;
    if (is_numbered(name)) return GROUP_D;
    if (strcmp(name, "E") == 0) return GROUP_E;
    if (strcmp(name, "H") == 0) return GROUP_H;
    return strcmp(name, "error") == 0 ? GROUP_ERROR : GROUP_INVARIANTS;
}

/* t, q, q', rest of the state, then D1.., E, H, invariants, error.  A coordinate may be called D1
 * or E; only behind the velocities is a column an observable. */
static void find_columns(run_page *run)
{
    const trajectory_reader *t = &run->reader;
    while (1 + run->n < t->columns && !strchr(t->name[1 + run->n], '\'')) run->n++;
    for (run->observables = 1 + 2 * run->n; run->observables < t->columns; run->observables++)
        if (is_observable(t->name[run->observables])) break;
}

static int add_curve(report_plot *plot, const char *title)
{
    if (plot->count >= PLOT_CURVES) return -1;
    report_curve(plot, title);
    return plot->count - 1;
}

/* Whether an observable should stay as it is.  Of E and H the summary says it, by a trend. */
static int should_stay(const run_page *run, int column)
{
    const int g = run->group[column];
    if (column < run->observables) return 0;
    if (g != GROUP_E && g != GROUP_H) return 1;
    for (int row = 1; row < run->summary.rows; row++)
        if (strcmp(report_csv_get(&run->summary, row, "observable"), run->reader.name[column]) == 0)
            return report_csv_get(&run->summary, row, "trend")[0] != '\0';
    return 0;
}

/* A curve for each column, as long as there is room for them. */
static void place_columns(run_page *run)
{
    for (int i = 1; i < run->reader.columns; i++) {
        const char *name = run->reader.name[i];
        run->group[i] = group_of(run, i);
        run->place[i] = run->group[i] < 0 ? -1 : add_curve(&run->plot[run->group[i]], name);
        run->envelope[i] = should_stay(run, i) ? add_curve(&run->drift, name) : -1;
    }
}

/* A sentence about all values needs all columns and all rows, of which figures leave some out. */
static void drop_sentences(run_page *run)
{
    for (int i = 1; i < run->reader.columns; i++) {
        if (run->group[i] >= 0 && run->most[i] != 0.0) run->plot[run->group[i]].nothing = NULL;
        if (should_stay(run, i) && run->most[i] != 0.0) run->drift.nothing = NULL;
    }
}

static void name_plots(run_page *run)
{
    static const char *const texts[][4] = {
#define GROUP_TEXTS(code, name, title, ylabel, nothing) {name, title, ylabel, nothing},
        GROUP_LIST(GROUP_TEXTS)
#undef GROUP_TEXTS
    };
    for (int g = 0; g < GROUPS; g++) {
        report_plot *plot = &run->plot[g];
        snprintf(plot->name, sizeof plot->name, "%s", texts[g][0]);
        snprintf(plot->title, sizeof plot->title, "%s", texts[g][1]);
        snprintf(plot->ylabel, sizeof plot->ylabel, "%s", texts[g][2]);
        snprintf(plot->xlabel, sizeof plot->xlabel, "t");
        plot->caption = "";
        plot->nothing = texts[g][3];
    }
    run->drift = (report_plot){.name = "drift",
                               .title = "Drift of what should not change",
                               .xlabel = "t",
                               .ylabel = "max |x - x(0)|",
                               .log_x = 1,
                               .log_y = 1,
                               .nothing = "Nothing that should not change does so at any row.",
                               .caption = report_envelope};
}

/* ---- rows ---- */

/* Points go to the last curve of a plot, so the others are hidden for a moment. */
static void add(report_plot *plot, int curve, double x, double y)
{
    const int count = plot->count;
    plot->count = curve + 1;
    report_point(plot, x, y);
    plot->count = count;
}

/* D and error are what they are; all else is measured from its start. */
static double value(const run_page *run, int i)
{
    const int g = run->group[i];
    const int plain = g == GROUP_COORDINATES || g == GROUP_D || g == GROUP_ERROR;
    return plain ? run->reader.row[i] : run->reader.row[i] - run->first[i];
}

static void take_row(run_page *run, long long k)
{
    const trajectory_reader *t = &run->reader;
    const long long stride = 1 + t->count / POINTS, last = t->count - 1;
    const double now = t->row[0];
    const int tell = now >= denser * run->told || k == last;
    if (k == 0) memcpy(run->first, t->row, (size_t)t->columns * sizeof *run->first);
    for (int i = 1; i < t->columns; i++) {
        if (run->group[i] < 0) continue;
        const double x = value(run, i);
        if (run->place[i] >= 0 && (k % stride == 0 || k == last))
            add(&run->plot[run->group[i]], run->place[i], now, x);
        if (!(fabs(x) <= run->most[i])) run->most[i] = fabs(x);
        if (tell && run->envelope[i] >= 0) add(&run->drift, run->envelope[i], now, run->most[i]);
    }
    if (tell) run->told = now;
}

static void tell_slopes(run_page *run)
{
    for (int i = run->observables; i < run->reader.columns; i++) {
        if (run->envelope[i] < 0) continue;
        plot_curve *curve = &run->drift.curve[run->envelope[i]];
        const double slope = report_slope(curve);
        char more[32] = "";
        if (curve->count == 0)
            snprintf(more, sizeof more, run->most[i] == 0.0 ? " (0)" : " (not finite)");
        if (isfinite(slope)) snprintf(more, sizeof more, " (%.1f)", fabs(slope));
        snprintf(curve->title, sizeof curve->title, "%.60s%s", run->reader.name[i], more);
    }
}

static int draw_figures(run_page *run)
{
    int more, status = CLI_DONE;
    name_plots(run);
    place_columns(run);
    for (long long k = 0; (more = reader_next(&run->reader)) > 0; k++) take_row(run, k);
    if (more < 0) status = CLI_IO;
    tell_slopes(run);
    drop_sentences(run);
    int drawn = report_draw(run->r, &run->drift);
    for (int g = 0; g < GROUPS; g++) {
        if (status == CLI_DONE) status = drawn;
        drawn = report_draw(run->r, &run->plot[g]);
    }
    return status == CLI_DONE ? drawn : status;
}

static int make_memory(run_page *run)
{
    const size_t columns = (size_t)run->reader.columns;
    if (run->reader.count == 0) return cli_fail(CLI_USAGE, "'%s' has no rows", run->reader.path);
    run->first = cli_calloc(2 * columns, sizeof *run->first);
    run->group = cli_calloc(3 * columns, sizeof *run->group);
    run->most = run->first + columns;
    run->place = run->group + columns;
    run->envelope = run->place + columns;
    return CLI_DONE;
}

/* ---- the summary ---- */

/* The largest drift over a time that the interval of the rate admits, where there is no
 * trend. */
static void say_drift(char *text, size_t size, const report_csv *csv, int row, double time)
{
    const double most = fmax(fabs(report_csv_number(csv, row, "rate_low")),
                             fabs(report_csv_number(csv, row, "rate_high")));
    const int is_exact = strcmp(report_csv_get(csv, row, "size"), "exact") == 0;
    text[0] = '\0';
    if (!is_exact && strcmp(report_csv_get(csv, row, "trend"), "none") == 0)
        snprintf(text, size, "|drift| ≤ %.1e", most * time);
}

static void put_quantity(FILE *page, const report_csv *csv, int row, double time)
{
    static const char *const columns[] = {"confidence", "first",     "final",
                                          "maximum",    "deviation", "rate",
                                          "rate_low",   "rate_high", "exponent"};
    fputs("<tr>", page);
    report_element(page, "th scope=\"row\"", report_csv_get(csv, row, "observable"));
    char drift[64];
    say_drift(drift, sizeof drift, csv, row, time);
    report_trend(page, report_csv_get(csv, row, "size"), report_csv_get(csv, row, "trend"), drift);
    for (size_t k = 0; k < sizeof columns / sizeof columns[0]; k++)
        report_number(page, "%.4g", report_csv_number(csv, row, columns[k]));
    fputs("</tr>\n", page);
}

/* summary.csv is there when the run is over. */
static int read_summary(run_page *run)
{
    char *path = cli_join(run->r->directory, "summary.csv");
    int status = access(path, F_OK) == 0 ? report_csv_read(&run->summary, path) : CLI_DONE;
    free(path);
    return status;
}

static void put_summary(const run_page *run, double time)
{
    FILE *page = run->r->page;
    if (run->summary.rows < 2) return;
    fputs("<h2>Size and trend</h2>\n<div class=\"wide\" tabindex=\"0\"><table><thead><tr><td></td>"
          "<th>size, trend</th><th>confi&shy;dence</th><th>first</th><th>final</th><th>max |x|</th>"
          "<th>max |x − first|</th><th>rate</th><th>rate, from</th><th>to (95 %)</th>"
          "<th>exponent</th></tr></thead>\n<tbody>",
          page);
    for (int row = 1; row < run->summary.rows; row++) put_quantity(page, &run->summary, row, time);
    fputs("</tbody></table></div>\n", page);
    for (int row = 1; row < run->summary.rows; row++)
        if (!report_csv_get(&run->summary, row, "trend")[0])
            fprintf(page,
                    "<p>%s has neither size nor trend: the motion of this run need not "
                    "conserve it.</p>\n",
                    report_csv_get(&run->summary, row, "observable"));
}

/* ---- what was asked for ---- */

/* A word of a shell's command. */
static void put_word(FILE *page, const char *word)
{
    static const char plain[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"
                                "_-+./,:=@%";
    if (word[0] && word[strspn(word, plain)] == '\0') {
        report_text(page, word);
        return;
    }
    fputc('\'', page);
    for (const char *c = word; *c; c++) {
        char letter[] = {*c, '\0'};
        if (*c == '\'')
            fputs("'\\''", page);
        else
            report_text(page, letter);
    }
    fputc('\'', page);
}

/* The shortest digits that are read back as the same number. */
static void put_settings(FILE *page, const char *option, const request_settings *settings)
{
    char text[256];
    for (int i = 0; i < settings->count; i++) {
        const dal_setting *s = &settings->item[i];
        for (int digits = 6; digits <= 17; digits++) {
            snprintf(text, sizeof text, "%.120s=%.*g", s->name, digits, s->value);
            if (strtod(strchr(text, '=') + 1, NULL) == s->value) break;
        }
        fprintf(page, " --%s ", option);
        put_word(page, text);
    }
}

static void put_command(FILE *page, const run_request *request)
{
    cli_option options[REQUEST_OPTIONS];
    request_list_options(options);
    fputs("<h2>How to make it again</h2>\n<pre tabindex=\"0\">dalembert run ", page);
    put_word(page, request->system_name);
    for (int i = 0; i < REQUEST_OPTIONS; i++) {
        if (!request->text[i] || i == REQUEST_set || i == REQUEST_start) continue;
        fprintf(page, " --%s ", options[i].name);
        put_word(page, request->text[i]);
    }
    put_settings(page, "set", &request->set);
    put_settings(page, "start", &request->start);
    fputs(" --output DIR</pre>\n", page);
}

static void put_heading(report *r, const run_request *request)
{
    char title[2 * PLOT_NAME];
    const char *method = request->text[REQUEST_integrator];
    snprintf(title, sizeof title, "%.80s by %.80s",
             request->system_name ? request->system_name : "A run", method ? method : "?");
    report_title(r, request->system_name ? title : "A run");
}

/* The request of the run; a directory without a manifest has none. */
static int read_job(const report *r, run_directory *dir, run_request *request)
{
    run_directory_open(dir, r->directory);
    if (access(dir->manifest, F_OK) != 0) return CLI_DONE;
    return run_directory_read(dir, request);
}

/* ---- the page ---- */

static int write_page(run_page *run, const run_request *request)
{
    report *r = run->r;
    put_heading(r, request);
    int status = CLI_DONE;
    put_summary(run, request->time);
    fputs("<h2>Figures</h2>\n<div class=\"figures\">\n", r->page);
    if (status == CLI_DONE && request->system_name)
        status = report_path(r, r->directory, "path", "");
    if (status == CLI_DONE) status = draw_figures(run);
    fputs("</div>\n", r->page);
    if (request->system_name) put_command(r->page, request);
    report_file(r, "manifest.json", "what it was made with: manifest.json");
    return status;
}

int report_run(report *r)
{
    run_directory dir = {.descriptor = -1};
    run_request request = request_default();
    run_page *run = cli_calloc(1, sizeof *run);
    run->r = r;
    int status = reader_open(&run->reader, r->directory), opened = status == CLI_DONE;
    if (opened) status = make_memory(run);
    if (status == CLI_DONE) status = read_job(r, &dir, &request);
    if (status == CLI_DONE) status = read_summary(run);
    if (status == CLI_DONE) {
        find_columns(run);
        status = write_page(run, &request);
    }
    if (opened) reader_close(&run->reader);
    report_csv_free(&run->summary);
    free(run->first);
    free(run->group);
    free(run);
    request_free(&request);
    run_directory_close(&dir);
    return status;
}
