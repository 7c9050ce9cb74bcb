/* dalembert_mpi.c - the program `dalembert-mpi`: a study on the processes of a cluster.
 *
 *     mpirun -n 64 dalembert-mpi STUDY.yaml --output DIR
 *
 * All processes see DIR.  Rank 0 describes the study there and assigns the cells, the costliest
 * first, while it runs cells itself: between steps it polls the requests of the other ranks.  Only
 * numbers of cells pass between processes; everything else goes through the directories of the
 * runs.  So this program or `dalembert resume` can continue the study after an interruption, with
 * the same bytes.  At the end rank 0 reads the directories and makes the tables. */
#include "io/file.h"
#include "run/pool.h"
#include "run/run.h"
#include "study/study_directory.h"
#include "ui/message.h"
#include "ui/options.h"
#include "ui/signals.h"

#include <mpi.h>
#include <stdlib.h>
#include <string.h>

/* What all ranks must know; they read the texts of the study from its directory. */
enum { PATH = 4096 };
typedef struct settings {
    char output[PATH];
    run_settings run;
    bool resume;
    int status;        /* of rank 0: what its arguments led to */
    const char *study; /* of rank 0 alone */
} settings;

static int parse_output(void *user, const cli_option *option, const char *text)
{
    settings *w = user;
    (void)option;
    if (strlen(text) >= sizeof w->output)
        return cli_fail(CLI_USAGE, "--output: the path is too long");
    memcpy(w->output, text, strlen(text) + 1);
    return CLI_DONE;
}

static const cli_option options[] = {
    {"output", "DIR", CLI_REQUIRED, "writes the files there", .parse = parse_output},
    {"resume", NULL, NULL, "continues the study in DIR", .parse = cli_parse_flag,
     .offset = offsetof(settings, resume)},
    {NULL, "STUDY.yaml", NULL, "a study file", .parse = cli_parse_text,
     .offset = offsetof(settings, study)},
};

static const cli_command command = {
    .name = "dalembert-mpi",
    .synopsis = "mpirun dalembert-mpi STUDY.yaml --output DIR [OPTION]...",
    .about = "runs a study, as 'dalembert study' does, with a process for each cell at a time",
    .notes = "mpirun starts the processes.  All of them must see DIR.  The results are the same "
             "bytes.\n",
};

static int check(const settings *w)
{
    if (w->resume && w->study)
        return cli_fail(CLI_USAGE, "--resume: the study is the one in '%s'", w->output);
    if (!w->resume && !w->study) return cli_fail(CLI_USAGE, "the STUDY.yaml is missing");
    return CLI_GO_ON;
}

static int read_arguments(settings *w, int argc, char **argv)
{
    enum { OPTIONS = sizeof options / sizeof *options };
    const cli_group groups[] = {
        {options, OPTIONS, .settings = w},
        run_group(&w->run, RUN_OPTION(output) | RUN_OPTION(summary) | RUN_OPTION(progress)),
    };
    const int status = cli_read_arguments(&command, argc, argv, groups, 2);
    return status == CLI_GO_ON ? check(w) : status;
}

/* ---- the study ---- */

/* Describes a new study in its directory, where all ranks then read it. */
static int describe(const settings *w)
{
    size_t length;
    study_plan plan = {0};
    study_directory dir = {0};
    const study_shard whole = {0};
    char *text = file_read(w->study, &length);
    if (!text) return CLI_USAGE;
    int status = study_plan_read(&plan, w->study, text, length, NULL);
    study_directory_open(&dir, w->output);
    if (status == CLI_DONE)
        status = study_directory_begin(&dir, &plan, text, length, whole, w->run.force);
    study_plan_free(&plan);
    study_directory_close(&dir);
    free(text);
    return status;
}

typedef struct scheduler {
    study_plan *plan;
    int *order;
    int rank, size;
    int next;    /* of rank 0: the place in order of the next cell */
    int waiting; /* of rank 0: ranks that have not got the end yet */
} scheduler;

enum { REQUEST_TAG, CELL_TAG };

/* ---- assigning cells ---- */

static int next_cell(scheduler *t)
{
    while (t->next < t->plan->cell_count && !cli_interrupted()) {
        const int cell = t->order[t->next++];
        if (!t->plan->cells[cell].elsewhere) return cell;
    }
    return -1;
}

