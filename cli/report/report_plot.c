/* report_plot.c - figures of curves: the data are part of the gnuplot script, which needs no other
 * file. */
#include "report_plot.h"

#include "io/gnuplot.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Of the figure without its key, and of a row of the key.  A page shows a figure at 0.97 of this
 * width at least, and no letter may be smaller than 11 there.  A letter is about so wide. */
enum { WIDTH = 360, HEIGHT = 270, KEY_ROW = 17, KEY_SAMPLE = 50 };
static const double letter = 7.0;
/* Above and below the axes, and the range of the height between them; left and right ends of the
 * axes as parts of the width. */
enum { ABOVE = 32, BELOW = 54, FRAME = ABOVE + BELOW, MIN_HEIGHT = 100, MAX_HEIGHT = 340 };
#define LEFT  0.215
#define RIGHT 0.95

/* ---- points -------------------------------------------------------------------------------- */

plot_curve *report_curve(report_plot *plot, const char *title)
{
    plot_curve *curve = &plot->curve[plot->count];
    *curve = (plot_curve){.colour = plot->count++};
    snprintf(curve->title, sizeof curve->title, "%s", title);
    return curve;
}

static void append_point(plot_curve *curve, double x, double y, double upper)
{
    if (curve->count == curve->capacity) {
        curve->capacity = curve->capacity ? 2 * curve->capacity : 64;
        curve->at = cli_realloc(curve->at, (size_t)curve->capacity * sizeof *curve->at);
    }
    double *at = curve->at[curve->count++];
    at[0] = x;
    at[1] = y;
    at[2] = upper;
}

void report_point(const report_plot *plot, plot_curve *curve, double x, double y)
{
    curve->values++;
    if (!(fabs(y) <= curve->max_abs)) curve->max_abs = fabs(y);
    if (!isfinite(x) || !isfinite(y) || (plot->log_x && x <= 0.0) || (plot->log_y && y <= 0.0))
        return;
    append_point(curve, x, y, y);
    if (plot->has_marks || curve->has_dots || curve->has_rings || curve->count < 3) return;
    /* A point on the level line between its neighbours is redundant. */
    double(*at)[3] = curve->at + curve->count - 3;
    if (at[0][1] != at[1][1] || at[1][1] != at[2][1]) return;
    at[1][0] = at[2][0];
    curve->count--;
}

void report_band(const report_plot *plot, plot_curve *curve, double x, double low, double high)
{
    curve->values++;
    curve->max_abs = fmax(curve->max_abs, fmax(fabs(low), fabs(high)));
    if (plot->log_y && low <= 0.0) return;
    append_point(curve, x, low, high);
}

void report_lift(plot_curve *curve) { append_point(curve, NAN, NAN, NAN); }

const char report_envelope_caption[] = "The maximum up to t; in brackets its slope over the last "
                                       "tenfold of t: 0 constant, 1 linear.";

void report_title_envelope(plot_curve *curve)
{
    char suffix[32] = "";
    int last = curve->count - 1, first = last;
    if (curve->count == 0)
        snprintf(suffix, sizeof suffix, curve->max_abs == 0.0 ? " (0)" : " (not finite)");
    while (first > 0 && curve->at[first][0] > 0.1 * curve->at[last][0] * (1.0 + 1e-9)) first--;
    if (last >= 1) {
        const double *a = curve->at[first], *b = curve->at[last];
        const double slope = log(b[1] / a[1]) / log(b[0] / a[0]);
        if (isfinite(slope)) snprintf(suffix, sizeof suffix, " (%.1f)", fabs(slope));
    }
    const size_t length = strlen(curve->title), limit = sizeof curve->title - sizeof suffix;
    snprintf(curve->title + (length < limit ? length : limit), sizeof suffix, "%s", suffix);
}

/* ---- the script ---------------------------------------------------------------------------- */

