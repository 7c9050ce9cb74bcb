/* page.c - the page of the bench, made of its results.
 *
 *     page DIR RESULTS...       DIR/report/index.html, with charts
 *
 * RESULTS are JSON lines, as run.sh and native_auto.py write them:
 *
 *     {"processor": ...}   the machine; begins each file
 *     {"section": ...}     a heading and a text; "figure" is what the results after it are:
 *     {"case": ...}        of "ratios" a ratio, of "sizes" the time of a step on a chain
 *     {"system": ...}      of "runs" the seconds that a run takes in each mode
 *
 * The page is made as by `dalembert report` (cli/report/report_page.h). */
#define _POSIX_C_SOURCE 200809L
#include "io/file.h"
#include "io/json.h"
#include "report/report_plot.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_LINES = 4096, MAX_WORD = 32 };

/* The lines of all files; lines of a section are together. */
typedef struct results {
    document line[MAX_LINES];
    char *place[MAX_LINES]; /* of messages */
    int count;
} results;

/* ---- results ------------------------------------------------------------------------------- */

/* A value as it is written; NULL: the line has none of this name, or null. */
static const char *get(const results *all, int i, const char *name)
{
    const document *line = &all->line[i];
    const yaml_node_t *value = document_value(line, document_node(line, 1), name);
    if (!value || value->type != YAML_SCALAR_NODE) return NULL;
    const char *text = (const char *)value->data.scalar.value;
    const bool is_plain = value->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
    return is_plain && strcmp(text, "null") == 0 ? NULL : text;
}

static const char *get_text(const results *all, int i, const char *name)
{
    const char *text = get(all, i, name);
    return text ? text : "";
}

static double get_number(const results *all, int i, const char *name)
{
    const char *text = get(all, i, name);
    return text ? strtod(text, NULL) : NAN;
}

static int read_results(results *all, const char *path)
{
    size_t length = 0;
    char *bytes = file_read(path, &length);
    char *line = bytes;
    int status = bytes ? CLI_DONE : CLI_IO;
    for (int number = 1; status == CLI_DONE && line && *line; number++) {
        char *next = strchr(line, '\n');
        if (next) *next++ = '\0';
        if (all->count == MAX_LINES) {
            status = cli_fail(CLI_USAGE, "'%s': more than %d lines", path, MAX_LINES);
        } else {
            const int k = all->count++;
            all->place[k] = cli_format("line %d of %s", number, path);
            status = json_parse(&all->line[k], all->place[k], line, strlen(line));
        }
        line = next;
    }
    free(bytes);
    return status;
}

/* The line after the last one from i on that has the name. */
static int find_end(const results *all, int i, const char *name)
{
    while (i < all->count && get(all, i, name)) i++;
    return i;
}

/* ---- ratios -------------------------------------------------------------------------------- */

/* One row a case: the median, a line from the smallest to the largest, and the goal. */
static int draw_ratios(report *r, const results *all, int section, int begin, int end)
{
    enum { SPREAD, MEDIAN, GOAL, KINDS };
    static const char *const titles[KINDS] = {"spread", "median", "goal"};
    const char **names = cli_calloc((size_t)(end - begin) + 1, sizeof *names);
    char name[MAX_WORD];
    double min = INFINITY, max = 0.0;
    snprintf(name, sizeof name, "ratios-%d", section);
    for (int i = begin; i < end; i++) {
        names[i - begin] = get_text(all, i, "case");
        if (!get(all, i, "median")) continue;
        min = fmin(min, get_number(all, i, "min"));
        max = fmax(max, get_number(all, i, "max"));
    }
    report_plot plot = {.name = name,
                        .title = get_text(all, section, "section"),
                        .xlabel = get_text(all, section, "unit"),
                        .ylabel = "",
                        .caption = "",
                        .log_x = max > 4.0 * min,
                        .row = names,
                        .rows = end - begin};
    for (int k = 0; k < KINDS; k++) {
        plot_curve *curve = report_curve(&plot, titles[k]);
        curve->colour = k == GOAL ? 0 : 1;
        curve->has_dots = k == MEDIAN;
        curve->has_rings = k == GOAL;
        for (int i = begin; i < end; i++) {
            const char *goal = get_text(all, i, "goal");
            const double row = i - begin + 1;
            if (!get(all, i, "median")) continue;
            if (k == MEDIAN) report_point(&plot, curve, get_number(all, i, "median"), row);
            if (k == GOAL && goal[0])
                report_point(&plot, curve, strtod(goal + strcspn(goal, "0123456789"), NULL), row);
            if (k != SPREAD) continue;
            report_point(&plot, curve, get_number(all, i, "min"), row);
            report_point(&plot, curve, get_number(all, i, "max"), row);
            report_lift(curve);
        }
    }
    const int status = report_draw(r, &plot);
    free(names);
    return status;
}

