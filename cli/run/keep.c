/* keep.c - a run in a directory of its own, begun or gone on with. */
#include "keep.h"

static const double interval = 5.0; /* seconds between checkpoints */

static int go_on(cli_keep *keep, const run_request *request)
{
    run_request held = request_default();
    int status = store_read(&keep->store, &held);
    if (status == CLI_DONE) status = store_is_of(&keep->store, &held, request);
    request_free(&held);
    return status;
}

int keep_open(cli_keep *keep, const run_request *request, const char *directory)
{
    cli_store *store = &keep->store;
    *keep = (cli_keep){0};
    store_open(store, directory);
    store->settle = 0;
    int status = cli_directory(directory);
    if (status == CLI_DONE) status = store_lock(store, !store_is_described(store));
    if (status == CLI_DONE)
        status = store_is_described(store) ? go_on(keep, request) : store_describe(store, request);
    if (status == CLI_DONE) status = recorder_open(&keep->recorder, request, store, directory);
    keep->recorder.interval = interval;
    keep->recorder.progress = PROGRESS_OFF;
    return status;
}

int keep_go(cli_keep *keep, dal_error *error) { return recorder_run(&keep->recorder, error); }

int keep_is_finished(const cli_keep *keep) { return recorder_is_finished(&keep->recorder); }

void keep_close(cli_keep *keep)
{
    recorder_close(&keep->recorder);
    store_close(&keep->store);
}
