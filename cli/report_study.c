/* report_study.c - the page of a study: what becomes of D, E and H with each method.
 *
 * First three tables, methods against systems; then per system and step a figure of up to four
 * panels: D and E on p = pi = 0, H off it, and the error against the work. */
#include "report.h"

#include <stdlib.h>
#include <string.h>

enum { MANY = 512, NAME = 80 };

/* Distinct texts in the order of their first coming. */
typedef struct words {
    const char *word[MANY];
    int count;
} words;

static int word_at(const words *w, const char *text)
{
    for (int i = 0; i < w->count; i++)
        if (strcmp(w->word[i], text) == 0) return i;
    return -1;
}

static void add_word(words *w, const char *text)
{
    if (word_at(w, text) < 0 && w->count < MANY) w->word[w->count++] = text;
}

typedef struct cells {
    report_csv csv;
    words labels, methods;
    words plain; /* the methods that have no modifiers: each has a colour of its own */
} cells;

static const char *get(const cells *c, int row, const char *head)
{
    return report_csv_get(&c->csv, row, head);
}

static int is(const cells *c, int row, const char *head, const char *text)
{
    return strcmp(get(c, row, head), text) == 0;
}

/* ---- tables of verdicts ---- */

typedef struct theme {
    const char *title, *start, *other, *value, *verdict;
} theme;

static const theme themes[] = {
    {"Constraints: max |D| on p = π = 0", "surface", "physical", "D_max", "D_verdict"},
    {"Energy: max |E − E(0)| on p = π = 0", "surface", "physical", "E_deviation", "E_verdict"},
    {"Hamiltonian of the lift: max |H − H(0)|, started off p = π = 0", "displaced", "displaced",
     "H_deviation", "H_verdict"},
};

/* The row of a method and a label at the first step, -1 for none. */
static int find_row(const cells *c, const char *method, const char *label, const theme *t)
{
    int other = -1;
    for (int row = 1; row < c->csv.rows; row++) {
        if (!is(c, row, "label", label) || !is(c, row, "integrator", method)) continue;
        if (is(c, row, "start", t->start)) return row;
        if (other < 0 && is(c, row, "start", t->other)) other = row;
    }
    return other;
}

static void put_value(FILE *page, const cells *c, int row, const theme *t)
{
    const char *value = row < 0 ? "" : get(c, row, t->value);
    if (row >= 0 && is(c, row, "state", "failed"))
        fputs("<td class=\"failed\">failed</td>", page);
    else if (value[0])
        fprintf(page, "<td class=\"%s\">%.1e</td>", get(c, row, t->verdict), strtod(value, NULL));
    else
        fputs("<td></td>", page);
}

static void put_theme(FILE *page, const cells *c, const theme *t)
{
    fprintf(page, "<h3>%s</h3>\n<table><tr><th></th>", t->title);
    for (int i = 0; i < c->labels.count; i++) {
        fputs("<th class=\"turned\"><span>", page);
        report_text(page, c->labels.word[i]);
        fputs("</span></th>", page);
    }
    fputs("</tr>\n", page);
    for (int m = 0; m < c->methods.count; m++) {
        fputs("<tr><td>", page);
        report_text(page, c->methods.word[m]);
        fputs("</td>", page);
        for (int i = 0; i < c->labels.count; i++)
            put_value(page, c, find_row(c, c->methods.word[m], c->labels.word[i], t), t);
        fputs("</tr>\n", page);
    }
    fputs("</table>\n", page);
}

static const char introduction[] =
    "<p>Green: exact, or changed by rounding alone. Yellow: bounded. Red: drifts. Grey: the run\n"
    "broke off. Empty: there is no such quantity, or the method needs what the system lacks.</p>\n"
    "<p>On p = π = 0 a lifted method is the same method on (q,v), bit for bit. That a method is\n"
    "symplectic on the lift says nothing there about D or the energy: every one-step method,\n"
    "explicit Euler included, is the restriction of a symplectic one. D and E are kept, or not,\n"
    "for other reasons: the form of D, reversibility, projection. What symplecticity does keep\n"
    "shows off p = π = 0, in H. A projection has no canonical lift.</p>\n";

