/* spectrum.c - a run with tangent vectors: its means in rows, and what is told of them. */
#include "spectrum.h"
#include "io/gnuplot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Steps between two looks at the flag of interruption. */
enum { CHUNK = 200, ROWS_MOST = 100000000 };

int spectrum_take(spectrum_study *s, int option, const char *value)
{
    switch (option) {
    case SPECTRUM_transient:
        if (cli_number("--transient", value, &s->transient) != CLI_DONE) return CLI_USAGE;
        if (s->transient >= 0.0) return CLI_DONE;
        return cli_fail(CLI_USAGE, "--transient: %s is negative", value);
    case SPECTRUM_rows:
        return cli_integer("--rows", value, 1, ROWS_MOST, &s->rows);
    default:
        s->output = value;
        return CLI_DONE;
    }
}

int spectrum_make(spectrum_study *s)
{
    run_request *request = &s->request;
    const dal_system *tangent = NULL;
    dal_error error = {0};
    dal_run_spec spec;
    request->options.space = DAL_PHYSICAL;
    /* A run that is made and not used tells what is wrong with its options. */
    int status = request_create_run(request);
    if (status == CLI_DONE) status = request_make_spec(request, &spec);
    if (status != CLI_DONE) return status;
    /* Vakonomic systems have no tangent system; differences serve them. */
    dal_status made = dal_model_tangent(request->model, &tangent, &error);
    if (made == DAL_OK || made == DAL_UNSUPPORTED)
        made = dal_spectrum_create(&s->spectrum, &spec, tangent, (int)s->exponents, &error);
    return made == DAL_OK ? CLI_DONE
                          : cli_error(cli_input_exit(made), request->system_name, &error);
}

void spectrum_free(spectrum_study *s)
{
    dal_spectrum_free(s->spectrum);
    request_free(&s->request);
}

/* ---- the way ------------------------------------------------------------------------------- */

static int advance(spectrum_study *s, long long steps)
{
    const dal_run *run = dal_spectrum_run(s->spectrum);
    const double end = s->transient + s->request.time;
    dal_status status = DAL_OK;
    dal_error error = {0};
    while (steps > 0 && status == DAL_OK) {
        const long long count = steps < CHUNK ? steps : CHUNK;
        if (cli_interrupted()) return CLI_SIGNAL;
        cli_progress("t = %.6g of %.6g", dal_run_time(run), end);
        status = dal_spectrum_advance(s->spectrum, count, &error);
        steps -= count;
    }
    return status == DAL_OK ? CLI_DONE
                            : cli_error(cli_exit(status), s->request.system_name, &error);
}

static long long steps_in(const spectrum_study *s, double t)
{
    return llround(t / s->request.options.step);
}

static int put_row(spectrum_study *s, const spectrum_table *t, double *values)
{
    if (!s->table.path) return CLI_DONE;
    values[0] = dal_run_time(dal_spectrum_run(s->spectrum));
    t->fill(s->spectrum, values + 1);
    return writer_append(&s->table, values);
}

static int take_rows(spectrum_study *s, const spectrum_table *t, double *values)
{
    const long long total = steps_in(s, s->request.time);
    const long long rows = s->rows < total ? s->rows : total;
    int status = advance(s, steps_in(s, s->transient));
    dal_spectrum_forget(s->spectrum);
    s->from = dal_run_time(dal_spectrum_run(s->spectrum));
    for (long long k = 1, done = 0; k <= rows && status == CLI_DONE; k++) {
        const long long next = llround((double)k / (double)rows * (double)total);
        status = advance(s, next - done);
        done = next;
        if (status == CLI_DONE) status = put_row(s, t, values);
    }
    cli_progress_end();
    return status;
}

/* ---- the picture --------------------------------------------------------------------------- */

