/* report_matrix.c - the tables of a study: sizes and trends, methods against systems; and predicted
 * sizes beside measured ones, with their figure. */
#include "report_matrix.h"
#include "dalembert_method.h"
#include "ui/memory.h"

#include "report_family.h"
#include "report_plot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A column of the tables: a label at a step. */
typedef struct table_column {
    const char *label, *step;
    bool is_alone; /* the only step of its label */
} table_column;

typedef struct table_columns {
    table_column at[CSV_WORDS];
    int count;
} table_columns;

static void add_column(table_columns *all, const char *label, const char *step)
{
    bool is_alone = true;
    for (int i = 0; i < all->count; i++) {
        if (strcmp(all->at[i].label, label) != 0) continue;
        if (strcmp(all->at[i].step, step) == 0) return;
        is_alone = all->at[i].is_alone = false;
    }
    if (all->count < CSV_WORDS) all->at[all->count++] = (table_column){label, step, is_alone};
}

static bool has_value(const study_page *s, const table_column *column, const quantity *t)
{
    for (int row = 1; row < s->cells.rows; row++)
        if (is_cell(s, row, "label", column->label) && is_cell(s, row, "step", column->step) &&
            is_shown(s, row, t) && !is_cell(s, row, t->value, ""))
            return true;
    return false;
}

static void write_trend_cell(const study_page *s, int row, const quantity *t)
{
    FILE *page = s->r->page;
    const double x = row > 0 ? csv_table_number(&s->cells, row, t->value) : NAN;
    if (row > 0 && is_cell(s, row, "state", "failed"))
        report_trend(page, "", "failed", x, "");
    else if (isnan(x))
        fputs("<td>–</td>", page);
    else
        report_trend(page, get_cell(s, row, t->size), get_cell(s, row, t->trend), x, "");
}

/* Begins a row, with what it may be sorted by. */
static void write_method(FILE *page, const char *name)
{
    dal_method method;
    dal_error error;
    const int order = dal_method_parse(&method, name, &error) ? 0 : dal_method_order(&method);
    fprintf(page, "<tr data-family=\"%s\" data-order=\"%d\">",
            method_family_name[method_family_of(name)], order);
    report_element(page, "th scope=\"row\"", name);
}

/* The full name of a label, "line: a point on a line", as the title of its short one. */
static void write_names(const study_page *s, const char *label)
{
    FILE *page = s->r->page;
    int i = 0;
    while (strcmp(s->labels.word[i], label) != 0) i++;
    fputs(" title=\"", page);
    report_text(page, label);
    if (strcmp(label, s->title[i]) != 0) {
        fputs(": ", page);
        report_text(page, s->title[i]);
    }
    fputs("\">", page);
    report_text(page, s->short_name[i]);
}

/* Labels without a value and methods that apply to none of the others are left out. */
static void write_matrix(const study_page *s, const table_columns *all, const quantity *t)
{
    FILE *page = s->r->page;
    char title[STUDY_DIVISION];
    table_columns shown = {.count = 0};
    if (!t->heading) return;
    for (int i = 0; i < all->count; i++)
        if (has_value(s, &all->at[i], t)) shown.at[shown.count++] = all->at[i];
    if (shown.count == 0) return;
    char *id = cli_format("all-%s", t->name);
    report_subheading(s->r, id, t->title);
    fprintf(page,
            "<h3 id=\"%s\">%s</h3>\n<div class=\"beside\"><div class=\"wide tall\" tabindex=\"0\" "
            "role=\"region\" aria-label=\"%s\">"
            "<table class=\"matrix\" data-quantity=\"%s\"><thead><tr><td></td>",
            id, t->heading, t->title, t->name);
    free(id);
    for (int i = 0; i < shown.count; i++) {
        fputs("<th scope=\"col\" data-label=\"", page);
        report_text(page, shown.at[i].label);
        if (step_tolerance(shown.at[i].step) > 0.0)
            fprintf(page, "\" data-step=\"%s\"", step_title(title, shown.at[i].step) + 4);
        else
            fprintf(page, "\" data-step=\"%.9g\"", strtod(shown.at[i].step, NULL));
        write_names(s, shown.at[i].label);
        if (!shown.at[i].is_alone)
            fprintf(page, "<br><small>%s</small>", step_title(title, shown.at[i].step));
        fputs("</th>", page);
    }
    fputs(REPORT_ROWS, page);
    for (int m = 0; m < s->methods.count; m++) {
        int rows[CSV_WORDS];
        bool is_found = false;
        for (int i = 0; i < shown.count; i++) {
            rows[i] =
                find_cell(s, shown.at[i].label, s->methods.word[m], shown.at[i].step, t->start);
            is_found |= rows[i] > 0;
        }
        if (!is_found) continue;
        write_method(page, s->methods.word[m]);
        for (int i = 0; i < shown.count; i++) write_trend_cell(s, rows[i], t);
        fputs("</tr>\n", page);
    }
    fputs(REPORT_TABLE_END "</div>\n", page);
}

