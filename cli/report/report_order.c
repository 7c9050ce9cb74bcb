/* report_order.c - the page of what `dalembert order --output DIR` found: for every method the
 * order and its errors, and the error over the step and over the work. */
#include "io/output.h"
#include "report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct orders {
    report *r;
    report_csv csv;
    report_words methods, steps; /* methods: those that have errors */
} orders;

static const char *get(const orders *o, int row, const char *head)
{
    return report_csv_get(&o->csv, row, head);
}

/* The row of a method, of one step unless that is NULL; -1: there is none. */
static int find(const orders *o, const char *method, const char *step)
{
    for (int row = 1; row < o->csv.rows; row++)
        if (strcmp(get(o, row, "integrator"), method) == 0 &&
            (!step || strcmp(get(o, row, "step"), step) == 0))
            return row;
    return -1;
}

/* ---- the table ---- */

static void put_number(FILE *page, const char *format, const char *text)
{
    fputs("<td>", page);
    if (text[0])
        fprintf(page, format, strtod(text, NULL));
    else
        fputs("–", page);
    fputs("</td>", page);
}

static void put_method(const orders *o, const char *method)
{
    FILE *page = o->r->page;
    const int first = find(o, method, NULL);
    fputs("<tr>", page);
    report_element(page, "th scope=\"row\"", method);
    put_number(page, "%g", get(o, first, "stated_order"));
    put_number(page, "%.2f", get(o, first, "observed_order"));
    for (int h = 0; h < o->steps.count; h++) {
        const int row = find(o, method, o->steps.word[h]);
        put_number(page, "%.1e", row < 0 ? "" : get(o, row, "error"));
    }
    fputs("</tr>\n", page);
}

static void put_table(const orders *o)
{
    FILE *page = o->r->page;
    fputs("<div class=\"wide\" tabindex=\"0\"><table><thead><tr><td></td><th>order, stated</th>"
          "<th>order, found</th>",
          page);
    for (int h = 0; h < o->steps.count; h++)
        fprintf(page, "<th>h = %g</th>", strtod(o->steps.word[h], NULL));
    fputs("</tr></thead>\n<tbody>", page);
    for (int m = 0; m < o->methods.count; m++) put_method(o, o->methods.word[m]);
    fputs("</tbody></table></div>\n<p>An order is found where two successive slopes of the error "
          "agree.</p>\n",
          page);
}

/* Methods that cannot serve the system, and why. */
static void put_others(const orders *o)
{
    FILE *page = o->r->page;
    int count = 0;
    for (int row = 1; row < o->csv.rows; row++) count += get(o, row, "message")[0] != '\0';
    if (count == 0) return;
    fputs("<details><summary>methods without errors</summary>\n<ul>\n", page);
    for (int row = 1; row < o->csv.rows; row++) {
        if (!get(o, row, "message")[0]) continue;
        fputs("<li>", page);
        report_text(page, get(o, row, "integrator"));
        fputs(": ", page);
        report_text(page, get(o, row, "message"));
        fputs("</li>\n", page);
    }
    fputs("</ul></details>\n", page);
}

/* ---- figures ---- */

/* What the error is drawn over: column, file name, title, label of the axis, caption */
static const struct {
    const char *column, *name, *title, *xlabel, *caption;
} figures[] = {
    {"step", "order", "Order", "step h", "A method of order p is a line of slope p."},
    {"evaluations", "work", "Work and precision", "evaluations of F",
     "Lower left is better: less error for less work."},
    {"seconds", "time", "Time and precision", "seconds of processor time",
     "Lower left is better: less error in less time."},
};

static int draw(const orders *o, int k, int part)
{
    report_plot plot = {.log_x = 1, .log_y = 1, .marks = 1, .ylabel = "error"};
    const int first = part * PLOT_CURVES;
    plot.caption = figures[k].caption;
    snprintf(plot.name, sizeof plot.name, part ? "%s-%d" : "%s", figures[k].name, part + 1);
    snprintf(plot.title, sizeof plot.title, "%s", figures[k].title);
    snprintf(plot.xlabel, sizeof plot.xlabel, "%s", figures[k].xlabel);
    for (int m = first; m < o->methods.count && m < first + PLOT_CURVES; m++) {
        report_curve(&plot, o->methods.word[m]);
        for (int row = 1; row < o->csv.rows; row++)
            if (strcmp(get(o, row, "integrator"), o->methods.word[m]) == 0)
                report_point(&plot, report_csv_number(&o->csv, row, figures[k].column),
                             report_csv_number(&o->csv, row, "error"));
    }
    return report_draw(o->r, &plot);
}

static int draw_all(const orders *o)
{
    int status = CLI_DONE;
    fputs("<div class=\"figures\">\n", o->r->page);
    for (int part = 0; part * PLOT_CURVES < o->methods.count; part++)
        for (size_t k = 0; k < sizeof figures / sizeof figures[0] && status == CLI_DONE; k++)
            status = draw(o, (int)k, part);
    fputs("</div>\n", o->r->page);
    return status;
}

/* ---- the page ---- */

static int write_page(const orders *o)
{
    char title[PLOT_NAME];
    snprintf(title, sizeof title, "%.120s: order, work and precision", get(o, 1, "label"));
    report_title(o->r, title);
    put_table(o);
    put_others(o);
    fputs("<h2>Figures</h2>\n", o->r->page);
    return draw_all(o);
}

int report_order(report *r)
{
    orders *o = cli_calloc(1, sizeof *o);
    char *path = cli_join(r->directory, "order.csv");
    int status = report_csv_read(&o->csv, path);
    for (int row = 1; status == CLI_DONE && row < o->csv.rows; row++) {
        if (!report_csv_get(&o->csv, row, "error")[0]) continue;
        report_add_word(&o->methods, report_csv_get(&o->csv, row, "integrator"));
        report_add_word(&o->steps, report_csv_get(&o->csv, row, "step"));
    }
    if (status == CLI_DONE && o->csv.rows < 2)
        status = cli_fail(CLI_USAGE, "'%s' has no rows", path);
    if (status == CLI_DONE) {
        o->r = r;
        status = write_page(o);
    }
    report_csv_free(&o->csv);
    free(o);
    free(path);
    return status;
}
