/* lyapunov.c - a run with tangent vectors, whose means
 * are the Lyapunov exponents and the rate of the volume of the phase space.
 *
 *     d/dt log(volume) = div (v, F) = trace F_v,     step: log|det J| / h
 *
 * On D = 0 the long-time mean is the same where log |grad D| stays bounded: D is constant on every
 * level, and the densities of the levels differ by a total derivative. */
#include "lyapunov.h"
#include "analysis.h"
#include "dalembert_evaluator.h"
#include "io/file.h"
#include "io/trajectory.h"
#include "lyapunov_results.h"
#include "run/request_json.h"
#include "run/row_times.h"
#include "run/simulation.h"
#include "ui/arguments.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/screen.h"
#include "ui/signals.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct lyapunov_settings {
    bool is_volume, json, details, force;
    screen_format format;
    run_simulation simulation;
    const char *output;
    lyapunov_page *page;
    double transient;
    long long rows, exponents; /* exponents: 0 for all */
} lyapunov_settings;

/* Steps between two polls of the signals. */
enum { CHUNK = 200, MAX_ROWS = 100000000, MAX_COLUMN_NAME = 24 };

typedef struct tangent_study {
    const lyapunov_settings *set;
    run_simulation *simulation;
    dal_lyapunov *spectrum;
    dal_jumps *jumps; /* of F, which end the means */
    double begin;     /* t at the beginning of the means */
    int status;       /* of the run */
    /* A table of the means so far: its name, which is the file's, and what it has beside t. */
    const char *name;
    int columns;
    char **heads;   /* [1 + columns] */
    double *values; /* [1 + columns] */
    trajectory_writer table;
} tangent_study;

/* ---- the run ------------------------------------------------------------------------------- */

static int create_spectrum(tangent_study *s)
{
    run_request *request = &s->simulation->request;
    const dal_system *tangent = NULL;
    dal_error error = {0};
    dal_run_spec spec;
    /* Creating a run of its own finds what is wrong with the options. */
    int status = request_check_forward(request);
    if (status == CLI_DONE) status = simulation_create(s->simulation);
    if (status == CLI_DONE) status = simulation_make_spec(s->simulation, &spec);
    if (status == CLI_DONE)
        status =
            row_times_check_step(request, request->from, s->set->transient + s->simulation->end);
    if (status != CLI_DONE) return status;
    if (dal_jumps_create(&s->jumps, s->simulation->model) != DAL_STATUS_OK)
        return cli_fail(CLI_IO, "%s: out of memory", request->system_name);
    dal_status made = dal_model_tangent(s->simulation->model, &tangent, &error);
    if (made == DAL_STATUS_OK)
        made =
            (spec.options.space == DAL_LIFTED ? dal_lyapunov_create_lifted : dal_lyapunov_create)(
                &s->spectrum, &spec, tangent, (int)s->set->exponents, &error);
    return made == DAL_STATUS_OK ? CLI_DONE
                                 : cli_error(cli_input_exit(made), request->system_name, &error);
}

/* Column i of the table and its name: t, lambda1, .., divergence or t, divergence, step. */
static double read_column(const tangent_study *s, int i, char name[MAX_COLUMN_NAME])
{
    dal_average a = {.mean = dal_run_time(dal_lyapunov_run(s->spectrum))};
    if (i == 0) {
        snprintf(name, MAX_COLUMN_NAME, "t");
    } else if (i == (s->set->is_volume ? 1 : s->columns)) {
        snprintf(name, MAX_COLUMN_NAME, "divergence");
        dal_lyapunov_divergence(s->spectrum, &a);
    } else if (s->set->is_volume) {
        snprintf(name, MAX_COLUMN_NAME, "step");
        dal_lyapunov_sum(s->spectrum, &a);
    } else {
        snprintf(name, MAX_COLUMN_NAME, "lambda%d", i);
        dal_lyapunov_exponent(s->spectrum, i - 1, &a);
    }
    return a.mean;
}

static void read_means(tangent_study *s)
{
    for (int i = 0; i <= s->columns; i++) s->values[i] = read_column(s, i, s->heads[i]);
}

