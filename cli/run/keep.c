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
    if (status == CLI_DONE) status = record_open(&keep->record, request, store, directory);
    keep->record.interval = interval;
    keep->record.progress = PROGRESS_OFF;
    return status;
}

int keep_go(cli_keep *keep, dal_error *error) { return record_go(&keep->record, error); }

int keep_is_finished(const cli_keep *keep) { return record_is_finished(&keep->record); }

void keep_close(cli_keep *keep)
{
    record_close(&keep->record);
    store_close(&keep->store);
}
