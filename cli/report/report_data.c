/* report_data.c - what report.js reads on a page: texts and numbers as JSON.
 *
 * An envelope is the largest value up to t, at times that lie ever further apart: each is the next
 * one of the table, or the first after 1.06 times the one before.  The level of a value x is
 * 32768 + 256 log2 x, so that neighbouring ones are 0.3 % apart; 0 is x = 0 and 65535 is what is
 * not finite. */
#include "report_data.h"
#include "ui/memory.h"

#include "io/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ZERO_LEVEL = 0, ONE_LEVEL = 32768, OCTAVE = 256, INFINITE_LEVEL = 65535, MAX_TIMES = 64 };
static const double spread = 1.06;

json_writer data_begin(FILE *page)
{
    json_writer data = {.out = page, .is_in_page = true};
    fputs("<script type=\"application/json\" class=\"data\">", page);
    json_open(&data, NULL, JSON_LINES);
    return data;
}

void data_end(json_writer *data)
{
    json_close(data);
    fputs("</script>\n", data->out);
}

void data_write_motions(json_writer *data, const motion *motions, int count)
{
    json_open_list(data, "motions", JSON_ON_ONE_LINE);
    for (int i = 0; i < count; i++)
        if (motions[i].frames > 1) motion_write(data, &motions[i]);
    json_close(data);
}

int data_write_run(report *r)
{
    motion pair[2];
    const int status = motion_read(&pair[0], &pair[1], r->directory, MOTION_RUN_FRAMES);
    if (pair[0].frames > 1) {
        json_writer data = data_begin(r->page);
        data_write_motions(&data, pair, 2);
        data_end(&data);
    }
    motion_free(&pair[0]);
    motion_free(&pair[1]);
    return status;
}

/* ---- envelopes ----------------------------------------------------------------------------- */

/* The rows of a cell in series/LABEL.csv, which are together: from first, count of them. */
typedef struct cell_rows {
    int first, count;
} cell_rows;

static bool is_same_cell(const csv_table *series, int a, int b)
{
    static const char *const heads[] = {"integrator", "start", "step"};
    for (int k = 0; k < 3; k++)
        if (!csv_table_is(series, a, heads[k], csv_table_get(series, b, heads[k]))) return false;
    return true;
}

/* Which of the rows of a cell are times of an envelope; their number. */
static int choose_times(int rows, int chosen[MAX_TIMES])
{
    int count = 0;
    for (int i = 1; i <= rows && count < MAX_TIMES; i = (int)fmax(i + 1, ceil(spread * i)))
        chosen[count++] = i;
    if (count > 0) chosen[count - 1] = rows;
    return count;
}

static uint16_t level_of(double x)
{
    if (!isfinite(x)) return INFINITE_LEVEL;
    if (x <= 0.0) return ZERO_LEVEL;
    return (uint16_t)fmin(fmax(lround(ONE_LEVEL + OCTAVE * log2(x)), 1), INFINITE_LEVEL - 1);
}

static void write_envelope(json_writer *data, const char *name, const csv_table *series,
                           cell_rows cell, const char *column)
{
    int chosen[MAX_TIMES];
    uint16_t level[MAX_TIMES];
    const int count = choose_times(cell.count, chosen);
    double max = 0.0;
    for (int i = 0, next = 0; i < cell.count; i++) {
        const double x = csv_table_number(series, cell.first + i, column);
        if (x > max) max = x; /* a part of the time may be without rows */
        if (i + 1 == chosen[next]) level[next++] = level_of(max);
    }
    report_put_levels(data, name, level, count);
}

/* The cell of a row of cells.csv, with the quantities that are shown of its start. */
static void write_cell(json_writer *data, const study_page *s, int row, int step,
                       const csv_table *series, cell_rows rows)
{
    const char *run = get_cell(s, row, "run");
    const cell_start start = is_cell(s, row, "start", "displaced") ? DISPLACED : ON_SURFACE;
    char *path = cli_format("%s/%s/report/index.html", s->r->directory, run);
    json_open(data, NULL, JSON_ON_ONE_LINE);
    json_put_text(data, "integrator", get_cell(s, row, "integrator"));
    json_put_integer(data, "step", step);
    json_put_text(data, "run", run);
    if (file_exists(path)) json_put_bool(data, "page", true);
    for (int k = 0; k < REPORT_QUANTITIES; k++) {
        const quantity *t = &quantities[k];
        if (t->start == start && !is_cell(s, row, t->value, ""))
            write_envelope(data, t->name, series, rows, t->column);
    }
    json_close(data);
    free(path);
}

static int find_word(const csv_words *words, const char *text)
{
    int i = 0;
    while (i < words->count && strcmp(words->word[i], text) != 0) i++;
    return i;
}

/* The times of each step, from its longest cell. */
static void write_times(json_writer *data, const csv_table *series, const cell_rows *longest,
                        const csv_words *steps)
{
    int chosen[MAX_TIMES];
    char title[STUDY_DIVISION];
    json_open_list(data, "steps", JSON_ON_ONE_LINE);
    for (int h = 0; h < steps->count; h++) {
        const int count = choose_times(longest[h].count, chosen);
        json_open(data, NULL, JSON_ON_ONE_LINE);
        if (step_tolerance(steps->word[h]) > 0.0)
            json_put_text(data, "h", step_title(title, steps->word[h]) + 4); /* without "h = " */
        else
            json_put_rounded(data, "h", strtod(steps->word[h], NULL));
        json_open_list(data, "t", JSON_ON_ONE_LINE);
        for (int i = 0; i < count; i++)
            json_put_rounded(data, NULL,
                             csv_table_number(series, longest[h].first + chosen[i] - 1, "until"));
        json_close(data);
        json_close(data);
    }
    json_close(data);
}

void data_write_envelopes(json_writer *data, const study_page *s, const char *label,
                          const csv_words *steps, const csv_table *series)
{
    cell_rows longest[CSV_WORDS] = {{0, 0}};
    json_put_text(data, "label", label);
    json_open_list(data, "cells", JSON_LINES);
    for (int first = 1, end; first < series->rows; first = end) {
        for (end = first + 1; end < series->rows && is_same_cell(series, first, end);) end++;
        const cell_rows rows = {first, end - first};
        const char *start = csv_table_get(series, first, "start");
        const char *step = csv_table_get(series, first, "step");
        const int h = find_word(steps, step);
        const int row = find_cell(s, label, csv_table_get(series, first, "integrator"), step,
                                  strcmp(start, "displaced") == 0 ? DISPLACED : ON_SURFACE);
        if (h == steps->count || row == 0 || !is_cell(s, row, "start", start)) continue;
        if (rows.count > longest[h].count) longest[h] = rows;
        write_cell(data, s, row, h, series, rows);
    }
    json_close(data);
    write_times(data, series, longest, steps);
}