static void assign_cell(scheduler *t)
{
    MPI_Status from;
    int nothing, cell = next_cell(t);
    MPI_Recv(&nothing, 1, MPI_INT, MPI_ANY_SOURCE, REQUEST_TAG, MPI_COMM_WORLD, &from);
    MPI_Send(&cell, 1, MPI_INT, from.MPI_SOURCE, CELL_TAG, MPI_COMM_WORLD);
    if (cell < 0) t->waiting--;
}

/* Assigns cells to the ranks whose requests have come. */
static void assign_cells(scheduler *t)
{
    for (int requested = 1; requested && t->waiting > 0;) {
        MPI_Iprobe(MPI_ANY_SOURCE, REQUEST_TAG, MPI_COMM_WORLD, &requested, MPI_STATUS_IGNORE);
        if (requested) assign_cell(t);
    }
}

static int request_cell(void)
{
    int cell = -1;
    MPI_Send(&cell, 1, MPI_INT, 0, REQUEST_TAG, MPI_COMM_WORLD);
    MPI_Recv(&cell, 1, MPI_INT, 0, CELL_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return cell;
}

static int stop(void *user)
{
    scheduler *t = user;
    if (t->rank == 0) assign_cells(t);
    return cli_interrupted();
}

/* A failure of one rank's own leaves the cells to the others. */
static int run_cells(scheduler *t)
{
    const study_stop_check watch = {stop, t};
    int status = CLI_DONE;
    for (int cell;
         status == CLI_DONE && (cell = t->rank == 0 ? next_cell(t) : request_cell()) >= 0;) {
        status = study_cell_run(t->plan, &t->plan->cells[cell], &watch);
        study_cell_free(&t->plan->cells[cell]);
        if (t->rank == 0) assign_cells(t);
    }
    if (t->rank > 0 && status != CLI_DONE)
        while (request_cell() >= 0) continue;
    while (t->rank == 0 && t->waiting > 0) assign_cell(t);
    return status;
}

/* ---- the whole ---- */

/* The worst status of all ranks. */
static int agree(int status)
{
    int worst;
    MPI_Allreduce(&status, &worst, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    return worst;
}

static int finish(study_plan *plan, const study_directory *dir, int status)
{
    if (status == CLI_SIGNAL)
        return cli_fail(status, "interrupted; resume with: dalembert resume %s", dir->directory);
    if (status != CLI_DONE) return status;
    return study_directory_finish(dir, plan, study_pool_run(plan, pool_threads()));
}

static int run_study(const settings *w, int rank, int size)
{
    study_plan plan = {0};
    study_directory dir = {0};
    scheduler t = {.plan = &plan, .rank = rank, .size = size, .waiting = size - 1};
    study_directory_open(&dir, w->output);
    int status = study_directory_read(&dir, &plan);
    t.order = study_sort_cells(&plan);
    plan.interval = w->run.interval;
    for (int i = 0; i < plan.case_count; i++) plan.cases[i].native = w->run.native;
    status = agree(status);
    if (status == CLI_DONE) {
        cli_catch_signals();
        status = agree(run_cells(&t));
        if (status == CLI_DONE && cli_interrupted()) status = CLI_SIGNAL;
        if (rank == 0) status = finish(&plan, &dir, status);
    }
    free(t.order);
    study_plan_free(&plan);
    study_directory_close(&dir);
    return status;
}

static int start(int argc, char **argv, int rank, int size)
{
    settings w = {0};
    if (rank == 0) {
        w.status = read_arguments(&w, argc, argv);
        const int described = w.status == CLI_GO_ON && !w.resume ? describe(&w) : CLI_DONE;
        if (described != CLI_DONE) w.status = described;
    }
    MPI_Bcast(&w, sizeof w, MPI_BYTE, 0, MPI_COMM_WORLD);
    return w.status == CLI_GO_ON ? run_study(&w, rank, size) : w.status;
}

int main(int argc, char **argv)
{
    int rank, size;
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    /* Of a status all ranks return the same, so that mpirun does not blame one of them. */
    int status = start(argc, argv, rank, size);
    MPI_Bcast(&status, 1, MPI_INT, 0, MPI_COMM_WORLD);
    MPI_Finalize();
    return status;
}