static void allocate_columns(tangent_study *s)
{
    s->name = s->set->is_volume ? "volume" : "lyapunov";
    s->columns = s->set->is_volume ? 2 : dal_lyapunov_count(s->spectrum) + 1;
    const size_t heads = (size_t)s->columns + 1;
    s->values = cli_calloc(heads, sizeof *s->values);
    s->heads = cli_calloc(heads, sizeof *s->heads + MAX_COLUMN_NAME);
    for (size_t i = 0; i < heads; i++)
        s->heads[i] = (char *)(s->heads + heads) + i * MAX_COLUMN_NAME;
    read_means(s);
}

static int advance_spectrum(tangent_study *s, long long steps)
{
    const dal_run *run = dal_lyapunov_run(s->spectrum);
    dal_status status = DAL_STATUS_OK;
    dal_error error = {0};
    const long long chunk = dal_jumps_count(s->jumps) > 0 ? 1 : CHUNK;
    dal_jumps_passed(s->jumps, run);
    for (; steps > 0 && status == DAL_STATUS_OK; steps -= chunk) {
        if (cli_interrupted()) return CLI_SIGNAL;
        cli_progress("t = %.6g of %.6g", dal_run_time(run), s->set->transient + s->simulation->end);
        const double t = dal_run_time(run);
        status = dal_lyapunov_advance(s->spectrum, steps < chunk ? steps : chunk, &error);
        const char *passed = dal_jumps_passed(s->jumps, run);
        if (status == DAL_STATUS_OK && passed)
            return cli_fail(CLI_USAGE,
                            "%s: a branch of the %s changes between t = %g and %g, where F or its "
                            "derivative by a velocity jumps: tangent vectors do not pass it",
                            s->simulation->request.system_name, passed, t, dal_run_time(run));
    }
    return status == DAL_STATUS_OK
               ? CLI_DONE
               : cli_error(cli_exit(status), s->simulation->request.system_name, &error);
}

/* The transient, then the rows at equal distances; after a failure or a signal the means so far are
 * good. */
static int run_to_end(tangent_study *s)
{
    const double h = s->simulation->request.options.step;
    const long long total = llround((s->simulation->end - s->simulation->request.from) / h),
                    rows = s->set->rows < total ? s->set->rows : total;
    int status = advance_spectrum(s, llround(s->set->transient / h));
    dal_lyapunov_discard_transient(s->spectrum);
    s->begin = dal_run_time(dal_lyapunov_run(s->spectrum));
    for (long long k = 1, done = 0; k <= rows && status == CLI_DONE; k++) {
        const long long next = llround((double)k / (double)rows * (double)total);
        status = advance_spectrum(s, next - done);
        done = next;
        if (status != CLI_DONE) break;
        read_means(s);
        if (s->table.path) status = writer_append(&s->table, s->values);
    }
    cli_progress_end();
    return status;
}

static void put_means(json_writer *w, const void *results)
{
    const tangent_study *s = results;
    request_open_json(w, s->simulation, LYAPUNOV_WITHOUT);
    json_put_number(w, "transient", s->set->transient);
    json_close(w);
}

static int run_with_table(tangent_study *s)
{
    analysis_output output = {0};
    int status = s->set->output ? analysis_open(&output, s->set->output, s->name) : CLI_DONE;
    if (status == CLI_DONE && output.table)
        status = writer_create(&s->table, output.table, s->heads, s->columns + 1);
    if (status == CLI_DONE) {
        cli_catch_signals();
        status = run_to_end(s);
        if (status == CLI_SIGNAL) cli_fail(status, "interrupted; the means so far are kept");
    }
    const int closed = s->table.path ? writer_close(&s->table) : CLI_DONE;
    int written = CLI_DONE;
    if (status == CLI_DONE) status = closed;
    if ((status == CLI_DONE || status == CLI_SIGNAL) && output.directory)
        written = analysis_describe(&output, s->name, s->simulation, put_means, s);
    if (status == CLI_DONE) status = written;
    if (status == CLI_DONE && output.directory) status = s->set->page(output.directory, status);
    analysis_close(&output, status);
    return status;
}

/* ---- all ----------------------------------------------------------------------------------- */

