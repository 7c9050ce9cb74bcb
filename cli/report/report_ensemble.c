/* report_ensemble.c - the page of an ensemble: what varies, histograms of each component of the
 * state that does, its quantiles along t, and the cloud of members in a plane at each time. */
#include "report_ensemble.h"

#include "io/csv_table.h"
#include "io/file.h"
#include "io/json.h"
#include "report_plot.h"
#include "report_system.h"
#include "run/manifest.h"
#include "run/simulation.h"
#include "run/system.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/screen.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Histograms in one figure, at times that are as far apart as can be; figures of clouds. */
enum { HISTOGRAMS = 4, CLOUDS = 12 };

typedef struct ensemble_page {
    report *r;
    csv_table statistics, histograms, cloud;
    csv_words times, columns; /* as they are in the files */
} ensemble_page;

/* Number k of at most `most` of the times, the first and the last among them. */
static int chosen_time(const ensemble_page *p, int k, int most)
{
    const int count = p->times.count;
    if (count <= most) return k;
    return most == 1 ? count - 1 : (int)((long long)k * (count - 1) / (most - 1));
}

static int chosen_times(const ensemble_page *p, int most)
{
    return p->times.count < most ? p->times.count : most;
}

/* Whether the members differ in a column at any time. */
static bool varies(const ensemble_page *p, int column)
{
    const csv_table *csv = &p->statistics;
    for (int row = 1; row < csv->rows; row++)
        if (csv_table_is(csv, row, "column", p->columns.word[column]) &&
            csv_table_number(csv, row, "min") < csv_table_number(csv, row, "max"))
            return true;
    return false;
}

static int draw_histogram(const ensemble_page *p, int column)
{
    const csv_table *csv = &p->histograms;
    char name[PLOT_NAME], *ylabel = cli_strdup("members");
    snprintf(name, sizeof name, "histogram-%d", column + 1);
    report_plot plot = {.name = name,
                        .title = p->columns.word[column],
                        .xlabel = p->columns.word[column],
                        .ylabel = ylabel,
                        .caption = "",
                        .from_zero = true};
    for (int k = 0; k < chosen_times(p, HISTOGRAMS); k++) {
        const char *t = p->times.word[chosen_time(p, k, HISTOGRAMS)];
        char title[PLOT_TITLE];
        snprintf(title, sizeof title, "t = %.6g", strtod(t, NULL));
        plot_curve *curve = report_curve(&plot, title);
        for (int row = 1; row < csv->rows; row++) {
            if (!csv_table_is(csv, row, "t", t) ||
                !csv_table_is(csv, row, "column", p->columns.word[column]))
                continue;
            const double count = csv_table_number(csv, row, "count");
            report_point(&plot, curve, csv_table_number(csv, row, "low"), count);
            report_point(&plot, curve, csv_table_number(csv, row, "high"), count);
        }
    }
    const int status = report_draw(p->r, &plot);
    free(ylabel);
    return status;
}

/* The first and the last quantile as a band, the mean as a line. */
static int draw_band(const ensemble_page *p, int column)
{
    const csv_table *csv = &p->statistics;
    const int first = 6, last = csv->columns - 2; /* between min and max */
    char name[PLOT_NAME], caption[96];
    snprintf(name, sizeof name, "band-%d", column + 1);
    snprintf(caption, sizeof caption, "Mean, and between the quantiles %s and %s.",
             csv->cell[first] + 1, csv->cell[last] + 1);
    report_plot plot = {.name = name,
                        .title = p->columns.word[column],
                        .xlabel = "t",
                        .ylabel = p->columns.word[column],
                        .caption = caption};
    plot_curve *band = report_curve(&plot, "");
    plot_curve *mean = report_curve(&plot, "mean");
    band->is_band = true;
    for (int row = 1; row < csv->rows; row++) {
        if (!csv_table_is(csv, row, "column", p->columns.word[column])) continue;
        const double t = csv_table_number(csv, row, "t");
        report_band(&plot, band, t, csv_table_number(csv, row, csv->cell[first]),
                    csv_table_number(csv, row, csv->cell[last]));
        report_point(&plot, mean, t, csv_table_number(csv, row, "mean"));
    }
    return report_draw(p->r, &plot);
}

