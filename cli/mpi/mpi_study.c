/* mpi_study.c - a study on the processes of a cluster.
 *
 * Rank 0 begins the study in its directory, where all read it, and makes the tables at the end. */
#include "mpi_study.h"
#include "io/file.h"
#include "run/pool.h"
#include "run/run.h"
#include "study/study_cell.h"
#include "study/study_directory.h"
#include "study/study_methods.h"
#include "study/study_pool.h"
#include "study/study_results.h"
#include "ui/arguments.h"
#include "ui/message.h"
#include "ui/signals.h"

#include <mpi.h>
#include <stdlib.h>

/* ---- on rank 0, at the beginning ---- */

typedef struct settings {
    const char *study, *output;
    bool resume;
    run_settings run;
} settings;

static const cli_option options[] = {
    {"output", "DIR", CLI_REQUIRED, "writes the files there", CLI_TEXT(settings, output)},
    {"resume", NULL, NULL, "continues the study or ensemble in DIR", CLI_FLAG(settings, resume)},
    {NULL, "STUDY.yaml", NULL, "a study file", CLI_TEXT(settings, study)},
};

static const cli_command command = {
    .name = "dalembert-mpi",
    .synopsis = "mpirun dalembert-mpi STUDY.yaml --output DIR [OPTION]...",
    .about = "runs a study, as 'dalembert study' does, with a process for each cell at a time",
    .notes = "mpirun starts the processes.  All of them must see DIR.  The results are the same "
             "bytes.  'mpirun dalembert-mpi ensemble SYSTEM ...' runs an ensemble; 'dalembert-mpi "
             "ensemble --help' has its options.\n",
};

static int parse_arguments(settings *s, int argc, char **argv)
{
    const cli_option_set sets[] = {
        CLI_OPTION_SET(options, s),
        run_option_set(&s->run, RUN_OPTION(output) | RUN_OPTION(events) | RUN_OPTION(summary) |
                                    RUN_OPTION(details) | RUN_OPTION(progress)),
    };
    const int status = cli_read_arguments(&command, argc, argv, sets, 2);
    if (status != CLI_GO_ON) return status;
    if (s->resume && s->study)
        return cli_fail(CLI_USAGE, "--resume: what is continued is in '%s'", s->output);
    if (!s->resume && !s->study) return cli_fail(CLI_USAGE, "the STUDY.yaml is missing");
    return CLI_GO_ON;
}

/* Begins a new study in its directory, where all ranks then read it. */
static int begin_directory(const settings *s)
{
    size_t length;
    study_plan plan = {0};
    study_directory dir;
    const store_shard whole = {0};
    char *text = file_read(s->study, &length);
    if (!text) return CLI_USAGE;
    int status = study_plan_read(&plan, s->study, text, length, NULL);
    study_directory_open(&dir, s->output);
    if (status == CLI_DONE)
        status = study_directory_begin(&dir, &plan, text, length, whole, s->run.force);
    if (status == CLI_DONE) study_say_projected(&plan);
    study_plan_free(&plan);
    study_directory_close(&dir);
    free(text);
    return status;
}

int mpi_study_begin(mpi_request *request, int argc, char **argv)
{
    settings s = {0};
    int status = parse_arguments(&s, argc, argv);
    if (status != CLI_GO_ON) return status;
    request->interval = s.run.interval;
    request->native = s.run.native;
    status = mpi_set_output(request, s.output);
    if (status == CLI_DONE && !s.resume) status = begin_directory(&s);
    return status == CLI_DONE ? CLI_GO_ON : status;
}

/* ---- on all ranks ---- */

/* On rank 0: reads what all have done, and makes the tables. */
static int finish(study_plan *plan, const study_directory *dir)
{
    int status = study_directory_open_results(dir, plan, plan->results);
    for (int i = 0; i < plan->cell_count; i++) study_cell_free(&plan->cells[i]);
    if (status != CLI_DONE) return status;
    const int threads = pool_threads();
    return study_directory_finish(dir, plan, study_pool_run(plan, work_on_threads, threads));
}

static int run_cells(study_plan *plan)
{
    cli_catch_signals();
    const int status = study_pool_run(plan, mpi_run_list, 1);
    if (status == CLI_IO) return status;
    const int saved = study_directory_save_results(plan);
    return status == CLI_DONE ? saved : status;
}

int mpi_study_run(const mpi_request *request)
{
    study_plan plan = {0};
    study_directory dir;
    study_directory_open(&dir, request->output);
    dir.writer = request->rank + 1;
    int status = mpi_max_status(study_directory_read(&dir, &plan));
    plan.interval = request->interval;
    plan.native = request->native;
    if (status == CLI_DONE) status = mpi_max_status(run_cells(&plan));
    if (request->rank == 0 && status == CLI_SIGNAL) status = store_interrupt(dir.path);
    if (request->rank == 0 && status == CLI_DONE) status = finish(&plan, &dir);
    study_plan_free(&plan);
    study_directory_close(&dir);
    return status;
}
