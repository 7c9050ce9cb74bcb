/* report_plot.c - figures of curves: the data go into the gnuplot script, which then needs nothing
 * else, and what cannot be drawn never gets there. */
#include "io/gnuplot.h"
#include "report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the figure without its key, and of a row of the key. */
enum { WIDTH = 420, HEIGHT = 290, KEY_ROW = 16, KEY_COLUMNS = 2 };
/* Above and below the axes; between them at least and at most; left and right ends of the axes as
 * parts of the width. */
enum { ABOVE = 32, BELOW = 48, FRAME = ABOVE + BELOW, LEAST = 100, MOST = 340 };
#define LEFT  0.215
#define RIGHT 0.95

/* ---- points ---- */

plot_curve *report_curve(report_plot *plot, const char *title)
{
    plot_curve *curve = &plot->curve[plot->count++];
    *curve = (plot_curve){.count = 0};
    snprintf(curve->title, sizeof curve->title, "%s", title);
    return curve;
}

static void append(report_plot *plot, double x, double y)
{
    plot_curve *curve = &plot->curve[plot->count - 1];
    if (curve->count == curve->room) {
        curve->room = curve->room ? 2 * curve->room : 64;
        curve->at = cli_realloc(curve->at, (size_t)curve->room * sizeof *curve->at);
    }
    curve->at[curve->count][0] = x;
    curve->at[curve->count++][1] = y;
}

/* Points beside it have the same y: the one between says nothing. */
static void drop_level(plot_curve *curve)
{
    double(*at)[2] = curve->at + curve->count - 3;
    if (curve->count < 3 || at[0][1] != at[1][1] || at[1][1] != at[2][1]) return;
    at[1][0] = at[2][0];
    curve->count--;
}

void report_point(report_plot *plot, double x, double y)
{
    plot_curve *curve = &plot->curve[plot->count - 1];
    curve->values++;
    if (!(fabs(y) <= curve->max_abs)) curve->max_abs = fabs(y);
    if (!isfinite(x) || !isfinite(y) || (plot->log_x && x <= 0.0) || (plot->log_y && y <= 0.0))
        return;
    append(plot, x, y);
    if (!plot->marks) drop_level(curve);
}

void report_lift(report_plot *plot) { append(plot, NAN, NAN); }

const char report_envelope[] = "The maximum up to t; in brackets its slope over the last tenfold "
                               "of t: 0 constant, 1 linear.";

double report_slope(const plot_curve *curve)
{
    int last = curve->count - 1, first = last;
    if (last < 1) return NAN;
    while (first > 0 && curve->at[first][0] > 0.1 * curve->at[last][0] * (1.0 + 1e-9)) first--;
    const double *a = curve->at[first], *b = curve->at[last];
    return log(b[1] / a[1]) / log(b[0] / a[0]);
}

/* ---- the script ---- */

/* The points of a coordinate: how many, and between what they lie. */
static int range(const report_plot *plot, int k, double *least, double *most)
{
    int count = 0;
    *least = INFINITY;
    *most = -INFINITY;
    for (int i = 0; i < plot->count; i++)
        for (int j = 0; j < plot->curve[i].count; j++) {
            const double x = plot->curve[i].at[j][k];
            if (isnan(x)) continue;
            *least = fmin(*least, x);
            *most = fmax(*most, x);
            count++;
        }
    return count;
}

/* Labels stand at the powers of ten: what does not reach over two of them is given whole decades.
 */
static void put_decades(FILE *s, const char *axis, const report_plot *plot, int k)
{
    double least, most;
    range(plot, k, &least, &most);
    double below = floor(log10(least)), above = ceil(log10(most));
    if (above <= below) above = below + 1.0;
    if (k == 0 && most >= 100.0 * least) {
        fprintf(s, "set logscale %s\nset %srange [%.17g:%.17g]\nset format %s '%%g'\n", axis, axis,
                least, most, axis);
        return;
    }
    fprintf(s, "set logscale %s\nset %srange [1e%.0f:1e%.0f]\nset format %s '%s'\n", axis, axis,
            fmax(below, -307.0), fmin(above, 307.0), axis,
            below < -3.0 || above > 4.0 ? "%.0e" : "%g");
}

