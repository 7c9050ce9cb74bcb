/* resume.c - `dalembert resume`: goes on with a run that lives in a directory. */
#include "run.h"

static const char notes[] =
    "DIR is what 'dalembert run --output DIR' made.  The rows will be, byte for byte, those of a\n"
    "run that was never interrupted.  A finished run is left alone.\n";

static int resume(const char *directory, const run_wishes *wishes)
{
    cli_store store;
    cli_job job = job_begin();
    int status = store_open(&store, directory);
    if (status != CLI_DONE) return status;
    status = store_read(&store, &job);
    if (status == CLI_DONE) status = job_make(&job);
    if (status == CLI_DONE) status = store_lock(&store);
    if (status == CLI_DONE) status = run_integrate(&job, &store, wishes);
    job_free(&job);
    store_close(&store);
    return status;
}

int command_resume(int argc, char **argv)
{
    enum { FIRST = OWN_checkpoint - JOB_OPTIONS, COUNT = OWN_force - OWN_checkpoint };
    cli_args args = cli_begin(argc, argv, own_options + FIRST, COUNT, notes);
    const char *value, *directory = NULL;
    run_wishes wishes = run_wish();
    for (int k; (k = cli_next(&args, &value)) != CLI_STOP;) {
        int taken = CLI_DONE;
        if (k != CLI_PLAIN)
            taken = run_take(&wishes, OWN_checkpoint + k, value);
        else if (directory)
            taken = cli_fail(CLI_USAGE, "resume: one DIR only, not also '%s'", value);
        else
            directory = value;
        if (taken != CLI_DONE) cli_stop(&args, taken);
    }
    if (args.status != CLI_GO_ON) return args.status;
    if (!directory) return cli_fail(CLI_USAGE, "resume: the DIR is missing");
    return resume(directory, &wishes);
}
