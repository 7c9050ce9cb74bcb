/* report_figure.c - the figure of one system of a study at one step. */
#include "report.h"

#include <stdlib.h>
#include <string.h>

enum { NAME = 80 };

typedef struct figure {
    const report_cells *c;
    const char *label, *step;
    const char *plain;       /* the start that shows the motion itself: surface, or physical */
    report_words methods;    /* all of the label */
    report_words shown;      /* those drawn as curves: without modifiers, if there are such */
    int has_D, has_E, has_H; /* some cell has numbers */
    const char *accuracy;    /* the column that tells errors: error_max, ... */
} figure;

static int belongs(const figure *f, int row)
{
    return report_is(f->c, row, "label", f->label) && report_is(f->c, row, "step", f->step);
}

/* A row counts when it is the motion itself, went to its end, and has a number to show. */
static int shows_work(const figure *f, int row)
{
    return belongs(f, row) && report_is(f->c, row, "start", f->plain) &&
           report_is(f->c, row, "state", "done") && report_get(f->c, row, f->accuracy)[0];
}

/* Which column can tell accuracy: the error, or what the system keeps. */
static const char *find_accuracy(const figure *f)
{
    static const char *const columns[] = {"error_max", "invariant_deviation", "E_deviation"};
    for (int row = 1; row < f->c->csv.rows; row++) {
        if (!belongs(f, row) || report_is(f->c, row, "start", "displaced")) continue;
        for (int k = 0; k < 3; k++) {
            int kept = k < 2 || !report_is(f->c, row, "E_verdict", "-");
            if (kept && report_get(f->c, row, columns[k])[0]) return columns[k];
        }
    }
    return NULL;
}

/* Whether a row of the figure has numbers: a run that was refused has none. */
static int has_numbers(const figure *f, int row)
{
    return belongs(f, row) && strcmp(report_get(f->c, row, "steps"), "0") != 0;
}

static void find_start(figure *f)
{
    f->plain = "displaced";
    for (int row = 1; row < f->c->csv.rows; row++)
        if (has_numbers(f, row) && strcmp(f->plain, "surface") != 0 &&
            !report_is(f->c, row, "start", "displaced"))
            f->plain = report_get(f->c, row, "start");
}

static void survey(figure *f)
{
    find_start(f);
    for (int row = 1; row < f->c->csv.rows; row++) {
        int plain = report_is(f->c, row, "start", f->plain);
        if (!has_numbers(f, row)) continue;
        report_add_word(&f->methods, report_get(f->c, row, "integrator"));
        f->has_D |= plain && report_get(f->c, row, "D_max")[0];
        f->has_E |= plain && report_get(f->c, row, "E_deviation")[0];
        f->has_H |=
            report_is(f->c, row, "start", "displaced") && report_get(f->c, row, "H_deviation")[0];
    }
    for (int m = 0; m < f->methods.count; m++)
        if (!strchr(f->methods.word[m], '+')) report_add_word(&f->shown, f->methods.word[m]);
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
    int i = report_word_at(&f->c->plain, base);
    if (i < 0) i = report_word_at(&f->c->methods, method);
    return i < 0 ? 0 : i;
}

/* lines lw 1.6 dt D lc rgb C: beyond the colours there are, dashes. */
static void put_style(FILE *s, const figure *f, const char *method, double width)
{
    int i = colour_of(f, method);
    fprintf(s, "with lines lw %g dt %d lc rgb '%s'", width, 1 + i / GNUPLOT_COLOURS,
            gnuplot_colour(i));
}

typedef struct panel {
    const char *title, *start, *column, *floor;
} panel;

static int panel_count(const figure *f)
{
    return f->has_D + f->has_E + f->has_H + (f->accuracy != NULL);
}

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
        gnuplot_quote(s, f->shown.word[i]);
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
        const char *method = report_get(f->c, row, "integrator");
        double evaluations = strtod(report_get(f->c, row, "evaluations"), NULL);
        double time = strtod(report_get(f->c, row, "time"), NULL);
        fprintf(s, "%.17g,%s,%d,%ld\n", evaluations / time, report_get(f->c, row, f->accuracy),
                strchr(method, '+') ? 6 : 7,
                strtol(gnuplot_colour(colour_of(f, method)) + 1, NULL, 16));
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
        gnuplot_quote(s, f->shown.word[i]);
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
    int has[] = {f->has_D, f->has_E, f->has_H}, count = panel_count(f), k = 0;
    for (int i = 0; i < 3; i++) {
        if (!has[i]) continue;
        place_panel(s, k++, count);
        draw_curves(s, f, &panels[i]);
    }
    if (f->accuracy) {
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
    gnuplot_quote(s, path);
    fputs("\nfloor_at(x, least) = x > least ? x : least\n", s);
    fprintf(s,
            "pick(m, start, name, least) = strcol('integrator') eq m && strcol('start') eq start "
            "\\\n    && column('step') == %s ? floor_at(column(name), least) : NaN\n",
            f->step);
    fputs("set format y '%.0e'\nunset key\nset multiplot title ", s);
    char title[2 * NAME];
    snprintf(title, sizeof title, "%.80s, h = %g", f->label, strtod(f->step, NULL));
    gnuplot_quote(s, title);
    fputc('\n', s);
    draw_panels(s, f);
    fputs("unset multiplot\n", s);
}

int report_figure(report *r, const report_cells *c, const char *label, const char *step, int number)
{
    figure *f = calloc(1, sizeof *f);
    char name[2 * NAME], *path;
    if (!f) return cli_fail(CLI_IO, "out of memory");
    *f = (figure){.c = c, .label = label, .step = step};
    survey(f);
    if (f->methods.count == 0) {
        free(f);
        fputs("<p>No run has numbers to show.</p>\n", r->page);
        return CLI_DONE;
    }
    snprintf(name, sizeof name, number > 1 ? "%.80s-%d" : "%.80s", label, number);
    FILE *script = report_script(r, name, 1200, panel_count(f) > 2 ? 820 : 480, &path);
    if (script) write_script(script, f);
    free(f);
    if (!script) return CLI_IO;
    return report_draw(r, script, path, name,
                       "Maxima within each hundredth of the time; what is smaller is drawn at "
                       "1e-17, H at 1e-26.");
}
