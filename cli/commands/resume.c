/* resume.c - `dalembert resume`: continues the run, the study or the ensemble of a directory. */
#include "ensemble/ensemble_growth.h"
#include "ensemble/ensemble_run.h"
#include "io/file.h"
#include "report/report_ensemble.h"
#include "report/report_study.h"
#include "run/extension.h"
#include "run/manifest.h"
#include "run/pool.h"
#include "run/run.h"
#include "run/simulation.h"
#include "study/study_directory.h"
#include "ui/arguments.h"
#include "ui/commands.h"
#include "ui/message.h"

static int resume_run(const char *directory, const run_extension *extension,
                      const run_settings *settings)
{
    run_directory dir;
    run_simulation simulation = simulation_default();
    run_directory_open(&dir, directory);
    int status = manifest_read(&dir, &simulation.request);
    if (status == CLI_DONE) status = extension_create(&dir, &simulation, extension);
    if (status == CLI_DONE) status = run_directory_lock(&dir, RUN_EXISTING);
    if (status == CLI_DONE) status = run_integrate(&simulation, &dir, settings);
    simulation_free(&simulation);
    run_directory_close(&dir);
    return status;
}

typedef struct settings {
    const char *directory;
    long long threads;
    bool no_page;
    ensemble_growth growth;
    run_settings run;
} settings;

static const cli_option options[] = {
    POOL_THREADS_OPTION(settings, "cells of a study, or chunks of an ensemble, at a time"),
    REPORT_NO_PAGE_OPTION(settings),
    EXTENSION_OPTIONS(settings, growth.later),
    {"members", "N2", NULL, "more members of an ensemble: N2 in all",
     CLI_INTEGER(settings, growth.members, 1, ENSEMBLE_MAX_MEMBERS)},
    {NULL, "DIR", CLI_REQUIRED, "what 'run', 'study' or 'ensemble' wrote with --output DIR",
     CLI_TEXT(settings, directory)},
};

static int resume(int argc, char **argv)
{
    settings s = {.threads = pool_threads()};
    const cli_option_set sets[] = {
        run_option_set(&s.run, RUN_OPTION(output) | RUN_OPTION(force)),
        CLI_OPTION_SET(options, &s),
    };
    int status = cli_read_arguments(&command_resume, argc, argv, sets, 2);
    if (status != CLI_GO_ON) return status;
    if (file_find_directory(s.directory) != CLI_DONE) return CLI_USAGE;
    const char *end = s.growth.later.time ? "time" : s.growth.later.steps ? "steps" : NULL;
    bool is_ensemble;
    status = ensemble_directory_find(s.directory, &is_ensemble);
    if (status != CLI_DONE) return status;
    if (s.growth.members > 0 && !is_ensemble)
        return cli_fail(CLI_USAGE, "--members: '%s' holds no ensemble", s.directory);
    if (is_ensemble && (end || s.growth.members > 0)) {
        status = ensemble_grow(s.directory, &s.growth);
        if (status != CLI_DONE) return status;
    }
    if (is_ensemble) {
        const ensemble_run_options how = {(int)s.threads, s.run.interval,  s.run.native,
                                          s.run.progress, work_on_threads, 1};
        const int ended = ensemble_resume(s.directory, &how);
        return s.no_page ? ended : report_after_ensemble(s.directory, ended);
    }
    study_directory dir;
    study_directory_open(&dir, s.directory);
    const bool is_study = study_directory_has_study(&dir);
    study_directory_close(&dir);
    if (end && is_study)
        return cli_fail(CLI_USAGE, "--%s: '%s' holds a study: change '%s/study.yaml' and resume it",
                        end, s.directory, s.directory);
    if (!is_study) return resume_run(s.directory, &s.growth.later, &s.run);
    const study_run_options how = {.threads = (int)s.threads,
                                   .interval = s.run.interval,
                                   .native = s.run.native,
                                   .shows_matrices = s.run.details,
                                   .format = s.run.format};
    const int ended = study_resume(s.directory, &how);
    return s.no_page ? ended : report_after_study(s.directory, ended, REPORT_NAMED);
}

const cli_command command_resume = {
    .name = "resume",
    .synopsis = "dalembert resume DIR [OPTION]...",
    .about = "continues or extends a run, a study or an ensemble",
    .notes = "The rows are, byte for byte, what the same version writes without an interruption.  "
             "A finished run is left alone, unless --time or --steps names a later end: then its "
             "rows go on at the same distance, its statistics and events go on, and the directory "
             "is as if the run had been to that end from the beginning.  The new end is a whole "
             "number of the distances of the rows.  A run that failed, or that an event stopped, "
             "has no later end.  --members adds members to an ensemble, and --time or --steps "
             "gives it a later "
             "end, to which all members run again; the files are as if it had been so from the "
             "beginning.  Of a study, the unfinished runs are "
             "continued and the tables and the page made; of shards, those that were begun in DIR. "
             " --threads is for "
             "studies and ensembles, --summary and --details are for runs, --progress for runs and "
             "ensembles.\n",
    .run = resume,
};
