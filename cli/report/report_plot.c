/* report_plot.c - figures of curves, written twice: as JSON on the page, of which its script makes
 * a chart, and as a script of gnuplot with its data, for papers. */
#include "report_plot.h"

#include "io/gnuplot.h"
#include "io/json.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* In a script, of the figure without its key, of a row of the key and of a row of names.  A letter
 * is about so wide. */
enum { WIDTH = GNUPLOT_WIDTH, HEIGHT = 245, KEY_ROW = 17, KEY_SAMPLE = 50, NAME_ROW = 20 };
static const double letter = 7.0;
/* Above and below the axes, and the range of the height between them; left and right ends of the
 * axes as fractions of the width. */
enum { ABOVE = 32, BELOW = 54, FRAME = ABOVE + BELOW, MIN_HEIGHT = 100, MAX_HEIGHT = 340 };
#define LEFT  0.23
#define NAMES 0.42 /* with names in rows */
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
    char suffix[PLOT_NOTE] = "";
    int last = curve->count - 1, first = last;
    if (curve->count == 0)
        snprintf(suffix, sizeof suffix, curve->max_abs == 0.0 ? " (0)" : " (not finite)");
    while (first > 0 && curve->at[first][0] > 0.1 * curve->at[last][0] * (1.0 + 1e-9)) first--;
    if (last >= 1) {
        const double *a = curve->at[first], *b = curve->at[last];
        const double slope = log(b[1] / a[1]) / log(b[0] / a[0]);
        if (isfinite(slope)) snprintf(suffix, sizeof suffix, " (%.1f)", fabs(slope));
    }
    memcpy(curve->note, suffix, sizeof suffix);
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

static void write_axis(const gnuplot *g, const char *axis, const report_plot *plot, int k,
                       bool is_log)
{
    FILE *s = g->script;
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
    fprintf(s, "set logscale %s\nset %srange ", axis, axis);
    if (k == 0 && max >= 100.0 * min)
        fprintf(s, "[%.17g:%.17g]\nset format %s '%%g'\n", min, max, axis);
    else
        fprintf(s, "[1e%.0f:1e%.0f]\nset format %s '%s'\n", fmax(below, -307.0), fmin(above, 307.0),
                axis,
                below >= -3.0 && above <= 4.0 ? "%g"
                : g->format == GNUPLOT_PDF    ? "$10^{%T}$"
                                              : "%.0e");
}

