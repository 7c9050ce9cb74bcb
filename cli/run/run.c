/* run.c - `dalembert run`: integrates one system and writes rows. */
#include "run.h"
#include "io/output.h"

#include "recorder.h"

#include <string.h>
#include <unistd.h>

const cli_option run_options[RUN_OWN] = {RUN_OPTION_LIST(CLI_OPTION)};

static const char run_notes[] =
    "SYSTEM is a built-in name ('dalembert list systems') or the path of a system file.\n"
    "\n"
    "Rows are CSV with 17 digits: t, the coordinates, the velocities, on the lifted space e, p_*,\n"
    "pi_*, pi_e, then D1.., E, H, the invariants and error; N+1 rows, from t = 0 to exactly T.\n"
    "FILE.npy holds the same as an array of numpy with the names of the columns.\n"
    "A directory gets manifest.json, system.yaml (when SYSTEM is a file),\n"
    "trajectory.npy, summary.csv and a checkpoint; 'dalembert resume DIR' goes on with it after "
    "any interruption,\n"
    "kill -9 included, and ends in the same bytes.\n"
    "\n"
    "The summary follows every observable at every step: maximum, final value, amplitude of its\n"
    "oscillation, drift rate with its 95 % interval, exponent of growth; its size: exact, "
    "rounding\n"
    "or larger; and its trend: none, settles, random walk, linear, power law, exponential, "
    "growing\n"
    "oscillation, undecided or aborted, with a confidence.  E has neither size nor trend where "
    "the\n"
    "motion does not conserve it.\n";

int run_parse_interval(const char *text, double *interval)
{
    int status = cli_number("--checkpoint", text, interval);
    if (status == CLI_DONE && *interval < 0.0)
        return cli_fail(CLI_USAGE, "--checkpoint: %s is negative", text);
    return status;
}

run_settings run_settings_default(void)
{
    run_settings settings = {.output = run_options[RUN_output - REQUEST_OPTIONS].initial};
    run_parse_interval(run_options[RUN_checkpoint - REQUEST_OPTIONS].initial, &settings.interval);
    return settings;
}

int run_parse_setting(run_settings *settings, int option, const char *text)
{
    switch (option) {
    case RUN_output:
        settings->output = text;
        break;
    case RUN_checkpoint:
        return run_parse_interval(text, &settings->interval);
    case RUN_summary:
        settings->summary = 1;
        break;
    case RUN_progress:
        return progress_parse(text, &settings->progress);
    case RUN_native:
        return native_parse(text, &settings->native);
    case RUN_force:
        settings->force = 1;
        break;
    }
    return CLI_DONE;
}

/* What is to be said of an end that has not been told. */
static void tell_end(const run_recorder *r, int status, const dal_error *error)
{
    if (status == CLI_SIGNAL && r->dir)
        cli_fail(status, "interrupted; go on with: dalembert resume %s", r->dir->path);
    else if (status == CLI_SIGNAL)
        cli_fail(status, "interrupted; %lld rows are kept", r->position.row);
    else if (status != CLI_DONE && error->message[0])
        cli_error(status, r->request->system_name, error);
}

int run_integrate(const run_request *request, run_directory *dir, const run_settings *settings)
{
    run_recorder recorder;
    dal_error error;
    int status = recorder_open(&recorder, request, dir, settings->output);
    recorder.interval = settings->interval;
    recorder.progress = settings->progress;
    if (status == CLI_DONE && recorder_is_finished(&recorder)) {
        cli_fail(CLI_DONE, "'%s' is finished: %lld rows", dir->path, recorder.position.row);
    } else if (status == CLI_DONE) {
        cli_catch_signals();
        if (recorder.position.row > 0)
            cli_fail(CLI_DONE, "'%s' goes on from t = %g with row %lld", dir->path,
                     dal_run_time(request->run), recorder.position.row);
        const double steps = (request->time - dal_run_time(request->run)) / request->options.step;
        native_compile_steps(request->run, &request->method, steps, settings->native);
        native_compile_observables(request->run, steps / (double)request->statistics,
                                   settings->native);
        status = recorder_run(&recorder, &error);
        tell_end(&recorder, status, &error);
        if (settings->summary || isatty(STDERR_FILENO)) summary_print(stderr, &recorder);
    }
    recorder_close(&recorder);
    return status;
}

/* ---- run ----------------------------------------------------------------------------------- */

static int run_in_directory(const run_request *request, const run_settings *settings)
{
    run_directory dir;
    run_directory_open(&dir, settings->output);
    int status = cli_directory(settings->output);
    const char *held =
        status == CLI_DONE && !settings->force ? run_directory_find_file(&dir) : NULL;
    if (held)
        status = cli_fail(CLI_USAGE,
                          "'%s' is there already: 'dalembert resume' goes on with a run, --force "
                          "writes over it",
                          held);
    if (status == CLI_DONE) status = run_directory_lock(&dir, 1);
    if (status == CLI_DONE) status = run_directory_begin(&dir, request);
    if (status == CLI_DONE) status = run_integrate(request, &dir, settings);
    run_directory_close(&dir);
    return status;
}

static int take(run_request *request, run_settings *settings, int option, const char *value)
{
    if (option == CLI_PLAIN) {
        if (request->system_name)
            return cli_fail(CLI_USAGE, "run: one SYSTEM only, not also '%s'", value);
        request->system_name = value;
        return CLI_DONE;
    }
    return option < REQUEST_OPTIONS ? request_parse_option(request, option, value)
                                    : run_parse_setting(settings, option, value);
}

int command_run(int argc, char **argv)
{
    cli_option options[RUN_OPTIONS];
    request_list_options(options);
    memcpy(options + REQUEST_OPTIONS, run_options, sizeof run_options);
    cli_args args = cli_begin(argc, argv, options, RUN_OPTIONS, run_notes);
    run_request request = request_default();
    run_settings settings = run_settings_default();
    const char *value;
    for (int k; (k = cli_next(&args, &value)) != CLI_STOP;) {
        int taken = take(&request, &settings, k, value);
        if (taken != CLI_DONE) cli_stop(&args, taken);
    }
    int status = args.status;
    if (status == CLI_GO_ON) status = request_create_run(&request);
    if (args.status == CLI_GO_ON && status == CLI_DONE)
        status = cli_is_directory(settings.output) ? run_in_directory(&request, &settings)
                                                   : run_integrate(&request, NULL, &settings);
    request_free(&request);
    return status;
}
