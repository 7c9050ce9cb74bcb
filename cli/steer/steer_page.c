/* steer_page.c - the page of a search between two states: what was found, and the inputs, on the
 * page of the run of the cheapest motion; without a run, how far the nearest one is. */
#include "steer_page.h"
#include "dalembert_program.h"
#include "io/csv_table.h"
#include "io/file.h"
#include "io/json.h"
#include "report/report_plot.h"
#include "report/report_run.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/screen.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A number of an object, NaN where there is none. */
static double member_number(const document *doc, const yaml_node_t *node, const char *name)
{
    const char *text = json_scalar(doc, node, name);
    double x;
    return dal__parse_number(text, strlen(text), &x) == DAL_STATUS_OK ? x : NAN;
}

/* Whether the target is reached, then a table of the motions. */
static void write_motions(report *r)
{
    static const char *const names[] = {"S",          "distance", "residual",        "max_D",
                                        "iterations", "rank",     "conjugate_times", "condition"};
    const document *doc = r->user;
    const yaml_node_t *root = document_node(doc, 1);
    yaml_node_t *motions = document_value(doc, root, "motions");
    const bool is_list = motions && motions->type == YAML_SEQUENCE_NODE;
    const int count = is_list ? document_count(motions) : 0;
    const yaml_node_t *best = count > 0 ? document_item(doc, motions, 0) : NULL;
    const bool is_found =
        count > 0 && strcmp(json_scalar(doc, best, "status"), dal_status_name(DAL_STATUS_OK)) == 0;
    fputs("<p><strong>", r->page);
    if (is_found)
        fprintf(r->page, "Reaches the target at t = %.6g for S = %.9g, within %.2g.",
                member_number(doc, root, "to"), member_number(doc, best, "S"),
                member_number(doc, best, "distance"));
    else if (isfinite(member_number(doc, best, "distance")))
        fprintf(r->page, "Ends %.3g from the target.", member_number(doc, best, "distance"));
    else
        fputs("Is not led to the target.", r->page);
    fputs("</strong> ", r->page);
    if (!is_found && count > 0) report_text(r->page, json_scalar(doc, best, "message"));
    fputs("</p>\n" REPORT_TABLE "<td>motion</td>", r->page);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        report_element(r->page, "th", names[i]);
    fputs(REPORT_ROWS, r->page);
    for (int k = 0; k < count; k++) {
        char name[16];
        const yaml_node_t *motion = document_item(doc, motions, k);
        snprintf(name, sizeof name, "%d", k + 1);
        report_row(r->page, name);
        for (size_t i = 0; i < sizeof names / sizeof *names; i++)
            report_number(r->page, "%.6g", member_number(doc, motion, names[i]));
        fputs("</tr>\n", r->page);
    }
    fputs(REPORT_TABLE_END, r->page);
}

static int draw_inputs(report *r)
{
    csv_table csv = {.text = NULL};
    char *path = cli_join(r->directory, "inputs.csv");
    int status = file_exists(path) ? csv_table_read(&csv, path) : CLI_DONE;
    if (status == CLI_DONE && csv.rows > 0) status = csv_table_require(&csv, path, "t");
    if (status == CLI_DONE && csv.rows > 1) {
        report_plot plot = {.name = "inputs",
                            .title = "Inputs",
                            .xlabel = "t",
                            .ylabel = "u",
                            .caption =
                                "What is added to the forces, by the columns of controls, or "
                                "to the accelerations.",
                            .zero_text = "The inputs are 0 at all steps."};
        for (int k = 0; k < csv.columns; k++) {
            if (csv_table_is(&csv, 0, csv.cell[k], "t") || plot.count == PLOT_CURVES) continue;
            plot_curve *curve = report_curve(&plot, csv.cell[k]);
            for (int row = 1; row < csv.rows; row++)
                report_point(&plot, curve, csv_table_number(&csv, row, "t"),
                             csv_table_number(&csv, row, csv.cell[k]));
        }
        for (int i = 0; i < plot.count; i++)
            if (plot.curve[i].max_abs != 0.0) plot.zero_text = NULL;
        status = report_draw(r, &plot);
    }
    csv_table_free(&csv);
    free(path);
    return status;
}

int steer_write_page(report *r)
{
    document doc;
    char *path = cli_join(r->directory, "steer.json");
    char *rows = cli_join(r->directory, "trajectory.npy");
    int status = json_read(&doc, path, path);
    if (status == CLI_DONE) {
        r->user = &doc;
        r->begin = write_motions;
        r->draw = draw_inputs;
        if (file_exists(rows)) {
            status = report_run(r);
        } else {
            report_title(r, "A search between two states");
            write_motions(r);
        }
        report_file(r, "steer.json", "what was found: steer.json");
    }
    yaml_document_delete(&doc.yaml);
    free(rows);
    free(path);
    return status;
}
