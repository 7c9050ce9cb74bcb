/* report_run.c - the page of a run: its coordinates, its path, and what should not change. */
#include "report.h"

#include "rows.h"

#include <stdlib.h>
#include <string.h>

/* Of more rows than these a figure shows every k-th; of more curves the first ones. */
enum { POINTS = 4000, CURVES = GNUPLOT_COLOURS };

typedef struct rows {
    cli_rows table;
    double *first; /* [columns] of the first row */
    long long stride;
    int coordinates; /* in columns 1.. */
    int observables; /* the first column behind the state */
} rows;

/* ---- reading ---- */

static int is_observable(const char *name)
{
    return strcmp(name, "E") == 0 || strcmp(name, "H") == 0 ||
           (name[0] == 'D' && name[1] && name[1 + strspn(name + 1, "0123456789")] == '\0');
}

/* t, q, q', rest of the state, then D1.., E, H, invariants, error.  A coordinate may be called D1
 * or E; only behind the velocities is a column an observable. */
static void find_columns(rows *r)
{
    const cli_rows *t = &r->table;
    while (1 + r->coordinates < t->columns && !strchr(t->name[1 + r->coordinates], '\''))
        r->coordinates++;
    for (r->observables = 1 + 2 * r->coordinates; r->observables < t->columns; r->observables++)
        if (is_observable(t->name[r->observables])) break;
}

/* Every stride-th row goes to DIR/report/run.dat, where gnuplot finds it. */
static int put_rows(rows *r, FILE *out)
{
    cli_rows *t = &r->table;
    int more;
    for (long long k = 0; (more = rows_next(t)) > 0; k++) {
        if (k == 0) memcpy(r->first, t->row, (size_t)t->columns * sizeof *r->first);
        if (k % r->stride) continue;
        for (int i = 0; i < t->columns; i++) {
            if (i) fputc(',', out);
            cli_put(out, t->row[i]);
        }
        fputc('\n', out);
    }
    return more < 0 ? CLI_IO : CLI_DONE;
}

static int read_rows(rows *r, const report *page)
{
    cli_rows *t = &r->table;
    if (t->count == 0) return cli_fail(CLI_USAGE, "'%s' has no rows", t->path);
    r->stride = 1 + t->count / POINTS;
    r->first = calloc((size_t)t->columns, sizeof *r->first);
    char *path = cli_join(page->place, "run.dat");
    FILE *out = path && r->first ? fopen(path, "w") : NULL;
    int status = CLI_DONE;
    if (!path || !r->first) status = cli_fail(CLI_IO, "out of memory");
    if (status == CLI_DONE && !out) status = cli_io("write", path);
    if (status == CLI_DONE) status = put_rows(r, out);
    if (out) {
        const int closed = cli_close(out, path);
        if (status == CLI_DONE) status = closed;
    }
    free(path);
    if (status == CLI_DONE) find_columns(r);
    return status;
}

/* ---- drawing ---- */

static const char *name_of(const rows *r, int column) { return r->table.name[column]; }

static void begin_panel(FILE *s, const char *title, const char *xlabel)
{
    fputs("set title ", s);
    gnuplot_quote(s, title);
    fputs("\nset xlabel ", s);
    gnuplot_quote(s, xlabel);
    fputc('\n', s);
}

static void put_curve(FILE *s, const char *using, const char *title, int i)
{
    fprintf(s, "%s  rows using %s with lines lw 1.6 lc rgb '%s' title ", i > 0 ? ", \\\n" : "",
            using, gnuplot_colour(CURVES - 1 - 2 * i % CURVES));
    gnuplot_quote(s, title);
}

static void draw_coordinates(FILE *s, const rows *r)
{
    char using[64];
    begin_panel(s, "coordinates", "t");
    fputs("plot \\\n", s);
    for (int i = 0; i < r->coordinates && i < CURVES; i++) {
        snprintf(using, sizeof using, "1:%d", 2 + i);
        put_curve(s, using, name_of(r, 1 + i), i);
    }
    fputc('\n', s);
}

static void draw_path(FILE *s, const rows *r)
{
    begin_panel(s, "path", name_of(r, 1));
    fputs("set ylabel ", s);
    gnuplot_quote(s, name_of(r, 2));
    fputs("\nset size ratio -1\nplot \\\n", s);
    put_curve(s, "2:3", "", 0);
    fputs("\nset size noratio\nunset ylabel\n", s);
}

/* What a run keeps is drawn as its distance from the first row, D and error as they are. */
static void draw_drift(FILE *s, const rows *r)
{
    char using[128], title[96];
    begin_panel(s, "what should be kept: |x|, or |x - x(0)|; 0 is drawn at 1e-17", "t");
    fputs("set logscale y\nset format y '%.0e'\nplot \\\n", s);
    for (int i = 0; r->observables + i < r->table.columns && i < CURVES; i++) {
        int column = r->observables + i;
        const char *name = name_of(r, column);
        int plain = strcmp(name, "error") == 0 || (name[0] == 'D' && is_observable(name));
        snprintf(using, sizeof using, "1:(least(abs($%d - (%.17g))))", column + 1,
                 plain ? 0.0 : r->first[column]);
        snprintf(title, sizeof title, plain ? "|%.80s|" : "|%.80s - first|", name);
        put_curve(s, using, title, i);
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
    int drift = r->observables<r->table.columns, plane = r->coordinates> 1;
    FILE *s = report_script(page, "run", 1100, drift ? 820 : 420, &path);
    if (!s) return CLI_IO;
    fputs("rows = 'run.dat'\nleast(x) = x > 1e-17 ? x : 1e-17\nset key inside left top\n"
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
    rows table = {.stride = 1};
    int status = rows_open(&table.table, r->directory);
    if (status != CLI_DONE) return status;
    status = read_rows(&table, r);
    if (status == CLI_DONE) {
        fputs("<title>A run</title></head><body>\n<h1>A run</h1>\n", r->page);
        status = draw(r, &table);
    }
    if (status == CLI_DONE) add_summary(r);
    free(table.first);
    rows_close(&table.table);
    return status;
}
