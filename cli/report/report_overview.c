/* report_overview.c - the result of a study at the beginning of its page: the sentences of its
 * screen, and the largest size in each family of methods on each system. */
#include "report_overview.h"

#include "io/file.h"
#include "report_family.h"
#include "study/study_restore.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the study ----------------------------------------------------------------------------- */

int report_overview_read(report_overview *a, const char *directory, const csv_table *cells)
{
    size_t length;
    csv_table quantities = {.text = NULL};
    char *study = cli_join(directory, "study.yaml"), *systems = cli_join(directory, "systems");
    char *path = cli_join(directory, "quantities.csv"), *text = file_read(study, &length);
    *a = (report_overview){.name = NULL};
    int status = text ? study_plan_read(&a->plan, study, text, length, systems) : CLI_IO;
    if (status == CLI_DONE && file_exists(path)) status = csv_table_read(&quantities, path);
    if (status == CLI_DONE) {
        study_restore(&a->plan, cells, &quantities);
        study_matrix_make(&a->matrix, &a->plan, STUDY_ALL);
        a->name = cli_calloc((size_t)a->matrix.columns + 1, sizeof *a->name);
        study_name_columns(&a->matrix, STUDY_SHORT_LETTERS, a->name);
    }
    csv_table_free(&quantities);
    free(text);
    free(path);
    free(study);
    free(systems);
    return status;
}

void report_overview_free(report_overview *a)
{
    study_matrix_free(&a->matrix);
    study_plan_free(&a->plan);
    free(a->name);
}

const char *report_short_name(const report_overview *a, const char *label)
{
    for (int i = 0; i < a->matrix.columns; i++)
        if (strcmp(a->matrix.column[i]->label, label) == 0) return a->name[i];
    return label;
}

/* ---- sentences ----------------------------------------------------------------------------- */

static void write_sentences(FILE *page, const report_overview *a)
{
    static const char *const texts[STUDY_AIMS] = {
        "keep D at rounding in every run", "keep E within 1 % on D = 0 in every run", "keep both"};
    static const char *const heads[STUDY_AIMS] = {"Take for D", "for E (1 %)", "for both"};
    enum { NAMES = 160 };
    char *names[STUDY_AIMS];
    const char *separator = "";
    fputs("<p class=\"lead\">", page);
    for (int k = 0; k < STUDY_AIMS; k++) {
        int kept, all;
        names[k] = study_list_keepers(&a->matrix, (study_aim)k, NAMES, &kept, &all);
        if (!names[k]) continue;
        fprintf(page, "%s<b>%d of %d</b> methods %s", separator, kept, all, texts[k]);
        separator = "; ";
    }
    fputs(separator[0] ? ".</p>\n<dl class=\"facts take\">\n" : "</p>\n<dl class=\"facts take\">\n",
          page);
    for (int k = 0; k < STUDY_AIMS; k++) {
        if (names[k]) {
            report_element(page, "dt", heads[k]);
            report_element(page, "dd", names[k]);
        }
        free(names[k]);
    }
    char *command = study_format_explain(&a->matrix, a->matrix.columns);
    if (command) {
        fputs("<dt>Next</dt><dd>", page);
        report_element(page, "code", command);
        fputs("</dd>", page);
    }
    fputs("</dl>\n", page);
    free(command);
}

/* ---- families and systems ------------------------------------------------------------------ */

/* How much a cell says against its family; what is larger among equals is worse. */
typedef enum blame { NOTHING, IS_REFUSED, NOT_STATED, IS_KEPT, IS_LARGER, HAS_FAILED } blame;

static blame find_blame(const study_cell *c, study_quantity quantity, double *size)
{
    *size = 0.0;
    if (!c || c->state == STUDY_WAITING) return NOTHING;
    if (c->state != STUDY_FINISHED) return c->state == STUDY_FAILED ? HAS_FAILED : IS_REFUSED;
    const dal_trend *trend = study_get_trend(c, quantity);
    if (!trend) return NOTHING;
    *size = quantity == ENERGY ? trend->deviation : trend->max_abs;
    if (!study_is_stated(trend)) return NOT_STATED;
    if (trend->trend == DAL_TREND_ABORTED) return HAS_FAILED;
    return study_is_at_rounding(trend) ? IS_KEPT : IS_LARGER;
}

