/* report_csv.c - CSV files in memory, for the report. */
#include "report.h"

#include "io/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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

static int take_text(report_csv *csv, char *text, const char *path)
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
    csv->cell = cli_calloc((size_t)csv->rows * (size_t)csv->columns + 1, sizeof *csv->cell);
    cut_rows(csv);
    return CLI_DONE;
}

/* Files of older versions had a column, or columns NAME_verdict. */
static int check_heads(const report_csv *csv, const char *path)
{
    static const char old[] = "verdict";
    for (int column = 0; column < csv->columns; column++) {
        const char *head = csv->cell[column];
        const size_t length = strlen(head), name = length - strlen(old);
        if (length < strlen(old) || strcmp(head + name, old) != 0) continue;
        return cli_fail(
            CLI_USAGE, "%s: of an older version: its column '%s' is now '%.*ssize' and '%.*strend'",
            path, head, (int)name, head, (int)name, head);
    }
    return CLI_DONE;
}

int report_csv_read(report_csv *csv, const char *path)
{
    size_t length;
    const int status = take_text(csv, file_read(path, &length), path);
    return status == CLI_DONE ? check_heads(csv, path) : status;
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

double report_csv_number(const report_csv *csv, int row, const char *head)
{
    const char *text = report_csv_get(csv, row, head);
    return *text ? strtod(text, NULL) : NAN;
}
