/* keep.c - a run in a directory of its own, begun or gone on with. */
#include "keep.h"
#include "ui/message.h"

#include "io/output.h"
#include "manifest.h"

static const double interval = 5.0; /* seconds between checkpoints */

static int go_on(cli_keep *keep, const run_request *request)
{
    run_request held = request_default();
    int status = manifest_read(&keep->dir, &held);
    if (status == CLI_DONE) status = manifest_compare(&keep->dir, &held, request);
    request_free(&held);
    return status;
}

int keep_open(cli_keep *keep, const run_request *request, const char *directory)
{
    run_directory *dir = &keep->dir;
    *keep = (cli_keep){0};
    run_directory_open(dir, directory);
    dir->sync = 0;
    int status = cli_directory(directory);
    if (status == CLI_DONE) status = run_directory_lock(dir, !run_directory_has_run(dir));
    if (status == CLI_DONE)
        status = run_directory_has_run(dir) ? go_on(keep, request) : manifest_begin(dir, request);
    if (status == CLI_DONE) status = recorder_open(&keep->recorder, request, dir, directory);
    keep->recorder.interval = interval;
    keep->recorder.progress = PROGRESS_OFF;
    return status;
}

int keep_go(cli_keep *keep, dal_error *error) { return recorder_run(&keep->recorder, error); }

int keep_is_finished(const cli_keep *keep) { return recorder_is_finished(&keep->recorder); }

void keep_close(cli_keep *keep)
{
    recorder_close(&keep->recorder);
    run_directory_close(&keep->dir);
}
