/* report_study.c - the page of a study: what becomes of D, E, the invariants and H with each
 * method.
 *
 * First the tables of sizes and trends, methods against systems; then the figures of each system;
 * then the expectations, and the tables of the study as they were printed. */
#include "io/output.h"
#include "report.h"

#include "io/document.h"
#include "io/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void report_add_word(report_words *words, const char *text)
{
    for (int i = 0; i < words->count; i++)
        if (strcmp(words->word[i], text) == 0) return;
    if (words->count < REPORT_WORDS) words->word[words->count++] = text;
}

const char *report_get(const report_cells *cells, int row, const char *head)
{
    return report_csv_get(&cells->csv, row, head);
}

int report_is(const report_cells *cells, int row, const char *head, const char *text)
{
    return strcmp(report_get(cells, row, head), text) == 0;
}

int report_find(const report_cells *cells, const char *label, const char *method, const char *step,
                const char *start, const char *other)
{
    int found = -1;
    for (int row = 1; row < cells->csv.rows; row++) {
        if (!report_is(cells, row, "label", label) || !report_is(cells, row, "step", step) ||
            !report_is(cells, row, "integrator", method) ||
            report_is(cells, row, "state", "refused"))
            continue;
        if (report_is(cells, row, "start", start)) return row;
        if (report_is(cells, row, "start", other)) found = row;
    }
    return found;
}

/* ---- tables of sizes and trends ---- */

typedef struct theme {
    const char *title, *start, *other, *value, *size, *trend;
} theme;

/* On p = pi = 0 the lifted run has the bits of the physical one, so that either will do. */
static const theme themes[] = {
    {"Constraints: max |D|", "physical", "surface", "D_max", "D_size", "D_trend"},
    {"Energy: max |E − E(0)|", "physical", "surface", "E_deviation", "E_size", "E_trend"},
    {"Invariants of the systems: max |I − I(0)|, the worst of each", "physical", "surface",
     "invariant_deviation", "invariant_size", "invariant_trend"},
    {"Hamiltonian of the lift: max |H − H(0)|, started off p = π = 0", "displaced", "displaced",
     "H_deviation", "H_size", "H_trend"},
};

/* A column of the tables: a label at a step. */
typedef struct column {
    const char *label, *step;
    int alone; /* the only step of its label */
} column;

typedef struct columns {
    column at[REPORT_WORDS];
    int count;
} columns;

static int same_text(const char *a, const char *b) { return strcmp(a, b) == 0; }

static void add_column(columns *all, const char *label, const char *step)
{
    int alone = 1;
    for (int i = 0; i < all->count; i++) {
        if (!same_text(all->at[i].label, label)) continue;
        if (same_text(all->at[i].step, step)) return;
        alone = all->at[i].alone = 0;
    }
    if (all->count < REPORT_WORDS) all->at[all->count++] = (column){label, step, alone};
}

/* Whether a theme has anything to say about a column. */
static int has_value(const report_cells *c, const column *at, const theme *t)
{
    for (int row = 1; row < c->csv.rows; row++)
        if (report_is(c, row, "label", at->label) && report_is(c, row, "step", at->step) &&
            (report_is(c, row, "start", t->start) || report_is(c, row, "start", t->other)) &&
            report_get(c, row, t->value)[0])
            return 1;
    return 0;
}

static void put_cell(FILE *page, const report_cells *c, int row, const theme *t)
{
    char number[32] = "";
    const char *value = row < 0 ? "" : report_get(c, row, t->value);
    const double size = strtod(value, NULL);
    if (value[0]) snprintf(number, sizeof number, size == 0.0 ? "0" : "%.1e", size);
    if (row >= 0 && report_is(c, row, "state", "failed"))
        report_trend(page, "", "failed", number);
    else if (!value[0])
        fputs("<td>–</td>", page);
    else
        report_trend(page, report_get(c, row, t->size), report_get(c, row, t->trend), number);
}

static void put_heads(FILE *page, const columns *all)
{
    fputs("<table><thead><tr><td></td>", page);
    for (int i = 0; i < all->count; i++) {
        fputs("<th scope=\"col\">", page);
        report_text(page, all->at[i].label);
        if (!all->at[i].alone)
            fprintf(page, "<br><small>h = %g</small>", strtod(all->at[i].step, NULL));
        fputs("</th>", page);
    }
    fputs("</tr></thead>\n<tbody>", page);
}

/* A method that no system of the table could use is left out. */
static void put_method(FILE *page, const report_cells *c, const columns *all, const char *method,
                       const theme *t)
{
    int rows[REPORT_WORDS], found = 0;
    for (int i = 0; i < all->count; i++) {
        const column *at = &all->at[i];
        rows[i] = report_find(c, at->label, method, at->step, t->start, t->other);
        found |= rows[i] >= 0;
    }
    if (!found) return;
    fputs("<tr>", page);
    report_element(page, "th scope=\"row\"", method);
    for (int i = 0; i < all->count; i++) put_cell(page, c, rows[i], t);
    fputs("</tr>\n", page);
}

