/* run.c - the integration of one run, as `dalembert run` and `dalembert resume` do it. */
#include "run.h"

#include "summary.h"

#include <unistd.h>

const cli_option run_options[RUN_OWN] = {RUN_OPTION_LIST(CLI_OPTION)};

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

static void print_end(const run_recorder *r, int status, const dal_error *error)
{
    if (status == CLI_SIGNAL && r->dir)
        cli_fail(status, "interrupted; resume with: dalembert resume %s", r->dir->path);
    else if (status == CLI_SIGNAL)
        cli_fail(status, "interrupted; %lld rows are kept", r->position.row);
    else if (status != CLI_DONE && error->message[0])
        cli_error(status, r->request->system_name, error);
}

int run_integrate(const run_request *request, run_directory *dir, const run_settings *settings)
{
    run_recorder recorder;
    dal_error error;
    dal_run *run = request->run;
    int status = recorder_open(&recorder, request, dir, settings->output);
    recorder.interval = settings->interval;
    recorder.progress = settings->progress;
    const long long row = recorder.position.row;
    if (status == CLI_DONE && recorder_is_finished(&recorder)) {
        cli_fail(CLI_DONE, "'%s' is finished: %lld rows", dir->path, row);
    } else if (status == CLI_DONE) {
        cli_catch_signals();
        if (row > 0)
            cli_fail(CLI_DONE, "'%s' resumes at t = %g with row %lld", dir->path, dal_run_time(run),
                     row);
        const double steps = (request->time - dal_run_time(run)) / request->options.step;
        native_compile_steps(run, &request->method, steps, settings->native);
        native_compile_observables(run, steps / (double)request->statistics, settings->native);
        status = recorder_run(&recorder, &error);
        print_end(&recorder, status, &error);
        if (settings->summary || isatty(STDERR_FILENO)) summary_print(stderr, &recorder);
    }
    recorder_close(&recorder);
    return status;
}
