/* mpi_ensemble.c - an ensemble on the processes of a cluster.
 *
 * Each process marks the chunks that it has done in a file of its own, as a shard does.  Rank 0
 * makes the statistics when the others have closed their files. */
#include "mpi_ensemble.h"
#include "ensemble/ensemble_run.h"
#include "run/pool.h"
#include "ui/arguments.h"
#include "ui/message.h"

static const cli_command command = {
    .name = "dalembert-mpi ensemble",
    .synopsis = "mpirun dalembert-mpi ensemble SYSTEM --members N --seed S --vary "
                "NAME=DISTRIBUTION --output DIR [OPTION]...",
    .about = "runs an ensemble, as 'dalembert ensemble' does, with a process for each 256 members "
             "at a time",
    .notes = "mpirun starts the processes.  All of them must see DIR.  The results are the same "
             "bytes.  'mpirun dalembert-mpi --resume --output DIR' continues, with any number of "
             "processes, and 'dalembert report DIR' makes the page.\n",
};

static int begin_directory(mpi_request *request, ensemble_settings *s)
{
    ensemble_directory dir;
    const store_shard whole = {0};
    request->interval = s->interval;
    request->native = s->native;
    int status = mpi_set_output(request, s->output);
    if (status == CLI_DONE) status = ensemble_complete(&s->ensemble);
    if (status != CLI_DONE) return status;
    ensemble_directory_open(&dir, s->output);
    status = ensemble_directory_begin(&dir, &s->ensemble, whole, s->force);
    ensemble_directory_close(&dir);
    return status == CLI_DONE ? CLI_GO_ON : status;
}

int mpi_ensemble_begin(mpi_request *request, int argc, char **argv)
{
    ensemble_settings s = {.ensemble = ensemble_default()};
    const cli_option_set sets[] = {
        ensemble_option_set(&s),
        simulation_options(&s.ensemble.simulation, request_options, ENSEMBLE_WITHOUT),
    };
    int status = cli_read_arguments(&command, argc, argv, sets, 2);
    if (status == CLI_GO_ON) status = begin_directory(request, &s);
    ensemble_free(&s.ensemble);
    return status;
}

static int open_shard(const mpi_request *request, store_shard shard, ensemble *e,
                      ensemble_directory *dir)
{
    *e = ensemble_default();
    ensemble_directory_open(dir, request->output);
    const int status = ensemble_directory_read(dir, e);
    return status == CLI_DONE ? ensemble_directory_attach(dir, e, shard) : status;
}

static void close_shard(ensemble *e, ensemble_directory *dir)
{
    ensemble_free(e);
    ensemble_directory_close(dir);
}

int mpi_ensemble_run(const mpi_request *request)
{
    const ensemble_run_options how = {
        1, request->interval, request->native, PROGRESS_OFF, mpi_run_list, request->size};
    const store_shard own = {request->rank + 1, request->size};
    ensemble e;
    ensemble_directory dir;
    int status = mpi_max_status(open_shard(request, own, &e, &dir));
    dir.marks.shard = (store_shard){0}; /* any process runs any chunk */
    if (status == CLI_DONE) status = ensemble_run(&e, &dir, &how);
    close_shard(&e, &dir);
    status = mpi_max_status(status);
    if (request->rank > 0 || (status != CLI_DONE && status != CLI_SIGNAL)) return status;
    /* The whole has the marks of all shards now. */
    int opened = open_shard(request, (store_shard){0}, &e, &dir);
    if (opened == CLI_DONE) opened = ensemble_directory_save(&dir);
    status = opened == CLI_DONE ? ensemble_end(&e, &dir, status, pool_threads()) : opened;
    close_shard(&e, &dir);
    return status;
}