static int draw(const spectrum_study *s, const char *directory, const spectrum_table *t)
{
    char *path, title[256], method[128];
    int missing;
    FILE *script = gnuplot_open(directory, t->name, "svg", 800, 500, &path);
    if (!script) return CLI_IO;
    dal_method_name(&s->request.method, method, sizeof method);
    snprintf(title, sizeof title, "%.80s, %.80s, h = %g", s->request.system_name, method,
             s->request.options.step);
    fputs("set title ", script);
    gnuplot_quote(script, title);
    fprintf(script,
            "\nset xlabel 't'\nset ylabel '%s'\nset xrange [*:*] noextend\n"
            "set key outside right top Left reverse samplen 2\nplot \\\n",
            t->ylabel);
    for (int i = 1; i <= t->columns; i++) {
        fprintf(script, "  '%s.csv' using 1:%d with lines lw 1.4 dt %d lc rgb '%s' title ", t->name,
                i + 1, 1 + i / GNUPLOT_COLOURS,
                gnuplot_colour(GNUPLOT_COLOURS - 1 - i % GNUPLOT_COLOURS));
        gnuplot_quote(script, t->names[i]);
        fputs(i < t->columns ? ", \\\n" : "\n", script);
    }
    const int status = gnuplot_draw(directory, script, path, &missing);
    free(path);
    return status;
}

/* ---- the whole ----------------------------------------------------------------------------- */

int spectrum_run(spectrum_study *s, const spectrum_table *t)
{
    analysis_output place = {0};
    double *values = cli_calloc((size_t)t->columns + 1, sizeof *values);
    int status = request_check_step(&s->request, s->transient + s->request.time);
    if (status == CLI_DONE && s->output) status = analysis_open(&place, s->output, t->name);
    if (status == CLI_DONE && place.table)
        status = writer_create(&s->table, place.table, t->names, t->columns + 1);
    if (status == CLI_DONE) {
        cli_catch_signals();
        status = take_rows(s, t, values);
    }
    if (s->table.path) {
        const int closed = writer_close(&s->table);
        if (status == CLI_DONE) status = closed;
    }
    if (status == CLI_DONE && place.directory) status = draw(s, place.directory, t);
    free(place.table);
    free(values);
    return status;
}

/* ---- telling ------------------------------------------------------------------------------- */

void spectrum_print_head(const spectrum_study *s)
{
    char method[128];
    const dal_run *run = dal_spectrum_run(s->spectrum);
    dal_method_name(&s->request.method, method, sizeof method);
    printf("%s, %s, h = %g: means over t = %g .. %g\n", s->request.system_name, method,
           s->request.options.step, s->from, dal_run_time(run));
    printf("the derivative of the step %s\n\n", dal_spectrum_is_exact(s->spectrum)
                                                    ? "exact, by the tangent system"
                                                    : "by differences of order 8");
    printf("%-24s %12s %25s\n", "", "mean", "95 % interval");
}

void spectrum_print_mean(const char *name, const dal_average *a, const char *word)
{
    printf("%-24s %12.6g %12.5g %12.5g  %s\n", name, a->mean, a->low, a->high, word);
}

int spectrum_print_balance(spectrum_study *s)
{
    dal_balance b;
    dal_error error;
    if (dal_spectrum_balance(s->spectrum, &b, &error) != DAL_OK) {
        printf("sum less divergence: not compared: %s\n", error.message);
        return CLI_DONE;
    }
    printf("sum less divergence: %.2g; the error of the method is at most about %.2g\n",
           b.difference, b.margin);
    if (b.surface != 0.0)
        printf("(the surface that the method forces accounts for %.2g more)\n", b.surface);
    if (b.holds) return CLI_DONE;
    return cli_fail(CLI_FAILED,
                    "%s: the sum of the exponents differs from the mean divergence by %g, more "
                    "than %g: the derivative of the steps is not reliable",
                    s->request.system_name, b.difference, b.margin);
}

double spectrum_resolution(const spectrum_study *s)
{
    const double T = dal_run_time(dal_spectrum_run(s->spectrum)) - s->from;
    return log(fmax(T, 1.0) + 1.0) / fmax(T, 1.0);
}