/* The range of coordinate k; returns the number of points. */
static int find_range(const report_plot *plot, int k, double *min, double *max)
{
    int count = 0;
    *min = INFINITY;
    *max = -INFINITY;
    for (int i = 0; i < plot->count; i++)
        for (int j = 0; j < plot->curve[i].count; j++) {
            const double *at = plot->curve[i].at[j];
            if (isnan(at[k])) continue;
            *min = fmin(*min, at[k]);
            *max = fmax(*max, k ? at[2] : at[0]);
            count++;
        }
    return count;
}

static void write_axis(FILE *s, const char *axis, const report_plot *plot, int k, bool is_log)
{
    double min, max;
    find_range(plot, k, &min, &max);
    if (!is_log) {
        fprintf(s, "set format %s '%%.4g'\n", axis);
        /* gnuplot needs a range of some width, about a constant, too. */
        const double width = min == 0.0 ? 1.0 : 0.1 * fabs(min);
        if (!(max - min > 1e-12 * fmax(fabs(min), fabs(max))))
            fprintf(s, "set %srange [%.17g:%.17g]\n", axis, min - width, max + width);
        if (k == 1 && plot->from_zero) fprintf(s, "set %srange [0:*]\n", axis);
        return;
    }
    /* Labels are at powers of ten: a range that does not hold two of them becomes one of whole
     * decades. */
    const double below = floor(log10(min)), above = fmax(ceil(log10(max)), below + 1.0);
    fprintf(s, "set logscale %s\nlog_%s = 1\nset %srange ", axis, axis, axis);
    if (k == 0 && max >= 100.0 * min)
        fprintf(s, "[%.17g:%.17g]\nset format %s '%%g'\n", min, max, axis);
    else
        fprintf(s, "[1e%.0f:1e%.0f]\nset format %s '%s'\n", fmax(below, -307.0), fmin(above, 307.0),
                axis, below < -3.0 || above > 4.0 ? "%.0e" : "%g");
}

/* As many titles side by side as the longest leaves room for. */
static int key_columns(const report_plot *plot)
{
    size_t longest = 0;
    for (int i = 0; i < plot->count; i++) {
        const size_t length = strlen(plot->curve[i].title);
        if (length > longest) longest = length;
    }
    return (int)fmax(1.0, WIDTH / (KEY_SAMPLE + letter * (double)longest));
}

static int key_rows(const report_plot *plot)
{
    const int columns = key_columns(plot);
    int titles = 0;
    for (int i = 0; i < plot->count; i++) titles += plot->curve[i].title[0] != '\0';
    return (titles + columns - 1) / columns;
}

static bool has_dots(const report_plot *plot)
{
    bool found = false;
    for (int i = 0; i < plot->count; i++) found |= plot->curve[i].has_dots;
    return found;
}

/* One scale on both axes makes a figure as high as its path. */
static int figure_height(const report_plot *plot)
{
    double low[2], high[2], height = HEIGHT - FRAME;
    for (int k = 0; k < 2; k++) find_range(plot, k, &low[k], &high[k]);
    if (plot->is_to_scale && high[0] > low[0])
        height = (RIGHT - LEFT) * WIDTH * (high[1] - low[1]) / (high[0] - low[0]);
    height = fmin(fmax(height, MIN_HEIGHT), MAX_HEIGHT);
    return FRAME + (int)height + KEY_ROW * key_rows(plot);
}

/* Vertical lines at the marks between the ends of the curves, no closer than they can be seen;
 * where they are many they are short. */
