/* ensemble.c - `dalembert ensemble`: many members of one motion, and their statistics. */
#include "ensemble/ensemble_run.h"
#include "io/file.h"
#include "report/report_ensemble.h"
#include "run/pool.h"
#include "ui/arguments.h"
#include "ui/commands.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <stdio.h>

typedef struct settings {
    ensemble_settings common; /* with dalembert-mpi */
    long long threads;
    store_shard shard;
    progress_mode progress;
    bool no_page;
} settings;

static const cli_option options[] = {
    POOL_THREADS_OPTION(settings, "chunks of members at a time; results do not depend on it"),
    STORE_SHARD_OPTION(
        settings,
        "runs every N-th chunk of 256 members, from the K-th on; 'dalembert merge' joins shards"),
    PROGRESS_OPTION(settings),
    {"no-page", NULL, NULL, "writes no page", CLI_FLAG(settings, no_page)},
};

static int run_ensemble(settings *s)
{
    ensemble *e = &s->common.ensemble;
    const ensemble_run_options how = {(int)s->threads, s->common.interval, s->common.native,
                                      s->progress,     work_on_threads,    1};
    ensemble_directory dir;
    int status = ensemble_complete(e);
    if (status != CLI_DONE) return status;
    ensemble_directory_open(&dir, s->common.output);
    status = ensemble_directory_begin(&dir, e, s->shard, s->common.force);
    if (status == CLI_DONE)
        status = ensemble_end(e, &dir, ensemble_run(e, &dir, &how), how.threads);
    if (!s->no_page) status = report_after_ensemble(s->common.output, status);
    ensemble_directory_close(&dir);
    return status;
}

static int run_command(int argc, char **argv)
{
    settings s = {.common = {.ensemble = ensemble_default()}, .threads = pool_threads()};
    run_simulation *simulation = &s.common.ensemble.simulation;
    const cli_option_set sets[] = {
        ensemble_option_set(&s.common),
        CLI_OPTION_SET(options, &s),
        simulation_options(simulation, request_options, ENSEMBLE_WITHOUT),
    };
    int status = cli_read_arguments(&command_ensemble, argc, argv, sets, 3);
    if (status == CLI_GO_ON) status = run_ensemble(&s);
    ensemble_free(&s.common.ensemble);
    return status;
}

const cli_command command_ensemble = {
    .name = "ensemble",
    .synopsis = "dalembert ensemble SYSTEM --members N --seed S --vary NAME=DISTRIBUTION --output "
                "DIR [OPTION]...",
    .about = "runs many members whose starts and parameters are drawn",
    .notes =
        "Members differ by what is drawn and added to their start values or parameters: a function "
        "of seed, name and member alone, so that threads, shards and interruptions change no bit.  "
        "By default --consistent is on here: the velocities of each start are moved to D = 0.  All "
        "members are stepped by compiled batches on all processors.  They are observed at --times "
        "and at "
        "the end, after whole steps.  With --tolerance, --step may be left out: it is a hundredth "
        "of the time.\n"
        "\n"
        "The directory gets\n"
        "  final.npy       the state of each member at the end, NaN where it failed\n"
        "  rows.npy        the same at each of --times\n"
        "  members.npy     status (0: done), t that was reached, and what was drawn\n"
        "  statistics.csv  count, mean, standard deviation, exact quantiles, min and max\n"
        "  covariance.csv  of the components of the state, at each time\n"
        "  failures.csv    the members that failed, and why\n"
        "  histograms.csv, cloud.csv, report/index.html\n"
        "                  figures: histograms, and the cloud of members in a plane\n"
        "\n"
        "The exit status is 0 where any member reached the end.  'dalembert resume DIR' continues "
        "after any interruption, kill -9 included, to the same bytes.  'mpirun dalembert-mpi "
        "ensemble SYSTEM ...' runs an ensemble on the processes of a cluster.\n",
    .run = run_command,
};