/* As many titles side by side as the longest leaves room for. */
static int key_columns(const report_plot *plot)
{
    size_t longest = 0;
    for (int i = 0; i < plot->count; i++) {
        const size_t length = strlen(plot->curve[i].title) + strlen(plot->curve[i].note);
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
    if (plot->rows > 0) return FRAME + NAME_ROW * plot->rows + KEY_ROW * key_rows(plot);
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

/* Tics equally far apart on both axes: 1, 2 or 5 times a power of ten. */
static void write_scale(FILE *s, const report_plot *plot)
{
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
    if (extent > 0.0) fprintf(s, "set xtics %.9g\nset ytics %.9g\n", times * power, times * power);
}

/* Names instead of numbers at the ordinates 1, 2, ..., from above. */
static void write_rows(const gnuplot *g, const report_plot *plot)
{
    fprintf(g->script, "set yrange [%d.5:0.5]\nset grid noytics\nset ytics (", plot->rows);
    for (int i = 0; i < plot->rows; i++) {
        gnuplot_quote(g, plot->row[i]);
        fprintf(g->script, " %d%s", i + 1, i + 1 < plot->rows ? ", " : ")\n");
    }
}

static void write_axes(const gnuplot *g, const report_plot *plot)
{
    FILE *s = g->script;
    const double height = figure_height(plot), key = KEY_ROW * key_rows(plot);
    gnuplot_set(g, "title offset 0,-0.4", plot->title);
    gnuplot_set(g, "xlabel offset 0,0.4", plot->xlabel);
    write_axis(g, "x", plot, 0, plot->log_x);
    write_axis(g, "y", plot, 1, plot->log_y);
    write_marks(s, plot);
    /* Dots on the frame would not be seen. */
    if (has_dots(plot)) fputs("set offsets 0, 0, graph 0.04, graph 0.04\n", s);
    if (plot->is_to_scale) write_scale(s, plot);
    if (plot->rows > 0) write_rows(g, plot);
    /* The key is below, as wide as the figure; the label of the ordinate is at the edge,
     * however wide the numbers beside it are. */
    gnuplot_set(g, "label 1", plot->ylabel);
    fprintf(s,
            "set label 1 at screen 0.035, graph 0.5 center rotate\n"
            "set lmargin at screen %.4f\nset rmargin at screen %.4f\n"
            "set tmargin at screen %.4f\nset bmargin at screen %.4f\n"
            "set key at screen 0.02, screen %.4f left top Left reverse maxrows %d maxcols %d "
            "samplen 2 width 1 font ',11.5'\n",
            plot->rows > 0 ? NAMES : LEFT, RIGHT, 1.0 - ABOVE / height, (BELOW + key) / height,
            (key + 3.0) / height, key_rows(plot), key_columns(plot));
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
                fprintf(s, "%.12g,%.9g,%.9g\n", curve->at[j][0], curve->at[j][1], curve->at[j][2]);
            else
                fprintf(s, "%.12g,%.9g\n", curve->at[j][0], curve->at[j][1]);
        fputs("END\n", s);
    }
}

static void write_title(const gnuplot *g, const plot_curve *curve)
{
    char title[PLOT_TITLE + PLOT_NOTE];
    snprintf(title, sizeof title, "%s%s", curve->title, curve->note);
    fputs(title[0] ? " title " : " notitle", g->script);
    if (title[0]) gnuplot_quote(g, title);
}

/* Filled, with both edges. */
static void write_band(const gnuplot *g, const report_plot *plot, int i)
{
    const char *colour = gnuplot_colour(plot->curve[i].colour);
    fprintf(g->script,
            "  $curve%d using 1:2:3 with filledcurves lc rgb '%s' fs transparent solid 0.4", i + 1,
            colour);
    write_title(g, &plot->curve[i]);
    for (int k = 2; k <= 3; k++)
        fprintf(g->script, ", \\\n  $curve%d using 1:%d with lines lw 1 lc rgb '%s' notitle", i + 1,
                k, colour);
}

/* A curve without points is in the key only. */
static void write_curve(const gnuplot *g, const report_plot *plot, int i)
{
    const plot_curve *curve = &plot->curve[i];
    const char *line = plot->has_marks ? "linespoints" : "lines";
    FILE *s = g->script;
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
    write_title(g, curve);
}

static int write_script(const report *r, const report_plot *plot)
{
    gnuplot g;
    const bool is_pdf = r->paper && strcmp(r->paper, "pdf") == 0;
    const int status = gnuplot_open(&g, r->place, plot->name, is_pdf ? GNUPLOT_PDF : GNUPLOT_SVG,
                                    figure_height(plot));
    if (status != CLI_DONE) return status;
    write_axes(&g, plot);
    write_data(g.script, plot);
    fputs("plot \\\n", g.script);
    for (int i = 0; i < plot->count; i++) {
        if (plot->curve[i].is_band)
            write_band(&g, plot, i);
        else
            write_curve(&g, plot, i);
        fputs(i + 1 < plot->count ? ", \\\n" : "\n", g.script);
    }
    return r->paper ? gnuplot_draw(&g, r->place) : gnuplot_close(&g);
}

/* ---- the chart ----------------------------------------------------------------------------- */

/* A millionth of the range of the values is less than a chart shows; digits: of all of them. */
static int find_digits(const plot_curve *curve, int k)
{
    enum { DIGITS = 6, MAX_DIGITS = 16 };
    double low = INFINITY, high = -INFINITY;
    for (int j = 0; j < curve->count; j++) {
        low = fmin(low, curve->at[j][k]);
        high = fmax(high, curve->at[j][k]);
    }
    const double before = log10(fmax(fabs(low), fabs(high)) / (high - low));
    return before > 0.0 && isfinite(before) ? (int)fmin(DIGITS + ceil(before), MAX_DIGITS) : DIGITS;
}

/* null ends a line. */
static void put_coordinate(json_writer *data, double x, int digits)
{
    char text[JSON_NUMBER];
    snprintf(text, sizeof text, "%.*g", digits, x);
    json_put_source(data, NULL, isfinite(x) ? text : "null");
}

static void put_coordinates(json_writer *data, const char *name, const plot_curve *curve, int k)
{
    const int digits = find_digits(curve, k);
    json_open_list(data, name, JSON_ON_ONE_LINE);
    for (int j = 0; j < curve->count; j++) put_coordinate(data, curve->at[j][k], digits);
    json_close(data);
}

static bool has_abscissas_of(const plot_curve *curve, const plot_curve *other)
{
    bool same = curve->count == other->count;
    for (int j = 0; same && j < curve->count; j++) same = curve->at[j][0] == other->at[j][0];
    return same;
}

/* The abscissas are a list, or the number of an earlier curve with points that has the same. */
static void put_curve(json_writer *data, const report_plot *plot, int i)
{
    const plot_curve *curve = &plot->curve[i];
    int same = 0, number = 0;
    for (; same < i && !has_abscissas_of(curve, &plot->curve[same]); same++)
        number += plot->curve[same].count > 0;
    json_open(data, NULL, JSON_ON_ONE_LINE);
    json_put_text(data, "title", curve->title);
    if (curve->note[0]) json_put_text(data, "note", curve->note);
    json_put_text(data, "kind",
                  curve->is_band     ? "band"
                  : curve->has_dots  ? "dots"
                  : curve->has_rings ? "rings"
                                     : "line");
    if (curve->is_black)
        json_put_bool(data, "black", true);
    else
        json_put_integer(data, "colour", curve->colour);
    if (same < i)
        json_put_integer(data, "x", number);
    else
        put_coordinates(data, "x", curve, 0);
    put_coordinates(data, "y", curve, 1);
    if (curve->is_band) put_coordinates(data, "upper", curve, 2);
    json_close(data);
}

static int make_figure(report *r, const report_plot *plot)
{
    const int status = write_script(r, plot);
    if (!report_begin_figure(r, plot->title, plot->caption)) return status;
    fputs("<script type=\"application/json\" class=\"figure\">", r->page);
    json_writer data = {.out = r->page, .is_in_page = true};
    json_open(&data, NULL, JSON_ON_ONE_LINE);
    json_put_text(&data, "name", plot->name);
    json_put_text(&data, "title", plot->title);
    json_put_text(&data, "x", plot->xlabel);
    json_put_text(&data, "y", plot->ylabel);
    if (plot->part) json_put_text(&data, "part", plot->part);
    if (plot->log_x) json_put_bool(&data, "logX", true);
    if (plot->log_y) json_put_bool(&data, "logY", true);
    if (plot->has_marks) json_put_bool(&data, "marks", true);
    if (plot->is_to_scale) json_put_bool(&data, "toScale", true);
    if (plot->from_zero) json_put_bool(&data, "fromZero", true);
    if (plot->rows > 0) {
        json_open_list(&data, "rows", JSON_ON_ONE_LINE);
        for (int i = 0; i < plot->rows; i++) json_put_text(&data, NULL, plot->row[i]);
        json_close(&data);
    }
    json_open_list(&data, "events", JSON_ON_ONE_LINE);
    for (int i = 0; i < plot->marks; i++) put_coordinate(&data, plot->mark[i], 9);
    json_close(&data);
    json_open_list(&data, "curves", JSON_ON_ONE_LINE);
    for (int i = 0; i < plot->count; i++)
        if (plot->curve[i].count > 0) put_curve(&data, plot, i);
    json_close(&data);
    json_close(&data);
    fputs("</script></figure>\n", r->page);
    return status;
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
