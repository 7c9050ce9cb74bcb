/* report_study.c - the page of a study: what becomes of D, E and H with each method.
 *
 * First three tables, methods against systems; then a figure per system and step; then the tables
 * of the study itself. */
#include "report.h"

#include <stdlib.h>
#include <string.h>

int report_word_at(const report_words *words, const char *text)
{
    for (int i = 0; i < words->count; i++)
        if (strcmp(words->word[i], text) == 0) return i;
    return -1;
}

void report_add_word(report_words *words, const char *text)
{
    if (report_word_at(words, text) < 0 && words->count < REPORT_WORDS)
        words->word[words->count++] = text;
}

const char *report_get(const report_cells *cells, int row, const char *head)
{
    return report_csv_get(&cells->csv, row, head);
}

int report_is(const report_cells *cells, int row, const char *head, const char *text)
{
    return strcmp(report_get(cells, row, head), text) == 0;
}

/* ---- tables of verdicts ---- */

typedef struct theme {
    const char *title, *start, *other, *value, *verdict;
} theme;

static const theme themes[] = {
    {"Constraints: max |D| on p = π = 0", "surface", "physical", "D_max", "D_verdict"},
    {"Energy: max |E − E(0)| on p = π = 0", "surface", "physical", "E_deviation", "E_verdict"},
    {"Hamiltonian of the lift: max |H − H(0)|, started off p = π = 0", "displaced", "displaced",
     "H_deviation", "H_verdict"},
};

/* The row of a method and a label at the first step, -1 for none. */
static int find_row(const report_cells *c, const char *method, const char *label, const theme *t)
{
    int other = -1;
    for (int row = 1; row < c->csv.rows; row++) {
        if (!report_is(c, row, "label", label) || !report_is(c, row, "integrator", method))
            continue;
        if (report_is(c, row, "start", t->start)) return row;
        if (other < 0 && report_is(c, row, "start", t->other)) other = row;
    }
    return other;
}

static void put_value(FILE *page, const report_cells *c, int row, const theme *t)
{
    const char *value = row < 0 ? "" : report_get(c, row, t->value);
    if (row >= 0 && report_is(c, row, "state", "failed"))
        fputs("<td class=\"failed\">failed</td>", page);
    else if (value[0])
        fprintf(page, "<td class=\"%s\">%.1e</td>", report_get(c, row, t->verdict),
                strtod(value, NULL));
    else
        fputs("<td></td>", page);
}

static void put_theme(FILE *page, const report_cells *c, const theme *t)
{
    fprintf(page, "<h3>%s</h3>\n<table><tr><th></th>", t->title);
    for (int i = 0; i < c->labels.count; i++) {
        fputs("<th class=\"turned\"><span>", page);
        report_text(page, c->labels.word[i]);
        fputs("</span></th>", page);
    }
    fputs("</tr>\n", page);
    for (int m = 0; m < c->methods.count; m++) {
        fputs("<tr><td>", page);
        report_text(page, c->methods.word[m]);
        fputs("</td>", page);
        for (int i = 0; i < c->labels.count; i++)
            put_value(page, c, find_row(c, c->methods.word[m], c->labels.word[i], t), t);
        fputs("</tr>\n", page);
    }
    fputs("</table>\n", page);
}

static const char introduction[] =
    "<p>Green: exact, or changed by rounding alone. Yellow: bounded. Red: drifts. Grey: the run\n"
    "broke off. Empty: there is no such quantity, or the method needs what the system lacks.</p>\n"
    "<p>On p = π = 0 a lifted method is the same method on (q,v), bit for bit. That a method is\n"
    "symplectic on the lift says nothing there about D or the energy: every one-step method,\n"
    "explicit Euler included, is the restriction of a symplectic one. D and E are kept, or not,\n"
    "for other reasons: the form of D, reversibility, projection. What symplecticity does keep\n"
    "shows off p = π = 0, in H. A projection has no canonical lift.</p>\n";

/* ---- figures ---- */

/* All steps of a label. */
static int draw_label(report *r, const report_cells *c, const char *label)
{
    report_words steps = {.count = 0};
    int status = CLI_DONE;
    fputs("<h2>", r->page);
    report_text(r->page, label);
    fputs("</h2>\n", r->page);
    for (int row = 1; row < c->csv.rows; row++)
        if (report_is(c, row, "label", label)) report_add_word(&steps, report_get(c, row, "step"));
    for (int i = 0; i < steps.count && !r->broken; i++) {
        cli_progress("report: %s", label);
        int drawn = report_figure(r, c, label, steps.word[i], i + 1);
        if (status == CLI_DONE) status = drawn;
    }
    return status;
}

/* The tables of the study as they were printed. */
static void put_tables(report *r)
{
    char *path = cli_join(r->directory, "tables.txt");
    FILE *file = path ? fopen(path, "r") : NULL;
    free(path);
    if (!file) return;
    fputs("<h2>Tables</h2>\n<pre>", r->page);
    char line[512];
    while (fgets(line, sizeof line, file)) report_text(r->page, line);
    fputs("</pre>\n", r->page);
    fclose(file);
}

static int write_page(report *r, const report_cells *c)
{
    int status = CLI_DONE;
    fputs("<title>Study of drift</title></head><body>\n<h1>Study of drift</h1>\n", r->page);
    fputs(introduction, r->page);
    for (size_t k = 0; k < sizeof themes / sizeof themes[0]; k++) put_theme(r->page, c, &themes[k]);
    for (int i = 0; i < c->labels.count && !r->broken; i++) {
        int drawn = draw_label(r, c, c->labels.word[i]);
        if (status == CLI_DONE) status = drawn;
    }
    cli_progress_end();
    put_tables(r);
    return status;
}

int report_study(report *r)
{
    report_cells *c = calloc(1, sizeof *c);
    char *path = cli_join(r->directory, "cells.csv");
    int status = c && path ? report_csv_read(&c->csv, path) : cli_fail(CLI_IO, "out of memory");
    for (int row = 1; status == CLI_DONE && row < c->csv.rows; row++) {
        report_add_word(&c->labels, report_get(c, row, "label"));
        report_add_word(&c->methods, report_get(c, row, "integrator"));
        if (!strchr(report_get(c, row, "integrator"), '+'))
            report_add_word(&c->plain, report_get(c, row, "integrator"));
    }
    if (status == CLI_DONE && c->labels.count == 0)
        status = cli_fail(CLI_USAGE, "'%s' has no rows", path);
    if (status == CLI_DONE) status = write_page(r, c);
    if (c) report_csv_free(&c->csv);
    free(c);
    free(path);
    return status;
}
