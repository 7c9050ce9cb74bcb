/* report_order.c - the page of `dalembert order --output DIR`: what is compared with what, order,
 * errors and cost of every method, and the error over step and work. */
#include "report_order.h"

#include "io/csv_table.h"
#include "io/file.h"
#include "report_cells.h"
#include "report_family.h"
#include "report_plot.h"
#include "report_results.h"
#include "report_system.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct order_page {
    report *r;
    csv_table csv;
    report_results results;
    csv_words methods, steps; /* methods that have errors */
} order_page;

/* The row of a method, and of a step unless that is NULL; 0: there is none. */
static int find_row(const order_page *o, const char *method, const char *step)
{
    for (int row = 1; row < o->csv.rows; row++)
        if (csv_table_is(&o->csv, row, "integrator", method) &&
            (!step || csv_table_is(&o->csv, row, "step", step)))
            return row;
    return 0;
}

/* T, the space and the reference are in order.json. */
static void write_facts(const order_page *o)
{
    FILE *page = o->r->page;
    const char *method = results_text(&o->results, "reference", "integrator");
    const char *time = results_text(&o->results, "request", "time");
    const char *tolerance = results_text(&o->results, "reference", "tolerance");
    results_begin_facts(page, &o->results);
    if (!o->results.root) {
        const double steps = csv_table_number(&o->csv, 1, "steps");
        fprintf(page, "<dt>time T</dt><dd>%.9g</dd>\n",
                steps * csv_table_number(&o->csv, 1, "step"));
    } else {
        fputs("<dt>error</dt><dd>largest difference in q and v at t = ", page);
        report_text(page, time);
        fputs(method[0] ? " from " : " from the exact solution", page);
        report_text(page, method);
        if (method[0])
            fprintf(
                page, " with %s = %.6g, itself within %.0e", tolerance[0] ? "tolerance" : "h",
                strtod(tolerance[0] ? tolerance : results_text(&o->results, "reference", "step"),
                       NULL),
                strtod(results_text(&o->results, "reference", "error"), NULL));
        fputs("</dd>\n", page);
    }
    fputs(REPORT_FACTS_END, page);
}

/* The orders, errors and the cost of a step of the methods that have errors. */
static void write_orders_table(const order_page *o)
{
    FILE *page = o->r->page;
    char title[STUDY_DIVISION];
    fputs(REPORT_TABLE "<td></td><th>order, stated</th><th>order, found</th>", page);
    for (int h = 0; h < o->steps.count; h++)
        report_element(page, "th", step_title(title, o->steps.word[h]));
    fputs("<th>evalu&shy;ations of F a step</th><th>µs a step</th>" REPORT_ROWS, page);
    for (int m = 0; m < o->methods.count; m++) {
        const int first = find_row(o, o->methods.word[m], NULL);
        report_row(page, o->methods.word[m]);
        report_number(page, "%g", csv_table_number(&o->csv, first, "stated_order"));
        report_number(page, "%.2f", csv_table_number(&o->csv, first, "observed_order"));
        for (int h = 0; h < o->steps.count; h++) {
            const int row = find_row(o, o->methods.word[m], o->steps.word[h]);
            report_number(page, "%.1e", row > 0 ? csv_table_number(&o->csv, row, "error") : NAN);
        }
        /* At the smallest step, as the command prints it. */
        const int last = find_row(o, o->methods.word[m], o->steps.word[o->steps.count - 1]);
        const double steps = last > 0 ? csv_table_number(&o->csv, last, "steps") : NAN;
        report_number(page, "%.1f", csv_table_number(&o->csv, last, "evaluations") / steps);
        report_number(page, "%.2f", 1e6 * csv_table_number(&o->csv, last, "seconds") / steps);
        fputs("</tr>\n", page);
    }
    fputs(REPORT_TABLE_END
          "<p>An order is found where two successive slopes of the error agree.</p>\n",
          page);
}

/* The methods that do not apply to the system, or failed, and why. */
static void write_failures(const order_page *o)
{
    FILE *page = o->r->page;
    int failures = 0;
    for (int row = 1; row < o->csv.rows; row++) {
        if (csv_table_is(&o->csv, row, "message", "")) continue;
        fputs(failures++ ? "" : "<details><summary>methods without errors</summary>\n<ul>\n", page);
        fputs("<li>", page);
        report_text(page, csv_table_get(&o->csv, row, "integrator"));
        fputs(": ", page);
        report_text(page, csv_table_get(&o->csv, row, "message"));
        fputs("</li>\n", page);
    }
    if (failures > 0) fputs("</ul></details>\n", page);
}