static void write_marks(FILE *s, const report_plot *plot)
{
    enum { MAX_LINES = 30, PLACES = 250 };
    double low, high, shown[PLACES + 1];
    int count = 0, last = -1;
    find_range(plot, 0, &low, &high);
    const double width = plot->log_x ? log(high / low) : high - low;
    for (int i = 0; i < plot->marks && width > 0.0; i++) {
        const double x = plot->mark[i];
        if (!(x >= low && x <= high)) continue;
        const int place = (int)(PLACES * (plot->log_x ? log(x / low) : x - low) / width);
        if (place == last || count > PLACES) continue;
        shown[count++] = x;
        last = place;
    }
    for (int i = 0; i < count; i++)
        fprintf(s,
                "set arrow from first %.9g, graph %g to first %.9g, graph 1 nohead back "
                "lw 0.7 lc rgb '#808080'\n",
                shown[i], count > MAX_LINES ? 0.95 : 0.0, shown[i]);
}

static void write_axes(FILE *s, const report_plot *plot)
{
    const double height = figure_height(plot), key = KEY_ROW * key_rows(plot);
    gnuplot_set(s, "title offset 0,-0.4", plot->title);
    gnuplot_set(s, "xlabel offset 0,0.4", plot->xlabel);
    write_axis(s, "x", plot, 0, plot->log_x);
    write_axis(s, "y", plot, 1, plot->log_y);
    write_marks(s, plot);
    /* Dots on the frame would not be seen. */
    if (has_dots(plot)) fputs("set offsets 0, 0, graph 0.04, graph 0.04\n", s);
    if (plot->is_to_scale) {
        /* Tics equally far apart on both axes: 1, 2 or 5 times a power of ten. */
        double low, high, extent = 0.0;
        for (int k = 0; k < 2; k++) {
            find_range(plot, k, &low, &high);
            extent = fmax(extent, high - low);
        }
        const double least = extent / 6.0, power = pow(10.0, floor(log10(least)));
        const double times = least <= power         ? 1.0
                             : least <= 2.0 * power ? 2.0
                             : least <= 5.0 * power ? 5.0
                                                    : 10.0;
        fputs("set size ratio -1\nset offsets graph 0.06, graph 0.06, graph 0.06, graph 0.06\n", s);
        if (extent > 0.0)
            fprintf(s, "set xtics %.9g\nset ytics %.9g\n", times * power, times * power);
    }
    /* The key is below, as wide as the figure; the label of the ordinate is at the edge,
     * however wide the numbers beside it are. */
    gnuplot_set(s, "label 1", plot->ylabel);
    fprintf(s,
            "set label 1 at screen 0.035, graph 0.5 center rotate\n"
            "set lmargin at screen %.4f\nset rmargin at screen %.4f\n"
            "set tmargin at screen %.4f\nset bmargin at screen %.4f\n"
            "set key at screen 0.02, screen %.4f left top Left reverse maxrows %d maxcols %d "
            "samplen 2 width 1 font ',11.5'\n",
            LEFT, RIGHT, 1.0 - ABOVE / height, (BELOW + key) / height, (key + 3.0) / height,
            key_rows(plot), key_columns(plot));
}

static void write_data(FILE *s, const report_plot *plot)
{
    for (int i = 0; i < plot->count; i++) {
        const plot_curve *curve = &plot->curve[i];
        if (curve->count == 0) continue;
        fprintf(s, "$curve%d << END\n", i + 1);
        for (int j = 0; j < curve->count; j++)
            if (isnan(curve->at[j][0]))
                fputc('\n', s);
            else if (curve->is_band)
                fprintf(s, "%.9g,%.9g,%.9g\n", curve->at[j][0], curve->at[j][1], curve->at[j][2]);
            else
                fprintf(s, "%.9g,%.9g\n", curve->at[j][0], curve->at[j][1]);
        fputs("END\n", s);
    }
}

static void write_title(FILE *s, const char *title)
{
    fputs(title[0] ? " title " : " notitle", s);
    if (title[0]) gnuplot_quote(s, title);
}