void report_matrices(const study_page *s)
{
    table_columns *all = cli_calloc(1, sizeof *all);
    for (int i = 0; i < s->labels.count; i++)
        for (int row = 1; row < s->cells.rows; row++)
            if (is_cell(s, row, "label", s->labels.word[i]))
                add_column(all, s->labels.word[i], get_cell(s, row, "step"));
    for (int k = 0; k < REPORT_QUANTITIES; k++) write_matrix(s, all, &quantities[k]);
    free(all);
}

/* ---- predicted sizes ----------------------------------------------------------------------- */

/* The columns of a size that is predicted and measured. */
typedef struct compared_size {
    const char *predicted, *measured, *size, *title, *head;
} compared_size;
enum { COMPARED = 3 };
static const compared_size compared[COMPARED] = {
    {"predicted_D_max", "D_max", "D_size", "max |D|", "D"},
    {"predicted_E_deviation", "E_deviation", "E_size", "max |E - E(0)|", "E"},
    {"predicted_invariant_deviation", "invariant_deviation", "invariant_size", "max |I - I(0)|",
     "I"},
};

/* Whether a cell is on p = pi = 0, and not another one has the same run. */
static bool is_chosen(const study_page *s, int row)
{
    return find_cell(s, get_cell(s, row, "label"), get_cell(s, row, "integrator"),
                     get_cell(s, row, "step"), ON_SURFACE) == row;
}

/* Whether a run was predicted to its end, and has a size above rounding there. */
static bool is_compared(const study_page *s, int row, const compared_size *of)
{
    const bool is_above = is_cell(s, row, of->size, "larger") || is_cell(s, row, of->size, "");
    return is_above && is_cell(s, row, "state", "done") && is_cell(s, row, "predicted_message", "");
}

static int draw_predicted(const study_page *s)
{
    double low = INFINITY, high = 0.0;
    report_plot plot = {.name = "predicted",
                        .title = "Predicted and measured",
                        .xlabel = "predicted",
                        .ylabel = "measured",
                        .caption = "Sizes of runs above rounding; on the line both are equal.",
                        .log_x = true,
                        .log_y = true};
    for (const compared_size *of = compared; of < compared + COMPARED; of++) {
        plot_curve *curve = report_curve(&plot, of->title);
        curve->has_rings = true;
        for (int row = 1; row < s->cells.rows; row++) {
            if (!is_chosen(s, row) || !is_compared(s, row, of)) continue;
            const double x = csv_table_number(&s->cells, row, of->predicted);
            const double y = csv_table_number(&s->cells, row, of->measured);
            report_point(&plot, curve, x, y);
            if (!(x > 0.0 && y > 0.0)) continue;
            low = fmin(low, fmin(x, y));
            high = fmax(high, fmax(x, y));
        }
    }
    plot_curve *equal = report_curve(&plot, "equal");
    equal->is_black = true;
    report_point(&plot, equal, low, low);
    report_point(&plot, equal, high, high);
    return report_draw(s->r, &plot);
}

static void write_predicted_row(const study_page *s, int row)
{
    FILE *page = s->r->page;
    char title[STUDY_DIVISION];
    report_row(page, get_cell(s, row, "label"));
    report_element(page, "td", get_cell(s, row, "integrator"));
    report_element(page, "td", step_title(title, get_cell(s, row, "step")) + 4);
    for (int k = 0; k < 2 * COMPARED; k++) {
        const compared_size *of = &compared[k / 2];
        report_number(page, "%.3g",
                      csv_table_number(&s->cells, row, k % 2 ? of->measured : of->predicted));
    }
    report_number(page, "%.6g", csv_table_number(&s->cells, row, "predicted_until"));
    report_element(page, "td", get_cell(s, row, "predicted_message"));
    fputs("</tr>\n", page);
}

int report_predicted(const study_page *s)
{
    FILE *page = s->r->page;
    if (!is_cell(s, 0, "predicted_until", "predicted_until")) return CLI_DONE;
    report_heading(s->r, "predicted", "Predicted and measured");
    fputs("<div class=\"figures\">\n", page);
    const int status = draw_predicted(s);
    fputs("</div>\n<details><summary>all of them</summary>\n" REPORT_TABLE
          "<th>system</th><th>integrator</th><th>h</th>",
          page);
    for (int k = 0; k < 2 * COMPARED; k++)
        fprintf(page, "<th>%s %s</th>", compared[k / 2].head, k % 2 ? "measured" : "predicted");
    fputs("<th>until t</th><th></th>" REPORT_ROWS, page);
    for (int row = 1; row < s->cells.rows; row++)
        if (is_chosen(s, row) &&
            (!is_cell(s, row, "predicted_until", "") || !is_cell(s, row, "predicted_message", "")))
            write_predicted_row(s, row);
    fputs(REPORT_TABLE_END "</details>\n", page);
    return status;
}