static int draw_cloud(const ensemble_page *p, int number)
{
    const csv_table *csv = &p->cloud;
    const char *t = p->times.word[chosen_time(p, number, CLOUDS)];
    char name[PLOT_NAME], title[PLOT_TITLE];
    snprintf(name, sizeof name, "cloud-%d", number + 1);
    snprintf(title, sizeof title, "t = %.6g", strtod(t, NULL));
    report_plot plot = {.name = name,
                        .title = title,
                        .xlabel = csv->cell[2],
                        .ylabel = csv->cell[3],
                        .caption = ""};
    plot_curve *curve = report_curve(&plot, "");
    curve->has_dots = true;
    for (int row = 1; row < csv->rows; row++)
        if (csv_table_is(csv, row, "t", t))
            report_point(&plot, curve, csv_table_number(csv, row, csv->cell[2]),
                         csv_table_number(csv, row, csv->cell[3]));
    return report_draw(p->r, &plot);
}

static void begin_section(report *r, const char *id, const char *title, const char *text)
{
    report_heading(r, id, title);
    report_element(r->page, "p", text);
    fputs("<div class=\"figures\">\n", r->page);
}

static int draw_clouds(const ensemble_page *p)
{
    int status = CLI_DONE;
    begin_section(p->r, "clouds", "Clouds", "The first members in the plane of two components.");
    for (int i = 0; i < chosen_times(p, CLOUDS) && status == CLI_DONE; i++)
        status = draw_cloud(p, i);
    fputs("</div>\n", p->r->page);
    return status;
}

/* A section with a figure for each component in which the members differ. */
static int draw_components(const ensemble_page *p, const char *id, const char *title,
                           const char *text, int (*draw)(const ensemble_page *p, int column))
{
    int status = CLI_DONE;
    begin_section(p->r, id, title, text);
    for (int i = 0; i < p->columns.count && status == CLI_DONE; i++)
        if (varies(p, i)) status = draw(p, i);
    fputs("</div>\n", p->r->page);
    return status;
}

/* A member of the ensemble in its manifest. */
static int write_member(FILE *page, const document *doc, const char *name, const char *heading)
{
    const yaml_node_t *root = document_node(doc, 1);
    yaml_node_t *value = document_value(doc, document_value(doc, root, "ensemble"), name);
    int status = value ? CLI_DONE : document_fail(doc, root, "there is no %s of an ensemble", name);
    for (int i = 0; status == CLI_DONE && i < document_count(value); i++) {
        const char *text = document_scalar(doc, document_item(doc, value, i), name);
        if (text)
            report_fact(page, i == 0 ? heading : "", text);
        else
            status = CLI_USAGE;
    }
    return status;
}

static void write_statistics(const ensemble_page *p)
{
    const csv_table *csv = &p->statistics;
    FILE *page = p->r->page;
    char *title =
        cli_format("Statistics at t = %.6g", strtod(p->times.word[p->times.count - 1], NULL));
    report_heading(p->r, "statistics", title);
    free(title);
    fputs(REPORT_TABLE, page);
    for (int k = 1; k < csv->columns; k++) report_element(page, "th", csv->cell[k]);
    fputs(REPORT_ROWS, page);
    for (int row = csv->rows - p->columns.count; row < csv->rows; row++) {
        report_row(page, csv_table_get(csv, row, "column"));
        for (int k = 2; k < csv->columns; k++)
            report_number(page, "%.6g", csv_table_number(csv, row, csv->cell[k]));
        fputs("</tr>\n", page);
    }
    fputs(REPORT_TABLE_END, page);
}

/* "2,000 members at t = 5, mean ± standard deviation: x = 0.02665 ± 0.094, ...", of what is not
 * the same for all. */
static void write_means(const ensemble_page *p)
{
    const csv_table *csv = &p->statistics;
    const int first = csv->rows - p->columns.count;
    FILE *page = p->r->page;
    char mean[SCREEN_NUMBER], deviation[SCREEN_NUMBER];
    char members[SCREEN_NUMBER];
    fprintf(page, "<p class=\"lead\">%s members at t = %.6g, mean ± standard deviation:</p>\n",
            screen_count(members, (long long)csv_table_number(csv, first, "count")),
            csv_table_number(csv, first, "t"));
    fputs("<p class=\"numbers\">", page);
    for (int row = first; row < csv->rows; row++) {
        const double size = csv_table_number(csv, row, "deviation");
        if (!(size > 0.0)) continue;
        fputs("<span>", page);
        report_text(page, csv_table_get(csv, row, "column"));
        fprintf(page, " = %s ± %s</span> ",
                screen_number(mean, csv_table_number(csv, row, "mean"), 4),
                screen_number(deviation, size, 2));
    }
    fputs("</p>\n", page);
}