/* gnuplot wants a range of some width, about a constant, too. */
static void put_width(FILE *s, const char *axis, const report_plot *plot, int k)
{
    double least, most;
    range(plot, k, &least, &most);
    fprintf(s, "set format %s '%%.4g'\n", axis);
    if (most - least > 1e-12 * fmax(fabs(least), fabs(most))) return;
    const double wide = least == 0.0 ? 1.0 : 0.1 * fabs(least);
    fprintf(s, "set %srange [%.17g:%.17g]\n", axis, least - wide, most + wide);
}

static void put_axis(FILE *s, const char *axis, const report_plot *plot, int k, int log)
{
    if (log)
        put_decades(s, axis, plot, k);
    else
        put_width(s, axis, plot, k);
}

static void put_text(FILE *s, const char *what, const char *text)
{
    fprintf(s, "set %s ", what);
    gnuplot_quote(s, text);
    fputc('\n', s);
}

static int key_rows(const report_plot *plot)
{
    int titles = 0;
    for (int i = 0; i < plot->count; i++) titles += plot->curve[i].title[0] != '\0';
    return (titles + KEY_COLUMNS - 1) / KEY_COLUMNS;
}

/* One scale on both axes makes a figure as high as its path. */
static int figure_height(const report_plot *plot)
{
    double low[2], high[2], height = HEIGHT - FRAME;
    for (int k = 0; k < 2; k++) range(plot, k, &low[k], &high[k]);
    if (plot->alike && high[0] > low[0])
        height = (RIGHT - LEFT) * WIDTH * (high[1] - low[1]) / (high[0] - low[0]);
    height = fmin(fmax(height, LEAST), MOST);
    return FRAME + (int)height + KEY_ROW * key_rows(plot);
}

/* The key stands below, as wide as the figure. */
static void put_margins(FILE *s, const report_plot *plot)
{
    const double height = figure_height(plot), key = KEY_ROW * key_rows(plot);
    fprintf(s,
            "set lmargin at screen %.4f\nset rmargin at screen %.4f\n"
            "set tmargin at screen %.4f\nset bmargin at screen %.4f\n"
            "set key at screen 0.02, screen %.4f left top Left reverse maxrows %d samplen 2.5 "
            "width -1 font ',10'\n",
            LEFT, RIGHT, 1.0 - ABOVE / height, (BELOW + key) / height, (key + 3.0) / height,
            key_rows(plot));
}

/* One scale on both axes, and tics equally far apart: 1, 2 or 5 times a power of ten. */
static void put_alike(FILE *s, const report_plot *plot)
{
    double low, high, extent = 0.0;
    for (int k = 0; k < 2; k++) {
        range(plot, k, &low, &high);
        extent = fmax(extent, high - low);
    }
    fputs("set size ratio -1\nset offsets graph 0.06, graph 0.06, graph 0.06, graph 0.06\n", s);
    if (!(extent > 0.0)) return;
    const double least = extent / 6.0, power = pow(10.0, floor(log10(least)));
    const double times = least <= power ? 1.0 : least <= 2.0 * power ? 2.0 : 5.0;
    const double step = least <= 5.0 * power ? times * power : 10.0 * power;
    fprintf(s, "set xtics %.9g\nset ytics %.9g\n", step, step);
}

static void put_axes(FILE *s, const report_plot *plot)
{
    put_text(s, "title", plot->title);
    put_text(s, "xlabel offset 0,0.4", plot->xlabel);
    put_text(s, "ylabel", plot->ylabel);
    put_axis(s, "x", plot, 0, plot->log_x);
    put_axis(s, "y", plot, 1, plot->log_y);
    if (plot->alike) put_alike(s, plot);
    put_margins(s, plot);
}

