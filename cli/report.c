/* report.c - `dalembert report DIR`: figures by gnuplot and a page around them. */
#include "report.h"
#include "file.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* ---- texts ---- */

void report_text(FILE *page, const char *text)
{
    for (; *text; text++) {
        if (*text == '&')
            fputs("&amp;", page);
        else if (*text == '<')
            fputs("&lt;", page);
        else if (*text == '>')
            fputs("&gt;", page);
        else
            fputc(*text, page);
    }
}

/* ---- CSV ---- */

static int count_cells(const char *text, int *rows)
{
    int cells = 0, quoted = 0;
    *rows = 0;
    for (; *text; text++) {
        if (*text == '"') quoted = !quoted;
        if (quoted || (*text != ',' && *text != '\n')) continue;
        cells++;
        *rows += *text == '\n';
    }
    return cells;
}

/* Ends the cell at text with a NUL, its quotes resolved, and returns where the next begins. */
static char *cut_cell(char *text, char *separator)
{
    char *from = text, *to = text;
    int quoted = 0;
    for (; *from && (quoted || (*from != ',' && *from != '\n')); from++) {
        if (*from != '"') {
            *to++ = *from;
        } else if (quoted && from[1] == '"') {
            *to++ = *from++;
        } else {
            quoted = !quoted;
        }
    }
    *separator = *from;
    char *next = *from ? from + 1 : from;
    *to = '\0';
    return next;
}

/* Rows shorter than the heads get empty cells, longer ones lose the rest. */
static void cut_rows(report_csv *csv)
{
    char *at = csv->text, separator;
    for (int row = 0; row < csv->rows; row++) {
        int column = 0;
        do {
            char *cell = at;
            at = cut_cell(at, &separator);
            if (column < csv->columns) csv->cell[row * csv->columns + column++] = cell;
        } while (separator == ',');
        while (column < csv->columns) csv->cell[row * csv->columns + column++] = at + strlen(at);
    }
}

int report_csv_read(report_csv *csv, const char *path)
{
    size_t length;
    return report_csv_take(csv, file_read(path, &length), path);
}

int report_csv_take(report_csv *csv, char *text, const char *path)
{
    int rows;
    *csv = (report_csv){.text = text};
    if (!csv->text) return CLI_IO;
    char *end = strchr(csv->text, '\n');
    if (!end) return cli_fail(CLI_USAGE, "'%s' has no rows", path);
    *end = '\0';
    csv->columns = count_cells(csv->text, &rows) + 1;
    *end = '\n';
    count_cells(csv->text, &csv->rows);
    csv->cell = calloc((size_t)csv->rows * (size_t)csv->columns + 1, sizeof *csv->cell);
    if (!csv->cell) return cli_fail(CLI_IO, "out of memory");
    cut_rows(csv);
    return CLI_DONE;
}

void report_csv_free(report_csv *csv)
{
    free(csv->text);
    free(csv->cell);
    *csv = (report_csv){0};
}

const char *report_csv_get(const report_csv *csv, int row, const char *head)
{
    for (int column = 0; column < csv->columns; column++)
        if (strcmp(csv->cell[column], head) == 0) return csv->cell[row * csv->columns + column];
    return "";
}

/* ---- figures ---- */

FILE *report_script(report *r, const char *name, int width, int height, char **path)
{
    return gnuplot_open(r->place, name, r->format, width, height, path);
}

int report_draw(report *r, FILE *script, char *path, const char *name, const char *caption)
{
    int status = gnuplot_draw(r->place, script, path, &r->broken);
    free(path);
    if (status != CLI_DONE) return status;
    fputs("<figure><img src=\"", r->page);
    report_text(r->page, name);
    fprintf(r->page, ".%s\" alt=\"\"><figcaption>%s</figcaption></figure>\n", r->format, caption);
    return CLI_DONE;
}

/* ---- the page ---- */