static void write_ratios(FILE *page, const results *all, int begin, int end)
{
    fputs(REPORT_TABLE "<th>case</th><th>what</th><th>median</th><th>spread</th><th>goal</th>"
                       "<th></th>" REPORT_ROWS,
          page);
    for (int i = begin; i < end; i++) {
        char spread[64] = "–";
        const char *goal = get_text(all, i, "goal"), *met = get_text(all, i, "met");
        const char *a = get(all, i, "a");
        const bool is_met = strcmp(met, "true") == 0;
        if (get(all, i, "median"))
            snprintf(spread, sizeof spread, "%.4g to %.4g", get_number(all, i, "min"),
                     get_number(all, i, "max"));
        report_row(page, get_text(all, i, "case"));
        report_element(page, "td style=\"text-align: left; white-space: normal; min-width: 12rem\"",
                       get_text(all, i, "what"));
        report_number(page, "%.4g", get_number(all, i, "median"));
        report_element(page, "td", spread);
        fputs("<td>", page);
        if (strlen(goal) > 2) fprintf(page, "%s%s", goal[0] == '<' ? "≤" : "≥", goal + 2);
        fprintf(page, "</td><td%s>%s</td></tr>\n",
                !*met    ? ""
                : is_met ? " class=\"kept\""
                         : " class=\"large\"",
                a && !*a                 ? "not reached"
                : !get(all, i, "median") ? "not measured"
                : !*met                  ? ""
                : is_met                 ? "met"
                                         : "missed");
    }
    fputs(REPORT_TABLE_END, page);
}

/* ---- sizes --------------------------------------------------------------------------------- */

/* What a contender is: dal ENGINE METHOD SPACE RN. */
typedef struct sized {
    char engine[MAX_WORD], method[MAX_WORD];
    int n;
} sized;

static sized parse_sized(const results *all, int i)
{
    sized s = {.n = 0};
    if (sscanf(get_text(all, i, "a"), "%*s %31s %31s %*s R%d", s.engine, s.method, &s.n) != 3)
        s.n = 0;
    return s;
}

/* The median of an engine and a method at a size. */
static double find_time(const results *all, int begin, int end, sized wanted)
{
    for (int i = begin; i < end; i++) {
        const sized s = parse_sized(all, i);
        if (s.n == wanted.n && strcmp(s.engine, wanted.engine) == 0 &&
            strcmp(s.method, wanted.method) == 0)
            return get_number(all, i, "median");
    }
    return NAN;
}

static const char *const engines[2][2] = {{"tape", "interpreted"}, {"native", "compiled"}};

/* Whether no case before i has its method, or its size. */
static bool is_new(const results *all, int begin, int i, bool by_size)
{
    const sized s = parse_sized(all, i);
    for (int j = begin; j < i; j++) {
        const sized other = parse_sized(all, j);
        if (by_size ? other.n == s.n : strcmp(other.method, s.method) == 0) return false;
    }
    return s.n > 0;
}

/* Of the method of the result `first`. */
static int draw_sizes(report *r, const results *all, int begin, int end, int first)
{
    char name[MAX_WORD], *method = cli_strdup(parse_sized(all, first).method);
    report_plot plot = {.name = name,
                        .title = method,
                        .xlabel = "n",
                        .ylabel = "µs a step",
                        .caption = "",
                        .log_x = true,
                        .log_y = true,
                        .has_marks = true};
    snprintf(name, sizeof name, "sizes-%d", first);
    for (int e = 0; e < 2; e++) {
        plot_curve *curve = report_curve(&plot, engines[e][1]);
        for (int i = begin; i < end; i++) {
            const sized s = parse_sized(all, i);
            if (strcmp(s.method, method) == 0 && strcmp(s.engine, engines[e][0]) == 0)
                report_point(&plot, curve, s.n, get_number(all, i, "median"));
        }
    }
    const int status = report_draw(r, &plot);
    free(method);
    return status;
}