/* ---- figures ---- */

typedef struct figure {
    const cells *c;
    const char *label, *step;
    const char *plain;       /* the start that shows the motion itself: surface, or physical */
    words methods;           /* all of the label */
    words shown;             /* those drawn as curves: without modifiers, if there are such */
    int has_D, has_E, has_H; /* some cell has numbers */
    const char *accuracy;    /* the column that tells errors: error_max, ... */
} figure;

static int belongs(const figure *f, int row)
{
    return is(f->c, row, "label", f->label) && is(f->c, row, "step", f->step);
}

/* A row counts when it is the motion itself, went to its end, and has a number to show. */
static int shows_work(const figure *f, int row)
{
    return belongs(f, row) && is(f->c, row, "start", f->plain) && is(f->c, row, "state", "done") &&
           get(f->c, row, f->accuracy)[0];
}

/* Which column can tell accuracy: the error, or what the system keeps. */
static const char *find_accuracy(const figure *f)
{
    static const char *const columns[] = {"error_max", "invariant_deviation", "E_deviation"};
    for (int row = 1; row < f->c->csv.rows; row++) {
        if (!belongs(f, row) || is(f->c, row, "start", "displaced")) continue;
        for (int k = 0; k < 3; k++) {
            int kept = k < 2 || !is(f->c, row, "E_verdict", "-");
            if (kept && get(f->c, row, columns[k])[0]) return columns[k];
        }
    }
    return NULL;
}

static void survey(figure *f)
{
    f->plain = "displaced";
    for (int row = 1; row < f->c->csv.rows; row++) {
        if (!belongs(f, row)) continue;
        add_word(&f->methods, get(f->c, row, "integrator"));
        if (strcmp(f->plain, "surface") != 0 && !is(f->c, row, "start", "displaced"))
            f->plain = get(f->c, row, "start");
        f->has_D |= get(f->c, row, "D_max")[0] != '\0';
        f->has_E |= get(f->c, row, "E_deviation")[0] != '\0';
        f->has_H |= is(f->c, row, "start", "displaced") && get(f->c, row, "H_deviation")[0];
    }
    for (int m = 0; m < f->methods.count; m++)
        if (!strchr(f->methods.word[m], '+')) add_word(&f->shown, f->methods.word[m]);
    if (f->shown.count == 0) f->shown = f->methods;
    f->accuracy = find_accuracy(f);
    int points = 0;
    for (int row = 1; f->accuracy && row < f->c->csv.rows; row++) points += shows_work(f, row);
    if (points == 0) f->accuracy = NULL;
}

/* The same for a method in all figures, with modifiers or without. */
static int colour_of(const figure *f, const char *method)
{
    char base[NAME];
    snprintf(base, sizeof base, "%.*s", (int)strcspn(method, "+"), method);
    int i = word_at(&f->c->plain, base);
    return i < 0 ? word_at(&f->c->methods, method) : i;
}

/* lines lw 1.6 dt D lc rgb C: beyond the colours there are, dashes. */
static void put_style(FILE *s, const figure *f, const char *method, double width)
{
    int i = colour_of(f, method);
    fprintf(s, "with lines lw %g dt %d lc rgb '%s'", width, 1 + i / REPORT_COLOURS,
            report_colour(i));
}

typedef struct panel {
    const char *title, *start, *column, *floor;
} panel;

static void place_panel(FILE *s, int k, int count)
{
    int rows = count > 2 ? 2 : 1, row = k / 2, column = k % 2;
    double height = 0.94 / rows, bottom = (rows - 1 - row) * height;
    double left = count == 1 ? 0.07 : 0.07 + column * 0.39, width = count == 1 ? 0.70 : 0.32;
    fprintf(s, "set lmargin at screen %.3f\nset rmargin at screen %.3f\n", left, left + width);
    fprintf(s, "set bmargin at screen %.3f\nset tmargin at screen %.3f\n", bottom + 0.16 / rows,
            bottom + height - 0.09 / rows);
}

