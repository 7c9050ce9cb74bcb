/* report.c - `dalembert report DIR`: a page with figures by gnuplot. */
#include "io/output.h"
#include "report/report_order.h"
#include "report/report_run.h"
#include "report/report_study.h"
#include "ui/cli.h"

#include <stdlib.h>
#include <unistd.h>

/* The file by which a directory is recognised, and what writes its page. */
static const struct {
    const char *file;
    int (*write)(report *r);
} kinds[] = {
    {"cells.csv", report_study}, {"trajectory.npy", report_run}, {"order.csv", report_order}};

enum { KINDS = sizeof kinds / sizeof kinds[0] };

static bool has_file(const char *directory, const char *name)
{
    char *path = cli_join(directory, name);
    const bool found = access(path, F_OK) == 0;
    free(path);
    return found;
}

/* name, value, default, help */
#define OWN_LIST(OPTION) OPTION(format, "svg|png", "svg", "format of the figures")

enum { OWN_LIST(CLI_OWN) OWN_OPTIONS };

static const cli_option options[] = {OWN_LIST(CLI_OPTION)};

static const char notes[] =
    "DIR is the output of 'dalembert study', 'dalembert run --output DIR' or 'dalembert order "
    "--output DIR'.  The command writes DIR/report/index.html, one page with everything in it; the "
    "figures, and the gnuplot scripts that draw them, stand beside it.  Without gnuplot the page "
    "has no figures.\n";

int command_report(int argc, char **argv)
{
    static const char *const formats[] = {"svg", "png"};
    report r = {.format = formats[0]};
    cli_args args = cli_begin(argc, argv, options, OWN_OPTIONS, notes);
    const char *value;
    for (int k; (k = cli_next(&args, &value)) != CLI_STOP;) {
        if (k == OWN_format && cli_word("--format", value, formats, 2) < 0)
            cli_stop(&args, CLI_USAGE);
        else if (k == OWN_format)
            r.format = value;
        else if (r.directory)
            cli_stop(&args, cli_fail(CLI_USAGE, "more than one DIR: '%s'", value));
        else
            r.directory = value;
    }
    if (args.status != CLI_GO_ON) return args.status;
    if (!r.directory) return cli_fail(CLI_USAGE, "the DIR is missing");
    int kind = 0;
    while (kind < KINDS && !has_file(r.directory, kinds[kind].file)) kind++;
    if (kind == KINDS && has_file(r.directory, "study.yaml"))
        return cli_fail(CLI_USAGE,
                        "'%s' holds a study that is not finished: 'dalembert resume' continues it, "
                        "'dalembert merge' merges shards",
                        r.directory);
    if (kind == KINDS)
        return cli_fail(CLI_USAGE,
                        "'%s' holds neither a study (cells.csv) nor a run (trajectory.npy) nor "
                        "orders (order.csv)",
                        r.directory);
    int status = report_open(&r);
    if (status == CLI_DONE) status = kinds[kind].write(&r);
    const int closed = report_close(&r);
    cli_progress_end();
    if (status == CLI_DONE) status = closed;
    if (status == CLI_DONE) printf("%s\n", r.page_path);
    free(r.place);
    free(r.page_path);
    return status == CLI_DONE ? cli_close(stdout, "standard output") : status;
}
