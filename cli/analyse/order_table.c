/* order_table.c - what is told of methods x steps: a table, a CSV file, and two diagrams. */
#include "io/gnuplot.h"
#include "order.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the table for the eye ----------------------------------------------------------------- */

/* " x", or " -" where there is no number. */
static void print_number(FILE *out, const char *format, int width, double x)
{
    char text[32];
    snprintf(text, sizeof text, format, x);
    fprintf(out, " %*s", width, isnan(x) ? "-" : text);
}

static void print_heads(FILE *out, const order_study *s)
{
    fprintf(out, "%-21s %13s  %-*s %15s\n", "", "order", 8 * s->levels - 1,
            "error at h =", "cost of a step");
    fprintf(out, "%-21s %6s %6s", "integrator", "stated", "found");
    for (int i = 0; i < s->levels; i++) print_number(out, "%.3g", 7, s->step[i]);
    fprintf(out, " %7s %7s\n", "F", "us");
}

/* Cost at the smallest step. */
static void print_method(FILE *out, const order_study *s, const order_method *m)
{
    const int last = s->levels - 1;
    const double steps = round(s->job.time / s->step[last]);
    const int went = m->why[last].status == DAL_OK;
    fprintf(out, "%-21s %6d", m->name, dal_method_order(&m->method));
    print_number(out, "%.2f", 6, m->order.order);
    for (int i = 0; i < s->levels; i++) print_number(out, "%.1e", 7, m->order.error[i]);
    print_number(out, "%.1f", 7, went ? (double)m->order.evaluations[last] / steps : NAN);
    print_number(out, "%.2f", 7, went ? 1e6 * m->seconds[last] / steps : NAN);
    fputc('\n', out);
}

/* The first reason of a method that did not go through at every step. */
static const char *reason(const order_method *m, int levels)
{
    for (int i = 0; i < levels; i++)
        if (m->why[i].status != DAL_OK) return m->why[i].message;
    return "";
}

static int any_without_order(const order_study *s)
{
    for (int i = 0; i < s->method_count; i++)
        if (s->methods[i].state != ORDER_REFUSED && isnan(s->methods[i].order.order)) return 1;
    return 0;
}

void order_print(FILE *out, const order_study *s)
{
    fprintf(out, "%s, error of (q,v) at t = %g, %s\nagainst %s\n\n", s->job.system, s->job.time,
            s->job.options.space == DAL_LIFTED ? "lifted" : "physical", s->judge);
    print_heads(out, s);
    for (int i = 0; i < s->method_count; i++)
        if (s->methods[i].state != ORDER_REFUSED) print_method(out, s, &s->methods[i]);
    if (any_without_order(s))
        fputs("\nno order found (-): the last slopes do not agree (the steps are too large), or\n"
              "fewer than three errors lie between rounding and half the solution\n",
              out);
    for (int i = 0; i < s->method_count; i++) {
        const order_method *m = &s->methods[i];
        if (m->state == ORDER_DONE) continue;
        fprintf(out, "\n%s: %s: %s", m->name, order_state_word(m->state), reason(m, s->levels));
    }
    fputs("\n", out);
}

/* ---- CSV ----------------------------------------------------------------------------------- */

static void put_number(FILE *out, double x)
{
    if (!isnan(x)) cli_put(out, x);
    fputc(',', out);
}

/* label, integrator, stated and observed order. */
static void put_method(FILE *out, const order_study *s, const order_method *m)
{
    cli_put_text(out, s->job.system);
    fputc(',', out);
    cli_put_text(out, m->name);
    fprintf(out, ",%d,", dal_method_order(&m->method));
    put_number(out, m->order.order);
}

static void put_level(FILE *out, const order_study *s, const order_method *m, int i)
{
    const int went = m->why[i].status == DAL_OK;
    put_method(out, s, m);
    put_number(out, s->step[i]);
    fprintf(out, "%lld,", llround(s->job.time / s->step[i]));
    put_number(out, m->order.error[i]);
    put_number(out, m->order.slope[i]);
    put_number(out, went ? (double)m->order.evaluations[i] : NAN);
    put_number(out, went ? m->seconds[i] : NAN);
    fprintf(out, "%s,", order_state_word(went ? ORDER_DONE : ORDER_FAILED));
    cli_put_text(out, m->why[i].message);
    fputc('\n', out);
}