/* The error of some methods over a column; suffix distinguishes the files. */
static int draw_errors(const order_page *o, int figure, const csv_words *methods,
                       const char *suffix)
{
    static const struct {
        const char *column, *name, *title, *xlabel, *caption;
    } figures[] = {
        {"step", "order", "Order", "step h", "A method of order p is a line of slope p."},
        {"evaluations", "work", "Work and precision", "evaluations of F",
         "Lower left is better: less error for less work."},
        {"seconds", "time", "Time and precision", "seconds of processor time",
         "Lower left is better: less error in less time."},
        {"tolerance", "tolerance", "Tolerance", "tolerance",
         "An error that follows the tolerance is a line of slope 1."},
    };
    enum { FIGURES = sizeof figures / sizeof figures[0] };
    const bool is_controlled = step_tolerance(o->steps.word[0]) > 0.0;
    char name[PLOT_NAME];
    if (figure == 0 && is_controlled) figure = FIGURES - 1;
    report_plot plot = {.name = name,
                        .title = figures[figure].title,
                        .xlabel = figures[figure].xlabel,
                        .ylabel = "error",
                        .caption = figures[figure].caption,
                        .log_x = true,
                        .log_y = true,
                        .has_marks = true};
    snprintf(name, sizeof name, "%s%s", figures[figure].name, suffix);
    for (int m = 0; m < methods->count; m++) {
        plot_curve *curve = report_curve(&plot, methods->word[m]);
        for (int row = 1; row < o->csv.rows; row++)
            if (csv_table_is(&o->csv, row, "integrator", methods->word[m]))
                report_point(&plot, curve, csv_table_number(&o->csv, row, figures[figure].column),
                             csv_table_number(&o->csv, row, "error"));
    }
    return report_draw(o->r, &plot);
}

static int draw_methods(const order_page *o, const csv_words *methods, const char *suffix)
{
    int status = CLI_DONE;
    fputs("<div class=\"figures\">\n", o->r->page);
    for (int figure = 0; figure < 3 && status == CLI_DONE; figure++)
        status = draw_errors(o, figure, methods, suffix);
    fputs("</div>\n", o->r->page);
    return status;
}

/* The members of a family, folded, PLOT_METHODS at a time. */
static int draw_family(const order_page *o, method_family family)
{
    csv_words some = {.count = 0};
    int status = CLI_DONE, figures = 0, found = 0;
    for (int m = 0; m < o->methods.count && status == CLI_DONE; m++) {
        char suffix[32];
        if (method_family_of(o->methods.word[m]) != family) continue;
        if (found++ == 0)
            fprintf(o->r->page, "<details><summary>%s</summary>\n", method_family_name[family]);
        csv_add_word(&some, o->methods.word[m]);
        if (some.count < PLOT_METHODS) continue;
        snprintf(suffix, sizeof suffix, "-%d-%d", (int)family + 1, ++figures);
        status = draw_methods(o, &some, suffix);
        some.count = 0;
    }
    char suffix[32];
    snprintf(suffix, sizeof suffix, "-%d-%d", (int)family + 1, figures + 1);
    if (status == CLI_DONE && some.count > 0) status = draw_methods(o, &some, suffix);
    if (found > 0) fputs("</details>\n", o->r->page);
    return status;
}

/* All methods in the figures; of many one of each family, and each family in figures of its own. */
static int draw_figures(const order_page *o)
{
    csv_words members = {.count = 0}, none = {.count = 0};
    report_heading(o->r, "figures", "Figures");
    if (o->methods.count <= PLOT_METHODS) return draw_methods(o, &o->methods, "");
    method_family_members(&o->methods, &none, &members);
    fputs("<p>One method of each family; all of them below.</p>\n", o->r->page);
    int status = draw_methods(o, &members, "");
    for (int family = 0; family < METHOD_FAMILIES && status == CLI_DONE; family++)
        status = draw_family(o, (method_family)family);
    return status;
}

int report_order(report *r)
{
    order_page *o = cli_calloc(1, sizeof *o);
    char *path = cli_join(r->directory, "order.csv");
    o->r = r;
    int status = results_read(&o->results, r->directory, "order");
    if (status == CLI_DONE) status = read_steps(&o->csv, path);
    if (status == CLI_DONE && o->csv.rows < 2)
        status = cli_fail(CLI_USAGE, "'%s' has no rows", path);
    for (int row = 1; status == CLI_DONE && row < o->csv.rows; row++) {
        if (csv_table_is(&o->csv, row, "error", "")) continue;
        csv_add_word(&o->methods, csv_table_get(&o->csv, row, "integrator"));
        csv_add_word(&o->steps, csv_table_get(&o->csv, row, "step"));
    }
    if (status == CLI_DONE) {
        char *title = cli_format("%s: order, work and precision",
                                 results_title(&o->results, csv_table_get(&o->csv, 1, "label")));
        report_title(r, title);
        free(title);
        if (o->methods.count > 0)
            write_orders_table(o);
        else
            fputs("<p>No method has errors to show.</p>\n", r->page);
        write_failures(o);
        write_facts(o);
        if (o->methods.count > 0) status = draw_figures(o);
        report_file(r, "order.json", "what it was made with: order.json");
    }
    csv_table_free(&o->csv);
    results_free(&o->results);
    free(o);
    free(path);
    return status;
}
