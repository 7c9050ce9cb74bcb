/* csv_table.c - CSV files in memory */
#include "csv_table.h"

#include "file.h"
#include "text.h"
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

/* Counts rows, and columns of the first one.  All of them are whole. */
static int count_cells(csv_table *csv, const char *path, size_t length)
{
    bool quoted = false;
    char before = '\0';
    if (strlen(csv->text) < length)
        return cli_fail(CLI_USAGE, "%s: byte %zu is a NUL", path, strlen(csv->text) + 1);
    for (const char *c = csv->text; *c; before = *c++) {
        if (*c == '"') quoted = !quoted;
        if (quoted || (*c != ',' && *c != '\n')) continue;
        csv->columns += csv->rows == 0;
        csv->rows += *c == '\n';
    }
    if (csv->rows == 0) return cli_fail(CLI_USAGE, "'%s' has no rows", path);
    if (quoted || before != '\n')
        return cli_fail(CLI_USAGE, "%s:%d: the file ends within a row", path, csv->rows + 1);
    return CLI_DONE;
}

/* Cuts a row into cells, one for each head, and moves to the next row. */
static int cut_row(const csv_table *csv, const char *path, int row, char **next)
{
    char separator, **cell = csv->cell + (size_t)row * (size_t)csv->columns;
    int count = 0;
    do {
        char *text = *next;
        *next = cut_cell(text, &separator);
        if (count < csv->columns) cell[count] = text;
        count++;
    } while (separator == ',');
    if (count == csv->columns) return CLI_DONE;
    return cli_fail(CLI_USAGE, "%s:%d: %d columns, but the file has %d heads", path, row + 1, count,
                    csv->columns);
}

/* A head is a text, and nothing has a control character. */
static int check_cell(const csv_table *csv, const char *path, int row, int column)
{
    const char *text = csv->cell[row * csv->columns + column];
    const long control = text_find_control(text, "");
    if (row == 0 && !text[0])
        return cli_fail(CLI_USAGE, "%s:1: column %d has no head", path, column + 1);
    if (control < 0) return CLI_DONE;
    return cli_fail(CLI_USAGE, "%s:%d: column %d ('%s') has the control character U+%04lX", path,
                    row + 1, column + 1, csv->cell[column], (unsigned long)control);
}

static int cut_rows(csv_table *csv, const char *path)
{
    int status = CLI_DONE;
    char *next = csv->text;
    csv->cell = cli_calloc((size_t)csv->rows * (size_t)csv->columns, sizeof *csv->cell);
    for (int row = 0; row < csv->rows && status == CLI_DONE; row++) {
        status = cut_row(csv, path, row, &next);
        for (int column = 0; column < csv->columns && status == CLI_DONE; column++)
            status = check_cell(csv, path, row, column);
    }
    return status;
}

int csv_table_read(csv_table *csv, const char *path)
{
    size_t length;
    *csv = (csv_table){.text = file_read(path, &length)};
    if (!csv->text) return CLI_IO;
    int status = count_cells(csv, path, length);
    if (status == CLI_DONE) status = cut_rows(csv, path);
    if (status != CLI_DONE) csv_table_free(csv);
    return status;
}

void csv_table_free(csv_table *csv)
{
    free(csv->text);
    free(csv->cell);
    free(csv->appended);
    *csv = (csv_table){0};
}

const char *csv_table_get(const csv_table *csv, int row, const char *head)
{
    for (int column = 0; column < csv->columns; column++)
        if (strcmp(csv->cell[column], head) == 0) return csv->cell[row * csv->columns + column];
    return "";
}

void csv_table_append(csv_table *csv, const char *head, const char *other)
{
    size_t size = 1;
    int column = 0;
    while (column < csv->columns && strcmp(csv->cell[column], head) != 0) column++;
    if (column == csv->columns) return;
    for (int row = 1; row < csv->rows; row++)
        size += strlen(csv_table_get(csv, row, head)) + strlen(csv_table_get(csv, row, other)) + 2;
    char *next = csv->appended = cli_calloc(size, 1);
    for (int row = 1; row < csv->rows; row++) {
        const char *text = csv_table_get(csv, row, head);
        if (!(csv_table_number(csv, row, other) > 0.0)) continue;
        const int length = sprintf(next, "%s %s", text, csv_table_get(csv, row, other));
        csv->cell[row * csv->columns + column] = next;
        next += length + 1;
    }
}

int csv_table_require(const csv_table *csv, const char *path, const char *head)
{
    if (csv_table_is(csv, 0, head, head)) return CLI_DONE;
    return cli_fail(CLI_USAGE, "%s: there is no column '%s': another version of dalembert wrote it",
                    path, head);
}

double csv_table_number(const csv_table *csv, int row, const char *head)
{
    const char *text = csv_table_get(csv, row, head);
    return *text ? strtod(text, NULL) : NAN;
}

bool csv_table_is(const csv_table *csv, int row, const char *head, const char *text)
{
    return strcmp(csv_table_get(csv, row, head), text) == 0;
}

void csv_add_word(csv_words *words, const char *text)
{
    for (int i = 0; i < words->count; i++)
        if (strcmp(words->word[i], text) == 0) return;
    if (words->count < CSV_WORDS) words->word[words->count++] = text;
}