static const char page_head[] =
    "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<style>\n"
    "body { font: 16px/1.5 system-ui, sans-serif; max-width: 76rem; margin: 2rem auto;\n"
    "       padding: 0 1rem; color: #222; }\n"
    "p { max-width: 46rem; }\n"
    "figure { margin: 1rem 0; } img { max-width: 100%; }\n"
    "figcaption { color: #555; max-width: 60rem; font-size: 0.9rem; }\n"
    "table { border-collapse: collapse; font-size: 0.85rem; display: block; overflow-x: auto; }\n"
    "th, td { padding: 0.15rem 0.5rem; text-align: right; white-space: nowrap; }\n"
    "th { font-weight: 600; } th:first-child, td:first-child { text-align: left; }\n"
    "th.turned { vertical-align: bottom; } th.turned span { writing-mode: vertical-rl;\n"
    "            transform: rotate(180deg); }\n"
    ".exact, .rounding { background: #d8efdc; } .bounded { background: #fdf3cf; }\n"
    ".drift, .power, .exponential { background: #f8d5cc; }\n"
    ".aborted, .data, .failed { background: #d9d9d9; }\n"
    "pre { font-size: 0.75rem; overflow-x: auto; }\n"
    "</style>\n";

static int open_page(report *r)
{
    r->place = cli_join(r->directory, "report");
    if (!r->place) return cli_fail(CLI_IO, "out of memory");
    int status = cli_directory(r->place);
    if (status != CLI_DONE) return status;
    r->page_path = cli_join(r->place, "index.html");
    if (!r->page_path) return cli_fail(CLI_IO, "out of memory");
    r->page = fopen(r->page_path, "w");
    if (!r->page) return cli_io("write", r->page_path);
    fputs(page_head, r->page);
    return CLI_DONE;
}

static int holds(const char *directory, const char *name)
{
    struct stat status;
    char *path = cli_join(directory, name);
    int found = path && stat(path, &status) == 0;
    free(path);
    return found;
}

static int make_report(report *r)
{
    const char *place = r->directory;
    int study = holds(place, "cells.csv");
    if (!study && !holds(place, "trajectory.npy") && !holds(place, "rows.csv"))
        return cli_fail(CLI_USAGE,
                        "'%s' holds neither a study (cells.csv) nor a run (trajectory.npy)", place);
    int status = open_page(r);
    if (status == CLI_DONE) status = study ? report_study(r) : report_run(r);
    if (r->page) {
        fputs("</body></html>\n", r->page);
        int closed = cli_close(r->page, r->page_path);
        if (status == CLI_DONE) status = closed;
    }
    if (status == CLI_DONE) printf("%s\n", r->page_path);
    free(r->place);
    free(r->page_path);
    return status == CLI_DONE ? cli_close(stdout, "standard output") : status;
}

#define OPTION_LIST(X) X(format, "svg|png", "what the figures are", "svg")

enum {
#define X(name, value, help, initial) OPTION_##name,
    OPTION_LIST(X)
#undef X
        OPTIONS
};

static const cli_option options[] = {
#define X(name, value, help, initial) {#name, value, help, initial},
    OPTION_LIST(X)
#undef X
};

static const char notes[] =
    "DIR is what 'dalembert study' or 'dalembert run --output DIR' made.  DIR/report gets a page,\n"
    "index.html, the figures, and the gnuplot scripts that draw them.  Needs gnuplot.\n";

static int take(report *r, int option, const char *value)
{
    if (option == OPTION_format) {
        r->format = value;
        if (strcmp(value, "svg") == 0 || strcmp(value, "png") == 0) return CLI_DONE;
        return cli_fail(CLI_USAGE, "--format: '%s' is neither svg nor png", value);
    }
    if (r->directory) return cli_fail(CLI_USAGE, "more than one DIR: '%s'", value);
    r->directory = value;
    return CLI_DONE;
}

int command_report(int argc, char **argv)
{
    report r = {.format = "svg"};
    cli_args args = cli_begin(argc, argv, options, OPTIONS, notes);
    const char *value;
    for (int k; (k = cli_next(&args, &value)) != CLI_STOP;) {
        int status = take(&r, k, value);
        if (status != CLI_DONE) cli_stop(&args, status);
    }
    if (args.status != CLI_GO_ON) return args.status;
    return r.directory ? make_report(&r) : cli_fail(CLI_USAGE, "the DIR is missing");
}