/* The worst cell of a family on a system, whose cells have no other. */
static const study_cell *find_worst(const study_matrix *m, int column, study_quantity quantity,
                                    method_family family)
{
    const study_cell *worst = NULL;
    blame most = NOTHING;
    double largest = 0.0, size;
    for (int row = 0; row < m->rows; row++) {
        const study_cell *c = study_matrix_cell(m, row, column);
        const blame found = find_blame(c, quantity, &size);
        if (method_family_of(m->row[row]->name) != family || found < most) continue;
        if (found == most && !(size > largest)) continue;
        worst = c;
        most = found;
        largest = size;
    }
    return worst;
}

/* The row of a family that has members, with the systems that have the quantity. */
static void write_family(FILE *page, const study_matrix *m, method_family family,
                         study_quantity quantity, const bool *has)
{
    int members = 0;
    for (int row = 0; row < m->rows; row++)
        members += method_family_of(m->row[row]->name) == family;
    if (members == 0) return;
    fprintf(page, "<tr><th scope=\"row\">%s <small>%d</small></th>", method_family_name[family],
            members);
    for (int i = 0; i < m->columns; i++) {
        char text[STUDY_SIZE_TEXT], method[STUDY_NAME];
        if (!has[i]) continue;
        const study_cell *c = find_worst(m, i, quantity, family);
        screen_colour colour = study_describe_size(c, quantity, text);
        /* On the page faint is what has a size without a statement. */
        if (!c || c->state == STUDY_REFUSED || c->state == STUDY_WAITING) colour = SCREEN_PLAIN;
        fprintf(page, "<td class=\"%s\"", report_colour(colour));
        if (c) fprintf(page, " title=\"%s\"", dal_method_name(c->method, method, sizeof method));
        fputc('>', page);
        report_element(page, "b", text);
        fputs("</td>", page);
    }
    fputs("</tr>\n", page);
}

static void write_families(report *r, const report_overview *a, study_quantity quantity,
                           const char *id, const char *heading)
{
    const study_matrix *m = &a->matrix;
    FILE *page = r->page;
    bool *has = cli_calloc((size_t)m->columns + 1, sizeof *has), has_any = false;
    for (int k = 0; k < m->rows * m->columns; k++) {
        const study_cell *c = m->cell[k];
        if (!c || !study_get_trend(c, quantity)) continue;
        has[k % m->columns] = has_any = true;
    }
    if (has_any) {
        report_subheading(r, id, heading);
        fprintf(page,
                "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"%s\">"
                "<table class=\"families\" id=\"%s\"><thead><tr><th scope=\"col\">%s</th>",
                heading, id, heading);
        for (int i = 0; i < m->columns; i++) {
            if (!has[i]) continue;
            fputs("<th scope=\"col\" title=\"", page);
            report_text(page, m->column[i]->label);
            fputs("\">", page);
            report_text(page, a->name[i]);
            fputs("</th>", page);
        }
        fputs(REPORT_ROWS, page);
        for (int f = 0; f < METHOD_FAMILIES; f++)
            write_family(page, m, (method_family)f, quantity, has);
        fputs(REPORT_TABLE_END, page);
    }
    free(has);
}

void report_overview_write(report *r, const report_overview *a)
{
    const study_plan *plan = &a->plan;
    const study_cell *failed;
    int count[STUDY_STATES];
    char number[SCREEN_NUMBER];
    const int runs = study_count_states(plan, count, &failed);
    char *range = study_describe_range(plan);
    fprintf(r->page, "<p>%d methods × %d systems, %s runs", a->matrix.method_count,
            plan->case_count, screen_count(number, runs));
    const char *separator = ": ";
    for (int i = 0; i < STUDY_STATES; i++) {
        if (count[i] == 0) continue;
        fprintf(r->page, "%s%s %s", separator, screen_count(number, count[i]),
                study_state_words[i]);
        separator = ", ";
    }
    fprintf(r->page, "; %s.</p>\n", range);
    free(range);
    write_sentences(r->page, a);
    write_families(r, a, CONSTRAINT, "families-D", "max |D|");
    write_families(r, a, ENERGY, "families-E", "max |E − E(0)|");
    fputs("<p class=\"faint\">The worst method of each family. <b>ok</b> rounding, <b>/</b> grows "
          "like t, <b>^</b> faster, <b>~</b> slower, <b>?</b> too short to say, <b>( )</b> not "
          "stated: D is not 0, <b>x</b> failed, <b>n/a</b> refused.</p>\n",
          r->page);
}
