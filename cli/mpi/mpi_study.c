/* mpi_study.c - a study on the processes of a cluster.
 *
 * Rank 0 begins the study in its directory and hands out the cells, the costliest first, while it
 * runs cells itself: it serves requests between steps.  Processes exchange only numbers of cells;
 * all else is in the directory, so that the study can be resumed after an interruption, by this
 * program or by `dalembert resume`, to the same bytes.  At the end rank 0 reads them and makes the
 * tables. */
#include "mpi_study.h"
#include "io/file.h"
#include "run/pool.h"
#include "run/run.h"
#include "study/study_cell.h"
#include "study/study_directory.h"
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
    const cli_group groups[] = {
        CLI_GROUP(options, s),
        run_group(&s->run, RUN_OPTION(output) | RUN_OPTION(events) | RUN_OPTION(summary) |
                               RUN_OPTION(details) | RUN_OPTION(progress)),
    };
    const int status = cli_read_arguments(&command, argc, argv, groups, 2);
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

/* ---- handing out cells ---- */

typedef struct cell_queue {
    study_plan *plan;
    int *order;
    int rank;
    int next;    /* of rank 0: the place in order of the next cell */
    int waiting; /* of rank 0: how many other ranks have not been refused a cell */
} cell_queue;

enum { REQUEST_CELL, SEND_CELL };

static int next_cell(cell_queue *q)
{
    while (q->next < q->plan->cell_count && !cli_interrupted()) {
        const int cell = q->order[q->next++];
        if (!q->plan->cells[cell].other_shard) return cell;
    }
    return -1;
}

static void serve_request(cell_queue *q)
{
    MPI_Status from;
    int nothing, cell = next_cell(q);
    MPI_Recv(&nothing, 1, MPI_INT, MPI_ANY_SOURCE, REQUEST_CELL, MPI_COMM_WORLD, &from);
    MPI_Send(&cell, 1, MPI_INT, from.MPI_SOURCE, SEND_CELL, MPI_COMM_WORLD);
    if (cell < 0) q->waiting--;
}

/* Serves the requests that have arrived, on rank 0. */
static void serve_requests(cell_queue *q)
{
    for (int arrived = 1; q->rank == 0 && arrived && q->waiting > 0;) {
        MPI_Iprobe(MPI_ANY_SOURCE, REQUEST_CELL, MPI_COMM_WORLD, &arrived, MPI_STATUS_IGNORE);
        if (arrived) serve_request(q);
    }
}

static int request_cell(void)
{
    int cell = -1;
    MPI_Send(&cell, 1, MPI_INT, 0, REQUEST_CELL, MPI_COMM_WORLD);
    MPI_Recv(&cell, 1, MPI_INT, 0, SEND_CELL, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return cell;
}

static bool must_stop(void *user)
{
    serve_requests(user);
    return cli_interrupted();
}

/* After a failure of a rank's own the other ranks run the cells that are left. */
static int run_cells(cell_queue *q)
{
    const study_stop_check check = {must_stop, q};
    int status = CLI_DONE;
    while (status == CLI_DONE) {
        const int cell = q->rank == 0 ? next_cell(q) : request_cell();
        if (cell < 0) break;
        status = study_cell_run(q->plan, &q->plan->cells[cell], &check);
        study_cell_free(&q->plan->cells[cell]);
        serve_requests(q);
    }
    if (q->rank > 0 && status != CLI_DONE)
        while (request_cell() >= 0) continue;
    while (q->rank == 0 && q->waiting > 0) serve_request(q);
    if (!q->plan->results || status == CLI_IO) return status;
    const int saved = study_results_save(q->plan->results);
    return status == CLI_DONE ? saved : status;
}

/* ---- all ---- */

static int finish(study_plan *plan, const study_directory *dir, int status)
{
    if (status == CLI_SIGNAL) return store_interrupt(dir->path);
    if (status != CLI_DONE) return status;
    /* The results of the other ranks are in their files now. */
    status = study_directory_open_results(dir, plan, dir->text, dir->length, &plan->results);
    if (status != CLI_DONE) return status;
    return study_directory_finish(dir, plan, study_pool_run(plan, pool_threads()));
}

int mpi_study_run(const mpi_request *request)
{
    study_plan plan = {0};
    study_directory dir;
    cell_queue q = {.plan = &plan, .rank = request->rank, .waiting = request->size - 1};
    study_directory_open(&dir, request->output);
    dir.writer = request->rank + 1;
    int status = study_directory_read(&dir, &plan);
    q.order = study_sort_cells(&plan);
    study_plan_add_steps(&plan);
    plan.interval = request->interval;
    plan.native = request->native;
    plan.shows_matrices = true; /* mpirun gives a rank a terminal, wherever its own output goes */
    status = mpi_max_status(status);
    if (status == CLI_DONE) {
        cli_catch_signals();
        status = mpi_max_status(run_cells(&q));
        if (status == CLI_DONE && cli_interrupted()) status = CLI_SIGNAL;
        if (request->rank == 0) status = finish(&plan, &dir, status);
    }
    free(q.order);
    study_plan_free(&plan);
    study_directory_close(&dir);
    return status;
}