static void put_refused(FILE *out, const order_study *s, const order_method *m)
{
    put_method(out, s, m);
    fprintf(out, ",,,,,,%s,", order_state_word(m->state));
    cli_put_text(out, reason(m, s->levels));
    fputc('\n', out);
}

int order_write(const order_study *s, const char *path)
{
    FILE *out = fopen(path, "w");
    if (!out) return cli_io("write", path);
    fputs("label,integrator,stated_order,observed_order,step,steps,error,slope,evaluations,seconds,"
          "state,message\n",
          out);
    for (int i = 0; i < s->method_count; i++) {
        const order_method *m = &s->methods[i];
        if (m->state == ORDER_REFUSED) put_refused(out, s, m);
        for (int k = 0; m->state != ORDER_REFUSED && k < s->levels; k++) put_level(out, s, m, k);
    }
    return cli_close(out, path);
}

/* ---- diagrams ------------------------------------------------------------------------------ */

static int is_drawn(const order_study *s, const order_method *m)
{
    for (int i = 0; i < s->levels; i++)
        if (m->order.error[i] > 0.0 && isfinite(m->order.error[i])) return 1;
    return 0;
}

/* One curve for each method; beyond the colours there are, dashes. */
static void put_curves(FILE *script, const order_study *s, const char *what)
{
    int drawn = 0;
    fputs("plot \\\n", script);
    for (int i = 0; i < s->method_count; i++) {
        const order_method *m = &s->methods[i];
        if (!is_drawn(s, m)) continue;
        fputs(drawn ? ", \\\n  'order.csv' using (is(" : "  'order.csv' using (is(", script);
        gnuplot_quote(script, m->name);
        fprintf(script,
                ") ? column('%s') : NaN):'error' with linespoints lw 1.4 ps 0.6 dt %d pt %d", what,
                1 + drawn / GNUPLOT_COLOURS, 7 - 2 * (drawn / GNUPLOT_COLOURS % 3));
        fprintf(script, " lc rgb '%s' title ", gnuplot_colour(drawn));
        gnuplot_quote(script, m->name);
        drawn++;
    }
    fputc('\n', script);
}

/* One panel of a figure, and what is along x. */
typedef struct panel {
    const char *label, *column, *format;
    double left, right; /* of the figure's width */
} panel;

static void put_panel(FILE *script, const order_study *s, const panel *p)
{
    fprintf(script,
            "set xlabel '%s'\nset format x '%s'\nset lmargin at screen %.3f\n"
            "set rmargin at screen %.3f\n",
            p->label, p->format, p->left, p->right);
    put_curves(script, s, p->column);
}

static int draw(const order_study *s, const char *directory, const char *name, const panel *panels,
                int count)
{
    char *path, title[2 * ORDER_NAME];
    int missing;
    FILE *script = gnuplot_open(directory, name, "svg", 1100, 600, &path);
    if (!script) return CLI_IO;
    snprintf(title, sizeof title, "%.80s: error of (q,v) at t = %g", s->job.system, s->job.time);
    fputs("is(name) = strcol('integrator') eq name && strcol('state') eq 'done'\n"
          "set logscale xy\nset format y '%.0e'\nset ylabel 'error'\n"
          "set xrange [*:*] noextend\nset offsets graph 0.05, graph 0.05\n"
          "set tmargin at screen 0.92\nset bmargin at screen 0.12\n"
          "set key at screen 0.79, screen 0.94 left top Left reverse samplen 2 maxrows 34 "
          "spacing 0.95 font ',9'\nset multiplot title ",
          script);
    gnuplot_quote(script, title);
    fputc('\n', script);
    for (int i = 0; i < count; i++) {
        put_panel(script, s, &panels[i]);
        fputs("unset key\nunset ylabel\n", script);
    }
    fputs("unset multiplot\n", script);
    const int status = gnuplot_draw(directory, script, path, &missing);
    free(path);
    return status;
}

int order_draw(const order_study *s, const char *directory)
{
    int curves = 0;
    for (int i = 0; i < s->method_count; i++) curves += is_drawn(s, &s->methods[i]);
    if (curves == 0) return CLI_DONE;
    const panel order = {"step h", "step", "%g", 0.09, 0.76};
    const panel work[] = {{"evaluations of F", "evaluations", "%g", 0.09, 0.41},
                          {"processor time in seconds", "seconds", "%.0e", 0.47, 0.76}};
    const int status = draw(s, directory, "order", &order, 1);
    return status == CLI_DONE ? draw(s, directory, "work", work, 2) : status;
}
