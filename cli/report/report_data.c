/* report_data.c - what report.js reads on a page: texts and numbers as JSON.
 *
 * An envelope is the largest value up to t, at times that lie ever further apart: each is the next
 * one of the table, or the first behind 1.06 times the one before.  The level of a value x is
 * 32768 + 256 log2 x, so that neighbouring ones are 0.3 % apart; 0 stands for x = 0 and 65535 for
 * what is not finite. */
#include "report_data.h"
#include "dalembert.h"
#include "ui/memory.h"

#include "io/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ZERO_LEVEL = 0, ONE_LEVEL = 32768, OCTAVE = 256, INFINITE_LEVEL = 65535, MAX_TIMES = 64 };
static const double spread = 1.06;

void data_write_string(FILE *page, const char *text)
{
    fputc('"', page);
    for (; *text; text++)
        if (*text == '"' || *text == '\\' || *text == '<' || (unsigned char)*text < ' ')
            fprintf(page, "\\u%04x", (unsigned)*text);
        else
            fputc(*text, page);
    fputc('"', page);
}

void data_write_number(FILE *page, double x)
{
    if (isfinite(x))
        fprintf(page, "%.9g", x);
    else
        fputs("null", page);
}

void data_write_levels(FILE *page, const uint16_t *level, int count)
{
    char *bytes = cli_malloc(2 * (size_t)count + 1);
    for (int i = 0; i < count; i++) {
        bytes[2 * i] = (char)(level[i] & 0xff);
        bytes[2 * i + 1] = (char)(level[i] >> 8);
    }
    fputc('"', page);
    report_base64(page, bytes, 2 * (size_t)count);
    fputc('"', page);
    free(bytes);
}

void data_begin(FILE *page) { fputs("<script type=\"application/json\" class=\"data\">{", page); }

void data_end(FILE *page) { fputs("}</script>\n", page); }

void data_write_motions(FILE *page, const motion *motions, int count)
{
    fputs("\"motions\":[", page);
    for (int i = 0, written = 0; i < count; i++) {
        if (motions[i].frames < 2) continue;
        if (written++) fputc(',', page);
        motion_write(page, &motions[i]);
    }
    fputc(']', page);
}

int data_write_run(report *r)
{
    motion m;
    const int status = motion_read(&m, r->directory, MOTION_RUN_FRAMES);
    if (m.frames > 1) {
        data_begin(r->page);
        data_write_motions(r->page, &m, 1);
        data_end(r->page);
    }
    motion_free(&m);
    return status;
}

/* ---- envelopes ----------------------------------------------------------------------------- */

/* The rows of a cell in series/LABEL.csv, which stand together: from first, count of them. */
typedef struct cell_rows {
    int first, count;
} cell_rows;

static bool is_same_cell(const report_csv *series, int a, int b)
{
    static const char *const heads[] = {"integrator", "start", "step"};
    for (int k = 0; k < 3; k++)
        if (!report_csv_is(series, a, heads[k], report_csv_get(series, b, heads[k]))) return false;
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

static void write_envelope(FILE *page, const report_csv *series, cell_rows cell, const char *column)
{
    int chosen[MAX_TIMES];
    uint16_t level[MAX_TIMES];
    const int count = choose_times(cell.count, chosen);
    double max = 0.0;
    for (int i = 0, next = 0; i < cell.count; i++) {
        const double x = report_csv_number(series, cell.first + i, column);
        if (x > max) max = x; /* a part of the time may be without rows */
        if (i + 1 == chosen[next]) level[next++] = level_of(max);
    }
    data_write_levels(page, level, count);
}

/* The cell of a row of cells.csv, with the quantities that are shown of its start. */
static void write_cell(const study_page *s, int row, int step, const report_csv *series,
                       cell_rows rows)
{
    FILE *page = s->r->page;
    const char *run = get_cell(s, row, "run");
    const bool is_displaced = is_cell(s, row, "start", "displaced");
    char *path = cli_format("%s/%s/report/index.html", s->r->directory, run);
    fputs("{\"method\":", page);
    data_write_string(page, get_cell(s, row, "integrator"));
    fprintf(page, ",\"step\":%d", step);
    fputs(",\"run\":", page);
    data_write_string(page, run);
    if (file_exists(path)) fputs(",\"page\":true", page);
    for (int k = 0; k < QUANTITIES; k++) {
        const quantity *t = &quantities[k];
        if (t->is_displaced != is_displaced || is_cell(s, row, t->value, "")) continue;
        fprintf(page, ",\"%s\":", t->name);
        write_envelope(page, series, rows, t->column);
    }
    fputc('}', page);
    free(path);
}

static int find_word(const report_words *words, const char *text)
{
    int i = 0;
    while (i < words->count && strcmp(words->word[i], text) != 0) i++;
    return i;
}

/* The times of each step, those of its longest cell. */
static void write_times(FILE *page, const report_csv *series, const cell_rows *longest,
                        const report_words *steps)
{
    int chosen[MAX_TIMES];
    char title[STEP_TITLE];
    fputs(",\"steps\":[", page);
    for (int h = 0; h < steps->count; h++) {
        const int count = choose_times(longest[h].count, chosen);
        fputs(h ? ",{\"h\":" : "{\"h\":", page);
        if (step_tolerance(steps->word[h]) > 0.0)
            data_write_string(page, step_title(title, steps->word[h]) + 4); /* without "h = " */
        else
            data_write_number(page, strtod(steps->word[h], NULL));
        fputs(",\"t\":[", page);
        for (int i = 0; i < count; i++) {
            fputs(i ? "," : "", page);
            data_write_number(page,
                              report_csv_number(series, longest[h].first + chosen[i] - 1, "until"));
        }
        fputs("]}", page);
    }
    fputs("]", page);
}

void data_write_envelopes(const study_page *s, const char *label, const report_words *steps,
                          const report_csv *series)
{
    FILE *page = s->r->page;
    cell_rows longest[REPORT_WORDS] = {{0, 0}};
    fputs("\"label\":", page);
    data_write_string(page, label);
    fputs(",\"cells\":[", page);
    for (int first = 1, end, written = 0; first < series->rows; first = end) {
        for (end = first + 1; end < series->rows && is_same_cell(series, first, end);) end++;
        const cell_rows rows = {first, end - first};
        const char *start = report_csv_get(series, first, "start");
        const char *step = report_csv_get(series, first, "step");
        const int h = find_word(steps, step);
        const int row = find_cell(s, label, report_csv_get(series, first, "integrator"), step,
                                  strcmp(start, "displaced") == 0);
        if (h == steps->count || row == 0 || !is_cell(s, row, "start", start)) continue;
        if (rows.count > longest[h].count) longest[h] = rows;
        fputs(written++ ? ",\n" : "", page);
        write_cell(s, row, h, series, rows);
    }
    fputc(']', page);
    write_times(page, series, longest, steps);
    fputc(',', page);
}
