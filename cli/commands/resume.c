/* resume.c - `dalembert resume`: continues the run or the study in a directory. */
#include "run/manifest.h"
#include "run/pool.h"
#include "run/run.h"
#include "study/study_directory.h"

#include <string.h>

static const char notes[] =
    "DIR is what 'dalembert run --output DIR' or 'dalembert study --output DIR' made.  The rows\n"
    "will be, byte for byte, those of a run of the same version that was never interrupted.  A\n"
    "finished run is left alone.  The unfinished runs of a study are resumed and its tables made;\n"
    "of shards, those that were begun in DIR.  --threads is for studies, --summary and --progress\n"
    "are for runs.\n";

/* The options of a run that a directory does not fix, then one of a study. */
enum {
    FIRST = RUN_checkpoint - REQUEST_OPTIONS,
    OF_RUN = RUN_force - RUN_checkpoint,
    OPTION_threads = OF_RUN,
    OPTIONS
};

static int holds_study(const char *directory)
{
    study_directory dir;
    study_directory_open(&dir, directory);
    const int holds = study_directory_has_study(&dir);
    study_directory_close(&dir);
    return holds;
}

static int resume_run(const char *directory, const run_settings *settings)
{
    run_directory dir;
    run_request request = request_default();
    run_directory_open(&dir, directory);
    int status = manifest_read(&dir, &request);
    if (status == CLI_DONE) status = request_create_run(&request);
    if (status == CLI_DONE) status = run_directory_lock(&dir, 0);
    if (status == CLI_DONE) status = run_integrate(&request, &dir, settings);
    request_free(&request);
    run_directory_close(&dir);
    return status;
}

int command_resume(int argc, char **argv)
{
    cli_option options[OPTIONS];
    memcpy(options, run_options + FIRST, OF_RUN * sizeof *options);
    options[OPTION_threads] =
        (cli_option){"threads", "N", "cells of a study at a time", POOL_DEFAULT_TEXT};
    cli_args args = cli_begin(argc, argv, options, OPTIONS, notes);
    const char *value, *directory = NULL;
    long long threads = pool_threads();
    run_settings settings = run_settings_default();
    for (int k; (k = cli_next(&args, &value)) != CLI_STOP;) {
        int parsed = CLI_DONE;
        if (k == OPTION_threads)
            parsed = cli_integer("--threads", value, 1, POOL_MAX_THREADS, &threads);
        else if (k != CLI_PLAIN)
            parsed = run_parse_setting(&settings, RUN_checkpoint + k, value);
        else if (directory)
            parsed = cli_fail(CLI_USAGE, "resume: one DIR only, not also '%s'", value);
        else
            directory = value;
        if (parsed != CLI_DONE) cli_stop(&args, parsed);
    }
    if (args.status != CLI_GO_ON) return args.status;
    if (!directory) return cli_fail(CLI_USAGE, "resume: the DIR is missing");
    if (!holds_study(directory)) return resume_run(directory, &settings);
    return study_resume(directory,
                        &(study_run_options){(int)threads, settings.interval, settings.native});
}
