/* report_csv.c - CSV files in memory, for the report. */
#include "report_csv.h"

#include "io/file.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Ends the cell at text with a NUL, its quotes resolved, and returns where the next one begins. */
static char *cut_cell(char *text, char *separator)
{
    char *from = text, *to = text;
    for (bool quoted = false; *from && (quoted || (*from != ',' && *from != '\n')); from++) {
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

int report_csv_read(report_csv *csv, const char *path)
{
    size_t length;
    bool quoted = false;
    *csv = (report_csv){.text = file_read(path, &length)};
    if (!csv->text) return CLI_IO;
    for (const char *c = csv->text; *c; c++) {
        if (*c == '"') quoted = !quoted;
        if (quoted || (*c != ',' && *c != '\n')) continue;
        csv->columns += csv->rows == 0;
        csv->rows += *c == '\n';
    }
    if (csv->rows == 0) return cli_fail(CLI_USAGE, "'%s' has no rows", path);
    csv->cell = cli_calloc((size_t)csv->rows * (size_t)csv->columns + 1, sizeof *csv->cell);
    /* Rows shorter than the heads get empty cells, longer ones lose the rest. */
    char *next = csv->text, separator;
    for (int row = 0; row < csv->rows; row++) {
        int column = 0;
        do {
            char *cell = next;
            next = cut_cell(next, &separator);
            if (column < csv->columns) csv->cell[row * csv->columns + column++] = cell;
        } while (separator == ',');
        while (column < csv->columns)
            csv->cell[row * csv->columns + column++] = next + strlen(next);
    }
    return CLI_DONE;
}

void report_csv_free(report_csv *csv)
{
    free(csv->text);
    free(csv->cell);
    free(csv->appended);
    *csv = (report_csv){0};
}

const char *report_csv_get(const report_csv *csv, int row, const char *head)
{
    for (int column = 0; column < csv->columns; column++)
        if (strcmp(csv->cell[column], head) == 0) return csv->cell[row * csv->columns + column];
    return "";
}

void report_csv_append(report_csv *csv, const char *head, const char *other)
{
    size_t size = 1;
    int column = 0;
    while (column < csv->columns && strcmp(csv->cell[column], head) != 0) column++;
    if (column == csv->columns) return;
    for (int row = 1; row < csv->rows; row++)
        size +=
            strlen(report_csv_get(csv, row, head)) + strlen(report_csv_get(csv, row, other)) + 2;
    char *next = csv->appended = cli_calloc(size, 1);
    for (int row = 1; row < csv->rows; row++) {
        const char *text = report_csv_get(csv, row, head);
        if (!(report_csv_number(csv, row, other) > 0.0)) continue;
        const int length = sprintf(next, "%s %s", text, report_csv_get(csv, row, other));
        csv->cell[row * csv->columns + column] = next;
        next += length + 1;
    }
}

int report_csv_require(const report_csv *csv, const char *path, const char *head)
{
    if (report_csv_is(csv, 0, head, head)) return CLI_DONE;
    return cli_fail(CLI_USAGE, "%s: there is no column '%s': another version of dalembert wrote it",
                    path, head);
}

double report_csv_number(const report_csv *csv, int row, const char *head)
{
    const char *text = report_csv_get(csv, row, head);
    return *text ? strtod(text, NULL) : NAN;
}

bool report_csv_is(const report_csv *csv, int row, const char *head, const char *text)
{
    return strcmp(report_csv_get(csv, row, head), text) == 0;
}

void report_add_word(report_words *words, const char *text)
{
    for (int i = 0; i < words->count; i++)
        if (strcmp(words->word[i], text) == 0) return;
    if (words->count < REPORT_WORDS) words->word[words->count++] = text;
}