static void draw_curves(FILE *s, const figure *f, const panel *p)
{
    const char *more = strcmp(p->start, "displaced") == 0 ? ", p and pi displaced" : "";
    fprintf(s, "set title '%s%s'\nset xlabel 't'\nset logscale y\nunset logscale x\n", p->title,
            more);
    fputs("set xrange [*:*]\nset yrange [*:*]\nplot \\\n", s);
    for (int i = 0; i < f->shown.count; i++) {
        fputs("  series using 'until':(pick(", s);
        report_quote(s, f->shown.word[i]);
        fprintf(s, ", '%s', '%s', %s)) ", p->start, p->column, p->floor);
        put_style(s, f, f->shown.word[i], 1.6);
        fprintf(s, " notitle%s\n", i + 1 < f->shown.count ? ", \\" : "");
    }
}

/* One point per method: x, y, its mark and its colour. */
static void put_points(FILE *s, const figure *f)
{
    fputs("$work << END\n", s);
    for (int row = 1; row < f->c->csv.rows; row++) {
        if (!shows_work(f, row)) continue;
        const char *method = get(f->c, row, "integrator");
        double evaluations = strtod(get(f->c, row, "evaluations"), NULL);
        double time = strtod(get(f->c, row, "time"), NULL);
        fprintf(s, "%.17g,%s,%d,%ld\n", evaluations / time, get(f->c, row, f->accuracy),
                strchr(method, '+') ? 6 : 7,
                strtol(report_colour(colour_of(f, method)) + 1, NULL, 16));
    }
    fputs("END\n", s);
}

static void draw_work(FILE *s, const figure *f)
{
    const char *what = strcmp(f->accuracy, "error_max") == 0     ? "greatest error"
                       : strcmp(f->accuracy, "E_deviation") == 0 ? "greatest |E - E(0)|"
                                                                 : "greatest |I - I(0)|";
    put_points(s, f);
    fprintf(s, "set title '%s against work, open: with modifiers'\n", what);
    fputs("set xlabel 'evaluations per unit of t'\nset logscale xy\n"
          "set xrange [*:*] noextend\nset yrange [*:*]\nset offsets graph 0.06, graph 0.06\n"
          "plot $work using 1:(floor_at($2, 1e-17)):3:4 with points ps 1.1 lw 1.4 pt variable "
          "lc rgb variable notitle\n",
          s);
}

static void draw_legend(FILE *s, const figure *f)
{
    fputs("set lmargin at screen 0.80\nset rmargin at screen 0.99\nset tmargin at screen 0.93\n"
          "set bmargin at screen 0.1\nunset border\nunset tics\nunset title\nunset xlabel\n"
          "unset logscale\nset key at graph 0, graph 1 left top Left reverse samplen 2 "
          "spacing 1.3\nplot [0:1][0:1] \\\n",
          s);
    for (int i = 0; i < f->shown.count; i++) {
        fputs("  NaN ", s);
        put_style(s, f, f->shown.word[i], 3.0);
        fputs(" title ", s);
        report_quote(s, f->shown.word[i]);
        fputs(i + 1 < f->shown.count ? ", \\\n" : "\n", s);
    }
}

static void draw_panels(FILE *s, const figure *f)
{
    const panel panels[] = {
        {"max |D| within each hundredth of the time", f->plain, "D", "1e-17"},
        {"max |E - E(0)|", f->plain, "E", "1e-17"},
        {"max |H - H(0)|", "displaced", "H", "1e-26"},
    };
    int has[] = {f->has_D, f->has_E, f->has_H}, work = f->accuracy != NULL, k = 0;
    int count = has[0] + has[1] + has[2] + work;
    for (int i = 0; i < 3; i++) {
        if (!has[i]) continue;
        place_panel(s, k++, count);
        draw_curves(s, f, &panels[i]);
    }
    if (work) {
        place_panel(s, k, count);
        draw_work(s, f);
    }
    draw_legend(s, f);
}