/* What came out, what moves and how, how many members there are, and in what they differ. */
static int write_head(const ensemble_page *p, const run_simulation *simulation, const document *doc)
{
    const run_request *request = &simulation->request;
    FILE *page = p->r->page;
    report_title(p->r, report_model_title(simulation->model, "An ensemble"));
    write_means(p);
    write_statistics(p);
    fputs(REPORT_FACTS, page);
    report_fact(page, "system", request->system_name);
    report_system(page, simulation->model, request);
    report_method(page, request);
    int status = write_member(page, doc, "members", "members");
    if (status == CLI_DONE) status = write_member(page, doc, "seed", "seed");
    if (status == CLI_DONE) status = write_member(page, doc, "vary", "added to each");
    fputs(REPORT_FACTS_END, page);
    return status;
}

static int describe_ensemble(const ensemble_page *p)
{
    document *doc;
    run_simulation simulation = simulation_default();
    char *place = cli_join(p->r->directory, "manifest.json");
    char *copy = cli_join(p->r->directory, "system.yaml"), *bytes;
    int status = store_read_manifest(place, &doc, &bytes);
    free(bytes);
    if (status == CLI_DONE) status = manifest_read_input(&simulation.request, doc, copy);
    if (status == CLI_DONE) status = cli_read(simulation.request.system_name, &simulation.model);
    if (status == CLI_DONE) status = write_head(p, &simulation, doc);
    simulation_free(&simulation);
    store_free_manifest(doc);
    free(copy);
    free(place);
    return status;
}

static int write_page(ensemble_page *p)
{
    int status = describe_ensemble(p);
    if (status != CLI_DONE) return status;
    status = draw_clouds(p);
    if (status == CLI_DONE)
        status = draw_components(p, "histograms", "Histograms",
                                 "Members in 40 intervals between the extremes.", draw_histogram);
    if (status == CLI_DONE && p->times.count > 2 && p->statistics.columns > 8)
        status = draw_components(p, "along", "Along t",
                                 "Each component at the times of observation.", draw_band);
    report_file(p->r, "failures.csv", "members that failed: failures.csv");
    report_file(p->r, "manifest.json", "what it was made with: manifest.json");
    return status;
}

/* The last of its heads in the files of this version, and the time that all rows have. */
static int read_table(const ensemble_page *p, csv_table *csv, const char *name, const char *head)
{
    char *path = cli_join(p->r->directory, name);
    int status = csv_table_read(csv, path);
    if (status == CLI_DONE) status = csv_table_require(csv, path, "t");
    if (status == CLI_DONE) status = csv_table_require(csv, path, head);
    free(path);
    return status;
}

int report_ensemble(report *r)
{
    ensemble_page *p = cli_calloc(1, sizeof *p);
    p->r = r;
    int status = read_table(p, &p->statistics, "statistics.csv", "deviation");
    if (status == CLI_DONE) status = read_table(p, &p->histograms, "histograms.csv", "count");
    if (status == CLI_DONE) status = read_table(p, &p->cloud, "cloud.csv", "member");
    for (int row = 1; status == CLI_DONE && row < p->statistics.rows; row++) {
        csv_add_word(&p->times, csv_table_get(&p->statistics, row, "t"));
        csv_add_word(&p->columns, csv_table_get(&p->statistics, row, "column"));
    }
    if (status == CLI_DONE && (p->times.count == 0 || p->cloud.columns != 4))
        status = cli_fail(CLI_USAGE, "'%s' has no statistics of an ensemble", r->directory);
    if (status == CLI_DONE) status = write_page(p);
    csv_table_free(&p->statistics);
    csv_table_free(&p->histograms);
    csv_table_free(&p->cloud);
    free(p);
    return status;
}

int report_after_ensemble(const char *directory, int status)
{
    char *statistics = cli_join(directory, "statistics.csv");
    const bool is_done = (status == CLI_DONE || status == CLI_FAILED) && file_exists(statistics);
    free(statistics);
    return is_done ? report_after(directory, status, report_ensemble) : status;
}