/* Filled, with both edges. */
static void write_band(FILE *s, const report_plot *plot, int i)
{
    const char *colour = gnuplot_colour(plot->curve[i].colour);
    fprintf(s, "  $curve%d using 1:2:3 with filledcurves lc rgb '%s' fs transparent solid 0.4",
            i + 1, colour);
    write_title(s, plot->curve[i].title);
    for (int k = 2; k <= 3; k++)
        fprintf(s, ", \\\n  $curve%d using 1:%d with lines lw 1 lc rgb '%s' notitle", i + 1, k,
                colour);
}

/* A curve without points is in the key only. */
static void write_curve(FILE *s, const report_plot *plot, int i)
{
    const plot_curve *curve = &plot->curve[i];
    const char *line = plot->has_marks ? "linespoints" : "lines";
    if (curve->count)
        fprintf(s, "  $curve%d using 1:2 with %s ", i + 1,
                curve->has_dots    ? "points pt 7 ps 0.3"
                : curve->has_rings ? "points pt 6 ps 0.8 lw 1.5"
                                   : line);
    else
        fprintf(s, "  keyentry with %s ", line);
    if (curve->is_black)
        fputs("lw 1.2 lc rgb 'black'", s);
    else if (curve->has_dots || curve->has_rings)
        fprintf(s, "lc rgb '%s'", gnuplot_colour(curve->colour));
    else {
        fputs("lw 1.8 ", s);
        gnuplot_style(s, curve->colour);
    }
    if (plot->has_marks) fprintf(s, " pt %d ps 0.7", 4 + curve->colour % GNUPLOT_COLOURS);
    write_title(s, curve->title);
}

static void write_curves(FILE *s, const report_plot *plot)
{
    write_data(s, plot);
    fputs("plot \\\n", s);
    for (int i = 0; i < plot->count; i++) {
        if (plot->curve[i].is_band)
            write_band(s, plot, i);
        else
            write_curve(s, plot, i);
        fputs(i + 1 < plot->count ? ", \\\n" : "\n", s);
    }
}

/* ---- the figure ---------------------------------------------------------------------------- */

static int make_figure(report *r, const report_plot *plot)
{
    char *path, alt[2048];
    FILE *s = gnuplot_open(r->place, plot->name, r->format, WIDTH, figure_height(plot), &path);
    if (!s) return CLI_IO;
    write_axes(s, plot);
    write_curves(s, plot);
    /* Without gnuplot the page has no figures; the first one has printed the message. */
    int status;
    bool missing = false;
    if (r->lacks_gnuplot) {
        status = cli_close(s, path);
    } else {
        status = gnuplot_draw(r->place, s, path, &missing);
        if (missing) status = CLI_DONE;
    }
    r->lacks_gnuplot |= missing;
    free(path);
    if (r->lacks_gnuplot || status != CLI_DONE) return status;
    /* "TITLE: YLABEL over XLABEL for A, B, C" */
    size_t n = (size_t)snprintf(alt, sizeof alt, "%s: %s over %s", plot->title, plot->ylabel,
                                plot->xlabel);
    for (int i = 0, named = 0; i < plot->count && n < sizeof alt; i++)
        if (plot->curve[i].title[0])
            n += (size_t)snprintf(alt + n, sizeof alt - n, "%s%s", named++ ? ", " : " for ",
                                  plot->curve[i].title);
    return report_embed(r, plot->name, alt, plot->caption);
}

int report_draw(report *r, report_plot *plot)
{
    double min, max;
    int status = CLI_DONE, values = 0;
    bool is_zero = plot->zero_text != NULL;
    for (int i = 0; i < plot->count; i++) {
        is_zero &= plot->curve[i].max_abs == 0.0;
        values += plot->curve[i].values;
    }
    if (is_zero && values > 0) {
        report_element(r->page, "p", plot->zero_text);
        fputc('\n', r->page);
    } else if (find_range(plot, 1, &min, &max) > 0) {
        status = make_figure(r, plot);
    }
    for (int i = 0; i < plot->count; i++) free(plot->curve[i].at);
    plot->count = 0;
    return status;
}
