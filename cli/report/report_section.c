/* report_section.c - the pages of `section`, `lyapunov` and `volume`, which have NAME.csv and
 * NAME.json in their directory: what was done and how, crossings in the plane of two columns, or
 * the means so far over t. */
#include "report_section.h"

#include "io/csv_table.h"
#include "io/file.h"
#include "report_plot.h"
#include "report_results.h"
#include "report_system.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Of more crossings every k-th is drawn. */
enum { MAX_POINTS = 3000 };

/* The columns of the figure: those that the command chose, or the last two. */
static void find_axes(const csv_table *csv, const report_results *results, const char *axis[2])
{
    yaml_node_t *axes = results->root ? document_value(&results->doc, results->root, "axes") : NULL;
    for (int i = 0; i < 2; i++) {
        axis[i] = csv->cell[csv->columns - 2 + i];
        if (!axes || document_count(axes) != 2) continue;
        const char *name =
            document_scalar(&results->doc, document_item(&results->doc, axes, i), "axes");
        if (name && csv_table_is(csv, 0, name, name)) axis[i] = name;
    }
}

static int draw_crossings(report *r, const csv_table *csv, const report_results *results)
{
    static const struct {
        const char *title, *direction;
    } sides[] = {{"upwards", "1"}, {"downwards", "-1"}};
    const int crossings = csv->rows - 1, stride = 1 + crossings / MAX_POINTS;
    const char *axis[2];
    char caption[64] = "";
    find_axes(csv, results, axis);
    report_plot plot = {.name = "section",
                        .title = "Section",
                        .xlabel = axis[0],
                        .ylabel = axis[1],
                        .caption = caption};
    if (stride > 1) snprintf(caption, sizeof caption, "Each %d-th of the crossings.", stride);
    for (int side = 0; side < 2; side++) {
        plot_curve *curve = NULL;
        for (int row = 1; row < csv->rows; row += stride) {
            if (!csv_table_is(csv, row, "direction", sides[side].direction)) continue;
            if (!curve) curve = report_curve(&plot, sides[side].title);
            curve->has_dots = true;
            report_point(&plot, curve, csv_table_number(csv, row, axis[0]),
                         csv_table_number(csv, row, axis[1]));
        }
    }
    report_heading(r, "figure", "Figure");
    fputs("<div class=\"figures\">\n", r->page);
    const int status = report_draw(r, &plot);
    fputs("</div>\n", r->page);
    return status;
}

static void write_counts(report *r, const csv_table *csv)
{
    int up = 0;
    for (int row = 1; row < csv->rows; row++) up += csv_table_is(csv, row, "direction", "1");
    fprintf(r->page, "<p class=\"lead\">%d crossings: %d upwards, %d downwards", csv->rows - 1, up,
            csv->rows - 1 - up);
    if (csv->rows > 1)
        fprintf(r->page, ", from t = %.6g to t = %.6g", csv_table_number(csv, 1, "t"),
                csv_table_number(csv, csv->rows - 1, "t"));
    fputs(".</p>\n", r->page);
}

int report_section(report *r)
{
    csv_table csv = {.text = NULL};
    report_results results;
    char *path = cli_join(r->directory, "section.csv");
    int status = results_read(&results, r->directory, "section");
    if (status == CLI_DONE) status = csv_table_read(&csv, path);
    if (status == CLI_DONE) status = csv_table_require(&csv, path, "t");
    if (status == CLI_DONE) status = csv_table_require(&csv, path, "direction");
    if (status == CLI_DONE) {
        const char *on = results_text(&results, "request", "on");
        char *title = cli_format("%s: section", results_title(&results, "A motion"));
        report_title(r, title);
        free(title);
        write_counts(r, &csv);
        if (csv.rows > 1) status = draw_crossings(r, &csv, &results);
        results_begin_facts(r->page, &results);
        if (on[0]) report_fact(r->page, "section", on);
        fputs(REPORT_FACTS_END, r->page);
        report_file(r, "section.json", "what it was made with: section.json");
    }
    csv_table_free(&csv);
    results_free(&results);
    free(path);
    return status;
}

/* ---- means --------------------------------------------------------------------------------- */

static void write_means(report *r, const csv_table *csv)
{
    FILE *page = r->page;
    report_heading(r, "means", "Means, per unit of t");
    fputs(REPORT_TABLE "<td></td><th>mean</th>" REPORT_ROWS, page);
    for (int k = 0; k < csv->columns; k++) {
        if (csv_table_is(csv, 0, csv->cell[k], "t")) continue;
        report_row(page, csv->cell[k]);
        report_number(page, "%.6g", csv_table_number(csv, csv->rows - 1, csv->cell[k]));
        fputs("</tr>\n", page);
    }
    fputs(REPORT_TABLE_END, page);
}

/* As many as a figure has colours for, the largest first, and the last, which is the divergence. */
static int draw_means(report *r, const char *name, const csv_table *csv)
{
    const bool has_more = csv->columns - 1 > PLOT_CURVES;
    report_plot plot = {.name = name,
                        .title = "Means so far",
                        .xlabel = "t",
                        .ylabel = "mean so far",
                        .caption = has_more ? "The largest exponents, and the divergence." : ""};
    for (int k = 0; k < csv->columns; k++) {
        if (csv_table_is(csv, 0, csv->cell[k], "t")) continue;
        if (plot.count >= PLOT_CURVES - 1 && k != csv->columns - 1) continue;
        plot_curve *curve = report_curve(&plot, csv->cell[k]);
        for (int row = 1; row < csv->rows; row++)
            report_point(&plot, curve, csv_table_number(csv, row, "t"),
                         csv_table_number(csv, row, csv->cell[k]));
    }
    report_heading(r, "figure", "Figure");
    fputs("<div class=\"figures\">\n", r->page);
    const int status = report_draw(r, &plot);
    fputs("</div>\n", r->page);
    return status;
}

static int write_means_page(report *r, const char *name, const char *what)
{
    csv_table csv = {.text = NULL};
    report_results results;
    char *path = cli_format("%s/%s.csv", r->directory, name);
    int status = results_read(&results, r->directory, name);
    if (status == CLI_DONE) status = csv_table_read(&csv, path);
    if (status == CLI_DONE) status = csv_table_require(&csv, path, "t");
    if (status == CLI_DONE) status = csv_table_require(&csv, path, "divergence");
    if (status == CLI_DONE) {
        char *title = cli_format("%s: %s", results_title(&results, "A motion"), what);
        char *json = cli_format("%s.json", name);
        report_title(r, title);
        if (csv.rows > 1) {
            write_means(r, &csv);
            status = draw_means(r, name, &csv);
        }
        results_begin_facts(r->page, &results);
        fputs(REPORT_FACTS_END, r->page);
        report_file(r, json, "what it was made with");
        free(json);
        free(title);
    }
    csv_table_free(&csv);
    results_free(&results);
    free(path);
    return status;
}

int report_lyapunov(report *r) { return write_means_page(r, "lyapunov", "Lyapunov exponents"); }

int report_volume(report *r) { return write_means_page(r, "volume", "volume of the phase space"); }