/* The row of a method and an engine, with a cell for each size. */
static void write_times(FILE *page, const results *all, int begin, int end, const char *method,
                        int e)
{
    sized wanted = {.n = 0};
    snprintf(wanted.engine, sizeof wanted.engine, "%s", engines[e][0]);
    snprintf(wanted.method, sizeof wanted.method, "%s", method);
    report_row(page, method);
    report_element(page, "td", engines[e][1]);
    for (int i = begin; i < end; i++) {
        if (!is_new(all, begin, i, true)) continue;
        wanted.n = parse_sized(all, i).n;
        report_number(page, "%.3g", find_time(all, begin, end, wanted));
    }
    fputs("</tr>\n", page);
}

/* A figure of each method; then the same as a table, a column for each size. */
static int write_sizes(report *r, const results *all, int begin, int end)
{
    int status = CLI_DONE;
    fputs("<div class=\"figures\">\n", r->page);
    for (int i = begin; i < end && status == CLI_DONE; i++)
        if (is_new(all, begin, i, false)) status = draw_sizes(r, all, begin, end, i);
    fputs("</div>\n" REPORT_TABLE "<th>method</th><th></th>", r->page);
    for (int i = begin; i < end; i++)
        if (is_new(all, begin, i, true)) fprintf(r->page, "<th>n = %d</th>", parse_sized(all, i).n);
    fputs(REPORT_ROWS, r->page);
    for (int i = begin; i < end; i++) {
        if (!is_new(all, begin, i, false)) continue;
        for (int e = 0; e < 2; e++)
            write_times(r->page, all, begin, end, parse_sized(all, i).method, e);
    }
    fputs(REPORT_TABLE_END, r->page);
    return status;
}

/* ---- runs ---------------------------------------------------------------------------------- */

static const struct {
    const char *name, *title;
} modes[] = {{"off", "off"},
             {"on", "on, empty cache"},
             {"warm", "on, full cache"},
             {"auto", "auto, empty cache"},
             {"auto_warm", "auto, full cache"}};

enum { MODES = sizeof modes / sizeof modes[0] };

static int draw_runs(report *r, const results *all, int begin, int end, int first)
{
    char name[MAX_WORD];
    const char *system = get_text(all, first, "system"), *method = get_text(all, first, "method");
    const char *slash = strrchr(system, '/');
    char *title = cli_format("%s, %s", slash ? slash + 1 : system, method);
    report_plot plot = {.name = name,
                        .title = title,
                        .xlabel = "seconds with --native off",
                        .ylabel = "seconds",
                        .caption = "",
                        .log_x = true,
                        .log_y = true,
                        .has_marks = true};
    snprintf(name, sizeof name, "runs-%d", first);
    for (int mode = 0; mode < MODES; mode++) {
        plot_curve *curve = report_curve(&plot, modes[mode].title);
        for (int i = begin; i < end; i++)
            if (strcmp(get_text(all, i, "system"), system) == 0 &&
                strcmp(get_text(all, i, "method"), method) == 0)
                report_point(&plot, curve, get_number(all, i, "off"),
                             get_number(all, i, modes[mode].name));
    }
    const int status = report_draw(r, &plot);
    free(title);
    return status;
}

