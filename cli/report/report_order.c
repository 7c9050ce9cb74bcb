/* report_order.c - the page of `dalembert order --output DIR`: the order and the errors of every
 * method, and the error over step and work. */
#include "report_order.h"

#include "io/file.h"
#include "report_csv.h"
#include "report_plot.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct order_page {
    report *r;
    report_csv csv;
    report_words methods, steps; /* methods that have errors */
} order_page;

/* The row of a method, and of a step unless that is NULL; 0: there is none. */
static int find_row(const order_page *o, const char *method, const char *step)
{
    for (int row = 1; row < o->csv.rows; row++)
        if (report_csv_is(&o->csv, row, "integrator", method) &&
            (!step || report_csv_is(&o->csv, row, "step", step)))
            return row;
    return 0;
}

/* The orders and errors, then the methods that do not apply to the system, or failed, and why. */
static void write_orders_table(const order_page *o)
{
    FILE *page = o->r->page;
    int failures = 0;
    fputs(REPORT_TABLE "<td></td><th>order, stated</th><th>order, found</th>", page);
    for (int h = 0; h < o->steps.count; h++)
        fprintf(page, "<th>h = %g</th>", strtod(o->steps.word[h], NULL));
    fputs(REPORT_ROWS, page);
    for (int m = 0; m < o->methods.count; m++) {
        const int first = find_row(o, o->methods.word[m], NULL);
        report_row(page, o->methods.word[m]);
        report_number(page, "%g", report_csv_number(&o->csv, first, "stated_order"));
        report_number(page, "%.2f", report_csv_number(&o->csv, first, "observed_order"));
        for (int h = 0; h < o->steps.count; h++) {
            const int row = find_row(o, o->methods.word[m], o->steps.word[h]);
            report_number(page, "%.1e", row > 0 ? report_csv_number(&o->csv, row, "error") : NAN);
        }
        fputs("</tr>\n", page);
    }
    fputs(REPORT_TABLE_END
          "<p>An order is found where two successive slopes of the error agree.</p>\n",
          page);
    for (int row = 1; row < o->csv.rows; row++) {
        if (report_csv_is(&o->csv, row, "message", "")) continue;
        fputs(failures++ ? "" : "<details><summary>methods without errors</summary>\n<ul>\n", page);
        fputs("<li>", page);
        report_text(page, report_csv_get(&o->csv, row, "integrator"));
        fputs(": ", page);
        report_text(page, report_csv_get(&o->csv, row, "message"));
        fputs("</li>\n", page);
    }
    if (failures > 0) fputs("</ul></details>\n", page);
}

/* The error of some methods over a column. */
static int draw_errors(const order_page *o, int figure, int part)
{
    static const struct {
        const char *column, *name, *title, *xlabel, *caption;
    } figures[] = {
        {"step", "order", "Order", "step h", "A method of order p is a line of slope p."},
        {"evaluations", "work", "Work and precision", "evaluations of F",
         "Lower left is better: less error for less work."},
        {"seconds", "time", "Time and precision", "seconds of processor time",
         "Lower left is better: less error in less time."},
    };
    char name[PLOT_NAME];
    report_plot plot = {.name = name,
                        .title = figures[figure].title,
                        .xlabel = figures[figure].xlabel,
                        .ylabel = "error",
                        .caption = figures[figure].caption,
                        .log_x = true,
                        .log_y = true,
                        .has_marks = true};
    const int first = part * PLOT_CURVES;
    snprintf(name, sizeof name, part ? "%s-%d" : "%s", figures[figure].name, part + 1);
    for (int m = first; m < o->methods.count && m < first + PLOT_CURVES; m++) {
        plot_curve *curve = report_curve(&plot, o->methods.word[m]);
        for (int row = 1; row < o->csv.rows; row++)
            if (report_csv_is(&o->csv, row, "integrator", o->methods.word[m]))
                report_point(&plot, curve, report_csv_number(&o->csv, row, figures[figure].column),
                             report_csv_number(&o->csv, row, "error"));
    }
    return report_draw(o->r, &plot);
}

int report_order(report *r)
{
    order_page *o = cli_calloc(1, sizeof *o);
    char *path = cli_join(r->directory, "order.csv"), title[PLOT_NAME];
    o->r = r;
    int status = report_csv_read(&o->csv, path);
    if (status == CLI_DONE && o->csv.rows < 2)
        status = cli_fail(CLI_USAGE, "'%s' has no rows", path);
    for (int row = 1; status == CLI_DONE && row < o->csv.rows; row++) {
        if (report_csv_is(&o->csv, row, "error", "")) continue;
        report_add_word(&o->methods, report_csv_get(&o->csv, row, "integrator"));
        report_add_word(&o->steps, report_csv_get(&o->csv, row, "step"));
    }
    if (status == CLI_DONE) {
        snprintf(title, sizeof title, "%.120s: order, work and precision",
                 report_csv_get(&o->csv, 1, "label"));
        report_title(r, title);
        write_orders_table(o);
        fputs("<h2>Figures</h2>\n<div class=\"figures\">\n", r->page);
        for (int part = 0; part * PLOT_CURVES < o->methods.count; part++)
            for (int figure = 0; figure < 3 && status == CLI_DONE; figure++)
                status = draw_errors(o, figure, part);
        fputs("</div>\n", r->page);
    }
    report_csv_free(&o->csv);
    free(o);
    free(path);
    return status;
}