static void put_theme(FILE *page, const report_cells *c, const columns *all, const theme *t)
{
    columns shown = {.count = 0};
    for (int i = 0; i < all->count; i++)
        if (has_value(c, &all->at[i], t)) shown.at[shown.count++] = all->at[i];
    if (shown.count == 0) return;
    fprintf(page, "<h3>%s</h3>\n<div class=\"wide\" tabindex=\"0\">", t->title);
    put_heads(page, &shown);
    for (int m = 0; m < c->methods.count; m++) put_method(page, c, &shown, c->methods.word[m], t);
    fputs("</tbody></table></div>\n", page);
}

/* ---- expectations ---- */

static void put_expectation(FILE *page, const report_csv *csv, int row)
{
    const int met = strcmp(report_csv_get(csv, row, "met"), "yes") == 0;
    fputs("<tr>", page);
    report_element(page, "th scope=\"row\"", report_csv_get(csv, row, "label"));
    report_element(page, "td", report_csv_get(csv, row, "integrator"));
    report_element(page, "td", report_csv_get(csv, row, "start"));
    report_number(page, "%g", report_csv_number(csv, row, "step"));
    report_element(page, "td", report_csv_get(csv, row, "quantity"));
    report_element(page, "td", report_csv_get(csv, row, "expected"));
    report_element(page, "td", report_csv_get(csv, row, "found"));
    fprintf(page, "<td class=\"%s\">%s</td></tr>\n", met ? "kept" : "drift",
            met ? "met" : "not met");
}

/* Those that are not met stand open on the page, all of them below. */
static void put_expectations(FILE *page, const report_csv *csv, int all)
{
    fputs("<div class=\"wide\" tabindex=\"0\"><table><thead><tr><th>system</th><th>integrator</th>"
          "<th>start</th><th>h</th><th>quantity</th><th>expected</th><th>found</th><th></th></tr>"
          "</thead>\n<tbody>",
          page);
    for (int row = 1; row < csv->rows; row++)
        if (all || strcmp(report_csv_get(csv, row, "met"), "yes") != 0)
            put_expectation(page, csv, row);
    fputs("</tbody></table></div>\n", page);
}

/* What the study says must become of its runs; a study need not say anything. */
static int tell_expectations(report *r)
{
    report_csv csv = {.text = NULL};
    char *path = cli_join(r->directory, "expectations.csv");
    int status = CLI_DONE, met = 0;
    if (access(path, F_OK) == 0) {
        status = report_csv_read(&csv, path);
        for (int row = 1; row < csv.rows; row++)
            met += strcmp(report_csv_get(&csv, row, "met"), "yes") == 0;
    }
    if (csv.rows > 1) {
        fprintf(r->page, "<h2>Expectations</h2>\n<p>%d of %d are met.</p>\n", met, csv.rows - 1);
        if (met < csv.rows - 1) put_expectations(r->page, &csv, 0);
        fputs("<details><summary>all of them</summary>\n", r->page);
        put_expectations(r->page, &csv, 1);
        fputs("</details>\n", r->page);
    }
    report_csv_free(&csv);
    free(path);
    return status;
}

/* ---- the page ---- */

static const char introduction[] =
    "<p>Each cell has a size, a trend and the number that the heading names; – : the method "
    "needs what the system lacks.</p>\n"
    "<ul class=\"key\">\n"
    "<li class=\"kept\">exact: never changed; rounding: no larger than roundings of so many steps "
    "make, and no trend: it stays about one value, or changes once (settles)</li>\n"
    "<li class=\"small\">rounding, and a trend: a random walk, or a drift of roundings to one "
    "side</li>\n"
    "<li class=\"bounded\">larger, none: larger than roundings, about one value; settles: changes "
    "once</li>\n"
    "<li class=\"drift\">larger, and random walk, linear, power law, exponential, growing "
    "oscillation: grows so</li>\n"
    "<li class=\"off\">failed, aborted: the run broke off; undecided: too few samples, or too "
    "slow an oscillation, to decide; a number alone: E where the motion of the run need not "
    "conserve "
    "it</li>\n"
    "</ul>\n";