static void put_data(FILE *s, const report_plot *plot)
{
    for (int i = 0; i < plot->count; i++) {
        const plot_curve *curve = &plot->curve[i];
        if (curve->count == 0) continue;
        fprintf(s, "$curve%d << END\n", i + 1);
        for (int j = 0; j < curve->count; j++) {
            if (isnan(curve->at[j][0]))
                fputc('\n', s);
            else
                fprintf(s, "%.9g,%.9g\n", curve->at[j][0], curve->at[j][1]);
        }
        fputs("END\n", s);
    }
}

/* A curve without points stands in the key alone. */
static void put_curves(FILE *s, const report_plot *plot)
{
    fputs("plot \\\n", s);
    for (int i = 0; i < plot->count; i++) {
        const plot_curve *curve = &plot->curve[i];
        if (curve->count)
            fprintf(s, "  $curve%d using 1:2 with %s ", i + 1,
                    curve->dots   ? "points pt 7 ps 0.2"
                    : plot->marks ? "linespoints"
                                  : "lines");
        else
            fprintf(s, "  keyentry with %s ", plot->marks ? "linespoints" : "lines");
        if (curve->ink)
            fputs("lw 1.2 lc rgb 'black'", s);
        else if (curve->dots)
            fprintf(s, "lc rgb '%s'", gnuplot_colour(i));
        else {
            fputs("lw 1.8 ", s);
            gnuplot_style(s, i);
        }
        if (plot->marks) fprintf(s, " pt %d ps 0.7", 4 + i % GNUPLOT_COLOURS);
        fputs(curve->title[0] ? " title " : " notitle", s);
        if (curve->title[0]) gnuplot_quote(s, curve->title);
        fputs(i + 1 < plot->count ? ", \\\n" : "\n", s);
    }
}

/* ---- the figure ---- */

/* "TITLE: YLABEL over XLABEL for A, B, C." */
static void describe(const report_plot *plot, char *alt, size_t size)
{
    size_t n =
        (size_t)snprintf(alt, size, "%s: %s over %s", plot->title, plot->ylabel, plot->xlabel);
    for (int i = 0, named = 0; i < plot->count && n < size; i++)
        if (plot->curve[i].title[0])
            n += (size_t)snprintf(alt + n, size - n, "%s%s", named++ ? ", " : " for ",
                                  plot->curve[i].title);
}

static int make_figure(report *r, const report_plot *plot)
{
    char *path, alt[2048];
    FILE *s = gnuplot_open(r->place, plot->name, r->format, WIDTH, figure_height(plot), &path);
    if (!s) return CLI_IO;
    put_axes(s, plot);
    put_data(s, plot);
    put_curves(s, plot);
    /* Without gnuplot the page goes on without figures: it has been told once. */
    int missing = r->missing, status = missing ? cli_close(s, path) : CLI_DONE;
    if (!missing) status = gnuplot_draw(r->place, s, path, &r->missing);
    free(path);
    if (r->missing) return missing ? status : CLI_DONE;
    describe(plot, alt, sizeof alt);
    return status == CLI_DONE ? report_embed(r, plot->name, alt, plot->caption) : status;
}

/* Whether there are values, and all of them are 0. */
static int is_zero(const report_plot *plot)
{
    int values = 0;
    for (int i = 0; i < plot->count; i++) {
        if (plot->curve[i].max_abs != 0.0) return 0;
        values += plot->curve[i].values;
    }
    return values > 0;
}

int report_draw(report *r, report_plot *plot)
{
    double least, most;
    int status = CLI_DONE, points = range(plot, 1, &least, &most);
    if (plot->nothing && is_zero(plot))
        report_paragraph(r->page, plot->nothing);
    else if (points > 0)
        status = make_figure(r, plot);
    for (int i = 0; i < plot->count; i++) free(plot->curve[i].at);
    plot->count = 0;
    return status;
}