static void write_script(FILE *s, const figure *f)
{
    char path[NAME + 32];
    snprintf(path, sizeof path, "../series/%.80s.csv", f->label);
    fputs("series = ", s);
    report_quote(s, path);
    fputs("\nfloor_at(x, least) = x > least ? x : least\n", s);
    fprintf(s,
            "pick(m, start, name, least) = strcol('integrator') eq m && strcol('start') eq start "
            "\\\n    && column('step') == %s ? floor_at(column(name), least) : NaN\n",
            f->step);
    fputs("set format y '%.0e'\nunset key\nset multiplot title ", s);
    char title[2 * NAME];
    snprintf(title, sizeof title, "%.80s, h = %g", f->label, strtod(f->step, NULL));
    report_quote(s, title);
    fputc('\n', s);
    draw_panels(s, f);
    fputs("unset multiplot\n", s);
}

static int draw_figure(report *r, const cells *c, const char *label, const char *step, int number)
{
    figure *f = calloc(1, sizeof *f);
    char name[2 * NAME], *path;
    if (!f) return cli_fail(CLI_IO, "out of memory");
    *f = (figure){.c = c, .label = label, .step = step};
    survey(f);
    snprintf(name, sizeof name, number > 1 ? "%.80s-%d" : "%.80s", label, number);
    FILE *script =
        report_script(r, name, 1200, f->has_D + f->has_E + f->has_H > 1 ? 820 : 480, &path);
    if (script) write_script(script, f);
    free(f);
    if (!script) return CLI_IO;
    return report_draw(r, script, path, name,
                       "Maxima within each hundredth of the time; what is smaller is drawn at "
                       "1e-17, H at 1e-26.");
}

/* All steps of a label. */
static int draw_label(report *r, const cells *c, const char *label)
{
    words steps = {.count = 0};
    int status = CLI_DONE;
    fputs("<h2>", r->page);
    report_text(r->page, label);
    fputs("</h2>\n", r->page);
    for (int row = 1; row < c->csv.rows; row++)
        if (is(c, row, "label", label)) add_word(&steps, get(c, row, "step"));
    for (int i = 0; i < steps.count && status == CLI_DONE; i++) {
        cli_progress("report: %s", label);
        status = draw_figure(r, c, label, steps.word[i], i + 1);
    }
    return status;
}

/* The tables of the study as they were printed. */
static void put_tables(report *r)
{
    char *path = cli_join(r->directory, "tables.txt");
    FILE *file = path ? fopen(path, "r") : NULL;
    free(path);
    if (!file) return;
    fputs("<h2>Tables</h2>\n<pre>", r->page);
    char line[512];
    while (fgets(line, sizeof line, file)) report_text(r->page, line);
    fputs("</pre>\n", r->page);
    fclose(file);
}

static int write_page(report *r, const cells *c)
{
    int status = CLI_DONE;
    fputs("<title>Study of drift</title></head><body>\n<h1>Study of drift</h1>\n", r->page);
    fputs(introduction, r->page);
    for (size_t k = 0; k < sizeof themes / sizeof themes[0]; k++) put_theme(r->page, c, &themes[k]);
    for (int i = 0; i < c->labels.count && status == CLI_DONE; i++)
        status = draw_label(r, c, c->labels.word[i]);
    cli_progress_end();
    put_tables(r);
    return status;
}

int report_study(report *r)
{
    cells *c = calloc(1, sizeof *c);
    char *path = cli_join(r->directory, "cells.csv");
    int status = c && path ? report_csv_read(&c->csv, path) : cli_fail(CLI_IO, "out of memory");
    for (int row = 1; status == CLI_DONE && row < c->csv.rows; row++) {
        add_word(&c->labels, get(c, row, "label"));
        add_word(&c->methods, get(c, row, "integrator"));
        if (!strchr(get(c, row, "integrator"), '+')) add_word(&c->plain, get(c, row, "integrator"));
    }
    if (status == CLI_DONE && c->labels.count == 0)
        status = cli_fail(CLI_USAGE, "'%s' has no rows", path);
    if (status == CLI_DONE) status = write_page(r, c);
    if (c) report_csv_free(&c->csv);
    free(c);
    free(path);
    return status;
}
