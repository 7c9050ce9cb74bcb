/* run.c - the integration of one run, as `dalembert run` and `dalembert resume` do it. */
#include "run.h"
#include "io/file.h"
#include "io/file_output.h"
#include "ui/message.h"
#include "ui/signals.h"

#include "extension.h"
#include "manifest.h"
#include "run_screen.h"
#include "summary.h"
#include "ui/options.h"
#include "ui/screen.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const cli_option options[RUN_OPTIONS] = {
    [RUN_output] = {"output", "FILE|DIR|-", "-",
                    "writes the rows there: .csv, .npy, a directory, or standard output, where a "
                    "terminal gets them only with this option",
                    .parse = cli_parse_output, .offset = offsetof(run_settings, output),
                    .heading = "output"},
    [RUN_events] = {"events", "FILE.csv", NULL,
                    "writes t, the number and the state after it of each event of the system",
                    .parse = cli_parse_text, .offset = offsetof(run_settings, events)},
    [RUN_checkpoint] = {"checkpoint", "SECONDS", "5",
                        "writes a checkpoint to a directory every SECONDS",
                        .parse = cli_parse_number, .offset = offsetof(run_settings, interval),
                        .min = 0.0, .max = INFINITY},
    [RUN_summary] = {"summary", NULL, NULL,
                     "prints the summary on stderr even where it is no terminal",
                     .parse = cli_parse_flag, .offset = offsetof(run_settings, summary)},
    [RUN_details] = {"details", NULL, NULL,
                     "prints the summary with what the rate of a line may be in a longer run",
                     .parse = cli_parse_flag, .offset = offsetof(run_settings, details)},
    [RUN_format] = SCREEN_FORMAT_OPTION(run_settings),
    [RUN_progress] = PROGRESS_OPTION(run_settings),
    [RUN_native] = NATIVE_OPTION(run_settings),
    [RUN_force] = {"force", NULL, NULL, "overwrites what the directory holds",
                   .parse = cli_parse_flag, .offset = offsetof(run_settings, force)},
};

cli_option_set run_option_set(run_settings *settings, uint64_t without)
{
    return (cli_option_set){options, RUN_OPTIONS, settings, settings->text, without, "run", NULL};
}

static void print_end(const run_recorder *r, int status, const dal_error *error)
{
    if (status == CLI_SIGNAL && r->dir)
        store_interrupt(r->dir->path);
    else if (status == CLI_SIGNAL)
        cli_fail(status, "interrupted; %lld rows are kept", r->results.position.row);
    else if (status != CLI_DONE && error->message[0])
        cli_error(status, r->simulation->request.system_name, error);
    else if (error->message[0])
        cli_note("%s: %s", r->simulation->request.system_name, error->message);
    if (status == CLI_FAILED && error->status == DAL_STATUS_NOT_FINITE)
        cli_note("a smaller step may help: --step %g", r->simulation->request.options.step / 10.0);
}

/* Where --events is to be: the file itself, unless a directory has its own, which is copied. */
static int open_events(run_recorder *recorder, const run_simulation *simulation,
                       const run_directory *dir, const run_settings *settings)
{
    if (!settings->events) return CLI_DONE;
    if (simulation->system->events == 0)
        return cli_fail(CLI_USAGE, "--events: %s has no events", simulation->request.system_name);
    const char *reason = strcmp(settings->events, "-") == 0 ? "standard output has the rows"
                         : strcmp(settings->events, settings->output) == 0 ? "the rows go there"
                                                                           : NULL;
    if (reason) return cli_fail(CLI_USAGE, "--events %s: %s", settings->events, reason);
    return dir ? CLI_DONE : event_log_open(&recorder->events, simulation, settings->events);
}

static void print_unresolved(const dal_run *run)
{
    double from;
    const long long steps = dal_run_unresolved(run, &from);
    if (steps > 0)
        cli_note(
            "%lld steps may hide events, the first from t = %g: |d(when)/dt| h > pi max |when| "
            "in their intervals",
            steps, from);
}

int run_integrate(const run_simulation *simulation, run_directory *dir,
                  const run_settings *settings)
{
    run_recorder recorder;
    dal_error error;
    dal_run *run = simulation->run;
    const bool has_format = settings->format != SCREEN_TEXT;
    const bool is_screen_alone = (has_format || screen_has_reader()) && !settings->text[RUN_output];
    const char *output = is_screen_alone ? "/dev/null" : settings->output;
    int status = recorder_open(&recorder, simulation, dir, output);
    if (status == CLI_DONE) status = open_events(&recorder, simulation, dir, settings);
    if (status == CLI_DONE && dir && dir->extends) status = extension_commit(&recorder);
    recorder.interval = settings->interval;
    recorder.progress = settings->progress;
    const long long row = recorder.results.position.row;
    int printed = CLI_DONE;
    if (status == CLI_DONE && recorder_is_finished(&recorder)) {
        cli_note("'%s' is finished: %lld rows", dir->path, row);
    } else if (status == CLI_DONE) {
        cli_catch_signals();
        if (row > 0)
            cli_note("'%s' resumes at t = %g with row %lld", dir->path, dal_run_time(run), row);
        const double steps =
            (simulation->end - dal_run_time(run)) / simulation->request.options.step;
        recorder.native =
            native_begin(run, simulation->end, steps / (double)simulation->request.statistics, 1.0,
                         settings->native);
        status = recorder_run(&recorder, &error);
        print_end(&recorder, status, &error);
        print_unresolved(run);
        /* A terminal gets a screen; what is no terminal, the table of all numbers on request. */
        FILE *reader = has_format ? stdout : screen_terminal();
        if (reader && !settings->details && !settings->has_no_screen)
            printed = run_screen_print(reader, &recorder, is_screen_alone ? NULL : output,
                                       settings->format);
        if (settings->details || (settings->summary && !isatty(STDERR_FILENO)))
            summary_print(stderr, simulation, &recorder.results);
        if (settings->details) summary_print_details(stderr, &recorder.results);
    }
    const int closed = recorder_close(&recorder);
    const int copied = dir && settings->events
                           ? file_copy(dir->events, settings->events, FILE_UNSYNCED)
                           : CLI_DONE;
    const int all[] = {status, closed, copied, printed};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i] != CLI_DONE) return all[i];
    return CLI_DONE;
}

int run_check_directory(const char *path)
{
    run_directory dir;
    run_directory_open(&dir, path);
    const char *file = run_directory_find_file(&dir);
    const int status =
        !file ? file_check_directory(path)
              : cli_fail(
                    CLI_USAGE,
                    "'%s' exists already: 'dalembert resume' continues a run, --force overwrites "
                    "it",
                    file);
    run_directory_close(&dir);
    return status;
}

int run_in_directory(const run_simulation *simulation, const run_settings *settings)
{
    run_directory dir;
    run_directory_open(&dir, settings->output);
    int status = settings->force ? CLI_DONE : run_check_directory(dir.path);
    if (status == CLI_DONE) status = file_make_directory(dir.path);
    if (status == CLI_DONE) status = run_directory_lock(&dir, RUN_NEW);
    if (status == CLI_DONE) status = manifest_begin(&dir, simulation);
    if (status == CLI_DONE) status = run_integrate(simulation, &dir, settings);
    file_report_directory(dir.path, status);
    run_directory_close(&dir);
    return status;
}