static const cli_option options[] = {
    {"transient", "T0", "0", "time that passes before the means begin",
     CLI_NUMBER(lyapunov_settings, transient, 0.0, INFINITY)},
    {"rows", "N", "100", "rows of the table, at equal distances in t",
     CLI_INTEGER(lyapunov_settings, rows, 1, MAX_ROWS)},
    {"output", "DIR|FILE", NULL, "writes the means so far: .csv, .npy, or a directory with a page",
     CLI_ROW(cli_parse_output, lyapunov_settings, output)},
    ANALYSIS_FORCE_OPTION(lyapunov_settings),
    SCREEN_FORMAT_OPTION(lyapunov_settings),
    JSON_OPTION(lyapunov_settings),
    SCREEN_DETAILS_OPTION(lyapunov_settings),
    {"exponents", "K", NULL, "computes the K largest only",
     CLI_INTEGER(lyapunov_settings, exponents, 1, 1e6)},
};

static int print_results(const lyapunov_results *r, const lyapunov_settings *set)
{
    if (screen_is_wanted(set->format, set->json || set->details))
        return lyapunov_print_screen(r, set->format);
    (set->json ? lyapunov_put : lyapunov_print)(r);
    return cli_close(stdout, "standard output");
}

/* Prints the means, which after a failure are those so far. */
static int report_means(const tangent_study *s)
{
    dal_error error = {0};
    lyapunov_results r = {.is_volume = s->set->is_volume,
                          .simulation = s->simulation,
                          .spectrum = s->spectrum,
                          .transient = s->set->transient,
                          .begin = s->begin,
                          .status = s->status,
                          .reason = ""};
    if (dal_lyapunov_balance(s->spectrum, &r.balance, &error) != DAL_STATUS_OK)
        r.reason = error.message;
    const int printed = print_results(&r, s->set);
    if (printed != CLI_DONE || r.reason[0] || r.balance.holds) return printed;
    return cli_fail(CLI_FAILED,
                    "%s: the sum of the exponents differs from the mean divergence by %g, more "
                    "than %g: the derivative of the steps is not reliable",
                    s->simulation->request.system_name, r.balance.difference, r.balance.margin);
}

static int measure_means(lyapunov_settings *settings)
{
    tangent_study s = {.set = settings, .simulation = &settings->simulation};
    int status = analysis_check_output(settings->output, settings->json);
    if (status == CLI_DONE)
        status = screen_check_format(settings->format, "--json", settings->json);
    if (status == CLI_DONE)
        status = screen_check_format(settings->format, "--details", settings->details);
    if (status == CLI_DONE && !settings->force) status = analysis_check_directory(settings->output);
    if (status == CLI_DONE) status = create_spectrum(&s);
    if (status == CLI_DONE) {
        allocate_columns(&s);
        status = s.status = run_with_table(&s);
        const int printed = status == CLI_IO || status == CLI_USAGE ? status : report_means(&s);
        if (status == CLI_DONE) status = printed;
    }
    free(s.heads);
    free(s.values);
    dal_lyapunov_free(s.spectrum);
    dal_jumps_free(s.jumps);
    return status;
}

static int run_measurement(lyapunov_settings *s, const cli_command *command, int argc, char **argv)
{
    s->simulation = simulation_default();
    cli_option of_request[REQUEST_OPTIONS];
    memcpy(of_request, request_options, sizeof of_request);
    of_request[REQUEST_space].initial = "physical";
    cli_option_set sets[] = {
        CLI_OPTION_SET(options, s),
        simulation_options(&s->simulation, of_request, LYAPUNOV_WITHOUT),
    };
    sets[0].owner = "lyapunov";
    sets[0].count -= s->is_volume; /* the last one is of lyapunov alone */
    int status = cli_read_arguments(command, argc, argv, sets, 2);
    if (status == CLI_GO_ON) status = measure_means(s);
    simulation_free(&s->simulation);
    return status;
}

int lyapunov_measure(const cli_command *command, int argc, char **argv, lyapunov_page *page)
{
    lyapunov_settings s = {.page = page};
    return run_measurement(&s, command, argc, argv);
}

int lyapunov_measure_volume(const cli_command *command, int argc, char **argv, lyapunov_page *page)
{
    lyapunov_settings s = {.is_volume = true, .page = page};
    return run_measurement(&s, command, argc, argv);
}
