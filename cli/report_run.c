/* report_run.c - the page of a run: its coordinates, its path, and what should not change. */
#include "report.h"

#include <stdlib.h>
#include <string.h>

/* Of more rows than these a figure shows every k-th; of more curves the first ones. */
enum { POINTS = 4000, CURVES = GNUPLOT_COLOURS };

typedef struct rows {
    report_csv head; /* the heads and the first row */
    long long count, stride;
    int coordinates; /* in columns 1.. */
    int observables; /* the first column behind the state */
} rows;

/* ---- reading ---- */

/* The first lines of a file, allocated; NULL when memory is out. */
static char *read_lines(FILE *file, int lines)
{
    size_t length = 0, room = 256;
    char *text = malloc(room);
    for (int c; text && lines > 0 && (c = fgetc(file)) != EOF; lines -= c == '\n') {
        text[length++] = (char)c;
        if (length < room) continue;
        char *more = realloc(text, room *= 2);
        if (!more) free(text);
        text = more;
    }
    if (text) text[length] = '\0';
    return text;
}

static long long count_lines(FILE *file)
{
    long long lines = 0;
    for (int c; (c = fgetc(file)) != EOF;) lines += c == '\n';
    return lines;
}

static int is_observable(const char *name)
{
    return strcmp(name, "E") == 0 || strcmp(name, "H") == 0 ||
           (name[0] == 'D' && name[1] && name[1 + strspn(name + 1, "0123456789")] == '\0');
}

/* t, q, q', rest of the state, then D1.., E, H, invariants, error.  A coordinate may be called D1
 * or E; only behind the velocities is a column an observable. */
static void find_columns(rows *r)
{
    const report_csv *csv = &r->head;
    int primes = 0;
    while (1 + r->coordinates < csv->columns && !strchr(csv->cell[1 + r->coordinates], '\''))
        r->coordinates++;
    primes = 1 + 2 * r->coordinates;
    for (r->observables = primes; r->observables < csv->columns; r->observables++)
        if (is_observable(csv->cell[r->observables])) break;
}

static int read_rows(rows *r, const char *path)
{
    FILE *file = fopen(path, "r");
    if (!file) return cli_io("read", path);
    char *text = read_lines(file, 2);
    int status = text ? report_csv_take(&r->head, text, path) : cli_fail(CLI_IO, "out of memory");
    r->count = 1 + count_lines(file);
    r->stride = 1 + r->count / POINTS;
    fclose(file);
    if (status == CLI_DONE && r->head.rows < 2)
        status = cli_fail(CLI_USAGE, "'%s' has no rows", path);
    if (status == CLI_DONE) find_columns(r);
    return status;
}

/* ---- drawing ---- */

static const char *name_of(const rows *r, int column) { return r->head.cell[column]; }

static const char *first_of(const rows *r, int column)
{
    return r->head.cell[r->head.columns + column];
}

static void begin_panel(FILE *s, const char *title, const char *xlabel)
{
    fputs("set title ", s);
    gnuplot_quote(s, title);
    fputs("\nset xlabel ", s);
    gnuplot_quote(s, xlabel);
    fputc('\n', s);
}

static void put_curve(FILE *s, const rows *r, const char *using, const char *title, int i)
{
    fprintf(s, "%s  rows every %lld using %s with lines lw 1.6 lc rgb '%s' title ",
            i > 0 ? ", \\\n" : "", r->stride, using, gnuplot_colour(CURVES - 1 - 2 * i % CURVES));
    gnuplot_quote(s, title);
}

static void draw_coordinates(FILE *s, const rows *r)
{
    char using[64];
    begin_panel(s, "coordinates", "t");
    fputs("plot \\\n", s);
    for (int i = 0; i < r->coordinates && i < CURVES; i++) {
        snprintf(using, sizeof using, "1:%d", 2 + i);
        put_curve(s, r, using, name_of(r, 1 + i), i);
    }
    fputc('\n', s);
}