static int write_runs(report *r, const results *all, int begin, int end)
{
    int status = CLI_DONE;
    fputs("<div class=\"figures\">\n", r->page);
    for (int i = begin; i < end && status == CLI_DONE; i++)
        if (i == begin || strcmp(get_text(all, i, "system"), get_text(all, i - 1, "system")) != 0 ||
            strcmp(get_text(all, i, "method"), get_text(all, i - 1, "method")) != 0)
            status = draw_runs(r, all, begin, end, i);
    fputs("</div>\n" REPORT_TABLE "<th>system</th><th>method</th><th>steps</th>", r->page);
    for (int mode = 0; mode < MODES; mode++) report_element(r->page, "th", modes[mode].title);
    fputs(REPORT_ROWS, r->page);
    for (int i = begin; i < end; i++) {
        report_row(r->page, get_text(all, i, "system"));
        report_element(r->page, "td", get_text(all, i, "method"));
        report_element(r->page, "td", get_text(all, i, "steps"));
        for (int mode = 0; mode < MODES; mode++)
            report_number(r->page, "%.3g s", get_number(all, i, modes[mode].name));
        fputs("</tr>\n", r->page);
    }
    fputs(REPORT_TABLE_END, r->page);
    return status;
}

/* ---- the page ------------------------------------------------------------------------------ */

static void write_facts(FILE *page, const results *all, int i)
{
    static const char *const facts[][2] = {{"processor", "processor"},
                                           {"processors", "processors"},
                                           {"load", "load before"},
                                           {"system", "system"},
                                           {"compiler", "compiler"},
                                           {"measured", "measured"},
                                           {"processes", "processes of each side"}};
    fputs("<dl class=\"facts\">\n", page);
    for (size_t k = 0; k < sizeof facts / sizeof facts[0]; k++) {
        if (!get(all, i, facts[k][0])) continue;
        report_element(page, "dt", facts[k][1]);
        report_element(page, "dd", get_text(all, i, facts[k][0]));
    }
    fputs("</dl>\n", page);
}

/* Writes a section; *i becomes the line after it. */
static int write_section(report *r, const results *all, int *i)
{
    const int section = *i, begin = section + 1;
    const char *figure = get_text(all, section, "figure");
    const bool has_runs = strcmp(figure, "runs") == 0;
    const int end = find_end(all, begin, has_runs ? "method" : "case");
    *i = end;
    report_element(r->page, "h2", get_text(all, section, "section"));
    report_element(r->page, "p", get_text(all, section, "text"));
    fputc('\n', r->page);
    if (end == begin) return CLI_DONE;
    if (has_runs) return write_runs(r, all, begin, end);
    if (strcmp(figure, "sizes") == 0) return write_sizes(r, all, begin, end);
    int status = CLI_DONE, first = begin;
    while (first < end && !get(all, first, "median")) first++;
    fputs("<div class=\"figures\">\n", r->page);
    if (first < end) status = draw_ratios(r, all, section, begin, end);
    fputs("</div>\n", r->page);
    write_ratios(r->page, all, begin, end);
    return status;
}

static int write_page(report *r)
{
    const results *all = r->user;
    int status = CLI_DONE;
    report_title(r, "The bench of dalembert");
    fputs(
        "<p>What a step costs, compared side by side: each side is a program with its best flags, "
        "run "
        "alternately with the other in fresh processes, and both reach the same end state. A "
        "number is the "
        "median over these processes, its spread the smallest and the largest. Time is processor "
        "time of the process, unless a text says otherwise.</p>\n",
        r->page);
    for (int i = 0; i < all->count && status == CLI_DONE;) {
        if (get(all, i, "section"))
            status = write_section(r, all, &i);
        else if (get(all, i, "processor"))
            write_facts(r->page, all, i++);
        else
            status = cli_fail(CLI_USAGE, "%s: it is no result of a section", all->place[i]);
    }
    return status;
}

int main(int argc, char **argv)
{
    static results all;
    report r = {.directory = argv[1], .user = &all};
    if (argc < 3) return cli_fail(CLI_USAGE, "page: DIR and RESULTS are required");
    int status = file_make_directory(argv[1]);
    for (int i = 2; i < argc && status == CLI_DONE; i++) status = read_results(&all, argv[i]);
    if (status == CLI_DONE) status = report_make(&r, write_page);
    if (status == CLI_DONE) printf("%s\n", r.page_path);
    for (int i = 0; i < all.count; i++) {
        yaml_document_delete(&all.line[i].yaml);
        free(all.place[i]);
    }
    free(r.place);
    free(r.page_path);
    return status;
}