static const char about_lift[] =
    "<p>On p = π = 0 a lifted method is the same method on (q,v), bit for bit. That a method is\n"
    "symplectic on the lift says nothing there about D or the energy: every one-step method\n"
    "whose step is locally invertible, explicit Euler included, is the restriction of a\n"
    "symplectic one. D and E are kept, or not, for other reasons: the form of D, whether D is\n"
    "imposed or projected on, reversibility. What symplecticity does keep shows off p = π = 0,\n"
    "in H. A step that lands in D = 0 has no lift of 4n+2 variables; restricted to D = 0 it lifts\n"
    "to T*{D = 0}, of dimension 2(2n − m).</p>\n";

static void put_contents(FILE *page, const report_cells *c)
{
    fputs("<p>Figures:", page);
    for (int i = 0; i < c->labels.count; i++) {
        fprintf(page, "%s <a href=\"#s%d\">", i ? "," : "", i + 1);
        report_text(page, c->labels.word[i]);
        fputs("</a>", page);
    }
    fputs(".</p>\n", page);
}

static void put_themes(FILE *page, const report_cells *c)
{
    columns *all = cli_calloc(1, sizeof *all);
    for (int row = 1; row < c->csv.rows; row++)
        add_column(all, report_get(c, row, "label"), report_get(c, row, "step"));
    for (size_t k = 0; k < sizeof themes / sizeof themes[0]; k++)
        put_theme(page, c, all, &themes[k]);
    free(all);
}

static void put_origin(report *r)
{
    fputs("<h2>How to make it again</h2>\n"
          "<pre>dalembert study study.yaml --output DIR\ndalembert report DIR</pre>\n",
          r->page);
    report_file(r, "study.yaml", "study.yaml");
    report_file(r, "manifest.json", "what it was made with: manifest.json");
    report_file(r, "tables.txt", "the tables as they were printed: tables.txt");
}

static void put_title(report *r, const document *doc)
{
    const yaml_node_t *root = document_node(doc, 1);
    const char *title = "A study of drift";
    const yaml_node_pair_t *pair = NULL, *end = NULL;
    if (root && root->type == YAML_MAPPING_NODE) {
        pair = root->data.mapping.pairs.start;
        end = root->data.mapping.pairs.top;
    }
    for (; pair < end; pair++) {
        const yaml_node_t *key = document_node(doc, pair->key);
        const yaml_node_t *value = document_node(doc, pair->value);
        if (key->type == YAML_SCALAR_NODE && value->type == YAML_SCALAR_NODE &&
            strcmp((const char *)key->data.scalar.value, "title") == 0)
            title = (const char *)value->data.scalar.value;
    }
    report_title(r, title);
}

/* The title that study.yaml has. */
static int begin_page(report *r)
{
    document doc = {.place = "study.yaml"};
    size_t length = 0;
    char *path = cli_join(r->directory, "study.yaml");
    char *bytes = file_read(path, &length);
    int status = bytes ? document_parse(&doc, path, bytes, length) : CLI_IO;
    if (status == CLI_DONE) {
        put_title(r, &doc);
        yaml_document_delete(&doc.yaml);
    }
    free(bytes);
    free(path);
    return status;
}

static int is_lifted(const report_cells *c)
{
    for (int row = 1; row < c->csv.rows; row++)
        if (!report_is(c, row, "start", "physical")) return 1;
    return 0;
}

static int write_page(report *r, const report_cells *c)
{
    int status = begin_page(r);
    if (status != CLI_DONE) return status;
    fprintf(r->page, "<p>%d runs: %d systems, %d methods.</p>\n", c->csv.rows - 1, c->labels.count,
            c->methods.count);
    put_contents(r->page, c);
    fputs(introduction, r->page);
    if (is_lifted(c)) fputs(about_lift, r->page);
    put_themes(r->page, c);
    status = tell_expectations(r);
    for (int i = 0; i < c->labels.count && status != CLI_IO; i++) {
        cli_progress("report: %s", c->labels.word[i]);
        fprintf(r->page, "<h2 id=\"s%d\">", i + 1);
        report_text(r->page, c->labels.word[i]);
        fputs("</h2>\n", r->page);
        int drawn = report_figures(r, c, c->labels.word[i]);
        if (status == CLI_DONE) status = drawn;
    }
    put_origin(r);
    return status;
}

int report_study(report *r)
{
    report_cells *c = cli_calloc(1, sizeof *c);
    char *path = cli_join(r->directory, "cells.csv");
    int status = report_csv_read(&c->csv, path);
    for (int row = 1; status == CLI_DONE && row < c->csv.rows; row++) {
        report_add_word(&c->labels, report_get(c, row, "label"));
        report_add_word(&c->methods, report_get(c, row, "integrator"));
    }
    if (status == CLI_DONE && c->labels.count == 0)
        status = cli_fail(CLI_USAGE, "'%s' has no rows", path);
    if (status == CLI_DONE) status = write_page(r, c);
    report_csv_free(&c->csv);
    free(c);
    free(path);
    return status;
}