static void draw_path(FILE *s, const rows *r)
{
    begin_panel(s, "path", name_of(r, 1));
    fputs("set ylabel ", s);
    gnuplot_quote(s, name_of(r, 2));
    fputs("\nset size ratio -1\nplot \\\n", s);
    put_curve(s, r, "2:3", "", 0);
    fputs("\nset size noratio\nunset ylabel\n", s);
}

/* What a run keeps is drawn as its distance from the first row, D and error as they are. */
static void draw_drift(FILE *s, const rows *r)
{
    char using[128], title[96];
    begin_panel(s, "what should be kept: |x|, or |x - x(0)|; 0 is drawn at 1e-17", "t");
    fputs("set logscale y\nset format y '%.0e'\nplot \\\n", s);
    for (int i = 0; r->observables + i < r->head.columns && i < CURVES; i++) {
        int column = r->observables + i;
        const char *name = name_of(r, column);
        int plain = strcmp(name, "error") == 0 || (name[0] == 'D' && is_observable(name));
        snprintf(using, sizeof using, "1:(least(abs($%d - (%.40s))))", column + 1,
                 plain ? "0" : first_of(r, column));
        snprintf(title, sizeof title, plain ? "|%.80s|" : "|%.80s - first|", name);
        put_curve(s, r, using, title, i);
    }
    fputs("\nunset logscale y\nset format y\n", s);
}

/* The panel of a row and column out of two by two, or over both columns. */
static void place(FILE *s, int row, int count, double left, double right)
{
    double height = 1.0 / count, bottom = (count - 1 - row) * height;
    fprintf(s, "set lmargin at screen %.3f\nset rmargin at screen %.3f\n", left, right);
    fprintf(s, "set bmargin at screen %.3f\nset tmargin at screen %.3f\n", bottom + 0.15 / count,
            bottom + 0.90 / count);
}

static int draw(report *page, const rows *r)
{
    char *path;
    int drift = r->observables<r->head.columns, plane = r->coordinates> 1;
    FILE *s = report_script(page, "run", 1100, drift ? 820 : 420, &path);
    if (!s) return CLI_IO;
    fputs("rows = '../rows.csv'\nleast(x) = x > 1e-17 ? x : 1e-17\nset key inside left top\n"
          "set multiplot\n",
          s);
    place(s, 0, 1 + drift, 0.08, plane ? 0.45 : 0.84);
    draw_coordinates(s, r);
    place(s, 0, 1 + drift, 0.62, 0.97);
    if (plane) draw_path(s, r);
    place(s, 1, 1 + drift, 0.08, 0.80);
    fputs("set key outside right top\n", s);
    if (drift) draw_drift(s, r);
    fputs("unset multiplot\n", s);
    return report_draw(page, s, path, "run", r->stride > 1 ? "Not every row is drawn." : "");
}

static void put_summary(FILE *page, const report_csv *csv)
{
    fputs("<h2>Summary</h2>\n<table>", page);
    for (int row = 0; row < csv->rows; row++) {
        fputs("<tr>", page);
        for (int column = 0; column < csv->columns; column++) {
            fputs(row == 0 ? "<th>" : "<td>", page);
            report_text(page, csv->cell[row * csv->columns + column]);
            fputs(row == 0 ? "</th>" : "</td>", page);
        }
        fputs("</tr>\n", page);
    }
    fputs("</table>\n", page);
}

/* summary.csv is there when the run is over. */
static void add_summary(report *r)
{
    report_csv csv = {0};
    char *path = cli_join(r->directory, "summary.csv");
    FILE *there = path ? fopen(path, "r") : NULL;
    if (there) {
        fclose(there);
        if (report_csv_read(&csv, path) == CLI_DONE) put_summary(r->page, &csv);
        report_csv_free(&csv);
    }
    free(path);
}

int report_run(report *r)
{
    rows table = {.count = 0};
    char *path = cli_join(r->directory, "rows.csv");
    int status = path ? read_rows(&table, path) : cli_fail(CLI_IO, "out of memory");
    if (status == CLI_DONE) {
        fputs("<title>A run</title></head><body>\n<h1>A run</h1>\n", r->page);
        status = draw(r, &table);
    }
    if (status == CLI_DONE) add_summary(r);
    report_csv_free(&table.head);
    free(path);
    return status;
}
